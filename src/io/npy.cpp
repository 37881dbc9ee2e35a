// SPDX-License-Identifier: BSD-3-Clause
// The .npy format: header, sizes, conversion of items. See npy.hpp.
#include "io/npy.hpp"

#include "io/file.hpp"
#include "io/text_cursor.hpp"
#include "io/utf8.hpp"
#include "io/write_npy.hpp"
#include "messages/in_quotes.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace delone::io {

namespace {

/// The header is the text of a Python dictionary with string keys; the values are a string, a boolean and a
/// tuple of integers. Anything else (a list of fields, say) is seen as `other`.
class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  struct Header {
    std::string descr;
    bool fortran_order = false;
    std::vector<std::size_t> shape;
  };

  Header parse() {
    Header header;
    bool seen[3] = {};
    expect('{');
    while (!accept('}')) {
      const std::string key = string();
      expect(':');
      if (key == "descr") {
        if (peek() != '\'' && peek() != '"')
          fail(Errc::unsupported, "{}: arrays with named fields are not supported; save one plain 2-D array",
               name_);
        header.descr = string();
        seen[0] = true;
      } else if (key == "fortran_order") {
        header.fortran_order = boolean();
        seen[1] = true;
      } else if (key == "shape") {
        header.shape = tuple();
        seen[2] = true;
      } else {
        malformed();
      }
      if (!accept(',') && peek() != '}') malformed();
    }
    if (!seen[0] || !seen[1] || !seen[2]) malformed();
    return header;
  }

 private:
  [[noreturn]] void malformed() const {
    fail(Errc::bad_format, "{}: malformed .npy header {}", name_, messages::in_quotes(text_));
  }
  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) malformed();
  }
  std::string string() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') malformed();
    const std::size_t close = text_.find(quote, at_ + 1);
    if (close == std::string_view::npos) malformed();
    const std::string out(text_.substr(at_ + 1, close - at_ - 1));
    at_ = close + 1;
    return out;
  }
  bool boolean() {
    peek();
    for (const bool value : {false, true}) {
      const std::string_view word = value ? "True" : "False";
      if (text_.substr(at_).starts_with(word)) {
        at_ += word.size();
        return value;
      }
    }
    malformed();
  }
  std::vector<std::size_t> tuple() {
    std::vector<std::size_t> out;
    expect('(');
    while (!accept(')')) {
      peek();
      const std::size_t start = at_;
      while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9') ++at_;
      const auto value = to_count(text_.substr(start, at_ - start));
      if (!value || *value > std::numeric_limits<std::size_t>::max()) malformed();
      out.push_back(static_cast<std::size_t>(*value));
      accept('L');  // Python 2 wrote long integers so
      if (!accept(',') && peek() != ')') malformed();
    }
    return out;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
};

std::size_t little_endian(std::string_view bytes) {
  std::size_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

void set_type(NpyArray& array, const std::string& descr, const std::string& name) {
  std::string_view type = descr;
  char order = '=';
  if (!type.empty() && std::string_view("<>|=").find(type[0]) != std::string_view::npos) {
    order = type[0];
    type.remove_prefix(1);
  }
  const bool known = type == "f4" || type == "f8" ||
                     (type.size() == 2 && (type[0] == 'i' || type[0] == 'u') &&
                      (type[1] == '1' || type[1] == '2' || type[1] == '4' || type[1] == '8'));
  if (!known)
    fail(Errc::unsupported, "{}: data type {} is not supported; convert to float64 (or float32, or integers)",
         name, messages::in_quotes(descr));
  array.kind = type[0];
  array.item_size = static_cast<std::size_t>(type[1] - '0');
  array.big_endian = order == '>' || (order == '=' && std::endian::native == std::endian::big);
}

template <class T>
T load(const char* p, bool swap) {
  char bytes[sizeof(T)];
  if (swap) {
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = p[sizeof(T) - 1 - i];
  } else {
    std::memcpy(bytes, p, sizeof(T));
  }
  return std::bit_cast<T>(bytes);
}

/// Items in row-major order, each through convert(item, position in the result).
template <class T, class Out, class Convert>
std::vector<Out> convert_items(const NpyArray& array, const Convert& convert) {
  const std::size_t size = array.num_items();
  std::vector<Out> out(size);
  const bool swap = array.big_endian != (std::endian::native == std::endian::big);
  const char* p = array.data.data();
  if (!array.fortran_order || array.shape.size() < 2) {
    for (std::size_t i = 0; i < size; ++i, p += sizeof(T)) out[i] = convert(load<T>(p, swap), i);
    return out;
  }
  const std::size_t rows = array.shape[0], columns = array.shape[1];
  for (std::size_t column = 0; column < columns; ++column)
    for (std::size_t row = 0; row < rows; ++row, p += sizeof(T)) {
      const std::size_t i = row * columns + column;
      out[i] = convert(load<T>(p, swap), i);
    }
  return out;
}

/// Calls use(T{}) with T the type of the items.
template <class Use>
auto with_item_type(const NpyArray& array, Use&& use) {
  if (array.kind == 'f') return array.item_size == 4 ? use(float{}) : use(double{});
  if (array.kind == 'i') {
    switch (array.item_size) {
      case 1:
        return use(std::int8_t{});
      case 2:
        return use(std::int16_t{});
      case 4:
        return use(std::int32_t{});
      default:
        return use(std::int64_t{});
    }
  }
  switch (array.item_size) {
    case 1:
      return use(std::uint8_t{});
    case 2:
      return use(std::uint16_t{});
    case 4:
      return use(std::uint32_t{});
    default:
      return use(std::uint64_t{});
  }
}

/// True if binary64 holds the integer exactly: at most 53 bits between its first and its last one.
template <class T>
bool is_exact(T value) {
  if constexpr (sizeof(T) < 8 || std::is_floating_point_v<T>) {
    return true;
  } else {
    auto magnitude = static_cast<std::uint64_t>(value);
    if (value < T{0}) magnitude = 0 - magnitude;
    return magnitude == 0 || std::bit_width(magnitude) - std::countr_zero(magnitude) <= 53;
  }
}

std::size_t num_columns(const NpyArray& array) { return array.shape.size() < 2 ? 1 : array.shape[1]; }

}  // namespace

std::string shape_text(const std::vector<std::size_t>& shape) {
  return fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

void require_npy(std::string_view opening, const std::string& name) {
  if (opening.empty()) fail(Errc::bad_format, "{}: the file is empty", name);
  if (!opening.starts_with("\x93NUMPY"))
    fail(Errc::bad_format, "{}: not an .npy file (its signature is missing)", name);
}

NpyOpening parse_npy_opening(std::string_view bytes, std::size_t file_size, const std::string& name) {
  require_npy(bytes, name);
  if (bytes.size() < 12) fail(Errc::bad_format, "{}: truncated .npy header", name);
  const int version = bytes[6];
  if (version < 1 || version > 3)
    fail(Errc::unsupported, "{}: .npy format version {} is not supported", name, version);
  const std::size_t start = version == 1 ? 10 : 12;
  const std::size_t length = little_endian(bytes.substr(8, start - 8));
  if (length > bytes.size() - start)
    fail(Errc::bad_format, "{}: truncated .npy header: expected {} bytes, found {}", name, length,
         bytes.size() - start);
  const auto header = HeaderParser(bytes.substr(start, length), name).parse();

  NpyArray array;
  set_type(array, header.descr, name);
  array.fortran_order = header.fortran_order;
  array.shape = header.shape;
  if (array.shape.size() > 2)
    fail(Errc::bad_format, "{}: the array has shape {}; expected at most 2 dimensions", name,
         shape_text(array.shape));

  // The product of the shape may overflow: compare by division.
  const std::size_t found = file_size - start - length;
  std::size_t expected = array.item_size;
  bool overflow = false, empty = false;
  for (const std::size_t extent : array.shape) {
    empty = empty || extent == 0;
    overflow = overflow || (extent != 0 && expected > std::numeric_limits<std::size_t>::max() / extent);
    if (!overflow) expected *= extent;
  }
  if (empty) expected = 0;
  if (overflow && !empty)
    fail(Errc::bad_format, "{}: truncated: shape {} needs more than 2^64 bytes, found {}", name,
         shape_text(array.shape), found);
  if (found < expected)
    fail(Errc::bad_format, "{}: truncated: expected {} bytes of data for shape {}, found {}", name, expected,
         shape_text(array.shape), found);
  if (found > expected)
    fail(Errc::bad_format, "{}: expected {} bytes of data for shape {}, found {}", name, expected,
         shape_text(array.shape), found);
  return {std::move(array), start + length};
}

NpyArray parse_npy(std::string_view bytes, const std::string& name) {
  auto [array, data_begin] = parse_npy_opening(bytes, bytes.size(), name);
  array.data = bytes.substr(data_begin);
  return array;
}

std::vector<double> to_doubles(const NpyArray& array, const std::string& name, std::size_t first_row) {
  if (array.kind == 'f' && array.item_size == 8 && !array.fortran_order && !array.big_endian &&
      std::endian::native == std::endian::little) {
    std::vector<double> out(array.num_items());
    if (!out.empty()) std::memcpy(out.data(), array.data.data(), array.data.size());
    return out;
  }
  return with_item_type(array, [&](auto sample) {
    using T = decltype(sample);
    return convert_items<T, double>(array, [&](T value, std::size_t i) {
      if (!is_exact(value))
        fail(Errc::bad_format, "{}: row {}: the integer {} is not exact in double precision", name,
             first_row + i / num_columns(array), value);
      return static_cast<double>(value);
    });
  });
}

std::vector<SignedIndex> to_indices(const NpyArray& array, const std::string& name) {
  if (array.kind == 'f') fail(Errc::bad_format, "{}: expected integers, found floating-point numbers", name);
  return with_item_type(array, [&](auto sample) {
    using T = decltype(sample);
    return convert_items<T, SignedIndex>(array, [&](T value, std::size_t i) {
      const auto narrow = static_cast<SignedIndex>(value);
      if (static_cast<T>(narrow) != value || (narrow < 0) != (value < T{0}))
        fail(Errc::bad_format, "{}: row {}: {} does not fit the {}-bit indices of this build", name,
             i / num_columns(array), value, 8 * sizeof(SignedIndex));
      return narrow;
    });
  });
}

std::vector<std::string> parse_npy_texts(std::string_view bytes, const std::string& name, std::size_t rank) {
  require_npy(bytes, name);
  if (bytes.size() < 12) fail(Errc::bad_format, "{}: truncated .npy header", name);
  const std::size_t start = bytes[6] == 1 ? 10 : 12, length = little_endian(bytes.substr(8, start - 8));
  if (length > bytes.size() - start) fail(Errc::bad_format, "{}: truncated .npy header", name);
  const auto header = HeaderParser(bytes.substr(start, length), name).parse();
  const std::string& type = header.descr;
  const auto width = to_count(std::string_view(type).substr(std::min<std::size_t>(type.size(), 2)));
  if (type.size() < 3 || type[1] != 'U' || !width || header.shape.size() != rank)
    fail(Errc::bad_format, "{}: expected a {}-D array of Unicode strings, found type {} and shape {}", name,
         rank, messages::in_quotes(type), shape_text(header.shape));
  const std::string_view data = bytes.substr(start + length);
  const std::size_t count = rank == 0 ? 1 : header.shape[0], characters = data.size() / 4;
  if (data.size() % 4 != 0 ||
      (*width == 0 ? characters != 0 : characters % *width != 0 || characters / *width != count) ||
      (*width == 0 && count > 4096))
    fail(Errc::bad_format, "{}: {} bytes of data for shape {} of type {}", name, data.size(),
         shape_text(header.shape), messages::in_quotes(type));
  const bool swap = (type[0] == '>') != (std::endian::native == std::endian::big);
  std::vector<std::string> texts(count);
  for (std::size_t i = 0; i < characters; ++i)
    if (const auto code = load<std::uint32_t>(data.data() + 4 * i, swap); code != 0)
      append_utf8(texts[i / static_cast<std::size_t>(*width)], code);
  return texts;
}

std::string npy_of_text(std::string_view text) {
  std::string file = npy_header(fmt::format("U{}", text.size()), {}), storage;
  const std::vector<std::uint32_t> codes(text.begin(), text.end());
  return file + std::string(little_endian_bytes(std::span<const std::uint32_t>(codes), storage));
}

std::string npy_of_texts(const std::vector<std::string>& texts) {
  std::vector<std::vector<std::uint32_t>> decoded;
  std::size_t width = 1;
  for (std::string_view text : texts) {
    std::vector<std::uint32_t>& codes = decoded.emplace_back();
    for (; !text.empty(); text.remove_prefix(first_character(text).size)) {
      const Character c = first_character(text);
      codes.push_back(c.is_valid ? c.code : 0xfffd);
    }
    width = std::max(width, codes.size());
  }
  std::string file = npy_header(fmt::format("U{}", width), {texts.size()}), storage;
  for (std::vector<std::uint32_t>& codes : decoded) {
    codes.resize(width, 0);
    file += little_endian_bytes(std::span<const std::uint32_t>(codes), storage);
  }
  return file;
}

std::string npy_header(std::string_view type, const std::vector<std::size_t>& shape) {
  std::string dictionary =
      fmt::format("{{'descr': '<{}', 'fortran_order': False, 'shape': {}, }}", type, shape_text(shape));
  constexpr std::size_t prefix = 10, alignment = 64;
  const std::size_t total = (prefix + dictionary.size() + 1 + alignment - 1) / alignment * alignment;
  dictionary.append(total - prefix - dictionary.size() - 1, ' ');
  dictionary += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(dictionary.size() & 0xff);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

}  // namespace delone::io
