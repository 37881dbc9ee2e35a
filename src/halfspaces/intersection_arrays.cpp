// SPDX-License-Identifier: BSD-3-Clause
// Duality. Cells of the boundary in one hyperplane merge into a facet (hull/hull_faces.hpp). A facet is dual
// to a vertex of the intersection, or to a direction of it if the hyperplane of the facet contains the row at
// infinity. An extreme site is dual to a facet, and a ridge to an edge.
//
// A site that is not extreme may still touch the intersection. The facets of the boundary that contain it are
// dual to the vertices and directions where its hyperplane touches. So it touches iff one of these facets is
// dual to a vertex.
#include "halfspaces/intersection_arrays.hpp"

#include "base/progress_meter.hpp"
#include "halfspaces/halfspace_cone.hpp"
#include "halfspaces/halfspace_vertex.hpp"
#include "hull/hull_faces.hpp"
#include "hull/hull_measure.hpp"
#include "kernel/hull_stages.hpp"
#include "kernel/rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::halfspaces {
namespace {

class ArrayMaker {
 public:
  explicit ArrayMaker(const IntersectionParts& parts)
      : parts_(parts),
        sites_(parts.sites),
        d_(parts.interior.rounded.size()),
        k_(static_cast<std::size_t>(parts.rank())),
        axes_(sites_.axes.begin(), sites_.axes.begin() + static_cast<std::ptrdiff_t>(k_)) {}

  IntersectionVertices vertices() {
    if (parts_.state != IntersectionState::full) return {};
    data_.vertex_offsets = {0};
    if (parts_.cone) {
      hull_ = parts_.cone->make_hull();
      merge_cells();
      make_vertices();
    }
    return {data_.bounded, std::move(data_.vertices), std::move(data_.vertex_offsets),
            std::move(data_.vertex_halfspaces)};
  }

  IntersectionData make() {
    data_.dimension = static_cast<int>(d_);
    data_.state = parts_.state;
    data_.first_of_halfspace.reserve(parts_.sites.num_rows());
    for (std::size_t r = 0; r < parts_.sites.num_rows(); ++r)
      data_.first_of_halfspace.push_back(parts_.sites.site_of_row(r) == invalid_index
                                             ? static_cast<SignedIndex>(r)
                                             : parts_.row_of_site(parts_.sites.site_of_row(r)));
    data_.witness = parts_.witness;
    if (parts_.state != IntersectionState::full) return std::move(data_);
    data_.rank = parts_.rank();
    data_.interior_point = parts_.interior.rounded;
    data_.interior_point_is_exact = parts_.interior.is_exact();
    data_.axes = axes_;
    std::vector<const double*> basis;
    for (std::size_t i = 1; i < parts_.basis.size(); ++i) basis.push_back(sites_.point(parts_.basis[i]));
    data_.lineality = lineality_basis(basis, axes_, d_);
    kind_of_site_.assign(sites_.size(), HalfspaceKind::redundant);
    data_.vertex_offsets = data_.direction_offsets = data_.facet_offsets =
        data_.facet_direction_offsets = {0};
    if (parts_.cone) {
      hull_ = parts_.cone->make_hull();
      merge_cells();
      classify();
      make_vertices();
      make_edges();
      make_facets();
    }
    make_kinds();
    make_dual();
    return std::move(data_);
  }

 private:
  void merge_cells() {
    faces_ = hull::find_faces(hull_, sites_.size(), parts_.cone->coplanar_neighbors(hull_));
    sites_of_facet_ = hull::find_facet_sites(hull_, faces_);
    const std::size_t num_facets = faces_.num_facets();
    cell_of_facet_.assign(num_facets, 0);
    is_at_infinity_.assign(num_facets, 0);
    for (std::size_t c = hull_.num_cells(); c-- > 0;)
      cell_of_facet_[faces_.facet_of_cell[c]] = static_cast<Index>(c);
    const bool is_corner = std::find(hull_.cells.begin(), hull_.cells.end(), 0) != hull_.cells.end();
    data_.bounded = k_ == d_ && !is_corner && !cell_through(*parts_.cone, hull_, 0);
    if (!data_.bounded)
      for (std::size_t f = 0; f < num_facets; ++f)
        is_at_infinity_[f] = side_of_cell(*parts_.cone, hull_, cell_of_facet_[f], 0) == Sign::zero;
  }

  void classify() {
    for (std::size_t c = 0; c < hull_.num_cells(); ++c)
      for (const Index site : hull_.cell(c))
        if (faces_.is_extreme[site])
          kind_of_site_[site] = HalfspaceKind::facet;
        else if (!is_at_infinity_[faces_.facet_of_cell[c]])
          kind_of_site_[site] = HalfspaceKind::touching;
    std::vector<char> is_corner(sites_.size(), 0);
    for (const Index site : hull_.cells) is_corner[site] = 1;
    for (Index site = 1; site < sites_.size(); ++site) {
      if (is_corner[site]) continue;
      if (const auto cell = cell_through(*parts_.cone, hull_, site); cell && touches(site, *cell))
        kind_of_site_[site] = HalfspaceKind::touching;
    }
  }

  /// The cells whose hyperplanes contain a site are connected: they surround the face that contains the site.
  bool touches(Index site, Index start) const {
    std::vector<Index> seen{start};
    for (std::size_t next = 0; next < seen.size(); ++next) {
      internal::cancellation_point();
      if (!is_at_infinity_[faces_.facet_of_cell[seen[next]]]) return true;
      for (const Index across : hull_.neighbors_of(seen[next]))
        if (std::find(seen.begin(), seen.end(), across) == seen.end() &&
            side_of_cell(*parts_.cone, hull_, across, site) == Sign::zero)
          seen.push_back(across);
    }
    return false;
  }

  /// Makes vertices and directions, and numbers them by facet of the boundary.
  void make_vertices() {
    const std::size_t num_facets = faces_.num_facets();
    number_.resize(num_facets);
    std::vector<const double*> rows, rows_of_vertices;
    for (std::size_t f = 0; f < num_facets; ++f) {
      internal::cancellation_point();
      auto& offsets = is_at_infinity_[f] ? data_.direction_offsets : data_.vertex_offsets;
      auto& halfspaces = is_at_infinity_[f] ? data_.direction_halfspaces : data_.vertex_halfspaces;
      number_[f] = static_cast<SignedIndex>(offsets.size()) - 1;
      const std::size_t first = halfspaces.size();
      for (const Index site : sites_of_facet_[f])
        if (site != 0) halfspaces.push_back(parts_.row_of_site(site));
      std::sort(halfspaces.begin() + static_cast<std::ptrdiff_t>(first), halfspaces.end());
      offsets.push_back(static_cast<SignedIndex>(halfspaces.size()));
      rows.clear();
      for (const Index site : hull_.cell(cell_of_facet_[f])) rows.push_back(sites_.point(site));
      if (!is_at_infinity_[f]) {
        rows_of_vertices.insert(rows_of_vertices.end(), rows.begin(), rows.end());
        continue;
      }
      // det(rows, q) is positive for q inside, where q·z must be negative.
      std::vector<kernel::Integer> z = cone_normal(rows, sites_.axes);
      z.pop_back();
      const bool keep = hull_.dimension == 1 && cell_of_facet_[f] == 1;
      for (kernel::Integer& entry : z)
        if (!keep) entry = -entry;
      const std::vector<double> direction = unit_vector(z, axes_, d_);
      data_.directions.insert(data_.directions.end(), direction.begin(), direction.end());
    }
    std::vector<double> points = meeting_points(rows_of_vertices, sites_.axes);
    if (k_ == d_) {
      data_.vertices = std::move(points);
      return;
    }
    data_.vertices.assign(points.size() / k_ * d_, 0.0);
    for (std::size_t i = 0; i < points.size(); ++i)
      data_.vertices[i / k_ * d_ + static_cast<std::size_t>(axes_[i % k_])] = points[i];
  }

  void make_edges() {
    const std::vector<Index> neighbors = hull::neighboring_facets(hull_, faces_);
    for (std::size_t r = 0; r < neighbors.size(); r += 2) {
      Index a = neighbors[r], b = neighbors[r + 1];
      if (is_at_infinity_[a] && is_at_infinity_[b]) continue;
      if (is_at_infinity_[a]) std::swap(a, b);
      std::vector<SignedIndex>& list = is_at_infinity_[b] ? data_.rays : data_.edges;
      list.push_back(number_[a]);
      list.push_back(number_[b]);
    }
    // For k = 1 the boundary has no ridges, but an edge joins its two ends.
    if (k_ == 1) {
      const bool first = is_at_infinity_[0], second = is_at_infinity_[1];
      if (first != second) data_.rays = {0, 0};
      if (!first && !second) data_.edges = {0, 1};
    }
  }

  void make_facets() {
    std::vector<std::pair<SignedIndex, Index>> order;  // row, site
    for (Index site = 1; site < sites_.size(); ++site)
      if (faces_.is_extreme[site]) order.emplace_back(parts_.row_of_site(site), site);
    std::sort(order.begin(), order.end());
    const hull::Lists around =
        k_ == 3 ? hull::Lists{} : hull::lists_with_each(sites_of_facet_, sites_.size());
    std::vector<Index> cell_with(sites_.size(), invalid_index);
    for (std::size_t c = 0; c < hull_.num_cells(); ++c)
      for (const Index site : hull_.cell(c)) cell_with[site] = static_cast<Index>(c);
    for (const auto& [row, site] : order) {
      internal::cancellation_point();
      data_.facet_halfspaces.push_back(row);
      for (const Index f : k_ == 3 ? in_cycle(site, cell_with[site]) : around[site])
        (is_at_infinity_[f] ? data_.facet_directions : data_.facet_vertices).push_back(number_[f]);
      data_.facet_offsets.push_back(static_cast<SignedIndex>(data_.facet_vertices.size()));
      data_.facet_direction_offsets.push_back(static_cast<SignedIndex>(data_.facet_directions.size()));
    }
  }

  /// For k = 3, the facets of the boundary around a site in cyclic order, those at infinity last. Valid until
  /// the next call.
  std::span<const Index> in_cycle(Index site, Index start) {
    std::vector<Index>& cycle = cycle_;
    cycle.clear();
    Index c = start;
    do {
      const auto cell = hull_.cell(c);
      const auto slot = static_cast<std::size_t>(std::find(cell.begin(), cell.end(), site) - cell.begin());
      if (const Index f = faces_.facet_of_cell[c]; cycle.empty() || cycle.back() != f) cycle.push_back(f);
      c = hull_.neighbors_of(c)[(slot + 2) % 3];
    } while (c != start);
    if (cycle.size() > 1 && cycle.back() == cycle.front()) cycle.pop_back();
    // Faces are convex, so the facets at infinity are consecutive.
    const auto after_infinity = [&] {
      for (std::size_t i = 0; i < cycle.size(); ++i)
        if (is_at_infinity_[cycle[i]] && !is_at_infinity_[cycle[(i + 1) % cycle.size()]]) return i + 1;
      return static_cast<std::size_t>(0);
    }();
    std::rotate(cycle.begin(), cycle.begin() + static_cast<std::ptrdiff_t>(after_infinity % cycle.size()),
                cycle.end());
    return cycle;
  }

  void make_kinds() {
    data_.kinds.reserve(parts_.sites.num_rows());
    for (std::size_t r = 0; r < parts_.sites.num_rows(); ++r) {
      const Index site = parts_.sites.site_of_row(r);
      data_.kinds.push_back(site == invalid_index ? HalfspaceKind::trivial
                            : parts_.row_of_site(site) != static_cast<SignedIndex>(r)
                                ? HalfspaceKind::duplicate
                                : kind_of_site_[site]);
    }
  }

  void make_dual() {
    std::vector<int> all(d_);
    for (std::size_t j = 0; j < d_; ++j) all[j] = static_cast<int>(j);
    std::vector<double> dual(2 * d_), normal(d_);
    data_.dual_points.resize(parts_.sites.num_rows() * d_);
    data_.dual_equations.reserve(data_.num_vertices() * (d_ + 1));
    for (std::size_t r = 0; r < parts_.sites.num_rows(); ++r) {
      internal::cancellation_point();
      const Index site = parts_.sites.site_of_row(r);
      if (site == invalid_index) continue;
      double* const leading = data_.dual_points.data() + r * d_;
      if (k_ == d_) {
        std::copy_n(sites_.dual(site), d_, leading);
      } else {
        dual_point(sites_.point(site), parts_.interior, all, dual.data());
        std::copy_n(dual.begin(), d_, leading);
      }
    }
    std::vector<char> is_axis(d_, 0);
    for (const int axis : axes_) is_axis[static_cast<std::size_t>(axis)] = 1;
    // The dual points y of the rows through a vertex v satisfy y·(v − p) = 1.
    for (std::size_t v = 0; v < data_.num_vertices(); ++v) {
      double largest = 0, square = 0;
      for (std::size_t j = 0; j < d_; ++j) {
        normal[j] = is_axis[j] != 0 ? data_.vertex(v)[j] - data_.interior_point[j] : 0;
        largest = std::max(largest, std::abs(normal[j]));
      }
      for (const double x : normal) square += (x / largest) * (x / largest);
      const double length = std::sqrt(square);
      for (const double x : normal) data_.dual_equations.push_back(x / largest / length);
      data_.dual_equations.push_back(-1 / largest / length);
    }
  }

  const IntersectionParts& parts_;
  const sites::BoundarySites& sites_;
  std::size_t d_, k_;
  std::vector<int> axes_;
  SimplicialHull hull_;
  hull::PolytopeFaces faces_;
  hull::Lists sites_of_facet_;
  std::vector<Index> cell_of_facet_, cycle_;
  std::vector<char> is_at_infinity_;
  std::vector<SignedIndex> number_;
  std::vector<HalfspaceKind> kind_of_site_;
  IntersectionData data_;
};

}  // namespace

IntersectionParts::IntersectionParts(std::size_t d)
    : sites(static_cast<int>(d) + 1, kernel::RowForm::homogeneous) {
  std::vector<double> row_at_infinity(d + 1, 0.0);
  row_at_infinity[d] = -1;
  sites.add_site(row_at_infinity.data());
  interior.rounded.assign(d, 0.0);
}

IntersectionParts::IntersectionParts(const IntersectionParts& other)
    : sites(other.sites),
      redundant(other.redundant),
      basis(other.basis),
      interior(other.interior),
      state(other.state),
      witness(other.witness) {
  if (other.cone) cone.emplace(sites, *other.cone);
}

void IntersectionParts::add_rows(std::span<const double> rows, const std::vector<Index>& having_normal) {
  const auto first = static_cast<Index>(sites.size());
  sites.add_rows(rows, &having_normal);
  add_duals(first);
}

void IntersectionParts::give_redundant_rows_sites(std::span<const double> rows) {
  if (redundant.empty()) return;
  const std::size_t d = interior.rounded.size(), k = static_cast<std::size_t>(rank());
  std::vector<double> given, duals(redundant.size() * 2 * k);
  given.reserve(redundant.size() * (d + 1));
  for (const Index row : redundant) {
    const auto entries = rows.subspan(row * (d + 1), d + 1);
    given.insert(given.end(), entries.begin(), entries.end());
  }
  dual_points(given.data(), redundant.size(), interior, std::span(sites.axes).first(k), duals.data());
  const auto first = static_cast<Index>(sites.size());
  cone->reserve(first + redundant.size());
  sites.duals.reserve((first + redundant.size()) * 2 * k);
  sites.give_sites(redundant, [&](Index row) { return &rows[row * (d + 1)]; });
  // The sites are in the boundary's box. If it throws below, they are not known to be interior, which is no
  // error.
  std::size_t at = 0;
  for (auto site = first; site < sites.size(); ++site) {
    while (redundant[at] != sites.row_of_site(site)) ++at;
    const auto dual = duals.begin() + static_cast<std::ptrdiff_t>(at * 2 * k);
    sites.duals.insert(sites.duals.end(), dual, dual + static_cast<std::ptrdiff_t>(2 * k));
  }
  redundant.clear();
  cone->include_sites(first);
  for (auto site = first; site < sites.size(); ++site) cone->leave_out(site);
}

void IntersectionParts::add_duals(Index first) {
  if (sites.axes.empty()) return;
  const auto k = static_cast<std::size_t>(rank());
  sites.duals.resize(sites.size() * 2 * k, 0.0);
  first = std::max(first, Index{1});
  if (first < sites.size())
    dual_points(sites.point(first), sites.size() - first, interior, std::span(sites.axes).first(k),
                sites.duals.data() + first * 2 * k);
}

bool is_strictly_inside(const double* row, const InteriorPoint& p) {
  const std::size_t d = p.rounded.size();
  if (p.is_exact()) {
    internal::StageCounts uncounted;
    return kernel::side_of_hyperplane(row, p.rounded.data(), static_cast<int>(d), uncounted) ==
           Sign::negative;
  }
  const std::vector<kernel::Integer> integers = integer_row(row, d + 1);
  kernel::Integer sum = integers[d] * p.denominator;
  for (std::size_t j = 0; j < d; ++j) sum += integers[j] * p.numerators[j];
  return sum < 0;
}

IntersectionData intersection_arrays(const IntersectionParts& parts) { return ArrayMaker(parts).make(); }

IntersectionVertices intersection_vertices(const IntersectionParts& parts) {
  return ArrayMaker(parts).vertices();
}

Measure dual_measure(const IntersectionParts& parts, bool volume) {
  const auto d = parts.interior.rounded.size();
  if (!parts.cone || static_cast<std::size_t>(parts.rank()) != d)
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  const SimplicialHull hull = parts.cone->make_hull();
  if (d == 1 && !volume) return {2, 0};
  hull::MeasureSum sum;
  std::vector<const double*> simplex;
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    internal::cancellation_point();
    const auto cell = hull.cell(c);
    simplex.clear();
    if (volume) {
      if (std::find(cell.begin(), cell.end(), hull.cells[0]) != cell.end()) continue;
      simplex.push_back(parts.sites.dual(hull.cells[0]));
    }
    for (const Index site : cell) simplex.push_back(parts.sites.dual(site));
    sum.add(hull::simplex_volume(simplex, static_cast<int>(d)));
  }
  return sum.result();
}

}  // namespace delone::halfspaces
