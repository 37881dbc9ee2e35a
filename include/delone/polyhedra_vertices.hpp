// SPDX-License-Identifier: BSD-3-Clause
// The vertices, rays and lines of many small polyhedra at once.
#pragma once

#include <delone/export.hpp>
#include <delone/options.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone {

/// What generates n polyhedra of R^d, one after the other. Polyhedron i has the vertices vertex_offsets[i] …
/// vertex_offsets[i+1]−1, and so on. All are those of Polyhedron, in its order.
struct PolyhedraVertices {
  int dimension = 0;                        ///< d
  std::vector<int> affine_dimensions;       ///< n: k ≤ d; −1 for the empty set
  std::vector<std::size_t> vertex_offsets;  ///< n+1
  std::vector<double> vertices;             ///< d coordinates each, rounded to the nearest doubles
  std::vector<std::size_t> ray_offsets;     ///< n+1
  std::vector<double> rays;                 ///< d each: directions, as of RationalRows::to_scaled_doubles()
  std::vector<std::size_t> line_offsets;    ///< n+1
  std::vector<double> lines;                ///< d each

  std::size_t size() const { return affine_dimensions.size(); }
};

/// The generators of the polyhedra {x : a·x ≤ b}, of `num_rows` inequalities each: `matrices` has n·num_rows
/// rows of d coefficients, `bounds` has n·num_rows numbers. As exact as Polyhedron; a loop takes some ten
/// times as long. Up to Options::threads threads share the polyhedra. Throws Errc::bad_dimension for another
/// number of entries, and Errc::not_finite; rows() names the polyhedra. Otherwise as
/// Polyhedron::from_inequalities.
DELONE_EXPORT PolyhedraVertices polyhedra_vertices(std::span<const double> matrices,
                                                   std::span<const double> bounds, std::size_t num_rows,
                                                   int dimension, const Options& options = {});

}  // namespace delone
