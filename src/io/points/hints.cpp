// SPDX-License-Identifier: BSD-3-Clause
#include "io/points/hints.hpp"

#include "io/text_cursor.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace delone::io {

namespace {

/// So much of a file is looked at.
constexpr std::size_t sample_bytes = std::size_t{1} << 16;
constexpr std::size_t sample_lines = 5;

/// The first lines with content, without comments and line ends.
std::vector<std::string_view> first_lines(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<std::string_view> lines;
  TextCursor at(text.substr(0, sample_bytes), {});
  while (lines.size() < sample_lines && at.find_content()) lines.push_back(at.rest_of_line());
  return lines;
}

/// The fields of a line; at blanks there are no empty ones.
std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  const std::string_view ends = separator == ' ' ? std::string_view(" \t") : std::string_view(&separator, 1);
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(ends, begin), line.size());
    std::string_view field = line.substr(begin, end - begin);
    while (!field.empty() && TextCursor::is_blank(field.front())) field.remove_prefix(1);
    while (!field.empty() && TextCursor::is_blank(field.back())) field.remove_suffix(1);
    if (separator != ' ' || !field.empty()) fields.push_back(field);
    begin = end + 1;
  }
  return fields;
}

bool is_number(std::string_view field) { return to_number(field).has_value(); }

bool has_decimal_comma(std::string_view field) {
  std::string text(field);
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return false;
  text[comma] = '.';
  return is_number(text);
}

struct Table {
  std::size_t width = 0;                        ///< fields of every line; 0 if lines differ
  std::size_t numbers = 0, decimal_commas = 0;  ///< of the last line
  bool is_all_numbers() const { return width > 0 && numbers + decimal_commas == width; }
};

Table table_of(const std::vector<std::string_view>& lines, char separator) {
  Table table;
  for (const std::string_view line : lines) {
    const std::vector<std::string_view> fields = fields_of(line, separator);
    if (line.data() != lines.front().data() && fields.size() != table.width) return {};
    table.width = fields.size();
    table.numbers = static_cast<std::size_t>(std::count_if(fields.begin(), fields.end(), is_number));
    table.decimal_commas = static_cast<std::size_t>(
        std::count_if(fields.begin(), fields.end(), [](auto field) { return has_decimal_comma(field); }));
  }
  return table;
}

/// The separator of a format; 0 if it has none.
char separator_of(std::string_view format) {
  if (format == "csv") return ',';
  if (format == "tsv") return '\t';
  return format == "txt" || format == "xyz" || format == "pts" || format == "dat" ? ' ' : '\0';
}

std::string separator_hint(const std::vector<std::string_view>& lines, std::string_view format) {
  const char own = separator_of(format);
  const Table as_told = own == '\0' ? Table() : table_of(lines, own);
  if (as_told.numbers > 0 && as_told.numbers == as_told.width) return {};
  for (const char separator : {';', '\t', ',', '|', ' '}) {
    if (separator == own) continue;
    const Table table = table_of(lines, separator);
    const bool is_likely =
        table.width > 1 && (table.is_all_numbers() || (as_told.width == 1 && table.numbers > 0));
    if (!is_likely || (table.decimal_commas > 0 && separator == ',')) continue;
    const bool may_be_read = table.decimal_commas == 0;
    if (separator == ',') return "this looks like it is separated by ',': format = \"csv\"";
    if (separator == '\t' && may_be_read) return "this looks like it is separated by tabs: format = \"tsv\"";
    if (separator == ' ' && may_be_read)
      return "this looks like it is separated by white space: format = \"txt\"";
    const std::string name = separator == '\t'  ? "tabs"
                             : separator == ' ' ? "white space"
                                                : std::string("'") + separator + "'";
    return "this looks like it is separated by " + name +
           (may_be_read ? ", which no format is: put ',' in its place"
                        : ", and has decimal commas: put points in their place");
  }
  return {};
}

bool are_numbers(const std::vector<std::string_view>& fields) {
  return !fields.empty() && std::all_of(fields.begin(), fields.end(), is_number);
}

std::string header_hint(const std::vector<std::string_view>& lines) {
  if (lines.size() < 2) return {};
  if (!are_numbers(fields_of(lines[0], ' ')) && are_numbers(fields_of(lines[1], ' ')))
    return "the first line looks like a header: put '#' before it";
  return {};
}

/// What the first bytes say, if it is another format.
std::string signature_hint(std::string_view bytes, std::string_view format) {
  struct Signature {
    std::string_view opening, format, name;
  };
  using namespace std::string_view_literals;
  static constexpr Signature signatures[] = {
      {"\x93NUMPY", "npy", "an .npy file"},
      {"ply\n", "ply", "a .ply file"},
      {"ply\r\n", "ply", "a .ply file"},
      {"OFF", "off", "an .off file"},
      {"nOFF", "off", "an .off file"},
      {"COFF", "off", "an .off file"},
      {"LASF", "las", "a .las file"},
      {"ATOM  ", "pdb", "a .pdb file"},
      {"HETATM", "pdb", "a .pdb file"},
      {"PK\x03\x04", "", "a zip archive"},
      {"\x89HDF", "", "an HDF5 file"},
      {"\x89PNG", "", "a picture"},
      {"\xff\xd8\xff", "", "a picture"},
      {"%PDF", "", "a PDF file"},
      {"BZh", "", "a file compressed by bzip2"},
      {"\xfd"sv
       "7zXZ",
       "", "a file compressed by xz"},
      {"\x28\xb5\x2f\xfd", "", "a file compressed by zstd"},
      {"<", "", "XML or HTML"},
      {"{", "", "JSON"},
  };
  for (const Signature& known : signatures)
    if (bytes.starts_with(known.opening)) {
      if (!known.format.empty() && known.format == format) return {};
      return "this looks like " + std::string(known.name) +
             (known.format.empty() ? "" : ": format = \"" + std::string(known.format) + "\"");
    }
  return {};
}

}  // namespace

bool is_qhull_form(std::string_view text) {
  const std::vector<std::string_view> lines = first_lines(text);
  if (lines.size() < 2) return false;
  const std::vector<std::string_view> first = fields_of(lines[0], ' ');
  const std::optional<std::uint64_t> dimension = to_count(first[0]);
  if (!dimension || *dimension == 0 || !to_count(lines[1])) return false;
  // Where numbers only come after the dimension this is a row.
  if (first.size() > 1 && are_numbers(first)) return false;
  if (lines.size() == 2) return first.size() > 1;
  const std::vector<std::string_view> row = fields_of(lines[2], ' ');
  return are_numbers(row) && (first.size() > 1 || (row.size() > 1 && row.size() == *dimension));
}

bool is_xyz_form(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  TextCursor at(text.substr(0, sample_bytes), {});
  std::string_view lines[3];
  for (std::string_view& line : lines) {
    line = at.rest_of_line();
    if (at.at_end() && &line != lines + 2) return false;
    at.take_line_end();
  }
  const std::vector<std::string_view> atom = fields_of(lines[2], ' ');
  return to_count(lines[0]) && atom.size() > 3 && are_numbers({atom.begin() + 1, atom.begin() + 4}) &&
         (!is_number(atom[0]) || !are_numbers(fields_of(lines[1], ' ')));
}

std::string hint_for(std::string_view bytes, std::string_view format) {
  if (std::string hint = signature_hint(bytes, format); !hint.empty()) return hint;
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return {};  // UTF-16, as was said
  const bool is_text = bytes.substr(0, sample_bytes).find('\0') == std::string_view::npos;
  if (format == "npy" || format == "ply" || format == "off" || format == "las") return {};
  if (!is_text) return "this is a binary file";
  if (format != "qhull" && is_qhull_form(bytes)) return "this looks like rbox's output: format = \"qhull\"";
  if (is_xyz_form(bytes)) return "this looks like the chemists' xyz format: format = \"xyz\"";
  const std::vector<std::string_view> lines = first_lines(bytes);
  if (lines.empty()) return {};
  if (format == "qhull" && is_qhull_form(bytes)) return {};
  if (std::string hint = separator_hint(lines, format); !hint.empty()) return hint;
  return separator_of(format) == ' ' ? header_hint(lines) : std::string();
}

}  // namespace delone::io
