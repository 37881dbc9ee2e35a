// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/check/check_part.hpp"

#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "tiles/part_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace delone::tiles {

namespace {

/// Runs an examination of check() on the part. What it finds names cells and points by their numbers in the
/// part; the report has those of the whole.
template <class Examine>
bool passes(const CheckedPart& part, int level, Findings& findings, const Examine& examine) {
  if (!findings.wanted(level)) return false;
  try {
    examine();
    return findings.wanted(level + 1);
  } catch (Violation& violation) {
    violation.message = fmt::format("{}, by its own numbers: {}", part_name(part.number), violation.message);
    for (std::size_t& cell : violation.cells) cell += static_cast<std::size_t>(part.first_cell);
    for (std::size_t& point : violation.points) point = static_cast<std::size_t>(part.tile.rows[point]);
    findings.add(level, std::move(violation));
    return false;
  }
}

void set_reference(Reference& reference, const internal::Examined& examined, const CheckedPart& part) {
  const ComplexData& data = part.data;
  reference.cell = part.first_cell;
  reference.row_size = examined.row_size();
  reference.form = examined.form();
  reference.hull = kernel::AffineHull(data.dimension);
  for (const SignedIndex v : examined.cell(0)) {
    reference.rows.push_back(part.row(v));
    reference.points.insert(reference.points.end(), examined.point(v),
                            examined.point(v) + examined.row_size());
    reference.hull.add(examined.point(v));
  }
  reference.is_flat = reference.hull.dimension() < data.affine_dimension;
  reference.axes = reference.hull.axes();
}

/// Neighbors within the part are mutual, share the facet and are oriented coherently. No facet has to be
/// looked for: that no third cell has it follows from what is covered once.
void check_neighbors(const internal::Examined& examined) {
  internal::for_parts(
      examined.threads, examined.data.num_cells(), internal::part_of_check,
      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
        std::vector<SignedIndex> scratch;
        for (std::size_t at = first * examined.corners; at < last * examined.corners; ++at) {
          stop();
          if (examined.neighbors[at] < 0) continue;
          const std::size_t c = at / examined.corners, i = at % examined.corners,
                            other = static_cast<std::size_t>(examined.neighbors[at]);
          const auto a = examined.cell(c), b = examined.cell(other);
          const std::size_t j = internal::mirror(a, i, b);
          if (other == c || !internal::equal_facets(a, i, b, j))
            throw Violation{
                fmt::format("neighbor {} of cell {} is cell {}, which does not share the facet {}", i, c,
                            other, internal::braces(internal::facet_vertices(a, i))),
                {c, other}};
          if (examined.neighbors[other * examined.corners + j] != static_cast<SignedIndex>(c))
            throw Violation{
                fmt::format("neighbor {} of cell {} is cell {}, but not the other way round", i, c, other),
                {c, other}};
          if (c < other && !internal::coherent(a, i, b, j, scratch))
            throw Violation{fmt::format("the cells {} {} and {} {} are not oriented coherently", c,
                                        internal::braces(a), other, internal::braces(b)),
                            {c, other}};
        }
      });
}

/// All points lie in the flat of the reference cell.
void check_flat(const CheckedPart& part, const internal::Examined& examined, Reference& reference) {
  if (reference.is_flat || part.data.affine_dimension == part.data.dimension) return;
  for (std::size_t at = 0; at < part.data.cells.size(); ++at) {
    internal::cancellation_point();
    if (reference.hull.contains(examined.point(part.data.cells[at]))) continue;
    const std::size_t c = at / part.corners();
    throw Violation{fmt::format("cell {} leaves the flat of dimension {} of the cell {} of the whole", c,
                                part.data.affine_dimension, reference.cell),
                    {c},
                    {static_cast<std::size_t>(part.data.cells[at])}};
  }
}

/// No cell but the reference cell covers the point o.
void check_covered_once(const CheckedPart& part, const internal::Examined& examined,
                        const internal::Volumes& volumes, const Reference& reference) {
  const kernel::Flat flat{part.data.dimension, volumes.axes, examined.form()};
  internal::for_parts(
      examined.threads, part.data.num_cells(), internal::part_of_check,
      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
        std::vector<const double*> points(examined.corners);
        for (std::size_t c = first; c < last; ++c) {
          stop();
          if (part.first_cell + static_cast<std::int64_t>(c) == reference.cell) continue;
          for (std::size_t i = 0; i < points.size(); ++i) points[i] = examined.point(examined.cell(c)[i]);
          const double* o = reference.point(0);
          const bool near = std::all_of(volumes.axes.begin(), volumes.axes.end(), [&](int axis) {
            return std::any_of(points.begin(), points.end(),
                               [&](const double* p) { return p[axis] <= o[axis]; }) &&
                   std::any_of(points.begin(), points.end(),
                               [&](const double* p) { return p[axis] >= o[axis]; });
          });
          if (!near) continue;
          std::size_t i = 0;
          while (i < points.size() && side_of_reference(flat, reference, points, i) == volumes.orientation[c])
            ++i;
          if (i == points.size())
            throw Violation{fmt::format("cell {} overlaps the cell {} of the whole", c, reference.cell), {c}};
        }
      });
}

}  // namespace

std::size_t check_part(const CheckedPart& part, Reference& reference, bool canonical, unsigned threads,
                       Findings& findings) {
  using namespace internal;
  const ComplexData& data = part.data;
  Examined examined{data, part.corners(), Lift::paraboloid, threads};
  if (!passes(part, 1, findings, [&] { check_storage(data, false, threads); })) return 0;
  if (data.num_cells() == 0) return 0;
  examined.weighted_rows = weighted_rows(data);
  examined.neighbors.reserve(part.tile.neighbors.size());
  for (const std::int32_t neighbor : part.tile.neighbors)
    examined.neighbors.push_back(std::max<std::int32_t>(neighbor, -1));
  if (reference.cell < 0) set_reference(reference, examined, part);
  if (!passes(part, 2, findings, [&] { check_neighbors(examined); })) return 0;
  Volumes volumes;
  if (!passes(part, 4, findings, [&] {
        check_flat(part, examined, reference);
        volumes = check_volume(examined, true);
        if (reference.is_flat) throw Violation{"the first cell is flat", {0}};
      }))
    return 0;
  std::size_t ties = 0;
  if (data.affine_dimension == 0) return ties;
  passes(part, 5, findings, [&] {
    ties = check_inner_facets(examined, volumes, canonical);
    check_covered_once(part, examined, volumes, reference);
  });
  return ties;
}

}  // namespace delone::tiles
