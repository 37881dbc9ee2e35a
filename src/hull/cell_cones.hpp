// SPDX-License-Identifier: BSD-3-Clause
// The cones from a point inside a hull over its cells, in binary64: for walks, and to see how far points are
// beyond cells.
#pragma once

#include "hull/hull_state.hpp"

#include <cstddef>
#include <vector>

namespace delone::hull {

/// The inverses of the cones, each computed on first use. The state and the center outlive it unchanged.
class CellCones {
 public:
  /// `center`: as many coordinates as the sites have, which is the affine dimension.
  CellCones(const HullState& state, const double* center)
      : sites_(state.sites()),
        hull_(state.hull()),
        center_(center),
        d_(static_cast<std::size_t>(sites_.ambient)),
        inverses_(hull_.num_cells() * d_ * d_),
        is_known_(hull_.num_cells(), 0) {}

  const SimplicialHull& hull() const { return hull_; }

  /// The matrix that takes x − center to the weights of the cell's vertices; with entries that are not
  /// numbers if binary64 finds the cone to be flat.
  const double* inverse(std::size_t cell);
  /// Coordinate j of the edge from the center to vertex i.
  double edge(std::size_t cell, std::size_t i, std::size_t j) const {
    return sites_.point(hull_.cell(cell)[i])[j] - center_[j];
  }

 private:
  void invert(std::size_t cell, double* result);

  const BoundarySites& sites_;
  const SimplicialHull& hull_;
  const double* center_;
  std::size_t d_;
  std::vector<double> inverses_, matrix_;
  std::vector<char> is_known_;
};

}  // namespace delone::hull
