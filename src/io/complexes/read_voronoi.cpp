// SPDX-License-Identifier: BSD-3-Clause
// read_voronoi: the arrays of a diagram from .npz or .json, collected by name; then their shapes must agree.
// What the numbers say is left to check_voronoi().
#include "io/collect.hpp"
#include "io/complexes/voronoi_arrays.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/text_cursor.hpp"
#include "io/zip.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace delone {
namespace io {
namespace {

using Shape = std::vector<std::size_t>;

/// The arrays that neither triangulations nor hulls have.
constexpr std::array<const char*, 2> marks{"ridge_points", "point_region"};

template <class T>
std::vector<T> items_of(const NpyArray& array, const std::string& name) {
  if constexpr (std::is_same_v<T, double>) {
    return to_doubles(array, name);
  } else {
    const std::vector<SignedIndex> items = to_indices(array, name);
    return {items.begin(), items.end()};
  }
}

template <class T>
T number_of(const nlohmann::json& value, const std::string& name) {
  if constexpr (std::is_same_v<T, double>) {
    if (value.is_null()) return std::nan("");
    if (value.is_number()) return value.get<double>();
    fail(Errc::bad_format, "{}: expected numbers, found {}", name, value.type_name());
  } else {
    if (!value.is_number_integer())
      fail(Errc::bad_format, "{}: expected integers, found {}", name, value.type_name());
    constexpr auto most = static_cast<std::int64_t>(std::numeric_limits<SignedIndex>::max());
    const bool fits = value.is_number_unsigned()
                          ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(most)
                          : value.get<std::int64_t>() >= -most;
    if (!fits) fail(Errc::bad_format, "{}: {} is not an index", name, value.dump());
    return static_cast<T>(value.get<std::int64_t>());
  }
}

/// A list of numbers, or of lists of numbers: their items, and the size of each list.
template <class T>
struct Lists {
  std::vector<T> items;
  std::vector<std::int64_t> offsets{0};
  bool is_nested = false;
};

template <class T>
Lists<T> lists_of(const nlohmann::json& value, const std::string& name) {
  if (!value.is_array()) fail(Errc::bad_format, "{}: expected a list, found {}", name, value.type_name());
  Lists<T> lists;
  for (const nlohmann::json& entry : value) {
    if (entry.is_array() != lists.is_nested && &entry != &value.front())
      fail(Errc::bad_format, "{}: numbers and lists side by side", name);
    lists.is_nested = entry.is_array();
    if (!lists.is_nested) {
      lists.items.push_back(number_of<T>(entry, name));
      continue;
    }
    for (const nlohmann::json& x : entry) lists.items.push_back(number_of<T>(x, name));
    lists.offsets.push_back(static_cast<std::int64_t>(lists.items.size()));
  }
  return lists;
}

/// What is left once all arrays are read: the shapes they were found with. JSON does not tell how many
/// columns a matrix without rows has: its shape is empty, and fits.
using Shapes = std::map<std::string, Shape>;

VoronoiData finish(VoronoiData data, const Shapes& shapes, std::optional<std::int64_t> dimension,
                   std::int64_t affine_dimension, const std::string& name) {
  const Shape& points = shapes.at("points");
  if (points.size() != 2 && !(points.empty() && dimension))
    fail(Errc::bad_format, "{}: points: expected a 2-D array, found shape {}", name, shape_text(points));
  const auto columns = points.empty() ? *dimension : static_cast<std::int64_t>(points[1]);
  if (columns < 1 || columns > std::numeric_limits<int>::max() || (dimension && *dimension != columns))
    fail(Errc::bad_dimension, "{}: the dimension is {}", name, dimension.value_or(columns));
  if (affine_dimension < -1 || affine_dimension > columns)
    fail(Errc::bad_format, "{}: affine dimension {} is impossible for points of dimension {}", name,
         affine_dimension, columns);
  data.dimension = static_cast<int>(columns);
  data.affine_dimension = static_cast<int>(affine_dimension);
  for_each_array(
      data, [&](const char* member, const auto& items, std::initializer_list<std::size_t> expected) {
        const auto found = shapes.find(member);
        if (found == shapes.end()) return;  // offsets of lists in json
        std::size_t size = 1;
        for (const std::size_t extent : expected) size *= extent;
        if (size != items.size() || (!found->second.empty() && size > 0 && found->second != Shape(expected)))
          fail(Errc::bad_format, "{}: {}: expected shape {}, as of the other arrays, found {}", name, member,
               shape_text(Shape(expected)), shape_text(found->second));
      });
  require_finite(data.points, data.dimension, name + ": points");
  require_finite(data.weights, 1, name + ": weights");
  return data;
}

VoronoiData read_npz_voronoi(std::string_view bytes, const std::string& name) {
  const ZipReader zip(bytes, name);
  VoronoiData data;
  Shapes shapes;
  const auto find = [&](const std::string& member) -> std::optional<NpyArray> {
    const auto found = zip.find(member + ".npy");
    if (!found) return std::nullopt;
    return parse_npy(*found, name + ": " + member);
  };
  const auto read = [&](const std::string& member, auto& items) {
    using Item = typename std::decay_t<decltype(items)>::value_type;
    const auto array = find(member);
    if (!array) fail(Errc::bad_format, "{}: there is no member '{}'", name, member);
    items = items_of<Item>(*array, name + ": " + member);
    shapes[member] = array->shape;
  };
  for_each_array(data, [&](const char* member, auto& items, auto) { read(member, items); });
  if (find("weights")) read("weights", data.weights);
  std::vector<SignedIndex> affine_dimension;
  read("affine_dimension", affine_dimension);
  if (affine_dimension.size() != 1) fail(Errc::bad_format, "{}: affine_dimension: expected one number", name);
  return finish(std::move(data), shapes, std::nullopt, affine_dimension[0], name);
}

VoronoiData read_json_voronoi(std::string_view bytes, const std::string& name) {
  const std::string_view text = text_of(bytes, name);
  nlohmann::json file;
  try {
    file = nlohmann::json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::exception& e) {  // of numbers beyond the range of doubles, too
    std::string_view what = e.what();             // "[json.exception.parse_error.101] parse error at …"
    if (const auto close = what.find("] "); close != std::string_view::npos) what.remove_prefix(close + 2);
    fail(Errc::bad_format, "{}: not valid JSON: {}", name, what);
  }
  if (!file.is_object()) fail(Errc::bad_format, "{}: expected an object, found {}", name, file.type_name());
  const auto find = [&](const std::string& member) -> const nlohmann::json& {
    const auto found = file.find(member);
    if (found == file.end()) fail(Errc::bad_format, "{}: there is no member '{}'", name, member);
    return *found;
  };
  VoronoiData data;
  Shapes shapes;
  const auto read = [&](const std::string& member, auto& items) {
    using Item = typename std::decay_t<decltype(items)>::value_type;
    const std::string what = name + ": " + member;
    Lists<Item> lists = lists_of<Item>(find(member), what);
    const std::size_t rows = lists.offsets.size() - 1;
    Shape& shape = shapes[member];
    if (!lists.is_nested && !lists.items.empty()) shape = {lists.items.size()};
    if (lists.is_nested) shape = {rows, static_cast<std::size_t>(lists.offsets[1])};
    for (std::size_t row = 0; row < rows; ++row)
      if (const auto size = static_cast<std::size_t>(lists.offsets[row + 1] - lists.offsets[row]);
          size != shape[1])
        fail(Errc::bad_format, "{}: row {}: expected {} numbers as in row 0, found {}", what, row, shape[1],
             size);
    items = std::move(lists.items);
  };
  const auto read_lists = [&](const std::string& member, auto& items, std::vector<std::int64_t>& offsets) {
    Lists<SignedIndex> lists = lists_of<SignedIndex>(find(member), name + ": " + member);
    if (!lists.is_nested && !lists.items.empty())
      fail(Errc::bad_format, "{}: {}: expected a list of lists", name, member);
    items = std::move(lists.items);
    offsets = std::move(lists.offsets);
  };
  for_each_array(data, [&](const std::string& member, auto& items, auto) {
    if (member == "ridge_vertices" || member == "region_vertices" || member.ends_with("_offsets")) return;
    read(member, items);
  });
  read_lists("ridge_vertices", data.ridge_vertices, data.ridge_offsets);
  read_lists("regions", data.region_vertices, data.region_offsets);
  if (file.contains("weights")) read("weights", data.weights);
  return finish(std::move(data), shapes, number_of<std::int64_t>(find("dimension"), name + ": dimension"),
                number_of<std::int64_t>(find("affine_dimension"), name + ": affine_dimension"), name);
}

}  // namespace
}  // namespace io

VoronoiData read_voronoi(const std::string& path, const std::string& format) {
  const std::string chosen =
      io::choose_format(path, format, "json", {"npz", "json"}, "reading a Voronoi diagram");
  const std::string name = io::input_name(path);
  return io::guarded(name, [&] {
    const io::Bytes file = io::read_all(path);
    return chosen == "npz" ? io::read_npz_voronoi(file.view(), name)
                           : io::read_json_voronoi(file.view(), name);
  });
}

bool holds_voronoi(const std::string& path, const std::string& format) {
  if (path == "-") return false;
  const std::string chosen =
      io::choose_format(path, format, "json", {"npz", "json", "off"}, "reading a Voronoi diagram");
  if (chosen == "off") return false;
  return io::guarded(path, [&] {
    const io::Bytes file = io::read_all(path);
    // No text that such a file may hold has quotes, but for names.
    if (chosen == "json")
      return std::all_of(io::marks.begin(), io::marks.end(), [&](const char* mark) {
        return file.view().find('"' + std::string(mark) + '"') != std::string_view::npos;
      });
    const io::ZipReader zip(file.view(), path);
    return std::all_of(io::marks.begin(), io::marks.end(), [&](const char* mark) {
      return std::any_of(zip.members().begin(), zip.members().end(), [&](const io::ZipMember& member) {
        return member.name == std::string(mark) + ".npy";
      });
    });
  });
}

}  // namespace delone
