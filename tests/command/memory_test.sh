# SPDX-License-Identifier: MIT
# Peak memory of the largest usual frame: 3840 x 2160 in at most 400 MB.
. "$CHECK"
for out in big.png big.exr; do
    peak=$("$PEAK_MEMORY" "$MANGATA" render "$simple" -o $out --size 3840x2160 --quiet) || fail "$out"
    echo "peak memory of $out: $peak kB"
    ((peak <= 400000)) || [[ -n ${SANITIZED:-} ]] || fail "$out needs $peak kB, at most 400000 are allowed"
done
finish
