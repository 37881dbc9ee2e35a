// SPDX-License-Identifier: BSD-3-Clause
#include <delone/site_cells.hpp>

#include "base/guarded.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "particles/cell_measure.hpp"
#include "particles/stars.hpp"
#include "triangulation/stored_points.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone {
namespace particles {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_dimension = 12;
constexpr std::size_t vertices_in_part = 1024;

/// The lists of some sites, one after the other.
struct Lists {
  std::vector<Index> rows;                // the sites
  std::vector<std::uint32_t> lengths;     // by site
  std::vector<SignedIndex> neighbors, num_edges;
  std::vector<double> areas, distances;
};

/// The neighbors of a site, with their slots.
using Order = std::vector<std::pair<Index, std::uint32_t>>;

class SiteCellsMaker {
 public:
  SiteCellsMaker(const Triangulation& triangulation, const SiteCellsOptions& options, unsigned threads)
      : triangulation_(triangulation),
        options_(options),
        threads_(threads),
        complex_(triangulation.complex()),
        points_(triangulation::StoredPoints::of(triangulation)),
        k_(static_cast<std::size_t>(std::max(complex_.affine_dimension(), 0))),
        d_(static_cast<std::size_t>(triangulation.dimension())) {}

  SiteCells run() {
    start();
    if (complex_.affine_dimension() == 0) {
      set_unbounded(triangulation_.row_of(complex_.finite_vertices().front()));
    } else if (k_ > 0) {
      measure();
    }
    if (options_.neighbors) join_lists();
    return std::move(cells_);
  }

 private:
  void start();
  void measure();
  void measure_site(Index v, Star& star, CellMeasure& measure, Order& order, Lists& lists);
  void join_lists();
  void set_unbounded(std::size_t row) {
    cells_.volumes[row] = cells_.areas[row] = infinity;
  }

  const Triangulation& triangulation_;
  const SiteCellsOptions& options_;
  unsigned threads_;
  Complex complex_;
  const sites::VertexPoints& points_;
  std::size_t k_, d_;
  std::vector<Index> row_of_vertex_;
  int unit_ = 0;
  std::vector<Lists> lists_;  // by part
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

void SiteCellsMaker::measure() {
  const std::size_t slots = complex_.num_vertex_slots();
  const Stars stars(complex_);
  lists_.resize((slots + vertices_in_part - 1) / vertices_in_part);
  internal::work_in_parts(threads_, slots, vertices_in_part, [&] {
    return [&, star = Star(stars, slots),
            measure = CellMeasure(k_, d_, points_.weighted(), unit_),
            order = Order()](
               std::size_t first, std::size_t last, const internal::StopPoint& stop) mutable {
      Lists& lists = lists_[first / vertices_in_part];
      for (std::size_t v = first; v < last; ++v) {
        if (row_of_vertex_[v] == invalid_index) continue;
        stop();
        measure_site(static_cast<Index>(v), star, measure, order, lists);
      }
    };
  });
}

void SiteCellsMaker::measure_site(Index v, Star& star, CellMeasure& measure, Order& order, Lists& lists) {
  star.find(v);
  const std::size_t row = row_of_vertex_[v], n = star.neighbors().size();
  measure.begin(n);
  for (std::size_t i = 0; i < n; ++i) measure.set_neighbor(i, points_.point(v), points_.point(star.neighbors()[i]));
  measure.measure(star.corners());
  cells_.num_faces[row] = static_cast<SignedIndex>(n);
  const auto area_of = [&](std::size_t i) { return star.is_at_infinity(i) ? infinity : measure.areas()[i]; };
  if (star.is_bounded()) {
    cells_.volumes[row] = measure.volume();
    double surface = 0;
    for (const double area : measure.areas()) surface += area;
    cells_.areas[row] = surface;
    for (std::size_t j = 0; j < d_; ++j)
      cells_.centroids[row * d_ + j] = points_.point(v)[j] + measure.offset()[j];
  } else {
    set_unbounded(row);
  }
  if (!options_.neighbors) return;
  lists.rows.push_back(static_cast<Index>(row));
  lists.lengths.push_back(static_cast<std::uint32_t>(n));
  order.resize(n);
  for (std::size_t i = 0; i < n; ++i) {  // by row
    const Index other = row_of_vertex_[star.neighbors()[i]];
    std::size_t at = i;
    for (; at > 0 && other < order[at - 1].first; --at) order[at] = order[at - 1];
    order[at] = {other, static_cast<std::uint32_t>(i)};
  }
  for (const auto& [other, i] : order) {
    lists.neighbors.push_back(static_cast<SignedIndex>(other));
    lists.areas.push_back(area_of(i));
    lists.distances.push_back(measure.distances()[i]);
    if (k_ == 3)
      lists.num_edges.push_back(static_cast<SignedIndex>(star.num_cells_at(i) + (star.is_at_infinity(i) ? 1 : 0)));
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
  if (k_ == 3) cells_.num_edges.resize(size);
  internal::for_parts(threads_, lists_.size(), 1,
                      [&](std::size_t part, std::size_t, const internal::StopPoint& stop) {
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
                          if (k_ == 3) copy(lists.num_edges, cells_.num_edges);
                          from += length;
                        }
                        lists = {};
                      });
}

}  // namespace
}  // namespace particles

SiteCells site_cells(const Triangulation& triangulation, const SiteCellsOptions& options, const Execution& how) {
  if (triangulation.kind() == TriangulationKind::furthest_site)
    throw Error(Errc::invalid_argument, "cells of sites are those of a Delaunay or regular triangulation");
  if (triangulation.affine_dimension() > particles::most_dimension)
    throw Error(Errc::unsupported, "cells of sites are available up to dimension " +
                                       std::to_string(particles::most_dimension));
  return internal::guarded("the cells of sites", [&] {
    const internal::ProgressMeter meter(how.progress);
    return particles::SiteCellsMaker(triangulation, options, how.threads).run();
  });
}

}  // namespace delone
