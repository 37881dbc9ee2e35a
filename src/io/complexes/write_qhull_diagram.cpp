// SPDX-License-Identifier: BSD-3-Clause
// Voronoi and power diagrams in the text forms of Qhull's qvoronoi, after its manual. In the outputs o and Fv
// vertex 0 is at infinity, and vertex i+1 is vertex i of the diagram.
#include "io/complexes/qhull_outputs.hpp"
#include "io/file.hpp"

#include <delone/io.hpp>
#include <delone/voronoi.hpp>

#include <algorithm>
#include <map>

namespace delone {
namespace io {
namespace {

using Rows = std::vector<SignedIndex>;

void put_vertices(AtomicFile& file, const Diagram& diagram, bool with_infinity) {
  const auto d = static_cast<std::size_t>(diagram.dimension());
  for (std::size_t j = 0; with_infinity && j < d; ++j) file.write(j + 1 < d ? "-10.101 " : "-10.101\n");
  put_rows(file, diagram.vertices(), d);
}

Rows counted_from_infinity(std::span<const SignedIndex> vertices) {
  Rows rows(vertices.begin(), vertices.end());
  for (SignedIndex& row : rows) ++row;
  return rows;
}

/// Vertices and regions, those of all rows of the input: none for a duplicate or hidden point.
void put_regions(AtomicFile& file, const Diagram& diagram) {
  file.print("{}\n{} {} 1\n", diagram.dimension(), diagram.num_vertices() + 1, diagram.num_points());
  put_vertices(file, diagram, true);
  NumberLists lists;
  for (std::size_t row = 0; row < diagram.num_points(); ++row) {
    const SignedIndex region = diagram.point_region()[row];
    const bool has_region = region >= 0 && at(diagram.region_points()[at(region)]) == row;
    lists.add(has_region ? counted_from_infinity(diagram.region(at(region))) : Rows{});
  }
  put_counted(file, lists);
}

/// Ridges of fewer than k vertices, infinity included, are left out as in Qhull: they are unbounded in
/// several directions, and their vertices and the midpoint of the sites do not span them.
void put_ridges(AtomicFile& file, const Diagram& diagram) {
  NumberLists lists;
  for (std::size_t i = 0; i < diagram.num_ridges(); ++i) {
    if (diagram.ridge(i).size() < static_cast<std::size_t>(diagram.affine_dimension())) continue;
    Rows row(diagram.ridge_points().begin() + static_cast<std::ptrdiff_t>(2 * i),
             diagram.ridge_points().begin() + static_cast<std::ptrdiff_t>(2 * i + 2));
    std::sort(row.begin(), row.end());
    Rows vertices = counted_from_infinity(diagram.ridge(i));
    if (diagram.affine_dimension() != 3) std::sort(vertices.begin(), vertices.end());
    row.insert(row.end(), vertices.begin(), vertices.end());
    lists.add(row);
  }
  file.print("{}\n", lists.size());
  put_counted(file, lists);
}

/// The sites of unbounded regions.
Rows border_of(const Diagram& diagram) {
  Rows rows;
  for (std::size_t region = 0; region < diagram.num_regions(); ++region)
    if (!diagram.is_bounded(region)) rows.push_back(diagram.region_points()[region]);
  return rows;
}

/// Adds the ends of the edges at each vertex: two vertices have one if they have regions in common that no
/// third vertex has.
void join_by_regions(const Diagram& diagram, std::vector<Rows>& neighbors) {
  std::vector<Rows> regions(diagram.num_vertices());
  for (std::size_t region = 0; region < diagram.num_regions(); ++region)
    for (const SignedIndex vertex : diagram.region(region))
      if (vertex >= 0) regions[at(vertex)].push_back(static_cast<SignedIndex>(region));
  for (std::size_t v = 0; v < regions.size(); ++v) {
    std::map<SignedIndex, Rows> common;  // of v and each other vertex
    for (const SignedIndex region : regions[v])
      for (const SignedIndex w : diagram.region(at(region)))
        if (w >= 0 && at(w) != v) common[w].push_back(region);
    for (const auto& [w, of_both] : common) {
      if (of_both.size() < static_cast<std::size_t>(diagram.affine_dimension())) continue;
      const bool is_edge =
          std::none_of(common.begin(), common.end(), [&, &w = w, &of_both = of_both](const auto& other) {
            return other.first != w &&
                   std::includes(other.second.begin(), other.second.end(), of_both.begin(), of_both.end());
          });
      if (is_edge) neighbors[v].push_back(w);
    }
  }
}

/// The vertices at the other ends of the edges of each vertex, and −1 for each ray.
std::vector<Rows> neighbors_of(const Diagram& diagram) {
  std::vector<Rows> neighbors(diagram.num_vertices());
  const auto join = [&](SignedIndex a, SignedIndex b) {
    if (a >= 0 && b >= 0 && a != b) neighbors[at(a)].push_back(b), neighbors[at(b)].push_back(a);
  };
  const int k = diagram.affine_dimension();
  if (k == 1)
    for (std::size_t region = 0; region < diagram.num_regions(); ++region)
      if (const auto ends = diagram.region(region); ends.size() == 2) join(ends[0], ends[1]);
  for (std::size_t i = 0; (k == 2 || k == 3) && i < diagram.num_ridges(); ++i) {
    const auto ridge = diagram.ridge(i);
    for (std::size_t j = 0; j < ridge.size(); ++j) join(ridge[j], ridge[(j + 1) % ridge.size()]);
  }
  if (k > 3) join_by_regions(diagram, neighbors);
  for (Rows& row : neighbors) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }
  for (const SignedIndex vertex : diagram.ray_vertices()) neighbors[at(vertex)].push_back(-1);
  return neighbors;
}

}  // namespace
}  // namespace io

void write_qhull(const std::string& path, const Diagram& diagram, const std::string& outputs) {
  using namespace io;
  if (!diagram.has_ridges()) fail(Errc::unsupported, "the diagram was made without ridges");
  write_qhull_outputs(path, outputs, "a diagram",
                      {{"o", [&](AtomicFile& file) { put_regions(file, diagram); }},
                       {"p",
                        [&](AtomicFile& file) {
                          file.print("{}\n{}\n", diagram.dimension(), diagram.num_vertices());
                          put_vertices(file, diagram, false);
                        }},
                       {"Fv", [&](AtomicFile& file) { put_ridges(file, diagram); }},
                       {"Fx", [&](AtomicFile& file) { put_column(file, border_of(diagram)); }},
                       {"Fn", [&](AtomicFile& file) {
                          NumberLists lists;
                          for (const Rows& row : neighbors_of(diagram)) lists.add(row);
                          file.print("{}\n", lists.size());
                          put_counted(file, lists);
                        }}});
}

}  // namespace delone
