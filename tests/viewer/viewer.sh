# SPDX-License-Identifier: MIT
# Sourced by every test of the viewer: a virtual screen, and words to drive the viewer in it.
# In: MANGATA, WINDOW_CHECK, SOURCE, COMMON (tests/command/common.sh); KEEP_LOADED where leaks are looked for.
. "$COMMON"

if ! command -v Xvfb >/dev/null; then
    echo "NOTICE: no Xvfb; the viewer is not tested"
    exit 77
fi
# A display of a free number, for this test alone.
Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3>display.txt >xvfb.txt 2>&1 &
screen=$!
trap 'kill "$screen"; wait "$screen"; rm -rf "$work"' EXIT
for ((i = 0; i < 100; i++)); do
    [[ ! -s display.txt ]] || break
    sleep 0.1
done
if [[ ! -s display.txt ]]; then
    fail "Xvfb does not start: $(tail -n 3 xvfb.txt)"
    finish
fi

# Software rendering that looks the same everywhere.
view() {
    env XDG_STATE_HOME="$PWD/state" DISPLAY=":$(<display.txt)" LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=llvmpipe ${KEEP_LOADED:+LD_PRELOAD="$KEEP_LOADED"} "$MANGATA" view "$@"
}

# drive SCENE [OPTION…] <script: must end well; what the script prints is in stdout.txt.
drive() {
    cat >script.txt
    view "$@" --backend cpu --quiet --script script.txt >stdout.txt 2>stderr.txt </dev/null
    local result=$?
    ((result == 0)) || fail "exit code $result: $(head -c 600 stderr.txt)"
}

# lively FILE…
lively() {
    local file
    for file; do "$WINDOW_CHECK" lively "$file" >lively.txt || fail "$file shows nothing: $(cat lively.txt)"; done
}
