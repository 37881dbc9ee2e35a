// SPDX-License-Identifier: BSD-3-Clause
// A triangulation that is edited, and beside it plain lists of what its rows are to be. Every call goes to
// both, and what the triangulation then says of rows, ids and changes is compared with the lists and with
// what it said before. The first thing that is not as it should be is kept as text, for tests of any
// framework.
#pragma once

#include "seen_triangulation.hpp"

#include <delone/check.hpp>
#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/regular.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone::test {

/// An edit in lists of its own.
struct EditLists {
  std::vector<std::size_t> remove = {}, move = {}, reweight = {};
  std::vector<double> to = {}, weights = {}, insert = {}, insert_weights = {};

  bool is_empty() const { return remove.empty() && move.empty() && reweight.empty() && insert.empty(); }
};

template <class Product>
class EditHistory {
 public:
  static constexpr bool has_weights = std::is_same_v<Product, Regular<>>;
  static constexpr bool may_hide = !std::is_same_v<Product, Delaunay<>>;
  using Seen = SeenTriangulation;

  EditHistory(int dimension, const Options& options, bool records_changes, bool records_undo)
      : options_(options),
        records_changes_(records_changes),
        records_undo_(records_undo),
        product_(dimension, options) {
    product_.record_changes(records_changes);
    product_.record_undo(records_undo);
  }

  /// The first fault, or nothing.
  const std::string& fault() const { return fault_; }
  const Product& product() const { return product_; }
  int dimension() const { return product_.dimension(); }
  std::size_t num_rows() const { return rows_.size(); }
  bool is_there(std::size_t row) const { return rows_[row].is_there; }
  const std::vector<double>& point(std::size_t row) const { return rows_[row].point; }
  double weight(std::size_t row) const { return rows_[row].weight; }
  bool can_undo() const { return last_.has_value(); }
  /// The rows that are there.
  std::vector<std::size_t> rows() const {
    std::vector<std::size_t> result;
    for (std::size_t row = 0; row < rows_.size(); ++row)
      if (rows_[row].is_there) result.push_back(row);
    return result;
  }

  void insert(const std::vector<double>& point, double weight, std::optional<CellId> hint = std::nullopt) {
    EditLists lists;
    lists.insert = point;
    lists.insert_weights = {weight};
    const std::size_t row = num_rows();
    InsertResult result;
    apply(lists, [&] {
      if constexpr (has_weights)
        result = product_.insert(point, weight, hint);
      else
        result = product_.insert(point, hint);
    });
    const std::vector<std::size_t>& here = places_.at(place(row));
    require(result.vertex == product_.vertex_at(row), "insert() tells another vertex");
    require(result.inserted == (result.vertex != invalid_vertex && here.size() == 1),
            "insert() says that a point is new, or that it is not");
  }
  void remove(std::size_t row) {
    apply({.remove = {row}}, [&] { product_.remove(row); });
  }
  void move(std::size_t row, const std::vector<double>& to) {
    apply({.move = {row}, .to = to}, [&] { product_.move(row, to); });
  }
  void set_weight(std::size_t row, double weight) {
    if constexpr (has_weights)
      apply({.reweight = {row}, .weights = {weight}}, [&] { product_.set_weight(row, weight); });
  }
  void insert_range(const std::vector<double>& points, const std::vector<double>& weights) {
    apply({.insert = points, .insert_weights = weights}, [&] {
      if constexpr (has_weights)
        product_.insert_range(points, weights);
      else
        product_.insert_range(points);
    });
  }
  void edit(const EditLists& lists) {
    apply(lists, [&] { product_.edit(to_edit(lists)); });
  }

  /// An edit that may fail, and then changes nothing; it is taken back if it does not. Returns whether it has
  /// failed.
  bool try_in_vain(const EditLists& lists) {
    if (lists.is_empty()) return false;
    const Seen before(product_);
    product_.record_undo(true);
    bool has_failed = false;
    try {
      product_.edit(to_edit(lists));
      product_.undo();
    } catch (const Error& error) {
      has_failed = true;
      require(!std::string(error.what()).empty(), "an error without a message");
    }
    require(Seen(product_) == before, "an edit in vain has left something behind");
    product_.record_undo(false);  // forgets what could be undone before
    product_.record_undo(records_undo_);
    last_.reset();
    return has_failed;
  }

  static Edit<> to_edit(const EditLists& lists) {
    Edit<> edit;
    edit.remove = lists.remove;
    edit.move = lists.move;
    edit.to = AnyPoints<>(std::span(lists.to));
    edit.reweight = lists.reweight;
    edit.weights = lists.weights;
    edit.insert = AnyPoints<>(std::span(lists.insert));
    if (has_weights) edit.insert_weights = lists.insert_weights;
    return edit;
  }

  /// Takes back the last call, if that can be.
  void undo() {
    require(product_.can_undo() == can_undo(), "can_undo() is wrong");
    if (!can_undo() || !fault_.empty()) return;
    product_.undo();
    require(!product_.can_undo(), "an undo could be undone");
    require(Seen(product_) == last_->seen, "undo() has left something behind");
    rows_ = last_->rows;
    last_id_ = last_->last_id;
    last_.reset();
    find_places();
    if (!records_changes_) return;
    const Changes& now = product_.changes();
    require(now.removed_cells == changes_.created_cells && now.created_cells == changes_.removed_cells &&
                now.added_vertices == changes_.removed_vertices &&
                now.removed_vertices == changes_.added_vertices &&
                now.hidden_vertices == changes_.reappeared_vertices &&
                now.reappeared_vertices == changes_.hidden_vertices &&
                now.moved_vertices == changes_.moved_vertices,
            "changes() of undo() are not those of the edit, reversed");
  }

  void compact_ids() {
    const Seen before(product_);
    const CanonicalHash hash = product_.hash();
    const CompactedIds ids = product_.compact_ids();
    last_.reset();
    require(!product_.can_undo(), "other ids can be undone");
    require(product_.hash() == hash, "other ids, other cells");
    require(ids.rows.size() == rows_.size(), "another number of rows has other numbers");
    std::vector<Row> left;
    for (std::size_t row = 0; row < rows_.size() && fault_.empty(); ++row) {
      require(ids.rows[row] == (rows_[row].is_there ? left.size() : CompactedIds::no_row),
              "the number of a row has become another one");
      if (rows_[row].is_there) left.push_back(rows_[row]);
    }
    rows_ = std::move(left);
    for (Row& row : rows_)
      if (row.vertex != invalid_vertex) row.vertex = ids.vertices[index(row.vertex)];
    find_places();
    Index next = 0;
    for (const VertexId v : ids.vertices)
      if (v != invalid_vertex) require(index(v) == next++, "ids are not in their order");
    require(may_hide ? next > places_.size() : next == places_.size() + 1, "ids have gaps");
    last_id_ = next - 1;
    for (std::size_t i = 0; i < before.vertices.size() && fault_.empty(); ++i) {
      const auto x = product_.point(ids.vertices[index(before.vertices[i])]);
      require(std::equal(x.begin(), x.end(), before.points[i].begin()), "an id has another point");
    }
    require(product_.num_rows() == rows_.size(), "rows have gaps");
    require_ids();
  }
  void compact() {
    const CanonicalHash hash = product_.hash();
    product_.compact();
    last_.reset();
    require(!product_.can_undo(), "what compact() has left can be undone");
    require(product_.hash() == hash, "compact() has changed cells");
    require_ids();
  }
  /// Goes on with a copy.
  void clone() {
    Product copy = product_.clone();
    require(Seen(copy) == Seen(product_), "a copy is different");
    require(!copy.can_undo(), "a copy can be undone");
    product_ = std::move(copy);
    last_.reset();
  }

  /// It is what all rows that are left make at once.
  void compare_with_batch() {
    std::vector<double> points, weights;
    for (const Row& row : rows_) {
      if (!row.is_there) continue;
      points.insert(points.end(), row.point.begin(), row.point.end());
      weights.push_back(row.weight);
    }
    Product batch(dimension(), options_);
    if constexpr (has_weights)
      batch.insert_range(points, weights);
    else
      batch.insert_range(points);
    require(batch.affine_dimension() == product_.affine_dimension(), "another affine dimension");
    require(batch.num_points() == product_.num_points(), "another number of points");
    require(batch.num_vertices() == product_.num_vertices(), "another number of vertices");
    require(batch.num_duplicates() == product_.num_duplicates(), "another number of duplicates");
    require(batch.num_hidden() == product_.num_hidden(), "another number of hidden points");
    require(batch.num_infinite_cells() == product_.num_infinite_cells(), "another number of infinite cells");
    require(batch.hash() == product_.hash(), "other cells");
    std::vector<std::size_t> hidden;
    std::size_t of_batch = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      if (!rows_[row].is_there) continue;
      if (batch.is_hidden(of_batch++)) hidden.push_back(row);
    }
    require(hidden == product_.hidden_rows(), "other rows are hidden");
  }
  /// It passes every exact check.
  void check_all_levels() {
    CheckOptions options;
    options.canonical = true;
    options.furthest_site = product_.kind() == TriangulationKind::furthest_site;
    const ComplexData data = product_.to_data();
    const CheckReport report = check(data, options);
    require(report.ok, "check: " + report.violation);
    require(canonical_hash(data) == product_.hash(), "the data have another hash");
  }

 private:
  struct Row {
    std::vector<double> point;
    double weight = 0;
    bool is_there = true;
    VertexId vertex = invalid_vertex;  // if it is known: that of a point that was always hidden is not
  };
  using Place = std::vector<double>;  // a point, with its weight
  using Places = std::map<Place, std::vector<std::size_t>>;
  struct Last {
    Seen seen;
    std::vector<Row> rows;
    Index last_id;
  };

  void require(bool condition, const std::string& what) {
    if (!condition && fault_.empty()) fault_ = what;
  }

  Place place(std::size_t row) const {
    Place result = rows_[row].point;
    if (has_weights) result.push_back(rows_[row].weight);
    for (double& x : result) x += 0.0;  // −0 and +0 are one number
    return result;
  }
  void find_places() {
    places_.clear();
    for (std::size_t row = 0; row < rows_.size(); ++row)
      if (rows_[row].is_there) places_[place(row)].push_back(row);
  }

  template <class Call>
  void apply(const EditLists& lists, Call call) {
    if (!fault_.empty()) return;
    Seen before(product_);
    if (lists.is_empty()) {  // tells nothing new, and what was before can be taken back still
      call();
      require(Seen(product_) == before, "an edit of nothing has changed something");
      return;
    }
    const std::vector<Row> rows_before = rows_;
    const Places places_before = places_;
    const Index last_id_before = last_id_;
    call();
    change_rows(lists);
    find_places();
    const Seen after(product_);
    follow_vertices(before, rows_before, places_before, after);
    require_ids(after);
    for (const VertexId v : after.vertices) last_id_ = std::max(last_id_, index(v));
    if (records_changes_) {
      changes_ = product_.changes();
      for (const VertexId v : changes_.added_vertices) last_id_ = std::max(last_id_, index(v));
      compare_cells(before, after);
      compare_vertices(before, after, last_id_before, rows_before, places_before);
    }
    if (records_undo_)
      last_ = Last{std::move(before), rows_before, last_id_before};
    else
      last_.reset();
    require(product_.can_undo() == records_undo_, "can_undo() is wrong");
  }

  void change_rows(const EditLists& lists) {
    const auto d = static_cast<std::size_t>(dimension());
    const auto point_of = [&](const std::vector<double>& points, std::size_t i) {
      return std::vector<double>(points.begin() + static_cast<std::ptrdiff_t>(i * d),
                                 points.begin() + static_cast<std::ptrdiff_t>((i + 1) * d));
    };
    for (const std::size_t row : lists.remove) rows_[row].is_there = false;
    for (std::size_t i = 0; i < lists.move.size(); ++i) rows_[lists.move[i]].point = point_of(lists.to, i);
    for (std::size_t i = 0; i < lists.reweight.size(); ++i)
      rows_[lists.reweight[i]].weight = lists.weights[i];
    for (std::size_t i = 0; i < lists.insert.size() / d; ++i)
      rows_.push_back({point_of(lists.insert, i), has_weights ? lists.insert_weights[i] : 0.0});
  }

  static Place place_of(const Row& row) {
    Place result = row.point;
    if (has_weights) result.push_back(row.weight);
    for (double& x : result) x += 0.0;
    return result;
  }
  bool is_alone(std::size_t row, const Places& places, const std::vector<Row>& rows) const {
    return places.at(place_of(rows[row])).size() == 1;
  }
  bool has_moved(std::size_t row, const std::vector<Row>& before) const {
    return place_of(before[row]) != place(row);
  }

  /// Rows that nothing has happened to keep their vertices, and one that moves alone takes its own along.
  void follow_vertices(const Seen& seen_before, const std::vector<Row>& before, const Places& places_before,
                       const Seen& after) {
    for (std::size_t row = 0; row < rows_.size() && fault_.empty(); ++row) {
      if (!rows_[row].is_there) continue;
      const VertexId now = after.vertex_at[row];
      const bool was_there = row < before.size();
      const bool is_alone_now = is_alone(row, places_, rows_);
      bool keeps = was_there && !has_moved(row, before), must_be_new = false;
      if (was_there && !keeps) {
        const bool was_alone = is_alone(row, places_before, before);
        keeps = was_alone && is_alone_now;
        // Its vertex stays with the others. Equal points that are hidden may be several vertices.
        const std::vector<std::size_t>& others = places_before.at(place_of(before[row]));
        must_be_new = is_alone_now && seen_before.vertex_at[row] != invalid_vertex &&
                      std::any_of(others.begin(), others.end(), [&](std::size_t other) {
                        return rows_[other].is_there && !has_moved(other, before);
                      });
      } else if (!was_there) {
        must_be_new = is_alone_now;
      }
      if (must_be_new && now != invalid_vertex)
        require(index(now) > last_id_, "a new vertex has an id that was used before");
      if (!keeps) rows_[row].vertex = invalid_vertex;
      if (now == invalid_vertex) {
        if (!is_alone_now && has_other_vertices(row)) rows_[row].vertex = invalid_vertex;
        continue;
      }
      if (rows_[row].vertex != invalid_vertex)
        require(rows_[row].vertex == now, "row " + std::to_string(row) + " has another vertex");
      rows_[row].vertex = now;
    }
  }

  /// Whether other rows at the place of a hidden one may have vertices of their own, one of which is the
  /// vertex when it is no longer hidden.
  bool has_other_vertices(std::size_t row) const {
    const std::vector<std::size_t>& here = places_.at(place(row));
    return std::any_of(here.begin(), here.end(),
                       [&](std::size_t other) { return rows_[other].vertex != rows_[row].vertex; });
  }

  void require_ids() { require_ids(Seen(product_)); }
  /// Rows, places and vertices belong together.
  void require_ids(const Seen& now) {
    require(now.has_row.size() == rows_.size(), "another number of rows");
    if (!fault_.empty()) return;
    for (std::size_t row = 0; row < rows_.size(); ++row)
      require(now.has_row[row] == rows_[row].is_there,
              "a row is there and should not be, or the other way round");
    std::size_t num_visible = 0, num_points = 0, num_duplicates = 0, num_hidden = 0;
    for (const auto& [where, rows] : places_) {
      const VertexId v = now.vertex_at[rows.front()];
      const bool is_hidden = v == invalid_vertex;
      num_points += rows.size();
      (is_hidden ? num_hidden : num_duplicates) += is_hidden ? rows.size() : rows.size() - 1;
      for (const std::size_t row : rows) {
        require(now.vertex_at[row] == v, "equal points are different vertices");
        require(now.is_hidden[row] == is_hidden, "is_hidden() is not what vertex_at() says");
      }
      if (is_hidden) {
        require(may_hide, "a point is hidden");
        continue;
      }
      ++num_visible;
      require(now.sees(v), "the vertex of a row is none");
      if (!fault_.empty()) return;
      const auto at = static_cast<std::size_t>(std::lower_bound(now.vertices.begin(), now.vertices.end(), v) -
                                               now.vertices.begin());
      require(now.first_rows[at] == rows.front(), "another row is the first one at a vertex");
      require(std::equal(now.points[at].begin(), now.points[at].end(), where.begin()),
              "a vertex is at another point");
      if constexpr (has_weights) require(product_.weight(v) == where.back(), "a vertex has another weight");
    }
    require(num_visible == now.vertices.size() && num_visible == now.num_vertices, "vertices without rows");
    require(
        num_points == now.num_points && num_duplicates == now.num_duplicates && num_hidden == now.num_hidden,
        "numbers of points, duplicates and hidden points are wrong");
    const Complex complex = product_.complex();
    for (const VertexId v : now.vertices)
      require(complex.is_cell(complex.incident_cell(v)) && complex.index_of(complex.incident_cell(v), v) >= 0,
              "the cell of a vertex does not have it");
    const std::size_t corners = static_cast<std::size_t>(now.affine_dimension) + 1;
    Index num_infinite = 0;
    for (const auto& [cell, links] : now.cells) {
      num_infinite +=
          std::count(links.begin(), links.begin() + static_cast<std::ptrdiff_t>(corners), Index{0});
      for (std::size_t i = 0; i < corners; ++i) {
        const auto there = now.cells.find(CellId{links[corners + i]});
        require(there != now.cells.end() &&
                    std::count(there->second.begin() + static_cast<std::ptrdiff_t>(corners),
                               there->second.end(), index(cell)) == 1,
                "neighbors are not mutual");
      }
    }
    require(num_infinite == now.num_infinite_cells, "infinite cells are counted wrongly");
  }

  template <class Id>
  static bool is_ascending(const std::vector<Id>& list) {
    return std::adjacent_find(list.begin(), list.end(), [](Id a, Id b) { return !(a < b); }) == list.end();
  }
  template <class Id>
  static bool has(const std::vector<Id>& list, Id id) {
    return std::binary_search(list.begin(), list.end(), id);
  }

  /// Cells in neither list have their ids and vertices still.
  void compare_cells(const Seen& before, const Seen& after) {
    const std::vector<CellId>&removed = changes_.removed_cells, &created = changes_.created_cells;
    require(is_ascending(removed) && is_ascending(created), "cells are not in order");
    for (const CellId c : removed) require(before.cells.contains(c), "a cell was removed that was none");
    for (const CellId c : created) require(after.cells.contains(c), "a cell was created that is none");
    const std::size_t corners = static_cast<std::size_t>(before.affine_dimension) + 1;
    for (const auto& [cell, links] : before.cells) {
      if (has(removed, cell)) continue;
      require(!has(created, cell), "a cell was created in the place of one that was not removed");
      const auto now = after.cells.find(cell);
      require(now != after.cells.end(), "a cell has gone that was not removed");
      require(before.affine_dimension == after.affine_dimension, "a cell has outlived its dimension");
      if (!fault_.empty()) return;
      for (std::size_t i = 0; i < corners; ++i) {
        require(now->second[i] == links[i], "a cell has other vertices");
        const CellId neighbor{links[corners + i]}, now_there{now->second[corners + i]};
        require(neighbor == now_there ? has(removed, neighbor) == has(created, neighbor)
                                      : has(removed, neighbor) && has(created, now_there),
                "a cell has another neighbor that is not new");
      }
    }
    for (const auto& [cell, links] : after.cells)
      require(has(created, cell) || (before.cells.contains(cell) && !has(removed, cell)),
              "a cell has come that was not created");
  }

  void compare_vertices(const Seen& before, const Seen& after, Index last_id_before,
                        const std::vector<Row>& rows_before, const Places& places_before) {
    const Changes& c = changes_;
    require(is_ascending(c.added_vertices) && is_ascending(c.removed_vertices) &&
                is_ascending(c.hidden_vertices) && is_ascending(c.reappeared_vertices) &&
                is_ascending(c.moved_vertices),
            "vertices are not in order");
    require(may_hide ||
                c.added_vertices.size() + places_before.size() == c.removed_vertices.size() + places_.size(),
            "as many vertices have not come as there are more, or gone as there are fewer");
    for (const VertexId v : c.added_vertices) require(index(v) > last_id_before, "a vertex has come again");
    for (const VertexId v : c.removed_vertices)
      require(index(v) <= last_id_before && !after.sees(v),
              "a vertex has gone that was not there, or still is");
    std::vector<VertexId> lost, back;
    for (const VertexId v : before.vertices)
      if (!after.sees(v) && !has(c.removed_vertices, v)) lost.push_back(v);
    for (const VertexId v : after.vertices) {
      if (before.sees(v)) {
        const bool weighs_other =
            has_weights && place_of_vertex(v, before, rows_before) != place_of_vertex(v, after, rows_);
        require(has(c.moved_vertices, v) == (before.point(v) != after.point(v) || weighs_other),
                "a vertex has moved, or has not");
      } else if (index(v) <= last_id_before) {
        back.push_back(v);
      } else {
        require(has(c.added_vertices, v), "a new vertex has not come");
      }
    }
    require(c.hidden_vertices == lost, "other vertices have become hidden");
    require(c.reappeared_vertices == back, "other vertices have come back");
    for (const VertexId v : c.moved_vertices)
      require(!has(c.removed_vertices, v) && !has(c.added_vertices, v),
              "a vertex has moved that is new or gone");
    // What rows say.
    std::vector<VertexId> stay, removed;
    for (std::size_t row = 0; row < rows_before.size(); ++row) {
      const VertexId v = rows_before[row].vertex;
      if (!rows_before[row].is_there || v == invalid_vertex) continue;
      if (rows_[row].is_there &&
          (!has_moved(row, rows_before) ||
           (is_alone(row, places_before, rows_before) && is_alone(row, places_, rows_))))
        stay.push_back(v);
      if (!rows_[row].is_there && is_alone(row, places_before, rows_before)) removed.push_back(v);
    }
    for (const VertexId v : stay) require(!has(c.removed_vertices, v), "a vertex has gone that has a row");
    for (const VertexId v : removed)
      require(has(c.removed_vertices, v), "a vertex without rows has not gone");
  }
  static Place place_of_vertex(VertexId v, const Seen& seen, const std::vector<Row>& rows) {
    const auto at = std::lower_bound(seen.vertices.begin(), seen.vertices.end(), v) - seen.vertices.begin();
    return place_of(rows[seen.first_rows[static_cast<std::size_t>(at)]]);
  }

  Options options_;
  bool records_changes_, records_undo_;
  Product product_;
  std::vector<Row> rows_;
  Places places_;
  Index last_id_ = 0;  // the largest vertex id that has been seen
  std::optional<Last> last_;
  Changes changes_;
  std::string fault_;
};

}  // namespace delone::test
