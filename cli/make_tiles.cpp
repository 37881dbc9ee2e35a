// SPDX-License-Identifier: BSD-3-Clause
#include "make_tiles.hpp"

#include "cost.hpp"
#include "interrupt.hpp"
#include "report.hpp"
#include "system.hpp"
#include "tiles_folder.hpp"

#include <delone/tiles.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

namespace delone::cli {
namespace {

constexpr std::array of_tiles{"--tiles", "--raw", "--vtu", "--no-resume"};
constexpr std::array of_files{"--output-format", "--qhull",         "--force",        "--max-stream",
                              "--trim",          "--furthest-site", "--seed",         "--runtime-dimension",
                              "--order",         "--time",          "--skip-missing", "--exact"};

bool is_given(const CLI::App& command, const char* option) {
  const CLI::Option* const found = command.get_option_no_throw(option);
  return found != nullptr && found->count() > 0;
}

/// "1.4 GB"
std::string size_text(std::uint64_t bytes) {
  const auto value = static_cast<double>(bytes);
  return value < 1e9 ? fmt::format("{:.0f} MB", std::max(value / 1e6, 1.0))
                     : fmt::format("{:.1f} GB", value / 1e9);
}

/// What it will cost, before it starts.
std::string text_of(const TilesForecast& forecast) {
  std::string text = fmt::format("{} in {}, each with about {} of memory",
                                 counted(static_cast<std::size_t>(forecast.num_points), "point"),
                                 counted(static_cast<std::size_t>(forecast.num_tiles), "tile"),
                                 size_text(forecast.bytes_per_tile));
  if (forecast.num_tiles > 1)
    text += fmt::format(" and {:.2g} % of points of other tiles", 100 * forecast.foreign_share);
  text += ".\n";
  if (forecast.foreign_share > 1)
    text += fmt::format(
        "Tiles do not pay here: each inserts {:.1f} times as many points of other tiles as of its own. "
        "With more memory, or a file as output, it takes less time.\n",
        forecast.foreign_share);
  return text;
}

/// Throws cannot_write if no folder can be made there.
void check_folder(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path above = fs::absolute(folder, error);
  while (!fs::exists(above, error) && above.has_relative_path()) above = above.parent_path();
  int why = 0;
  if (!fs::is_directory(above, error))
    why = ENOTDIR;
  else
    why = system::why_not_writable_folder(above.string());
  if (why != 0)
    throw Error(Errc::cannot_write, output_name(folder) + ": " + std::generic_category().message(why));
}

Json stats_of(const TilesCommand& command, const TilesIndex& index, const Cost& cost) {
  std::int64_t foreign = 0, rounds = 0;
  for (const TilePart& part : index.parts) {
    foreign += part.num_foreign;
    rounds = std::max(rounds, part.num_rounds);
  }
  Json json;
  json["command"] = command.name;
  json["dimension"] = index.dimension;
  json["affine_dimension"] = index.affine_dimension;
  json["points"] = index.num_points;
  json["vertices"] = index.num_vertices;
  json["duplicates"] = index.num_duplicates;
  json["hidden"] = index.num_hidden;
  json["cells"] = index.num_cells;
  json["hull_facets"] = index.num_hull_facets;
  if (index.lattice.rank() > 0) json["lattice_vectors"] = index.lattice.rank();
  json["hash"] = index.hash.hex();
  json["parts"] = index.parts.size();
  json["foreign"] = foreign;
  json["rounds"] = rounds;
  json["seconds"] = {{"total", cost.total}};
  json["peak_rss_bytes"] = cost.peak_rss_bytes;
  json["threads"] = command.build.threads;
  json["version"] = DELONE_VERSION;
  return json;
}

TilesOptions options_of(const TilesCommand& command, ProgressBar& bar) {
  TilesOptions options;
  options.memory = command.build.memory;
  options.tiles = command.tiles.tiles;
  options.threads = command.build.threads;
  options.weighted = !command.weights.empty();
  options.lattice = command.lattice;
  options.unit = command.unit;
  options.format = command.tiles.raw_columns > 0 ? "raw" : command.input.options.format;
  options.columns = command.tiles.raw_columns;
  options.coordinates = command.input.options.columns;
  options.weights = command.weights;
  options.resume = !command.tiles.no_resume;
  options.vtu = command.tiles.vtu;
  options.progress = bar.callback();
  options.forecast = [&command, &bar](const TilesForecast& forecast) {
    if (!command.build.quiet) {
      bar.clear();
      print_note(text_of(forecast));
    }
    return true;
  };
  options.damage = [&bar](const std::vector<std::string>& files) {
    bar.clear();
    for (const std::string& file : files) print_note(fmt::format("delone: {}; made again\n", file));
    return true;
  };
  return options;
}

}  // namespace

void TilesInput::add_to(CLI::App& command) {
  const char* const group = "With a folder as output (-o OUT/)";
  command.add_option("--tiles", tiles, "The number of tiles, instead of as few as the memory allows")
      ->check(CLI::Range(1, 1 << 20))
      ->type_name("N")
      ->group(group);
  command
      .add_option("--raw", raw_columns,
                  "IN consists of little-endian doubles, N per row, the weight included")
      ->check(CLI::Range(1, 1 << 20))
      ->type_name("N")
      ->group(group);
  command.add_flag("--vtu", vtu, "Also write tiles.pvtu and a .vtu per part, for ParaView (d <= 3)")
      ->group(group);
  command.add_flag("--no-resume", no_resume, "Start again instead of continuing from what is in the folder")
      ->group(group);
}

bool TilesInput::wanted(const CLI::App& command, const std::string& output) const {
  const bool is_tiled = !output.empty() && (output.back() == '/' || is_folder(output));
  if (!is_tiled)
    for (const char* const option : of_tiles)
      if (is_given(command, option))
        throw UsageError(
            fmt::format("{} is for tiles, which go to a folder: -o OUT/, with a slash at the end", option));
  if (is_tiled)
    for (const char* const option : of_files)
      if (is_given(command, option))
        throw UsageError(
            fmt::format("{} does not go together with tiles, which a folder as output means", option));
  if (is_tiled && vtu && is_given(command, "--lattice"))
    throw UsageError("--vtu does not go together with --lattice");
  if (is_tiled && raw_columns > 0 && is_given(command, "--format"))
    throw UsageError("--raw is a format; --format names another one");
  return is_tiled;
}

int run_tiles(const TilesCommand& command) {
  const std::string& folder = command.build.output;
  check_folder(folder);
  if (command.build.stats) protect_files({command.input.path}, {{"--stats", "-"}});
  const auto start = Clock::now();
  TilesIndex index;
  try {
    ProgressBar bar(command.build.quiet);
    const StageGuard guard(Stage::tiling);
    index = make_tiles(command.input.path, folder, options_of(command, bar));
  } catch (const Error&) {
    const int signal = caught_signal();
    if (signal == 0) throw;
    const auto unfinished = find_unfinished_tiles(folder);
    const std::string done =
        unfinished ? fmt::format(": {} of {} tiles are done", unfinished->num_finished, unfinished->num_tiles)
                   : "";
    print_note(fmt::format("delone: interrupted; the same command continues with {}{}\n", output_name(folder),
                           done));
    return 128 + signal;
  }
  Cost cost;
  cost.close(start);
  if (command.build.stats) print_output(stats_of(command, index, cost).dump(2) + "\n");
  return exit_status::ok;
}

}  // namespace delone::cli
