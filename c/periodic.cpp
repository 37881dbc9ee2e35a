// SPDX-License-Identifier: BSD-3-Clause
#include "periodic.hpp"

#include "options.hpp"

#include <delone/io.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::c {
namespace {

const PeriodicObject& as_periodic(const delone_object* object) {
  return as<const PeriodicObject>(object, "a periodic triangulation");
}

}  // namespace

const Members& PeriodicObject::members() const {
  using Made = PeriodicObject;
  static const auto corners = [](const Made& o) {
    return o.triangulation().num_cells() == 0 ? 0 : o.triangulation().affine_dimension() + 1;
  };
  static const Members all = {
      member<Made>("dimension", [](const Made& o) { return o.triangulation().dimension(); }),
      member<Made>("affine_dimension", [](const Made& o) { return o.triangulation().affine_dimension(); }),
      member<Made>("rank", [](const Made& o) { return o.triangulation().rank(); }),
      member<Made>("num_points", [](const Made& o) { return o.triangulation().num_points(); }),
      member<Made>("num_vertices", [](const Made& o) { return o.triangulation().num_vertices(); }),
      member<Made>("num_duplicates", [](const Made& o) { return o.triangulation().num_duplicates(); }),
      member<Made>("num_hidden", [](const Made& o) { return o.triangulation().num_hidden(); }),
      member<Made>("num_cells", [](const Made& o) { return o.triangulation().num_cells(); }),
      member<Made>("num_ghosts", [](const Made& o) { return o.triangulation().num_ghosts(); }),
      member<Made>("is_simplicial", [](const Made& o) { return int{o.triangulation().is_simplicial()}; }),
      member<Made>("displacement", [](const Made& o) { return o.triangulation().displacement(); }),
      member<Made>("kind", [](const Made& o) { return o.kind(); }),
      member<Made>("hash", [](const Made& o) -> const std::string& { return o.hash(); }),
      member<Made>(
          "points",
          [](const Made& o) { return table(o.triangulation().points(), o.triangulation().dimension()); }),
      member<Made>("weights", [](const Made& o) { return list(o.triangulation().weights()); }),
      member<Made>("lattice",
                   [](const Made& o) {
                     return table(o.triangulation().lattice().vectors, o.triangulation().dimension());
                   }),
      member<Made>("cells", [](const Made& o) { return table(o.triangulation().cells(), corners(o)); }),
      member<Made>(
          "cell_offsets",
          [](const Made& o) { return table(o.triangulation().cell_offsets(), o.triangulation().rank()); }),
      member<Made>("neighbors",
                   [](const Made& o) { return table(o.triangulation().neighbors(), corners(o)); }),
      member<Made>("neighbor_offsets",
                   [](const Made& o) {
                     return table(o.triangulation().neighbor_offsets(), o.triangulation().rank());
                   }),
      member<Made>("vertex_of_point",
                   [](const Made& o) { return list(o.triangulation().vertex_of_point()); }),
      member<Made>(
          "point_offsets",
          [](const Made& o) { return table(o.triangulation().point_offsets(), o.triangulation().rank()); }),
  };
  return all;
}

CheckReport PeriodicObject::check(const CheckOptions& options, const Execution& how) const {
  return delone::check(made_->to_data(), options, how);
}

void PeriodicObject::write(const std::string& path, const std::string& format) const {
  delone::write(path, made_->to_data(), format);
}

}  // namespace delone::c

using namespace delone;
using namespace delone::c;

int delone_periodic_delaunay(const double* points, std::size_t num_points, int dimension,
                             const double* lattice, std::size_t num_vectors, const delone_options* options,
                             delone_object** object) {
  return make(object, [&] {
    const Options how = without_tolerance(options);
    return std::make_unique<PeriodicObject>(
        std::make_shared<const PeriodicDelaunay<>>(view_of(points, num_points, dimension, "points"),
                                                   lattice_of(lattice, num_vectors, dimension),
                                                   given(options).periodic, how),
        how.threads);
  });
}

int delone_periodic_regular(const double* points, const double* weights, std::size_t num_points,
                            int dimension, const double* lattice, std::size_t num_vectors,
                            const delone_options* options, delone_object** object) {
  return make(object, [&] {
    const Options how = without_tolerance(options);
    return std::make_unique<PeriodicObject>(
        std::make_shared<const PeriodicRegular<>>(
            view_of(points, num_points, dimension, "points"), matrix(weights, num_points, 1, "weights"),
            lattice_of(lattice, num_vectors, dimension), given(options).periodic, how),
        how.threads);
  });
}

int delone_periodic_moved(const delone_object* before, const double* points, std::size_t num_points,
                          const double* weights, const double* lattice, delone_object** object) {
  return make(object, [&] {
    const PeriodicObject& from = as_periodic(before);
    const PeriodicTriangulation& t = from.triangulation();
    const PointsView to = view_of(points, num_points, t.dimension(), "points");
    const Lattice box = lattice == nullptr
                            ? Lattice()
                            : lattice_of(lattice, static_cast<std::size_t>(t.rank()), t.dimension());
    if (!t.is_regular()) {
      if (weights != nullptr)
        throw Error(Errc::invalid_argument, "points of this triangulation have no weights");
      const auto& delaunay = static_cast<const PeriodicDelaunay<>&>(t);
      return std::make_unique<PeriodicObject>(
          std::make_shared<const PeriodicDelaunay<>>(lattice == nullptr ? delaunay.moved(to)
                                                                        : delaunay.moved(to, box)),
          from.threads());
    }
    const auto& regular = static_cast<const PeriodicRegular<>&>(t);
    const std::span<const double> of_rows =
        weights == nullptr ? t.weights() : matrix(weights, num_points, 1, "weights");
    return std::make_unique<PeriodicObject>(
        std::make_shared<const PeriodicRegular<>>(lattice == nullptr ? regular.moved(to, of_rows)
                                                                     : regular.moved(to, of_rows, box)),
        from.threads());
  });
}

int delone_periodic_locate(const delone_object* triangulation, const double* queries, std::size_t num_queries,
                           const delone_options* options, std::int64_t* cells, std::int32_t* offsets,
                           std::uint8_t* kinds, double* barycentric) {
  return run([&] {
    const PeriodicObject& in = as_periodic(triangulation);
    const PeriodicTriangulation& t = in.triangulation();
    const PointsView points = view_of(queries, num_queries, t.dimension(), "queries");
    std::vector<Location::Kind> found_kinds(kinds == nullptr ? 0 : num_queries);
    std::vector<SignedIndex> found_cells(cells == nullptr ? 0 : num_queries);
    PeriodicLocatedArrays to{.kinds = found_kinds, .cells = found_cells};
    if (offsets != nullptr) to.offsets = {offsets, num_queries * static_cast<std::size_t>(t.rank())};
    if (barycentric != nullptr)
      to.barycentric = {barycentric, num_queries * static_cast<std::size_t>(t.affine_dimension() + 1)};
    in.locator().locate(points.coordinates(), to, execution(options));
    std::ranges::copy(found_cells, cells);
    std::ranges::transform(found_kinds, kinds,
                           [](Location::Kind kind) { return static_cast<std::uint8_t>(kind); });
  });
}

int delone_periodic_nearest(const delone_object* triangulation, const double* queries,
                            std::size_t num_queries, const delone_options* options, std::int64_t* rows,
                            std::int32_t* offsets, double* distances) {
  return run([&] {
    const PeriodicObject& in = as_periodic(triangulation);
    const PeriodicTriangulation& t = in.triangulation();
    const PointsView points = view_of(queries, num_queries, t.dimension(), "queries");
    std::vector<SignedIndex> found_rows(rows == nullptr ? 0 : num_queries);
    PeriodicNearestArrays to{.rows = found_rows};
    if (offsets != nullptr) to.offsets = {offsets, num_queries * static_cast<std::size_t>(t.rank())};
    if (distances != nullptr) to.distances = {distances, num_queries};
    in.locator().nearest(points.coordinates(), to, execution(options));
    std::ranges::copy(found_rows, rows);
  });
}
