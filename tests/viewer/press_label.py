#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""press_label.py LAYOUT KEYCODE: gives the screen a keyboard of that layout, prints a line, and for each line that it reads presses Ctrl and the key of that
code over the window in the corner. Exit code 77 where the system cannot do that."""
import ctypes
import shutil
import subprocess
import sys

layout, code = sys.argv[1], int(sys.argv[2])
try:
    x11, xtest = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
except OSError:
    sys.exit(77)
if not shutil.which("setxkbmap"):
    sys.exit(77)
x11.XOpenDisplay.restype = ctypes.c_void_p
display = ctypes.c_void_p(x11.XOpenDisplay(None))  # stays open, because a screen without programs forgets its keyboard
if subprocess.run(["setxkbmap", "-layout", layout]).returncode != 0:
    sys.exit(77)
print("ready", flush=True)
for _ in sys.stdin:
    xtest.XTestFakeMotionEvent(display, -1, 100, 100, 0)
    for key, down in ((37, 1), (code, 1), (code, 0), (37, 0)):
        xtest.XTestFakeKeyEvent(display, key, down, 0)
    x11.XSync(display, 0)
    print("pressed", flush=True)
