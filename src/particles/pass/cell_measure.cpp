// SPDX-License-Identifier: BSD-3-Clause
// Sums over cells are exact_sums.hpp's, also those that decide which cells are replaced.
#include "particles/pass/cell_measure.hpp"

#include "base/compiled_dimension.hpp"
#include "base/length.hpp"
#include "base/progress_meter.hpp"
#include "kernel/double_double.hpp"
#include "particles/pass/exact_sums.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

namespace delone::particles {
namespace {

/// By how much the computed pieces of a cell may be off in all, relative to the sum of their absolute values.
/// Sums over them are allowed 10⁻¹³ more.
constexpr double tolerance = 9e-13;

double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}
/// x·2^−exponent.
double scaled(double x, int exponent) {
  return std::abs(exponent) < 1000 ? x * power_of_two(-exponent) : std::ldexp(x, -exponent);
}

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

/// Records: differences of coordinates, rounded, in a unit that makes the largest one of [1/2, 1).
template <int D>
void CellMeasure::measure_neighbors() {
  const std::size_t n = to_.size(), d = D > 0 ? static_cast<std::size_t>(D) : d_, size = record_size(d);
  records_.resize(n * size);
  distances_.resize(n);
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double* const to = to_[i];
    double* const record = records_.data() + i * size;
    for (std::size_t j = 0; j < d; ++j) {
      record[j] = coordinate_factor_ * to[j] - coordinate_factor_ * from_[j];
      largest = std::max(largest, std::abs(record[j]));
    }
  }
  exponent_ = 0;
  if (largest > 0) std::frexp(largest, &exponent_);
  const bool is_in_range = std::abs(exponent_) < 500;
  const double factor = is_in_range ? power_of_two(-exponent_) : 0, factor_of_weights = factor * factor;
  const double least = power_of_two(-360 / static_cast<int>(k_)), most = 0x1p200;
  is_moderate_ = true;
  if (weighted_) positions_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    double* const record = records_.data() + i * size;
    double square_of_e = 0;
    for (std::size_t j = 0; j < d; ++j) {
      record[j] = is_in_range ? record[j] * factor : scaled(record[j], exponent_);
      square_of_e += record[j] * record[j];
    }
    double weight = weighted_ ? weight_factor_ * from_[d] - weight_factor_ * to_[i][d] : 0;
    weight = is_in_range ? weight * factor_of_weights : scaled(weight, 2 * exponent_);
    record[d + square] = square_of_e;
    record[d + alpha] = 0.5 * (square_of_e + weight);
    const double sum = square_of_e + std::abs(weight);
    record[d + magnitude] = weighted_ ? sum * (sum / square_of_e) : square_of_e;
    const bool is_moderate = square_of_e >= least && record[d + magnitude] <= most;
    is_moderate_ = is_moderate_ && is_moderate;
    const double length = is_moderate ? std::sqrt(square_of_e)
                                      : internal::length_of(d, [&](std::size_t j) { return record[j]; });
    distances_[i] = length;
    if (weighted_) positions_[i] = length > 0 ? 0.5 + 0.5 * (weight / length / length) : 0.5;
  }
}

void CellMeasure::measure(std::span<const std::uint32_t> corners) {
  corners_ = corners;
  num_cells_ = corners.size() / k_;
  stride_ = (num_cells_ + 7) / 8 * 8;
  pieces_.resize(piece_size(k_, d_) * stride_);
  internal::with_compiled_dimension<2, 4>(d_, [&](auto d) { measure_neighbors<d()>(); });
  find_pieces();
  improve();
  sum_up();
  unscale();
}

void CellMeasure::find_pieces() {
  if (!is_moderate_) {
    for (std::size_t c = 0; c < num_cells_; ++c) {
      size_of(c) = 0;
      error_of(c) = std::numeric_limits<double>::infinity();
    }
    return;
  }
  if (has_lanes(k_, d_)) {
    find_pieces_in_lanes(d_, weighted_, num_cells_, records_.data(), corners_.data(), stride_,
                         pieces_.data());
    return;
  }
  for (std::size_t c = 0; c < num_cells_; ++c) {
    internal::cancellation_point();
    particles::find_pieces(k_, d_, records_.data(), corners_.data() + c * k_, one_.data());
    for (std::size_t i = 0; i < one_.size(); ++i) piece(i, c) = one_[i];
  }
}

void CellMeasure::find_exact_differences() {
  const std::size_t n = to_.size();
  high_.resize(n * d_);
  low_.resize(n * d_);
  weight_high_.resize(weighted_ ? n : 0);
  weight_low_.resize(weight_high_.size());
  for (std::size_t i = 0; i < n; ++i) {
    const double* const to = to_[i];
    for (std::size_t j = 0; j < d_; ++j) {
      const kernel::DoubleDouble difference =
          kernel::two_sum(coordinate_factor_ * to[j], -(coordinate_factor_ * from_[j]));
      high_[i * d_ + j] = scaled(difference.high, exponent_);
      low_[i * d_ + j] = scaled(difference.low, exponent_);
    }
    if (!weighted_) continue;
    const kernel::DoubleDouble difference =
        kernel::two_sum(weight_factor_ * from_[d_], -(weight_factor_ * to[d_]));
    weight_high_[i] = scaled(difference.high, 2 * exponent_);
    weight_low_[i] = scaled(difference.low, 2 * exponent_);
  }
}

/// Neither rounded nor scaled: in the unit that the largest differences give, the smallest ones may be 0.
void CellMeasure::keep_coordinates() {
  for (std::size_t i = 0; i < to_.size(); ++i) {
    std::copy_n(to_[i], d_, high_.begin() + static_cast<std::ptrdiff_t>(i * d_));
    std::transform(from_, from_ + d_, low_.begin() + static_cast<std::ptrdiff_t>(i * d_), std::negate<>());
    if (!weighted_) continue;
    weight_high_[i] = from_[d_];
    weight_low_[i] = -to_[i][d_];
  }
}

template <class Find>
void CellMeasure::replace(std::size_t cell, const Find& find) {
  find(ExactNeighbors{k_, d_, high_, low_, weight_high_, weight_low_, exponent_ + unit_},
       corners_.data() + cell * k_, one_.data());
  for (std::size_t i = 0; i < one_.size(); ++i) piece(i, cell) = one_[i];
}

/// Replaces the worst cells by better ones, until the errors of all are certain to add up to no more than
/// half of the tolerance. The sizes of computed pieces less their errors are at most those of exact ones, so
/// what is left of them after the first step is a safe measure for the next. Cells from integers are off by
/// roundings only.
void CellMeasure::improve() {
  for (const bool exactly : {false, true}) {
    const PieceTotals totals = find_totals(num_cells_, &size_of(0), &error_of(0));
    if (totals.error <= tolerance * totals.size) return;
    if (exactly)
      keep_coordinates();
    else
      find_exact_differences();
    scratch_.resize(num_cells_);
    for (std::size_t c = 0; c < num_cells_; ++c)
      scratch_[c] = error_of(c) < size_of(c) ? size_of(c) - error_of(c) : 0;
    const double most = most_error(0.9 * tolerance * total_of_scratch());
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

double CellMeasure::total_of_scratch() const {
  return find_totals(num_cells_, scratch_.data(), scratch_.data()).size;
}

/// A number such that the errors that do not exceed it add up to at most `sum`.
double CellMeasure::most_error(double sum) {
  for (double most = sum;; most /= 4) {
    for (std::size_t c = 0; c < num_cells_; ++c) scratch_[c] = error_of(c) <= most ? error_of(c) : 0;
    if (total_of_scratch() <= sum) return most;
  }
}

/// Sums over cells: shares and moments.
void CellMeasure::sum_pieces() {
  const std::size_t n = to_.size();
  shares_.assign(n, 0.0);
  if (num_cells_ > most_split_cells) {
    double largest = 0;
    for (std::size_t i = 0; i < k_; ++i) largest = std::max(largest, largest_magnitude(column(i)));
    TermSplitter splitter(largest, num_cells_);
    do {
      parts_.assign(n, 0.0);
      for (std::size_t i = 0; i < k_; ++i)
        for (std::size_t c = 0; c < num_cells_; ++c)
          parts_[corners_[c * k_ + i]] += splitter.take(piece(i, c));
      for (std::size_t i = 0; i < n; ++i) shares_[i] += parts_[i];
    } while (splitter.next());
    for (std::size_t j = 0; j < d_; ++j) offset_[j] = exact_sum(column(k_ + j));
    return;
  }
  first_parts_.resize(k_ * stride_);
  split_pieces(k_, d_, num_cells_, stride_, pieces_.data(), first_parts_.data(), offset_.data());
  parts_.assign(n, 0.0);
  for (std::size_t i = 0; i < k_; ++i) {
    const double* const first = first_parts_.data() + i * stride_;
    const double* const second = &piece(i, 0);
    for (std::size_t c = 0; c < num_cells_; ++c) {
      const std::uint32_t slot = corners_[c * k_ + i];
      shares_[slot] += first[c];
      parts_[slot] += second[c];
    }
  }
  for (std::size_t i = 0; i < n; ++i) shares_[i] += parts_[i];
}

/// Results in the unit of the pieces.
void CellMeasure::sum_up() {
  sum_pieces();
  const std::size_t n = to_.size();
  volume_ = 0;
  areas_.resize(n);
  const double per_edge = 1 / static_cast<double>(k_), per_simplex = 1 / static_cast<double>(k_ + 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double* const record = records_.data() + i * record_size(d_);
    const double t = weighted_ ? positions_[i] : 0.5, part = per_edge * shares_[i] * t;
    areas_[i] = distances_[i] > 0 ? shares_[i] / distances_[i] : 0;
    volume_ += part;
    for (std::size_t j = 0; j < d_; ++j) offset_[j] += part * t * per_simplex * record[j];
  }
  for (double& x : offset_) x = volume_ > 0 ? x / volume_ : 0;
}

/// Results in the unit of the coordinates.
void CellMeasure::unscale() {
  const int exponent = exponent_ + unit_, of_volume = exponent * static_cast<int>(k_),
            of_area = exponent * static_cast<int>(k_ - 1);
  const bool is_in_range = std::abs(of_volume) < 900;
  const auto times_power = [&](double x, int power) {
    return is_in_range ? x * power_of_two(power) : std::ldexp(x, power);
  };
  volume_ = times_power(std::max(volume_, 0.0), of_volume);
  for (double& x : offset_) x = times_power(x, exponent);
  for (std::size_t i = 0; i < to_.size(); ++i) {
    areas_[i] = times_power(std::max(areas_[i], 0.0), of_area);
    distances_[i] = times_power(distances_[i], exponent);
  }
}

}  // namespace delone::particles
