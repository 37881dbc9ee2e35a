// SPDX-License-Identifier: BSD-3-Clause
// ConvexHullBase: the public members of what hull_state.hpp builds and hull_analysis.hpp derives from it.
#include "base/axis_scale.hpp"
#include "base/build_limits.hpp"
#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/require_dimension.hpp"
#include "base/require_finite.hpp"
#include "base/require_tolerance.hpp"
#include "complex/canonical_hash.hpp"
#include "hull/extreme_hull.hpp"
#include "hull/flat_distance.hpp"
#include "hull/hull_analysis.hpp"
#include "hull/hull_state.hpp"
#include "hull/tolerance/necessary_hull.hpp"
#include "hull/tolerance/tolerant_hull.hpp"

#include <delone/arithmetic.hpp>
#include <delone/convex_hull.hpp>

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace delone {

using compiled::SimplicialHull;
using hull::HullAnalysis;
using hull::HullLocator;
using hull::HullState;
using hull::TolerantHull;
using internal::AxisScale;

namespace {

void require_row(std::size_t row, std::size_t count) {
  if (row >= count)
    throw Error(Errc::invalid_argument, "row " + std::to_string(row) + " is not a row of the input");
}

}  // namespace

struct ConvexHullBase::Impl {
  Impl(int d, Options given)
      : dimension(d),
        options(std::move(given)),
        scale(options.tolerance, options.axis_tolerances, d),
        state(std::make_unique<HullState>(d)) {
    options.tolerance = scale.tolerance();
  }
  Impl(const Impl& other)
      : dimension(other.dimension),
        options(other.options),
        scale(other.scale),
        state(std::make_unique<HullState>(*other.state)),
        has_vertices_only(other.has_vertices_only) {
    if (has_vertices_only) tolerant = std::make_unique<const TolerantHull>(*state, options.tolerance);
  }

  int dimension;
  Options options;
  AxisScale scale;                   // where distances count; its tolerance is that of the options
  std::unique_ptr<HullState> state;  // the exact hull of all points,
  bool has_vertices_only = false;    // unless only those that are shown have been inserted into it
  mutable std::mutex mutex;
  mutable std::unique_ptr<const TolerantHull> tolerant;  // made on first use, if there is a tolerance
  mutable std::unique_ptr<const HullAnalysis> analysis_of_state;
  mutable std::optional<double> known_distance;  // of points from the hull, if it has vertices only

  std::size_t ambient() const { return static_cast<std::size_t>(dimension); }
  int affine_dimension() const { return shown().affine_hull().dimension(); }
  const SimplicialHull& hull() const { return shown().hull(); }

  /// What this object shows: the exact hull, or that with a tolerance.
  const HullState& shown() const {
    if (options.tolerance == 0) return *state;
    return internal::guarded("the hull", [&]() -> const HullState& {
      const std::lock_guard lock(mutex);
      return shown_when_locked();
    });
  }
  const HullState& shown_when_locked() const {
    if (options.tolerance == 0) return *state;
    if (!tolerant) tolerant = std::make_unique<const TolerantHull>(*state, scale, options, false);
    return tolerant->state();
  }
  double max_distance() const {
    shown();
    if (!has_vertices_only) return tolerant ? tolerant->max_distance() : 0;
    return internal::guarded("the hull", [&] {
      const std::lock_guard lock(mutex);
      if (!known_distance) {
        const std::unique_ptr<HullState> exact = exact_state();
        known_distance = TolerantHull(*exact, scale, options, false).max_distance();
      }
      return *known_distance;
    });
  }
  /// The exact hull of all rows, where `state` is that of vertices only.
  std::unique_ptr<HullState> exact_state() const {
    auto exact = std::make_unique<HullState>(dimension);
    exact->insert_range(state->sites().coordinates, options);
    return exact;
  }
  void make_exact() {
    if (!has_vertices_only) return;
    std::unique_ptr<HullState> exact = exact_state();
    analysis_of_state.reset();
    tolerant.reset();
    known_distance.reset();
    state = std::move(exact);
    has_vertices_only = false;
  }

  template <class Work>
  decltype(auto) within_limits(Work&& work) const {
    internal::BuildLimits limits(options.memory_limit, options.time_limit, "points");
    const internal::ProgressMeter meter(options.progress);
    return limits.guard(std::forward<Work>(work));
  }

  /// Throws unless all is well with new points; false if there are none.
  bool check_points(std::span<const double> coordinates) const {
    if (coordinates.size() % ambient() != 0)
      throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
    internal::require_finite(coordinates, ambient(), "a coordinate");
    check_room(coordinates.size() / ambient());
    if (coordinates.empty()) return false;
    internal::require_tolerance_within(options.tolerance, coordinates, ambient(), state->sites().coordinates,
                                       scale.factors());
    return true;
  }
  void insert_range(std::span<const double> coordinates) {
    if (!check_points(coordinates)) return;
    make_exact();
    std::unique_ptr<const TolerantHull> made;
    const auto make = [&] { made = std::make_unique<const TolerantHull>(*state, scale, options, true); };
    state->insert_range(coordinates, options, options.tolerance > 0 ? make : std::function<void()>{});
    analysis_of_state.reset();
    tolerant = std::move(made);
  }
  std::vector<SignedIndex> insert_extreme(std::span<const double> coordinates) {
    if (state->num_rows() > 0)
      throw Error(Errc::invalid_argument, "extreme points alone are inserted into an empty hull only");
    if (!check_points(coordinates)) return {};
    if (options.tolerance > 0)
      if (auto necessary = hull::find_necessary_hull(coordinates, dimension, scale, options)) {
        auto made = std::make_unique<const TolerantHull>(*necessary->state, options.tolerance);
        std::vector<SignedIndex> rows(necessary->rows.begin(), necessary->rows.end());
        analysis_of_state.reset();
        tolerant = std::move(made);
        state = std::move(necessary->state);
        has_vertices_only = true;
        return rows;
      }
    hull::ExtremeHull hull = hull::find_extreme_hull(coordinates, dimension, options);
    std::vector<SignedIndex> rows(hull.rows.begin(), hull.rows.end());
    // What is shown with a tolerance depends on the extreme points alone.
    std::unique_ptr<const TolerantHull> made;
    if (options.tolerance > 0) made = std::make_unique<const TolerantHull>(*hull.state, scale, options, true);
    analysis_of_state.reset();
    tolerant = std::move(made);
    state = std::move(hull.state);
    return rows;
  }

  HullInsertResult insert(std::span<const double> point) {
    if (point.size() != ambient())
      throw Error(Errc::bad_dimension, "the point has not as many coordinates as the space");
    internal::require_finite(point, ambient(), "a coordinate");
    check_room(1);
    make_exact();
    if (state->raises_dimension(point.data())) {
      const std::size_t row = state->num_rows();
      analysis_of_state.reset();
      tolerant.reset();
      state->insert_range(point, options);
      return {row, true, false};
    }
    const HullInsertResult result = state->insert_in_flat(point.data());
    tolerant.reset();
    // Of a duplicate only the new row's entries change, but they are part of the arrays.
    analysis_of_state.reset();
    return result;
  }
  void check_room(std::size_t n) const {
    if (n > max_index - state->num_rows()) throw Error(Errc::too_many, "more points than this build has ids");
  }

  /// What `ask` finds out from the analysis.
  template <class Ask>
  decltype(auto) analyse(Ask ask) const {
    return internal::guarded("the faces of the hull", [&]() -> decltype(auto) { return ask(analysis()); });
  }
  const HullAnalysis& analysis() const {
    const std::lock_guard lock(mutex);
    if (!analysis_of_state) {
      const HullState& of = shown_when_locked();
      const double distance = tolerant ? tolerant->max_distance() : 0;
      analysis_of_state =
          std::make_unique<HullAnalysis>(of, hull::HullTolerance{scale, distance}, options.threads);
    }
    return *analysis_of_state;
  }

  const double* checked_query(std::span<const double> query) const {
    if (query.size() != ambient())
      throw Error(Errc::bad_dimension, "the query has not as many coordinates as the space");
    internal::require_finite(query, ambient(), "a coordinate");
    return query.data();
  }
  bool in_flat(const double* q) const {
    const kernel::AffineHull& flat = shown().affine_hull();
    return flat.dimension() == dimension || flat.contains(q) ||
           (options.tolerance > 0 && is_near(flat.basis(), q));
  }
  bool is_near(std::span<const double* const> flat, const double* q) const {
    if (scale.is_one()) return hull::is_near_flat(flat, q, dimension, options.tolerance);
    std::vector<double> rows;
    for (const double* point : flat) rows.insert(rows.end(), point, point + dimension);
    rows.insert(rows.end(), q, q + dimension);
    rows = scale.scaled(rows);
    std::vector<const double*> points;
    for (std::size_t i = 0; i <= flat.size(); ++i) points.push_back(rows.data() + i * ambient());
    return hull::is_near_flat(std::span(points).first(flat.size()), points.back(), dimension,
                              options.tolerance);
  }
  kernel::Grid grid_with(const double* q) const {
    kernel::Grid grid = shown().sites().grid;
    grid.include(q);
    return grid;
  }
};

ConvexHullBase::ConvexHullBase(int dimension, const Options& options) {
  const ArithmeticScope arithmetic;
  internal::require_dimension(dimension);
  internal::require_time_limit(options.time_limit);
  impl_ = internal::guarded("the hull", [&] { return std::make_unique<Impl>(dimension, options); });
}
ConvexHullBase::ConvexHullBase(detail::Clone, const ConvexHullBase& other)
    : impl_(internal::guarded("the hull", [&] { return std::make_unique<Impl>(*other.impl_); })) {}
ConvexHullBase::ConvexHullBase(ConvexHullBase&&) noexcept = default;
ConvexHullBase& ConvexHullBase::operator=(ConvexHullBase&&) noexcept = default;
ConvexHullBase::~ConvexHullBase() = default;

void ConvexHullBase::insert_coordinates(std::span<const double> coordinates) {
  internal::guarded("the hull", [&] { impl_->within_limits([&] { impl_->insert_range(coordinates); }); });
}
std::vector<SignedIndex> ConvexHullBase::insert_extreme_coordinates(std::span<const double> coordinates) {
  return internal::guarded(
      "the hull", [&] { return impl_->within_limits([&] { return impl_->insert_extreme(coordinates); }); });
}
HullInsertResult ConvexHullBase::insert_point(std::span<const double> point) {
  return internal::guarded("the hull", [&] { return impl_->insert(point); });
}

int ConvexHullBase::dimension() const { return impl_->dimension; }
int ConvexHullBase::affine_dimension() const { return impl_->affine_dimension(); }
std::size_t ConvexHullBase::num_points() const { return impl_->state->num_rows(); }
std::size_t ConvexHullBase::num_duplicates() const { return impl_->state->num_duplicates(); }
std::size_t ConvexHullBase::num_cells() const { return impl_->hull().num_cells(); }
std::vector<int> ConvexHullBase::axes() const { return impl_->shown().sites().axes; }
double ConvexHullBase::tolerance() const { return impl_->options.tolerance; }
std::vector<double> ConvexHullBase::axis_tolerances() const {
  return impl_->scale.is_one() ? std::vector<double>(impl_->ambient(), tolerance())
                               : impl_->scale.tolerances();
}
double ConvexHullBase::max_distance() const { return impl_->max_distance(); }

std::size_t ConvexHullBase::num_vertices() const {
  return impl_->analyse([](const HullAnalysis& analysis) { return analysis.num_extreme(); });
}
std::size_t ConvexHullBase::num_facets() const {
  return impl_->analyse([](const HullAnalysis& analysis) { return analysis.faces().num_facets(); });
}
std::size_t ConvexHullBase::num_ridges() const {
  return impl_->analyse([](const HullAnalysis& analysis) { return analysis.num_ridges(); });
}
PointKind ConvexHullBase::kind(std::size_t row) const {
  require_row(row, num_points());
  return impl_->analyse([&](const HullAnalysis& analysis) { return analysis.kinds()[row]; });
}
std::size_t ConvexHullBase::count(PointKind kind) const {
  return impl_->analyse([&](const HullAnalysis& analysis) { return analysis.count(kind); });
}
std::span<const double> ConvexHullBase::point(std::size_t row) const {
  require_row(row, num_points());
  return {impl_->state->point_of_row(row), impl_->ambient()};
}

const HullData& ConvexHullBase::data() const {
  return impl_->analyse([](const HullAnalysis& analysis) -> const HullData& { return analysis.data(); });
}
HullCells ConvexHullBase::to_cells() const {
  return impl_->analyse([](const HullAnalysis& analysis) { return analysis.cells(); });
}
HullData ConvexHullBase::to_data(bool with_points) const {
  HullData copy = data();
  if (with_points) copy.points.reserve(num_points() * impl_->ambient());
  for (std::size_t row = 0; with_points && row < num_points(); ++row)
    copy.points.insert(copy.points.end(), point(row).begin(), point(row).end());
  return copy;
}

Measure ConvexHullBase::volume() const {
  return impl_->analyse([](const HullAnalysis& analysis) { return analysis.measures().volume; });
}
Measure ConvexHullBase::area() const {
  return impl_->analyse([](const HullAnalysis& analysis) { return analysis.measures().area; });
}
std::vector<std::size_t> ConvexHullBase::f_vector(const Execution& how) const {
  const internal::ProgressMeter meter(how.progress);
  return impl_->analyse([&](const HullAnalysis& analysis) {
    return hull::count_faces(analysis.facet_sites(), affine_dimension());
  });
}

Containment ConvexHullBase::locate(const AnyPoint<>& query) const {
  const ArithmeticScope arithmetic;
  const double* q = impl_->checked_query(query);
  Containment result;
  if (affine_dimension() < 0 || !impl_->in_flat(q)) return result;
  if (affine_dimension() == 0) {
    result.kind = Containment::Kind::on_boundary;
    result.face = {impl_->state->row(impl_->shown().basis()[0])};
    return result;
  }
  const HullAnalysis& analysis = impl_->analysis();
  const kernel::Grid grid = impl_->grid_with(q);
  const HullLocator::Result found = analysis.locator()->locate(q, grid);
  result.cell = static_cast<SignedIndex>(found.cell);
  result.kind = found.side == Sign::positive   ? Containment::Kind::inside
                : found.side == Sign::negative ? Containment::Kind::outside
                                               : Containment::Kind::on_boundary;
  if (found.side != Sign::zero) return result;
  std::vector<Index> facets;
  for (const Index c : analysis.locator()->cells_on_side(found.cell, Sign::zero, q, grid))
    facets.push_back(analysis.faces().facet_of_cell[c]);
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  for (const Index site : hull::common_vertices(analysis.facet_sites(), facets))
    result.face.push_back(impl_->state->row(site));
  return result;
}
bool ConvexHullBase::contains(const AnyPoint<>& query) const {
  const ArithmeticScope arithmetic;
  const double* q = impl_->checked_query(query);
  const int k = affine_dimension();
  if (k < 0 || !impl_->in_flat(q)) return false;
  return k == 0 || impl_->analysis().locator()->side_of_hull(q, impl_->grid_with(q)) != Sign::negative;
}

std::vector<SignedIndex> ConvexHullBase::visible_cells(const AnyPoint<>& query) const {
  const ArithmeticScope arithmetic;
  const double* q = impl_->checked_query(query);
  if (affine_dimension() < 1 || !impl_->in_flat(q)) return {};
  const HullAnalysis& analysis = impl_->analysis();
  const kernel::Grid grid = impl_->grid_with(q);
  const HullLocator::Result found = analysis.locator()->locate(q, grid);
  if (found.side != Sign::negative) return {};
  const std::vector<Index> cells = analysis.locator()->cells_on_side(found.cell, Sign::negative, q, grid);
  return {cells.begin(), cells.end()};
}
std::vector<SignedIndex> ConvexHullBase::visible_facets(const AnyPoint<>& query) const {
  std::vector<SignedIndex> facets;
  for (const SignedIndex c : visible_cells(query))
    facets.push_back(
        static_cast<SignedIndex>(impl_->analysis().faces().facet_of_cell[static_cast<std::size_t>(c)]));
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  return facets;
}

CanonicalHash ConvexHullBase::hash() const {
  const ArithmeticScope arithmetic;
  const SimplicialHull& hull = impl_->hull();
  const sites::BoundarySites& sites = impl_->state->sites();
  const unsigned threads = impl_->options.threads;
  complex::HashAccumulator hash;
  std::vector<char> is_corner(sites.size(), 0);
  for (const Index site : hull.cells) is_corner[site] = 1;
  if (affine_dimension() == 0) is_corner[impl_->shown().basis()[0]] = 1;
  std::vector<complex::PointTag> tags(sites.size());
  complex::add_in_parts(
      threads, sites.size(), hash, [&](std::size_t first, std::size_t last, complex::HashAccumulator& some) {
        for (std::size_t site = first; site < last; ++site) {
          if (is_corner[site] == 0) continue;
          tags[site] = complex::point_tag(sites.point(static_cast<Index>(site)), dimension());
          some.add_vertex(tags[site]);
        }
      });
  complex::add_in_parts(threads, hull.num_cells(), hash,
                        [&](std::size_t first, std::size_t last, complex::HashAccumulator& some) {
                          for (std::size_t c = first; c < last; ++c) {
                            complex::PointTag sum;
                            for (const Index site : hull.cell(c)) sum += tags[site];
                            some.add_cell(sum);
                          }
                        });
  return hash.finish(dimension(), affine_dimension());
}

Statistics ConvexHullBase::statistics() const {
  Statistics statistics = impl_->shown().statistics();
  const Statistics of_exact = impl_->state->statistics();
  statistics.order_seconds = of_exact.order_seconds;
  statistics.build_seconds = of_exact.build_seconds;
  return statistics;
}

}  // namespace delone
