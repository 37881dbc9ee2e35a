// SPDX-License-Identifier: BSD-3-Clause
// The levels of check() for each kind of data, and how they are run: one after the other, up to the first
// violation.
#pragma once

#include "base/guarded.hpp"

#include <delone/check.hpp>
#include <delone/error.hpp>
#include <delone/export.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace delone::internal {

/// What a level throws at the first violation, so that none has to pass a result through its loops.
struct Violation {
  std::string message;
  std::vector<std::size_t> cells{}, points{}, vertices{}, halfspaces{};
};

/// Throws a Violation unless tolerances of axes are those of a scale with the tolerance given, or none.
void check_axis_tolerances(double tolerance, std::span<const double> of_axes, int dimension);

template <PlainData Data>
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 0> levels_of{};
template <>
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 6> levels_of<ComplexData>{
    {{1, "storage", "sizes, ranges, no repeated vertex in a cell"},
     {2, "incidence", "neighbors are mutual, facets shared by two, coherent orientation"},
     {3, "sphere", "closed by the infinite cells, a sphere"},
     {4, "volume", "every cell has positive volume"},
     {5, "local convexity", "no vertex inside the sphere of a cell, the hull is convex"},
     {6, "completeness", "every point is a vertex or a duplicate of one"}}};
template <>
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 5> levels_of<HullData>{
    {{1, "storage", "sizes, ranges, no repeated vertex in a cell"},
     {2, "incidence", "every ridge in two cells, neighbors mutual, coherent orientation, connected"},
     {3, "convexity", "no cell is flat, the boundary is convex at every ridge"},
     {4, "support", "no point is beyond a cell, the cells cover the boundary once"},
     {5, "completeness", "facets, extreme points and kinds of points are those of the polytope"}}};
template <>
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 3> levels_of<IntersectionData>{
    {{1, "storage", "sizes, ranges"},
     {2, "support", "every vertex is where its rows meet, inside all others; or the witness is a proof"},
     {3, "completeness", "no edge, vertex or direction is missing; facets and kinds are right"}}};
template <>
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 5> levels_of<VoronoiData>{
    {{1, "storage", "sizes, ranges, nothing twice in a list"},
     {2, "regions", "each point in the region of its site, the vertices of all regions"},
     {3, "vertices", "each coordinate the double nearest to the exact one"},
     {4, "ridges", "the pairs of regions with a common facet, its vertices"},
     {5, "rays", "the unbounded edges, their sites and directions"}}};

// Those of ComplexData that are no Delaunay or regular triangulation.
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 6> levels_of_furthest_site{
    {levels_of<ComplexData>[0],
     levels_of<ComplexData>[1],
     levels_of<ComplexData>[2],
     levels_of<ComplexData>[3],
     { 5, "local convexity", "no vertex outside the sphere of a cell, the hull is convex" },
     { 6, "completeness", "every point is a vertex, a duplicate of one, or hidden" }}};
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 6> levels_of_lower_hull{
    {levels_of<ComplexData>[0],
     levels_of<ComplexData>[1],
     levels_of<ComplexData>[2],
     { 4, "volume", "every cell has positive volume over the compositions" },
     { 5, "local convexity", "no vertex below the hyperplane of a cell, the domain is convex" },
     { 6, "completeness", "no point is below the cells" }}};
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 6> levels_of_upper_hull{
    {levels_of<ComplexData>[0],
     levels_of<ComplexData>[1],
     levels_of<ComplexData>[2],
     { 4, "volume", "every cell has positive volume over the compositions" },
     { 5, "local convexity", "no vertex above the hyperplane of a cell, the domain is convex" },
     { 6, "completeness", "no point is above the cells" }}};
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 6> levels_of_periodic{
    {{1, "storage", "sizes, ranges, points on the grid of the box, no image twice in a cell"},
     {2, "incidence", "neighbors are mutual, with their offsets"},
     {3, "torus", "facets shared by two, Euler characteristic 0"},
     {4, "volume", "every cell has positive volume, all together that of the box"},
     {5, "local convexity", "no vertex inside the sphere of a cell, the outside is convex"},
     {6, "completeness", "every point is a vertex or a translate of one, or hidden"}}};
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 3> levels_of_part{
    {levels_of<ComplexData>[0], levels_of<ComplexData>[1], {
       3, "part", "every cell is one of the triangulation of all points"
     }}};
DELONE_HIDDEN inline constexpr std::array<CheckLevel, 2> levels_of_boundary{
    {levels_of<ComplexData>[0], { 2, "closed", "the facets enclose something: none has a border" }}};

/// Runs step i for level i, `step(report)`, up to the level that the options name.
template <class... Steps>
CheckReport run_levels(std::span<const CheckLevel> levels, const CheckOptions& options, Steps... steps) {
  if (options.up_to < 1) throw Error(Errc::invalid_argument, "levels of checks are counted from 1");
  CheckReport report;
  const auto run = [&](const CheckLevel& level, auto& step) {
    if (level.number > options.up_to) return;
    report.reached = level;
    step(report);
  };
  try {
    guarded("a check", [&] {
      const CheckLevel* level = levels.data();
      (run(*level++, steps), ...);
    });
    report.ok = true;
  } catch (Violation& violation) {
    report.violation = std::move(violation.message);
    report.cells = std::move(violation.cells);
    report.points = std::move(violation.points);
    report.vertices = std::move(violation.vertices);
    report.halfspaces = std::move(violation.halfspaces);
  }
  return report;
}
template <PlainData Data, class... Steps>
CheckReport run_levels(const CheckOptions& options, Steps... steps) {
  static_assert(sizeof...(Steps) == levels_of<Data>.size(), "each level is one step");
  if (!std::same_as<Data, ComplexData> && (options.canonical || !options.oriented || options.furthest_site))
    throw Error(Errc::invalid_argument,
                "canonical, oriented and furthest_site are options of the check of a triangulation");
  return run_levels(std::span<const CheckLevel>(levels_of<Data>), options, std::move(steps)...);
}

}  // namespace delone::internal
