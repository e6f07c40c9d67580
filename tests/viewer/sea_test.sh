# SPDX-License-Identifier: MIT
# Seas and objects: the plot's handles are dragged, a wind becomes single waves, objects move; what is shown, the command and the saved scene agree to the bit.
. "$CHECK"

drive --size 1280x720 <<'END'
set view.resolution quarter
page 2
expect-value water.wind.speed 8
mark
# the wind's handle: a drag is one step
drag 1216 474 1180 454
expect-refused water.wind.speed 200
expect-change
undo
expect-value water.wind.speed 8
expect-value water.amplitude 1
expect-same
# a handle of a swell
set water.swell [{height: 2, period: 12, count: 20}]
frames 2
drag 1239 446 1215 464
expect-change
undo
expect-value water.swell[0].period 12
# no such sea: the reason stands over the picture, the former sea stays
set water.wind.count 2048
frames 2
expect-error water
undo
frames 2
expect-no-error
set water.wind.speed 11
set water.choppiness 0
set camera.position [0, 4, 0]
set view.resolution full
picture wind.png 320x180
command
save-scene wind.yaml
# the button "waves": the same picture of single waves
set view.resolution quarter
drag 1021 171 1021 171
set water.waves[0].phase 1
undo
picture waves.png 320x180
END
lively wind.png
expect 0 '' "$MANGATA" diff --max-rmse 0 wind.png waves.png
expect 0 '' "$MANGATA" scene check wind.yaml
works render wind.yaml -o saved.png --quiet --size 320x180
expect 0 '' "$MANGATA" diff --max-rmse 0 saved.png wind.png

cat >box.yaml <<'END'
mangata: 1
image: {width: 320, height: 180}
camera: {position: [0, 3, 4], target: [0, 0, -2]}
light: {elevation_deg: 40}
objects: [{name: box, shape: box, size: [1, 1, 1], position: [0, 0.2, -2]}]
water: {waves: [{amplitude: 0.05, a: 1.5, b: 0.7, c: -4}]}
END
drive box.yaml --size 900x500 <<'END'
set view.resolution half
mark
set objects[0].position [0.5, 0.4, -2]
expect-change
undo
expect-same
redo
expect-change
set objects[0].material.base_color [0.8, 0.1, 0.1]
set objects[0].scale [1, 2, 1]
picture box.png 320x180
save-scene moved.yaml
END
works render moved.yaml -o moved.png --quiet --size 320x180
expect 0 '' "$MANGATA" diff --max-rmse 0 moved.png box.png
finish
