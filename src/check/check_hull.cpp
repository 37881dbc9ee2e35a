// SPDX-License-Identifier: BSD-3-Clause
// check() of a convex hull.
//
// Why levels 1–4 suffice. The cells are simplices, not flat, each with its hyperplane supporting all points
// (level 4): each lies in the boundary of the convex hull. Every ridge is in two cells that are oriented
// coherently, and outwards (levels 2 and 3), so as one moves on the boundary the number of cells that cover a
// point of general position does not change: it grows and falls only at ridges, where one cell ends and the
// other begins on the other side. It is one at a point of cell 0 (level 4), hence everywhere. (As Mehlhorn et
// al., doi:10.1016/S0925-7721(98)00036-4, check hulls.)
#include "check/check_hull.hpp"
#include "base/progress_meter.hpp"

#include <delone/arithmetic.hpp>
#include <delone/check.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace delone {

using compiled::SimplicialHull;

namespace internal {
namespace {

/// Lists of rows: offsets that divide the rows, which are in range.
void check_lists(const char* what, const std::vector<SignedIndex>& offsets,
                 const std::vector<SignedIndex>& rows, std::size_t n) {
  if (offsets.empty()) {
    if (!rows.empty()) throw Violation{fmt::format("the {}s have vertices, but no offsets", what)};
    return;
  }
  if (offsets.front() != 0 || static_cast<std::size_t>(offsets.back()) != rows.size())
    throw Violation{fmt::format("the offsets of the {}s go from {} to {}, for {} vertices", what,
                                offsets.front(), offsets.back(), rows.size())};
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i)
    if (offsets[i] > offsets[i + 1])
      throw Violation{
          fmt::format("the offsets of the {}s fall from {} to {}", what, offsets[i], offsets[i + 1])};
  for (const SignedIndex row : rows)
    if (row < 0 || static_cast<std::size_t>(row) >= n)
      throw Violation{fmt::format("a {} has the vertex {}, but there are {} points", what, row, n)};
}

void check_hull_storage(const HullData& data, const ComplexData& boundary) {
  if (data.affine_dimension < -1 || data.affine_dimension > data.dimension)
    throw Violation{
        fmt::format("the affine dimension is {}, outside -1...{}", data.affine_dimension, data.dimension)};
  check_storage(boundary);
  const std::size_t n = boundary.num_points(), m = data.num_cells(), f = data.num_facets();
  const auto expect_size = [](const char* what, std::size_t actual, const char* of, std::size_t expected) {
    if (actual != 0 && actual != expected)
      throw Violation{fmt::format("{} entries in {} for {} {}", actual, what, expected, of)};
  };
  if (data.affine_dimension >= 1 && m == 0) throw Violation{"there is no cell"};
  if (data.affine_dimension < 1 && f + data.num_ridges() > 0)
    throw Violation{
        fmt::format("there are facets or ridges, but the affine dimension is {}", data.affine_dimension)};
  expect_size("facet_of_cell", data.facet_of_cell.size(), "cells", m);
  expect_size("equations", data.equations.size() / (static_cast<std::size_t>(data.dimension) + 1), "facets",
              f);
  expect_size("equation_errors", data.equation_errors.size(), "facets", f);
  expect_size("vertex_of_point", data.vertex_of_point.size(), "points", n);
  expect_size("point_kinds", data.point_kinds.size(), "points", n);
  if (data.ridge_offsets.size() != data.num_ridges() + 1 &&
      !(data.ridge_offsets.empty() && data.num_ridges() == 0))
    throw Violation{fmt::format("{} entries in ridge_offsets for {} ridges", data.ridge_offsets.size(),
                                data.num_ridges())};
  check_lists("facet", data.facet_offsets, data.facet_vertices, n);
  check_lists("ridge", data.ridge_offsets, data.ridge_vertices, n);
  for (std::size_t c = 0; c < data.facet_of_cell.size(); ++c)
    if (data.facet_of_cell[c] < 0 || static_cast<std::size_t>(data.facet_of_cell[c]) >= f)
      throw Violation{
          fmt::format("cell {} is part of facet {}, but there are {} facets", c, data.facet_of_cell[c], f),
          {c}};
  for (std::size_t i = 0; i < data.ridge_facets.size(); ++i)
    if (data.ridge_facets[i] < 0 || static_cast<std::size_t>(data.ridge_facets[i]) >= f)
      throw Violation{
          fmt::format("ridge {} is of facet {}, but there are {} facets", i / 2, data.ridge_facets[i], f)};
  if (!(data.tolerance >= 0 && data.max_distance >= 0 && data.max_distance <= data.tolerance &&
        std::isfinite(data.tolerance)))
    throw Violation{fmt::format("the tolerance is {}, and the largest distance of a point at most {}",
                                data.tolerance, data.max_distance)};
  check_axis_tolerances(data.tolerance, data.axis_tolerances, data.dimension);
  for (const SignedIndex row : data.vertices)
    if (row < 0 || static_cast<std::size_t>(row) >= n)
      throw Violation{fmt::format("the extreme points include {}, but there are {} points", row, n)};
}

void check_closed(ExaminedHull& examined, const ComplexData& boundary) {
  Examined incidence{boundary, examined.hull.corners()};
  check_incidence(incidence, examined.hull.dimension > 1);
  const std::size_t corners = examined.hull.corners();
  for (std::size_t at = 0; at < incidence.neighbors.size(); ++at)
    if (incidence.neighbors[at] < 0)
      throw Violation{fmt::format("the boundary is open: only cell {} has the ridge {}", at / corners,
                                  braces(facet_vertices(incidence.cell(at / corners), at % corners))),
                      {at / corners}};
  examined.hull.neighbors.assign(incidence.neighbors.begin(), incidence.neighbors.end());
  std::vector<char> reached(examined.hull.num_cells(), 0);
  std::vector<std::size_t> queue{0};
  reached[0] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const Index across : examined.hull.neighbors_of(queue[next]))
      if (!reached[across]) {
        reached[across] = 1;
        queue.push_back(across);
      }
  if (queue.size() < reached.size()) {
    const auto other =
        static_cast<std::size_t>(std::find(reached.begin(), reached.end(), 0) - reached.begin());
    throw Violation{fmt::format("the boundary falls apart: cell {} cannot be reached from cell 0", other),
                    {0, other}};
  }
}

std::size_t check_convexity(ExaminedHull& examined) {
  const SimplicialHull& hull = examined.hull;
  std::size_t coplanar = 0;
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    cancellation_point();
    Sign sign = Sign::zero;
    for (const Index row : examined.basis)
      if (sign = examined.side(c, row); sign != Sign::zero) break;
    if (sign == Sign::zero) throw Violation{fmt::format("cell {} {} is flat", c, examined.text(c)), {c}};
    if (sign == Sign::negative)
      throw Violation{
          fmt::format("cell {} {} is not oriented outwards, or a point is beyond it", c, examined.text(c)),
          {c}};
    for (std::size_t i = 0; hull.dimension > 1 && i < hull.corners(); ++i) {
      const Index across = hull.neighbors_of(c)[i];
      if (across < c) continue;
      const Index apex = apex_across(hull, c, i);
      const Sign side = examined.side(c, apex);
      if (side == Sign::negative)
        throw Violation{
            fmt::format("the boundary is not convex: the vertex {} of cell {} {} is beyond cell {} {}", apex,
                        across, examined.text(across), c, examined.text(c)),
            {c, across},
            {apex}};
      coplanar += side == Sign::zero;
    }
  }
  return coplanar;
}

void check_support(ExaminedHull& examined) {
  const SimplicialHull& hull = examined.hull;
  std::vector<Index> rows = examined.vertices();
  if (!examined.is_tolerant()) {
    rows.resize(examined.sites.size());
    std::iota(rows.begin(), rows.end(), Index{0});
  }
  for (std::size_t c = 0; c < hull.num_cells(); ++c)
    for (const Index row : rows)
      if (examined.side(c, row) == Sign::negative)
        throw Violation{
            fmt::format("the point {} is beyond cell {} {}", row, c, examined.text(c)), {c}, {row}};
  const auto first = hull.cell(0);
  const Index inner = *std::find_if(examined.basis.begin(), examined.basis.end(),
                                    [&](Index row) { return examined.side(0, row) == Sign::positive; });
  for (std::size_t c = 1; c < hull.num_cells(); ++c) {
    cancellation_point();
    const auto cell = hull.cell(c);
    if (!std::all_of(cell.begin(), cell.end(), [&](Index v) { return examined.side(0, v) == Sign::zero; }))
      continue;
    // The point of general position: vertex 0 of cell 0, moved by ε towards vertex 1, by ε² towards vertex 2,
    // and so on.
    std::size_t i = 0;
    for (; i < cell.size(); ++i) {
      Sign sign = Sign::zero;
      for (const Index v : first)
        if (sign = examined.replaced(c, i, v, inner); sign != Sign::zero) break;
      if (sign != Sign::positive) break;
    }
    if (i == cell.size())
      throw Violation{fmt::format("the cells 0 {} and {} {} overlap", examined.text(0), c, examined.text(c)),
                      {0, c}};
  }
}

}  // namespace
}  // namespace internal

CheckReport check(const HullData& data, const CheckOptions& options, const Execution& how) {
  const ArithmeticScope arithmetic;
  using namespace internal;
  const ProgressMeter meter(how.progress);
  ComplexData boundary;  // cells of k vertices: a complex of dimension k−1
  boundary.dimension = data.dimension;
  boundary.affine_dimension = std::max(data.affine_dimension - 1, -1);
  boundary.points = data.points;
  boundary.cells = data.cells;
  boundary.neighbors = data.neighbors;
  boundary.vertex_of_point = data.vertex_of_point;
  std::optional<ExaminedHull> examined;
  const bool has_cells = data.affine_dimension >= 1;
  return run_levels<HullData>(
      options, [&](CheckReport&) { check_hull_storage(data, boundary); },
      [&](CheckReport&) {
        examined.emplace(data, data.points);
        if (has_cells) check_closed(*examined, boundary);
      },
      [&](CheckReport& report) {
        examined->find_flat();
        if (has_cells) report.ties = check_convexity(*examined);
      },
      [&](CheckReport&) {
        if (has_cells) check_support(*examined);
        if (examined->is_tolerant()) examined->check_distances();
      },
      [&](CheckReport&) { check_hull_faces(*examined, data); });
}

}  // namespace delone
