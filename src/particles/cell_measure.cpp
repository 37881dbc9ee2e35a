// SPDX-License-Identifier: BSD-3-Clause
// Rounding errors of the sums over cells are below (number of cells + 4)·u of the sum of absolute pieces.
// Stars of so many cells that this counts are summed with compensation.
#include "particles/cell_measure.hpp"

#include "base/compensated_sum.hpp"
#include "base/length.hpp"
#include "base/progress_meter.hpp"
#include "kernel/determinant.hpp"
#include "kernel/double_double.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace delone::particles {
namespace {

/// What the computed pieces of a cell may be off by in all, relative to the sum of their absolute values.
/// 10⁻¹³ more is for sums over them.
constexpr double tolerance = 9e-13;
/// More cells are summed with compensation.
constexpr std::size_t most_cells_of_plain_sums = 500;

}  // namespace

CellMeasure::CellMeasure(std::size_t k, std::size_t d, bool weighted, int unit)
    : k_(k),
      d_(d),
      weighted_(weighted),
      unit_(unit),
      coordinate_factor_(std::ldexp(1.0, -unit)),
      weight_factor_(std::ldexp(1.0, -2 * unit)),
      one_(piece_size(k, d)),
      offset_(d) {}

void CellMeasure::begin(std::size_t num_neighbors) {
  num_neighbors_ = num_neighbors;
  high_.resize(num_neighbors * d_);
  low_.resize(num_neighbors * d_);
  weight_high_.resize(weighted_ ? num_neighbors : 0);
  weight_low_.resize(weight_high_.size());
}

void CellMeasure::set_neighbor(std::size_t i, const double* from, const double* to) {
  for (std::size_t j = 0; j < d_; ++j) {
    const kernel::DoubleDouble difference =
        kernel::two_sum(coordinate_factor_ * to[j], -(coordinate_factor_ * from[j]));
    high_[i * d_ + j] = difference.high;
    low_[i * d_ + j] = difference.low;
  }
  if (!weighted_) return;
  const kernel::DoubleDouble difference =
      kernel::two_sum(weight_factor_ * from[d_], -(weight_factor_ * to[d_]));
  weight_high_[i] = difference.high;
  weight_low_[i] = difference.low;
}

/// Makes the largest coordinate one of [1/2, 1), by a power of two.
void CellMeasure::scale() {
  double largest = 0;
  for (const double x : high_) largest = std::max(largest, std::abs(x));
  if (largest > 0) std::frexp(largest, &exponent_);
  const auto multiply = [](std::vector<double>& numbers, int exponent) {
    if (std::abs(exponent) < 1000) {
      const double factor = std::ldexp(1.0, exponent);
      for (double& x : numbers) x *= factor;
      return;
    }
    // In two steps, as the power itself may be out of range.
    const double first = std::ldexp(1.0, exponent / 2), second = std::ldexp(1.0, exponent - exponent / 2);
    for (double& x : numbers) x = x * first * second;
  };
  multiply(high_, -exponent_);
  multiply(low_, -exponent_);
  multiply(weight_high_, -2 * exponent_);
  multiply(weight_low_, -2 * exponent_);
}

void CellMeasure::measure_neighbors() {
  const std::size_t n = num_neighbors_, size = record_size(d_);
  records_.resize(n * size);
  distances_.resize(n);
  positions_.assign(n, 0.5);
  const double least = std::ldexp(1.0, -360 / static_cast<int>(k_)), most = 0x1p200;
  is_moderate_ = true;
  for (std::size_t i = 0; i < n; ++i) {
    const double* const e = high_.data() + i * d_;
    double* const record = records_.data() + i * size;
    double square_of_e = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      record[j] = e[j];
      square_of_e += e[j] * e[j];
    }
    const double weight = weighted_ ? weight_high_[i] : 0;
    record[d_ + square] = square_of_e;
    record[d_ + alpha] = 0.5 * (square_of_e + weight);
    const double sum = square_of_e + std::abs(weight);
    record[d_ + magnitude] = weighted_ ? sum * (sum / square_of_e) : square_of_e;
    const bool is_moderate = square_of_e >= least && record[d_ + magnitude] <= most;
    is_moderate_ = is_moderate_ && is_moderate;
    const double length =
        is_moderate ? std::sqrt(square_of_e) : internal::length_of(d_, [&](std::size_t j) { return e[j]; });
    distances_[i] = length;
    if (weighted_) positions_[i] = 0.5 + 0.5 * (weight / length / length);
  }
}

void CellMeasure::measure(std::span<const std::uint32_t> corners) {
  corners_ = corners;
  num_cells_ = corners.size() / k_;
  stride_ = (num_cells_ + 7) / 8 * 8;
  pieces_.resize(piece_size(k_, d_) * stride_);
  scale();
  measure_neighbors();
  if (is_moderate_) {
    find_pieces();
  } else {
    for (std::size_t c = 0; c < num_cells_; ++c) {
      size_of(c) = 0;
      error_of(c) = std::numeric_limits<double>::infinity();
    }
  }
  improve();
  finish();
}

void CellMeasure::find_pieces() {
  if (has_lanes(k_, d_)) {
    find_pieces_in_lanes(d_, num_cells_, records_.data(), corners_.data(), stride_, pieces_.data());
    return;
  }
  for (std::size_t c = 0; c < num_cells_; ++c) {
    internal::cancellation_point();
    particles::find_pieces(k_, d_, records_.data(), corners_.data() + c * k_, one_.data());
    for (std::size_t i = 0; i < one_.size(); ++i) piece(i, c) = one_[i];
  }
}

template <class Find>
void CellMeasure::replace(std::size_t cell, const Find& find) {
  find(ExactNeighbors{k_, d_, high_, low_, weight_high_, weight_low_}, corners_.data() + cell * k_,
       one_.data());
  for (std::size_t i = 0; i < one_.size(); ++i) piece(i, cell) = one_[i];
}

/// Replaces the worst cells by better ones, until the errors of all are certain to add up to no more than
/// half of the tolerance. The sizes of computed pieces less their errors are at most those of exact ones, so
/// what is left of them after the first step is a safe measure for the next. Cells from integers are off by
/// roundings only.
void CellMeasure::improve() {
  for (const bool exactly : {false, true}) {
    double size = 0, error = 0, certain = 0;
    for (std::size_t c = 0; c < num_cells_; ++c) {
      size += size_of(c);
      error += error_of(c);
      if (error_of(c) < size_of(c)) certain += size_of(c) - error_of(c);
    }
    if (error <= tolerance * size) return;
    const double most = most_error(0.9 * tolerance * certain);
    for (std::size_t c = 0; c < num_cells_; ++c) {
      if (error_of(c) <= most) continue;
      internal::cancellation_point();
      if (exactly) {
        replace(c, find_pieces_exactly);
        ++num_exact_;
      } else {
        replace(c, find_pieces_in_pairs);
        ++num_in_pairs_;
      }
    }
  }
}

/// A number such that the errors that do not exceed it add up to at most `sum`.
double CellMeasure::most_error(double sum) {
  for (double most = sum;; most /= 4) {
    double rest = 0;
    for (std::size_t c = 0; c < num_cells_; ++c)
      if (error_of(c) <= most) rest += error_of(c);
    if (rest <= sum) return most;
  }
}

template <class Sum, class Add, class Value>
void CellMeasure::sum_up(std::vector<Sum>& shares, std::vector<Sum>& moment, Add add, Value value) {
  shares.assign(num_neighbors_, Sum());
  moment.assign(d_, Sum());
  for (std::size_t i = 0; i < k_; ++i) {
    const double* const column = &piece(i, 0);
    for (std::size_t c = 0; c < num_cells_; ++c) add(shares[corners_[c * k_ + i]], column[c]);
  }
  for (std::size_t j = 0; j < d_; ++j) {
    const double* const column = &piece(k_ + j, 0);
    for (std::size_t c = 0; c < num_cells_; ++c) add(moment[j], column[c]);
  }
  Sum volume{};
  const double per_edge = 1 / static_cast<double>(k_), per_simplex = 1 / static_cast<double>(k_ + 1);
  for (std::size_t i = 0; i < num_neighbors_; ++i) {
    const double* const record = records_.data() + i * record_size(d_);
    const double share = value(shares[i]), t = positions_[i], part = per_edge * share * t;
    areas_[i] = share / distances_[i];
    add(volume, part);
    for (std::size_t j = 0; j < d_; ++j) add(moment[j], part * t * per_simplex * record[j]);
  }
  volume_ = value(volume);
  for (std::size_t j = 0; j < d_; ++j) offset_[j] = volume_ > 0 ? value(moment[j]) / volume_ : 0;
}

/// Sums, in the unit of the coordinates.
void CellMeasure::finish() {
  areas_.resize(num_neighbors_);
  if (num_cells_ <= most_cells_of_plain_sums)
    sum_up(
        shares_, moment_, [](double& sum, double x) { sum += x; }, [](double sum) { return sum; });
  else
    sum_up(
        long_shares_, long_moment_, [](internal::CompensatedSum& sum, double x) { sum.add(x); },
        [](const internal::CompensatedSum& sum) { return sum.value(); });
  const int exponent = exponent_ + unit_, of_volume = exponent * static_cast<int>(k_),
            of_area = exponent * static_cast<int>(k_ - 1);
  const bool is_in_range = std::abs(of_volume) < 900;
  const auto times_power = [&](double x, int power) {
    return is_in_range ? x * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + power) << 52)
                       : std::ldexp(x, power);
  };
  volume_ = times_power(std::max(volume_, 0.0), of_volume);
  for (double& x : offset_) x = times_power(x, exponent);
  for (std::size_t i = 0; i < num_neighbors_; ++i) {
    areas_[i] = times_power(std::max(areas_[i], 0.0), of_area);
    distances_[i] = times_power(distances_[i], exponent);
  }
}

}  // namespace delone::particles
