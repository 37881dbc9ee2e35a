#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The libraries that delone needs, for a cross compiler that Debian has no libraries for, in build/KIND-packages/installed: of those that
# are headers alone, links to the ones of this system; Highway, {fmt} and, for tests, GoogleTest compiled from Debian's sources. Does
# nothing if they are there.
#   tools/build_cross_packages.sh mingw|emscripten [jobs]      KIND, that of cmake/toolchains/KIND.cmake
set -euo pipefail
case ${1:-} in
  mingw|emscripten) kind=$1 ;;
  *) echo "usage: $0 mingw|emscripten [jobs]" >&2; exit 64 ;;
esac
jobs=${2:-$(nproc)}
repository=$(cd "$(dirname "$0")/.." && pwd)
packages=$repository/build/$kind-packages
installed=$packages/installed
[ -e "$installed/complete" ] && exit 0

rm -rf "$installed"
mkdir -p "$packages/apt/lists/partial" "$packages/sources" "$installed/include" "$installed/share/cmake"

# The headers of others by themselves: those of this system's C library must not be found.
for headers in boost CLI nlohmann fast_float; do
  ln -s /usr/include/$headers "$installed/include/$headers"
done
cp -r /usr/share/cmake/CLI11 /usr/share/cmake/nlohmann_json "$installed/share/cmake"

# Sources of this Debian release, without a change to this system's lists.
sed 's/^Types:.*/Types: deb-src/' /etc/apt/sources.list.d/debian.sources >"$packages/apt/source.sources"
apt_source=(apt-get -qq -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$packages/apt"
            -o Dir::State::Lists="$packages/apt/lists" -o APT::Sandbox::User=)
cd "$packages/sources"
if ! ls -d highway-*/ fmtlib-*/ >/dev/null 2>&1; then
  "${apt_source[@]}" update
  "${apt_source[@]}" source --only-source highway fmtlib >/dev/null
fi

build() {  # name, source folder, options of CMake
  local name=$1 source=$2
  shift 2
  {
    cmake -S "$source" -B "$packages/build/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF \
      -DCMAKE_TOOLCHAIN_FILE="$repository/cmake/toolchains/$kind.cmake" -DCMAKE_INSTALL_PREFIX="$installed" "$@" &&
      cmake --build "$packages/build/$name" -j "$jobs" &&
      cmake --install "$packages/build/$name"
  } >"$packages/$name.log" || { cat "$packages/$name.log"; exit 1; }
}
build highway "$(echo highway-*/)" -DBUILD_TESTING=OFF -DHWY_ENABLE_TESTS=OFF -DHWY_ENABLE_EXAMPLES=OFF -DHWY_ENABLE_CONTRIB=OFF
build fmt "$(echo fmtlib-*/)" -DFMT_TEST=OFF -DFMT_DOC=OFF
build googletest /usr/src/googletest
touch "$installed/complete"
