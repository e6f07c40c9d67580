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
"$MANGATA" diff n.pfm n.pfm --max-rmse 9 >/dev/null 2>&1
[[ $? == 2 ]] || fail "NaN passes a gate"
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
finish
