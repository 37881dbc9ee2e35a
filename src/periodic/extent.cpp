// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/extent.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace delone::periodic {

namespace {

double product(const double* a, const double* b, std::size_t d) {
  double sum = 0;
  for (std::size_t j = 0; j < d; ++j) sum += a[j] * b[j];
  return sum;
}

/// Orthonormal directions: those of the lattice, and the others.
std::vector<double> make_basis(const PeriodicSet& set) {
  const std::size_t d = set.dimension;
  std::vector<double> basis;
  const auto add = [&](std::vector<double> x) {
    const double before = std::sqrt(product(x.data(), x.data(), d));
    for (int pass = 0; pass < 2; ++pass)  // the second one removes what rounding has left
      for (std::size_t at = 0; at < basis.size(); at += d) {
        const double part = product(x.data(), &basis[at], d);
        for (std::size_t j = 0; j < d; ++j) x[j] -= part * basis[at + j];
      }
    const double length = std::sqrt(product(x.data(), x.data(), d));
    if (!(length > 0x1p-40 * before)) x.assign(d, 0.0);  // a lattice so flat bounds nothing
    for (double& coordinate : x) coordinate /= length > 0x1p-40 * before ? length : 1;
    basis.insert(basis.end(), x.begin(), x.end());
  };
  for (std::size_t i = 0; i < set.rank; ++i)
    add(std::vector<double>(set.period.vector(i), set.period.vector(i) + d));
  while (basis.size() < d * d) {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t j = 0; j < d; ++j) {
      double rest = 1;
      for (std::size_t at = 0; at < basis.size(); at += d) rest -= basis[at + j] * basis[at + j];
      if (rest > most) {
        most = rest;
        best = j;
      }
    }
    std::vector<double> axis(d, 0.0);
    axis[best] = 1;
    add(std::move(axis));
  }
  return basis;
}

}  // namespace

Extent::Extent(const PeriodicSet& set)
    : set_(set),
      largest_weight_(-std::numeric_limits<double>::infinity()),
      basis_(make_basis(set)),
      low_(set.dimension, std::numeric_limits<double>::infinity()),
      high_(set.dimension, -std::numeric_limits<double>::infinity()),
      extremes_(2 + 2 * (set.dimension - set.rank)),
      others_(1 + 2 * set.rank) {
  double size = 0;
  for (const double largest : set_.largest) size += largest;
  margin_ = 0x1p-45 * size;
  for (std::size_t i = 0; i < set_.rank; ++i) {
    double magnitude = 0;
    for (std::size_t j = 0; j < set_.dimension; ++j)
      magnitude += std::abs(set_.period.gradient(i)[j]) * set_.largest[j];
    fraction_slack_.push_back(static_cast<double>(set_.dimension + 4) * 0x1p-52 * magnitude);
  }
}

/// Of equal positions the largest weight counts.
void Extent::take(Extreme& extreme, bool is_beyond, const double* point, std::int64_t row) const {
  const std::size_t d = set_.dimension;
  if (is_beyond ||
      (set_.weighted && point[d] > extreme.point[d] && std::equal(point, point + d, extreme.point.begin())))
    extreme = {row, {point, point + set_.row_size()}};
}

void Extent::add(const double* point, std::int64_t row) {
  const std::size_t d = set_.dimension;
  const bool is_first = extremes_[0].row < 0;
  double off = 0;
  for (std::size_t i = 0; i < set_.rank; ++i)
    off = std::max(off, std::abs(set_.period.fraction(i, point) - 0.5));
  take(extremes_[0], is_first || off < least_off_, point, row);
  least_off_ = std::min(least_off_, off);
  bool is_heavier = false;
  if (set_.weighted) {
    weight_range_ = std::max(weight_range_, std::abs(point[d]));
    is_heavier = point[d] > largest_weight_;
    largest_weight_ = std::max(largest_weight_, point[d]);
  }
  if (set_.weighted) {
    take(extremes_[1], is_first || is_heavier, point, row);
    if (is_first || point[d] < others_[0].point[d]) others_[0] = {row, {point, point + set_.row_size()}};
  }
  for (std::size_t i = 0; i < d; ++i) {
    const double along = product(lattice_direction(i), point, d);
    Extreme* const ends = i < set_.rank ? &others_[1 + 2 * i] : &extremes_[2 + 2 * (i - set_.rank)];
    take(ends[0], is_first || along < low_[i], point, row);
    take(ends[1], is_first || along > high_[i], point, row);
    low_[i] = std::min(low_[i], along);
    high_[i] = std::max(high_[i], along);
  }
}

std::vector<double> Extent::witnesses() const {
  std::vector<double> points;
  for (const std::vector<Extreme>* some : {&extremes_, &others_})
    for (const Extreme& one : *some) points.insert(points.end(), one.point.begin(), one.point.end());
  return points;
}

std::vector<Extent::Extreme> Extent::extremes() const {
  std::vector<Extreme> all;
  if (extremes_[0].row < 0) return all;
  std::copy_if(extremes_.begin(), extremes_.end(), std::back_inserter(all),
               [](const Extreme& one) { return one.row >= 0; });
  std::sort(all.begin(), all.end(), [](const Extreme& a, const Extreme& b) { return a.row < b.row; });
  all.erase(
      std::unique(all.begin(), all.end(), [](const Extreme& a, const Extreme& b) { return a.row == b.row; }),
      all.end());
  return all;
}

std::vector<std::vector<std::int32_t>> Extent::frame_shifts() const {
  const std::size_t r = set_.rank;
  std::vector<std::vector<std::int32_t>> shifts;
  constexpr std::size_t most_cubes = 4;
  if (r == 0) return shifts;
  if (r <= most_cubes) {  // Σ ±a_i
    for (std::size_t signs = 0; signs < std::size_t{1} << r; ++signs) {
      shifts.emplace_back(r);
      for (std::size_t i = 0; i < r; ++i) shifts.back()[i] = (signs >> i & 1) != 0 ? 1 : -1;
    }
  } else {  // ±a_i
    for (std::size_t i = 0; i < r; ++i)
      for (const std::int32_t sign : {-1, 1}) {
        shifts.emplace_back(r, 0);
        shifts.back()[i] = sign;
      }
  }
  return shifts;
}

}  // namespace delone::periodic
