# SPDX-License-Identifier: MIT
# Manual pages and completions as the command makes them: complete, without warnings, and knowing methods, layers, keys and files.
. "$CHECK"

python=/usr/bin/python3
[[ -x $python ]] || python=python3
command -v "$python" >/dev/null || { echo "not tested: no python3"; exit 77; }
# In whatever locale a build runs.
LC_ALL=C PYTHONUTF8=0 PYTHONCOERCECLOCALE=0 timeout 60 "$python" "$SOURCE/scripts/man_pages" "$MANGATA" made || fail "scripts/man_pages"

verbs=$("$MANGATA" --help | sed -n '/^verbs:/,/^options:/s/^  \([a-z]*\)  *.*/\1/p')
for verb in $verbs; do
    exists made/mangata-$verb.1
    # Every option of the help stands in the page.
    for option in $("$MANGATA" $verb --help | sed -n 's/^  \(-., \|    \)--\([a-z0-9-]*\).*/\2/p'); do
        grep -q -- "\\\\-\\\\-${option//-/\\\\-}\\\\fR" made/mangata-$verb.1 || fail "mangata-$verb.1 lacks --$option"
    done
done
exists made/mangata-viewer.1
grep -q -- '\\-\\-shaders\\fR' made/mangata-viewer.1 && grep -q '^.SS Keys' made/mangata-viewer.1 || fail "mangata-viewer.1 lacks options or keys"
if command -v man >/dev/null && command -v nroff >/dev/null; then
    for page in made/*.1; do
        warnings=$(MANROFFSEQ='' MANWIDTH=100 man --warnings -E UTF-8 -l -Tutf8 -Z "$page" 2>&1 >/dev/null)
        [[ -z $warnings ]] || fail "$page: $(head -n 3 <<<"$warnings")"
    done
fi

bash -n made/mangata.bash || fail "mangata.bash"
completes() { # WORDS… of which the last one is begun; prints what it may become
    bash -c '
        compopt() { :; }
        . "$1"
        shift
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
        _mangata mangata "${@: -1}" "${@: -2:1}"
        printf "%s\n" "${COMPREPLY[@]}"' bash made/mangata.bash mangata "$@"
}
has() { # WORD WORDS…
    local wanted=$1
    shift
    completes "$@" | grep -Fxq -- "$wanted" || fail "no $wanted for: mangata $*: $(completes "$@" | head -n 5 | tr '\n' ' ')"
}
touch a.yaml b.c
mkdir folder
has render ren
has --method render a.yaml --me
has podee-pixel render --method p
has ssaa4 render --method = ssaa
has coverage render --layer c
has two-phase render --refraction t
has prores render --codec ''
has light.elevation_deg= render --set light.e
has water.wind= render --set water.w
has a.yaml render a
has folder render f
has json compare --progress j
[[ -z $(completes render b.) ]] || fail "completes files that are no scenes or pictures: $(completes render b.)"
for verb in $verbs; do has --help $verb --he; done
if command -v zsh >/dev/null; then
    timeout 20 zsh -n made/_mangata || fail "_mangata"
    # What a terminal of zsh offers.
    printf '%s\n' 'mangata ren' 'mangata render --me' 'mangata render --method=p' 'mangata render --set light.e' 'mangata render ' 'mangata render --layer c' 'mangata compare --progress j' \
        'mangata diff --error-' >made/lines
    timeout 60 zsh -f "$SOURCE/tests/command/zsh_complete.zsh" made <made/lines >made/offers 2>&1
    offers() { # LINE OFFER…: these and no others
        local line=$1 found
        shift
        found=$(awk -v line="LINE: $line" '$0 == line { on = 1; next } /^LINE: / { on = 0 } on' made/offers | tr '\n' ' ')
        [[ $found == "$* " ]] || fail "zsh offers for '$line': $found"
    }
    offers 'mangata ren' render
    offers 'mangata render --me' --method
    offers 'mangata render --method=p' podee-pixel podee-uniform
    offers 'mangata render --set light.e' light.elevation_deg=
    offers 'mangata render ' a.yaml folder made
    offers 'mangata render --layer c' color coverage
    offers 'mangata compare --progress j' json
    offers 'mangata diff --error-' --error-map --error-top
else
    echo "NOTICE: no zsh here; its completion was not tried"
fi
finish
