// SPDX-License-Identifier: BSD-3-Clause
// Volume, centroid and facets of a clipped region, and which of its facets are proper ones.
#include "voronoi/region_clipper.hpp"

#include "base/length.hpp"
#include "kernel/fractions.hpp"

#include <algorithm>
#include <cmath>
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

/// Without ties all facets are. Otherwise a facet is if its corners span its plane: d of them are linearly
/// independent as rows of d + 1 homogeneous coordinates.
bool RegionClipper::spans_plane(std::size_t plane, const std::vector<Corner>& all) {
  std::vector<std::vector<kernel::Integer>> rows;
  for (const Corner c : all) {
    if (std::find(planes_of(c), planes_of(c) + d_, plane) == planes_of(c) + d_) continue;
    if (!has_ties_) return true;
    kernel::Fractions corner = solve_exactly(c);
    rows.push_back(std::move(corner.numerators));
    rows.back().push_back(std::move(corner.denominator));
  }
  return rank_of(std::move(rows)) >= d_;
}

std::vector<RegionClipper::ProperFacet> RegionClipper::proper_facets() {
  const std::vector<Corner> all = corners();
  std::vector<ProperFacet> facets;
  if (d_ > 3) {
    for (std::size_t plane = 0; plane < planes_.size(); ++plane)
      if (spans_plane(plane, all)) facets.push_back({plane, 0});
    return facets.size() > d_ ? facets : std::vector<ProperFacet>{};
  }
  const std::vector<Index> number = exact_numbers();
  // On a line each facet is a corner, and both may be in one place.
  if (d_ == 1 && !all.empty() && number[all.front()] == number[all.back()]) return facets;
  for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
    std::size_t size = 0;
    if (d_ == 3) {
      size = cycle(plane, number, all).size();
    } else {
      std::vector<Index> on;
      for (const Corner c : all)
        if (std::find(planes_of(c), planes_of(c) + d_, plane) != planes_of(c) + d_) on.push_back(number[c]);
      std::sort(on.begin(), on.end());
      size = static_cast<std::size_t>(std::unique(on.begin(), on.end()) - on.begin());
    }
    if (size >= d_) facets.push_back({plane, size});
  }
  return facets.size() > d_ ? facets : std::vector<ProperFacet>{};
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
