#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Renders one golden image anew and compares: golden_test.sh SOURCE MANGATA PICTURE_CHECK FOLDER FILE [gl]. The new picture and, where
# it is off, the difference stay in FOLDER. OpenGL rounds otherwise: one value in a thousand may flip at a glint's edge.
set -euo pipefail
source=$1 mangata=$2 check=$3 folder=$4 name=$5 backend=${6:-cpu}
cd "$source"
mkdir -p "$folder"
read -r file largest mean scene options < <(awk -v f="$name" '$1 == f' tests/images/goldens.txt)
[ "$file" = "$name" ] || { echo "tests/images/goldens.txt has no $name" >&2; exit 1; }
code=0
# shellcheck disable=SC2086 # options are words
"$mangata" render "$scene" -o "$folder/$file" --overwrite --quiet --size 160x90 --backend "$backend" $options || code=$?
if [ "$backend" = gl ] && [ "$code" = 69 ]; then
    echo "no OpenGL here: not compared"
    exit 77
fi
[ "$code" = 0 ]
rm -f "$folder/$file.difference.png"
[ "$backend" = cpu ] || exec "$check" most "$folder/$file" "tests/images/golden/$file" 5e-3 1e-3 "$mean" "$folder/$file.difference.png"
exec "$check" near "$folder/$file" "tests/images/golden/$file" "$largest" "$mean" "$folder/$file.difference.png"
