// SPDX-License-Identifier: BSD-3-Clause
#include "particles/cell_centers.hpp"

#include "base/parallel_parts.hpp"
#include "solve/cell_center.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace delone::particles {
namespace {

/// Whether all sites agree in the coordinates that are not in `axes`.
bool are_aligned(const Complex& complex, const sites::VertexPoints& points, const std::vector<int>& axes) {
  const double* first = nullptr;
  for (Index v = 1; v < complex.num_vertex_slots(); ++v) {
    if (!complex.is_vertex(VertexId{v})) continue;
    const double* const p = points.point(v);
    if (first == nullptr) first = p;
    for (int j = 0; j < points.ambient; ++j)
      if (p[j] != first[j] && !std::binary_search(axes.begin(), axes.end(), j)) return false;
  }
  return true;
}

}  // namespace

void for_each_center(const Triangulation& triangulation, const sites::VertexPoints& points,
                     const std::function<bool(CellId cell)>& is_wanted,
                     const std::function<void(CellId cell, const double* center)>& visit, unsigned threads) {
  const auto d = static_cast<std::size_t>(triangulation.dimension());
  const Complex complex = triangulation.complex();
  const std::vector<int> axes = triangulation.axes();
  const bool aligned = axes.size() == d || are_aligned(complex, points, axes);
  constexpr std::size_t block = solve::CenterFinder::block, part = 64 * block;
  const std::size_t slots = complex.num_cell_slots();
  internal::work_in_parts(threads, slots, part, [&] {
    return [&, finder = solve::CenterFinder(triangulation.dimension(), axes, aligned),
            cells = std::vector<CellId>(), of_block = std::vector<const double*>(),
            weights = std::vector<double>(), centers = std::vector<double>(block * d)](
               std::size_t first, std::size_t last, const internal::StopPoint& stop) mutable {
      for (std::size_t c = first; c < last;) {
        stop();
        cells.clear();
        of_block.clear();
        weights.clear();
        for (; c < last && cells.size() < block; ++c) {
          const CellId cell{static_cast<Index>(c)};
          if (!complex.is_cell(cell) || complex.is_infinite(cell) || !is_wanted(cell)) continue;
          cells.push_back(cell);
          for (const VertexId v : complex.vertices(cell)) {
            of_block.push_back(points.point(index(v)));
            if (points.weighted()) weights.push_back(points.point(index(v))[d]);
          }
        }
        if (cells.empty()) continue;
        finder.find_block(cells.size(), of_block.data(), points.weighted() ? weights.data() : nullptr,
                          centers.data());
        for (std::size_t i = 0; i < cells.size(); ++i) visit(cells[i], centers.data() + i * d);
      }
    };
  });
}

}  // namespace delone::particles
