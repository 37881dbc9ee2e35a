// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation.hpp"

#include "options.hpp"

#include <delone/io.hpp>
#include <delone/measures.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <utility>

namespace delone::c {
namespace {

using Object = TriangulationObject;

int width(const ComplexData& data) { return data.affine_dimension + 1; }

}  // namespace

void TriangulationObject::write(const std::string& path, const std::string& format) const {
  delone::write(path, data(), format);
}

Members TriangulationObject::members_of_data() {
  return {
      member<Object>("dimension", [](const Object& o) { return o.dimension(); }),
      member<Object>("affine_dimension", [](const Object& o) { return o.affine_dimension(); }),
      member<Object>("num_points", [](const Object& o) { return o.num_points(); }),
      member<Object>("num_cells", [](const Object& o) { return o.num_cells(); }),
      member<Object>("points", [](const Object& o) { return table(o.data().points, o.data().dimension); }),
      member<Object>("weights", [](const Object& o) { return list(o.data().weights); }),
      member<Object>("cells", [](const Object& o) { return table(o.data().cells, width(o.data())); }),
      member<Object>("neighbors", [](const Object& o) { return table(o.data().neighbors, width(o.data())); }),
      member<Object>("vertex_of_point", [](const Object& o) { return list(o.data().vertex_of_point); }),
      member<Object>("kind", [](const Object& o) { return name_of(o.data_kind()).data(); }),
      member<Object>("hash", [](const Object& o) -> const std::string& { return o.hash(); }),
  };
}

GivenTriangulation::GivenTriangulation(ComplexData data, Members more)
    : data_(std::move(data)), members_(members_of_data() + std::move(more)) {}

const std::string& GivenTriangulation::hash() const {
  return hash_.get([&] { return canonical_hash(data_).hex(); });
}

const CellSearch& GivenTriangulation::search() const {
  if (data_.affine_dimension != data_.dimension)
    throw Error(Errc::unsupported, "cells of dimension " + std::to_string(data_.affine_dimension) +
                                       " are not searched in a space of dimension " +
                                       std::to_string(data_.dimension));
  return search_.get([&] { return CellSearch({data_.points, data_.dimension}, data_.cells); });
}

MadeTriangulation::MadeTriangulation(AnyTriangulation any, unsigned threads)
    : product_(std::make_shared<Product>(std::move(any))), threads_(threads) {}

DataKind MadeTriangulation::data_kind() const {
  constexpr std::array kinds{DataKind::delaunay, DataKind::regular, DataKind::furthest_site};
  return kinds[product_->any.index()];
}

const char* MadeTriangulation::kind() const {
  constexpr std::array<const char*, 3> kinds{"delaunay", "regular", "furthest_site"};
  return kinds[product_->any.index()];
}

const Members& MadeTriangulation::members() const {
  using Made = MadeTriangulation;
  static const Members all =
      members_of_data() +
      Members{
          member<Made>("num_rows", [](const Made& o) { return o.product_->common().num_rows(); }),
          member<Made>("num_vertices", [](const Made& o) { return o.product_->common().num_vertices(); }),
          member<Made>("num_duplicates", [](const Made& o) { return o.product_->common().num_duplicates(); }),
          member<Made>("num_hidden", [](const Made& o) { return o.product_->common().num_hidden(); }),
          member<Made>("num_infinite_cells",
                       [](const Made& o) { return o.product_->common().num_infinite_cells(); }),
          member<Made>("edges",
                       [](const Made& o) {
                         return table(
                             o.edges_.get([&] { return o.rows_of(o.triangulation().complex().edges()); }), 2);
                       }),
          member<Made>("hull_facets",
                       [](const Made& o) {
                         const auto make = [&] {
                           const Complex complex = o.triangulation().complex();
                           std::vector<VertexId> vertices;
                           for (const Facet& facet : complex.hull_facets())
                             for (int i = 0; i <= complex.affine_dimension(); ++i)
                               if (i != facet.opposite) vertices.push_back(complex.vertex(facet.cell, i));
                           return o.rows_of(vertices);
                         };
                         return table(o.hull_facets_.get(make), o.triangulation().affine_dimension());
                       }),
          member<Made>(
              "axes",
              [](const Made& o) { return list(o.axes_.get([&] { return o.product_->common().axes(); })); }),
          member<Made>("circumcenters",
                       [](const Made& o) {
                         const auto make = [&] {
                           return circumcenters(o.triangulation(), {.threads = o.threads_});
                         };
                         return table(o.circumcenters_.get(make), o.dimension());
                       }),
          member<Made>("circumradii",
                       [](const Made& o) {
                         const auto make = [&] {
                           return circumradii(o.triangulation(), {.threads = o.threads_});
                         };
                         return list(o.circumradii_.get(make));
                       }),
      };
  return all;
}

std::vector<SignedIndex> MadeTriangulation::rows_of(const std::vector<VertexId>& vertices) const {
  std::vector<SignedIndex> rows(vertices.size());
  std::ranges::transform(vertices, rows.begin(), [&](VertexId v) { return row_of(v); });
  return rows;
}

const MadeTriangulation::Ready& MadeTriangulation::ready() const {
  return ready_.get([&] {
    std::visit([](auto& one) { one.sort_cells(); }, product_->any);
    const Triangulation& triangulation = product_->common();
    return Ready{triangulation.to_data(), CellNumbers(triangulation.complex())};
  });
}

const PointLocator& MadeTriangulation::locator() const {
  const Triangulation& sorted = triangulation();
  return locator_.get([&] { return PointLocator(sorted); });
}

const std::string& MadeTriangulation::hash() const {
  return hash_.get([&] { return product_->common().hash({.threads = threads_}).hex(); });
}

std::unique_ptr<delone_object> MadeTriangulation::clone() const {
  return std::visit(
      [&](const auto& one) { return std::make_unique<MadeTriangulation>(one.clone(), threads_); },
      product()->any);
}

void MadeTriangulation::forget() {
  ready_.reset();
  locator_.reset();
  hash_.reset();
  edges_.reset();
  hull_facets_.reset();
  axes_.reset();
  circumcenters_.reset();
  circumradii_.reset();
  ++product_->changes;
}

void MadeTriangulation::insert(const double* rows, std::size_t num_rows, const double* weights) {
  const PointsView points = view_of(rows, num_rows, product_->common().dimension(), "rows");
  const bool is_weighted = std::holds_alternative<Regular<>>(product_->any);
  if (!is_weighted && weights != nullptr)
    throw Error(Errc::invalid_argument, "only points of a regular triangulation have weights");
  const std::span<const double> of_rows =
      is_weighted ? matrix(weights, num_rows, 1, "weights") : std::span<const double>();
  // Whatever happens, ids may have changed. The rows may be an array of this object.
  const AtEnd changed([&] { forget(); });
  std::visit(
      [&](auto& one) {
        if constexpr (std::same_as<std::remove_cvref_t<decltype(one)>, Regular<>>) {
          if (num_rows == 1)
            one.insert(points.coordinates(), of_rows[0]);
          else
            one.insert_range(points, of_rows);
        } else {
          if (num_rows == 1)
            one.insert(points.coordinates());
          else
            one.insert_range(points);
        }
      },
      product_->any);
}

void MadeTriangulation::remove(std::span<const std::size_t> rows) {
  const AtEnd changed([&] { forget(); });
  std::visit([&](auto& one) { one.remove(rows); }, product_->any);
}

void MadeTriangulation::change(std::span<const std::size_t> rows, const double* to, const double* weights) {
  const int d = product_->common().dimension();
  const std::span<const double> points =
      to == nullptr ? std::span<const double>() : view_of(to, rows.size(), d, "to").coordinates();
  const std::span<const double> of_rows =
      weights == nullptr ? std::span<const double>() : matrix(weights, rows.size(), 1, "weights");
  const AtEnd changed([&] { forget(); });
  std::visit(
      [&](auto& one) {
        Edit<> edit;
        if (to != nullptr) edit.move = rows;
        edit.to = PointsView(points, d);
        if (weights != nullptr) edit.reweight = rows;
        edit.weights = of_rows;
        one.edit(edit);
      },
      product_->any);
}

}  // namespace delone::c

using namespace delone;
using namespace delone::c;

namespace {

/// A triangulation of one class without weights.
template <class T>
int triangulate(const double* points, std::size_t num_points, int dimension, const delone_options* options,
                delone_object** object) {
  return make(object, [&] {
    const Options how = without_tolerance(options);
    return std::make_unique<MadeTriangulation>(
        T(view_of(points, num_points, dimension, "points"), dimension, how), how.threads);
  });
}

}  // namespace

int delone_delaunay(const double* points, std::size_t num_points, int dimension,
                    const delone_options* options, delone_object** object) {
  return triangulate<Delaunay<>>(points, num_points, dimension, options, object);
}

int delone_furthest_site(const double* points, std::size_t num_points, int dimension,
                         const delone_options* options, delone_object** object) {
  return triangulate<FurthestSite<>>(points, num_points, dimension, options, object);
}

int delone_regular(const double* points, const double* weights, std::size_t num_points, int dimension,
                   const delone_options* options, delone_object** object) {
  return make(object, [&] {
    const Options how = without_tolerance(options);
    return std::make_unique<MadeTriangulation>(
        Regular<>(view_of(points, num_points, dimension, "points"), matrix(weights, num_points, 1, "weights"),
                  dimension, how),
        how.threads);
  });
}

int delone_triangulation_of_cells(const double* points, const double* weights, std::size_t num_points,
                                  int dimension, const std::int64_t* cells, std::size_t num_cells,
                                  int affine_dimension, delone_object** object) {
  return make(object, [&] {
    ComplexData data;
    data.dimension = dimension;
    data.affine_dimension = affine_dimension;
    const PointsView view = view_of(points, num_points, dimension, "points");
    if (affine_dimension < -1 || affine_dimension > dimension)
      throw Error(Errc::bad_dimension, "the affine dimension is " + std::to_string(affine_dimension) +
                                           ", and must be -1 to " + std::to_string(dimension));
    data.points.assign(view.coordinates().begin(), view.coordinates().end());
    if (weights != nullptr) data.weights.assign(weights, weights + num_points);
    for (const std::int64_t row :
         matrix(cells, num_cells, static_cast<std::size_t>(affine_dimension + 1), "cells")) {
      if (row < 0 || static_cast<std::uint64_t>(row) >= num_points)
        throw Error(Errc::invalid_argument, "cells: there is no row " + std::to_string(row));
      data.cells.push_back(static_cast<SignedIndex>(row));
    }
    return std::make_unique<GivenTriangulation>(std::move(data));
  });
}
