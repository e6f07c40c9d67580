# SPDX-License-Identifier: MIT
# Opening another scene: by path, by dropping, from the dialog; what was opened lately is listed; a bad file changes nothing.
. "$CHECK"

cp "$SOURCE/scenes/sunset.json" first.json
cp "$SOURCE/scenes/moonlit.json" second.json
printf 'mangata: 1\nlight: {elevation_deg: far}\n' >bad.yaml
drive first.json --size 900x640 <<'END'
mark
open second.json
expect-change
screenshot second.png
set light.elevation_deg 33
press ctrl+z
drop bad.yaml
screenshot kept.png
drop --sea wind=6
screenshot sea.png
press ctrl+o
screenshot dialog.png
press escape
screenshot closed.png
drop first.json
expect-same
END
same kept.png second.png
differ sea.png second.png
differ dialog.png sea.png
same closed.png sea.png
[[ $(head -n 1 state/mangata/recent) == "$PWD/first.json" ]] || fail "opened lately: $(cat state/mangata/recent)"
(($(grep -c first.json state/mangata/recent) == 1)) || fail "a scene is listed twice"
finish
