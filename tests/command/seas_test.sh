# SPDX-License-Identifier: MIT
# Seas in one line: water.wind in scenes, --sea in place of a scene, and what they say to nonsense.
. "$CHECK"

# ---- a scene's key ----
printf 'mangata: 1\nwater: {wind: 12}\n' >short.yaml
printf 'mangata: 1\nwater:\n  wind:\n    speed: 12\n' >long.yaml
printf 'mangata: 1\nwater: {spectrum: {model: elfouhaily, wind: 12, slope: cox-munk, count: 160, fetch: 1e7}}\n' >spectrum.yaml
for scene in short long spectrum; do
    expect 0 '' "$MANGATA" scene check $scene.yaml
    works render $scene.yaml -o $scene.png -q "${small[@]}"
done
same short.png long.png
differ short.png spectrum.png # 10 000 km are not without bound
works render short.yaml -o other.png -q "${small[@]}" --set water.wind.seed=2
differ short.png other.png

printf 'mangata: 1\nwater:\n  wind: 3\n  swell: [{height: 2, direction_deg: 250}]\n' >swell.yaml
printf 'mangata: 1\nwater: {waves: [{wavelength: 40, direction_deg: 30, height: 1.2}]}\n' >measured.yaml
for scene in swell measured; do
    expect 0 '' "$MANGATA" scene check $scene.yaml
    works render $scene.yaml -o $scene.png -q "${small[@]}"
done
expect 0 '' "$MANGATA" scene check measured.yaml --set time.frames=1
[[ $(cat stdout.txt) == 'measured.yaml: ok, 1 wave, 1 frame' ]] || fail "$(cat stdout.txt)"
works render swell.yaml -o high.png -q "${small[@]}" --set 'water.swell[0].height=4'
differ swell.png high.png

# ---- in place of a scene ----
works render --sea wind=8 -o sea.png -q "${small[@]}"
works render --sea=wind=8 -o again.png -q "${small[@]}"
same sea.png again.png
works render --sea wind=8,direction=30,seed=3,fetch=1e5,count=40 -o b.png -q "${small[@]}" --set light.elevation_deg=30
works render --sea wind=8 -o film_%02d.png -q "${small[@]}" --frames 58-59
exists sea.png b.png film_58.png film_59.png
works render --sea wind=8 -o sea.png -q "${small[@]}" --skip-existing
expect 73 'was not rendered from this scene' render --sea wind=9 -o sea.png -q "${small[@]}" --skip-existing
expect 0 '' "$MANGATA" scene check --sea wind=8 short.yaml
grep -q '^--sea wind=8: ok, 160 waves, 60 frames$' stdout.txt || fail "$(cat stdout.txt)"
expect 0 '' "$MANGATA" bench --sea wind=8 "${small[@]}" --frames 1 --repeat 1 --methods none --json
[[ $("$JSON_GET" scene <stdout.txt) == '--sea wind=8' ]] || fail "$(cat stdout.txt)"
works "$MANGATA" compare --sea wind=3.5 --sea wind=8 -o report -q --methods none --spatial 1 --time-samples 2 --size 32x18 --frames 0 --time-runs 0
exists report/frames/sea_wind_3_5 report/frames/sea_wind_8
grep -q 'mangata render --sea wind=3.5 -o' report/report.json || fail "report.json has no such command"
"$MANGATA" render --help | grep -q -- '--sea KEY=VALUE' || fail "the help does not list --sea"

# ---- nonsense ----
refused() { # CODE PATTERN options
    expect "$1" "$2" render "${@:3}" "${null[@]}" -o out.png
    absent out.png
}
refused 64 '^mangata: --sea wynd=8: unknown key "wynd"; allowed: wind, direction, fetch, depth, count, seed, swell, swell_period.*' --sea wynd=8
refused 64 '^mangata: --sea 8: "8" is not of the form key=value' --sea 8
refused 64 'one scene at a time: short.yaml and --sea wind=8 are given' short.yaml --sea wind=8
refused 64 'one scene at a time' --sea wind=3 --sea wind=8
expect 64 '--sea needs a value' render -o out.png --sea
refused 64 '^mangata: --sea wind=gale: wind is "gale"; allowed: a number' --sea wind=gale
refused 64 '^mangata: --sea wind=12,swell_period=9: swell_period is given, but no swell; allowed: beside swell, its height' --sea wind=12,swell_period=9
refused 64 'swell_direction is given, but no swell' --sea swell_direction=30,swell_spread=20
expect 0 '' "$MANGATA" scene check --sea swell_period=9,swell=2,wind=12
refused 64 '^mangata: --sea seed=8: there is no wind and no swell' --sea seed=8
refused 64 '^mangata: --sea wind=20,fetch=500: fetch is 500 m, too short' --sea wind=20,fetch=500
refused 65 '^--set water.waves=.*: water.waves stands beside water.wind' --sea wind=8 --set 'water.waves=[{amplitude: 1, a: 1, b: 1, c: 1}]'
refused 65 '^--set water.wind=8: water.wind stands beside water.waves of the file' "$simple" --set water.wind=8
printf 'mangata: 1\nwater:\n  wind: 8\n  spectrum: {model: jonswap}\n' >both.yaml
refused 65 '^both.yaml:4:3: water.spectrum stands beside water.wind, which replaces it; allowed: one of them' both.yaml
refused 64 '^mangata: --sea wind=8,swell=99: swell is "99"; allowed: a number, 0.001 to 50 m' --sea wind=8,swell=99
printf 'mangata: 1\nwater: {waves: [{wavelength: 4, height: 1, b: 2}]}\n' >forms.yaml
refused 65 '^forms.yaml:2:44: water.waves.0..b stands beside wavelength, which is of another form' forms.yaml
printf 'mangata: 1\nwater: {wind: light}\n' >light.yaml
refused 65 '^light.yaml:2:15: water.wind is light; allowed: a number, 0 or 0.5 to 75 m/s, or a mapping' light.yaml
no_temporaries .
finish
