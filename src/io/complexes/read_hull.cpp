// SPDX-License-Identifier: BSD-3-Clause
// read_hull: the arrays of a hull from .npz or .json. All are collected by name first; then their shapes must
// agree.
#include "io/collect.hpp"
#include "io/complexes/hull_arrays.hpp"
#include "io/complexes/intersection_arrays.hpp"
#include "io/complexes/raw_complex.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/text_cursor.hpp"
#include "io/zip.hpp"

#include <delone/io.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace delone {
namespace io {
namespace {

using Shape = std::vector<std::size_t>;

/// The items of an array of a file, as numbers or indices.
template <class T>
std::vector<T> items_of(const NpyArray& array, const std::string& name) {
  if constexpr (std::is_same_v<T, double>)
    return to_doubles(array, name);
  else
    return to_indices(array, name);
}

/// An array of JSON: a list of numbers, or of lists of numbers. A single number has no shape.
struct JsonArray {
  std::vector<double> items;
  Shape shape;
};

template <class T>
std::vector<T> items_of(const JsonArray& array, const std::string& name) {
  if constexpr (std::is_same_v<T, double>) return array.items;
  std::vector<T> items;
  items.reserve(array.items.size());
  for (const double x : array.items) {
    if (!(x == std::floor(x) && std::fabs(x) <= static_cast<double>(std::numeric_limits<SignedIndex>::max())))
      fail(Errc::bad_format, "{}: {} is not an index", name, x);
    items.push_back(static_cast<T>(x));
  }
  return items;
}

/// Members of an object that are numbers or arrays of numbers of up to two dimensions; null is infinity.
class ArrayHandler : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit ArrayHandler(const std::string& name) : name_(name) {}
  std::map<std::string, JsonArray> arrays;

  bool start_object(std::size_t) override { return at_top_ ? wrong("an object") : (at_top_ = true); }
  bool end_object() override { return true; }
  bool key(std::string& key) override {
    member_ = key;
    depth_ = 0;
    const auto [at, is_new] = arrays.try_emplace(key);
    if (!is_new) fail(Errc::bad_format, "{}: the member {} appears twice", name_, in_quotes(key));
    array_ = &at->second;
    return true;
  }
  bool start_array(std::size_t) override {
    if (array_ == nullptr || ++depth_ > 2) return wrong("an array");
    if (depth_ == 1) array_->shape = {0};
    if (depth_ == 2) {
      if (array_->shape.size() == 1 && array_->shape[0] > 0) return wrong("an array");
      row_size_ = 0;
    }
    return true;
  }
  bool end_array() override {
    if (depth_-- < 2) return true;
    Shape& shape = array_->shape;
    if (shape.size() == 1) shape.push_back(row_size_);
    if (shape[1] != row_size_)
      fail(Errc::bad_format, "{}: {}: row {}: expected {} numbers as in row 0, found {}", name_, member_,
           shape[0], shape[1], row_size_);
    ++shape[0];
    return true;
  }
  bool null() override { return number(std::numeric_limits<double>::infinity()); }
  bool number_integer(std::int64_t x) override { return number(static_cast<double>(x)); }
  bool number_unsigned(std::uint64_t x) override { return number(static_cast<double>(x)); }
  bool number_float(double x, const std::string&) override { return number(x); }
  bool boolean(bool) override { return wrong("a boolean"); }
  bool string(std::string& text) override { return wrong("the string " + in_quotes(text)); }
  bool binary(nlohmann::json::binary_t&) override { return true; }  // text has none
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception& error) override {
    std::string_view what = error.what();  // "[json.exception.parse_error.101] parse error at …"
    if (const auto close = what.find("] "); close != std::string_view::npos) what.remove_prefix(close + 2);
    fail(Errc::bad_format, "{}: not valid JSON (byte {}): {}", name_, position, what);
  }

 private:
  bool number(double x) {
    if (array_ == nullptr || (depth_ == 1 && array_->shape.size() == 2)) return wrong("a number");
    array_->items.push_back(x);
    if (depth_ == 1) ++array_->shape[0];
    if (depth_ == 2) ++row_size_;
    return true;
  }
  bool wrong(const std::string& found) const {
    fail(Errc::bad_format, "{}: {}: {} is not expected there", name_, member_.empty() ? "the file" : member_,
         found);
  }

  const std::string& name_;
  bool at_top_ = false;
  std::string member_;
  JsonArray* array_ = nullptr;
  int depth_ = 0;
  std::size_t row_size_ = 0;
};

/// `find(member)` gives an optional array, with its shape.
template <class Find>
HullData assemble_hull(const std::string& name, Find find) {
  HullData data;
  std::vector<SignedIndex> kinds;
  std::map<std::string, Shape> shapes;
  for_each_array(
      data, kinds,
      [&]<class T>(const char* member, std::vector<T>& items, std::initializer_list<std::size_t> expected) {
        const auto array = find(member);
        if (!array) fail(Errc::bad_format, "{}: there is no member '{}'", name, member);
        Shape& shape = shapes[member] = array->shape;
        items = items_of<T>(*array, name + ": " + member);
        // JSON does not tell how many columns a matrix without rows has.
        if (items.empty() && shape == Shape{0} && expected.size() == 2) shape.clear();
        if (!shape.empty() && shape.size() != expected.size())
          fail(Errc::bad_format, "{}: {}: expected {} dimension(s), found shape {}", name, member,
               expected.size(), shape_text(shape));
      });
  const auto scalar = [&](const char* member) -> std::optional<SignedIndex> {
    const auto array = find(member);
    if (!array) return std::nullopt;
    const std::vector<SignedIndex> items = items_of<SignedIndex>(*array, name + ": " + member);
    if (items.size() != 1) fail(Errc::bad_format, "{}: {}: expected one number", name, member);
    return items[0];
  };
  const std::optional<SignedIndex> affine_dimension = scalar("affine_dimension"),
                                   dimension = scalar("dimension");
  if (!affine_dimension) fail(Errc::bad_format, "{}: there is no member 'affine_dimension'", name);
  const Shape& points = shapes["points"];
  if (points.empty() && !dimension)
    fail(Errc::bad_format, "{}: without points the member 'dimension' is needed", name);
  const std::size_t columns =
      points.empty() ? static_cast<std::size_t>(std::max<SignedIndex>(*dimension, 0)) : points[1];
  if (columns < 1 || columns > static_cast<std::size_t>(std::numeric_limits<int>::max()) ||
      (dimension && static_cast<std::size_t>(*dimension) != columns))
    fail(Errc::bad_dimension, "{}: the dimension is {}", name,
         dimension ? static_cast<std::size_t>(*dimension) : columns);
  data.dimension = static_cast<int>(columns);
  if (*affine_dimension < -1 || *affine_dimension > data.dimension)
    fail(Errc::bad_format, "{}: affine dimension {} is impossible for points of dimension {}", name,
         *affine_dimension, data.dimension);
  data.affine_dimension = static_cast<int>(*affine_dimension);
  for_each_array(data, kinds,
                 [&](const char* member, const auto& items, std::initializer_list<std::size_t> expected) {
                   const Shape& shape = shapes[member];
                   std::size_t size = 1;
                   for (const std::size_t extent : expected) size *= extent;
                   if (size != items.size() || (!shape.empty() && size > 0 && shape != Shape(expected)))
                     fail(Errc::bad_format, "{}: {}: expected shape {}, as of the other arrays, found {}",
                          name, member, shape_text(Shape(expected)), shape_text(shape));
                 });
  require_finite(data.points, data.dimension, name + ": points");
  for (std::size_t row = 0; row < kinds.size(); ++row) {
    if (kinds[row] < 0 || kinds[row] > static_cast<SignedIndex>(PointKind::duplicate))
      fail(Errc::bad_format, "{}: point_kinds: row {}: {} is no kind of point, which are 0 to 3", name, row,
           kinds[row]);
    data.point_kinds.push_back(static_cast<PointKind>(kinds[row]));
  }
  return data;
}

HullData read_npz_hull(std::string_view bytes, const std::string& name) {
  const ZipReader zip(bytes, name);
  return assemble_hull(name, [&](const std::string& member) -> std::optional<NpyArray> {
    const auto found = zip.find(member + ".npy");
    if (!found) return std::nullopt;
    return parse_npy(*found, name + ": " + member);
  });
}

HullData read_json_hull(std::string_view bytes, const std::string& name) {
  const std::string_view text = text_of(bytes, name);
  ArrayHandler handler(name);
  nlohmann::json::sax_parse(text.begin(), text.end(), &handler);
  return assemble_hull(name, [&](const std::string& member) -> std::optional<JsonArray> {
    const auto found = handler.arrays.find(member);
    if (found == handler.arrays.end()) return std::nullopt;
    return std::move(found->second);
  });
}

bool holds_array(const char* array, std::string_view bytes, const std::string& format,
                 const std::string& name) {
  // No text that these files may hold has quotes, but for names.
  if (format == "json") return bytes.find('"' + std::string(array) + '"') != std::string_view::npos;
  if (format != "npz") return false;
  const ZipReader zip(bytes, name);
  for (const ZipMember& member : zip.members())
    if (member.name == std::string(array) + ".npy") return true;
  return false;
}

}  // namespace
}  // namespace io

HullData read_hull(const std::string& path, const std::string& format) {
  const std::string chosen = io::choose_format(path, format, "json", {"npz", "json"}, "reading a hull");
  const std::string name = io::input_name(path);
  return io::guarded(name, [&] {
    const io::Bytes file = io::read_all(path);
    return chosen == "npz" ? io::read_npz_hull(file.view(), name) : io::read_json_hull(file.view(), name);
  });
}

std::variant<ComplexData, HullData, IntersectionData> read_any(const std::string& path,
                                                               const std::string& format) {
  using Result = std::variant<ComplexData, HullData, IntersectionData>;
  const std::string chosen = io::choose_format(path, format, "json", {"npz", "json", "off"},
                                               "reading a triangulation, a hull or an intersection");
  const std::string name = io::input_name(path);
  return io::guarded(name, [&]() -> Result {
    const io::Bytes file = io::read_all(path);
    if (io::holds_array(io::intersection_mark, file.view(), chosen, name))
      return io::read_intersection_in(chosen, file.view(), name);
    if (!io::holds_array(io::hull_mark, file.view(), chosen, name))
      return io::read_complex_in(chosen, file.view(), name);
    return chosen == "npz" ? io::read_npz_hull(file.view(), name) : io::read_json_hull(file.view(), name);
  });
}

}  // namespace delone
