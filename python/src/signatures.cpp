// SPDX-License-Identifier: BSD-3-Clause
// What inspect.signature() and help() say of the compiled callables, and what calls with other arguments
// raise. pybind11 begins each docstring with a line of its own, "name(self: Type, argument: type = default)
// -> type". CPython reads signatures from docstrings that begin with "name(self, argument=default)\n--\n\n",
// and takes that off what __doc__ returns.
#include "module.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

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

/// An argument; `*` is one without a type. The default is empty if there is none.
struct Argument {
  std::string name, type, value;
};
struct Signature {
  std::string name;
  std::vector<Argument> arguments;
  bool is_there = false;
};

/// That of the first line of a docstring of pybind11.
Signature signature_of(std::string_view doc) {
  const std::size_t open = doc.find('(');
  const std::string_view line = doc.substr(0, doc.find('\n'));
  if (open == std::string_view::npos || open >= line.size() || line.find(") -> ") == std::string_view::npos)
    return {};
  Signature signature{std::string(line.substr(0, open)), {}, true};
  std::size_t at = open + 1;
  while (at < line.size() && line[at] != ')') {
    const std::size_t end = end_of_item(line, at);
    if (end == line.size()) return {};
    const std::string_view item = line.substr(at, end - at);
    const std::size_t value = std::min(item.find(" = "), item.size()),
                      colon = std::min(item.find(": "), value);
    Argument argument{std::string(item.substr(0, colon)), {}, {}};
    if (colon < value) argument.type = item.substr(colon + 2, value - colon - 2);
    if (value < item.size()) argument.value = item.substr(value + 3);
    signature.arguments.push_back(std::move(argument));
    at = line[end] == ',' ? end + 2 : end;
  }
  return signature;
}

/// The docstring with a signature as CPython reads it.
std::string with_text_signature(const Signature& signature, std::string_view doc) {
  std::string text = signature.name + "(";
  for (const Argument& argument : signature.arguments) {
    if (&argument != signature.arguments.data()) text += ", ";
    text += argument.name;
    if (!argument.value.empty()) text += '=', text += argument.value;
  }
  std::string_view rest = doc.substr(std::min(doc.find('\n'), doc.size()));
  while (rest.starts_with('\n')) rest.remove_prefix(1);
  return text + ")\n--\n\n" + std::string(rest);
}

/// What pybind11 has set as the function of C of each callable, the same for all, and their signatures by
/// what they are called with as `self`. They live as long as the interpreter.
PyCFunctionWithKeywords call_of_pybind11 = nullptr;
std::unordered_map<PyObject*, Signature>& signatures() {
  static auto* const all = new std::unordered_map<PyObject*, Signature>;
  return *all;
}

/// Whether the error is that of pybind11 for arguments that do not fit the function. It raises it outside of
/// Python, so there is no traceback.
bool is_refusal(const py::error_already_set& error, const std::string& function) {
  if (error.type().ptr() != PyExc_TypeError || error.trace()) return false;
  try {
    return std::string(py::str(error.value())).starts_with(function + "(): incompatible ");
  } catch (const py::error_already_set&) {  // of the error's own text
    return false;
  }
}

/// Raises what says which argument is wrong, in place of the TypeError that is set, in which pybind11 shows
/// all arguments in full. Leaves other errors as they are.
void explain_refusal(PyObject* self, PyObject* arguments, PyObject* keywords) {
  py::error_already_set error;  // takes it
  const auto found = signatures().find(self);
  if (found == signatures().end() || !is_refusal(error, found->second.name)) return error.restore();
  try {
    py::list all;
    for (const Argument& argument : found->second.arguments)
      all.append(py::make_tuple(argument.name, argument.type, argument.value));
    const auto named = keywords == nullptr ? py::dict() : py::reinterpret_borrow<py::dict>(keywords);
    const py::object explained = py::module_::import("delone._refusals").attr("explained");
    const py::object better = explained(found->second.name, all, py::handle(arguments), named);
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(better.ptr())), better.ptr());
  } catch (py::error_already_set& other) {  // Ctrl-C, and what methods of the arguments raise
    other.restore();
  }
}

/// The function of C of all callables. What succeeds costs no more than the call of it.
PyObject* call_and_explain(PyObject* self, PyObject* arguments, PyObject* keywords) {
  PyObject* const result = call_of_pybind11(self, arguments, keywords);
  if (result == nullptr && PyErr_ExceptionMatches(PyExc_TypeError) != 0) {
    try {
      explain_refusal(self, arguments, keywords);
    } catch (const std::bad_alloc&) {
      PyErr_NoMemory();
    } catch (const std::exception& error) {
      if (PyErr_Occurred() == nullptr) PyErr_SetString(PyExc_TypeError, error.what());
    }
  }
  return result;
}

void explain_refusals(PyCFunctionObject* function, const Signature& signature) {
  const auto call =
      reinterpret_cast<PyCFunctionWithKeywords>(reinterpret_cast<void (*)()>(function->m_ml->ml_meth));
  if (function->m_ml->ml_flags != (METH_VARARGS | METH_KEYWORDS) || call == call_and_explain) return;
  if (call_of_pybind11 != nullptr && call != call_of_pybind11) return;
  signatures().emplace(function->m_self, signature);
  call_of_pybind11 = call;
  function->m_ml->ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(call_and_explain));
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
  const Signature signature = signature_of(definition->ml_doc);
  if (!signature.is_there) return;
  explain_refusals(reinterpret_cast<PyCFunctionObject*>(object), signature);
  const std::string doc = with_text_signature(signature, definition->ml_doc);
  char* const copy = static_cast<char*>(std::malloc(doc.size() + 1));
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
