#!/bin/sh
# SPDX-License-Identifier: MIT
# Every kernel file must be valid GLSL 4.50 (compute) and GLSL ES 3.00 (fragment), which has no double. usage: validate_glsl.sh SOURCE_DIR
# Exit 77, which ctest counts as skipped, where glslangValidator is missing.
set -u
source=$1
kernels=$source/src/kernels
command -v glslangValidator >/dev/null 2>&1 || { echo "glslangValidator is not installed"; exit 77; }
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
mkdir "$work/whole" || exit 1
failed=0

check() { # name, version line, extension, epilogue, kernel
    whole=$work/whole/$1.$3
    version=$2
    epilogue=$4
    kernel=$5
    case $1 in # what it needs beside what all need
    lean | leadr) set -- "$kernels/baselines/lean_accessors_glsl.k" ;;
    fxaa) set -- "$work/luma.glsl" ;;
    slots) set -- "$kernels/common/math.k" ;;
    rounds) set -- "$source/src/gl/shaders/word64.glsl" ;;
    refract_*) set -- "$kernels/refraction/refract_accessors_glsl.k" ;;
    again | caustic | footprint | material | narrow | shadow | shown | spread | surfaces | texture | water_path | water_seen) set -- "$kernels/refraction/refract_accessors_glsl.k" "$kernels/refraction/narrow_types.k" "$kernels/refraction/shade_types.k" "$kernels/refraction/layer.k" "$work/object_accessors.glsl" ;;
    *) set -- ;;
    esac
    "$source/scripts/kernel_glsl" "$version" "$kernels/common/prelude_glsl.k" "$kernels/waves/sines_types.k" "$kernels/common/accessors_glsl.k" "$kernels/waves/foam_accessors_glsl.k" "$@" "$kernel" >"$whole" || failed=1
    printf '%s\n' "$epilogue" >>"$whole"
}

# For the validator alone: what the kernels of objects read, wherever a shader may keep it.
cat >"$work/object_accessors.glsl" <<'GLSL'
layout(std140) uniform NarrowBlock { NarrowData narrow_data; };
layout(std140) uniform ShadeBlock { ShadeData shade_data; };
#define NARROW(cx) narrow_data
#define CHOPPY_BEHIND(cx) NARROW(cx).choppy
#define SHADE(cx) shade_data
#define CHOPPY_LIGHT(cx) SHADE(cx).choppy
LayerPlane LAYER_PLANE(int cx, int layer, float column, float row);
float LAYER_DEPTH(int cx, int layer, float column, float row);
float LAYER_NEAREST(int cx, int layer, float column, float row);
#define MIRRORED_WITHIN(cx, a, b) (a.x < b.x)
vec3 SURFACE_CORNER(int cx, int triangle, int i);
vec3 SURFACE_NORMAL(int cx, int triangle);
int SURFACE_NEIGHBOUR(int cx, int triangle, int i);
bool IS_IN_LAYER(int cx, int layer, float column, float row);
int SHOWN_TRIANGLE(int cx, int layer, float column, float row);
bool SURFACE_KNOWN(int cx, int triangle);
bool IS_TESTED(int cx, int triangle);
#define ALONG_RAY(cx, end, nearest, i) vec2(nearest, i)
#define TEXTURE_NAME int
struct TextureLevel { float width, height; };
TextureLevel TEXTURE_LEVEL(int cx, int texture_name, float level);
vec3 TEXTURE_TEXEL(int cx, TextureLevel level, float column, float row);
vec3 TEXTURE(int cx, float object, float u, float v, float level);
float SUN_VISIBILITY(int cx, vec3 position, vec3 first, vec3 second, bool dry);
float SHADOW_TEXEL(int cx, float column, float row);
vec2 SHADOW_RANGE(int cx, float column, float row, float width, bool dry);
GLSL

echo "float LUMA(int cx, float column, float row);" >"$work/luma.glsl"

count=0
for kernel in "$kernels"/*/*.k; do
    name=$(basename "$kernel" .k)
    case $name in prelude_glsl | accessors_glsl | *_accessors_glsl) continue ;; esac
    count=$((count + 1))
    check "$name" "450 core" comp 'layout(local_size_x = 8, local_size_y = 8) in; void main() {}' "$kernel"
    [ "$name" = rounds ] || [ "$name" = slot_order ] || check "$name" "300 es" frag 'void main() {}' "$kernel"
done
# One process compiles all of them, much faster than one each.
if ! glslangValidator "$work"/whole/* >"$work/log" 2>&1; then
    failed=1
    for whole in "$work"/whole/*; do
        glslangValidator "$whole" >"$work/log" 2>&1 && continue
        echo "FAILED: $(basename "$whole") as GLSL $(sed -n '1s/#version //p' "$whole")"
        grep '^// ' "$whole"
        grep -E 'ERROR|WARNING' "$work/log"
    done
fi
echo "$count kernel files, each as GLSL 4.50 and, but for those with doubles, as GLSL ES 3.00"

# The check itself must be able to fail, and say where.
printf '/* broken */\n#include "kernels/common/math.k"\nKERNEL real broken(CTX cx, real x) { return x +; }\n' >"$work/broken.k"
"$source/scripts/kernel_glsl" "450 core" "$kernels/common/prelude_glsl.k" "$work/broken.k" >"$work/broken.comp" || failed=1
if glslangValidator "$work/broken.comp" >"$work/log" 2>&1 || ! grep -q 'ERROR: 3:3:' "$work/log"; then
    echo "FAILED: a broken kernel was not reported at its own line"
    cat "$work/log"
    failed=1
fi
exit $failed
