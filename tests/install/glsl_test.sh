# SPDX-License-Identifier: MIT
# glsl_test.sh SOURCE BUILD CC CMAKE: a program that has only the installed GLSL must draw the command's coverage. Exit 77, which ctest counts
# as skipped, where OpenGL 4.5 cannot be had without a window.
set -euo pipefail
source=$1 build=$2 cc=$3 cmake=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export CCACHE_DISABLE=1 LC_ALL=C

die() {
    echo "FAIL: $*"
    exit 1
}

"$cmake" --install "$build" --prefix "$work/prefix" >"$work/install.log" || die "$(cat "$work/install.log")"
export PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name mangata.pc)")
glsl=$(pkg-config --variable=glsldir mangata)
mangata=$work/prefix/bin/mangata
for name in mangata_types.glsl mangata_accessors.glsl mangata_glitter.glsl mangata_types.h; do
    [[ -s $glsl/$name ]] || die "$name is not installed in '$glsl'"
done

# The page shows the very shader that is tested here.
diff <(sed -n '/^```glsl$/,/^```$/p' "$source/docs/glsl.md" | sed '1d;$d') "$source/examples/glsl_coverage.frag" ||
    die "docs/glsl.md shows another shader"

# CMake's users find the same folder, also through a link, such as /lib to /usr/lib.
mkdir "$work/user"
ln -s "$(dirname "$PKG_CONFIG_PATH")" "$work/lib"
cat >"$work/user/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.20)
project(user C)
find_package(mangata REQUIRED)
file(WRITE glsl_dir "${mangata_GLSL_DIR}")
END
"$cmake" -S "$work/user" -B "$work/user/build" -DCMAKE_PREFIX_PATH="$work" -DCMAKE_C_COMPILER="$cc" >"$work/user.log" 2>&1 ||
    die "$(cat "$work/user.log")"
[[ $(cat "$work/user/glsl_dir") -ef $glsl ]] || die "mangata_GLSL_DIR is '$(cat "$work/user/glsl_dir")'"

# The parts with the installed accessors, in both languages. The shader's own names are words of the kernels, which must be free again.
own='layout(location = 0) out vec4 color;
void main()
{
    float real = 0.0, mask = 0.0, scale = 0.0;
    PixelRay p = pixel_ray_filtered(0, gl_FragCoord.x + real, gl_FragCoord.y);
    SlopeState s = slope_state(0, p.ray, HitEstimate(0.0, mask, 1.0, vec2(0.0), vec2(0.0)));
    color = vec4(glitter_result(0, p, s).color, 1.0 + scale);
}'
if command -v glslangValidator >/dev/null; then
    for version in "450 core" "300 es"; do
        { echo "#version $version"; cat "$glsl/mangata_types.glsl" "$glsl/mangata_accessors.glsl" "$glsl/mangata_glitter.glsl"; echo "$own"; } \
            >"$work/parts.frag"
        glslangValidator "$work/parts.frag" >"$work/log" 2>&1 || die "GLSL $version: $(grep -E 'ERROR' "$work/log")"
    done
else
    echo "glslangValidator is not installed: the parts are not checked as GLSL ES"
fi

# The structs in C and C++, and the example.
printf '#include <mangata_types.h>\n#include <mangata_types.h>\nint nothing;\n' | tee "$work/types.c" >"$work/types.cpp"
"$cc" -std=c17 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I "$glsl" "$work/types.c" || die "mangata_types.h as C17"
g++ -std=c++17 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I "$glsl" "$work/types.cpp" || die "mangata_types.h as C++17"
pkg-config --exists egl gl || { echo "no headers of EGL and OpenGL: the example is not built"; exit 77; }
"$cc" -std=c17 -O1 -Wall -Wextra -Wshadow -Werror "$source/examples/glsl_coverage.c" -I "$glsl" -lEGL -lGL -lm -o "$work/glsl_coverage"
cd "$work"
./glsl_coverage "$glsl" "$source/examples/glsl_coverage.frag" own.pfm scene.json && code=0 || code=$?
((code != 69)) || exit 77
((code == 0)) || die "glsl_coverage ends with $code"
"$mangata" render --quiet scene.json --layer coverage -o library.pfm

# One tile without a lattice is not the library's way to the hits: .0011 apart, where both are .0044 from brute force.
limit=0.0012
"$mangata" diff own.pfm library.pfm --max-rmse $limit | tee diff.txt || die "own.pfm and library.pfm differ"
awk '$1 == "mean" && ($3 < 0.99 || $3 > 1.01) { exit 1 }' diff.txt || die "own.pfm has another brightness"

# The comparison sees a shift by half a pixel.
sed 's/gl_FragCoord.x - 0.5/gl_FragCoord.x/' "$source/examples/glsl_coverage.frag" >shifted.frag
./glsl_coverage "$glsl" shifted.frag shifted.pfm
! "$mangata" diff shifted.pfm library.pfm --max-rmse $limit >/dev/null || die "a shifted picture passes"
