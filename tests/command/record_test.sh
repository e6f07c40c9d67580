# SPDX-License-Identifier: MIT
# Metadata, the render hash, and --skip-existing.
. "$CHECK"

hash_of() { # options: the hash that the render records
    "$MANGATA" render "$simple" -o hash.pfm "${small[@]}" "${null[@]}" --quiet --overwrite "$@" || fail "render $*"
    "$JSON_GET" render_hash <hash.pfm.json
}
first=$(hash_of)
[[ $first =~ ^[0-9a-f]{64}$ ]] || fail "the hash is '$first'"
keeps() { [[ $(hash_of "$@") == "$first" ]] || fail "the hash must not depend on $*"; }
changes() { [[ $(hash_of "$@") != "$first" ]] || fail "the hash must depend on $*"; }
keeps --threads 7
keeps --stamp
keeps --progress json 2>/dev/null
keeps --verbose 2>/dev/null
keeps --set description=other
keeps --method mangata
keeps --crop 0,0,64,36
keeps --set image.width=64
changes --size 64x37
changes --crop 0,0,64,35
changes --method none
changes --method ssaa4
changes --method reference
changes --seed 1
changes --frames 1
changes --layer mask
changes --set light.elevation_deg=3
changes --set water.waves[0].phase=1
changes --set time.fps=25
changes --set time.start=3
changes --set post.exposure=1
[[ $(hash_of --method reference) != $(hash_of --method reference --spatial 9) ]] || fail "the hash must depend on --spatial"
[[ $(hash_of --method reference) != $(hash_of --method reference --samples-range 0,64) ]] || fail "the hash must depend on the range"
[[ $(hash_of --method reference) == $(hash_of --method reference --samples-range 0,512) ]] || fail "the whole range is no range"
[[ $(hash_of --method podee-pixel) != $(hash_of --method podee-pixel --ndf-mean drop) ]] || fail "the hash must depend on --ndf-mean"
podee=$(hash_of --method podee-pixel)
for option in 'kernels 9' 'kernels feline' 'integral kernels' 'path-segments 2' 'transition hard' 'transition-width 0.2'; do
    [[ $(hash_of --method podee-pixel --$option) != "$podee" ]] || fail "the hash must depend on --$option"
done
for option in 'kernels exact' 'integral exact' 'path-segments 1' 'transition soft' 'transition-width 0.3' 'set quality.transition_width=0.3'; do
    [[ $(hash_of --method podee-pixel --$option) == "$podee" ]] || fail "--$option is the default"
done
slots=(--method adaptive --adaptive podee)
podee=$(hash_of "${slots[@]}")
for option in 'samples 8' 'importance-center 0.1' 'importance-width 0.04' 'importance-threshold 0.05' 'set quality.importance_threshold=0.05'; do
    [[ $(hash_of "${slots[@]}" --$option) == "$podee" ]] || fail "--$option is the default of adaptive"
done
[[ $(hash_of "${slots[@]}" --importance-threshold 0.06) != "$podee" ]] || fail "the hash must depend on --importance-threshold"

[[ $(hash_of --method reference) != $(hash_of --method reference --light-cells 20) ]] || fail "the hash must depend on --light-cells"
[[ $(hash_of --method ggx-moments) != $(hash_of --method ggx-moments --roughness-floor 0.1) ]] || fail "the hash must depend on --roughness-floor"
[[ $(hash_of --method ggx-moments --roughness-floor 0.1) == $(hash_of --set 'quality={method: ggx-moments, roughness_floor: 0.1}') ]] || fail "a scene's quality and the command line are one"
value() { "$JSON_GET" "$1" <hash.pfm.json 2>/dev/null; }
hash_of --method ssaa3 --time-samples 2 --seed 5 --frames 4 >/dev/null
[[ $(value method) == ssaa3 && $(value samples) == 18 && $(value seed) == 5 && $(value frame) == 4 ]] || fail "sidecar: $(cat hash.pfm.json)"
[[ $(value mangata_version) == $("$MANGATA" --version | cut -d' ' -f2) ]] || fail "version in the sidecar"
[[ -z $(value host)$(value threads)$(value isa) ]] || fail "the machine is recorded without --stamp"
hash_of --stamp >/dev/null
[[ -n $(value host) && -n $(value threads) && -n $(value isa) ]] || fail "--stamp records nothing"

hash_of --method podee-pixel --kernels 9 --path-segments 2 >/dev/null
[[ $(value method_options) == 'kernels 9 path_segments 2' ]] || fail "options in the sidecar: $(cat hash.pfm.json)"

# The recorded exposure, set by hand, gives the same pixels; linear light has none.
automatic=(--set post.exposure_offset=1.3 --set sky.model=gradient)
works render "$simple" -o automatic.y4m --frames 0 "${small[@]}" --quiet "${automatic[@]}"
stops=$("$JSON_GET" exposure <automatic.y4m.json)
works render "$simple" -o fixed.y4m --frames 0 "${small[@]}" --quiet "${automatic[@]}" --set post.exposure="$stops" --set post.exposure_offset=0
same automatic.y4m fixed.y4m
[[ -n $stops && $("$JSON_GET" exposure <fixed.y4m.json) == "$stops" ]] || fail "the exposure is '$stops': $(cat fixed.y4m.json)"
works render "$simple" -o fixed.png "${small[@]}" --quiet --set post.exposure=-2.5
grep -aqP 'exposure\x00-2\.5' fixed.png || fail "the PNG has no exposure"
works render "$simple" -o linear.pfm "${small[@]}" --quiet
[[ -z $("$JSON_GET" exposure <linear.pfm.json 2>/dev/null) ]] || fail "linear light has an exposure: $(cat linear.pfm.json)"

# Nothing is rendered again when it is there; anything else is refused.
works render "$simple" -o s_##.png --frames 0-3 "${small[@]}" "${null[@]}" --quiet
rm s_02.png
touch -d '2001-01-01' s_00.png s_01.png s_03.png
before=$(stat -c %Y s_0[013].png)
expect 0 '1 frame of .*others kept' render "$simple" -o s_##.png --frames 0-3 "${small[@]}" "${null[@]}" --skip-existing
exists s_02.png
[[ $(stat -c %Y s_0[013].png) == "$before" ]] || fail "--skip-existing wrote files anew"
expect 0 'nothing to render' render "$simple" -o s_##.png --frames 0-3 "${small[@]}" "${null[@]}" --skip-existing
expect 73 's_00.png: .*was not rendered from this scene' render "$simple" -o s_##.png --frames 0-4 "${small[@]}" "${null[@]}" --skip-existing --seed 2
absent s_04.png
works render "$simple" -o s_##.png --frames 0-4 "${small[@]}" "${null[@]}" --skip-existing --overwrite --seed 2 --quiet
exists s_04.png
[[ $(stat -c %Y s_0[013].png) != "$before" ]] || fail "--skip-existing --overwrite kept files of another seed"
for out in x.exr x.pfm x.y4m; do
    works render "$simple" -o $out --frames 0 "${small[@]}" "${null[@]}" --quiet
    expect 0 'nothing to render' render "$simple" -o $out --frames 0 "${small[@]}" "${null[@]}" --skip-existing
    expect 73 'was not rendered' render "$simple" -o $out --frames 1 "${small[@]}" "${null[@]}" --skip-existing
done

# A damaged file is rendered again, to the same bytes, and said so; one that is whole is not.
flip() { # FILE BYTE
    local byte
    byte=$(od -An -tu1 -j "$2" -N 1 "$1")
    printf "\\$(printf %03o $((byte ^ 16)))" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none
}
again() { # FILE WHAT
    expect 0 "$1: damaged; it is rendered again" render "$simple" -o "$1" --frames 0 "${small[@]}" "${null[@]}" --skip-existing
    same "$1" "whole.$1"
    expect 0 'nothing to render' render "$simple" -o "$1" --frames 0 "${small[@]}" "${null[@]}" --skip-existing
}
for out in d.png d.exr d.pfm d.y4m; do
    works render "$simple" -o $out --frames 0 "${small[@]}" "${null[@]}" --quiet
    cp $out whole.$out
    size=$(stat -c %s $out)
    for cut in 0 $((size / 2)) $((size - 1)); do
        truncate -s "$cut" $out
        again $out
    done
    printf x >>$out
    again $out
    for part in 4 2; do
        flip $out $((size - size / part))
        again $out
    done
    flip $out $((size - 5))
    again $out
done
echo '{"render_hash": ' >d.pfm.json
again d.pfm
# The backend null writes pixels of zero, which no other backend takes for its own.
works render "$simple" -o null.pfm "${small[@]}" "${null[@]}" --quiet
(($(tail -c $((64 * 36 * 12)) null.pfm | tr -d '\0' | wc -c) == 0)) || fail "--backend null: pixels are not zero"
expect 73 'null.pfm: .*was not rendered' render "$simple" -o null.pfm "${small[@]}" --skip-existing

echo foreign >y.png
expect 73 'y.png' render "$simple" -o y.png "${small[@]}" "${null[@]}" --skip-existing
[[ $(cat y.png) == foreign ]] || fail "a foreign file was replaced"

# A dry run renders nothing, and ends as a run that is refused before its first frame.
dry=(render "$simple" "${small[@]}" --dry-run)
for output in dry.png dry.exr 'dry_%d.pfm' dry.y4m; do
    expect 0 "$output: nothing speaks against it" "${dry[@]}" -o "$output"
    [[ ! -s stdout.txt ]] || fail "--dry-run -o $output: stdout is not empty"
done
"$MANGATA" "${dry[@]}" -o dry.png --json >stdout.txt 2>/dev/null || fail "--dry-run --json"
[[ $("$JSON_GET" rendered <stdout.txt) == 0 && $("$JSON_GET" width <stdout.txt) == 64 ]] || fail "--dry-run --json: $(cat stdout.txt)"
absent dry*
expect 73 'nowhere' "${dry[@]}" -o nowhere/dry.png
expect 73 'nowhere' "${dry[@]}" -o nowhere/dry.y4m
works render "$simple" "${small[@]}" -o 'dry_%d.png' --frames 2 --quiet
works render "$simple" "${small[@]}" -o dry.y4m --frames 0-1 --quiet
expect 73 'dry_2.png: exists already' "${dry[@]}" -o 'dry_%d.png' --frames 0-2
expect 73 'dry_2.png: it exists, but was not rendered' "${dry[@]}" -o 'dry_%d.png' --frames 0-2 --skip-existing --seed 5
expect 73 'dry.y4m: it exists, but was not rendered' "${dry[@]}" -o dry.y4m --frames 0-2 --skip-existing
expect 0 'nothing speaks against it' "${dry[@]}" -o 'dry_%d.png' --frames 0-2 --skip-existing
expect 0 'nothing speaks against it' "${dry[@]}" -o dry.y4m --frames 0-1 --skip-existing
absent dry_0.png dry_1.png
# A frame that no backend draws is refused before the first frame is rendered, and by the code of the render.
sinks=(--frames 0-2 --set time.start=0 --set 'camera={path: [{time: 0, position: [0, 1, 0], target: [0, 0, -5]}, {time: 0.1, position: [0, -4, 0], target: [0, -4, -5]}]}')
for way in --dry-run --quiet; do
    expect 69 'frame [12]: method reference computes the water.s surface alone' render "$simple" "${small[@]}" --method reference "${sinks[@]}" -o 'sinks_%d.png' "$way"
done
absent sinks_*
expect 69 'frame 0: method reference computes' "$MANGATA" scene check "$simple" --set quality.method=reference --set camera.position=[0,-1,0] --set camera.target=[0,-1,-5]
finish
