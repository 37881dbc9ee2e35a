// SPDX-License-Identifier: BSD-3-Clause
// delone.forecast and delone.estimate.
#include "arrays.hpp"
#include "docs_forecasts.hpp"
#include "docstring.hpp"
#include "messages/in_quotes.hpp"
#include "messages/readable.hpp"
#include "module.hpp"
#include "pickling.hpp"
#include "running.hpp"

#include <pybind11/stl.h>

#include <delone/forecast.hpp>
#include <delone/point_sets.hpp>

#include <array>
#include <string>

namespace delone::python {
namespace {

using namespace py::literals;

py::tuple as_range(const ForecastQuantity& quantity) { return py::make_tuple(quantity.low, quantity.high); }

void require_kind(const std::string& kind) {
  std::string names;
  for (const PointSetKind& known : point_set_kinds()) {
    if (known.name == kind) return;
    names += (names.empty() ? "" : ", ") + std::string(known.name);
  }
  throw py::value_error("kind: " + names + "; not " + messages::in_quotes(kind));
}

std::string forecast_text(const Forecast& f) {
  return "<delone.Forecast: " + std::to_string(f.num_points) + " points in " + std::to_string(f.dimension) +
         "D, about " + shown(py::str("{:.3g}").format(f.cells.expected)) + " cells, " +
         messages::readable_bytes(f.bytes.expected) + ", " + messages::readable_seconds(f.seconds.expected) +
         ">";
}

py::tuple state_of_forecast(const Forecast& f) {
  const auto quantity = [](const ForecastQuantity& q) { return py::make_tuple(q.expected, q.low, q.high); };
  return py::make_tuple(f.dimension, f.affine_dimension, f.num_points, f.threads, f.num_sampled,
                        quantity(f.vertices), quantity(f.cells), quantity(f.bytes), quantity(f.seconds));
}

Forecast restored_forecast(const py::tuple& given) {
  return from_state(given, 9, "a forecast", [](const py::tuple& state) {
    const auto quantity = [&](std::size_t i) {
      const auto numbers = state[i].cast<std::array<double, 3>>();
      return ForecastQuantity{numbers[0], numbers[1], numbers[2]};
    };
    Forecast f;
    f.dimension = state[0].cast<int>();
    f.affine_dimension = state[1].cast<int>();
    f.num_points = state[2].cast<std::size_t>();
    f.threads = state[3].cast<unsigned>();
    f.num_sampled = state[4].cast<std::size_t>();
    f.vertices = quantity(5);
    f.cells = quantity(6);
    f.bytes = quantity(7);
    f.seconds = quantity(8);
    return f;
  });
}

}  // namespace

void bind_forecast(py::module_& module) {
  py::class_<Forecast>(module, "Forecast", text(docs::forecasts::result))
      .def_readonly("dimension", &Forecast::dimension, "The number d of coordinates.")
      .def_readonly("affine_dimension", &Forecast::affine_dimension,
                    "The affine dimension k, if known from points; -1 for no points.")
      .def_readonly("num_points", &Forecast::num_points, "The number n of points.")
      .def_readonly("threads", &Forecast::threads, "The number of threads that will build.")
      .def_readonly("num_sampled", &Forecast::num_sampled,
                    "The number of points of the largest triangulated sample; 0: none.")
      .def_property_readonly(
          "vertices", [](const Forecast& f) { return f.vertices.expected; },
          "The expected number of distinct points.")
      .def_property_readonly(
          "cells", [](const Forecast& f) { return f.cells.expected; }, "The expected number of cells.")
      .def_property_readonly(
          "bytes", [](const Forecast& f) { return f.bytes.expected; },
          "The expected peak of memory in bytes, on top of the points.")
      .def_property_readonly(
          "seconds", [](const Forecast& f) { return f.seconds.expected; },
          "The expected wall-clock time in seconds, on an otherwise idle machine.")
      .def_property_readonly(
          "cells_range", [](const Forecast& f) { return as_range(f.cells); },
          "The range of `cells`, (low, high).")
      .def_property_readonly(
          "bytes_range", [](const Forecast& f) { return as_range(f.bytes); },
          "The range of `bytes`, (low, high).")
      .def_property_readonly(
          "seconds_range", [](const Forecast& f) { return as_range(f.seconds); },
          "The range of `seconds`, (low, high).")
      .def("__repr__", &forecast_text)
      .def(py::pickle(&state_of_forecast, &restored_forecast));
  module.def(
      "forecast",
      [](int dimension, std::size_t num_points, const std::string& kind, int threads) {
        const unsigned most = as_threads(threads);
        require_kind(kind);
        Supervisor supervisor;
        return supervisor.run([&] { return forecast(dimension, num_points, kind, {.threads = most}); });
      },
      "dimension"_a, "num_points"_a, "kind"_a = "uniform", py::kw_only(), "threads"_a = 0,
      text(docs::forecasts::forecast));
  module.def(
      "estimate",
      [](const py::object& points, int threads, double sample_seconds, const py::object& progress) {
        const auto rows = as_points(points, "points");
        ForecastOptions options;
        options.threads = as_threads(threads);
        options.sample_seconds = sample_seconds;
        const int dimension = static_cast<int>(rows.shape(1));
        const PointsView view(numbers(rows), dimension);
        Supervisor supervisor(progress);
        return supervisor.run([&] { return estimate(view, dimension, options); });
      },
      "points"_a, py::kw_only(), "threads"_a = 0, "sample_seconds"_a = 1.0, "progress"_a = py::none(),
      text(docs::forecasts::estimate));
}

}  // namespace delone::python
