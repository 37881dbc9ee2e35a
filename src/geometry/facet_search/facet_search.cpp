// SPDX-License-Identifier: BSD-3-Clause
// With the barycentric coordinates λ_i of a cell as affine functions of the image X, its functional is h = ℓ
// − Σ ℓ_i·λ_i(X), ℓ the lift; it is positive outside its sphere. The spheres through facet i are the members
// h + t·λ_i of a pencil, and a vertex p beyond the facet, where λ_i < 0, is on that of t = h(p)/−λ_i(p). The
// cell beyond has the vertex with the least t.
//
// In binary32 h is replaced by something that is hardly ever above it, −λ_i by something hardly ever below
// it, and their ratio by the difference of their logarithms; vertices that may have the least t, mostly one,
// are computed again in binary64.
#include "geometry/facet_search/facet_search.hpp"

#include "base/compiled_dimension.hpp"
#include "geometry/cache_line.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/facet_search/facet_search.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#ifndef DELONE_FACET_SEARCH
#define DELONE_FACET_SEARCH
namespace delone::geometry {

/// Vertices are in blocks of as many, the images' first entries side by side, then the second ones, …, then
/// the lifts.
constexpr std::size_t block = 16;
/// The number of blocks is a multiple of that: so many may be looked at together.
constexpr std::size_t most_together = 8;

/// A tile is looked at for all facets of a batch before the next one is: in 7D and 8D half of the largest one
/// has 16 or 18 kB.
constexpr std::size_t most_tile_blocks = 64;
static_assert(most_tile_blocks / 2 % most_together == 0);

/// The height of vertices that are not to be met: those of the cell itself, and those that fill the last
/// blocks. So is their ratio.
constexpr float out_of_reach = std::numeric_limits<float>::infinity();
/// Ratios of vertices beyond the facet are less.
constexpr float largest_ratio = 0x1p80f;
/// Vertices whose ratio in binary32 is no more than that may have the least one.
inline float bound_of(float least) { return least + 0x1p-6f * std::fabs(least); }

/// Where all heights are larger, ratios are compared by their keys, the bits of a height less those of a
/// value. Bits of a positive number in binary32 are its logarithm, but for a constant: too small by at most
/// logarithm_error, in units of which there are an octave in a factor of two (log2(1 + m) − m is largest at m
/// = 1/ln 2 − 1; Mitchell, Computer multiplication and division using binary logarithms, 1962,
/// doi:10.1109/TEC.1962.5219391).
constexpr float least_height = 0x1p-40f;
constexpr std::int32_t octave = 1 << 23, logarithm_error = 722'100;  // 0.0860714 octaves
/// The lowest bits of keys are replaced by the place in the tile.
constexpr std::int32_t place_mask = most_tile_blocks * block - 1;
/// Keys of vertices that may have the least ratio are no more than that above the least key: ratio_below() is
/// not less than that ratio then.
constexpr std::int32_t doubt = 2 * (logarithm_error + place_mask);
/// Keys of vertices beyond the facet are less. Those of others are not: bits of heights are at least 87
/// octaves, of infinity 255, those of values at most 167.
constexpr std::int32_t largest_key = 80 * octave;
/// No ratio with a larger key is less than that.
inline float ratio_below(std::int32_t key) {
  return std::exp2(static_cast<float>(key - place_mask - logarithm_error) / octave) * (1 - 0x1p-18f);
}
/// No positive ratio up to this one has a larger key.
inline std::int32_t key_above(float ratio) {
  constexpr std::int32_t bits_of_one = std::bit_cast<std::int32_t>(1.0f);
  return std::bit_cast<std::int32_t>(std::max(ratio, 0.0f)) - bits_of_one +
         2 * (logarithm_error + place_mask);
}

/// Coefficients add up to less, or the cell is too flat for binary32: keys do not overflow.
constexpr double largest_spread = 0x1p40;

/// All that one dispatched call works on.
struct SearchTask {
  int k;
  std::size_t num_blocks;
  const float* images;
  std::size_t tile_blocks;
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

/// So many blocks are looked at together: sums of one after the other would wait for themselves, as a
/// processor does not see far enough ahead. Processors with vectors of 512 bits have twice as many of them.
constexpr std::size_t together =
    hn::MaxLanes(hn::CappedTag<float, block>()) == block ? most_together : most_together / 2;

/// An affine function, its coefficients in all lanes. K is k, or 0 for any: then they are loaded where they
/// are needed.
template <int K, class D>
class InLanes {
 public:
  using V = hn::Vec<D>;

  InLanes(D d, const SearchTask& task, Affine function)
      : d_(d),
        k_(static_cast<std::size_t>(K > 0 ? K : task.k)),
        from_(function),
        constant_(hn::Set(d, function[k_])) {
    for (std::size_t r = 0; r < K; ++r) kept_[r] = hn::Set(d, function[r]);
  }

  /// The values at the vertices of `Count` blocks from this image on, or at some of each.
  template <std::size_t Count>
  HWY_INLINE void values(const float* image, V (&sums)[Count]) const {
    for (V& sum : sums) sum = constant_;
    add_to(sums, image);
  }
  /// The same and the lifts.
  template <std::size_t Count>
  HWY_INLINE void heights(const float* image, V (&sums)[Count]) const {
#pragma GCC unroll 8
    for (std::size_t b = 0; b < Count; ++b)
      sums[b] = hn::Add(hn::Load(d_, image + (b * (k_ + 1) + k_) * block), constant_);
    add_to(sums, image);
  }

 private:
  HWY_INLINE V coefficient(std::size_t r) const { return K > 0 ? kept_[r] : hn::Set(d_, from_[r]); }
  template <std::size_t Count>
  HWY_INLINE void add_to(V (&sums)[Count], const float* image) const {
#pragma GCC unroll 8
    for (std::size_t r = 0; r < k_; ++r)
#pragma GCC unroll 8
      for (std::size_t b = 0; b < Count; ++b)
        sums[b] = hn::MulAdd(hn::Load(d_, image + (b * (k_ + 1) + r) * block), coefficient(r), sums[b]);
  }

  D d_;
  std::size_t k_;
  Affine from_;
  V constant_;
  V kept_[K > 0 ? K : 1];
};

/// Writes the heights at the vertices of a tile. Returns whether all are more than least_height, but for
/// those of the cell. K is k, or 0 for any.
template <int K>
bool write_heights(const SearchTask& task, std::size_t first, std::size_t end, std::size_t cell) {
  const hn::CappedTag<float, block> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto k = static_cast<std::size_t>(K > 0 ? K : task.k);
  const InLanes<K, decltype(d)> function(d, task, task.height_functions + cell * (k + 1));
  const float* HWY_RESTRICT images = task.images;
  float* HWY_RESTRICT heights = task.heights;
  auto minus_low = hn::Zero(di);  // −1 for each that is not
  for (std::size_t start = first; start < end; start += together)
    for (std::size_t lane = 0; lane < block; lane += hn::Lanes(d)) {
      hn::Vec<decltype(d)> of_blocks[together];
      function.heights(images + start * block * (k + 1) + lane, of_blocks);
#pragma GCC unroll 8
      for (std::size_t b = 0; b < together; ++b) {
        hn::Store(of_blocks[b], d, heights + (start + b - first) * block + lane);
        const auto is_low = hn::Le(of_blocks[b], hn::Set(d, least_height));
        minus_low = hn::Add(minus_low, hn::VecFromMask(di, hn::RebindMask(di, is_low)));
      }
    }
  std::int32_t num_low = -hn::GetLane(hn::SumOfLanes(di, minus_low));
  for (std::size_t i = 0; i <= k; ++i) {
    const std::size_t place =
        task.cells[cell].vertices[i] - 1 - first * block;  // wraps where it is less than 0
    if (place >= (end - first) * block) continue;
    num_low -= heights[place] <= least_height;
    heights[place] = out_of_reach;
  }
  return num_low == 0;
}

/// Heights over the values of an affine function, at the vertices of a tile; out of reach where these are not
/// positive.
template <int K>
class Ratios {
 public:
  using D = hn::CappedTag<float, block>;
  using DI = hn::RebindToSigned<D>;

  Ratios(const SearchTask& task, std::size_t first, const SoughtFacet& facet)
      : k_(static_cast<std::size_t>(K > 0 ? K : task.k)),
        images_(task.images + first * block * (k_ + 1)),
        heights_(task.heights),
        facet_(facet),
        task_(task),
        function_(D(), task, facet.beyond) {}

  /// At the vertices of some blocks of the tile or, from a lane on, at some of each.
  HWY_INLINE void ratios(std::size_t start, std::size_t lane, hn::Vec<D> (&ratios)[together]) const {
    hn::Vec<D> values[together];
    function_.values(images_ + start * block * (k_ + 1) + lane, values);
#pragma GCC unroll 8
    for (std::size_t b = 0; b < together; ++b) {
      const auto ratio = hn::Div(hn::Load(D(), heights_ + (start + b) * block + lane), values[b]);
      ratios[b] = hn::IfThenElse(hn::Gt(values[b], hn::Zero(D())), ratio, hn::Set(D(), out_of_reach));
    }
  }
  /// The keys of the ratios; more than largest_key where these are out of reach. REQUIRES that all heights
  /// are more than least_height.
  HWY_INLINE void keys(std::size_t start, std::size_t lane, hn::Vec<DI> (&keys)[together]) const {
    hn::Vec<D> values[together];
    function_.values(images_ + start * block * (k_ + 1) + lane, values);
#pragma GCC unroll 8
    for (std::size_t b = 0; b < together; ++b) {
      const auto height = hn::BitCast(DI(), hn::Load(D(), heights_ + (start + b) * block + lane));
      keys[b] = hn::Sub(height, hn::Max(hn::BitCast(DI(), values[b]), hn::Zero(DI())));
    }
  }
  /// The ratio at one vertex of the tile.
  float ratio(std::size_t vertex) const {
    const hn::CappedTag<float, 1> d;  // rounded like the others
    hn::Vec<decltype(d)> value[1];
    const InLanes<0, decltype(d)> function(d, task_, facet_.beyond);
    function.values(images_ + vertex / block * block * (k_ + 1) + vertex % block, value);
    return hn::GetLane(value[0]) > 0 ? heights_[vertex] / hn::GetLane(value[0]) : out_of_reach;
  }

 private:
  std::size_t k_;
  const float* images_;
  const float* heights_;
  const SoughtFacet& facet_;
  const SearchTask& task_;
  InLanes<K, D> function_;
};

/// A bit for each lane of a mask of as many as a block has at most.
template <class D, class M>
HWY_INLINE std::uint64_t bits_of(D d, M mask) {
  std::uint8_t bytes[8] = {};  // written in whole words
  hn::StoreMaskBits(d, mask, bytes);
  return hn::MaxLanes(d) > 8 ? bytes[0] | std::uint64_t{bytes[1]} << 8 : bytes[0];
}

/// Lists the vertices of a tile whose ratios are at most the bound, as far as there is room, and counts them.
template <int K>
void list_up_to(const Ratios<K>& ratios, std::size_t first, std::size_t end, float bound,
                std::span<std::uint32_t> list, std::size_t& count) {
  const typename Ratios<K>::D d;
  for (std::size_t start = first; start < end; start += together) {
    std::uint64_t listed[together] = {};
    for (std::size_t lane = 0; lane < block; lane += hn::Lanes(d)) {
      hn::Vec<decltype(d)> of_blocks[together];
      ratios.ratios(start - first, lane, of_blocks);
      for (std::size_t b = 0; b < together; ++b)
        listed[b] |= bits_of(d, hn::Le(of_blocks[b], hn::Set(d, bound))) << lane;
    }
    for (std::size_t b = 0; b < together; ++b)
      for (; listed[b] != 0; listed[b] &= listed[b] - 1, ++count)
        if (count < list.size())
          list[count] = static_cast<std::uint32_t>((start + b) * block) +
                        static_cast<std::uint32_t>(std::countr_zero(listed[b]));
  }
}

/// The same for those that may have the least ratio, of which `least` is known not to be less.
template <int K>
void list_least(const Ratios<K>& ratios, std::size_t first, std::size_t end, float least,
                SoughtFacet& facet) {
  facet.least = std::min(facet.least, least);
  const float bound = std::min(bound_of(facet.least), largest_ratio);
  list_up_to<K>(ratios, first, end, bound, facet.listed, facet.num_listed);
  facet.listed_up_to = std::min(facet.listed_up_to, bound);
}

/// Lists the vertices of a tile that may have the least ratio.
template <int K>
void search_tile(const SearchTask& task, std::size_t first, std::size_t end, SoughtFacet& facet) {
  const typename Ratios<K>::D d;
  const Ratios<K> ratios(task, first, facet);
  auto least = hn::Set(d, out_of_reach);
  for (std::size_t start = 0; start < end - first; start += together)
    for (std::size_t lane = 0; lane < block; lane += hn::Lanes(d)) {
      hn::Vec<decltype(d)> of_blocks[together];
      ratios.ratios(start, lane, of_blocks);
      for (const auto& of_block : of_blocks) least = hn::Min(of_block, least);
    }
  list_least<K>(ratios, first, end, hn::GetLane(hn::MinOfLanes(d, least)), facet);
}

/// The same by keys. There is no branch that cannot be predicted if it is one vertex.
template <int K>
void search_tile_by_keys(const SearchTask& task, std::size_t first, std::size_t end, SoughtFacet& facet) {
  const typename Ratios<K>::DI d;
  using V = hn::Vec<decltype(d)>;
  const Ratios<K> ratios(task, first, facet);
  const std::size_t parts = block / hn::Lanes(d);                                  // of a block
  V least = hn::Set(d, std::numeric_limits<std::int32_t>::max()), second = least;  // of each lane
  const V next_block = hn::Set(d, static_cast<std::int32_t>(parts)), key_mask = hn::Set(d, ~place_mask);
  for (std::size_t start = 0; start < end - first; start += together)
    for (std::size_t part = 0; part < parts; ++part) {
      V of_blocks[together];
      ratios.keys(start, part * hn::Lanes(d), of_blocks);
      V place = hn::Set(d, static_cast<std::int32_t>(start * parts + part));  // in parts of blocks
#pragma GCC unroll 8
      for (const V& of_block : of_blocks) {
        const V key = hn::OrAnd(place, of_block, key_mask);
        second = hn::Min(second, hn::Max(least, key));
        least = hn::Min(least, key);
        place = hn::Add(place, next_block);
      }
    }
  const std::int32_t bound =
      std::min({hn::GetLane(hn::MinOfLanes(d, least)) + doubt, key_above(facet.least), largest_key});
  const auto lanes_up_to_bound = [&](V keys) { return bits_of(d, hn::Lt(keys, hn::Set(d, bound + 1))); };
  std::uint64_t lanes = lanes_up_to_bound(least);
  HWY_ALIGN std::int32_t least_of_lanes[block];
  hn::Store(least, d, least_of_lanes);
  const auto met_in = [&](std::uint64_t bits) {  // the vertex of the tile, in the first of these lanes
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    return static_cast<std::size_t>(least_of_lanes[lane] & place_mask) * hn::Lanes(d) + lane;
  };
  constexpr int few = 3;
  if (lanes_up_to_bound(second) != 0 || std::popcount(lanes) > few) [[unlikely]] {
    float least_ratio = out_of_reach;
    for (; lanes != 0; lanes &= lanes - 1) least_ratio = std::min(least_ratio, ratios.ratio(met_in(lanes)));
    return list_least<K>(ratios, first, end, least_ratio, facet);
  }
  for (; lanes != 0; lanes &= lanes - 1, ++facet.num_listed)
    if (facet.num_listed < facet.listed.size())
      facet.listed[facet.num_listed] = static_cast<std::uint32_t>(first * block + met_in(lanes));
  facet.listed_up_to = std::min(facet.listed_up_to, ratio_below(bound));
  facet.least = std::min(facet.least, bound_of(facet.listed_up_to));
}

template <int K>
void search_tiles(const SearchTask& task) {
  for (std::size_t first = 0; first < task.num_blocks; first += task.tile_blocks) {
    const std::size_t end = std::min(first + task.tile_blocks, task.num_blocks);
    std::size_t facet = 0;
    for (std::size_t cell = 0; cell < task.cells.size(); ++cell) {
      const auto search = write_heights<K>(task, first, end, cell) ? search_tile_by_keys<K> : search_tile<K>;
      for (; facet < task.facets.size() && task.facets[facet].cell == cell; ++facet)
        search(task, first, end, task.facets[facet]);
    }
  }
}

/// Lists all vertices whose ratio is at most the bound; returns how many there are.
template <int K>
std::size_t list_all(const SearchTask& task, const SoughtFacet& facet, float bound,
                     std::span<std::uint32_t> list) {
  std::size_t count = 0;
  for (std::size_t first = 0; first < task.num_blocks; first += task.tile_blocks) {
    const std::size_t end = std::min(first + task.tile_blocks, task.num_blocks);
    write_heights<K>(task, first, end, facet.cell);
    list_up_to<K>(Ratios<K>(task, first, facet), first, end, bound, list, count);
  }
  return count;
}

void search_here(const SearchTask& task) {
  internal::with_compiled_dimension<7, 8>(static_cast<std::size_t>(task.k),
                                          [&](auto k) { search_tiles<k()>(task); });
}
std::size_t list_here(const SearchTask& task, const SoughtFacet& facet, float bound,
                      std::span<std::uint32_t> list) {
  return internal::with_compiled_dimension<7, 8>(
      static_cast<std::size_t>(task.k), [&](auto k) { return list_all<k()>(task, facet, bound, list); });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::geometry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::geometry {

HWY_EXPORT(search_here);
HWY_EXPORT(list_here);

namespace {

/// As many as fit the first-level cache, with the heights of a cell.
std::size_t blocks_of_a_tile() {
#ifdef _SC_LEVEL1_DCACHE_SIZE
  static const bool is_large = sysconf(_SC_LEVEL1_DCACHE_SIZE) >= 48 << 10;
  if (is_large) return most_tile_blocks;
#endif
  return most_tile_blocks / 2;
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
  // A functional that is nowhere negative: at first the lift less the least lift. It is turned about the
  // vertices where it is 0 until there is another.
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
  std::transform(cells.begin(), cells.end(), simplices.begin(),
                 [](const OpenCell& cell) { return cell.vertices; });
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
  if (!(scale.spread < largest_spread && scale.height < largest_spread)) return std::nullopt;
  if (facet.num_listed == 0) return index(infinite_vertex);
  const auto coefficient = [&](std::size_t f, std::size_t r) {
    return lane_entry(functions, f * width + r, facet.cell);
  };
  // Barycentric coordinates magnify rounding errors at the vertices.
  const double unit = 8 * 0x1p-53 * scale.spread;
  const double height_error = unit * scale.height, error = unit * scale.slots[facet.slot];
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Candidate best;
  bool is_listed = facet.num_listed <= facet.listed.size();
  for (float bound = facet.listed_up_to;; is_listed = false) {
    const std::size_t num_listed =
        is_listed ? facet.num_listed
                  : HWY_DYNAMIC_DISPATCH(list_here)(task, facet, bound, {list_.data(), list_.size()});
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
    if (best.high <= bound || bound >= largest_ratio) break;
    const auto high = static_cast<float>(std::min<double>(best.high, largest_ratio));
    bound = std::nextafter(bound_of(high), out_of_reach);  // larger than before, however small it is
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
