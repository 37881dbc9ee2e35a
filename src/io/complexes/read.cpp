// SPDX-License-Identifier: BSD-3-Clause
// read() and read_as(): what a file holds is told by its member `kind` or else by its arrays. They are read
// by name; then their shapes must agree. What the numbers say is left to check().
#include "io/collect.hpp"
#include "io/complexes/arrays.hpp"
#include "io/complexes/json_file.hpp"
#include "io/complexes/npz_file.hpp"
#include "io/file.hpp"
#include "io/known_kind.hpp"
#include "io/npy.hpp"
#include "io/points/off.hpp"
#include "io/text_cursor.hpp"

#include <delone/io.hpp>

#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

namespace delone {
namespace io {
namespace {

using Shape = std::vector<std::size_t>;

/// The alternatives of AnyData as numbers, in its order.
enum Type : std::size_t { complex, hull, intersection, diagram };
constexpr std::array<const char*, 4> type_names{
    "a triangulation", "a convex hull", "an intersection of halfspaces", "a Voronoi or power diagram"};

template <class Data>
constexpr Type type_of_data = std::is_same_v<Data, ComplexData>        ? complex
                              : std::is_same_v<Data, HullData>         ? hull
                              : std::is_same_v<Data, IntersectionData> ? intersection
                                                                       : diagram;

/// What a file says that it holds; `unknown` if it does not say.
template <class File>
DataKind kind_of(const File& file) {
  const std::optional<std::string> name = file.find_text("kind");
  return name ? known_kind(*name, file.name()) : DataKind::unknown;
}

template <class File>
Type type_of(const File& file, DataKind kind) {
  if (kind != DataKind::unknown)
    return fits<ComplexData>(kind)        ? complex
           : fits<HullData>(kind)         ? hull
           : fits<IntersectionData>(kind) ? intersection
                                          : diagram;
  if (file.has("first_of_halfspace")) return intersection;
  if (file.has("ridge_points") && file.has("point_region")) return diagram;
  return file.has("facet_of_cell") ? hull : complex;
}

template <class File>
[[noreturn]] void fail_missing(const File& file, std::string_view member) {
  fail(Errc::bad_format, "{}: there is no member {}; the members are {}", file.name(), member,
       joined(file.members()));
}

/// Reads all arrays, and keeps the shapes that they were found with.
template <class File>
class ArrayReader {
 public:
  explicit ArrayReader(File& file) : file_(file) {}

  template <class T>
  void operator()(const Array& array, std::vector<T>& items, std::initializer_list<std::size_t> shape) {
    std::string member = array.name;
    if (!file_.has(member) && array.other_name != nullptr) member = array.other_name;
    if (!file_.has(member)) {
      if (!array.required) return;
      fail_missing(file_, array.other_name == nullptr
                              ? fmt::format("'{}'", array.name)
                              : fmt::format("'{}' (or '{}')", array.name, array.other_name));
    }
    Shape& found = shapes_[array.name];
    if constexpr (std::is_same_v<T, double>)
      items = file_.template read<double>(member, shape.size(), !array.finite, found);
    else
      convert(file_.template read<SignedIndex>(member, shape.size(), false, found), items, member);
  }

  template <class Offset>
  void lists(const Lists& lists, std::vector<Offset>& offsets, std::vector<SignedIndex>& items) {
    if constexpr (File::nests_lists && std::is_same_v<Offset, std::int64_t>) {
      if (!file_.has(lists.nested)) fail_missing(file_, fmt::format("'{}'", lists.nested));
      items = file_.read_lists(lists.nested, offsets);
    } else {
      (*this)(Array{lists.offsets}, offsets, {0});
      (*this)(Array{lists.items}, items, {0});
    }
  }

  /// Null if the array is not in the file.
  const Shape* shape(const char* array) const {
    const auto found = shapes_.find(array);
    return found == shapes_.end() ? nullptr : &found->second;
  }

 private:
  template <class T>
  void convert(std::vector<SignedIndex>&& numbers, std::vector<T>& items, const std::string& member) const {
    if constexpr (std::is_same_v<T, SignedIndex>) {
      items = std::move(numbers);
    } else {
      items.clear();
      items.reserve(numbers.size());
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] < least_number<T> || numbers[i] > largest_number<T>)
          fail(Errc::bad_format, "{}: {}: row {}: expected a number from {} to {}, found {}", file_.name(),
               member, i, least_number<T>, largest_number<T>, numbers[i]);
        items.push_back(static_cast<T>(numbers[i]));
      }
    }
  }

  File& file_;
  std::map<std::string, Shape> shapes_;
};

/// Compares the shapes that were found with those that the other arrays require. Only an empty array of JSON
/// does not tell its columns.
template <class File>
class ShapeChecker {
 public:
  ShapeChecker(const ArrayReader<File>& read, const std::string& name) : read_(read), name_(name) {}

  template <class T>
  void operator()(const Array& array, const std::vector<T>& items,
                  std::initializer_list<std::size_t> expected) const {
    const Shape* const found = read_.shape(array.name);
    if (found == nullptr) return;
    std::size_t size = 1;
    for (const std::size_t extent : expected) size *= extent;
    if (size != items.size() || (size > 0 && *found != Shape(expected)))
      fail(Errc::bad_format, "{}: {}: expected shape {}, as of the other arrays, found {}", name_, array.name,
           shape_text(Shape(expected)), shape_text(*found));
    if constexpr (std::is_same_v<T, double>)
      if (array.finite)
        require_finite(items, expected.size() == 2 ? static_cast<int>(expected.begin()[1]) : 1,
                       name_ + ": " + array.name);
  }
  template <class Offset>
  void lists(const Lists&, const std::vector<Offset>&, const std::vector<SignedIndex>&) const {}

 private:
  const ArrayReader<File>& read_;
  const std::string& name_;
};

/// d and k, from the points, `affine_dimension` and, in JSON, `dimension`.
template <class Data, class File>
void set_dimensions(Data& data, const File& file, const ArrayReader<File>& read) {
  const std::string& name = file.name();
  const Shape& points = *read.shape("points");
  const std::optional<std::int64_t> given =
      File::tells_columns ? std::nullopt : file.find_number("dimension");
  if (points.size() < 2 && !given)
    fail(Errc::bad_format, "{}: without points the member 'dimension' is needed", name);
  const std::int64_t dimension = given ? *given : static_cast<std::int64_t>(points[1]);
  if (dimension < 1 || dimension >= std::numeric_limits<int>::max())
    fail(Errc::bad_dimension, "{}: points: shape {}: the dimension is {}", name, shape_text(points),
         dimension);
  if (points.size() == 2 && static_cast<std::int64_t>(points[1]) != dimension)
    fail(Errc::bad_format, "{}: points: expected {} columns as 'dimension' says, found {}", name, dimension,
         points[1]);
  data.dimension = static_cast<int>(dimension);

  std::optional<std::int64_t> affine_dimension = file.find_number("affine_dimension");
  if constexpr (std::is_same_v<Data, ComplexData>) {
    const Shape& cells = *read.shape("cells");
    const std::size_t corners = cells.size() == 2 ? cells[1] : 0;
    if (cells[0] > 0 && corners == 0)
      fail(Errc::bad_format, "{}: cells: {} rows without vertices", name, cells[0]);
    if (!affine_dimension) affine_dimension = static_cast<std::int64_t>(corners) - 1;
    if (cells[0] > 0 && *affine_dimension >= -1 && *affine_dimension <= dimension &&
        static_cast<std::int64_t>(corners) != *affine_dimension + 1)
      fail(Errc::bad_format, "{}: cells: expected {} columns for affine dimension {}, found {}", name,
           *affine_dimension + 1, *affine_dimension, corners);
  }
  if (!affine_dimension) fail_missing(file, "'affine_dimension'");
  if (*affine_dimension < -1 || *affine_dimension > dimension)
    fail(Errc::bad_format, "{}: affine dimension {} is impossible for points of dimension {}", name,
         *affine_dimension, dimension);
  data.affine_dimension = static_cast<int>(*affine_dimension);
}

/// The members of an intersection that are no arrays.
template <class File>
void read_scalars(IntersectionData& data, const File& file) {
  const std::string& name = file.name();
  const auto need = [&](const char* member, const auto& found) {
    if (!found) fail_missing(file, fmt::format("'{}'", member));
    return *found;
  };
  const std::int64_t dimension = need("dimension", file.find_number("dimension")),
                     rank = need("rank", file.find_number("rank"));
  if (dimension < 1 || dimension >= std::numeric_limits<int>::max())
    fail(Errc::bad_dimension, "{}: the dimension is {}", name, dimension);
  if (rank < 0 || rank > dimension)
    fail(Errc::bad_format, "{}: rank {} is impossible in dimension {}", name, rank, dimension);
  const std::size_t state = need("state", file.find_choice("state", state_names));
  if (state >= std::size(state_names))
    fail(Errc::bad_format, "{}: state: expected full, flat or empty (0 to 2)", name);
  data.dimension = static_cast<int>(dimension);
  data.rank = static_cast<int>(rank);
  data.state = static_cast<IntersectionState>(state);
  data.bounded = need("bounded", file.find_flag("bounded"));
  data.interior_point_is_exact = need("interior_point_is_exact", file.find_flag("interior_point_is_exact"));
}

template <class Data, class File>
Data read_arrays(File& file, DataKind kind = DataKind::unknown) {
  Data data;
  if constexpr (std::is_same_v<Data, ComplexData>) data.kind = kind;
  ArrayReader reader(file);
  if constexpr (std::is_same_v<Data, IntersectionData>) {
    read_scalars(data, file);
    for_each_array(data, reader);
  } else {
    for_each_array(data, reader);
    set_dimensions(data, file, reader);
    data.column_names = file.find_texts("column_names");
    if (!data.column_names.empty() && data.column_names.size() != static_cast<std::size_t>(data.dimension))
      fail(Errc::bad_format, "{}: column_names: expected {} of them, found {}", file.name(), data.dimension,
           data.column_names.size());
  }
  for_each_array(data, ShapeChecker(reader, file.name()));
  if constexpr (std::is_same_v<Data, HullData>)
    if (data.axes.empty() && data.affine_dimension == data.dimension) {  // the only ones there are
      data.axes.resize(static_cast<std::size_t>(data.dimension));
      std::iota(data.axes.begin(), data.axes.end(), 0);
    }
  return data;
}

void require_type(Type found, std::optional<Type> wanted, DataKind kind, const std::string& name) {
  if (wanted && found != *wanted)
    fail(Errc::bad_format, "{}: the file holds {}, not {}", name,
         kind == DataKind::unknown ? type_names[found] : description_of(kind), type_names[*wanted]);
}

template <class File>
AnyData read_file(File file, std::optional<Type> wanted) {
  const DataKind kind = kind_of(file);
  const Type type = type_of(file, kind);
  require_type(type, wanted, kind, file.name());
  switch (type) {
    case hull:
      return read_arrays<HullData>(file);
    case intersection:
      return read_arrays<IntersectionData>(file);
    case diagram: {
      VoronoiData data = read_arrays<VoronoiData>(file);
      data.kind = kind != DataKind::unknown ? kind
                  : data.weights.empty()    ? DataKind::voronoi
                                            : DataKind::power_diagram;
      return data;
    }
    default:
      return read_arrays<ComplexData>(file, kind);
  }
}

/// Refuses what cannot be of this format by its first bytes. Where the first word is wrong the reader says
/// so.
void check_opening(const std::string& format, std::string_view opening, bool is_whole,
                   const std::string& name) {
  if (is_whole) return;
  if (format == "npz") return require_zip(opening, name);
  const std::string_view text = text_of(opening, name);
  require_text(text, name);
  if (format == "off") {
    TextCursor at(text, name);
    if (const std::string_view word = at.next_token(); !at.at_end() && !word.ends_with("OFF"))
      read_off_complex(text, name);
  } else if (const auto first = text.find_first_not_of(" \t\r\n");
             first != std::string_view::npos && text[first] != '{') {
    JsonFile(text, name);
  }
}

AnyData read_any(const std::string& path, const std::string& format, std::optional<Type> wanted,
                 std::uint64_t max_stream_bytes) {
  refuse_folder(path, "a file");
  const std::string chosen =
      choose_format(path, format, "json", {"npz", "json", "off"}, Use::reading, "anything but points");
  const std::string name = input_name(path);
  return guarded(name, [&]() -> AnyData {
    const Bytes bytes = read_all(path, max_stream_bytes, [&](std::string_view opening, bool is_whole) {
      check_opening(chosen, opening, is_whole, name);
    });
    if (chosen == "npz") return read_file(NpzFile(bytes.view(), name), wanted);
    if (chosen == "json") return read_file(JsonFile(bytes.view(), name), wanted);
    require_type(complex, wanted, DataKind::unknown, name);
    return read_off_complex(bytes.view(), name);
  });
}

}  // namespace
}  // namespace io

AnyData read(const std::string& path, const std::string& format, std::uint64_t max_stream_bytes) {
  return io::read_any(path, format, std::nullopt, max_stream_bytes);
}

template <PlainData Data>
Data read_as(const std::string& path, const std::string& format, std::uint64_t max_stream_bytes) {
  return std::get<Data>(io::read_any(path, format, io::type_of_data<Data>, max_stream_bytes));
}
template ComplexData read_as(const std::string&, const std::string&, std::uint64_t);
template HullData read_as(const std::string&, const std::string&, std::uint64_t);
template IntersectionData read_as(const std::string&, const std::string&, std::uint64_t);
template VoronoiData read_as(const std::string&, const std::string&, std::uint64_t);

}  // namespace delone
