// SPDX-License-Identifier: BSD-3-Clause
#include <delone/arithmetic.hpp>
#include <delone/convex_hulls.hpp>

#include "base/build_limits.hpp"
#include "base/guarded.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "base/require_dimension.hpp"
#include "base/require_finite.hpp"
#include "base/require_tolerance.hpp"
#include "hull/extreme_hull.hpp"
#include "hull/hull_analysis.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

namespace delone {
namespace {

using hull::HullAnalysis;
using hull::HullMeasures;
using hull::HullState;

constexpr std::size_t part = 16;  // sets that a thread takes at once

/// Appends the hull of one set, whose rows begin at first_row.
void append(const hull::ExtremeHull& hull, std::size_t first_row, ConvexHulls& all) {
  const HullState& state = *hull.state;
  const int d = all.dimension, k = state.affine_hull().dimension();
  const HullAnalysis& analysis = *hull.analysis;
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

ConvexHulls none(int dimension) {
  ConvexHulls result;
  result.dimension = dimension;
  result.vertex_offsets = result.cell_offsets = {0};
  return result;
}

template <class T>
void append(const std::vector<T>& more, std::vector<T>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Appends hulls of the next sets.
void append(const ConvexHulls& more, ConvexHulls& all) {
  const std::size_t first_vertex = all.vertices.size(), first_cell = all.cell_offsets.back();
  append(more.affine_dimensions, all.affine_dimensions);
  for (std::size_t i = 1; i < more.vertex_offsets.size(); ++i) {
    all.vertex_offsets.push_back(first_vertex + more.vertex_offsets[i]);
    all.cell_offsets.push_back(first_cell + more.cell_offsets[i]);
  }
  append(more.vertices, all.vertices);
  append(more.cells, all.cells);
  for (const SignedIndex cell : more.neighbors)
    all.neighbors.push_back(cell + static_cast<SignedIndex>(first_cell));
  append(more.equations, all.equations);
  append(more.volumes, all.volumes);
  append(more.areas, all.areas);
}

/// The hull of the rows first … last−1.
hull::ExtremeHull hull_of(std::span<const double> coordinates, int dimension, std::size_t first,
                          std::size_t last, Options options) {
  constexpr std::size_t small = 48;  // sets so small are not worth an order
  if (last - first <= small) options.order = InsertionOrder::as_given;
  const auto d = static_cast<std::size_t>(dimension);
  return hull::find_extreme_hull(coordinates.subspan(first * d, (last - first) * d), dimension, options);
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
  internal::require_dimension(dimension);
  internal::refuse_tolerance(options.tolerance, options.axis_tolerances, "many hulls at once");
  points.require_dimension(dimension);
  const std::span<const double> coordinates = points.coordinates();
  check(coordinates, dimension, offsets);
  return internal::guarded("the hulls", [&] {
    ConvexHulls all = none(dimension);
    Options of_each = options;
    of_each.progress = {};
    of_each.time_limit = 0;
    of_each.memory_limit = 0;
    const std::size_t count = offsets.size() - 1, num_parts = (count + part - 1) / part;
    const unsigned threads = internal::threads_for_parts(options.threads, num_parts);
    if (threads > 1) of_each.threads = 1;
    internal::BuildLimits limits(options.memory_limit, options.time_limit, "sets");
    limits.set_independent();
    internal::ProgressMeter progress(options.progress, count);
    limits.guard([&] {
      std::vector<ConvexHulls> parts(threads > 1 ? num_parts : 0);
      std::atomic<std::size_t> done = 0;
      internal::for_parts(threads, count, part, [&](std::size_t first, std::size_t last, const auto& stop) {
        ConvexHulls made = threads > 1 ? none(dimension) : ConvexHulls();
        for (std::size_t i = first; i < last; ++i) {
          stop();
          append(hull_of(coordinates, dimension, offsets[i], offsets[i + 1], of_each), offsets[i],
                 threads > 1 ? made : all);
          const std::size_t so_far = done.fetch_add(1, std::memory_order_relaxed) + 1;
          if (internal::current_meter != nullptr) progress(so_far);  // no other thread has one
        }
        if (threads > 1) parts[first / part] = std::move(made);
      });
      for (ConvexHulls& one : parts) append(std::exchange(one, {}), all);
    });
    return all;
  });
}

}  // namespace delone
