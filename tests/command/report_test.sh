# SPDX-License-Identifier: MIT
# --json, --progress json, info and bench: what programs read.
. "$CHECK"
json() { "$JSON_GET" "$1" <stdout.txt || echo "no $1"; }

expect 0 '' render "$simple" -o 'a_##.png' --frames 0-2 "${small[@]}" --json --quiet
[[ $(json rendered) == 3 && $(json files) == 3 && $(json files.2.path) == a_02.png && $(json files.2.frame) == 2 ]] || fail "$(cat stdout.txt)"
[[ $(json files.1.render_hash) =~ ^[0-9a-f]{64}$ && $(json width) == 64 && $(json method) == mangata ]] || fail "$(cat stdout.txt)"
[[ ! -s stderr.txt ]] || fail "--quiet --json writes to stderr: $(cat stderr.txt)"
expect 0 '' render "$simple" -o 'a_##.png' --frames 0-2 "${small[@]}" --json --skip-existing
[[ $(json rendered) == 0 && $(json skipped) == 3 && $(json files.0.skipped) == true ]] || fail "$(cat stdout.txt)"
works render "$simple" -o 'p_##.png' --frames 0-2 "${small[@]}" --progress json --quiet
[[ $("$JSON_GET" --lines event <stderr.txt | grep -c frame) == 3 ]] || fail "--progress json: $(cat stderr.txt)"
works render "$simple" -o quiet.png "${small[@]}" --progress auto
(($(wc -l <stderr.txt) == 1)) || fail "a bar was drawn on what is no terminal: $(cat stderr.txt)"
expect 0 '' render "$simple" -o $'odd\xff\n.png' "${small[@]}" --json --quiet
json files.0.path >/dev/null || fail "a name that is not UTF-8 breaks the JSON"

expect 0 '' "$MANGATA" info --json
for key in version default.isa default.threads default.lanes instruction_sets libraries.libfyaml libraries.libspng libraries.openexr libraries.jansson formats; do
    [[ $(json $key) != "no $key" ]] || fail "info has no $key"
done
expect 0 '' "$MANGATA" info
grep -q '^instruction sets .*scalar' stdout.txt || fail "info: $(cat stdout.txt)"
grep -q '^formats .*mp4.* mov' stdout.txt || fail "info: $(cat stdout.txt)"
expect 0 '' "$MANGATA" bench "$simple" --size 64x36 --methods none,mangata --frames 2 --repeat 2 --json
[[ $(json methods) == 2 && $(json runs) == 4 && $(json methods.1.method) == mangata && $(json methods.0.median_ms) != 0 ]] || fail "$(cat stdout.txt)"
expect 0 '' "$MANGATA" bench "$simple" --size 64x36 --methods none --display --repeat 1
grep -q '^none ' stdout.txt || fail "bench: $(cat stdout.txt)"
expect 0 '' "$MANGATA" bench "$simple" --size 64x36 --methods none+off,mangata+hybrid:tess-error=1:refraction-samples=2,lean --memory --repeat 1 --frames 1 --json
[[ $(json methods) == 3 && $(json methods.1.method) == mangata+hybrid:tess-error=1:refraction-samples=2 && $(json methods.1.memory_bytes) -ge 0 ]] || fail "$(cat stdout.txt)"
[[ $(json methods.2.memory_bytes) -gt 200000000 ]] || fail "lean's tables take no memory: $(cat stdout.txt)"
expect 0 '' "$MANGATA" scene check "$simple" --json
[[ $(json 0.ok) == true && $(json 0.waves) == 5 ]] || fail "$(cat stdout.txt)"
finish
