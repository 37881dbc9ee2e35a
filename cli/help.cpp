// SPDX-License-Identifier: BSD-3-Clause
#include "help.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace delone::cli {
namespace {

/// The number of letters to insert, remove, replace or swap with the next one ("optimal string alignment").
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = last;
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

}  // namespace

void add_examples(CLI::App& command, std::initializer_list<std::string_view> lines) {
  if (lines.size() == 0) return;
  std::string footer = command.get_footer();
  if (!footer.empty() && footer.back() != '\n') footer += '\n';
  footer += footer.empty() ? "Examples:" : "\nExamples:";
  for (const std::string_view line : lines) footer += "\n  " + std::string(line);
  command.footer(footer);
}

std::optional<std::string> likely_word(std::string_view given, const std::vector<std::string>& words) {
  constexpr std::size_t longest = 40, shortest_beginning = 3;
  if (given.size() > longest) return std::nullopt;
  const std::string word = lower_case(given);
  const std::size_t dashes = std::min(word.find_first_not_of('-'), word.size()),
                    letters = word.size() - dashes;
  const std::size_t most = std::max<std::size_t>(1, letters / 3),
                    beginning =
                        dashes + std::max(shortest_beginning, letters - std::min<std::size_t>(letters, 2));
  std::optional<std::string> best;
  std::size_t best_distance = longest;
  for (const std::string& candidate : words) {
    const std::size_t d = distance(word, candidate);
    const bool begins_alike =
        word.size() >= beginning && candidate.substr(0, beginning) == word.substr(0, beginning);
    if ((d <= most || begins_alike) && d < best_distance) best = candidate, best_distance = d;
  }
  return best;
}

std::string suggestion(std::string_view given, const std::vector<std::string>& words) {
  const std::optional<std::string> meant = likely_word(given, words);
  return meant ? "; did you mean '" + *meant + "'?" : "";
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::optional<std::string> unknown_option(const CLI::App& command,
                                          const std::vector<std::string>& arguments) {
  const std::vector<std::string> names = option_names(command);
  for (const std::string& argument : arguments) {
    if (argument == "--") break;
    const bool is_short = argument.size() > 1 && argument[0] == '-' &&
                          std::isalpha(static_cast<unsigned char>(argument[1])) != 0;
    const bool is_long = argument.size() > 2 && argument.starts_with("--");
    if (!is_short && !is_long) continue;
    const std::string name = is_long ? argument.substr(0, argument.find('=')) : argument.substr(0, 2);
    if (std::find(names.begin(), names.end(), name) == names.end())
      return is_long ? name : argument;  // all of it: -output is --output, perhaps
  }
  return std::nullopt;
}

}  // namespace delone::cli
