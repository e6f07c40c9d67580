# SPDX-License-Identifier: MIT
# OpenGL: the same bytes every time, whichever of its threads comes first.
. "$CHECK"

for view in hull diver; do
    objects=("$SOURCE/scenes/$view.yaml" --backend gl --refraction-samples 2 --size 96x54 --quiet --overwrite)
    "$MANGATA" render "${objects[@]}" -o g1.exr --layer all || continue # without OpenGL there is none
    for n in 2 3 4; do
        works render "${objects[@]}" -o g$n.exr --layer all
        same g1.exr g$n.exr
    done
done
finish
