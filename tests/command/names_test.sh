# SPDX-License-Identifier: MIT
# New names beside old ones: the same picture, hash and records; never both at once.
. "$CHECK"

hull=$SOURCE/scenes/hull.yaml
record() { "$JSON_GET" "$2" <"$1.json"; }

# alike NAME: old.pfm and new.pfm, with their records
alike() {
    same old.pfm new.pfm
    same old.pfm.json new.pfm.json
    [[ $(record new.pfm render_hash) =~ ^[0-9a-f]{64}$ ]] || fail "$1: no hash"
    rm -f old.pfm* new.pfm*
}
draw() { works render "$2" -o "$1.pfm" --size 32x18 --quiet "${@:3}"; }

for mixture in 9 feline riemann; do
    draw old "$simple" --method podee-pixel --kernels $mixture
    draw new "$simple" --method podee-pixel --mixture=$mixture
    [[ $(record new.pfm method_options) == "kernels $mixture" ]] || fail "$(cat new.pfm.json)"
    alike "--mixture $mixture"
done
draw old "$simple" --set 'quality={method: podee-uniform, kernels: 3}'
draw new "$simple" --set 'quality={method: podee-uniform, mixture: 3}'
alike 'quality: {mixture: 3}'
draw old "$simple" --set 'quality={method: podee-uniform, kernels: 3}' --kernels 5
draw new "$simple" --set 'quality={method: podee-uniform, kernels: 3}' --mixture 5
alike 'the command line overrides the scene by either name'

draw old "$simple" --set light.body=moon
draw new "$simple" --set light.source=moon
alike light.source
for key in body source; do
    printf 'mangata: 1\nlight: {elevation_deg: 20, %s: moon}\nwater: {waves: [{amplitude: 0.05, a: 2, b: 3, c: 1}]}\n' $key >$key.yaml
done
draw old body.yaml
draw new source.yaml
alike 'a file with light.source'

ln -s "$SOURCE/scenes/models" models
for refraction in truth path-traced; do
    printf 'quality: {refraction: %s}\n' $refraction | cat "$hull" - >$refraction.yaml
done
draw old "$hull" --refraction truth --refraction-samples 1 "${null[@]}"
draw new "$hull" --refraction path-traced --refraction-samples 1 "${null[@]}"
[[ $(record new.pfm refraction) == truth ]] || fail "$(cat new.pfm.json)"
alike '--refraction path-traced'
draw old truth.yaml "${null[@]}"
draw new path-traced.yaml "${null[@]}"
alike 'quality: {refraction: path-traced}'
if "$MANGATA" render "$hull" -o probe.pfm --size 32x18 --quiet --refraction truth 2>/dev/null; then # without Embree there is none
    draw old "$hull" --refraction truth --refraction-samples 1
    draw new "$hull" --refraction path-traced --refraction-samples 1
    alike 'pixels of path-traced'
fi

# Names on standard output neither obey nor reorder a terminal.
hostile=$'red\e[31m \u202egnp\nline.json'
cp "$simple" "$hostile"
expect 0 '' "$MANGATA" scene check "$hostile"
[[ $(cat stdout.txt) == 'red?[31m ?gnp?line.json: ok, '* ]] || fail "$(cat -v stdout.txt)"
expect 0 '' "$MANGATA" bench "$hostile" --size 16x9 --frames 1 --repeat 1 --methods none
[[ $(head -1 stdout.txt) == 'red?[31m ?gnp?line.json, 16 x 9, '* ]] || fail "$(cat -v stdout.txt)"

# Methods in one word: tables hold the old names.
expect 0 '' "$MANGATA" bench "$simple" --size 16x9 --frames 1 --repeat 1 --json --methods podee-pixel:mixture=9:path-segments=2,none+path-traced
[[ $("$JSON_GET" methods.0.method <stdout.txt) == podee-pixel:kernels=9:path-segments=2 ]] || fail "$(cat stdout.txt)"
[[ $("$JSON_GET" methods.1.method <stdout.txt) == none+truth ]] || fail "$(cat stdout.txt)"
expect 64 'none\+truth is given twice' "$MANGATA" compare "$simple" -o x --methods none+truth,none+path-traced

# Both at once, and bad input.
refused() { # CODE PATTERN options
    expect "$1" "$2" render "${@:3}" "${null[@]}" -o out.pfm
    absent out.pfm
}
refused 64 '--mixture is the new name of --kernels' "$simple" --method podee-pixel --mixture 9 --kernels 9
refused 64 '--mixture is the new name of --kernels' "$simple" --method podee-pixel --kernels 5 --mixture 9
expect 64 '--mixture is the new name of --kernels' "$MANGATA" bench "$simple" --methods podee-pixel:kernels=9:mixture=9
refused 64 '--mixture 2: allowed is one of exact, 1' "$simple" --method podee-pixel --mixture 2
refused 64 '--mixture: it is for method podee-uniform or podee-pixel alone' "$simple" --mixture 9
refused 64 '--integral and --kernels contradict' "$simple" --method podee-pixel --mixture 9 --integral exact
expect 64 '--mixture needs a value' render "$simple" -o out.pfm --method podee-pixel --mixture
refused 64 'did you mean --mixture' "$simple" --mixtures 9
refused 64 '--refraction path-trace: allowed is one of .*truth \(also called path-traced\)' "$hull" --refraction path-trace
refused 65 'key "source" stands beside "body" of --set light.body=sun' "$simple" --set light.body=sun --set light.source=sun
printf 'mangata: 1\nlight: {body: sun, source: sun}\n' >both.yaml
refused 65 '^both.yaml:2:20: key "source" stands beside "body" at line 2, column 9; "source" is the new name of "body"' both.yaml
printf 'mangata: 1\nquality: {mixture: 9, method: podee-pixel, kernels: 9}\n' >both.yaml
refused 65 '^both.yaml:2:44: .*"mixture" is the new name of "kernels"' both.yaml
printf 'mangata: 1\nlight: {source: star}\n' >star.yaml
refused 65 '^star.yaml:2:17: light.source is star; allowed: one of sun, moon' star.yaml

# The help says so.
render --help >help.txt
tr -s ' \n' ' ' <help.txt | grep -q 'truth (also called path-traced)' || fail "help of --refraction"
tr -s ' \n' ' ' <help.txt | grep -q 'also called --mixture' || fail "help of --kernels"
finish
