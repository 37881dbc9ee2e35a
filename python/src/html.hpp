// SPDX-License-Identifier: BSD-3-Clause
// What delone/_viewer.py calls for the method to_html.
#pragma once

#include "arrays.hpp"
#include "running.hpp"

#include <delone/html.hpp>

#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

namespace delone::python {

/// The options; ValueError for values that are not a list, or for another `at`.
inline HtmlOptions html_options(const std::string& title, std::vector<std::string> columns,
                                const py::object& values, const std::string& at, const std::string& name) {
  HtmlOptions options;
  options.title = title;
  options.column_names = std::move(columns);
  options.value_name = name;
  if (!values.is_none()) {
    const auto array = as_doubles(values, "values");
    if (array.ndim() != 1) throw py::value_error("values: an array of one dimension was expected");
    options.values.assign(array.data(), array.data() + array.size());
  }
  options.values_at = at == "points" || at == "halfspaces" ? ValuesAt::points
                      : at == "cells" || at == "regions"   ? ValuesAt::cells
                      : at == "facets"                     ? ValuesAt::facets
                                                           : ValuesAt::automatic;
  return options;
}

/// Defines _to_html(title, columns, values, values_at, value_name) by page(object, options).
template <class Class, class Page>
void define_to_html(Class& type, Page page) {
  type.def(
      "_to_html",
      [page](const typename Class::type& held, const std::string& title, std::vector<std::string> columns,
             const py::object& values, const std::string& at, const std::string& name) {
        return page(held, html_options(title, std::move(columns), values, at, name));
      },
      py::arg("title"), py::arg("columns"), py::arg("values"), py::arg("values_at"), py::arg("value_name"));
}

/// The page of arrays that `data` points to.
template <class Data>
std::string html_of(const Data& data, const HtmlOptions& options) {
  Supervisor supervisor;
  return supervisor.run([&] { return to_html(*data, options); });
}

}  // namespace delone::python
