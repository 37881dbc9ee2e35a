// SPDX-License-Identifier: BSD-3-Clause
#include "hull/box_faces.hpp"

#include "base/progress_meter.hpp"
#include "hull/extreme_hull.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>

namespace delone::hull {
namespace {

/// The values of one coordinate that bound the box, and how many rows have them.
struct Ends {
  double value[2];
  std::size_t count[2];
};

std::vector<Ends> find_ends(std::span<const double> coordinates, std::size_t d) {
  std::vector<Ends> ends;
  for (std::size_t j = 0; j < d; ++j) ends.push_back({{coordinates[j], coordinates[j]}, {0, 0}});
  for (std::size_t row = 0; row < coordinates.size(); row += d)
    for (std::size_t j = 0; j < d; ++j) {
      const double x = coordinates[row + j];
      Ends& of_axis = ends[j];
      of_axis.value[0] = std::min(of_axis.value[0], x);
      of_axis.value[1] = std::max(of_axis.value[1], x);
    }
  for (std::size_t row = 0; row < coordinates.size(); row += d)
    for (std::size_t j = 0; j < d; ++j)
      for (const std::size_t end : {0, 1}) ends[j].count[end] += coordinates[row + j] == ends[j].value[end];
  return ends;
}

}  // namespace

std::vector<char> find_inner_rows_of_box_faces(std::span<const double> coordinates, int dimension,
                                               unsigned threads) {
  constexpr std::size_t least_rows = 512, least_share = 32;
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t n = coordinates.size() / d;
  // What is inserted into hulls of faces is no part of what is done.
  const std::function<bool(double)> no_function;
  const internal::ProgressMeter meter(no_function, 1);
  std::vector<char> is_inner;
  if (d < 3 || n < least_rows) return is_inner;
  const std::vector<Ends> ends = find_ends(coordinates, d);
  for (std::size_t axis = 0; axis < d; ++axis)
    for (const std::size_t end : {0, 1}) {
      if (ends[axis].count[end] < std::max(least_rows, n / least_share)) continue;
      std::vector<std::size_t> rows;
      std::vector<double> face;  // without the coordinate that all have
      rows.reserve(ends[axis].count[end]);
      face.reserve(rows.capacity() * (d - 1));
      for (std::size_t row = 0; row < n; ++row) {
        const double* const x = coordinates.data() + row * d;
        if (x[axis] != ends[axis].value[end] || (!is_inner.empty() && is_inner[row] != 0)) continue;
        rows.push_back(row);
        face.insert(face.end(), x, x + axis);
        face.insert(face.end(), x + axis + 1, x + d);
      }
      if (rows.size() <= d) continue;
      Options options;
      options.threads = threads;
      const ExtremeHull hull = find_extreme_hull(face, dimension - 1, options);
      if (hull.state->affine_hull().dimension() < dimension - 1) continue;
      is_inner.resize(n, 0);
      for (const std::size_t row : rows) is_inner[row] = 1;
      for (const Index at : hull.rows) is_inner[rows[at]] = 0;
    }
  return is_inner;
}

}  // namespace delone::hull
