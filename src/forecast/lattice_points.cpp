// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/lattice_points.hpp"

#include "base/progress_meter.hpp"
#include "forecast/model/cell_counts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone::cost_model {
namespace {

/// Coordinates that differ by less than this part of their range count as one, as do distances: numbers that
/// were rounded a few times.
constexpr double rounding = 1e-9;

double squared_distance(const double* a, const double* b, std::size_t d) {
  double sum = 0;
  for (std::size_t j = 0; j < d; ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sum;
}

struct RowAtDistance {
  double distance;
  std::size_t row;
  friend bool operator<(const RowAtDistance& a, const RowAtDistance& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.row < b.row;
  }
};

/// The squared distance to the nearest other point that is not equal.
double nearest(std::span<const double> coordinates, std::size_t d, std::size_t row) {
  const double* const point = coordinates.data() + row * d;
  double least = std::numeric_limits<double>::infinity();
  std::size_t count = 0;
  for (const double* other = coordinates.data(); other != coordinates.data() + coordinates.size();
       other += d) {
    if (++count % 1024 == 0) internal::cancellation_point();
    const double distance = squared_distance(point, other, d);
    if (distance > 0 && distance < least) least = distance;
  }
  return least;
}

/// The different values of a coordinate: apart by more than a gap, and in all.
struct Values {
  std::size_t apart = 1, exact = 1;
};
Values count_values(std::span<const double> sorted, double gap) {
  Values values;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    values.apart += sorted[i] - sorted[i - 1] > gap;
    values.exact += sorted[i] != sorted[i - 1];
  }
  return values;
}

/// How many distances are about the middle one, and how many are equal to it.
struct Alike {
  std::size_t about = 0, equal = 0;
};
Alike count_alike(std::span<const double> sorted) {
  const double middle = sorted[sorted.size() / 2];
  Alike alike;
  for (const double x : sorted) {
    alike.about += std::abs(x - middle) <= rounding * middle;
    alike.equal += x == middle;
  }
  return alike;
}

}  // namespace

LatticePoints find_lattice(std::span<const double> coordinates, int dimension,
                           std::span<const std::size_t> rows, double num_distinct) {
  constexpr std::size_t most_asked = 12, least_asked = 6;
  const auto d = static_cast<std::size_t>(dimension);
  LatticePoints lattice;
  if (dimension < 2 || num_distinct < 8 || rows.size() < 8) return lattice;
  std::vector<double> distances;
  Alike alike;
  for (std::size_t i = 0; i < std::min(rows.size(), most_asked); ++i) {
    const double distance = nearest(coordinates, d, rows[i]);
    if (!std::isfinite(distance)) return lattice;
    distances.insert(std::upper_bound(distances.begin(), distances.end(), distance), distance);
    if (distances.size() < least_asked) continue;
    // Two points may be nearest to each other in any set, and points at the border of a lattice that is not
    // parallel to the axes may miss their neighbors.
    alike = count_alike(distances);
    if (alike.about < std::max<std::size_t>(distances.size() / 3, 2)) return lattice;
  }
  lattice.found = true;
  std::vector<std::vector<double>> sorted(d);
  double range = 0;
  for (std::size_t axis = 0; axis < d; ++axis) {
    for (const std::size_t row : rows) sorted[axis].push_back(coordinates[row * d + axis]);
    std::sort(sorted[axis].begin(), sorted[axis].end());
    range = std::max(range, sorted[axis].back() - sorted[axis].front());
  }
  double boxes = 1, points = 1, most_values = 0;
  bool is_rounded = alike.equal < alike.about;
  for (const std::vector<double>& numbers : sorted) {
    const Values values = count_values(numbers, rounding * range);
    const auto apart = static_cast<double>(values.apart);
    is_rounded |= values.apart <= numbers.size() / 4 && values.exact > values.apart;
    points *= apart;
    if (values.apart > 1) boxes *= apart - 1;
    most_values = std::max(most_values, apart);
  }
  const double fill = num_distinct / points;
  lattice.has_ties = !is_rounded;
  const double side = grid_side(dimension, num_distinct);
  lattice.hull_volume = fill >= 0.4 && most_values > side  // parallel to the axes
                            ? boxes * std::min(fill, 1.0)
                            : lattice_hull(dimension, num_distinct, side).volume;
  return lattice;
}

std::vector<double> patch_around(std::span<const double> coordinates, int dimension, std::size_t row,
                                 std::size_t m) {
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t n = coordinates.size() / d;
  const double* const center = coordinates.data() + row * d;
  std::vector<RowAtDistance> found;  // the nearest so far, as a heap: the farthest of them is the first
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 1024 == 0) internal::cancellation_point();
    const RowAtDistance next{squared_distance(center, coordinates.data() + i * d, d), i};
    if (found.size() >= m) {
      if (found.empty() || !(next < found.front())) continue;
      std::pop_heap(found.begin(), found.end());
      found.pop_back();
    }
    found.push_back(next);
    std::push_heap(found.begin(), found.end());
  }
  std::sort_heap(found.begin(), found.end());
  std::vector<double> patch;
  patch.reserve(found.size() * d);
  for (const RowAtDistance& near : found) {
    const double* const point = coordinates.data() + near.row * d;
    patch.insert(patch.end(), point, point + d);
  }
  return patch;
}

}  // namespace delone::cost_model
