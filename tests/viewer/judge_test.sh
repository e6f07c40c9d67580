# SPDX-License-Identifier: MIT
# The judge's figures are those of `mangata diff` against references of the command, and begin anew when something moves.
. "$CHECK"

scene=$SOURCE/scenes/smooth.json
samples=128
[[ -z ${SANITIZED:-} ]] || samples=4
drive "$scene" --size 144x96 <<END
set panel.shown off
wipe none mangata 0.5
judge 2
# moved: the figures of before are gone
set light.elevation_deg 40
judge 4
set light.elevation_deg 35
revert
judge $samples
screenshot judged.png
set panel.judge off
screenshot plain.png
END
tee judged.txt <stdout.txt
differ judged.png plain.png
[[ -z ${SANITIZED:-} ]] || finish
works render "$scene" -o truth-%d.png --frames 0-1 --size 144x96 --method reference --spatial 8 --time-samples 4 --quiet
for side in A:none B:mangata; do
    method=${side#*:}
    works render "$scene" -o "$method-%d.png" --frames 0-1 --size 144x96 --method "$method" --quiet
    "$MANGATA" diff "$method-%d.png" truth-%d.png --frames 0 --metrics rmse,flip >still.txt
    "$MANGATA" diff "$method-%d.png" truth-%d.png --frames 0-1 --metrics flicker >steps.txt
    awk -v side="${side%:*}" '
        FILENAME != "judged.txt" { if (!($1 in told)) told[$1] = $2; next }
        $1 == "judge" && $2 == side ":" { gsub(",", ""); error = $4; flip = $6; flicker = $8 }
        function off(name, own) { d = own / told[name] - 1; printf "%s %s: %s, diff says %s\n", side, name, own, told[name]; return d < -0.15 || d > 0.15 }
        END { exit off("rmse", error) + off("flip", flip) + off("flicker", flicker) > 0 }' still.txt steps.txt judged.txt || fail "the judge and diff differ on side $side"
done
finish
