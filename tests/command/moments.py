#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Sends SIGTERM at random moments of loads, renders, films and comparisons: each ends within a second with exit code 143, or had ended; nothing is half written.

usage: moments.py COMMAND SOURCE [RUNS]     RUNS: 200 where it is left out; SANITIZED=1 in the environment: a build whose time says nothing"""
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SCENE = "mangata: 1\nimage: {width: 96, height: 54}\nwater: {wind: {speed: 8, count: 60}}\nobjects:\n  - {mesh: a.obj}\n  - {mesh: rock.ply}\n"
WORK = {
    "load": (["scene", "check", "s.yaml"], ()),
    "render": (["render", "s.yaml", "-o", "out.png", "--method", "adaptive", "-q"], ("out.png",)),
    "render exr": (["render", "s.yaml", "-o", "out.exr", "--layer", "all", "-q"], ("out.exr",)),
    "film": (["render", "s.yaml", "-o", "out.y4m", "--frames", "0-5", "-q"], ("out.y4m", "out.y4m.json")),
    "compare": (["compare", "simple.json", "-o", "out", "--methods", "none,mangata", "--frames", "0-1", "--size", "64x36", "--spatial", "2", "--time-samples", "4", "-q"], ()),
    "diff": (["diff", "a.pfm", "b.pfm"], ()),
}


def prepare(command, source, folder):
    with open(folder + "/s.yaml", "w", encoding="utf-8") as file:
        file.write(SCENE)
    with open(folder + "/a.obj", "w", encoding="utf-8") as file:
        file.write("v 0 -1 -3\nv 1 -1 -3\nv 0 -1 -4\n" + "f 1 2 3\n" * 50000)
    for name in ("models/rock.ply", "simple.json"):
        shutil.copy(f"{source}/scenes/{name}", folder)
    for name in ("a.pfm", "b.pfm"):
        subprocess.run([command, "render", source + "/scenes/simple.json", "-o", name, "--size", "640x360", "--method", "none", "-q"], cwd=folder, check=True)


def start(command, words, folder):
    return subprocess.Popen([command, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def used(process):
    """Seconds of a core that a process and its ended children have used."""
    with open(f"/proc/{process.pid}/stat", encoding="utf-8") as file:
        words = file.read().rpartition(")")[2].split()
    return sum(int(word) for word in words[11:15]) / os.sysconf("SC_CLK_TCK")


def clean(folder):
    for name in os.listdir(folder):
        if name.startswith("out"):
            path = os.path.join(folder, name)
            shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)


def main():
    if len(sys.argv) < 3 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        return 64
    command, source = sys.argv[1:3]
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 200
    moments = random.Random(1)
    folder = tempfile.mkdtemp(prefix="mangata-moments-")
    prepare(command, source, folder)
    whole, lasts = {}, {}
    for work, (words, outputs) in WORK.items():
        begun = time.monotonic()
        process = start(command, words, folder)
        assert process.wait() in (0, 2), process.stderr.read()
        lasts[work] = time.monotonic() - begun
        for name in outputs:
            with open(os.path.join(folder, name), "rb") as file:
                whole[name] = file.read()
        clean(folder)
    failed, stopped, slowest, busiest = 0, 0, 0, 0
    for i in range(runs):
        work = list(WORK)[i % len(WORK)]
        words, outputs = WORK[work]
        delay = moments.uniform(0, lasts[work])
        process = start(command, words, folder)
        time.sleep(delay)
        before, sent = used(process), time.monotonic()
        os.kill(process.pid, signal.SIGTERM)  # send_signal() would collect one that has ended
        message = process.stderr.read().decode(errors="replace")
        _, status, usage = os.wait4(process.pid, 0)
        code = process.returncode = os.waitstatus_to_exitcode(status)
        took, spent = time.monotonic() - sent, usage.ru_utime + usage.ru_stime - before
        # Before main() the system itself ends the process.
        interrupted = code in (143, -signal.SIGTERM)
        stopped += interrupted
        if interrupted:
            slowest, busiest = max(slowest, took), max(busiest, spent)
        wrong = []
        if not interrupted and code not in (0, 2):
            wrong.append(f"exit code {code}: {message!r}")
        if interrupted and message.count("\n") > 1:
            wrong.append(f"says {message!r}")
        # A second of a machine that has nothing else to do.
        if took > (10 if os.environ.get("SANITIZED") == "1" else 1) * max(1, os.getloadavg()[0] / os.cpu_count()):
            wrong.append(f"takes {took:.2f} s to end, {spent:.2f} s of a core")
        wrong += [f"leaves {name}" for where, _, names in os.walk(folder) for name in names if name.startswith(".")]
        for name in outputs:
            path = os.path.join(folder, name)
            if os.path.exists(path):
                with open(path, "rb") as file:
                    if file.read() != whole[name]:
                        wrong.append(f"{name} is not what a whole run makes")
        if wrong:
            failed += 1
            print(f"FAIL {work} after {delay:.3f} s: " + "; ".join(wrong))
        clean(folder)
    shutil.rmtree(folder)
    print(f"SIGTERM at {runs} moments: {stopped} were stopped, the others had ended; the slowest took {slowest:.2f} s, the busiest {busiest:.2f} s of a core; {failed} failures")
    return 1 if failed or stopped < runs // 4 else 0


sys.exit(main())
