// SPDX-License-Identifier: BSD-3-Clause
#include "messages.hpp"

namespace delone::python {

namespace py = pybind11;

namespace {

/// Text of Python can have halves of pairs of UTF-16, which UTF-8 cannot.
std::string printed(const py::str& text) {
  return printable(std::string(py::bytes(text.attr("encode")("utf-8", "surrogatepass"))));
}

/// What `to_text` makes of a value; its type if it fails, as for integers of too many digits.
template <class ToText>
std::string printed_by(ToText to_text, const py::handle& value) {
  try {
    return printed(to_text(value));
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_Exception)) throw;  // Ctrl-C
    return "a huge " + type_name(value);
  }
}

}  // namespace

std::string shown(const py::handle& value) {
  return printed_by([](const py::handle& x) { return py::str(x); }, value);
}

std::string represented(const py::handle& value) {
  return printed_by([](const py::handle& x) { return py::str(py::repr(x)); }, value);
}

std::string type_name(const py::handle& value) {
  return printed(py::type::handle_of(value).attr("__name__"));
}

std::string type_with_article(const py::handle& value) {
  const std::string name = type_name(value);
  const bool has_vowel =
      !name.empty() && std::string_view("aeiouAEIOU").find(name[0]) != std::string_view::npos;
  return (has_vowel ? "an " : "a ") + name;
}

}  // namespace delone::python
