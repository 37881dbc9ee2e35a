// SPDX-License-Identifier: BSD-3-Clause
// The compiled module delone._core.
#include "module.hpp"

#include "messages.hpp"
#include "running.hpp"

#include <delone/io.hpp>

#include <cstddef>
#include <new>
#include <string>

namespace {

namespace py = pybind11;

/// pybind11 allocates an object of C++ when a method of a Python object is called that has none, because its
/// __init__ or __setstate__ has not run or has failed. This stands in the place of that allocation, so that
/// no method of any class ever sees memory that nothing has been made in.
void* refuse_uninitialized(std::size_t) {
  throw py::type_error("the object is not initialized: its __init__ or __setstate__ did not run, or failed");
}

void require_initialized_objects(const py::module_& module) {
  for (const auto& item : py::dict(module.attr("__dict__")))
    if (PyType_Check(item.second.ptr()))
      if (auto* const type = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(item.second.ptr())))
        type->operator_new = refuse_uninitialized;
}

/// Pickles of protocols 0 and 1, and __reduce__() itself, would make an object of pybind11's common base
/// class, at which pybind11 ends the program.
py::tuple reduce(const py::object& self) {
  const py::type type = py::type::of(self);
  if (!py::hasattr(type, "__setstate__"))
    throw py::type_error("cannot pickle '" + delone::python::type_name(self) + "' object");
  return py::make_tuple(py::module_::import("copyreg").attr("__newobj__"), py::make_tuple(type),
                        self.attr("__getstate__")());
}

void reduce_in_one_way(const py::module_& module) {
  for (const auto& item : py::dict(module.attr("__dict__")))
    if (PyType_Check(item.second.ptr()) &&
        py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(item.second.ptr())) != nullptr &&
        !item.second.attr("__dict__").contains("__reduce__"))
      py::setattr(item.second, "__reduce__",
                  py::cpp_function(&reduce, py::name("__reduce__"), py::is_method(item.second)));
}

ternaryfunc make_of_pybind11 = nullptr;

/// What calling a class does. pybind11 ends the program at a class without a class of C++, as its own common
/// base class is, and those derived from it alone.
PyObject* make_of_type(PyObject* type, PyObject* arguments, PyObject* keywords) {
  try {
    if (py::detail::all_type_info(reinterpret_cast<PyTypeObject*>(type)).empty()) {
      PyErr_Format(PyExc_TypeError, "cannot make '%.200s' objects",
                   reinterpret_cast<PyTypeObject*>(type)->tp_name);
      return nullptr;
    }
  } catch (const std::bad_alloc&) {
    return PyErr_NoMemory();
  }
  return make_of_pybind11(type, arguments, keywords);
}

/// The metaclass is that of delone's modules alone, which have internals of pybind11 of their own
/// (python/CMakeLists.txt).
void refuse_to_make_the_base() {
  PyTypeObject* const metaclass = py::detail::get_internals().default_metaclass;
  if (metaclass->tp_call == make_of_type) return;
  make_of_pybind11 = metaclass->tp_call;
  metaclass->tp_call = make_of_type;
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  namespace python = delone::python;
  module.doc() = "The compiled part of delone.";
  module.attr("__version__") = DELONE_VERSION;
  python::bind_errors(module);
  python::bind_triangulations(module);
  python::bind_trim(module);
  python::bind_faces(module);
  python::bind_interpolator(module);
  python::bind_natural_neighbors(module);
  python::bind_convex_hull(module);
  python::bind_convex_hulls(module);
  python::bind_voronoi(module);
  python::bind_site_cells(module);
  python::bind_halfspaces(module);
  python::bind_cell_maps(module);
  python::bind_clough_tocher(module);
  python::bind_lists(module);
  python::bind_rounding(module);
  python::bind_tiles(module);
  python::bind_forecast(module);
  python::bind_files(module);
  python::bind_lower_hull(module);
  python::bind_polyhedra(module);
  python::bind_polyhedra_vertices(module);
  python::bind_periodic(module);
  python::bind_qhull_options(module);
  python::bind_periodic_queries(module);
  python::bind_density(module);
  module.def("_represented", &python::represented, py::arg("value"), "How messages show a foreign value.");
  module.def("_write_text", &delone::write_text, py::arg("path"), py::arg("text"),
             "Writes a file, whole or not at all.", py::call_guard<py::gil_scoped_release>());
  require_initialized_objects(module);
  refuse_to_make_the_base();
  reduce_in_one_way(module);
  python::give_signatures(module);
}
