#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Renders one golden image anew and compares: golden_test.sh SOURCE MANGATA PICTURE_CHECK FOLDER FILE. The new picture and, where
# it is off, the difference stay in FOLDER.
set -euo pipefail
source=$1 mangata=$2 check=$3 folder=$4 name=$5
cd "$source"
mkdir -p "$folder"
read -r file largest mean scene options < <(awk -v f="$name" '$1 == f' tests/images/goldens.txt)
[ "$file" = "$name" ] || { echo "tests/images/goldens.txt has no $name" >&2; exit 1; }
# shellcheck disable=SC2086 # options are words
"$mangata" render "$scene" -o "$folder/$file" --overwrite --quiet --size 160x90 $options
rm -f "$folder/$file.difference.png"
exec "$check" near "$folder/$file" "tests/images/golden/$file" "$largest" "$mean" "$folder/$file.difference.png"
