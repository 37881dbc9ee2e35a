// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace delone::cli {

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Counts counts_of(const Triangulation& t, std::string hash) {
  return {t.dimension(),      t.affine_dimension(), t.num_points(),         t.num_vertices(),
          t.num_duplicates(), t.num_finite_cells(), t.num_infinite_cells(), std::move(hash)};
}

Counts counts_of(const ConvexHullBase& hull) {
  return {hull.dimension(),
          hull.affine_dimension(),
          hull.num_points(),
          hull.num_vertices(),
          hull.num_duplicates(),
          hull.num_cells(),
          0,
          hull.hash().hex()};
}

Json stats_of(const char* command, const Counts& counts) {
  Json json;
  json["command"] = command;
  json["dimension"] = counts.dimension;
  json["affine_dimension"] = counts.affine_dimension;
  json["points"] = counts.points;
  json["vertices"] = counts.vertices;
  json["duplicates"] = counts.duplicates;
  json["hidden"] = num_hidden(counts);
  json["cells"] = counts.cells;
  json["infinite_cells"] = counts.infinite_cells;
  json["hash"] = counts.hash;
  return json;
}

void add_cost(Json& json, const Statistics& s, std::size_t num_cells, const Cost& cost, std::uint64_t seed) {
  json["seconds"] = {{"read", cost.read},
                     {"order", s.order_seconds},
                     {"build", cost.build - s.order_seconds},
                     {"write", cost.write},
                     {"total", cost.total}};
  if (cost.diagram) json["seconds"]["diagram"] = *cost.diagram;
  json["peak_rss_bytes"] = cost.peak_rss_bytes;
  json["bytes_per_cell"] =
      num_cells == 0 ? 0.0 : static_cast<double>(s.cell_bytes) / static_cast<double>(num_cells);
  json["created_cells"] = s.created_cells;
  json["stages"] = {
      {"filter", s.filter}, {"direct", s.direct}, {"exact", s.exact}, {"perturbed", s.perturbed}};
  json["threads"] = s.threads;
  json["seed"] = seed;
  json["version"] = DELONE_VERSION;
}

Json stats_of(const char* command, const Counts& counts, const Statistics& statistics, const Cost& cost,
              std::uint64_t seed) {
  Json json = stats_of(command, counts);
  add_cost(json, statistics, counts.cells + counts.infinite_cells, cost, seed);
  return json;
}

Summary& Summary::line(const std::string& name, const std::string& value) {
  text_ += fmt::format("  {:<18}{}\n", name, value);
  return *this;
}

Summary& Summary::affine_dimension(int k, int d, const std::string& if_flat) {
  return line("affine dimension", fmt::format("{}{}", k,
                                              k < 0   ? " (no points)"
                                              : k < d ? fmt::format(" (flat: {})", if_flat)
                                                      : ""));
}

Summary& Summary::triangulation(const Counts& counts) {
  affine_dimension(counts.affine_dimension, counts.dimension, "triangulated inside its flat");
  line("vertices", fmt::format("{} ({} hidden, {} duplicate points)", counts.vertices, num_hidden(counts),
                               counts.duplicates));
  line("cells", fmt::format("{}, and {} hull facets", counts.cells, counts.infinite_cells));
  return line("hash", counts.hash);
}

Summary& Summary::cost(const Statistics& s, const Cost& cost) {
  line("conflict tests",
       fmt::format("{} by filter, {} direct, {} exact, {} ties", s.filter, s.direct, s.exact, s.perturbed));
  line("time", fmt::format("{:.3f} s (reading {:.3f}, ordering {:.3f}, building {:.3f}{})", cost.total,
                           cost.read, s.order_seconds, cost.build - s.order_seconds,
                           cost.diagram ? fmt::format(", diagram {:.3f}", *cost.diagram) : std::string()));
  return line("peak memory", fmt::format("{:.1f} MB", static_cast<double>(cost.peak_rss_bytes) / 1e6));
}

}  // namespace delone::cli
