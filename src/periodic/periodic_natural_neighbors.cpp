// SPDX-License-Identifier: BSD-3-Clause
// PeriodicNaturalNeighborCoordinates and PeriodicNaturalNeighborInterpolator.
//
// A search among the points of the box and their images (queries/natural_search.hpp) finds the cells in
// conflict with the query. If each of them and each of their neighbors has a vertex in the box, all are cells
// of the whole set. Its zone is bounded by neighbors that are not in conflict, and connected, so it is the
// same.
//
// Otherwise the zone is collected cell by cell across the border, from the one that contains the query. Its
// vertices have the same coordinates in a triangulation of their own: the region that the query would have is
// bounded by what it has in common with them, and every point of it is as near to one of them as to any other
// point of the set. They are as far from the query, along the lattice, as the reach allows, so their
// coordinates are exact.
#include "base/guarded.hpp"
#include "periodic/periodic_point_locator_impl.hpp"
#include "queries/natural_search.hpp"
#include "queries/site_gradients.hpp"

#include <delone/delaunay.hpp>

#include <algorithm>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

namespace delone {

using periodic::Offset;
using periodic::PeriodicBatch;
using periodic::Place;
using periodic::PlaceVisit;
using periodic::QueryParts;
using periodic::Translate;
using periodic::WrappedQueries;
using queries::NaturalCenters;
using queries::NaturalSearch;

struct PeriodicNaturalNeighborCoordinates::Impl {
  explicit Impl(const PeriodicTriangulation& t)
      : locator(t), parts(locator.parts), centers(parts.ghosts.triangulation(), true) {}

  PeriodicPointLocator::Impl locator;
  const QueryParts& parts;
  NaturalCenters centers;
};

namespace {

const PeriodicTriangulation& without_weights(const PeriodicTriangulation& t) {
  if (t.is_regular())
    throw Error(Errc::unsupported, "natural neighbors are those of a Delaunay triangulation");
  return t;
}

/// The natural neighbors of one query after the other; each thread has its own.
class Search {
 public:
  Search(const QueryParts& parts, const NaturalCenters& centers, bool with_gradients)
      : parts_(parts), with_gradients_(with_gradients), search_(centers), x_(parts.dimension) {}

  struct Neighbor {
    VertexId vertex;  // of the triangulation with ghosts
    Offset by;        // translated by this it is the neighbor
    double weight;
    std::vector<double> gradient;  // of the weight; empty at a vertex
  };
  /// In an order that does not depend on where the search began, so that sums do not.
  std::vector<Neighbor> found;
  bool is_at_vertex = false;

  void find(const double* q, const Place& place) {
    found.clear();
    is_at_vertex = place.kind == Location::Kind::on_vertex;
    if (place.cell < 0) return;
    if (is_at_vertex) {
      for (std::size_t i = 0; i < parts_.corners; ++i)
        if (place.barycentric[i] > 0)
          found.push_back({parts_.classes.vertex(place.cell, i), offset_of(place), 1, {}});
      return;
    }
    x_.assign(q, q + parts_.dimension);
    parts_.subtract(place.offset, x_);
    search_.find(x_.data(), parts_.classes.cell(place.cell), with_gradients_);
    if (!is_complete()) {
      find_across(q, place);
    } else {
      for (std::size_t i = 0; i < search_.vertices.size(); ++i)
        found.push_back({search_.vertices[i], offset_of(place), search_.weights[i], gradient_of(search_, i)});
    }
    std::ranges::sort(found, [&](const Neighbor& a, const Neighbor& b) {
      const std::uint32_t of_a = parts_.row_of(a.vertex), of_b = parts_.row_of(b.vertex);
      return std::tie(of_a, a.weight, a.gradient) < std::tie(of_b, b.weight, b.gradient);
    });
  }

 private:
  std::vector<double> gradient_of(const NaturalSearch& search, std::size_t i) const {
    if (!with_gradients_) return {};
    const auto first = search.gradients.begin() + static_cast<std::ptrdiff_t>(i * parts_.dimension);
    return {first, first + static_cast<std::ptrdiff_t>(parts_.dimension)};
  }
  static Offset offset_of(const Place& place) { return {place.offset.begin(), place.offset.end()}; }

  bool is_complete() const {
    return std::ranges::all_of(search_.zone(), [&](CellId cell) {
      if (!parts_.classes.has_own(cell)) return false;
      for (std::size_t i = 0; i < parts_.corners; ++i)
        if (!parts_.classes.has_own(parts_.complex.neighbor(cell, static_cast<int>(i)))) return false;
      return true;
    });
  }

  void find_across(const double* q, const Place& place) {
    // Cells as numbers and translations.
    std::vector<std::pair<SignedIndex, Offset>> zone{{place.cell, offset_of(place)}};
    std::set<std::pair<SignedIndex, Offset>> seen{zone.front()};
    std::set<std::pair<std::uint32_t, Offset>> names;
    std::vector<std::pair<VertexId, Offset>> sites;
    std::vector<double> coordinates;
    for (std::size_t next = 0; next < zone.size(); ++next) {
      const auto [number, offset] = zone[next];
      const CellId cell = parts_.classes.cell(number);
      for (const VertexId v : parts_.complex.vertices(cell)) {
        Offset at = parts_.classes.offset_of(v);
        for (std::size_t l = 0; l < parts_.rank; ++l) at[l] += offset[l];
        if (!names.emplace(parts_.row_of(v), at).second) continue;
        std::vector<double> x(parts_.point(v), parts_.point(v) + parts_.dimension);
        Offset back(parts_.rank);
        for (std::size_t l = 0; l < parts_.rank; ++l) back[l] = -offset[l];
        parts_.subtract(back, x);
        coordinates.insert(coordinates.end(), x.begin(), x.end());
        sites.emplace_back(v, offset);
      }
      for (std::size_t i = 0; i < parts_.corners; ++i) {
        Translate neighbor = parts_.classes.find_neighbor(cell, static_cast<int>(i));
        if (neighbor.number < 0) continue;
        for (std::size_t l = 0; l < parts_.rank; ++l) neighbor.offset[l] += offset[l];
        std::pair<SignedIndex, Offset> translated(neighbor.number, std::move(neighbor.offset));
        if (!seen.insert(translated).second || !is_inside(q, translated)) continue;
        zone.push_back(std::move(translated));
      }
    }
    const Delaunay<> some(PointsView(coordinates, static_cast<int>(parts_.dimension)));
    const NaturalCenters centers(some, false);
    NaturalSearch search(centers);
    const std::span<const double> query(q, parts_.dimension);
    search.find(q, some.locate(query).cell, with_gradients_);
    for (std::size_t i = 0; i < search.vertices.size(); ++i) {
      const auto& [v, offset] = sites[some.row_of(search.vertices[i])];
      found.push_back({v, offset, search.weights[i], gradient_of(search, i)});
    }
  }

  bool is_inside(const double* q, const std::pair<SignedIndex, Offset>& cell) {
    x_.assign(q, q + parts_.dimension);
    parts_.subtract(cell.second, x_);
    return triangulation::StoredPoints::in_sphere(parts_.ghosts.triangulation(),
                                                  parts_.classes.cell(cell.first), x_) == Side::inside;
  }

  const QueryParts& parts_;
  const bool with_gradients_;
  NaturalSearch search_;
  std::vector<double> x_;
};

/// Calls visit(query, search) for all queries.
template <class MakeVisit>
void each_natural(const QueryParts& parts, const NaturalCenters& centers, const WrappedQueries& queries,
                  bool with_gradients, MakeVisit make_visit, unsigned threads) {
  const auto make = [&]() -> PlaceVisit {
    const auto search = std::make_shared<Search>(parts, centers, with_gradients);
    return [&, search, visit = make_visit()](std::size_t query, const Place& place) mutable {
      search->find(queries.points.data() + query * parts.dimension, place);
      visit(query, *search);
    };
  };
  find_places(parts, queries, false, make, threads);
}

}  // namespace

PeriodicNaturalNeighborCoordinates::PeriodicNaturalNeighborCoordinates(
    const PeriodicTriangulation& triangulation, const Execution& how) {
  internal::guarded("the centers of the cells", [&] {
    const internal::ProgressMeter meter(how.progress);
    impl_ = std::make_unique<const Impl>(without_weights(triangulation));
  });
}
PeriodicNaturalNeighborCoordinates::PeriodicNaturalNeighborCoordinates(
    PeriodicNaturalNeighborCoordinates&&) noexcept = default;
PeriodicNaturalNeighborCoordinates& PeriodicNaturalNeighborCoordinates::operator=(
    PeriodicNaturalNeighborCoordinates&&) noexcept = default;
PeriodicNaturalNeighborCoordinates::~PeriodicNaturalNeighborCoordinates() = default;

PeriodicNaturalNeighbors PeriodicNaturalNeighborCoordinates::find(std::span<const double> queries,
                                                                  const Execution& how) const {
  const QueryParts& parts = impl_->parts;
  return internal::guarded("the natural neighbors", [&] {
    const internal::ProgressMeter meter(how.progress);
    const WrappedQueries wrapped = parts.wrap(queries, how.threads);
    struct Named {
      SignedIndex row;
      std::vector<std::int32_t> offset;
      double weight;
    };
    std::vector<std::vector<Named>> lists(queries.size() / parts.dimension);
    const auto make_visit = [&] {
      return [&](std::size_t query, const Search& search) {
        for (const Search::Neighbor& one : search.found) {
          std::vector<std::int32_t> offset(parts.rank);
          parts.given_offset(one.vertex, one.by, wrapped.wraps.data() + query * parts.rank, offset.data());
          lists[query].push_back(
              {static_cast<SignedIndex>(parts.row_of(one.vertex)), std::move(offset), one.weight});
        }
        std::ranges::sort(lists[query], [](const Named& a, const Named& b) {
          return a.row != b.row ? a.row < b.row : a.offset < b.offset;
        });
      };
    };
    each_natural(parts, impl_->centers, wrapped, false, make_visit, how.threads);
    PeriodicNaturalNeighbors result;
    for (const auto& list : lists) {
      for (const Named& one : list) {
        result.rows.push_back(one.row);
        result.offsets.insert(result.offsets.end(), one.offset.begin(), one.offset.end());
        result.weights.push_back(one.weight);
      }
      result.starts.push_back(static_cast<std::int64_t>(result.rows.size()));
    }
    return result;
  });
}

PeriodicNaturalNeighborInterpolator::PeriodicNaturalNeighborInterpolator(
    const PeriodicTriangulation& triangulation, std::span<const double> values, std::size_t columns,
    const Execution& how)
    : triangulation_(triangulation), coordinates_(triangulation, how), columns_(columns) {
  periodic::require_values(triangulation, values.size(), columns);
  internal::guarded("the values", [&] { values_.assign(values.begin(), values.end()); });
}

void PeriodicNaturalNeighborInterpolator::evaluate(std::span<const double> queries, std::span<double> result,
                                                   const EvaluateOptions& options,
                                                   const Execution& how) const {
  const auto& impl = *coordinates_.impl_;
  const QueryParts& parts = impl.parts;
  PeriodicBatch batch(impl.locator, queries, result, columns_, columns_, options);
  const auto make_visit = [&] {
    return [&, meter = batch.meter()](std::size_t query, const Search& search) mutable {
      meter();
      if (search.found.empty()) return batch.value_outside(query);
      const std::span<double> at = batch.at(query);
      std::ranges::fill(at, 0.0);
      for (const Search::Neighbor& one : search.found)
        for (std::size_t c = 0; c < columns_; ++c)
          at[c] += one.weight * values_[parts.row_of(one.vertex) * columns_ + c];
    };
  };
  batch.run(how, [&] {
    each_natural(parts, impl.centers, batch.wrapped(), false, make_visit, how.threads);
    batch.take_nearest(values_, how.threads);
  });
}

void PeriodicNaturalNeighborInterpolator::gradients(std::span<const double> queries, std::span<double> result,
                                                    const EvaluateOptions& options,
                                                    const Execution& how) const {
  const auto& impl = *coordinates_.impl_;
  const QueryParts& parts = impl.parts;
  const std::size_t d = parts.dimension;
  PeriodicBatch batch(impl.locator, queries, result, columns_ * d, options.fill.size(), options);
  std::vector<double> by_vertex;
  const auto make_visit = [&] {
    return [&, meter = batch.meter()](std::size_t query, const Search& search) mutable {
      meter();
      if (search.found.empty()) return batch.gradient_outside(query);
      const std::span<double> at = batch.at(query);
      std::ranges::fill(at, 0.0);
      if (search.is_at_vertex)  // in the box, where a point has all of its neighbors
        queries::estimate_gradients(impl.centers,
                                    parts.ghosts.vertex_of_row(parts.row_of(search.found.front().vertex)),
                                    by_vertex, columns_, at.data());
      else
        for (const Search::Neighbor& one : search.found)
          for (std::size_t c = 0; c < columns_; ++c)
            for (std::size_t j = 0; j < d; ++j)
              at[c * d + j] += one.gradient[j] * values_[parts.row_of(one.vertex) * columns_ + c];
      // From per unit of the set to per unit of the caller.
      for (double& one : at) one = parts.set.inner(one);
    };
  };
  batch.run(how, [&] {
    by_vertex.resize(parts.ghosts.num_ids() * columns_);
    for (const VertexId v : parts.complex.finite_vertices())
      std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(parts.row_of(v) * columns_), columns_,
                  by_vertex.begin() + static_cast<std::ptrdiff_t>(index(v) * columns_));
    each_natural(parts, impl.centers, batch.wrapped(), true, make_visit, how.threads);
  });
}

}  // namespace delone
