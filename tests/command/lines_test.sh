# SPDX-License-Identifier: MIT
# Every command line of docs/command.md of version 0.1 ends as it did then; lines.txt holds them.
. "$CHECK"

declare -A quick=(
    [render]='--size 32x18' [bench]='--size 32x18 --frames 1 --repeat 1' [figures]='--scenes nowhere'
    [compare]='--size 16x9 --frames 0-1 --spatial 1 --time-samples 1 --time-runs 0 --metrics rmse,flip,flicker'
)
mangata() { "$MANGATA" "$@"; }
unset DISPLAY WAYLAND_DISPLAY
ln -s "$SOURCE/scenes" scenes
cp "$SOURCE/tests/data/scenes/buoy.txt" buoy.txt
mkdir a b frames
echo quit >moves.txt
clip() { # NAME METHOD: pictures of all kinds
    local few=(--method "$2" --size 32x18 --quiet)
    mangata render "$simple" -o "$1.png" "${few[@]}"
    mangata render "$simple" -o "$1.exr" "${few[@]}" --layer all
    mangata render "$simple" -o "$1/%04d.pfm" "${few[@]}" --layer coverage --frames 0-8,16-56:8
}
clip a podee-pixel
clip b mangata
mangata render "$simple" -o c.exr --size 32x18 --quiet
mangata render "$simple" --layer mask --size 32x18 -q -o m.pfm

count=0
while read -r code output line; do
    [[ $code =~ ^[0-9]+$ ]] || continue
    count=$((count + 1))
    [[ -z ${SANITIZED:-} || $((count % 3)) == 0 || $line == *" -o more "* ]] || continue
    read -r _ verb _ <<<"$line"
    more=${quick[$verb]:-}
    [[ $line != *--crop\ 480* ]] || more='--backend null' # a crop of the picture at its full size
    [[ $line != *--help ]] || more=
    [[ $output == stdout || $output == - ]] || rm -f "$output" "$output.json"
    line=${line//SCENE/scenes\/simple.json}
    eval "${line//POOL/scenes/hull.yaml} $more" >stdout 2>stderr </dev/null
    result=$?
    [[ $line != *.mp4 || $result != 69 ]] || continue # without ffmpeg
    ((result == code)) || fail "exit code $result instead of $code: $line: $(head -c 400 stderr)"
    [[ $output == - || -s $output ]] || fail "no $output: $line"
done <"$SOURCE/tests/command/lines.txt"
finish
