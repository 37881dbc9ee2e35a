// SPDX-License-Identifier: BSD-3-Clause
// The sites of a periodic set: which vertices of its triangulation with ghosts have cells, whose images the
// others are, and what their numbers are to the caller.
//
// All cells of the triangulation at a vertex that is a point of the set are cells of the whole set, so its
// star is all that its cell needs. Stars of ghosts are open: ghosts have no cells and no lists.
#pragma once

#include "periodic/ghost_triangulation.hpp"
#include "periodic/periodic_set.hpp"

#include <delone/periodic.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::particles {

class PeriodicSites {
 public:
  explicit PeriodicSites(const PeriodicTriangulation& triangulation);

  const Triangulation& triangulation() const { return ghosts_.triangulation(); }
  std::size_t num_rows() const { return set_.num_points(); }
  std::size_t rank() const { return set_.rank; }
  bool has_cell(Index v) const { return ghosts_.is_own(VertexId{v}); }
  /// The first row at the point of a vertex, or at the point that it is an image of.
  Index row_of(Index v) const { return ghosts_.image_of(VertexId{v}).row; }
  const periodic::Image& image_of(Index v) const { return ghosts_.image_of(VertexId{v}); }
  /// Whether points were given outside of the box.
  bool has_wraps() const { return has_wraps_; }
  /// By vertex, whether it has a cell.
  std::vector<unsigned char> have_cells() const;

  /// Of each vertex the translation from where its row was given, as `rank` numbers, if the site is where its
  /// row was given.
  void find_offsets(Index site, std::span<const Index> vertices, std::vector<std::int32_t>& offsets) const;
  /// The point of a row where it was given.
  const double* given_point(std::size_t row) const { return given_.data() + row * set_.dimension; }
  /// The volume of something of so many dimensions in numbers of the caller.
  double outer(double volume, std::size_t dimension) const {
    if (set_.unit == 0) {
      if (set_.scale == 0) return volume;
      return std::ldexp(volume, set_.scale * static_cast<int>(dimension));
    }
    for (std::size_t j = 0; j < dimension; ++j) volume *= set_.unit;
    return volume;
  }

 private:
  const periodic::PeriodicSet& set_;
  const periodic::GhostTriangulation& ghosts_;
  std::span<const double> given_;
  bool has_wraps_;
};

}  // namespace delone::particles
