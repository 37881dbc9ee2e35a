// SPDX-License-Identifier: BSD-3-Clause
// Sites in parts, by vertex: the star of each, its measures, and its lists; these are put into the order of
// rows at the end.
#include <delone/site_cells.hpp>

#include "base/guarded.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "particles/cell_measure.hpp"
#include "particles/clipped_cells.hpp"
#include "particles/proper_faces.hpp"
#include "particles/stars.hpp"
#include "triangulation/stored_points.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace delone {
namespace particles {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_dimension = 12;
constexpr std::size_t vertices_in_part = 1024;

/// The neighbors of a site by row, with their places in another list; −1 comes last.
using Order = std::vector<std::pair<Index, std::uint32_t>>;

/// The lists of some sites, one after the other.
struct Lists {
  std::vector<Index> rows;             // the sites
  std::vector<std::uint32_t> lengths;  // by site
  std::vector<SignedIndex> neighbors, num_edges;
  std::vector<double> areas, distances;

  /// The list of the next site will be in this order, which is sorted here.
  void begin(std::size_t row, Order& order) {
    std::sort(order.begin(), order.end());
    rows.push_back(static_cast<Index>(row));
    lengths.push_back(static_cast<std::uint32_t>(order.size()));
  }
};

class SiteCellsMaker {
 public:
  SiteCellsMaker(const Triangulation& triangulation, const SiteCellsOptions& options, unsigned threads)
      : triangulation_(triangulation),
        options_(options),
        threads_(threads),
        complex_(triangulation.complex()),
        points_(triangulation::StoredPoints::of(triangulation)),
        k_(static_cast<std::size_t>(std::max(complex_.affine_dimension(), 0))),
        d_(static_cast<std::size_t>(triangulation.dimension())) {
    if (options.box) container_.emplace(Container{*options.box, options.halfspaces});
  }

  SiteCells run() {
    start();
    if (complex_.affine_dimension() == 0)
      measure_lone_site();
    else if (k_ > 0)
      measure();
    if (options_.neighbors) join_lists();
    return std::move(cells_);
  }

 private:
  /// What a thread works with.
  struct Worker {
    Worker(const SiteCellsMaker& maker, const Stars& stars)
        : star(stars, maker.complex_.num_vertex_slots()),
          measure(maker.k_, maker.d_, maker.points_.weighted(), maker.unit_) {
      if (maker.classes_) faces.emplace(stars, *maker.classes_);
      if (maker.container_) clipper.emplace(maker.points_, *maker.container_);
    }
    Star star;
    CellMeasure measure;
    std::optional<ProperFaces> faces;
    std::optional<CellClipper> clipper;
    Order order;
  };

  void start();
  void measure_lone_site();
  void measure();
  void measure_site(Index v, const Stars& stars, Worker& worker, Lists& lists);
  void clip(Index v, std::span<const Index> neighbors, CellClipper& clipper, Order& order, Lists& lists);
  void join_lists();
  bool is_inside(std::span<const Index> cells) const;
  bool are_proper() const { return options_.faces == CellFaces::proper; }
  /// The dimension of the cells: with a box that of the space.
  std::size_t dimension_of_cells() const { return container_ ? d_ : k_; }
  void set_centroid(std::size_t row, Index v, std::span<const double> offset) {
    for (std::size_t j = 0; j < offset.size(); ++j)
      cells_.centroids[row * d_ + j] = points_.point(v)[j] + offset[j];
  }

  const Triangulation& triangulation_;
  const SiteCellsOptions& options_;
  unsigned threads_;
  Complex complex_;
  const sites::VertexPoints& points_;
  std::size_t k_, d_;
  std::optional<Container> container_;
  std::vector<Index> row_of_vertex_;
  int unit_ = 0;
  std::optional<SphereClasses> classes_;  // if only proper faces count
  std::vector<unsigned char> inside_;     // by cell of the triangulation; empty: none is known to be
  std::vector<Lists> lists_;              // by part
  SiteCells cells_;
};

/// Rows and the unit. Differences of coordinates that may be out of range are taken of smaller numbers.
void SiteCellsMaker::start() {
  const std::size_t n = triangulation_.num_rows();
  cells_.dimension = triangulation_.dimension();
  cells_.volumes.assign(n, 0.0);
  cells_.centroids.assign(n * d_, std::numeric_limits<double>::quiet_NaN());
  cells_.areas.assign(n, 0.0);
  cells_.num_faces.assign(n, 0);
  row_of_vertex_.assign(complex_.num_vertex_slots(), invalid_index);
  double largest = 0;
  for (Index v = 1; v < complex_.num_vertex_slots(); ++v) {
    if (!complex_.is_vertex(VertexId{v})) continue;
    row_of_vertex_[v] = static_cast<Index>(triangulation_.row_of(VertexId{v}));
    const double* const p = points_.point(v);
    for (std::size_t j = 0; j < points_.row_size(); ++j) largest = std::max(largest, std::abs(p[j]));
  }
  if (largest > 0x1p1000) unit_ = 8;
}

/// Its cell is everything, or the box.
void SiteCellsMaker::measure_lone_site() {
  const Index v = index(complex_.finite_vertices().front());
  lists_.resize(1);
  if (!container_) {
    cells_.volumes[row_of_vertex_[v]] = cells_.areas[row_of_vertex_[v]] = infinity;
    return;
  }
  CellClipper clipper(points_, *container_);
  Order order;
  clip(v, {}, clipper, order, lists_[0]);
}

void SiteCellsMaker::measure() {
  const std::size_t slots = complex_.num_vertex_slots();
  const Stars stars(complex_);
  if (are_proper()) {
    const std::vector<int> axes = triangulation_.axes();
    classes_.emplace(complex_, stars, points_, kernel::Flat{points_.ambient, axes, points_.form}, threads_);
  }
  if (container_ && k_ == d_) inside_ = centers_inside(triangulation_, stars, points_, *container_, threads_);
  lists_.resize((slots + vertices_in_part - 1) / vertices_in_part);
  internal::work_in_parts(threads_, slots, vertices_in_part, [&] {
    return [&, worker = Worker(*this, stars)](std::size_t first, std::size_t last,
                                              const internal::StopPoint& stop) mutable {
      Lists& lists = lists_[first / vertices_in_part];
      for (std::size_t v = first; v < last; ++v) {
        if (row_of_vertex_[v] == invalid_index) continue;
        stop();
        measure_site(static_cast<Index>(v), stars, worker, lists);
      }
    };
  });
}

/// Cells are convex, so one is inside if its vertices are.
bool SiteCellsMaker::is_inside(std::span<const Index> cells) const {
  return !inside_.empty() &&
         std::all_of(cells.begin(), cells.end(), [&](Index c) { return inside_[c] != 0; });
}

void SiteCellsMaker::measure_site(Index v, const Stars& stars, Worker& worker, Lists& lists) {
  Star& star = worker.star;
  CellMeasure& measure = worker.measure;
  star.find(v);
  if (container_ && !is_inside(stars.cells_at(v))) {
    clip(v, star.neighbors(), *worker.clipper, worker.order, lists);
    return;
  }
  const std::size_t row = row_of_vertex_[v], n = star.neighbors().size();
  measure.begin(n);
  for (std::size_t i = 0; i < n; ++i)
    measure.set_neighbor(i, points_.point(v), points_.point(star.neighbors()[i]));
  measure.measure(star.corners());
  if (worker.faces) worker.faces->find(star, stars.cells_at(v));
  worker.order.clear();
  for (std::size_t i = 0; i < n; ++i)
    if (!worker.faces || worker.faces->is_proper(i))
      worker.order.emplace_back(row_of_vertex_[star.neighbors()[i]], static_cast<std::uint32_t>(i));
  cells_.num_faces[row] = static_cast<SignedIndex>(worker.order.size());
  if (star.is_bounded()) {
    cells_.volumes[row] = measure.volume();
    if (measure.volume() > 0) set_centroid(row, v, measure.offset());
    double surface = 0;
    for (const auto& [other, i] : worker.order) surface += measure.areas()[i];
    cells_.areas[row] = surface;
  } else {
    cells_.volumes[row] = cells_.areas[row] = infinity;
  }
  if (!options_.neighbors) return;
  lists.begin(row, worker.order);
  for (const auto& [other, i] : worker.order) {
    const bool is_unbounded = star.is_at_infinity(i) && k_ > 1;
    lists.neighbors.push_back(static_cast<SignedIndex>(other));
    lists.areas.push_back(is_unbounded ? infinity : measure.areas()[i]);
    lists.distances.push_back(measure.distances()[i]);
    if (k_ == 3)
      lists.num_edges.push_back(static_cast<SignedIndex>(
          (worker.faces ? worker.faces->num_classes(i) : star.num_cells_at(i)) + (is_unbounded ? 1 : 0)));
  }
}

void SiteCellsMaker::clip(Index v, std::span<const Index> neighbors, CellClipper& clipper, Order& order,
                          Lists& lists) {
  const std::size_t row = row_of_vertex_[v];
  clipper.clip(v, neighbors, are_proper());
  cells_.volumes[row] = clipper.volume();
  set_centroid(row, v, clipper.offset());
  const std::span<const ClippedFace> faces = clipper.faces();
  cells_.num_faces[row] = static_cast<SignedIndex>(faces.size());
  double surface = 0;
  order.clear();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    surface += faces[i].area;
    const bool is_wall = faces[i].neighbor == ClippedFace::wall;
    order.emplace_back(is_wall ? invalid_index : row_of_vertex_[neighbors[faces[i].neighbor]],
                       static_cast<std::uint32_t>(i));
  }
  cells_.areas[row] = surface;
  if (!options_.neighbors) return;
  lists.begin(row, order);
  for (const auto& [other, i] : order) {
    lists.neighbors.push_back(other == invalid_index ? -1 : static_cast<SignedIndex>(other));
    lists.areas.push_back(faces[i].area);
    lists.distances.push_back(faces[i].distance);
    if (d_ == 3) lists.num_edges.push_back(static_cast<SignedIndex>(faces[i].num_corners));
  }
}

/// Puts the lists of all parts into the order of rows.
void SiteCellsMaker::join_lists() {
  std::vector<std::int64_t>& offsets = cells_.neighbor_offsets;
  offsets.assign(cells_.num_rows() + 1, 0);
  for (const Lists& lists : lists_)
    for (std::size_t i = 0; i < lists.rows.size(); ++i)
      offsets[lists.rows[i] + 1] = static_cast<std::int64_t>(lists.lengths[i]);
  for (std::size_t row = 0; row < cells_.num_rows(); ++row) offsets[row + 1] += offsets[row];
  const auto size = static_cast<std::size_t>(offsets.back());
  cells_.neighbors.resize(size);
  cells_.face_areas.resize(size);
  cells_.distances.resize(size);
  if (dimension_of_cells() == 3) cells_.num_edges.resize(size);
  internal::for_parts(
      threads_, lists_.size(), 1, [&](std::size_t part, std::size_t, const internal::StopPoint& stop) {
        stop();
        Lists& lists = lists_[part];
        std::size_t from = 0;
        for (std::size_t i = 0; i < lists.rows.size(); ++i) {
          const std::ptrdiff_t to = offsets[lists.rows[i]];
          const std::size_t length = lists.lengths[i];
          const auto copy = [&](const auto& items, auto& all) {
            std::copy_n(items.begin() + static_cast<std::ptrdiff_t>(from), length, all.begin() + to);
          };
          copy(lists.neighbors, cells_.neighbors);
          copy(lists.areas, cells_.face_areas);
          copy(lists.distances, cells_.distances);
          if (dimension_of_cells() == 3) copy(lists.num_edges, cells_.num_edges);
          from += length;
        }
        lists = {};
      });
}

}  // namespace
}  // namespace particles

SiteCells site_cells(const Triangulation& triangulation, const SiteCellsOptions& options,
                     const Execution& how) {
  if (triangulation.kind() == TriangulationKind::furthest_site)
    throw Error(Errc::invalid_argument, "cells of sites are those of a Delaunay or regular triangulation");
  if (triangulation.affine_dimension() > particles::most_dimension)
    throw Error(Errc::unsupported,
                "cells of sites are available up to dimension " + std::to_string(particles::most_dimension));
  const auto d = static_cast<std::size_t>(triangulation.dimension());
  if (options.box)
    particles::check_container({*options.box, options.halfspaces}, triangulation.dimension());
  else if (!options.halfspaces.empty())
    throw Error(Errc::invalid_argument, "halfspaces clip cells only in a box");
  if (options.box && options.faces == CellFaces::proper && d > 3)
    throw Error(Errc::unsupported, "proper faces of clipped cells are available up to dimension 3");
  return internal::guarded("the cells of sites", [&] {
    const internal::ProgressMeter meter(how.progress);
    return particles::SiteCellsMaker(triangulation, options, how.threads).run();
  });
}

}  // namespace delone
