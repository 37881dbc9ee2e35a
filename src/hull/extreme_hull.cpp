// SPDX-License-Identifier: BSD-3-Clause
#include "hull/extreme_hull.hpp"

#include "hull/box_faces.hpp"
#include "hull/complete_shell.hpp"
#include "hull/point_sieve.hpp"

#include <algorithm>
#include <utility>

namespace delone::hull {
namespace {

void insert(ExtremeHull& hull, std::span<const double> coordinates, std::span<const Index> rows,
            const Options& options) {
  const auto d = static_cast<std::size_t>(hull.state->sites().ambient);
  std::vector<double> points;
  points.reserve(rows.size() * d);
  for (const Index row : rows)
    points.insert(points.end(), coordinates.data() + row * d, coordinates.data() + (row + 1) * d);
  hull.rows.insert(hull.rows.end(), rows.begin(), rows.end());
  hull.state->insert_range(points, options);
}

/// Begins again with the extreme points if another point is a vertex of a cell. Which points are extreme does
/// not depend on the others, so this happens at most once. `before`: a state of the first rows alone, or
/// none; if they are extreme it goes on from there.
void drop_others(ExtremeHull& hull, std::unique_ptr<HullState> before, std::span<const double> coordinates,
                 const Options& options) {
  hull.analysis = std::make_unique<HullAnalysis>(*hull.state);
  const SimplicialHull& boundary = hull.state->hull();
  const std::vector<char>& is_extreme = hull.analysis->faces().is_extreme;
  if (std::all_of(boundary.cells.begin(), boundary.cells.end(),
                  [&](Index site) { return is_extreme[site] != 0; }))
    return;
  ExtremeHull other{std::make_unique<HullState>(hull.state->sites().ambient), {}, {}};
  const std::size_t first = before ? before->sites().size() : 0;
  if (before && before->num_rows() == first &&
      std::find(is_extreme.begin(), is_extreme.begin() + static_cast<std::ptrdiff_t>(first), 0) ==
          is_extreme.begin() + static_cast<std::ptrdiff_t>(first)) {
    other.state = std::move(before);
    other.rows.assign(hull.rows.begin(), hull.rows.begin() + static_cast<std::ptrdiff_t>(first));
  }
  std::vector<Index> rows;
  for (Index site = static_cast<Index>(other.rows.size()); site < is_extreme.size(); ++site)
    if (is_extreme[site] != 0) rows.push_back(hull.rows[static_cast<std::size_t>(hull.state->row(site))]);
  std::sort(rows.begin(), rows.end());
  insert(other, coordinates, rows, options);
  other.analysis = std::make_unique<HullAnalysis>(*other.state);
  hull = std::move(other);
}

}  // namespace

ExtremeHull find_extreme_hull(std::span<const double> coordinates, int dimension, const Options& options) {
  constexpr std::size_t least_rows = 64;
  const std::size_t n = coordinates.size() / static_cast<std::size_t>(dimension);
  ExtremeHull result{std::make_unique<HullState>(dimension), {}, {}};
  PointSieve sieve(coordinates, dimension, 0, options.threads);
  std::unique_ptr<HullState> before;
  if (dimension > 1 && n >= least_rows) {
    const std::vector<char> is_inner = find_inner_rows_of_box_faces(coordinates, dimension, options.threads);
    if (!is_inner.empty()) sieve.remove(is_inner);
    sieve.run();
  }
  if (!sieve.has_shell()) {
    insert(result, coordinates, sieve.remaining_rows(), options);
  } else {
    const bool is_complete = complete_shell(sieve, &before);
    result.rows = sieve.shell_rows();
    result.state = sieve.take_shell();
    if (!is_complete) {
      std::vector<Index> rows = sieve.remaining_rows(), known = result.rows;
      std::sort(known.begin(), known.end());
      std::erase_if(rows, [&](Index row) { return std::binary_search(known.begin(), known.end(), row); });
      insert(result, coordinates, rows, options);
    }
  }
  // With a tolerance it is not these cells that are shown.
  if (options.tolerance == 0) drop_others(result, std::move(before), coordinates, options);
  return result;
}

}  // namespace delone::hull
