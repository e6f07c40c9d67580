# SPDX-License-Identifier: MIT
# `mangata diff` with a second reference: texture, specks, errors freed of noise.
. "$CHECK"

# grey FILE ROWS V V V V [ROWS V V V V]…: so many rows of four values, from the bottom
grey() {
    local file=$1 height=0 rows
    shift
    : >rows.bin
    while (($#)); do
        for ((rows = $1; rows > 0; rows--, height++)); do
            for value in "${@:2:4}"; do
                case $value in
                0) printf '\0\0\0\0' ;;
                .5) printf '\0\0\0\077' ;;
                1) printf '\0\0\200\077' ;;
                2) printf '\0\0\0\100' ;;
                inf) printf '\0\0\200\177' ;;
                max) printf '\377\377\177\177' ;;
                nan) printf '\0\0\300\177' ;;
                esac >>rows.bin
            done
        done
        shift 5
    done
    { printf 'Pf\n4 %d\n-1.0\n' "$height" && cat rows.bin; } >"$file"
}
number() { "$JSON_GET" "$1" <stdout.txt; }
diff() { "$MANGATA" diff "$@"; }

# The RMSE freed of noise, and the noise floor; the usual lines stay.
grey p.pfm 1 1 1 1 1
grey a.pfm 1 0 2 1 1
grey b.pfm 1 1 1 0 2
expect 0 '' diff p.pfm a.pfm
cp stdout.txt plain.txt
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm
head -n "$(wc -l <plain.txt)" stdout.txt | cmp -s - plain.txt || fail "--second-reference changes the first lines: $(cat stdout.txt)"
grep -Eq '^noiseless rmse 0$' stdout.txt && grep -Eq '^noise floor +0.5$' stdout.txt || fail "noise: $(cat stdout.txt)"
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --json
[[ $(number rmse) == 0.707106781* && $(number noiseless_rmse) == 0.0 && $(number noise_floor) == 0.5 && $(number second_reference) == b.pfm ]] ||
    fail "noise: $(cat stdout.txt)"
expect 0 '' diff p.pfm a.pfm --json
! number noise_floor >/dev/null 2>&1 || fail "a noise floor without a second reference"

# The floor of every metric: what B scores against the mean of B and B2, which lies half as far away as B2 does.
grey p.pfm 12 1 1 1 1
grey a.pfm 12 .5 1 .5 1
grey b.pfm 12 .5 0 .5 0
grey mean.pfm 12 .5 .5 .5 .5
expect 0 '' diff a.pfm mean.pfm --metrics flip,ssim,rmse --json
flip=$(number metrics.flip) ssim=$(number metrics.ssim)
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --metrics flip,ssim,rmse --json
[[ $(number noise_floors.flip) == "$flip" && $(number noise_floors.rmse) == "$(number noise_floor)" && $(number noise_floors.rmse) == 0.353553390* ]] ||
    fail "floors: $(cat stdout.txt)"
awk -v a="$ssim" -v b="$(number noise_floors.ssim)" 'BEGIN { exit !((a + b - 1) ^ 2 < 1e-12) }' || fail "floor of SSIM: $ssim, $(cat stdout.txt)"
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --metrics flip
grep -Eq '^flip           [0-9.]+; noise floor [0-9.]+$' stdout.txt || fail "floors: $(cat stdout.txt)"
expect 0 '' diff p.pfm a.pfm --metrics flip --json
! number noise_floors >/dev/null 2>&1 || fail "noise floors without a second reference"

# Seven rows at the bottom are the second band; a third of four is left out.
grey p.pfm 7 2 1 2 1 10 1 2 1 2
grey a.pfm 17 0 2 0 2
grey b.pfm 17 0 2 0 2
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --metrics texture --json
[[ $(number metrics.texture.bands.0.row) == 0 && $(number metrics.texture.bands.1.row) == 10 && $(number metrics.texture.bands.1.rows) == 7 ]] ||
    fail "bands: $(cat stdout.txt)"
[[ $(number metrics.texture.bands.0.contrast) == 0.5 && $(number metrics.texture.bands.0.mean) == 1.5 ]] || fail "contrast: $(cat stdout.txt)"
[[ $(number metrics.texture.bands.0.correlation) == 1.0 && $(number metrics.texture.bands.1.correlation) == -1.0 ]] || fail "correlation: $(cat stdout.txt)"
[[ $(number metrics.texture.correlation_mean) == 0.0 && $(number metrics.texture.correlation_least) == -1.0 ]] || fail "summary: $(cat stdout.txt)"
[[ $(number metrics.texture.contrast_least) == 0.5 && $(number metrics.texture.contrast_greatest) == 0.5 ]] || fail "summary: $(cat stdout.txt)"
[[ $(number metrics.texture.mean_least) == 1.5 && $(number metrics.texture.mean_greatest) == 1.5 ]] || fail "summary: $(cat stdout.txt)"
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --metrics texture,ssim
grep -q '^texture        correlation 0, least -1; contrast 0.5 to 0.5; mean 1.5 to 1.5$' stdout.txt || fail "text: $(cat stdout.txt)"
grep -Eq '^ +10 +0.5 +-1 +1.5$' stdout.txt && grep -q '^ssim ' stdout.txt || fail "text: $(cat stdout.txt)"
grey flat.pfm 14 1 1 1 1
grey more.pfm 14 2 2 2 2
grey wavy.pfm 14 0 1 0 1
expect 0 '' diff wavy.pfm flat.pfm --second-reference more.pfm --metrics texture --json
[[ $(number metrics.texture.bands.0.contrast) == null && $(number metrics.texture.contrast_least) == null && $(number metrics.texture.mean_least) == 0.33333* ]] ||
    fail "no texture: $(cat stdout.txt)"
expect 0 '' diff wavy.pfm flat.pfm --second-reference more.pfm --metrics texture
grep -Eq '^ +0 +- +- +0.33333' stdout.txt && ! grep -q '^ *10 ' stdout.txt || fail "no texture: $(cat stdout.txt)"
grey low_a.pfm 4 0 1 0 1
grey low_b.pfm 4 0 1 0 1
grey low_c.pfm 4 0 1 0 1
expect 0 '' diff low_a.pfm low_b.pfm --second-reference low_c.pfm --metrics texture --json
[[ $(number metrics.texture) == null && $(number unavailable.texture) == *'five rows'* ]] || fail "four rows: $(cat stdout.txt)"
expect 0 '' diff low_a.pfm low_b.pfm --second-reference low_c.pfm --metrics texture
grep -q '^texture        unavailable: texture needs at least five rows' stdout.txt || fail "four rows: $(cat stdout.txt)"

# Encoded values are decoded before: .5 is .214 of light.
grey p.pfm 10 0 .5 0 .5
grey a.pfm 10 0 1 0 1
grey b.pfm 10 0 1 0 1
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --metrics texture --encoding srgb --json
[[ $(number metrics.texture.contrast_least) == 0.21404* ]] || fail "encoding: $(cat stdout.txt)"

# Specks, alone and beside those of the references; masks leave pixels out.
grey p.pfm 5 0 0 0 0 1 0 1 0 .5 5 0 0 0 0
grey a.pfm 11 0 0 0 0
grey b.pfm 10 0 0 0 0 1 1 0 0 0
expect 0 '' diff p.pfm a.pfm --metrics specks
grep -Eq '^specks +2 of 44 pixels, 0.0454545$' stdout.txt || fail "specks: $(cat stdout.txt)"
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --metrics specks --json
[[ $(number metrics.specks.count) == 2 && $(number metrics.specks.pixels) == 44 && $(number metrics.specks.share) == 0.0454545* ]] || fail "specks: $(cat stdout.txt)"
[[ $(number metrics.specks.reference_count) == 0.5 && $(number metrics.specks.excess) == 1.5 && $(number metrics.specks.excess_share) == 0.0340909* ]] ||
    fail "specks of references: $(cat stdout.txt)"
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --metrics specks
grep -q '; references of each other 0.5, 0.0113636; excess 1.5, 0.0340909$' stdout.txt || fail "specks: $(cat stdout.txt)"
grey m.pfm 11 1 1 0 0
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --metrics specks,texture --mask m.pfm --json
[[ $(number metrics.specks.count) == 1 && $(number metrics.specks.pixels) == 22 ]] || fail "specks in a mask: $(cat stdout.txt)"
expect 0 '' diff p.pfm a.pfm --metrics specks --display -8 --json
[[ $(number metrics.specks.count) == 0 ]] || fail "specks in the dark: $(cat stdout.txt)"

# Clips add up.
for frame in 0 1; do
    cp p.pfm p_$frame.pfm
    cp a.pfm a_$frame.pfm
    cp b.pfm b_$frame.pfm
done
expect 0 '' diff p_#.pfm a_#.pfm --second-reference b_#.pfm --frames 0-1 --metrics specks,texture,flicker --json
[[ $(number metrics.specks.count) == 4 && $(number metrics.specks.pixels) == 88 && $(number metrics.flicker) == 0.0 ]] || fail "clip: $(cat stdout.txt)"
expect 66 'b_2.pfm' diff p_#.pfm a_#.pfm --second-reference b_#.pfm --frames 0,1 --metrics specks --mask b_2.pfm
cp p.pfm p_2.pfm
cp a.pfm a_2.pfm
expect 66 'b_2.pfm' diff p_#.pfm a_#.pfm --second-reference b_#.pfm --frames 0-2
cp low_a.pfm p_2.pfm
cp low_b.pfm a_2.pfm
cp low_c.pfm b_2.pfm
expect 1 'p_2.pfm has 4 x 4 pixels of 1 channel, the first frame 4 x 11 of 1; the frames of a clip must agree' diff p_#.pfm a_#.pfm --second-reference b_#.pfm --frames 0-2 --metrics specks

# Sizes, channels, values without meaning.
expect 1 'low_a.pfm has 4 x 4 of 1; they must agree' diff p.pfm a.pfm --second-reference low_a.pfm
works render "$simple" -o color.pfm "${small[@]}" "${null[@]}" --quiet
cp color.pfm color_b.pfm
expect 1 'they must agree' diff color.pfm color_b.pfm --second-reference low_a.pfm --metrics texture
grey p.pfm 10 nan inf 0 max
grey a.pfm 10 inf nan max 0
grey b.pfm 10 max max inf nan
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --metrics texture,specks --json
[[ $(number metrics.specks) == null && $(number metrics.texture) == null && $(number unavailable.specks) == 'not a number, or infinite in one picture only' ]] ||
    fail "values without meaning: $(cat stdout.txt)"
expect 0 '' diff p.pfm a.pfm --second-reference b.pfm --metrics texture,specks --display 100
[[ $(grep -c 'unavailable: not a number' stdout.txt) == 2 ]] || fail "values without meaning: $(cat stdout.txt)"
finish
