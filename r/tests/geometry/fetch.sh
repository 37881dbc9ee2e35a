#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Unpacks the tests of package geometry, which Debian's package r-cran-geometry has among its documentation:  fetch.sh FOLDER
set -e
folder=$1
mkdir -p "$folder/package"
folder=$(cd "$folder" && pwd)
[ -d "$folder/testthat" ] && exit 0
cd "$folder/package"
apt-get -o APT::Sandbox::User=root download -qq r-cran-geometry
dpkg-deb -x r-cran-geometry_*.deb .
cp -R usr/share/doc/r-cran-geometry/tests/testthat "$folder/"
gunzip -f "$folder"/testthat/*.gz
