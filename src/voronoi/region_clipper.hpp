// SPDX-License-Identifier: BSD-3-Clause
// Clips one region to a box and to halfspaces. The box is a simple polytope with 2^d corners, and one
// halfspace and bisector after the other cuts it. Every decision (is this corner beyond that hyperplane?) is
// exact: corners are known within a certified radius, and where that leaves the sign open, it is the sign of
// a determinant in integers. Ties are broken by a symbolic perturbation that moves every hyperplane outward,
// later ones less. So the polytope stays simple and its combinatorics consistent for any input.
#pragma once

#include "kernel/fractions.hpp"
#include "solve/simple_polytope.hpp"
#include "voronoi/face_volumes.hpp"

#include <delone/voronoi.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone::voronoi {

/// Throws Errc::invalid_argument unless box and halfspaces are d finite numbers low < high, and rows of d + 1
/// finite numbers a, c with a ≠ 0; unsupported for d > 12.
void require_container(const Box& box, std::span<const double> halfspaces, int dimension);

class RegionClipper {
 public:
  /// REQUIRES what require_container() does.
  /// `furthest`: whether the region of a site is that of the points not further from any other one; then
  /// weights are not looked at. `halfspaces`: rows a, c of a·x + c ≤ 0, which must stay valid.
  explicit RegionClipper(const Box& box, bool furthest = false, std::span<const double> halfspaces = {});

  struct Site {
    const double* point;
    double weight;
  };
  /// Clips the region of `site` among the others.
  void clip(const Site& site, std::span<const Site> others);

  /// The d-volume of the clipped region.
  double volume();
  /// The volume, the centroid less the site, and the facets of the clipped region, labelled by planes. Some
  /// facets have no area if more planes than d meet in a corner.
  solve::SimplePolytope::Measures measures();
  /// Whether the region has an interior, exactly. `inside`: d numbers of a point less the site, which may
  /// help to decide that; or none.
  bool has_interior(std::span<const double> inside);
  /// Numbers for the corners, equal for those that coincide exactly.
  std::vector<Index> exact_numbers();
  /// The planes that have corners, with the numbers of these, increasing without repetitions. `proper`: those
  /// whose corners span the plane, decided exactly; then `number` are exact_numbers(). REQUIRES an interior.
  struct Facet {
    std::size_t plane;
    std::vector<Index> corners;
  };
  std::vector<Facet> facets(const std::vector<Index>& number, bool proper);
  /// The numbers of the corners on a plane in order. d = 3: counterclockwise around the facet, seen from
  /// outside, equal ones in a row once. d = 2: both ends, counterclockwise around the region.
  /// REQUIRES 2 ≤ d ≤ 3 and a plane with corners.
  std::vector<Index> ordered_facet(std::size_t plane, const std::vector<Index>& number);
  /// The plane of the box, or of a halfspace, with the same points and the same side as the bisector `plane`,
  /// or else `plane` itself: the site behind that bisector has no interior in the box.
  std::size_t fixed_plane_of(std::size_t plane);
  /// The corners and faces of the clipped region, with coincident corners merged. REQUIRES d ≤ 3.
  ClippedRegion geometry();

  // The simple polytope of the last clip().
  using Corner = std::size_t;
  /// Planes are numbered: those of the box (low, high by axis), the halfspaces, and then bisectors.
  std::size_t num_fixed_planes() const { return 2 * d_ + halfspaces_.size() / (d_ + 1); }
  /// Which of the other sites a plane is the bisector with.
  std::size_t other_of(std::size_t plane) const { return other_of_plane_[plane]; }
  std::vector<Corner> corners() const;
  std::span<const std::size_t> planes_through(Corner c) const { return {planes_of_.data() + c * d_, d_}; }
  /// A corner, in units of 2^grid.
  struct ExactCorner {
    kernel::Fractions at;
    int grid;
  };
  ExactCorner exact_corner(Corner c);
  /// The faces, counterclockwise seen from outside, as lists of numbers of corners without repetitions in a
  /// row; those of fewer than three are left out. d = 2: the polygon. `number`: by corner, equal for corners
  /// that coincide. REQUIRES 2 ≤ d ≤ 3.
  std::vector<std::vector<Index>> faces(const std::vector<Index>& number);

 private:
  /// a·y ≤ b for y = x − site. In binary64 each entry of a is within a relative unit roundoff, and b within
  /// b_error.
  struct Plane {
    std::vector<double> a;
    double b = 0, b_error = 0;
    std::vector<kernel::Integer> exact;  // a and b times a positive factor; computed on first use
  };

  bool is_on(Corner c, std::size_t plane) const {
    const std::span<const std::size_t> planes = planes_through(c);
    return std::find(planes.begin(), planes.end(), plane) != planes.end();
  }
  /// The dimension, plus one, that corners span.
  std::size_t rank_of_corners(const std::vector<Corner>& corners);
  bool has_moderate_sides() const;
  std::pair<double, double> range_of_corners(std::size_t j) const;
  std::vector<int> exponents_of_extents() const;
  /// Whether the region is so thin, seen from the site, that rounded corners have too few digits.
  bool is_far() const;
  solve::SimplePolytope::Measures measures_here();
  solve::SimplePolytope::Measures measures_from_a_corner();
  solve::SimplePolytope::Measures measures_by_axis(const std::vector<int>& exponents);
  void make_box();
  void make_halfspaces();
  void make_bisectors(std::span<const Site> others);
  void cut(std::size_t plane);
  /// 1 if a point within `radius` of y, along each axis, certainly lies beyond the plane, −1 if it certainly
  /// does not, and 0 if that is open.
  int certain_side(const double* y, double radius, std::size_t plane) const;
  bool is_beyond(Corner corner, std::size_t plane);
  bool is_beyond_exactly(Corner corner, std::size_t plane);
  const std::vector<kernel::Integer>& exact_plane(std::size_t plane);
  /// Nothing where rounding errors may be magnified.
  std::optional<double> volume_by_faces();
  Corner new_corner();
  void find_coordinates(Corner corner);
  /// Improves the coordinates that find_coordinates() has found, and returns a radius of the corner.
  double refine(Corner corner, double alpha);
  void find_coordinates_exactly(Corner corner);
  void link_new_corners(std::size_t plane);
  kernel::Fractions solve_exactly(Corner corner);
  bool is_counterclockwise(std::size_t plane, std::size_t along, std::size_t leaves);
  /// The corners by coordinates, and numbers for them, equal for corners with the same coordinates.
  std::vector<Corner> number_corners(std::vector<Index>& number);
  std::vector<Index> cycle(std::size_t plane, const std::vector<Index>& number,
                           const std::vector<Corner>& corners);

  const double* halfspace(std::size_t plane) const {
    return halfspaces_.data() + (plane - 2 * d_) * (d_ + 1);
  }
  std::size_t* planes_of(Corner c) { return planes_of_.data() + c * d_; }
  Corner* neighbors(Corner c) { return neighbors_.data() + c * d_; }
  double* position(Corner c) { return positions_.data() + c * d_; }

  std::size_t d_;
  Box box_;
  bool furthest_;
  std::span<const double> halfspaces_;
  double extent_ = 0;  // the longest side
  bool is_moderate_ = false;
  Site site_{};
  std::span<const Site> others_;
  int grid_ = 0;
  bool has_grid_ = false, has_ties_ = false;
  std::vector<Plane> planes_;
  std::vector<std::size_t> order_;  // of the bisectors
  std::vector<std::size_t> other_of_plane_;
  std::vector<std::size_t> planes_of_;  // d per corner
  std::vector<Corner> neighbors_;       // d per corner: neighbor i is on all planes but the i-th
  std::vector<double> positions_, radii_;
  std::vector<unsigned char> alive_, beyond_;
  std::vector<Corner> free_, fresh_;
  std::vector<double> matrix_, work_, inverse_, right_, scales_;
  solve::SimplePolytope polytope_;
};

}  // namespace delone::voronoi
