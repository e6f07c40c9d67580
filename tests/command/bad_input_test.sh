# SPDX-License-Identifier: MIT
# Bad scenes and bad pictures: what is wrong, where, what is allowed; the exit code; nothing written.
. "$CHECK"

refused() { # CODE PATTERN SCENE [options]
    local code=$1 pattern=$2
    shift 2
    expect "$code" "$pattern" render "$@" -o out.png "${null[@]}"
    absent out.png
    no_temporaries .
}

refused 66 'missing.json: No such file' missing.json
refused 66 'No such file|Not a directory' "$simple/below.json"
refused 66 'directory' .
if ((EUID != 0)); then
    cp "$simple" secret.json
    chmod 0 secret.json
    refused 66 'Permission denied' secret.json
fi

# A scene with one thing wrong, and where: the place is part of the message.
scene() { printf '%s\n' "$@" >scene.yaml; }
scene 'mangata: 1' 'image: {width: 640, height: 360' 'time: {fps: 30}'
refused 65 '^scene.yaml:[0-9]+:[0-9]+: ' scene.yaml
scene 'mangata: 1' 'water:' '  wavse: []'
refused 65 '^scene.yaml:3:3: .*wavse' scene.yaml
scene 'mangata: 1' 'image: {width: wide}'
refused 65 '^scene.yaml:2:[0-9]+: .*width' scene.yaml
scene 'mangata: 1' 'image: {width: [640]}'
refused 65 '^scene.yaml:2:[0-9]+: .*width' scene.yaml
for value in 0 -1 100000 1.5 .inf; do
    scene 'mangata: 1' "image: {width: $value}"
    refused 65 '^scene.yaml:2:[0-9]+: .*width.*allowed' scene.yaml
done
for value in .nan .inf nan '"high"' 91; do
    scene 'mangata: 1' 'light:' "  elevation_deg: $value"
    refused 65 '^scene.yaml:3:[0-9]+: .*elevation_deg' scene.yaml
done
scene 'mangata: 1' 'camera: {position: [1, 2, 3], target: [1, 2, 3]}'
refused 65 '^scene.yaml:2:[0-9]+: .*own position' scene.yaml
scene 'mangata: 1' 'camera: {position: [0, 4, 0], target: [0, 0, 0], up: [0, 1, 0]}'
refused 65 '^scene.yaml:[0-9]+:[0-9]+: .*up' scene.yaml
{
    printf 'mangata: 1\nwater:\n  waves:\n'
    for ((i = 0; i < 10000; i++)); do echo '    - {amplitude: 0.01, a: 1, b: 0, c: 1}'; done
} >scene.yaml
refused 65 '^scene.yaml:[0-9]+:[0-9]+: .*2048' scene.yaml
: >scene.yaml
refused 65 '^scene.yaml' scene.yaml
head -c 4096 /dev/urandom >scene.yaml
refused 65 '^scene.yaml' scene.yaml
head -c 300 "$SOURCE/scenes/sunset.json" >scene.yaml
refused 65 '^scene.yaml:[0-9]+:[0-9]+: ' scene.yaml

# A named pipe, a device or a directory is refused at once, whatever it stands for; standard input is "-".
mkfifo pipe.yaml
mkdir -p folder.yaml
refused 66 'pipe.yaml: is no regular file .standard input is "-".; allowed: ' pipe.yaml
refused 66 '/dev/zero: is no regular file' /dev/zero
for special in pipe.yaml folder.yaml; do
    is="$special: is (no regular file|a directory)"
    refused 66 "$is" "$special"
    expect 66 "$is" "$MANGATA" scene check "$special"
    expect 66 "$is" "$MANGATA" bench "$special"
    expect 66 "$is" "$MANGATA" compare "$special" -o special
    expect 66 "$is" "$MANGATA" waves --base "$special"
    expect 66 "$is" "$MANGATA" waves --buoy "$special"
    expect 66 "$is" "$MANGATA" diff "$special" "$special"
    expect 66 "$is" "$MANGATA" merge "$simple" "$special" -o merged.png --method ssaa2
done

# Nor does a command write to one, whatever its extension.
mkfifo pipe.png
mkdir -p folder.png
for special in pipe.yaml folder.yaml pipe.png folder.png /dev/null; do
    is="$special: is (not a regular file|a directory)"
    expect 73 "$is" "$MANGATA" render "$simple" -o "$special" --overwrite
    expect 73 "$is" "$MANGATA" render "$simple" -o "$special" --skip-existing
    expect 73 "$is" "$MANGATA" merge "$simple" part.sums -o "$special" --overwrite
    expect 73 "$is" "$MANGATA" waves -o "$special" --overwrite
    expect 73 "$is" "$MANGATA" diff part.png part.png --error-map "rmse=$special" --overwrite
done
for special in pipe.png /dev/null; do
    expect 73 "$special: it is not a folder" "$MANGATA" compare "$simple" -o "$special"
done
printf 'mangata: 1\nwater: {choppiness: 3}\n' >bad.yaml
from() { # CODE PATTERN FILE COMMAND…
    expect "$1" "$2" bash -c 'exec "${@:2}" <"$1"' bash "${@:3}"
}
from 65 '^-:2:21: water.choppiness is 3; allowed: ' bad.yaml "$MANGATA" scene check -
from 65 '^-' /dev/null "$MANGATA" scene check -
from 0 '' "$simple" "$MANGATA" scene check -

# Objects: the file that is missing or broken is named, at the place that names it.
cp "$SOURCE/scenes/models/rock.ply" "$SOURCE/scenes/models/sand.png" .
head -c 300 rock.ply >cut.ply
head -c 900 sand.png >cut.png
echo 'not a mesh' >bad.obj
mkfifo pipe.ply
scene 'mangata: 1' 'objects:' '  - {mesh: nowhere.ply}'
refused 66 'scene.yaml:3:12: objects\[0\].mesh: nowhere.ply: No such file .*allowed: ' scene.yaml
scene 'mangata: 1' 'objects:' '  - {mesh: cut.ply}'
refused 65 '^scene.yaml:3:12: .*cut.ply: ends too early; allowed: ' scene.yaml
scene 'mangata: 1' 'objects:' '  - {mesh: bad.obj}'
refused 65 '^scene.yaml:3:12: .*bad.obj:2:1: ' scene.yaml
scene 'mangata: 1' 'objects:' '  - {mesh: pipe.ply}'
refused 66 'scene.yaml:3:12: .*pipe.ply: is no regular file' scene.yaml
scene 'mangata: 1' 'objects:' '  - {mesh: sand.png}'
refused 65 '^scene.yaml:3:12: .*sand.png: has another extension; allowed: .*gltf, .glb, .obj or .ply' scene.yaml
scene 'mangata: 1' 'objects:' '  - {shape: box, material: {texture: cut.png}}'
refused 65 '^scene.yaml:3:38: .*cut.png: is not a sound PNG' scene.yaml
scene 'mangata: 1' 'objects:' '  - {shape: floor, heights: nowhere.pfm}'
refused 66 'scene.yaml:3:29: objects\[0\].heights: nowhere.pfm' scene.yaml
scene 'mangata: 1' 'objects:' '  - {shape: pool, mesh: rock.ply}'
refused 65 '^scene.yaml:3:[0-9]+: objects\[0\].mesh stands beside a shape' scene.yaml
scene 'mangata: 1' 'objects:' '  - {shape: box, scale: [1, 0, 1]}'
refused 65 '^scene.yaml:3:[0-9]+: objects\[0\].scale\[1\] is 0; allowed: ' scene.yaml
refused 65 '^--set objects.0..shape=cone: .*allowed: one of mesh, plane' "$SOURCE/scenes/shore.yaml" --set 'objects[0].shape=cone'
refused 65 '^--set objects.0..dry=wet: .*allowed: ' "$SOURCE/scenes/hull.yaml" --set 'objects[0].dry=wet'
refused 69 "method reference computes the water's surface alone.*ssaa with refraction truth" "$SOURCE/scenes/shore.yaml" --method reference
refused 69 "method reference computes the water's surface alone" "$simple" --method reference --set camera.position=[0,-1,0]
expect 0 '' "$MANGATA" scene check "$SOURCE"/scenes/{shore,diver,hull}.yaml
expect 0 'warning: --set camera.position=.0,2,0.: in frame 0 a wave stands' "$MANGATA" scene check "$SOURCE/scenes/gale.yaml" --set 'camera.position=[0,2,0]'
if [[ -f $SOURCE/data/bunny.ply ]]; then
    expect 0 '' "$MANGATA" scene check "$SOURCE/scenes/pool.yaml"
else
    expect 66 'scripts/fetch_models' "$MANGATA" scene check "$SOURCE/scenes/pool.yaml"
fi

# What --set has made wrong together with the file is blamed on --set.
printf '%s\n' 'mangata: 1' 'image: {width: 64, height: 32000}' 'camera: {position: [0, 4, 0], target: [0, 1, 0], up: [0, 0, -1]}' 'water: {wind: 8, foam: {share: 0.1}}' \
    'post: {exposure: auto, exposure_offset: 1}' 'quality: {method: adaptive, target_rmse: 0.1}' >scene2.yaml
expect 0 '' "$MANGATA" scene check scene2.yaml
refused 65 '^--set camera.target=.0,0,0.: camera: up is zero or parallel' "$simple" --set 'camera.position=[0,4,0]' --set 'camera.target=[0,0,0]'
refused 65 '^--set camera.position.1.=1: camera: ' scene2.yaml --set 'camera.position[1]=1'
refused 65 '^--set image.width=32768: image is 32768 x 32000' scene2.yaml --set image.width=32768
refused 65 '^--set water.foam.amount=1: water.foam.share' scene2.yaml --set water.foam.amount=1
refused 65 '^--set post.exposure=3: post.exposure_offset' scene2.yaml --set post.exposure=3
refused 65 '^--set quality.samples=4: quality: samples and target_rmse exclude' scene2.yaml --set quality.samples=4

refused 65 'light.elevation_degrees' "$simple" --set light.elevation_degrees=3
refused 65 'elevation_deg' "$simple" --set light.elevation_deg=nan
refused 65 'elevation_deg' "$simple" --set light.elevation_deg=high
refused 64 'key=value' "$simple" --set light

for code in 65 66; do
    [[ $code == 66 ]] && rm -f scene.yaml
    expect $code 'scene.yaml' "$MANGATA" scene check scene.yaml
    "$MANGATA" scene check scene.yaml --json >stdout.txt 2>/dev/null
    [[ $? == "$code" && $("$JSON_GET" 0.ok <stdout.txt) == false ]] || fail "scene check --json of a bad scene"
done
expect 0 '' "$MANGATA" scene check "$SOURCE"/scenes/*.json
grep -q 'simple.json: ok, ' stdout.txt || fail "scene check does not say ok"
expect 0 '' "$MANGATA" scene schema
"$JSON_GET" '$schema' <stdout.txt >/dev/null || fail "the schema is not JSON"

# A program that reads models and ends badly is an error of the file; without that program there is one as well.
mkdir program
cp "$MANGATA" program/mangata
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >good.obj
scene 'mangata: 1' 'objects:' '  - {mesh: good.obj}'
expect 0 '' "$MANGATA" scene check scene.yaml
for end in 'kill -SEGV $$' 'kill -KILL $$' 'exit 3' 'exit 0' 'head -c 5000 /dev/zero' 'printf short' 'printf MGI2; head -c 500 /dev/zero' 'printf MGI2; head -c 500 /dev/zero | tr "\\000" "\\377"'; do
    printf '#!/bin/sh\n%s\n' "$end" >program/mangata-import
    chmod +x program/mangata-import
    expect 65 'scene.yaml:3:12: .*good.obj: ' program/mangata scene check scene.yaml
done
rm program/mangata-import
program/mangata scene check scene.yaml >stdout.txt 2>stderr.txt || grep -q 'cannot be read without the program mangata-import' stderr.txt || fail "without mangata-import: $(cat stderr.txt)"
rm -r program

# Pictures that are not.
expect 66 'missing.png' "$MANGATA" diff missing.png missing.png
echo 'not a picture' >bad.png
expect 65 'bad.png' "$MANGATA" diff bad.png bad.png
works render "$simple" -o whole.exr "${small[@]}" "${null[@]}" --quiet
head -c 200 whole.exr >short.exr
expect 65 'short.exr' "$MANGATA" diff whole.exr short.exr
for wrong in 1e9 64M -1 1000000000000000000; do
    expect 65 "whole.exr: .* MANGATA_PIXELS=$wrong; allowed: a whole number" env MANGATA_PIXELS=$wrong "$MANGATA" diff whole.exr whole.exr
done
expect 65 'whole.exr: .* allowed: 9, more with MANGATA_PIXELS=' env MANGATA_PIXELS=9 "$MANGATA" diff whole.exr whole.exr
expect 0 '' env MANGATA_PIXELS= "$MANGATA" diff whole.exr whole.exr
expect 65 'shore.yaml.*png: .* MANGATA_PIXELS=64M; allowed: a whole number' env MANGATA_PIXELS=64M "$MANGATA" scene check "$SOURCE/scenes/shore.yaml"
expect '64' 'nolayer' "$MANGATA" diff whole.exr whole.exr --layer nolayer
cp whole.exr other.exr
expect 66 'missing.exr' "$MANGATA" diff whole.exr other.exr --second-reference missing.exr --metrics texture,specks
expect 65 'short.exr' "$MANGATA" diff whole.exr other.exr --second-reference short.exr --metrics texture,specks

# Unusual but meaningful scenes render.
good() {
    works render "$@" -o good.png "${small[@]}" --quiet --overwrite
    exists good.png
}
scene 'mangata: 1'
good scene.yaml
good "$simple" --set water.waves=[]
good "$simple" --set light.elevation_deg=-6
good "$simple" --set time.shutter=0
good "$simple" --set light.radiance=[0,0,0]
finish
