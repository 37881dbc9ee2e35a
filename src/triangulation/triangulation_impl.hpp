// SPDX-License-Identifier: BSD-3-Clause
// What all kinds of triangulations share: sites with their cells, transactions on them, and what is asked of
// them.
#pragma once

#include "compiled/compact_triangulation.hpp"
#include "construction/construction.hpp"

#include <delone/triangulation.hpp>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

struct delone::Triangulation::Impl {
  Impl(int dimension, kernel::RowForm form, const Options& options)
      : state(std::make_unique<construction::State>(dimension, form, options)) {}
  /// A deep copy.
  std::unique_ptr<Impl> clone() const;

  std::unique_ptr<construction::State> state;
  std::unique_ptr<compiled::CompactTriangulation> compacted;  // after compact(), until the next change
  construction::Recording recording;
  std::unique_ptr<construction::Record> last;  // of the last transaction, if anything is wanted of it …
  construction::Recording wanted_of_last;      // … namely this

  const sites::SiteSet& sites() const { return state->sites; }
  const sites::VertexPoints& points() const { return state->sites.points(); }
  int dimension() const { return state->dimension(); }
  int affine_dimension() const { return state->affine_hull.dimension(); }
  std::size_t ambient() const { return state->ambient(); }
  bool weighted() const { return state->weighted(); }
  /// Whether the affine dimension is at least 1.
  bool has_cells() const { return state->engine || compacted; }
  /// Calls ask() with the engine, or the compact form. REQUIRES has_cells().
  template <class Ask>
  decltype(auto) visit(Ask&& ask) const {
    return state->engine ? ask(std::as_const(*state->engine)) : ask(std::as_const(*compacted));
  }
  Complex complex() const {
    return compacted ? complex_of(*compacted, state->num_vertices, state->cell_of_vertex) : state->complex();
  }

  /// `weights`: one per point, or none: all are 0. `release`, if there is one, is called when the coordinates
  /// are not needed any more, before most cells are created.
  void insert_range(std::span<const double> coordinates, std::span<const double> weights,
                    const std::function<void()>& release = {});
  InsertResult insert(std::span<const double> point, double weight, std::optional<CellId> hint);
  void edit(const construction::RowEdits& edits, Index start = invalid_index);
  /// An edit that does not rebuild everything: returns false, and nothing has changed, if that would cost
  /// less. REQUIRES lists that are valid.
  bool edit_in_place(const construction::RowEdits& edits);
  void undo();
  void record_changes(bool wanted);
  void record_undo(bool wanted);
  /// What the last transaction has done. Throws unless changes are recorded.
  const construction::AllChanges& recorded_changes() const;
  CompactedIds compact_ids();
  void compact();
  void sort_cells();

  /// Throws unless a row is one, there or removed.
  void require_row(std::size_t row) const;
  bool is_hidden(std::size_t row) const;  // throws as require_row()
  std::size_t num_hidden() const;
  std::vector<std::size_t> hidden_rows() const;

  /// A query of d coordinates and its weight, checked, as a row. REQUIRES that `row` outlives the use.
  const double* checked_query(std::span<const double> query, double weight, std::vector<double>& row) const;
  Index checked_hint(std::optional<CellId> hint) const;
  Index checked_vertex(VertexId v) const;

  std::vector<CellId> conflict_zone(std::span<const double> query, double weight,
                                    std::optional<CellId> hint) const;
  Sign in_sphere(CellId cell, std::span<const double> query, double weight) const;

 private:
  const construction::AllChanges& changes() const;
  void forget();
  void forget_changes();
  void note_unknown_changes();
  void check_finite(std::span<const double> coordinates, std::span<const double> weights) const;
  void require_idle() const;
  bool transact(const char* items, const std::function<bool(construction::Construction&)>& work,
                const std::function<void(internal::BuildLimits&)>& prepare = {});
  void expand();
  InsertResult insert_at_once(const double* point, Index start);
  Index lone_vertex_of(std::size_t row);
  engine::Outcome remove_at_once(std::size_t row);
  bool move_at_once(std::size_t row, std::span<const double> to);

  mutable std::mutex changes_mutex_;
  mutable bool are_changes_known_ = true;  // if not, `last` tells them
  mutable construction::AllChanges changes_;
};
