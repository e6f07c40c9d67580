# SPDX-License-Identifier: MIT
# Actions by chance: controls, keys, drags, wheel, pages, undo and redo, other scenes. scripts/viewer_random does 10000 of them under sanitizers.
. "$CHECK"

count=60
[[ -z ${SANITIZED:-} ]] || count=150
"$SOURCE/tests/viewer/random_actions.py" "$count" 3 "$SOURCE/scenes/simple.json" "$SOURCE/scenes/pool.yaml" '--sea wind=6' >actions.txt
drive "$SOURCE/scenes/simple.json" --size 640x400 <actions.txt
finish
