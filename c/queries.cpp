// SPDX-License-Identifier: BSD-3-Clause
// Points, located in and near what was made; interpolation; predicates.
#include "envelope.hpp"
#include "hull.hpp"
#include "options.hpp"
#include "triangulation.hpp"

#include <delone/interpolation.hpp>
#include <delone/natural_neighbors.hpp>
#include <delone/predicates.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace delone::c {
namespace {

static_assert(static_cast<int>(Location::Kind::in_cell) == DELONE_INSIDE);
static_assert(static_cast<int>(Location::Kind::on_face) == DELONE_ON_FACE);
static_assert(static_cast<int>(Location::Kind::on_vertex) == DELONE_ON_VERTEX);
static_assert(static_cast<int>(Location::Kind::outside_hull) == DELONE_OUTSIDE_HULL);
static_assert(static_cast<int>(Location::Kind::outside_affine_hull) == DELONE_OUTSIDE_AFFINE_HULL);

/// Where the answers go; those that are NULL are not wanted.
struct Answers {
  std::int64_t* cells;
  std::uint8_t* kinds;
  double *barycentric, *distances;
};

void put(const std::vector<Location::Kind>& kinds, const std::vector<SignedIndex>& cells, const Answers& to) {
  std::ranges::copy(cells, to.cells);
  std::ranges::transform(kinds, to.kinds,
                         [](Location::Kind kind) { return static_cast<std::uint8_t>(kind); });
}

void locate(const MadeTriangulation& in, std::span<const double> queries, const delone_options* options,
            const Answers& to) {
  const std::size_t count = queries.size() / static_cast<std::size_t>(in.dimension()),
                    width = static_cast<std::size_t>(in.triangulation().affine_dimension() + 1);
  std::vector<Location::Kind> kinds(to.kinds == nullptr ? 0 : count);
  std::vector<SignedIndex> cells(to.cells == nullptr ? 0 : count);
  LocatedArrays arrays{.kinds = kinds, .cells = cells};
  if (to.barycentric != nullptr) arrays.barycentric = {to.barycentric, count * width};
  if (to.distances != nullptr) arrays.distances = {to.distances, count};
  in.locator().locate(queries, locate_options(options), in.numbers(), arrays);
  put(kinds, cells, to);
}

void locate(const GivenTriangulation& in, std::span<const double> queries, const delone_options* options,
            const Answers& to) {
  const LocateOptions how = locate_options(options);
  if (how.tolerance != 0 || how.project)
    throw Error(Errc::unsupported,
                "cells that were given are located without a tolerance and without projection");
  const std::size_t count = queries.size() / static_cast<std::size_t>(in.dimension()),
                    width = static_cast<std::size_t>(in.dimension() + 1);
  std::vector<Location::Kind> kinds(to.kinds == nullptr ? 0 : count);
  std::vector<SignedIndex> cells(to.cells == nullptr ? 0 : count);
  LocatedArrays arrays{.kinds = kinds, .cells = cells};
  if (to.barycentric != nullptr) arrays.barycentric = {to.barycentric, count * width};
  if (to.distances != nullptr) arrays.distances = {to.distances, count};
  in.search().locate(queries, arrays, execution(options));
  put(kinds, cells, to);
}

std::uint8_t kind_of(const Containment& where) {
  switch (where.kind) {
    case Containment::Kind::inside:
      return DELONE_INSIDE;
    case Containment::Kind::on_boundary:
      return where.face.size() == 1 ? DELONE_ON_VERTEX : DELONE_ON_FACE;
    case Containment::Kind::outside:
      return DELONE_OUTSIDE_HULL;
    case Containment::Kind::outside_affine_hull:
      break;
  }
  return DELONE_OUTSIDE_AFFINE_HULL;
}

void require_none(const void* answer, const char* what) {
  if (answer != nullptr)
    throw Error(Errc::invalid_argument, std::string(what) + " must be NULL for an object of this kind");
}

/// Lists of what was found near queries.
std::unique_ptr<Results> lists_of(const char* name, const std::vector<std::vector<std::int64_t>>& found) {
  auto [offsets, items] = joined(found);
  auto results = std::make_unique<Results>("lists");
  results->add("offsets", std::move(offsets));
  results->add(name, std::move(items));
  return results;
}

/// An interpolator keeps its triangulation, and notices its changes.
class Interpolator final : public delone_object {
 public:
  using Any = std::variant<LinearInterpolator, NaturalNeighborInterpolator>;

  template <class Make>
  Interpolator(const MadeTriangulation& of, Make make)
      : product_(of.product()), changes_(product_->changes), any_(make(product_->common())) {}

  const char* kind() const override { return "interpolator"; }
  const Members& members() const override {
    static const Members all = {
        member<Interpolator>("dimension", [](const Interpolator& o) { return o.dimension(); }),
        member<Interpolator>("columns", [](const Interpolator& o) { return o.columns(); }),
    };
    return all;
  }

  int dimension() const { return product_->common().dimension(); }
  std::size_t columns() const {
    return std::visit([](const auto& one) { return one.columns(); }, any_);
  }
  const Any& any() const {
    if (product_->changes != changes_)
      throw Error(Errc::invalid_argument, "the triangulation of the interpolator has changed");
    return any_;
  }

 private:
  std::shared_ptr<Product> product_;
  std::uint64_t changes_;
  Any any_;
};

}  // namespace
}  // namespace delone::c

using namespace delone;
using namespace delone::c;

int delone_locate(const delone_object* object, const double* queries, std::size_t num_queries,
                  const delone_options* options, std::int64_t* cells, std::uint8_t* kinds,
                  double* barycentric, double* distances) {
  return run([&] {
    if (const auto* const made = dynamic_cast<const MadeTriangulation*>(&required(object, "the object"))) {
      const PointsView points = view_of(queries, num_queries, made->triangulation().dimension(), "queries");
      return locate(*made, points.coordinates(), options, {cells, kinds, barycentric, distances});
    }
    if (const auto* const cells_of = dynamic_cast<const GivenTriangulation*>(object)) {
      const PointsView points = view_of(queries, num_queries, cells_of->dimension(), "queries");
      return locate(*cells_of, points.coordinates(), options, {cells, kinds, barycentric, distances});
    }
    require_none(barycentric, "barycentric");
    require_none(distances, "distances");
    if (const auto* const made = dynamic_cast<const EnvelopeObject*>(object)) {
      require_none(kinds, "kinds");
      const PointsView points = view_of(queries, num_queries, made->hull().dimension() - 1, "queries");
      for (std::size_t i = 0; i < num_queries; ++i) {
        cancellation_point();
        const std::optional<std::size_t> cell = made->hull().find_cell(points[i]);
        if (cells != nullptr) cells[i] = cell ? static_cast<std::int64_t>(*cell) : -1;
      }
      return;
    }
    const ConvexHull<>& hull =
        as<const MadeHull>(object, "a triangulation, or a convex, lower or upper hull that was made").hull();
    const PointsView points = view_of(queries, num_queries, hull.dimension(), "queries");
    for (std::size_t i = 0; i < num_queries; ++i) {
      cancellation_point();
      const Containment where = hull.locate(points[i]);
      if (cells != nullptr) cells[i] = where.cell;
      if (kinds != nullptr) kinds[i] = kind_of(where);
    }
  });
}

int delone_nearest(const delone_object* triangulation, const double* queries, std::size_t num_queries,
                   std::size_t count, const delone_options* options, std::int64_t* rows) {
  return run([&] {
    const MadeTriangulation& of = as_made(triangulation);
    const PointsView points = view_of(queries, num_queries, of.triangulation().dimension(), "queries");
    const std::span<std::int64_t> to = matrix(rows, num_queries, count, "rows");
    std::ranges::fill(to, -1);
    of.locator().nearest(
        points.coordinates(), count,
        [&](std::size_t i, std::span<const VertexId> nearest) {
          std::ranges::transform(nearest, to.subspan(i * count).begin(),
                                 [&](VertexId v) { return of.row_of(v); });
        },
        execution(options));
  });
}

int delone_cells_within(const delone_object* triangulation, const double* queries, std::size_t num_queries,
                        double radius, const delone_options* options, delone_object** lists) {
  return make(lists, [&] {
    std::vector<std::vector<std::int64_t>> found(num_queries);
    if (const auto* const given = dynamic_cast<const GivenTriangulation*>(triangulation)) {
      const PointsView points = view_of(queries, num_queries, given->dimension(), "queries");
      given->search().find(
          points.coordinates(), radius,
          [&](std::size_t i, std::span<const SignedIndex> cells) {
            found[i].assign(cells.begin(), cells.end());
          },
          execution(options));
      return lists_of("cells", found);
    }
    const MadeTriangulation& of = as_made(triangulation);
    const PointsView points = view_of(queries, num_queries, of.triangulation().dimension(), "queries");
    const CellNumbers& numbers = of.numbers();
    of.locator().cells_within(
        points.coordinates(), radius,
        [&](std::size_t i, CellId cell) {
          found[i].push_back(numbers.row(cell));
          return true;
        },
        execution(options));
    for (std::vector<std::int64_t>& one : found) std::ranges::sort(one);
    return lists_of("cells", found);
  });
}

int delone_natural_neighbors(const delone_object* triangulation, const double* queries,
                             std::size_t num_queries, const delone_options* options, delone_object** lists) {
  return make(lists, [&] {
    const MadeTriangulation& of = as_made(triangulation);
    const PointsView points = view_of(queries, num_queries, of.triangulation().dimension(), "queries");
    std::vector<std::vector<std::int64_t>> rows(num_queries);
    std::vector<std::vector<double>> weights(num_queries);
    NaturalNeighborCoordinates(of.triangulation())
        .find(points.coordinates(), locate_options(options),
              [&](std::size_t i, const NaturalNeighbors& found) {
                for (const VertexId v : found.vertices) rows[i].push_back(of.row_of(v));
                weights[i].assign(found.weights.begin(), found.weights.end());
              });
    std::unique_ptr<Results> results = lists_of("rows", rows);
    results->add("weights", joined(weights).second);
    return results;
  });
}

int delone_linear_interpolator(const delone_object* triangulation, const double* values, std::size_t columns,
                               delone_object** interpolator) {
  return make(interpolator, [&] {
    const MadeTriangulation& of = as_made(triangulation);
    const std::span<const double> given = matrix(values, of.triangulation().num_rows(), columns, "values");
    return std::make_unique<Interpolator>(
        of, [&](const Triangulation& t) { return LinearInterpolator(t, given, columns); });
  });
}

int delone_natural_neighbor_interpolator(const delone_object* triangulation, const double* values,
                                         std::size_t columns, int smooth, const double* gradients,
                                         delone_object** interpolator) {
  return make(interpolator, [&] {
    const MadeTriangulation& of = as_made(triangulation);
    const std::size_t n = of.triangulation().num_rows();
    const auto d = static_cast<std::size_t>(of.triangulation().dimension());
    const std::span<const double> given = matrix(values, n, columns, "values");
    const std::span<const double> slopes = gradients == nullptr
                                               ? std::span<const double>()
                                               : std::span<const double>(gradients, given.size() * d);
    return std::make_unique<Interpolator>(of, [&](const Triangulation& t) {
      return NaturalNeighborInterpolator(t, given, columns, smooth != 0, slopes);
    });
  });
}

int delone_interpolate(const delone_object* interpolator, const double* queries, std::size_t num_queries,
                       const delone_options* options, double* values, double* gradients) {
  return run([&] {
    const Interpolator& by = as<const Interpolator>(interpolator, "an interpolator");
    const delone_options& how = given(options);
    const PointsView points = view_of(queries, num_queries, by.dimension(), "queries");
    const std::vector<double> fill(by.columns(), how.fill);
    EvaluateOptions evaluate;
    evaluate.outside = how.outside;
    evaluate.fill = fill;
    evaluate.tolerance = how.tolerance;
    const Execution execution{.threads = how.threads};
    std::visit(
        [&](const auto& one) {
          const std::size_t size = num_queries * by.columns();
          if (values != nullptr) one.evaluate(points.coordinates(), {values, size}, evaluate, execution);
          if (gradients != nullptr)
            one.gradients(points.coordinates(), {gradients, size * static_cast<std::size_t>(by.dimension())},
                          evaluate, execution);
        },
        by.any());
  });
}

int delone_orientation(const double* points, int dimension, int* sign) {
  return run([&] {
    view_of(nullptr, 0, dimension, "points");
    const PointsView given = view_of(points, static_cast<std::size_t>(dimension) + 1, dimension, "points");
    required(sign, "the place for the sign") = static_cast<int>(orientation(given.coordinates(), dimension));
  });
}

int delone_in_sphere(const double* points, const double* query, int dimension, int* side) {
  return run([&] {
    view_of(nullptr, 0, dimension, "points");
    const PointsView given = view_of(points, static_cast<std::size_t>(dimension) + 1, dimension, "points");
    const PointsView of = view_of(query, 1, dimension, "the query");
    required(side, "the place for the side") =
        static_cast<int>(in_sphere(given.coordinates(), of.coordinates(), dimension));
  });
}
