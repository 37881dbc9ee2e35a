#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Three real data sets, triangulated, checked exactly and drawn:  tools/demo.sh BUILD_DIR OUTPUT_DIR
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
out=${2:-build/demo}
delone=$build/delone
[ -x "$delone" ] || { echo "demo: $delone is missing; run 'make build' first" >&2; exit 1; }
mkdir -p "$out"

say() { printf '\n\033[1m%s\033[0m\n' "$*"; }
[ -t 1 ] || say() { printf '\n%s\n' "$*"; }
# Shows a command, then runs it.
try() { printf '$ %s\n' "delone ${*:2}"; "$@"; }

say "1. Earthquakes of one week in space and time: 4 dimensions of very different scale"
columns=longitude,latitude,depth_km,time_ms
try "$delone" delaunay data/earthquakes.csv --columns $columns
try "$delone" delaunay data/earthquakes.csv --columns $columns -o "$out/earthquakes.npz"
try "$delone" check "$out/earthquakes.npz"

say "2. The same earthquakes on the map: a picture"
try "$delone" delaunay data/earthquakes.csv --columns longitude,latitude
try "$delone" delaunay data/earthquakes.csv --columns longitude,latitude -o "$out/earthquakes.svg"

say "3. The atoms of a protein: points in space, tetrahedra for ParaView"
try "$delone" delaunay data/protein.csv
try "$delone" delaunay data/protein.csv -o "$out/protein.npz"
try "$delone" delaunay data/protein.csv -o "$out/protein.vtu"
try "$delone" check "$out/protein.npz"

say "4. Cars: 6 dimensions, decimal numbers, a duplicate"
try "$delone" delaunay data/cars.csv
try "$delone" delaunay data/cars.csv -o "$out/cars.npz"
try "$delone" check "$out/cars.npz"

say "5. A lattice, where every sphere passes through many points: the hash does not depend on the order of insertion"
try "$delone" generate grid -d 4 -n 625 -o "$out/grid.csv"
try "$delone" delaunay "$out/grid.csv" --order as_given
try "$delone" delaunay "$out/grid.csv" --order shuffled --seed 42 | grep -E '^\$|hash'
try "$delone" delaunay "$out/grid.csv" -o "$out/grid.npz"
try "$delone" check --canonical "$out/grid.npz"

say "Written to $out:"
ls -l "$out" | awk 'NR > 1 { printf "  %-20s %10d bytes\n", $NF, $5 }'
