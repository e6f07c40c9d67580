# SPDX-License-Identifier: MIT
# Sourced by every test of the viewer: a virtual screen, and words to drive the viewer in it.
# In: MANGATA, WINDOW_CHECK, SOURCE, COMMON (tests/command/common.sh); KEEP_LOADED where leaks are looked for.
. "$COMMON"
. "$SOURCE/tests/screen.sh"

if ! command -v Xvfb >/dev/null; then
    echo "NOTICE: no Xvfb; the viewer is not tested"
    exit 77
fi
trap 'kill "$screen"; wait "$screen"; rm -rf "$work"' EXIT
if ! start_screen 1280x800 .; then
    fail "Xvfb does not start: $(tail -n 3 xvfb.txt)"
    finish
fi

# The viewer, with its state in the test's folder.
view() {
    env XDG_STATE_HOME="$PWD/state" ${KEEP_LOADED:+LD_PRELOAD="$KEEP_LOADED"} "$MANGATA" view "$@"
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
