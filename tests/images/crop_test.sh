#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Renders a crop of one committed reference anew, by the command in the manifest: crop_test.sh SOURCE MANGATA PICTURE_CHECK FILE X,Y,W,H.
# The bytes must be equal.
set -euo pipefail
source=$1 mangata=$2 check=$3 name=$4 crop=$5
cd "$source"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
read -r file _ scene options < <(awk -v f="$name" '$1 == f' tests/reference/manifest.txt)
[ "$file" = "$name" ] || { echo "tests/reference/manifest.txt has no $name" >&2; exit 1; }
# shellcheck disable=SC2086 # options are words
"$mangata" render "$scene" -o "$work/crop.pfm" --quiet $options --crop "$crop"
IFS=, read -r x y _ _ <<< "$crop"
"$check" crop "tests/reference/$file" "$work/crop.pfm" "$x" "$y"
