# SPDX-License-Identifier: MIT
# A thin front of CMake: `make` builds the command build/mangata, `make demo` and `make check` start from nothing.

.PHONY: all setup demo check bench bench-gpu install clean

all:
	[ -f build/build.ninja ] || cmake --preset release
	cmake --build build

setup:
	scripts/setup

# The steps are recipes, not prerequisites, so that they keep their order under `make -j`.
demo: setup
	[ -f build/build.ninja ] || cmake --preset release
	cmake --build build --target mangata
	scripts/demo

check: setup
	scripts/check

bench: all
	scripts/bench

bench-gpu: all
	scripts/bench_gpu

install: all
	cmake --install build

clean:
	rm -rf build demo
