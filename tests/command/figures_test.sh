# SPDX-License-Identifier: MIT
# `mangata figures`: what it writes, that its figures are those of render and diff, going on after a kill, bad input.
. "$CHECK"
json() { "$JSON_GET" "$1" <stdout.txt || echo "no $1"; }
# The pool without what stands around it: voxels of distances fill a twentieth of the space.
mkdir small && cp -r "$SOURCE/scenes" small/scenes && ln -s "$SOURCE/data" small/data
awk '/^  - name:/ { drop = /deck|wall|hedges/ } !drop' "$SOURCE/scenes/pool.yaml" >small/scenes/pool.yaml
scenes=$work/small/scenes
figures() { "$MANGATA" figures --scenes "$scenes" "$@"; }
frames=0-1 count=187
[[ -z ${SANITIZED:-} ]] || frames=0 count=131
# What idiff takes to start is most of a small picture's time; metrics_test asks the real one.
mkdir quick && printf '#!/bin/sh\necho\necho PASS\n' >quick/idiff && chmod +x quick/idiff && PATH=$work/quick:$PATH
tiny=(--size 32x18 --spatial 2 --time-samples 2 --frames $frames --refraction-samples 1 --time-runs 0)

# Everything is there, and complete: 4 scenes of 13 methods and the reference, 2 frames; 15 views of objects, 60 pictures by their methods and 15 of the truth.
expect 0 "$count pictures rendered, 0 kept" figures -o all "${tiny[@]}" --json
plates=(all/fig{11,12,13,14,15,16,17,17-elongation,18,20,21}.svg all/liu-fig{4,7,8,9,10,11,12,13,14,15}.svg)
exists all/index.html all/figures.json all/table1.md all/table1.csv all/refraction.md "${plates[@]}" all/frames/high/mangata_000${frames#*-}.exr all/pictures/simple-none.png
exists all/frames/pool-waves/reference_0000.exr all/pictures/pool-waves-mangata-narrow-artefacts.png
absent all/frames/pool-waves/reference_0001.exr
no_temporaries all
for plate in "${plates[@]}"; do
    head -c 200 "$plate" | grep -q '^<svg xmlns' && tail -c 8 "$plate" | grep -q '</svg>' || fail "$plate is cut short"
    # Pictures are inside; a plate never fetches anything.
    ! grep -Eo '(href|src)="[^"]{0,30}' "$plate" | grep -qv 'href="data:image/png;base64' || fail "$plate fetches something"
    grep -q "src=\"${plate#all/}\"" all/index.html || fail "the page does not show $plate"
done
(($(grep -c '<svg x=' all/fig13.svg) == 14 && $(grep -c '<svg x=' all/fig17.svg) == 7)) || fail "pictures in plates: $(grep -c '<svg x=' all/fig13.svg all/fig17.svg)"
! grep -Eqi '[> ](-?nan|inf)[ <]' all/index.html "${plates[@]}" || fail "not a number: $(grep -Eil '[> ](-?nan|inf)[ <]' all/index.html "${plates[@]}")"
[[ $(json table1) == 24 && $(json liu_scores) == 60 && $(json run.rendered) == $count && $(json claims.0.claim) == 'Table 1, simple'* ]] || fail "$(head -c 600 stdout.txt)"
(($(grep -c '<svg x=' all/liu-fig10.svg) == 11 && $(grep -c '<svg x=' all/liu-fig13.svg) == 16)) || fail "pictures in plates: $(grep -c '<svg x=' all/liu-fig1[03].svg)"
(($(grep -c '^| ' all/refraction.md) == 61)) || fail "refraction.md: $(cat all/refraction.md)"
(($(wc -l <all/table1.csv) == 25)) || fail "table1.csv: $(cat all/table1.csv)"

# The figures are those of mangata render and mangata diff.
for frame in ${frames/-/ }; do
    render "$SOURCE/scenes/smooth.json" -o "m_$frame.pfm" --frames $frame --layer coverage --size 32x18 --method podee-uniform --kernels 9 --quiet
    render "$SOURCE/scenes/smooth.json" -o "t_$frame.pfm" --frames $frame --layer coverage --size 32x18 --method reference --spatial 2 --time-samples 2 --seed 1 --quiet
done
expect 0 '' "$MANGATA" diff m_#.pfm t_#.pfm --frames $frames --json
ours=$(grep '^smooth,podee-uniform' all/table1.csv | cut -d, -f4)
awk -v a="$ours" -v b="$(json rmse)" 'BEGIN { exit !(a > 0 && (a - b) * (a - b) < 1e-12) }' || fail "RMSE $ours, mangata diff says $(json rmse)"

draw() { render "$scenes/pool.yaml" -o "$1" --frames 0 --size 32x18 --method none --quiet "${@:2}"; }
draw o.pfm --layer refraction --refraction off
draw r.pfm --layer refraction --refraction truth --refraction-samples 1
draw w.pfm --layer mask
expect 0 '' "$MANGATA" diff o.pfm r.pfm --mask w.pfm --display -4 --json
ours=$(awk -F' *\\| *' '$2 == "pool-waves" && $3 == "`off`" { print $4 }' all/refraction.md)
awk -v a="$ours" -v b="$(json rmse)" 'BEGIN { exit !(a > 0 && (a - 255 * b) * (a - 255 * b) < 1e-4) }' || fail "RMSE $ours, mangata diff says 255 times $(json rmse)"

# Nothing is rendered twice, and everything comes out the same.
if [[ -z ${SANITIZED:-} ]]; then
    cp -r all before
    expect 0 "0 pictures rendered, $count kept" figures -o all "${tiny[@]}"
    { cat all/table1.md; echo; cat all/refraction.md; } >tables.txt
    grep -q '^| `mangata` |' stdout.txt && same stdout.txt tables.txt
    for file in "${plates[@]}" all/table1.csv all/refraction.md all/pictures/high-mangata.png; do same "$file" "before/${file#all/}"; done
fi

# A part alone: only its pictures; what needs no scene renders nothing.
expect 0 '16 pictures rendered, 0 kept' figures -o transition --only 11 --size 32x18 --spatial 1 --time-samples 1 --frames 0 --time-runs 0
head -n 1 stderr.txt | grep -q '^transition: all plates and tables take about half an hour' || fail "figures does not say how long it takes: $(head -n 1 stderr.txt)"
exists transition/fig11.svg
absent transition/fig13.svg transition/table1.md
expect 0 '4 pictures rendered, 0 kept' figures -o border --only liu-7 --size 32x18 --refraction-samples 1 --time-runs 3
exists border/liu-fig7.svg
absent border/liu-fig8.svg border/fig11.svg border/frames/pool-16k
if [[ -z ${SANITIZED:-} ]]; then
    expect 0 '0 pictures rendered, 0 kept' figures -o speed --only liu-table3 --size 32x18 --time-runs 1 --json
    [[ $(json liu_table3) == 14 && $(json liu_table3.0.published_frames_per_second) == 55.* && $(json run.rendered) == 0 ]] || fail "$(head -c 600 stdout.txt)"
    awk -v ms="$(json liu_table3.2.milliseconds)" 'BEGIN { exit !(ms > 0) }' || fail "two-phase takes $(json liu_table3.2.milliseconds) ms"
    cp speed/frames/pool-16k/times.json times.json
    expect 0 '' figures -o speed --only liu-table3 --size 32x18 --time-runs 1
    same times.json speed/frames/pool-16k/times.json
    grep -q '^| `two-phase` |' speed/refraction.md || fail "$(cat speed/refraction.md)"
fi
expect 0 '0 pictures rendered' "$MANGATA" figures -o fits --only 21 --scenes nowhere
exists fits/fig21.svg
[[ ! -s stdout.txt ]] || fail "a plate is no data: $(head -c 200 stdout.txt)"

# Killed without warning, it goes on.
size=40x22 spatial=4 pictures=56
[[ -z ${SANITIZED:-} ]] || pictures=28
slow=(--only table1 --size $size --spatial $spatial --time-samples 4 --frames $frames --time-runs 0 --progress json --quiet)
signalled KILL '(($(grep -c "\"event\":\"frame\"" signalled.txt) >= 3))' "$MANGATA" figures --scenes "$scenes" -o k "${slow[@]}"
count=$(grep -c '"event":"frame"' signalled.txt)
((count >= 3 && count < pictures)) || fail "killed after $count of $pictures pictures"
absent k/index.html
expect 0 '' figures -o k "${slow[@]}"
again=$(grep -c '"event":"frame"' stderr.txt)
((count + again == pictures || count + again == pictures - 1)) || fail "$count pictures before the kill, $again after it, not $pictures"
if [[ -z ${SANITIZED:-} ]]; then
    expect 0 '' figures -o whole "${slow[@]}"
    same k/table1.csv whole/table1.csv
fi

# SIGTERM ends cleanly.
signalled TERM '[[ -d s/frames/high ]]' "$MANGATA" figures --scenes "$scenes" -o s "${slow[@]}" --spatial 64
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
expect 64 'liu-15, liu-table3' figures -o x --only liu-5
expect 64 'allowed is a whole number, 1 to 64' figures -o x --refraction-samples 0
expect 64 'each from 16 to' figures -o x --size 8x8
expect 64 'allowed is a whole number, 1 to 1024' figures -o x --spatial 0
expect 66 'it holds no simple.json' figures -o x --scenes "$work"
echo '{"mangata": 1, "light": {"elevation_deg": 99}}' >simple.json
cp simple.json smooth.json && cp simple.json medium.json && cp simple.json high.json
expect 65 'simple.json:1' figures -o x --scenes "$work"
expect 66 '/pool.yaml: No such file' figures -o empty --scenes "$work" --only liu-10
# Without the bunny's file a rock stands for it.
mkdir bare && cp -r "$SOURCE/scenes" bare/scenes
expect 0 'a rock stands for the pool' "$MANGATA" figures --scenes bare/scenes -o rock --only liu-7 --size 16x16 --refraction-samples 1
# Texts of others are not replaced, its own are.
mkdir own && echo mine >own/index.html
expect 73 'own/index.html: exists already, and this command did not write it; --overwrite replaces it' figures -o own --only 21
[[ $(cat own/index.html) == mine ]] || fail "own/index.html was touched"
expect 0 '' figures -o own --only 21 --overwrite
mv own 'own work'
expect 0 '' figures -o 'own work' --only 21
# The command on the page can be pasted into a shell.
grep -q "<code>mangata figures .* -o 'own work' --only 21</code>" 'own work/index.html' || fail "the page's command: $(grep -o '<code>mangata[^<]*' 'own work/index.html')"
echo file >taken
expect 73 'taken: it is not a folder' figures -o taken --only 21
expect 73 'cannot make this folder' figures -o no/such/place --only 21
absent x
finish
