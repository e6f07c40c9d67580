# SPDX-License-Identifier: MIT
# Folders that cannot be written and disks that run full: exit code 73 and nothing left behind.
. "$CHECK"

printf x >file
expect 73 'file' render "$simple" -o file/out.png "${null[@]}"
expect 73 'nowhere' render "$simple" -o nowhere/out.png "${null[@]}"
mkdir folder.png
expect 73 'folder.png' render "$simple" -o folder.png --overwrite "${null[@]}"
expect 73 'folder.png' render "$simple" -o folder.png "${null[@]}"
# It is said before anything is rendered: brute force would take hours.
expect 73 'nowhere' timeout 20 "$MANGATA" render "$simple" -o nowhere/out.png --method reference --spatial 1024
works render "$simple" -o f_03.png "${null[@]}" "${small[@]}" --quiet
expect 73 'f_03.png: .*exist' render "$simple" -o f_##.png --frames 0-9 "${null[@]}" "${small[@]}"
absent f_00.png
if [[ -c /dev/full ]]; then
    expect 73 'standard output' bash -c '"$MANGATA" info >/dev/full'
    expect 73 'standard output' bash -c '"$MANGATA" scene schema >/dev/full'
    [[ $("$MANGATA" scene schema 2>&1 >/dev/full | wc -l) == 1 ]] || fail "scene schema >/dev/full: not one line"
else
    echo "NOTICE: no /dev/full here; a full standard output was not tested"
fi

# Standard streams that the parent has closed: no message goes into the file that would have taken the stream's number.
works render "$simple" -o open.y4m "${small[@]}" "${null[@]}" --frames 0-1 --quiet
"$MANGATA" render "$simple" -o closed.y4m "${small[@]}" "${null[@]}" --frames 0-1 --progress json >&- 2>&- || fail "closed streams: exit code $?"
same closed.y4m open.y4m
expect 73 'standard output' bash -c '"$MANGATA" info >&-'

mkdir small readonly
if ! unshare -rm true 2>/dev/null; then
    echo "NOTICE: no mount namespaces here; full and read-only disks were not tested"
    finish
fi
export simple CHECK MANGATA
inside() { # everything on mounts that vanish with the namespace
    mount -t tmpfs -o size=64k tmpfs small && mount -t tmpfs -o ro tmpfs readonly || exit 9
    for out in big.png big.exr big.pfm big.y4m big.mp4; do
        timeout 60 "$MANGATA" render "$simple" -o "small/$out" --backend null --layer "$([[ $out == *.png ]] && echo color || echo normal)" \
            --size 1920x1080 --frames 0 >stdout.txt 2>stderr.txt
        local code=$?
        if ((code == 0)) && [[ $out == *.png || $out == *.exr || $out == *.mp4 ]]; then
            # Black pixels may compress into the little room there is.
            rm -f "small/$out" "small/$out.json"
            continue
        fi
        ((code == 73)) || fail "$out on a full disk: exit code $code: $(cat stderr.txt)"
        (($(wc -l <stderr.txt) == 1)) || fail "$out on a full disk: not one line: $(cat stderr.txt)"
        [[ -z $(ls -A small) ]] || fail "$out on a full disk left $(ls -A small)"
    done
    cat /dev/zero >small/filler 2>/dev/null
    for out in full.png full.exr full.pfm full.y4m; do
        expect 73 "$out.*[Nn]o space left" render "$simple" -o "small/$out" --backend null --size 640x360 --frames 0 --layer normal
        [[ $(ls -A small) == filler ]] || fail "$out on a full disk left $(ls -A small)"
    done
    expect 73 'readonly' render "$simple" -o readonly/out.png --backend null
    expect 73 'readonly' render "$simple" -o readonly/out.mp4 --backend null
    return $((failures > 0))
}
export -f inside fail expect render
export failures
unshare -rm bash -c 'set -u; inside' || failures=$((failures + 1))
finish
