// SPDX-License-Identifier: BSD-3-Clause
#include "io/file.hpp"
#include "io/text_cursor.hpp"
#include "messages/in_quotes.hpp"

#include <delone/arithmetic.hpp>
#include <delone/qhull_options.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace delone {
namespace {

constexpr bool is_digit(char c) { return '0' <= c && c <= '9'; }
constexpr bool is_letter(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); }
bool is_one_of(char c, std::string_view letters) { return letters.find(c) != std::string_view::npos; }
bool are_digits(std::string_view text) { return !text.empty() && std::ranges::all_of(text, is_digit); }

/// A number in digits: neither the name of one nor nothing.
std::optional<double> number_of(std::string_view text) {
  const std::size_t first = !text.empty() && is_one_of(text[0], "+-") ? 1 : 0;
  if (first == text.size() || !(is_digit(text[first]) || text[first] == '.')) return std::nullopt;
  return io::to_number(text);
}

/// A number, or one after a minus sign of its own.
bool is_number_or_minus(std::string_view text) {
  return number_of(text) || (text.starts_with('-') && number_of(text.substr(1)));
}

/// Whether no result depends on an option: on how Qhull deals with rounding errors, orders its work, traces
/// it, tests and warns, or what it prints.
bool is_without_effect(std::string_view option) {
  constexpr std::array<std::string_view, 15> words{"Qt", "Qx", "Qs", "Qf", "Qm", "Qr", "Qv", "Qw",
                                                   "Qa", "Pp", "Tv", "Po", "Pg", "PG", "T-1"};
  if (std::ranges::find(words, option) != words.end()) return true;
  const std::string_view rest = option.substr(1);
  switch (option[0]) {
    case 'Q':
      return are_digits(rest);
    case 'T':
      return are_digits(rest) || (rest.size() == 1 && is_one_of(rest[0], "acsz")) ||
             (!rest.empty() && is_one_of(rest[0], "FMPRW") && number_of(rest.substr(1)));
    case 'A':
    case 'U':
    case 'V':
    case 'R':
      return is_number_or_minus(rest);
    case 'F':
      return rest.size() == 1 && is_letter(rest[0]);
    case 'G':
      return rest.empty() || (rest.size() == 1 && is_letter(rest[0])) ||
             (rest.size() == 2 && rest[0] == 'D' && is_digit(rest[1]));
    default:
      return rest.empty() && is_one_of(option[0], "fimnops");
  }
}

/// What an option asks for that there is not.
std::string_view reason_against(std::string_view option) {
  const auto begins = [&](std::string_view start, std::string_view next) {
    return option.size() > start.size() && option.starts_with(start) && is_one_of(option[start.size()], next);
  };
  constexpr std::string_view digits = "0123456789";
  if (begins("Qb", "k0123456789") || begins("QB", "k0123456789"))
    return "it scales or drops a coordinate: do so to the points";
  if (option == "QG" || option == "QG-") return "the number of a row is missing";
  if (option.starts_with("QG")) return "only hulls have facets that a point sees";
  if (option.starts_with("QR")) return "it rotates the points: do so to the points";
  if (option.starts_with("QV")) return "facets are not selected by a vertex";
  if (option == "Qg") return "facets that are not good are built as well";
  if (option == "Qi") return "of points inside a hull no list is kept";
  if (option == "Qu") return "only triangulations and diagrams have furthest sites";
  if (begins("TA", "-0123456789") || begins("TC", "-0123456789") || begins("TV", "-0123456789"))
    return "it stops before all points are in";
  if (begins("T", "IO")) return "it names a file; what functions return is the output";
  if (begins("Pd", digits) || begins("PD", digits) || begins("PA", digits) || begins("PF", digits) ||
      begins("PM", digits))
    return "it selects facets: do so with what is returned";
  if (option == "d" || option == "v" || option.starts_with('H'))
    return "it asks for another program: use what is made for that";
  return "not known, or without a meaning here";
}

[[noreturn]] void refuse_option(std::string_view option, std::string_view why) {
  io::fail(Errc::unsupported, "Qhull option {}: {}", messages::in_quotes(option), why);
}

double tolerance_of(std::string_view option, double value) {
  if (value < 0) refuse_option(option, "a tolerance is not negative");
  return value;
}

void parse_option(std::string_view option, QhullProgram program, QhullOptions& to) {
  const bool lifts = program == QhullProgram::delaunay || program == QhullProgram::voronoi;
  if (option == "Qbb") {
    (lifts ? to.scaled : to.last_in_box) = true;
  } else if (option == "QbB") {
    to.in_cube = true;
  } else if (option == "Qz") {
    to.at_infinity = to.at_infinity || lifts;
  } else if (option == "Qc") {
    to.keep_coplanar = true;
  } else if (option == "Qu" && lifts) {
    to.furthest_site = true;
  } else if (option == "Q0") {
    to.unmerged = true;
  } else if (option == "QJ" || (option.starts_with("QJ") && number_of(option.substr(2)))) {
    to.joggled = to.unmerged = true;
  } else if (const auto centrum = number_of(option.substr(option.starts_with("C-") ? 2 : 1));
             option[0] == 'C' && centrum) {
    to.centrum = std::max(to.centrum, tolerance_of(option, *centrum));
  } else if (const auto value = number_of(option.substr(1)); option[0] == 'E' && value) {
    to.roundoff = tolerance_of(option, *value);
  } else if (option[0] == 'W' && value) {
    to.width = tolerance_of(option, *value);
  } else if (option.starts_with("QG") && program == QhullProgram::hull) {
    to.good_visible = !option.starts_with("QG-");
    const std::string_view row = option.substr(to.good_visible ? 2 : 3);
    to.good_row = io::to_count(row);
    if (!to.good_row) refuse_option(option, row.empty() ? reason_against(option) : "there is no such row");
  } else if (!is_without_effect(option)) {
    refuse_option(option, reason_against(option));
  }
}

}  // namespace

QhullOptions parse_qhull_options(std::string_view text, QhullProgram program) {
  const ArithmeticScope arithmetic;
  constexpr std::string_view blanks = " \t\n\v\f\r";
  QhullOptions options;
  for (std::size_t first = text.find_first_not_of(blanks); first != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, first), text.size());
    parse_option(text.substr(first, end - first), program, options);
    first = text.find_first_not_of(blanks, end);
  }
  if (options.furthest_site) options.at_infinity = false;
  return options;
}

}  // namespace delone
