# SPDX-License-Identifier: MIT
# `mangata figures`: what it writes, that its figures are those of render and diff, going on after a kill, bad input.
. "$CHECK"
json() { "$JSON_GET" "$1" <stdout.txt || echo "no $1"; }
figures() { "$MANGATA" figures --scenes "$SOURCE/scenes" "$@"; }
tiny=(--size 32x18 --spatial 2 --time-samples 2 --frames 0-1 --time-runs 0)

# Everything is there, and complete: 4 scenes of 13 methods and the reference, 2 frames.
expect 0 '112 pictures rendered, 0 kept' figures -o all "${tiny[@]}" --json
plates=(all/fig{11,12,13,14,15,16,17,17-elongation,18,20,21}.svg)
exists all/index.html all/figures.json all/table1.md all/table1.csv "${plates[@]}" all/frames/high/mangata_0001.exr all/pictures/simple-none.png
no_temporaries all
for plate in "${plates[@]}"; do
    head -c 200 "$plate" | grep -q '^<svg xmlns' && tail -c 8 "$plate" | grep -q '</svg>' || fail "$plate is cut short"
    # Pictures are inside; a plate never fetches anything.
    ! grep -Eo '(href|src)="[^"]{0,30}' "$plate" | grep -qv 'href="data:image/png;base64' || fail "$plate fetches something"
    grep -q "src=\"${plate#all/}\"" all/index.html || fail "the page does not show $plate"
done
(($(grep -c '<svg x=' all/fig13.svg) == 14 && $(grep -c '<svg x=' all/fig17.svg) == 7)) || fail "pictures in plates: $(grep -c '<svg x=' all/fig13.svg all/fig17.svg)"
! grep -Eqi '[> ](-?nan|inf)[ <]' all/index.html "${plates[@]}" || fail "not a number: $(grep -Eil '[> ](-?nan|inf)[ <]' all/index.html "${plates[@]}")"
[[ $(json table1) == 24 && $(json run.rendered) == 112 && $(json claims.0.claim) == 'Table 1, simple'* ]] || fail "$(head -c 600 stdout.txt)"
(($(wc -l <all/table1.csv) == 25)) || fail "table1.csv: $(cat all/table1.csv)"

# The figures are those of mangata render and mangata diff.
for frame in 0 1; do
    render "$SOURCE/scenes/smooth.json" -o "m_$frame.pfm" --frames $frame --layer coverage --size 32x18 --method podee-uniform --kernels 9 --quiet
    render "$SOURCE/scenes/smooth.json" -o "t_$frame.pfm" --frames $frame --layer coverage --size 32x18 --method reference --spatial 2 --time-samples 2 --seed 1 --quiet
done
expect 0 '' "$MANGATA" diff m_#.pfm t_#.pfm --frames 0-1 --json
ours=$(grep '^smooth,podee-uniform' all/table1.csv | cut -d, -f4)
awk -v a="$ours" -v b="$(json rmse)" 'BEGIN { exit !(a > 0 && (a - b) * (a - b) < 1e-12) }' || fail "RMSE $ours, mangata diff says $(json rmse)"

# Nothing is rendered twice, and everything comes out the same.
cp -r all before
expect 0 '0 pictures rendered, 112 kept' figures -o all "${tiny[@]}"
grep -q '^| `mangata` |' stdout.txt && same stdout.txt all/table1.md
for file in "${plates[@]}" all/table1.csv all/pictures/high-mangata.png; do same "$file" "before/${file#all/}"; done

# A part alone: only its pictures; what needs no scene renders nothing.
expect 0 '16 pictures rendered, 0 kept' figures -o transition --only 11 --size 32x18 --spatial 1 --time-samples 1 --frames 0 --time-runs 0
exists transition/fig11.svg
absent transition/fig13.svg transition/table1.md
expect 0 '0 pictures rendered' "$MANGATA" figures -o fits --only 21 --scenes nowhere
exists fits/fig21.svg
[[ ! -s stdout.txt ]] || fail "a plate is no data: $(head -c 200 stdout.txt)"

# Killed without warning, it goes on.
slow=(--only table1 --size 64x36 --spatial 8 --time-samples 4 --frames 0-1 --time-runs 0 --progress json --quiet)
: >killed.txt
"$MANGATA" figures --scenes "$SOURCE/scenes" -o k "${slow[@]}" 2>killed.txt >/dev/null &
process=$!
for ((i = 0; i < 1200; i++)); do
    (($(grep -c '"event":"frame"' killed.txt) >= 3)) && break
    sleep 0.05
done
kill -9 $process
wait $process 2>/dev/null
count=$(grep -c '"event":"frame"' killed.txt)
((count >= 3 && count < 56)) || fail "killed after $count of 56 pictures"
absent k/index.html
expect 0 '' figures -o k "${slow[@]}"
again=$(grep -c '"event":"frame"' stderr.txt)
((count + again == 56 || count + again == 55)) || fail "$count pictures before the kill, $again after it, not 56"
expect 0 '' figures -o whole "${slow[@]}"
same k/table1.csv whole/table1.csv

# SIGTERM ends cleanly.
"$MANGATA" figures --scenes "$SOURCE/scenes" -o s "${slow[@]}" --spatial 64 2>/dev/null >/dev/null &
process=$!
for ((i = 0; i < 600; i++)); do
    [[ -d s/frames/high ]] && break
    sleep 0.05
done
kill -TERM $process
wait $process
result=$?
((result == 143)) || fail "SIGTERM ends with $result"
no_temporaries s

# A claim that does not hold: nothing moves and hardly anything is sampled, so some method must beat ours.
figures -o claims --only table1 --size 16x16 --spatial 1 --time-samples 1 --frames 0 --time-runs 0 --check >stdout.txt 2>stderr.txt
result=$?
((result == 2)) && grep -q 'claims do not hold' stderr.txt && grep -q 'class="no"' claims/index.html || fail "--check ends with $result: $(cat stderr.txt)"
expect 0 '' figures -o fits --only 21 --check

# Bad input.
expect 64 'no folder given' figures
expect 64 'figures takes no scene' figures -o x scene.json
expect 64 '\-\-only 10: allowed is a list of table1, 11' figures -o x --only 10
expect 64 'allowed' figures -o x --only 11,,12
expect 64 'each from 16 to' figures -o x --size 8x8
expect 64 'allowed is a number from 1' figures -o x --spatial 0
expect 66 'it holds no simple.json' figures -o x --scenes "$work"
echo '{"mangata": 1, "light": {"elevation_deg": 99}}' >simple.json
cp simple.json smooth.json && cp simple.json medium.json && cp simple.json high.json
expect 65 'simple.json:1' figures -o x --scenes "$work"
echo file >taken
expect 73 'taken: it is not a folder' figures -o taken --only 21
expect 73 'cannot make this folder' figures -o no/such/place --only 21
absent x
finish
