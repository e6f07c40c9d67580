# SPDX-License-Identifier: MIT
# `mangata diff` against pictures whose errors are known.
. "$CHECK"

# pfm FILE V00 V10 V01 V11: 2 x 2 grey values, bottom row first
pfm() {
    local file=$1 value
    shift
    printf 'Pf\n2 2\n-1.0\n' >"$file"
    for value; do
        case $value in
        0) printf '\0\0\0\0' ;;
        0.9) printf '\146\146\146\077' ;;
        1) printf '\0\0\200\077' ;;
        2) printf '\0\0\0\100' ;;
        4) printf '\0\0\200\100' ;;
        inf) printf '\0\0\200\177' ;;
        nan) printf '\0\0\300\177' ;;
        esac >>"$file"
    done
}
number() { "$JSON_GET" "$1" <stdout.txt; }
pfm a.pfm 1 2 1 4
pfm b.pfm 1 2 1 2
expect 0 '' "$MANGATA" diff a.pfm b.pfm --json
[[ $(number rmse) == 1.0 ]] || fail "rmse $(number rmse)"
[[ $(number mean_ratio) == 1.333333333* ]] || fail "mean ratio $(number mean_ratio)"
[[ $(number relative_rmse) == 0.632455532* ]] || fail "relative rmse $(number relative_rmse)"
[[ $(number maximum.difference) == 2.0 && $(number maximum.x) == 1 && $(number maximum.y) == 0 ]] || fail "maximum: $(cat stdout.txt)"
expect 0 '' "$MANGATA" diff a.pfm b.pfm
grep -Eq '^rmse +1$' stdout.txt || fail "text: $(cat stdout.txt)"

"$MANGATA" diff a.pfm b.pfm --max-rmse 0.999 >stdout.txt 2>stderr.txt
[[ $? == 2 ]] && grep -q 'RMSE 1 is above 0.999' stderr.txt && grep -q '^rmse' stdout.txt || fail "--max-rmse"
expect 0 '' "$MANGATA" diff a.pfm b.pfm --max-rmse 1
pfm i.pfm 1 inf 1 2
pfm n.pfm 1 nan 1 2
expect 0 '' "$MANGATA" diff i.pfm i.pfm --max-rmse 0
expect 0 '' "$MANGATA" diff i.pfm b.pfm
grep -Eq '^mismatches +1 values' stdout.txt || fail "mismatches: $(cat stdout.txt)"
"$MANGATA" diff n.pfm n.pfm --max-rmse 9 >/dev/null 2>&1
[[ $? == 2 ]] || fail "NaN passes a gate"
pfm zero.pfm 1 0 1 2
"$MANGATA" diff n.pfm zero.pfm --display 0 --max-rmse 9 >/dev/null 2>&1
[[ $? == 2 ]] || fail "NaN passes a gate as displayed"
"$MANGATA" diff i.pfm b.pfm --max-rmse 9 >/dev/null 2>&1
[[ $? == 2 ]] || fail "an infinity against a number passes a gate"

works render "$simple" -o large.pfm --layer mask "${small[@]}" "${null[@]}" --quiet
expect 1 'large.pfm has 64 x 36 pixels of 1 channel, a.pfm has 2 x 2 of 1; they must agree' "$MANGATA" diff large.pfm a.pfm

# A clip is scored as one; flicker is the error of the differences.
pfm p_0.pfm 0 0 0 0
pfm p_1.pfm 1 1 1 1
pfm p_2.pfm 2 2 2 2
pfm q_0.pfm 1 1 1 1
pfm q_1.pfm 2 2 2 2
pfm q_2.pfm 4 4 4 4
expect 0 '' "$MANGATA" diff p_#.pfm q_%d.pfm --frames 0-2 --json
[[ $(number frames) == 3 && $(number rmse) == 1.41421356* ]] || fail "clip: $(cat stdout.txt)"
expect 0 '' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --flicker --json
[[ $(number frames) == 2 && $(number rmse) == 0.707106781* && $(number maximum.frame) == 2 ]] || fail "flicker: $(cat stdout.txt)"
expect 66 '_3.pfm' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2,3
expect 0 '' "$MANGATA" diff p_#.pfm p_#.pfm --frames 0-2 --flicker --max-rmse 0

# A mask leaves pixels out; displayed values are clamped and encoded.
pfm m.pfm 0 1 1 0
expect 0 '' "$MANGATA" diff a.pfm b.pfm --mask m.pfm --json
[[ $(number rmse) == 0.0 && $(number values) == 2 ]] || fail "mask: $(cat stdout.txt)"
pfm m.pfm 0 0 0 1
expect 0 '' "$MANGATA" diff a.pfm b.pfm --mask m.pfm --json
[[ $(number rmse) == 2.0 && $(number values) == 1 ]] || fail "mask of one: $(cat stdout.txt)"
expect 0 '' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --mask m.pfm --json
[[ $(number values) == 3 && $(number rmse) == 1.41421356* ]] || fail "mask of a clip: $(cat stdout.txt)"
expect 0 '' "$MANGATA" diff a.pfm b.pfm --display 0 --max-rmse 0
expect 0 '' "$MANGATA" diff a.pfm b.pfm --display -2 --json
[[ $(number rmse) == 0.13232* ]] || fail "displayed: $(cat stdout.txt)" # 1 and 0.73536, once in four
expect 1 'large.pfm has 64 x 36 pixels of 1 channel; a mask of 2 x 2 of 1 is needed' "$MANGATA" diff a.pfm b.pfm --mask large.pfm
expect 66 'none.pfm' "$MANGATA" diff a.pfm b.pfm --mask none.pfm
pfm half.pfm 0 0.9 0 0
expect 65 '^mangata: half.pfm: this mask selects no pixel' "$MANGATA" diff a.pfm b.pfm --mask half.pfm --metrics ssim,specks --max-rmse 0 --error-map ssim=masked.png
expect 65 'half.pfm: this mask' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --mask half.pfm
absent masked.png
cp half.pfm m_0.pfm
cp m.pfm m_1.pfm
cp half.pfm m_2.pfm
expect 0 '' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --mask m_#.pfm --json
[[ $(number values) == 1 && $(number rmse) == 1.0 ]] || fail "a mask of one frame: $(cat stdout.txt)"
# All figures of RMSE are of the pixels that the mask selects.
pfm m.pfm 0 0 0 1
pfm twice.pfm 1 2 1 4
expect 0 '' "$MANGATA" diff a.pfm b.pfm --mask m.pfm --metrics rmse,relrmse,energy --second-reference zero.pfm --error-map rmse=masked.pfm --json
[[ $(number metrics.rmse) == "$(number rmse)" && $(number metrics.relative_rmse) == "$(number relative_rmse)" && $(number metrics.energy) == "$(number mean_ratio)" &&
    $(number per_frame.0.rmse) == 2.0 && $(number noise_floors.rmse) == "$(number noise_floor)" ]] || fail "metrics in a mask: $(cat stdout.txt)"
grep -q '"score": "2"' masked.pfm.json || fail "record of a masked map: $(cat masked.pfm.json)"
expect 0 '' "$MANGATA" diff twice.pfm b.pfm --mask m.pfm --metrics rmse --second-reference a.pfm --json
[[ $(number noise_floors.rmse) == 1.0 && $(number noise_floor) == 1.0 ]] || fail "floors in a mask: $(cat stdout.txt)"
expect 0 '' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --mask m.pfm --metrics rmse --json
[[ $(number metrics.rmse) == 1.41421356* && $(number per_frame.2.rmse) == 2.0 ]] || fail "metrics of a clip in a mask: $(cat stdout.txt)"

# Every floor is printed behind its score.
expect 0 '' "$MANGATA" diff p_2.pfm a.pfm --second-reference b.pfm --metrics relrmse,energy
[[ $(grep -Ec '^(relative rmse|mean ratio) .*; noise floor 0\.[0-9]+$' stdout.txt) == 2 ]] || fail "floors: $(cat stdout.txt)"

# Infinities that both clips have do not tell them apart, and those of one do.
for frame in 0 1 2; do cp i.pfm far_$frame.pfm; done
expect 0 '' "$MANGATA" diff far_#.pfm far_#.pfm --frames 0-2 --flicker --max-rmse 0
cp a.pfm far_1.pfm
expect 0 '' "$MANGATA" diff far_#.pfm far_#.pfm --frames 0-2 --flicker --max-rmse 0
cp a.pfm near_0.pfm
cp far_1.pfm near_1.pfm
cp far_2.pfm near_2.pfm
expect 0 '' "$MANGATA" diff far_#.pfm near_#.pfm --frames 0-2 --flicker --json
[[ $(number mismatches) == 1 ]] || fail "an infinity in one clip: $(cat stdout.txt)"

# Values that are not comparable have no score, and maps say where.
"$MANGATA" diff n.pfm n.pfm --max-rmse 9 >/dev/null 2>stderr.txt
grep -q '1 values are not a number, or infinite in one picture only, so no limit is kept$' stderr.txt || fail "NaN in both: $(cat stderr.txt)"
expect 0 '' "$MANGATA" diff n.pfm b.pfm --metrics rmse,flip,ssim,specks --error-map flip=lost.pfm --json
[[ $(number metrics.flip) == null && $(number metrics.ssim) == null && $(number metrics.specks) == null && $(number metrics.rmse) == 0.0 && $(number per_frame.0.flip) == null &&
    $(number unavailable.flip) == 'not a number, or infinite in one picture only' ]] || fail "scores of NaN: $(cat stdout.txt)"
expect 0 '' "$MANGATA" diff lost.pfm b.pfm --json
[[ $(number mismatches) == 1 ]] || fail "a map of NaN: $(od -f lost.pfm)"
expect 0 '' "$MANGATA" diff i.pfm i.pfm --metrics flip,ssim --json
[[ $(number metrics.flip) == 0.0 && $(number metrics.ssim) == 1.0 ]] || fail "equal infinities: $(cat stdout.txt)"

expect 64 '--display x: allowed is a number of stops' "$MANGATA" diff a.pfm b.pfm --display x
expect 64 'leave --encoding out' "$MANGATA" diff a.pfm b.pfm --display 0 --encoding linear

# Further metrics add lines and keys and change none.
"$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 >plain.txt
expect 0 '' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --metrics rmse,relrmse,energy
same plain.txt stdout.txt
expect 0 '' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --metrics flip,hdr-flip,ssim,flicker
head -n "$(wc -l <plain.txt)" stdout.txt | cmp -s - plain.txt || fail "--metrics changes the first lines: $(cat stdout.txt)"
for word in flip hdr-flip ssim flicker flicker-power flicker-ratio flicker-bright flicker-glints flicker-sizes; do
    grep -Eq "^$word +[0-9.]+$" stdout.txt || fail "$word: $(cat stdout.txt)"
done
expect 0 '' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --metrics rmse,energy,flicker --json
[[ $(number metrics.rmse) == "$(number rmse)" && $(number metrics.energy) == "$(number mean_ratio)" ]] || fail "metrics: $(cat stdout.txt)"
[[ $(number metrics.flicker) == 0.707106781* && $(number metrics.flicker_power) == 1.5 && $(number metrics.flicker_ratio) == 0.4* ]] ||
    fail "flicker of clips: $(cat stdout.txt)"
[[ $(number per_frame.0.flicker) == null && $(number per_frame.1.flicker) == 0.0 && $(number per_frame.2.flicker) == 1.0 ]] ||
    fail "flicker of frames: $(cat stdout.txt)"
expect 0 '' "$MANGATA" diff a.pfm b.pfm --metrics flicker --json
[[ $(number metrics.flicker) == null && $(number unavailable.flicker) == *'two frames'* ]] || fail "one frame flickers: $(cat stdout.txt)"

works render "$simple" -o scene.png "${small[@]}" --quiet
works render "$simple" -o rough.png "${small[@]}" --method none --quiet
expect 0 '' "$MANGATA" diff scene.png scene.png --metrics flip,hdr-flip,ssim --json
[[ $(number metrics.flip) == 0.0 && $(number metrics.hdr_flip) == 0.0 && $(number metrics.ssim) == 1.0 ]] || fail "identity: $(cat stdout.txt)"
expect 0 '' "$MANGATA" diff rough.png scene.png --metrics flip --json
near=$(number metrics.flip)
expect 0 '' "$MANGATA" diff rough.png scene.png --metrics flip --pixels-per-degree 300 --json
far=$(number metrics.flip)
[[ $near == 0.0[1-9]* && $far == 0.0[1-9]* && $near != "$far" ]] || fail "FLIP $near near, $far from afar"

# Without idiff Yee's test is unavailable and nothing else is lost.
expect 0 '' env PATH=/nonexistent "$MANGATA" diff rough.png scene.png --metrics flip,yee --json
[[ $(number metrics.yee) == null && $(number metrics.flip) == "$near" && $(number unavailable.yee) == *openimageio-tools* ]] || fail "no idiff: $(cat stdout.txt)"
if command -v idiff >/dev/null; then
    expect 0 '' "$MANGATA" diff scene.png scene.png --metrics yee --json
    [[ $(number metrics.yee) == 0.0 ]] || fail "Yee's test of equal pictures: $(cat stdout.txt)"
    TMPDIR=$work/nowhere expect 0 '' "$MANGATA" diff scene.png scene.png --metrics yee --json
    [[ $(number unavailable.yee) == *nowhere* ]] || fail "no folder for Yee's test: $(cat stdout.txt)"
fi
# A signal while idiff works: no result, and its pictures are taken away.
mkdir slow temporary && printf '#!/bin/sh\n>%s/began; sleep 0.3; echo; echo PASS\n' "$work/slow" >slow/idiff && chmod +x slow/idiff
TMPDIR=$work/temporary PATH=$work/slow:$PATH signalled TERM '[[ -e slow/began ]]' "$MANGATA" diff scene.png scene.png --metrics yee
result=$?
((result == 143)) && [[ $(cat signalled.txt) == 'mangata: stopped by a signal' && -z $(ls -A temporary) ]] || fail "yee and a signal: $result: $(cat signalled.txt; ls -A temporary)"

# Maps: the values themselves, and in colours from black to pale yellow; what exists stays.
expect 0 '' "$MANGATA" diff a.pfm b.pfm --error-map rmse=error.pfm --error-map relrmse=relative.exr --error-map ssim=s.png --json
[[ $(number error_maps.0.file) == error.pfm && $(number error_maps.1.metric) == relrmse && $(number metrics.ssim) != null ]] || fail "maps: $(cat stdout.txt)"
pfm expected.pfm 0 0 0 2
tail -c 16 error.pfm | cmp -s - <(tail -c 16 expected.pfm) || fail "error map: $(od -f error.pfm)"
grep -q '"score": "1"' error.pfm.json || fail "record of the map: $(cat error.pfm.json)"
expect 0 '' "$MANGATA" diff relative.exr expected.pfm --json # 2 over 2, but for the floor of a hundredth of √2.5
[[ $(number maximum.difference) == 1.00003* && $(number mean_a) == 0.24999* ]] || fail "relative map: $(cat stdout.txt)"
expect 73 'error.pfm: .*exists' "$MANGATA" diff a.pfm b.pfm --error-map rmse=error.pfm
expect 0 '' "$MANGATA" diff a.pfm b.pfm --error-map rmse=error.png --error-top 2 --error-map relrmse=error.pfm --overwrite
pfm black.pfm 0 0 0 0
expect 0 '' "$MANGATA" diff a.pfm a.pfm --error-map rmse=none.png
expect 0 '' "$MANGATA" diff error.png none.png --json # pale yellow once, elsewhere black
[[ $(number mean_b) == 0.0 && $(number maximum.difference) == 0.9[789]* && $(number mean_a) == 0.2[23]* ]] || fail "colours of the map: $(cat stdout.txt)"
expect 0 '' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --error-map flicker=step_#.pfm
cmp -s <(tail -c 16 step_0.pfm) <(tail -c 16 black.pfm) || fail "flicker of a first frame"
pfm ones.pfm 1 1 1 1
cmp -s <(tail -c 16 step_2.pfm) <(tail -c 16 ones.pfm) || fail "flicker map"
! grep -q score step_0.pfm.json || fail "a score of no step"
no_temporaries .
expect 64 'METRIC=FILE' "$MANGATA" diff a.pfm b.pfm --error-map energy=a.png
expect 64 'METRIC=FILE' "$MANGATA" diff a.pfm b.pfm --error-map flip=a.jpg
expect 64 'METRIC=FILE' "$MANGATA" diff a.pfm b.pfm --error-map flip.png
expect 64 'that picture is compared' "$MANGATA" diff a.pfm b.pfm --error-map rmse=a.pfm --overwrite
ln -s a.pfm also_a.pfm
expect 64 'also_a.pfm: that picture is compared' "$MANGATA" diff a.pfm b.pfm --error-map rmse=also_a.pfm --overwrite
expect 64 '--error-map flip=f.png: the metric has a map already, e.png' "$MANGATA" diff a.pfm b.pfm --error-map flip=e.png --error-map flip=f.png
expect 64 'two maps of one name' "$MANGATA" diff a.pfm b.pfm --error-map rmse=e.png --error-map flip=e.png
expect 64 'two maps of one name' "$MANGATA" diff a.pfm b.pfm --error-map rmse=e.png --error-map "flip=$PWD/./e.png"
expect 64 'two maps of one name' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --error-map rmse=e_#.png --error-map flip=e_%d.png --overwrite
# No map takes the place of a picture that is read, however it is spelt.
cp a.pfm kept.pfm
expect 64 'that picture is compared, as ./a.pfm' "$MANGATA" diff ./a.pfm b.pfm --error-map rmse=a.pfm --overwrite
expect 64 'that picture is compared, as m.pfm' "$MANGATA" diff a.pfm b.pfm --mask m.pfm --error-map rmse=./m.pfm --overwrite
expect 64 'that picture is compared, as q_0.pfm' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --error-map rmse=q_%d.pfm --overwrite
same a.pfm kept.pfm
expect 66 'no_0.pfm: .*No such file' timeout 10 "$MANGATA" diff no_#.pfm no_#.pfm --frames 0-99999999 --error-map rmse=e_#.png
expect 64 'number the files' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --error-map flip=e.png
expect 64 'leave the frame number out' "$MANGATA" diff a.pfm b.pfm --error-map flip=e_#.png
expect 64 'above 0' "$MANGATA" diff a.pfm b.pfm --error-map flip=e.png --error-top 0
expect 64 'no --error-map' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --flicker --error-map flip=e_#.png
expect 73 'nowhere' "$MANGATA" diff a.pfm b.pfm --error-map flip=nowhere/e.png
absent e.png 'e_*'

expect 64 'allowed are rmse, relrmse' "$MANGATA" diff a.pfm b.pfm --metrics rmse,flop
expect 64 'goes with no --metrics' "$MANGATA" diff p_#.pfm q_#.pfm --frames 0-2 --flicker --metrics flip
expect 64 'linear and srgb' "$MANGATA" diff a.pfm b.pfm --metrics flip --encoding gamma
expect 64 'from 4 to 400' "$MANGATA" diff a.pfm b.pfm --metrics flip --pixels-per-degree 3
expect 64 'above 0' "$MANGATA" diff a.pfm b.pfm --metrics flicker --glint-threshold 0
expect 64 'unlike encoding' "$MANGATA" diff a.pfm scene.png --metrics flip

# The frames of a clip have one size; metrics take grey and colours; options that nothing reads are told.
cp scene.png mixed_0.png
works render "$simple" -o mixed_1.png --size 32x18 --quiet
expect 1 'mixed_1.png has 32 x 18 pixels of 3 channels, the first frame 64 x 36 of 3; the frames of a clip must agree' "$MANGATA" diff mixed_#.png mixed_#.png --frames 0-1
"$MANGATA" diff mixed_#.png mixed_#.png --frames 0-1 --error-map flip=e_#.png >stdout.txt 2>stderr.txt
[[ $? == 1 ]] && grep -q mixed_1.png stderr.txt || fail "maps of mixed sizes: $(cat stderr.txt)"
rm e_0.png
expect 64 'frames needs numbered names, such as frame_%04d.pfm; a frame number is allowed in the file.s name alone' "$MANGATA" diff %04d/c.pfm %04d/c.pfm --frames 0-1
while read -r option reader; do
    # shellcheck disable=SC2086 # words
    expect 0 "warning: ${option%%=*} does nothing here; it is for .*$reader" "$MANGATA" diff a.pfm b.pfm ${option/=/ }
done <<'END'
--error-top=3 .png maps
--glint-threshold=1 flicker-glints
--pixels-per-degree=60 flip
--encoding=linear --metrics
--overwrite --error-map
END
expect 0 'warning: --error-top does nothing' "$MANGATA" diff a.pfm b.pfm --error-map flip=t.png --error-top 3
expect 0 'warning: --pixels-per-degree does nothing' "$MANGATA" diff a.pfm b.pfm --metrics ssim --pixels-per-degree 60
expect 0 '' "$MANGATA" diff a.pfm b.pfm --metrics flip --pixels-per-degree 60 --encoding linear
[[ ! -s stderr.txt ]] || fail "a warning of options that are read: $(cat stderr.txt)"

# Pictures of colour in unlike encodings are compared as they are stored, which is said.
works render "$simple" -o kind.png "${small[@]}" --quiet
works render "$simple" -o kind.exr "${small[@]}" --quiet
expect 0 'warning: kind.png and kind.exr are compared as they are stored, sRGB-encoded against linear' "$MANGATA" diff kind.png kind.exr
for pair in 'kind.png kind.png' 'kind.exr kind.exr'; do
    # shellcheck disable=SC2086 # two words
    "$MANGATA" diff $pair >stdout.txt 2>stderr.txt || fail "diff $pair"
    [[ ! -s stderr.txt ]] || fail "diff $pair: $(cat stderr.txt)"
done
expect 64 '--layer coverage: it is for .exr alone' "$MANGATA" diff kind.png kind.png --layer coverage

# A header of PFM has no comments and one kind of line end.
{ printf 'Pf\n# a comment\n2 2\n-1.0\n' && tail -c 16 a.pfm; } >comment.pfm
expect 65 'comment.pfm: .*width, height, scale, without comments' "$MANGATA" diff comment.pfm a.pfm
{ printf 'Pf\r\n2 2\r\n-1.0\r\n' && tail -c 16 a.pfm; } >windows.pfm
expect 65 'windows.pfm: .*its header ends with one blank or line end, and the pixels follow' "$MANGATA" diff windows.pfm a.pfm
finish
