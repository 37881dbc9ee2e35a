// SPDX-License-Identifier: BSD-3-Clause
// Step by step from a simplicial cone to that of all rows, and when something else is tried.
#pragma once

#include "polyhedra/bit_rows.hpp"
#include "polyhedra/integer_rows.hpp"

namespace delone::polyhedra {

/// A cone without lines, by rows that are primitive and distinct. The first d of them are independent, and
/// `first_rays` are the rays of the simplicial cone that these define: ray i does not lie on row i.
struct PointedCone {
  Rows rows;
  Rows first_rays;
};

struct PointedRays {
  Rows rays;
  BitRows zeros;  ///< for each ray the rows that it lies on
};

/// The integers with which a conversion begins; others are for tests.
enum class Tier { small, medium, large };

/// The rays of a cone of dimension d ≥ 1, in no particular order. Numbers have 64 bits while these are
/// enough, then 128, then any number: the step in which one is too large is repeated. `threads`: as
/// Options::threads; the rays are the same for each number.
PointedRays find_rays_by_steps(const PointedCone& cone, unsigned threads = 1, Tier first = Tier::small);

/// The same, or by insertion (insertion.hpp), whichever ends first; `zeros` may then miss rows that are no
/// facets.
PointedRays find_rays_of_pointed(const PointedCone& cone, unsigned threads);

}  // namespace delone::polyhedra
