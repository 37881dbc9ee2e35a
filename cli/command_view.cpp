// SPDX-License-Identifier: BSD-3-Clause
// delone view: a page for a browser.
#include "build_options.hpp"
#include "command.hpp"
#include "interrupt.hpp"
#include "memory_limit.hpp"
#include "messages/in_quotes.hpp"
#include "output.hpp"
#include "progress_bar.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

namespace delone::cli {
namespace {

struct ViewOptions {
  PointInput input;
  BuildOptions build;
  std::string product, values, title;
  std::vector<double> box;
};

/// A file with one column.
PointTable read_values(const ViewOptions& options) {
  PointTable table = options.input.read_beside(options.values, options.build.threads);
  if (table.num_points() > 0 && table.dimension != 1)
    throw Error(Errc::bad_format, fmt::format("{}: expected one value per row, found {} columns",
                                              input_name(options.values), table.dimension));
  return table;
}

std::string title_of(const ViewOptions& options) {
  if (!options.title.empty()) return options.title;
  return options.input.path == "-" ? "" : std::filesystem::path(options.input.path).stem().string();
}

/// Throws UsageError for options that have no effect on what the file holds.
void require_use(const ViewOptions& options, bool is_points, bool is_diagram) {
  const std::string name = input_name(options.input.path);
  if (!is_points && !options.product.empty())
    throw UsageError("--of says what to make of points, and " + name + " holds a result");
  if (!is_points && !options.input.options.columns.empty())
    throw UsageError("--columns is for points, and " + name + " holds a result");
  if (!is_points && options.input.options.skip_missing)
    throw UsageError("--skip-missing is for points, and " + name + " holds a result");
  if (!is_diagram && !options.box.empty())
    throw UsageError("--box cuts Voronoi and power diagrams, and none is shown");
}

std::optional<Box> box_of(const ViewOptions& options, int dimension) {
  if (options.box.empty()) return std::nullopt;
  const auto d = static_cast<std::ptrdiff_t>(dimension);
  if (options.box.size() != 2 * static_cast<std::size_t>(dimension))
    throw UsageError(
        fmt::format("--box takes {} numbers for dimension {}, not {}", 2 * d, dimension, options.box.size()));
  return Box{{options.box.begin(), options.box.begin() + d}, {options.box.begin() + d, options.box.end()}};
}

constexpr std::size_t many_cells = 200'000;  // notes tell the size of their page

/// What a page draws of a result: how many, what they are called, and about how many bytes each takes.
struct Content {
  std::size_t count;
  const char* name;
  double bytes;
};
Content content_of(const Diagram& diagram) {
  return {diagram.num_regions(), "regions", diagram.dimension() == 3 ? 210.0 : 34.0};
}
Content content_of(const IntersectionData& data) { return {data.num_facets(), "facets", 34}; }
Content content_of(const ComplexData& data) { return {data.num_cells(), "cells", 13}; }
Content content_of(const HullData& data) { return {data.num_cells(), "cells", 13}; }

/// The page of a result. The bar, which showed how it was built, begins again.
template <class Result, class... BoxOrNothing>
std::string make_page(const Result& result, const HtmlOptions& html, const ViewOptions& options,
                      ProgressBar& bar, const BoxOrNothing&... box) {
  constexpr double program = 0.6;  // megabytes
  const Content content = content_of(result);
  const bool tells = content.count >= many_cells && !options.build.quiet;
  const std::string name = output_name(options.build.output);
  bar.restart();
  if (tells)
    print_note(fmt::format("{}: a page of {} {}, about {:.0f} MB\n", name, content.count, content.name,
                           program + content.bytes * static_cast<double>(content.count) / 1e6));
  const Execution how{.threads = options.build.threads, .progress = bar.callback()};
  std::string page = to_html(result, html, box..., how);
  bar.clear();
  if (tells)
    print_note(fmt::format("{}: {} {}, {:.1f} MB\n", name, content.count, content.name,
                           static_cast<double>(page.size()) / 1e6));
  return page;
}

/// The diagram of the points and weights of a file, made again: regions are cut at a box exactly.
std::string page_of(const VoronoiData& data, HtmlOptions html, const ViewOptions& options) {
  html.column_names = data.column_names;
  ProgressBar bar(options.build.quiet);
  const StageGuard guard(Stage::building);
  const DiagramOptions wanted{.tolerance = data.tolerance, .axis_tolerances = data.axis_tolerances};
  const Execution how{.threads = options.build.threads};
  const Options build = options.build.to_options(bar);
  if (data.kind == DataKind::furthest_voronoi)
    return make_page(FurthestVoronoi(FurthestSite<>(data.points, data.dimension, build), wanted, how), html,
                     options, bar, box_of(options, data.dimension));
  if (data.weights.empty())
    return make_page(Voronoi(Delaunay<>(data.points, data.dimension, build), wanted, how), html, options, bar,
                     box_of(options, data.dimension));
  return make_page(PowerDiagram(Regular<>(data.points, data.weights, data.dimension, build), wanted, how),
                   html, options, bar, box_of(options, data.dimension));
}

std::string page_of(const PointTable& points, const HtmlOptions& html, const ViewOptions& options) {
  ProgressBar bar(options.build.quiet);
  const StageGuard guard(Stage::building);
  const Options build = options.build.to_options(bar);
  if (options.product == "hull")
    return make_page(ConvexHull<>(points.coordinates, points.dimension, build).to_data(), html, options, bar);
  Delaunay<> triangulation(points.coordinates, points.dimension, build);
  triangulation.sort_cells();
  if (options.product == "voronoi")
    return make_page(Voronoi(triangulation, {}, {.threads = options.build.threads}), html, options, bar,
                     box_of(options, points.dimension));
  return make_page(triangulation.to_data(), html, options, bar);
}

int run_view(const ViewOptions& options) {
  if (options.input.path == "-" && options.values == "-")
    throw UsageError("--values and the points are both standard input");
  protect_files({options.input.path, options.values}, {{"--output", options.build.output}},
                options.build.force);
  require_extension(options.build.output, {"html", "htm"}, "a page");
  check_writable(options.build.output);
  const MemoryLimit limit(input_name(options.input.path), options.build.memory);
  const std::string name = input_name(options.input.path);
  HtmlOptions html;
  html.title = title_of(options);
  std::optional<AnyData> data =
      try_read(options.input.path, options.input.options.format, options.input.options.max_stream_bytes);
  require_use(options, !data,
              data ? std::holds_alternative<VoronoiData>(*data) : options.product == "voronoi");
  const bool values_are_file = names_a_file(options.values);
  PointTable values;
  if (values_are_file) values = read_values(options);
  if (!options.values.empty()) html.value_name = std::filesystem::path(options.values).stem().string();
  if (data && !options.values.empty() && !values_are_file)
    throw UsageError(fmt::format("--values {}: there is no such file", messages::in_quotes(options.values)));
  std::string page;
  if (data) {
    html.values = std::move(values.coordinates);
    page = about(name, [&] {
      return std::visit(
          [&](const auto& held) {
            if constexpr (std::is_same_v<std::decay_t<decltype(held)>, VoronoiData>) {
              return page_of(held, html, options);
            } else {
              ProgressBar bar(options.build.quiet);
              const StageGuard guard(Stage::building);
              return make_page(held, html, options, bar);
            }
          },
          *data);
    });
  } else {
    PointInput input = options.input;
    if (!options.values.empty() && !values_are_file) input.options.values = {options.values};
    PointTable points = input.read(options.build.threads);
    if (num_rows(values) == num_rows(points)) keep_common_rows(points, values);
    html.values = std::move(values.coordinates);
    if (points.num_values == 1) html.values = std::move(points.values);
    if (points.num_values == 1 && !points.value_names.empty()) html.value_name = points.value_names[0];
    html.column_names = points.column_names;
    page = about(name, [&] { return page_of(points, html, options); });
  }
  save_text(options.build.output, page);
  return exit_status::ok;
}

}  // namespace

Run add_view(CLI::App& app) {
  auto options = std::make_shared<ViewOptions>();
  options->build.output = "-";
  app.add_option("FILE", options->input.path,
                 "Points, or any output of delone except a folder of tiles; - for points from standard input")
      ->required()
      ->type_name("");
  std::vector<std::string> formats = point_formats();
  formats.insert(formats.end(), {"npz", "json"});
  app.add_option("--format", options->input.options.format, "Format of FILE, if not told by its extension")
      ->check(CLI::IsMember(formats));
  add_columns(app, "--columns", options->input.options.columns);
  add_skip_missing(app, options->input.options.skip_missing);
  app.add_option("-o,--output", options->build.output, "The page, .html; standard output if not given")
      ->type_name("OUT");
  app.add_option("--of", options->product,
                 "What to make of points: delaunay, hull or voronoi; delaunay if not given")
      ->check(CLI::IsMember({"delaunay", "hull", "voronoi"}));
  app.add_option(
         "--values", options->values,
         "Values to color by: a column of points by its name or number from 0, or a file with one per row, "
         "cell, region or facet")
      ->type_name("COLUMN|FILE");
  app.add_option("--box", options->box,
                 "Clip a Voronoi or power diagram to this box: all lower limits, then all upper ones; a "
                 "box around the "
                 "points if not "
                 "given")
      ->delimiter(',')
      ->type_name("LOW,...,HIGH,...");
  app.add_option("--title", options->title, "The title of the page; the name of FILE if not given")
      ->type_name("TEXT");
  add_force(app, options->build.force);
  options->build.add_limits(app, "what is shown");
  add_max_stream(app, options->input.options.max_stream_bytes);
  add_threads(app, options->build.threads);
  app.footer("The page is self-contained and needs no network.");
  return [options] { return run_view(*options); };
}

}  // namespace delone::cli
