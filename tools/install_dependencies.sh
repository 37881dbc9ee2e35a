#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the packages that are missing on Debian and Ubuntu:  tools/install_dependencies.sh [GROUP ...]
# A group is a list below; build is the default.
# Does nothing if all are there. On other systems it prints what is needed and leaves the rest to you.
set -euo pipefail

build=(g++ cmake ninja-build libcli11-dev libfmt-dev nlohmann-json3-dev libfast-float-dev libboost-dev libhwy-dev libtbb-dev zlib1g-dev)
python=(python3 python3-dev python3-numpy pybind11-dev python3-pybind11 python3-pip python3-setuptools python3-wheel python3-venv)
test=(libgtest-dev libgmock-dev librapidcheck-dev libqhull-dev libcdd-dev lrslib libcgal-dev libeigen3-dev libgmp-dev
      libmpfr-dev python3-scipy python3-pytest python3-hypothesis python3-matplotlib python3-pandas python3-tqdm python3-meshio python3-numpydoc
      qhull-bin python3-yaml python3-jinja2 pkgconf groff man-db zsh fish)
nightly=(python3-skimage python3-libpysal python3-ase python3-pymatgen python3-xarray python3-vtk9 python3-gudhi)
bench=(python3 python3-scipy libbenchmark-dev)
paper=(python3 python3-numpy python3-scipy python3-matplotlib libqhull-dev libtet1.5-dev libcdd-dev libcdd-tools lrslib libppl-dev libcgal-dev
       libeigen3-dev libgmp-dev libmpfr-dev voro++-dev)
lint=(clang-format clang-tidy python3)
clang=(clang)
site=(python3-sphinx python3-myst-parser furo doxygen)
browser=(chromium chromium-driver python3-selenium python3-pil)
packages=(debhelper dpkg-dev dh-python fakeroot lintian mmdebstrap pkgconf)
mingw=(g++-mingw-w64-x86-64-posix wine wine64 dpkg-dev googletest)
aarch64=(g++-aarch64-linux-gnu qemu-user-static python3)
s390x=(g++-s390x-linux-gnu qemu-user-static python3)
libcxx=(clang libc++-dev libc++abi-dev googletest python3)
js=(emscripten nodejs python3 python3-numpy dpkg-dev googletest brotli node-typescript)
octave=(octave octave-dev gnuplot-nox fonts-freefont-otf pkgconf python3)
r=(r-base-core r-base-dev r-cran-testthat r-cran-knitr r-cran-rmarkdown r-cran-rgl r-cran-geometry r-cran-roxygen2 pandoc qpdf devscripts
   apt python3)
mpi=(libopenmpi-dev openmpi-bin python3 python3-numpy python3-mpi4py)

wanted=()
for group in "${@:-build}"; do
  case $group in
    build) wanted+=("${build[@]}") ;;
    python) wanted+=("${build[@]}" "${python[@]}") ;;
    test) wanted+=("${build[@]}" "${python[@]}" "${test[@]}") ;;
    nightly) wanted+=("${build[@]}" "${python[@]}" "${test[@]}" "${nightly[@]}") ;;
    bench) wanted+=("${build[@]}" "${python[@]}" "${bench[@]}") ;;
    paper) wanted+=("${build[@]}" "${bench[@]}" "${paper[@]}") ;;
    lint) wanted+=("${build[@]}" "${lint[@]}") ;;
    clang) wanted+=("${build[@]}" "${clang[@]}") ;;
    mingw) wanted+=("${build[@]}" "${mingw[@]}") ;;
    js) wanted+=("${build[@]}" "${js[@]}") ;;
    octave) wanted+=("${build[@]}" "${octave[@]}") ;;
    r) wanted+=("${build[@]}" "${r[@]}") ;;
    mpi) wanted+=("${build[@]}" "${mpi[@]}") ;;
    aarch64) wanted+=("${build[@]}" "${aarch64[@]}") ;;
    s390x) wanted+=("${build[@]}" "${s390x[@]}") ;;
    libcxx) wanted+=("${build[@]}" "${libcxx[@]}") ;;
    site) wanted+=("${build[@]}" "${python[@]}" "${site[@]}") ;;
    packages) wanted+=("${build[@]}" "${python[@]}" "${packages[@]}") ;;
    browser) wanted+=("${browser[@]}") ;;
    *) echo "usage: $0 [GROUP ...]; the groups are the lists of this script: $(sed -n 's/^\([a-z0-9]*\)=([^)].*/\1/p' "$0" | xargs)" >&2; exit 64 ;;
  esac
done

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "This is not a Debian system; please see to it that you have what these Debian packages hold: ${wanted[*]}" >&2
  exit 0
fi

installed=$(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null || true)
missing=()
for package in "${wanted[@]}"; do
  grep -qxF "installed $package" <<<"$installed" || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "Please install these packages, or run this script as root: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq </dev/null
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null >/dev/null
