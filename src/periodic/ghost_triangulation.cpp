// SPDX-License-Identifier: BSD-3-Clause
// Rounds of insertions and questions; steps are in ghost_step.cpp.
#include "periodic/ghost_triangulation.hpp"

#include "base/build_limits.hpp"
#include "base/compiled_dimension.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "kernel/predicates.hpp"
#include "periodic/image_search.hpp"
#include "periodic/quick_ball.hpp"
#include "solve/cell_center.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace delone::periodic {

namespace {

/// How wide the layer of ghosts is to begin with, in distances of neighbors. In four dimensions and more the
/// ghosts of a layer are soon many more than those that are needed.
double layer_width(std::size_t dimension) { return dimension <= 3 ? 1.75 : dimension == 4 ? 1.0 : 0.0; }

/// Calls make(options) such that limits and progress are those of all batches and questions together.
template <class Make>
void guard(const Options& options, const Make& make) {
  internal::BuildLimits limits(options.memory_limit, options.time_limit, "points");
  limits.count_items(false);
  const internal::ProgressMeter meter(options.progress);
  Options of_batches = options;
  of_batches.progress = nullptr;
  of_batches.memory_limit = 0;
  of_batches.time_limit = 0;
  limits.guard([&] { make(of_batches); });
}

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
        flat_{points_.ambient, axes_, points_.form},
        d_(set_.dimension),
        k_(axes_.size()),
        finder_(static_cast<int>(d_), axes_, is_aligned(set_, axes_)),
        search_(images_, 0, images_.table().num_pages()),
        centers_(solve::CenterFinder::block * d_) {}

  /// Nearly all cells are found far from everything unknown, by several threads: a cell whose sphere is
  /// narrower than all that is known around one of its points meets nothing else. The others ask in the order
  /// of their slots, so that no result depends on threads.
  void ask_all() {
    const std::vector<double> depths = find_depths();
    constexpr std::size_t cells_in_part = 4096;
    const std::size_t slots = complex_.num_cell_slots();
    std::vector<std::vector<CellId>> open((slots + cells_in_part - 1) / cells_in_part);
    internal::for_parts(
        ghosts_.threads_, slots, cells_in_part,
        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
          for (std::size_t slot = first; slot < last; ++slot) {
            if (slot % 64 == 0) stop();
            const CellId cell{static_cast<Index>(slot)};
            if (complex_.is_cell(cell) && is_new(cell) && !is_deep(cell, depths) && is_open(cell))
              open[first / cells_in_part].push_back(cell);
          }
        });
    for (const std::vector<CellId>& cells : open)
      for (const CellId cell : cells) {
        round_();
        gather(cell);
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
        if (std::none_of(vertices.begin(), vertices.end(), [&](VertexId w) { return w > v; }) &&
            is_open(cell))
          gather(cell);
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

  /// Whether the cells of the set are of a kind that quick_ball.hpp measures.
  bool has_quick_balls() const {
    return (D == 2 || D == 3) && !set_.weighted && k_ == static_cast<std::size_t>(D);
  }
  std::array<const double*, 4> corners_of(const VerticesOfCell& vertices) const {
    std::array<const double*, 4> corners{};
    for (std::size_t i = 0; i <= k_; ++i) corners[i] = points_.point(index(vertices[i]));
    return corners;
  }
  /// By vertex: within which distance of a point of the set everything is known; 0 for other vertices.
  std::vector<double> find_depths() const {
    std::vector<double> depths(has_quick_balls() ? ghosts_.image_of_vertex_.size() : 0, 0.0);
    constexpr std::size_t vertices_in_part = 4096;
    internal::for_parts(ghosts_.threads_, depths.size(), vertices_in_part,
                        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                          stop();
                          for (std::size_t v = std::max<std::size_t>(first, 1); v < last; ++v)
                            if (ghosts_.image_of_vertex_[v].shift == 0)
                              depths[v] = depth_of(points_.point(static_cast<Index>(v)));
                        });
    return depths;
  }
  double depth_of(const double* p) const {
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < set_.rank; ++i) {
      const double at = set_.period.fraction(i, p),
                   within = std::min(at + images_.known_below(i), 1 + images_.known_above(i) - at) -
                            set_.period.fraction_slack(i, p) - 2 * images_.extent().fraction_slack(i);
      depth = std::min(depth, within / set_.period.gradient_length(i) * (1 - 0x1p-40));
    }
    return std::max(depth, 0.0);
  }
  /// Whether the sphere of a cell is within the depth of one of its vertices.
  bool is_deep(CellId cell, const std::vector<double>& depths) const {
    if constexpr (D == 2 || D == 3) {
      if (depths.empty()) return false;
      const VerticesOfCell vertices = complex_.vertices(cell);
      double deepest = 0;
      bool is_infinite = false;
      for (const VertexId v : vertices) {
        deepest = std::max(deepest, depths[index(v)]);
        is_infinite = is_infinite || v == infinite_vertex;
      }
      return !is_infinite && deepest > 0 && is_narrower<D>(corners_of(vertices).data(), deepest);
    }
    return false;
  }
  /// Whether a cell has a vertex in the box, and there may be something unknown in its sphere.
  bool is_open(CellId cell) const {
    const VerticesOfCell vertices = complex_.vertices(cell);
    if (std::none_of(vertices.begin(), vertices.end(), [&](VertexId v) { return ghosts_.is_own(v); }))
      return false;
    if constexpr (D == 2 || D == 3) {
      Ball ball;
      if (has_quick_balls() && !complex_.is_infinite(cell) &&
          find_ball<D>(corners_of(vertices).data(), ball) && is_in_known(ball.center, ball.radius))
        return false;
    }
    return true;
  }

  /// REQUIRES a vertex in the box.
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
    const double* const p = points_.point(index(own));
    if (is_infinite) {
      ask_beyond(cell, own, p);
      return;
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
      const FoundImage found = search_.find(
          spoke.own, center, [&](const double* x) { return pages::is_in_sphere(flat_, corners, x); });
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
      const Extent::Range range = images_.extent().fractions_in_ball(i, center, radius);
      if (!(range.low > -images_.known_below(i) && range.high < 1 + images_.known_above(i))) return false;
    }
    return true;
  }

  void ask_beyond(CellId cell, VertexId own, const double* p) {
    const int infinite = complex_.infinite_index(cell);
    facet_.clear();
    for (const VertexId v : complex_.vertices(cell))
      if (v != infinite_vertex) facet_.push_back(points_.point(index(v)));
    const CellId behind = complex_.neighbor(cell, infinite);
    const double* const inner =
        points_.point(index(complex_.vertex(behind, complex_.mirror_index(cell, infinite))));
    std::vector<double> x(p, p + set_.row_size());
    for (std::size_t i = 0; i < set_.rank; ++i) {
      for (std::size_t j = 0; j < d_; ++j) x[j] = p[j] + set_.period.vector(i)[j];
      const Sign side = kernel::hull_side(flat_, facet_, inner, x.data());
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
  const kernel::Flat flat_;
  const std::size_t d_, k_;
  solve::CenterFinder finder_;
  ImageSearch<D, Images> search_;
  internal::QuickRounds round_;
  std::vector<Spoke> spokes_;
  std::vector<const double*> corners_, facet_;
  std::vector<double> weights_, centers_;
};

GhostTriangulation::GhostTriangulation(const PeriodicSet& set, const Options& options)
    : set_(set), threads_(options.threads), images_(set) {
  guard(options, [&](const Options& of_batches) { construct(of_batches); });
}

GhostTriangulation::GhostTriangulation(const PeriodicSet& set, const GhostTriangulation& before,
                                       const Options& options)
    : set_(set), threads_(options.threads), images_(set) {
  guard(options, [&](const Options& of_batches) {
    if (!step_from(before)) construct(of_batches);
  });
}

void GhostTriangulation::construct(const Options& options) {
  images_.forget_known();
  made_.emplace(static_cast<int>(set_.dimension), set_.weighted, options);
  if (set_.num_points() == 0) return;
  begin();
  ask_and_insert(std::numeric_limits<std::size_t>::max());
  num_constructed_ = image_of_row_.size();
  constructed_below_ = images_.known_below();
  constructed_above_ = images_.known_above();
  made_->get().sort_cells();  // vertices and cells do not depend on threads
}

/// Asks until nothing is found. Returns false, and is not done, as soon as more images than `most_found` are
/// found.
bool GhostTriangulation::ask_and_insert(std::size_t most_found) {
  std::size_t num_found = 0;
  while (set_.rank > 0) {
    ++effort_.num_rounds;
    found_.clear();
    ask();
    if (found_.empty()) break;
    num_found += found_.size();
    if (num_found > most_found) return false;
    insert_found();
  }
  effort_.num_ghosts = image_of_row_.size() - set_.num_points();
  return true;
}

/// The points of the set, the frame and the layer.
void GhostTriangulation::begin() {
  const std::size_t n = set_.num_points(), width = set_.row_size();
  own_row_.resize(n);
  std::iota(own_row_.begin(), own_row_.end(), std::uint32_t{0});
  std::vector<Image> ghosts = images_.frame();
  if (const double layer_size = layer_width(set_.dimension); layer_size > 0 && set_.rank > 0) {
    const std::vector<Image> layer = images_.layer(layer_size);
    ghosts.insert(ghosts.end(), layer.begin(), layer.end());
  }
  image_of_row_.clear();
  image_of_row_.reserve(n + 2 * ghosts.size());  // some more come later
  for (const std::uint32_t row : own_row_) image_of_row_.push_back({row, 0});
  image_of_row_.insert(image_of_row_.end(), ghosts.begin(), ghosts.end());
  std::vector<double> rows;
  rows.reserve(image_of_row_.size() * width);
  rows = set_.rows;
  rows.resize(image_of_row_.size() * width);
  for (std::size_t i = n; i < image_of_row_.size(); ++i)
    images_.copy_image(image_of_row_[i], &rows[i * width]);
  made_->insert_rows(std::move(rows));
  image_of_vertex_.clear();
  num_rows_done_ = 0;
  enter_vertices();
}

VertexId GhostTriangulation::id_of_row(std::size_t row) const {
  return triangulation::StoredPoints::vertices_of_rows(triangulation())[own_row_[row]];
}

/// The vertices of rows that were inserted since.
void GhostTriangulation::enter_vertices() {
  // A hidden vertex keeps its id, which Complex does not show.
  const auto& vertex_of_row = triangulation::StoredPoints::vertices_of_rows(triangulation());
  const std::size_t slots = triangulation::StoredPoints::of(triangulation()).last_vertex() + std::size_t{1};
  const std::size_t before = image_of_vertex_.size();
  image_of_vertex_.resize(slots, {std::uint32_t(-1), 0});
  const auto enter = [&](std::size_t row, const Image& image) {
    Image& known = image_of_vertex_[index(vertex_of_row[row])];
    if (known.row == std::uint32_t(-1)) known = image;
  };
  if (num_rows_done_ == 0)
    for (std::uint32_t row = 0; row < own_row_.size(); ++row) enter(own_row_[row], {row, 0});
  for (; num_rows_done_ < vertex_of_row.size(); ++num_rows_done_) {
    const Image& image = image_of_row_[num_rows_done_];
    const Index own = index(vertex_of_row[own_row_[image.row]]);
    enter(num_rows_done_, {image_of_vertex_[own].row, image.shift});  // the first row at the point
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
    image_of_row_.push_back(one.image);
    if (one.place)
      images_.shift(one.image.shift)
          .known.add(one.place->page, one.place->slot, images_.table().page_size(one.place->page));
  }
  std::vector<double> row(set_.row_size());
  // A batch goes through all cells several times, some 10 ns for each; a point by itself takes some 5 µs.
  constexpr std::size_t cells_per_point = 512;
  if (found_.size() < triangulation().num_all_cells() / cells_per_point) {
    for (const Found& one : found_) {
      internal::cancellation_point();
      images_.copy_image(one.image, row.data());
      // The cell may have gone. Then another one is in its place, or none.
      made_->insert_row(row,
                        triangulation().complex().is_cell(one.cell) ? std::optional(one.cell) : std::nullopt);
    }
  } else {
    std::vector<double> rows;
    for (const Found& one : found_) {
      images_.copy_image(one.image, row.data());
      rows.insert(rows.end(), row.begin(), row.end());
    }
    made_->insert_rows(std::move(rows));
  }
  enter_vertices();
}

}  // namespace delone::periodic
