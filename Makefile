# SPDX-License-Identifier: MIT
# A thin front of CMake: `make` builds the libraries, the command build/mangata and the viewer; `make demo`, `make test` (a few minutes) and `make check`
# (everything) start from nothing.

.PHONY: all setup demo test check fuzz bench bench-gpu install clean

all:
	[ -f build/build.ninja ] || cmake --preset release
	cmake --build build --target products

setup:
	scripts/setup

# The steps are recipes, not prerequisites, so that they keep their order under `make -j`.
demo: setup
	[ -f build/build.ninja ] || cmake --preset release
	cmake --build build --target mangata buoyancy web_page
	scripts/demo

test: setup
	scripts/check --quick

check: setup
	scripts/check

# HOURS of the clock; corpora grow from run to run.
fuzz: setup
	scripts/fuzz $(or $(HOURS),0.1)

bench: all
	cmake --build build --target benchmarks
	scripts/bench

bench-gpu: all
	cmake --build build --target benchmarks
	scripts/bench_gpu

# Everyone may read what is installed, whatever the umask of who installs it.
install: all
	umask 022 && cmake --install build

clean:
	rm -rf build demo
