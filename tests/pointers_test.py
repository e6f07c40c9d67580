#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Functions, constants, sources and tests that docs/*.md name exist where the pages say.

usage: pointers_test.py SOURCE_DIR

Read are words between backticks: "`NAME`, `NAME` in `FILE`" where FILE is the end of a path in src/ or include/; `NAME_test`; and
names of kernels and shaders."""
import glob
import os
import re
import sys

NAMES = re.compile(r"((?:`\w+`(?:, | and )?)+) in `([\w/.-]+\.[a-z]+)`")
KERNEL = re.compile(r"`(?:[\w-]+/)*(?!NAME|mangata_)([\w-]+\.(?:k|comp|frag|vert|glsl))`")
TEST = re.compile(r"`(\w+_test)`")


def files(*tops):
    return ["/" + os.path.join(folder, name) for top in tops for folder, _, names in os.walk(top) for name in names]


def code(path):
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", open(path[1:], encoding="utf-8").read(), flags=re.S)


def main():
    os.chdir(sys.argv[1])
    sources, tests = files("src", "include"), files("tests")
    shaders = sources + files("examples", "web")
    failed, count = 0, 0
    for page in sorted(glob.glob("docs/*.md") + ["README.md", "CONTRIBUTING.md"] + glob.glob("src/**/README.md", recursive=True)):
        text = re.sub(r"\s*\n\s+|\n(?=[^\n|#-])", " ", open(page, encoding="utf-8").read())
        wrong = []
        for names, file in NAMES.findall(text):
            found = [path for path in sources if path.endswith("/" + file)]
            for name in re.findall(r"\w+", re.sub(r"` and `", "` `", names)):
                count += 1
                if not any(re.search(rf"\b{name}\b", code(path)) for path in found):
                    wrong.append(f"{name} in {file}")
        for name in TEST.findall(text):
            count += 1
            if not any(os.path.basename(path).rpartition(".")[0] == name for path in tests):
                wrong.append(name)
        for file in KERNEL.findall(text):
            count += 1
            if not any(path.endswith("/" + file) for path in shaders):
                wrong.append(file)
        for what in wrong:
            print(f"{page}: {what} does not exist", file=sys.stderr)
        failed += len(wrong)
    print(f"{count} names")
    return failed > 0 or count < 100


sys.exit(main())
