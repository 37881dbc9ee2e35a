// SPDX-License-Identifier: BSD-3-Clause
// The triangulation of the points of a periodic set, in the box of its lattice, and of as many images of
// them, ghosts, as it takes: until no cell with a vertex of the set is in conflict with any image. Then these
// cells are all cells of the periodic triangulation at the points of the set.
//
// Why. A cell that no point of the whole set is in conflict with, ties perturbed by coordinates alone, is a
// cell of the whole; translations change no answer, as they are exact. The star of a vertex, closed by cells
// of the whole, is its whole star. A facet of the hull stays one if it is parallel to the lattice, as then
// every image of a point is as far below it as the point. Beyond other facets at a point p of the set lies
// p + a_i or p − a_i, and is inserted.
#pragma once

#include "periodic/images.hpp"
#include "triangulation/row_triangulation.hpp"

#include <delone/options.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace delone::periodic {

/// What ghosts have cost.
struct GhostEffort {
  std::size_t num_ghosts = 0, num_rounds = 0;
  std::uint64_t questions = 0, pages = 0;
};

class GhostTriangulation {
 public:
  /// REQUIRES that the set outlives the object.
  GhostTriangulation(const PeriodicSet& set, const Options& options);
  /// The same, of a set whose points have moved from those of another triangulation, row by row: where most
  /// have moved little, a copy of that one is repaired (ghost_step.cpp).
  GhostTriangulation(const PeriodicSet& set, const GhostTriangulation& before, const Options& options);
  GhostTriangulation(const GhostTriangulation&) = delete;
  GhostTriangulation& operator=(const GhostTriangulation&) = delete;

  /// Its rows are points of the set and ghosts, in any order.
  const Triangulation& triangulation() const { return made_->get(); }
  /// Of a finite vertex: the first row of the set at its point, and the shift; 0 for a point of the set.
  const Image& image_of(VertexId v) const { return image_of_vertex_[index(v)]; }
  /// The vertex at a point of the set; invalid_vertex if it is hidden.
  VertexId vertex_of_row(std::size_t row) const { return triangulation().vertex_at(own_row_[row]); }
  /// The id of that vertex, hidden or not.
  VertexId id_of_row(std::size_t row) const;
  std::size_t num_ids() const { return image_of_vertex_.size(); }
  /// Whether this is a repaired copy of another one: then vertices that both have go by the same ids.
  bool comes_from(const GhostTriangulation& other) const { return origin_ == other.identity_; }
  bool is_own(VertexId v) const { return v != infinite_vertex && image_of(v).shift == 0; }
  std::span<const std::int32_t> offset_of(VertexId v) const { return images_.shift(image_of(v).shift).k; }
  const Images& images() const { return images_; }
  const GhostEffort& effort() const { return effort_; }

 private:
  template <int D>
  class Asking;
  class Step;

  /// An image that a cell is in conflict with, and its place among the pages if it was searched there.
  struct Found {
    Image image;
    std::optional<pages::PointPlace> place;
    CellId cell;
  };

  void construct(const Options& options);
  void begin();
  bool ask_and_insert(std::size_t most_found);
  void ask();
  void insert_found();
  bool step_from(const GhostTriangulation& before);
  void enter_vertices();

  const PeriodicSet& set_;
  unsigned threads_;  // as Options::threads
  Images images_;
  std::optional<triangulation::RowTriangulation> made_;
  std::vector<Image> image_of_row_;     // by row of the triangulation
  std::vector<std::uint32_t> own_row_;  // the row of the triangulation of each point of the set
  std::vector<Image> image_of_vertex_;  // by vertex id
  std::size_t num_rows_done_ = 0;       // rows whose vertices are entered
  Index first_new_vertex_ = 1;          // of the last insertion
  std::vector<Found> found_;            // to be inserted next
  GhostEffort effort_;
  std::shared_ptr<const char> identity_ = std::make_shared<const char>('\0'), origin_;
  std::uint32_t num_failures_ = 0;  // of repairs, one after the other
  std::uint32_t num_skipped_ = 0;   // steps since that were not tried
  // What there was when all cells were constructed.
  std::size_t num_constructed_ = 0;                            // rows
  std::vector<double> constructed_below_, constructed_above_;  // what was known beside the box
};

}  // namespace delone::periodic
