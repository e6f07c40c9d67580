# SPDX-License-Identifier: MIT
# OpenGL: the same bytes every time, whichever of its threads comes first, and the same layer whichever others are drawn.
. "$CHECK"

for view in hull diver; do
    objects=("$SOURCE/scenes/$view.yaml" --backend gl --refraction-samples 2 --size 96x54 --quiet --overwrite)
    "$MANGATA" render "${objects[@]}" -o g1.exr --layer all || continue # without OpenGL there is none
    for n in 2 3 4; do
        works render "${objects[@]}" -o g$n.exr --layer all
        same g1.exr g$n.exr
    done
done

# A layer alone is what it is among all.
for method in none fxaa taa; do
    alone=("$SOURCE/scenes/high.json" --backend gl --method $method --size 96x54 --quiet --overwrite)
    "$MANGATA" render "${alone[@]}" -o all.exr --layer all || continue
    works render "${alone[@]}" -o alone.pfm --layer coverage
    expect 0 '' "$MANGATA" diff alone.pfm all.exr --layer coverage --max-rmse 1e-6
done
finish
