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

check() { # file, what to define
    printf '%s\n' "$2" >"$work/defines.k"
    "$source/scripts/kernel_glsl" "450 core" "$work/defines.k" "$1" >"$work/whole.${1##*.}" || { failed=1; return; }
    if ! glslangValidator "$work/whole.${1##*.}" >"$work/log" 2>&1; then
        failed=1
        echo "FAILED: $(basename "$1") $2"
        grep '^// ' "$work/whole.${1##*.}"
        grep -E 'ERROR|WARNING' "$work/log"
    fi
}

count=0
each_way() { # file, what to define
    count=$((count + 1))
    check "$1" "$2"
    check "$1" "$2
#define SOFTWARE_GL"
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
echo "$count passes, each for hardware and for software"
[ $count -ge 12 ] || failed=1
exit $failed
