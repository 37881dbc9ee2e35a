// SPDX-License-Identifier: BSD-3-Clause
// The C++ object behind delone.Polyhedron: an immutable polyhedron, and a cache of its arrays.
#pragma once

#include "exact_numbers.hpp"
#include "running.hpp"

#include <delone/polyhedron.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace delone::python {

/// How a call runs, as Python has it.
struct CallArguments {
  int threads;
  py::object progress, memory_limit, time_limit;

  /// Runs make(options) without the GIL. Raises ValueError for a bad argument.
  template <class Make>
  auto run(Make make) const {
    const Options options = BuildArguments{.threads = threads,
                                           .memory_limit = as_memory_limit(memory_limit),
                                           .time_limit = as_time_limit(time_limit)}
                                .to_options();
    Supervisor supervisor(progress);
    return supervisor.run([&] { return make(options); });
  }
};

class HeldPolyhedron {
 public:
  /// The arrays that are kept.
  enum Array {
    vertices,
    vertex_integers,
    vertex_fractions,
    rays,
    ray_integers,
    lines,
    line_integers,
    inequalities,
    inequality_integers,
    equations,
    equation_integers,
    adjacent_vertices,
    adjacent_facets,
    num_arrays
  };

  explicit HeldPolyhedron(Polyhedron polyhedron)
      : HeldPolyhedron(std::move(polyhedron), std::vector<RowKind>()) {
    kinds_ = polyhedron_.row_kinds();
  }
  /// `kinds`: of the rows that the polyhedron was made of, which a pickle does not have.
  HeldPolyhedron(Polyhedron polyhedron, std::vector<RowKind> kinds)
      : polyhedron_(std::move(polyhedron)), kinds_(std::move(kinds)) {}

  const Polyhedron& polyhedron() const { return polyhedron_; }
  std::size_t dimension() const { return static_cast<std::size_t>(polyhedron_.dimension()); }
  const std::vector<RowKind>& kinds() const { return kinds_; }

  /// question(polyhedron), without the GIL.
  template <class Question>
  auto ask(Question question) const {
    Supervisor supervisor;
    return supervisor.run([&] { return question(polyhedron_); });
  }
  /// The array, made by `make` the first time.
  template <class Make>
  py::object kept(Array which, Make make) const {
    if (!arrays_[which]) {
      py::object array = make();
      if (!arrays_[which]) arrays_[which] = std::move(array);  // no other thread was faster
    }
    return arrays_[which];
  }

 private:
  Polyhedron polyhedron_;
  std::vector<RowKind> kinds_;
  mutable std::array<py::object, num_arrays> arrays_;
};

using PolyhedronClass = py::class_<HeldPolyhedron>;

/// Defines the method to_polyhedron() of a class that holds an intersection or a hull. `data_of`: returns a
/// pointer to its data, with the rows.
template <class Class, class DataOf>
void define_to_polyhedron(Class& type, const char* doc, DataOf data_of) {
  using namespace py::literals;
  type.def(
      "to_polyhedron",
      [data_of](const typename Class::type& held, int threads, const py::object& progress,
                const py::object& memory_limit, const py::object& time_limit) {
        const auto data = data_of(held);
        return std::make_unique<HeldPolyhedron>(
            CallArguments{threads, progress, memory_limit, time_limit}.run(
                [&](const Options& options) { return to_polyhedron(*data, options); }));
      },
      py::kw_only(), "threads"_a = 0, "progress"_a = py::none(), "memory_limit"_a = py::none(),
      "time_limit"_a = py::none(), doc);
}

/// The constructors, and the methods that make other polyhedra.
void bind_polyhedron_operations(PolyhedronClass& type);

}  // namespace delone::python
