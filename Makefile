# SPDX-License-Identifier: MIT
# A thin front of CMake: `make` builds the command build/mangata, `make demo` and `make check` start from nothing.

.PHONY: all setup demo check bench install clean

all: build/build.ninja
	cmake --build build

build/build.ninja:
	cmake --preset release

setup:
	scripts/setup

# Recipes rather than prerequisites keep the order under `make -j`.
demo: setup
	$(MAKE) --no-print-directory all
	scripts/demo

check: setup
	scripts/check

bench: all
	scripts/bench

install: all
	cmake --install build

clean:
	rm -rf build demo
