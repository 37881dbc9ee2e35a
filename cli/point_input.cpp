// SPDX-License-Identifier: BSD-3-Clause
// The options that say how to read points, and the formats by name.
#include "command.hpp"

#include <algorithm>

namespace delone::cli {

void PointInput::add_to(CLI::App& command, const std::string& name, const std::string& description) {
  command.add_option(name, path, description)->required()->type_name("");
  command.add_option("--format", options.format, "Format of " + name + ", if not told by its extension")
      ->check(CLI::IsMember(point_formats()));
  add_columns(command, "--columns", options.columns);
}

void add_columns(CLI::App& command, const std::string& name, std::vector<std::string>& columns) {
  command
      .add_option_function<std::string>(
          name,
          [&columns](const std::string& list) {
            columns.clear();
            for (std::size_t begin = 0; begin <= list.size();) {
              const std::size_t end = std::min(list.find(',', begin), list.size());
              columns.push_back(list.substr(begin, end - begin));
              begin = end + 1;
            }
          },
          "Columns with the coordinates: names, or numbers from 0")
      ->type_name("A,B,...");
}

void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& description) {
  // The parser reads −1 as 2^64 − 1.
  const auto not_negative = [](const std::string& text) {
    return text.find('-') == std::string::npos ? "" : "must be 0 or more";
  };
  command.add_option("-s,--seed", seed, description)->check(CLI::Validator(not_negative, ""))->type_name("S");
}

PointTable PointInput::read() const {
  return about(input_name(path), [&] { return read_points(path, options); });
}

const std::vector<std::string>& point_formats() {
  static const std::vector<std::string> formats{"npy", "csv", "tsv", "txt",  "xyz",
                                                "pts", "off", "ply", "qhull"};
  return formats;
}

const std::vector<std::string>& complex_formats() {
  static const std::vector<std::string> formats{"npz", "vtu", "off", "json", "svg", "txt", "npy"};
  return formats;
}

const std::vector<std::string>& readable_complex_formats() {
  static const std::vector<std::string> formats{"npz", "json", "off"};
  return formats;
}

}  // namespace delone::cli
