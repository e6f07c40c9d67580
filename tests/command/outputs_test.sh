# SPDX-License-Identifier: MIT
# Kinds of files, layers, numbering, and what happens to files that are there already.
. "$CHECK"

works render "$simple" -o a.png "${small[@]}" --quiet
[[ ! -s stderr.txt ]] || fail "--quiet is not quiet"
exists a.png
expect 73 'a.png: .*--overwrite' render "$simple" -o a.png "${small[@]}"
works render "$simple" -o a.png "${small[@]}" --overwrite
expect 0 'a.png: 1 frame of 64 x 36' render "$simple" -o a.png "${small[@]}" --overwrite

# A link stays a link, and what it names is replaced, or made, with the permissions that it had.
for end in png pfm y4m; do
    mkdir -p shelf
    ln -s shelf/kept.$end link.$end
    works render "$simple" -o link.$end "${small[@]}" "${null[@]}" --frames 0 --quiet
    exists shelf/kept.$end
    chmod 640 shelf/kept.$end
    cp shelf/kept.$end kept
    expect 73 "link.$end: .*--overwrite" render "$simple" -o link.$end "${small[@]}" "${null[@]}" --frames 0
    works render "$simple" -o link.$end --size 32x18 "${null[@]}" --frames 0 --quiet --overwrite
    differ shelf/kept.$end kept
    [[ -L link.$end && $(stat -c %a shelf/kept.$end) == 640 ]] || fail "link.$end: $(ls -l link.$end shelf)"
    no_temporaries shelf
    works render "$simple" -o link.$end --size 32x18 "${null[@]}" --frames 0 --quiet --skip-existing
done
expect 73 'away.png: cannot write: folder .*nowhere: No such file' render "$simple" -o "$(ln -s nowhere/a.png away.png && echo away.png)" "${small[@]}"

for layer in color coverage mask depth normal; do
    works render "$simple" -o $layer.pfm --layer $layer "${small[@]}" --quiet
    exists $layer.pfm $layer.pfm.json
    head -c 2 $layer.pfm | grep -q "$([[ $layer == color || $layer == normal ]] && echo PF || echo Pf)" || fail "$layer.pfm has the wrong kind"
done
for layer in coverage mask normal; do
    works render "$simple" -o $layer.png --layer $layer "${small[@]}" --quiet
    exists $layer.png
done
works render "$simple" -o all.exr --layer all "${small[@]}" --quiet
works render "$simple" -o two.exr --layer depth --layer color "${small[@]}" --quiet
for layer in color coverage mask depth normal; do
    expect 0 '' "$MANGATA" diff all.exr $layer.pfm --layer $layer --max-rmse 0
done
expect 0 '' "$MANGATA" diff all.exr two.exr --layer depth --max-rmse 0
expect 64 'normal' "$MANGATA" diff all.exr two.exr --layer normal

# A mask as a grey picture is the mask within half a step of 8 bits, water below and sky above.
"$MANGATA" diff coverage.png coverage.png >/dev/null || fail "a grey picture cannot be read"

# What --skip-existing cannot keep: --overwrite is named only where it helps.
mkdir dir.png
mkfifo pipe.png
expect 73 'dir.png: is a directory$' render "$simple" -o dir.png --skip-existing "${small[@]}"
expect 73 'pipe.png: is not a regular file$' render "$simple" -o pipe.png --skip-existing "${small[@]}"
expect 73 'a.png: it exists, but was not rendered from this scene with these options; --overwrite' render "$simple" -o a.png --skip-existing --seed 9 --method ssaa2 "${small[@]}"
if ((EUID != 0)); then
    cp a.png secret.png
    chmod 0 secret.png
    expect 73 'secret.png: it exists, but cannot be read: Permission denied; --overwrite' render "$simple" -o secret.png --skip-existing "${small[@]}"
    works render "$simple" -o secret.png --skip-existing --overwrite "${small[@]}" --quiet
fi
rm -r dir.png pipe.png

# A picture and a film that another process finishes while they are rendered: the report says whose is kept.
if [[ -z ${SANITIZED:-} ]]; then
    for name in rival.png rival.y4m; do
        slow=(--size 320x180 --threads 1 --method reference --spatial 3)
        [[ $name == *.png ]] || slow+=(--frames 0-1)
        works render "$simple" -o "done_$name" "${slow[@]}" --quiet
        rm -f rival.txt
        render "$simple" -o $name "${slow[@]}" --skip-existing --progress json 2>rival.txt &
        for ((i = 0; i < 1200; i++)); do
            grep -qs '"progress"' rival.txt && break
            sleep 0.01
        done
        [[ $name == *.png ]] || cp "done_$name.json" $name.json
        cp "done_$name" .rival && mv .rival $name
        wait $! || fail "$name: exit code $?: $(cat rival.txt)"
        grep -Eq '"text": ?".*ms each; kept the (picture|film) that another process has finished meanwhile"' rival.txt || fail "$name: $(tail -n 1 rival.txt)"
    done
fi

# A missing folder is told before ten million frames are checked.
expect 73 'big/x_0.png: cannot write: folder big: No such file' timeout 20 "$MANGATA" render "$simple" -o 'big/x_%d.png' --frames 0-9999999

# ssaaN is ssaa with --spatial N, in whatever order.
works render "$simple" -o ssaa2.png --method ssaa2 --seed 3 "${small[@]}" --quiet
works render "$simple" -o ssaa_2.png --method ssaa --spatial 2 --seed 3 "${small[@]}" --quiet
works render "$simple" -o 2_ssaa.png --spatial 2 --method ssaa --seed 3 "${small[@]}" --quiet
same ssaa2.png ssaa_2.png
same ssaa2.png 2_ssaa.png
works render "$simple" -o ssaa4.png --method ssaa4 "${small[@]}" --quiet
works render "$simple" -o ssaa.png --method ssaa "${small[@]}" --quiet
same ssaa4.png ssaa.png

# Numbering; one frame through a numbered name; an explicit list.
works render "$simple" -o 'n_%04d.png' --frames 0-4:2,9 "${small[@]}" "${null[@]}" --quiet
exists n_0000.png n_0002.png n_0004.png n_0009.png
(($(ls n_*.png | wc -l) == 4)) || fail "wrong number of frames: $(ls n_*)"
works render "$simple" -o 'h_###.png' --frames 7 "${small[@]}" "${null[@]}" --quiet
exists h_007.png
works render "$simple" -o 'plain%d.png' --frames 12 "${small[@]}" "${null[@]}" --quiet
exists plain12.png
works render "$simple" -o '100%%.png' "${small[@]}" "${null[@]}" --quiet
exists '100%.png'
# Frames behind the film's end are told once; a scene of one frame and one from the wind state no end.
expect 0 '^mangata: warning: .*simple.json: the film ends with frame 59 \(time.frames is 60\), and --frames goes on to 61' \
    render "$simple" -o 'late_%d.png' --frames 58-61 "${small[@]}" "${null[@]}"
(($(grep -c warning stderr.txt) == 1)) || fail "the end is told $(grep -c warning stderr.txt) times"
cp "$simple" film.json
for words in "film.json --frames 58-59" "film.json --frames 61 --quiet" "film.json --frames 7 --set time.frames=1" "--sea wind=5 --frames 99"; do
    expect 0 '' render $words -o 'early_%d.png' "${small[@]}" "${null[@]}"
    ! grep warning stderr.txt || fail "$words warns"
done
mkdir 'dir%s#'
works render "$simple" -o 'dir%s#/x.png' "${small[@]}" "${null[@]}" --quiet
exists 'dir%s#/x.png'
works render "$simple" -o 'every_##.png' --set time.frames=3 "${small[@]}" "${null[@]}" --quiet
(($(ls every_*.png | wc -l) == 3)) || fail "a numbered name takes all frames of the scene: $(ls every_*)"
works render "$simple" -o one.png --set time.frames=3 "${small[@]}" "${null[@]}" --quiet
no_temporaries .

# Sizes and crops.
works render "$simple" -o tall.pfm --size 10x20 "${null[@]}" --quiet
head -n 2 tall.pfm | tail -n 1 | grep -q '^10 20$' || fail "--size is not the size"
works render "$simple" -o crop.pfm --size 100x50 --crop 10,20,30,15 "${null[@]}" --quiet
head -n 2 crop.pfm | tail -n 1 | grep -q '^30 15$' || fail "--crop is not the size"
finish
