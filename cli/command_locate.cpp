// SPDX-License-Identifier: BSD-3-Clause
// delone locate: where query points lie in the triangulation of other points, exactly.
#include "build_options.hpp"
#include "command.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress_bar.hpp"

#include <delone/point_locator.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace delone::cli {
namespace {

struct LocateOptions {
  PointInput input, queries;
  std::string output = "-", output_format;
  bool quiet = false, force = false;
  unsigned threads = 0;
};

const char* name_of(Location::Kind kind) {
  switch (kind) {
    case Location::Kind::in_cell:
      return "in_cell";
    case Location::Kind::on_face:
      return "on_face";
    case Location::Kind::on_vertex:
      return "on_vertex";
    case Location::Kind::outside_hull:
      return "outside_hull";
    case Location::Kind::outside_affine_hull:
      break;
  }
  return "outside_affine_hull";
}

LocatedPoints locate_all(const PointTable& points, const PointTable& queries, const LocateOptions& options) {
  ProgressBar bar(options.quiet);
  const StageGuard guard(Stage::building);
  Options build_options;
  build_options.progress = bar.callback();
  const Delaunay<> t = about(input_name(options.input.path),
                             [&] { return Delaunay<>(points.coordinates, points.dimension, build_options); });
  const ProgressScope scope([](double) { return caught_signal() == 0; });
  return PointLocator(t).locate(queries.coordinates, {}, CellNumbers(t.complex()),
                                {.threads = options.threads});
}

/// The rows of a face.
std::span<const SignedIndex> face(const LocatedPoints& answers, std::size_t query) {
  const auto begin = static_cast<std::size_t>(answers.face_offsets[query]),
             end = static_cast<std::size_t>(answers.face_offsets[query + 1]);
  return std::span(answers.face_rows).subspan(begin, end - begin);
}

std::string as_csv(const LocatedPoints& answers) {
  std::string text = "query,kind,cell,face\n";
  for (std::size_t i = 0; i < answers.cells.size(); ++i) {
    text.append(std::to_string(i)).append(",").append(name_of(answers.kinds[i])).append(",");
    text.append(std::to_string(answers.cells[i]));
    char separator = ',';
    for (const SignedIndex row : face(answers, i)) {
      text.append(1, separator).append(std::to_string(row));
      separator = ' ';
    }
    text.append(separator == ',' ? ",\n" : "\n");
  }
  return text;
}

std::string as_json(const LocatedPoints& answers) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < answers.cells.size(); ++i)
    rows.push_back({{"query", i},
                    {"kind", name_of(answers.kinds[i])},
                    {"cell", answers.cells[i]},
                    {"face", face(answers, i)}});
  return rows.dump(1) + "\n";
}

int run_locate(const LocateOptions& options) {
  std::string format = options.output_format;
  protect_files({options.input.path, options.queries.path}, {{"--output", options.output}}, options.force);
  if (format.empty()) format = options.output == "-" ? "csv" : chosen_format(options.output, format);
  require_format(options.output, format, {"csv", "json"}, "answers");
  check_writable(options.output);
  if (options.input.path == "-" && options.queries.path == "-")
    throw UsageError("points and queries both from standard input");
  PointInput from = options.queries;
  from.options.max_stream_bytes = options.input.options.max_stream_bytes;
  from.options.skip_missing = options.input.options.skip_missing;
  const PointTable points = options.input.read(options.threads), queries = from.read(options.threads);
  require_fitting(queries, points, options.queries);
  const LocatedPoints answers = locate_all(points, queries, options);
  save_text(options.output, format == "json" ? as_json(answers) : as_csv(answers));
  return exit_status::ok;
}

}  // namespace

Run add_locate(CLI::App& app) {
  auto options = std::make_shared<LocateOptions>();
  options->input.add_to(app, "IN", "Points to triangulate: a file, or - for standard input");
  add_queries(app, options->queries, "Points to locate: a file, or -");
  app.add_option("-o,--output", options->output, "Answers: .csv or .json; standard output if not given")
      ->type_name("OUT");
  app.add_option("--output-format", options->output_format,
                 "csv or json, if not told by the extension of OUT")
      ->check(CLI::IsMember({"csv", "json"}));
  add_force(app, options->force);
  app.add_flag("-q,--quiet", options->quiet, "No progress bar");
  add_threads(app, options->threads);
  app.footer(
      "One row for each query: its number, its kind (in_cell, on_face, on_vertex, outside_hull, "
      "outside_affine_hull), a cell\n"
      "that contains it (a row of `cells` as written by `delone delaunay`, -1 if none), and the rows of the "
      "points that\n"
      "span the smallest face that contains it.");
  return [options] { return run_locate(*options); };
}

}  // namespace delone::cli
