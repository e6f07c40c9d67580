# SPDX-License-Identifier: MIT
# Films saved by the viewer: the same bytes as the command's, each kind of file, a refusal that names the file.
. "$CHECK"

scene=$SOURCE/scenes/simple.json
drive "$scene" --size 200x120 <<'END'
set a.method podee-pixel
film film.y4m 1 3 96x54
film frame-####.png 0 1
film count_%03d.png 0 1 32x18
film wide.exr 0 0 64x36
expect-no-error
END
exists film.y4m film.y4m.json frame-0000.png frame-0001.png count_000.png count_001.png wide-0000.exr
works render "$scene" -o whole.y4m --frames 1-3 --size 96x54 --method podee-pixel --quiet
same film.y4m whole.y4m
[[ ! -e frame-0002.png ]] || fail "a film of two frames has three"
echo 'film film.y4m 0 1' >again.txt
expect 1 '^again.txt:1: film.y4m: exists already' view "$scene" --size 200x120 --backend cpu --quiet --script again.txt
same film.y4m whole.y4m
echo 'film film.gif 0 1' >gif.txt
expect 1 'ends in none of .mp4, .mov, .y4m, .png and .exr' view "$scene" --size 200x120 --backend cpu --quiet --script gif.txt
finish
