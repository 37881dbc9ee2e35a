// SPDX-License-Identifier: BSD-3-Clause
#include <delone/arithmetic.hpp>
#include <delone/convex_hulls.hpp>

#include "base/build_limits.hpp"
#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/require_dimension.hpp"
#include "base/require_finite.hpp"
#include "base/require_tolerance.hpp"
#include "hull/extreme_hull.hpp"
#include "hull/hull_analysis.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <string>

namespace delone {
namespace {

using hull::HullAnalysis;
using hull::HullMeasures;
using hull::HullState;

/// Appends the hull of one set, whose rows begin at first_row.
void append(const hull::ExtremeHull& hull, std::size_t first_row, ConvexHulls& all) {
  const HullState& state = *hull.state;
  const int d = all.dimension, k = state.affine_hull().dimension();
  const HullAnalysis analysis(state);
  const auto row = [&](Index site) {
    return static_cast<SignedIndex>(first_row + hull.rows[static_cast<std::size_t>(state.row(site))]);
  };
  all.affine_dimensions.push_back(k);
  const auto first_vertex = static_cast<std::ptrdiff_t>(all.vertices.size());
  const std::vector<char>& is_extreme = analysis.faces().is_extreme;
  for (Index site = 0; site < state.sites().size(); ++site)
    if (k == 0 || is_extreme[site] != 0) all.vertices.push_back(row(site));
  std::sort(all.vertices.begin() + first_vertex, all.vertices.end());
  if (k == d) {
    const compiled::SimplicialHull& boundary = state.hull();
    const auto first_cell = static_cast<SignedIndex>(all.cells.size() / static_cast<std::size_t>(d));
    for (const Index site : boundary.cells) all.cells.push_back(row(site));
    for (const Index cell : boundary.neighbors)
      all.neighbors.push_back(first_cell + static_cast<SignedIndex>(cell));
    HullMeasures measures;
    const std::vector<double> equations = analysis.equations(&measures).equations;
    all.volumes.push_back(measures.volume.value);
    all.areas.push_back(measures.area.value);
    const auto width = static_cast<std::ptrdiff_t>(d + 1);
    for (const Index facet : analysis.faces().facet_of_cell) {
      const auto begin = equations.begin() + static_cast<std::ptrdiff_t>(facet) * width;
      all.equations.insert(all.equations.end(), begin, begin + width);
    }
  } else {
    all.volumes.push_back(0);
    all.areas.push_back(k == d - 1 && k > 0 ? 2 * analysis.measures().volume.value : 0);
  }
  all.vertex_offsets.push_back(all.vertices.size());
  all.cell_offsets.push_back(all.cells.size() / static_cast<std::size_t>(d));
}

void check(std::span<const double> coordinates, int dimension, std::span<const std::size_t> offsets) {
  const auto d = static_cast<std::size_t>(dimension);
  if (coordinates.size() % d != 0)
    throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  if (coordinates.size() / d > max_index) throw Error(Errc::too_many, "more points than this build has ids");
  const bool is_range = !offsets.empty() && offsets.front() == 0 && offsets.back() == coordinates.size() / d;
  const auto bad = std::is_sorted_until(offsets.begin(), offsets.end());
  if (bad != offsets.end())
    throw Error(Errc::invalid_argument,
                "offset " + std::to_string(bad - offsets.begin()) + " is less than the one before it");
  if (!is_range)
    throw Error(Errc::invalid_argument, "the offsets do not begin with 0 and end with the number of points");
  internal::require_finite(coordinates, d, "a coordinate");
}

}  // namespace

ConvexHulls convex_hulls(const AnyPoints<>& points, int dimension, std::span<const std::size_t> offsets,
                         const Options& options) {
  const ArithmeticScope arithmetic;
  // Sets so small are not worth an order.
  constexpr std::size_t small = 48;
  internal::require_dimension(dimension);
  internal::refuse_tolerance(options.tolerance, options.axis_tolerances, "many hulls at once");
  points.require_dimension(dimension);
  const std::span<const double> coordinates = points.coordinates();
  check(coordinates, dimension, offsets);
  return internal::guarded("the hulls", [&] {
    ConvexHulls all;
    all.dimension = dimension;
    all.vertex_offsets = all.cell_offsets = {0};
    Options of_each = options, of_small = options;
    of_each.progress = of_small.progress = {};
    of_each.time_limit = of_small.time_limit = 0;
    of_each.memory_limit = of_small.memory_limit = 0;
    internal::BuildLimits limits(options.memory_limit, options.time_limit, "sets");
    limits.set_independent();
    of_small.order = InsertionOrder::as_given;
    internal::ProgressMeter progress(options.progress, offsets.size() - 1);
    const auto d = static_cast<std::size_t>(dimension);
    limits.guard([&] {
      for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
        const std::size_t n = offsets[i + 1] - offsets[i];
        append(hull::find_extreme_hull(coordinates.subspan(offsets[i] * d, n * d), dimension,
                                       n <= small ? of_small : of_each),
               offsets[i], all);
        progress(i + 1);
      }
    });
    return all;
  });
}

}  // namespace delone
