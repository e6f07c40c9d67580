# SPDX-License-Identifier: MIT
# Orbits turn by at most 0.3 degrees a pixel at constant distance, and the point of water grabbed in a pan stays under the pointer. Prints both figures.
. "$CHECK"

drive "$SOURCE/scenes/sunset.json" --size 1024x600 <<'END'
mark-camera
drag 200 300 300 300
expect-orbit 100 0.3
press r
mark-camera
drag 200 300 200 240
expect-orbit 60 0.3
press r
# as low as it goes: not into the water
mark-camera
drag 200 300 200 200
expect-orbit 100 0.3
press r
mark-point 300 420
drag 300 420 420 330 middle
expect-point 420 330 2
# what is seen there now is that point
mark-point 420 330
expect-point 420 330 2
press r
# from near to far
mark-point 200 540
drag 200 540 100 320 middle
expect-point 100 320 2
press r
# a pull beyond the horizon stops before it
drag 200 400 200 100 middle
mark-point 300 500
expect-no-error
END
cat stdout.txt
# A camera under water orbits as well.
drive "$SOURCE/scenes/diver.yaml" --size 640x360 --set 'objects=[]' <<'END'
mark-camera
drag 200 100 260 130
expect-orbit 67 0.3
END
# Without a scene there is a sea.
drive --size 320x200 <<<'screenshot sea.png'
lively sea.png
finish
