// SPDX-License-Identifier: BSD-3-Clause
// delone.NaturalNeighborInterpolator, for real and complex values of any shape, and delone.natural_neighbors.
#include "docs_interpolation.hpp"
#include "docstring.hpp"
#include "held_function.hpp"
#include "module.hpp"
#include "pickling.hpp"

#include <delone/natural_neighbors.hpp>

#include <algorithm>
#include <complex>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace delone::python {
namespace {

using namespace py::literals;

/// (indptr, rows, weights) from a search in a triangulation.
class NeighborLists {
 public:
  explicit NeighborLists(std::size_t count) : of_query_(count) {}
  void find(const NaturalNeighborCoordinates& coordinates, const Triangulation& engine,
            std::span<const double> queries, const LocateOptions& options, unsigned threads) {
    const auto put = [&](std::size_t query, const NaturalNeighbors& found) {
      cancellation_point();
      for (std::size_t i = 0; i < found.vertices.size(); ++i)
        of_query_[query].emplace_back(static_cast<SignedIndex>(engine.row_of(found.vertices[i])),
                                      found.weights[i]);
      std::sort(of_query_[query].begin(), of_query_[query].end());
    };
    coordinates.find(queries, options, put, false, {.threads = threads});
  }
  py::tuple arrays() const {
    std::vector<std::int64_t> offsets{0};
    std::vector<SignedIndex> rows;
    std::vector<double> weights;
    for (const auto& list : of_query_) {
      for (const auto& [row, weight] : list) {
        rows.push_back(row);
        weights.push_back(weight);
      }
      offsets.push_back(static_cast<std::int64_t>(rows.size()));
    }
    return py::make_tuple(list_view(std::move(offsets)), list_view(std::move(rows)),
                          list_view(std::move(weights)));
  }

 private:
  std::vector<std::vector<std::pair<SignedIndex, double>>> of_query_;
};

py::tuple natural_neighbors(const py::object& points, const py::object& object) {
  const py::object source = triangulation_of(points);
  const auto& held = source.cast<const HeldTriangulation&>();
  const Queries queries(object, held);
  NeighborLists lists(queries.size());
  Supervisor supervisor;
  supervisor.run([&, x = queries.coordinates()] {
    held.with_engine([&](const Triangulation& engine) {
      lists.find(NaturalNeighborCoordinates(engine), engine, x, {}, held.threads());
    });
  });
  return lists.arrays();
}

class HeldNaturalInterpolator : public HeldFunction<NaturalNeighborInterpolator> {
 public:
  HeldNaturalInterpolator(const py::object& points, const py::object& values, const std::string& outside,
                          const py::object& fill, bool smooth, const py::object& gradients, double tolerance)
      : HeldFunction(points, values, outside, fill, tolerance), smooth_(smooth), given_gradients_(gradients) {
    const std::vector<double> site_gradients = parts_of_gradients();
    make_function([&](const Triangulation& engine, std::span<const double> numbers, std::size_t columns) {
      return std::make_unique<NaturalNeighborInterpolator>(engine, numbers, columns, smooth_, site_gradients);
    });
  }

  py::array site_gradients() const {
    const auto d = static_cast<std::size_t>(triangulation().dimension());
    std::vector<double> numbers;
    run([&](const Triangulation& engine) {
      const std::size_t width = num_parts() * d;
      numbers.resize(engine.num_rows() * width);
      for (std::size_t row = 0; row < engine.num_rows(); ++row) {
        cancellation_point();
        const VertexId v = engine.vertex_at(row);
        const std::size_t first = v == invalid_vertex ? row : engine.row_of(v);
        double* const out = numbers.data() + row * width;
        if (v == invalid_vertex)
          std::fill_n(out, width, std::numeric_limits<double>::quiet_NaN());
        else if (first == row)
          function().site_gradient(v, {out, width});
        else
          std::copy_n(numbers.data() + first * width, width, out);
      }
    });
    return gradients_of_parts(numbers, shape_at_points());
  }

  py::tuple neighbors(const py::object& object) const {
    const Queries queries(object, triangulation());
    NeighborLists lists(queries.size());
    run([&, x = queries.coordinates()](const Triangulation& engine) {
      lists.find(function().coordinates(), engine, x, how_to_locate(), triangulation().threads());
    });
    return lists.arrays();
  }

  std::string repr() const {
    return std::string("<delone.NaturalNeighborInterpolator: ") + (smooth_ ? "smooth, " : "") + "values " +
           std::string(py::str(values().dtype())) + " " + std::string(py::str(values().attr("shape"))) +
           " on " + std::string(py::repr(source())) + ">";
  }
  py::tuple state() const {
    return py::make_tuple(source(), values(), outside(), fill(), smooth_, given_gradients_, tolerance());
  }
  bool is_smooth() const { return smooth_; }

 private:
  std::vector<py::ssize_t> shape_at_points() const {
    std::vector<py::ssize_t> shape(values().shape(), values().shape() + values().ndim());
    shape.push_back(triangulation().dimension());
    return shape;
  }

  /// The given gradients as the library has them: of complex numbers those of real and imaginary parts one
  /// after the other.
  std::vector<double> parts_of_gradients() {
    if (given_gradients_.is_none()) return {};
    const auto d = static_cast<std::size_t>(triangulation().dimension());
    require_index(given_gradients_, triangulation().row_index(), "gradients");
    const py::array array =
        read_only_copy(as_numbers(given_gradients_, "gradients"), is_complex(), "gradients");
    given_gradients_ = array;
    if (std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()) != shape_at_points())
      throw py::value_error("gradients: the shape of values followed by the dimension, not " +
                            shown(array.attr("shape")));
    const auto* const given = static_cast<const double*>(array.data());
    const std::size_t size = static_cast<std::size_t>(array.size()), pieces = is_complex() ? 2 : 1;
    std::vector<double> result(size * pieces);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t piece = 0; piece < pieces; ++piece)
        result[(i / d * pieces + piece) * d + i % d] = given[i * pieces + piece];
    return result;
  }

  bool smooth_;
  py::object given_gradients_;
};

}  // namespace

void bind_natural_neighbors(py::module_& module) {
  using Held = HeldNaturalInterpolator;
  py::class_<Held> bound(module, "NaturalNeighborInterpolator", text(docs::interpolation::natural));
  bind_function(bound);
  bound
      .def(py::init([](const py::object& points, const py::object& values, const std::string& outside,
                       const py::object& fill, bool smooth, const py::object& gradients, double tolerance) {
             return std::make_unique<Held>(points, values, outside, fill, smooth || !gradients.is_none(),
                                           gradients, tolerance);
           }),
           "points"_a, "values"_a, py::kw_only(), "outside"_a = "fill",
           "fill_value"_a = std::numeric_limits<double>::quiet_NaN(), "smooth"_a = false,
           "gradients"_a = py::none(), "tolerance"_a = 0.0)
      .def("gradient", &Held::gradient, "queries"_a, text(docs::interpolation::natural_gradient))
      .def("natural_neighbors", &Held::neighbors, "queries"_a, text(docs::interpolation::neighbors))
      .def_property_readonly("smooth", &Held::is_smooth,
                             "Whether the interpolant is differentiable at the points.")
      .def_property_readonly("site_gradients", &Held::site_gradients,
                             text(docs::interpolation::site_gradients))
      .def(py::pickle([](const Held& held) { return held.state(); },
                      [](const py::tuple& given) {
                        return from_state(given, 7, "an interpolator", [](const py::tuple& state) {
                          return std::make_unique<Held>(state[0], state[1], state[2].cast<std::string>(),
                                                        state[3], state[4].cast<bool>(), state[5],
                                                        state[6].cast<double>());
                        });
                      }));
  module.def("natural_neighbors", &natural_neighbors, "points"_a, "queries"_a,
             text(docs::interpolation::natural_neighbors));
}

}  // namespace delone::python
