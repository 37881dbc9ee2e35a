// SPDX-License-Identifier: BSD-3-Clause
// What the methods save() of all products have in common.
#pragma once

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

}  // namespace delone::python
