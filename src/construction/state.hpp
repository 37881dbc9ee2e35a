// SPDX-License-Identifier: BSD-3-Clause
// Sites and the sphere of cells over them, and how one vertex becomes part of it.
//
// Points with weights, and those for which vertices are furthest, may be hidden, at once or by later
// insertions and edits: their ids keep their points and have no cell. Insertions leave hidden points hidden,
// as more points only lower the lifted surface; edits may bring them back.
#pragma once

#include "compiled/triangulation_engine.hpp"
#include "construction/hidden_points.hpp"
#include "construction/landmarks.hpp"
#include "construction/record.hpp"
#include "kernel/predicates.hpp"
#include "sites/site_set.hpp"

#include <delone/complex.hpp>
#include <delone/data.hpp>
#include <delone/options.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace delone::construction {

using compiled::TriangulationEngine;

struct State {
  State(int dimension, kernel::RowForm form, const Options& given)
      : options(given), sites(dimension, form), affine_hull(dimension) {}
  /// A deep copy, without what only speeds up later calls.
  std::unique_ptr<State> clone() const;

  Options options;
  sites::SiteSet sites;
  kernel::AffineHull affine_hull;
  std::unique_ptr<TriangulationEngine> engine;  ///< none while the affine dimension is below 1
  std::vector<CellId> cell_of_vertex;           ///< by vertex id; invalid_cell for those that have none
  Index num_vertices = 0;                       ///< those that have cells
  /// A batch was large enough for several threads: until cells are sorted, their ids may tell of timing.
  bool ids_tell_of_timing = false;
  Statistics statistics;
  std::unique_ptr<Landmarks> landmarks;  ///< from an insertion without hint on, until the frame changes
  std::unique_ptr<HiddenPoints> hidden_points;  ///< from the first edit that needs them on
  Record* record = nullptr;                     ///< of the transaction that is going on
  /// The links of the complex of one point, a finite and an infinite cell of one vertex each.
  Index single_links[4] = {0, 1, 0, 0};

  Index& only_vertex() { return single_links[0]; }
  int dimension() const { return sites.points().ambient; }
  std::size_t ambient() const { return static_cast<std::size_t>(dimension()); }
  std::size_t row_size() const { return sites.points().row_size(); }
  bool weighted() const { return sites.points().weighted(); }
  bool is_furthest() const { return sites.points().form == kernel::RowForm::furthest_point; }
  bool may_hide() const { return sites.points().form != kernel::RowForm::point; }
  bool is_visible(Index v) const { return v < cell_of_vertex.size() && cell_of_vertex[v] != invalid_cell; }
  CellId cell_of(Index v) const { return cell_of_vertex[v]; }
  /// Valid until the next change.
  Complex complex() const;

  /// Makes vertex v, which has a point, part of the triangulation; outside the affine hull it raises the
  /// dimension. Walks from a cell, or from the last insertion. Keeps cell_of_vertex up to date. Returns the
  /// vertex at the point, or invalid_index if v is hidden. If it throws, nothing has changed, or a
  /// transaction is going on and has to be rolled back.
  Index place(Index v, Index start);
  /// The same if all points are in one place: the heaviest is the vertex, equal ones are duplicates, lighter
  /// ones hidden.
  Index place_at_only_vertex(Index v);
  /// + for a heavier point than that of the only vertex, − for a lighter one.
  int compare_with_only_vertex(const double* point) const;
  /// Brings the cells of the vertices of new cells up to date.
  void update_cells(std::span<const Index> made);
  /// The same for all vertices, of the cells of a complex.
  void find_cells_of_vertices(const Complex& now);
  void find_cells_of_vertices() { find_cells_of_vertices(complex()); }
  /// Gives cells ids that do not tell of timing; those of cell_of_vertex are outdated then.
  void sort_cells();
  /// Before the vertex gets its first cells or loses all.
  void note_visibility(Index v);
  /// Another engine takes over; a transaction keeps the one of its beginning.
  void replace_engine(std::unique_ptr<TriangulationEngine> next);

  /// A frame for the present one, or all vertices if there is none, and the box [low, high]; `margin` times
  /// its size is added on each side where it had to grow, so that points arriving from ever farther away
  /// change it a logarithmic number of times, and a quarter of that on the other sides, which often have to
  /// grow next. Weights have a range like coordinates.
  geometry::Frame frame_with(const double* low, const double* high, double margin) const;
  /// An engine without cells for the axes of a flat.
  std::unique_ptr<TriangulationEngine> new_engine(const kernel::AffineHull& flat,
                                                  const geometry::Frame& frame);

  /// Adds the vertices first … last. Without memory for them there are no landmarks. REQUIRES an engine.
  void add_landmarks(Index first, Index last);
  /// Where to start a walk to a point: a cell, or invalid_index for where the last insertion was.
  Index start_near(const double* point) const;

 private:
  void raise(Index v, kernel::AffineHull grown);
  void hide(Index v, Index start);
  void rehome_hidden_points(const engine::Change& change);
};

}  // namespace delone::construction
