# SPDX-License-Identifier: MIT
# What farms need of the command, and contrib/farm without a farm: scripts/farm_test has a real one.
. "$CHECK"

# Shards: every frame in one of them, in none twice.
list=0-9,12,20-41:3,50
works render "$simple" -o 'all_%03d.png' --frames $list "${small[@]}" "${null[@]}" --quiet
for count in 1 2 3 7 40; do
    for ((i = 0; i < count; i++)); do
        works render "$simple" -o 's_%03d.png' --frames $list --shard $i/$count "${small[@]}" "${null[@]}" --quiet
    done
    [[ $(ls s_* | tr -d s) == "$(ls all_* | sed s/all//)" ]] || fail "$count shards: $(ls s_* | tr '\n' ' ')"
    rm s_*
done
works render "$simple" -o 's_%03d.png' --frames $list --shard 1/3 "${small[@]}" "${null[@]}" --quiet
[[ $(ls s_* | tr '\n' ' ') == 's_001.png s_004.png s_007.png s_012.png s_026.png s_035.png s_050.png ' ]] || fail "shard 1/3: $(ls s_* | tr '\n' ' ')"
expect 0 'nothing to render' render "$simple" -o 'n_%d.png' --frames 0-2 --shard 3/4 "${small[@]}" "${null[@]}"
absent n_*
for wrong in 1 2/2 3/2 a/2 0/0 -1/2 0/1000001 0/2/3 ''; do
    expect 64 '^mangata: --shard .*allowed is I/N' render "$simple" -o 'n_%d.png' --shard "$wrong" "${small[@]}" "${null[@]}"
done
expect 64 'shard takes numbered pictures' render "$simple" -o n.mp4 --shard 0/2 "${small[@]}" "${null[@]}"
expect 64 'shard takes numbered pictures' render "$simple" -o n.png --shard 0/2 "${small[@]}" "${null[@]}"

# Machines that render the same files at once end well; each keeps what another has finished meanwhile.
at_once() { # OPTIONS…
    local machines=() machine
    for machine in 1 2 3; do
        render "$simple" --size 32x18 --threads 1 --skip-existing --quiet "$@" 2>once_$machine &
        machines+=($!)
    done
    for machine in 1 2 3; do
        wait "${machines[machine - 1]}" || fail "one of three machines at once, $*: exit code $?: $(cat once_$machine)"
        [[ ! -s once_$machine ]] || fail "one of three machines at once, $*: $(cat once_$machine)"
    done
    expect 0 'kept, nothing to render' render "$simple" --size 32x18 --skip-existing "$@"
}
mkdir once
for ((i = 0; i < 3; i++)); do
    at_once -o 'once/f_%d.pfm' --frames 0-29
    at_once -o 'once/f_%d.png' --frames 0-29
    at_once -o once/f.y4m --frames 0-3
    ! command -v ffmpeg >/dev/null || at_once -o once/f.mp4 --frames 0-3
    no_temporaries once
    rm once/*
done

# A picture that appears after it was looked for and before its name is checked, which here comes a second late.
if command -v strace >/dev/null && [[ -z ${SANITIZED:-} ]]; then
    works render "$simple" -o done.png "${small[@]}" --quiet
    (sleep 0.5; cp done.png .late && mv .late late.png) &
    expect 0 'late.png: kept' strace -f -o /dev/null -P late.png -e trace=newfstatat -e inject=newfstatat:delay_enter=1s:when=1 \
        "$MANGATA" render "$simple" -o late.png "${small[@]}" --skip-existing
    wait
else
    echo "NOTICE: no strace here, or a sanitized build: no picture appeared between look and check"
fi

# Progress as render managers read it: increasing, to the end.
render "$simple" -o 'p_%d.png' --frames 0-3 "${small[@]}" --progress text --quiet 2>progress
grep -vE '^Progress: [0-9]+%$' progress && fail "--progress text: $(cat progress)"
[[ $(tail -n 1 progress) == 'Progress: 100%' ]] || fail "--progress text ends with $(tail -n 1 progress)"
sort -n -k2 -c progress || fail "--progress text runs backwards"
render "$simple" -o 'p_%d.png' --frames 0-3 "${small[@]}" --progress openjd --quiet --overwrite 2>progress
grep -vE '^openjd_(progress: [0-9]+|status: frame [0-3], [1-4] of 4)$' progress && fail "--progress openjd: $(cat progress)"
grep -qx 'openjd_progress: 100' progress || fail "--progress openjd: $(cat progress)"

# Pictures of a comparison, drawn in shards, are kept by the run that measures.
compare=("$MANGATA" compare "$simple" --methods none,mangata --size 16x9 --frames 0-1 --spatial 1 --time-samples 2 --time-runs 0 --metrics rmse)
expect 0 'shard 0/2: 3 pictures rendered' "${compare[@]}" -o report --shard 0/2
expect 0 'shard 1/2: 3 pictures rendered' "${compare[@]}" -o report --shard 1/2
absent report/report.html
expect 0 '0 pictures rendered, 6 kept' "${compare[@]}" -o report
exists report/report.html

# After a signal it says how to go on.
timeout -s TERM --preserve-status 1 "$MANGATA" render "$simple" -o 'k_%d.png' --method reference --spatial 16 --size 3840x2160 2>stderr.txt
grep -q 'skip-existing' stderr.txt || fail "after a signal: $(cat stderr.txt)"

# The Slurm script, with a command that ends as told and a scontrol that says what it was asked.
mkdir bin
printf '#!/bin/sh\necho "$@" >>"%s/calls"\n' "$work" >bin/scontrol
printf '#!/bin/sh\nexit 0\n' >bin/sleep
cat >bin/ends <<END
#!/bin/sh
case " \$* " in *" --dry-run "*) exit \${DRY:-0} ;; esac
echo "\$@" >>"$work/arguments"
exit \$CODE
END
chmod +x bin/*
slurm() { # [NAME=VALUE…] -- WORDS…: runs task 3 of 8
    local values=()
    while [[ $1 != -- ]]; do values+=("$1") && shift; done
    env PATH="$work/bin:$PATH" SLURM_JOB_ID=77 SLURM_ARRAY_JOB_ID=77 SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_COUNT=8 SLURM_CPUS_PER_TASK=2 "${values[@]}" \
        "$SOURCE/contrib/farm/mangata.sbatch" "${@:2}"
}
expect_usage() { # PATTERN [NAME=VALUE…] -- WORDS…: it says how it is used
    slurm "${@:2}" 2>stderr.txt
    [[ $? == 64 ]] || fail "mangata.sbatch ${*:2} does not end with 64: $(cat stderr.txt)"
    grep -q '^usage: sbatch' stderr.txt && grep -q "^mangata.sbatch: .*$1" stderr.txt || fail "mangata.sbatch ${*:2}: $(cat stderr.txt)"
}
task() { # CODE RESTARTS
    rm -f calls
    slurm CODE="$1" MANGATA=ends SLURM_RESTART_COUNT="$2" -- 'a b.yaml' -o 'f_%d.png' 2>/dev/null
    [[ $? == "$1" ]] || fail "mangata.sbatch does not end with $1"
}
for code in 73 75 137 143; do
    task $code 2
    [[ $(cat calls) == 'requeue 77_3' ]] || fail "exit code $code: scontrol $(cat calls)"
    task $code 20
    absent calls
done
for code in 0 1 64 65 66 69; do
    task $code 0
    absent calls
done
# A refusal that a dry run repeats is not tried again.
rm -f calls
slurm CODE=73 DRY=73 MANGATA=ends -- a.yaml -o f.png 2>/dev/null
[[ $? == 73 ]] || fail "mangata.sbatch does not end with 73"
absent calls
[[ $(tail -n 1 arguments) == *'a.yaml -o f.png '* ]] || fail "mangata.sbatch: $(cat arguments)"
works render "$simple" -o frame_003.png --method none "${small[@]}" --quiet
for words in '-o frame_%03d.png --frames 0-7' '-o nowhere/frame_%03d.png'; do
    # shellcheck disable=SC2086 # options are words
    slurm MANGATA="$MANGATA" -- "$simple" "${small[@]}" $words 2>stderr.txt
    [[ $? == 73 ]] || fail "mangata.sbatch $words does not end with 73: $(cat stderr.txt)"
    absent calls
done
rm -f arguments
slurm CODE=0 MANGATA=ends -- 'a b.yaml' -o 'f_%d.png' 2>/dev/null
[[ $(cat arguments) == 'render a b.yaml -o f_%d.png --shard 3/8 --threads 2 --skip-existing --progress text' ]] || fail "mangata.sbatch: $(cat arguments)"

# Arrays that do not begin at 0, or have a step, have all shards; arrays with gaps are refused unless it is said how many tasks there are.
shards_of() { # MIN MAX STEP COUNT ID…
    local id
    rm -f arguments
    for id in "${@:5}"; do
        slurm CODE=0 MANGATA=ends SLURM_ARRAY_TASK_MIN="$1" SLURM_ARRAY_TASK_MAX="$2" SLURM_ARRAY_TASK_STEP="$3" SLURM_ARRAY_TASK_COUNT="$4" SLURM_ARRAY_TASK_ID="$id" -- a.yaml -o f.png
        slurm CODE=0 MANGATA=ends SLURM_ARRAY_TASK_MIN="$1" SLURM_ARRAY_TASK_MAX="$2" SLURM_ARRAY_TASK_STEP="$3" SLURM_ARRAY_TASK_COUNT="$4" SLURM_ARRAY_TASK_ID="$id" -- --part shards a.yaml
    done
    grep -oE -- '--(shard|samples-range) [^ ]*' arguments | cut -d ' ' -f 2 | tr '\n' ' '
}
[[ $(shards_of 1 4 1 4 1 2 3 4) == '0/4 0/4 1/4 1/4 2/4 2/4 3/4 3/4 ' ]] || fail "array 1-4: $(cat arguments)"
[[ $(shards_of 0 6 2 4 0 2 4 6) == '0/4 0/4 1/4 1/4 2/4 2/4 3/4 3/4 ' ]] || fail "array 0-6:2: $(cat arguments)"
[[ $(shards_of 10 16 3 3 10 13 16) == '0/3 0/3 1/3 1/3 2/3 2/3 ' ]] || fail "array 10-16:3: $(cat arguments)"
[[ $(MANGATA_SHARDS=64 shards_of 5 17 1 2 5 17) == '5/64 5/64 17/64 17/64 ' ]] || fail "array 5,17 of 64: $(cat arguments)"
for id in 5 17; do
    expect_usage 'an array with gaps' SLURM_ARRAY_TASK_MIN=5 SLURM_ARRAY_TASK_MAX=17 SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_ID=$id -- a.yaml -o f.png
done

# Too few words, or no job.
for words in '' --part '--part parts' --merge '--merge parts'; do
    # shellcheck disable=SC2086 # options are words
    expect_usage '' -- $words
done
env -u SLURM_JOB_ID -u SLURM_ARRAY_TASK_ID "$SOURCE/contrib/farm/mangata.sbatch" --merge parts a.yaml -o a.exr 2>stderr.txt
[[ $? == 64 ]] || fail "mangata.sbatch without Slurm does not end with 64: $(cat stderr.txt)"
grep -q '^usage: sbatch' stderr.txt || fail "mangata.sbatch without Slurm: $(cat stderr.txt)"

# One frame in parts.
frame=("$simple" --method reference --spatial 2 --time-samples 3 --size 16x9)
for ((i = 0; i < 5; i++)); do
    slurm MANGATA="$MANGATA" SLURM_ARRAY_TASK_ID=$i SLURM_ARRAY_TASK_COUNT=5 -- --part parts "${frame[@]}" 2>stderr.txt || fail "--part $i: $(cat stderr.txt)"
done
slurm MANGATA="$MANGATA" -- --merge parts "${frame[@]}" -o frame.exr 2>stderr.txt || fail "--merge: $(cat stderr.txt)"
works render "${frame[@]}" -o whole.exr --quiet
same whole.exr frame.exr
rm -f arguments
slurm MANGATA=ends CODE=0 -- --part parts x.yaml --method reference
[[ $(cat arguments) == 'render x.yaml --method reference -o parts/3-of-8.sums --samples-range 3/8 --checkpoint 300 --threads 2 --skip-existing --progress text' ]] || fail "--part: $(cat arguments)"

# Templates of Open Job Description, checked by its specification, and their tasks. Frames in parts have the bytes of the whole.
frame+=(--quiet)
if python3 -c 'import yaml' 2>/dev/null; then
    openjd() { python3 "${CHECK%/*}/openjd.py" "$SOURCE/contrib/farm/$1.openjd.yaml" "Command=$MANGATA" "Scene=$simple" "${@:2}" 2>stderr.txt; }
    openjd mangata OutputFolder=. Frames=7-8 'Options=--size 64x36 --backend null' || fail "mangata.openjd.yaml: $(cat stderr.txt)"
    exists frame_0007.exr frame_0008.exr
    grep -qx 'openjd_progress: 100' stderr.txt || fail "mangata.openjd.yaml: $(cat stderr.txt)"
    openjd mangata OutputFolder=. Frames=7 'Options=--size 64x36 --method none' && fail "mangata.openjd.yaml: another picture was kept"
    openjd mangata_parts PartsFolder=openjd_parts OutputFolder=. FileName=o_%d.exr Frames=0-2:2 Parts=3 "Options=${frame[*]:1}" 'PictureOptions=--layer all' ||
        fail "mangata_parts.openjd.yaml: $(cat stderr.txt)"
    grep -qx 'openjd_progress: 100' stderr.txt || fail "mangata_parts.openjd.yaml: $(cat stderr.txt)"
    for i in 0 2; do
        works render "${frame[@]}" -o o_whole.exr --overwrite --frames $i --layer all
        same o_whole.exr o_$i.exr
    done
    [[ $(ls openjd_parts | tr '\n' ' ') == '0_0-of-3.sums 0_1-of-3.sums 0_2-of-3.sums 2_0-of-3.sums 2_1-of-3.sums 2_2-of-3.sums ' ]] || fail "openjd_parts: $(ls openjd_parts)"
else
    echo "NOTICE: no python3-yaml here; the OpenJD templates were not tested"
fi

# The tasks that the Flamenco job types make, as lines of their names, their dependencies and the words of their commands. Those of parts are run.
if command -v node >/dev/null; then
    flamenco() { # TYPE CHUNKS SETTINGS
        node -e '
const [file, chunks, given] = process.argv.slice(1);
const author = {
    Task: (name, type) => ({ name, type, commands: [], before: [], addCommand(c) { this.commands.push(c); }, addDependency(t) { this.before.push(t.name); } }),
    Command: (name, parameters) => ({ name, ...parameters }),
};
const frameChunker = (frames, size) => { if (frames !== "0-9" || size !== (file.includes("parts") ? 1 : 8)) throw "frameChunker"; return chunks.split(" "); };
eval(require("fs").readFileSync(file, "utf8") + ";globalThis.type = JOB_TYPE; globalThis.compile = compileJob;");
const settings = { frames: "0-9", ...JSON.parse(given) };
for (const s of type.settings) {
    if (!["string", "int32"].includes(s.type) || !s.key || !s.description) throw s;
    settings[s.key] ??= s.default;
    if (settings[s.key] === undefined) throw `${s.key} has no value`;
}
const added = [];
compile({ settings, addTask: (t) => {
    for (const b of t.before) if (!added.includes(b)) throw `${t.name} is behind ${b}, which is not added`;
    added.push(t.name);
    const { name, exe, args } = t.commands[0];
    if (t.commands.length !== 1 || name !== "exec" || t.type !== "misc" || !args.every((a) => typeof a === "string")) throw t.name;
    console.log([t.name, t.before.join(","), exe, ...args].join("\t"));
} });
' "$SOURCE/contrib/farm/$1.flamenco.js" "$2" "$3" >tasks.txt 2>stderr.txt || fail "$1.flamenco.js: $(cat stderr.txt)"
    }
    flamenco mangata '0-7 8-9' '{"scene": "a b.yaml", "folder": "/out", "options": "--seed  3"}'
    for chunk in 0-7 8-9; do
        printf 'render-%s||mangata|render|a b.yaml|-o|/out/frame_####.exr|--frames|%s|--skip-existing|--progress|text|--seed|3\n' $chunk $chunk
    done | tr '|' '\t' >expected.txt
    diff expected.txt tasks.txt || fail "mangata.flamenco.js"
    mkdir flamenco_parts
    flamenco mangata_parts '0 2' "{\"scene\": \"$simple\", \"parts\": 3, \"parts_folder\": \"flamenco_parts\", \"folder\": \".\", \"file_name\": \"l_#.exr\",
        \"command\": \"$MANGATA\", \"options\": \"${frame[*]:1}\", \"picture_options\": \"--layer all\"}"
    [[ $(cut -f 1,2 tasks.txt | tr '\t\n' ': ') == 'part-0-0: part-0-1: part-0-2: merge-0:part-0-0,part-0-1,part-0-2 part-2-0: part-2-1: part-2-2: merge-2:part-2-0,part-2-1,part-2-2 ' ]] ||
        fail "mangata_parts.flamenco.js: $(cut -f 1,2 tasks.txt)"
    while IFS=$'\t' read -r -a words; do
        "${words[@]:2}" 2>stderr.txt </dev/null || fail "${words[0]}: $(cat stderr.txt)"
    done < <(sed 's/\t\t/\t-\t/' tasks.txt)
    for i in 0 2; do
        works render "${frame[@]}" -o l_whole.exr --overwrite --frames $i --layer all
        same l_whole.exr l_$i.exr
    done
else
    echo "NOTICE: no node here; the Flamenco job types were not tested"
fi
finish
