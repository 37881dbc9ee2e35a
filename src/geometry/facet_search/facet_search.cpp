// SPDX-License-Identifier: BSD-3-Clause
// With the barycentric coordinates λ_i of a cell as affine functions of the image X, its functional is h = ℓ
// − Σ ℓ_i·λ_i(X), ℓ the lift; it is positive outside the cell's sphere. The spheres through facet i are the
// members h + t·λ_i of a pencil. A vertex p beyond the facet, where λ_i < 0, is on the member of t =
// h(p)/−λ_i(p). The cell beyond has the vertex with the least t.
//
// In binary32 (`tile_search.cpp`) h is replaced by something that is hardly ever above it, −λ_i by something
// hardly ever below it. The few vertices, mostly one, that may have the least ratio of the two are computed
// again in binary64.
#include "geometry/facet_search/facet_search.hpp"

#include "base/platform.hpp"
#include "geometry/cache_line.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::geometry {

namespace {

/// As many blocks as fit the L1 cache, with the heights of a cell.
std::size_t blocks_of_a_tile() {
  static const bool is_large = platform::first_level_cache() >= 48 << 10;
  return is_large ? most_tile_blocks : most_tile_blocks / 2;
}

}  // namespace

FacetSearch::FacetSearch(int k, const double* rows, Index num_vertices, Arbiter arbiter)
    : k_(k),
      rows_(rows),
      num_vertices_(num_vertices),
      num_blocks_((num_vertices + block * most_together - 1) / (block * most_together) * most_together),
      arbiter_(std::move(arbiter)) {
  const auto width = static_cast<std::size_t>(k) + 1;
  images_.resize(num_blocks_ * block * width + cache_line_of<float>);
  heights_.resize(most_tile_blocks * block + cache_line_of<float>);
  scratch_.resize(simplex_scratch(k) + cache_line_of<double>);
  list_.resize(num_blocks_ * block);
  float* const images = at_cache_line(images_.data());
  for (std::size_t b = 0; b < num_blocks_; ++b)
    for (std::size_t lane = 0; lane < block; ++lane) {
      const std::size_t v = b * block + lane + 1;
      for (std::size_t r = 0; r < width; ++r) {
        const float filling = r + 1 < width ? 0 : out_of_reach;
        images[(b * width + r) * block + lane] =
            v <= num_vertices ? static_cast<float>(rows[v * width + r]) : filling;
      }
      if (v <= num_vertices) largest_lift_ = std::max(largest_lift_, std::fabs(rows[v * width + width - 1]));
    }
}

bool FacetSearch::first_cell(Index* vertices) const {
  const auto k = static_cast<std::size_t>(k_), width = k + 1;
  const auto row = [&](Index v) { return rows_ + v * width; };
  // A functional that is nowhere negative, at first the lift less the least lift. It is turned about the
  // vertices where it is 0 until it vanishes at another one.
  Index lowest = 1;
  for (Index v = 2; v <= num_vertices_; ++v)
    if (row(v)[k] < row(lowest)[k]) lowest = v;
  std::vector<double> functional(width, 0.0), normal(k);
  functional[k] = -row(lowest)[k];
  std::vector<std::vector<double>> basis;  // orthonormal, of the span of the edges
  const auto without_basis = [&](std::vector<double>& x) {
    for (const auto& b : basis) {
      double along = 0;
      for (std::size_t r = 0; r < k; ++r) along += b[r] * x[r];
      for (std::size_t r = 0; r < k; ++r) x[r] -= along * b[r];
    }
    double square = 0;
    for (const double c : x) square += c * c;
    return std::sqrt(square);
  };
  vertices[0] = lowest;
  for (std::size_t found = 1; found <= k; ++found) {
    double longest = 0;
    for (std::size_t axis = 0; axis < k; ++axis) {
      std::vector<double> direction(k, 0.0);
      direction[axis] = 1;
      const double length = without_basis(direction);
      if (length > longest) {
        longest = length;
        normal = direction;
      }
    }
    Index best = invalid_index;
    double least = std::numeric_limits<double>::infinity();
    for (const double side : {1.0, -1.0}) {
      if (best != invalid_index) break;
      for (Index v = 1; v <= num_vertices_; ++v) {
        if (std::find(vertices, vertices + found, v) != vertices + found) continue;
        double beyond = 0, height = row(v)[k] + functional[k];
        for (std::size_t r = 0; r < k; ++r) {
          beyond -= side * normal[r] * (row(v)[r] - row(lowest)[r]);
          height += functional[r] * row(v)[r];
        }
        if (beyond > 1e-9 && height < least * beyond) {
          least = height / beyond;
          best = v;
        }
      }
      if (best == invalid_index) continue;
      for (std::size_t r = 0; r < k; ++r) {
        functional[r] += least * side * normal[r];
        functional[k] -= least * side * normal[r] * row(lowest)[r];
      }
    }
    if (best == invalid_index) return false;
    vertices[found] = best;
    std::vector<double> edge(k);
    for (std::size_t r = 0; r < k; ++r) edge[r] = row(best)[r] - row(lowest)[r];
    const double length = without_basis(edge);
    for (double& c : edge) c /= length;
    basis.push_back(std::move(edge));
  }
  return true;
}

bool FacetSearch::find_apexes(std::span<const cells::OpenCell> cells, Index* apexes,
                              cells::ComparisonLimit& limit) {
  const auto k = static_cast<std::size_t>(k_), width = k + 1;
  double* const functions = at_cache_line(scratch_.data());
  std::array<const Index*, batch_size> simplices;
  std::transform(cells.begin(), cells.end(), simplices.begin(),
                 [](const cells::OpenCell& cell) { return cell.vertices; });
  solve_simplices({k_, {simplices.data(), cells.size()}, rows_, functions});

  float* const images = at_cache_line(images_.data());
  const std::size_t most_facets = batch_size * width;
  std::array<Scale, batch_size> scales;
  functions_.resize((batch_size + most_facets) * width);
  float* const height_functions = functions_.data();
  std::vector<SoughtFacet>& facets = facets_;
  facets.clear();
  std::array<std::array<double, simplex_lanes>, 33> magnitudes;
  for (std::size_t f = 0; f <= width; ++f) {
    magnitudes[f] = {};
    for (std::size_t r = 0; r <= k; ++r)
      for (std::size_t lane = 0; lane < simplex_lanes; ++lane)
        magnitudes[f][lane] += std::fabs(lane_entry(functions, f * width + r, lane));
  }
  for (std::size_t lane = 0; lane < cells.size(); ++lane) {
    const auto coefficient = [&](std::size_t f, std::size_t r) {
      return lane_entry(functions, f * width + r, lane);
    };
    Scale& scale = scales[lane];
    scale.spread = 0;
    for (std::size_t f = 0; f <= k; ++f) scale.spread += scale.slots[f] = magnitudes[f][lane];
    scale.height = magnitudes[width][lane] + largest_lift_;
    const double unit = static_cast<double>(k) * 0x1p-24;
    float* const h = height_functions + lane * width;
    for (std::size_t r = 0; r <= k; ++r) h[r] = static_cast<float>(coefficient(width, r));
    h[k] -= static_cast<float>(unit * scale.height);
    for (std::uint32_t open = cells[lane].open_slots; open != 0; open &= open - 1) {
      const auto slot = static_cast<std::size_t>(std::countr_zero(open));
      float* const beyond = functions_.data() + (batch_size + facets.size()) * width;
      for (std::size_t r = 0; r <= k; ++r) beyond[r] = -static_cast<float>(coefficient(slot, r));
      beyond[k] += static_cast<float>(unit * scale.slots[slot]);
      SoughtFacet& facet = facets.emplace_back();
      facet.cell = lane;
      facet.slot = slot;
      facet.beyond = beyond;
      facet.least = out_of_reach;
      facet.listed_up_to = largest_ratio;
      facet.num_listed = 0;
    }
  }
  const SearchTask task{k_,    num_blocks_,      images, blocks_of_a_tile(), at_cache_line(heights_.data()),
                        cells, height_functions, facets};
  search_tiles(task);

  for (const SoughtFacet& facet : facets) {
    const std::optional<Index> apex = settle(task, facet, functions, scales[facet.cell], limit);
    if (!apex) return false;
    apexes[facet.cell * width + facet.slot] = *apex;
  }
  return true;
}

std::optional<Index> FacetSearch::settle(const SearchTask& task, const SoughtFacet& facet, double* functions,
                                         const Scale& scale, cells::ComparisonLimit& limit) {
  const auto k = static_cast<std::size_t>(k_), width = k + 1;
  if (!(scale.spread < largest_spread && scale.height < largest_spread)) return std::nullopt;
  if (facet.num_listed == 0) return index(infinite_vertex);
  const auto coefficient = [&](std::size_t f, std::size_t r) {
    return lane_entry(functions, f * width + r, facet.cell);
  };
  // Rounding errors at the vertices are magnified by the barycentric coordinates.
  const double unit = 8 * 0x1p-53 * scale.spread;
  const double height_error = unit * scale.height, error = unit * scale.slots[facet.slot];
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Candidate best;
  bool is_listed = facet.num_listed <= facet.listed.size();
  for (float bound = facet.listed_up_to;; is_listed = false) {
    const std::size_t num_listed =
        is_listed ? facet.num_listed : list_up_to(task, facet, bound, {list_.data(), list_.size()});
    const std::uint32_t* const listed = is_listed ? facet.listed.data() : list_.data();
    best = {index(infinite_vertex), 0, infinity};
    candidates_.clear();
    for (std::size_t c = 0; c < num_listed; ++c) {
      const Index v = static_cast<Index>(listed[c]) + 1;
      const double* const row = rows_ + v * width;
      double height = row[k] + coefficient(width, k), beyond = -coefficient(facet.slot, k);
      for (std::size_t r = 0; r < k; ++r) {
        height += coefficient(width, r) * row[r];
        beyond -= coefficient(facet.slot, r) * row[r];
      }
      if (beyond < -error) continue;
      const bool is_beyond = beyond > 2 * error;
      candidates_.push_back({v, is_beyond ? (height - height_error) / (beyond + error) : -infinity,
                             is_beyond ? (height + height_error) / (beyond - error) : infinity});
      if (candidates_.back().high < best.high) best = candidates_.back();
    }
    // Whatever has a smaller ratio than the best is in the list if the bound is clear of the best.
    if (best.high <= bound || bound >= largest_ratio) break;
    const auto high = static_cast<float>(std::min<double>(best.high, largest_ratio));
    bound = std::nextafter(bound_of(high), out_of_reach);  // larger than before
  }
  std::erase_if(candidates_, [&](const Candidate& c) { return c.low > best.high; });
  if (candidates_.size() <= 1 && best.high < infinity) return best.vertex;
  contenders_.clear();
  for (const Candidate& c : candidates_) contenders_.push_back(c.vertex);
  if (!limit.allows(contenders_.size())) return std::nullopt;
  return arbiter_(task.cells[facet.cell].vertices, static_cast<int>(facet.slot), contenders_);
}

}  // namespace delone::geometry
