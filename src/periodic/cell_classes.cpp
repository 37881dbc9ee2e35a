// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/cell_classes.hpp"

#include "base/quick_rounds.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace delone::periodic {

namespace {

VertexId smallest_vertex(const GhostTriangulation& ghosts, const Complex& complex, CellId cell) {
  const auto& points = triangulation::StoredPoints::of(ghosts.triangulation());
  const auto d = static_cast<std::ptrdiff_t>(points.ambient);
  VertexId smallest = complex.vertex(cell, 0);
  const double* least = points.point(index(smallest));
  for (const VertexId v : complex.vertices(cell)) {
    const double* const x = points.point(index(v));
    if (*x > *least || v == smallest) continue;
    if (*x == *least && !std::lexicographical_compare(x, x + d, least, least + d)) continue;
    smallest = v;
    least = x;
  }
  return smallest;
}

}  // namespace

CanonicalCells find_canonical_cells(const GhostTriangulation& ghosts) {
  CanonicalCells canonical;
  const Complex complex = ghosts.triangulation().complex();
  canonical.number_of_slot.assign(complex.num_cell_slots(), -1);
  internal::QuickRounds round;
  for (std::size_t slot = 0; slot < complex.num_cell_slots(); ++slot) {
    round();
    const CellId cell{static_cast<Index>(slot)};
    if (!complex.is_cell(cell)) continue;
    const VerticesOfCell vertices = complex.vertices(cell);
    if (std::ranges::find(vertices, infinite_vertex) != vertices.end() ||
        std::ranges::none_of(vertices, [&](VertexId v) { return ghosts.is_own(v); }))
      continue;
    const VertexId smallest = smallest_vertex(ghosts, complex, cell);
    if (!ghosts.is_own(smallest)) continue;
    canonical.number_of_slot[slot] = static_cast<SignedIndex>(canonical.cells.size());
    canonical.cells.push_back(cell);
    canonical.smallest.push_back(smallest);
  }
  return canonical;
}

CellClasses::CellClasses(const GhostTriangulation& ghosts, const PeriodicSet& set)
    : ghosts_(ghosts),
      complex_(ghosts.triangulation().complex()),
      canonical_(find_canonical_cells(ghosts)),
      r_(set.rank),
      corners_(static_cast<std::size_t>(complex_.affine_dimension() + 1)),
      first_at_(set.num_points() + 1, 0),
      slots_(canonical_.cells.size() * corners_) {
  order_rows(set);
  sort_by_row();
  sort_within_rows(set);
  for (std::size_t number = 0; number < canonical_.cells.size(); ++number)
    canonical_.number_of_slot[index(canonical_.cells[number])] = static_cast<SignedIndex>(number);
}

/// Along Morton's curve, so that what is close is near in memory.
void CellClasses::order_rows(const PeriodicSet& set) {
  const std::size_t n = set.num_points(), axes = std::min<std::size_t>(set.dimension, 8);
  const int bits = static_cast<int>(63 / std::max<std::size_t>(axes, 1));
  std::vector<double> low(axes, std::numeric_limits<double>::infinity()), high(axes, -low[0]);
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t j = 0; j < axes; ++j) {
      low[j] = std::min(low[j], set.row(row)[j]);
      high[j] = std::max(high[j], set.row(row)[j]);
    }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> coded(n);
  std::vector<std::uint64_t> places(axes);
  const double most = std::ldexp(1 - 0x1p-30, bits);
  internal::QuickRounds round;
  for (std::size_t row = 0; row < n; ++row) {
    round();
    for (std::size_t j = 0; j < axes; ++j)
      places[j] = high[j] > low[j]
                      ? static_cast<std::uint64_t>((set.row(row)[j] - low[j]) / (high[j] - low[j]) * most)
                      : 0;
    std::uint64_t code = 0;
    for (int bit = bits; bit-- > 0;)
      for (const std::uint64_t place : places) code = code << 1 | (place >> bit & 1);
    coded[row] = {code, static_cast<std::uint32_t>(row)};
  }
  std::sort(coded.begin(), coded.end());
  place_of_row_.resize(n);
  for (const auto& [code, row] : coded) {
    place_of_row_[row] = static_cast<std::uint32_t>(row_at_.size());
    row_at_.push_back(row);
  }
}

void CellClasses::sort_by_row() {
  const std::size_t count = canonical_.cells.size();
  const auto place = [&](std::size_t i) {
    return place_of_row_[ghosts_.image_of(canonical_.smallest[i]).row];
  };
  for (std::size_t i = 0; i < count; ++i) ++first_at_[place(i) + 1];
  for (std::size_t i = 1; i < first_at_.size(); ++i) first_at_[i] += first_at_[i - 1];
  std::vector<std::size_t> next(first_at_.begin(), first_at_.end() - 1);
  std::vector<CellId> cells(count);
  std::vector<VertexId> smallest(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t number = next[place(i)]++;
    cells[number] = canonical_.cells[i];
    smallest[number] = canonical_.smallest[i];
  }
  canonical_.cells = std::move(cells);
  canonical_.smallest = std::move(smallest);
}

/// Also finds the order of the vertices of each.
void CellClasses::sort_within_rows(const PeriodicSet& set) {
  // A cell as the row of each vertex and r numbers, its offset from the smallest vertex.
  const std::size_t width = r_ + 1, size = corners_ * width;
  std::vector<std::int64_t> keys, key(size);
  std::vector<std::uint8_t> slots, order(corners_);
  std::vector<std::size_t> places;
  std::vector<CellId> cells;
  std::vector<VertexId> smallest;
  internal::QuickRounds round;
  for (std::size_t at = 0; at < row_at_.size(); ++at) {
    round();
    const std::size_t row = row_at_[at], first = first_at_[at], count = first_at_[at + 1] - first;
    keys.clear();
    slots.clear();
    for (std::size_t number = first; number < first + count; ++number) {
      const VerticesOfCell vertices = complex_.vertices(canonical_.cells[number]);
      for (std::size_t i = 0; i < corners_; ++i) {
        const Image& image = ghosts_.image_of(vertices[i]);
        const auto offset = ghosts_.offset_of(vertices[i]);
        key[i * width] = image.row;
        for (std::size_t l = 0; l < r_; ++l)
          key[i * width + 1 + l] =
              std::int64_t{offset[l]} - set.wraps[image.row * r_ + l] + set.wraps[row * r_ + l];
      }
      std::iota(order.begin(), order.end(), std::uint8_t{0});
      bool is_odd = false;
      for (std::size_t i = 1; i < corners_; ++i)
        for (std::size_t at = i; at > 0; --at) {
          const std::int64_t *const a = &key[order[at - 1] * width], *const b = &key[order[at] * width];
          if (!std::lexicographical_compare(b, b + width, a, a + width)) break;
          std::swap(order[at - 1], order[at]);
          is_odd = !is_odd;
        }
      for (const std::uint8_t slot : order)
        keys.insert(keys.end(), &key[slot * width], &key[slot * width] + width);
      if (is_odd) std::swap(order[corners_ - 2], order[corners_ - 1]);
      slots.insert(slots.end(), order.begin(), order.end());
    }
    places.resize(count);
    std::iota(places.begin(), places.end(), std::size_t{0});
    std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
      return std::lexicographical_compare(&keys[a * size], &keys[a * size] + size, &keys[b * size],
                                          &keys[b * size] + size);
    });
    cells.clear();
    smallest.clear();
    for (const std::size_t place : places) {
      cells.push_back(canonical_.cells[first + place]);
      smallest.push_back(canonical_.smallest[first + place]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      canonical_.cells[first + i] = cells[i];
      canonical_.smallest[first + i] = smallest[i];
      std::copy_n(slots.data() + places[i] * corners_, corners_, slots_.data() + (first + i) * corners_);
    }
  }
}

bool CellClasses::has_own(CellId cell) const {
  return std::ranges::any_of(complex_.vertices(cell), [&](VertexId v) { return ghosts_.is_own(v); });
}

bool CellClasses::has_moved(CellId cell, VertexId v, const Offset& offset) const {
  return std::ranges::any_of(complex_.vertices(cell),
                             [&](VertexId w) { return w != infinite_vertex && is_moved(w, v, offset); });
}

bool CellClasses::is_moved(VertexId w, VertexId v, const Offset& offset) const {
  const auto of_w = ghosts_.offset_of(w), of_v = ghosts_.offset_of(v);
  if (ghosts_.image_of(w).row != ghosts_.image_of(v).row) return false;
  for (std::size_t l = 0; l < r_; ++l)
    if (of_w[l] != of_v[l] - offset[l]) return false;
  return true;
}

Translate CellClasses::find_class(CellId cell) const {
  if (complex_.is_infinite(cell)) return {-1, Offset(r_)};
  if (const SignedIndex number = canonical_.number_of_slot[index(cell)]; number >= 0)
    return {number, Offset(r_)};
  const VertexId smallest = smallest_vertex(ghosts_, complex_, cell);
  const Offset moved = offset_of(smallest);
  const std::uint32_t row = ghosts_.image_of(smallest).row;
  const std::size_t place = place_of_row_[row];
  for (std::size_t at = first_at_[place]; at < first_at_[place + 1]; ++at) {
    const CellId candidate = canonical_.cells[at];
    if (std::ranges::all_of(complex_.vertices(cell),
                            [&](VertexId v) { return has_moved(candidate, v, moved); }))
      return {static_cast<SignedIndex>(at), moved};
  }
  return {-1, moved};
}

Translate CellClasses::find_neighbor(CellId cell, int i) const {
  const VerticesOfCell vertices = complex_.vertices(cell);
  if (corners_ == 1) return {-1, Offset(r_)};
  for (std::size_t l = 0; l < corners_; ++l)
    if (l != static_cast<std::size_t>(i) && ghosts_.is_own(vertices[l]))
      return find_class(complex_.neighbor(cell, i));
  // No vertex of the facet is in the box: the same facet at a translate of one that is.
  const VertexId first = vertices[i == 0 ? 1 : 0];
  const Offset moved = offset_of(first);
  for (const CellId other : complex_.star(own_vertex(first))) {
    const bool has_facet = [&] {
      for (std::size_t l = 0; l < corners_; ++l)
        if (l != static_cast<std::size_t>(i) && !has_moved(other, vertices[l], moved)) return false;
      return true;
    }();
    if (!has_facet || has_moved(other, vertices[static_cast<std::size_t>(i)], moved)) continue;
    Translate found = find_class(other);
    for (std::size_t l = 0; l < r_; ++l) found.offset[l] += moved[l];
    return found;
  }
  return {-1, Offset(r_)};
}

}  // namespace delone::periodic
