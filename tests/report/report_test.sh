#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes a small comparison and tries its page in headless Chromium with real clicks and keys; 77 where there is no Chromium or Python.
# In: MANGATA (the command), SOURCE (the repository); SCREENSHOTS: a folder for pictures of the page.
set -euo pipefail
command -v python3 >/dev/null || { echo "python3 is not installed: the report's page is not tested"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
options=(--size 96x54)
methods=none,ssaa2,ssaa3,ssaa2:time-samples=4,podee-uniform,podee-pixel,podee-pixel:ndf-mean=drop,podee-uniform:kernels=1,mangata
"$MANGATA" compare "$SOURCE/scenes/simple.json" "$SOURCE/scenes/sunset.json" -o "$work/report" "${options[@]}" --methods $methods \
    --frames 0-2 --spatial 2 --time-samples 4 --time-runs 2 --metrics rmse,energy,ssim,flicker --quiet
"$MANGATA" render "$SOURCE/scenes/simple.json" -o "$work/coverage.pfm" --layer coverage --method none "${options[@]}" --quiet
"$MANGATA" render "$SOURCE/scenes/sunset.json" -o "$work/color.pfm" --method none "${options[@]}" --quiet
python3 "$(dirname "$0")/report_test.py" "$work/report" "$work/coverage.pfm" "$work/color.pfm" ${SCREENSHOTS:+"$SCREENSHOTS"}
