// SPDX-License-Identifier: BSD-3-Clause
// The rows of vertices: read from memory, or computed from the points.
#pragma once

#include "base/compiler.hpp"

#include <delone/types.hpp>

#include <array>
#include <cstddef>

namespace delone::geometry {

/// The dimensions in which rows may be computed where they are needed. In the plane, with two cells per
/// vertex, stored rows would be a tenth of all memory. In space they are a twentieth, and computing them
/// takes longer than loading them.
constexpr bool can_compute_rows(int k) { return k == 2; }

/// The rows of vertices, by vertex id: an array of them, or the points that they are images and lifts of.
/// Copies refer to the same memory.
class VertexRows {
 public:
  /// An array of rows.
  VertexRows(const double* rows) : rows_(rows) {}  // implicit, as most rows are arrays
  /// The images and lifts of points of R^k without weights in a frame with these centers and scales. REQUIRES
  /// can_compute_rows(k).
  VertexRows(const double* points, const double* center, const double* scale, double lift_scale)
      : points_(points), center_(center), scale_(scale), lift_scale_(lift_scale) {}

  /// The k + 1 entries of a row: an array or a pointer. K: k, or 0 when it is chosen at run time.
  template <int K>
  auto row(Index v, int k) const {
    if constexpr (can_compute_rows(K)) {
      constexpr auto size = static_cast<std::size_t>(K);
      std::array<double, size + 1> row;
      if (rows_ == nullptr) {  // as Frame::image() and Frame::lift(), bit for bit
        const double* point = points_ + v * size;
        row[size] = 0;
        for (std::size_t r = 0; r < size; ++r) {
          const double difference = point[r] - center_[r], t = difference * lift_scale_;
          row[r] = difference * scale_[r];
          row[size] += t * t;
        }
      } else {
        for (std::size_t r = 0; r <= size; ++r) row[r] = rows_[v * (size + 1) + r];
      }
      return row;
    } else {
      return rows_ + v * (static_cast<std::size_t>(k) + 1);
    }
  }
  /// Prefetches the row of a vertex.
  [[gnu::always_inline]] void prefetch(Index v, int k) const {
    const bool computed = rows_ == nullptr;
    const double* const first = computed ? points_ : rows_;
    const std::size_t size = static_cast<std::size_t>(k) + !computed;
    internal::prefetch(first + v * size);
    internal::prefetch(first + v * size + size - 1);
  }

 private:
  const double* rows_ = nullptr;
  const double *points_ = nullptr, *center_ = nullptr, *scale_ = nullptr;
  double lift_scale_ = 1;
};

}  // namespace delone::geometry
