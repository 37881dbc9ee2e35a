// SPDX-License-Identifier: BSD-3-Clause
// Help: examples at its end, and what was meant by a word that is none.
#pragma once

#include <CLI/CLI.hpp>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace delone::cli {

/// Adds examples, lines for a shell, after what the help of a command ends with.
void add_examples(CLI::App& command, std::initializer_list<std::string_view> lines);

/// The word that was probably meant: one that begins like it, or differs by few letters; of several the
/// nearest. Nothing if none is like it.
std::optional<std::string> likely_word(std::string_view given, const std::vector<std::string>& words);

/// "; did you mean 'hull'?", or nothing.
std::string suggestion(std::string_view given, const std::vector<std::string>& words);

/// The first of the arguments that looks like an option and is none of the command.
std::optional<std::string> unknown_option(const CLI::App& command, const std::vector<std::string>& arguments);

/// The names of all options of a command, with their dashes.
std::vector<std::string> option_names(const CLI::App& command);

}  // namespace delone::cli
