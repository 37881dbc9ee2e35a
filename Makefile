# SPDX-License-Identifier: BSD-3-Clause
# The everyday commands. Each installs what is missing (Debian and Ubuntu), configures, builds and runs.
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := build

jobs := $(shell nproc)
launcher := $(if $(shell command -v ccache),-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
sources = $(shell git ls-files --cached --others --exclude-standard '*.hpp' '*.cpp')

.PHONY: build demo test test-release test-asan bench docs lint format clean help

help:                 ## this list
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' Makefile | expand -t 16

build:                ## the command, at build/release/delone, and the library
	tools/install_dependencies.sh build
	cmake --preset release $(launcher) >/dev/null
	cmake --build --preset release -j $(jobs)

demo: build           ## three real data sets: triangulated, checked, drawn
	tools/demo.sh build/release build/demo

test: test-release test-asan  ## everything, then unit, property and fuzz tests under sanitizers

test-release:         ## all tests of a release build
	tools/install_dependencies.sh test
	cmake --preset test $(launcher)
	cmake --build --preset test -j $(jobs)
	ctest --preset test

test-asan:            ## unit, property and fuzz tests, smaller, with AddressSanitizer and UndefinedBehaviorSanitizer
	tools/install_dependencies.sh test
	cmake --preset asan $(launcher)
	cmake --build --preset asan -j $(jobs)
	ctest --preset asan

bench: build          ## the standard constructions, timed; takes minutes
	tools/install_dependencies.sh bench
	python3 benchmarks/construction.py build/release/delone

docs: build           ## run the programs and commands of the documentation, follow its links
	tools/check_docs.py build/release

lint:                 ## formatting, layering, clang-tidy
	tools/install_dependencies.sh lint test
	clang-format --dry-run -Werror $(sources)
	tools/check_layering.py
	cmake --preset dev $(launcher) >/dev/null
	clang-tidy -p build/dev --quiet $$(git ls-files --cached --others --exclude-standard 'src/*.cpp' 'cli/*.cpp')

format:               ## format all C++ sources
	tools/install_dependencies.sh lint
	clang-format -i $(sources)

clean:                ## remove everything that was built
	rm -rf build
