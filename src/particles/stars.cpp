// SPDX-License-Identifier: BSD-3-Clause
// Which neighbors are new, and which vertex of a cell is that of the star, is up to chance: the loops over
// the cells of a star have no branches for either.
#include "particles/stars.hpp"

#include "base/compiled_dimension.hpp"
#include "base/quick_rounds.hpp"
#include "base/spread.hpp"
#include "kernel/buffer.hpp"

#include <algorithm>
#include <utility>

namespace delone::particles {
namespace {

template <int K>
std::size_t number_of(std::size_t k) {
  return K > 0 ? static_cast<std::size_t>(K) : k;
}

}  // namespace

Stars::Stars(const Complex& complex, std::vector<unsigned char> wanted)
    : complex_(complex),
      k_(static_cast<std::size_t>(complex.affine_dimension())),
      wanted_(std::move(wanted)) {
  internal::with_compiled_dimension<1, 4>(k_, [&](auto k) { fill<k()>(); });
}

bool Stars::has(CellId cell) const {
  const VerticesOfCell vertices = complex_.vertices(cell);
  return std::any_of(vertices.begin(), vertices.end(), [&](VertexId v) { return is_wanted(index(v)); });
}

/// The first pass counts the cells at each vertex.
template <int K>
void Stars::fill() {
  const std::size_t size = number_of<K>(k_) + 1;
  internal::spread(complex_.num_vertex_slots(), offsets_, cells_, [&](const auto& put) {
    internal::QuickRounds round;
    for (const CellId c : complex_.all_cells()) {
      round();
      const VerticesOfCell vertices = complex_.vertices(c);
      for (std::size_t i = 0; i < size; ++i)
        if (const Index v = index(vertices[i]); is_wanted(v)) put(v, c);
    }
  });
}

void Star::find(Index v) {
  internal::with_compiled_dimension<1, 4>(k_, [&](auto k) { collect<k()>(v); });
}

template <int K>
void Star::collect(Index v) {
  const std::size_t k = number_of<K>(k_);
  const Complex& complex = stars_.complex();
  const std::span<const CellId> cells = stars_.cells_at(v);
  neighbors_.resize(cells.size() * k + 1);
  corners_.resize(cells.size() * k);
  finite_.resize(cells.size());
  infinite_.clear();
  infinite_corners_.clear();
  kernel::Buffer<Index, K> others(k);
  std::uint32_t count = 0;
  const auto slot_of = [&](Index w) {
    Place& place = places_[w];
    const std::uint32_t is_new = place.vertex != v ? 1 : 0,
                        slot = place.slot ^ ((place.slot ^ count) & -is_new);
    place = {v, slot};
    neighbors_[count] = w;  // until the next new one is put there
    count += is_new;
    return slot;
  };
  std::size_t num_finite = 0;
  std::uint32_t* corner = corners_.data();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const CellId cell = cells[c];
    stars_.prefetch_after(v, c);
    const VerticesOfCell vertices = complex.vertices(cell);
    const Index last = index(vertices[k]);  // takes the place of v
    bool is_infinite = last == index(infinite_vertex);
    for (std::size_t i = 0; i < k; ++i) {
      const Index w = index(vertices[i]);
      others[i] = w ^ ((w ^ last) & (w == v ? ~Index{0} : 0));
      is_infinite |= w == index(infinite_vertex);
    }
    if (is_infinite) {
      infinite_.push_back(cell);
      for (std::size_t i = 0; i < k; ++i)
        if (others[i] != index(infinite_vertex)) infinite_corners_.push_back(slot_of(others[i]));
      continue;
    }
    finite_[num_finite++] = cell;
    for (std::size_t i = 0; i < k; ++i) *corner++ = slot_of(others[i]);
  }
  neighbors_.resize(count);
  finite_.resize(num_finite);
  corners_.resize(num_finite * k);
}

void Star::arrange(std::span<const std::uint32_t> order) {
  old_neighbors_.swap(neighbors_);
  neighbors_.resize(order.size());
  new_slots_.resize(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    neighbors_[i] = old_neighbors_[order[i]];
    new_slots_[order[i]] = i;
  }
  internal::with_compiled_dimension<1, 4>(k_, [&](auto k) { renumber<k()>(); });
  if (infinite_.empty()) return;
  at_infinity_.assign(order.size(), 0);
  for (std::uint32_t& slot : infinite_corners_) {
    slot = new_slots_[slot];
    at_infinity_[slot] = 1;
  }
}

template <int K>
void Star::renumber() {
  const std::size_t k = number_of<K>(k_);
  kernel::Buffer<std::uint32_t, K> slots(k);
  for (std::size_t first = 0; first < corners_.size(); first += k) {
    for (std::size_t i = 0; i < k; ++i) slots[i] = new_slots_[corners_[first + i]];
    for (std::size_t i = 0; i < k; ++i) {  // slots differ, so each tells its place
      std::uint32_t place = 0;
      for (std::size_t j = 0; j < k; ++j) place += slots[j] < slots[i] ? 1 : 0;
      corners_[first + place] = slots[i];
    }
  }
}

void Star::count_cells_at_edges(std::vector<std::uint32_t>& counts) const {
  counts.assign(neighbors_.size(), 0);
  for (const std::uint32_t slot : corners_) ++counts[slot];
}

}  // namespace delone::particles
