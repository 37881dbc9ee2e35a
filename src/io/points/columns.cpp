// SPDX-License-Identifier: BSD-3-Clause
#include "io/points/columns.hpp"

#include "io/file.hpp"
#include "io/text_cursor.hpp"
#include "messages/in_quotes.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace delone::io {

namespace {

class Chooser {
 public:
  /// `option`: the member of options that names the columns.
  Chooser(const std::vector<std::string>& names, std::size_t width, const std::string& name,
          const char* option)
      : names_(names), width_(width), name_(name + ": " + option) {}

  std::vector<std::size_t> choose(const std::vector<std::string>& wanted) const {
    std::vector<std::size_t> columns;
    for (const std::string& one : wanted)
      if (!add_name(one, columns) && !add_numbers(one, columns)) fail_missing(one);
    return columns;
  }

 private:
  bool add_name(const std::string& one, std::vector<std::size_t>& columns) const {
    const auto found = std::find(names_.begin(), names_.end(), one);
    if (found == names_.end()) return false;
    const auto again = std::find(found + 1, names_.end(), one);
    if (again != names_.end())
      fail(Errc::bad_format, "{}: {} and {} are both named {}; choose by number", name_,
           found - names_.begin(), again - names_.begin(), messages::in_quotes(one));
    columns.push_back(static_cast<std::size_t>(found - names_.begin()));
    return true;
  }

  bool add_numbers(std::string_view one, std::vector<std::size_t>& columns) const {
    const std::size_t dash = one.find('-');
    const std::optional<std::uint64_t> first = to_count(one.substr(0, dash)),
                                       last = dash == std::string_view::npos ? first
                                                                             : to_count(one.substr(dash + 1));
    if (!first || !last) return false;
    if (*first > *last)
      fail(Errc::bad_format, "{}: the range {} runs backwards", name_, messages::in_quotes(one));
    if (*last >= width_ && *first < width_)
      fail(Errc::bad_format, "{}: the range {} ends beyond column {}, the last one", name_,
           messages::in_quotes(one), width_ - 1);
    if (*last >= width_) return false;
    for (std::uint64_t i = *first; i <= *last; ++i) columns.push_back(static_cast<std::size_t>(i));
    return true;
  }

  [[noreturn]] void fail_missing(std::string_view one) const {
    if (const std::size_t dash = one.find('-');
        dash != std::string_view::npos && dash > 0 && one.substr(0, dash) == one.substr(dash + 1))
      one = one.substr(0, dash);  // a range of one number
    if (names_.empty())
      fail(Errc::bad_format, "{}: there is no column {}; the columns are 0 to {}", name_,
           messages::in_quotes(one), width_ - 1);
    fail(Errc::bad_format, "{}: there is no column {}; the columns are {}", name_, messages::in_quotes(one),
         joined(names_));
  }

  const std::vector<std::string>& names_;
  std::size_t width_;
  const std::string name_;
};

}  // namespace

ChosenColumns choose_columns(const ColumnChoice& choice, const std::vector<std::string>& names,
                             std::size_t width, const std::string& name) {
  const std::vector<std::size_t> last = Chooser(names, width, name, choice.last_name).choose(choice.last);
  std::vector<std::size_t> columns = Chooser(names, width, name, "columns").choose(choice.wanted);
  for (std::size_t i = 0; choice.wanted.empty() && i < width; ++i)
    if (std::find(last.begin(), last.end(), i) == last.end()) columns.push_back(i);
  columns.insert(columns.end(), last.begin(), last.end());
  return {std::move(columns), last.size()};
}

}  // namespace delone::io
