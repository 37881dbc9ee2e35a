// SPDX-License-Identifier: BSD-3-Clause
// Thresholds from the distances of points. Those that are cached hold in the whole box, and bound a cell by its sphere; of flat
// cells, as among points of a surface, they say too little near the cell, where nearly all queries are. Proofs:
// docs/predicates.md, "Near a cell".
#pragma once

#include "geometry/functionals.hpp"

#include <algorithm>
#include <cmath>

namespace delone::geometry {

template <int K, bool Lifted>
auto Functionals<K, Lifted>::distances(Index cell, const double* rows, const double* row, int excluded) const -> Distances
    requires(Lifted) {
  const double image_error = 3 * 0x1p-53 * k();
  const Index* vertices = memory_.links(cell);
  Distances result;
  for (int i = 0; i <= k(); ++i) {
    if (i == excluded || vertices[i] == index(infinite_vertex)) continue;
    const double* vertex = rows + static_cast<std::size_t>(vertices[i]) * (static_cast<std::size_t>(k()) + 1);
    double square = 0;
    for (int r = 0; r < k(); ++r) square += (vertex[r] - row[r]) * (vertex[r] - row[r]);
    const double distance = std::sqrt(square) + image_error;
    result.product *= distance;
    result.inverse_sum += 1 / distance;
  }
  return result;
}

template <int K, bool Lifted>
[[gnu::noinline]] double Functionals<K, Lifted>::threshold_at(Index cell, const double* rows, const double* row) const
    requires(Lifted) {
  const std::uint64_t bits = packed(cell);
  const Distances from_row = distances(cell, rows, row);
  const double spread = from_row.product * from_row.inverse_sum / certificate::determinant(bits);
  const double bound = (certificate::error(bits) * spread + evaluation_error_ * magnitude(cell)) * (1 + 0x1p-30);
  return from_row.are_usable() && bound < threshold(cell) ? bound : threshold(cell);
}

template <int K, bool Lifted>
bool Functionals<K, Lifted>::sharpen(Index cell, int apex, const double* rows) requires(Lifted) {
  constexpr double gain = 16;  // what elimination may gain before it is worth its time
  const std::uint64_t bits = packed(cell);
  const double* row = rows + static_cast<std::size_t>(memory_.links(cell)[apex]) * (static_cast<std::size_t>(k()) + 1);
  const Distances edges = distances(cell, rows, row, apex);
  const double spread =
      1 + 4.5 * std::sqrt(static_cast<double>(k())) * edges.product * edges.inverse_sum / certificate::determinant(bits);
  const double rounding = evaluation_error_ * magnitude(cell);
  const double bound = certificate::error(bits) * spread + rounding;
  if (!edges.are_usable() || !(certificate::error(bits) <= gain * rounding)) return false;
  if (bound < threshold(cell)) record(cell)[k() + 1] = std::bit_cast<double>(certificate::with_threshold(bits, bound));
  return true;
}

template <int K, bool Lifted>
[[gnu::noinline]] std::span<const std::uint32_t> Functionals<K, Lifted>::combine_near(
    StarTask task, std::span<std::uint32_t> weak) requires(Lifted) {
  const auto row = [&](Index vertex) {
    return task.rows + static_cast<std::size_t>(vertex) * (static_cast<std::size_t>(k()) + 1);
  };
  // Of two infinite cells, errors of coefficients count.
  const auto first_finite = std::partition(weak.begin(), weak.end(), [&](std::uint32_t f) {
    return is_infinite(task.facets[f].dead) && is_infinite(task.facets[f].survivor);
  });
  const auto num_infinite = static_cast<std::size_t>(first_finite - weak.begin());
  const std::span<std::uint32_t> finite = weak.subspan(num_infinite);
  for (std::size_t i = 0; i < finite.size(); ++i) {
    const HorizonFacet& facet = task.facets[finite[i]];
    double a = threshold_at(facet.dead, task.rows, task.query_row);
    double b = threshold_at(facet.survivor, task.rows, task.query_row);
    if (is_infinite(facet.dead))
      a = std::max(a, threshold_at(facet.dead, task.rows, row(facet.survivor_opposite)));
    else
      b = std::max(b, threshold_at(facet.survivor, task.rows, row(facet.dead_opposite)));
    near_facets_[i] = facet;
    near_thresholds_[2 * i] = a;
    near_thresholds_[2 * i + 1] = b;
  }
  task.facets = {near_facets_.data(), finite.size()};
  task.thresholds = near_thresholds_.data();
  task.weakest = std::numeric_limits<double>::infinity();
  task.weak = still_weak_.data();
  const std::size_t num_uncertified = combine_star(task);
  std::size_t num_weak = 0, next = 0;
  for (std::size_t i = 0; i < finite.size(); ++i) {
    const bool is_certified = next == num_uncertified || still_weak_[next] != i;
    if (!is_certified) ++next;
    if (!is_certified || !sharpen(near_facets_[i].created, near_facets_[i].slot, task.rows)) finite[num_weak++] = finite[i];
  }
  return weak.first(num_infinite + num_weak);
}

}  // namespace delone::geometry
