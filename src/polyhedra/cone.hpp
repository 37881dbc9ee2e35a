// SPDX-License-Identifier: BSD-3-Clause
// From the inequalities and equations of a polyhedral cone to its rays and lines, by the double description
// method (Motzkin et al. 1953; Fukuda and Prodon, doi:10.1007/3-540-61576-8_77). Applied to generators as
// rows it finds inequalities and equations, because that is the same for the polar cone.
//
// 1. Equations are solved: their kernel gives coordinates in which there are none (cone.cpp).
// 2. Rows become primitive; duplicates and zeros are dropped. Coordinates that are pivots of the rows remain,
//    which is a quotient by the lineality space: the cone has no line in them.
// 3. Rows are sorted. The first ones that are independent define a simplicial cone.
// 4. Each further row removes the rays beyond it, and adds a ray on each edge that it cuts
//    (double_description.cpp).
#pragma once

#include "polyhedra/bit_rows.hpp"
#include "polyhedra/double_description.hpp"
#include "polyhedra/integer_rows.hpp"

#include <cstddef>
#include <vector>

namespace delone::polyhedra {

/// The cone {x : row·x ≥ 0 for the rows, equation·x = 0 for the equations} of R^dimension as the cone of its
/// rays plus the space of its lines.
struct ConeRays {
  Rows rays;   ///< primitive; one of each class modulo the lines, which is extreme there
  Rows lines;  ///< a basis of the lineality space
  /// For each ray the rows that it lies on, all that are facets at least.
  BitRows zeros;
};

/// Finds the rays of a pointed cone, in up to so many threads (Options::threads).
using PointedMethod = PointedRays (*)(const PointedCone& cone, unsigned threads);

/// Throws Errc::cancelled, too_many, and at limits. `threads`: as Options::threads. `method`: another one is
/// for measurements.
ConeRays find_rays(const Rows& rows, const Rows& equations, std::size_t dimension, unsigned threads = 1,
                   PointedMethod method = find_rays_of_pointed);

}  // namespace delone::polyhedra
