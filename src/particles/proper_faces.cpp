// SPDX-License-Identifier: BSD-3-Clause
#include "particles/proper_faces.hpp"

#include "base/parallel_parts.hpp"
#include "base/quick_rounds.hpp"
#include "base/spread.hpp"
#include "kernel/predicates.hpp"

#include <algorithm>

namespace delone::particles {

SphereClasses::SphereClasses(const Stars& stars, const sites::VertexPoints& points, const kernel::Flat& flat,
                             unsigned threads) {
  const Complex& complex = stars.complex();
  const std::size_t slots = complex.num_cell_slots(), size = stars.dimension() + 1;
  const auto is_one = [&](Index c) { return complex.is_cell(CellId{c}) && stars.has(CellId{c}); };
  const auto is_infinite = [&](Index c) { return complex.is_infinite(CellId{c}); };
  const auto neighbor = [&](Index c, std::size_t i) {
    return index(complex.neighbor(CellId{c}, static_cast<int>(i)));
  };
  // The vertex of the neighbor across facet i.
  const auto opposite = [&](Index c, std::size_t i) {
    const CellId id{c}, other = complex.neighbor(id, static_cast<int>(i));
    return index(complex.vertex(other, complex.mirror_index(id, static_cast<int>(i))));
  };
  internal::UnionFind classes(slots);
  if (size > 2) {
    std::vector<unsigned char> are_equal(slots * size, 0);
    constexpr std::size_t cells_in_part = 1024;
    internal::for_parts(
        threads, slots, cells_in_part,
        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
          std::vector<const double*> of_cell(size);
          for (auto c = static_cast<Index>(first); c < last; ++c) {
            stop();
            if (!is_one(c) || is_infinite(c)) continue;
            const VerticesOfCell vertices = complex.vertices(CellId{c});
            for (std::size_t i = 0; i < size; ++i) of_cell[i] = points.point(index(vertices[i]));
            for (std::size_t i = 0; i < size; ++i)
              if (const Index other = neighbor(c, i); other < c && is_one(other) && !is_infinite(other))
                are_equal[c * size + i] = kernel::in_sphere(flat, of_cell, Sign::positive,
                                                            points.point(opposite(c, i))) == Sign::zero;
          }
        });
    internal::QuickRounds round;
    for (Index c = 0; c < slots; ++c) {
      round();
      for (std::size_t i = 0; i < size; ++i)
        if (are_equal[c * size + i] != 0) classes.unite(c, neighbor(c, i));
    }
    std::vector<const double*> of_facets(size);
    for (const CellId cell : complex.infinite_cells()) {
      internal::cancellation_point();
      const Index c = index(cell);
      if (!is_one(c)) continue;
      const auto apex = static_cast<std::size_t>(complex.infinite_index(cell));
      for (std::size_t i = 0; i < size; ++i) {
        const Index other = neighbor(c, i);
        if (i == apex || other > c || !is_one(other)) continue;
        const auto other_apex = static_cast<std::size_t>(complex.infinite_index(CellId{other}));
        if (classes.root(neighbor(c, apex)) != classes.root(neighbor(other, other_apex))) continue;
        std::size_t at = 0;
        for (const VertexId v : complex.vertices(cell))
          if (v != infinite_vertex) of_facets[at++] = points.point(index(v));
        of_facets[at] = points.point(opposite(c, i));
        if (kernel::orientation(flat, of_facets) == Sign::zero) classes.unite(c, other);
      }
    }
  }
  classes_.resize(slots);
  for (Index c = 0; c < slots; ++c) classes_[c] = classes.root(c);
}

void ProperFaces::find(const Star& star) {
  const std::size_t n = star.neighbors().size();
  // The cells at each edge.
  num_classes_.assign(n, 0);
  internal::spread(n, offsets_, at_edge_, [&](const auto& put) {
    for (std::size_t c = 0; c < star.num_cells(); ++c)
      for (const std::uint32_t slot : star.slots_of(c)) put(slot, static_cast<std::uint32_t>(c));
  });
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
      const Index of_cell = classes_.of(star.cell(c));
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
