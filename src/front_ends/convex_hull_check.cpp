// SPDX-License-Identifier: BSD-3-Clause
// check_hull(): the levels of exact checks of a convex hull, our own or anybody's.
//
// Why levels 1–4 suffice. The cells are simplices, not flat, each with its hyperplane supporting all points (level 4): each
// lies in the boundary of the convex hull. Every ridge is in two cells that are oriented coherently, and outwards (levels 2 and
// 3), so as one moves on the boundary the number of cells that cover a point of general position does not change: it grows and
// falls only at ridges, where one cell ends and the other begins on the other side. It is one at a point of cell 0 (level 4),
// hence everywhere. (As Mehlhorn et al., doi:10.1016/S0925-7721(98)00036-4, check hulls.)
#include "front_ends/canonical_hash.hpp"
#include "front_ends/check_stages.hpp"
#include "front_ends/convex_hull_faces.hpp"
#include "front_ends/hull_normal.hpp"
#include "front_ends/simplicial_hull.hpp"
#include "kernel/predicates.hpp"

#include <delone/convex_hull.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>

namespace delone {
namespace front_ends {
namespace {

/// The hull as the engine's front end sees it: rows are sites.
class ExaminedHull {
 public:
  ExaminedHull(const HullData& data, const std::vector<double>& points) : sites(data.dimension), data_(data) {
    sites.coordinates = points;
    for (std::size_t row = 0; row < sites.size(); ++row) sites.grid.include(sites.point(static_cast<Index>(row)));
    hull.dimension = data.affine_dimension;
    hull.cells.assign(data.cells.begin(), data.cells.end());
  }

  /// The affine hull of the points, which must have the dimension that was given.
  void find_flat() {
    kernel::AffineHull affine_hull(sites.ambient);
    for (Index row = 0; row < sites.size() && affine_hull.dimension() < sites.ambient; ++row)
      if (affine_hull.add(sites.point(row))) basis.push_back(row);
    if (affine_hull.dimension() != hull.dimension)
      throw Violation{
          fmt::format("the affine dimension is given as {}, but the points span {}", hull.dimension, affine_hull.dimension()),
          {},
          {}};
    sites.axes = affine_hull.axes();
    normals.emplace(hull.dimension < 1 ? 1 : hull.dimension);
    records.resize(hull.num_cells() * normals->stride());
    for (std::size_t c = 0; c < hull.num_cells(); ++c)
      normals->compute(sites, hull.cell(c), hull.dimension == 1 && c == 0, records.data() + c * normals->stride());
  }

  Sign side(std::size_t c, Index row) {
    const auto cell = hull.cell(c);
    if (std::find(cell.begin(), cell.end(), row) != cell.end()) return Sign::zero;
    const double* q = sites.point(row);
    const Sign sign = normals->side(sites, records.data() + c * normals->stride(), sites.point(cell[0]), q);
    return sign != Sign::zero ? sign : side_of_cell(sites, hull, c, q, sites.grid, scratch);
  }
  /// The sign of det(v_i − base) for the cell with vertex i replaced.
  Sign replaced(std::size_t c, std::size_t i, Index row, Index base) {
    scratch.assign(1, sites.point(base));
    for (const Index v : hull.cell(c)) scratch.push_back(sites.point(v));
    scratch[i + 1] = sites.point(row);
    return kernel::orientation<0>(sites.flat(), scratch.data(), sites.grid);
  }

  std::string text(std::size_t c) const {
    const auto corners = hull.corners();
    return braces(std::span<const SignedIndex>(data_.cells).subspan(c * corners, corners));
  }

  HullSites sites;
  SimplicialHull hull;
  std::vector<Index> basis;
  std::optional<HullNormals> normals;
  std::vector<double> records;
  std::vector<const double*> scratch;

 private:
  const HullData& data_;
};

void check_hull_storage(const HullData& data, const ComplexData& boundary) {
  if (data.affine_dimension < 1) {
    if (data.dimension < 1) throw Violation{fmt::format("the dimension is {}, less than 1", data.dimension), {}, {}};
    if (!data.cells.empty())
      throw Violation{fmt::format("there are cells, but the affine dimension is {}", data.affine_dimension), {}, {}};
    return;
  }
  if (data.affine_dimension > data.dimension)
    throw Violation{fmt::format("the affine dimension is {}, outside -1...{}", data.affine_dimension, data.dimension), {}, {}};
  check_storage(boundary);
  if (data.cells.empty()) throw Violation{"there is no cell", {}, {}};
  const std::size_t f = data.num_facets();
  if (!data.facet_of_cell.empty() && data.facet_of_cell.size() != data.num_cells())
    throw Violation{
        fmt::format("{} entries in facet_of_cell for {} cells", data.facet_of_cell.size(), data.num_cells()), {}, {}};
  for (std::size_t c = 0; c < data.facet_of_cell.size(); ++c)
    if (data.facet_of_cell[c] < 0 || static_cast<std::size_t>(data.facet_of_cell[c]) >= f)
      throw Violation{
          fmt::format("cell {} is part of facet {}, but there are {} facets", c, data.facet_of_cell[c], f), {c}, {}};
  if (!data.point_kinds.empty() && data.point_kinds.size() != boundary.num_points())
    throw Violation{fmt::format("{} kinds for {} points", data.point_kinds.size(), boundary.num_points()), {}, {}};
}

void check_closed(ExaminedHull& examined, const ComplexData& boundary) {
  Examined incidence{boundary, examined.hull.corners()};
  check_incidence(incidence, examined.hull.dimension > 1);
  const std::size_t corners = examined.hull.corners();
  for (std::size_t at = 0; at < incidence.neighbors.size(); ++at)
    if (incidence.neighbors[at] < 0)
      throw Violation{fmt::format("the boundary is open: only cell {} has the ridge {}", at / corners,
                                  braces(facet_vertices(incidence.cell(at / corners), at % corners))),
                      {at / corners},
                      {}};
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
    const auto other = static_cast<std::size_t>(std::find(reached.begin(), reached.end(), 0) - reached.begin());
    throw Violation{fmt::format("the boundary falls apart: cell {} cannot be reached from cell 0", other), {0, other}, {}};
  }
}

/// The vertex opposite the ridge that cell c shares across its vertex i.
Index apex_across(const SimplicialHull& hull, std::size_t c, std::size_t i) {
  const auto cell = hull.cell(c);
  const auto other = hull.cell(hull.neighbors_of(c)[i]);
  return *std::find_if(other.begin(), other.end(), [&](Index v) {
    const auto at = std::find(cell.begin(), cell.end(), v);
    return at == cell.end() || at == cell.begin() + static_cast<std::ptrdiff_t>(i);
  });
}

std::size_t check_convexity(ExaminedHull& examined) {
  const SimplicialHull& hull = examined.hull;
  std::size_t coplanar = 0;
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    Sign sign = Sign::zero;
    for (const Index row : examined.basis)
      if (sign = examined.side(c, row); sign != Sign::zero) break;
    if (sign == Sign::zero) throw Violation{fmt::format("cell {} {} is flat", c, examined.text(c)), {c}, {}};
    if (sign == Sign::negative)
      throw Violation{
          fmt::format("cell {} {} is not oriented outwards, or a point is beyond it", c, examined.text(c)), {c}, {}};
    for (std::size_t i = 0; hull.dimension > 1 && i < hull.corners(); ++i) {
      const Index across = hull.neighbors_of(c)[i];
      if (across < c) continue;
      const Index apex = apex_across(hull, c, i);
      const Sign side = examined.side(c, apex);
      if (side == Sign::negative)
        throw Violation{fmt::format("the boundary is not convex: the vertex {} of cell {} {} is beyond cell {} {}", apex,
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
  std::vector<std::size_t> coplanar;  // with cell 0
  for (std::size_t c = 0; c < hull.num_cells(); ++c)
    for (Index row = 0; row < examined.sites.size(); ++row)
      if (examined.side(c, row) == Sign::negative)
        throw Violation{fmt::format("the point {} is beyond cell {} {}", row, c, examined.text(c)), {c}, {row}};
  const auto first = hull.cell(0);
  const Index inner = *std::find_if(examined.basis.begin(), examined.basis.end(),
                                    [&](Index row) { return examined.side(0, row) == Sign::positive; });
  for (std::size_t c = 1; c < hull.num_cells(); ++c) {
    const auto cell = hull.cell(c);
    if (!std::all_of(cell.begin(), cell.end(), [&](Index v) { return examined.side(0, v) == Sign::zero; })) continue;
    // The point of general position: vertex 0 of cell 0, moved by ε towards vertex 1, by ε² towards vertex 2, and so on.
    std::size_t i = 0;
    for (; i < cell.size(); ++i) {
      Sign sign = Sign::zero;
      for (const Index v : first)
        if (sign = examined.replaced(c, i, v, inner); sign != Sign::zero) break;
      if (sign != Sign::positive) break;
    }
    if (i == cell.size())
      throw Violation{fmt::format("the cells 0 {} and {} {} overlap", examined.text(0), c, examined.text(c)), {0, c}, {}};
  }
}

void check_faces(ExaminedHull& examined, const HullData& data) {
  const SimplicialHull& hull = examined.hull;
  const std::size_t n = examined.sites.size();
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t c = 0; hull.dimension > 1 && c < hull.num_cells(); ++c)
    for (std::size_t i = 0; i < hull.corners(); ++i)
      if (const Index across = hull.neighbors_of(c)[i]; across > c && examined.side(c, apex_across(hull, c, i)) == Sign::zero)
        pairs.emplace_back(static_cast<Index>(c), across);
  const PolytopeFaces faces = find_faces(hull, n, pairs);
  const Lists facet_sites = find_facet_sites(hull, faces);
  if (!data.facet_of_cell.empty()) {
    if (faces.num_facets() != data.num_facets())
      throw Violation{fmt::format("{} facets are given, the cells make {}", data.num_facets(), faces.num_facets()), {}, {}};
    std::vector<SignedIndex> given_of(faces.num_facets(), -1);
    for (std::size_t c = 0; c < hull.num_cells(); ++c) {
      SignedIndex& given = given_of[faces.facet_of_cell[c]];
      if (given < 0) given = data.facet_of_cell[c];
      if (given != data.facet_of_cell[c])
        throw Violation{
            fmt::format("cell {} is part of facet {}, but lies in the hyperplane of facet {}", c, data.facet_of_cell[c], given),
            {c},
            {}};
    }
    for (std::size_t f = 0; f < faces.num_facets(); ++f) {
      const auto given = static_cast<std::size_t>(given_of[f]);
      const std::vector<SignedIndex> expected(facet_sites[f].begin(), facet_sites[f].end());
      const std::span<const SignedIndex> actual(data.facet_vertices.data() + data.facet_offsets[given],
                                                data.facet_vertices.data() + data.facet_offsets[given + 1]);
      if (!std::equal(expected.begin(), expected.end(), actual.begin(), actual.end()))
        throw Violation{
            fmt::format("facet {} has the extreme points {}, given are {}", given, braces(expected), braces(actual)), {}, {}};
    }
  }
  std::unordered_map<std::string_view, Index> first_at;
  const auto bytes = [&](std::vector<double>& key, Index row) {
    key.assign(examined.sites.point(row), examined.sites.point(row) + examined.sites.ambient);
    for (double& x : key) x += 0.0;  // −0 equals +0
    return std::string_view(reinterpret_cast<const char*>(key.data()), key.size() * sizeof(double));
  };
  std::vector<std::vector<double>> keys(n);
  for (Index row = 0; row < n && !data.point_kinds.empty(); ++row) {
    const bool duplicate = !first_at.emplace(bytes(keys[row], row), row).second;
    PointKind kind = duplicate ? PointKind::duplicate : faces.is_extreme[row] ? PointKind::extreme : PointKind::interior;
    if (hull.dimension == 0 && row == 0) kind = PointKind::extreme;
    for (std::size_t c = 0; kind == PointKind::interior && c < hull.num_cells(); ++c)
      if (examined.side(c, row) == Sign::zero) kind = PointKind::boundary;
    if (kind != data.point_kinds[row]) {
      constexpr const char* names[] = {"extreme", "on the boundary", "in the interior", "a duplicate"};
      throw Violation{fmt::format("point {} is {}, but is said to be {}", row, names[static_cast<int>(kind)],
                                  names[static_cast<int>(data.point_kinds[row]) & 3]),
                      {},
                      {row}};
    }
    const bool listed = std::binary_search(data.vertices.begin(), data.vertices.end(), static_cast<SignedIndex>(row));
    if (listed != (kind == PointKind::extreme))
      throw Violation{fmt::format("point {} is {}in the list of extreme points", row, listed ? "" : "not "), {}, {row}};
  }
}

}  // namespace
}  // namespace front_ends

HullCheckReport check_hull(const HullData& data, HullCheckLevel up_to) {
  using namespace front_ends;
  HullCheckReport report;
  ComplexData boundary;  // cells of k vertices: a complex of dimension k−1
  boundary.dimension = data.dimension;
  boundary.affine_dimension = data.affine_dimension - 1;
  boundary.points = data.points;
  boundary.cells = data.cells;
  boundary.neighbors = data.neighbors;
  boundary.vertex_of_point = data.vertex_of_point;
  std::optional<ExaminedHull> examined;
  const bool has_cells = data.affine_dimension >= 1;
  try {
    for (int level = 1; level <= std::clamp(static_cast<int>(up_to), 1, 5); ++level) {
      report.reached = static_cast<HullCheckLevel>(level);
      if (level == 2) examined.emplace(data, data.points);
      if (level == 3) examined->find_flat();
      switch (report.reached) {
        case HullCheckLevel::storage:
          check_hull_storage(data, boundary);
          break;
        case HullCheckLevel::incidence:
          if (has_cells) check_closed(*examined, boundary);
          break;
        case HullCheckLevel::convexity:
          if (has_cells) report.coplanar_ridges = check_convexity(*examined);
          break;
        case HullCheckLevel::support:
          if (has_cells) check_support(*examined);
          break;
        case HullCheckLevel::completeness:
          check_faces(*examined, data);
          break;
      }
    }
    report.ok = true;
  } catch (Violation& violation) {
    violation.move_to(report);
  }
  return report;
}

}  // namespace delone
