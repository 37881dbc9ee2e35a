// SPDX-License-Identifier: BSD-3-Clause
// delone.Polyhedron: how it is made, of rows, of a file and of other polyhedra.
#include "arrays.hpp"
#include "docs_polyhedra.hpp"
#include "docstring.hpp"
#include "held_polyhedron.hpp"

#include <delone/polyhedron_io.hpp>

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;

/// Rows (a, b) of a matrix and a vector.
struct System {
  RationalRows rows;
  std::size_t dimension;
};

System as_system(const py::object& matrix, const py::object& vector, const std::string& matrix_name,
                 const std::string& vector_name) {
  const ExactArray a = as_exact(matrix, matrix_name, 2);
  const std::size_t m = a.length(0), d = a.length(1);
  const std::vector<Rational> b = as_exact_vector(vector, vector_name, m);
  std::vector<Rational> entries;
  entries.reserve(m * (d + 1));
  for (std::size_t i = 0; i < m; ++i) {
    const auto row = a.entries.begin() + static_cast<std::ptrdiff_t>(i * d);
    entries.insert(entries.end(), row, row + static_cast<std::ptrdiff_t>(d));
    entries.push_back(b[i]);
  }
  return {{std::move(entries), d + 1}, d};
}

std::optional<System> as_equations(const py::object& equations) {
  if (equations.is_none()) return std::nullopt;
  const bool is_sequence = py::isinstance<py::sequence>(equations) && PyUnicode_Check(equations.ptr()) == 0;
  if (!is_sequence || py::isinstance<py::array>(equations) || py::len(equations) != 2)
    throw py::value_error("equations: a pair (C, e) of a matrix and a vector, for C x = e");
  const auto pair = py::reinterpret_borrow<py::sequence>(equations);
  return as_system(pair[0], pair[1], "equations[0]", "equations[1]");
}

std::unique_ptr<HeldPolyhedron> from_inequalities(const py::object& a, const py::object& b,
                                                  const py::object& equations, const CallArguments& call) {
  if (a.is_none() != b.is_none())
    throw py::value_error(a.is_none() ? "A: missing, the matrix for b" : "b: missing, the vector for A");
  const std::optional<System> equal = as_equations(equations);
  if (a.is_none() && !equal)
    throw py::value_error("A and b, or equations; Polyhedron.space(d) is all of space");
  const System below = a.is_none() ? System{{}, equal->dimension} : as_system(a, b, "A", "b");
  if (equal && equal->dimension != below.dimension)
    throw py::value_error("equations[0]: an array of shape (e, " + std::to_string(below.dimension) +
                          "), not (" + std::to_string(equal->rows.size()) + ", " +
                          std::to_string(equal->dimension) + "): as many columns as A");
  return std::make_unique<HeldPolyhedron>(call.run([&](const Options& options) {
    return Polyhedron::from_inequalities(below.rows, equal ? equal->rows : RationalRows(),
                                         static_cast<int>(below.dimension), options);
  }));
}

/// Nothing for None, and for an empty list, which has no width.
std::optional<ExactArray> as_generators(const py::object& object, const char* name) {
  if (object.is_none()) return std::nullopt;
  if (PyList_CheckExact(object.ptr()) && PyList_GET_SIZE(object.ptr()) == 0) return std::nullopt;
  return as_exact(object, name, 2);
}

std::unique_ptr<HeldPolyhedron> from_generators(const py::object& vertices, const py::object& rays,
                                                const py::object& lines, const CallArguments& call) {
  constexpr const char* names[] = {"vertices", "rays", "lines"};
  std::optional<ExactArray> given[] = {as_generators(vertices, names[0]), as_generators(rays, names[1]),
                                       as_generators(lines, names[2])};
  std::optional<std::size_t> dimension;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!given[i]) continue;
    const std::size_t width = given[i]->length(1);
    if (dimension && *dimension != width)
      throw py::value_error(std::string(names[i]) + ": an array of shape (n, " + std::to_string(*dimension) +
                            "), not (" + std::to_string(given[i]->length(0)) + ", " + std::to_string(width) +
                            "): as many columns as the others");
    dimension = width;
  }
  if (!dimension)
    throw py::value_error("vertices, rays or lines, with their coordinates; Polyhedron.empty(d) is empty");
  RationalRows rows[3];
  for (std::size_t i = 0; i < 3; ++i)
    if (given[i]) rows[i] = to_rows(std::move(*given[i]));
  return std::make_unique<HeldPolyhedron>(call.run([&](const Options& options) {
    return Polyhedron::from_generators(rows[0], rows[1], rows[2], static_cast<int>(*dimension), options);
  }));
}

std::unique_ptr<HeldPolyhedron> read_polyhedron_file(const std::string& path, std::uint64_t max_stream_bytes,
                                                     const CallArguments& call) {
  return std::make_unique<HeldPolyhedron>(call.run([&](const Options& options) {
    return to_polyhedron(read_polyhedron(path, max_stream_bytes), options);
  }));
}

/// Defines a method with these arguments, and behind them those that say how it runs: make(polyhedron,
/// arguments…) returns what makes another polyhedron with options.
template <class... Arguments, class Make, class... Names>
void define_operation(PolyhedronClass& type, const char* name, const char* doc, Make make,
                      const Names&... names) {
  type.def(
      name,
      [make](const HeldPolyhedron& held, const Arguments&... arguments, int threads,
             const py::object& progress, const py::object& memory_limit, const py::object& time_limit) {
        return std::make_unique<HeldPolyhedron>(
            CallArguments{threads, progress, memory_limit, time_limit}.run(
                make(held.polyhedron(), arguments...)));
      },
      names..., py::kw_only(), "threads"_a = 0, "progress"_a = py::none(), "memory_limit"_a = py::none(),
      "time_limit"_a = py::none(), doc);
}

template <auto Operation>
auto with_another() {
  return [](const Polyhedron& p, const HeldPolyhedron& other) {
    return [&p, &q = other.polyhedron()](const Options& options) { return (p.*Operation)(q, options); };
  };
}

/// Axes as numbers, or as flags of all of them. Bool is a kind of int, so that a list may be both.
std::vector<int> as_axes(const py::object& given, int dimension) {
  const bool is_array = py::isinstance<py::array>(given);
  if (!py::isinstance<py::iterable>(given) || (is_array && given.attr("ndim").cast<int>() != 1))
    throw py::type_error("axes: a list of integers, or of a flag for each coordinate, not " + shown(given));
  const auto is_flag = [&](const py::handle& x) {
    return is_array ? given.attr("dtype").attr("kind").cast<std::string>() == "b"
                    : py::isinstance<py::bool_>(x);
  };
  std::vector<int> axes;
  std::size_t flags = 0, size = 0;
  for (const py::handle x : given) {
    if (is_flag(x)) {
      if (x.cast<bool>()) axes.push_back(static_cast<int>(size));
      ++flags;
    } else {
      try {
        axes.push_back(x.cast<int>());
      } catch (const py::cast_error&) {
        throw py::type_error("axes: integers, or a flag for each coordinate, not " + shown(x));
      }
    }
    ++size;
  }
  if (flags == 0) return axes;
  if (flags != size) throw py::type_error("axes: integers or flags, not both");
  if (size != static_cast<std::size_t>(dimension))
    throw Error(Errc::invalid_argument, "axes: " + std::to_string(dimension) +
                                            " flags, one for each coordinate, not " + std::to_string(size));
  return axes;
}

std::vector<Rational> as_translation(const py::object& translation, std::size_t size) {
  return translation.is_none() ? std::vector<Rational>() : as_exact_vector(translation, "translation", size);
}

auto image_of(const Polyhedron& p, const py::object& given, const py::object& translation) {
  ExactArray matrix = as_exact(given, "matrix", 2);
  const auto d = static_cast<std::size_t>(p.dimension());
  if (matrix.length(1) != d)
    throw py::value_error("matrix: an array of shape (n, " + std::to_string(d) + "), not (" +
                          std::to_string(matrix.length(0)) + ", " + std::to_string(matrix.length(1)) + ")");
  std::vector<Rational> shift = as_translation(translation, matrix.length(0));
  return [&p, rows = to_rows(std::move(matrix)), shift = std::move(shift)](const Options& options) {
    return p.image(rows, shift, options);
  };
}

auto preimage_of(const Polyhedron& p, const py::object& given, const py::object& translation) {
  ExactArray matrix = as_exact(given, "matrix", 2);
  const auto d = static_cast<std::size_t>(p.dimension());
  if (matrix.length(0) != d)
    throw py::value_error("matrix: an array of shape (" + std::to_string(d) + ", n), not (" +
                          std::to_string(matrix.length(0)) + ", " + std::to_string(matrix.length(1)) + ")");
  const auto e = static_cast<int>(matrix.length(1));
  std::vector<Rational> shift = as_translation(translation, d);
  return [&p, e, rows = to_rows(std::move(matrix)), shift = std::move(shift)](const Options& options) {
    return p.preimage(rows, e, shift, options);
  };
}

void define_makers(PolyhedronClass& type) {
  type.def(py::init([](const py::object& a, const py::object& b, const py::object& equations, int threads,
                       const py::object& progress, const py::object& memory_limit,
                       const py::object& time_limit) {
             return from_inequalities(a, b, equations, {threads, progress, memory_limit, time_limit});
           }),
           "A"_a = py::none(), "b"_a = py::none(), "equations"_a = py::none(), py::kw_only(), "threads"_a = 0,
           "progress"_a = py::none(), "memory_limit"_a = py::none(), "time_limit"_a = py::none())
      .def_static(
          "from_generators",
          [](const py::object& vertices, const py::object& rays, const py::object& lines, int threads,
             const py::object& progress, const py::object& memory_limit, const py::object& time_limit) {
            return from_generators(vertices, rays, lines, {threads, progress, memory_limit, time_limit});
          },
          "vertices"_a = py::none(), "rays"_a = py::none(), "lines"_a = py::none(), py::kw_only(),
          "threads"_a = 0, "progress"_a = py::none(), "memory_limit"_a = py::none(),
          "time_limit"_a = py::none(), text(docs::polyhedra::from_generators))
      .def_static(
          "empty",
          [](int dimension) { return std::make_unique<HeldPolyhedron>(Polyhedron::empty(dimension)); },
          "dimension"_a, text(docs::polyhedra::empty))
      .def_static(
          "space",
          [](int dimension) { return std::make_unique<HeldPolyhedron>(Polyhedron::space(dimension)); },
          "dimension"_a, text(docs::polyhedra::space))
      .def_static(
          "_read",
          [](const std::string& path, std::uint64_t max_stream_bytes, int threads, const py::object& progress,
             const py::object& memory_limit, const py::object& time_limit) {
            return read_polyhedron_file(path, max_stream_bytes,
                                        {threads, progress, memory_limit, time_limit});
          },
          "path"_a, "max_stream_bytes"_a, "threads"_a, "progress"_a, "memory_limit"_a, "time_limit"_a);
}

}  // namespace

void bind_polyhedron_operations(PolyhedronClass& type) {
  using P = Polyhedron;
  define_makers(type);
  define_operation<HeldPolyhedron>(type, "intersection", text(docs::polyhedra::intersection),
                                   with_another<&P::intersection>(), "other"_a);
  define_operation<HeldPolyhedron>(type, "convex_union", text(docs::polyhedra::convex_union),
                                   with_another<&P::convex_union>(), "other"_a);
  define_operation<HeldPolyhedron>(type, "minkowski_sum", text(docs::polyhedra::minkowski_sum),
                                   with_another<&P::minkowski_sum>(), "other"_a);
  type.def(
      "product",
      [](const HeldPolyhedron& held, const HeldPolyhedron& other) {
        return std::make_unique<HeldPolyhedron>(
            held.ask([&](const P& p) { return p.product(other.polyhedron()); }));
      },
      "other"_a, text(docs::polyhedra::product));
  define_operation<>(type, "polar", text(docs::polyhedra::polar),
                     [](const P& p) { return [&p](const Options& options) { return p.polar(options); }; });
  define_operation<py::object>(
      type, "projection", text(docs::polyhedra::projection),
      [](const P& p, const py::object& given) {
        return [&p, axes = as_axes(given, p.dimension())](const Options& options) {
          return p.projection(axes, options);
        };
      },
      "axes"_a);
  define_operation<py::object, py::object>(type, "image", text(docs::polyhedra::image), &image_of, "matrix"_a,
                                           "translation"_a = py::none());
  define_operation<py::object, py::object>(type, "preimage", text(docs::polyhedra::preimage), &preimage_of,
                                           "matrix"_a, "translation"_a = py::none());
}

}  // namespace delone::python
