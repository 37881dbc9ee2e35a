// SPDX-License-Identifier: BSD-3-Clause
// Sites in parts, by vertex: the star of each, its measures, and its list in the order of rows. Those of a
// periodic set are vertices of its triangulation with ghosts.
#include <delone/site_cells.hpp>

#include "base/compiler.hpp"
#include "base/guarded.hpp"
#include "base/infinity.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "particles/cell_centers.hpp"
#include "particles/clipped_cells.hpp"
#include "particles/face_polygons.hpp"
#include "particles/neighbor_lists.hpp"
#include "particles/neighbor_order.hpp"
#include "particles/pass/cell_measure.hpp"
#include "particles/periodic_sites.hpp"
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

using internal::infinity;
constexpr int most_dimension = 12;
constexpr std::size_t vertices_in_part = 1024;

/// The faces of a clipped cell by the rows of neighbors, with their places in another list; −1 comes last.
using Order = std::vector<std::pair<Index, std::uint32_t>>;

/// Prefetches items first … last − 1, which will be written. Inlined, as a call of a function that does
/// nothing else is taken for a useless one.
template <class T>
[[gnu::always_inline]] inline void prefetch_items(const std::vector<T>& items, std::size_t first,
                                                  std::size_t last) {
  if (first == last) return;
  constexpr std::size_t line = 64;
  for (std::size_t at = first; at < last; at += line / sizeof(T))
    internal::prefetch_for_writing(items.data() + at);
  internal::prefetch_for_writing(items.data() + last - 1);
}

class SiteCellsMaker {
 public:
  /// `periodic`: null, or whose triangulation it is.
  SiteCellsMaker(const Triangulation& triangulation, const PeriodicSites* periodic,
                 const SiteCellsOptions& options, unsigned threads)
      : triangulation_(triangulation),
        periodic_(periodic),
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
    if (has_lists() && cells_.neighbor_offsets.empty())
      join_lists(lists_, dimension_of_cells() == 3, options_.vertices, threads_, cells_);
    return std::move(cells_);
  }

 private:
  /// What a thread works with.
  struct Worker {
    Worker(const SiteCellsMaker& maker, const Stars& stars)
        : star(stars), measure(maker.k_, maker.d_, maker.points_.weighted(), maker.unit_) {
      if (maker.classes_) faces.emplace(*maker.classes_);
      if (maker.options_.vertices)
        polygons.emplace(stars, maker.d_, maker.centers_, maker.classes_ ? &*maker.classes_ : nullptr);
      if (maker.container_) clipper.emplace(maker.points_, *maker.container_);
    }
    Star star;
    CellMeasure measure;
    std::optional<ProperFaces> faces;
    std::optional<FacePolygons> polygons;
    std::optional<CellClipper> clipper;
    NeighborOrder neighbor_order;
    Order order;                              // of clipped faces
    std::vector<std::uint32_t> num_at_edges;  // by slot
  };

  void start();
  void measure_lone_site();
  void measure();
  void measure_site(Index v, Worker& worker, NeighborLists* lists);
  void lay_out(const Stars& stars);
  void prefetch_after(std::size_t v) const;
  template <class Put>
  void for_each_listed(Worker& worker, const Put& put);
  void list_neighbors(Worker& worker, NeighborLists& lists);
  void find_centers(const Stars& stars);
  void list_vertices(Index v, FacePolygons& polygons, NeighborLists& lists);
  void clip(Index v, std::span<const Index> neighbors, CellClipper& clipper, Order& order,
            NeighborLists* lists);
  bool is_inside(const Star& star) const;
  bool has_lists() const { return options_.neighbors || options_.vertices; }
  bool are_proper() const { return options_.faces == CellFaces::proper; }
  /// Whether the number of cells at a site tells how many neighbors are listed.
  bool are_lengths_known() const { return k_ <= 3 && !are_proper() && !options_.vertices && !container_; }
  /// The dimension of the cells: with a box that of the space.
  std::size_t dimension_of_cells() const { return container_ ? d_ : k_; }
  bool has_cell(Index v) const {
    return row_of_vertex_[v] != invalid_index && (periodic_ == nullptr || periodic_->has_cell(v));
  }
  /// A volume of so many dimensions as a number of the caller.
  double outer(double volume, std::size_t dimension) const {
    return periodic_ == nullptr ? volume : periodic_->outer(volume, dimension);
  }
  void set_centroid(std::size_t row, Index v, std::span<const double> offset) {
    const double* const site = periodic_ == nullptr ? points_.point(v) : periodic_->given_point(row);
    for (std::size_t j = 0; j < offset.size(); ++j)
      cells_.centroids[row * d_ + j] = site[j] + outer(offset[j], 1);
  }

  const Triangulation& triangulation_;
  const PeriodicSites* periodic_;
  const SiteCellsOptions& options_;
  unsigned threads_;
  Complex complex_;
  const sites::VertexPoints& points_;
  std::size_t k_, d_;
  std::optional<Container> container_;
  std::vector<Index> row_of_vertex_;  // of a ghost, that of the point that it is an image of
  int unit_ = 0;
  std::optional<SphereClasses> classes_;  // if only proper faces count
  std::vector<unsigned char> inside_;     // by cell of the triangulation; empty: none is known to be
  std::vector<double> centers_;           // by cell of the triangulation, if vertices are wanted
  std::vector<NeighborLists> lists_;      // by part
  SiteCells cells_;
};

/// Rows and the unit. Differences of coordinates that may be out of range are taken of smaller numbers.
void SiteCellsMaker::start() {
  const std::size_t n = periodic_ == nullptr ? triangulation_.num_rows() : periodic_->num_rows();
  cells_.dimension = triangulation_.dimension();
  if (periodic_ != nullptr) cells_.rank = static_cast<int>(periodic_->rank());
  cells_.volumes.assign(n, 0.0);
  cells_.centroids.assign(n * d_, std::numeric_limits<double>::quiet_NaN());
  cells_.areas.assign(n, 0.0);
  cells_.num_faces.assign(n, 0);
  row_of_vertex_.assign(complex_.num_vertex_slots(), invalid_index);
  double largest = 0;
  for (Index v = 1; v < complex_.num_vertex_slots(); ++v) {
    if (!complex_.is_vertex(VertexId{v})) continue;
    row_of_vertex_[v] =
        periodic_ == nullptr ? static_cast<Index>(triangulation_.row_of(VertexId{v})) : periodic_->row_of(v);
    const double* const p = points_.point(v);
    for (std::size_t j = 0; j < points_.row_size(); ++j) largest = std::max(largest, std::abs(p[j]));
  }
  if (largest > 0x1p1000) unit_ = 8;
}

/// Its cell is everything, or the box.
void SiteCellsMaker::measure_lone_site() {
  const Index v = index(complex_.finite_vertices().front());
  if (has_lists()) lists_.resize(1);
  if (!container_) {
    cells_.volumes[row_of_vertex_[v]] = cells_.areas[row_of_vertex_[v]] = infinity;
    return;
  }
  CellClipper clipper(points_, *container_);
  Order order;
  clip(v, {}, clipper, order, lists_.data());
}

/// Prefetches what sites that follow will write. Their vertices are next to each other, but their rows are
/// anywhere in memory.
[[gnu::always_inline]] inline void SiteCellsMaker::prefetch_after(std::size_t v) const {
  constexpr std::size_t near = 4, far = 8;
  if (v + far >= row_of_vertex_.size()) return;
  const bool has_room = has_lists() && lists_.empty();
  if (const Index row = row_of_vertex_[v + far]; row != invalid_index) {
    prefetch_items(cells_.volumes, row, row + 1);
    prefetch_items(cells_.areas, row, row + 1);
    prefetch_items(cells_.num_faces, row, row + 1);
    prefetch_items(cells_.centroids, row * d_, (row + 1) * d_);
    if (periodic_ != nullptr) internal::prefetch(periodic_->given_point(row));
    if (has_room) internal::prefetch(&cells_.neighbor_offsets[row]);
  }
  if (const Index row = row_of_vertex_[v + near]; has_room && row != invalid_index) {
    const auto begin = static_cast<std::size_t>(cells_.neighbor_offsets[row]),
               end = static_cast<std::size_t>(cells_.neighbor_offsets[row + 1]),
               rank = static_cast<std::size_t>(cells_.rank);
    prefetch_items(cells_.neighbors, begin, end);
    prefetch_items(cells_.face_areas, begin, end);
    prefetch_items(cells_.distances, begin, end);
    if (!cells_.num_edges.empty()) prefetch_items(cells_.num_edges, begin, end);
    prefetch_items(cells_.neighbor_lattice, begin * rank, end * rank);
  }
}

void SiteCellsMaker::measure() {
  const std::size_t slots = complex_.num_vertex_slots();
  const Stars stars(complex_, periodic_ == nullptr ? std::vector<unsigned char>() : periodic_->have_cells());
  if (are_proper()) {
    const std::vector<int> axes = triangulation_.axes();
    classes_.emplace(stars, points_, kernel::Flat{points_.ambient, axes, points_.form}, threads_);
  }
  find_centers(stars);
  if (has_lists() && are_lengths_known())
    lay_out(stars);
  else if (has_lists())
    lists_.resize((slots + vertices_in_part - 1) / vertices_in_part);
  internal::work_in_parts(threads_, slots, vertices_in_part, [&] {
    return [&, worker = Worker(*this, stars)](std::size_t first, std::size_t last,
                                              const internal::StopPoint& stop) mutable {
      NeighborLists* const lists = lists_.empty() ? nullptr : &lists_[first / vertices_in_part];
      for (std::size_t v = first; v < last; ++v) {
        prefetch_after(v);
        if (!has_cell(static_cast<Index>(v))) continue;
        stop();
        measure_site(static_cast<Index>(v), worker, lists);
      }
    };
  });
}

/// As far as they are wanted. In a flat with a box all cells are clipped.
void SiteCellsMaker::find_centers(const Stars& stars) {
  if (container_ ? k_ < d_ : !options_.vertices) return;
  if (options_.vertices) centers_.resize(complex_.num_cell_slots() * d_);
  if (container_) inside_.resize(complex_.num_cell_slots());
  for_each_center(
      triangulation_, points_, [&](CellId cell) { return stars.has(cell); },
      [&](CellId cell, const double* center) {
        if (options_.vertices) std::copy_n(center, d_, centers_.data() + index(cell) * d_);
        if (container_) inside_[index(cell)] = particles::is_inside(center, d_, *container_) ? 1 : 0;
      },
      threads_);
}

/// Cells are convex, so one is inside if its vertices are.
bool SiteCellsMaker::is_inside(const Star& star) const {
  if (inside_.empty()) return false;
  for (std::size_t c = 0; c < star.num_cells(); ++c)
    if (inside_[index(star.cell(c))] == 0) return false;
  return true;
}

/// By Euler's formula for the link, a sphere of dimension k − 1 of which each cell at the site is a simplex.
void SiteCellsMaker::lay_out(const Stars& stars) {
  std::vector<std::int64_t>& lengths = cells_.neighbor_offsets;
  lengths.assign(cells_.num_rows() + 1, 0);
  for (Index v = 1; v < row_of_vertex_.size(); ++v) {
    if (!has_cell(v)) continue;
    const auto num_cells = static_cast<std::int64_t>(stars.cells_at(v).size());
    lengths[row_of_vertex_[v] + 1] = k_ == 3 ? num_cells / 2 + 2 : num_cells;
  }
  for (const VertexId v : complex_.adjacent_vertices(infinite_vertex))
    if (has_cell(index(v))) --lengths[row_of_vertex_[index(v)] + 1];
  lay_out_lists(dimension_of_cells() == 3, threads_, cells_);
}

/// `lists`: null unless lists of this part are wanted.
void SiteCellsMaker::measure_site(Index v, Worker& worker, NeighborLists* lists) {
  Star& star = worker.star;
  CellMeasure& measure = worker.measure;
  star.find(v);
  star.arrange(worker.neighbor_order.find(v, star.neighbors(), row_of_vertex_, periodic_));
  if (container_ && !is_inside(star)) {
    clip(v, star.neighbors(), *worker.clipper, worker.order, lists);
    return;
  }
  const std::size_t row = row_of_vertex_[v], n = star.neighbors().size();
  measure.begin(points_.point(v), n);
  for (std::size_t i = 0; i < n; ++i) measure.set_neighbor(i, points_.point(star.neighbors()[i]));
  measure.measure(star.corners());
  if (worker.faces) worker.faces->find(star);
  const auto counts = [&](std::size_t i) { return !worker.faces || worker.faces->is_proper(i); };
  std::size_t num_faces = 0;
  double surface = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (counts(i)) {
      ++num_faces;
      surface += measure.areas()[i];
    }
  cells_.num_faces[row] = static_cast<SignedIndex>(num_faces);
  if (star.is_bounded()) {
    cells_.volumes[row] = outer(measure.volume(), k_);
    if (measure.volume() > 0) set_centroid(row, v, measure.offset());
    cells_.areas[row] = outer(surface, k_ - 1);
  } else {
    cells_.volumes[row] = cells_.areas[row] = infinity;
  }
  if (lists != nullptr) {
    lists->begin(row, num_faces);
    if (worker.polygons) {
      worker.polygons->find(v, star);
      list_vertices(v, *worker.polygons, *lists);
    }
    list_neighbors(worker, *lists);
  } else if (has_lists()) {
    auto at = static_cast<std::size_t>(cells_.neighbor_offsets[row]);
    for_each_listed(worker, [&](std::size_t, const ListedNeighbor& listed, const std::int32_t* lattice) {
      put_neighbor(cells_, at++, listed, lattice);
    });
  }
}

/// In a periodic set around the point where it was given.
void SiteCellsMaker::list_vertices(Index v, FacePolygons& polygons, NeighborLists& lists) {
  lists.num_vertices.push_back(static_cast<std::uint32_t>(polygons.num_vertices()));
  const double* const site = points_.point(v);
  for (std::size_t i = 0; i < polygons.num_vertices(); ++i) {
    const double* const x = polygons.vertex(i);
    for (std::size_t j = 0; j < d_; ++j)
      lists.vertices.push_back(periodic_ == nullptr
                                   ? x[j]
                                   : periodic_->given_point(row_of_vertex_[v])[j] + outer(x[j] - site[j], 1));
  }
}

/// Calls put(slot, neighbor, lattice) in the order of slots.
template <class Put>
void SiteCellsMaker::for_each_listed(Worker& worker, const Put& put) {
  const Star& star = worker.star;
  const CellMeasure& measure = worker.measure;
  const auto rank = static_cast<std::size_t>(cells_.rank);
  if (k_ == 3 && !worker.faces) star.count_cells_at_edges(worker.num_at_edges);
  for (std::size_t i = 0; i < star.neighbors().size(); ++i) {
    if (worker.faces && !worker.faces->is_proper(i)) continue;
    const bool is_unbounded = star.is_at_infinity(i) && k_ > 1;
    ListedNeighbor listed{static_cast<SignedIndex>(row_of_vertex_[star.neighbors()[i]]), 0,
                          is_unbounded ? infinity : outer(measure.areas()[i], k_ - 1),
                          outer(measure.distances()[i], 1)};
    if (k_ == 3)
      listed.num_edges = static_cast<SignedIndex>(
          (worker.faces ? worker.faces->num_classes(i) : worker.num_at_edges[i]) + (is_unbounded ? 1 : 0));
    put(i, listed, worker.neighbor_order.offsets(i, rank).data());
  }
}

void SiteCellsMaker::list_neighbors(Worker& worker, NeighborLists& lists) {
  const auto rank = static_cast<std::size_t>(cells_.rank);
  for_each_listed(worker, [&](std::size_t i, const ListedNeighbor& listed, const std::int32_t* lattice) {
    lists.neighbors.push_back(listed);
    if (worker.polygons) {
      const std::span<const SignedIndex> face = worker.polygons->face(i);
      lists.face_lengths.push_back(static_cast<std::uint32_t>(face.size()));
      lists.face_vertices.insert(lists.face_vertices.end(), face.begin(), face.end());
    }
    lists.lattice.insert(lists.lattice.end(), lattice, lattice + rank);
  });
}

void SiteCellsMaker::clip(Index v, std::span<const Index> neighbors, CellClipper& clipper, Order& order,
                          NeighborLists* lists) {
  const std::size_t row = row_of_vertex_[v];
  clipper.clip(v, neighbors, are_proper(), options_.vertices);
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
  if (lists == nullptr) return;
  std::sort(order.begin(), order.end());
  lists->begin(row, order.size());
  if (options_.vertices) {
    lists->num_vertices.push_back(static_cast<std::uint32_t>(clipper.vertices().size() / d_));
    lists->vertices.insert(lists->vertices.end(), clipper.vertices().begin(), clipper.vertices().end());
  }
  for (const auto& [other, i] : order) {
    lists->neighbors.push_back({other == invalid_index ? -1 : static_cast<SignedIndex>(other),
                                d_ == 3 ? static_cast<SignedIndex>(faces[i].num_corners) : 0, faces[i].area,
                                faces[i].distance});
    if (!options_.vertices) continue;
    lists->face_lengths.push_back(static_cast<std::uint32_t>(faces[i].vertices.size()));
    lists->face_vertices.insert(lists->face_vertices.end(), faces[i].vertices.begin(),
                                faces[i].vertices.end());
  }
}

void require_supported(const Triangulation& triangulation) {
  if (triangulation.affine_dimension() > most_dimension)
    throw Error(Errc::unsupported,
                "cells of sites are available up to dimension " + std::to_string(most_dimension));
}

/// Of cells that are in no box.
void refuse_halfspaces(const SiteCellsOptions& options) {
  if (!options.halfspaces.empty()) throw Error(Errc::invalid_argument, "halfspaces clip cells only in a box");
}

}  // namespace
}  // namespace particles

SiteCells site_cells(const Triangulation& triangulation, const SiteCellsOptions& options,
                     const Execution& how) {
  if (triangulation.kind() == TriangulationKind::furthest_site)
    throw Error(Errc::invalid_argument, "cells of sites are those of a Delaunay or regular triangulation");
  particles::require_supported(triangulation);
  if (options.box)
    voronoi::require_container(*options.box, options.halfspaces, triangulation.dimension());
  else
    particles::refuse_halfspaces(options);
  return internal::guarded("the cells of sites", [&] {
    const internal::ProgressMeter meter(how.progress);
    return particles::SiteCellsMaker(triangulation, nullptr, options, how.threads).run();
  });
}

SiteCells site_cells(const PeriodicTriangulation& triangulation, const SiteCellsOptions& options,
                     const Execution& how) {
  if (options.box) throw Error(Errc::unsupported, "a box clips no cells of a periodic set");
  particles::refuse_halfspaces(options);
  return internal::guarded("the cells of sites", [&] {
    const internal::ProgressMeter meter(how.progress);
    const particles::PeriodicSites sites(triangulation);
    particles::require_supported(sites.triangulation());
    return particles::SiteCellsMaker(sites.triangulation(), &sites, options, how.threads).run();
  });
}

}  // namespace delone
