// SPDX-License-Identifier: BSD-3-Clause
// For the default tolerance of delone.spatial: how large the numbers of columns are, and whether points are
// flat.
#include "arrays.hpp"
#include "module.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;
using Points = py::array_t<double, py::array::c_style>;

constexpr double most_of_median = 4096;

/// (low, high), the least and the largest numbers of the columns of n ≥ 1 rows of finite numbers.
py::tuple bounds(const Points& points) {
  const auto n = static_cast<std::size_t>(points.shape(0)), d = static_cast<std::size_t>(points.shape(1));
  py::array_t<double> low(points.shape(1)), high(points.shape(1));
  double* const least = low.mutable_data();
  double* const largest = high.mutable_data();
  const double* row = points.data();
  std::copy_n(row, d, least);
  std::copy_n(row, d, largest);
  for (std::size_t i = 1; i < n; ++i) {
    row += d;
    for (std::size_t j = 0; j < d; ++j) {
      least[j] = std::min(least[j], row[j]);
      largest[j] = std::max(largest[j], row[j]);
    }
  }
  return py::make_tuple(low, high);
}

/// Whether the size of each column is its largest |coordinate|, without a median: another one reaches half of
/// it, and most reach the part of it that the median would have to. Looks at as few rows as that takes.
bool are_largest(const double* rows, std::size_t n, const std::vector<double>& largest) {
  const std::size_t d = largest.size();
  std::vector<std::size_t> near(d, 0), large(d, 0);
  std::size_t next = std::min<std::size_t>(n, n / 2 + 1);
  for (std::size_t i = 0; i < n;) {
    for (; i < next; ++i)
      for (std::size_t j = 0; j < d; ++j) {
        const double size = std::fabs(rows[i * d + j]);
        near[j] += size >= largest[j] / 2 ? 1 : 0;
        large[j] += size >= largest[j] / most_of_median ? 1 : 0;
      }
    if (std::all_of(near.begin(), near.end(), [](std::size_t count) { return count > 1; }) &&
        std::all_of(large.begin(), large.end(), [n](std::size_t count) { return count > n / 2; }))
      return true;
    next = std::min(n, next + n / 8 + 1);
  }
  return false;
}

double size_of_column(const double* rows, std::size_t n, std::size_t d, std::size_t j) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < n; ++i)
    if (const double size = std::fabs(rows[i * d + j]); size > 0) sizes.push_back(size);
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double most = most_of_median * *middle;
  std::partial_sort(sizes.begin(), sizes.begin() + std::min<std::ptrdiff_t>(2, std::ssize(sizes)),
                    sizes.end(), std::greater<>());
  const bool is_alone = sizes.size() > 1 && sizes[1] < sizes[0] / 2;
  return std::min(sizes[is_alone ? 1 : 0], most);
}

std::vector<double> column_sizes(const Points& points, const std::vector<double>& largest) {
  const auto n = static_cast<std::size_t>(points.shape(0)), d = static_cast<std::size_t>(points.shape(1));
  if (are_largest(points.data(), n, largest)) return largest;
  std::vector<double> sizes;
  for (std::size_t j = 0; j < d; ++j) sizes.push_back(size_of_column(points.data(), n, d, j));
  return sizes;
}

/// Each of d + 1 points is the farthest from the flat of those before it, in units of the tolerances. What is
/// nearer than their rounding counts as within the tolerance.
bool may_be_flat(const Points& points, const std::vector<double>& tolerances) {
  const std::size_t d = tolerances.size();
  std::vector<double> rests = {points.data(), points.data() + points.size()};
  double largest = 0;
  for (std::size_t i = rests.size(); i-- > 0;) {
    rests[i] = (rests[i] - rests[i % d]) / tolerances[i % d];
    largest = std::max(largest, std::fabs(rests[i]));
  }
  const double noise = 8 + 64 * static_cast<double>(d) * std::numeric_limits<double>::epsilon() * largest;
  for (std::size_t k = 0; k < d; ++k) {
    double farthest = 0;
    std::vector<double> unit(d);
    for (std::size_t i = 0; i < rests.size(); i += d) {
      double square = 0;
      for (std::size_t j = 0; j < d; ++j) square += rests[i + j] * rests[i + j];
      if (!(square > farthest)) continue;
      farthest = square;
      std::copy_n(&rests[i], d, unit.begin());
    }
    const double distance = std::sqrt(farthest);
    if (!(distance > noise && distance < std::numeric_limits<double>::infinity())) return true;
    for (double& x : unit) x /= distance;
    for (std::size_t i = 0; i < rests.size(); i += d) {
      double part = 0;
      for (std::size_t j = 0; j < d; ++j) part += unit[j] * rests[i + j];
      for (std::size_t j = 0; j < d; ++j) rests[i + j] -= part * unit[j];
    }
  }
  return false;
}

}  // namespace

void bind_rounding(py::module_& module) {
  module.def("_bounds", &bounds, "points"_a,
             "(low, high), (d,) each: the least and the largest numbers of the columns of finite points.");
  module.def("_column_sizes", &column_sizes, "points"_a, "largest"_a,
             "Of each column the largest |coordinate|, which is given, or the second largest if that is less "
             "than half of it; at most 4096 times the median of those that are not 0.");
  module.def(
      "_may_be_flat", &may_be_flat, "points"_a, "tolerances"_a,
      "Whether points may be within the tolerances of the axes of a flat of fewer dimensions; if not, they "
      "certainly are not.");
}

}  // namespace delone::python
