#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Each script of scripts/ prints its usage for --help, and tells an unknown option in the last line of stderr with exit code 64, or 2 where it is in Python, before
# it does anything. A wrong regular expression is told in the same way. usage: scripts_test.sh SOURCE_DIR
set -u
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/empty"
cd "$work/empty" || exit 1
failed=0

fail() { # SCRIPT WHAT
    echo "FAIL $1: $2: $(tail -n 1 "$work/stderr")"
    failed=1
}

count=0
for script in "$source"/scripts/*; do
    [[ -x $script ]] || continue # others read it
    name=${script##*/}
    count=$((count + 1))
    timeout 20 "$script" --help >"$work/stdout" 2>"$work/stderr" </dev/null || fail "$name --help" "exit code $?"
    [[ ! -s $work/stderr ]] || fail "$name --help" "it writes to stderr"
    grep -Eq "(usage: |^ *)(scripts/)?$name\b" "$work/stdout" || fail "$name --help" "no usage"
    code=64
    [[ $(head -n 1 "$script") != *python3 ]] || code=2
    timeout 20 "$script" --no-such-option >"$work/stdout" 2>"$work/stderr" </dev/null
    result=$?
    ((result == code)) || fail "$name --no-such-option" "exit code $result instead of $code"
    tail -n 1 "$work/stderr" | grep -Eq "^$name: .*(--no-such-option|are required: )" || fail "$name --no-such-option" "not told"
    grep -q 'usage: ' "$work/stderr" || fail "$name --no-such-option" "no usage"
    ((code == 2 || $(wc -l <"$work/stderr") == 1)) || fail "$name --no-such-option" "not one line"
    [[ ! -s $work/stdout ]] || fail "$name --no-such-option" "it writes to stdout"
done
for call in "seas --only" "foam --only" "same_pictures --only" "test_times build"; do
    name=${call%% *}
    # shellcheck disable=SC2086 # words
    timeout 20 "$source"/scripts/$call '[' >"$work/stdout" 2>"$work/stderr" </dev/null
    result=$?
    ((result == 2)) || fail "$call [" "exit code $result instead of 2"
    tail -n 1 "$work/stderr" | grep -q "^$name: error: .*unterminated" || fail "$call [" "not told"
done
[[ -z $(ls -A) ]] || fail "$(ls -A)" "left in the folder"
((count > 30)) || fail "$source/scripts" "$count scripts"
echo "$count scripts"
exit $failed
