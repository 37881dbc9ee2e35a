// SPDX-License-Identifier: BSD-3-Clause
// The levels of check() of a triangulation that look at arrays only, storage (1) and completeness (6);
// incidence and sphere (2, 3) are in check_topology.cpp, the exact geometry (4, 5) in check_geometry.cpp.
// What data are, and so which levels they have, check_kinds.cpp decides.
#include <delone/check.hpp>

#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "check/check_stages.hpp"
#include "complex/canonical_hash.hpp"
#include "kernel/predicates.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace delone {
namespace internal {

std::string braces(std::span<const SignedIndex> rows) { return fmt::format("{{{}}}", fmt::join(rows, ", ")); }

std::vector<SignedIndex> facet_vertices(std::span<const SignedIndex> cell, std::size_t opposite) {
  std::vector<SignedIndex> rows(cell.begin(), cell.end());
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(opposite));
  return rows;
}

void check_storage(const ComplexData& data, bool may_hide, unsigned threads) {
  const int d = data.dimension, k = data.affine_dimension;
  if (d < 1) throw Violation{fmt::format("the dimension is {}, less than 1", d)};
  if (k < -1 || k > d) throw Violation{fmt::format("the affine dimension is {}, outside -1...{}", k, d)};
  if (data.points.size() % static_cast<std::size_t>(d) != 0)
    throw Violation{
        fmt::format("{} coordinates are not a multiple of the dimension {}", data.points.size(), d)};
  const std::size_t n = data.num_points(), corners = static_cast<std::size_t>(k + 1);
  if (n == 0 && (!data.cells.empty() || !data.vertex_of_point.empty()))
    throw Violation{
        "there are cells, but no points: data() and to_data(false) leave them out, to_data() does not"};
  if (k == -1 && !data.cells.empty()) throw Violation{"there are cells, but the affine dimension is -1"};
  if (k >= 0 && data.cells.size() % corners != 0)
    throw Violation{fmt::format("{} cell vertices are not a multiple of {}", data.cells.size(), corners)};
  if (!data.neighbors.empty() && data.neighbors.size() != data.cells.size())
    throw Violation{
        fmt::format("{} neighbors for {} cell vertices", data.neighbors.size(), data.cells.size())};
  if (!data.vertex_of_point.empty() && data.vertex_of_point.size() != n)
    throw Violation{
        fmt::format("{} entries in vertex_of_point for {} points", data.vertex_of_point.size(), n)};

  if (!data.weights.empty() && data.weights.size() != n)
    throw Violation{fmt::format("{} weights for {} points", data.weights.size(), n)};

  for (std::size_t i = 0; i < data.points.size(); ++i)
    if (!std::isfinite(data.points[i]) && !data.is_removed(i / static_cast<std::size_t>(d))) {
      const std::size_t row = i / static_cast<std::size_t>(d);
      throw Violation{fmt::format("point {} has a coordinate that is not finite", row), {}, {row}};
    }
  for (std::size_t row = 0; row < data.weights.size(); ++row)
    if (!std::isfinite(data.weights[row]) && !data.is_removed(row))
      throw Violation{fmt::format("the weight of point {} is not finite", row), {}, {row}};
  const std::size_t m = data.num_cells();
  for_parts(threads, m, part_of_check, [&](std::size_t first, std::size_t last, const StopPoint& stop) {
    stop();
    std::vector<SignedIndex> sorted(corners);
    for (std::size_t c = first; c < last; ++c) {
      sorted.assign(data.cells.begin() + static_cast<std::ptrdiff_t>(c * corners),
                    data.cells.begin() + static_cast<std::ptrdiff_t>((c + 1) * corners));
      std::sort(sorted.begin(), sorted.end());
      for (const SignedIndex row : {sorted.front(), sorted.back()})
        if (row < 0 || static_cast<std::size_t>(row) >= n)
          throw Violation{fmt::format("cell {} has the vertex {}, but there are {} points", c, row, n), {c}};
      for (const SignedIndex row : sorted)
        if (data.is_removed(static_cast<std::size_t>(row)))
          throw Violation{fmt::format("cell {} has the vertex {}, whose coordinates are missing", c, row),
                          {c}};
      const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
      if (twice != sorted.end())
        throw Violation{fmt::format("cell {} has the vertex {} twice", c, *twice),
                        {c},
                        {static_cast<std::size_t>(*twice)}};
    }
  });
  for (std::size_t i = 0; i < data.neighbors.size(); ++i)
    if (data.neighbors[i] < -1 ||
        (data.neighbors[i] >= 0 && static_cast<std::size_t>(data.neighbors[i]) >= m))
      throw Violation{fmt::format("neighbor {} of cell {} is {}, but there are {} cells", i % corners,
                                  i / corners, data.neighbors[i], m),
                      {i / corners}};
  for (std::size_t row = 0; row < data.vertex_of_point.size(); ++row)
    if (data.vertex_of_point[row] < (data.weights.empty() && !may_hide && !data.is_removed(row) ? 0 : -1) ||
        (data.vertex_of_point[row] >= 0 && static_cast<std::size_t>(data.vertex_of_point[row]) >= n))
      throw Violation{fmt::format("vertex_of_point sends point {} to row {}, but there are {} points", row,
                                  data.vertex_of_point[row], n),
                      {},
                      {row}};
}

std::vector<double> weighted_rows(const ComplexData& data) {
  std::vector<double> rows;
  const auto d = static_cast<std::ptrdiff_t>(data.dimension);
  for (std::size_t row = 0; row < data.weights.size(); ++row) {
    const auto point = data.points.begin() + static_cast<std::ptrdiff_t>(row) * d;
    rows.insert(rows.end(), point, point + d);
    rows.push_back(data.weights[row]);
  }
  return rows;
}

namespace {

bool equal_points(const Examined& examined, std::size_t a, std::size_t b) {
  const double* p = examined.point(static_cast<SignedIndex>(a));
  return std::equal(p, p + examined.row_size(), examined.point(static_cast<SignedIndex>(b)));
}

// For each row a vertex row with equal coordinates, or −1 where there is none.
std::vector<SignedIndex> derived_vertices(const Examined& examined, const std::vector<bool>& is_vertex) {
  const std::size_t n = is_vertex.size(), capacity = std::bit_ceil(2 * n + 1);
  std::vector<std::size_t> table(capacity, n);
  std::vector<SignedIndex> vertex_of_point(n, -1);
  const auto place_of = [&](std::size_t row) {
    std::size_t place = complex::point_tag(examined.point(static_cast<SignedIndex>(row)),
                                           static_cast<int>(examined.row_size()))
                            .low &
                        (capacity - 1);
    while (table[place] != n && !equal_points(examined, table[place], row))
      place = (place + 1) & (capacity - 1);
    return place;
  };
  for (std::size_t row = 0; row < n; ++row) {
    cancellation_point();
    if (!is_vertex[row]) continue;
    const std::size_t place = place_of(row);
    if (table[place] != n)
      throw Violation{fmt::format("the vertices {} and {} are the same point", table[place], row),
                      {},
                      {table[place], row}};
    table[place] = row;
    vertex_of_point[row] = static_cast<SignedIndex>(row);
  }
  for (std::size_t row = 0; row < n; ++row)
    if (!is_vertex[row]) {
      const std::size_t vertex = table[place_of(row)];
      if (vertex != n) vertex_of_point[row] = static_cast<SignedIndex>(vertex);
    }
  return vertex_of_point;
}

}  // namespace

void check_completeness(const Examined& examined, const Volumes& volumes, bool canonical) {
  const ComplexData& data = examined.data;
  const std::size_t n = data.num_points();
  std::vector<bool> is_vertex(n, false);
  for (const SignedIndex row : data.cells) is_vertex[static_cast<std::size_t>(row)] = true;

  const bool derive = data.vertex_of_point.empty();
  const std::vector<SignedIndex> derived =
      derive ? derived_vertices(examined, is_vertex) : std::vector<SignedIndex>{};
  const std::vector<SignedIndex>& vertex_of_point = derive ? derived : data.vertex_of_point;
  std::vector<std::size_t> hidden;
  for (std::size_t row = 0; row < n; ++row) {
    cancellation_point();
    if (data.is_removed(row)) continue;
    const SignedIndex vertex = vertex_of_point[row];
    if (vertex < 0 && examined.may_hide()) {
      if (is_vertex[row])
        throw Violation{fmt::format("point {} is a vertex of a cell, but hidden", row), {}, {row}};
      hidden.push_back(row);
      continue;
    }
    if (vertex < 0)
      throw Violation{fmt::format("point {} is neither a vertex of a cell nor equal to one", row), {}, {row}};
    const auto at = static_cast<std::size_t>(vertex);
    if (!is_vertex[at])
      throw Violation{at == row
                          ? fmt::format("point {} is its own vertex, but no cell has it", row)
                          : fmt::format("point {} was merged into point {}, but no cell has that", row, at),
                      {},
                      at == row ? std::vector{row} : std::vector{row, at}};
    if (is_vertex[row] && at != row)
      throw Violation{fmt::format("point {} is a vertex of a cell, but was merged into point {}", row, at),
                      {},
                      {row, at}};
    if (!equal_points(examined, row, at))
      throw Violation{
          fmt::format("point {} was merged into point {}, but they are not equal", row, at), {}, {row, at}};
  }

  kernel::AffineHull hull(data.dimension);
  for (std::size_t row = 0; row < n && hull.dimension() < data.dimension; ++row)
    if (!data.is_removed(row) && hull.add(examined.point(static_cast<SignedIndex>(row))) &&
        hull.dimension() > data.affine_dimension)
      throw Violation{fmt::format("the affine dimension is given as {}, but the points up to {} span {}",
                                  data.affine_dimension, row, hull.dimension()),
                      {},
                      {row}};
  if (hull.dimension() != data.affine_dimension)
    throw Violation{fmt::format("the affine dimension is given as {}, but the points span {}",
                                data.affine_dimension, hull.dimension())};
  check_hidden(examined, volumes, hidden, canonical);
}

std::string no_fault_of_a_part(const ComplexData& data, int level) {
  if (data.kind != DataKind::unknown) return {};
  return fmt::format(
      "; if the cells are a part of a triangulation, as those of an alpha complex are, this is no fault: a "
      "part has to pass the levels up to {} only",
      level - 1);
}

namespace {

/// The dimension that the points of the cells span, as far as it is needed: not beyond `most`.
int spanned_dimension(const ComplexData& data, int most) {
  kernel::AffineHull hull(data.dimension);
  for (const SignedIndex row : data.cells) {
    if (hull.dimension() >= most) break;
    hull.add(data.points.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(data.dimension));
  }
  return hull.dimension();
}

/// What data that do not say what they are may be, if they are no triangulation of their points; empty if the
/// violation is none of those that they have. REQUIRES that level 1 is passed.
std::string other_meaning(const ComplexData& data, const CheckReport& report) {
  if (data.kind != DataKind::unknown) return {};
  const int k = data.affine_dimension;
  if (k < data.dimension && spanned_dimension(data, k + 1) > k)
    return fmt::format(
        "; these cells of dimension {} do not lie in one flat: they are a surface, as the lower hull of "
        "points or the boundary of an alpha complex, which has to pass level 1 only",
        k);
  return report.reached.number == 3 ? no_fault_of_a_part(data, 3) : "";
}

}  // namespace

CheckReport check_lifted(const ComplexData& data, const CheckOptions& options, unsigned threads, Lift lift,
                         std::span<const CheckLevel> levels) {
  Examined examined{data, static_cast<std::size_t>(std::max(0, data.affine_dimension + 1)), lift, threads};
  Volumes volumes;
  // No points, no cells: the empty complex is a sphere of dimension −1, and nothing else is left to hold.
  const bool is_empty = data.affine_dimension < 0;
  CheckReport found = run_levels(
      levels, options,
      [&](CheckReport&) {
        check_storage(data, lift != Lift::paraboloid, threads);
        examined.weighted_rows = weighted_rows(data);
      },
      [&](CheckReport&) {
        if (!is_empty) check_incidence(examined, options.oriented);
      },
      [&](CheckReport&) {
        if (!is_empty) check_sphere(examined);
      },
      [&](CheckReport&) {
        if (!is_empty) volumes = check_volume(examined, options.oriented);
      },
      [&](CheckReport& report) {
        if (!is_empty) report.ties = check_local_convexity(examined, volumes, options.canonical);
      },
      [&](CheckReport&) { check_completeness(examined, volumes, options.canonical); });
  if (!found.ok && found.reached.number > 1 && !is_empty) found.violation += other_meaning(data, found);
  return found;
}

}  // namespace internal
}  // namespace delone
