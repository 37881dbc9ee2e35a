// SPDX-License-Identifier: BSD-3-Clause
// One cell at a time, by flags-inl.hpp: with doubles, with pairs of doubles, and from integers.
#include "particles/pass/wide_pieces.hpp"

#include "base/compiled_dimension.hpp"
#include "base/progress_meter.hpp"
#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"

#include <hwy/highway.h>
// After highway.h
#include "particles/pass/flags-inl.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace delone::particles {
namespace {

using namespace HWY_NAMESPACE;
using kernel::DoubleDouble;
using kernel::Integer;
using kernel::unit_roundoff;

/// That of pairs: sums are off by 6u², products by 9u², quotients by less than this.
constexpr double pair_roundoff = 0x1p-100;

/// Integers by Bareiss's elimination (1968, doi:10.1090/S0025-5718-1968-0226829-0): with g the determinant of
/// the Gram matrix of F, r_w·g, 2α_w·g and the inner products r_w·r_j·g are integers, bordered minors.
///
/// sum_flags() gets the distances of centers, h = α_w/|r_w|, in place of α_w, 1 in place of D, and |e_i| in
/// place of its square. Then nothing overflows or underflows that is not itself out of range.
class ExactElimination {
 public:
  ExactElimination(const ExactNeighbors& neighbors, const std::uint32_t* corners, Flags<double, 0, 0>& flags)
      : k_(neighbors.k), d_(neighbors.d), width_(d_ + 1 + k_), flags_(flags), lengths_(k_) {
    grid_ = std::numeric_limits<int>::max() / 4;
    for_each_number(
        neighbors, corners, [&](double x) { grid_ = std::min(grid_, kernel::trailing_exponent(x)); },
        [&](double x) { grid_ = std::min(grid_, kernel::square_exponent(x)); });
    std::vector<Integer> rows(k_ * width_);
    std::size_t at = 0;
    for (std::size_t i = 0; i < k_; ++i) {
      Integer* const row = rows.data() + i * width_;
      for (std::size_t j = 0; j < d_; ++j) {
        at = corners[i] * d_ + j;
        row[j] = integer(neighbors.high[at], grid_) + integer(neighbors.low[at], grid_);
        row[d_] += row[j] * row[j];
      }
      if (!neighbors.weight_high.empty())
        row[d_] += integer(neighbors.weight_high[corners[i]], 2 * grid_) +
                   integer(neighbors.weight_low[corners[i]], 2 * grid_);
    }
    for (std::size_t i = 0; i < k_; ++i)
      for (std::size_t j = 0; j < k_; ++j)
        for (std::size_t c = 0; c < d_; ++c)
          rows[i * width_ + d_ + 1 + j] += rows[i * width_ + c] * rows[j * width_ + c];
    unit_ = grid_ - neighbors.exponent;
    for (std::size_t i = 0; i < k_; ++i) lengths_[i] = length(rows.data() + i * width_);
    run(0, 0, rows, 1);
  }
  /// Of the edges; those that are too short for doubles have the least one.
  const std::vector<double>& lengths() const { return lengths_; }

 private:
  double length(const Integer* edge) const {
    std::vector<double> rounded;
    double largest = 0, sum = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      rounded.push_back(kernel::nearest_double(edge[j], 1, unit_));
      largest = std::max(largest, std::abs(rounded.back()));
    }
    if (largest == 0) return std::numeric_limits<double>::denorm_min();
    for (const double x : rounded) sum += (x / largest) * (x / largest);
    return largest * std::sqrt(sum);
  }
  static Integer integer(double x, int grid) { return x == 0 ? Integer(0) : kernel::scaled_integer(x, grid); }
  template <class Coordinate, class Weight>
  static void for_each_number(const ExactNeighbors& neighbors, const std::uint32_t* corners,
                              Coordinate coordinate, Weight weight) {
    for (std::size_t i = 0; i < neighbors.k; ++i) {
      for (std::size_t j = 0; j < neighbors.d; ++j)
        for (const auto& part : {neighbors.high, neighbors.low})
          if (const double x = part[corners[i] * neighbors.d + j]; x != 0) coordinate(x);
      if (neighbors.weight_high.empty()) continue;
      for (const auto& part : {neighbors.weight_high, neighbors.weight_low})
        if (const double x = part[corners[i]]; x != 0) weight(x);
    }
  }

  void run(std::size_t set, std::size_t first, const std::vector<Integer>& rows, const Integer& g) {
    internal::cancellation_point();
    const auto row = [&](std::size_t w) { return rows.data() + w * width_; };
    const auto square = [&](std::size_t w) -> const Integer& { return row(w)[d_ + 1 + w]; };
    for (std::size_t w = 0; w < k_; ++w) {
      if ((set >> w & 1) != 0) continue;
      const Integer& twice_alpha = row(w)[d_];
      double h = 0;
      if (twice_alpha != 0)
        h = kernel::root_above(twice_alpha * twice_alpha, 4 * g * square(w), unit_) *
            (twice_alpha < 0 ? -1 : 1);
      flags_.alpha[set * k_ + w] = h;
      flags_.tau[set * k_ + w] = 2 * unit_roundoff * std::abs(h);
    }
    for (std::size_t v = first; v < k_; ++v) {
      const std::size_t with = set | std::size_t{1} << v;
      const Integer& pivot = square(v);
      for (std::size_t j = 0; j < d_; ++j)
        flags_.steps[with * d_ + j] = kernel::nearest_double(row(v)[d_] * row(v)[j], pivot * g, unit_ - 1);
      if (with + 1 == std::size_t{1} << k_) continue;
      std::vector<Integer> next(rows.size());
      for (std::size_t w = 0; w < k_; ++w) {
        if ((with >> w & 1) != 0) continue;
        for (std::size_t i = 0; i < width_; ++i)
          next[w * width_ + i] = (row(w)[i] * pivot - row(v)[i] * row(w)[d_ + 1 + v]) / g;
      }
      run(with, v + 1, next, pivot);
    }
  }

  std::size_t k_, d_, width_;
  Flags<double, 0, 0>& flags_;
  int grid_, unit_ = 0;  // of the integers, and of these in the unit of the pieces
  std::vector<double> lengths_;
};

auto writer(double* pieces) {
  return [pieces](std::size_t i, double x) { pieces[i] = x; };
}

template <int K>
void find_in_pairs(const ExactNeighbors& neighbors, const std::uint32_t* corners, double* pieces) {
  const std::size_t k = K > 0 ? static_cast<std::size_t>(K) : neighbors.k, d = K > 0 ? k : neighbors.d;
  kernel::Buffer<double, K> lambda(k), squares(k);
  Remainders<double, DoubleDouble, K, K> edges(k, d);
  for (std::size_t i = 0; i < k; ++i) {
    DoubleDouble* const edge = edges.r.data() + i * d;
    for (std::size_t j = 0; j < d; ++j)
      edge[j] = {neighbors.high[corners[i] * d + j], neighbors.low[corners[i] * d + j]};
    DoubleDouble sum = dot(edge, edge, d);
    squares[i] = sum.high;
    lambda[i] = std::sqrt(sum.high);
    double size = sum.high;
    if (!neighbors.weight_high.empty()) {
      const DoubleDouble weight{neighbors.weight_high[corners[i]], neighbors.weight_low[corners[i]]};
      sum = sum + weight;
      size += std::abs(weight.high);
    }
    edges.alpha[i] = {sum.high / 2, sum.low / 2};
    edges.epsilon[i] = pair_roundoff * lambda[i];
    edges.tau[i] = static_cast<double>(d + 3) * pair_roundoff * size;
  }
  Flags<double, K, K> flags(k, d);
  eliminate<double, DoubleDouble, K, K>(flags, lambda.data(), pair_roundoff, Zero<0>(), Zero<0>(), edges);
  sum_flags<double, K, K>(flags, squares.data(), writer(pieces));
}

}  // namespace

void find_pieces(std::size_t k, std::size_t d, const double* records, const std::uint32_t* corners,
                 double* pieces) {
  std::vector<double> lambda(k), squares(k);
  Remainders<double, double, 0, 0> edges(k, d);
  for (std::size_t i = 0; i < k; ++i) {
    const double* const record = records + corners[i] * record_size(d);
    std::copy_n(record, d, edges.r.begin() + static_cast<std::ptrdiff_t>(i * d));
    squares[i] = record[d + square];
    lambda[i] = std::sqrt(squares[i]);
    edges.alpha[i] = record[d + alpha];
    edges.epsilon[i] = unit_roundoff * lambda[i];
    edges.tau[i] =
        static_cast<double>(d + 3) * unit_roundoff * (std::sqrt(record[d + magnitude]) * lambda[i]);
  }
  Flags<double, 0, 0> flags(k, d);
  eliminate<double, double, 0, 0>(flags, lambda.data(), unit_roundoff, Zero<0>(), Zero<0>(), edges);
  sum_flags<double, 0, 0>(flags, squares.data(), writer(pieces));
}

void find_pieces_in_pairs(const ExactNeighbors& neighbors, const std::uint32_t* corners, double* pieces) {
  // Where sizes are known, nothing is allocated.
  const std::size_t known = has_lanes(neighbors.k, neighbors.d) ? neighbors.k : 0;
  internal::with_compiled_dimension<2, most_lanes_dimension>(
      known, [&](auto k) { find_in_pairs<k()>(neighbors, corners, pieces); });
}

void find_pieces_exactly(const ExactNeighbors& neighbors, const std::uint32_t* corners, double* pieces) {
  const std::size_t k = neighbors.k, d = neighbors.d;
  Flags<double, 0, 0> flags(k, d);
  const ExactElimination elimination(neighbors, corners, flags);
  sum_flags<double, 0, 0>(flags, elimination.lengths().data(), writer(pieces));
}

}  // namespace delone::particles
