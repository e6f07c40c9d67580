#!/bin/sh
# SPDX-License-Identifier: MIT
# Every pass must be valid GLSL 4.50 also for glslang, which is stricter than drivers are. usage: validate_passes.sh SOURCE_DIR
# Exit 77, which ctest counts as skipped, where glslangValidator is missing.
set -u
source=$1
command -v glslangValidator >/dev/null 2>&1 || { echo "glslangValidator is not installed"; exit 77; }
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cp "$source"/src/gl/shaders/* "$work" || exit 1
failed=0

mkdir "$work/whole" || exit 1

# One process compiles all of them, much faster than one each.
files=0
check() { # file, what to define
    files=$((files + 1))
    whole=$work/whole/$files.${1##*.}
    printf '%s\n' "$2" >"$work/defines.k"
    "$source/scripts/kernel_glsl" "450 core" "$work/defines.k" "$1" >"$whole" || failed=1
    echo "$(basename "$1") $2" >"$work/$files.what"
}

count=0
foamy=0
each_way() { # file, what to define
    count=$((count + 1))
    check "$1" "$2"
    check "$1" "$2
#define SOFTWARE_GL"
    grep -q FOAMY_WATER "$whole" || return 0
    foamy=$((foamy + 1))
    # As water_defines of gl_programs.c has it.
    check "$1" "$2
#define CHOPPY_WATER
#define FOAMY_WATER"
    check "$1" "$2
#define SOFTWARE_GL
#define MANY_WAVES
#define CHOPPY_WATER
#define FOAMY_WATER"
}
for pass in "$work"/*.comp "$work"/*.vert "$work"/*.frag "$work"/*.tesc "$work"/*.tese; do
    grep -q '"method\.k"' "$pass" || each_way "$pass" ""
done
# Passes that are assembled once a method: {PASS, KERNEL, RESULT} in the rows of the methods.
rows=$(grep -oE '\{"[a-z_]+\.comp", "[a-z_]+\.k", "[a-z_]+"\}' "$source/src/params/methods.c" | tr -d '{}",')
while read -r pass kernel result; do
    echo "#include \"kernels/$(cd "$source/src/kernels" && find . -name "$kernel" | sed 's,^\./,,')\"" >"$work/method.k"
    case $kernel in lean.k | leadr.k) map="#define LEAN_MAP" ;; *) map= ;; esac
    each_way "$work/$pass" "#define method_result $result
$map"
done <<END
$rows
END
if ! glslangValidator "$work"/whole/* >"$work/log" 2>&1; then
    failed=1
    for whole in "$work"/whole/*; do
        glslangValidator "$whole" >"$work/log" 2>&1 && continue
        number=$(basename "$whole")
        echo "FAILED: $(cat "$work/${number%.*}.what")"
        grep '^// ' "$whole"
        grep -E 'ERROR|WARNING' "$work/log"
    done
fi
echo "$count passes, each for hardware and for software; $foamy of them also with foam"
[ $count -ge 12 ] && [ $foamy -ge 12 ] || failed=1
exit $failed
