// SPDX-License-Identifier: BSD-3-Clause
#include "view/scene.hpp"

#include "base/quick_rounds.hpp"
#include "io/file.hpp"
#include "view/encode.hpp"

#include <fmt/format.h>

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace delone::view {

namespace {

/// The bits of the coordinates in turn, the highest first: the place along a Z-shaped curve.
std::uint64_t place_of(std::span<const std::uint32_t> codes) {
  const auto d = static_cast<int>(codes.size());
  const int bits = std::max(1, std::min(8 * position_bytes, 63 / d));
  std::uint64_t place = 0;
  for (int b = 1; b <= bits; ++b)
    for (int axis = 0; axis < std::min(d, 63); ++axis)
      place = place << 1 | (codes[static_cast<std::size_t>(axis)] >> (8 * position_bytes - b) & 1);
  return place;
}

void renumber(std::vector<SignedIndex>& items, const std::vector<SignedIndex>& number) {
  internal::QuickRounds round;
  for (SignedIndex& item : items) {
    round();
    item = number[static_cast<std::size_t>(item)];
  }
}

}  // namespace

Scene scene_of(const HtmlOptions& options, int dimension, const char* kind,
               const std::vector<std::string>& column_names) {
  Scene scene;
  scene.kind = kind;
  scene.dimension = dimension;
  scene.title = options.title;
  scene.columns = options.column_names.empty() ? column_names : options.column_names;
  scene.value_name = options.value_name;
  const auto d = static_cast<std::size_t>(dimension);
  if (scene.columns.empty())
    for (std::size_t j = 0; j < d; ++j)
      scene.columns.push_back(d <= 3 ? std::string(1, static_cast<char>('x' + j)) : fmt::format("x{}", j));
  if (scene.columns.size() != d)
    io::fail(Errc::invalid_argument, "column_names: {} names for {} coordinates", scene.columns.size(), d);
  return scene;
}

void take_vertices(Scene& scene, std::span<const double> points, bool merge) {
  const auto d = static_cast<std::size_t>(scene.dimension);
  const std::size_t n = points.size() / d;
  std::vector<unsigned char> used(n, 0);
  for (const auto* items : {&scene.cells, &scene.face_vertices, &scene.segments})
    for (const SignedIndex item : *items) used[static_cast<std::size_t>(item)] = 1;
  const auto codes = codes_of_positions(points, box_of(points, scene.dimension));
  std::vector<std::pair<std::uint64_t, SignedIndex>> order;
  internal::QuickRounds round;
  for (std::size_t i = 0; i < n; ++i) {
    round();
    if (used[i])
      order.emplace_back(place_of(std::span(codes).subspan(i * d, d)), static_cast<SignedIndex>(i));
  }
  std::sort(order.begin(), order.end(), [&round](const auto& a, const auto& b) {
    round();
    return a < b;
  });

  std::vector<SignedIndex> number(n, 0);
  scene.rows.clear();
  for (std::size_t at = 0; at < order.size(); ++at) {
    round();
    const auto i = static_cast<std::size_t>(order[at].second);
    const bool is_first =
        !merge || scene.rows.empty() ||
        !std::equal(
            codes.begin() + static_cast<std::ptrdiff_t>(i * d),
            codes.begin() + static_cast<std::ptrdiff_t>(i * d + d),
            codes.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(scene.rows.back()) * d));
    if (is_first) {
      scene.rows.push_back(order[at].second);
      const auto point = points.subspan(i * d, d);
      scene.vertices.insert(scene.vertices.end(), point.begin(), point.end());
    }
    number[i] = static_cast<SignedIndex>(scene.rows.size() - 1);
  }
  for (auto* items : {&scene.cells, &scene.face_vertices, &scene.segments}) renumber(*items, number);
}

void take_values(Scene& scene, const HtmlOptions& options, const ValuePlaces& places) {
  const std::vector<double>& values = options.values;
  if (values.empty()) return;
  internal::QuickRounds round;
  for (std::size_t i = 0; i < values.size(); ++i) {
    round();
    if (std::isinf(values[i])) io::fail(Errc::invalid_argument, "values: item {} is infinite", i);
  }
  const auto suits = [&](ValuesAt at, std::size_t count) {
    return values.size() == count && (options.values_at == ValuesAt::automatic || options.values_at == at);
  };
  const auto take = [&](std::span<const SignedIndex> of) {
    for (const SignedIndex i : of) scene.values.push_back(values[static_cast<std::size_t>(i)]);
  };
  if (suits(ValuesAt::points, places.num_rows)) {
    take(places.row_of);
    scene.values_of_vertices = places.of_vertices;
  } else if (suits(ValuesAt::cells, scene.num_cells)) {
    scene.values = values;
  } else if (suits(ValuesAt::facets, places.num_facets)) {
    if (places.group_of_cell.empty())
      scene.values = values;
    else
      take(places.group_of_cell);
  } else {
    io::fail(Errc::invalid_argument, "values: {} numbers for {} rows, {} {}s and {} facets", values.size(),
             places.num_rows, scene.num_cells, scene.cell_word, places.num_facets);
  }
}

}  // namespace delone::view
