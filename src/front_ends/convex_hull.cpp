// SPDX-License-Identifier: BSD-3-Clause
// Polytope: rows to distinct sites, affine dimensions, and the arrays that describe the faces; the builder makes the boundary.
#include "front_ends/canonical_hash.hpp"
#include "front_ends/convex_hull_builder.hpp"
#include "front_ends/convex_hull_faces.hpp"
#include "front_ends/convex_hull_locator.hpp"
#include "front_ends/convex_hull_measure.hpp"
#include "front_ends/progress_meter.hpp"
#include "kernel/predicates.hpp"
#include "order/insertion_order.hpp"

#include <delone/convex_hull.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <new>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

namespace delone {
namespace {

using front_ends::ConvexHullBuilder;
using front_ends::HullLocator;
using front_ends::HullSites;
using front_ends::Lists;
using front_ends::PolytopeFaces;
using front_ends::SimplicialHull;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void check_finite(std::span<const double> coordinates, std::size_t ambient) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    if (!std::isfinite(coordinates[i]) && (rows.empty() || rows.back() != i / ambient)) rows.push_back(i / ambient);
  if (rows.empty()) return;
  throw Error(Errc::not_finite,
              "a coordinate of point " + std::to_string(rows.front()) + " is not finite" +
                  (rows.size() > 1 ? " (and of " + std::to_string(rows.size() - 1) + " more points)" : ""),
              rows);
}

/// What insertions change. A batch works on a copy, so that it is done whole or not at all.
struct State {
  explicit State(int dimension) : sites(dimension), affine_hull(dimension) {}
  State(const State& other)
      : sites(other.sites),
        affine_hull(other.affine_hull),
        basis(other.basis),
        row_of_site(other.row_of_site),
        site_of_row(other.site_of_row),
        site_at(other.site_at),
        earlier(other.earlier),
        order_seconds(other.order_seconds),
        build_seconds(other.build_seconds) {
    if (other.builder) builder.emplace(sites, *other.builder);
  }
  State& operator=(const State&) = delete;

  /// The site of a point, new or not: (site, is new). A new one is not yet part of the boundary.
  std::pair<Index, bool> add_site(const double* point, std::size_t row) {
    const auto ambient = static_cast<std::size_t>(sites.ambient);
    const std::uint64_t tag = front_ends::point_tag(point, sites.ambient).low;
    const auto [first, last] = site_at.equal_range(tag);
    for (auto at = first; at != last; ++at)
      if (kernel::equal_points(sites.point(at->second), point, sites.ambient)) return {at->second, false};
    const auto site = static_cast<Index>(sites.size());
    row_of_site.push_back(static_cast<Index>(row));
    sites.coordinates.insert(sites.coordinates.end(), point, point + ambient);
    sites.grid.include(point);
    site_at.emplace(tag, site);
    return {site, true};
  }

  /// Lets a site raise the affine dimension; true if it did.
  bool raise(Index site) {
    if (affine_hull.dimension() == sites.ambient || !affine_hull.add(sites.point(site))) return false;
    basis.push_back(site);
    return true;
  }

  /// Starts anew with the simplex of the basis.
  void restart() {
    sites.axes = affine_hull.axes();
    if (builder) {
      earlier.created_cells += builder->effort().created_cells;
      earlier.stages.filter += builder->effort().stages.filter;
      earlier.stages.direct += builder->effort().stages.direct;
      earlier.stages.exact += builder->effort().stages.exact;
      earlier.stages.perturbed += builder->effort().stages.perturbed;
    }
    builder.reset();
    if (affine_hull.dimension() >= 1) builder.emplace(sites, basis);
  }

  struct Effort {
    std::uint64_t created_cells = 0;
    StageCounts stages;
  };

  HullSites sites;
  kernel::AffineHull affine_hull;
  std::vector<Index> basis;        // sites that span the flat
  std::vector<Index> row_of_site;  // the first row at each site; increasing
  std::vector<Index> site_of_row;
  std::unordered_multimap<std::uint64_t, Index> site_at;
  std::optional<ConvexHullBuilder> builder;  // none while the affine dimension is below 1
  Effort earlier;                            // of builders that were given up
  double order_seconds = 0, build_seconds = 0;
};

/// What is derived from the boundary.
struct Analysis {
  HullData data;
  PolytopeFaces faces;
  std::optional<HullLocator> locator;
};

const SimplicialHull no_cells{};

}  // namespace

struct Polytope::Impl {
  Impl(int d, Options given) : dimension(d), options(std::move(given)), state(std::make_unique<State>(d)) {}

  int dimension;
  Options options;
  std::unique_ptr<State> state;
  mutable std::mutex mutex;
  mutable std::unique_ptr<const Analysis> analysis;

  std::size_t ambient() const { return static_cast<std::size_t>(dimension); }
  int affine_dimension() const { return state->affine_hull.dimension(); }
  const SimplicialHull& hull() const { return state->builder ? state->builder->hull() : no_cells; }
  SignedIndex row(Index site) const { return static_cast<SignedIndex>(state->row_of_site[site]); }

  void insert_range(std::span<const double> coordinates) {
    if (coordinates.size() % ambient() != 0)
      throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
    check_finite(coordinates, ambient());
    const std::size_t n = coordinates.size() / ambient(), first_row = state->site_of_row.size();
    if (n == 0) return;
    if (n > max_index - first_row) throw Error(Errc::too_many, "more points than this build has ids");
    auto next = std::make_unique<State>(*state);

    auto start = Clock::now();
    const auto first_site = static_cast<Index>(next->sites.size());
    for (std::size_t i = 0; i < n; ++i)
      next->site_of_row.push_back(next->add_site(coordinates.data() + i * ambient(), first_row + i).first);
    std::vector<Index> order =
        insertion_order({std::span<const double>(next->sites.coordinates).subspan(first_site * ambient()), dimension});
    for (Index& site : order) site += first_site;
    next->order_seconds += seconds_since(start);

    start = Clock::now();
    bool raised = false;
    for (const Index site : order) raised |= next->raise(site);
    if (raised) {
      // Sites of earlier calls are inserted again.
      next->restart();
      std::vector<Index> all(first_site);
      std::iota(all.begin(), all.end(), Index{0});
      order.insert(order.begin(), all.begin(), all.end());
      for (const Index site : next->basis) order.erase(std::find(order.begin(), order.end(), site));
    }
    front_ends::ProgressMeter progress(options.progress, order.size());
    for (std::size_t i = 0; next->builder && i < order.size(); ++i) {
      next->builder->insert(order[i]);
      progress(i + 1);
    }
    next->build_seconds += seconds_since(start);
    state = std::move(next);
    analysis.reset();
  }

  HullInsertResult insert(std::span<const double> point) {
    if (point.size() != ambient()) throw Error(Errc::bad_dimension, "the point has not as many coordinates as the space");
    check_finite(point, ambient());
    HullInsertResult result;
    result.row = state->site_of_row.size();
    if (result.row >= max_index) throw Error(Errc::too_many, "more points than this build has ids");
    const std::uint64_t tag = front_ends::point_tag(point.data(), dimension).low;
    const auto [first, last] = state->site_at.equal_range(tag);
    for (auto at = first; at != last; ++at)
      if (kernel::equal_points(state->sites.point(at->second), point.data(), dimension)) {
        state->site_of_row.push_back(at->second);
        result.duplicate = true;
        // Only the new row's entries change, but they are part of the arrays.
        analysis.reset();
        return result;
      }
    if (affine_dimension() < dimension && !state->affine_hull.contains(point.data())) {
      insert_range(point);
      result.inserted = true;
      return result;
    }
    state->site_of_row.reserve(result.row + 1);
    const auto site = static_cast<Index>(state->sites.size());
    try {
      state->add_site(point.data(), result.row);
      result.inserted = state->builder->insert(site);
    } catch (...) {
      drop_last_site(site, tag);
      throw;
    }
    state->site_of_row.push_back(site);
    analysis.reset();
    return result;
  }

  void drop_last_site(Index site, std::uint64_t tag) {
    state->row_of_site.resize(site);
    state->sites.coordinates.resize(site * ambient());
    const auto [first, last] = state->site_at.equal_range(tag);
    for (auto at = first; at != last; ++at)
      if (at->second == site) {
        state->site_at.erase(at);
        break;
      }
  }

  std::vector<Index> insertion_order(PointsView view) const {
    switch (options.order) {
      case InsertionOrder::shuffled:
        return order::shuffled_order(view.size(), options.seed);
      case InsertionOrder::as_given: {
        std::vector<Index> sites(view.size());
        std::iota(sites.begin(), sites.end(), Index{0});
        return sites;
      }
      case InsertionOrder::automatic:
        break;
    }
    return order::brio_order(view, options.seed);
  }

  const Analysis& analyse() const {
    const std::lock_guard lock(mutex);
    if (!analysis) {
      try {
        analysis = make_analysis();
      } catch (const std::bad_alloc&) {
        throw Error(Errc::out_of_memory, "not enough memory for the faces of the hull");
      }
    }
    return *analysis;
  }

  std::unique_ptr<const Analysis> make_analysis() const {
    auto result = std::make_unique<Analysis>();
    const SimplicialHull& hull = this->hull();
    const HullSites& sites = state->sites;
    if (hull.num_cells() > 0) result->locator.emplace(sites, hull);
    std::vector<const double*> scratch;
    result->faces = front_ends::find_faces(hull, sites.size(), [&](std::size_t c, std::size_t i) {
      const std::size_t across = hull.neighbors_of(c)[i];
      const auto neighbors = hull.neighbors_of(across);
      for (std::size_t j = 0; j < neighbors.size(); ++j)
        if (neighbors[j] == c) {
          const Index opposite = hull.cell(across)[j];
          const auto cell = hull.cell(c);
          if (std::find(cell.begin(), cell.end(), opposite) == cell.end())
            return result->locator->side(c, sites.point(opposite), sites.grid, scratch) == Sign::zero;
        }
      return false;
    });
    fill(result->data, result->faces, hull, result->locator);
    return result;
  }

  void fill(HullData& data, const PolytopeFaces& faces, const SimplicialHull& hull,
            const std::optional<HullLocator>& locator) const {
    const HullSites& sites = state->sites;
    data.dimension = dimension;
    data.affine_dimension = affine_dimension();
    for (const Index site : hull.cells) data.cells.push_back(row(site));
    data.neighbors.assign(hull.neighbors.begin(), hull.neighbors.end());
    data.facet_of_cell.assign(faces.facet_of_cell.begin(), faces.facet_of_cell.end());
    const auto copy = [&](const Lists& lists, std::vector<SignedIndex>& offsets, std::vector<SignedIndex>& items) {
      offsets.assign(lists.offsets.begin(), lists.offsets.end());
      for (const Index site : lists.items) items.push_back(row(site));
    };
    copy(faces.facets, data.facet_offsets, data.facet_vertices);
    copy(faces.ridges, data.ridge_offsets, data.ridge_vertices);
    data.ridge_facets.assign(faces.facets_of_ridge.begin(), faces.facets_of_ridge.end());
    fill_equations(data, hull, locator);

    std::vector<PointKind> kinds(sites.size(), PointKind::interior);
    std::vector<char> is_corner(sites.size(), 0);
    for (const Index site : hull.cells) is_corner[site] = 1;
    for (Index site = 0; site < sites.size(); ++site) {
      if (affine_dimension() == 0 || faces.is_extreme[site])
        kinds[site] = PointKind::extreme;
      else if (is_corner[site] || locator->locate(sites.point(site), sites.grid).side == Sign::zero)
        kinds[site] = PointKind::boundary;
      if (kinds[site] == PointKind::extreme) data.vertices.push_back(row(site));
    }
    for (std::size_t r = 0; r < state->site_of_row.size(); ++r) {
      const Index site = state->site_of_row[r];
      data.vertex_of_point.push_back(row(site));
      data.point_kinds.push_back(state->row_of_site[site] == r ? kinds[site] : PointKind::duplicate);
    }
  }

  void fill_equations(HullData& data, const SimplicialHull& hull, const std::optional<HullLocator>& locator) const {
    const HullSites& sites = state->sites;
    double square = 0;  // of the diagonal of the box of all points
    for (std::size_t j = 0; j < ambient(); ++j) {
      double low = 0, high = 0;
      for (Index site = 0; site < sites.size(); ++site) {
        low = site == 0 ? sites.point(site)[j] : std::min(low, sites.point(site)[j]);
        high = site == 0 ? sites.point(site)[j] : std::max(high, sites.point(site)[j]);
      }
      square += (high - low) * (high - low);
    }
    const std::size_t f = data.num_facets();
    const double extent = 1.01 * std::sqrt(square) + 1e-150;  // squares may underflow
    data.equations.resize(f * (ambient() + 1));
    data.equation_errors.assign(f, -1);
    std::vector<double> equation(ambient() + 1);
    std::vector<const double*> scratch;
    for (std::size_t c = 0; c < hull.num_cells(); ++c) {
      std::size_t inner = 0;
      while (locator->side(c, sites.point(state->basis[inner]), sites.grid, scratch) != Sign::positive) ++inner;
      const double error =
          front_ends::facet_equation(sites, hull, c, sites.point(state->basis[inner]), extent, equation.data());
      const auto facet = static_cast<std::size_t>(data.facet_of_cell[c]);
      if (data.equation_errors[facet] >= 0 && error >= data.equation_errors[facet]) continue;  // the best cell of the facet
      data.equation_errors[facet] = error;
      std::copy(equation.begin(), equation.end(),
                data.equations.begin() + static_cast<std::ptrdiff_t>(facet * (ambient() + 1)));
    }
  }

  const double* checked_query(std::span<const double> query) const {
    if (query.size() != ambient()) throw Error(Errc::bad_dimension, "the query has not as many coordinates as the space");
    check_finite(query, ambient());
    return query.data();
  }
  bool in_flat(const double* q) const { return affine_dimension() == dimension || state->affine_hull.contains(q); }
  kernel::Grid grid_with(const double* q) const {
    kernel::Grid grid = state->sites.grid;
    grid.include(q);
    return grid;
  }
};

Polytope::Polytope(int dimension, const Options& options) {
  if (dimension < 1) throw Error(Errc::bad_dimension, "the dimension must be at least 1");
  impl_ = std::make_unique<Impl>(dimension, options);
}
Polytope::Polytope(std::span<const double> coordinates, int dimension, const Options& options) : Polytope(dimension, options) {
  insert_range(coordinates);
}
Polytope::Polytope(PointsView points, const Options& options) : Polytope(points.coordinates(), points.dimension(), options) {}
Polytope::Polytope(Polytope&&) noexcept = default;
Polytope& Polytope::operator=(Polytope&&) noexcept = default;
Polytope::~Polytope() = default;

void Polytope::insert_range(std::span<const double> coordinates) {
  try {
    impl_->insert_range(coordinates);
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for the hull");
  }
}
HullInsertResult Polytope::insert(std::span<const double> point) {
  try {
    return impl_->insert(point);
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for the hull");
  }
}

int Polytope::dimension() const { return impl_->dimension; }
int Polytope::affine_dimension() const { return impl_->affine_dimension(); }
std::size_t Polytope::num_points() const { return impl_->state->site_of_row.size(); }
std::size_t Polytope::num_duplicates() const { return num_points() - impl_->state->sites.size(); }
std::size_t Polytope::num_cells() const { return impl_->hull().num_cells(); }
std::vector<int> Polytope::axes() const { return impl_->state->affine_hull.axes(); }

std::span<const double> Polytope::point(std::size_t row) const {
  if (row >= num_points()) throw Error(Errc::invalid_argument, "not a row of the input");
  return {impl_->state->sites.point(impl_->state->site_of_row[row]), impl_->ambient()};
}
PointKind Polytope::kind(std::size_t row) const {
  if (row >= num_points()) throw Error(Errc::invalid_argument, "not a row of the input");
  return data().point_kinds[row];
}
std::size_t Polytope::count(PointKind kind) const {
  return static_cast<std::size_t>(std::count(data().point_kinds.begin(), data().point_kinds.end(), kind));
}

const HullData& Polytope::data() const { return impl_->analyse().data; }
HullData Polytope::to_data(bool with_points) const {
  HullData copy = data();
  for (std::size_t row = 0; with_points && row < num_points(); ++row)
    copy.points.insert(copy.points.end(), point(row).begin(), point(row).end());
  return copy;
}

Measure Polytope::volume() const {
  // Every cell joined to one vertex: none of these simplices has negative volume, so nothing cancels.
  const SimplicialHull& hull = impl_->hull();
  const HullSites& sites = impl_->state->sites;
  front_ends::MeasureSum sum;
  std::vector<const double*> simplex;
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    const auto cell = hull.cell(c);
    if (std::find(cell.begin(), cell.end(), hull.cells[0]) != cell.end()) continue;
    simplex.assign(1, sites.point(hull.cells[0]));
    for (const Index site : cell) simplex.push_back(sites.point(site));
    sum.add(front_ends::simplex_volume(simplex, sites.ambient));
  }
  return hull.num_cells() == 0 ? Measure{} : sum.result();
}
Measure Polytope::area() const {
  const SimplicialHull& hull = impl_->hull();
  if (hull.dimension <= 1) return {static_cast<double>(hull.num_cells()), 0};
  front_ends::MeasureSum sum;
  std::vector<const double*> simplex;
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    simplex.clear();
    for (const Index site : hull.cell(c)) simplex.push_back(impl_->state->sites.point(site));
    sum.add(front_ends::simplex_volume(simplex, dimension()));
  }
  return sum.result();
}

std::vector<std::size_t> Polytope::f_vector() const {
  return front_ends::count_faces(impl_->analyse().faces.facets, affine_dimension());
}

Containment Polytope::locate(std::span<const double> query) const {
  const double* q = impl_->checked_query(query);
  Containment result;
  if (affine_dimension() < 0 || !impl_->in_flat(q)) return result;
  if (affine_dimension() == 0) {
    result.kind = Containment::Kind::on_boundary;
    result.face = {impl_->row(0)};
    return result;
  }
  const Analysis& analysis = impl_->analyse();
  const kernel::Grid grid = impl_->grid_with(q);
  const HullLocator::Result found = analysis.locator->locate(q, grid);
  result.cell = static_cast<SignedIndex>(found.cell);
  result.kind = found.side == Sign::positive   ? Containment::Kind::inside
                : found.side == Sign::negative ? Containment::Kind::outside
                                               : Containment::Kind::on_boundary;
  if (found.side != Sign::zero) return result;
  std::vector<Index> facets;
  for (const Index c : analysis.locator->cells_on_side(found.cell, Sign::zero, q, grid))
    facets.push_back(analysis.faces.facet_of_cell[c]);
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  for (const Index site : front_ends::common_vertices(analysis.faces.facets, facets)) result.face.push_back(impl_->row(site));
  return result;
}
bool Polytope::contains(std::span<const double> query) const {
  const Containment::Kind kind = locate(query).kind;
  return kind == Containment::Kind::inside || kind == Containment::Kind::on_boundary;
}

std::vector<SignedIndex> Polytope::visible_cells(std::span<const double> query) const {
  const double* q = impl_->checked_query(query);
  if (affine_dimension() < 1 || !impl_->in_flat(q)) return {};
  const Analysis& analysis = impl_->analyse();
  const kernel::Grid grid = impl_->grid_with(q);
  const HullLocator::Result found = analysis.locator->locate(q, grid);
  if (found.side != Sign::negative) return {};
  const std::vector<Index> cells = analysis.locator->cells_on_side(found.cell, Sign::negative, q, grid);
  return {cells.begin(), cells.end()};
}
std::vector<SignedIndex> Polytope::visible_facets(std::span<const double> query) const {
  std::vector<SignedIndex> facets;
  for (const SignedIndex c : visible_cells(query)) facets.push_back(data().facet_of_cell[static_cast<std::size_t>(c)]);
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  return facets;
}

CanonicalHash Polytope::hash() const {
  const SimplicialHull& hull = impl_->hull();
  const HullSites& sites = impl_->state->sites;
  front_ends::HashAccumulator hash;
  std::vector<Index> corners = hull.cells;
  if (affine_dimension() == 0) corners = {0};
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (const Index site : corners) hash.add_vertex(front_ends::point_tag(sites.point(site), dimension()));
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    front_ends::PointTag sum;
    for (const Index site : hull.cell(c)) sum += front_ends::point_tag(sites.point(site), dimension());
    hash.add_cell(sum);
  }
  return hash.finish(dimension(), affine_dimension());
}

Statistics Polytope::statistics() const {
  const State& state = *impl_->state;
  Statistics s;
  s.created_cells = state.earlier.created_cells;
  StageCounts stages = state.earlier.stages;
  if (state.builder) {
    s.created_cells += state.builder->effort().created_cells;
    s.insertions = state.builder->insertions();
    s.cell_bytes = state.builder->bytes();
    stages.filter += state.builder->effort().stages.filter;
    stages.direct += state.builder->effort().stages.direct;
    stages.exact += state.builder->effort().stages.exact;
    stages.perturbed += state.builder->effort().stages.perturbed;
  }
  s.filter = stages.filter;
  s.direct = stages.direct;
  s.exact = stages.exact;
  s.perturbed = stages.perturbed;
  s.order_seconds = state.order_seconds;
  s.build_seconds = state.build_seconds;
  return s;
}

}  // namespace delone
