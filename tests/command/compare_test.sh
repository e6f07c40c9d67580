# SPDX-License-Identifier: MIT
# `mangata compare`: what it writes, going on after a kill, gates, bad input.
. "$CHECK"
json() { "$JSON_GET" "$1" <stdout.txt || echo "no $1"; }
report() { "$JSON_GET" "$1" <"$2/report.json" || echo "no $1"; }
compare() { "$MANGATA" compare "$@"; }
smooth=$SOURCE/scenes/smooth.json
tiny=(--size 32x18 --spatial 2 --time-samples 2)
quick=("${tiny[@]}" --frames 0-1 --time-runs 2 --metrics rmse,relrmse,energy,flicker)

# Everything is there, and complete.
expect 0 '4 pictures rendered|8 pictures rendered' compare "$simple" "$smooth" -o r "${quick[@]}" --methods mangata --json
exists r/report.html r/report.json r/report.csv r/report.tex r/frames/simple/mangata_0001.exr r/frames/smooth/reference_0000.exr
no_temporaries r
[[ $(json run.rendered) == 8 && $(json run.kept) == 0 && $(json scenes) == 2 && $(json scenes.0.methods) == 1 ]] || fail "$(head -c 600 stdout.txt)"
[[ $(json scenes.0.methods.0.time_ms.median) =~ ^[0-9.]+$ && $(json reference.samples) == 8 ]] || fail "times, samples: $(head -c 600 stdout.txt)"
(($(wc -l <r/report.csv) == 3)) && head -1 r/report.csv | grep -q '^scene,method,samples,median_ms' || fail "CSV: $(cat r/report.csv)"
grep -q '\\toprule' r/report.tex && grep -q 'mangata compare' r/report.tex || fail "LaTeX: $(cat r/report.tex)"
grep -q '</html>' r/report.html || fail "the page is cut short"
! grep -Eq '(src|href)="?(http|//)' r/report.html || fail "the page fetches something"

# The figures are those of mangata render and mangata diff.
for frame in 0 1; do
    render "$simple" -o "m_$frame.pfm" --frames $frame --layer coverage --size 32x18 --quiet
    for half in 1 2; do
        render "$simple" -o "t${half}_$frame.exr" --frames $frame --layer color --layer coverage --size 32x18 --method reference --spatial 2 \
            --time-samples 1 --seed $half --quiet
        expect 0 '' "$MANGATA" diff "t${half}_$frame.exr" "r/frames/simple/reference-${half}_000$frame.exr" --layer coverage --max-rmse 0
    done
done
near() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > 0 && (a - b) * (a - b) < 1e-14) }' || fail "$3: $1, mangata diff says $2"; }
csv() { awk -F, -v key="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == key) c = i } NR == 2 { print $c }' "$1/report.csv"; }
expect 0 '' "$MANGATA" diff m_#.pfm r/frames/simple/reference_####.exr --frames 0-1 --layer coverage --json
near "$(cut -d, -f7 r/report.csv | sed -n 2p)" "$(json rmse)" RMSE
expect 0 '' "$MANGATA" diff m_#.pfm t1_#.exr --second-reference t2_#.exr --frames 0-1 --layer coverage --json
near "$(csv r coverage.rmse.noise-floor)" "$(json noise_floor)" "noise floor"
[[ $(report scenes.0.noise_floor r) == *"\"coverage.rmse\":$(csv r coverage.rmse.noise-floor)"* ]] || fail "noise floor: $(report scenes.0.noise_floor r)"
near "$(report scenes.0.methods.0.noiseless_rmse r)" "$(json noiseless_rmse)" "noiseless RMSE"
[[ $(report scenes.0.reference.command r) == *'--spatial 2 --time-samples 1 --seed 1'* && $(report scenes.0.reference.second_command r) == *'--seed 2'* ]] ||
    fail "commands of the halves: $(report scenes.0.reference r)"

# Texture and specks are those of mangata diff; without rmse nothing else is there.
expect 0 '' compare "$simple" -o x1 --size 64x36 --spatial 2 --time-samples 8 --frames 0-1 --time-runs 0 --methods mangata --metrics texture,specks
[[ $(report columns.0.key x1) == light.texture-correlation && $(report columns.6.key x1) == displayed.specks ]] || fail "columns: $(report columns x1)"
expect 0 '' "$MANGATA" diff x1/frames/simple/mangata_####.exr x1/frames/simple/reference-1_####.exr --second-reference x1/frames/simple/reference-2_####.exr \
    --frames 0-1 --layer color --metrics texture --json
near "$(csv x1 light.texture-correlation)" "$(json metrics.texture.correlation_mean)" texture
[[ $(report scenes.0.methods.0.texture.bands.3.rows x1) == 6 && $(report scenes.0.methods.0.specks.pixels x1) == 4608 ]] || fail "bands: $(report scenes.0.methods.0 x1)"

# The noise floor is what a far better reference scores, and halves with four times as many samples.
for samples in 8 32; do
    expect 0 '' compare "$simple" -o n$samples --size 64x36 --spatial 2 --time-samples $samples --frames 0-1 --time-runs 0 \
        --methods reference:spatial=4:time-samples=64,none --metrics rmse,flip
done
for metric in coverage.rmse displayed.rmse displayed.flip; do
    for samples in 8 32; do
        echo "$(csv n$samples $metric.noise-floor) $(csv n$samples $metric)"
    done >floors.txt
    awk '{ floor[NR] = $1; right += $1 > 0 && $2 / $1 > 0.8 && $2 / $1 < 1.25 } END { ratio = floor[1] / floor[2]; exit !(right == 2 && ratio > 1.4 && ratio < 2.6) }' \
        floors.txt || fail "$metric: floor and score of the truth, with 32 and 128 samples: $(cat floors.txt)"
done
[[ $(report scenes.0.best n8) == '{"coverage.rmse":"reference:spatial=4:time-samples=64"'* ]] || fail "best: $(report scenes.0.best n8)"
grep -q '\\textbf{0\.00' n8/report.tex && grep -q '\\textit{noise floor}' n8/report.tex && ! grep -q 'No best' n8/report.tex || fail "LaTeX: $(cat n8/report.tex)"

# Pictures that are alike, or that differ by less than the noise, have no winner, and the tables say so.
expect 0 '' compare "$simple" -o tie "${quick[@]}" --time-runs 0 --methods podee-pixel,podee-pixel:ndf-mean=add
[[ $(report scenes.0.best tie) == '{"coverage.rmse":null,'* ]] && ! grep -q 'textbf' tie/report.tex && ! grep -q 'class="score best"' tie/report.html ||
    fail "a winner among equals: $(report scenes.0.best tie)"
grep -q 'No best is marked where .* noise floor: simple (RMSE, relative RMSE' tie/report.tex && grep -q 'id="ties">No best is marked' tie/report.html ||
    fail "ties: $(cat tie/report.tex)"

# Where there is more to see than the surface, the reference is ssaa, of objects by refraction truth, and of each scene its own.
hull=$SOURCE/scenes/hull.yaml
if "$MANGATA" render "$hull" -o probe.pfm --size 32x18 --quiet --refraction truth 2>/dev/null; then # without Embree there is none
    expect 0 '8 pictures rendered' compare "$hull" "$simple" -o w --size 32x18 --spatial 2 --time-samples 8 --frames 0 --time-runs 0 \
        --methods none+off,mangata,ssaa4+truth:time-samples=16:refraction-samples=16 --metrics rmse,flip
    below='--method ssaa2 --time-samples 4 --refraction truth --refraction-samples 4 --seed'
    [[ $(report scenes.0.reference.command w) == *"$below 1 "* && $(report scenes.0.reference.second_command w) == *"$below 2 "* &&
        $(report scenes.0.reference.samples w) == 32 && $(report scenes.1.reference.command w) == *'--method reference --spatial 2 --time-samples 4 --seed 1'* ]] ||
        fail "references: $(report scenes.0.reference w) $(report scenes.1.reference w)"
    render "$hull" -o half.exr --layer color --layer coverage --size 32x18 --quiet ${below% --seed} --seed 2
    expect 0 '' "$MANGATA" diff half.exr w/frames/hull/reference-2_0000.exr --layer color --max-rmse 0
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i } $1 == "hull" { score[$2] = $column["displayed.rmse"]; floor = $column["displayed.rmse.noise-floor"] }
        END { truth = score["ssaa4+truth:time-samples=16:refraction-samples=16"] / floor
              exit !(floor > 0 && truth > 0.6 && truth < 1.6 && score["mangata"] < 0.5 * score["none+off"]) }' w/report.csv ||
        fail "scores of objects: $(cat w/report.csv)"
    expect 0 '2 pictures rendered' compare "$hull" -o w2 "${tiny[@]}" --frames 0 --time-runs 0 --methods none --metrics rmse
    [[ $(report scenes.0.reference.command w2) == *'--time-samples 2 --refraction truth --refraction-samples 3'* && $(report scenes.0.reference.samples w2) == 16 ]] ||
        fail "halves of one instant: $(report scenes.0.reference w2)"
fi
expect 0 '2 pictures rendered' compare "$simple" -o w3 "${tiny[@]}" --frames 0 --time-runs 0 --methods none --metrics rmse --set camera.position=[0,-1,0]
[[ $(report scenes.0.reference.command w3) == *'--method ssaa2 --time-samples 2 --seed 1 '* ]] || fail "a camera under water: $(report scenes.0.reference w3)"

# Nothing is rendered or timed twice; what was asked anew is.
before=$(stat -c %Y.%i r/frames/*/*)
expect 0 '0 pictures rendered, 8 kept' compare "$simple" "$smooth" -o r "${quick[@]}" --methods mangata
[[ $(stat -c %Y.%i r/frames/*/*) == "$before" ]] || fail "a finished picture or time was written again"
expect 0 '4 pictures rendered, 8 kept' compare "$simple" "$smooth" -o r "${quick[@]}" --methods mangata,none
expect 0 '6 pictures rendered, 0 kept' compare "$simple" -o r "${quick[@]}" --methods mangata,none --set light.elevation_deg=12
echo junk >r/frames/simple/none_0000.exr
expect 0 '1 pictures rendered, 5 kept' compare "$simple" -o r "${quick[@]}" --methods mangata,none --set light.elevation_deg=12

# A half of the reference that was finished is taken as it is; one that is lost is rendered again.
expect 0 '6 pictures rendered' compare "$simple" -o h --size 32x18 --spatial 1 --time-samples 3 --frames 0-2 --time-runs 0 --methods none --metrics rmse
expect 0 '0 pictures rendered, 6 kept' compare "$simple" -o h --size 32x18 --spatial 1 --time-samples 4 --frames 0-2 --time-runs 0 --methods none --metrics rmse
[[ $(report reference.samples h) == 4 && $(report reference.time_samples h) == 4 ]] || fail "an odd number of time samples: $(report reference h)"
half=h/frames/simple/reference-1_0000.exr
before=$(stat -c %Y.%i $half)
cp h/frames/simple/reference_0000.exr mean.exr
rm h/frames/simple/reference_0000.exr h/frames/simple/reference-2_0000.exr
expect 0 '1 pictures rendered, 5 kept' compare "$simple" -o h --size 32x18 --spatial 1 --time-samples 4 --frames 0-2 --time-runs 0 --methods none --metrics rmse
[[ $(stat -c %Y.%i $half) == "$before" ]] || fail "a finished half was rendered again"
for layer in color coverage; do
    expect 0 '' "$MANGATA" diff mean.exr h/frames/simple/reference_0000.exr --layer $layer --max-rmse 0
done

# Killed without warning, it goes on: no picture twice, and the same report at the end.
slow=(--size 160x90 --spatial 2 --time-samples 4 --frames 0-3 --time-runs 0 --metrics rmse,flicker --methods none,ssaa8,mangata
    --progress json --quiet)
signalled KILL '(($(grep -c "\"event\":\"frame\"" signalled.txt) >= 3))' "$MANGATA" compare "$simple" -o k "${slow[@]}"
done_before=$(grep '"event":"frame"' signalled.txt | grep -o '"file":"[^"]*"' | sort)
count=$(wc -l <<<"$done_before")
((count >= 3 && count < 16)) || fail "killed after $count of 16 pictures"
absent k/report.html
expect 0 '' compare "$simple" -o k "${slow[@]}"
cp stderr.txt again.txt
done_after=$(grep '"event":"frame"' again.txt | grep -o '"file":"[^"]*"' | sort)
[[ -z $(comm -12 <(echo "$done_before") <(echo "$done_after")) ]] || fail "rendered twice: $(comm -12 <(echo "$done_before") <(echo "$done_after"))"
after=$(wc -l <<<"$done_after")
# A picture may be finished but not yet told when the kill comes.
((count + after == 16 || count + after == 15)) || fail "$count pictures before the kill, $after after it, not 16"
expect 0 '' compare "$simple" -o whole "${slow[@]}"
lasting() { sed '/"command"/d; /"time_ms"/d' "$1"; }
for name in report.json report.csv; do
    cmp -s <(lasting k/$name) <(lasting whole/$name) || fail "$name differs after a kill"
done
no_temporaries whole

# SIGTERM ends cleanly.
signalled TERM '[[ -e s/frames/simple/none_0000.exr ]]' "$MANGATA" compare "$simple" -o s "${slow[@]}" --spatial 8
result=$?
((result == 143)) || fail "SIGTERM ends with $result"
no_temporaries s

# Gates.
gate() { compare "$simple" -o g "${quick[@]}" --methods none,mangata --quiet "$@"; }
expect 0 '' gate --max-rmse mangata=1 --max-flicker none=2
gate --max-rmse mangata=1 --max-rmse none=1e-6 >stdout.txt 2>stderr.txt
(($? == 2)) && grep -q 'none: RMSE of coverage .* is above 1e-06' stderr.txt || fail "--max-rmse: $(cat stderr.txt)"
gate --max-flicker mangata=1e-9 >stdout.txt 2>stderr.txt
(($? == 2)) && grep -q 'mangata: flicker of coverage' stderr.txt || fail "--max-flicker: $(cat stderr.txt)"
[[ $(report gates.0.passed g) == false && -s g/report.html ]] || fail "a failed gate is not in the report"
sed 's/"width": *1280/"width": 1000/' "$smooth" >other.json
expect 64 'other.json has 1000 x 720; a limit scores all scenes as one clip' compare "$simple" other.json -o g --max-rmse mangata=1

# A method with options is the same as mangata render with them.
expect 0 '' compare "$simple" -o o "${quick[@]}" --time-runs 0 --methods podee-pixel:ndf-mean=drop,ssaa2:time-samples=3 --quiet
render "$simple" -o direct.exr --layer color --layer coverage --size 32x18 --method podee-pixel --ndf-mean drop --quiet
expect 0 '' "$MANGATA" diff direct.exr o/frames/simple/podee-pixel-ndf-mean-drop_0000.exr --layer coverage --max-rmse 0
[[ $(report scenes.0.methods.1.command o) == *'--method ssaa2 --time-samples 3'* && $(report scenes.0.methods.1.samples o) == 12 ]] ||
    fail "commands: $(report scenes.0.methods.1.command o)"

# The commands of the report make its pictures, whatever the scene says of seeds and however long the list of frames is.
cat >seeded.yaml <<'END'
mangata: 1
quality: {method: ssaa, spatial: 2, seed: 77}
END
expect 0 '' compare seeded.yaml -o seeded "${tiny[@]}" --frames 0 --time-runs 0 --methods ssaa2,adaptive:samples=4,taa --metrics rmse --quiet
line=$(report scenes.0.methods.0.command seeded)
[[ $line == *' --seed 0 '* ]] || fail "no seed: $line"
mkdir again
(cd again && cp ../seeded.yaml . && eval "\"$MANGATA\" ${line#mangata} --quiet") || fail "the command does not run: $line"
expect 0 '' "$MANGATA" diff again/ssaa2_0000.exr seeded/frames/seeded/ssaa2_0000.exr --layer coverage --max-rmse 0
# Samples are those of the layer; where pixels differ there is no number.
[[ $(report scenes.0.methods.0.samples seeded) == 4 && $(report scenes.0.methods.1.samples seeded) == null && $(report scenes.0.methods.2.samples seeded) == 8 ]] ||
    fail "samples: $(cat seeded/report.csv)"
grep -q '^seeded,adaptive:samples=4,,' seeded/report.csv || fail "samples of adaptive: $(cat seeded/report.csv)"
frames=$(seq -s, 0 7 700)
expect 0 '' compare "$simple" -o long "${tiny[@]}" --backend null --frames "$frames" --time-runs 0 --methods none --metrics rmse --quiet
[[ $(report scenes.0.methods.0.command long) == *" --frames $frames "* ]] || fail "a long list of frames: $(report scenes.0.methods.0.command long)"
# A comment stays one, an unsigned seed is not negative.
expect 0 '' compare "$simple" -o lines "${tiny[@]}" --frames 0 --time-runs 0 --methods none --metrics rmse --quiet --seed 18446744073709551613 --set $'description=a\nb'
grep -v '^%' lines/report.tex | head -1 | grep -q '^.begin' || fail "a line end in the command: $(head -4 lines/report.tex)"
[[ $(report reference.seed lines) == 18446744073709551614 ]] || fail "seed: $(report reference lines)"

# No best where no other has a score, or where the reference is black.
expect 0 '' compare "$simple" -o alone "${tiny[@]}" --frames 0 --time-runs 0 --methods none --metrics rmse --json
[[ $(report scenes.0.best alone) == '{"coverage.rmse":null,"displayed.rmse":null}' ]] || fail "best of one: $(report scenes.0.best alone)"
expect 0 'warning: The reference shows no light, so no best is marked: simple .coverage' compare "$simple" -o dark "${tiny[@]}" --frames 0 --time-runs 0 --methods none,mangata \
    --metrics rmse --set light.azimuth_deg=180 --set light.elevation_deg=80
[[ $(report scenes.0.best dark) == '{"coverage.rmse":null,'* ]] || fail "best in the dark: $(report scenes.0.best dark)"
grep -q 'The reference shows no light' dark/report.tex && grep -q 'id="black"' dark/report.html || fail "the dark is not told"

# Files of others are not replaced, its own are.
for name in report.tex report.html report.csv report.json; do
    rm -rf own && mkdir own
    echo mine >own/$name
    expect 73 "own/$name: exists already, and this command did not write it; --overwrite replaces it" compare "$simple" -o own "${tiny[@]}" --frames 0 --methods none
    [[ $(ls own) == "$name" && $(cat own/$name) == mine ]] || fail "own/$name was touched"
done
expect 0 '' compare "$simple" -o own "${tiny[@]}" --frames 0 --time-runs 0 --methods none --metrics rmse --quiet --overwrite
expect 0 '' compare "$simple" -o own "${tiny[@]}" --frames 0 --time-runs 0 --methods none --metrics rmse --quiet

# Told before anything is drawn.
expect 64 'metrics flicker needs at least two --frames' compare "$simple" -o x --frames 3 --metrics flicker
expect 0 'warning: --metrics flicker needs at least two --frames' compare "$simple" -o own "${tiny[@]}" --frames 0 --time-runs 0 --methods none --metrics rmse,flicker
expect 64 'frames: 100000000 frames; allowed are 100000' timeout 10 "$MANGATA" compare "$simple" -o x --frames 0-99999999

# Pictures of others, beside ours: a copy of a method scores what it scores; what a file lacks has no score.
mkdir -p other/simple other/smooth
cp r/frames/smooth/none_0000.exr other/smooth/0000.exr
cp r/frames/smooth/none_0001.exr other/smooth/0001.exr
for frame in 0 1; do
    render "$simple" -o other/simple/000$frame.exr --layer coverage --layer color --method none --size 32x18 --frames $frame --quiet
    render "$simple" -o other/coverage_$frame.pfm --layer coverage --method none --size 32x18 --frames $frame --quiet
done
expect 0 '8 pictures rendered, 0 kept' compare "$simple" "$smooth" -o e --size 32x18 --spatial 2 --time-samples 2 --frames 0-1 --time-runs 0 --methods none --metrics rmse,flip,texture \
    --external 'Mine_1.0=other/{scene}/%04d.exr' --json
[[ $(json scenes.0.methods.1.method) == Mine_1.0 && $(json scenes.1.methods.1.samples) == null && $(json scenes.0.methods.1.command) == null ]] || fail "external: $(json scenes.0.methods.1)"
for scene in 0 1; do
    [[ $(json scenes.$scene.methods.0.scores) == "$(json scenes.$scene.methods.1.scores)" ]] || fail "a copy scores $(json scenes.$scene.methods.1.scores)"
done
grep -q '^simple,Mine_1.0,,,,,0' e/report.csv && grep -q 'Mine\\_1.0 & -- & 0' e/report.tex && grep -q 'row">Mine_1.0' e/report.html || fail "external in the tables: $(cat e/report.csv)"
absent e/frames/simple/Mine_1.0_0000.exr
expect 0 '0 pictures rendered, 4 kept' compare "$simple" -o e "${tiny[@]}" --frames 0-1 --time-runs 0 --methods none --metrics rmse,flip \
    --external grey=other/coverage_%d.pfm --json --max-rmse grey=1
[[ $(json scenes.0.methods.1.scores) == *'"displayed.flip":null'* && $(json scenes.0.methods.1.scores) == '{"coverage.rmse":0.'* ]] || fail "coverage alone: $(json scenes.0.methods.1)"
# A picture that is not a number scores nothing, is named and passes no gate.
pfm() { # FILE, then the bytes of each of its 576 values
    { printf 'Pf\n32 18\n-1.0\n' && for ((i = 0; i < 576; i++)); do printf "$2"; done; } >"$1"
}
pfm other/bad_0.pfm '\0\0\300\177'
pfm other/bad_1.pfm '\0\0\0\0'
printf '\0\0\200\177' | dd of=other/bad_1.pfm bs=1 seek=94 conv=notrunc status=none
cp other/bad_1.pfm other/inf_0.pfm
bad=(compare "$simple" -o e "${tiny[@]}" --frames 0-1 --time-runs 0 --methods none --metrics rmse,energy,flicker --external 'mine=other/bad_%d.pfm')
said='mine: values that are infinite or not a number in one picture only: other/bad_0.pfm \(576\), other/bad_1.pfm \(1\)'
expect 0 "warning: $said\$" "${bad[@]}"
[[ $(report scenes.0.methods.1.mismatches.0 e) == '{"file":"other/bad_0.pfm","values":576}' && $(report scenes.0.methods.1.mismatches.1.values e) == 1 &&
    $(report scenes.0.methods.1.scores e) == '{"coverage.rmse":null,"coverage.energy":null,'* && $(report scenes.0.methods.1.frames e) != *[0-9]* &&
    $(report scenes.0.methods.1.noiseless_rmse e) == null && $(report scenes.0.methods.0.mismatches e) == no* && $(report scenes.0.best e) != *mine* ]] ||
    fail "values that are not a number: $(report scenes.0.methods.1 e)"
grep -Eq "mismatches\">$said<" e/report.html && grep -q '^simple,mine,,,,,,' e/report.csv || fail "tables of values that are not a number: $(cat e/report.csv)"
expect 2 "^mangata: $said, so it passes no limit" "${bad[@]}" --max-rmse mine=1 --quiet
expect 2 'mine: .*so it passes no limit' "${bad[@]}" --max-flicker mine=9 --quiet
[[ $(report gates.0.passed e) == false ]] || fail "the gate: $(report gates e)"
expect 0 '' "${bad[@]}" --max-rmse none=1
expect 2 'mine: .*other/inf_0.pfm \(1\), so' compare "$simple" -o e "${tiny[@]}" --frames 0 --time-runs 0 --methods none --metrics texture,rmse --external mine=other/inf_0.pfm \
    --max-rmse mine=1 --quiet

for frame in 0 1; do render "$simple" -o other/color_$frame.pfm --method none --size 32x18 --frames $frame --quiet; done
expect 64 'max-rmse mine: its pictures of simple hold no coverage' compare "$simple" -o x "${tiny[@]}" --frames 0-1 --methods none --external mine=other/color_%d.pfm --max-rmse mine=1
external() { compare "$simple" -o x "${tiny[@]}" --frames 0-1 --methods none --external "$@"; }
expect 64 'allowed is NAME=PATH' external other/%04d.exr
expect 64 'allowed is NAME=PATH' external 'my own=other/%04d.exr'
expect 64 'mangata is the name of a method' external mangata=other/simple/%04d.exr
expect 64 'a is the name of a method' external a=other/simple/%04d.exr --external a=other/smooth/%04d.exr
expect 64 'allowed are .exr and .pfm' external a=other/%04d.png
expect 64 'number the files' external a=other/simple/0000.exr
expect 64 'several scenes are compared; write .scene.' external a=other/simple/%04d.exr "$smooth"
expect 66 'other/simple/0002.exr: .*No such file' external a=other/simple/%04d.exr --frames 0-2
expect 1 'other/simple/0000.exr has 32 x 18 pixels, simple is compared at 16 x 9; --size' external a=other/simple/%04d.exr --size 16x9
render "$simple" -o other/normal_0.exr --layer normal --size 32x18 --quiet
render "$simple" -o other/mixed_0.exr --layer color --size 32x18 --quiet
render "$simple" -o other/mixed_1.exr --layer coverage --size 32x18 --quiet
expect 65 'normal_0.exr: it holds neither color' external a=other/normal_%d.exr
expect 65 'mixed_1.exr: it does not hold the layers' external a=other/mixed_%d.exr
echo junk >other/junk_0.exr
expect 65 'junk_0.exr' external a=other/junk_%d.exr

# Without idiff one metric is missing, and nothing else.
mkdir bin
expect 0 'Yee is unavailable' env PATH="$work/bin" "$MANGATA" compare "$simple" -o y "${tiny[@]}" --frames 0 --time-runs 0 \
    --methods none --metrics rmse,yee
[[ $(report columns.1.key y) == displayed.rmse && $(report columns.2.unavailable y) == *idiff* ]] || fail "missing idiff: $(report columns y)"
[[ $(cut -d, -f7 y/report.csv | tail -1) =~ ^[0-9.] ]] || fail "RMSE went with idiff: $(cat y/report.csv)"

# The page's pictures keep to their limit: the first frames are shown.
expect 0 'the page shows the first [0-9]+ of 8 frames' compare "$SOURCE/scenes/sunset.json" -o p --size 160x90 --frames 0-7 --spatial 1 \
    --time-samples 1 --time-runs 0 --methods none,podee-uniform,mangata --metrics rmse --picture-mb 1
(($(stat -c %s p/report.html) < 1200000)) || fail "the page is larger than asked for"

# Bad input.
expect 64 'no scene given' compare -o x
expect 64 'no folder given' compare "$simple"
expect 64 'unknown method mirror; allowed are none' compare "$simple" -o x --methods none,mirror
expect 64 'refraction' compare "$simple" -o x --methods mangata+refraction
expect 64 'podee-uniform:kernels=3:path-seg.*: the name with its options has [0-9]+ characters; allowed are 200' compare "$simple" -o x \
    --methods "podee-uniform:kernels=3:path-segments=4$(printf ':elongation=3%.0s' {1..14})"
expect 64 'none is given twice' compare "$simple" -o x --methods none,mangata,none
expect 64 'the reference is always rendered' compare "$simple" -o x --methods reference
expect 64 'ndf-mean: it is for method podee-pixel alone' compare "$simple" -o x --methods mangata:ndf-mean=drop
expect 64 'unknown option kernel;' compare "$simple" -o x --methods podee-pixel:kernel=3
expect 64 'for method podee-uniform or podee-pixel' compare "$simple" -o x --methods mangata:kernels=3
expect 64 'METHOD=X' compare "$simple" -o x --max-rmse 0.1
expect 64 'lean is not one of the methods compared' compare "$simple" -o x --max-rmse lean=0.1
expect 64 'needs at least two frames' compare "$simple" -o x --frames 3 --max-flicker mangata=0.1
expect 64 'needs rmse among --metrics' compare "$simple" -o x --metrics flicker --max-rmse mangata=0.1
expect 64 '--metrics beauty: allowed are rmse, .*, texture, specks, separated by commas' compare "$simple" -o x --metrics beauty
expect 64 'seed 18446744073709551614' compare "$simple" -o x --seed 18446744073709551614
expect 64 '--metrics texture,: allowed are' compare "$simple" -o x --metrics texture,
expect 64 '--metrics : allowed are' compare "$simple" -o x --metrics ''
expect 66 'nosuch.json' compare "$simple" nosuch.json -o x
echo '{"mangata": 1, "light": {"elevation_deg": 99}}' >bad.json
expect 65 'bad.json:1' compare bad.json -o x
echo file >taken
expect 73 'taken: it is not a folder' compare "$simple" -o taken "${quick[@]}"
expect 73 'cannot make this folder' compare "$simple" -o no/such/place "${quick[@]}"
expect 73 '' compare "$simple" -o /proc/report "${quick[@]}"
absent x
finish
