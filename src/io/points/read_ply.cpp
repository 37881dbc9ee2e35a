// SPDX-License-Identifier: BSD-3-Clause
// The vertices of a PLY file (Stanford triangle format), ascii and binary of either byte order. Elements
// before the vertices and properties that are not needed are skipped, lists included.
#include "io/collect.hpp"
#include "io/file.hpp"
#include "io/points/read_points.hpp"
#include "io/text_cursor.hpp"
#include "messages/in_quotes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

namespace delone::io {

namespace {

enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(ScalarType type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

struct Property {
  std::string name;
  ScalarType type = ScalarType::float32;
  bool is_list = false;
  ScalarType count_type = ScalarType::uint8;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

ScalarType parse_type(const TextCursor& at, std::string_view text) {
  constexpr std::array<std::array<std::string_view, 2>, 8> names{{{"char", "int8"},
                                                                  {"uchar", "uint8"},
                                                                  {"short", "int16"},
                                                                  {"ushort", "uint16"},
                                                                  {"int", "int32"},
                                                                  {"uint", "uint32"},
                                                                  {"float", "float32"},
                                                                  {"double", "float64"}}};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (text == names[i][0] || text == names[i][1]) return static_cast<ScalarType>(i);
  fail(Errc::bad_format, "{}: {} is not a type of PLY", at.place(), messages::in_quotes(text));
}

/// The next word of this line of the header.
std::string word(TextCursor& at) {
  at.skip_blanks();
  const char* start = at.position();
  while (!at.at_line_end() && !TextCursor::is_blank(*at.position())) at.move_to(at.position() + 1);
  return {start, at.position()};
}

Property parse_property(TextCursor& at) {
  Property property;
  std::string type = word(at);
  if (type == "list") {
    property.is_list = true;
    property.count_type = parse_type(at, word(at));
    if (property.count_type >= ScalarType::float32)
      fail(Errc::bad_format, "{}: the length of a list must be an integer", at.place());
    type = word(at);
  }
  property.type = parse_type(at, type);
  property.name = word(at);
  if (property.name.empty()) fail(Errc::bad_format, "{}: a property without a name", at.place());
  return property;
}

/// Leaves the cursor at the first byte of the data.
Header parse_header(TextCursor& at) {
  Header header;
  if (word(at) != "ply")
    fail(Errc::bad_format, "{}: not a PLY file (the first line is not 'ply')", at.name());
  bool has_format = false;
  for (;;) {
    at.skip_to_line_end();
    if (at.at_end()) fail(Errc::bad_format, "{}: the file ends before 'end_header'", at.place());
    at.take_line_end();
    const std::string keyword = word(at);
    if (keyword == "format") {
      const std::string encoding = word(at), version = word(at);
      if (encoding == "ascii")
        header.encoding = Encoding::ascii;
      else if (encoding == "binary_little_endian")
        header.encoding = Encoding::little_endian;
      else if (encoding == "binary_big_endian")
        header.encoding = Encoding::big_endian;
      else
        fail(Errc::unsupported, "{}: the PLY format {} is not supported", at.place(),
             messages::in_quotes(encoding));
      if (version != "1.0")
        fail(Errc::unsupported, "{}: PLY version {} is not supported", at.place(),
             messages::in_quotes(version));
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      element.name = word(at);
      const std::string count = word(at);
      const auto value = to_count(count);
      if (!value) fail(Errc::bad_format, "{}: {} is not a count", at.place(), messages::in_quotes(count));
      element.count = *value;
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) fail(Errc::bad_format, "{}: a property before any element", at.place());
      header.elements.back().properties.push_back(parse_property(at));
    } else if (keyword == "end_header") {
      break;
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      fail(Errc::bad_format, "{}: {} does not belong in a PLY header", at.place(),
           messages::in_quotes(keyword));
    }
  }
  if (!has_format) fail(Errc::bad_format, "{}: the header has no 'format' line", at.place());
  at.skip_to_line_end();
  at.take_line_end();
  return header;
}

/// Reads the values of an ascii file.
class AsciiSource {
 public:
  explicit AsciiSource(TextCursor at) : at_(std::move(at)) {}
  bool done() { return !at_.find_content(); }
  double value(ScalarType) { return at_.number("a value"); }
  std::uint64_t list_length(ScalarType) {
    return at_.count("the length of a list", std::numeric_limits<std::uint64_t>::max());
  }
  void skip_value(ScalarType) { at_.token(); }
  std::string place(std::uint64_t) const { return at_.place(); }
  /// Lists must be walked through, and here so must everything.
  bool try_skip(std::uint64_t, std::uint64_t) { return false; }
  std::size_t most_values() const { return at_.remaining() / 2 + 1; }

 private:
  TextCursor at_;
};

/// Reads the values of a binary file.
class BinarySource {
 public:
  BinarySource(std::string_view bytes, std::string name, bool big_endian)
      : bytes_(bytes),
        name_(std::move(name)),
        swap_(big_endian != (std::endian::native == std::endian::big)) {}

  bool done() const { return bytes_.empty(); }
  double value(ScalarType type) {
    switch (type) {
      case ScalarType::int8:
        return take<std::int8_t>();
      case ScalarType::uint8:
        return take<std::uint8_t>();
      case ScalarType::int16:
        return take<std::int16_t>();
      case ScalarType::uint16:
        return take<std::uint16_t>();
      case ScalarType::int32:
        return take<std::int32_t>();
      case ScalarType::uint32:
        return take<std::uint32_t>();
      case ScalarType::float32:
        return static_cast<double>(take<float>());
      default:
        return take<double>();
    }
  }
  std::uint64_t list_length(ScalarType type) {
    const double length = value(type);
    if (length < 0) fail(Errc::bad_format, "{}: a list of negative length", name_);
    return static_cast<std::uint64_t>(length);
  }
  void skip_value(ScalarType type) { skip(size_of(type)); }
  std::string place(std::uint64_t row) const { return fmt::format("{}: vertex {}", name_, row); }
  /// Skips `count` records of `size` bytes at once.
  bool try_skip(std::uint64_t count, std::uint64_t size) {
    if (size != 0 && count > bytes_.size() / size)
      fail(Errc::bad_format, "{}: the file ends in the middle of a record", name_);
    skip(static_cast<std::size_t>(count * size));
    return true;
  }
  std::size_t most_values() const { return bytes_.size(); }

 private:
  void skip(std::size_t size) {
    if (size > bytes_.size()) fail(Errc::bad_format, "{}: the file ends in the middle of a record", name_);
    bytes_.remove_prefix(size);
  }
  template <class T>
  T take() {
    char item[sizeof(T)] = {};
    const char* p = bytes_.data();
    skip(sizeof(T));
    if (swap_)
      std::reverse_copy(p, p + sizeof(T), item);
    else
      std::memcpy(item, p, sizeof(T));
    return std::bit_cast<T>(item);
  }

  std::string_view bytes_;
  std::string name_;
  bool swap_;
};

template <class Source>
void skip_property(Source& source, const Property& property) {
  std::uint64_t length = 1;
  if (property.is_list) {
    length = source.list_length(property.count_type);
    if (source.try_skip(length, size_of(property.type))) return;
  }
  for (std::uint64_t i = 0; i < length; ++i) {
    if (source.done()) fail(Errc::bad_format, "{}: the file ends in the middle of a record", source.place(0));
    source.skip_value(property.type);
  }
}

template <class Source>
void skip_element(Source& source, const Element& element) {
  if (element.properties.empty()) return;
  std::uint64_t size = 0;
  bool fixed = true;
  for (const Property& property : element.properties) {
    size += size_of(property.type);
    fixed = fixed && !property.is_list;
  }
  if (fixed && source.try_skip(element.count, size)) return;
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties) skip_property(source, property);
}

/// The positions of the properties to read.
std::vector<std::size_t> select(const Element& vertex, const ColumnChoice& choice, const std::string& name) {
  std::vector<std::string> available;
  for (const Property& property : vertex.properties)
    available.push_back(property.is_list ? std::string{} : property.name);
  const auto position = [&](const std::string& one) {
    return static_cast<std::size_t>(std::find(available.begin(), available.end(), one) - available.begin());
  };
  std::vector<std::string> names = choice.wanted;
  if (names.empty()) {
    names = {"x", "y"};
    if (position("z") < available.size()) names.push_back("z");
    std::erase_if(names, [&](const std::string& one) {
      return std::find(choice.last.begin(), choice.last.end(), one) != choice.last.end();
    });
  }
  names.insert(names.end(), choice.last.begin(), choice.last.end());
  std::vector<std::size_t> columns;
  for (const std::string& one : names) {
    if (position(one) == available.size() || one.empty()) {
      std::erase(available, std::string{});
      fail(Errc::bad_format, "{}: columns: the vertices have no property {}; they have {}", name,
           messages::in_quotes(one), joined(available));
    }
    columns.push_back(position(one));
  }
  return columns;
}

template <class Source>
PointTable read_vertices(Source source, const Header& header, const std::string& name,
                         const ColumnChoice& choice, Missing missing) {
  auto vertex = header.elements.begin();
  for (; vertex != header.elements.end() && vertex->name != "vertex"; ++vertex) skip_element(source, *vertex);
  if (vertex == header.elements.end()) fail(Errc::bad_format, "{}: the file has no element 'vertex'", name);
  const std::vector<std::size_t> columns = select(*vertex, choice, name);
  PointCollector points(missing);
  points.table.dimension = static_cast<int>(columns.size());
  points.table.num_values = static_cast<int>(choice.last.size());
  for (const std::size_t column : columns)
    points.table.column_names.push_back(vertex->properties[column].name);
  if (vertex->count <= source.most_values() / columns.size())
    points.table.coordinates.reserve(static_cast<std::size_t>(vertex->count) * columns.size());
  std::vector<bool> selected(vertex->properties.size(), false);
  for (const std::size_t column : columns) selected[column] = true;
  std::vector<double> row(vertex->properties.size());
  for (std::uint64_t i = 0; i < vertex->count; ++i) {
    for (std::size_t p = 0; p < vertex->properties.size(); ++p) {
      if (source.done())
        fail(Errc::bad_format, "{}: expected {} vertices, the file ends after {}", name, vertex->count, i);
      if (selected[p])
        row[p] = source.value(vertex->properties[p].type);
      else
        skip_property(source, vertex->properties[p]);
    }
    for (const std::size_t column : columns)
      points.add(row[column], [&] {
        return fmt::format("{}: {}: {} is not finite", source.place(i),
                           printable(vertex->properties[column].name), row[column]);
      });
  }
  return points.finish();
}

}  // namespace

PointTable read_ply(std::string_view bytes, const std::string& name, const ColumnChoice& choice,
                    Missing missing) {
  if (bytes.empty()) fail(Errc::bad_format, "{}: the file is empty", name);
  TextCursor at(bytes, name);
  const Header header = parse_header(at);
  if (header.encoding == Encoding::ascii)
    return read_vertices(AsciiSource(at), header, name, choice, missing);
  const std::string_view data = bytes.substr(static_cast<std::size_t>(at.position() - bytes.data()));
  return read_vertices(BinarySource(data, name, header.encoding == Encoding::big_endian), header, name,
                       choice, missing);
}

}  // namespace delone::io
