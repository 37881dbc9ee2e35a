// SPDX-License-Identifier: BSD-3-Clause
// Levels 4 and 5 of check(): exact volumes, and the local conditions that prove the empty-sphere property
// globally.
//
// Why levels 1–5 suffice. Let o be a point of general position in the interior of cell 0, and map every
// infinite cell to the part of space that lies behind its hull facet as seen from o. If every finite cell is
// non-flat and neighbors lie on different sides of their facets (level 4), and every hull facet has o
// strictly on its inner side, then the closed complex is mapped to R^k ∪ {∞} without a fold, so each point of
// general position is covered the same number of times. At o that number is one as soon as no other finite
// cell covers o. Hence the finite cells tile a region that is star-shaped around o. A section of it by a
// plane through o is a polygon without reflex angles if the hull is convex at its ridges, so the region is
// convex. The piecewise linear interpolation of |x|² over the tiles is then convex if it is convex at each
// facet between two of them: no vertex lies below the lifted plane of a cell, which is the empty-sphere
// property. (Mehlhorn, Näher, Seel, Seidel, Schilz, Schirra, Uhrig: Checking geometric programs or
// verification of geometric structures, doi:10.1016/S0925-7721(98)00036-4, check hulls this way.)
//
// Perturbed ties move the lifted points up and down only, by amounts that make the lifted surface strictly
// convex; the region stays, and coplanar hull facets stay coplanar and are decided by the facets inside. So
// `canonical` asks for the perturbed sign at inner facets and for nothing at the hull.
//
// All of that holds for other lifts, too: |x|² less weights; −|x|², for which the empty-sphere property is
// that no point is outside the sphere; and any heights, for which it is that no point is below the hyperplane
// of a cell.
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "base/random.hpp"
#include "check/check_stages.hpp"
#include "hull/cell_height.hpp"
#include "kernel/predicates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <tuple>
#include <utility>

namespace delone::internal {

namespace {

// Evaluates predicates on the vertices of cells.
class Geometry {
 public:
  Geometry(const Examined& examined, const std::vector<int>& axes)
      : examined_(examined),
        flat_{examined.data.dimension, axes, examined.form()},
        points_(examined.corners) {
    lifted_axes_ = axes;
    lifted_axes_.push_back(examined.data.dimension);
  }

  // The orientation of cell c.
  Sign orientation(std::size_t c) {
    gather(c);
    return orientation_of_gathered();
  }
  // The orientation of cell c with its vertex i replaced by the point at `row`.
  Sign orientation(std::size_t c, std::size_t i, SignedIndex row) {
    gather(c);
    points_[i] = examined_.point(row);
    return orientation_of_gathered();
  }
  // With heights, the side of the hyperplane: + above.
  Sign in_sphere(std::size_t c, Sign orientation, SignedIndex row) {
    gather(c);
    if (examined_.lift == Lift::heights) return above_hyperplane(row) * orientation;
    return kernel::in_sphere(flat_, points_, orientation, examined_.point(row));
  }
  Sign in_sphere_perturbed(std::size_t c, Sign orientation, SignedIndex row) {
    gather(c);
    return kernel::in_sphere_perturbed(flat_, points_, orientation, examined_.point(row));
  }

  // Whether the height of a point is farther below that of the hyperplane of the cell than the tolerance of
  // the data.
  bool is_far_below(std::size_t c, SignedIndex row) {
    if (examined_.data.tolerance == 0) return true;
    // The composition on the axes, and the height.
    const std::size_t width = lifted_axes_.size();
    std::vector<double> rows;
    const auto add = [&](SignedIndex one) {
      for (const int axis : lifted_axes_) rows.push_back(examined_.point(one)[axis]);
    };
    for (const SignedIndex vertex : examined_.cell(c)) add(vertex);
    add(row);
    std::vector<const double*> corners;
    for (std::size_t i = 0; i < examined_.corners; ++i) corners.push_back(rows.data() + i * width);
    return hull::HeightOfPlane(corners, rows.data() + examined_.corners * width, static_cast<int>(width))
        .exceeds(examined_.data.tolerance);
  }

 private:
  // det(p_1 − p_0, …, q − p_0) with the heights as last coordinates is the determinant of the compositions
  // times the height of q above the hyperplane.
  Sign above_hyperplane(SignedIndex row) {
    points_.push_back(examined_.point(row));
    const Sign sign =
        kernel::orientation(kernel::Flat{static_cast<int>(examined_.row_size()), lifted_axes_}, points_);
    points_.pop_back();
    return sign;
  }
  void gather(std::size_t c) {
    const auto cell = examined_.cell(c);
    for (std::size_t i = 0; i < cell.size(); ++i) points_[i] = examined_.point(cell[i]);
  }
  // One point has no volume to orient: positive.
  Sign orientation_of_gathered() const {
    return points_.size() == 1 ? Sign::positive : kernel::orientation(flat_, points_);
  }

  const Examined& examined_;
  kernel::Flat flat_;
  std::vector<int> lifted_axes_;
  std::vector<const double*> points_;
};

/// "inside the sphere", or what takes its place.
const char* conflict_text(const Examined& examined) {
  switch (examined.lift) {
    case Lift::paraboloid:
      return "inside the sphere";
    case Lift::inverted:
      return "outside the sphere";
    case Lift::heights:
      break;
  }
  return examined.data.kind == DataKind::upper_hull ? "above the hyperplane" : "below the hyperplane";
}

// Axes on which the flat of the cells projects one-to-one.
std::vector<int> axes_of_cells(const Examined& examined) {
  const ComplexData& data = examined.data;
  std::vector<int> axes(static_cast<std::size_t>(data.affine_dimension));
  std::iota(axes.begin(), axes.end(), 0);
  if (data.affine_dimension == data.dimension) return axes;

  kernel::AffineHull hull(data.dimension);
  std::vector<bool> added(data.num_points(), false);
  for (std::size_t at = 0; at < data.cells.size(); ++at) {
    cancellation_point();
    const auto row = static_cast<std::size_t>(data.cells[at]);
    if (added[row]) continue;
    added[row] = true;
    if (hull.add(examined.point(data.cells[at])) && hull.dimension() > data.affine_dimension)
      throw Violation{fmt::format("cell {} leaves the flat of dimension {} with its vertex {}",
                                  at / examined.corners, data.affine_dimension, row),
                      {at / examined.corners},
                      {row}};
  }
  if (hull.dimension() < data.affine_dimension)
    throw Violation{
        fmt::format("cell 0 is flat: the vertices of all cells span the dimension {} only", hull.dimension()),
        {0}};
  return {hull.axes().begin(), hull.axes().end()};
}

/// Calls examine(i, geometry) for i = 0 … size − 1, in the parts of the threads, each with a Geometry of
/// its own.
template <class Examine>
void in_parts(const Examined& examined, const Volumes& volumes, std::size_t size, Examine examine) {
  work_in_parts(examined.threads, size, part_of_check, [&] {
    return [&, geometry = Geometry(examined, volumes.axes)](std::size_t first, std::size_t last,
                                                            const StopPoint& stop) mutable {
      for (std::size_t i = first; i < last; ++i) {
        stop();
        examine(i, geometry);
      }
    };
  });
}

}  // namespace

Volumes check_volume(const Examined& examined, bool oriented) {
  const ComplexData& data = examined.data;
  const std::size_t m = data.num_cells();
  Volumes volumes{axes_of_cells(examined), std::vector<Sign>(m)};
  if (m > 0) volumes.orientation[0] = Geometry(examined, volumes.axes).orientation(0);
  const Sign first_sign = m > 0 ? volumes.orientation[0] : Sign::zero;
  in_parts(examined, volumes, m, [&](std::size_t c, Geometry& geometry) {
    const Sign sign = geometry.orientation(c);
    if (c > 0) volumes.orientation[c] = sign;
    if (sign == Sign::zero)
      throw Violation{fmt::format("cell {} {} is flat", c, braces(examined.cell(c))), {c}};
    if (!oriented) return;
    if (data.affine_dimension == data.dimension && sign == Sign::negative)
      throw Violation{fmt::format("cell {} {} is negatively oriented", c, braces(examined.cell(c))), {c}};
    if (sign != first_sign)
      throw Violation{fmt::format("the cells 0 {} and {} {} have different orientations",
                                  braces(examined.cell(0)), c, braces(examined.cell(c))),
                      {0, c}};
  });

  // Oriented cells lie on different sides of a common facet because level 2 found them coherent.
  if (oriented) return volumes;
  for_neighbors(examined, [&](std::size_t c, std::size_t other, bool are_coherent) {
    if (are_coherent != (volumes.orientation[c] == volumes.orientation[other]))
      throw Violation{fmt::format("the cells {} {} and {} {} lie on the same side of their common facet", c,
                                  braces(examined.cell(c)), other, braces(examined.cell(other))),
                      {c, other}};
  });
  return volumes;
}

std::size_t check_inner_facets(const Examined& examined, const Volumes& volumes, bool canonical) {
  std::atomic<std::size_t> ties = 0;
  in_parts(examined, volumes, examined.neighbors.size(), [&](std::size_t at, Geometry& geometry) {
    const std::size_t c = at / examined.corners, i = at % examined.corners;
    const SignedIndex across = examined.neighbors[at];
    if (across < 0 || static_cast<std::size_t>(across) < c) return;
    const auto other = static_cast<std::size_t>(across);
    const auto a = examined.cell(c), b = examined.cell(other);
    const SignedIndex apex = b[mirror(a, i, b)];
    const Sign sign = geometry.in_sphere(c, volumes.orientation[c], apex);
    if (sign == Sign::negative)
      throw Violation{fmt::format("the vertex {} of cell {} {} is {} of cell {} {}", apex, other, braces(b),
                                  conflict_text(examined), c, braces(a)),
                      {c, other},
                      {static_cast<std::size_t>(apex)}};
    if (sign == Sign::positive) return;
    ties.fetch_add(1, std::memory_order_relaxed);
    if (canonical && geometry.in_sphere_perturbed(c, volumes.orientation[c], apex) != Sign::positive)
      throw Violation{
          fmt::format(
              "the vertex {} of cell {} {} is on the sphere of cell {} {}, and {} when ties are perturbed",
              apex, other, braces(b), c, braces(a), examined.furthest() ? "outside" : "inside"),
          {c, other},
          {static_cast<std::size_t>(apex)}};
  });
  return ties;
}

namespace {

void check_hull_ridges(const Examined& examined, const Volumes& volumes) {
  const std::size_t k = examined.corners - 1;
  in_parts(examined, volumes, examined.hull_neighbors.size(), [&](std::size_t at, Geometry& geometry) {
    const std::size_t h = at / k, i = at % k, next = static_cast<std::size_t>(examined.hull_neighbors[at]);
    if (next < h) return;
    const auto a = examined.hull_facet(h), b = examined.hull_facet(next);
    const SignedIndex apex = b[mirror(a, i, b)];
    const auto [c, opposite] = examined.hull[h];
    if (geometry.orientation(c, opposite, apex) == -volumes.orientation[c])
      throw Violation{
          fmt::format(
              "the hull is not convex: the vertex {} of cell {} is beyond the hull facet {} of cell {}{}",
              apex, examined.hull[next].first, braces(a), c, no_fault_of_a_part(examined.data, 5)),
          {c, examined.hull[next].first},
          {static_cast<std::size_t>(apex)}};
  });
}

// The point o of the header: vertex 0 of cell 0, moved by ε towards vertex 1, by ε² towards vertex 2, and so
// on. The sign of a determinant with o in a row is the first that is not zero when the row is vertex 0, 1, …
// of cell 0.
Sign side_of_reference(const Examined& examined, const Volumes& volumes, Geometry& geometry, std::size_t c,
                       std::size_t i) {
  for (const SignedIndex row : examined.cell(0)) {
    const Sign sign = geometry.orientation(c, i, row);
    if (sign != Sign::zero) return sign * volumes.orientation[c];
  }
  return Sign::zero;
}

void check_covered_once(const Examined& examined, const Volumes& volumes) {
  in_parts(examined, volumes, examined.hull.size(), [&](std::size_t h, Geometry& geometry) {
    const auto [c, i] = examined.hull[h];
    if (side_of_reference(examined, volumes, geometry, c, i) != Sign::positive)
      throw Violation{
          fmt::format("the hull is not convex: cell 0 {} is not behind the hull facet {} of cell {}{}",
                      braces(examined.cell(0)), braces(facet_vertices(examined.cell(c), i)), c,
                      no_fault_of_a_part(examined.data, 5)),
          {0, c}};
  });

  const double* reference = examined.point(examined.cell(0)[0]);
  in_parts(examined, volumes, examined.data.num_cells(), [&](std::size_t c, Geometry& geometry) {
    if (c == 0) return;
    const auto cell = examined.cell(c);
    const bool near = std::all_of(volumes.axes.begin(), volumes.axes.end(), [&](int axis) {
      bool below = false, above = false;
      for (const SignedIndex row : cell) {
        below |= examined.point(row)[axis] <= reference[axis];
        above |= examined.point(row)[axis] >= reference[axis];
      }
      return below && above;
    });
    if (!near) return;
    std::size_t i = 0;
    while (i < cell.size() && side_of_reference(examined, volumes, geometry, c, i) == Sign::positive) ++i;
    if (i == cell.size())
      throw Violation{
          fmt::format("the cells 0 {} and {} {} overlap", braces(examined.cell(0)), c, braces(cell)), {0, c}};
  });
}

/// The cell whose closed simplex has the point, by a walk; or the one behind the hull facet that the point is
/// beyond. Facets are tried from a random one on: such a walk ends with probability 1 in any triangulation
/// (Devillers, Pion, Teillaud, "Walking in a triangulation", doi:10.1142/S0129054102001047).
std::pair<std::size_t, bool> find_cell(const Examined& examined, const Volumes& volumes, Geometry& geometry,
                                       SignedIndex row, std::size_t start, std::uint64_t& random) {
  for (std::size_t c = start;;) {
    cancellation_point();
    const std::size_t corners = examined.corners, first = (random = random::mix(random + 1)) % corners;
    std::size_t step = 0;
    while (step < corners &&
           geometry.orientation(c, (first + step) % corners, row) != -volumes.orientation[c])
      ++step;
    if (step == corners) return {c, true};
    const SignedIndex across = examined.neighbors[c * corners + (first + step) % corners];
    if (across < 0) return {c, false};
    c = static_cast<std::size_t>(across);
  }
}

}  // namespace

void check_hidden(const Examined& examined, const Volumes& volumes, std::span<const std::size_t> rows,
                  bool canonical) {
  const auto examine = [&](std::size_t at, Geometry& geometry, std::uint64_t& random, std::size_t& c) {
    const auto row = static_cast<SignedIndex>(at);
    if (examined.corners > 1) {
      bool found;
      std::tie(c, found) = find_cell(examined, volumes, geometry, row, c, random);
      if (!found)
        throw Violation{
            fmt::format("point {} is no vertex, but outside the hull: beyond a facet of cell {} {}", at, c,
                        braces(examined.cell(c))),
            {c},
            {at}};
    }
    for (const SignedIndex vertex : examined.cell(c))
      if (std::equal(examined.point(row), examined.point(row) + examined.row_size(), examined.point(vertex)))
        throw Violation{fmt::format("point {} is given as hidden, but equal to the vertex {}", at, vertex),
                        {c},
                        {at, static_cast<std::size_t>(vertex)}};
    const Sign sign = canonical ? geometry.in_sphere_perturbed(c, volumes.orientation[c], row)
                                : geometry.in_sphere(c, volumes.orientation[c], row);
    if (sign == Sign::negative && examined.lift == Lift::heights) {
      if (geometry.is_far_below(c, row))
        throw Violation{fmt::format("point {} is {} of cell {} {}{}", at, conflict_text(examined), c,
                                    braces(examined.cell(c)),
                                    examined.data.tolerance > 0 ? ", farther than the tolerance" : ""),
                        {c},
                        {at}};
    } else if (sign == Sign::negative)
      throw Violation{fmt::format("point {} is given as hidden, but in conflict with cell {} {}{}", at, c,
                                  braces(examined.cell(c)), canonical ? ", ties perturbed" : ""),
                      {c},
                      {at}};
  };
  constexpr std::size_t walks_in_part = 256;
  work_in_parts(examined.threads, rows.size(), walks_in_part, [&] {
    return [&, geometry = Geometry(examined, volumes.axes)](std::size_t first, std::size_t last,
                                                            const StopPoint& stop) mutable {
      std::uint64_t random = first;
      std::size_t c = 0;
      for (std::size_t i = first; i < last; ++i) {
        stop();
        examine(rows[i], geometry, random, c);
      }
    };
  });
}

std::size_t check_local_convexity(const Examined& examined, const Volumes& volumes, bool canonical) {
  if (examined.corners == 1) return 0;
  const std::size_t ties = check_inner_facets(examined, volumes, canonical);
  check_hull_ridges(examined, volumes);
  check_covered_once(examined, volumes);
  return ties;
}

}  // namespace delone::internal
