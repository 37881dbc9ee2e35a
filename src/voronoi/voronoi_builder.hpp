// SPDX-License-Identifier: BSD-3-Clause
// From the cells of a triangulation to the arrays of its Voronoi or power diagram, in the order of the
// members of run().
#pragma once

#include <delone/voronoi.hpp>

#include <span>
#include <unordered_map>
#include <vector>

namespace delone {

class VoronoiBuilder {
 public:
  VoronoiBuilder(const Triangulation& triangulation, const std::function<double(VertexId)>& weight,
                 VoronoiDiagram& out);

  void run() {
    sort_cells();
    collect_sites();
    find_centers();
    merge_finite_cells();
    merge_infinite_cells();
    number_vertices();
    collect_stars();
    if (out_.has_ridges_) collect_ridges();
    collect_regions();
    collect_rays();
  }

 private:
  /// Finite cells by their largest vertex: the last round of an insertion along a space-filling curve has
  /// most vertices, so that cells that follow each other are close to each other, in space and thus in
  /// memory. Half of the time depends on it.
  void sort_cells();
  /// The vertices of finite cells: hidden points have no region.
  void collect_sites();
  /// The centre of every finite cell, in sorted order.
  void find_centers();
  /// Cells of one sphere become one class. They are connected: they triangulate one polytope. As centres are
  /// rounded correctly, only neighbors with equal centres need the exact test.
  void merge_finite_cells();
  /// Infinite cells become one class if their hull facets lie in one hyperplane of the flat and the cells
  /// behind have one sphere: their unbounded edges are then the same.
  void merge_infinite_cells();
  void number_vertices();
  /// The finite cells of each site, as places, increasing: where no cells merge, places are Voronoi vertices
  /// and this is the list of the region. Not for k = 2.
  void collect_stars();
  void collect_regions();
  void collect_regions_in_plane();
  void walk_region(std::size_t region, VertexId site, std::vector<SignedIndex>& items);
  void collect_ridges();
  void collect_ridges_in_plane();
  void collect_ridges_in_space();
  void collect_ridges_by_region();
  /// Whether the Delaunay face whose interior holds the edge is the edge itself, so that its dual has
  /// dimension k−1: no site off the line through both is common to all polytopes (classes of cells) around
  /// the edge.
  bool is_ridge(VertexId s, VertexId t, std::span<const Index> star);
  void add_ridge(VertexId s, VertexId t, std::span<const SignedIndex> vertices);
  void collect_rays();

  Index root(Index cell);
  void unite(Index a, Index b);
  const double* center(CellId c) const {
    return centers_.data() + static_cast<std::size_t>(vertex_of_cell_[index(c)]) * d_;
  }
  bool is_on_sphere(CellId cell, VertexId v) const;
  std::span<const VertexId> class_vertices(Index root, std::vector<VertexId>& storage) const;
  const double* point(VertexId v) const {
    return coordinates_.data() + static_cast<std::size_t>(index(v)) * d_;
  }
  SignedIndex row_of(VertexId v) const { return row_of_vertex_[index(v)]; }
  SignedIndex region_of(VertexId v) const { return region_of_vertex_[index(v)]; }

  const Triangulation& triangulation_;
  const std::function<double(VertexId)>& weight_;
  VoronoiDiagram& out_;
  const Complex complex_;
  const int k_;
  const std::size_t d_;
  const std::vector<int> axes_;
  std::vector<VertexId> site_of_region_;
  std::vector<double> coordinates_, weights_;                  // by vertex id
  std::vector<SignedIndex> region_of_vertex_, row_of_vertex_;  // −1: not a site
  std::vector<CellId> cells_;                                  // the finite ones, sorted
  std::vector<VertexId> corners_;  // k+1 for each of cells_, until all lists are made
  std::vector<CellId> neighbors_;  // as many; those of the complex lie far from each other
  std::vector<double> centers_;    // by place in cells_, then by Voronoi vertex
  std::vector<Index> parent_;      // by slot: the classes of cells, a forest; empty: no cells merged
  std::vector<SignedIndex> vertex_of_cell_;  // by slot: the place in centers_; −1: not a finite cell
  bool has_merged_ = false;
  std::unordered_map<Index, std::vector<VertexId>>
      sites_of_class_;  // of classes of more than one cell: sorted
};

}  // namespace delone
