// SPDX-License-Identifier: BSD-3-Clause
// What the parts of PointLocator share: the triangulation, with direct access to its coordinates.
#pragma once

#include "base/parallel_parts.hpp"
#include "order/insertion_order.hpp"
#include "queries/thick_cells.hpp"
#include "triangulation/stored_points.hpp"

#include <delone/point_locator.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace delone::queries {

/// How a batch of queries is divided among threads.
struct BatchOptions {
  unsigned threads = 1;           ///< as Options::threads
  std::size_t least_part = 2048;  ///< queries; as many as take some 100 µs
};

/// Who gets the answers: one visitor that all threads share, or for each thread that works its own.
struct Visits {
  const PointLocator::Visit* shared = nullptr;
  std::function<PointLocator::Visit()> make{};
};

}  // namespace delone::queries

struct delone::PointLocator::Impl {
  explicit Impl(const Triangulation& t)
      : triangulation(t),
        complex(t.complex()),
        points(triangulation::StoredPoints::of(t)),
        dimension(t.dimension()),
        affine_dimension(t.affine_dimension()),
        axes(t.axes()) {}

  const Triangulation& triangulation;
  Complex complex;
  const sites::VertexPoints& points;
  int dimension, affine_dimension;
  std::vector<int> axes;

  mutable std::once_flag edges_once;
  mutable Edges edges;
  mutable std::once_flag side_once;
  mutable double side = 0;
  mutable std::mutex thick_mutex;
  mutable std::shared_ptr<const queries::ThickCells> thick;  // for the tolerance used last

  const double* point(VertexId v) const { return points.point(index(v)); }
  /// Answers all queries in parts, whose walks start in cells that do not depend on the number of threads. A
  /// part is a stretch of a Hilbert curve. Each thread that works has its own part_work = make_work(), called
  /// as part_work(rows, start, stop); `start` is a finite cell, or invalid_cell. find_start(query, start)
  /// returns a finite cell at the query, or `start`. Rounds bound the time until the first answer, so that a
  /// callback can stop a large batch early. Throws as locate().
  template <class MakeWork, class FindStart>
  void in_parts(std::span<const double> queries, const queries::BatchOptions& how, MakeWork make_work,
                FindStart find_start) const {
    std::vector<Index> rows = rows_of(queries);
    const std::size_t part = std::clamp(rows.size() / 64, how.least_part, most_in_part);
    std::vector<CellId> starts;
    CellId start = invalid_cell;
    for (std::size_t first = 0; first < rows.size(); first += round) {
      const auto in_round = std::span(rows).subspan(first, std::min(round, rows.size() - first));
      for (std::size_t at = 0; at < in_round.size(); at += piece) {
        const auto sorted = in_round.subspan(at, std::min(piece, in_round.size() - at));
        if (sorted.size() > 8)
          order::hilbert_sort(PointsView(queries, dimension), sorted, 0,
                              internal::threads_for_parts(how.threads, sorted.size() / part));
      }
      starts.clear();
      for (std::size_t at = 0; at < in_round.size() && rows.size() > part; at += part)
        starts.push_back(start = find_start(in_round[at], start));
      internal::work_in_parts(how.threads, in_round.size(), part, [&] {
        return [&, work = make_work()](std::size_t begin, std::size_t end,
                                       const internal::StopPoint& stop) mutable {
          work(std::span<const Index>(in_round.subspan(begin, end - begin)),
               starts.empty() ? invalid_cell : starts[begin / part], stop);
        };
      });
    }
  }
  /// PointLocator::locate().
  void locate(std::span<const double> queries, const LocateOptions& options, queries::BatchOptions batch,
              const queries::Visits& visits) const;
  /// The longest side of the bounding box of the vertices; 0 if there are none. Kept.
  double longest_side() const;
  /// The kinds of cells for this tolerance; null for 0.
  std::shared_ptr<const queries::ThickCells> thick_cells(double tolerance) const;
  static constexpr std::size_t piece = std::size_t{1} << 18;  // sorted as a whole
  static constexpr std::size_t round = 8 * piece;
  static constexpr std::size_t most_in_part = 8192;

 private:
  /// Checks the queries and returns their numbers. Throws as locate().
  std::vector<Index> rows_of(std::span<const double> queries) const;
};
