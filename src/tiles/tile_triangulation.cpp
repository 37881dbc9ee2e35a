// SPDX-License-Identifier: BSD-3-Clause
// Rounds of insertions and questions.
#include "tiles/tile_triangulation.hpp"

#include "base/parallel_parts.hpp"
#include "base/stopwatch.hpp"
#include "kernel/predicates.hpp"
#include "solve/cell_center.hpp"
#include "solve/outward_direction.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <cmath>

namespace delone::tiles {

namespace {

constexpr double u = 0x1p-53;

/// Whether the flat of all points is parallel to coordinate axes, so that centers are found in binary64.
bool is_aligned(const Survey& survey, std::span<const int> axes) {
  for (std::size_t j = 0; j < survey.low.size(); ++j)
    if (survey.low[j] != survey.high[j] &&
        std::find(axes.begin(), axes.end(), static_cast<int>(j)) == axes.end())
      return false;
  return true;
}

}  // namespace

/// The questions of one thread in one round.
class TileTriangulation::Asking {
 public:
  explicit Asking(TileTriangulation& tile)
      : tile_(tile),
        complex_(tile.triangulation().complex()),
        points_(triangulation::StoredPoints::of(tile.triangulation())),
        axes_(tile.triangulation().axes()),
        flat_{points_.ambient, axes_, points_.form},
        d_(static_cast<std::size_t>(points_.ambient)),
        k_(axes_.size()),
        finder_(points_.ambient, axes_, is_aligned(tile.survey_, axes_)),
        search_(tile.surroundings_->make_search(
            std::max(std::abs(tile.survey_.lowest_weight), std::abs(tile.survey_.largest_weight)))) {
    centers_.resize(solve::CenterFinder::block * d_);
    spokes_.reserve(solve::CenterFinder::block);
  }
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;

  /// All cells of these slots that are new and have a vertex of the tile.
  void ask_slots(std::size_t first, std::size_t last) {
    for (std::size_t slot = first; slot < last && !tile_.asks_in_vain_; ++slot) {
      const CellId cell{static_cast<Index>(slot)};
      if (complex_.is_cell(cell) && is_new(cell)) gather(cell);
    }
    ask_gathered();
  }
  /// The same of the cells of which one of these vertices is the last, all of them new: each cell once.
  void ask_stars(std::size_t first, std::size_t last) {
    for (std::size_t id = first; id < last && !tile_.asks_in_vain_; ++id) {
      const VertexId v{static_cast<Index>(id)};
      if (!complex_.is_vertex(v)) continue;
      for (const CellId cell : complex_.star(v)) {
        const VerticesOfCell vertices = complex_.vertices(cell);
        if (std::none_of(vertices.begin(), vertices.end(), [&](VertexId w) { return w > v; })) gather(cell);
      }
    }
    ask_gathered();
  }
  /// Asks again for cells that have waited for pages.
  void ask_again(std::span<const CellId> cells) {
    for (const CellId cell : cells)
      if (complex_.is_cell(cell) && !is_new(cell)) gather(cell);
    ask_gathered();
  }

  std::vector<ForeignPlace> found;
  std::vector<CellId> waiting;
  std::uint64_t num_questions = 0;
  std::uint64_t num_pages() const { return search_->num_pages(); }
  std::uint64_t num_exact() const { return search_->num_exact(); }

 private:
  /// Where exact arithmetic decides more points than this, as on a sphere, all points of
  /// other tiles are tried.
  static constexpr std::uint64_t most_exact_per_question = 16, some_exact = 1024;

  /// A finite cell whose center is wanted.
  struct Spoke {
    CellId cell;
    const double* own;  ///< the first vertex of the tile
  };

  bool is_new(CellId cell) const {
    for (const VertexId v : complex_.vertices(cell))
      if (v != infinite_vertex && index(v) >= tile_.first_new_vertex_) return true;
    return false;
  }
  bool is_own(VertexId v) const { return tile_.is_own_[index(v)] != 0; }
  const double* point(VertexId v) const { return points_.point(index(v)); }

  /// Puts the question of a cell with a vertex of the tile: at once, or with the next block of centers.
  void gather(CellId cell) {
    // By their ids: the order of vertices in a cell depends on threads, and rounding on that order.
    const VerticesOfCell vertices = complex_.vertices(cell);
    sorted_.assign(vertices.begin(), vertices.end());
    std::sort(sorted_.begin(), sorted_.end());
    const auto first = std::find_if(sorted_.begin(), sorted_.end(), [&](VertexId v) { return is_own(v); });
    if (first == sorted_.end()) return;
    const double* const own = point(*first);
    if (complex_.is_infinite(cell)) {
      ask_beyond(cell, own);
      return;
    }
    spokes_.push_back({cell, own});
    for (const VertexId v : sorted_) {
      corners_.push_back(point(v));
      if (points_.weighted()) weights_.push_back(corners_.back()[d_]);
    }
    if (spokes_.size() == solve::CenterFinder::block) ask_gathered();
  }

  void ask_gathered() {
    if (!spokes_.empty()) {
      finder_.find_block(spokes_.size(), corners_.data(), points_.weighted() ? weights_.data() : nullptr,
                         centers_.data());
      for (std::size_t i = 0; i < spokes_.size(); ++i) {
        const double* const center = centers_.data() + i * d_;
        if (is_within_tile(spokes_[i].own, center)) continue;
        const std::span<const double* const> corners(corners_.data() + i * (k_ + 1), k_ + 1);
        take(spokes_[i].cell, search_->within_sphere(spokes_[i].own, center, [&](const double* x) {
          return pages::is_in_sphere(flat_, corners, x);
        }));
        if (tile_.can_try_all_points() &&
            num_exact() > most_exact_per_question * num_questions + some_exact) {
          tile_.asks_in_vain_ = true;
          break;
        }
      }
      tile_.pages_asked_ += num_pages() - pages_counted_;
      pages_counted_ = num_pages();
      if (tile_.can_try_all_points() && tile_.pages_asked_ > tile_.most_pages_asked_)
        tile_.asks_in_vain_ = true;
    }
    spokes_.clear();
    corners_.clear();
    weights_.clear();
  }

  /// Whether certainly no foreign point is inside the sphere, as the tile's box contains it. The
  /// radius, and the distance of the center from either side, are off by at most what the center is,
  /// 1.01u Σ|c_j|, and (d + 6)u of their size.
  bool is_within_tile(const double* own, const double* center) const {
    double squared = 0, magnitude = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      squared += (own[j] - center[j]) * (own[j] - center[j]);
      magnitude += std::abs(center[j]);
    }
    if (points_.weighted()) squared += std::max(tile_.survey_.largest_weight - own[d_], 0.0);
    const double radius = std::sqrt(squared);
    const double reach = radius + 8 * u * (magnitude + static_cast<double>(d_ + 6) * radius) + 0x1p-500;
    const Tile& tile = tile_.tile();
    for (std::size_t j = 0; j < d_; ++j)
      if (!(center[j] - reach > tile.low[j] && center[j] + reach < tile.high[j])) return false;
    return tile_.surroundings_->is_within_period(center, reach);
  }

  /// An infinite cell. A point in the hyperplane of its facet is in conflict exactly if it is so with the
  /// finite cell behind the facet, which has the same vertices of the tile and asks for itself.
  void ask_beyond(CellId cell, const double* own) {
    const int infinite = complex_.infinite_index(cell);
    facet_.clear();
    for (const VertexId v : sorted_)
      if (v != infinite_vertex) facet_.push_back(point(v));
    const CellId behind = complex_.neighbor(cell, infinite);
    const double* const inner = point(complex_.vertex(behind, complex_.mirror_index(cell, infinite)));
    if (is_side_of_box(inner)) return;
    const std::vector<double> normal = solve::outward_direction(facet_, inner, d_);
    take(cell, search_->beyond_facet(own, normal.data(), [&](const double* x) {
      return kernel::hull_side(flat_, facet_, inner, x) == Sign::negative;
    }));
  }
  /// Whether the facet lies in a side of the box of all points: then nothing is beyond it.
  bool is_side_of_box(const double* inner) const {
    const auto lies_in = [&](std::size_t j, double bound) {
      return inner[j] != bound &&
             std::all_of(facet_.begin(), facet_.end(), [&](const double* p) { return p[j] == bound; });
    };
    for (std::size_t j = 0; j < d_; ++j)
      if (lies_in(j, tile_.survey_.low[j]) || lies_in(j, tile_.survey_.high[j])) return true;
    return false;
  }

  void take(CellId cell, const ForeignAnswer& answer) {
    ++num_questions;
    if (answer.is_waiting)
      waiting.push_back(cell);
    else if (answer.is_open)
      found.push_back(answer.place);
  }

  TileTriangulation& tile_;
  const Complex complex_;
  const sites::VertexPoints& points_;
  const std::vector<int> axes_;
  const kernel::Flat flat_;
  const std::size_t d_, k_;
  solve::CenterFinder finder_;
  const std::unique_ptr<ForeignSearch> search_;
  std::uint64_t pages_counted_ = 0;
  std::vector<Spoke> spokes_;
  std::vector<const double*> corners_, facet_;
  std::vector<double> weights_, centers_;
  std::vector<VertexId> sorted_;  // the vertices of the cell that gather() looks at, by their ids
};

TileTriangulation::TileTriangulation(const Survey& survey, const PageTree& tree, PageSource& source,
                                     std::size_t number, TilePoints own, const TileOptions& options,
                                     std::unique_ptr<Surroundings> surroundings)
    : survey_(survey),
      tree_(tree),
      source_(source),
      number_(number),
      options_(options),
      own_(std::move(own)),
      surroundings_(surroundings ? std::move(surroundings)
                                 : open_surroundings(survey, tree, source, number)) {
  Options how;
  how.threads = options.threads;
  how.progress = options.progress;
  made_.emplace(survey.dimension, survey.weighted, how);
}

bool TileTriangulation::advance() {
  if (own_.rows.empty()) return false;
  if (asks_in_vain_) return try_all_points();
  const internal::Stopwatch insertion;
  if (!has_asked_) {
    // These settle the affine dimension and the frame, which later rounds would have to change.
    const StartingPoints start = surroundings_->starting_points();
    std::vector<double> rows = std::move(own_.points);
    own_.points = {};
    rows.insert(rows.end(), start.points.begin(), start.points.end());
    rows_ = own_.rows;
    rows_.insert(rows_.end(), start.rows.begin(), start.rows.end());
    if (surroundings_->rank() > 0) {
      shifts_.assign(own_.rows.size(), 0);
      shifts_.insert(shifts_.end(), start.shifts.begin(), start.shifts.end());
    }
    insert(std::move(rows));
  } else {
    insert_found();
  }
  effort_.insert_seconds += insertion.seconds();
  has_asked_ = true;
  ++num_rounds_;
  if (survey_.affine_dimension >= 1) {
    const internal::Stopwatch asking;
    asks_in_vain_ = options_.try_all_points;
    if (!asks_in_vain_) ask();
    effort_.ask_seconds += asking.seconds();
  }
  if (asks_in_vain_) {
    pages_to_try_ = pages_by_distance();
    last_cell_ = *triangulation().all_cells().begin();
  }
  return asks_in_vain_ || !found_.empty() || !waiting_.empty();
}

/// `rows`: those of rows_ that have no vertices yet.
void TileTriangulation::insert(std::vector<double> rows) {
  first_new_vertex_ = has_asked_ ? triangulation().complex().num_vertex_slots() : 1;
  made_->insert_rows(std::move(rows));
  enter_vertices();
}

/// The vertices of rows that were inserted since.
void TileTriangulation::enter_vertices() {
  // A hidden vertex keeps its id, which Complex does not show.
  const auto& vertex_of_row = triangulation::StoredPoints::vertices_of_rows(triangulation());
  const Index slots = triangulation::StoredPoints::of(triangulation()).last_vertex() + 1;
  is_own_.resize(slots, 0);
  row_of_.resize(slots, -1);
  if (surroundings_->rank() > 0) shift_of_.resize(slots, 0);
  for (; num_rows_done_ < rows_.size(); ++num_rows_done_) {
    const VertexId v = vertex_of_row[num_rows_done_];
    if (v == invalid_vertex) continue;
    if (num_rows_done_ < own_.rows.size()) is_own_[index(v)] = 1;
    std::int64_t& row = row_of_[index(v)];
    if (row >= 0) continue;
    row = rows_[num_rows_done_];
    if (surroundings_->rank() > 0) shift_of_[index(v)] = shifts_[num_rows_done_];
  }
}

void TileTriangulation::insert_found() {
  if (found_.empty()) {
    first_new_vertex_ = triangulation::StoredPoints::of(triangulation()).last_vertex() + 1;
    return;
  }
  num_foreign_ += found_.size();
  // A batch goes through all cells several times, some 10 ns for each; a point by itself takes some 5 µs. The
  // number of cells does not depend on threads; that of their slots does.
  constexpr std::size_t cells_per_point = 512;
  if (found_.size() < triangulation().num_all_cells() / cells_per_point) {
    insert_one_by_one();
    return;
  }
  const std::size_t width = tree_.table().row_size();
  std::vector<double> rows;
  rows.reserve(found_.size() * width);
  for (const ForeignPlace& place : found_) {
    rows.resize(rows.size() + width);
    take_found(place, rows.data() + rows.size() - width);
  }
  insert(std::move(rows));
}

/// A point that is inserted next.
void TileTriangulation::take_found(const ForeignPlace& place, double* point) {
  rows_.push_back(surroundings_->copy_point(place, point));
  if (surroundings_->rank() > 0) shifts_.push_back(place.shift);
  surroundings_->know(place);
}

/// The points of found_, in whose order neighbors are near each other.
void TileTriangulation::insert_one_by_one() {
  first_new_vertex_ = triangulation::StoredPoints::of(triangulation()).last_vertex() + 1;
  std::vector<double> row(tree_.table().row_size());
  last_cell_ = *triangulation().all_cells().begin();
  for (const ForeignPlace& place : found_) {
    internal::cancellation_point();
    take_found(place, row.data());
    const InsertResult result = made_->insert_row(row, last_cell_);
    // If the point is hidden by another one, nothing has changed.
    if (result.vertex != invalid_vertex) last_cell_ = triangulation().complex().incident_cell(result.vertex);
  }
  enter_vertices();
}

/// How many pages questions may look at in the time that trying all points of other tiles takes: a page some
/// 80 ns; a point 3 µs for its location, and 60 ns per cell of its conflict zone, which is some ten times as
/// large as those of the tile's own points, as there are few others far away. Questions that have taken as
/// long as that are given up, so no more than twice the time of the better way is spent.
std::uint64_t TileTriangulation::pages_worth_all_points() const {
  const Statistics statistics = triangulation().statistics();
  const double zone = static_cast<double>(statistics.created_cells) /
                      static_cast<double>(std::max<std::uint64_t>(statistics.insertions, 1));
  const auto foreign = static_cast<double>(tree_.table().num_points() - own_.rows.size());
  return static_cast<std::uint64_t>(foreign * (40 + 8 * zone));
}

void TileTriangulation::ask() {
  most_pages_asked_ = pages_worth_all_points();
  found_.clear();
  const std::vector<CellId> waited = std::move(waiting_);
  waiting_ = {};
  std::mutex mutex;
  // The answers of all threads, in an order that does not depend on them.
  const auto collect = [&](auto& asking) {
    const std::lock_guard lock(mutex);
    found_.insert(found_.end(), asking.found.begin(), asking.found.end());
    waiting_.insert(waiting_.end(), asking.waiting.begin(), asking.waiting.end());
  };
  if (!waited.empty()) {
    Asking asking(*this);
    asking.ask_again(waited);
    collect(asking);
  }
  // Few new vertices: their stars. Otherwise all cells are looked through.
  const std::size_t slots = triangulation().complex().num_cell_slots(),
                    end = triangulation::StoredPoints::of(triangulation()).last_vertex() + std::size_t{1},
                    num_new = end - std::min<std::size_t>(first_new_vertex_, end);
  constexpr std::size_t part_of_slots = 16384, part_of_stars = 256, cells_per_star = 256;
  const bool has_few = num_new < triangulation().num_all_cells() / cells_per_star;
  internal::for_parts(options_.threads, has_few ? num_new : slots, has_few ? part_of_stars : part_of_slots,
                      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                        stop();
                        Asking asking(*this);
                        if (has_few)
                          asking.ask_stars(first_new_vertex_ + first, first_new_vertex_ + last);
                        else
                          asking.ask_slots(first, last);
                        collect(asking);
                      });
  std::sort(found_.begin(), found_.end());
  found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
}

std::size_t TileTriangulation::bytes() const {
  const auto& points = triangulation::StoredPoints::of(triangulation());
  return triangulation().statistics().cell_bytes + points.coordinates.capacity() * sizeof(double) +
         rows_.capacity() * sizeof(std::int64_t) + is_own_.capacity() +
         row_of_.capacity() * sizeof(std::int64_t) +
         (shifts_.capacity() + shift_of_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace delone::tiles
