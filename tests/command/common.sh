# SPDX-License-Identifier: MIT
# Sourced by every test of the command: a folder of its own, and words to state what must happen.
# In: MANGATA (the command), JSON_GET, SOURCE (the repository).
set -u
export LC_ALL=C.UTF-8
work=$(mktemp -d)
trap 'chmod -R u+rwx "$work" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() {
    local i
    for ((i = 0; i < ${#BASH_SOURCE[@]}; i++)); do
        [[ ${BASH_SOURCE[i]} == */common.sh ]] || break
    done
    echo "FAIL ${BASH_SOURCE[i]##*/}:${BASH_LINENO[i - 1]}: $*"
    failures=$((failures + 1))
}

# expect CODE PATTERN COMMAND…: the exit code, and what stderr holds (an extended regular expression). A failure says one
# line on stderr and nothing on stdout.
expect() {
    local code=$1 pattern=$2 result
    shift 2
    "$@" >stdout.txt 2>stderr.txt </dev/null
    result=$?
    ((result == code)) || fail "exit code $result instead of $code: ${*##*/}: $(head -c 400 stderr.txt)"
    [[ -z $pattern ]] || grep -Eq -- "$pattern" stderr.txt || fail "stderr does not match '$pattern': ${*##*/}: $(head -c 400 stderr.txt)"
    if ((code != 0)); then
        (($(wc -l <stderr.txt) == 1)) || fail "not one line: ${*##*/}: $(head -c 800 stderr.txt)"
        [[ ! -s stdout.txt ]] || fail "stdout is not empty: ${*##*/}"
    fi
}

# The same for a good end that says nothing on stdout.
works() {
    expect 0 '' "$@"
    [[ ! -s stdout.txt ]] || fail "stdout is not empty: ${*##*/}"
}

# signalled SIGNAL CONDITION COMMAND…: runs it, its stderr in signalled.txt, and sends it the signal once the condition holds, at most a minute later. Its exit code.
signalled() {
    local signal=$1 condition=$2 process i
    shift 2
    : >signalled.txt
    "$@" 2>signalled.txt >/dev/null &
    process=$!
    for ((i = 0; i < 1200; i++)); do
        eval "$condition" && break
        sleep 0.05
    done
    kill "-$signal" $process
    wait $process 2>/dev/null
}

# exists FILE…; absent FILE… (patterns of the shell allowed): no file, also none of the hidden temporary ones.
exists() {
    local file
    for file; do [[ -s $file ]] || fail "$file is missing or empty"; done
}
absent() {
    local file
    for file; do [[ ! -e $file ]] || fail "$file should not be there"; done
}

# same A B; differ A B
same() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }
differ() { ! cmp -s "$1" "$2" || fail "$1 and $2 are the same"; }

# no_temporaries FOLDER: nothing hidden was left behind
no_temporaries() {
    local left
    left=$(find "$1" -mindepth 1 -name '.*')
    [[ -z $left ]] || fail "left behind: $left"
}

render() { "$MANGATA" render "$@"; }
simple=$SOURCE/scenes/simple.json
small=(--size 64x36)
null=(--backend null)

finish() {
    ((failures == 0)) || echo "$failures failures"
    exit $((failures > 0))
}
