# SPDX-License-Identifier: MIT
# compilers_test.sh CLANG_BUILD: the command built by another compiler gives the same bytes.
other=$1
. "$CHECK"
if [[ ! -x $other ]]; then
    echo "NOTICE: $other has not been built; nothing was compared"
    finish
fi
for scene in simple smooth sunset moonlit rough; do
    for method in none podee-uniform podee-pixel mangata ssaa2 "reference --spatial 2 --time-samples 2"; do
        for command in "$MANGATA" "$other"; do
            # shellcheck disable=SC2086
            works "$command" render "$SOURCE/scenes/$scene.json" -o "out$([[ $command == "$other" ]] && echo 2).exr" --layer all --method $method \
                --size 160x90 --frames 3 --overwrite --quiet
        done
        same out.exr out2.exr
    done
    for command in "$MANGATA" "$other"; do
        works "$command" render "$SOURCE/scenes/$scene.json" -o "out$([[ $command == "$other" ]] && echo 2).png" --size 160x90 --overwrite --quiet
    done
    same out.png out2.png
done
finish
