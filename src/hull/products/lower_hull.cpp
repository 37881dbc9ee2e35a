// SPDX-License-Identifier: BSD-3-Clause
// LowerHullBase: the hull of the points and of one more above them, of which the cells that look down are
// kept.
//
// Why one more point. It lies over the composition of a lowest point, higher than that. The hyperplane of a
// lower facet is, over any composition of the domain, at most as high as the lower hull, so the new point is
// strictly above all of them: no lower facet is lost or gained. But the hull is full-dimensional even when
// all heights are an affine function of the compositions, and the upper side, of no interest, becomes simple.
#include "base/build_limits.hpp"
#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/require_dimension.hpp"
#include "base/require_finite.hpp"
#include "base/require_tolerance.hpp"
#include "hull/cell_height.hpp"
#include "hull/tolerance/envelope_choice.hpp"
#include "kernel/predicates.hpp"
#include "kernel/stages.hpp"

#include <delone/arithmetic.hpp>
#include <delone/lower_hull.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace delone {

struct LowerHullBase::Impl {
  int dimension = 0;
  HullSide side = HullSide::lower;
  std::vector<double> points;                    // n×d, as given
  kernel::AffineHull compositions;               // in R^(d−1)
  std::shared_ptr<const ConvexHull<>> polytope;  // of no copy of the envelope alone: it never changes
  std::vector<SignedIndex> rows_of_polytope;     // but for the last point; all rows if it is empty
  double tolerance = 0, max_distance = 0;
  std::vector<double> projected;  // n×(c+1): the composition axes, the height
  std::vector<int> axes;          // 0 … c
  kernel::Grid grid;
  bool reversed = false;  // whether cells were turned to be positive over the compositions
  std::vector<SignedIndex> cells, neighbors, facet_of_cell, vertices;
  std::size_t num_facets = 0;

  explicit Impl(int d, HullSide given) : dimension(d), side(given), compositions(d - 1), grid(1) {}

  std::size_t ambient() const { return static_cast<std::size_t>(dimension); }
  std::size_t corners() const { return static_cast<std::size_t>(compositions.dimension() + 1); }
  std::size_t num_points() const { return points.size() / ambient(); }
  std::size_t num_cells() const { return cells.empty() ? 0 : cells.size() / corners(); }
  double height_sign() const { return side == HullSide::lower ? 1.0 : -1.0; }
  const double* place(SignedIndex row) const {
    return projected.data() + static_cast<std::size_t>(row) * corners();
  }
  kernel::Flat composition_flat() const {
    return {static_cast<int>(corners()), std::span<const int>(axes).first(corners() - 1)};
  }
  kernel::Flat flat() const { return {static_cast<int>(corners()), axes}; }

  /// The point on the composition axes; `height` is given with its sign for the lower hull.
  void project(const double* composition, double height, std::vector<double>& result) const {
    for (const int axis : compositions.axes()) result.push_back(composition[axis]);
    result.push_back(height);
  }

  void build(const Options& options) {
    const std::size_t n = num_points();
    tolerance = options.tolerance;
    if (n == 0) return;
    for (std::size_t row = 0; row < n && compositions.dimension() < dimension - 1; ++row)
      compositions.add(points.data() + row * ambient());
    axes.resize(corners());
    std::iota(axes.begin(), axes.end(), 0);
    std::size_t lowest = 0;
    double low = 0, high = 0;
    for (std::size_t row = 0; row < n; ++row) {
      const double* point = points.data() + row * ambient();
      const double height = height_sign() * point[dimension - 1];
      project(point, height, projected);
      if (row == 0 || height < low) low = height, lowest = row;
      if (row == 0 || height > high) high = height;
    }
    internal::require_tolerance_within(tolerance, high - low, "the range of heights,");
    grid = kernel::Grid(static_cast<int>(corners()));
    for (std::size_t row = 0; row < n; ++row) grid.include(place(static_cast<SignedIndex>(row)));
    build_polytope(lowest, low, high, options);
    if (tolerance == 0) return;
    internal::ProgressMeter meter(options.progress, 0);
    hull::EnvelopeChoice choice =
        hull::choose_envelope(projected, static_cast<int>(corners()), vertices, tolerance, [&] { meter(0); });
    max_distance = choice.max_distance;
    if (choice.rows.size() == vertices.size()) return;
    rows_of_polytope = std::move(choice.rows);
    std::sort(rows_of_polytope.begin(), rows_of_polytope.end());
    cells.clear();
    neighbors.clear();
    facet_of_cell.clear();
    num_facets = 0;
    build_polytope(lowest, low, high, options);
  }

  /// The hull of the points, or of those of rows_of_polytope, and of one above them all.
  void build_polytope(std::size_t lowest, double low, double high, Options options) {
    double raised = high + (high - low);
    if (!(raised < std::numeric_limits<double>::max())) raised = high;
    if (raised == low) raised = std::nextafter(low, std::numeric_limits<double>::infinity());
    std::vector<double> all = projected;
    if (!rows_of_polytope.empty()) {
      all.clear();
      for (const SignedIndex row : rows_of_polytope)
        all.insert(all.end(), place(row), place(row) + corners());
    }
    if (std::isinf(raised)) {  // all heights are the largest double: any other constant has the same hull
      for (std::size_t at = corners() - 1; at < all.size(); at += corners()) all[at] = 0;
      raised = 1;
    }
    project(points.data() + lowest * ambient(), raised, all);
    options.tolerance = 0;
    polytope = std::make_shared<const ConvexHull<>>(all, static_cast<int>(corners()), options);
    collect(polytope->data());
  }
  /// The row of a point of the polytope; none of the points' for that above them.
  SignedIndex row_of(SignedIndex of_polytope) const {
    const auto at = static_cast<std::size_t>(of_polytope);
    if (rows_of_polytope.empty()) return of_polytope;
    return at < rows_of_polytope.size() ? rows_of_polytope[at] : static_cast<SignedIndex>(num_points());
  }

  /// The sign of the last component of the outward normal of a cell is that of (−1)^(k+1)·(orientation over
  /// the compositions), k = c + 1: expand det(n, e_1, …, e_(k−1)) > 0 along an n of the last axis.
  bool looks_down(std::span<const SignedIndex> cell, std::size_t number) const {
    if (corners() == 1) return number == 0;
    std::vector<const double*> simplex;
    for (const SignedIndex of_polytope : cell) {
      const SignedIndex row = row_of(of_polytope);
      if (static_cast<std::size_t>(row) >= num_points()) return false;  // the point above
      simplex.push_back(place(row));
    }
    const Sign sign = kernel::orientation<0>(composition_flat(), simplex.data(), grid);
    return sign == (corners() % 2 == 0 ? Sign::positive : Sign::negative);
  }

  void collect(const HullData& data) {
    const std::size_t k = corners();
    reversed = k % 2 == 1 && k > 1;
    std::vector<SignedIndex> number(data.num_cells(), -1), facet_number(data.num_facets(), -1);
    SignedIndex count = 0;
    for (std::size_t c = 0; c < data.num_cells(); ++c)
      if (looks_down(std::span(data.cells).subspan(c * k, k), c)) number[c] = count++;
    std::vector<SignedIndex> extreme;
    for (std::size_t c = 0; c < data.num_cells(); ++c) {
      if (number[c] < 0) continue;
      const std::size_t first = cells.size();
      for (std::size_t i = 0; i < k; ++i) {
        const SignedIndex at = data.cells[c * k + i], row = row_of(at);
        cells.push_back(row);
        neighbors.push_back(k == 1 ? -1 : number[static_cast<std::size_t>(data.neighbors[c * k + i])]);
        if (data.point_kinds[static_cast<std::size_t>(at)] == PointKind::extreme) extreme.push_back(row);
      }
      if (reversed) {
        std::swap(cells[first], cells[first + 1]);
        std::swap(neighbors[first], neighbors[first + 1]);
      }
      SignedIndex& facet = facet_number[static_cast<std::size_t>(data.facet_of_cell[c])];
      if (facet < 0) facet = static_cast<SignedIndex>(num_facets++);
      facet_of_cell.push_back(facet);
    }
    std::sort(extreme.begin(), extreme.end());
    extreme.erase(std::unique(extreme.begin(), extreme.end()), extreme.end());
    vertices = std::move(extreme);
  }

  std::span<const SignedIndex> cell(std::size_t c) const {
    return std::span(cells).subspan(c * corners(), corners());
  }

  /// The points of a cell.
  std::vector<const double*> simplex_of(std::size_t c) const {
    std::vector<const double*> points(corners());
    fill_simplex(c, points);
    return points;
  }
  void fill_simplex(std::size_t c, std::span<const double*> points) const {
    std::size_t i = 0;
    for (const SignedIndex row : cell(c)) points[i++] = place(row);
  }

  /// A cell that contains a composition, and which of its vertices are those of the smallest face that does.
  struct Found {
    std::size_t cell = 0;
    std::vector<unsigned char> on_face{1};
  };

  /// The walk: leave a cell by a facet that has the composition on its other side. It ends, as the cells are
  /// the projection of a convex boundary (Edelsbrunner 1990, doi:10.1007/BF02122779).
  std::optional<Found> find_cell(const double* q, std::size_t start, const kernel::Grid& with_q) const {
    if (num_cells() == 0) return std::nullopt;
    if (corners() == 1) return Found();
    std::vector<unsigned char> on_face(corners());
    std::vector<const double*> simplex(corners());
    for (std::size_t c = start;;) {
      fill_simplex(c, simplex);
      std::size_t out = corners();
      for (std::size_t i = 0; i < corners() && out == corners(); ++i) {
        const double* vertex = simplex[i];
        simplex[i] = q;
        const Sign side = kernel::orientation<0>(composition_flat(), simplex.data(), with_q);
        if (side == Sign::negative) out = i;
        on_face[i] = side == Sign::positive ? 1 : 0;
        simplex[i] = vertex;
      }
      if (out == corners()) return Found{c, std::move(on_face)};
      const SignedIndex across = neighbors[c * corners() + out];
      if (across < 0) return std::nullopt;
      c = static_cast<std::size_t>(across);
    }
  }

  /// Calls visit(projected query, where it was found or nullopt, a grid that includes it) for rows of `width`
  /// ≥ d−1 numbers.
  template <class Visit>
  void for_each_query(std::span<const double> queries, std::size_t width, Visit visit) const {
    if (queries.size() % width != 0)
      throw Error(Errc::bad_dimension, "the number of coordinates does not fit the dimension");
    internal::require_finite(queries, width, "a coordinate", "query");
    std::size_t hint = 0;
    std::vector<double> q;
    for (std::size_t i = 0; i < queries.size() / width; ++i) {
      const double* row = queries.data() + i * width;
      q.clear();
      std::optional<Found> found;
      kernel::Grid with_q = grid;
      if (compositions.dimension() == dimension - 1 || compositions.contains(row)) {
        project(row, width == ambient() ? height_sign() * row[width - 1] : place(0)[corners() - 1], q);
        with_q.include(q.data());
        found = find_cell(q.data(), hint, with_q);
        if (found) hint = found->cell;
      }
      visit(q.data(), found, with_q);
    }
  }
};

LowerHullBase::LowerHullBase(const AnyPoints<>& points, int dimension, HullSide side,
                             const Options& options) {
  const ArithmeticScope arithmetic;
  if (dimension < 2)
    throw Error(Errc::bad_dimension, "a lower hull needs a composition and a height: at least 2 coordinates");
  internal::require_dimension(dimension);
  points.require_dimension(dimension);
  const std::span<const double> coordinates = points.coordinates();
  if (coordinates.size() % static_cast<std::size_t>(dimension) != 0)
    throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  internal::require_finite(coordinates, static_cast<std::size_t>(dimension), "a coordinate");
  internal::require_tolerance(options.tolerance);
  internal::refuse_axis_tolerances(options.axis_tolerances, "lower and upper hulls");
  internal::require_time_limit(options.time_limit);
  internal::guarded("the hull", [&] {
    impl_ = std::make_unique<Impl>(dimension, side);
    impl_->points.assign(coordinates.begin(), coordinates.end());
    internal::BuildLimits limits(options.memory_limit, options.time_limit, "points");
    Options of_polytopes = options;  // within the limits of the whole
    of_polytopes.memory_limit = 0;
    of_polytopes.time_limit = 0;
    limits.guard([&] { impl_->build(of_polytopes); });
  });
}
LowerHullBase::LowerHullBase(detail::Clone, const LowerHullBase& other)
    : impl_(internal::guarded("the hull", [&] { return std::make_unique<Impl>(*other.impl_); })) {}
LowerHullBase::LowerHullBase(LowerHullBase&&) noexcept = default;
LowerHullBase& LowerHullBase::operator=(LowerHullBase&&) noexcept = default;
LowerHullBase::~LowerHullBase() = default;

int LowerHullBase::dimension() const { return impl_->dimension; }
int LowerHullBase::composition_dimension() const { return impl_->compositions.dimension(); }
HullSide LowerHullBase::side() const { return impl_->side; }
std::size_t LowerHullBase::num_points() const { return impl_->num_points(); }
std::size_t LowerHullBase::num_cells() const { return impl_->num_cells(); }
std::size_t LowerHullBase::num_facets() const { return impl_->num_facets; }
std::span<const SignedIndex> LowerHullBase::cells() const { return impl_->cells; }
std::span<const SignedIndex> LowerHullBase::neighbors() const { return impl_->neighbors; }
std::span<const SignedIndex> LowerHullBase::facet_of_cell() const { return impl_->facet_of_cell; }
std::span<const SignedIndex> LowerHullBase::vertices() const { return impl_->vertices; }
double LowerHullBase::tolerance() const { return impl_->tolerance; }
double LowerHullBase::max_distance() const { return impl_->max_distance; }
std::vector<int> LowerHullBase::composition_axes() const { return impl_->compositions.axes(); }

std::optional<std::size_t> LowerHullBase::find_cell(const AnyPoint<>& composition) const {
  const ArithmeticScope arithmetic;
  if (composition.coordinates().size() != impl_->ambient() - 1)
    throw Error(Errc::bad_dimension, "the composition has not as many coordinates as those of the points");
  std::optional<std::size_t> result;
  impl_->for_each_query(composition, impl_->ambient() - 1, [&](auto, const auto& found, const auto&) {
    if (found) result = found->cell;
  });
  return result;
}

std::vector<double> LowerHullBase::heights(const AnyPoints<>& compositions) const {
  const ArithmeticScope arithmetic;
  compositions.require_dimension(dimension() - 1);
  const Impl& hull = *impl_;
  const int width = static_cast<int>(hull.corners());
  std::vector<double> result;
  hull.for_each_query(compositions.coordinates(), hull.ambient() - 1,
                      [&](const double* q, const std::optional<Impl::Found>& found, const auto&) {
                        const double height = found ? hull::height_over_cell(hull.simplex_of(found->cell),
                                                                             found->on_face, q, width)
                                                    : std::numeric_limits<double>::infinity();
                        result.push_back(hull.height_sign() * height + 0.0);
                      });
  return result;
}

std::vector<double> LowerHullBase::height_above(const AnyPoints<>& points, double tolerance) const {
  const ArithmeticScope arithmetic;
  internal::require_tolerance(tolerance);
  points.require_dimension(dimension());
  std::vector<double> result;
  const Impl& hull = *impl_;
  const int width = static_cast<int>(hull.corners());
  const auto above = [&](const double* q, const std::optional<Impl::Found>& found, const kernel::Grid& grid) {
    if (!found) return -std::numeric_limits<double>::infinity();
    std::vector<const double*> simplex = hull.simplex_of(found->cell);
    simplex.insert(simplex.begin(), q);
    Sign sign = kernel::orientation<0>(hull.flat(), simplex.data(), grid);
    if (hull.reversed || hull.corners() == 1) sign = -sign;  // of one vertex, the cell is the lower end
    return hull::height_above_cell(std::span(simplex).subspan(1), found->on_face, q, width, sign, tolerance);
  };
  hull.for_each_query(
      points.coordinates(), hull.ambient(),
      [&](const double* q, const std::optional<Impl::Found>& found, const kernel::Grid& grid) {
        result.push_back(hull.height_sign() * above(q, found, grid) + 0.0);
      });
  return result;
}

ComplexData LowerHullBase::to_data() const {
  ComplexData data;
  data.dimension = dimension();
  data.affine_dimension = composition_dimension();
  data.points = impl_->points;
  data.cells = impl_->cells;
  data.neighbors = impl_->neighbors;
  data.kind = side() == HullSide::lower ? DataKind::lower_hull : DataKind::upper_hull;
  data.tolerance = impl_->tolerance;
  return data;
}
const ConvexHullBase& LowerHullBase::polytope() const {
  if (!impl_->polytope) throw Error(Errc::invalid_argument, "there is no point, hence no hull");
  return *impl_->polytope;
}

}  // namespace delone
