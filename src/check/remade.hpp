// SPDX-License-Identifier: BSD-3-Clause
// Triangulations of the points of data, rebuilt and examined, for checks by comparison.
#pragma once

#include <delone/check.hpp>
#include <delone/data.hpp>
#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/furthest_site.hpp>
#include <delone/regular.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace delone::internal {

using AnyTriangulation = std::variant<Delaunay<>, Regular<>, FurthestSite<>>;

inline const Triangulation& common(const AnyTriangulation& any) {
  return std::visit([](const auto& one) -> const Triangulation& { return one; }, any);
}

/// The triangulation of all rows of data but those that were removed. Throws unsupported if check() finds a
/// fault in it.
template <class Data>
AnyTriangulation remade(const Data& data, TriangulationKind kind, unsigned threads) {
  // Rows that were removed get some point, and are removed.
  const auto d = static_cast<std::size_t>(data.dimension);
  std::vector<double> points = data.points, weights = data.weights;
  std::vector<std::size_t> removed;
  for (std::size_t row = 0; row < data.num_points(); ++row) {
    if (!data.is_removed(row)) continue;
    removed.push_back(row);
    std::fill_n(points.begin() + static_cast<std::ptrdiff_t>(row * d), d, 0.0);
    if (!weights.empty()) weights[row] = 0;
  }
  Options options;
  options.threads = threads;
  const auto make = [&]() -> AnyTriangulation {
    switch (kind) {
      case TriangulationKind::delaunay:
        return Delaunay<>(points, data.dimension, options);
      case TriangulationKind::regular:
        return Regular<>(points, weights, data.dimension, options);
      case TriangulationKind::furthest_site:
        break;
    }
    return FurthestSite<>(points, data.dimension, options);
  };
  AnyTriangulation made = make();
  std::visit([&](auto& one) { one.remove(removed); }, made);
  const CheckReport report = check(common(made).to_data(), {}, {.threads = threads});
  if (!report.ok)
    throw Error(Errc::unsupported,
                "the triangulation of the points is wrong, a fault of delone: " + report.violation);
  return made;
}

}  // namespace delone::internal
