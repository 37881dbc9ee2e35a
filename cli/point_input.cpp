// SPDX-License-Identifier: BSD-3-Clause
// The options that say how to read points, and the formats by name.
#include "command.hpp"

namespace delone::cli {

void PointInput::add_to(CLI::App& command, const std::string& name, const std::string& description) {
  command.add_option(name, path, description)->required()->type_name("");
  command.add_option("--format", options.format, "Format of " + name + ", if not told by its extension")
      ->check(CLI::IsMember(point_formats()));
  command.add_option("--columns", options.columns, "Columns with the coordinates: names, or numbers from 0")
      ->delimiter(',')
      ->expected(1)
      ->type_name("A,B,...");
}

PointTable PointInput::read() const {
  return about(input_name(path), [&] { return read_points(path, options); });
}

const std::vector<std::string>& point_formats() {
  static const std::vector<std::string> formats{"npy", "csv", "tsv", "txt", "xyz", "pts", "off", "ply", "qhull"};
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
