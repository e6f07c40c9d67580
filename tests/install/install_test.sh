# SPDX-License-Identifier: MIT
# install_test.sh SOURCE BUILD CC CMAKE: installs into a folder of its own, then is a user of the library: headers alone, pkg-config,
# find_package, exported symbols.
set -eu
source=$1 build=$2 cc=$3 cmake=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
export CCACHE_DISABLE=1 LC_ALL=C

die() {
    echo "FAIL: $*"
    exit 1
}

# The libraries of a sanitized build need its flags; what is tested here does not depend on them.
flags=()
if grep -q '^MANGATA_SANITIZE:BOOL=ON' "$build/CMakeCache.txt"; then
    flags=(-fsanitize=address,undefined)
elif grep -q '^MANGATA_TSAN:BOOL=ON' "$build/CMakeCache.txt"; then
    flags=(-fsanitize=thread)
fi

"$cmake" --install "$build" --prefix "$prefix" >"$work/install.log" || die "$(cat "$work/install.log")"
library=$(find "$prefix" -name libmangata.so)
folder=$(dirname "$library")
[[ -n $library && -x $prefix/bin/mangata ]] || die "not installed: $(cat "$work/install.log")"
"$prefix/bin/mangata" --version >/dev/null

# Each public header compiles alone, as C17 and as C++17, with every warning an error.
warnings=(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -fsyntax-only -I "$prefix/include")
for header in "$prefix"/include/mangata/*.h; do
    name=mangata/${header##*/}
    printf '#include <%s>\n#include <%s>\nint nothing;\n' "$name" "$name" >"$work/header.c"
    cp "$work/header.c" "$work/header.cpp"
    "$cc" -std=c17 "${warnings[@]}" -Wstrict-prototypes "$work/header.c" || die "$name as C17"
    g++ -std=c++17 "${warnings[@]}" "$work/header.cpp" || die "$name as C++17"
done

# All that is exported is the public interface, and all of the public interface is exported.
nm -D --defined-only "$library" | awk '{ print $3 }' | grep -v '^_' | sort >"$work/exported"
grep -Eho '^MGT_API [^(]*\(' "$prefix"/include/mangata/*.h | grep -Eo 'mgt_[a-z0-9_]+\(' | tr -d '(' | sort >"$work/declared"
[[ -s $work/declared ]] || die "no declarations found"
diff "$work/declared" "$work/exported" || die "exported symbols are not the declared ones"
objdump -p "$library" | grep -Eq 'SONAME +libmangata\.so\.[0-9]+$' || die "no soname"

# By pkg-config.
export PKG_CONFIG_PATH=$folder/pkgconfig
"$cc" -std=c17 -Wall -Wextra -Werror "${flags[@]}" "$source/examples/render.c" $(pkg-config --cflags --libs mangata) -lm -o "$work/by_pkgconfig"
LD_LIBRARY_PATH=$folder "$work/by_pkgconfig" "$work/a.ppm"
[[ $(head -c 15 "$work/a.ppm" | tr '\n' ' ') == "P6 640 360 255 " ]] || die "the example's picture: $(head -c 15 "$work/a.ppm")"
(($(stat -c %s "$work/a.ppm") == 15 + 640 * 360 * 3)) || die "the example's picture is short"
(($(tail -c +16 "$work/a.ppm" | od -An -v -tu1 -w3 | sort -u | wc -l) > 100)) || die "the example's picture is blank"

# By CMake.
mkdir "$work/user"
cp "$source/examples/render.c" "$work/user"
cat >"$work/user/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.20)
project(user C)
find_package(mangata 0.1 REQUIRED)
add_executable(user render.c)
target_link_libraries(user PRIVATE mangata::mangata m)
END
"$cmake" -S "$work/user" -B "$work/user/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS="${flags[*]}" \
    >"$work/user.log" 2>&1 && "$cmake" --build "$work/user/build" >>"$work/user.log" 2>&1 || die "$(cat "$work/user.log")"
"$work/user/build/user" "$work/b.ppm"
cmp "$work/a.ppm" "$work/b.ppm" || die "two builds of the example differ"
! "$work/user/build/user" "$work/no/such/folder.ppm" || die "the example hides a failure"
