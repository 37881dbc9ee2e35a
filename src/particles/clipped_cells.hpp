// SPDX-License-Identifier: BSD-3-Clause
// Cells in a box and halfspaces: which of them lie inside, and what is left of the others.
#pragma once

#include "sites/vertex_points.hpp"
#include "voronoi/region_clipper.hpp"

#include <delone/data.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone::particles {

/// The box, and rows of d + 1 numbers a, c of halfspaces a·x + c ≤ 0.
struct Container {
  const Box& box;
  std::span<const double> halfspaces;
};

/// Whether the center of a cell of the triangulation, rounded to the nearest doubles, is certain to lie
/// inside.
bool is_inside(const double* center, std::size_t d, const Container& container);

/// One side of a clipped cell.
struct ClippedFace {
  static constexpr std::size_t wall = static_cast<std::size_t>(-1);
  std::size_t neighbor;   ///< a place in the list of neighbors, or `wall`
  double area, distance;  ///< to the neighbor's site, or to the wall
  std::size_t num_corners;
  std::vector<SignedIndex> vertices;  ///< as in SiteCells::face_vertices
};

class CellClipper {
 public:
  CellClipper(const sites::VertexPoints& points, const Container& container);

  /// The cell of a vertex among those of its neighbors. `proper`: only faces of full dimension, decided
  /// exactly. `with_vertices`: whether vertices are listed. A cell without interior has no volume and no
  /// faces.
  void clip(Index v, std::span<const Index> neighbors, bool proper, bool with_vertices);
  double volume() const { return measures_.volume; }
  /// The centroid less the site; empty if there is no volume.
  std::span<const double> offset() const { return measures_.centroid; }
  std::span<const ClippedFace> faces() const { return faces_; }
  /// d coordinates each, correctly rounded, in lexicographic order.
  std::span<const double> vertices() const { return vertices_; }

 private:
  /// Makes the vertices, one for each number of corners, and replaces these numbers by theirs.
  void list_vertices(std::vector<Index>& number);
  double distance_of(std::size_t plane, Index v, std::span<const Index> neighbors) const;

  const sites::VertexPoints& points_;
  Container container_;
  voronoi::RegionClipper clipper_;
  std::vector<voronoi::RegionClipper::Site> others_;
  solve::SimplePolytope::Measures measures_;
  std::vector<ClippedFace> faces_;
  std::vector<double> vertices_;
};

}  // namespace delone::particles
