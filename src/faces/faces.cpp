// SPDX-License-Identifier: BSD-3-Clause
#include <delone/error.hpp>
#include <delone/faces.hpp>

#include "base/guarded.hpp"
#include "base/large_vector.hpp"
#include "base/parallel_parts.hpp"
#include "base/quick_rounds.hpp"
#include "faces/face_rows.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace delone {
namespace internal {
namespace {

constexpr std::size_t numbers_in_part = 1 << 15;

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

std::vector<SignedIndex> rows_of_vertices(const Triangulation& triangulation) {
  const Complex complex = triangulation.complex();
  std::vector<SignedIndex> rows(complex.num_vertex_slots(), -1);
  for (Index v = 1; v < rows.size(); ++v)
    if (complex.is_vertex(VertexId{v})) rows[v] = static_cast<SignedIndex>(triangulation.row_of(VertexId{v}));
  return rows;
}

Faces faces_by_rows(const Triangulation& triangulation, FaceLevel level, int j, unsigned threads,
                    const std::vector<unsigned char>& marks, std::vector<double>* values) {
  Faces result;
  result.dimension = j;
  if (level.dimension != j) return result;
  const std::size_t corners = level.corners();
  if (level.cells.empty()) {
    resize_large(level.cells, level.size());
    std::iota(level.cells.begin(), level.cells.end(), SignedIndex{0});
  }
  if (level.on_hull.empty()) resize_large(level.on_hull, level.size());
  level.facets = {};
  level.neighbors = {};
  result.vertices = std::move(level.vertices);
  result.cells = std::move(level.cells);
  result.on_hull = std::move(level.on_hull);
  const std::vector<SignedIndex> row_of = rows_of_vertices(triangulation);
  if (j > 0 && j == triangulation.affine_dimension()) {  // in the order of to_data(), with its orientation
    const Complex complex = triangulation.complex();
    SignedIndex* to = result.vertices.data();
    QuickRounds round;
    for (const CellId c : complex.finite_cells()) {
      round();
      for (int i = 0; i <= j; ++i) *to++ = row_of[index(complex.vertex(c, i))];
    }
  } else {
    for_parts(threads, result.size(), numbers_in_part,
              [&](std::size_t first, std::size_t last, const StopPoint& stop) {
                stop();
                for (std::size_t i = first; i < last; ++i) {
                  SignedIndex* const rows = result.vertices.data() + i * corners;
                  for (std::size_t m = 0; m < corners; ++m) {  // sorts by insertion
                    const SignedIndex row = row_of[static_cast<std::size_t>(rows[m])];
                    std::size_t at = m;
                    for (; at > 0 && rows[at - 1] > row; --at) rows[at] = rows[at - 1];
                    rows[at] = row;
                  }
                }
              });
  }
  std::size_t count = result.size();
  if (!marks.empty()) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (marks[i] == 0) continue;
      std::copy_n(result.vertices.data() + i * corners, corners, result.vertices.data() + to * corners);
      result.cells[to] = result.cells[i];
      result.on_hull[to++] = result.on_hull[i];
    }
    count = to;
    result.vertices.resize(count * corners);
    result.cells.resize(count);
    result.on_hull.resize(count);
  }
  if (j > 0) return result;
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

Faces faces(const Triangulation& triangulation, int j, const Execution& how) {
  internal::require_face_dimension(triangulation, j);
  return internal::guarded("the faces", [&] {
    const internal::ProgressMeter meter(how.progress);
    const int k = triangulation.affine_dimension();
    if (j > k) return internal::faces_by_rows(triangulation, {}, j, how.threads);
    internal::FaceLevel level = internal::level_of_cells(triangulation);
    const Index slots = triangulation.complex().num_vertex_slots();
    while (level.dimension > j) level = internal::facets_of(level, slots, how.threads);
    return internal::faces_by_rows(triangulation, std::move(level), j, how.threads);
  });
}

}  // namespace delone
