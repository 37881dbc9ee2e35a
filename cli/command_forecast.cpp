// SPDX-License-Identifier: BSD-3-Clause
// delone forecast: what a Delaunay triangulation will take, from a kind and a number of points or from a
// sample of given points.
#include "build_options.hpp"
#include "command.hpp"
#include "interrupt.hpp"
#include "messages/readable.hpp"
#include "output.hpp"
#include "report.hpp"

#include <delone/forecast.hpp>

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace delone::cli {
namespace {

struct ForecastCommand {
  PointInput input;
  std::string kind = "uniform", count;
  int dimension = 0;
  unsigned threads = 0;
  bool stats = false;
};

Forecast make_forecast(const ForecastCommand& options, const CLI::App& app) {
  const bool has_file = !options.input.path.empty();
  if (has_file && (app.count("-d") > 0 || app.count("-n") > 0 || app.count("--kind") > 0))
    throw UsageError("-d, -n and --kind are for a forecast without points: leave them or the file out");
  if (!has_file && (app.count("-d") == 0 || app.count("-n") == 0))
    throw UsageError("a file of points is needed, or -d and -n");
  if (!has_file)
    return forecast(options.dimension, count_of(options.count), options.kind, {.threads = options.threads});
  const PointTable table = options.input.read(options.threads);
  const StageGuard guard(Stage::building);
  return about(input_name(options.input.path), [&] {
    return estimate(PointsView(table.coordinates, table.dimension), table.dimension,
                    {.threads = options.threads});
  });
}

Json json_of(const ForecastQuantity& quantity) {
  return {{"expected", quantity.expected}, {"low", quantity.low}, {"high", quantity.high}};
}

template <class Text>
std::string in_words(const ForecastQuantity& quantity, Text text) {
  if (quantity.low == quantity.high) return text(quantity.expected);
  return fmt::format("{} ({} to {})", text(quantity.expected), text(quantity.low), text(quantity.high));
}

int run_forecast(const ForecastCommand& options, const CLI::App& app) {
  const Forecast found = make_forecast(options, app);
  if (options.stats) {
    Json json;
    json["command"] = "forecast";
    json["dimension"] = found.dimension;
    json["affine_dimension"] = found.affine_dimension;
    json["points"] = found.num_points;
    json["sampled"] = found.num_sampled;
    json["vertices"] = json_of(found.vertices);
    json["cells"] = json_of(found.cells);
    json["bytes"] = json_of(found.bytes);
    json["seconds"] = json_of(found.seconds);
    json["threads"] = found.threads;
    json["version"] = DELONE_VERSION;
    print_output(json.dump(2) + "\n");
    return exit_status::ok;
  }
  const bool has_file = !options.input.path.empty();
  const std::string points =
      fmt::format("{} in dimension {}", counted(found.num_points, "point"), found.dimension);
  Summary summary(has_file ? options.input.path : options.kind,
                  "a Delaunay triangulation of " + points + " will take about");
  if (found.affine_dimension < found.dimension)
    summary.affine_dimension(found.affine_dimension, found.dimension, "triangulated inside its flat");
  if (found.vertices.expected < static_cast<double>(found.num_points))
    summary.line("vertices", in_words(found.vertices, [](double x) { return fmt::format("{:.3g}", x); }));
  summary.line("cells", in_words(found.cells, [](double x) { return fmt::format("{:.3g}", x); }));
  summary.line("memory", in_words(found.bytes, messages::readable_bytes));
  summary.line("time", in_words(found.seconds, messages::readable_seconds) +
                           fmt::format(", {} thread{}", found.threads, found.threads == 1 ? "" : "s"));
  if (has_file) summary.line("sample", counted(found.num_sampled, "point"));
  if (const std::string text = memory_warning(found); !text.empty()) summary.line("warning", text);
  print_output(summary.text());
  return exit_status::ok;
}

}  // namespace

Run add_forecast(CLI::App& app) {
  auto options = std::make_shared<ForecastCommand>();
  options->input.add_to(app, "IN",
                        "Points: a file, or - for standard input; or leave it out and give -d and -n");
  app.get_option("IN")->required(false);
  app.add_option("-d,--dimension", options->dimension, "Coordinates per point")
      ->check(CLI::Range(1, 1000000));
  app.add_option("-n,--points", options->count, "The number of points, such as 1000 or 1e6")->type_name("N");
  std::vector<std::string> names;
  for (const PointSetKind& kind : point_set_kinds()) names.emplace_back(kind.name);
  app.add_option("--kind", options->kind,
                 "The kind of points, see 'delone generate --help'; uniform if not given")
      ->type_name("KIND")
      ->check(CLI::IsMember(names).description(""));
  add_threads(app, options->threads);
  app.add_flag("--stats", options->stats, "Print one JSON object");
  return [options, &app] { return run_forecast(*options, app); };
}

}  // namespace delone::cli
