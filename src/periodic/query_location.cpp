// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/query_location.hpp"

#include "base/require_finite.hpp"
#include "queries/barycentric.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <memory>
#include <string>

namespace delone::periodic {

QueryParts::QueryParts(const PeriodicTriangulation& t)
    : triangulation(t),
      set(StoredSet::set(t)),
      ghosts(StoredSet::ghosts(t)),
      classes(StoredSet::classes(t)),
      complex(ghosts.triangulation().complex()),
      where(ghosts.triangulation()),
      dimension(set.dimension),
      rank(set.rank),
      corners(static_cast<std::size_t>(complex.affine_dimension() + 1)) {}

WrappedQueries QueryParts::wrap(std::span<const double> queries, unsigned threads) const {
  if (queries.size() % dimension != 0)
    throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  internal::require_finite(queries, dimension, "a coordinate", "query");
  const std::size_t count = queries.size() / dimension;
  WrappedQueries wrapped{std::vector<double>(queries.size()), std::vector<std::int32_t>(count * rank)};
  internal::work_in_parts(threads, count, 2048, [&] {
    return [&](std::size_t begin, std::size_t end, const internal::StopPoint& stop) {
      for (std::size_t query = begin; query < end; ++query) {
        stop();
        double* const x = wrapped.points.data() + query * dimension;
        for (std::size_t j = 0; j < dimension; ++j) x[j] = set.snapped_query(queries[query * dimension + j]);
        if (!set.period.wrap(set.query_grid, x, wrapped.wraps.data() + query * rank) ||
            !std::all_of(x, x + dimension, [](double one) { return std::isfinite(one); }))
          throw Error(Errc::invalid_argument,
                      "query " + std::to_string(query) + " is more than 2^29 periods away", {query});
        for (std::size_t j = 0; j < dimension; ++j) x[j] += 0.0;
      }
    };
  });
  return wrapped;
}

void QueryParts::given_offset(VertexId v, std::span<const std::int64_t> by, const std::int32_t* wraps,
                              std::int32_t* given) const {
  std::vector<std::int64_t> sum(rank);
  const auto of_image = ghosts.offset_of(v);
  for (std::size_t i = 0; i < rank; ++i) sum[i] = by[i] + of_image[i] + wraps[i] - wrap_of(row_of(v), i);
  set.to_given_basis(sum, given);
}

void QueryParts::given_offset_of_cell(SignedIndex cell, std::span<const std::int64_t> by,
                                      const std::int32_t* wraps, std::int32_t* given) const {
  std::vector<std::int64_t> sum(rank);
  const std::size_t row = classes.row_of_smallest(static_cast<std::size_t>(cell));
  for (std::size_t i = 0; i < rank; ++i) sum[i] = by[i] + wraps[i] - wrap_of(row, i);
  set.to_given_basis(sum, given);
}

void QueryParts::subtract(std::span<const std::int64_t> k, std::span<double> x) const {
  for (std::size_t i = 0; i < rank; ++i) {
    if (k[i] == 0) continue;
    for (std::size_t j = 0; j < dimension; ++j) x[j] -= static_cast<double>(k[i]) * set.period.vector(i)[j];
  }
}

PlaceFinder::PlaceFinder(const QueryParts& parts, bool with_coordinates)
    : parts_(parts),
      with_coordinates_(with_coordinates),
      shift_(parts.rank),
      offset_(parts.rank),
      none_(parts.rank),
      ordered_(parts.corners),
      given_(parts.rank),
      least_(parts.rank) {}

Place PlaceFinder::find(const double* q, const LocatedPoint& located) {
  if (located.kind == Location::Kind::outside_affine_hull) return {};
  const Place outside{Location::Kind::outside_hull, -1, none_, {}};
  kind_ = located.kind;
  cell_ = located.cell;
  if (parts_.classes.has_own(cell_)) {
    if (parts_.complex.is_infinite(cell_)) return outside;
    if (kind_ == Location::Kind::in_cell)
      if (const SignedIndex number = parts_.classes.canonical().number_of_slot[index(cell_)]; number >= 0) {
        for (std::size_t i = 0; i < located.barycentric.size(); ++i)
          ordered_[i] = located.barycentric[static_cast<std::size_t>(
              parts_.classes.slot(static_cast<std::size_t>(number), i))];
        return {kind_, number, none_, std::span(ordered_).first(located.barycentric.size())};
      }
    std::fill(shift_.begin(), shift_.end(), 0);
    weights_.assign(located.barycentric.begin(), located.barycentric.end());
  } else if (!find_translate(q, cell_) || parts_.complex.is_infinite(cell_)) {
    return outside;
  }
  if (kind_ == Location::Kind::in_cell) {
    const Translate of_class = parts_.classes.find_class(cell_);
    number_ = of_class.number;
    for (std::size_t i = 0; i < parts_.rank; ++i) offset_[i] = shift_[i] + of_class.offset[i];
  } else {
    choose_first(cell_);
  }
  order_coordinates(cell_);
  return {kind_, number_, offset_, ordered_};
}

/// Whether a translate of q is in a cell with a vertex in the box, or beyond a facet with one.
bool PlaceFinder::find_translate(const double* q, CellId cell) {
  for (const VertexId v : parts_.complex.vertices(cell)) {
    if (v == infinite_vertex) continue;
    const VertexId own = parts_.classes.own_vertex(v);
    if (own != invalid_vertex && is_at(q, parts_.classes.offset_of(v), parts_.complex.incident_cell(own)))
      return true;
  }
  Offset k(parts_.rank);
  for (std::size_t i = 0; i < parts_.rank; ++i) k[i] = -parts_.set.period.reach(i);
  for (;;) {
    internal::cancellation_point();
    if (is_at(q, k, cell)) return true;
    std::size_t i = 0;
    for (; i < parts_.rank; ++i) {
      if (k[i]++ < parts_.set.period.reach(i)) break;
      k[i] = -parts_.set.period.reach(i);
    }
    if (i == parts_.rank) return false;
  }
}

bool PlaceFinder::is_at(const double* q, std::span<const std::int64_t> k, CellId hint) {
  x_.assign(q, q + parts_.dimension);
  parts_.subtract(k, x_);
  const Location location = parts_.ghosts.triangulation().locate(x_, hint);
  if (location.cell == invalid_cell || !parts_.classes.has_own(location.cell)) return false;
  kind_ = location.kind;
  cell_ = location.cell;
  shift_.assign(k.begin(), k.end());
  if (location.face.empty()) return true;
  std::vector<const double*> points;
  std::vector<unsigned char> on_face;
  for (const VertexId v : parts_.complex.vertices(cell_)) {
    points.push_back(parts_.point(v));
    on_face.push_back(std::ranges::find(location.face, v) != location.face.end() ? 1 : 0);
  }
  if (with_coordinates_)
    queries::barycentric(points, on_face, parts_.where.axes, x_.data(), weights_);
  else
    weights_.assign(on_face.begin(), on_face.end());
  return true;
}

/// Of all cells with the face of the query, the one of the least number and offset.
void PlaceFinder::choose_first(CellId cell) {
  std::vector<VertexId> face;
  for (std::size_t i = 0; i < parts_.corners; ++i)
    if (weights_[i] > 0) face.push_back(parts_.complex.vertex(cell, static_cast<int>(i)));
  const Offset moved = parts_.classes.offset_of(face.front());
  number_ = -1;
  Offset sum(parts_.rank);
  for (const CellId other : parts_.complex.star(parts_.classes.own_vertex(face.front()))) {
    if (parts_.complex.is_infinite(other) ||
        !std::ranges::all_of(face, [&](VertexId v) { return parts_.classes.has_moved(other, v, moved); }))
      continue;
    const Translate of_class = parts_.classes.find_class(other);
    if (number_ >= 0 && of_class.number > number_) continue;
    for (std::size_t i = 0; i < parts_.rank; ++i) sum[i] = shift_[i] + moved[i] + of_class.offset[i];
    parts_.set.to_given_basis(sum, given_.data());
    if (of_class.number == number_ && !(given_ < least_)) continue;
    number_ = of_class.number;
    offset_ = sum;
    least_ = given_;
  }
}

/// The coordinates of the vertices of `cell` as those of the canonical cell that was chosen.
void PlaceFinder::order_coordinates(CellId cell) {
  std::fill(ordered_.begin(), ordered_.end(), 0.0);
  Offset between(parts_.rank);
  for (std::size_t i = 0; i < parts_.rank; ++i) between[i] = offset_[i] - shift_[i];
  for (std::size_t i = 0; i < parts_.corners; ++i) {
    const VertexId w = parts_.classes.vertex(number_, i);
    for (std::size_t l = 0; l < parts_.corners; ++l)
      if (weights_[l] > 0 &&
          parts_.classes.is_moved(w, parts_.complex.vertex(cell, static_cast<int>(l)), between))
        ordered_[i] = weights_[l];
  }
}

void find_places(const QueryParts& parts, const WrappedQueries& queries, bool with_coordinates,
                 const std::function<PlaceVisit()>& make_visit, unsigned threads) {
  struct Finding {
    PlaceFinder finder;
    PlaceVisit visit;
  };
  const auto make = [&]() -> PointLocator::Visit {
    const auto own = std::shared_ptr<Finding>(new Finding{{parts, with_coordinates}, make_visit()});
    return [&, own](std::size_t query, const LocatedPoint& located) {
      own->visit(query, own->finder.find(queries.points.data() + query * parts.dimension, located));
    };
  };
  parts.where.locate(queries.points, {.coordinates = with_coordinates}, {.threads = threads}, {.make = make});
}

}  // namespace delone::periodic
