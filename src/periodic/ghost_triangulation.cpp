// SPDX-License-Identifier: BSD-3-Clause
// Rounds of insertions and questions.
#include "periodic/ghost_triangulation.hpp"

#include "base/build_limits.hpp"
#include "base/compiled_dimension.hpp"
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "base/stopwatch.hpp"
#include "kernel/predicates.hpp"
#include "periodic/image_search.hpp"
#include "periodic/quick_ball.hpp"
#include "solve/cell_center.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace delone::periodic {

namespace {

/// How wide the layer of ghosts is to begin with, in distances of neighbors. In four dimensions and more the
/// ghosts of a layer are soon many more than those that are needed.
double layer_width(std::size_t dimension) { return dimension <= 3 ? 1.5 : dimension == 4 ? 1.0 : 0.0; }

/// Whether the flat of all points is parallel to coordinate axes, so that centers are found in binary64.
bool is_aligned(const PeriodicSet& set, std::span<const int> axes) {
  for (std::size_t j = 0; j < set.dimension; ++j) {
    if (std::find(axes.begin(), axes.end(), static_cast<int>(j)) != axes.end()) continue;
    for (std::size_t row = 0; row < set.num_points(); ++row)
      if (set.row(row)[j] != set.row(0)[j]) return false;
    for (std::size_t i = 0; i < set.rank; ++i)
      if (set.period.vector(i)[j] != 0) return false;
  }
  return true;
}

}  // namespace

/// The questions of one round.
template <int D>
class GhostTriangulation::Asking {
 public:
  explicit Asking(GhostTriangulation& ghosts)
      : ghosts_(ghosts),
        set_(ghosts.set_),
        images_(ghosts.images_),
        complex_(ghosts.triangulation().complex()),
        points_(triangulation::StoredPoints::of(ghosts.triangulation())),
        axes_(ghosts.triangulation().axes()),
        d_(set_.dimension),
        k_(axes_.size()),
        finder_(static_cast<int>(d_), axes_, is_aligned(set_, axes_)),
        search_(images_, 0, images_.table().num_pages()),
        centers_(solve::CenterFinder::block * d_) {}

  void ask_all() {
    for (std::size_t slot = 0; slot < complex_.num_cell_slots(); ++slot) {
      round_();
      const CellId cell{static_cast<Index>(slot)};
      if (complex_.is_cell(cell) && is_new(cell)) gather(cell);
    }
    ask_gathered();
  }
  /// The cells of which one of these vertices is the last, each cell once.
  void ask_stars(std::size_t first, std::size_t last) {
    for (std::size_t id = first; id < last; ++id) {
      round_();
      const VertexId v{static_cast<Index>(id)};
      if (!complex_.is_vertex(v)) continue;
      for (const CellId cell : complex_.star(v)) {
        const VerticesOfCell vertices = complex_.vertices(cell);
        if (std::none_of(vertices.begin(), vertices.end(), [&](VertexId w) { return w > v; })) gather(cell);
      }
    }
    ask_gathered();
  }
  std::uint64_t num_questions = 0;
  std::uint64_t num_pages() const { return search_.num_pages(); }

 private:
  /// A cell whose center is wanted.
  struct Spoke {
    CellId cell;
    const double* own;  ///< a vertex that is a point of the set
  };

  bool is_new(CellId cell) const {
    if (ghosts_.first_new_vertex_ <= 1) return true;
    for (const VertexId v : complex_.vertices(cell))
      if (v != infinite_vertex && index(v) >= ghosts_.first_new_vertex_) return true;
    return false;
  }

  void gather(CellId cell) {
    const VerticesOfCell vertices = complex_.vertices(cell);
    VertexId own = infinite_vertex;
    bool is_infinite = false;
    for (const VertexId v : vertices) {
      if (v == infinite_vertex)
        is_infinite = true;
      else if (ghosts_.image_of(v).shift == 0 && (own == infinite_vertex || v < own))
        own = v;  // the first one by id, as the order of vertices in a cell may depend on threads
    }
    if (own == infinite_vertex) return;
    const double* const p = points_.point(index(own));
    if (is_infinite) {
      ask_beyond(cell, own, p);
      return;
    }
    if constexpr (D == 2 || D == 3) {
      std::array<const double*, 4> corners;
      if (!set_.weighted && k_ == static_cast<std::size_t>(D)) {
        for (std::size_t i = 0; i <= k_; ++i) corners[i] = points_.point(index(vertices[i]));
        Ball ball;
        if (find_ball<D>(corners.data(), ball) && is_in_known(ball.center, ball.radius)) return;
      }
    }
    spokes_.push_back({cell, p});
    for (const VertexId v : vertices) {
      corners_.push_back(points_.point(index(v)));
      if (set_.weighted) weights_.push_back(corners_.back()[d_]);
    }
    if (spokes_.size() == solve::CenterFinder::block) ask_gathered();
  }

  void ask_gathered() {
    if (spokes_.empty()) return;
    internal::cancellation_point();
    finder_.find_block(spokes_.size(), corners_.data(), set_.weighted ? weights_.data() : nullptr,
                       centers_.data());
    for (std::size_t i = 0; i < spokes_.size(); ++i) {
      const Spoke& spoke = spokes_[i];
      const double* const center = centers_.data() + i * d_;
      if (is_in_known(center, bound_of_radius(spoke.own, center))) continue;
      ++num_questions;
      const std::span<const double* const> corners(corners_.data() + i * (k_ + 1), k_ + 1);
      const FoundImage found =
          search_.find(spoke.own, center, [&](const double* x) { return is_in_sphere(corners, x); });
      if (!found.is_open) continue;
      ghosts_.found_.push_back({images_.image_at(found.shift, found.place), found.place, spoke.cell});
    }
    spokes_.clear();
    corners_.clear();
    weights_.clear();
  }

  /// What the radius of a sphere is below: the center is off by 1.01u of its coordinates at most.
  double bound_of_radius(const double* own, const double* center) const {
    double squared = 0, magnitude = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      squared += (own[j] - center[j]) * (own[j] - center[j]);
      magnitude += std::abs(center[j]);
    }
    if (set_.weighted) squared += std::max(images_.extent().largest_weight() - own[d_], 0.0);
    return std::sqrt(squared) * (1 + 0x1p-40) + 0x1p-48 * magnitude;
  }

  /// Whether all images that the ball may contain are known.
  bool is_in_known(const double* center, double radius) const {
    for (std::size_t i = 0; i < set_.rank; ++i) {
      const double middle = set_.period.fraction(i, center),
                   width = radius * set_.period.gradient_length(i) * (1 + 0x1p-40) +
                           set_.period.fraction_slack(i, center) + 2 * images_.extent().fraction_slack(i);
      if (!(middle - width > -images_.known_below(i) && middle + width < 1 + images_.known_above(i)))
        return false;
    }
    return true;
  }

  bool is_in_sphere(std::span<const double* const> corners, const double* x) const {
    const std::size_t width = set_.row_size();
    for (const double* corner : corners)
      if (std::equal(corner, corner + width, x)) return false;
    const kernel::Flat flat{points_.ambient, axes_, points_.form};
    return kernel::in_sphere_perturbed(flat, corners, kernel::orientation(flat, corners), x) ==
           Sign::negative;
  }

  void ask_beyond(CellId cell, VertexId own, const double* p) {
    const int infinite = complex_.infinite_index(cell);
    facet_.clear();
    for (const VertexId v : complex_.vertices(cell))
      if (v != infinite_vertex) facet_.push_back(points_.point(index(v)));
    const CellId behind = complex_.neighbor(cell, infinite);
    const double* const inner =
        points_.point(index(complex_.vertex(behind, complex_.mirror_index(cell, infinite))));
    const kernel::Flat flat{points_.ambient, axes_, points_.form};
    std::vector<double> x(p, p + set_.row_size());
    for (std::size_t i = 0; i < set_.rank; ++i) {
      for (std::size_t j = 0; j < d_; ++j) x[j] = p[j] + set_.period.vector(i)[j];
      const Sign side = kernel::hull_side(flat, facet_, inner, x.data());
      if (side == Sign::zero) continue;
      std::vector<std::int32_t> k(set_.rank, 0);
      k[i] = side == Sign::negative ? 1 : -1;
      ghosts_.found_.push_back({{ghosts_.image_of(own).row, images_.shift_number(k)}, {}, cell});
      return;
    }
  }

  GhostTriangulation& ghosts_;
  const PeriodicSet& set_;
  Images& images_;
  const Complex complex_;
  const sites::VertexPoints& points_;
  const std::vector<int> axes_;
  const std::size_t d_, k_;
  solve::CenterFinder finder_;
  ImageSearch<D, Images> search_;
  internal::QuickRounds round_;
  std::vector<Spoke> spokes_;
  std::vector<const double*> corners_, facet_;
  std::vector<double> weights_, centers_;
};

GhostTriangulation::GhostTriangulation(const PeriodicSet& set, const Options& options)
    : set_(set), images_(set) {
  // Limits and progress are those of all batches and questions together.
  internal::BuildLimits limits(options.memory_limit, options.time_limit, "points");
  limits.count_items(false);
  const internal::ProgressMeter meter(options.progress);
  Options of_batches = options;
  of_batches.progress = nullptr;
  of_batches.memory_limit = 0;
  of_batches.time_limit = 0;
  limits.guard([&] { construct(of_batches); });
}

void GhostTriangulation::construct(const Options& options) {
  if (set_.weighted)
    regular_.emplace(static_cast<int>(set_.dimension), options);
  else
    delaunay_.emplace(static_cast<int>(set_.dimension), options);
  if (set_.num_points() == 0) return;
  begin();
  while (set_.rank > 0) {
    ++effort_.num_rounds;
    found_.clear();
    const internal::Stopwatch asking;
    ask();
    effort_.ask_seconds += asking.seconds();
    if (found_.empty()) break;
    const internal::Stopwatch insertion;
    insert_found();
    effort_.later_seconds += insertion.seconds();
  }
  effort_.num_ghosts = ghosts_.size();
  // Arrays do not depend on threads.
  if (delaunay_)
    delaunay_->sort_cells();
  else
    regular_->sort_cells();
}

/// The points of the set, the frame and the layer.
void GhostTriangulation::begin() {
  const internal::Stopwatch insertion;
  ghosts_ = images_.frame();
  if (const double width = layer_width(set_.dimension); width > 0 && set_.rank > 0) {
    const std::vector<Image> layer = images_.layer(width);
    ghosts_.insert(ghosts_.end(), layer.begin(), layer.end());
  }
  const std::size_t n = set_.num_points(), d = set_.dimension, width = set_.row_size();
  std::vector<double> rows = set_.rows;
  rows.resize((n + ghosts_.size()) * width);
  for (std::size_t i = 0; i < ghosts_.size(); ++i) images_.copy_image(ghosts_[i], &rows[(n + i) * width]);
  if (delaunay_) {
    delaunay_->insert_range(std::move(rows));
  } else {
    std::vector<double> coordinates, weights;
    for (std::size_t at = 0; at < rows.size(); at += width) {
      coordinates.insert(coordinates.end(), &rows[at], &rows[at] + d);
      weights.push_back(rows[at + d]);
    }
    regular_->insert_range(std::move(coordinates), weights);
  }
  enter_vertices();
  effort_.insert_seconds = insertion.seconds();
}

/// The vertices of rows that were inserted since.
void GhostTriangulation::enter_vertices() {
  // A hidden vertex keeps its id, which Complex does not show.
  const auto& vertex_of_row = triangulation::StoredPoints::vertices_of_rows(triangulation());
  const std::size_t slots = triangulation::StoredPoints::of(triangulation()).last_vertex() + std::size_t{1},
                    n = set_.num_points();
  const std::size_t before = image_of_vertex_.size();
  image_of_vertex_.resize(slots, {std::uint32_t(-1), 0});
  for (; num_rows_done_ < vertex_of_row.size(); ++num_rows_done_) {
    const std::size_t row = num_rows_done_;
    Image& image = image_of_vertex_[index(vertex_of_row[row])];
    if (image.row != std::uint32_t(-1)) continue;
    if (row < n) {
      image = {static_cast<std::uint32_t>(row), 0};
    } else {  // the first row at the point
      const Image& ghost = ghosts_[row - n];
      image = {image_of_vertex_[index(vertex_of_row[ghost.row])].row, ghost.shift};
    }
  }
  first_new_vertex_ = static_cast<Index>(std::max<std::size_t>(before, 1));
}

void GhostTriangulation::ask() {
  const Complex complex = triangulation().complex();
  if (complex.affine_dimension() < 1) return;
  internal::with_compiled_dimension<1, 5>(set_.dimension, [&](auto d) {
    Asking<d()> asking(*this);
    // Few new vertices: their stars. Otherwise all cells are looked through.
    constexpr std::size_t cells_per_star = 256;
    const std::size_t end = image_of_vertex_.size(),
                      num_new = end - std::min<std::size_t>(first_new_vertex_, end);
    if (first_new_vertex_ > 1 && num_new < complex.num_all_cells() / cells_per_star)
      asking.ask_stars(first_new_vertex_, end);
    else
      asking.ask_all();
    effort_.questions += asking.num_questions;
    effort_.pages += asking.num_pages();
  });
}

void GhostTriangulation::insert_found() {
  const auto number = [](const Found& one) { return std::pair(one.image.shift, one.image.row); };
  std::sort(found_.begin(), found_.end(),
            [&](const Found& a, const Found& b) { return number(a) < number(b); });
  found_.erase(std::unique(found_.begin(), found_.end(),
                           [&](const Found& a, const Found& b) { return number(a) == number(b); }),
               found_.end());
  for (const Found& one : found_) {
    ghosts_.push_back(one.image);
    if (one.place)
      images_.shift(one.image.shift)
          .known.add(one.place->page, one.place->slot, images_.table().page_size(one.place->page));
  }
  std::vector<double> row(set_.row_size());
  const std::span<const double> point(row.data(), set_.dimension);
  // A batch goes through all cells several times, some 10 ns for each; a point by itself takes some 5 µs.
  constexpr std::size_t cells_per_point = 512;
  if (found_.size() < triangulation().num_all_cells() / cells_per_point) {
    for (const Found& one : found_) {
      internal::cancellation_point();
      images_.copy_image(one.image, row.data());
      // The cell may have gone. Then another one is in its place, or none.
      const std::optional<CellId> hint =
          triangulation().complex().is_cell(one.cell) ? std::optional(one.cell) : std::nullopt;
      if (delaunay_)
        delaunay_->insert(point, hint);
      else
        regular_->insert(point, row[set_.dimension], hint);
    }
  } else {
    std::vector<double> coordinates, weights;
    for (const Found& one : found_) {
      images_.copy_image(one.image, row.data());
      coordinates.insert(coordinates.end(), point.begin(), point.end());
      if (set_.weighted) weights.push_back(row.back());
    }
    if (delaunay_)
      delaunay_->insert_range(std::move(coordinates));
    else
      regular_->insert_range(std::move(coordinates), weights);
  }
  enter_vertices();
}

}  // namespace delone::periodic
