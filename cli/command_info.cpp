// SPDX-License-Identifier: BSD-3-Clause
// delone info: what a file holds.
#include "command.hpp"
#include "output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

namespace delone::cli {
namespace {

struct InfoOptions {
  PointInput input;
};

/// The triangulation in the file, if its format can hold one. An OFF file without faces holds points.
std::optional<ComplexData> try_read_complex(const std::string& path, std::string format) {
  if (format.empty()) format = std::filesystem::path(path).extension().string();
  if (!format.empty() && format[0] == '.') format.erase(0, 1);
  if (path == "-" || std::find(readable_complex_formats().begin(), readable_complex_formats().end(),
                               format) == readable_complex_formats().end())
    return std::nullopt;
  if (format != "off") return about(path, [&] { return read_complex(path, format); });
  try {
    ComplexData data = read_complex(path, format);
    if (data.num_cells() == 0) return std::nullopt;
    return data;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string describe(const ComplexData& data) {
  std::string text;
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<18}{}\n", what, value);
  };
  line("points", fmt::format("{}", data.num_points()));
  line("dimension", fmt::format("{}", data.dimension));
  line("affine dimension", fmt::format("{}", data.affine_dimension));
  line("cells", fmt::format("{}", data.num_cells()));
  line("neighbors", data.neighbors.empty() && data.num_cells() > 0 ? "not stored" : "stored");
  if (!data.vertex_of_point.empty()) {
    std::size_t vertices = 0;
    for (std::size_t i = 0; i < data.vertex_of_point.size(); ++i)
      vertices += data.vertex_of_point[i] == static_cast<SignedIndex>(i) ? 1 : 0;
    line("vertices", fmt::format("{}", vertices));
    const auto hidden = std::count(data.vertex_of_point.begin(), data.vertex_of_point.end(), -1);
    if (hidden > 0) line("hidden points", fmt::format("{}", hidden));
  }
  if (!data.weights.empty()) {
    const auto [low, high] = std::minmax_element(data.weights.begin(), data.weights.end());
    line("weights", fmt::format("{} ... {}", *low, *high));
  }
  line("hash", canonical_hash(data).hex());
  return text;
}

std::string describe(const PointTable& table) {
  std::string text;
  const auto line = [&](const std::string& what, const std::string& value) {
    text += fmt::format("  {:<18}{}\n", what, value);
  };
  line("points", fmt::format("{}", table.num_points()));
  line("dimension", fmt::format("{}", table.dimension));
  line("affine dimension",
       fmt::format("{}", table.dimension < 1 ? -1 : affine_dimension(table.coordinates, table.dimension)));
  const auto d = static_cast<std::size_t>(std::max(table.dimension, 0));
  constexpr std::size_t most_axes = 12;
  for (std::size_t axis = 0; axis < std::min(d, most_axes) && !table.coordinates.empty(); ++axis) {
    double low = table.coordinates[axis], high = low;
    for (std::size_t i = axis; i < table.coordinates.size(); i += d) {
      low = std::min(low, table.coordinates[i]);
      high = std::max(high, table.coordinates[i]);
    }
    const bool named = axis < table.column_names.size();
    line(named ? table.column_names[axis] : fmt::format("axis {}", axis),
         fmt::format("{} ... {}", low, high));
  }
  return text;
}

int run_info(const InfoOptions& options) {
  const std::string name = input_name(options.input.path);
  if (const auto data = try_read_complex(options.input.path, options.input.options.format)) {
    print_output(about(name, [&] { return fmt::format("{}: a triangulation\n{}", name, describe(*data)); }));
  } else {
    const PointTable table = options.input.read();
    print_output(about(name, [&] { return fmt::format("{}: points\n{}", name, describe(table)); }));
  }
  return exit_status::ok;
}

}  // namespace

Run add_info(CLI::App& app) {
  auto options = std::make_shared<InfoOptions>();
  app.add_option("FILE", options->input.path, "Points or a triangulation; - for points from standard input")
      ->required()
      ->type_name("");
  std::vector<std::string> formats = point_formats();
  formats.insert(formats.end(), {"npz", "json"});
  app.add_option("--format", options->input.options.format, "Format of FILE, if not told by its extension")
      ->check(CLI::IsMember(formats));
  add_columns(app, "--columns", options->input.options.columns);
  return [options] { return run_info(*options); };
}

}  // namespace delone::cli
