// SPDX-License-Identifier: BSD-3-Clause
#include <delone/faces.hpp>

#include "base/guarded.hpp"
#include "base/parallel_parts.hpp"
#include "faces/face_rows.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace delone {
namespace internal {
namespace {

constexpr std::size_t faces_in_part = 1 << 15;

/// Moves the entries of `items`, `width` each, to the order of `order`.
template <class T>
void reorder(std::vector<T>& items, std::size_t width, const std::vector<std::size_t>& order) {
  std::vector<T> moved;
  moved.reserve(items.size());
  for (const std::size_t i : order)
    for (std::size_t j = 0; j < width; ++j) moved.push_back(items[i * width + j]);
  items = std::move(moved);
}

}  // namespace

void require_face_dimension(const Triangulation& triangulation, int j) {
  if (j < 0 || j > triangulation.dimension())
    throw Error(Errc::invalid_argument, "the dimension of faces is " + std::to_string(j) +
                                            ", which is not within 0 … " +
                                            std::to_string(triangulation.dimension()));
}

Faces faces_by_rows(const Triangulation& triangulation, FaceLevel level, int j, unsigned threads,
                    const std::vector<unsigned char>& marks, std::vector<double>* values) {
  Faces result;
  result.dimension = j;
  if (level.dimension != j) return result;
  const std::size_t corners = level.corners();
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i] != 0) chosen.push_back(i);
  const std::size_t count = marks.empty() ? level.size() : chosen.size();
  result.vertices.resize(count * corners);
  result.cells.resize(count);
  result.on_hull.resize(count);
  for_parts(threads, count, faces_in_part, [&](std::size_t first, std::size_t last, const StopPoint& stop) {
    for (std::size_t i = first; i < last; ++i) {
      if (i % 1024 == 0) stop();
      const std::size_t face = marks.empty() ? i : chosen[i];
      SignedIndex* const rows = result.vertices.data() + i * corners;
      for (std::size_t m = 0; m < corners; ++m)
        rows[m] =
            static_cast<SignedIndex>(triangulation.row_of(VertexId{level.vertices[face * corners + m]}));
      std::sort(rows, rows + corners);
      result.cells[i] = static_cast<SignedIndex>(level.cells.empty() ? face : level.cells[face]);
      result.on_hull[i] = level.on_hull.empty() ? 0 : level.on_hull[face];
    }
  });
  if (j > 0) {
    if (j == triangulation.affine_dimension()) {  // in the order of to_data(), with its orientation
      const std::vector<SignedIndex> cells = triangulation.to_data(false).cells;
      for (std::size_t i = 0; i < count; ++i)
        std::copy_n(
            cells.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(result.cells[i]) * corners),
            corners, result.vertices.begin() + static_cast<std::ptrdiff_t>(i * corners));
    }
    return result;
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return result.vertices[a] < result.vertices[b]; });
  reorder(result.vertices, 1, order);
  reorder(result.cells, 1, order);
  reorder(result.on_hull, 1, order);
  if (values != nullptr) reorder(*values, 1, order);
  return result;
}

}  // namespace internal

Faces faces(const Triangulation& triangulation, int j, const FaceOptions& options) {
  internal::require_face_dimension(triangulation, j);
  return internal::guarded("the faces", [&] {
    const internal::ProgressMeter meter(options.progress);
    const int k = triangulation.affine_dimension();
    if (j > k) return internal::faces_by_rows(triangulation, {}, j, options.threads);
    internal::FaceLevel level = internal::level_of_cells(triangulation);
    const Index slots = triangulation.complex().num_vertex_slots();
    if (j == k - 1)
      level = internal::facets_of(level, slots, options.threads);
    else if (j < k)
      level = internal::faces_of(level, j, slots, options.threads);
    return internal::faces_by_rows(triangulation, std::move(level), j, options.threads);
  });
}

}  // namespace delone
