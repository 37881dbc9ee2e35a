# SPDX-License-Identifier: BSD-3-Clause
# The everyday commands. Each installs what is missing (Debian and Ubuntu), configures, builds and runs.
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := build

jobs := $(shell nproc)
launcher := $(if $(shell command -v ccache),-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
python_of_build = $(shell sed -n 's/^_\?Python_EXECUTABLE:[A-Z]*=//p' build/release/CMakeCache.txt | head -n 1)
python_with_plots = $(shell for p in python3 /usr/bin/python3; do $$p -c "import matplotlib, scipy" 2>/dev/null && echo $$p && break; done)
version = $(shell sed -n 's/^project.delone VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
sources = $(shell git ls-files --cached --others --exclude-standard '*.hpp' '*.cpp' '*.h' '*.c')

# Every target with a description.
.PHONY: $(shell sed -n 's/^\([a-z0-9-]*\):.*\#\# .*/\1/p' Makefile)

help:                 ## list these targets
	@sed -n 's/^\([a-z0-9-]*\):.*## /\1\t/p' Makefile | expand -t 16

build:                ## build the command (build/release/delone) and the library
	tools/install_dependencies.sh build
	cmake --preset release $(launcher) >/dev/null
	cmake --build --preset release -j $(jobs)

python:               ## build the Python module; use it with PYTHONPATH=build/release/python
	tools/install_dependencies.sh python
	cmake --preset release $(launcher) -DDELONE_BUILD_PYTHON=ON >/dev/null
	cmake --build --preset release -j $(jobs)

wheel: python         ## build a wheel that needs no other libraries, in build/wheels
	DELONE_BUILD_DIR=build/release $(python_of_build) -m pip wheel --no-build-isolation --no-deps --no-index -w build/wheels .
	@echo "The wheel: $$(ls -t build/wheels/delone-*.whl | head -n 1)"

wheels:               ## build a source distribution and a wheel from it, and run the Python tests with that wheel in a new environment
	tools/install_dependencies.sh test
	for p in python3 /usr/bin/python3; do if $$p -c "import numpy, pytest, hypothesis, wheel" 2>/dev/null; then \
	  exec $$p -B tests/python/check_wheel.py --full $(version) --wheels build/wheels; fi; done; exit 1

demo:                 ## triangulate, check and draw three real data sets
	tools/install_dependencies.sh build
	cmake --preset release $(launcher) >/dev/null
	cmake --build --preset release -j $(jobs) --target delone_cli
	tools/demo.sh build/release build/demo

test:                 ## run all tests of a release build
	tools/install_dependencies.sh test
	cmake --preset test $(launcher)
	cmake --build --preset test -j $(jobs)
	ctest --preset test

fuzz:                 ## run every fuzz target under sanitizers for five minutes; FUZZ_SECONDS=60: for one minute
	tools/install_dependencies.sh test clang
	cmake --preset fuzz $(launcher) -DDELONE_FUZZ_SECONDS=$(or $(FUZZ_SECONDS),300)
	cmake --build --preset fuzz -j $(jobs)
	ctest --preset fuzz

matrix:               ## build and test all other configurations and print a table, in about an hour; KINDS="tsan mpi": only these
	tools/matrix.py $(KINDS)

asan:                 ## run smaller unit and fuzz tests under AddressSanitizer and UndefinedBehaviorSanitizer
	tools/install_dependencies.sh test clang
	cmake --preset asan $(launcher)
	cmake --build --preset asan -j $(jobs)
	ctest --preset asan

tsan:                 ## run the tests that use threads under clang's ThreadSanitizer
	tools/install_dependencies.sh test clang
	cmake --preset tsan $(launcher)
	cmake --build --preset tsan -j $(jobs)
	ctest --preset tsan

without-tbb:          ## run the tests of units and of the command in a build without threads
	tools/install_dependencies.sh test
	cmake --preset without-tbb $(launcher)
	cmake --build --preset without-tbb -j $(jobs)
	ctest --preset without-tbb

portable:             ## the same in a build without compiler extensions and system calls; the hashes must be equal
	tools/install_dependencies.sh test
	cmake --preset portable $(launcher)
	cmake --build --preset portable -j $(jobs)
	ctest --preset portable

mingw:                ## build for Windows with MinGW-w64, and run the unit tests under Wine
	tools/install_dependencies.sh test mingw
	tools/build_cross_packages.sh mingw $(jobs)
	cmake --preset mingw $(launcher)
	cmake --build --preset mingw -j $(jobs)
	mkdir -p build/mingw-packages/wine
	# One server for all programs: to start and end it for each fails at times. 2: it is there.
	WINEPREFIX=$(CURDIR)/build/mingw-packages/wine PATH=$$PATH:/usr/lib/wine wineserver -p60 || [ $$? = 2 ]
	ctest --preset mingw

aarch64:              ## build for 64-bit ARM, and run the unit tests and the tests of hashes under QEMU
	tools/install_dependencies.sh build aarch64
	tools/make_sysroot.sh arm64
	cmake --preset aarch64 $(launcher)
	cmake --build --preset aarch64 -j $(jobs)
	ctest --preset aarch64

s390x:                ## the same for s390x, which is big-endian
	tools/install_dependencies.sh build s390x
	tools/make_sysroot.sh s390x
	cmake --preset s390x $(launcher)
	cmake --build --preset s390x -j $(jobs)
	ctest --preset s390x

libcxx:               ## the same with clang and libc++ on this machine
	tools/install_dependencies.sh build libcxx
	cmake --preset libcxx $(launcher)
	cmake --build --preset libcxx -j $(jobs)
	ctest --preset libcxx

mpi:                  ## run the tests of delone::mpi at full size, with 1, 2, 3 and 5 ranks
	tools/install_dependencies.sh test mpi
	cmake --preset test $(launcher) -DDELONE_BUILD_MPI=ON
	cmake --build --preset test -j $(jobs) --target delone_cli delone_mpi_cli delone_mpi_tests delone_python delone_python_mpi
	DELONE_TEST_SCALE=large ctest --preset test -L mpi

packages:             ## build Debian packages of the committed tree in build/packages, and try them in a clean system (as root)
	tools/install_dependencies.sh packages
	tools/debian_packages.py

trixie:               ## build a wheel of the committed tree in a Debian 13 in build/trixie, and run the Python tests and SciPy's own there (as root)
	tools/install_dependencies.sh packages
	tools/other_debian.py trixie

octave:               ## build the Octave package on an installed C library in build/release/octave, and run its tests and Octave's own
	tools/install_dependencies.sh octave
	cmake --preset release $(launcher) >/dev/null
	cmake --build --preset release -j $(jobs)
	cmake --install build/release --prefix build/release/octave/prefix >/dev/null
	python3 -B tests/octave/run.py build/release

r:                    ## check the R package on an installed C library in build/release/r, and run the tests of package geometry with it
	tools/install_dependencies.sh r
	cmake --preset release $(launcher) >/dev/null
	cmake --build --preset release -j $(jobs)
	python3 -B tests/r/run.py build/release

npm:                  ## build the npm package in build/js/delone, by emscripten
	tools/install_dependencies.sh js
	tools/build_cross_packages.sh emscripten $(jobs)
	cmake --preset js >/dev/null
	cmake --build --preset js -j $(jobs)

js: npm               ## test the npm package in Node and in Chromium: its results must be those of the native library
	tools/install_dependencies.sh browser
	cmake --preset release $(launcher) >/dev/null
	cmake --build --preset release -j $(jobs)
	/usr/bin/python3 -B tests/js/run.py build/js/delone build/release

bench: python         ## time the standard constructions, in some minutes
	tools/install_dependencies.sh bench
	python3 benchmarks/construction.py build/release/delone
	PYTHONPATH=build/release/python $(python_of_build) benchmarks/python.py

paper:                ## repeat the experiments of the report in build/paper, in an hour; QUICK=1: in minutes; DOCS=1: replaces docs/experiments.md; HULL=/path/to/hull
	tools/install_dependencies.sh paper
	cmake --preset bench $(launcher) >/dev/null
	cmake --build --preset bench -j $(jobs)
	PYTHONPATH=benchmarks $(python_with_plots) -m paper --build build/bench $(if $(QUICK),--quick) $(if $(DOCS),--docs) $(if $(HULL),--hull $(HULL)) $(PAPER)

site: pictures        ## build the documentation as a site in build/site: pages, references of Python, C++ and the command, and the page to try it if emscripten is there
	tools/install_dependencies.sh site
	if command -v em++ >/dev/null; then $(MAKE) npm; fi
	for p in $(python_of_build) python3 /usr/bin/python3; do if $$p -c "import furo, myst_parser, numpy" 2>/dev/null; then exec $$p -B tools/make_site.py build/release; fi; done; exit 1

pictures: python      ## make the pictures of the documentation again that are stale
	tools/pictures.py --check >/dev/null || tools/install_dependencies.sh browser paper
	tools/pictures.py build/release

docs: pictures        ## run the examples of the documentation and follow its links
	tools/check_docs.py build/release --python $(python_of_build)

browser: site         ## test the site in Chromium, as on a phone, and the pages of `delone view`
	tools/install_dependencies.sh browser
	SITE=build/site /usr/bin/python3 -B tests/site/test_in_browser.py
	SITE=build/site /usr/bin/python3 -B tests/site/test_try.py
	DELONE=build/release/delone /usr/bin/python3 -B tests/site/test_viewer.py

viewer:               ## build viewer/dist/viewer.html, the page that results are embedded in (needs Node and npm)
	cd viewer && npm ci --no-audit --no-fund && node build.mjs

lint:                 ## check formatting, layering and prose, and run clang-tidy
	tools/install_dependencies.sh lint test
	clang-format --dry-run -Werror $(sources)
	tools/check_layering.py
	tools/check_docs.py --prose
	cmake --preset dev $(launcher) >/dev/null
	clang-tidy -p build/dev --quiet $$(git ls-files --cached --others --exclude-standard 'src/*.cpp' 'cli/*.cpp')

format:               ## format all C++ sources
	tools/install_dependencies.sh lint
	clang-format -i $(sources)

clean:                ## remove everything that was built
	rm -rf build
