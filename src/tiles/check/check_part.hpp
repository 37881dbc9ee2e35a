// SPDX-License-Identifier: BSD-3-Clause
// What the check of a folder of tiles knows of the whole, and one part of it as check() takes a
// triangulation.
#pragma once

#include "check/check_stages.hpp"
#include "kernel/predicates.hpp"

#include <delone/tiles.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace delone::tiles {

using internal::Violation;

/// The first violation of each level. What is found early belongs to a later level sometimes.
class Findings {
 public:
  explicit Findings(int up_to) : limit_(up_to) {}

  /// Whether a level is still to be examined: no violation of an earlier one is known.
  bool wanted(int level) const { return level <= limit_; }
  void add(int level, Violation violation) {
    auto& first = first_[static_cast<std::size_t>(level)];
    if (!first) first = std::move(violation);
    limit_ = std::min(limit_, level);
  }
  /// Throws the violation of this level, if there is one.
  void require(int level) const {
    if (const auto& first = first_[static_cast<std::size_t>(level)]) throw *first;
  }

 private:
  std::array<std::optional<Violation>, 7> first_;
  int limit_;
};

/// The first cell of all, which serves as the reference for what is covered, and the axes on which
/// orientations are taken across parts.
struct Reference {
  std::int64_t cell = -1;  ///< global; −1: no part has a cell
  std::vector<std::int64_t> rows;
  std::vector<double> points;  ///< k+1 points, each with its weight if points have one
  std::size_t row_size = 0;
  std::vector<int> axes;
  kernel::AffineHull hull{1};  ///< of these points
  bool is_flat = false;        ///< then nothing can be told by orientations
  kernel::RowForm form = kernel::RowForm::point;

  kernel::Flat flat(int dimension) const { return {dimension, axes, form}; }
  const double* point(std::size_t i) const { return points.data() + i * row_size; }
};

/// The orientation of k+1 points; of one point: positive.
inline Sign orientation_of(const kernel::Flat& flat, std::span<const double* const> points) {
  return points.size() == 1 ? Sign::positive : kernel::orientation(flat, points);
}

/// The side of the facet on which the point o in general position inside the reference cell lies: its vertex
/// 0, moved by ε towards vertex 1, by ε² towards vertex 2, and so on. `points`: a simplex whose point i is
/// not of the facet; it is replaced meanwhile. The sign is that of the orientation with o in its place.
inline Sign side_of_reference(const kernel::Flat& flat, const Reference& reference,
                              std::span<const double*> points, std::size_t i) {
  const double* const before = points[i];
  Sign sign = Sign::zero;
  for (std::size_t r = 0; r < reference.rows.size() && sign == Sign::zero; ++r) {
    points[i] = reference.point(r);
    sign = orientation_of(flat, points);
  }
  points[i] = before;
  return sign;
}

/// A part as a triangulation of its points.
struct CheckedPart {
  std::size_t number = 0;
  std::int64_t first_cell = 0;
  ComplexData data;
  TileData tile;  ///< without points, weights and cells, which `data` has; that has no neighbors

  std::size_t corners() const { return static_cast<std::size_t>(data.affine_dimension + 1); }
  std::int64_t row(SignedIndex point) const { return tile.rows[static_cast<std::size_t>(point)]; }
  /// The cell across the facet opposite vertex i of cell c, as the file says: global, or −1.
  std::int64_t given_neighbor(std::size_t at) const {
    const std::int32_t neighbor = tile.neighbors[at];
    return neighbor >= 0    ? first_cell + neighbor
           : neighbor == -1 ? -1
                            : tile.seams[static_cast<std::size_t>(-2 - static_cast<std::int64_t>(neighbor))];
  }
};

/// Examines part after part: levels 1, 2, 4 and 5 as far as one part tells. Returns the ties.
std::size_t check_part(const CheckedPart& part, Reference& reference, bool canonical, unsigned threads,
                       Findings& findings);

}  // namespace delone::tiles
