// SPDX-License-Identifier: BSD-3-Clause
#include "halfspaces/halfspace_vertex.hpp"

#include "halfspaces/halfspace_dual.hpp"
#include "halfspaces/meeting_point_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace delone::halfspaces {
namespace {

void find_exactly(std::span<const double* const> rows, std::span<const int> columns, double* result) {
  const std::size_t n = rows.size();
  std::vector<kernel::Integer> system;
  std::vector<double> entries(n + 1);
  for (const double* row : rows) {
    for (std::size_t j = 0; j <= n; ++j) entries[j] = row[columns[j]];
    for (kernel::Integer& x : integer_row(entries.data(), n + 1)) system.push_back(std::move(x));
    system.back() = -system.back();
  }
  const kernel::Fractions x = kernel::solve_exactly(std::move(system), n);
  for (std::size_t j = 0; j < n; ++j) result[j] = kernel::nearest_double(x.numerators[j], x.denominator, 0);
}

}  // namespace

void meeting_point(std::span<const double* const> rows, std::span<const int> columns, double* x) {
  if (!find_meeting_point(rows, columns, x)) find_exactly(rows, columns, x);
}

std::vector<double> meeting_points(std::span<const double* const> rows, std::span<const int> columns) {
  const std::size_t n = columns.size() - 1, count = rows.size() / n;
  std::vector<double> points(count * n);
  const auto find = [&](std::size_t p) {
    meeting_point(rows.subspan(p * n, n), columns, points.data() + p * n);
  };
  std::size_t next = 0;
  if (n >= least_meeting_lanes && n <= most_meeting_lanes) {
    std::vector<double> entries(n * (n + 1) * meeting_block), found(n * meeting_block),
        settled(meeting_block);
    for (; next + meeting_block <= count; next += meeting_block) {
      for (std::size_t lane = 0; lane < meeting_block; ++lane)
        for (std::size_t i = 0; i < n; ++i) {
          const double* const row = rows[(next + lane) * n + i];
          for (std::size_t j = 0; j <= n; ++j)
            entries[(i * (n + 1) + j) * meeting_block + lane] = row[columns[j]];
        }
      find_meeting_points_in_lanes(n, entries.data(), found.data(), settled.data());
      for (std::size_t lane = 0; lane < meeting_block; ++lane) {
        if (settled[lane] == 0) {
          find(next + lane);
          continue;
        }
        for (std::size_t j = 0; j < n; ++j) points[(next + lane) * n + j] = found[j * meeting_block + lane];
      }
    }
  }
  for (; next < count; ++next) find(next);
  return points;
}

std::vector<kernel::Integer> cone_normal(std::span<const double* const> rows, std::span<const int> columns) {
  const std::size_t k = rows.size();
  std::vector<std::vector<kernel::Integer>> integers;
  std::vector<double> entries(k + 1);
  for (const double* row : rows) {
    for (std::size_t j = 0; j <= k; ++j) entries[j] = row[columns[j]];
    integers.push_back(integer_row(entries.data(), k + 1));
  }
  std::vector<kernel::Integer> normal;
  for (std::size_t j = 0; j <= k; ++j) {
    std::vector<kernel::Integer> minor;
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t c = 0; c <= k; ++c)
        if (c != j) minor.push_back(integers[i][c]);
    const kernel::Integer det = kernel::exact_determinant(std::move(minor), k);
    normal.push_back((k + j) % 2 == 0 ? det : kernel::Integer(-det));
  }
  return normal;
}

std::vector<double> unit_vector(std::span<const kernel::Integer> entries, std::span<const int> axes,
                                std::size_t d) {
  kernel::Integer largest = 0;
  for (const kernel::Integer& x : entries)
    largest = std::max(largest, kernel::Integer(boost::multiprecision::abs(x)));
  std::vector<double> vector(d, 0.0);
  double square = 0;
  for (std::size_t j = 0; j < axes.size(); ++j) {
    double& x = vector[static_cast<std::size_t>(axes[j])];
    x = kernel::nearest_double(entries[j], largest, 0);
    square += x * x;
  }
  for (double& x : vector) x = x / std::sqrt(square) + 0.0;
  return vector;
}

std::vector<double> lineality_basis(std::span<const double* const> rows, std::span<const int> axes,
                                    std::size_t d) {
  const std::size_t k = rows.size();
  std::vector<double> basis;
  for (int free = 0; free < static_cast<int>(d); ++free) {
    if (std::binary_search(axes.begin(), axes.end(), free)) continue;
    std::vector<kernel::Integer> system;
    std::vector<double> entries(k + 1);
    std::vector<int> columns(axes.begin(), axes.end());
    columns.push_back(free);
    for (const double* row : rows) {
      for (std::size_t j = 0; j <= k; ++j) entries[j] = row[columns[j]];
      for (kernel::Integer& x : integer_row(entries.data(), k + 1)) system.push_back(std::move(x));
    }
    // The solution of the system is the negative of the coordinates on the axes.
    std::vector<kernel::Integer> direction;
    kernel::Integer denominator = 1;
    if (k > 0) {
      kernel::Fractions solution = kernel::solve_exactly(std::move(system), k);
      for (kernel::Integer& x : solution.numerators) direction.push_back(-x);
      denominator = solution.denominator;
    }
    direction.push_back(denominator);
    const std::vector<double> vector = unit_vector(direction, columns, d);
    basis.insert(basis.end(), vector.begin(), vector.end());
  }
  return basis;
}

}  // namespace delone::halfspaces
