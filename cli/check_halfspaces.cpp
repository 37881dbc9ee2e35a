// SPDX-License-Identifier: BSD-3-Clause
#include "check_halfspaces.hpp"

#include "command.hpp"
#include "output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace delone::cli {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 3> levels{
    {{"storage", "sizes, ranges"},
     {"support", "every vertex is where its rows meet, inside all others; or the witness is a proof"},
     {"completeness", "no edge, vertex or direction is missing; facets and kinds are right"}}};

}  // namespace

int run_halfspaces_check(const IntersectionData& data, const std::string& path, int level) {
  const auto last = std::min(static_cast<std::size_t>(level), levels.size());
  const IntersectionCheckReport report =
      about(path, [&] { return check_halfspaces(data, static_cast<IntersectionCheckLevel>(last)); });
  std::string text = fmt::format("{}: the intersection of {} halfspaces in dimension {}, ", path,
                                 data.num_halfspaces(), data.dimension);
  if (data.state == IntersectionState::full)
    text += fmt::format("{} vertices, {} directions, {} facets\n", data.num_vertices(), data.num_directions(),
                        data.num_facets());
  else
    text += data.state == IntersectionState::flat ? "flat\n" : "empty\n";
  const auto reached = static_cast<std::size_t>(report.reached);
  for (std::size_t i = 1; i <= reached; ++i)
    text += fmt::format("level {}  {:<17}{:<8}{}\n", i, levels[i - 1].first,
                        !report.ok && i == reached ? "FAILED" : "ok", levels[i - 1].second);
  if (!report.ok)
    text += fmt::format("violation: {}\n", report.violation);
  else
    text += last == levels.size() ? "the intersection of all its halfspaces, exactly\n"
                                  : "no violation up to this level\n";
  print_output(text);
  return report.ok ? exit_status::ok : exit_status::check_failed;
}

std::string halfspaces_check_footer() {
  std::string footer = "Levels of intersections of halfspaces:\n";
  for (std::size_t i = 0; i < levels.size(); ++i)
    footer += fmt::format("  {}  {:<17}{}\n", i + 1, levels[i].first, levels[i].second);
  return footer;
}

}  // namespace delone::cli
