# SPDX-License-Identifier: MIT
# The same bytes from any number of threads, any instruction set with fma, from a crop, and from a frame alone.
. "$CHECK"

scene=$SOURCE/scenes/smooth.json
size=(--size 96x54)
quiet=(--quiet --overwrite)
crop_of() { # FILE X Y W H OUT: the rectangle of a grey PFM, as raw bytes
    local width height header row
    width=$(sed -n 2p "$1" | cut -d' ' -f1) height=$(sed -n 2p "$1" | cut -d' ' -f2)
    header=$(head -n 3 "$1" | wc -c)
    : >"$6"
    for ((row = $3 + $5 - 1; row >= $3; row--)); do
        dd if="$1" bs=4 iflag=skip_bytes,count_bytes skip=$((header + 4 * ((height - 1 - row) * width + $2))) count=$((4 * $4)) status=none >>"$6"
    done
}
more_threads=(2 7) film=20-39
declare -A views=([hull]="two-phase broad screen-space" [diver]="two-phase hybrid truth")
[[ -z ${SANITIZED:-} ]] || more_threads=(7) film=29-31 views=([hull]="hybrid truth")
# Instruction sets with fma beside the one that is chosen.
others=()
"$MANGATA" info --json >info.json
for isa in scalar avx2 avx512; do
    grep -q "^    \"$isa\"" info.json && [[ $isa != "$("$JSON_GET" default.isa <info.json)" ]] && others+=("$isa")
done
raw() { tail -c +$(($(head -n 3 "$1" | wc -c) + 1)) "$1"; }

for method in none mangata podee-uniform podee-pixel ssaa2 reference adaptive adaptive-podee; do
    few=()
    [[ $method == adaptive* ]] && few=(--samples 2)
    [[ $method == adaptive-podee ]] && few+=(--adaptive podee) && method=adaptive
    [[ $method == reference ]] && few=(--spatial 2 --time-samples 2)
    works render "$scene" -o t1.exr --layer all --method $method "${few[@]}" --threads 1 "${size[@]}" "${quiet[@]}"
    for n in "${more_threads[@]}"; do
        works render "$scene" -o t$n.exr --layer all --method $method "${few[@]}" --threads $n "${size[@]}" "${quiet[@]}"
        same t1.exr t$n.exr
    done
    works render "$scene" -o whole.pfm --layer coverage --method $method "${few[@]}" "${size[@]}" "${quiet[@]}"
    works render "$scene" -o part.pfm --layer coverage --method $method "${few[@]}" "${size[@]}" "${quiet[@]}" --crop 21,17,52,27
    crop_of whole.pfm 21 17 52 27 whole.raw
    raw part.pfm >part.raw
    same whole.raw part.raw
    for isa in "${others[@]}"; do
        works render "$scene" -o $isa.exr --layer all --method $method "${few[@]}" --isa $isa "${size[@]}" "${quiet[@]}"
        same t1.exr $isa.exr
    done
done
differ whole.raw /dev/null

# Objects: through the water, mirrored by it and before it, seen from above and from below.
for view in "${!views[@]}"; do
    for refraction in ${views[$view]}; do
        objects=("$SOURCE/scenes/$view.yaml" --frames 4 --refraction $refraction --refraction-samples 2 --caustics on "${size[@]}" "${quiet[@]}")
        [[ $refraction == hybrid || $refraction == truth ]] && { "$MANGATA" render "${objects[@]}" -o probe.png || continue; } # without Embree there is none
        works render "${objects[@]}" -o t1.exr --layer all --threads 1
        for n in "${more_threads[@]}"; do
            works render "${objects[@]}" -o t$n.exr --layer all --threads $n
            same t1.exr t$n.exr
        done
        works render "${objects[@]}" -o whole.pfm --layer refraction_error
        works render "${objects[@]}" -o part.pfm --layer refraction_error --crop 21,13,52,27
        crop_of whole.pfm 21 13 52 27 whole.raw
        raw part.pfm >part.raw
        same whole.raw part.raw
        for isa in "${others[@]}"; do
            works render "${objects[@]}" -o $isa.exr --layer all --isa $isa
            same t1.exr $isa.exr
        done
        works render "${objects[@]}" -o two_%d.exr --frames 3-4 --layer all
        same two_4.exr t1.exr
    done
done

# 8-bit pictures: threads and instruction sets; frame 30 alone and among others; in one process or another.
works render "$scene" -o f_%02d.png --frames $film "${size[@]}" "${quiet[@]}"
works render "$scene" -o alone.png --frames 30 "${size[@]}" "${quiet[@]}" --threads 1
same f_30.png alone.png
differ f_29.png f_30.png
for isa in "${others[@]}"; do
    works render "$scene" -o $isa.png --frames 30 --isa $isa "${size[@]}" "${quiet[@]}"
    same $isa.png alone.png
done

# The mean of the halves is the whole; the seed matters to the reference.
works render "$scene" -o seed.pfm --layer coverage --method reference --spatial 2 --time-samples 2 --seed 9 "${size[@]}" "${quiet[@]}"
differ seed.pfm whole.pfm
finish
