// SPDX-License-Identifier: BSD-3-Clause
// delone info: what a file holds.
#include "command.hpp"
#include "output.hpp"
#include "tiles_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>

namespace delone::cli {

std::optional<AnyData> try_read(const std::string& path, std::string format, std::uint64_t max_stream_bytes) {
  if (format.empty()) {
    std::filesystem::path of_content = path;
    if (of_content.extension() == ".gz" || of_content.extension() == ".GZ") of_content.replace_extension();
    format = of_content.extension().string();
    if (!format.empty()) format.erase(0, 1);
  }
  std::transform(format.begin(), format.end(), format.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (path == "-" || std::find(readable_complex_formats().begin(), readable_complex_formats().end(),
                               format) == readable_complex_formats().end())
    return std::nullopt;
  if (format != "off")
    return about(input_name(path), [&] { return delone::read(path, format, max_stream_bytes); });
  try {
    ComplexData data = read_as<ComplexData>(path, format, max_stream_bytes);
    if (data.num_cells() == 0) return std::nullopt;
    return data;
  } catch (const Error&) {
    return std::nullopt;
  }
}

namespace {

struct InfoOptions {
  PointInput input;
};

/// A title, and a line for each number.
class Description {
 public:
  explicit Description(const std::string& title) : text_(title + "\n") {}
  template <class Value>
  Description& line(std::string_view what, const Value& value) {
    text_ += fmt::format("  {:<18}{}\n", what, value);
    return *this;
  }
  Description& range(std::string_view what, double low, double high) {
    return line(what, fmt::format("{} ... {}", low, high));
  }
  Description& range(std::string_view what, const std::vector<double>& values) {
    if (values.empty()) return *this;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return range(what, *low, *high);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string describe(const ComplexData& data) {
  Description description{std::string(description_of(data.kind))};
  description.line("points", data.num_points())
      .line("dimension", data.dimension)
      .line("affine dimension", data.affine_dimension)
      .line("cells", data.num_cells())
      .line("neighbors", data.neighbors.empty() && data.num_cells() > 0 ? "not stored" : "stored");
  if (!data.vertex_of_point.empty()) {
    std::size_t vertices = 0;
    for (std::size_t i = 0; i < data.vertex_of_point.size(); ++i)
      vertices += data.vertex_of_point[i] == static_cast<SignedIndex>(i) ? 1 : 0;
    description.line("vertices", vertices);
    const auto hidden = std::count(data.vertex_of_point.begin(), data.vertex_of_point.end(), -1);
    if (hidden > 0) description.line("hidden points", hidden);
  }
  if (data.tolerance > 0) description.line("tolerance", data.tolerance);
  if (data.is_periodic())
    return description.range("weights", data.weights).line("lattice vectors", data.rank()).text();
  return description.range("weights", data.weights).line("hash", canonical_hash(data).hex()).text();
}

std::string describe(const HullData& data) {
  return Description("a convex hull")
      .line("points", data.num_points())
      .line("dimension", data.dimension)
      .line("affine dimension", data.affine_dimension)
      .line("vertices", data.vertices.size())
      .line("facets", data.num_facets())
      .line("ridges", data.num_ridges())
      .line("cells", data.num_cells())
      .text();
}

std::string describe(const IntersectionData& data) {
  Description description("an intersection of halfspaces");
  description.line("halfspaces", data.num_halfspaces()).line("dimension", data.dimension);
  if (data.state != IntersectionState::full)
    return description.line("state", data.state == IntersectionState::flat ? "flat" : "empty").text();
  return description.line("rank", data.rank)
      .line("bounded", data.bounded ? "yes" : "no")
      .line("vertices", data.num_vertices())
      .line("directions", data.num_directions())
      .line("edges", data.num_edges())
      .line("rays", data.num_rays())
      .line("facets", data.num_facets())
      .text();
}

std::string describe(const VoronoiData& data) {
  return Description(std::string(description_of(data.kind)))
      .line("points", data.num_points())
      .line("dimension", data.dimension)
      .line("affine dimension", data.affine_dimension)
      .line("regions", data.num_regions())
      .line("vertices", data.num_vertices())
      .line("ridges", data.num_ridges())
      .line("rays", data.num_rays())
      .range("weights", data.weights)
      .text();
}

std::string describe(const PointTable& table) {
  Description description("points");
  description.line("points", table.num_points())
      .line("dimension", table.dimension)
      .line("affine dimension",
            table.dimension < 1 ? -1 : affine_dimension(table.coordinates, table.dimension));
  const auto d = static_cast<std::size_t>(std::max(table.dimension, 0));
  constexpr std::size_t most_axes = 12;
  for (std::size_t axis = 0; axis < std::min(d, most_axes) && !table.coordinates.empty(); ++axis) {
    double low = table.coordinates[axis], high = low;
    for (std::size_t i = axis; i < table.coordinates.size(); i += d) {
      low = std::min(low, table.coordinates[i]);
      high = std::max(high, table.coordinates[i]);
    }
    const bool named = axis < table.column_names.size();
    description.range(named ? printable(table.column_names[axis]) : fmt::format("axis {}", axis), low, high);
  }
  return description.text();
}

std::string describe(const TilesIndex& index) {
  Description description("a triangulation in tiles");
  description.line("points", index.num_points)
      .line("dimension", index.dimension)
      .line("affine dimension", index.affine_dimension)
      .line("weights", index.weighted ? "stored" : "none")
      .line("cells", index.num_cells)
      .line("hull facets", index.num_hull_facets);
  if (index.lattice.rank() > 0) description.line("lattice vectors", index.lattice.rank());
  if (index.unit > 0) description.line("unit", fmt::format("{}", index.unit));
  description.line("vertices", index.num_vertices).line("duplicates", index.num_duplicates);
  if (index.weighted) description.line("hidden points", index.num_hidden);
  description.line("parts", index.parts.size());
  if (!index.parts.empty()) {
    std::int64_t least = index.parts.front().num_cells, largest = least, foreign = 0;
    for (const TilePart& part : index.parts) {
      least = std::min(least, part.num_cells);
      largest = std::max(largest, part.num_cells);
      foreign += part.num_foreign;
    }
    description.line("cells of a part", fmt::format("{} ... {}", least, largest))
        .line("foreign points", foreign);
  }
  return description.line("hash", index.hash.hex()).text();
}

/// A folder of tiles, finished or not.
std::string describe_folder(const std::string& folder) {
  if (const auto unfinished = find_unfinished_tiles(folder))
    return Description("a triangulation in tiles, not finished")
        .line("tiles", unfinished->num_tiles)
        .line("tiles done", unfinished->num_finished)
        .text();
  return describe(read_tiles_index(folder));
}

int run_info(const InfoOptions& options) {
  protect_files({options.input.path}, {{"the description", "-"}});
  const std::string name = input_name(options.input.path);
  const auto print = [&](const auto& held) {
    print_output(about(name, [&] { return fmt::format("{}: {}", name, describe(held)); }));
  };
  if (is_folder(options.input.path)) {
    print_output(
        about(name, [&] { return fmt::format("{}: {}", name, describe_folder(options.input.path)); }));
    return exit_status::ok;
  }
  if (const auto data =
          try_read(options.input.path, options.input.options.format, options.input.options.max_stream_bytes))
    std::visit(print, *data);
  else
    print(options.input.read());
  return exit_status::ok;
}

}  // namespace

Run add_info(CLI::App& app) {
  auto options = std::make_shared<InfoOptions>();
  app.add_option("FILE", options->input.path,
                 "Points, or any output of delone, also a folder of tiles; - for points from standard input")
      ->required()
      ->type_name("");
  std::vector<std::string> formats = point_formats();
  formats.insert(formats.end(), {"npz", "json"});
  app.add_option("--format", options->input.options.format, "Format of FILE, if not told by its extension")
      ->check(CLI::IsMember(formats));
  add_columns(app, "--columns", options->input.options.columns);
  add_skip_missing(app, options->input.options.skip_missing);
  add_max_stream(app, options->input.options.max_stream_bytes);
  return [options] { return run_info(*options); };
}

}  // namespace delone::cli
