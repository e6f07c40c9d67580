# SPDX-License-Identifier: MIT
# OpenGL on the window's own context: the same pictures as the CPU's, kernel files read again as they change, and errors that name their line.
. "$CHECK"

scene=$SOURCE/scenes/smooth.json
gl() { # as drive, by OpenGL
    cat >script.txt
    view "$@" --backend gl --quiet --script script.txt >stdout.txt 2>stderr.txt </dev/null
}
echo quit | gl "$scene" --size 240x150
case $? in
    0) ;;
    69)
        echo "NOTICE: no OpenGL 4.5 here: $(cat stderr.txt)"
        exit 77
        ;;
    *) fail "OpenGL does not start: $(head -c 600 stderr.txt)" ;;
esac

cat >common.txt <<'END'
set panel.shown off
set view.resolution full
screenshot X-color.png
set a.method podee-pixel
screenshot X-podee.png
set a.method mangata
set view.layer coverage
screenshot X-coverage.png
set view.layer normal
screenshot X-normal.png
set view.layer color
wipe none mangata 0.5
screenshot X-wipe.png
set view.compare off
END
{ sed 's/X-/cpu-/' common.txt; echo quit; } | drive "$scene" --size 240x150
mkdir -p kernels/display
cp "$SOURCE/src/kernels/display/tone.k" kernels/display/tone.k
sed '0,/^KERNEL/s//KERNEL nonsense;\nKERNEL/' kernels/display/tone.k >broken.k
sed 's/^KERNEL vec3 display_color/KERNEL vec3 unused_color(CTX cx, vec3 c) { return c; }\n&/' kernels/display/tone.k >other.k
{
    sed 's/X-/gl-/' common.txt
    cat <<'END'
mark
copy broken.k kernels/display/tone.k
frames 10
expect-error tone.k:
screenshot banner.png
copy other.k kernels/display/tone.k
frames 10
expect-no-error
expect-same
lose-renderer
set a.method mangata
set view.compare off
screenshot lost.png
random 20 5 image.
quit
END
} | gl "$scene" --size 240x150 --shaders kernels || fail "exit code: $(head -c 600 stderr.txt)"
for name in color podee coverage normal wipe; do
    expect 0 '' "$MANGATA" diff --max-rmse 0.01 gl-$name.png cpu-$name.png
done
differ banner.png gl-color.png
same lost.png cpu-color.png

# An OpenGL that gives up on the first frame, here as it knows no GLSL 4.50: the CPU draws it.
printf '%s\n' 'set panel.shown off' 'set view.resolution full' 'screenshot first.png' quit |
    MESA_GL_VERSION_OVERRIDE=4.5 MESA_GLSL_VERSION_OVERRIDE=430 gl "$scene" --size 240x150 || fail "exit code: $(head -c 600 stderr.txt)"
expect 0 '' "$MANGATA" diff --max-rmse 0.01 first.png cpu-color.png
finish
