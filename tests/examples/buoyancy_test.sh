# SPDX-License-Identifier: MIT
# buoyancy_test.sh BUOYANCY SOURCE: the example as a command: its exit codes, its pictures, and a boat that stays on the waves and upright.
set -euo pipefail
buoyancy=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

die() {
    echo "FAIL: $*"
    exit 1
}

for wrong in "" "boat.ppm" "--size 0x9 b_#.ppm" "--size nine b_#.ppm" "--frames 0 b_#.ppm" "--fps 0 b_#.ppm" "--frames b_#.ppm"; do
    "$buoyancy" $wrong 2>message && code=0 || code=$?
    ((code == 64)) && grep -q '^usage:' message || die "'$wrong' ends with $code: $(cat message)"
done
cp "$source/README.md" "$source/scenes/models/hull.ply" .
for wrong in "--mesh none.ply b_#.ppm" "--mesh README.md b_#.ppm" "--mesh hull.ply no/such/folder_#.ppm"; do
    "$buoyancy" --size 16x9 --frames 1 $wrong >/dev/null 2>message && code=0 || code=$?
    ((code == 1)) && (($(wc -l <message) == 1)) || die "'$wrong' ends with $code: $(cat message)"
done
"$buoyancy" b_#.ppm >/dev/null 2>message && die "a boat from nowhere"
grep -q 'scenes/models/hull.ply: No such file or directory; --mesh PLY' message || die "without a boat: $(cat message)"

"$buoyancy" --mesh "$source/scenes/models/hull.ply" --size 96x54 --frames 12 --fps 1 'boat_##.ppm' >motion
cat motion

# A line a second. The boat is never farther from its place at rest than the highest crests of such a sea, follows the water, and stays upright.
awk '
    /^sea:/ { significant = $4 }
    /^second/ {
        heave = $4; pitch = $7; roll = $10; water = $13; lines++
        if (heave "" !~ /^-?[0-9.]+$/ || pitch "" !~ /^-?[0-9.]+$/ || roll "" !~ /^-?[0-9.]+$/) bad = bad "\nno number: " $0
        if (heave^2 > significant^2) bad = bad "\nabove the crests: " $0
        if ((heave - water)^2 > (significant / 3)^2) bad = bad "\nbeside the water: " $0
        if (pitch^2 > 625 || roll^2 > 625) bad = bad "\ncapsized: " $0
        swing += heave^2 / significant^2
    }
    END {
        if (lines != 12) bad = bad "\n" lines " lines of 12"
        if (swing < 0.1) bad = bad "\nit does not move"
        if (bad) { print bad; exit 1 }
    }' motion || die "the boat does not float"

# Pictures: whole, of many colours, with red pixels where the boat is, and no two the same.
for picture in boat_00.ppm boat_05.ppm boat_11.ppm; do
    (($(stat -c %s $picture) == 13 + 3 * 96 * 54)) || die "$picture has $(stat -c %s $picture) bytes"
    tail -c $((3 * 96 * 54)) $picture | od -An -v -tu1 -w3 >pixels
    (($(sort -u pixels | wc -l) > 500)) || die "$picture is empty"
    red=$(awk '$1 > 1.5 * $3 { n++ } END { print n + 0 }' pixels)
    ((red > 200 && red < 2000)) || die "$picture has $red pixels of the boat"
done
! cmp -s boat_00.ppm boat_05.ppm || die "the film stands still"
