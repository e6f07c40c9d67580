#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Waterlines, borders, edges of depth and the horizon, by two-phase and hybrid against traced rays:
# edges_test.sh SOURCE MANGATA PICTURE_CHECK FOLDER SCENE…
# A crack or a smear is a run of pixels that are off; edges.txt has the limits.
# The pictures, and where they are off the differences, stay in FOLDER.
set -euo pipefail
source=$1 mangata=$2 check=$3 folder=$4
shift 4
cd "$source"
mkdir -p "$folder"
failures=0

draw() { # OUT REFRACTION CROP SCENE OPTION…
    local out=$1 refraction=$2 crop=$3 scene=$4 code=0
    shift 4
    "$mangata" render "$scene" -o "$out" --overwrite --quiet --size 1280x720 --crop "$crop" --refraction "$refraction" --refraction-samples 3 \
        --set time.shutter=0 --set post.glare=0 "$@" 2> "$folder/said.txt" || code=$?
    [ $code != 0 ] || return 0
    cat "$folder/said.txt" >&2
    # Without what traces rays there is no truth; without scripts/fetch_models no bunny.
    if [ $code = 69 ] || { [ $code = 66 ] && [ ! -e data/bunny.ply ]; }; then exit 77; fi
    exit 1
}

compare() { # NAME REFRACTION SHARE RUN CROP SCENE OPTION…
    local name=$1 refraction=$2 share=$3 run=$4 said
    shift 4
    draw "$folder/$name-$refraction.png" "$refraction" "$@"
    said=$("$check" runs "$folder/$name-$refraction.png" "$folder/$name-truth.png" 0.1 "$share" "$run" "$folder/$name-$refraction.difference.png") ||
        failures=$((failures + 1))
    echo "$name $refraction: $said"
}

while read -r name crop share run traced_share traced_run scene options; do
    case " $* " in *" $(basename "$scene" .yaml) "*) ;; *) continue ;; esac
    # shellcheck disable=SC2086 # options are words
    draw "$folder/$name-truth.png" truth "$crop" "$scene" $options
    # shellcheck disable=SC2086
    compare "$name" two-phase "$share" "$run" "$crop" "$scene" $options
    # shellcheck disable=SC2086
    compare "$name" hybrid "$traced_share" "$traced_run" "$crop" "$scene" $options
done < <(grep '^[a-z]' tests/images/edges.txt)
[ $failures = 0 ]
