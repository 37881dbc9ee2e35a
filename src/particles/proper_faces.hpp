// SPDX-License-Identifier: BSD-3-Clause
// Which faces of cells have an area, decided exactly: sites with one empty sphere are triangulated in one of
// many ways, and edges inside of their polytope have faces of lower dimension.
#pragma once

#include "base/union_find.hpp"
#include "kernel/flat.hpp"
#include "particles/stars.hpp"
#include "sites/vertex_points.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace delone::particles {

/// Cells of the triangulation that have one sphere are one *class*. So are infinite cells at hull facets in
/// one hyperplane, if the cells behind them are.
class SphereClasses {
 public:
  /// Cost: an exact test for each facet, by up to `threads` threads.
  SphereClasses(const Stars& stars, const sites::VertexPoints& points, const kernel::Flat& flat,
                unsigned threads);

  /// A name of the class of a cell, one of its cells. REQUIRES a cell in a star that is wanted.
  Index of(CellId cell) const { return classes_[index(cell)]; }

 private:
  std::vector<Index> classes_;
};

/// An edge lies in the interior of a face of the sites' polytopes, or is one. If it does, that face is
/// triangulated around it, so one of its other vertices w is joined to both ends; and w belongs to all
/// classes at the edge, each of which has the triangle. If it is a face itself, no w does, as the polytopes
/// of all classes have nothing else in common.
class ProperFaces {
 public:
  explicit ProperFaces(const SphereClasses& classes) : classes_(classes) {}

  void find(const Star& star);
  bool is_proper(std::size_t slot) const { return num_classes_[slot] > 0; }
  /// The number of distinct centers of finite cells at a proper face.
  std::uint32_t num_classes(std::size_t slot) const { return num_classes_[slot]; }

 private:
  const SphereClasses& classes_;
  std::vector<std::uint32_t> num_classes_, offsets_, at_edge_;
  std::vector<std::pair<std::uint32_t, Index>> others_;  // slots and classes
  std::vector<Index> found_;
};

}  // namespace delone::particles
