# SPDX-License-Identifier: MIT
# Sourced by tests and scripts that need a screen: Mesa's software rendering, which looks the same everywhere, in a virtual X server.

# start_screen SIZE FOLDER: starts a server with a screen of SIZE under a number that is free. Sets DISPLAY and screen, the server's process, which
# the caller ends. False where it does not start: FOLDER/xvfb.txt says why.
start_screen() {
    Xvfb -displayfd 3 -screen 0 "$1x24" -nolisten tcp 3>"$2/display.txt" >"$2/xvfb.txt" 2>&1 &
    screen=$!
    for ((i = 0; i < 100; i++)); do
        [[ ! -s $2/display.txt ]] || break
        sleep 0.1
    done
    export DISPLAY=":$(<"$2/display.txt")" LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=llvmpipe
    [[ -s $2/display.txt ]]
}
