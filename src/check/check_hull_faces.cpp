// SPDX-License-Identifier: BSD-3-Clause
// Level 5 of check() of a hull: what is derived from a boundary that levels 1–4 have proved is derived again
// and compared.
#include "base/progress_meter.hpp"
#include "check/check_hull.hpp"
#include "hull/facet_labels.hpp"
#include "hull/hull_faces.hpp"
#include "hull/scaled_sites.hpp"

#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

namespace delone::internal {

using sites::BoundarySites;

namespace {

hull::PolytopeFaces faces_of(ExaminedHull& examined, const HullData& data) {
  const SimplicialHull& hull = examined.hull;
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t c = 0; hull.dimension > 1 && c < hull.num_cells(); ++c)
    for (std::size_t i = 0; i < hull.corners(); ++i)
      if (const Index across = hull.neighbors_of(c)[i];
          across > c && examined.side(c, apex_across(hull, c, i)) == Sign::zero)
        pairs.emplace_back(static_cast<Index>(c), across);
  hull::PolytopeFaces exact = hull::find_faces(hull, examined.sites.size(), pairs);
  if (!examined.is_tolerant()) return exact;
  hull::PolytopeFaces labels =
      hull::label_facets(hull::ScaledSites(examined.sites, examined.scale).get(), hull, data.tolerance);
  labels.is_extreme = std::move(exact.is_extreme);  // of all corners, if the cells are sound
  return labels;
}

std::vector<SignedIndex> signed_copy(std::span<const Index> items) { return {items.begin(), items.end()}; }

/// One list of a file.
std::span<const SignedIndex> list(const std::vector<SignedIndex>& items,
                                  const std::vector<SignedIndex>& offsets, std::size_t i) {
  return std::span(items).subspan(static_cast<std::size_t>(offsets[i]),
                                  static_cast<std::size_t>(offsets[i + 1] - offsets[i]));
}

/// The numbers that the file gives to our facets.
std::vector<SignedIndex> check_facets(const SimplicialHull& hull, const hull::PolytopeFaces& faces,
                                      const hull::Lists& facet_sites, const HullData& data) {
  if (faces.num_facets() != data.num_facets())
    throw Violation{
        fmt::format("{} facets are given, the cells make {}", data.num_facets(), faces.num_facets())};
  std::vector<SignedIndex> given_of(faces.num_facets(), -1);
  std::vector<SignedIndex> first_cell(faces.num_facets(), -1);  // by the file's number
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    cancellation_point();
    SignedIndex& given = given_of[faces.facet_of_cell[c]];
    if (given < 0) {
      given = data.facet_of_cell[c];
      if (SignedIndex& first = first_cell[static_cast<std::size_t>(given)];
          std::exchange(first, static_cast<SignedIndex>(c)) >= 0)
        throw Violation{
            fmt::format("cell {} is part of facet {}, but lies in another hyperplane than its other cells", c,
                        given),
            {c}};
    }
    if (given != data.facet_of_cell[c])
      throw Violation{fmt::format("cell {} is part of facet {}, but lies in the hyperplane of facet {}", c,
                                  data.facet_of_cell[c], given),
                      {c}};
  }
  for (std::size_t f = 0; f < faces.num_facets(); ++f) {
    const auto given = static_cast<std::size_t>(given_of[f]);
    const std::vector<SignedIndex> expected = signed_copy(facet_sites[f]);
    const auto actual = list(data.facet_vertices, data.facet_offsets, given);
    if (!std::equal(expected.begin(), expected.end(), actual.begin(), actual.end()))
      throw Violation{fmt::format("facet {} has the extreme points {}, given are {}", given, braces(expected),
                                  braces(actual))};
  }
  return given_of;
}

void check_ridges(const SimplicialHull& hull, const hull::PolytopeFaces& faces,
                  const hull::Lists& facet_sites, const std::vector<SignedIndex>& given_of,
                  const HullData& data) {
  using Facets = std::pair<SignedIndex, SignedIndex>;
  const hull::PolytopeRidges ridges = hull::find_ridges(hull, faces, facet_sites);
  if (ridges.sites.size() != data.num_ridges())
    throw Violation{
        fmt::format("{} ridges are given, the facets make {}", data.num_ridges(), ridges.sites.size())};
  std::map<Facets, std::size_t> given_ridge;
  for (std::size_t r = 0; r < data.num_ridges(); ++r) {
    const SignedIndex a = data.ridge_facets[2 * r], b = data.ridge_facets[2 * r + 1];
    if (!given_ridge.emplace(std::minmax(a, b), r).second)
      throw Violation{fmt::format("ridge {} is between the facets {} and {}, as an earlier one is", r, a, b)};
  }
  for (std::size_t r = 0; r < ridges.sites.size(); ++r) {
    const SignedIndex a = given_of[ridges.facets[2 * r]], b = given_of[ridges.facets[2 * r + 1]];
    const auto found = given_ridge.find(std::minmax(a, b));
    if (found == given_ridge.end())
      throw Violation{fmt::format("the facets {} and {} meet in a ridge, which is not given", a, b)};
    const std::vector<SignedIndex> expected = signed_copy(ridges.sites[r]);
    const auto actual = list(data.ridge_vertices, data.ridge_offsets, found->second);
    if (!std::equal(expected.begin(), expected.end(), actual.begin(), actual.end()))
      throw Violation{fmt::format("ridge {} has the extreme points {}, given are {}", found->second,
                                  braces(expected), braces(actual))};
  }
}

/// The promise of `equation_errors` at the extreme points, where the difference of two affine functions is
/// greatest: with m within e of a normal of the hyperplane, the distance of x from it is m·t/|m| up to
/// |t|·2e/|m|, t = x − a point of it. Only what is certainly broken is a violation. Nothing is promised in
/// flats, nor where binary64 knows no normal.
void check_equations(ExaminedHull& examined, const hull::PolytopeFaces& faces,
                     const std::vector<SignedIndex>& given_of, const HullData& data) {
  const BoundarySites& sites = examined.sites;
  const auto d = static_cast<std::size_t>(sites.ambient);
  if (data.equations.empty() || data.equation_errors.empty() || examined.hull.corners() != d) return;
  const std::size_t stride = examined.normals->stride();
  const double gamma = 1.01 * (static_cast<double>(d) + 8) * kernel::unit_roundoff;
  for (std::size_t f = 0; f < faces.num_facets(); ++f) {
    const auto given = static_cast<std::size_t>(given_of[f]);
    const double error = data.equation_errors[given], *equation = data.equations.data() + given * (d + 1);
    if (!(error >= 0)) throw Violation{fmt::format("the error of equation {} is {}", given, error)};
    const std::size_t c = faces.seeds.empty() ? faces.cells_of_facet[f][0] : faces.seeds[f];
    const double *normal = examined.records.data() + c * stride,
                 *base = sites.point(examined.hull.cell(c)[0]);
    double length = 0;
    for (std::size_t j = 0; j < d; ++j) length += normal[j] * normal[j];
    length = std::sqrt(length);
    for (Index row = 0; row < sites.size(); ++row) {
      if (!faces.is_extreme[row]) continue;
      const double* x = sites.point(row);
      double value = equation[d], magnitude = std::fabs(value), distance = 0, distance_magnitude = 0,
             reach = 0;
      for (std::size_t j = 0; j < d; ++j) {
        const auto axis = static_cast<std::size_t>(sites.axes[j]);
        value += equation[j] * x[j];
        magnitude += std::fabs(equation[j] * x[j]);
        const double t = x[axis] - base[axis];
        distance += normal[j] * t;
        distance_magnitude += std::fabs(normal[j] * t);
        reach += std::fabs(t);
      }
      const double uncertain = gamma * magnitude +
                               (2.02 * normal[d] * reach + gamma * distance_magnitude) / length +
                               kernel::underflow_allowance;
      if (std::fabs(value - distance / length) - uncertain > error)
        throw Violation{fmt::format("the equation of facet {} gives {} for point {}, whose distance is {}; "
                                    "the error is said to be {}",
                                    given, value, row, distance / length, error),
                        {},
                        {row}};
    }
  }
}

/// By row, the first row with the same point.
std::vector<SignedIndex> first_rows(const BoundarySites& sites) {
  std::unordered_map<std::string_view, SignedIndex> first_at;
  std::vector<double> keys(sites.coordinates);
  for (double& x : keys) x += 0.0;  // −0 equals +0
  const std::size_t size = static_cast<std::size_t>(sites.ambient) * sizeof(double);
  std::vector<SignedIndex> first;
  for (std::size_t row = 0; row < sites.size(); ++row) {
    cancellation_point();
    const std::string_view key(reinterpret_cast<const char*>(keys.data()) + row * size, size);
    first.push_back(first_at.emplace(key, static_cast<SignedIndex>(row)).first->second);
  }
  return first;
}

void check_points(ExaminedHull& examined, const hull::PolytopeFaces& faces, const HullData& data) {
  const SimplicialHull& hull = examined.hull;
  const std::vector<SignedIndex> first = first_rows(examined.sites);
  const std::vector<Index> vertices = examined.vertices();
  const Index only_vertex = hull.dimension == 0 ? (vertices.empty() ? 0 : vertices[0]) : invalid_index;
  std::vector<char> listed(first.size(), 0);
  for (const SignedIndex row : data.vertices)
    if (std::exchange(listed[static_cast<std::size_t>(row)], 1) != 0)
      throw Violation{fmt::format("point {} is twice in the list of extreme points", row),
                      {},
                      {static_cast<std::size_t>(row)}};
  for (Index row = 0; row < first.size(); ++row) {
    if (!data.vertex_of_point.empty() && data.vertex_of_point[row] != first[row])
      throw Violation{fmt::format("point {} is first in row {}, but vertex_of_point says {}", row, first[row],
                                  data.vertex_of_point[row]),
                      {},
                      {row}};
    PointKind kind = first[row] != static_cast<SignedIndex>(row)   ? PointKind::duplicate
                     : faces.is_extreme[row] || row == only_vertex ? PointKind::extreme
                     : hull.dimension == 0                         ? PointKind::boundary
                                                                   : PointKind::interior;
    if (!data.vertices.empty() && (listed[row] != 0) != (kind == PointKind::extreme))
      throw Violation{
          fmt::format("point {} is {}in the list of extreme points", row, listed[row] ? "" : "not "),
          {},
          {row}};
    if (data.point_kinds.empty()) continue;
    for (std::size_t c = 0; kind == PointKind::interior && c < hull.num_cells(); ++c)
      if (examined.side(c, row) != Sign::positive) kind = PointKind::boundary;
    if (kind != data.point_kinds[row]) {
      constexpr const char* names[] = {"extreme", "on the boundary", "in the interior", "a duplicate"};
      throw Violation{fmt::format("point {} is {}, but is said to be {}", row, names[static_cast<int>(kind)],
                                  names[static_cast<int>(data.point_kinds[row]) & 3]),
                      {},
                      {row}};
    }
  }
}

}  // namespace

void check_hull_faces(ExaminedHull& examined, const HullData& data) {
  const hull::PolytopeFaces faces = faces_of(examined, data);
  if (!data.facet_of_cell.empty()) {
    const hull::Lists facet_sites = hull::find_facet_sites(examined.hull, faces);
    const std::vector<SignedIndex> given_of = check_facets(examined.hull, faces, facet_sites, data);
    if (!data.ridge_offsets.empty()) check_ridges(examined.hull, faces, facet_sites, given_of, data);
    check_equations(examined, faces, given_of, data);
  }
  check_points(examined, faces, data);
}

}  // namespace delone::internal
