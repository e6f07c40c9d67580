# SPDX-License-Identifier: MIT
# mangata waves: scenes from spectra, their statistics, and what it says to nonsense.
source "$CHECK"

waves() { "$MANGATA" waves "$@"; }
check() { "$MANGATA" scene check "$@"; }
buoy=$SOURCE/tests/data/scenes/buoy.txt

# near VALUE EXPECTED SHARE: numbers that agree
near() { awk -v a="$1" -v b="$2" -v s="$3" 'BEGIN { d = a - b; exit !(d * d <= s * s * b * b) }' || fail "$1 is not $2 within $3"; }

# ---- scenes ----
works waves -q -o pm.yaml --spectrum pierson-moskowitz --wind 10 -n 100
works waves -q -o jonswap.yaml --spectrum jonswap --wind 8 --fetch 50000 --directions mitsuyasu --seed 4
works waves -q -o tma.yaml --spectrum tma --wind 12 --fetch 30000 --depth 6 --direction 90 --gamma 2.2 --slope cox-munk --shortest 0.1
works waves -q -o buoy.yaml --buoy "$buoy" -n 32
works waves -q -o deep.yml --spectrum tma --depth 9000 -n 2048
works waves -q -o unified.yaml --spectrum elfouhaily --wind 10 --fetch 200000
for scene in pm jonswap tma buoy unified; do
    expect 0 '' check "$scene.yaml"
    works render "$scene.yaml" -o "$scene.png" -q "${small[@]}" --frames 0
done
expect 0 '' check deep.yml
grep -q '2048 waves' stdout.txt || fail "deep.yml: $(cat stdout.txt)"
same <(waves -q --wind 9 --seed 3) <(waves -q --wind 9 --seed 3)
differ <(waves -q --wind 9 --seed 3) <(waves -q --wind 9 --seed 4)

# The height and the slope of the written waves, by another program: 0.2092 U²/g; ω² = g k tanh(k d).
sums() { # FILE DEPTH
    sed -n 's/^ *- {amplitude: \([^,]*\), a: \([^,]*\), b: \([^,]*\), c: \([^,]*\), phase: .*/\1 \2 \3 \4/p' "$1" | awk -v d="$2" '
        function tanh(x) { return x > 20 ? 1 : (exp(2 * x) - 1) / (exp(2 * x) + 1) }
        { k = sqrt($2 ^ 2 + $3 ^ 2); m += $1 ^ 2 / 2; s += $1 ^ 2 / 2 * k * k; r = $4 ^ 2 / (9.80665 * k * (d ? tanh(k * d) : 1)) - 1
          worst = r * r > worst ? r * r : worst; back += $4 >= 0 }
        END { printf "%d %.6g %.6g %.3g %d\n", NR, 4 * sqrt(m), s, sqrt(worst), back }'
}
read -r count height slope worst back < <(sums pm.yaml 0)
[[ $count == 100 && $back == 0 ]] || fail "pm.yaml: $count waves, $back with c not below 0"
near "$height" 2.1336 0.001
awk -v w="$worst" 'BEGIN { exit !(w < 1e-5) }' || fail "dispersion is off by $worst"
read -r count height slope worst back < <(sums tma.yaml 6)
awk -v w="$worst" 'BEGIN { exit !(w < 1e-5) }' || fail "dispersion in 6 m is off by $worst"
near "$slope" "$(awk 'BEGIN { print 0.003 + 0.00512 * 12 * 1.0201 }')" 0.001

# ---- statistics ----
waves --json --spectrum pierson-moskowitz --wind 10 -n 100 >pm.json
value() { "$JSON_GET" "$2" <"$1"; }
near "$(value pm.json significant_wave_height.waves)" 2.1336 0.001
near "$(value pm.json significant_wave_height.closed_form)" 2.1336 0.001
near "$(value pm.json mean_square_slope.waves)" "$(value pm.json mean_square_slope.closed_form)" 0.001
near "$(value pm.json mean_square_slope_upwind.waves)" "$(value pm.json mean_square_slope_upwind.spectrum)" 0.05
near "$(value pm.json peak_period)" 7.30 0.005
waves --json --wind 7 --slope cox-munk --wind-height 12.5 >clean.json
near "$(value clean.json mean_square_slope.waves)" 0.03884 0.001
near "$(value clean.json mean_square_slope.cox_munk)" 0.03884 0.001
# The table by trapezia, in another program: sorted by hand, gaps above 90 degrees left out.
waves --json --buoy "$buoy" >buoy.json
expected=$(awk '!/^[#f]/ && NF { if ($1 != f) { if (n) row(); f = $1; n = 0 } t[n] = $2 % 360; e[n++] = $3 }
    function row(  i, j, x, s, g) {
        for (i = 1; i < n; i++) for (j = i; j > 0 && t[j - 1] > t[j]; j--) { x = t[j]; t[j] = t[j - 1]; t[j - 1] = x; x = e[j]; e[j] = e[j - 1]; e[j - 1] = x }
        for (i = s = 0; i < n; i++) { j = (i + 1) % n; g = (t[j] - t[i] + 360) % 360; if (g <= 90) s += g * (e[i] + e[j]) / 2 }
        if (seen++) m += (f - last) * (s + before) / 2
        before = s; last = f }
    END { row(); print 4 * sqrt(m) }' "$buoy")
near "$(value buoy.json significant_wave_height.waves)" "$expected" 0.0005

# ---- buoys' files as they are published ----
mkdir ndbc
row() { printf '#YY  MM DD hh mm %s\n2026 01 31 12 40 %s\n' "$2" "$3" >"ndbc/46042.$1"; }
row data_spec 'Sep_Freq  < spec_1 (freq_1) ... >' '0.117 0.500 (0.033) 8.000 (0.070) 2.000 (0.100) 0.250 (0.200)'
row swdir 'alpha1_1 (freq_1) ... >' '999.0 (0.033) 290.0 (0.070) 310.0 (0.100) 20.0 (0.200)'
row swdir2 'alpha2_1 (freq_1) ... >' '999.0 (0.033) 292.0 (0.070) 300.0 (0.100) 40.0 (0.200)'
row swr1 'r1_1 (freq_1) ... >' '999.00 (0.033) 0.90 (0.070) 0.60 (0.100) 0.30 (0.200)'
expect 66 'ndbc/46042.swr2: No such file' waves -q -o ndbc.yaml --buoy ndbc/46042.data_spec
row swr2 'r2_1 (freq_1) ... >' '999.00 (0.033) 0.40 (0.070) 0.20 (0.100) MM (0.200)'
waves --json --buoy ndbc/46042.data_spec --shortest 0.05 >ndbc.json
near "$(value ndbc.json from_deg)" 294 0.02
waves --json --buoy ndbc/46042.data_spec >ndbc.json
near "$(value ndbc.json significant_wave_height.waves)" "$(awk 'BEGIN { print 4 * sqrt(8.5 / 2 * .037 + 10 / 2 * .03 + 2.25 / 2 * .1) }')" 0.001
printf '%s\r\n' 17 231 7.1 4.5E+0 10 8.5 7 0 0 0 40 60 '0.080,1.000E+00,90.0,20.0,0.1,2.0' '0.180,4.000E-01,90.0,30.0,0.1,2.0' >buoy.spt
waves --json --buoy buoy.spt >spt.json
near "$(value spt.json significant_wave_height.waves)" "$(awk 'BEGIN { print 4 * sqrt(6.3 / 2 * .1) }')" 0.001
near "$(value spt.json from_deg)" 90 0.01
echo 'mangata: 1
water: {spectrum: {model: buoy, file: buoy.spt}}' >spt.yaml
expect 0 '' check spt.yaml

# ---- bases, and spectra that stay spectra ----
works waves -q -o moon.yaml --base "$SOURCE/scenes/moonlit.json" --set image.width=64 --set image.height=36 --wind 5
grep -q 'body: moon' moon.yaml || fail "moon.yaml has no moon"
! grep -q 'spectrum:' moon.yaml || fail "moon.yaml has a spectrum"
works waves -q -o key.yaml --base "$SOURCE/scenes/moonlit.json" --set image.width=64 --set image.height=36 --wind 5 --as-spectrum
grep -q 'spectrum: {model: jonswap, wind: 5' key.yaml || fail "key.yaml has no spectrum"
works render moon.yaml -o moon.png -q --frames 0
works render key.yaml -o key.png -q --frames 0
same moon.png key.png # the same waves, and the same render hash
works render key.yaml -o other.png -q --frames 0 --set water.spectrum.seed=2
differ other.png key.png
cp -r "$SOURCE/scenes/models" models
cp "$SOURCE/scenes/hull.yaml" hull.yaml
mkdir folder
works waves -q -o folder/hull.yaml --base hull.yaml
expect 0 '' check folder/hull.yaml
works waves -q -o hull2.yaml --base hull.yaml
grep -q 'mesh: "models/hull.ply"' hull2.yaml || fail "beside its base a scene keeps its paths: $(grep mesh hull2.yaml)"
"$MANGATA" waves -q --base hull.yaml >folder/piped.yaml || fail "a scene to a pipe"
(cd folder && "$MANGATA" waves -q --base ../hull.yaml >../piped.yaml && "$MANGATA" waves -q --base ../hull.yaml -o hull3.yaml) || fail "from another folder"
for scene in folder/piped piped folder/hull3; do
    expect 0 '' check $scene.yaml
done
printf 'mangata: 1\nlight: {body: moon}\nwater: {wind: 12}\n' >night.yaml
works waves -q -o night_sea.yaml --base night.yaml
for key in aerial stars night_tint; do
    grep -q "$key: on" night_sea.yaml || fail "night_sea.yaml has no $key"
done
cp "$buoy" near.txt
works waves -q -o folder/table.yaml --buoy near.txt --as-spectrum -n 20
expect 0 '' check folder/table.yaml
cp near.txt folder/beside.txt
printf 'mangata: 1\nwater: {spectrum: {model: buoy, file: beside.txt}}\n' >folder/beside.yaml
expect 0 '' check folder/beside.yaml
expect 65 'count is 9999; allowed: a whole number, 1 to 2048' check folder/beside.yaml --set water.spectrum.count=9999

# ---- the scenes of the repository ----
for scene in breeze gale lagoon; do
    expect 0 '' check "$SOURCE/scenes/$scene.yaml"
    works render "$SOURCE/scenes/$scene.yaml" -o "$scene.png" -q "${small[@]}" --frames 0
done

# ---- the examples of the documentation ----
for page in waves choppy; do
    awk '/^```yaml/ { on = 1; next } /^```/ && on { exit } on' "$SOURCE/docs/$page.md" >$page.yaml
    expect 0 '' check $page.yaml
done
awk '/^# comments/ { on = 1 } /^```/ { on = 0 } on' "$SOURCE/docs/waves.md" >example.txt
works waves -q -o example.yaml --buoy example.txt

# ---- nonsense ----
expect 64 '--wind -3: allowed is a number, 0.5 to 75 m/s' waves --wind -3
expect 64 '--wind 0: allowed' waves --wind 0
expect 64 '--wind nan: allowed' waves --wind nan
expect 64 '--wind 400: allowed' waves --wind 400
expect 64 '--wind fresh: allowed' waves --wind fresh
expect 64 '--fetch -1: allowed is a number, 100 to 1e7 m' waves --fetch -1
expect 64 '--depth -2: allowed is a number, 0 to 12000 m' waves --depth=-2
expect 64 '--count 0: allowed is a whole number, 1 to 2048' waves -n 0
expect 64 '--count 100000: allowed' waves -n 100000
expect 64 '--count 1.5: allowed' waves -n 1.5
expect 64 '--seed -1: allowed' waves --seed -1
expect 64 '--spectrum phillips: allowed is pierson-moskowitz, jonswap, tma, elfouhaily or buoy' waves --spectrum phillips
expect 64 '--spectrum none: allowed' waves --spectrum none
expect 64 '--directions sideways: allowed is one of mitsuyasu' waves --directions sideways
expect 64 '--spectrum tma needs --depth' waves --spectrum tma --wind 8
expect 64 '--spectrum buoy needs --buoy FILE' waves --spectrum buoy
expect 64 '--buoy is for --spectrum buoy' waves --spectrum jonswap --buoy "$buoy"
expect 64 'ends in .yaml or .yml' waves -o sea.png
works waves --wind 8 -n 8 -q -o CAPITALS.YAML
expect 0 '' waves --wind 8 -n 8 -q -o -
same stdout.txt CAPITALS.YAML
[[ ! -e ./- ]] || fail "waves -o - has written a file"
expect 64 'takes options alone' waves pm.yaml
expect 64 '--shortest 5e-5: allowed is a number, 0 or 0.0001 to 1000 m' waves --shortest 5e-5
expect 64 '--shortest 1e-9: allowed' waves --shortest 1e-9
expect 64 '--wind-height 1.5e-4: allowed is a number, 0 or 0.5 to 200 m' waves --wind-height 1.5e-4
expect 65 '--shortest leaves no room between the shortest wave, 900 m' waves --shortest 900
expect 65 '--fetch is 500 m, too short for the spectrum in this wind; allowed: at least 2365 m' waves --spectrum elfouhaily --wind 20 --fetch 500
unused() { # OPTION TAKERS LINE…: an option that the spectrum does not take
    expect 64 "^mangata: --$1: it is for $2 alone" waves "${@:3}"
}
unused directions 'pierson-moskowitz, jonswap and tma' --spectrum elfouhaily --directions mitsuyasu
unused directions 'pierson-moskowitz, jonswap and tma' --buoy "$buoy" --directions fixed
unused spread 'pierson-moskowitz, jonswap and tma' --spectrum elfouhaily --spread 5
unused spread '--directions fixed' --wind 8 --spread 5
unused spread '--directions fixed' --wind 8 --directions mitsuyasu --spread 5
unused gamma 'jonswap and tma' --spectrum elfouhaily --gamma 2
unused gamma 'jonswap and tma' --spectrum pierson-moskowitz --wind 8 --gamma 2
unused fetch 'jonswap, tma and elfouhaily' --spectrum pierson-moskowitz --wind 8 --fetch 5000
unused fetch 'jonswap, tma and elfouhaily' --buoy "$buoy" --fetch 5000
unused wind 'the spectra of a wind, or for --slope cox-munk,' --buoy "$buoy" --wind 5
unused wind-height 'the spectra of a wind, or for --slope cox-munk,' --buoy "$buoy" --wind-height 5
unused direction 'the spectra of a wind' --buoy "$buoy" --direction 5
works waves -q -o bent.yaml --buoy "$buoy" --wind 5 --slope cox-munk
for key in wind=5 'waves[0].amplitude=1' 'sea={wind: 3}' swell.height=1 'spectrum={model: jonswap}'; do
    expect 64 "^mangata: --set water.${key%%[^a-z]*}: the waves are those of --wind" waves --wind 8 --set "water.$key"
    expect 64 "^mangata: --set water.${key%%[^a-z]*}: the waves are those of --wind" waves --base "$SOURCE/scenes/gale.yaml" --set "water.$key"
done
expect 64 '--set water: one key of it at a time' waves --set 'water={wind: 5}'
works waves -q -o calmer.yaml --wind 8 --set water.choppiness=0.3

# The description tells of the new waves.
works waves -q -o gale.yaml --wind 8 --base "$SOURCE/scenes/gale.yaml"
grep -q '^description: "a JONSWAP sea, wind 8 m/s' gale.yaml || fail "gale.yaml: $(grep ^description gale.yaml)"
works waves -q -o told.yaml --wind 8 --base "$SOURCE/scenes/gale.yaml" --set 'description=less of a gale'
grep -q '^description: "less of a gale"' told.yaml || fail "told.yaml: $(grep ^description told.yaml)"
expect 65 '--slope cannot be cox-munk' waves --wind 0.5 --fetch 100 --shortest 0.01 --slope cox-munk
expect 66 'no-such.txt: No such file' waves --buoy no-such.txt
expect 66 'no-such.yaml: No such file' waves --base no-such.yaml
expect 65 'water.amplitude is 900, which makes a wave of' waves --base night.yaml --set water.amplitude=900 --wind 40 --fetch 1e6 -n 1
: >empty.txt
expect 65 'empty.txt:1:1: the table holds no rows; allowed: lines of frequency' waves --buoy empty.txt
printf '0.1 0 1\n0.1 10 much\n' >word.txt
expect 65 'word.txt:2:8: density is much; allowed' waves --buoy word.txt
expect 73 'pm.yaml.*--overwrite replaces it' waves -q -o pm.yaml
works waves -q -o pm.yaml --overwrite
expect 73 'no-folder' waves -q -o no-folder/pm.yaml
expect 0 'fully developed' waves --wind 3 --fetch 1e6
if [[ -w /dev/full ]]; then
    waves -q >/dev/full 2>stderr.txt
    (($? == 73)) || fail "a full standard output is no error"
fi
no_temporaries .
finish
