// SPDX-License-Identifier: BSD-3-Clause
// delone check of what `delone voronoi` and `delone power` wrote: five levels, exactly.
#include "check_voronoi.hpp"
#include "command.hpp"
#include "output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace delone::cli {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 5> levels{
    {{"storage", "sizes, ranges, nothing twice in a list"},
     {"regions", "each point in the region of its site, the vertices of all regions"},
     {"vertices", "each coordinate the double nearest to the exact one"},
     {"ridges", "the pairs of regions with a common facet, its vertices"},
     {"rays", "the unbounded edges, their sites and directions"}}};

}  // namespace

int run_voronoi_check(const std::string& path, const std::string& format, int level) {
  const VoronoiData data = about(path, [&] { return read_voronoi(path, format); });
  const auto asked = std::min(static_cast<std::size_t>(level), levels.size());
  const VoronoiCheckReport report =
      about(path, [&] { return check_voronoi(data, static_cast<VoronoiCheckLevel>(asked)); });
  const char* kind = data.weights.empty() ? "Voronoi" : "power";
  std::string text = fmt::format(
      "{}: the {} diagram of {} points in dimension {}, affine dimension {}, {} regions, {} vertices\n", path,
      kind, data.num_points(), data.dimension, data.affine_dimension, data.num_regions(),
      data.num_vertices());
  const auto reached = static_cast<std::size_t>(report.reached);
  for (std::size_t i = 1; i <= reached; ++i)
    text += fmt::format("level {}  {:<17}{:<8}{}\n", i, levels[i - 1].first,
                        !report.ok && i == reached ? "FAILED" : "ok", levels[i - 1].second);
  if (!report.ok)
    text += fmt::format("violation: {}\n", report.violation);
  else if (asked == levels.size())
    text += fmt::format("the {} diagram of all its points, exactly\n", kind);
  else
    text += "no violation up to this level\n";
  print_output(text);
  return report.ok ? exit_status::ok : exit_status::check_failed;
}

std::string voronoi_levels_text() {
  std::string text = "Levels of Voronoi and power diagrams:\n";
  for (std::size_t i = 0; i < levels.size(); ++i)
    text += fmt::format("  {}  {:<17}{}\n", i + 1, levels[i].first, levels[i].second);
  return text;
}

}  // namespace delone::cli
