// SPDX-License-Identifier: BSD-3-Clause
// The canonical hash of a periodic triangulation, the same for all points and bases that stand for the set.
//
// All numbers are integers in units of the finest bit of lattice and vertices. The lattice enters by its
// Hermite normal form, which is unique, a vertex by its translate that is reduced by that form, and a cell by
// its smallest vertex and the differences of the others from it.
#pragma once

#include "periodic/ghost_triangulation.hpp"

#include <delone/complex.hpp>

namespace delone::periodic {

CanonicalHash hash_of(const GhostTriangulation& ghosts, const PeriodicSet& set);

}  // namespace delone::periodic
