// SPDX-License-Identifier: BSD-3-Clause
// read_halfspaces: the arrays of an intersection from .npz or .json. Each is read by name; then their shapes
// must agree.
#include "io/collect.hpp"
#include "io/complexes/intersection_arrays.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/text_cursor.hpp"
#include "io/zip.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <type_traits>
#include <vector>

namespace delone {
namespace io {
namespace {

using Shape = std::vector<std::size_t>;
using nlohmann::json;

/// The members of a file: arrays with their shapes, numbers, and the state.
class NpzMembers {
 public:
  NpzMembers(std::string_view bytes, const std::string& name) : zip_(bytes, name), name_(name) {}

  template <class T>
  Shape read(const char* member, std::vector<T>& items) const {
    const NpyArray array = find(member);
    if constexpr (std::is_same_v<T, double>)
      items = to_doubles(array, name_ + ": " + member);
    else
      items = to_indices(array, name_ + ": " + member);
    return array.shape;
  }
  std::int64_t number(const char* member) const {
    const std::vector<SignedIndex> items = to_indices(find(member), name_ + ": " + member);
    if (items.size() != 1) fail(Errc::bad_format, "{}: {}: expected one number", name_, member);
    return items[0];
  }
  std::int64_t state() const { return number("state"); }
  bool flag(const char* member) const { return number(member) != 0; }

 private:
  NpyArray find(const char* member) const {
    const auto found = zip_.find(std::string(member) + ".npy");
    if (!found) fail(Errc::bad_format, "{}: there is no member '{}'", name_, member);
    return parse_npy(*found, name_ + ": " + member);
  }

  ZipReader zip_;
  const std::string& name_;
};

class JsonMembers {
 public:
  JsonMembers(std::string_view bytes, const std::string& name) : name_(name) {
    const std::string_view text = text_of(bytes, name);
    try {
      file_ = json::parse(text.begin(), text.end());
    } catch (const json::parse_error& error) {
      fail(Errc::bad_format, "{}: not valid JSON (byte {})", name, error.byte);
    } catch (const json::out_of_range&) {
      fail(Errc::bad_format, "{}: a number is beyond the range of double precision", name);
    }
    if (!file_.is_object()) fail(Errc::bad_format, "{}: expected an object", name);
  }

  /// Without rows a matrix has the shape of a list, as the number of its columns is not told.
  template <class T>
  Shape read(const char* member, std::vector<T>& items) const {
    const json& list = find(member);
    if (!list.is_array()) fail(Errc::bad_format, "{}: {}: expected an array", name_, member);
    Shape shape{list.size()};
    for (std::size_t row = 0; row < list.size(); ++row) {
      const json& entry = list[row];
      if (row == 0 && entry.is_array()) shape.push_back(entry.size());
      if (entry.is_array() != (shape.size() == 2) || (entry.is_array() && entry.size() != shape[1]))
        fail(Errc::bad_format, "{}: {}: row {} has another shape than row 0", name_, member, row);
      if (!entry.is_array()) items.push_back(item<T>(entry, member, row));
      if (entry.is_array())
        for (const json& x : entry) items.push_back(item<T>(x, member, row));
    }
    return shape;
  }
  std::int64_t number(const char* member) const { return item<SignedIndex>(find(member), member, 0); }
  std::int64_t state() const {
    const json& entry = find("state");
    const auto at = std::find_if(state_names.begin(), state_names.end(), [&](const char* state) {
      return entry.is_string() && entry.get<std::string>() == state;
    });
    return at - state_names.begin();
  }
  bool flag(const char* member) const {
    const json& entry = find(member);
    if (!entry.is_boolean()) fail(Errc::bad_format, "{}: {}: expected true or false", name_, member);
    return entry.get<bool>();
  }

 private:
  const json& find(const char* member) const {
    const auto found = file_.find(member);
    if (found == file_.end()) fail(Errc::bad_format, "{}: there is no member '{}'", name_, member);
    return *found;
  }
  /// null stands for a coordinate beyond the doubles.
  template <class T>
  T item(const json& entry, const char* member, std::size_t row) const {
    if constexpr (std::is_same_v<T, double>) {
      if (entry.is_null()) return std::numeric_limits<double>::infinity();
      if (entry.is_number()) return entry.get<double>();
      fail(Errc::bad_format, "{}: {}: row {}: expected a number", name_, member, row);
    } else {
      const double x = entry.is_number() ? entry.get<double>() : std::numeric_limits<double>::quiet_NaN();
      if (!(x == std::floor(x) &&
            std::abs(x) <= static_cast<double>(std::numeric_limits<SignedIndex>::max())))
        fail(Errc::bad_format, "{}: {}: row {}: expected an index", name_, member, row);
      return static_cast<T>(x);
    }
  }

  const std::string& name_;
  json file_;
};

template <class Members>
IntersectionData assemble(const Members& members, const std::string& name) {
  IntersectionData data;
  const std::int64_t dimension = members.number("dimension"), rank = members.number("rank"),
                     state = members.state();
  if (dimension < 1 || dimension >= std::numeric_limits<int>::max())
    fail(Errc::bad_dimension, "{}: the dimension is {}", name, dimension);
  data.dimension = static_cast<int>(dimension);
  if (rank < 0 || rank > dimension)
    fail(Errc::bad_format, "{}: rank {} is impossible in dimension {}", name, rank, dimension);
  data.rank = static_cast<int>(rank);
  if (state < 0 || state >= static_cast<std::int64_t>(state_names.size()))
    fail(Errc::bad_format, "{}: state: expected full, flat or empty (0 to 2)", name);
  data.state = static_cast<IntersectionState>(state);
  data.bounded = members.flag("bounded");
  data.interior_point_is_exact = members.flag("interior_point_is_exact");

  std::vector<SignedIndex> axes, kinds;
  std::map<std::string, Shape> shapes;
  for_each_array(data, axes, kinds, [&](const char* member, auto& items, std::initializer_list<std::size_t>) {
    shapes[member] = members.read(member, items);
  });
  for_each_array(
      data, axes, kinds,
      [&](const char* member, const auto& items, std::initializer_list<std::size_t> expected) {
        const Shape& found = shapes[member];
        if (found != Shape(expected) && !(items.empty() && (expected.size() == 0 || *expected.begin() == 0)))
          fail(Errc::bad_format, "{}: {}: expected shape {}, as of the other arrays, found {}", name, member,
               shape_text(Shape(expected)), shape_text(found));
      });
  require_finite(data.halfspaces, data.dimension + 1, name + ": halfspaces");
  for (std::size_t row = 0; row < kinds.size(); ++row) {
    if (kinds[row] < 0 || kinds[row] > static_cast<SignedIndex>(HalfspaceKind::trivial))
      fail(Errc::bad_format, "{}: kinds: row {}: {} is no kind of halfspace, which are 0 to 4", name, row,
           kinds[row]);
    data.kinds.push_back(static_cast<HalfspaceKind>(kinds[row]));
  }
  data.axes.assign(axes.begin(), axes.end());
  return data;
}

}  // namespace

IntersectionData read_intersection_in(const std::string& format, std::string_view bytes,
                                      const std::string& name) {
  return format == "npz" ? assemble(NpzMembers(bytes, name), name) : assemble(JsonMembers(bytes, name), name);
}

}  // namespace io

IntersectionData read_halfspaces(const std::string& path, const std::string& format) {
  const std::string chosen =
      io::choose_format(path, format, "json", {"npz", "json"}, "reading an intersection");
  const std::string name = io::input_name(path);
  return io::guarded(name, [&] {
    const io::Bytes file = io::read_all(path);
    return io::read_intersection_in(chosen, file.view(), name);
  });
}

}  // namespace delone
