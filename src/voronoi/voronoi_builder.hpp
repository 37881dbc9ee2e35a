// SPDX-License-Identifier: BSD-3-Clause
// From the cells of a triangulation to the arrays of its Voronoi or power diagram, in the order of the calls
// in run().
#pragma once

#include "base/quick_rounds.hpp"
#include "base/union_find.hpp"

#include <delone/voronoi.hpp>

#include <span>
#include <unordered_map>
#include <vector>

namespace delone::voronoi {

class VoronoiBuilder {
 public:
  /// `threads`: as Execution::threads.
  VoronoiBuilder(const Triangulation& triangulation, const std::function<double(VertexId)>& weight,
                 unsigned threads, Diagram& out);

  void run() {
    sort_cells();
    collect_sites();
    find_centers();
    merge_finite_cells();
    merge_infinite_cells();
    number_vertices();
    collect_stars();
    if (out_.has_ridges_) {
      keep_cells();
      collect_ridges();
    }
    collect_regions();
    collect_rays();
  }

 private:
  /// Sorts finite cells by their largest vertex. Insertion follows a space-filling curve, and most vertices
  /// belong to its last round, so consecutive cells are close to each other in space and in memory.
  /// Without this order, cache misses double the time.
  void sort_cells();
  /// Sites are the vertices of finite cells. Hidden points have no region.
  void collect_sites();
  /// The center of every finite cell, in sorted order.
  void find_centers();
  /// Merges the cells of each sphere into one class. They triangulate one polytope, so they are connected.
  /// Centers are correctly rounded, so only neighbors with equal centers need the exact test.
  void merge_finite_cells();
  /// Merges infinite cells whose hull facets are in one hyperplane of the flat, if the cells behind have one
  /// sphere: their unbounded edges coincide.
  void merge_infinite_cells();
  void number_vertices();
  /// For each site its finite cells, as positions in cells_, in increasing order. If no cells merge,
  /// positions are Voronoi vertices and this is the vertex list of the region. Not for k = 2.
  void collect_stars();
  /// The regions of finite cells, which volumes are made of. For k > 3 collect_ridges() keeps them.
  void keep_cells();
  void collect_regions();
  void collect_regions_in_plane();
  void walk_region(std::size_t region, VertexId site, std::vector<SignedIndex>& items);
  void collect_ridges();
  void collect_ridges_in_plane();
  void collect_ridges_in_space();
  void collect_ridges_by_region();
  /// Whether the edge s–t is itself the Delaunay face that contains its interior, so that its dual has
  /// dimension k−1. This holds iff every site common to all polytopes (classes of cells) around the edge is
  /// on the line through s and t.
  bool is_ridge(VertexId s, VertexId t, std::span<const Index> star);
  void add_ridge(VertexId s, VertexId t, std::span<const SignedIndex> vertices);
  template <class MakeWork>
  void collect_in_parts(std::size_t size, MakeWork make_work);
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
  const unsigned threads_;
  Diagram& out_;
  const Complex complex_;
  const int k_;
  const std::size_t d_;
  const std::vector<int> axes_;
  std::vector<VertexId> site_of_region_;
  std::vector<double> coordinates_, weights_;                  // by vertex id
  std::vector<SignedIndex> region_of_vertex_, row_of_vertex_;  // −1: not a site
  std::vector<CellId> cells_;                                  // the finite ones, sorted
  std::vector<VertexId> corners_;            // k+1 for each of cells_; freed once all lists exist
  std::vector<CellId> neighbors_;            // likewise; those of the complex are scattered
  std::vector<double> centers_;              // by position in cells_, then by Voronoi vertex
  internal::UnionFind classes_;              // of cells, by slot; empty if none merged
  std::vector<SignedIndex> vertex_of_cell_;  // by slot: the position in centers_; −1: not a finite cell
  bool has_merged_ = false;
  internal::QuickRounds round_;  // of all loops
  /// The sites of each class of several cells, sorted; by root.
  std::unordered_map<Index, std::vector<VertexId>> sites_of_class_;
};

}  // namespace delone::voronoi
