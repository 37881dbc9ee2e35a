// SPDX-License-Identifier: BSD-3-Clause
// Both descriptions of a polyhedron, minimal and in a canonical form. Everything is homogeneous and integer:
// a row of d+1 entries, the last one for x_0, stands for an inequality row·(x, 1) ≥ 0 or an equation, for the
// point x/x_0 if x_0 > 0, and for the direction x if x_0 = 0. The polyhedron is the part x_0 = 1 of a cone,
// on which x_0 ≥ 0: the inequality of infinity, which is in no description.
#pragma once

#include "polyhedra/bit_rows.hpp"
#include "polyhedra/integer_rows.hpp"

#include <delone/polyhedron.hpp>

#include <cstddef>
#include <vector>

namespace delone::polyhedra {

/// Rows are primitive. Equations and lines are fully reduced, with pivots as early as possible; facets have
/// zeros at the pivots of equations, generators at those of lines. So each set has one description:
///   facets      sorted by (a, b) of a·x ≤ b
///   generators  vertices sorted by their coordinates, then rays sorted as rows of integers
/// The empty set has the equation (0, …, 0, 1), and no other row.
struct Description {
  std::size_t dimension = 0;  ///< d
  Rows facets, equations;
  Rows generators;  ///< vertices, then rays
  std::size_t num_vertices = 0;
  Rows lines;
  BitRows incidence;  ///< for each generator the facets that it lies on

  /// The same with one more number, that of facets, for infinity, on which rays lie.
  BitRows incidence_with_infinity() const;
  bool is_empty() const { return num_vertices == 0; }
  std::size_t num_rays() const { return generators.size() - num_vertices; }
  std::size_t width() const { return dimension + 1; }
  /// −1 for the empty set.
  int affine_dimension() const {
    return is_empty() ? -1 : static_cast<int>(dimension) - static_cast<int>(equations.size());
  }
};

/// Rows of d+1 integers, primitive or not. `kinds`, if given, gets those of `inequalities`. `threads`: as
/// Options::threads; the description is the same for each number.
Description from_inequalities(Rows inequalities, const Rows& equations, std::size_t dimension,
                              std::vector<RowKind>* kinds = nullptr, unsigned threads = 1);
/// The convex hull of points plus the cone of directions plus the space of lines. Without points, and with
/// directions or lines, the origin is one. `kinds`: those of `generators`. REQUIRES x_0 ≥ 0, and x_0 = 0 for
/// lines.
Description from_generators(Rows generators, const Rows& lines, std::size_t dimension,
                            std::vector<RowKind>* kinds = nullptr, unsigned threads = 1);
/// The description of these rows, which are minimal on both sides: they are reduced and sorted, and
/// incidences are computed.
Description from_minimal_rows(Rows facets, const Rows& equations, Rows generators, const Rows& lines,
                              std::size_t dimension);

/// Whether generators and lines of `part` are in `whole`.
bool includes(const Description& whole, const Description& part);

}  // namespace delone::polyhedra
