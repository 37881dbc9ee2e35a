// SPDX-License-Identifier: BSD-3-Clause
// delone check: every level of exact checks of what a file holds, from any program.
#include "build_options.hpp"
#include "command.hpp"
#include "output.hpp"
#include "tiles_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace delone::cli {
namespace {

struct CheckCommandOptions {
  std::string path, format;
  PointInput points;
  int level = CheckOptions::all;
  bool canonical = false;
  bool any_orientation = false;
  bool furthest_site = false;
  unsigned threads = 0;
};

const char* kind_of(const ComplexData& data, bool furthest_site) {
  return furthest_site ? "furthest-site Delaunay" : data.weights.empty() ? "Delaunay" : "regular";
}
const char* kind_of(const VoronoiData& data) { return data.weights.empty() ? "Voronoi" : "power"; }

/// What the file holds, with its numbers.
std::string contents(const ComplexData& data) {
  return fmt::format("{} in dimension {}, affine dimension {}, {}", counted(data.num_points(), "point"),
                     data.dimension, data.affine_dimension, counted(data.num_cells(), "cell"));
}
std::string contents(const HullData& data) {
  return fmt::format("the hull of {} in dimension {}, affine dimension {}, {}, {}",
                     counted(data.num_points(), "point"), data.dimension, data.affine_dimension,
                     counted(data.num_facets(), "facet"), counted(data.num_cells(), "cell"));
}
std::string contents(const IntersectionData& data) {
  const std::string text = fmt::format("the intersection of {} halfspaces in dimension {}, ",
                                       data.num_halfspaces(), data.dimension);
  if (data.state != IntersectionState::full)
    return text + (data.state == IntersectionState::flat ? "flat" : "empty");
  return text + fmt::format("{} vertices, {} directions, {} facets", data.num_vertices(),
                            data.num_directions(), data.num_facets());
}
std::string contents(const VoronoiData& data) {
  return fmt::format("the {} diagram of {} in dimension {}, affine dimension {}, {}, {} vertices",
                     kind_of(data), counted(data.num_points(), "point"), data.dimension,
                     data.affine_dimension, counted(data.num_regions(), "region"), data.num_vertices());
}

/// What has been proved once all levels are passed.
std::string result(const ComplexData& data, const CheckOptions& options) {
  return fmt::format("a {} triangulation of all its points", kind_of(data, options.furthest_site));
}
std::string result(const HullData& data, const CheckOptions&) {
  return data.tolerance == 0 ? "the convex hull of all its points"
                             : "the convex hull of its vertices, all points within the tolerance";
}
std::string result(const IntersectionData&, const CheckOptions&) {
  return "the intersection of all its halfspaces";
}
std::string result(const VoronoiData& data, const CheckOptions&) {
  return fmt::format("the {} diagram of all its points", kind_of(data));
}

/// The ties, once the level that finds them has been passed.
std::string ties(const ComplexData&, const CheckReport& report) {
  return report.reached.number < 5
             ? ""
             : fmt::format("ties: {} facets between two cells on one sphere\n", report.ties);
}
std::string ties(const HullData&, const CheckReport& report) {
  return report.reached.number < 3
             ? ""
             : fmt::format("coplanar: {} ridges between two cells in one hyperplane\n", report.ties);
}
std::string ties(const IntersectionData&, const CheckReport&) { return {}; }
std::string ties(const VoronoiData&, const CheckReport&) { return {}; }

/// Throws UsageError for options that are for other kinds of data.
template <class Data>
void require_fitting(const CheckCommandOptions& options) {
  constexpr bool is_complex = std::is_same_v<Data, ComplexData>, is_hull = std::is_same_v<Data, HullData>;
  if (!is_complex && (options.canonical || options.any_orientation || options.furthest_site))
    throw UsageError(fmt::format(
        "{} is no triangulation; --canonical, --any-orientation and --furthest-site are for triangulations",
        input_name(options.path)));
  if (!is_complex && !is_hull && !options.points.path.empty())
    throw UsageError(
        fmt::format("{} is neither a triangulation nor a hull; --points is for triangulations and hulls",
                    input_name(options.path)));
}

/// Takes the points from the other file.
template <class Data>
void replace_points(Data& data, const CheckCommandOptions& options) {
  PointTable table = options.points.read(options.threads);
  if (data.num_points() != 0 && data.dimension != table.dimension)
    throw Error(Errc::bad_dimension, fmt::format("{}: points of dimension {}; those of {} have {}",
                                                 input_name(options.points.path), table.dimension,
                                                 input_name(options.path), data.dimension));
  data.dimension = table.dimension;
  data.points = std::move(table.coordinates);
}

/// Prints the report. Returns the exit status.
template <class Data>
int print_report(const CheckCommandOptions& options, const std::string& held, const CheckReport& report,
                 const std::string& ties_text, const std::string& proved) {
  std::string text = fmt::format("{}: {}\n", input_name(options.path), held);
  for (const CheckLevel& level : check_levels<Data>()) {
    if (level.number > report.reached.number) break;
    const bool failed = !report.ok && level.number == report.reached.number;
    std::string meaning(level.meaning);
    if (const auto at = meaning.find("inside the sphere"); options.furthest_site && at != std::string::npos)
      meaning.replace(at, 6, "outside");
    text +=
        fmt::format("level {}  {:<17}{:<8}{}\n", level.number, level.name, failed ? "FAILED" : "ok", meaning);
  }
  if (!report.ok) {
    text += fmt::format("violation: {}\n", report.violation);
  } else {
    text += ties_text;
    text += report.reached.number == check_levels<Data>().back().number ? proved + ", exactly\n"
                                                                        : "no violation up to this level\n";
    if (options.canonical) text += "ties are decided as the symbolic perturbation decides them\n";
  }
  print_output(text);
  return report.ok ? exit_status::ok : exit_status::check_failed;
}

template <class Data>
int run_check(Data data, const CheckCommandOptions& options) {
  require_fitting<Data>(options);
  if constexpr (std::is_same_v<Data, ComplexData> || std::is_same_v<Data, HullData>)
    if (!options.points.path.empty()) replace_points(data, options);
  CheckOptions check_options;
  check_options.up_to = options.level;
  check_options.threads = options.threads;
  check_options.canonical = options.canonical;
  check_options.oriented = !options.any_orientation;
  check_options.furthest_site = options.furthest_site;
  const CheckReport report = about(input_name(options.path), [&] { return check(data, check_options); });

  return print_report<Data>(options, contents(data), report, ties(data, report), result(data, check_options));
}

/// A folder of tiles.
int run_check_tiles(const CheckCommandOptions& options) {
  if (options.any_orientation || options.furthest_site)
    throw UsageError(fmt::format(
        "{} is a folder of tiles; --any-orientation and --furthest-site are for triangulations in one file",
        input_name(options.path)));
  const TilesIndex index = read_finished(options.path);
  CheckOptions check_options;
  check_options.up_to = options.level;
  check_options.threads = options.threads;
  check_options.canonical = options.canonical;
  std::optional<PointTable> input;
  if (!options.points.path.empty()) input = options.points.read(options.threads);
  const CheckReport report = about(input_name(options.path), [&] {
    return input ? check_tiles(options.path, PointsView(input->coordinates, input->dimension), check_options)
                 : check_tiles(options.path, check_options);
  });
  return print_report<ComplexData>(
      options,
      fmt::format("{} in dimension {}, affine dimension {}, {} in {}",
                  counted(static_cast<std::size_t>(index.num_points), "point"), index.dimension,
                  index.affine_dimension, counted(static_cast<std::size_t>(index.num_cells), "cell"),
                  counted(index.parts.size(), "part")),
      report, ties(ComplexData{}, report),
      fmt::format("a {} triangulation of {}, each point in one part", index.weighted ? "regular" : "Delaunay",
                  !input            ? "its vertices"
                  : !index.weighted ? "all its points"
                                    : "all its points but hidden ones, which are not examined"));
}

template <class Data>
std::string levels_text(const char* title) {
  std::string text = fmt::format("{}:\n", title);
  for (const CheckLevel& level : check_levels<Data>())
    text += fmt::format("  {}  {:<17}{}\n", level.number, level.name, level.meaning);
  return text;
}

}  // namespace

Run add_check(CLI::App& app) {
  auto options = std::make_shared<CheckCommandOptions>();
  app.add_option(
         "COMPLEX", options->path,
         "A triangulation: .npz, .json or .off, or a folder of tiles; or a hull, an intersection, a Voronoi "
         "or power diagram: .npz or .json")
      ->required()
      ->type_name("");
  app.add_option("--format", options->format, "Format of COMPLEX, if not told by its extension")
      ->check(CLI::IsMember(readable_complex_formats()));
  app.add_option("--level", options->level, "The highest level to check; all, if not given")
      ->check(CLI::Range(1, 6));
  app.add_flag("--canonical", options->canonical, "Also require that ties are broken as delone breaks them");
  app.add_flag("--any-orientation", options->any_orientation,
               "Take cells as sets of vertices, as Qhull and SciPy write them: their order means nothing");
  app.add_flag("--furthest-site", options->furthest_site,
               "Require that no point is outside the sphere of a cell; points that are not extreme are not "
               "vertices");
  app.add_option("--points", options->points.path,
                 "Take the points from this file instead; with a folder of tiles, compare with them")
      ->type_name("FILE");
  add_max_stream(app, options->points.options.max_stream_bytes);
  add_threads(app, options->threads);
  app.footer(levels_text<ComplexData>("Levels of triangulations") + levels_text<HullData>("Levels of hulls") +
             levels_text<VoronoiData>("Levels of Voronoi and power diagrams") +
             levels_text<IntersectionData>("Levels of intersections of halfspaces") +
             "Exit status: 0 no violation, 1 a violation, which is printed.");
  return [options] {
    protect_files({options->path, options->points.path}, {{"the report", "-"}});
    if (is_folder(options->path)) return run_check_tiles(*options);
    AnyData data = about(input_name(options->path), [&] {
      return read(options->path, options->format, options->points.options.max_stream_bytes);
    });
    return std::visit([&](auto& held) { return run_check(std::move(held), *options); }, data);
  };
}

}  // namespace delone::cli
