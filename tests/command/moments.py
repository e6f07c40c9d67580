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
    failed, stopped, slowest = 0, 0, 0
    for i in range(runs):
        work = list(WORK)[i % len(WORK)]
        words, outputs = WORK[work]
        delay = moments.uniform(0, lasts[work])
        process = start(command, words, folder)
        time.sleep(delay)
        sent = time.monotonic()
        process.send_signal(signal.SIGTERM)
        message = process.stderr.read().decode(errors="replace")
        code = process.wait()
        took = time.monotonic() - sent
        # Before main() the system itself ends the process.
        interrupted = code in (143, -signal.SIGTERM)
        stopped += interrupted
        slowest = max(slowest, took)
        wrong = []
        if not interrupted and code not in (0, 2):
            wrong.append(f"exit code {code}: {message!r}")
        if interrupted and message.count("\n") > 1:
            wrong.append(f"says {message!r}")
        # A second of a machine that has nothing else to do.
        if took > (10 if os.environ.get("SANITIZED") == "1" else 1) * max(1, os.getloadavg()[0] / os.cpu_count()):
            wrong.append(f"takes {took:.2f} s to end")
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
    print(f"SIGTERM at {runs} moments: {stopped} were stopped, the others had ended; the slowest took {slowest:.2f} s; {failed} failures")
    return 1 if failed or stopped < runs // 4 else 0


sys.exit(main())
