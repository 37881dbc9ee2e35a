// SPDX-License-Identifier: BSD-3-Clause
// A tile whose questions are all answered becomes its part of the triangulation: the cells whose
// lexicographically smallest vertex is its own. In a periodic set these are one of each class of translates,
// as a translation keeps the order of points.
#include "base/atomic_ref.hpp"
#include "base/parallel_parts.hpp"
#include "tiles/tile_triangulation.hpp"
#include "triangulation/stored_points.hpp"

#include <delone/cell_numbers.hpp>

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>

namespace delone::tiles {

namespace {

constexpr std::size_t slots_per_part = 16384;
constexpr std::int32_t unknown = -2;

/// Whether the neighbor across a facet is known: the cell there has a vertex of the tile, and so is a cell of
/// the whole.
class PartMaker {
 public:
  PartMaker(const Triangulation& triangulation, const std::vector<std::uint8_t>& is_own,
            const std::vector<std::int64_t>& row_of, const std::vector<std::uint32_t>& shift_of,
            const Surroundings& surroundings, unsigned threads)
      : complex_(triangulation.complex()),
        points_(triangulation::StoredPoints::of(triangulation)),
        is_own_(is_own),
        row_of_(row_of),
        shift_of_(shift_of),
        surroundings_(surroundings),
        r_(surroundings.rank()),
        threads_(threads),
        d_(static_cast<std::size_t>(points_.ambient)),
        corners_(static_cast<std::size_t>(complex_.affine_dimension() + 1)),
        is_chosen_(complex_.num_cell_slots(), 0),
        is_used_(points_.last_vertex() + std::size_t{1}, 0) {}

  FinishedTile make() {
    FinishedTile result;
    TileData& data = result.data;
    data.dimension = points_.ambient;
    data.affine_dimension = complex_.affine_dimension();
    data.rank = static_cast<int>(r_);
    make_tags();
    add_vertices(result);
    choose_cells(result);
    number_cells();
    if (r_ == 0)
      number_points(data);
    else
      number_periodic_points(data);
    write_cells(data);
    find_seams(result);
    return result;
  }

 private:
  bool is_vertex(std::size_t v) const {
    return v < complex_.num_vertex_slots() && complex_.is_vertex(VertexId{static_cast<Index>(v)});
  }
  const double* point(VertexId v) const { return points_.point(index(v)); }
  bool has_own_vertex(CellId cell) const {
    for (const VertexId v : complex_.vertices(cell))
      if (is_own_[index(v)] != 0) return true;
    return false;
  }
  bool is_before(const double* a, const double* b) const {
    return std::lexicographical_compare(a, a + d_, b, b + d_);
  }
  VertexId smallest_vertex(CellId cell) const {
    const VerticesOfCell vertices = complex_.vertices(cell);
    VertexId smallest = vertices[0];
    for (const VertexId v : vertices)
      if (is_before(point(v), point(smallest))) smallest = v;
    return smallest;
  }

  void make_tags() {
    tags_.resize(is_used_.size());
    if (points_.weighted()) weighted_tags_.resize(is_used_.size());
    internal::for_parts(threads_, tags_.size(), slots_per_part,
                        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                          stop();
                          for (std::size_t v = std::max(first, std::size_t{1}); v < last; ++v) {
                            const double* const p = points_.point(static_cast<Index>(v));
                            tags_[v] = complex::point_tag(p, points_.ambient);
                            if (points_.weighted())
                              weighted_tags_[v] = complex::point_tag(p, points_.ambient + 1);
                          }
                        });
  }
  void add_vertices(FinishedTile& result) const {
    for (std::size_t v = 1; v < is_own_.size(); ++v) {
      if (is_own_[v] == 0 || !is_vertex(v)) continue;
      result.hash.add_vertex(tags_[v]);
      if (points_.weighted()) {
        result.weighted_hash.add_vertex(weighted_tags_[v]);
        const double weight = points_.point(static_cast<Index>(v))[d_];
        result.least_weight = result.num_vertices == 0 ? weight : std::min(result.least_weight, weight);
        result.largest_weight = result.num_vertices == 0 ? weight : std::max(result.largest_weight, weight);
      }
      ++result.num_vertices;
    }
  }
  /// Marks the cells of the part and the points that they use.
  void choose_cells(FinishedTile& result) {
    std::mutex mutex;
    internal::for_parts(
        threads_, is_chosen_.size(), slots_per_part,
        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
          stop();
          complex::HashAccumulator hash, weighted_hash;
          for (std::size_t slot = first; slot < last; ++slot) {
            const CellId cell{static_cast<Index>(slot)};
            if (!complex_.is_cell(cell) || complex_.is_infinite(cell) || !has_own_vertex(cell)) continue;
            if (is_own_[index(smallest_vertex(cell))] == 0) continue;
            is_chosen_[slot] = 1;
            complex::PointTag sum, weighted_sum;
            for (const VertexId v : complex_.vertices(cell)) {
              sum += tags_[index(v)];
              if (points_.weighted()) weighted_sum += weighted_tags_[index(v)];
              internal::AtomicRef<std::uint8_t>(is_used_[index(v)]).store(1, std::memory_order_relaxed);
            }
            hash.add_cell(sum);
            if (points_.weighted()) weighted_hash.add_cell(weighted_sum);
          }
          const std::lock_guard lock(mutex);
          result.hash.add(hash);
          result.weighted_hash.add(weighted_hash);
        });
    tags_ = {};
    weighted_tags_ = {};
  }
  void number_cells() {
    numbers_ = CellNumbers(is_chosen_);
    is_chosen_ = {};
    if (numbers_.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
      throw Error(Errc::too_many, "a tile has more cells than 32-bit numbers; use more tiles");
  }
  void number_points(TileData& data) {
    number_of_vertex_.resize(is_used_.size(), -1);
    for (std::size_t v = 1; v < is_used_.size(); ++v) {
      if (is_used_[v] == 0) continue;
      number_of_vertex_[v] = add_point(data, v);
    }
  }
  /// The same in the box of the lattice: first all vertices of the tile, then those of others, one for all
  /// translates of a row.
  void number_periodic_points(TileData& data) {
    number_of_vertex_.resize(is_used_.size(), -1);
    std::vector<std::pair<std::int64_t, std::int32_t>> own;    // row, number
    std::vector<std::pair<std::int64_t, std::size_t>> others;  // row, vertex
    for (std::size_t v = 1; v < is_used_.size(); ++v) {
      if (v < is_own_.size() && is_own_[v] != 0 && is_vertex(v))
        own.emplace_back(row_of_[v], number_of_vertex_[v] = add_point(data, v));
      else if (is_used_[v] != 0)
        others.emplace_back(row_of_[v], v);
    }
    std::sort(own.begin(), own.end());
    std::sort(others.begin(), others.end());
    for (std::size_t i = 0; i < others.size(); ++i) {
      const auto& [row, v] = others[i];
      const auto found = std::lower_bound(own.begin(), own.end(), std::pair(row, std::int32_t{-1}));
      number_of_vertex_[v] = found != own.end() && found->first == row ? found->second
                             : i > 0 && others[i - 1].first == row ? number_of_vertex_[others[i - 1].second]
                                                                   : add_point(data, v);
    }
  }
  std::int32_t add_point(TileData& data, std::size_t v) const {
    const double* const p = points_.point(static_cast<Index>(v));
    data.rows.push_back(row_of_[v]);
    data.points.insert(data.points.end(), p, p + d_);
    if (r_ > 0) {  // exact, on the grid of the set
      const std::span<const double> by = surroundings_.translation(shift_of_[v]);
      for (std::size_t j = 0; j < d_; ++j) data.points[data.points.size() - d_ + j] -= by[j];
    }
    if (points_.weighted()) data.weights.push_back(p[d_]);
    return static_cast<std::int32_t>(data.rows.size() - 1);
  }
  void write_cells(TileData& data) const {
    data.cells.resize(numbers_.size() * corners_);
    data.neighbors.resize(data.cells.size());
    data.cell_offsets.resize(data.cells.size() * r_);
    internal::for_parts(threads_, complex_.num_cell_slots(), slots_per_part,
                        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                          stop();
                          for (std::size_t slot = first; slot < last; ++slot) {
                            const CellId cell{static_cast<Index>(slot)};
                            const SignedIndex number = numbers_.row(cell);
                            if (number < 0) continue;
                            std::size_t at = static_cast<std::size_t>(number) * corners_;
                            const NeighborsOfCell neighbors = complex_.neighbors(cell);
                            std::size_t i = 0;
                            for (const VertexId v : complex_.vertices(cell)) {
                              data.cells[at] = number_of_vertex_[index(v)];
                              if (r_ > 0)
                                std::ranges::copy(
                                    surroundings_.offset(shift_of_[index(v)]),
                                    data.cell_offsets.begin() + static_cast<std::ptrdiff_t>(at * r_));
                              data.neighbors[at++] = neighbor_number(neighbors[i++]);
                            }
                          }
                        });
  }
  /// −1: infinite; `unknown`: of another part, or not a cell of the whole.
  std::int32_t neighbor_number(CellId neighbor) const {
    if (const SignedIndex number = numbers_.row(neighbor); number >= 0)
      return static_cast<std::int32_t>(number);
    return complex_.is_infinite(neighbor) && (has_own_vertex(neighbor) || corners_ == 1) ? -1 : unknown;
  }
  void find_seams(FinishedTile& result) const {
    std::vector<std::int32_t>& neighbors = result.data.neighbors;
    for (std::size_t at = 0; at < neighbors.size(); ++at) {
      if (neighbors[at] == -1) ++result.num_hull_facets;
      if (neighbors[at] != unknown) continue;
      neighbors[at] = -2 - static_cast<std::int32_t>(result.seams.size());
      result.seams.push_back(
          {static_cast<std::int32_t>(at / corners_), static_cast<std::int32_t>(at % corners_)});
    }
  }

  const Complex complex_;
  const sites::VertexPoints& points_;
  const std::vector<std::uint8_t>& is_own_;
  const std::vector<std::int64_t>& row_of_;
  const std::vector<std::uint32_t>& shift_of_;  // if the set is periodic
  const Surroundings& surroundings_;
  const std::size_t r_;  // the vectors of the lattice
  const unsigned threads_;
  const std::size_t d_, corners_;
  std::vector<std::uint8_t> is_chosen_;  // by slot: whether it is a cell of the part
  CellNumbers numbers_;                  // of these cells
  std::vector<std::uint8_t> is_used_;    // by vertex id, as the next three
  std::vector<std::int32_t> number_of_vertex_;
  std::vector<complex::PointTag> tags_, weighted_tags_;
};

}  // namespace

FinishedTile TileTriangulation::finish() {
  FinishedTile result;
  result.data.dimension = survey_.dimension;
  result.data.affine_dimension = survey_.affine_dimension;
  result.data.rank = static_cast<int>(surroundings_->rank());
  if (!own_.rows.empty()) {
    made_->get().sort_cells();
    result = PartMaker(triangulation(), is_own_, row_of_, shift_of_, *surroundings_, options_.threads).make();
  }
  result.num_foreign = static_cast<std::int64_t>(num_foreign_);
  result.num_rounds = static_cast<std::int64_t>(num_rounds_);

  // The rows of the tile, and what became of them.
  const auto& vertex_of_row = triangulation::StoredPoints::vertices_of_rows(triangulation());
  const Complex complex = triangulation().complex();
  std::vector<std::pair<std::int64_t, std::int64_t>> rows;
  rows.reserve(own_.rows.size() + own_.duplicates.size());
  std::vector<std::int64_t> hidden;
  for (std::size_t i = 0; i < own_.rows.size(); ++i) {
    const VertexId v = vertex_of_row[i];
    const bool is_hidden = v == invalid_vertex || !complex.is_vertex(v);
    if (is_hidden) hidden.push_back(own_.rows[i]);
    rows.emplace_back(own_.rows[i], is_hidden ? -1 : own_.rows[i]);
  }
  std::sort(hidden.begin(), hidden.end());
  result.num_hidden = static_cast<std::int64_t>(hidden.size());
  for (const Duplicate& duplicate : own_.duplicates) {
    const bool is_hidden = std::binary_search(hidden.begin(), hidden.end(), duplicate.first_row);
    (is_hidden ? result.num_hidden : result.num_duplicates) += 1;
    rows.emplace_back(duplicate.row, is_hidden ? -1 : duplicate.first_row);
  }
  made_.reset();
  std::sort(rows.begin(), rows.end());
  for (const auto& [row, vertex] : rows) {
    result.data.own_rows.push_back(row);
    result.data.vertex_of_row.push_back(vertex);
  }
  return result;
}

}  // namespace delone::tiles
