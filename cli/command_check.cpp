// SPDX-License-Identifier: BSD-3-Clause
// delone check: every level of exact checks of what a file holds, from any program.
#include "build_options.hpp"
#include "check_descriptions.hpp"
#include "command.hpp"
#include "output.hpp"
#include "tiles_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

namespace delone::cli {
namespace {

struct CheckCommandOptions {
  std::string path, format, same_as;
  PointInput points;
  int level = CheckOptions::all;
  bool canonical = false;
  bool any_orientation = false;
  bool furthest_site = false;
  unsigned threads = 0;
};

/// What data are examined as, if they do not say what they are.
template <class Data>
DataKind kind_of(const Data&, const CheckCommandOptions&) {
  return Data::kind;
}
DataKind kind_of(const ComplexData& data, const CheckCommandOptions& options) {
  return data.kind != DataKind::unknown ? data.kind
         : options.furthest_site        ? DataKind::furthest_site
         : data.weights.empty()         ? DataKind::delaunay
                                        : DataKind::regular;
}
DataKind kind_of(const VoronoiData& data, const CheckCommandOptions&) { return data.kind; }

/// "Delaunay triangulation"
std::string_view without_article(DataKind kind) {
  const std::string_view description = description_of(kind);
  return description.substr(description.find(' ') + 1);
}

/// What the file holds, with its numbers.
std::string contents(const ComplexData& data) {
  const std::string text =
      fmt::format("{} in dimension {}, affine dimension {}, {}", counted(data.num_points(), "point"),
                  data.dimension, data.affine_dimension, counted(data.num_cells(), "cell"));
  return data.kind == DataKind::unknown ? text : fmt::format("{} of {}", description_of(data.kind), text);
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
  return fmt::format("the {} of {} in dimension {}, affine dimension {}, {}, {} vertices",
                     without_article(data.kind), counted(data.num_points(), "point"), data.dimension,
                     data.affine_dimension, counted(data.num_regions(), "region"), data.num_vertices());
}

/// What has been proved once all levels are passed.
std::string result(const ComplexData& data, DataKind kind) {
  switch (kind) {
    case DataKind::alpha_complex:
    case DataKind::trimmed:
      return fmt::format("cells of the {} triangulation of all its points",
                         data.weights.empty() ? "Delaunay" : "regular");
    case DataKind::alpha_boundary:
      return "facets that enclose something";
    case DataKind::lower_hull:
    case DataKind::upper_hull:
      return data.tolerance == 0 ? fmt::format("the {} of all its points", without_article(kind))
                                 : fmt::format("the {} of its vertices, all points within the tolerance",
                                               without_article(kind));
    case DataKind::hull_boundary:
      return "the convex hull of all its points";
    default:
      return fmt::format("{} of all its points", description_of(kind));
  }
}
std::string result(const HullData& data, DataKind) {
  return data.tolerance == 0 ? "the convex hull of all its points"
                             : "the convex hull of its vertices, all points within the tolerance";
}
std::string result(const IntersectionData&, DataKind) { return "the intersection of all its halfspaces"; }
std::string result(const VoronoiData&, DataKind kind) {
  return fmt::format("the {} of all its points", without_article(kind));
}

/// The ties, once the level that finds them has been passed.
std::string ties(const HullData&, const CheckReport& report);
std::string ties(const ComplexData& data, const CheckReport& report) {
  if (data.kind == DataKind::hull_boundary) return ties(HullData{}, report);
  const bool is_envelope = data.kind == DataKind::lower_hull || data.kind == DataKind::upper_hull;
  return report.reached.number < 5 ? ""
                                   : fmt::format("ties: {} facets between two cells {}\n", report.ties,
                                                 is_envelope ? "in one hyperplane" : "on one sphere");
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

/// The same of options that are not for simplices of every kind.
void require_fitting_kind(const ComplexData& data, const CheckCommandOptions& options) {
  const auto refuse = [&](std::string_view option, std::string_view use) {
    throw UsageError(fmt::format("{} says that it holds {}; {} is for {}", input_name(options.path),
                                 description_of(data.kind), option, use));
  };
  if (options.furthest_site && data.kind != DataKind::unknown && data.kind != DataKind::furthest_site)
    refuse("--furthest-site", "files that do not say what they hold");
  const bool is_hull = data.kind >= DataKind::lower_hull || data.kind == DataKind::alpha_boundary;
  if (options.canonical && is_hull) refuse("--canonical", "triangulations and parts of them");
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
int print_report(const CheckCommandOptions& options, DataKind kind, const std::string& held,
                 const CheckReport& report, const std::string& ties_text, const std::string& proved) {
  std::string text = fmt::format("{}: {}\n", input_name(options.path), held);
  for (const CheckLevel& level : check_levels(kind)) {
    if (level.number > report.reached.number) break;
    const bool failed = !report.ok && level.number == report.reached.number;
    text += fmt::format("level {}  {:<17}{:<8}{}\n", level.number, level.name, failed ? "FAILED" : "ok",
                        level.meaning);
  }
  if (!report.ok) {
    text += fmt::format("violation: {}\n", report.violation);
  } else {
    text += ties_text;
    text += report.reached.number == check_levels(kind).back().number ? proved + ", exactly\n"
                                                                      : "no violation up to this level\n";
    if (!report.not_examined.empty()) text += fmt::format("not examined: {}\n", report.not_examined);
    if (options.canonical) text += "ties are decided as the symbolic perturbation decides them\n";
  }
  print_output(text);
  return report.ok ? exit_status::ok : exit_status::check_failed;
}

template <class Data>
int run_check(Data data, const CheckCommandOptions& options) {
  require_fitting<Data>(options);
  if constexpr (std::is_same_v<Data, ComplexData>) require_fitting_kind(data, options);
  if constexpr (std::is_same_v<Data, ComplexData> || std::is_same_v<Data, HullData>)
    if (!options.points.path.empty()) replace_points(data, options);
  CheckOptions check_options;
  check_options.up_to = options.level;
  check_options.canonical = options.canonical;
  check_options.oriented = !options.any_orientation;
  check_options.furthest_site = options.furthest_site;
  const CheckReport report = about(input_name(options.path),
                                   [&] { return check(data, check_options, {.threads = options.threads}); });

  const DataKind kind = kind_of(data, options);
  return print_report(options, kind, contents(data), report, ties(data, report), result(data, kind));
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
  check_options.canonical = options.canonical;
  if (index.lattice.rank() > 0 && !options.points.path.empty())
    throw UsageError(
        fmt::format("--points: {} has tiles of a periodic set, which are not compared with points",
                    input_name(options.path)));
  std::optional<PointTable> input;
  if (!options.points.path.empty()) input = options.points.read(options.threads);
  const CheckReport report = about(input_name(options.path), [&] {
    const Execution how{.threads = options.threads};
    return input ? check_tiles(options.path, PointsView(input->coordinates, input->dimension), check_options,
                               how)
                 : check_tiles(options.path, check_options, how);
  });
  return print_report(
      options, DataKind::unknown,
      fmt::format("{} in dimension {}, affine dimension {}, {} in {}",
                  counted(static_cast<std::size_t>(index.num_points), "point"), index.dimension,
                  index.affine_dimension, counted(static_cast<std::size_t>(index.num_cells), "cell"),
                  counted(index.parts.size(), "part")),
      report, ties(ComplexData{}, report),
      fmt::format("a {}{} triangulation of {}, each point in one part",
                  index.lattice.rank() > 0 ? "periodic " : "", index.weighted ? "regular" : "Delaunay",
                  !input            ? "its vertices"
                  : !index.weighted ? "all its points"
                                    : "all its points but hidden ones, which are not examined"));
}

std::string levels_text(DataKind kind, const char* title) {
  std::string text = fmt::format("{}:\n", title);
  for (const CheckLevel& level : check_levels(kind))
    text += fmt::format("  {}  {:<17}{}\n", level.number, level.name, level.meaning);
  return text;
}

}  // namespace

Run add_check(CLI::App& app) {
  auto options = std::make_shared<CheckCommandOptions>();
  app.add_option(
         "COMPLEX", options->path,
         "A triangulation: .npz, .json or .off, or a folder of tiles; or a hull, an intersection, a Voronoi "
         "or power diagram: .npz or .json; or, with --same-as, a description of a polyhedron: .ine or .ext")
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
               "For a file that does not say what it holds: require that no point is outside the sphere of a "
               "cell; points that are not extreme are not vertices");
  app.add_option("--points", options->points.path,
                 "Take the points from this file instead; with a folder of tiles, compare with them")
      ->type_name("FILE");
  app.add_option(
         "--same-as", options->same_as,
         "Prove that this file describes the same polyhedron: inequalities or generators in the form of "
         "cddlib and lrs, as COMPLEX")
      ->type_name("FILE");
  add_skip_missing(app, options->points.options.skip_missing);
  add_max_stream(app, options->points.options.max_stream_bytes);
  add_threads(app, options->threads);
  app.footer(levels_text(DataKind::unknown, "Levels of triangulations") +
             levels_text(DataKind::lower_hull, "Levels of lower hulls; of upper hulls alike") +
             levels_text(DataKind::alpha_complex, "Levels of alpha complexes and trimmed triangulations") +
             levels_text(DataKind::alpha_boundary, "Levels of boundaries of alpha complexes") +
             levels_text(DataKind::convex_hull, "Levels of hulls") +
             levels_text(DataKind::voronoi, "Levels of Voronoi and power diagrams") +
             levels_text(DataKind::halfspace_intersection, "Levels of intersections of halfspaces") +
             "Exit status: 0 no violation, 1 a violation, which is printed.");
  return [options] {
    protect_files({options->path, options->points.path, options->same_as}, {{"the report", "-"}});
    if (!options->same_as.empty())
      return run_check_descriptions(options->path, options->same_as, options->points.options.max_stream_bytes,
                                    options->threads);
    if (is_folder(options->path)) return run_check_tiles(*options);
    AnyData data = about(input_name(options->path), [&] {
      return read(options->path, options->format, options->points.options.max_stream_bytes);
    });
    return std::visit([&](auto& held) { return run_check(std::move(held), *options); }, data);
  };
}

}  // namespace delone::cli
