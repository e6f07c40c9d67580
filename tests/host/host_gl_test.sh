# SPDX-License-Identifier: MIT
# host_gl_test.sh HOST_GL MANGATA: the example as a command: its files, its exit codes, its window. Exit 77, which ctest counts as skipped, where
# there is no OpenGL 4.5 without a window.
set -euo pipefail
host=$1 mangata=$2
. "${BASH_SOURCE%/*}/../screen.sh"
work=$(mktemp -d)
trap '[[ -z ${screen:-} ]] || kill "$screen"; rm -rf "$work"' EXIT
cd "$work"

die() {
    echo "FAIL: $*"
    exit 1
}

for wrong in "--depth sideways" "--size 0x9" "--size nine" "--frames 0" "--headless" "out.png"; do
    "$host" $wrong 2>message && code=0 || code=$?
    ((code == 64)) && grep -q '^usage:' message || die "'$wrong' ends with $code: $(cat message)"
done

for depth in standard reversed infinite-reversed; do
    "$host" --headless $depth.png --frames 2 --depth $depth --size 320x180 2>message && code=0 || code=$?
    cat message
    ((code != 69)) || exit 77
    ((code == 0)) || die "--depth $depth ends with $code"
done
for depth in reversed infinite-reversed; do
    "$mangata" diff standard.png $depth.png --max-rmse 0.01 >diff.txt || die "$depth.png is another picture: $(cat diff.txt)"
done
"$host" --headless no/such/folder.png --size 32x32 2>/dev/null && die "a file that cannot be written is no failure"

# No driver: one line that says what is missing.
__EGL_VENDOR_LIBRARY_DIRS=$work/none "$host" --headless none.png 2>message && code=0 || code=$?
((code == 69)) && (($(wc -l <message) == 1)) || die "without a driver it ends with $code: $(cat message)"

# A window that stays open until it is closed.
ldd "$host" >libraries
if ! grep -q libglfw libraries; then
    echo "built without GLFW: no window"
elif ! command -v Xvfb >/dev/null; then
    echo "Xvfb is not installed: the window is not tested"
else
    start_screen 800x600 . || die "Xvfb does not start: $(tail -n 3 xvfb.txt)"
    timeout 5 "$host" --size 320x180 2>message && code=0 || code=$?
    ((code == 124)) || die "the window ends with $code: $(cat message)"
fi
