// SPDX-License-Identifier: BSD-3-Clause
#include <delone/cell_search.hpp>

#include "base/guarded.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "base/require_dimension.hpp"
#include "base/require_finite.hpp"
#include "base/require_tolerance.hpp"
#include "kernel/nearest_in_hull.hpp"
#include "kernel/predicates.hpp"
#include "queries/barycentric.hpp"
#include "queries/box_tree.hpp"
#include "queries/require_room.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace delone {
namespace {

using queries::require_room;

using Corners = std::vector<const double*>;
using Flags = std::vector<unsigned char>;

}  // namespace

struct CellSearch::Impl {
  Impl(PointsView given, std::span<const SignedIndex> of_cells)
      : points(given), d(static_cast<std::size_t>(given.dimension())), cells(of_cells), axes(d) {
    internal::require_dimension(given.dimension());
    std::iota(axes.begin(), axes.end(), 0);
    if (cells.size() % (d + 1) != 0)
      throw Error(Errc::invalid_argument,
                  "the number of rows of cells is not a multiple of the dimension and one");
    require_rows();
    orientations.reserve(num_cells());
    std::vector<double> boxes(num_cells() * 2 * d);
    Corners corners;
    for (std::size_t c = 0; c < num_cells(); ++c) {
      internal::cancellation_point();
      load(c, corners);
      orientations.push_back(kernel::orientation(flat(), corners));
      if (orientations.back() == Sign::zero) flat_cells.push_back(static_cast<SignedIndex>(c));
      for (std::size_t j = 0; j < d; ++j) {
        const auto less = [j](const double* a, const double* b) { return a[j] < b[j]; };
        const auto [low, high] = std::minmax_element(corners.begin(), corners.end(), less);
        boxes[c * 2 * d + j] = (*low)[j];
        boxes[c * 2 * d + d + j] = (*high)[j];
      }
    }
    tree.emplace(std::move(boxes), d);
  }

  std::size_t num_cells() const { return cells.size() / (d + 1); }
  kernel::Flat flat() const { return {static_cast<int>(d), axes}; }

  void load(std::size_t cell, Corners& corners) const {
    corners.clear();
    for (const SignedIndex row : cells.subspan(cell * (d + 1), d + 1))
      corners.push_back(points[static_cast<std::size_t>(row)].data());
  }

  void require_rows() const {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string where = "cell " + std::to_string(i / (d + 1));
      if (cells[i] < 0 || static_cast<std::size_t>(cells[i]) >= points.size())
        throw Error(Errc::invalid_argument, where + ": there is no row " + std::to_string(cells[i]),
                    {i / (d + 1)});
      const std::span<const double> point = points[static_cast<std::size_t>(cells[i])];
      if (!std::all_of(point.begin(), point.end(), [](double x) { return std::isfinite(x); }))
        throw Error(Errc::not_finite,
                    where + ": a coordinate of point " + std::to_string(cells[i]) + " is not finite",
                    {static_cast<std::size_t>(cells[i])});
    }
  }

  PointsView points;
  std::size_t d;
  std::span<const SignedIndex> cells;
  std::vector<int> axes;
  std::vector<Sign> orientations;
  std::vector<SignedIndex> flat_cells;
  std::optional<queries::BoxTree> tree;
};

namespace {

/// The search of one thread.
template <class Impl>
class Searcher {
 public:
  explicit Searcher(const Impl& in) : in_(in) {}

  /// The cells within a radius of q, increasing.
  std::span<const SignedIndex> find(const double* q, double radius) {
    found_.clear();
    in_.tree->visit(q, radius, [&](std::size_t cell) {
      if (in_.orientations[cell] == Sign::zero) return;
      if (contains(cell, q) || (radius > 0 && is_within(q, radius)))
        found_.push_back(static_cast<SignedIndex>(cell));
    });
    std::sort(found_.begin(), found_.end());
    return found_;
  }

  /// Whether the cell contains q. Marks the vertices of the smallest face that does in on_face().
  bool contains(std::size_t cell, const double* q) {
    in_.load(cell, corners_);
    on_face_.assign(corners_.size(), 1);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const double* const corner = std::exchange(corners_[i], q);
      const Sign side = kernel::orientation(in_.flat(), corners_);
      corners_[i] = corner;
      if (side == Sign::zero)
        on_face_[i] = 0;
      else if (side != in_.orientations[cell])
        return false;
    }
    return true;
  }
  const Flags& on_face() const { return on_face_; }

  /// After contains(), of the same cell and query.
  const std::vector<double>& barycentric(const double* q) {
    queries::barycentric(corners_, on_face_, in_.axes, q, weights_);
    return weights_;
  }

 private:
  /// After contains(), of the same cell.
  bool is_within(const double* q, double radius) {
    nearest_.find(corners_, q, static_cast<int>(in_.d));
    return nearest_.lower() <= radius;
  }

  const Impl& in_;
  Corners corners_;
  Flags on_face_;
  std::vector<double> weights_;
  std::vector<SignedIndex> found_;
  kernel::NearestInHull nearest_;
};

Location::Kind kind_of(const Flags& on_face) {
  const auto size = std::count(on_face.begin(), on_face.end(), 1);
  if (size == 1) return Location::Kind::on_vertex;
  return size == static_cast<std::ptrdiff_t>(on_face.size()) ? Location::Kind::in_cell
                                                             : Location::Kind::on_face;
}

/// Calls work(searcher, query) for all queries.
template <class Impl, class Work>
void for_queries(const Impl& in, std::span<const double> queries, const Execution& how, const Work& work) {
  constexpr std::size_t part = 256;
  if (queries.size() % in.d != 0)
    throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  internal::guarded("the queries", [&] {
    internal::require_finite(queries, in.d, "a coordinate", "query");
    internal::ProgressMeter meter(how.progress);
    internal::work_in_parts(how.threads, queries.size() / in.d, part, [&] {
      return
          [&, searcher = Searcher<Impl>(in)](std::size_t first, std::size_t last, const auto& stop) mutable {
            for (std::size_t i = first; i < last; ++i) {
              stop();
              work(searcher, i);
            }
          };
    });
  });
}

}  // namespace

CellSearch::CellSearch(PointsView points, std::span<const SignedIndex> cells)
    : impl_(internal::guarded("the cells", [&] { return std::make_unique<const Impl>(points, cells); })) {}
CellSearch::CellSearch(CellSearch&&) noexcept = default;
CellSearch& CellSearch::operator=(CellSearch&&) noexcept = default;
CellSearch::~CellSearch() = default;

std::size_t CellSearch::num_cells() const { return impl_->num_cells(); }
std::span<const SignedIndex> CellSearch::flat_cells() const { return impl_->flat_cells; }

void CellSearch::find(std::span<const double> queries, double radius, const Visit& visit,
                      const Execution& how) const {
  internal::require_tolerance(radius, "radius");
  for_queries(*impl_, queries, how, [&](auto& searcher, std::size_t i) {
    visit(i, searcher.find(&queries[i * impl_->d], radius));
  });
}

void CellSearch::locate(std::span<const double> queries, const LocatedArrays& to,
                        const Execution& how) const {
  const std::size_t count = queries.size() / impl_->d, width = impl_->d + 1;
  require_room(to.kinds, count, "kinds");
  require_room(to.cells, count, "cells");
  require_room(to.barycentric, count * width, "barycentric coordinates");
  require_room(to.distances, count, "distances");
  for_queries(*impl_, queries, how, [&](auto& searcher, std::size_t i) {
    const double* const q = &queries[i * impl_->d];
    const std::span<const SignedIndex> found = searcher.find(q, 0);
    if (!to.cells.empty()) to.cells[i] = found.empty() ? SignedIndex{-1} : found[0];
    if (!to.distances.empty()) to.distances[i] = 0;
    if (!found.empty()) searcher.contains(static_cast<std::size_t>(found[0]), q);
    if (!to.kinds.empty())
      to.kinds[i] = found.empty() ? Location::Kind::outside_hull : kind_of(searcher.on_face());
    if (to.barycentric.empty()) return;
    const auto out = to.barycentric.subspan(i * width, width);
    if (found.empty())
      std::ranges::fill(out, std::numeric_limits<double>::quiet_NaN());
    else
      std::ranges::copy(searcher.barycentric(q), out.begin());
  });
}

}  // namespace delone
