// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_analysis.hpp"

#include "base/infinity.hpp"
#include "base/progress_meter.hpp"
#include "hull/facet_labels.hpp"
#include "hull/scaled_sites.hpp"

#include <algorithm>
#include <utility>

namespace delone::hull {

HullAnalysis::HullAnalysis(const HullState& state, const HullTolerance& tolerance, unsigned threads)
    : state_(state), tolerance_(tolerance), threads_(threads) {
  if (state.boundary() != nullptr) locator_.emplace(state.sites(), *state.boundary());
}

const PolytopeFaces& HullAnalysis::faces() const {
  return faces_.get([&] {
    const SimplicialHull& hull = state_.hull();
    if (tolerance_.scale.tolerance() > 0)
      return label_facets(ScaledSites(state_.sites(), tolerance_.scale).get(), hull,
                          tolerance_.scale.tolerance());
    std::vector<std::pair<Index, Index>> coplanar;
    if (state_.boundary() != nullptr) coplanar = state_.boundary()->coplanar_neighbors(hull);
    return find_faces(hull, state_.sites().size(), coplanar);
  });
}

/// With a tolerance all corners of cells are extreme, whatever facets these are joined to.
std::vector<char> HullAnalysis::are_extreme() const {
  if (tolerance_.scale.tolerance() == 0) return faces().is_extreme;
  std::vector<char> are(state_.sites().size(), 0);
  for (const Index site : state_.hull().cells) are[site] = 1;
  return are;
}

const Lists& HullAnalysis::facet_sites() const {
  return facet_sites_.get([&] { return find_facet_sites(state_.hull(), faces()); });
}

std::size_t HullAnalysis::num_ridges() const {
  return num_ridges_.get([&] { return count_ridges(state_.hull(), faces()); });
}

const std::vector<PointKind>& HullAnalysis::kinds() const {
  return kinds_.get([&] { return find_kinds(); });
}

std::size_t HullAnalysis::count(PointKind kind) const {
  return counts_.get([&] {
    std::array<std::size_t, 4> counts{};
    for (const PointKind each : kinds()) ++counts[static_cast<std::size_t>(each)];
    return counts;
  })[static_cast<std::size_t>(kind)];
}

std::size_t HullAnalysis::num_extreme() const {
  if (!locator_) return state_.sites().size() > 0 ? 1 : 0;
  const std::vector<char> is_extreme = are_extreme();
  return static_cast<std::size_t>(std::count(is_extreme.begin(), is_extreme.end(), 1));
}

const HullMeasures& HullAnalysis::measures() const {
  return measures_.get([&] { return measure_hull(state_.sites(), state_.hull(), threads_); });
}

const HullData& HullAnalysis::data() const {
  return data_.get([&] { return make_data(); });
}

std::vector<PointKind> HullAnalysis::find_kinds() const {
  const BoundarySites& sites = state_.sites();
  const PolytopeFaces& faces = this->faces();
  std::vector<char> is_corner(sites.size(), 0);
  for (const Index site : state_.hull().cells) is_corner[site] = 1;
  // The least box around the hull: what is not strictly inside of it is not in the interior.
  const auto d = static_cast<std::size_t>(sites.ambient);
  std::vector<double> low(d, internal::infinity), high(d, -internal::infinity);
  for (Index site = 0; site < sites.size(); ++site)
    for (std::size_t j = 0; j < d && is_corner[site]; ++j) {
      low[j] = std::min(low[j], sites.point(site)[j]);
      high[j] = std::max(high[j], sites.point(site)[j]);
    }
  const auto is_in_box = [&](Index site) {
    const double* const x = sites.point(site);
    return std::all_of(sites.axes.begin(), sites.axes.end(), [&](int axis) {
      const auto j = static_cast<std::size_t>(axis);
      return low[j] < x[j] && x[j] < high[j];
    });
  };
  const auto kind_of = [&](Index site) {
    internal::cancellation_point();
    if (faces.is_extreme[site]) return PointKind::extreme;
    // Without a boundary there is one vertex; with a tolerance there may be other points within it.
    if (!locator_) return site == state_.basis()[0] ? PointKind::extreme : PointKind::boundary;
    if (is_corner[site]) return PointKind::boundary;
    if (state_.is_surely_interior(site)) return PointKind::interior;
    return is_in_box(site) && locator_->is_in_interior(sites.point(site), sites.grid) ? PointKind::interior
                                                                                      : PointKind::boundary;
  };
  std::vector<PointKind> kinds(state_.num_rows(), PointKind::duplicate);
  for (Index site = 0; site < sites.size(); ++site)
    kinds[static_cast<std::size_t>(state_.row(site))] = kind_of(site);
  const SievedRows& sieved = state_.sieved_rows();
  for (std::size_t i = 0; i < sieved.rows().size(); ++i)
    if (sieved.first_rows()[i] == sieved.rows()[i]) kinds[sieved.rows()[i]] = PointKind::interior;
  return kinds;
}

FacetEquations HullAnalysis::equations(HullMeasures* measures) const {
  const BoundarySites& sites = state_.sites();
  std::vector<const double*> scratch;
  return facet_equations(
      sites, state_.hull(), faces().facet_of_cell, faces().num_facets(),
      [&](std::size_t c) {
        const auto is_inside = [&](Index site) {
          return compiled::side_of_cell(sites, state_.hull(), c, sites.point(site), sites.grid, scratch) ==
                 Sign::positive;
        };
        return sites.point(*std::find_if(state_.basis().begin(), state_.basis().end(), is_inside));
      },
      faces().seeds, measures);
}

std::vector<SignedIndex> HullAnalysis::rows_of(const std::vector<Index>& sites) const {
  std::vector<SignedIndex> rows(sites.size());
  std::transform(sites.begin(), sites.end(), rows.begin(), [&](Index site) { return state_.row(site); });
  return rows;
}

HullCells HullAnalysis::cells() const {
  const SimplicialHull& hull = state_.hull();
  HullCells cells;
  cells.affine_dimension = state_.affine_hull().dimension();
  cells.cells = rows_of(hull.cells);
  cells.neighbors.assign(hull.neighbors.begin(), hull.neighbors.end());
  if (!locator_ && num_extreme() > 0) cells.vertices.push_back(state_.row(state_.basis()[0]));
  const std::vector<char> is_extreme = are_extreme();
  for (Index site = 0; locator_ && site < state_.sites().size(); ++site)
    if (is_extreme[site] != 0) cells.vertices.push_back(state_.row(site));
  std::sort(cells.vertices.begin(), cells.vertices.end());
  return cells;
}

HullData HullAnalysis::make_data() const {
  const BoundarySites& sites = state_.sites();
  const SimplicialHull& hull = state_.hull();
  HullData data;
  data.dimension = sites.ambient;
  data.affine_dimension = state_.affine_hull().dimension();
  data.axes = sites.axes;
  data.tolerance = tolerance_.scale.tolerance();
  data.axis_tolerances = tolerance_.scale.tolerances();
  data.max_distance = tolerance_.max_distance;
  HullCells cells = this->cells();
  data.cells = std::move(cells.cells);
  data.neighbors = std::move(cells.neighbors);
  data.vertices = std::move(cells.vertices);
  data.facet_of_cell.assign(faces().facet_of_cell.begin(), faces().facet_of_cell.end());
  const Lists& facets = facet_sites();
  data.facet_offsets.assign(facets.offsets.begin(), facets.offsets.end());
  data.facet_vertices = rows_of(facets.items);
  const PolytopeRidges ridges = find_ridges(hull, faces(), facets);
  data.ridge_facets.assign(ridges.facets.begin(), ridges.facets.end());
  data.ridge_offsets.assign(ridges.sites.offsets.begin(), ridges.sites.offsets.end());
  data.ridge_vertices = rows_of(ridges.sites.items);
  FacetEquations equations = this->equations();
  data.equations = std::move(equations.equations);
  data.equation_errors = std::move(equations.errors);
  data.point_kinds = kinds();
  data.vertex_of_point.resize(state_.num_rows());
  for (std::size_t row = 0; row < state_.num_rows(); ++row)
    if (const Index site = state_.site_of_row(row); site != invalid_index)
      data.vertex_of_point[row] = state_.row(site);
  const SievedRows& sieved = state_.sieved_rows();
  for (std::size_t i = 0; i < sieved.rows().size(); ++i)
    data.vertex_of_point[sieved.rows()[i]] = static_cast<SignedIndex>(sieved.first_rows()[i]);
  return data;
}

}  // namespace delone::hull
