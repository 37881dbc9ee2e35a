// SPDX-License-Identifier: BSD-3-Clause
// What inspect.signature() and help() say of the compiled callables. pybind11 begins each docstring with a
// line of its own, "name(self: Type, argument: type = default) -> type". CPython reads signatures from
// docstrings that begin with "name(self, argument=default)\n--\n\n", and takes that off what __doc__ returns.
#include "module.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

namespace delone::python {
namespace {

namespace py = pybind11;

/// The end of the item that begins at `first`: the comma or closing parenthesis outside of brackets and
/// quotes.
std::size_t end_of_item(std::string_view text, std::size_t first) {
  int depth = 0;
  char quote = 0;
  for (std::size_t i = first; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == '\\') ++i;
      if (c == quote) quote = 0;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (std::strchr("([{", c) != nullptr) {
      ++depth;
    } else if (depth > 0 && std::strchr(")]}", c) != nullptr) {
      --depth;
    } else if (depth == 0 && (c == ',' || c == ')')) {
      return i;
    }
  }
  return text.size();
}

/// The docstring with a signature as CPython reads it; empty if it does not begin with one of pybind11.
std::string with_text_signature(std::string_view doc) {
  const std::size_t open = doc.find('(');
  const std::string_view line = doc.substr(0, doc.find('\n'));
  if (open == std::string_view::npos || open >= line.size() || line.find(") -> ") == std::string_view::npos)
    return {};
  std::string signature(line.substr(0, open + 1));
  std::size_t at = open + 1;
  while (at < line.size() && line[at] != ')') {
    const std::size_t end = end_of_item(line, at);
    if (end == line.size()) return {};
    const std::string_view item = line.substr(at, end - at);
    const std::size_t value = item.find(" = "), colon = item.find(": ");
    signature += item.substr(0, std::min(colon, value));
    if (value != std::string_view::npos) signature += '=', signature += item.substr(value + 3);
    at = end;
    if (line[end] == ',') signature += ", ", at = end + 2;
  }
  std::string_view rest = doc.substr(line.size());
  while (rest.starts_with('\n')) rest.remove_prefix(1);
  return signature + ")\n--\n\n" + std::string(rest);
}

/// A function of pybind11 owns its docstring, which it frees.
void give_signature(py::handle callable) {
  PyObject* object = callable.ptr();
  if (PyInstanceMethod_Check(object)) object = PyInstanceMethod_GET_FUNCTION(object);
  py::object function;
  if (Py_TYPE(object) == &PyStaticMethod_Type) {
    function = py::handle(object).attr("__func__");
    object = function.ptr();
  }
  if (!PyCFunction_Check(object)) return;
  PyMethodDef* const definition = reinterpret_cast<PyCFunctionObject*>(object)->m_ml;
  if (definition->ml_doc == nullptr) return;
  const std::string doc = with_text_signature(definition->ml_doc);
  char* const copy = doc.empty() ? nullptr : static_cast<char*>(std::malloc(doc.size() + 1));
  if (copy == nullptr) return;
  std::memcpy(copy, doc.c_str(), doc.size() + 1);
  std::free(const_cast<char*>(definition->ml_doc));
  definition->ml_doc = copy;
}

/// A class without a constructor of its own (pybind11 has one that raises) says so: Name(). Classes own their
/// docstrings as functions do, but __doc__ of those that are there is a string of its own.
void give_signature_to_class(py::handle type) {
  auto* const object = reinterpret_cast<PyTypeObject*>(type.ptr());
  if (Py_TYPE(py::object(type.attr("__init__")).ptr()) != &PyWrapperDescr_Type) return;
  const std::string doc = type.attr("__name__").cast<std::string>() + "()\n--\n\n" +
                          (object->tp_doc == nullptr ? "" : object->tp_doc);
  char* const copy = static_cast<char*>(PyObject_Malloc(doc.size() + 1));
  if (copy == nullptr) return;
  std::memcpy(copy, doc.c_str(), doc.size() + 1);
  PyObject_Free(const_cast<char*>(object->tp_doc));
  object->tp_doc = copy;
}

}  // namespace

void give_signatures(py::module_& module) {
  module.attr("nan") = std::numeric_limits<double>::quiet_NaN();  // defaults are looked up in the module
  for (const auto& item : py::dict(module.attr("__dict__"))) {
    if (PyType_Check(item.second.ptr())) {
      if (py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(item.second.ptr())) == nullptr) continue;
      give_signature_to_class(item.second);
      for (const auto& member : py::dict(item.second.attr("__dict__"))) give_signature(member.second);
    } else {
      give_signature(item.second);
    }
  }
}

}  // namespace delone::python
