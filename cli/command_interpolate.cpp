// SPDX-License-Identifier: BSD-3-Clause
// delone interpolate: values that are known at points, at other places.
#include "command.hpp"
#include "interrupt.hpp"
#include "memory_limit.hpp"
#include "numbers.hpp"
#include "report.hpp"

#include <delone/natural_neighbors.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace delone::cli {
namespace {

struct InterpolateOptions {
  PointInput input, queries;
  BuildOptions build;
  std::string values, method = "linear";
  std::optional<std::string> outside;
  std::optional<double> fill, tolerance;
  bool smooth = false, coordinates = false;
};

const std::vector<std::string>& table_formats() {
  static const std::vector<std::string> formats{"csv", "tsv", "txt", "npy", "json"};
  return formats;
}

/// The values of `outside`, with what they are called.
constexpr std::pair<const char*, Outside> outsides[] = {{"fill", Outside::fill},
                                                        {"nearest", Outside::nearest},
                                                        {"error", Outside::error},
                                                        {"project", Outside::project}};

Outside outside_of(const InterpolateOptions& options) {
  for (const auto& [name, value] : outsides)
    if (options.outside == name) return value;
  return Outside::fill;
}

void require_sense(const InterpolateOptions& options) {
  if (options.method == "nearest" && (options.outside || options.fill || options.tolerance))
    throw UsageError(
        "--method nearest has a value everywhere: --outside, --fill and --tolerance are for linear and "
        "natural");
  if (options.smooth && options.method != "natural") throw UsageError("--smooth is for --method natural");
  if (options.fill && outside_of(options) != Outside::fill) throw UsageError("--fill is for --outside fill");
  if (options.tolerance && (!(*options.tolerance >= 0) || !std::isfinite(*options.tolerance)))
    throw UsageError("--tolerance: a finite distance of at least 0 was expected");
  if (options.input.path == "-" && options.queries.path == "-")
    throw UsageError("points and queries both from standard input");
}

/// The points with their values, which are columns of theirs or another file.
PointTable read_field(const InterpolateOptions& options) {
  PointInput from = options.input;
  if (!names_a_file(options.values)) {
    from.options.values = split_list(options.values);
    return from.read(options.build.threads);
  }
  if (options.values == "-" && (options.input.path == "-" || options.queries.path == "-"))
    throw UsageError("--values and another input are both standard input");
  PointTable field = from.read(options.build.threads);
  PointTable values = from.read_beside(options.values, options.build.threads);
  if (num_rows(values) != num_rows(field))
    throw Error(Errc::bad_format, fmt::format("{}: expected {} rows of values, one per point, found {}",
                                              input_name(options.values), num_rows(field), num_rows(values)));
  keep_common_rows(field, values);
  field.num_values = values.dimension;
  field.values = std::move(values.coordinates);
  field.value_names = std::move(values.column_names);
  return field;
}

/// "value", or "value0", "value1" … unless there are names.
std::vector<std::string> names_or(const std::vector<std::string>& names, int count,
                                  const std::string& other) {
  if (!names.empty()) return names;
  std::vector<std::string> made;
  for (int i = 0; i < count; ++i) made.push_back(count == 1 ? other : fmt::format("{}{}", other, i));
  return made;
}

std::vector<double> evaluate(const Triangulation& t, const PointTable& field, const PointTable& queries,
                             const InterpolateOptions& options, ProgressBar& bar) {
  const auto columns = static_cast<std::size_t>(field.num_values), q = queries.num_points();
  const std::vector<double> fill(columns, options.fill.value_or(std::numeric_limits<double>::quiet_NaN()));
  std::vector<double> result(q * columns, fill.empty() ? 0 : fill[0]);
  const EvaluateOptions wanted{
      .outside = outside_of(options), .fill = fill, .tolerance = options.tolerance.value_or(0)};
  const Execution how{.threads = options.build.threads, .progress = bar.callback()};
  if (options.method == "linear") {
    LinearInterpolator(t, field.values, columns).evaluate(queries.coordinates, result, wanted, how);
  } else if (options.method == "natural") {
    NaturalNeighborInterpolator(t, field.values, columns, options.smooth, {}, how)
        .evaluate(queries.coordinates, result, wanted, how);
  } else {
    PointLocator(t).nearest(
        queries.coordinates,
        [&](std::size_t query, VertexId v) {
          if (caught_signal() != 0) throw Error(Errc::cancelled, "interrupted");
          if (v == invalid_vertex) return;
          const auto from = field.values.begin() + static_cast<std::ptrdiff_t>(t.row_of(v) * columns);
          std::copy_n(from, columns, result.begin() + static_cast<std::ptrdiff_t>(query * columns));
        },
        how);
  }
  return result;
}

/// How many queries are neither in the hull nor within the tolerance of it.
std::size_t num_outside(const Triangulation& t, const PointTable& queries,
                        const InterpolateOptions& options) {
  std::vector<char> is_outside(queries.num_points());
  const auto note = [&](std::size_t query, const LocatedPoint& where) {
    is_outside[query] =
        where.kind == Location::Kind::outside_hull || where.kind == Location::Kind::outside_affine_hull;
  };
  PointLocator(t).locate(queries.coordinates,
                         {.tolerance = options.tolerance.value_or(0), .coordinates = false}, note,
                         {.threads = options.build.threads});
  return static_cast<std::size_t>(std::count(is_outside.begin(), is_outside.end(), 1));
}

/// What is written: the values, after the coordinates of queries if they are wanted.
PointTable as_table(std::vector<double> values, const PointTable& field, PointTable& queries,
                    const InterpolateOptions& options) {
  PointTable table;
  table.dimension = field.num_values;
  table.column_names = names_or(field.value_names, field.num_values, "value");
  if (!options.coordinates) {
    table.coordinates = std::move(values);
    return table;
  }
  const auto m = static_cast<std::size_t>(field.num_values), d = static_cast<std::size_t>(queries.dimension);
  std::vector<std::string> names = names_or(queries.column_names, queries.dimension, "x");
  table.column_names.insert(table.column_names.begin(), names.begin(), names.end());
  table.dimension += queries.dimension;
  table.coordinates.reserve(queries.num_points() * (m + d));
  for (std::size_t i = 0; i < queries.num_points(); ++i) {
    const auto row = std::span(queries.coordinates).subspan(i * d, d),
               of_row = std::span(values).subspan(i * m, m);
    table.coordinates.insert(table.coordinates.end(), row.begin(), row.end());
    table.coordinates.insert(table.coordinates.end(), of_row.begin(), of_row.end());
  }
  return table;
}

int run_interpolate(InterpolateOptions options) {
  BuildOptions& to = options.build;
  if (to.output.empty() && !to.stats) to.output = "-";
  require_sense(options);
  protect_files({options.input.path, options.queries.path, options.values}, to.outputs(), to.force);
  if (to.output == "-" && to.output_format == "npy")
    throw UsageError("--output-format npy is binary and is not written to standard output");
  const auto write = [](const std::string& path, const PointTable& table, const std::string& format) {
    const StageGuard guard(stage_of_writing(path));
    about(output_name(path), [&] { write_table(path, table, format); });
  };
  if (!to.output.empty() && to.output != "-")
    check_output(to.output, to.output_format, [](const std::string& nowhere, const std::string& format) {
      PointTable nothing;
      nothing.dimension = 1;
      write_table(nowhere, nothing, format);
    });

  const MemoryLimit limit(input_name(options.input.path), to.memory);
  const auto start = Clock::now();
  Cost cost;
  const PointTable field = read_field(options);
  PointInput from = options.queries;
  from.options.max_stream_bytes = options.input.options.max_stream_bytes;
  from.options.skip_missing = options.input.options.skip_missing;
  PointTable queries = from.read(to.threads);
  require_fitting(queries, field, options.queries);
  cost.read = seconds_since(start);

  ProgressBar bar(to.quiet);
  const auto build_start = Clock::now();
  std::optional<Delaunay<>> t;
  {
    const StageGuard guard(Stage::building);
    t.emplace(about(input_name(options.input.path), [&] {
      return Delaunay<>(PointsView(field.coordinates, field.dimension), to.to_options(bar));
    }));
  }
  t->sort_cells();  // in which order values are added does not depend on the threads
  cost.build = seconds_since(build_start);
  const auto interpolate_start = Clock::now();
  std::vector<double> values;
  {
    const StageGuard guard(Stage::building);
    values =
        about(input_name(options.queries.path), [&] { return evaluate(*t, field, queries, options, bar); });
  }
  bar.clear();
  const double interpolate_seconds = seconds_since(interpolate_start);
  const std::size_t num_queries = queries.num_points(),
                    outside = to.stats ? num_outside(*t, queries, options) : 0;
  if (!to.output.empty()) {
    const auto write_start = Clock::now();
    write(to.output, as_table(std::move(values), field, queries, options), to.output_format);
    cost.write = seconds_since(write_start);
  }
  cost.close(start);
  if (!to.stats) return exit_status::ok;
  Json json = stats_of("interpolate", counts_of(*t, t->hash().hex()));
  json["method"] = options.method;
  json["values"] = names_or(field.value_names, field.num_values, "value");
  json["queries"] = num_queries;
  json["outside"] = outside;
  add_cost(json, t->statistics(), static_cast<std::size_t>(t->num_all_cells()), cost, to.seed);
  json["seconds"]["interpolate"] = interpolate_seconds;
  print_output(as_text(json));
  return exit_status::ok;
}

}  // namespace

Run add_interpolate(CLI::App& app) {
  auto options = std::make_shared<InterpolateOptions>();
  options->input.add_to(app, "IN", "Points with values: a file, or - for standard input");
  app.add_option("--values", options->values,
                 "The values: columns of IN, by name, number from 0 or range, or a file with a row per "
                 "point")
      ->required()
      ->type_name("COLUMN,...|FILE");
  add_queries(app, options->queries, "The query points: a file, or -");
  app.add_option("--method", options->method,
                 "linear in each cell, natural neighbors (Sibson), or the value of the nearest point")
      ->check(CLI::IsMember({"linear", "natural", "nearest"}));
  app.add_flag("--smooth", options->smooth,
               "natural: differentiable at the points, too, by estimated gradients");
  std::vector<std::string> names;
  for (const auto& [name, unused] : outsides) names.emplace_back(name);
  app.add_option("--outside", options->outside,
                 "The value of queries outside the convex hull; fill if not given")
      ->check(CLI::IsMember(names));
  app.add_option("--fill", options->fill, "The value of --outside fill; nan if not given")->type_name("X");
  app.add_option("--tolerance", options->tolerance,
                 "Queries within this distance of the hull are inside; 0 if not given")
      ->type_name("DISTANCE");
  app.add_option("-o,--output", options->build.output,
                 "Values, a row per query: .csv .tsv .txt .npy .json; standard output if not given")
      ->type_name("OUT");
  app.add_option("--output-format", options->build.output_format,
                 "Format of OUT, if not told by its extension; csv on standard output")
      ->check(CLI::IsMember(table_formats()));
  app.add_flag("--coordinates", options->coordinates, "Put the coordinates of queries before the values");
  add_force(app, options->build.force);
  add_threads(app, options->build.threads);
  options->build.add_construction(app);
  app.footer(
      "Values of --outside: fill, a constant; nearest, the value of the nearest point; project, the value "
      "at the "
      "nearest\n"
      "point of the hull; error, exit status 2. Which cell a query is in is decided exactly. `nan` is null "
      "in "
      "json.\nOf rows with equal coordinates the first one counts; values must be finite.");
  return [options] { return run_interpolate(*options); };
}

}  // namespace delone::cli
