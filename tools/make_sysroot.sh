#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The libraries that a cross build needs, as Debian packages of another architecture:  tools/make_sysroot.sh arm64|s390x
# They are unpacked in build/sysroot/<processor>, with package lists of their own beside it: the packages of this machine stay as they
# are. The C and C++ libraries come with the cross compiler. Does nothing if the packages are there. For Debian and Ubuntu.
set -euo pipefail

packages=(libhwy-dev libhwy1 libfmt-dev libfmt9 libtbb-dev libtbb12 libtbbbind-2-5 libtbbmalloc2 libgtest-dev libgmock-dev libboost1.74-dev libfast-float-dev
          libcli11-dev nlohmann-json3-dev)
case ${1:-} in
  arm64) processor=aarch64 ;;
  s390x) processor=s390x ;;
  *) echo "usage: $0 arm64|s390x" >&2; exit 64 ;;
esac

cd "$(dirname "$0")/.."
root=$PWD/build/sysroot/$processor
[ "$(cat "$root/packages" 2>/dev/null)" = "${packages[*]}" ] && exit 0
echo "Unpacking packages for $1 in build/sysroot/$processor"
rm -rf "$root"
state=$root/apt
mkdir -p "$state/lists/partial" "$state/cache/archives/partial" "$root/debs"
touch "$state/status"
options=(-qq -o APT::Architecture="$1" -o APT::Architectures::="$1" -o Dir::State="$state" -o Dir::State::lists="$state/lists"
         -o Dir::State::status="$state/status" -o Dir::Cache="$state/cache" -o APT::Sandbox::User="$(id -un)")
apt-get "${options[@]}" update
(cd "$root/debs" && apt-get "${options[@]}" download "${packages[@]}" >/dev/null)
for package in "$root"/debs/*.deb; do dpkg-deb --extract "$package" "$root"; done
rm -rf "$root/debs" "$state"
echo "${packages[*]}" >"$root/packages"
