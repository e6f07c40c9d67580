# SPDX-License-Identifier: MIT
# Signals: an orderly stop within two seconds, and nothing under a final name that is not whole, even after kill -9.
. "$CHECK"

stops() { # SIGNAL CODE OUT [options]
    local signal=$1 code=$2 out=$3 start result
    shift 3
    mkdir stop
    start=$(date +%s%N)
    timeout -s "$signal" -k 20 --preserve-status 1 "$MANGATA" render "$simple" -o "stop/$out" "$@" >stdout.txt 2>stderr.txt
    result=$?
    ((result == code)) || fail "$signal, $out: exit code $result: $(cat stderr.txt)"
    (($(date +%s%N) - start < 3000000000)) || fail "$signal, $out: it took $((($(date +%s%N) - start) / 1000000 - 1000)) ms to stop"
    (($(wc -l <stderr.txt) <= 1)) || fail "$signal: more than one line: $(cat stderr.txt)"
    [[ -z $(ls -A stop) ]] || fail "$signal, $out: left $(ls -A stop)"
    rm -r stop
}
long=(--method reference --spatial 16 --size 3840x2160)
stops INT 130 a.png "${long[@]}"
stops TERM 143 a.exr "${long[@]}" --layer all
stops INT 130 a.y4m "${long[@]}" --frames 0-9
stops TERM 143 b.y4m --frames 0-99999 --set time.frames=100000 --size 640x360 "${null[@]}"
command -v ffmpeg >/dev/null && stops INT 130 b.mp4 --frames 0-99999 --set time.frames=100000 --size 640x360 "${null[@]}"

# While a scene is read from a pipe that stays open.
timeout -s TERM -k 20 --preserve-status 1 "$MANGATA" render - -o pipe.png < <(exec sleep 3) 2>stderr.txt
result=$?
((result == 143)) || fail "reading a scene: exit code $result: $(cat stderr.txt)"
(($(wc -l <stderr.txt) == 1)) || fail "reading a scene: $(cat stderr.txt)"
[[ ! -e pipe.png ]] || fail "reading a scene left a picture"

# While a large model is read, by the program and by the process that it starts: one line, and that process ends as well, however the first one does.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' >large.obj
for ((i = 0; i < 12; i++)); do echo 'f 1 2 3'; done >faces
for ((i = 0; i < 16; i++)); do cat faces faces >more && mv more faces; done
cat faces >>large.obj
printf 'mangata: 1\nobjects:\n  - mesh: large.obj\n' >large.yaml
readers() { pgrep -f "mangata-import large.obj $1 " | wc -l; }
for signal in TERM KILL HUP; do
    "$MANGATA" render large.yaml -o large.png 2>stderr.txt &
    pid=$!
    for ((i = 0; i < 100 && $(readers $pid) == 0; i++)); do sleep 0.05; done
    (($(readers $pid) == 1)) || fail "$signal: no process reads the model"
    start=$(date +%s%N)
    kill -s "$signal" "$pid"
    wait "$pid" 2>/dev/null
    result=$?
    (($(date +%s%N) - start < 1000000000)) || fail "$signal while a model was read: it took longer than a second"
    case $signal in TERM) expected=143 ;; KILL) expected=137 ;; HUP) expected=129 ;; esac
    ((result == expected)) || fail "$signal while a model was read: exit code $result: $(cat stderr.txt)"
    [[ $signal == KILL ]] || (($(wc -l <stderr.txt) == 1)) || fail "$signal while a model was read: $(cat stderr.txt)"
    for ((i = 0; i < 20 && $(readers $pid) > 0; i++)); do sleep 0.05; done
    (($(readers $pid) == 0)) || fail "$signal: the process that reads the model lives on"
    absent large.png
done
rm faces large.*

# Killed at once: what has a final name can be read to its end.
mkdir kill
for ((i = 0; i < 6; i++)); do
    (timeout -s KILL "0.$((RANDOM % 70 + 10))" "$MANGATA" render "$simple" -o "kill/f_%05d.png" --frames 0-999 --size 320x180 "${null[@]}" --overwrite --quiet; true) 2>/dev/null
    (timeout -s KILL "0.$((RANDOM % 70 + 10))" "$MANGATA" render "$simple" -o kill/film.y4m --frames 0-99999 --size 320x180 "${null[@]}" --overwrite --quiet; true) 2>/dev/null
done
frames=$(ls kill/f_*.png | wc -l)
((frames > 0)) || fail "no frame was finished; the test shows nothing"
"$MANGATA" diff kill/f_%05d.png kill/f_%05d.png --frames "0-$((frames - 1))" >/dev/null || fail "not every frame is whole"
absent kill/film.y4m kill/film.y4m.json

# Stopped or killed while files get their names, a film or a picture with a sidecar is whole or not there, and the same command goes on.
if command -v strace >/dev/null && [[ -z ${SANITIZED:-} ]]; then
    named() { # SIGNAL CALL CODE OUT [options]: the signal comes with the CALLth renameat() or renameat2()
        local signal=$1 call=$2 code=$3 out=$4 result
        shift 4
        (strace -f -o /dev/null -e trace=renameat,renameat2 -e "inject=renameat:signal=$signal:when=$call" \
            -e "inject=renameat2:signal=$signal:when=$call" "$MANGATA" render "$simple" -o "named/$out" "${small[@]}" --quiet "$@"; exit $?) >/dev/null 2>&1
        result=$?
        ((result == code)) || fail "$signal with name $call of $out: exit code $result"
    }
    outs=(a.pfm a.y4m)
    ! command -v ffmpeg >/dev/null || outs+=(a.mp4)
    mkdir named
    for out in "${outs[@]}"; do
        for call in 1 2; do
            named TERM $call 143 $out --frames 0
            exists named/$out named/$out.json
            no_temporaries named
            expect 0 'kept' render "$simple" -o named/$out "${small[@]}" --frames 0 --skip-existing
            rm named/$out*
            named KILL $call 137 $out --frames 0
            absent named/$out
            works render "$simple" -o named/$out "${small[@]}" --quiet --frames 0 --skip-existing
            rm -r named/.mangata*
            # The first name is the sidecar's, the second the picture's.
            cp named/$out old
            named KILL $call 137 $out --frames 0 --overwrite --method ssaa2
            same named/$out old
            if ((call == 1)); then
                expect 0 'kept' render "$simple" -o named/$out "${small[@]}" --frames 0 --skip-existing
            else
                expect 0 'damaged; it is rendered again' render "$simple" -o named/$out "${small[@]}" --frames 0 --skip-existing --method ssaa2
            fi
            rm -r named/.mangata* named/$out*
        done
    done
else
    echo "NOTICE: no strace here, or a sanitized build: no signal came while files got their names"
fi

# A series that was killed goes on where it stopped.
works render "$simple" -o "kill/f_%05d.png" --frames 0-9 --size 320x180 "${null[@]}" --skip-existing --quiet
finish
