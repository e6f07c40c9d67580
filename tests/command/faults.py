#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes allocations, threads, writes, syncs and renames of the command fail, one call a run: the documented exit code, one line, nothing half written.

usage: faults.py COMMAND SHIM SOURCE [RUNS]     RUNS: how many in all, spread over the calls; 0: every call (default 200)"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

CODES = {"memory": (0, 1), "thread": (0, 75), "write": (73,), "sync": (73,), "rename": (73,)}
# One of its metrics comes from another program, for which it writes two pictures; without them the metric is left out.
HARMLESS = {"compare": (0,)}
KINDS = tuple(CODES)
SCENE = """mangata: 1
image: {width: 24, height: 16}
water: {wind: {speed: 6, count: 24, seed: 2}, choppiness: 0.4}
objects:
  - {mesh: t.gltf}
  - {mesh: t.obj, material: {texture: sand.png}}
  - {mesh: rock.ply, position: [0, -1, -4]}
  - {shape: floor, heights: h.pfm, size: [4, 1, 4], position: [0, -2, -4]}
"""
BASE = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
GLTF = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": BASE}]}
SMALL = ["--set", "image.width=16", "--set", "image.height=9", "--threads", "2"]
WORK = {
    "load": ["scene", "check", "s.yaml"],
    "render png": ["render", "s.yaml", "-o", "out.png", "--threads", "2", "-q"],
    "render exr": ["render", "s.yaml", "-o", "out.exr", "--threads", "2", "--layer", "all", "--method", "adaptive", "--samples", "2", "-q"],
    "render y4m": ["render", "simple.json", "-o", "out.y4m", "--frames", "0-1", *SMALL, "-q"],
    "render pfm": ["render", "simple.json", "-o", "out.pfm", "--method", "podee-pixel", *SMALL, "-q"],
    "compare": ["compare", "simple.json", "-o", "out", "--methods", "none", "--frames", "0", "--size", "8x8", "--spatial", "2", "--time-samples", "2", "--threads", "2", "-q"],
    "diff": ["diff", "a.exr", "b.exr"],
}


def prepare(folder, source):
    with open(folder + "/s.yaml", "w", encoding="utf-8") as file:
        file.write(SCENE)
    with open(folder + "/t.gltf", "w", encoding="utf-8") as file:
        json.dump(GLTF, file)
    with open(folder + "/t.obj", "w", encoding="utf-8") as file:
        file.write("v 0 0 -3\nv 1 0 -3\nv 0 1 -3\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
    for name in ("models/rock.ply", "models/sand.png", "simple.json"):
        shutil.copy(f"{source}/scenes/{name}", folder)
    shutil.copy(source + "/tests/data/scenes/floor.pfm", folder + "/h.pfm")


def run(command, shim, words, folder, kind="", at=0, count=None):
    environment = {**os.environ, "LD_PRELOAD": shim, "FAULT_KIND": kind, "FAULT_AT": str(at)}
    if count:
        environment["FAULT_COUNT"] = count
    done = subprocess.run([command, *words], cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120, check=False)
    return done.returncode, done.stderr.decode(errors="replace")


def outputs(folder):
    """What a run has written, the names of files alone."""
    return sorted(os.path.join(where, name) for where, _, names in os.walk(folder) for name in names if "out" in os.path.relpath(where, folder) or name.startswith((".", "out")))


def main():
    if len(sys.argv) < 4 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        return 64
    command, shim, source = sys.argv[1:4]
    runs = int(sys.argv[4]) if len(sys.argv) > 4 else 200
    folder = tempfile.mkdtemp(prefix="mangata-faults-")
    prepare(folder, source)
    for name in ("a.exr", "b.exr"):
        code, message = run(command, shim, ["render", "simple.json", "-o", name, *SMALL, "-q"], folder)
        assert code == 0, message
    counts = {}
    for work, words in WORK.items():
        for kind in KINDS:
            code, message = run(command, shim, words, folder, kind, 0, folder + "/count")
            assert code == 0, f"{work}: exit code {code}: {message}"
            with open(folder + "/count", encoding="utf-8") as file:
                counts[work, kind] = int(file.read())
            clean(folder)
    share = 1  # of the calls of one kind in one piece of work, so that there are `runs` in all
    while share < max(counts.values()) and sum(min(c, share + 1) for c in counts.values()) <= runs:
        share += 1
    failed, done, start, tolerated = 0, 0, time.monotonic(), 0
    for (work, kind), count in counts.items():
        wanted = range(1, count + 1) if runs == 0 or count <= share else sorted({1 + i * (count - 1) // max(share - 1, 1) for i in range(share)})
        for at in wanted:
            code, message = run(command, shim, WORK[work], folder, kind, at)
            left = outputs(folder)
            wrong = []
            if code not in CODES[kind] + HARMLESS.get(work, ()):
                wrong.append(f"exit code {code}, not {' or '.join(map(str, CODES[kind]))}")
            if code != 0 and message.count("\n") != 1:
                wrong.append(f"says {message!r}")
            if any(os.path.basename(path).startswith(".") for path in left):
                wrong.append(f"leaves {left}")
            if code != 0 and work.startswith("render") and any(not path.endswith(".json") for path in left) and kind not in ("sync", "rename"):
                wrong.append(f"leaves {left}")
            if wrong:
                failed += 1
                print(f"FAIL {work}, {kind} {at} of {count}: " + "; ".join(wrong))
            tolerated += code == 0
            done += 1
            clean(folder)
    shutil.rmtree(folder)
    for kind in KINDS:
        print(f"{kind}: " + ", ".join(f"{work} {counts[work, kind]}" for work in WORK) + " calls")
    print(f"{done} calls failed, one a run, {tolerated} of them without harm, {failed} wrongly, in {time.monotonic() - start:.0f} s")
    return 1 if failed else 0


def clean(folder):
    for path in outputs(folder):
        os.remove(path)
    shutil.rmtree(folder + "/out", ignore_errors=True)


sys.exit(main())
