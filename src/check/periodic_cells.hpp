// SPDX-License-Identifier: BSD-3-Clause
// The cells of a periodic triangulation for its check: images of points by row and offset, and where they
// are.
//
// Coordinates are exact as long as an image is not farther from another one than the ends of edges can be
// (periodic/period.hpp), so cells are moved until one of their vertices is in the box.
#pragma once

#include "kernel/flat.hpp"
#include "kernel/fractions.hpp"
#include "periodic/periodic_set.hpp"

#include <delone/data.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::internal {

/// A point of the data by its row, translated by an offset in terms of the lattice of the data.
struct PeriodicVertex {
  SignedIndex row = 0;
  std::vector<std::int64_t> offset{};
  friend bool operator==(const PeriodicVertex&, const PeriodicVertex&) = default;
};

class PeriodicCells {
 public:
  /// Throws Violation unless points and lattice are on their grid, and Error for a bad lattice.
  explicit PeriodicCells(const ComplexData& data);

  std::size_t size() const { return data_.num_cells(); }
  std::size_t corners() const { return corners_; }
  std::size_t rank() const { return set_.rank; }
  const periodic::PeriodicSet& set() const { return set_; }
  const ComplexData& data() const { return data_; }
  std::vector<int> axes() const { return axes_; }
  int affine_dimension() const { return static_cast<int>(axes_.size()); }
  kernel::Flat flat() const {
    return {data_.dimension, axes_, set_.weighted ? kernel::RowForm::weighted_point : kernel::RowForm::point};
  }

  PeriodicVertex vertex(std::size_t cell, std::size_t i) const;
  /// Those of the neighbor across a facet, next to the cell.
  std::vector<PeriodicVertex> neighbor_of(std::size_t cell, std::size_t i) const;
  std::vector<PeriodicVertex> vertices(std::size_t cell) const;
  /// The coordinates, and the weight, of v where `base` is in the box. Throws Violation if they are farther
  /// from each other than vertices of a cell.
  std::vector<double> place(const PeriodicVertex& v, const PeriodicVertex& base, std::size_t cell) const;
  /// Whether two images are the same point.
  bool is_same_place(const PeriodicVertex& v, const PeriodicVertex& w) const;

 private:
  std::int64_t shift(const PeriodicVertex& v, std::size_t i) const;

  const ComplexData& data_;
  std::size_t corners_;
  periodic::PeriodicSet set_;
  std::vector<std::int64_t> to_reduced_;  // r×r: the lattice vectors of the data in terms of the reduced ones
  std::vector<int> axes_;
};

}  // namespace delone::internal
