# SPDX-License-Identifier: MIT
# One picture whose samples several runs render: however they are cut, `mangata merge` makes the bytes of the whole; what does not belong together is refused.
. "$CHECK"

sunset=$SOURCE/scenes/sunset.json
few=(--method reference --spatial 4 --time-samples 3 --size 33x19 --seed 5 --set post.glare=0.05) # 48 samples
merge() { "$MANGATA" merge "$@"; }
part() { works render "$sunset" "${few[@]}" -o "$1" --samples-range "$2" --quiet "${@:3}"; }

# Cuts into two, three and seven uneven parts, and the exact bytes of pictures of all layers and of displayed colour, with its glare.
works render "$sunset" "${few[@]}" -o whole.exr --layer all --quiet
works render "$sunset" "${few[@]}" -o whole.png --quiet
works render "$sunset" "${few[@]}" -o whole.sums --quiet
cuts=('0 17 48' '0 1 40 48' '0 3 4 9 16 17 45 48')
[[ -z ${SANITIZED:-} ]] || cuts=('0 1 40 48')
for cut in "${cuts[@]}"; do
    rm -f p_*
    read -ra at <<<"$cut"
    for ((i = 1; i < ${#at[@]}; i++)); do part "p_$((9 - i)).sums" "${at[i - 1]},$((at[i] - at[i - 1]))" --threads $((i % 2 + 1)); done
    works merge "$sunset" p_*.sums "${few[@]}" -o merged.exr --layer all --quiet --overwrite
    works merge "$sunset" p_*.sums "${few[@]}" -o merged.png --quiet --overwrite
    works merge "$sunset" p_*.sums "${few[@]}" -o merged.sums --quiet --overwrite
    for kind in exr png sums; do same whole.$kind merged.$kind; done
done

# Equal parts by number; parts of parts; other instruction sets of the same arithmetic.
part a.sums 0/3
part b.sums 1/3 --isa scalar
part c.sums 2/3
works merge "$sunset" c.sums a.sums "${few[@]}" -o ac.sums --quiet
works merge "$sunset" ac.sums b.sums "${few[@]}" -o joined.png --quiet
same whole.png joined.png
[[ $(head -c 2000 ac.sums | grep -ao '"ranges": "[^"]*"') == '"ranges": "0,16 32,16"' ]] || fail "ac.sums: $(head -c 900 ac.sums | strings)"

# A crop lies where it is in the whole; lights found by cells are the merge's.
crop=("${few[@]}" --set post.glare=0 --crop 5,4,20,9)
for kind in exr png; do works render "$sunset" "${crop[@]}" -o crop.$kind --quiet; done
for i in 0 1; do works render "$sunset" "${crop[@]}" -o k$i.sums --samples-range $i/2 --quiet; done
for kind in exr png; do
    works merge "$sunset" k?.sums "${crop[@]}" -o crop_merged.$kind --quiet
    same crop.$kind crop_merged.$kind
done
cells=(--method reference --spatial 2 --time-samples 2 --size 9x5 --light-cells 2)
works render "$sunset" "${cells[@]}" -o cells.exr --layer color --layer coverage --quiet
for i in 0 1 2; do works render "$sunset" "${cells[@]}" -o l$i.sums --samples-range $i/3 --quiet; done
works merge "$sunset" l?.sums "${cells[@]}" -o cells_merged.exr --layer color --layer coverage --quiet
same cells.exr cells_merged.exr

# Point samples as well, of a sea and of what stands in the water.
for scene in sunset.json pool.yaml; do
    points=("$SOURCE/scenes/$scene" --method ssaa3 --time-samples 2 --size 40x23 --quiet --overwrite) # 18 samples
    works render "${points[@]}" -o points.exr --layer all
    at=(0 1 7 18)
    for i in 1 2 3; do works render "${points[@]}" -o s_$i.sums --samples-range "${at[i - 1]},$((at[i] - at[i - 1]))" --isa "$([[ $i == 1 ]] && echo scalar || echo auto)"; done
    works merge "${points[@]}" s_?.sums -o points_merged.exr --layer all
    same points.exr points_merged.exr
done

# Slots of the paper's adaptive scheme.
slots=("$SOURCE/scenes/hull.yaml" --method adaptive --adaptive podee --slots 5003 --size 49x27 --quiet)
works render "${slots[@]}" -o slots.exr --layer all
at=(0 1 1700 5003)
for i in 1 2 3; do works render "${slots[@]}" -o u_$i.sums --samples-range "${at[i - 1]},$((at[i] - at[i - 1]))"; done
works merge "${slots[@]}" u_?.sums -o slots_merged.exr --layer all
same slots.exr slots_merged.exr

# A crop that cuts tiles.
for method in 'ssaa2 --time-samples 3' 'adaptive --adaptive podee --slots 5003'; do
    read -ra words <<<"$method"
    cut=("$sunset" --method "${words[@]}" --size 70x40 --set post.glare=0 --crop 30,14,21,9 --quiet --overwrite)
    works render "${cut[@]}" -o cut.png
    for i in 0 1; do works render "${cut[@]}" -o t$i.sums --samples-range $i/2; done
    works merge "${cut[@]}" t?.sums -o cut_merged.png
    same cut.png cut_merged.png
done

# Frames: a numbered part stands for one of each frame. Films as well.
clip=(--method reference --spatial 1 --time-samples 3 --size 12x8 --frames 0-2)
works render "$sunset" "${clip[@]}" -o 'f_%d.png' --quiet
for i in 0 1; do works render "$sunset" "${clip[@]}" -o "q${i}_%d.sums" --samples-range $i/2 --quiet; done
works merge "$sunset" 'q0_%d.sums' 'q1_%d.sums' "${clip[@]}" -o 'g_%d.png' --quiet
for i in 0 1 2; do same f_$i.png g_$i.png; done
works render "$sunset" "${clip[@]}" -o f.y4m --quiet
works merge "$sunset" 'q0_%d.sums' 'q1_%d.sums' "${clip[@]}" -o g.y4m --quiet
same f.y4m g.y4m

# A farm starts the same task again: what is there is kept, also when its parts are gone; a damaged part is rendered again.
expect 0 'kept' render "$sunset" "${few[@]}" -o a.sums --samples-range 0/3 --skip-existing
expect 73 'not rendered from this scene with these options' render "$sunset" "${few[@]}" -o a.sums --samples-range 1/3 --skip-existing
expect 0 'kept' merge "$sunset" gone.sums "${few[@]}" -o whole.png --skip-existing
cp b.sums sound.sums
printf x | dd of=b.sums bs=1 seek=3000 conv=notrunc status=none
expect 65 '^mangata: b.sums: is not a sound file of sums' merge "$sunset" a.sums b.sums c.sums "${few[@]}" -o bad.png
absent bad.png
expect 0 'b.sums: damaged; it is rendered again' render "$sunset" "${few[@]}" -o b.sums --samples-range 1/3 --skip-existing
same b.sums sound.sums
for size in 10 200 3000 $(($(stat -c %s sound.sums) - 1)); do
    head -c "$size" sound.sums >b.sums
    expect 65 '^mangata: b.sums: is not a ' merge "$sunset" a.sums b.sums c.sums "${few[@]}" -o bad.png
done
{ cat sound.sums && echo; } >b.sums
expect 65 'b.sums: .*its checksum is another' merge "$sunset" a.sums b.sums c.sums "${few[@]}" -o bad.png
cp sound.sums b.sums

# What does not belong together: which file, and what about it.
refused() { # CODE PATTERN PARTS… -- options
    local code=$1 pattern=$2 parts=()
    shift 2
    while (($#)) && [[ $1 != -- ]]; do parts+=("$1") && shift; done
    expect "$code" "$pattern" merge "$sunset" "${parts[@]}" -o bad.png "${few[@]}" "${@:2}"
    absent bad.png
}
refused 66 'no part has the samples 16,16 of 48; .* --samples-range 16,16 makes it' a.sums c.sums
refused 66 'gone.sums: .*No such file' a.sums gone.sums
# Whole by its checksum, and no sums of samples: red below 0, and a coverage of thousands.
python3 - <<'END'
import struct, zlib
data = open("a.sums", "rb").read()
head = data[:15 + 4 + struct.unpack("<I", data[15:19])[0]]
for name, words in (("red", (0, 1)), ("coverage", (7,))):
    rows = b"".join(b"\x08" + b"\xff" * 8 * 33 if word in words else b"\0" for word in range(12)) + b"\0" * 12 * 18
    whole = head + rows
    open(name + ".sums", "wb").write(whole + struct.pack("<I", zlib.crc32(whole)))
END
for kind in red coverage; do refused 65 "^mangata: $kind.sums: is not a sound file of sums: it holds sums that its samples cannot have" $kind.sums b.sums c.sums; done
refused 65 '^mangata: ac.sums: its samples 0,16 are in an earlier part as well' a.sums b.sums ac.sums
refused 65 '^mangata: a.sums: it has seed 5, and this merge has 6' a.sums b.sums c.sums -- --seed 6
refused 65 '^mangata: a.sums: it has samples 48, and this merge has 96' a.sums b.sums c.sums -- --time-samples 6
refused 65 '^mangata: a.sums: it has method_options none, and this merge has light_cells 4' a.sums b.sums c.sums -- --light-cells 4
refused 65 '^mangata: a.sums: it has frame 0, and this merge has 3' a.sums b.sums c.sums -- --frames 3
refused 65 '^mangata: a.sums: it has size 33x19, and this merge has 33x20' a.sums b.sums c.sums -- --size 33x20
refused 65 '^mangata: a.sums: it has crop 0,0,33,19, and this merge has 0,0,9,9' a.sums b.sums c.sums -- --crop 0,0,9,9 --set post.glare=0
refused 65 '^mangata: a.sums: it has arithmetic cpu, and this merge has cpu without fma' a.sums b.sums c.sums -- --isa sse2
refused 65 '^mangata: a.sums: it was rendered from another scene' a.sums b.sums c.sums -- --set light.elevation_deg=19
refused 65 '^mangata: whole.png: is not a file of sums' whole.png
expect 64 'method mangata has no exact sums' merge "$sunset" a.sums -o bad.png
expect 64 'no parts given' merge "$sunset" -o bad.png "${few[@]}"
expect 64 'no scene given; see mangata merge --help' merge -o bad.png
expect 64 'unknown option --samples-range' merge "$sunset" a.sums -o bad.png "${few[@]}" --samples-range 0,3
glare=("${few[@]}" --crop 5,4,20,9 --set post.glare=0.1)
works render "$sunset" "${glare[@]}" -o glare.sums --quiet
expect 64 'the glare of displayed colour needs the sums of the whole picture' merge "$sunset" glare.sums -o bad.png "${glare[@]}"
works merge "$sunset" glare.sums -o glare.exr "${glare[@]}" --quiet

# What a file of sums cannot be asked for.
bad() { expect 64 "$1" render "$sunset" -o bad.sums "${@:2}"; }
bad 'method mangata has no exact sums of samples; reference, ssaaN, and adaptive --adaptive podee --slots have'
bad 'method adaptive has no exact sums of samples' --method adaptive --adaptive podee
bad '--samples-range: of adaptive, --adaptive podee with --slots has ranges' --method adaptive --samples-range 0/2
bad '--samples-range 0/10: the picture has only 9 samples' --method adaptive --adaptive podee --slots 9 --samples-range 0/10
bad '--samples-range 5,5: allowed is FIRST,COUNT within the 9 samples of the picture' --method adaptive --adaptive podee --slots 9 --samples-range 5,5
bad '--layer is for the mangata merge that makes a picture' --method reference --layer color
bad 'leave out --backend gl' --method reference --backend gl
bad '--samples-range 3/3: allowed is FIRST,COUNT .*, or I/N' --method reference --samples-range 3/3
bad '--samples-range 0/600: a pixel has only 512 samples' --method reference --samples-range 0/600
absent bad.*
no_temporaries .
finish
