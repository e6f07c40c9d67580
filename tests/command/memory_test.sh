# SPDX-License-Identifier: MIT
# A small limit of the stack changes nothing. Peak memory of the largest usual frame: 3840 x 2160 in at most 400 MB.
. "$CHECK"
if [[ -z ${SANITIZED:-} ]]; then
    works render "$simple" -o whole.exr "${small[@]}" --quiet
    for stack in 256 512; do
        for threads in 1 2; do
            (ulimit -s $stack && render "$simple" -o stack.exr "${small[@]}" --threads $threads --quiet --overwrite) 2>stderr.txt || fail "stack of $stack kB: $(cat stderr.txt)"
            same whole.exr stack.exr
        done
    done
    (ulimit -s 256 && render "$simple" -o stack.exr "${small[@]}" --method reference --spatial 1 --time-samples 1 --quiet --overwrite) || fail "reference with a stack of 256 kB"
fi
for out in big.png big.exr; do
    peak=$("$PEAK_MEMORY" "$MANGATA" render "$simple" -o $out --size 3840x2160 --quiet) || fail "$out"
    echo "peak memory of $out: $peak kB"
    ((peak <= 400000)) || [[ -n ${SANITIZED:-} ]] || fail "$out needs $peak kB, at most 400000 are allowed"
done
finish
