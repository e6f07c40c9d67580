# SPDX-License-Identifier: MIT
# Opening another scene: by path, by dropping, from the dialog; what was opened lately is listed; a bad file changes nothing. Undo brings back the scene before.
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
# the first sea of the dialog
press ctrl+o
drag 150 123 150 123
expect-value water.wind.speed 3
undo
screenshot undone.png
drop first.json
expect-same
END
same kept.png second.png
differ sea.png second.png
differ dialog.png sea.png
same closed.png sea.png
same undone.png sea.png
[[ $(head -n 1 state/mangata/recent) == "$PWD/first.json" ]] || fail "opened lately: $(cat state/mangata/recent)"
(($(grep -c first.json state/mangata/recent) == 1)) || fail "a scene is listed twice"

# Undo brings back the scene before with its edits, though its file is gone; redo opens again, though an opening has failed since.
drive first.json --size 240x160 --set light.azimuth_deg=9 <<'END'
set panel.shown off
frames 2
set light.elevation_deg 20
set a.method none
set a.spatial 3
picture edited.png
open second.json
expect-value a.method mangata
set light.elevation_deg 33
copy bad.yaml second.json
wait-reload
expect-error second.json:2:
mark
undo
undo
expect-no-error
expect-value light.elevation_deg 20
expect-value light.azimuth_deg 9
picture undone.png
save-scene undone.yaml
command
drop bad.yaml
drop missing.yaml
redo
expect-error second.json:2:
redo
expect-value light.elevation_deg 33
expect-same
# opening the same file is a step, too, and what follows an undone opening takes its place
open first.json
open first.json
undo
undo
expect-same
press r
undo
undo
press r
expect-value light.azimuth_deg 9
set light.azimuth_deg 8
undo
picture again.png
END
for file in undone.png again.png; do cmp -s "$file" edited.png || fail "$file is another picture than edited.png"; done
grep -q '^mangata render first.json .*light.azimuth_deg=9' stdout.txt || fail "the command is of another scene: $(cat stdout.txt)"
grep -q 'elevation_deg: 20' undone.yaml || fail "the saved scene is another: $(cat undone.yaml)"

# Each command of a script is a step of its own, though no frame goes by between them.
drive first.json --size 240x160 <<'END'
set light.elevation_deg 20
set light.azimuth_deg 10
set light.elevation_deg 30
undo
expect-value light.elevation_deg 20
expect-value light.azimuth_deg 10
undo
expect-value light.elevation_deg 20
expect-refused light.azimuth_deg far
redo
expect-value light.azimuth_deg 10
END

# Saved scenes and commands name files beside the scene by relative paths, and those elsewhere by whole ones.
mkdir -p tree/scenes tree/other tree/models far/away
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' | tee tree/models/three.obj >tree/scenes/own.obj
printf 'mangata: 1\nobjects: [{mesh: ../models/three.obj}, {mesh: own.obj}]\nwater: {waves: [{amplitude: 0.05, a: 1.5, b: 0.7, c: -4}]}\n' >tree/scenes/two.yaml
drive tree/scenes/two.yaml --size 240x160 <<'END'
set objects[0].dry true
command
save-scene tree/other/saved.yaml
save-scene far/away/saved.yaml
END
grep -q 'mesh: "\?../models/three.obj' tree/other/saved.yaml || fail "no relative path: $(cat tree/other/saved.yaml)"
grep -q 'mesh: "\?../scenes/own.obj' tree/other/saved.yaml || fail "no relative path: $(cat tree/other/saved.yaml)"
grep -q "$PWD/tree/scenes/own.obj" far/away/saved.yaml || fail "no whole path: $(cat far/away/saved.yaml)"
! grep -q "$PWD" stdout.txt || fail "the command has whole paths: $(cat stdout.txt)"
expect 0 '' "$MANGATA" scene check tree/other/saved.yaml far/away/saved.yaml --quiet
mv tree moved
expect 0 '' "$MANGATA" scene check moved/other/saved.yaml --quiet
finish
