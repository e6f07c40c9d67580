# SPDX-License-Identifier: MIT
# A frame that is killed goes on from its checkpoint, and ends with the bytes of one that was not.
. "$CHECK"

sunset=$SOURCE/scenes/sunset.json
long=(--method reference --spatial 8 --time-samples 6 --size 96x54)
works render "$sunset" "${long[@]}" -o whole.exr --layer all --quiet

# killed TIMES SAMPLES SCENE OPTION…: frame.exr, killed so often, each time after another checkpoint; it has SAMPLES in all.
killed() {
    local times=$1 samples=$2 kill wait process before now kept=0
    shift 2
    for ((kill = 0; kill < times; kill++)); do
        before=$(stat -c %i frame.exr.checkpoint 2>/dev/null)
        "$MANGATA" render "$@" -o frame.exr --layer all --checkpoint 0.1 2>stderr.txt &
        process=$!
        for ((wait = 0; wait < 1000; wait++)); do
            [[ $(stat -c %i frame.exr.checkpoint 2>/dev/null) == "$before" ]] || break
            kill -0 $process 2>/dev/null || break
            sleep 0.01
        done
        kill -9 $process 2>/dev/null
        wait $process 2>/dev/null
        absent frame.exr
        exists frame.exr.checkpoint
        ((kill == 0)) || grep -Eq "^frame.exr.checkpoint: goes on after [0-9]+ of $samples samples\$" stderr.txt || fail "kill $kill: $(cat stderr.txt)"
        now=$(sed -n 's/.*goes on after \([0-9]*\) .*/\1/p' stderr.txt)
        ((kill == 0 || now > kept)) || fail "kill $kill: $now samples, not more than $kept"
        kept=${now:-0}
    done
}
killed 5 384 "$sunset" "${long[@]}"
rm -f .mangata-*
cp frame.exr.checkpoint kept
expect 0 'goes on after' render "$sunset" "${long[@]}" -o frame.exr --layer all --checkpoint 0.1 --progress text
grep -E '^Progress: [0-9]+%$' stderr.txt | tee progress | sort -n -k2 -c || fail "progress runs backwards: $(cat progress)"
[[ $(tail -n 1 progress) == 'Progress: 100%' ]] || fail "progress ends with $(tail -n 1 progress)"
same whole.exr frame.exr
absent frame.exr.checkpoint

# A checkpoint is a file of sums of the samples so far. One that is damaged is not used; one of something else is not replaced unasked.
restore() { cp kept frame.exr.checkpoint; }
restore
printf x | dd of=frame.exr.checkpoint bs=1 seek=5000 conv=notrunc status=none
expect 0 'damaged; the frame begins anew' render "$sunset" "${long[@]}" -o frame.exr --layer all --checkpoint 60 --overwrite
same whole.exr frame.exr
rm frame.exr
quick=(--method reference --spatial 1 --time-samples 1 --size 16x9)
restore
expect 73 'frame.exr.checkpoint: it is no checkpoint of this scene with these options; --overwrite begins anew' render "$sunset" "${quick[@]}" -o frame.exr --checkpoint 9
same kept frame.exr.checkpoint
works render "$sunset" "${quick[@]}" -o frame.exr --checkpoint 9 --overwrite --quiet
absent frame.exr.checkpoint
works render "$sunset" "${quick[@]}" -o plain.exr --quiet
same frame.exr plain.exr

# One that was cut short, even to nothing, is damaged as well. What was never a checkpoint stays.
for bytes in 0 7 40; do
    head -c $bytes kept >frame.exr.checkpoint
    expect 0 'frame.exr.checkpoint: damaged; the frame begins anew' render "$sunset" "${quick[@]}" -o frame.exr --checkpoint 9 --overwrite
    rm frame.exr
    head -c $bytes kept >frame.exr.checkpoint
    expect 0 'frame.exr.checkpoint: damaged; the frame begins anew' render "$sunset" "${quick[@]}" -o frame.exr --checkpoint 9
    same frame.exr plain.exr
    absent frame.exr.checkpoint
    rm frame.exr
done
echo 'a text' >frame.exr.checkpoint
expect 73 'it is no checkpoint of this scene' render "$sunset" "${quick[@]}" -o frame.exr --checkpoint 9
expect 73 'it is no checkpoint of this scene' render "$sunset" "${quick[@]}" -o frame.exr --checkpoint 9 --dry-run
exists frame.exr.checkpoint
rm frame.exr.checkpoint

# It is refused before any frame is rendered.
cp kept f_2.exr.checkpoint
expect 73 'f_2.exr.checkpoint: it is no checkpoint' render "$sunset" "${quick[@]}" -o 'f_%d.exr' --frames 0-2 --checkpoint 9
absent f_0.exr f_1.exr
rm f_2.exr.checkpoint

# A picture that is completed without checkpoints needs none any more; that of another picture stays.
restore
works render "$sunset" "${long[@]}" -o frame.exr --layer all --quiet
absent frame.exr.checkpoint
restore
works render "$sunset" "${long[@]}" -o frame.exr --layer all --quiet --skip-existing
absent frame.exr.checkpoint
restore
works render "$sunset" "${quick[@]}" -o frame.exr --quiet --overwrite
same kept frame.exr.checkpoint
works render "$sunset" --method none --size 16x9 -o frame.exr --quiet --overwrite
same kept frame.exr.checkpoint
rm frame.exr.checkpoint

# The other methods with exact sums: samples of each pixel, slots of the whole picture.
killed_twice() {
    local samples=$1
    shift
    rm -f frame.exr
    works render "$@" -o other.exr --layer all --quiet --overwrite
    killed 2 "$samples" "$@" --threads 1 # so that there is time for two kills
    expect 0 'goes on after' render "$@" -o frame.exr --layer all --checkpoint 0.1
    same other.exr frame.exr
    absent frame.exr.checkpoint
    rm -f .mangata-*
}
killed_twice 576 "$SOURCE/scenes/smooth.json" --method ssaa24 --size 48x27
killed_twice 600000 "$SOURCE/scenes/smooth.json" --method adaptive --adaptive podee --slots 600000 --size 48x27

# A part can have checkpoints of its own.
works render "$sunset" "${quick[@]}" --time-samples 4 --samples-range 1,2 -o a.sums --checkpoint 0.1 --quiet
works render "$sunset" "${quick[@]}" --time-samples 4 --samples-range 1,2 -o b.sums --quiet
same a.sums b.sums

# A signal stops it within a slice and says how to go on.
timeout -s TERM --preserve-status 1 "$MANGATA" render "$sunset" -o k.png --method reference --spatial 16 --size 1920x1080 --checkpoint 0.1 2>stderr.txt
[[ $? == 143 ]] || fail "after SIGTERM: $?"
grep -q 'the same command goes on from the last checkpoint' stderr.txt || fail "after a signal: $(cat stderr.txt)"
absent k.png

for value in 0 -1 0.01 1e9 nan x ''; do
    expect 64 "--checkpoint $value: allowed is a number of seconds from 0.1 to 86400" render "$sunset" -o bad.png --method reference --checkpoint "$value"
done
expect 64 'method msaa32 has no exact sums' render "$sunset" -o bad.png --method msaa32 --checkpoint 5
expect 64 'the glare of displayed colour needs the sums of the whole picture' render "$sunset" -o bad.png --method reference --checkpoint 5 --crop 0,0,9,9 --set post.glare=0.1
expect 64 '--checkpoint is for pictures' render "$sunset" -o bad.y4m --method reference --checkpoint 5
absent bad.*
# A checkpoint that cannot be written, for its name is too long, is told once.
long=$(printf 'x%.0s' {1..245}).png
expect 0 'the frame goes on without a checkpoint' render "$simple" -o "$long" --size 160x90 --method reference --spatial 6 --checkpoint 0.1
(($(grep -c 'goes on without' stderr.txt) == 1)) || fail "a checkpoint that cannot be written: $(cut -c 1-60 stderr.txt)"
finish
