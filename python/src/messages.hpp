// SPDX-License-Identifier: BSD-3-Clause
// Foreign values in messages: without characters that a terminal acts on, and cut, as printable() does it.
#pragma once

#include <pybind11/pybind11.h>

#include <delone/printable.hpp>

#include <string>

namespace delone::python {

/// The value as str() shows it; its type if Python has no text for it, as for integers of thousands of
/// digits.
std::string shown(const pybind11::handle& value);

/// The same as repr() shows it, with text in quotes.
std::string represented(const pybind11::handle& value);

/// The name of its type.
std::string type_name(const pybind11::handle& value);
/// The same with its article: "a dict", "an object".
std::string type_with_article(const pybind11::handle& value);

}  // namespace delone::python
