#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The shared library, the C interface and the command; each package takes its files of them. Run by conda-build.
set -euo pipefail
cmake -S . -B build/conda -G Ninja ${CMAKE_ARGS:-} -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$PREFIX" \
  -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_SHARED_LIBS=ON -DDELONE_BUILD_MPI=OFF -DDELONE_WITH_TBB=ON -DDELONE_WITH_ZLIB=ON
cmake --build build/conda --parallel "${CPU_COUNT:-1}"
cmake --install build/conda
