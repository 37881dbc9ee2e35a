// SPDX-License-Identifier: BSD-3-Clause
// The functions behind the names of make_point_set(): each makes n points of R^d, row-major. REQUIRES d ≥ 1
// and a representable n·d.
#pragma once

#include "point_sets/generator.hpp"

#include <cstddef>
#include <vector>

namespace delone::point_sets {

using Coordinates = std::vector<double>;
using Maker = Coordinates (*)(std::size_t d, std::size_t n, Generator& generator);

// Continuous distributions.
Coordinates make_uniform(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_ball(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_sphere(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_gaussian(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_clusters(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_manifold(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_moment(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_plummer(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_offset(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_mixed_scales(std::size_t d, std::size_t n, Generator& generator);

// Lattices.
Coordinates make_grid(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_tilted_grid(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_nudged_grid(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_cube01(std::size_t d, std::size_t n, Generator& generator);

// Exactly flat, exactly cospherical, repeated.
Coordinates make_flat(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_collinear(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_equal(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_duplicates(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_cospherical(std::size_t d, std::size_t n, Generator& generator);
Coordinates make_ulp_sphere(std::size_t d, std::size_t n, Generator& generator);

}  // namespace delone::point_sets
