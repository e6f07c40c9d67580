# SPDX-License-Identifier: MIT
# A session: open, change, compare, look into a pixel, record a path, save, break the scene file and mend it, close.
# And how it ends when it cannot begin.
. "$CHECK"

# ---- no beginning ----
expect 69 'no window can be opened: ' env -u DISPLAY -u WAYLAND_DISPLAY "$MANGATA" view "$simple"
printf 'mangata: 1\nlight:\n  elevation_deg: steep\n' >bad.yaml
expect 65 '^bad.yaml:3:18: ' view bad.yaml
expect 66 'missing.yaml: ' view missing.yaml
expect 64 '--sea wind=gale: wind is "gale"' view --sea wind=gale
expect 66 'missing.txt' view "$simple" --script missing.txt
expect 64 '--backend cuda: allowed is auto, cpu or gl' view "$simple" --backend cuda
echo 'no-such-command' >unknown.txt
expect 1 '^unknown.txt:1: unknown command no-such-command$' view "$simple" --backend cpu --quiet --script unknown.txt
printf 'frames 2\n\n# a comment\nset light.elevation_deg high\n' >refused.txt
expect 1 '^refused.txt:4: .*light.elevation_deg' view "$simple" --backend cpu --quiet --script refused.txt
echo 'set view.compare both' >both.txt
expect 1 ':1: .*allowed is one of off, wipe, difference' view "$simple" --backend cpu --quiet --script both.txt

# ---- a session ----
cp "$SOURCE/scenes/sunset.json" scene.json
sed 's/"elevation_deg": 7/"elevation_deg": 700/' scene.json >broken.json
sed 's/"elevation_deg": 7/"elevation_deg": 12/' scene.json >mended.json
drive scene.json --size 1024x600 <<'END'
set view.resolution full
screenshot open.png
mark
# a slider under the pointer, a camera by drag, keys and wheel
drag 740 219 860 219
expect-change
set light.elevation_deg 7
pointer 5 5
expect-same
drag 200 300 260 320
expect-change
press r
expect-same
drag 300 300 330 290 right
expect-change
press r
hold w 5
expect-change
press r
scroll 300 300 2
expect-change
press r
expect-same
scroll 300 300 4 ctrl
expect-change
press r
expect-same
# the panel hides and comes back
press tab
screenshot whole.png
press tab
expect-same
# two methods side by side
set a.method none
screenshot a.png
set a.method podee-pixel
screenshot b.png
wipe none podee-pixel 0.4
screenshot wiped.png
drag 282 300 500 300
expect-change
# a slider over the divider moves alone
wipe none podee-pixel 0.5
drag 353 570 300 570
expect-value view.wipe 0.5
pointer 500 300
set clock.time 10
set view.compare difference
screenshot difference.png
set view.compare off
set a.method mangata
expect-same
# clock
press .
expect-value clock.time 10.033333333333333
press space
frames 4
press space
expect-change
set clock.time 10
expect-same
# one pixel
inspect 350 400
press i
# keyframes, a path
set camera.position [0, 6, 0]
press k
set clock.time 11
set camera.position [3, 5, 1]
press k
press p
set clock.time 10.5
screenshot path.png
set view.layer color
save-scene saved.yaml
expect-refused light.elevation_deg 200
set water.waves[3].wavelength 5
expect-value water.waves[3].wavelength 5
undo
command
picture viewer.png
picture small.png 320x180
picture layers.exr 160x90
revert
set clock.time 10
expect-same
# the scene file breaks and is mended
copy broken.json scene.json
wait-reload
expect-error scene.json:
expect-error elevation_deg
screenshot broken.png
copy mended.json scene.json
wait-reload
expect-no-error
expect-value light.elevation_deg 12
expect-change
quit
END
lively open.png whole.png a.png b.png wiped.png path.png broken.png viewer.png small.png
"$WINDOW_CHECK" size whole.png 1024x600 || fail "the screenshot has another size"
"$WINDOW_CHECK" size small.png 320x180 || fail "the picture has another size"
"$WINDOW_CHECK" wipe wiped.png a.png b.png 0.4 707 >wipe.txt || fail "the wipe: $(cat wipe.txt)"
differ open.png broken.png

# The command gives the frame, and the saved scene gives the path, to the bit.
grep '^mangata render ' stdout.txt >command.txt || fail "no command: $(cat stdout.txt)"
cp "$SOURCE/scenes/sunset.json" scene.json
PATH=$(dirname "$MANGATA"):$PATH bash -e command.txt 2>stderr.txt || fail "the command fails: $(cat stderr.txt)"
expect 0 '' "$MANGATA" diff --max-rmse 0 frame.png viewer.png
exists frame.png layers.exr saved.yaml
expect 0 '' "$MANGATA" scene check saved.yaml
grep -q 'path:' saved.yaml || fail "the saved scene has no path"
works render saved.yaml -o saved.png --frames 15 --quiet --size 707x600
expect 0 '' "$MANGATA" diff --max-rmse 0 saved.png viewer.png

# A view off the path is in no saved scene, and a word tells so.
# A picture that is wider than textures is shown with fewer pixels.
printf '%s\n' 'press k' 'save-scene free.yaml' 'set view.resolution full' 'set image.width 20000' 'set image.height 16' 'set view.frame scene' settle >free.txt
works view scene.json --size 320x200 --backend cpu --script free.txt
grep -q '^saved free.yaml; its camera follows the path' stderr.txt || fail "no word on the view: $(cat stderr.txt)"

# Letters are those on the keys: on a German keyboard Z lies where a US keyboard has Y.
coproc keyboard { exec "$SOURCE/tests/viewer/press_label.py" de 29; }
answers=${keyboard[0]:-}
if [[ -n $answers ]] && read -r _ <&"$answers"; then
    mkfifo keys
    view scene.json --size 320x200 --backend cpu --quiet --script keys 2>stderr.txt &
    exec 5<>keys
    printf '%s\n' 'set light.elevation_deg 33' 'screenshot ready.png' >&5
    for ((i = 0; i < 1200 && $(stat -c %s ready.png 2>/dev/null || echo 0) == 0; i++)); do sleep 0.05; done
    echo >&"${keyboard[1]}"
    read -r _ <&"$answers"
    printf '%s\n' 'frames 5' 'expect-value light.elevation_deg 7' quit >&5
    exec 5>&-
    wait $! || fail "the key labelled Z: $(cat stderr.txt)"
else
    echo "NOTICE: no keyboard of another layout; labels of keys are not tested"
fi
finish
