// SPDX-License-Identifier: BSD-3-Clause
// What joins the kernel to the engine: for each cell a cached affine functional h of (x, |x|²) that vanishes at its vertices,
// and a threshold T with which it answers most conflict tests by one dot product. A point q is in conflict iff h(q) < 0.
//
// Finite cell: h(x) = |x|² + g·x + c, the power of x with respect to the circumsphere, up to the frame's scaling.
// Infinite cell: h(x) = g·x + c with one coefficient ±1, positive on the side of the hull.
// The filter: |h̃(q)| > T proves the sign of h(q), for every q in the frame's box (docs/predicates.md, "The filter").
#pragma once

#include "geometry/frame.hpp"
#include "kernel/stages.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace delone::geometry {

/// A point to be tested against cells: its coordinates, its image in the frame, and whether the filter may be used on it.
template <int K>
struct Query {
  Query(const double* at, std::size_t dimension) : point(at), image(dimension) {}
  const double* point;
  kernel::Buffer<double, K> image;
  double lift = 0;
  bool in_frame = false;
};

template <int K>
class DelaunayGeometry {
 public:
  using Query = geometry::Query<K>;

  /// `coordinates`: the points of the vertices, `flat.ambient` doubles each, indexed by vertex id (vertex 0 is a dummy).
  /// Both references must outlive this object; they may grow.
  DelaunayGeometry(std::vector<int> axes, int ambient, const std::vector<double>& coordinates, const kernel::Grid& grid, Frame frame)
      : axes_(std::move(axes)), ambient_(ambient), coordinates_(coordinates), grid_(grid), frame_(std::move(frame)) {}

  int dimension() const { return K > 0 ? K : static_cast<int>(axes_.size()); }
  const Frame& frame() const { return frame_; }
  void set_frame(Frame frame) { frame_ = std::move(frame); }

  Query make_query(const double* point) const {
    Query q(point, axes_.size());
    for (int r = 0; r < dimension(); ++r) q.image[static_cast<std::size_t>(r)] = frame_.image(point, axis(r));
    q.lift = frame_.lift(point);
    q.in_frame = frame_.contains(point);
    return q;
  }

  const double* point(Index vertex) const { return coordinates_.data() + static_cast<std::size_t>(vertex) * static_cast<std::size_t>(ambient_); }
  bool is_at(Index vertex, const Query& q) const { return kernel::equal_points(point(vertex), q.point, ambient_); }

  void reserve_cells(std::size_t cells) { records_.resize(cells * stride()); }
  std::size_t bytes() const { return records_.capacity() * sizeof(double); }

  /// h̃(q), approximately the functional of the cell. Functionals of finite cells are comparable with each other.
  double value(Index cell, const Query& q) const {
    const double* record = row(cell);
    double h = record[dimension()];
    for (int r = 0; r < dimension(); ++r) h += record[r] * q.image[static_cast<std::size_t>(r)];
    return std::signbit(threshold(record)) ? h : h + q.lift;
  }
  bool is_infinite(Index cell) const { return std::signbit(threshold(row(cell))); }

  /// Stage filter_: the sign of h(q) if the functional proves it, else zero.
  Sign filter_side(Index cell, const Query& q) const {
    const double h = value(cell, q);
    const double bound = q.in_frame ? std::fabs(threshold(row(cell))) : std::numeric_limits<float>::infinity();
    return h < -bound ? Sign::negative : h > bound ? Sign::positive : Sign::zero;
  }

  /// Stages direct_ to perturbed_: the sign of h(q) for the cell of these k+1 vertices, `infinite_slot` −1 for a finite cell.
  /// Zero only for an infinite cell with q exactly on its hyperplane. REQUIRES that q is none of the vertices.
  Sign exact_side(const Index* vertices, int infinite_slot, const Query& q, StageCounts& counts) const {
    auto points = gather(vertices);
    const kernel::Flat flat = this->flat();
    if (infinite_slot >= 0) {
      points[static_cast<std::size_t>(infinite_slot)] = q.point;
      return -kernel::orientation<K>(flat, points.data(), grid_, counts);
    }
    const Sign sign = kernel::in_sphere<K>(flat, points.data(), q.point, grid_, counts);
    if (sign != Sign::zero) return sign;
    ++counts.perturbed;
    return kernel::perturbed_in_sphere<K>(flat, points.data(), q.point, grid_);
  }

  /// The sign of the power of q with respect to the sphere of a finite cell, ties not perturbed.
  Sign unperturbed_side(const Index* vertices, const Query& q) const {
    StageCounts uncounted;
    return kernel::in_sphere<K>(flat(), gather(vertices).data(), q.point, grid_, uncounted);
  }

  /// The exact sign of the barycentric coordinate of q at vertex `slot` of a finite, positively oriented cell.
  Sign side_of_facet(const Index* vertices, int slot, const Query& q) const {
    auto points = gather(vertices);
    points[static_cast<std::size_t>(slot)] = q.point;
    return kernel::orientation<K>(flat(), points.data(), grid_);
  }

  /// The orientation of k+1 finite vertices.
  Sign orientation(const Index* vertices) const { return kernel::orientation<K>(flat(), gather(vertices).data(), grid_); }

  /// Computes functional and threshold of a cell by elimination. `apex` is the slot of a finite vertex.
  void create(Index cell, const Index* vertices, int infinite_slot, int apex) {
    if (infinite_slot < 0)
      create_functional<false>(cell, vertices, infinite_slot, apex);
    else
      create_functional<true>(cell, vertices, infinite_slot, apex);
  }

 private:
  template <bool Infinite>
  void create_functional(Index cell, const Index* vertices, int infinite_slot, int apex);

  std::size_t stride() const { return static_cast<std::size_t>(dimension()) + 2; }
  const double* row(Index cell) const { return records_.data() + static_cast<std::size_t>(cell) * stride(); }
  double* row(Index cell) { return records_.data() + static_cast<std::size_t>(cell) * stride(); }
  int axis(int r) const { return axes_[static_cast<std::size_t>(r)]; }
  kernel::Flat flat() const { return {ambient_, axes_}; }

  /// The last entry of a record: the threshold, negated for an infinite cell.
  float threshold(const double* record) const {
    float t;
    std::memcpy(&t, record + dimension() + 1, sizeof t);
    return t;
  }
  void set_threshold(double* record, double bound, bool infinite) const {
    // Rounded up to float; whatever is not a number or too large means: never certain.
    constexpr double largest = std::numeric_limits<float>::max() / 2;
    float t = bound < largest ? static_cast<float>(bound * (1 + 0x1p-22)) + std::numeric_limits<float>::min()
                              : std::numeric_limits<float>::infinity();
    t = infinite ? -t : t;
    std::memcpy(record + dimension() + 1, &t, sizeof t);
  }

  auto gather(const Index* vertices) const {
    const int size = dimension() + 1;
    kernel::Buffer<const double*, K + (K > 0)> points(static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) points[static_cast<std::size_t>(i)] = point(vertices[i]);
    return points;
  }

  std::vector<int> axes_;
  int ambient_;
  const std::vector<double>& coordinates_;
  const kernel::Grid& grid_;
  Frame frame_;
  std::vector<double> records_;  // per cell: k coefficients, the constant, the threshold
};

template <int K>
template <bool Infinite>
void DelaunayGeometry<K>::create_functional(Index cell, const Index* vertices, int infinite_slot, int apex) {
  const int k = dimension();
  const int n = Infinite ? k - 1 : k;                    // the points besides the apex
  constexpr int N = K > 0 ? (Infinite ? K - 1 : K) : 0;  // n, or 0 when it is not known or no more than that
  double* record = row(cell);

  // Rows of the finite vertices, the apex first: k images and the lift.
  kernel::Buffer<double, (K > 0) * (K + 1) * (K + 1)> rows(static_cast<std::size_t>((k + 1) * (k + 1)));
  const auto fill = [&](int position, Index vertex) {
    const double* x = point(vertex);
    double* out = rows.data() + static_cast<std::ptrdiff_t>(position) * (k + 1);
    for (int r = 0; r < k; ++r) out[r] = frame_.image(x, axis(r));
    out[k] = frame_.lift(x);
  };
  fill(0, vertices[apex]);
  for (int i = 0, position = 1; i <= k; ++i)
    if (i != apex && i != infinite_slot) fill(position++, vertices[i]);

  kernel::Buffer<double, K * K> columns(static_cast<std::size_t>(k) * static_cast<std::size_t>(k));
  kernel::Buffer<int, K> row_of(static_cast<std::size_t>(k));
  kernel::Buffer<double, K> heights(static_cast<std::size_t>(k));
  const double* base = rows.data();
  for (int j = 0; j < n; ++j) {
    const double* x = rows.data() + static_cast<std::ptrdiff_t>(j + 1) * (k + 1);
    for (int r = 0; r < k; ++r) columns[static_cast<std::size_t>(j * k + r)] = x[r] - base[r];
    heights[static_cast<std::size_t>(j)] = x[k] - base[k];
  }
  // An image is off by a rounding of a number ≤ 1, twice per difference, and the difference is rounded once more.
  const kernel::EntryError entry_error{1.01 * kernel::unit_roundoff, 2.02 * kernel::unit_roundoff * std::sqrt(static_cast<double>(k))};
  const kernel::CertifiedDeterminant det = kernel::factor<N>(columns.data(), n, k, entry_error, row_of.data());
  const double least_determinant = std::fabs(det.value) - det.error;
  if (!(least_determinant > 0)) {  // too flat to say anything: never certain, and never attractive to a walk
    std::fill(record, record + k, 0.0);
    record[k] = std::numeric_limits<double>::infinity();
    set_threshold(record, std::numeric_limits<double>::infinity(), Infinite);
    return;
  }
  if constexpr (Infinite) {
    // The coordinate that was not chosen as a pivot gets the coefficient ±1, such that h is negative where a point in the slot
    // of the infinite vertex would make a positively oriented cell (docs/predicates.md, "Signs").
    const int position = infinite_slot - (infinite_slot > apex ? 1 : 0);
    record[k - 1] = ((apex + position + k) % 2 == 0) == (det.value > 0) ? 1.0 : -1.0;
    for (int j = 0; j < n; ++j) heights[static_cast<std::size_t>(j)] = 0;
  }
  kernel::solve_transposed<N>(columns.data(), n, k, row_of.data(), heights.data(), record);
  constexpr double lift_weight = Infinite ? 0 : 1;
  const auto linear_part = [&](const double* x) {
    double sum = lift_weight * x[k];
    for (int r = 0; r < k; ++r) sum += record[r] * x[r];
    return sum;
  };
  const double constant = -linear_part(base);
  record[k] = constant;

  // The threshold (docs/predicates.md, "The filter"): δ = h̃ − h is affine and known at the vertices up to `rounding`, so inside
  // the box it is at most the largest of these values times Σ|barycentric coordinates|, bounded by Cramer and Hadamard.
  double residual = 0;
  for (int j = 0; j <= n; ++j)
    residual = std::max(residual, std::fabs(linear_part(rows.data() + static_cast<std::ptrdiff_t>(j) * (k + 1)) + constant));
  double magnitude = lift_weight * ambient_ + std::fabs(constant);
  for (int r = 0; r < k; ++r) magnitude += std::fabs(record[r]);
  const double rounding = 1.01 * (k + ambient_ + 8) * kernel::unit_roundoff * magnitude;
  const double spread = 1 + 4.5 * std::sqrt(static_cast<double>(n)) * det.norm_product * det.inverse_norm_sum / least_determinant;
  set_threshold(record, (residual + rounding) * spread + rounding, Infinite);
}

}  // namespace delone::geometry
