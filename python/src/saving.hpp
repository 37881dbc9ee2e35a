// SPDX-License-Identifier: BSD-3-Clause
// What the methods save() of all products have in common.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <delone/io.hpp>

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone::python {

/// Where to save, and as what.
struct SaveArguments {
  std::string path, format;
  std::optional<std::string> qhull;       ///< outputs in the form of Qhull, instead of a format
  std::vector<std::string> column_names;  ///< as many as there are coordinates, or none

  /// Without the GIL: writes make_data(), or the product in the form of Qhull.
  template <class Product, class MakeData>
  void save(const Product& product, MakeData make_data) const {
    if (qhull)
      write_qhull(path, product, *qhull);
    else
      save_data(make_data());
  }
  template <PlainData Data>
  void save_data(Data data) const {
    if constexpr (!std::is_same_v<Data, IntersectionData>) data.column_names = column_names;
    write(path, data, format);
  }
};

/// Defines _save(path, format, qhull, columns) by save(object, arguments).
template <class Class, class Save>
void define_save(Class& type, Save save) {
  namespace py = pybind11;
  type.def(
      "_save",
      [save](const typename Class::type& held, std::string path, std::string format,
             std::optional<std::string> qhull, std::vector<std::string> columns) {
        save(held, SaveArguments{std::move(path), std::move(format), std::move(qhull), std::move(columns)});
      },
      py::arg("path"), py::arg("format"), py::arg("qhull"), py::arg("columns"));
}

}  // namespace delone::python
