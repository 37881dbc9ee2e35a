#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The Python module, against the shared library. Run by conda-build after build_library.sh, whose objects are taken.
set -euo pipefail
cmake -S . -B build/conda -G Ninja ${CMAKE_ARGS:-} -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$PREFIX" \
  -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_SHARED_LIBS=ON -DDELONE_BUILD_MPI=OFF -DDELONE_WITH_TBB=ON -DDELONE_WITH_ZLIB=ON \
  -DDELONE_BUILD_CLI=OFF -DDELONE_BUILD_PYTHON=ON -DPython_EXECUTABLE="$PYTHON"
cmake --build build/conda --parallel "${CPU_COUNT:-1}" --target delone_python
cmake --install build/conda --component python --prefix "$SP_DIR"
"$PYTHON" -B setup.py -q egg_info --egg-base "$SP_DIR"
