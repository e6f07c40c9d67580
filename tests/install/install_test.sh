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
if command -v python3 >/dev/null; then
    for file in man/man1/mangata.1.gz man/man1/mangata-render.1.gz bash-completion/completions/mangata zsh/site-functions/_mangata; do
        [[ -s $prefix/share/$file ]] || die "share/$file is not installed"
    done
fi

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
exported() { nm -D --defined-only "$1" | awk '{ print $3 }' | grep -v '^_' | sort; }
declared() { grep -Eho '^MGT_API [^(]*\(' "$@" | grep -Eo 'mgt_[a-z0-9_]+\(' | tr -d '(' | sort; }
declared $(ls "$prefix"/include/mangata/*.h | grep -v /io.h) >"$work/declared"
[[ -s $work/declared ]] || die "no declarations found"
exported "$library" | diff "$work/declared" - || die "exported symbols are not the declared ones"
exported "$folder/libmangata-io.so" | diff <(declared "$prefix/include/mangata/io.h") - || die "exported symbols of libmangata-io are not the declared ones"
objdump -p "$library" | grep -Eq 'SONAME +libmangata\.so\.0\.1$' || die "no soname"

# The Python package, where the system's Python has what it needs.
if /usr/bin/python3 -c 'import cffi, numpy' 2>/dev/null && ((${#flags[@]} == 0)); then
    # It finds the libraries of its own prefix.
    (cd "$work" && PYTHONPATH=$prefix/lib/python3/dist-packages /usr/bin/python3 -c 'import mangata; mangata.render(mangata.sea(wind=5), size=(16, 9))') ||
        die "the installed Python package"
fi

# By pkg-config.
export PKG_CONFIG_PATH=$folder/pkgconfig
"$cc" -std=c17 -Wall -Wextra -Werror "${flags[@]}" "$source/examples/render.c" $(pkg-config --cflags --libs mangata) -lm -o "$work/by_pkgconfig"
LD_LIBRARY_PATH=$folder "$work/by_pkgconfig" "$work/a.ppm"
[[ $(head -c 15 "$work/a.ppm" | tr '\n' ' ') == "P6 640 360 255 " ]] || die "the example's picture: $(head -c 15 "$work/a.ppm")"
(($(stat -c %s "$work/a.ppm") == 15 + 640 * 360 * 3)) || die "the example's picture is short"
(($(tail -c +16 "$work/a.ppm" | od -An -v -tu1 -w3 | sort -u | wc -l) > 100)) || die "the example's picture is blank"

# The library of files, linked by its own module alone.
cat >"$work/files.c" <<'END'
#include <locale.h>
#include <mangata/io.h>
#include <mangata/mangata.h>
#include <string.h>

int main(int count, char **words)
{
    const char *changes[] = {"water.level=0.25"};
    mgt_scene_file *file = NULL;
    mgt_scene scene;
    mgt_context *context = NULL;
    setlocale(LC_ALL, "");
    if (count != 3 || strcmp(mgt_io_version(), mgt_version()) != 0 || mgt_scene_file_load(&file, words[1], changes, 1, NULL) != MGT_IO_OK)
        return 1;
    const bool good = mgt_scene_file_frame(file, 0, &scene, sizeof scene) == MGT_IO_OK && mgt_context_create(&context, NULL) == MGT_OK &&
                      mgt_scene_check(context, &scene) == MGT_OK && scene.water.level == 0.25 && localeconv()->decimal_point[0] == *words[2];
    mgt_context_destroy(context);
    mgt_scene_file_free(file);
    return !good;
}
END
"$cc" -std=c17 -Wall -Wextra -Werror "${flags[@]}" "$work/files.c" $(pkg-config --cflags --libs mangata-io) -o "$work/files"
LD_LIBRARY_PATH=$folder "$work/files" "$source/scenes/simple.json" . || die "a program of libmangata-io, by pkg-config"
# The same in a locale with a decimal comma.
printf '%s\n' 'comment_char %' 'escape_char /' LC_NUMERIC 'decimal_point ","' 'thousands_sep "."' 'grouping 3;3' 'END LC_NUMERIC' >"$work/comma"
localedef -c -i "$work/comma" "$work/xx_XX" >/dev/null 2>&1 || true # it warns of what is left out
LC_ALL=xx_XX LOCPATH=$work LD_LIBRARY_PATH=$folder "$work/files" "$source/scenes/simple.json" , || die "a program with a decimal comma reads another scene"
[[ $(pkg-config --modversion mangata-io) == $(pkg-config --modversion mangata) ]] || die "versions of the modules differ"

# The static one, which has no other global symbol than the public interface either.
nm -g --defined-only "$folder/libmangata.a" | awk 'NF == 3 { print $3 }' | sort | diff "$work/declared" - || die "global symbols of libmangata.a"
static_words="pkg-config --static --cflags --libs mangata | sed 's/-lmangata/-l:libmangata.a/'"
grep -qF "$static_words" "$source/README.md" || die "README.md has other words for the static library"
"$cc" -std=c17 "${flags[@]}" "$source/examples/render.c" $(eval "$static_words") -o "$work/static"
! ldd "$work/static" | grep mangata || die "the static library is not linked"
"$work/static" "$work/static.ppm"
cmp "$work/a.ppm" "$work/static.ppm" || die "the static library draws something else"

# Programs that were built with the header of 0.1, whose scene ends with sample_slots, and with a later one, whose scene is larger.
for version in earlier later; do
    mkdir -p "$work/$version"
    cp -r "$prefix/include/mangata" "$work/$version"
    if [[ $version == earlier ]]; then
        sed -i '/sample_slots;/,/} mgt_quality;/ { /sample_slots;/b; /} mgt_quality;/b; d }' "$work/$version/mangata/scene.h"
    else
        sed -i 's/^} mgt_quality;/double added[2]; &/' "$work/$version/mangata/scene.h"
    fi
    "$cc" -std=c17 "${flags[@]}" -I "$work/$version" "$source/examples/render.c" -L "$folder" -lmangata -lm -o "$work/$version/render"
    LD_LIBRARY_PATH=$folder "$work/$version/render" "$work/$version.ppm"
    cmp "$work/a.ppm" "$work/$version.ppm" || die "a program that was built with an $version header draws something else"
done

# By CMake, linked with either.
mkdir "$work/user"
cp "$source/examples/render.c" "$work/user"
cat >"$work/user/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.20)
project(user C)
find_package(mangata 0.1 REQUIRED)
add_executable(user render.c)
target_link_libraries(user PRIVATE mangata::mangata m)
add_executable(user_static render.c)
target_link_libraries(user_static PRIVATE mangata::mangata_static m)
END
"$cmake" -S "$work/user" -B "$work/user/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS="${flags[*]}" \
    >"$work/user.log" 2>&1 && "$cmake" --build "$work/user/build" >>"$work/user.log" 2>&1 || die "$(cat "$work/user.log")"
"$work/user/build/user" "$work/b.ppm"
cmp "$work/a.ppm" "$work/b.ppm" || die "two builds of the example differ"
"$work/user/build/user_static" "$work/c.ppm"
cmp "$work/a.ppm" "$work/c.ppm" || die "the static build of the example differs"
# What the static library needs is named, not a file of one version of it, which another system may not have.
! grep -nE 'lib[a-z0-9_]+\.(so|a)\.[0-9]' "$folder/cmake/mangata/mangata-config.cmake" || die "the CMake package names the file of one version"
! "$work/user/build/user" "$work/no/such/folder.ppm" || die "the example hides a failure"

# A tree in a folder with spaces: its pages, and the declarations for Python.
ln -s "$source" "$work/a tree"
"$cmake" -S "$work/a tree" -B "$work/a build" -DMANGATA_TOOLS=OFF -DCMAKE_C_COMPILER="$cc" >"$work/spaces.log" 2>&1 &&
    "$cmake" --build "$work/a build" --target installed_pages >>"$work/spaces.log" 2>&1 || die "$(cat "$work/spaces.log")"
diff -r "$build/docs" "$work/a build/docs" || die "a tree in a folder with spaces installs other pages"
"$source/scripts/declarations" "$cc" "$work/a tree/include" "$work/a build/declarations.h"
diff "$build/python/declarations.h" "$work/a build/declarations.h" || die "a tree in a folder with spaces has other declarations"
