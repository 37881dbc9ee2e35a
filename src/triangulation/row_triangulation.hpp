// SPDX-License-Identifier: BSD-3-Clause
// A Delaunay triangulation of rows of points, or a regular one if each row ends with a weight.
#pragma once

#include <delone/delaunay.hpp>
#include <delone/options.hpp>
#include <delone/regular.hpp>
#include <delone/triangulation.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace delone::triangulation {

class RowTriangulation {
 public:
  RowTriangulation(int dimension, bool weighted, const Options& options)
      : dimension_(static_cast<std::size_t>(dimension)),
        any_(weighted ? Any(std::in_place_type<Regular<>>, dimension, options)
                      : Any(std::in_place_type<Delaunay<>>, dimension, options)) {}
  RowTriangulation clone() const {
    return {dimension_, std::visit([](const auto& one) { return Any(one.clone()); }, any_)};
  }

  Triangulation& get() {
    return std::visit([](auto& one) -> Triangulation& { return one; }, any_);
  }
  const Triangulation& get() const {
    return std::visit([](const auto& one) -> const Triangulation& { return one; }, any_);
  }

  /// In bulk. Rows without weights are consumed.
  void insert_rows(std::vector<double> rows) {
    if (auto* const delaunay = std::get_if<Delaunay<>>(&any_)) return delaunay->insert_range(std::move(rows));
    const std::size_t width = dimension_ + 1;
    std::vector<double> coordinates, weights;
    coordinates.reserve(rows.size() / width * dimension_);
    weights.reserve(rows.size() / width);
    for (std::size_t at = 0; at < rows.size(); at += width) {
      coordinates.insert(coordinates.end(), &rows[at], &rows[at] + dimension_);
      weights.push_back(rows[at + dimension_]);
    }
    std::get<Regular<>>(any_).insert_range(std::move(coordinates), weights);
  }
  InsertResult insert_row(std::span<const double> row, std::optional<CellId> near) {
    const std::span<const double> point = row.first(dimension_);
    if (auto* const delaunay = std::get_if<Delaunay<>>(&any_)) return delaunay->insert(point, near);
    return std::get<Regular<>>(any_).insert(point, row.back(), near);
  }

 private:
  using Any = std::variant<Delaunay<>, Regular<>>;
  RowTriangulation(std::size_t dimension, Any any) : dimension_(dimension), any_(std::move(any)) {}

  std::size_t dimension_;
  Any any_;
};

}  // namespace delone::triangulation
