# SPDX-License-Identifier: MIT
# Films: whole files, sidecars, any layer, and memory that does not grow with the frames.
. "$CHECK"

works render "$simple" -o a.y4m --frames 0-4 "${small[@]}" --quiet
exists a.y4m a.y4m.json
head -n 1 a.y4m | grep -q '^YUV4MPEG2 W64 H36 F30:1' || fail "y4m header: $(head -n 1 a.y4m)"
(($(grep -ao FRAME a.y4m | wc -l) == 5)) || fail "y4m frames: $(grep -ao FRAME a.y4m | wc -l)"
[[ $("$JSON_GET" frames <a.y4m.json) == 0-4 ]] || fail "the sidecar does not name the frames"
works render "$simple" -o mask.y4m --frames 0-1 --layer mask "${small[@]}" --quiet
expect 73 'a.y4m: .*exist' render "$simple" -o a.y4m --frames 0-4 "${small[@]}"

if command -v ffmpeg >/dev/null; then
    works render "$simple" -o a.mp4 --frames 0-4 "${small[@]}" --quiet
    exists a.mp4 a.mp4.json
    ffmpeg -v error -i a.mp4 -f null - 2>&1 | grep . && fail "ffmpeg cannot read a.mp4"
    [[ $(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 a.mp4 | tr -d ,) == 5 ]] || fail "a.mp4 has not 5 frames"
fi
if command -v ffprobe >/dev/null; then
    expect 0 'warning: odd.mp4: encoders take even sides, so the film has 66 x 38 pixels' render "$simple" -o odd.mp4 --frames 0 --size 65x37
    [[ $(ffprobe -v error -show_entries stream=width,height -of csv=p=0 odd.mp4) == 66,38* ]] || fail "odd.mp4 has another size"
    expect 73 'ffmpeg (was ended by signal [0-9]+: File size limit exceeded|failed)' \
        bash -c 'ulimit -f 4; exec "$0" render "$1" -o long.mp4 --frames 0-4 --size 640x360 --crf 0' "$MANGATA" "$simple"
    absent long.mp4
fi
mkdir empty
expect 69 'ffmpeg' env PATH="$work/empty" "$MANGATA" render "$simple" -o b.mp4 --frames 0-1 "${small[@]}"
absent b.mp4 b.mp4.json
no_temporaries .

# Peak memory does not grow with the frames: within 2% and the few pages by which a process this small differs from run to run.
# (Sanitizers keep freed memory on purpose.)
few=$("$PEAK_MEMORY" "$MANGATA" render "$simple" -o few.y4m --frames 0-9 --size 320x180 "${null[@]}" --quiet) || fail "ten frames"
many=$("$PEAK_MEMORY" "$MANGATA" render "$simple" -o many.y4m --frames 0-599 --size 320x180 "${null[@]}" --quiet) || fail "six hundred frames"
echo "peak memory: $few kB for 10 frames, $many kB for 600"
((many <= few + few / 50 + 256)) || [[ -n ${SANITIZED:-} ]] || fail "memory grows with the film"
finish
