// SPDX-License-Identifier: BSD-3-Clause
// Volume, centroid and facets of a clipped region, and which of its facets are proper ones.
#include "voronoi/region_clipper.hpp"

#include "base/length.hpp"
#include "kernel/fractions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace delone::voronoi {

namespace {

/// A region whose extents along two axes differ by more than this is measured in a unit of its own for each
/// axis, and boxes with such sides get the coordinates of corners from integers: with one unit for all, the
/// digits along the short axis would be lost among those along the long one.
constexpr int most_moderate_ratio = 20;  // as a power of two

/// Corners are rounded relative to the site. If the extent of a region along an axis is smaller than this
/// share of the largest coordinate there, it would lose more than ten bits.
constexpr double far_extent = 0x1p-10;

/// 2^e for each x, so that x·2^−e is in [1/2, 1).
int exponent_of(double x) { return std::ilogb(x) + 1; }

}  // namespace

bool RegionClipper::has_moderate_sides() const {
  int least = std::numeric_limits<int>::max(), largest = std::numeric_limits<int>::lowest();
  for (std::size_t j = 0; j < d_; ++j) {
    const int exponent = exponent_of(box_.high[j] / 2 - box_.low[j] / 2);
    least = std::min(least, exponent);
    largest = std::max(largest, exponent);
  }
  return largest - least <= most_moderate_ratio;
}

/// The least and the largest coordinate j of all corners; infinity and −infinity for none.
std::pair<double, double> RegionClipper::range_of_corners(std::size_t j) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (Corner c = 0; c < alive_.size(); ++c)
    if (alive_[c] != 0) {
      low = std::min(low, positions_[c * d_ + j]);
      high = std::max(high, positions_[c * d_ + j]);
    }
  return {low, high};
}

/// The exponents of the extents; empty if they are moderate, or the region is flat.
std::vector<int> RegionClipper::exponents_of_extents() const {
  std::vector<int> exponents;
  int least = std::numeric_limits<int>::max(), largest = std::numeric_limits<int>::lowest();
  for (std::size_t j = 0; j < d_; ++j) {
    const auto [low, high] = range_of_corners(j);
    if (!(low < high) || !std::isfinite(high / 2 - low / 2)) return {};
    exponents.push_back(exponent_of(high / 2 - low / 2) + 1);
    least = std::min(least, exponents.back());
    largest = std::max(largest, exponents.back());
  }
  return largest - least > most_moderate_ratio ? exponents : std::vector<int>{};
}

/// In coordinates x'_j = x_j·2^−e_j. A volume there is that of the region times 2^−Σe. A facet in the plane
/// a·x = b is in a'·x' = b with a'_j = a_j·2^e_j, and its distance from a point is that in the plane's own
/// coordinates times |a|/|a'|: so its volume there is that of the facet times 2^−Σe·|a'|/|a|.
solve::SimplePolytope::Measures RegionClipper::measures_by_axis(const std::vector<int>& exponents) {
  std::vector<double> scaled;
  const std::vector<Corner> all = corners();
  scaled.reserve(all.size() * d_);
  polytope_.start(d_, d_);
  for (const Corner c : all) {
    for (std::size_t j = 0; j < d_; ++j) scaled.push_back(std::ldexp(position(c)[j], -exponents[j]));
    polytope_.add_corner(scaled.data() + scaled.size() - d_, {planes_of(c), d_});
  }
  solve::SimplePolytope::Measures result = polytope_.measures();
  const int sum = std::accumulate(exponents.begin(), exponents.end(), 0);
  result.volume = std::ldexp(result.volume, sum);
  for (std::size_t j = 0; j < result.centroid.size(); ++j)
    result.centroid[j] = std::ldexp(result.centroid[j], exponents[j]);
  for (auto& facet : result.facets) {
    const std::vector<double>& a = planes_[facet.label].a;
    // The largest exponents of the terms of a and a'. A term whose exponent is a thousand less does not
    // count.
    int top = std::numeric_limits<int>::lowest(), scaled_top = top;
    for (std::size_t j = 0; j < d_; ++j)
      if (a[j] != 0) {
        top = std::max(top, exponent_of(a[j]));
        scaled_top = std::max(scaled_top, exponent_of(a[j]) + exponents[j]);
      }
    const double length = internal::length_of(d_, [&](std::size_t j) { return std::ldexp(a[j], -top); });
    const double scaled_length =
        internal::length_of(d_, [&](std::size_t j) { return std::ldexp(a[j], exponents[j] - scaled_top); });
    facet.volume = std::ldexp(facet.volume * (length / scaled_length), sum + top - scaled_top);
  }
  return result;
}

bool RegionClipper::is_far() const {
  for (std::size_t j = 0; j < d_; ++j) {
    const auto [low, high] = range_of_corners(j);
    if (low <= high && high - low < far_extent * std::max(std::abs(low), std::abs(high))) return true;
  }
  return false;
}

/// With the differences of all corners from the first one, each correctly rounded from integers.
solve::SimplePolytope::Measures RegionClipper::measures_from_a_corner() {
  const std::vector<Corner> all = corners();
  const kernel::Fractions first = solve_exactly(all.front());
  const std::vector<double> from_site(position(all.front()), position(all.front()) + d_),
      positions = positions_;
  for (const Corner c : all) {
    const kernel::Fractions at = solve_exactly(c);
    for (std::size_t j = 0; j < d_; ++j)
      position(c)[j] =
          kernel::nearest_double(at.numerators[j] * first.denominator - first.numerators[j] * at.denominator,
                                 at.denominator * first.denominator, grid_);
  }
  solve::SimplePolytope::Measures result = measures_here();
  positions_ = positions;
  for (std::size_t j = 0; j < result.centroid.size(); ++j) result.centroid[j] += from_site[j];
  return result;
}

solve::SimplePolytope::Measures RegionClipper::measures() {
  return is_far() ? measures_from_a_corner() : measures_here();
}

solve::SimplePolytope::Measures RegionClipper::measures_here() {
  if (const std::vector<int> exponents = exponents_of_extents(); !exponents.empty())
    return measures_by_axis(exponents);
  polytope_.start(d_, d_);
  for (const Corner c : corners()) polytope_.add_corner(position(c), {planes_of(c), d_});
  return polytope_.measures();
}

/// Without ties no two corners coincide. With ties, those that do are rounded to the same numbers.
std::vector<Index> RegionClipper::exact_numbers() {
  std::vector<Index> rounded, number(alive_.size(), invalid_index);
  if (!has_ties_) {
    std::iota(number.begin(), number.end(), Index{0});
    return number;
  }
  const std::vector<Corner> sorted = number_corners(rounded);
  std::vector<kernel::Fractions> exact;
  for (const Corner c : sorted) exact.push_back(solve_exactly(c));
  const auto are_equal = [&](std::size_t a, std::size_t b) {
    for (std::size_t j = 0; j < d_; ++j)
      if (exact[a].numerators[j] * exact[b].denominator != exact[b].numerators[j] * exact[a].denominator)
        return false;
    return true;
  };
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    number[sorted[i]] = static_cast<Index>(i);
    for (std::size_t j = i; j-- > 0 && rounded[sorted[j]] == rounded[sorted[i]];)
      if (are_equal(i, j)) number[sorted[i]] = number[sorted[j]];
  }
  return number;
}

namespace {

/// By Bareiss's elimination (1968, doi:10.1090/S0025-5718-1968-0226829-0).
std::size_t rank_of(std::vector<std::vector<kernel::Integer>> rows) {
  kernel::Integer last = 1;
  std::size_t rank = 0;
  const std::size_t width = rows.empty() ? 0 : rows[0].size();
  for (std::size_t column = 0; column < width && rank < rows.size(); ++column) {
    std::size_t pivot = rank;
    while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[pivot], rows[rank]);
    for (std::size_t i = rank + 1; i < rows.size(); ++i)
      for (std::size_t j = width; j-- > column;)
        rows[i][j] = (rows[i][j] * rows[rank][column] - rows[i][column] * rows[rank][j]) / last;
    last = rows[rank++][column];
  }
  return rank;
}

}  // namespace

/// Of rows of d + 1 homogeneous coordinates.
std::size_t RegionClipper::rank_of_corners(const std::vector<Corner>& corners) {
  std::vector<std::vector<kernel::Integer>> rows;
  for (const Corner c : corners) {
    kernel::Fractions corner = solve_exactly(c);
    rows.push_back(std::move(corner.numerators));
    rows.back().push_back(std::move(corner.denominator));
  }
  return rank_of(std::move(rows));
}

/// Without ties the planes of a corner are the only ones there, so its edges lead inside of all others.
bool RegionClipper::has_interior(std::span<const double> inside) {
  const std::vector<Corner> all = corners();
  if (all.empty() || !has_ties_) return !all.empty();
  if (!inside.empty()) {
    std::size_t plane = 0;
    while (plane < planes_.size() && certain_side(inside.data(), 0, plane) < 0) ++plane;
    if (plane == planes_.size()) return true;
  }
  return rank_of_corners(all) == d_ + 1;
}

/// A facet of the perturbed polytope tends to a face of the region, whose vertices are what its corners tend
/// to (clipped_regions.cpp). So for d ≤ 3 it spans its plane if it has d different ones.
std::vector<RegionClipper::Facet> RegionClipper::facets(const std::vector<Index>& number, bool proper) {
  std::vector<Facet> result;
  std::vector<Corner> on;
  const std::vector<Corner> all = corners();
  for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
    on.clear();
    std::copy_if(all.begin(), all.end(), std::back_inserter(on), [&](Corner c) { return is_on(c, plane); });
    if (on.empty()) continue;
    Facet facet{plane, {}};
    for (const Corner c : on) facet.corners.push_back(number[c]);
    std::sort(facet.corners.begin(), facet.corners.end());
    facet.corners.erase(std::unique(facet.corners.begin(), facet.corners.end()), facet.corners.end());
    if (proper && has_ties_ && (d_ <= 3 ? facet.corners.size() < d_ : rank_of_corners(on) < d_)) continue;
    result.push_back(std::move(facet));
  }
  return result;
}

std::size_t RegionClipper::fixed_plane_of(std::size_t plane) {
  if (!has_ties_ || plane < num_fixed_planes()) return plane;
  const std::vector<kernel::Integer> row = exact_plane(plane);
  for (std::size_t fixed = 0; fixed < num_fixed_planes(); ++fixed) {
    const std::vector<kernel::Integer>& other = exact_plane(fixed);
    std::size_t at = 0;
    while (other[at] == 0) ++at;
    bool is_same = (other[at] > 0) == (row[at] > 0) && row[at] != 0;
    for (std::size_t j = 0; j <= d_ && is_same; ++j) is_same = row[j] * other[at] == row[at] * other[j];
    if (is_same) return fixed;
  }
  return plane;
}

}  // namespace delone::voronoi
