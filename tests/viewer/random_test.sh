# SPDX-License-Identifier: MIT
# Hundreds of changes by chance: no OpenGL error, no crash, and memory that does not grow. OpenGL's error flag is read after every frame.
. "$CHECK"

# A frame that is being drawn has memory of its own, so the clock stops and the frame ends before memory is read. The size of the picture stays, so that
# memory may. Tables are made once and kept: lean's map, 246 MiB, and those of podee, 64 MiB, are made before memory is counted.
again=$'random 150 2 image.\nrandom 200 3 image.'
[[ -z ${SANITIZED:-} ]] || again= # memory is not compared there
drive "$SOURCE/scenes/smooth.json" --size 480x300 <<END
set a.method lean
settle
set a.method podee-uniform
set a.kernels 5
settle
set a.kernels 1
settle
random 150 1 image.
random 150 2 image.
random 200 3 image.
set clock.play off
settle
memory
$again
set clock.play off
settle
memory
# and back to a picture
set a.method mangata
set view.compare off
set view.layer color
revert
settle
expect-no-error
screenshot end.png
quit
END
mapfile -t memory < <(sed -n 's/^memory \([0-9]*\) kB$/\1/p' stdout.txt)
echo "memory: ${memory[*]} kB"
((${#memory[@]} == 2)) || fail "memory was not printed twice: $(head -c 300 stdout.txt)"
[[ -n ${SANITIZED:-} ]] || ((memory[1] <= memory[0] + 40000)) || fail "memory grew from ${memory[0]} to ${memory[1]} kB"
"$WINDOW_CHECK" size end.png 480x300 || fail "the window has another size"
finish
