// SPDX-License-Identifier: BSD-3-Clause
// With the barycentric coordinates λ_i of a cell as affine functions of the image X, its functional is h = ℓ − Σ ℓ_i·λ_i(X), ℓ
// the lift; it is positive outside its sphere. The spheres through facet i are the members h + t·λ_i of a pencil, and a vertex
// p beyond the facet, where λ_i < 0, is on that of t = h(p)/−λ_i(p). The cell beyond has the vertex with the least t.
//
// In binary32 each t is replaced by something that is hardly ever above it; vertices that may have the least t, seldom more
// than one, are computed again in binary64.
#include "geometry/facet_search.hpp"

#include "geometry/cache_line.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/facet_search.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#ifndef DELONE_FACET_SEARCH
#define DELONE_FACET_SEARCH
namespace delone::geometry {

/// Vertices are in blocks of as many, the images' first entries side by side, then the second ones, …, then the lifts.
constexpr std::size_t block = 16;
/// The height of vertices that are not to be met: those of the cell itself, and those that fill the last block. So is their
/// ratio.
constexpr float out_of_reach = std::numeric_limits<float>::infinity();
constexpr float largest_ratio = std::numeric_limits<float>::max();
/// What may be wrong with a ratio because it is computed with an approximate reciprocal, relatively.
constexpr float coarseness = 0x1p-7f;

/// The least ratios are kept of so many blocks together, one in each lane: a stretch.
constexpr std::size_t stretch_blocks = 4;

/// So many blocks are looked at for all facets of a batch before the next ones are: in 7D and 8D their 16 or 18 kB, and the
/// heights of a cell, stay in a first-level cache of 32 kB.
constexpr std::size_t tile_blocks = 32;
static_assert(tile_blocks % stretch_blocks == 0);

/// Vertices whose ratio is no more than that may have the least one.
constexpr float bound_of(float least) { return least + 3 * coarseness * (least < 0 ? -least : least); }

/// All that one dispatched call works on.
struct SearchTask {
  int k;
  std::size_t num_blocks;
  const float* images;
  float* heights;  ///< h at the vertices of a tile
  std::span<const OpenCell> cells;
  const float* height_functions;  ///< of each cell, k + 1 numbers
  std::span<SoughtFacet> facets;  ///< in the order of their cells
};

}  // namespace delone::geometry
#endif

HWY_BEFORE_NAMESPACE();
namespace delone::geometry {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// An affine function, its coefficients in all lanes. K is k, or 0 for any: then they are loaded where they are needed.
template <int K, class D>
class InLanes {
 public:
  using V = hn::Vec<D>;

  InLanes(D d, const SearchTask& task, Affine function)
      : d_(d), k_(static_cast<std::size_t>(K > 0 ? K : task.k)), from_(function), constant_(hn::Set(d, function[k_])) {
    for (std::size_t r = 0; r < K; ++r) kept_[r] = hn::Set(d, function[r]);
  }

  /// The values at the vertices of a block, or part of one, from this image on.
  HWY_INLINE V values(const float* image) const { return sum(hn::Mul(hn::Load(d_, image), coefficient(0)), image); }
  /// The same and the lifts.
  HWY_INLINE V heights(const float* image) const {
    return sum(hn::MulAdd(hn::Load(d_, image), coefficient(0), hn::Load(d_, image + k_ * block)), image);
  }

 private:
  HWY_INLINE V coefficient(std::size_t r) const { return K > 0 ? kept_[r] : hn::Set(d_, from_[r]); }
  HWY_INLINE V sum(V even, const float* image) const {
    V odd = constant_;
    for (std::size_t r = 1; r < k_; ++r) {
      V& sum = r % 2 == 0 ? even : odd;
      sum = hn::MulAdd(hn::Load(d_, image + r * block), coefficient(r), sum);
    }
    return hn::Add(even, odd);
  }

  D d_;
  std::size_t k_;
  Affine from_;
  V constant_;
  V kept_[K > 0 ? K : 1];
};

/// Writes the values of an affine function plus the lift at the vertices of the blocks from `first` on, but for those of the
/// cell. K is k, or 0 for any.
template <int K>
void write_heights(const SearchTask& task, std::size_t first, std::size_t end, std::size_t cell, float* HWY_RESTRICT heights) {
  const hn::CappedTag<float, block> d;
  const auto k = static_cast<std::size_t>(K > 0 ? K : task.k);
  const InLanes<K, decltype(d)> function(d, task, task.height_functions + cell * (k + 1));
  const float* HWY_RESTRICT images = task.images;
  for (std::size_t start = first; start < end; start += stretch_blocks)
#pragma GCC unroll 4
    for (std::size_t b = start; b < start + stretch_blocks; ++b)
      for (std::size_t lane = 0; lane < block; lane += hn::Lanes(d))
        hn::Store(function.heights(images + b * block * (k + 1) + lane), d, heights + (b - first) * block + lane);
  for (std::size_t i = 0; i <= k; ++i) {
    const std::size_t place = task.cells[cell].vertices[i] - 1 - first * block;  // wraps where it is less than 0
    if (place < (end - first) * block) heights[place] = out_of_reach;
  }
}

/// Heights over the values of an affine function where that is positive.
template <int K>
class Ratios {
 public:
  using D = hn::CappedTag<float, block>;
  using V = hn::Vec<D>;

  Ratios(const SearchTask& task, const SoughtFacet& facet)
      : k_(static_cast<std::size_t>(K > 0 ? K : task.k)), images_(task.images), function_(D(), task, facet.beyond) {}

  /// Of the vertices of a block, or part of one.
  HWY_INLINE V at(std::size_t b, std::size_t lane, const float* heights) const {
    const V value = function_.values(images_ + b * block * (k_ + 1) + lane);
    const V ratio = hn::Mul(hn::Load(D(), heights + lane), hn::ApproximateReciprocal(value));
    return hn::IfThenElse(hn::Gt(value, hn::Zero(D())), ratio, hn::Set(D(), out_of_reach));
  }

 private:
  std::size_t k_;
  const float* images_;
  InLanes<K, D> function_;
};

/// Which of the lanes are at most the bound: a bit for each.
HWY_INLINE std::uint64_t lanes_below(hn::Vec<hn::CappedTag<float, block>> x, float bound) {
  const hn::CappedTag<float, block> d;
  std::uint8_t bytes[8] = {};  // written in whole words
  hn::StoreMaskBits(d, hn::Le(x, hn::Set(d, bound)), bytes);
  return hn::MaxLanes(d) > 8 ? bytes[0] | std::uint64_t{bytes[1]} << 8 : bytes[0];
}

/// Lists the vertices of a stretch whose ratios are at most the bound, as far as there is room, and counts them. heights: of
/// the stretch. There is no branch that cannot be predicted if it is one vertex.
template <int K>
HWY_INLINE void list_below(const Ratios<K>& ratios, std::size_t start, const float* heights, float bound,
                           std::span<std::uint32_t> list, std::size_t& count) {
  std::uint64_t below = 0;
  static_assert(stretch_blocks * block == 64);
  for (std::size_t i = 0; i < 64; i += hn::Lanes(typename Ratios<K>::D()))
    below |= lanes_below(ratios.at(start + i / block, i % block, heights + i / block * block), bound) << i;
  for (; below != 0; below &= below - 1, ++count)
    if (count < list.size())
      list[count] = static_cast<std::uint32_t>(start * block) + static_cast<std::uint32_t>(std::countr_zero(below));
}

/// Brings the least ratio of a facet up to date, and lists the vertices of a tile that may have it.
template <int K>
void search_tile(const SearchTask& task, std::size_t first, std::size_t end, SoughtFacet& facet) {
  const typename Ratios<K>::D d;
  using V = typename Ratios<K>::V;
  const Ratios<K> ratios(task, facet);
  const float* HWY_RESTRICT heights = task.heights;
  HWY_ALIGN float minima[tile_blocks / stretch_blocks * block];
  V least = hn::Set(d, out_of_reach);
  for (std::size_t start = first; start < end; start += stretch_blocks)
    for (std::size_t lane = 0; lane < block; lane += hn::Lanes(d)) {
      V least_of_stretch = hn::Set(d, out_of_reach);
#pragma GCC unroll 4
      for (std::size_t b = start; b < start + stretch_blocks; ++b)
        least_of_stretch = hn::Min(least_of_stretch, ratios.at(b, lane, heights + (b - first) * block));
      hn::Store(least_of_stretch, d, minima + (start - first) / stretch_blocks * block + lane);
      least = hn::Min(least, least_of_stretch);
    }
  const float least_of_tile = hn::GetLane(hn::MinOfLanes(d, least));
  facet.least = std::min(facet.least, least_of_tile);
  const float bound = std::min(bound_of(facet.least), largest_ratio);
  if (!(least_of_tile <= bound)) return;
  std::uint64_t stretches = 0;  // that have vertices to be listed
  static_assert(tile_blocks / stretch_blocks <= 64);
  for (std::size_t i = 0; i < (end - first) / stretch_blocks; ++i) {
    auto lowest = hn::Load(d, minima + i * block);
    for (std::size_t lane = hn::Lanes(d); lane < block; lane += hn::Lanes(d))
      lowest = hn::Min(lowest, hn::Load(d, minima + i * block + lane));
    stretches |= std::uint64_t{!hn::AllFalse(d, hn::Le(lowest, hn::Set(d, bound)))} << i;
  }
  for (; stretches != 0; stretches &= stretches - 1) {
    const auto start = static_cast<std::size_t>(std::countr_zero(stretches)) * stretch_blocks;
    list_below<K>(ratios, first + start, heights + start * block, bound, facet.listed, facet.num_listed);
  }
}

template <int K>
void search_tiles(const SearchTask& task) {
  for (std::size_t first = 0; first < task.num_blocks; first += tile_blocks) {
    const std::size_t end = std::min(first + tile_blocks, task.num_blocks);
    std::size_t facet = 0;
    for (std::size_t cell = 0; cell < task.cells.size(); ++cell) {
      write_heights<K>(task, first, end, cell, task.heights);
      for (; facet < task.facets.size() && task.facets[facet].cell == cell; ++facet)
        search_tile<K>(task, first, end, task.facets[facet]);
    }
  }
}

/// Lists all vertices whose ratio is at most the bound; returns how many there are.
template <int K>
std::size_t list_all(const SearchTask& task, const SoughtFacet& facet, float bound, std::span<std::uint32_t> list) {
  const Ratios<K> ratios(task, facet);
  std::size_t count = 0;
  for (std::size_t first = 0; first < task.num_blocks; first += tile_blocks) {
    const std::size_t end = std::min(first + tile_blocks, task.num_blocks);
    write_heights<K>(task, first, end, facet.cell, task.heights);
    for (std::size_t start = first; start < end; start += stretch_blocks)
      list_below<K>(ratios, start, task.heights + (start - first) * block, bound, list, count);
  }
  return count;
}

/// Calls f with k as a constant where there is code of its own for it, or 0.
template <class F>
auto with_k(int k, F&& f) {
  switch (k) {
    case 7:
      return f(std::integral_constant<int, 7>());
    case 8:
      return f(std::integral_constant<int, 8>());
    default:
      return f(std::integral_constant<int, 0>());
  }
}

void search_here(const SearchTask& task) {
  with_k(task.k, [&](auto k) { search_tiles<k()>(task); });
}
std::size_t list_here(const SearchTask& task, const SoughtFacet& facet, float bound, std::span<std::uint32_t> list) {
  return with_k(task.k, [&](auto k) { return list_all<k()>(task, facet, bound, list); });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::geometry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::geometry {

HWY_EXPORT(search_here);
HWY_EXPORT(list_here);

FacetSearch::FacetSearch(int k, const double* rows, Index num_vertices, Arbiter arbiter)
    : k_(k),
      rows_(rows),
      num_vertices_(num_vertices),
      num_blocks_((num_vertices + block * stretch_blocks - 1) / (block * stretch_blocks) * stretch_blocks),
      arbiter_(std::move(arbiter)) {
  const auto width = static_cast<std::size_t>(k) + 1;
  storage_.resize(num_blocks_ * block * width + tile_blocks * block + cache_line_of<float>);
  scratch_.resize(simplex_scratch(k) + cache_line_of<double>);
  list_.resize(num_blocks_ * block);
  float* const images = at_cache_line(storage_.data());
  for (std::size_t b = 0; b < num_blocks_; ++b)
    for (std::size_t lane = 0; lane < block; ++lane) {
      const std::size_t v = b * block + lane + 1;
      for (std::size_t r = 0; r < width; ++r) {
        const float filling = r + 1 < width ? 0 : out_of_reach;
        images[(b * width + r) * block + lane] = v <= num_vertices ? static_cast<float>(rows[v * width + r]) : filling;
      }
      if (v <= num_vertices) largest_lift_ = std::max(largest_lift_, std::fabs(rows[v * width + width - 1]));
    }
}

bool FacetSearch::first_cell(Index* vertices) const {
  const auto k = static_cast<std::size_t>(k_), width = k + 1;
  const auto row = [&](Index v) { return rows_ + v * width; };
  // A functional that is nowhere negative: at first the lift less the least lift. It is turned about the vertices where it is 0
  // until there is another.
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

bool FacetSearch::find_apexes(std::span<const OpenCell> cells, Index* apexes) {
  const auto k = static_cast<std::size_t>(k_), width = k + 1;
  double* const functions = at_cache_line(scratch_.data());
  std::array<const Index*, batch_size> simplices;
  std::transform(cells.begin(), cells.end(), simplices.begin(), [](const OpenCell& cell) { return cell.vertices; });
  solve_simplices({k_, {simplices.data(), cells.size()}, rows_, functions});

  float* const images = at_cache_line(storage_.data());
  float* const heights = images + num_blocks_ * block * width;
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
    const auto coefficient = [&](std::size_t f, std::size_t r) { return lane_entry(functions, f * width + r, lane); };
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
      facet.num_listed = 0;
    }
  }
  const SearchTask task{k_, num_blocks_, images, heights, cells, height_functions, facets};
  HWY_DYNAMIC_DISPATCH(search_here)(task);

  for (const SoughtFacet& facet : facets) {
    const std::optional<Index> apex = settle(task, facet, functions, scales[facet.cell]);
    if (!apex) return false;
    apexes[facet.cell * width + facet.slot] = *apex;
  }
  return true;
}

/// The apex, in binary64 or by the arbiter.
std::optional<Index> FacetSearch::settle(const SearchTask& task, const SoughtFacet& facet, double* functions,
                                         const Scale& scale) {
  const auto k = static_cast<std::size_t>(k_), width = k + 1;
  ++num_settled_;
  if (facet.least > largest_ratio) return index(infinite_vertex);
  if (!std::isfinite(facet.least)) return std::nullopt;  // the cell is too flat for binary32
  const auto coefficient = [&](std::size_t f, std::size_t r) { return lane_entry(functions, f * width + r, facet.cell); };
  // Barycentric coordinates magnify rounding errors at the vertices.
  const double unit = 8 * 0x1p-53 * scale.spread;
  const double height_error = unit * scale.height, error = unit * scale.slots[facet.slot];
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Candidate best;
  bool is_listed = facet.num_listed <= facet.listed.size();
  for (float bound = bound_of(facet.least);; is_listed = false) {
    const std::size_t num_listed =
        is_listed ? facet.num_listed : HWY_DYNAMIC_DISPATCH(list_here)(task, facet, bound, {list_.data(), list_.size()});
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
    // Whatever has a lesser ratio than the best is in the list if the bound is clear of that.
    const double needed = best.high + coarseness * std::fabs(best.high);
    if (needed <= bound || bound >= largest_ratio) break;
    bound = std::nextafter(static_cast<float>(std::min<double>(needed + coarseness * std::fabs(needed), largest_ratio)),
                           largest_ratio);
  }
  std::erase_if(candidates_, [&](const Candidate& c) { return c.low > best.high; });
  if (candidates_.size() <= 1 && best.high < infinity) return best.vertex;
  contenders_.clear();
  for (const Candidate& c : candidates_) contenders_.push_back(c.vertex);
  // Where vertices are close to many spheres insertion is not slower.
  num_asked_ += contenders_.size();
  if (num_asked_ > 1000 + num_settled_ / 4) return std::nullopt;
  return arbiter_(task.cells[facet.cell].vertices, static_cast<int>(facet.slot), contenders_);
}

}  // namespace delone::geometry
#endif
