// SPDX-License-Identifier: BSD-3-Clause
// delone check: the six levels, exactly, on a triangulation from any program; the five of a hull or of a
// Voronoi diagram and the three of an intersection of halfspaces on what delone wrote.
#include "check_halfspaces.hpp"
#include "check_voronoi.hpp"
#include "command.hpp"
#include "output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <variant>

namespace delone::cli {
namespace {

struct CheckCommandOptions {
  std::string path, format;
  PointInput points;
  int level = 6;
  bool canonical = false;
  bool any_orientation = false;
  bool furthest_site = false;
};

struct Level {
  const char* name;
  const char* meaning;
};
constexpr std::array<Level, 6> levels{
    {{"storage", "sizes, ranges, no repeated vertex in a cell"},
     {"incidence", "neighbors are mutual, facets shared by two, coherent orientation"},
     {"sphere", "closed by the infinite cells, a sphere"},
     {"volume", "every cell has positive volume"},
     {"local convexity", "no vertex inside the sphere of a cell, the hull is convex"},
     {"completeness", "every point is a vertex or a duplicate of one"}}};

constexpr std::array<Level, 5> hull_levels{
    {{"storage", "sizes, ranges, no repeated vertex in a cell"},
     {"incidence", "every ridge in two cells, neighbors mutual, coherent orientation, connected"},
     {"convexity", "no cell is flat, the boundary is convex at every ridge"},
     {"support", "no point is beyond a cell, the cells cover the boundary once"},
     {"completeness", "facets, extreme points and kinds of points are those of the polytope"}}};

/// Takes the points from the other file if one is given.
template <class Data>
void replace_points(Data& data, const CheckCommandOptions& options, const char* what) {
  if (options.points.path.empty()) return;
  PointTable table = options.points.read();
  if (data.num_points() != 0 && data.dimension != table.dimension)
    throw Error(Errc::bad_dimension, fmt::format("{}: points of dimension {} for a {} in dimension {}",
                                                 options.points.path, table.dimension, what, data.dimension));
  data.dimension = table.dimension;
  data.points = std::move(table.coordinates);
}

int run_hull_check(HullData data, const CheckCommandOptions& options) {
  if (options.canonical || options.any_orientation || options.furthest_site)
    throw UsageError(
        fmt::format("{} is a hull; --canonical, --any-orientation and --furthest-site are for triangulations",
                    options.path));
  replace_points(data, options, "hull");
  const auto level = std::min(static_cast<std::size_t>(options.level), hull_levels.size());
  const HullCheckReport report =
      about(options.path, [&] { return check_hull(data, static_cast<HullCheckLevel>(level)); });
  std::string text = fmt::format(
      "{}: the hull of {} points in dimension {}, affine dimension {}, {} facets, {} cells\n", options.path,
      data.num_points(), data.dimension, data.affine_dimension, data.num_facets(), data.num_cells());
  const auto reached = static_cast<std::size_t>(report.reached);
  for (std::size_t i = 1; i <= reached; ++i)
    text += fmt::format("level {}  {:<17}{:<8}{}\n", i, hull_levels[i - 1].name,
                        !report.ok && i == reached ? "FAILED" : "ok", hull_levels[i - 1].meaning);
  if (report.ok) {
    if (report.reached >= HullCheckLevel::convexity)
      text +=
          fmt::format("coplanar: {} ridges between two cells in one hyperplane\n", report.coplanar_ridges);
    text += level == hull_levels.size() ? "the convex hull of all its points, exactly\n"
                                        : "no violation up to this level\n";
  } else {
    text += fmt::format("violation: {}\n", report.violation);
  }
  print_output(text);
  return report.ok ? exit_status::ok : exit_status::check_failed;
}

/// Whether the file is a Voronoi or power diagram; no other option than --level is for these.
bool is_diagram(const CheckCommandOptions& options) {
  if (!about(options.path, [&] { return holds_voronoi(options.path, options.format); })) return false;
  if (options.canonical || options.any_orientation || options.furthest_site || !options.points.path.empty())
    throw UsageError(
        fmt::format("{} is a Voronoi diagram; --canonical, --any-orientation, --furthest-site and --points "
                    "are for triangulations",
                    options.path));
  return true;
}

int run_check(const CheckCommandOptions& options) {
  if (is_diagram(options)) return run_voronoi_check(options.path, options.format, options.level);
  std::variant<ComplexData, HullData, IntersectionData> file =
      about(options.path, [&] { return read_any(options.path, options.format); });
  if (const IntersectionData* found = std::get_if<IntersectionData>(&file)) {
    if (options.canonical || options.any_orientation || options.furthest_site || !options.points.path.empty())
      throw UsageError(fmt::format(
          "{} is an intersection of halfspaces; --canonical, --any-orientation, --furthest-site and "
          "--points are for triangulations and hulls",
          options.path));
    return run_halfspaces_check(*found, options.path, options.level);
  }
  if (HullData* hull = std::get_if<HullData>(&file)) return run_hull_check(std::move(*hull), options);
  ComplexData& data = std::get<ComplexData>(file);
  replace_points(data, options, "triangulation");
  CheckOptions check_options;
  check_options.up_to = static_cast<CheckLevel>(options.level);
  check_options.canonical = options.canonical;
  check_options.oriented = !options.any_orientation;
  check_options.furthest_site = options.furthest_site;
  const CheckReport report = about(options.path, [&] { return check(data, check_options); });

  std::string text =
      fmt::format("{}: {} points in dimension {}, affine dimension {}, {} cells\n", options.path,
                  data.num_points(), data.dimension, data.affine_dimension, data.num_cells());
  const auto reached = static_cast<std::size_t>(report.reached);
  for (std::size_t i = 1; i <= levels.size() && i <= reached; ++i) {
    const bool failed = !report.ok && i == reached;
    const bool other_side =
        options.furthest_site && i == static_cast<std::size_t>(CheckLevel::local_convexity);
    text += fmt::format(
        "level {}  {:<17}{:<8}{}\n", i, levels[i - 1].name, failed ? "FAILED" : "ok",
        other_side ? "no vertex outside the sphere of a cell, the hull is convex" : levels[i - 1].meaning);
  }
  if (report.ok) {
    if (reached >= static_cast<std::size_t>(CheckLevel::local_convexity))
      text += fmt::format("ties: {} facets between two cells on one sphere\n", report.ties);
    const char* kind = options.furthest_site  ? "furthest-site Delaunay"
                       : data.weights.empty() ? "Delaunay"
                                              : "regular";
    text += options.level == 6 ? fmt::format("a {} triangulation of all its points, exactly\n", kind)
                               : std::string("no violation up to this level\n");
    if (options.canonical) text += "ties are decided as the symbolic perturbation decides them\n";
  } else {
    text += fmt::format("violation: {}\n", report.violation);
  }
  print_output(text);
  return report.ok ? exit_status::ok : exit_status::check_failed;
}

}  // namespace

Run add_check(CLI::App& app) {
  auto options = std::make_shared<CheckCommandOptions>();
  app.add_option("COMPLEX", options->path,
                 "A triangulation: .npz, .json or .off; or a hull, an intersection, a Voronoi or power "
                 "diagram: .npz or .json")
      ->required()
      ->type_name("");
  app.add_option("--format", options->format, "Format of COMPLEX, if not told by its extension")
      ->check(CLI::IsMember(readable_complex_formats()));
  app.add_option("--level", options->level, "The highest level to check")->check(CLI::Range(1, 6));
  app.add_flag("--canonical", options->canonical, "Ask also for the choice among ties that delone makes");
  app.add_flag("--any-orientation", options->any_orientation,
               "Take cells as sets of vertices, as Qhull and SciPy write them: their order means nothing");
  app.add_flag(
      "--furthest-site", options->furthest_site,
      "Ask that no point is outside the sphere of a cell; points that are not extreme are no vertices");
  app.add_option("--points", options->points.path, "Take the points from this file instead")
      ->type_name("FILE");
  std::string footer = "Levels:\n";
  for (std::size_t i = 0; i < levels.size(); ++i)
    footer += fmt::format("  {}  {:<17}{}\n", i + 1, levels[i].name, levels[i].meaning);
  footer += "Levels of hulls:\n";
  for (std::size_t i = 0; i < hull_levels.size(); ++i)
    footer += fmt::format("  {}  {:<17}{}\n", i + 1, hull_levels[i].name, hull_levels[i].meaning);
  footer += voronoi_levels_text();
  footer += halfspaces_check_footer();
  app.footer(footer + "Exit status: 0 no violation, 1 a violation, which is printed.");
  return [options] { return run_check(*options); };
}

}  // namespace delone::cli
