// SPDX-License-Identifier: BSD-3-Clause
// The exceptions of the module, each derived also from the built-in exception that fits best; options and
// statistics.
#include "messages.hpp"
#include "messages/in_quotes.hpp"
#include "running.hpp"

#include <algorithm>
#include <cmath>
#include <new>

namespace delone::python {
namespace {

struct Types {
  py::object base, input, memory, cancelled, time_limit;
};

/// Lives as long as the interpreter, like the module itself.
Types& types() {
  static auto* const all = new Types;
  return *all;
}

py::object make(py::module_& module, const char* name, const py::tuple& bases, const char* doc) {
  py::dict members;
  members["__doc__"] = std::string(name) + "(*args)\n--\n\n" + doc;  // for inspect.signature()
  members["__module__"] = "delone";
  py::object type = py::reinterpret_steal<py::object>(PyObject_CallFunction(
      reinterpret_cast<PyObject*>(&PyType_Type), "sOO", name, bases.ptr(), members.ptr()));
  if (!type) throw py::error_already_set();
  type.attr("__doc__") = doc;
  module.attr(name) = type;
  return type;
}

const py::object& type_of(Errc code) {
  switch (code) {
    case Errc::not_finite:
    case Errc::bad_dimension:
    case Errc::invalid_argument:
    case Errc::bad_format:
      return types().input;
    case Errc::out_of_memory:
      return types().memory;
    case Errc::cancelled:
      return types().cancelled;
    case Errc::time_limit:
      return types().time_limit;
    case Errc::too_many:
    case Errc::cannot_open:
    case Errc::cannot_write:
    case Errc::unsupported:
      break;
  }
  return types().base;
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const Error& error) {
    const py::object exception = type_of(error.code())(error.what());
    py::list rows;
    for (const std::size_t row : error.rows()) rows.append(row);
    exception.attr("rows") = rows;
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
  } catch (const std::bad_alloc&) {
    PyErr_SetString(types().memory.ptr(), "not enough memory");
  }
}

/// A finite number above 0.
double as_limit(const py::object& limit, const std::string& name, const std::string& unit) {
  const bool is_bool = PyBool_Check(limit.ptr()) != 0;
  const double value = is_bool ? 0 : PyFloat_AsDouble(limit.ptr());
  if (is_bool || PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw py::type_error(name + ": a number of " + unit + ", or None, not " + type_name(limit));
  }
  if (!(value > 0) || std::isinf(value))
    throw py::value_error(name + ": a finite number of " + unit + " above 0, or None, not " + shown(limit));
  return value;
}

}  // namespace

Options BuildArguments::to_options() const {
  Options options;
  options.seed = seed;
  if (order == "shuffled")
    options.order = InsertionOrder::shuffled;
  else if (order == "as_given")
    options.order = InsertionOrder::as_given;
  else if (order != "automatic")
    throw py::value_error("order: 'automatic', 'as_given' or 'shuffled', not " + messages::in_quotes(order));
  options.threads = as_threads(threads);
  options.memory_limit = memory_limit;
  options.time_limit = time_limit;
  return options;
}

unsigned as_threads(int threads) {
  if (threads < 0) throw py::value_error("threads: at least 0, not " + std::to_string(threads));
  return static_cast<unsigned>(threads);
}

std::size_t as_memory_limit(const py::object& bytes) {
  if (bytes.is_none()) return 0;
  const double value = as_limit(bytes, "memory_limit", "bytes");
  constexpr double most = 0x1p62;
  return static_cast<std::size_t>(std::max(std::min(value, most), 1.0));
}
double as_time_limit(const py::object& seconds) {
  return seconds.is_none() ? 0 : as_limit(seconds, "time_limit", "seconds");
}

py::dict as_dict(const Statistics& s) {
  using namespace py::literals;
  return py::dict("created_cells"_a = s.created_cells, "visited_cells"_a = s.visited_cells,
                  "insertions"_a = s.insertions, "filter"_a = s.filter, "direct"_a = s.direct,
                  "exact"_a = s.exact, "perturbed"_a = s.perturbed, "order_seconds"_a = s.order_seconds,
                  "threads"_a = s.threads, "build_seconds"_a = s.build_seconds,
                  "cell_bytes"_a = s.cell_bytes);
}

void bind_errors(py::module_& module) {
  const auto builtin = [](PyObject* type) { return py::reinterpret_borrow<py::object>(type); };
  Types& t = types();
  t.base = make(module, "Error", py::make_tuple(builtin(PyExc_Exception)),
                "Base of all errors of delone. `rows` lists the input rows concerned, if any.");
  t.base.attr("rows") = py::tuple();
  t.input = make(module, "InputError", py::make_tuple(t.base, builtin(PyExc_ValueError)),
                 "Input or an argument without a result, such as NaN; also a ValueError.");
  t.memory = make(module, "OutOfMemoryError", py::make_tuple(t.base, builtin(PyExc_MemoryError)),
                  "Not enough memory, or `memory_limit` was reached; also a MemoryError.");
  t.time_limit = make(module, "TimeLimitError", py::make_tuple(t.base, builtin(PyExc_TimeoutError)),
                      "The call reached `time_limit`; also a TimeoutError.");
  t.cancelled = make(module, "CancelledError", py::make_tuple(t.base),
                     "The progress function returned a false value other than None.");
  py::register_exception_translator(translate);
}

}  // namespace delone::python
