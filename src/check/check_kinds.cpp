// SPDX-License-Identifier: BSD-3-Clause
// check() of simplices: what they say that they are decides what is examined. Here too the kinds that are no
// triangulation of all their points: parts of one, and boundaries.
//
// Parts. The triangulation of all points is rebuilt and examined. It is a function of the set of points, so
// each cell must be one of its cells; nothing else is left to hold.
//
// The boundary of a set of cells is, as a chain with integers as coefficients, the sum of the oriented facets
// of these cells; facets between two of them cancel. The boundary of that is zero: each ridge is in as many
// facets with one orientation as with the other. In a sphere every chain of that kind is the boundary of
// cells.
#include "base/progress_meter.hpp"
#include "check/check_periodic.hpp"
#include "check/check_stages.hpp"
#include "check/remade.hpp"

#include <delone/arithmetic.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace delone {
namespace internal {
namespace {

/// What level 1 requires of data because of what they say that they are.
void check_kind(const ComplexData& data) {
  const bool is_envelope = data.kind == DataKind::lower_hull || data.kind == DataKind::upper_hull;
  const std::string what(description_of(data.kind));
  switch (data.kind) {
    case DataKind::unknown:
    case DataKind::alpha_complex:
    case DataKind::trimmed:
      break;
    case DataKind::regular:
    case DataKind::periodic_regular:
      if (data.weights.empty() && data.num_points() > 0)
        throw Violation{what + " has weights, and these data have none"};
      break;
    case DataKind::delaunay:
    case DataKind::furthest_site:
    case DataKind::alpha_boundary:
    case DataKind::lower_hull:
    case DataKind::upper_hull:
    case DataKind::periodic_delaunay:
    case DataKind::hull_boundary:
      if (!data.weights.empty()) throw Violation{what + " has no weights, and these data have some"};
      break;
    default:
      throw Violation{"the data say that they are " + what + ", which has other arrays"};
  }
  if (!(data.tolerance >= 0) || !std::isfinite(data.tolerance))
    throw Violation{"the tolerance is not a finite number of at least 0"};
  if (data.tolerance > 0 && !is_envelope)
    throw Violation{"there is a tolerance, which only lower and upper hulls have"};
  if (is_envelope && data.dimension < 2)
    throw Violation{fmt::format("a point of {} has at least 2 coordinates, not {}", what, data.dimension)};
}

/// The same with heights in the place of weights; of an upper hull with their signs changed.
ComplexData over_compositions(const ComplexData& data) {
  ComplexData result;
  result.dimension = data.dimension - 1;
  result.affine_dimension = data.affine_dimension;
  result.cells = data.cells;
  result.neighbors = data.neighbors;
  result.vertex_of_point = data.vertex_of_point;
  result.kind = data.kind;
  result.tolerance = data.tolerance;
  const auto d = static_cast<std::size_t>(data.dimension);
  const double sign = data.kind == DataKind::lower_hull ? 1 : -1;
  for (std::size_t row = 0; row < data.num_points(); ++row) {
    const auto point = data.points.begin() + static_cast<std::ptrdiff_t>(row * d);
    result.points.insert(result.points.end(), point, point + static_cast<std::ptrdiff_t>(d) - 1);
    result.weights.push_back(sign * data.points[row * d + d - 1]);
  }
  return result;
}

/// The cells of a boundary as those of a hull.
HullData as_hull(const ComplexData& data) {
  HullData hull;
  hull.dimension = data.dimension;
  hull.affine_dimension = data.affine_dimension >= 0 ? data.affine_dimension + 1
                          : data.points.empty()      ? -1
                                                     : 0;
  hull.points = data.points;
  hull.cells = data.cells;
  hull.neighbors = data.neighbors;
  return hull;
}

/// Whether the permutation that sorts the items is odd.
bool is_odd(std::span<const SignedIndex> items) {
  bool odd = false;
  for (std::size_t i = 0; i < items.size(); ++i)
    for (std::size_t j = i + 1; j < items.size(); ++j) odd ^= items[j] < items[i];
  return odd;
}

/// Rows of `width` numbers, found by their sets of numbers.
class SortedRows {
 public:
  SortedRows(std::span<const SignedIndex> rows, std::size_t width)
      : width_(width), rows_(rows.begin(), rows.end()) {
    for (std::size_t i = 0; i < rows_.size(); i += width) sort(i);
    order_.resize(rows_.size() / width);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t a, std::size_t b) { return less(a, (*this)[b]); });
  }
  std::span<const SignedIndex> operator[](std::size_t i) const {
    return std::span(rows_).subspan(i * width_, width_);
  }
  /// The numbers of the rows, equal ones next to each other.
  const std::vector<std::size_t>& order() const { return order_; }
  /// REQUIRES numbers that increase.
  std::optional<std::size_t> find(std::span<const SignedIndex> wanted) const {
    const auto at = std::lower_bound(order_.begin(), order_.end(), wanted,
                                     [&](std::size_t a, auto b) { return less(a, b); });
    if (at == order_.end() || !std::ranges::equal((*this)[*at], wanted)) return std::nullopt;
    return *at;
  }

 private:
  void sort(std::size_t at) {
    const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(at);
    std::sort(first, first + static_cast<std::ptrdiff_t>(width_));
  }
  bool less(std::size_t a, std::span<const SignedIndex> b) const {
    return std::ranges::lexicographical_compare((*this)[a], b);
  }

  std::size_t width_;
  std::vector<SignedIndex> rows_;
  std::vector<std::size_t> order_;
};

/// The cells of a part are cells of `whole`, each once, and oriented as there if they are oriented at all:
/// when k < d all as there, or none.
void check_cells_of_part(const ComplexData& data, const ComplexData& whole, bool oriented) {
  const std::size_t corners = static_cast<std::size_t>(data.affine_dimension + 1);
  const SortedRows cells(whole.cells, corners);
  std::vector<std::size_t> user(whole.num_cells(), data.num_cells());
  std::vector<SignedIndex> rows(corners), sorted(corners);
  std::optional<bool> turned;
  for (std::size_t c = 0; c < data.num_cells(); ++c) {
    cancellation_point();
    const auto cell = std::span(data.cells).subspan(c * corners, corners);
    for (std::size_t i = 0; i < corners; ++i)
      rows[i] = whole.vertex_of_point[static_cast<std::size_t>(cell[i])];
    sorted = rows;
    std::sort(sorted.begin(), sorted.end());
    const auto found = cells.find(sorted);
    if (!found)
      throw Violation{fmt::format("cell {} {} is none of the triangulation of all points", c, braces(cell)),
                      {c}};
    if (user[*found] < data.num_cells())
      throw Violation{fmt::format("the cells {} and {} {} are the same", user[*found], c, braces(cell)),
                      {user[*found], c}};
    user[*found] = c;
    if (!oriented || corners == 1) continue;
    const bool is_turned = is_odd(rows) != is_odd(std::span(whole.cells).subspan(*found * corners, corners));
    if (!turned) turned = data.affine_dimension == data.dimension ? false : is_turned;
    if (is_turned != *turned)
      throw Violation{fmt::format("cell {} {} is oriented the wrong way", c, braces(cell)), {c}};
  }
}

/// Where it is known which row each row was merged into, this is right.
void check_rows_of_part(const ComplexData& data, const ComplexData& whole) {
  for (std::size_t row = 0; row < data.vertex_of_point.size(); ++row) {
    const SignedIndex vertex = data.vertex_of_point[row], right = whole.vertex_of_point[row];
    const bool agree = vertex < 0
                           ? right < 0
                           : right >= 0 && whole.vertex_of_point[static_cast<std::size_t>(vertex)] == right &&
                                 data.vertex_of_point[static_cast<std::size_t>(vertex)] == vertex;
    if (!agree)
      throw Violation{
          fmt::format("vertex_of_point of point {} is {}, and {} in the triangulation of all points", row,
                      vertex, right),
          {},
          {row}};
  }
}

ComplexData whole_of(const ComplexData& data, TriangulationKind kind, unsigned threads) {
  const AnyTriangulation made = remade(data, kind, threads);
  return common(made).to_data();
}

void check_part(const ComplexData& data, const CheckOptions& options, unsigned threads) {
  ComplexData whole = whole_of(
      data, data.weights.empty() ? TriangulationKind::delaunay : TriangulationKind::regular, threads);
  const auto examine = [&] {
    if (whole.affine_dimension != data.affine_dimension)
      throw Violation{fmt::format("the affine dimension is given as {}, but the points span {}",
                                  data.affine_dimension, whole.affine_dimension)};
    if (data.affine_dimension >= 0) check_cells_of_part(data, whole, options.oriented);
    check_rows_of_part(data, whole);
  };
  if (data.kind != DataKind::trimmed || !data.weights.empty()) return examine();
  try {
    examine();
  } catch (const Violation& violation) {
    whole = whole_of(data, TriangulationKind::furthest_site, threads);
    try {  // furthest-site triangulations can be trimmed, too
      examine();
    } catch (const Violation&) {
      throw violation;
    }
  }
}

CheckReport check_part_levels(const ComplexData& data, const CheckOptions& options, unsigned threads) {
  Examined examined{data, static_cast<std::size_t>(data.affine_dimension + 1), Lift::paraboloid, threads};
  CheckReport report = run_levels(
      levels_of_part, options,
      [&](CheckReport&) {
        check_kind(data);
        check_storage(data, true, threads);
      },
      [&](CheckReport&) {
        if (data.affine_dimension >= 0) check_incidence(examined, options.oriented);
      },
      [&](CheckReport&) { check_part(data, options, threads); });
  report.not_examined = data.kind == DataKind::trimmed
                            ? "which cells are left: the data do not hold the tolerance"
                            : "which cells belong to it: the data do not hold the radius";
  return report;
}

/// Level 2 of a boundary.
void check_closed(const ComplexData& data, bool oriented) {
  const std::size_t corners = static_cast<std::size_t>(data.affine_dimension + 1);
  if (corners == 1) {  // the empty face is a ridge of all of them
    if (data.num_cells() % 2 != 0)
      throw Violation{fmt::format("{} points do not enclose segments", data.num_cells())};
    return;
  }
  std::vector<SignedIndex> ridges;
  std::vector<signed char> signs;
  ridges.reserve(data.cells.size() * (corners - 1));
  signs.reserve(data.cells.size());
  for (std::size_t at = 0; at < data.cells.size(); ++at) {
    const std::vector<SignedIndex> ridge =
        facet_vertices(std::span(data.cells).subspan(at - at % corners, corners), at % corners);
    ridges.insert(ridges.end(), ridge.begin(), ridge.end());
    signs.push_back((at % corners % 2 == 1) != is_odd(ridge) ? -1 : 1);
  }
  const SortedRows rows(ridges, corners - 1);
  const std::vector<std::size_t>& order = rows.order();
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    cancellation_point();
    std::ptrdiff_t sum = 0;
    for (last = first; last < order.size() && std::ranges::equal(rows[order[first]], rows[order[last]]);
         ++last)
      sum += signs[order[last]];
    const std::size_t count = last - first, cell = order[first] / corners;
    if (count % 2 != 0)
      throw Violation{fmt::format("the boundary is open: {} of the facets have the face {}, as cell {} does",
                                  count, braces(rows[order[first]]), cell),
                      {cell}};
    if (oriented && sum != 0)
      throw Violation{
          fmt::format("the facets with the face {}, as cell {}, are not oriented to enclose anything",
                      braces(rows[order[first]]), cell),
          {cell}};
  }
}

CheckReport check_boundary_levels(const ComplexData& data, const CheckOptions& options, unsigned threads) {
  CheckReport report = run_levels(
      levels_of_boundary, options,
      [&](CheckReport&) {
        check_kind(data);
        check_storage(data, true, threads);
      },
      [&](CheckReport&) {
        if (data.affine_dimension >= 0) check_closed(data, options.oriented);
      });
  report.not_examined = "which facets belong to it: the data do not hold the cells and the radius";
  return report;
}

/// The report on data whose kind does not fit their arrays.
std::optional<CheckReport> check_fit(const ComplexData& data, const CheckOptions& options) {
  CheckOptions first = options;
  first.up_to = std::min(options.up_to, 1);
  CheckReport report =
      run_levels(std::span(check_levels(data.kind)).first(1), first, [&](CheckReport&) { check_kind(data); });
  return report.ok ? std::nullopt : std::optional(std::move(report));
}

void require_options(const ComplexData& data, const CheckOptions& options) {
  const DataKind kind = data.kind;
  const std::string what(description_of(kind));
  if (options.furthest_site && kind != DataKind::unknown && kind != DataKind::furthest_site)
    throw Error(Errc::invalid_argument, "the data say that they are " + what +
                                            "; furthest_site is for data that do not say what they are");
  const bool has_ties = kind == DataKind::unknown || kind == DataKind::delaunay ||
                        kind == DataKind::regular || kind == DataKind::furthest_site ||
                        kind == DataKind::alpha_complex || kind == DataKind::trimmed || data.is_periodic();
  if (options.canonical && !has_ties)
    throw Error(Errc::invalid_argument,
                "the data say that they are " + what + "; canonical is for triangulations and parts of them");
}

}  // namespace
}  // namespace internal

CheckReport check(const ComplexData& data, const CheckOptions& options, const Execution& how) {
  const ArithmeticScope arithmetic;
  using namespace internal;
  const ProgressMeter meter(how.progress);
  require_options(data, options);
  if (std::optional<CheckReport> wrong = check_fit(data, options)) return *std::move(wrong);
  switch (data.kind) {
    case DataKind::alpha_complex:
    case DataKind::trimmed:
      return check_part_levels(data, options, how.threads);
    case DataKind::alpha_boundary:
      return check_boundary_levels(data, options, how.threads);
    case DataKind::periodic_delaunay:
    case DataKind::periodic_regular:
      return check_periodic(data, options);
    case DataKind::hull_boundary: {
      CheckOptions of_hull;
      of_hull.up_to = options.up_to;
      return check(as_hull(data), of_hull, how);
    }
    case DataKind::lower_hull:
    case DataKind::upper_hull:
      // The sizes first: what is made of them relies on them.
      if (data.points.size() % static_cast<std::size_t>(data.dimension) == 0)
        return check_lifted(over_compositions(data), options, how.threads, Lift::heights,
                            check_levels(data.kind));
      break;
    default:
      break;
  }
  const bool furthest = options.furthest_site || data.kind == DataKind::furthest_site;
  return check_lifted(data, options, how.threads, furthest ? Lift::inverted : Lift::paraboloid,
                      check_levels(furthest ? DataKind::furthest_site : data.kind));
}

}  // namespace delone
