// SPDX-License-Identifier: BSD-3-Clause
#include "particles/stars.hpp"

#include "base/compiled_dimension.hpp"
#include "base/large_vector.hpp"
#include "base/quick_rounds.hpp"
#include "kernel/buffer.hpp"

#include <algorithm>
#include <numeric>

namespace delone::particles {
namespace {

/// The ranks of the vertices of a cell, increasing.
void sorted_vertices(const VerticesOfCell& vertices, std::size_t size, const VertexOrder* order,
                     Index* sorted) {
  for (std::size_t i = 0; i < size; ++i) {
    const Index v = order == nullptr ? index(vertices[i]) : order->ranks[index(vertices[i])];
    std::size_t at = i;
    for (; at > 0 && v < sorted[at - 1]; --at) sorted[at] = sorted[at - 1];
    sorted[at] = v;
  }
}

/// Whether a cell with these ranks is at no vertex whose star is wanted.
bool is_left_out(const Index* sorted, const VertexOrder* order) {
  return order != nullptr && sorted[sorted[0] == index(infinite_vertex) ? 1 : 0] > order->last_site;
}

}  // namespace

Stars::Stars(const Complex& complex) : Stars(complex, nullptr) {}
Stars::Stars(const Complex& complex, const VertexOrder& order) : Stars(complex, &order) {}

Stars::Stars(const Complex& complex, const VertexOrder* order)
    : k_(static_cast<std::size_t>(complex.affine_dimension())) {
  offsets_.assign(complex.num_vertex_slots() + 1, 0);
  internal::with_compiled_dimension<1, 4>(k_, [&](auto k) { sort<k()>(complex, order); });
  if (order != nullptr)
    for (Index& v : vertices_) v = order->ids[v];
  fill();
}

/// Cells by their first vertex, and then those of each first vertex, all by ranks. Also counts the cells at
/// each vertex.
template <int K>
void Stars::sort(const Complex& complex, const VertexOrder* order) {
  const std::size_t size = K > 0 ? static_cast<std::size_t>(K) + 1 : k_ + 1;
  std::vector<std::size_t> begin(complex.num_vertex_slots() + 1, 0);
  kernel::Buffer<Index, K + (K > 0 ? 1 : 0)> sorted(size);
  internal::QuickRounds round;
  for (const CellId c : complex.all_cells()) {
    round();
    sorted_vertices(complex.vertices(c), size, order, sorted.data());
    if (is_left_out(sorted.data(), order)) continue;
    ++begin[sorted[0] + 1];
    for (const VertexId v : complex.vertices(c)) ++offsets_[index(v) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  const std::size_t num_cells = begin.back();
  internal::resize_large(vertices_, num_cells * size);
  internal::resize_large(ids_, num_cells);
  std::vector<std::size_t> next(begin);
  for (const CellId c : complex.all_cells()) {
    round();
    sorted_vertices(complex.vertices(c), size, order, sorted.data());
    if (is_left_out(sorted.data(), order)) continue;
    const std::size_t place = next[sorted[0]]++;
    ids_[place] = c;
    std::copy_n(sorted.data(), size, vertices_.data() + place * size);
  }
  const auto is_before = [&](const Index* a, const Index* b) {
    for (std::size_t i = 1; i < size; ++i)
      if (a[i] != b[i]) return a[i] < b[i];
    return false;
  };
  std::vector<Index> places, old_vertices;
  std::vector<CellId> old_ids;
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
    round();
    const std::size_t first = begin[v], count = begin[v + 1] - first;
    const auto of_cell = [&](std::size_t c) { return vertices_.data() + (first + c) * size; };
    bool is_sorted = true;
    for (std::size_t c = 1; c < count && is_sorted; ++c) is_sorted = is_before(of_cell(c - 1), of_cell(c));
    if (is_sorted) continue;
    places.resize(count);
    std::iota(places.begin(), places.end(), Index{0});
    const auto less = [&](Index a, Index b) { return is_before(of_cell(a), of_cell(b)); };
    constexpr std::size_t few = 24;
    if (count > few) {
      std::sort(places.begin(), places.end(), [&](Index a, Index b) {
        round();
        return less(a, b);
      });
    } else {
      for (std::size_t i = 1; i < count; ++i) {
        const Index item = places[i];
        std::size_t at = i;
        for (; at > 0 && less(item, places[at - 1]); --at) places[at] = places[at - 1];
        places[at] = item;
      }
    }
    old_vertices.assign(of_cell(0), of_cell(count));
    old_ids.assign(ids_.begin() + static_cast<std::ptrdiff_t>(first),
                   ids_.begin() + static_cast<std::ptrdiff_t>(first + count));
    for (std::size_t c = 0; c < count; ++c) {
      ids_[first + c] = old_ids[places[c]];
      std::copy_n(old_vertices.data() + places[c] * size, size, of_cell(c));
    }
  }
}

void Stars::fill() {
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  internal::resize_large(cells_, vertices_.size());
  std::vector<std::size_t> next(offsets_);
  internal::QuickRounds round;
  for (std::size_t c = 0, at = 0; c < ids_.size(); ++c) {
    round();
    for (std::size_t i = 0; i <= k_; ++i) cells_[next[vertices_[at++]]++] = static_cast<Index>(c);
  }
}

void Star::find(Index v) {
  internal::with_compiled_dimension<1, 4>(stars_.dimension(), [&](auto k) { collect<k()>(v); });
}

template <int K>
void Star::collect(Index v) {
  const std::size_t k = K > 0 ? static_cast<std::size_t>(K) : stars_.dimension();
  const std::span<const Index> cells = stars_.cells_at(v);
  neighbors_.resize(cells.size() * k);
  num_cells_at_.resize(cells.size() * k);
  corners_.resize(cells.size() * k);
  std::uint32_t count = 0;
  std::uint32_t* corner = corners_.data();
  num_infinite_ = num_at_infinity_ = 0;
  infinite_corners_.clear();
  for (const Index cell : cells) {
    const Index* const vertices = stars_.vertices(cell).data();
    const bool is_finite = vertices[0] != index(infinite_vertex);
    num_infinite_ += is_finite ? 0 : 1;
    for (std::size_t i = is_finite ? 0 : 1; i <= k; ++i) {
      const Index w = vertices[i];
      if (w == v) continue;
      Place& place = places_[w];
      if (place.vertex != v) {
        place = {v, count};
        neighbors_[count] = w;
        num_cells_at_[count++] = 0;
        num_at_infinity_ += is_finite ? 0 : 1;
      }
      if (!is_finite) {
        infinite_corners_.push_back(place.slot);
        continue;
      }
      ++num_cells_at_[place.slot];
      *corner++ = place.slot;
    }
  }
  neighbors_.resize(count);
  corners_.resize(static_cast<std::size_t>(corner - corners_.data()));
}

}  // namespace delone::particles
