// SPDX-License-Identifier: BSD-3-Clause
#include "particles/proper_faces.hpp"

#include "base/parallel_parts.hpp"
#include "base/quick_rounds.hpp"
#include "kernel/predicates.hpp"

#include <algorithm>

namespace delone::particles {

SphereClasses::SphereClasses(const Complex& complex, const Stars& stars, const sites::VertexPoints& points,
                             const kernel::Flat& flat, unsigned threads) {
  const std::size_t n = stars.num_cells(), size = stars.dimension() + 1;
  std::vector<Index> number(complex.num_cell_slots(), invalid_index);
  for (std::size_t c = 0; c < n; ++c) number[index(stars.id(c))] = static_cast<Index>(c);
  const auto is_infinite = [&](std::size_t c) { return stars.vertices(c)[0] == index(infinite_vertex); };
  const auto neighbor = [&](std::size_t c, std::size_t i) -> std::size_t {
    return number[index(complex.neighbor(stars.id(c), static_cast<int>(i)))];
  };
  // The vertex of the neighbor across facet i.
  const auto opposite = [&](std::size_t c, std::size_t i) {
    const CellId id = stars.id(c), other = complex.neighbor(id, static_cast<int>(i));
    return index(complex.vertex(other, complex.mirror_index(id, static_cast<int>(i))));
  };
  internal::UnionFind classes(n);
  if (size > 2) {
    std::vector<unsigned char> are_equal(n * size, 0);
    constexpr std::size_t cells_in_part = 1024;
    internal::for_parts(
        threads, n, cells_in_part, [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
          std::vector<const double*> of_cell(size);
          for (std::size_t c = first; c < last; ++c) {
            stop();
            if (is_infinite(c)) continue;
            for (std::size_t i = 0; i < size; ++i) of_cell[i] = points.point(stars.vertices(c)[i]);
            for (std::size_t i = 0; i < size; ++i)
              if (const std::size_t other = neighbor(c, i); other < c && !is_infinite(other))
                are_equal[c * size + i] = kernel::in_sphere(flat, of_cell, Sign::positive,
                                                            points.point(opposite(c, i))) == Sign::zero;
          }
        });
    internal::QuickRounds round;
    for (std::size_t c = 0; c < n; ++c) {
      round();
      for (std::size_t i = 0; i < size; ++i)
        if (are_equal[c * size + i] != 0)
          classes.unite(static_cast<Index>(c), static_cast<Index>(neighbor(c, i)));
    }
    std::vector<const double*> of_facets(size);
    for (std::size_t c = 0; c < n && is_infinite(c); ++c) {  // they come first
      internal::cancellation_point();
      const auto apex = static_cast<std::size_t>(complex.infinite_index(stars.id(c)));
      for (std::size_t i = 0; i < size; ++i) {
        const std::size_t other = neighbor(c, i);
        if (i == apex || other > c) continue;
        const auto other_apex = static_cast<std::size_t>(complex.infinite_index(stars.id(other)));
        const auto root = [&](std::size_t cell) { return classes.root(static_cast<Index>(cell)); };
        if (root(neighbor(c, apex)) != root(neighbor(other, other_apex))) continue;
        for (std::size_t j = 1; j < size; ++j) of_facets[j - 1] = points.point(stars.vertices(c)[j]);
        of_facets[size - 1] = points.point(opposite(c, i));
        if (kernel::orientation(flat, of_facets) == Sign::zero)
          classes.unite(static_cast<Index>(c), static_cast<Index>(other));
      }
    }
  }
  classes_.resize(n);
  for (std::size_t c = 0; c < n; ++c) classes_[c] = classes.root(static_cast<Index>(c));
}

void ProperFaces::find(const Star& star, std::span<const Index> cells) {
  const std::size_t n = star.neighbors().size();
  // The cells at each edge.
  num_classes_.assign(n, 0);
  offsets_.assign(n + 1, 0);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const std::uint32_t slot : star.slots_of(c)) ++offsets_[slot + 1];
  for (std::size_t i = 0; i < n; ++i) offsets_[i + 1] += offsets_[i];
  next_.assign(offsets_.begin(), offsets_.end() - 1);
  at_edge_.resize(offsets_[n]);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const std::uint32_t slot : star.slots_of(c)) at_edge_[next_[slot]++] = static_cast<std::uint32_t>(c);
  const auto count_distinct = [&] {
    std::sort(found_.begin(), found_.end());
    return static_cast<std::size_t>(std::unique(found_.begin(), found_.end()) - found_.begin());
  };
  for (std::size_t slot = 0; slot < n; ++slot) {
    others_.clear();
    found_.clear();
    std::vector<Index> finite;
    for (std::size_t i = offsets_[slot]; i < offsets_[slot + 1]; ++i) {
      const std::size_t c = at_edge_[i];
      const Index of_cell = classes_.of(cells[c]);
      found_.push_back(of_cell);
      if (c >= star.num_infinite()) finite.push_back(of_cell);
      for (const std::uint32_t w : star.slots_of(c))
        if (w != slot) others_.emplace_back(w, of_cell);
    }
    const std::size_t num_classes = count_distinct();
    std::sort(others_.begin(), others_.end());
    others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
    bool is_proper = true;
    for (std::size_t begin = 0, end = 0; begin < others_.size() && is_proper; begin = end) {
      while (end < others_.size() && others_[end].first == others_[begin].first) ++end;
      is_proper = end - begin < num_classes;
    }
    if (!is_proper) continue;
    found_.swap(finite);
    num_classes_[slot] = static_cast<std::uint32_t>(count_distinct());
  }
}

}  // namespace delone::particles
