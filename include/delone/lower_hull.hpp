// SPDX-License-Identifier: BSD-3-Clause
// The lower (or upper) part of a convex hull with respect to the last coordinate: the convex envelope of
// heights over compositions, as in phase diagrams.
#pragma once

#include <delone/complex.hpp>
#include <delone/convex_hull.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace delone {

enum class HullSide { lower, upper };

/// The lower hull of points of R^d, d ≥ 2: the graph of the largest convex function that is nowhere above the
/// points, over the convex hull of their *compositions*, the first d−1 coordinates; the last coordinate is
/// the *height* (an energy, say). The upper hull is that of the least concave function that is nowhere below.
///
/// The cells are simplices of c+1 points, c the affine dimension of the compositions; seen along the last
/// axis they triangulate the domain, and cells in one hyperplane belong to one facet. Where all heights are
/// an affine function of the compositions there is a single facet. Exact for all finite doubles; a function
/// of the set of points. Duplicates, flat compositions and points above the hull are ordinary input. `const`
/// members may be called from several threads at once.
class LowerHull {
 public:
  /// From n×d coordinates, row-major. Throws Errc::bad_dimension (d < 2, or a number of coordinates that does
  /// not fit), not_finite, too_many, out_of_memory, cancelled. Cost: a convex hull of n+1 points.
  LowerHull(std::span<const double> coordinates, int dimension, HullSide side = HullSide::lower,
            const Options& options = {});
  LowerHull(PointsView points, HullSide side = HullSide::lower, const Options& options = {});
  LowerHull(LowerHull&&) noexcept;
  LowerHull& operator=(LowerHull&&) noexcept;
  ~LowerHull();

  int dimension() const;              ///< d
  int composition_dimension() const;  ///< c ≤ d−1, the affine dimension of the compositions; −1 for no point
  HullSide side() const;
  std::size_t num_points() const;
  std::size_t num_cells() const;
  std::size_t num_facets() const;

  /// m×(c+1) input rows. Positively oriented in the coordinates of `composition_axes` for c ≥ 1.
  std::span<const SignedIndex> cells() const;
  /// m×(c+1) cells: neighbor i is across the facet opposite vertex i; −1 at the border of the domain.
  std::span<const SignedIndex> neighbors() const;
  /// The facet each cell is part of.
  std::span<const SignedIndex> facet_of_cell() const;
  /// The rows of the extreme points of this side ("stable" phases), increasing; of equal rows the first.
  std::span<const SignedIndex> vertices() const;
  /// c axes of the compositions on which their flat projects one-to-one.
  std::vector<int> composition_axes() const;

  /// A cell whose domain contains the composition (d−1 numbers), exactly; nullopt outside the domain. Cost: a
  /// walk.
  std::optional<std::size_t> find_cell(std::span<const double> composition) const;

  /// The height of the hull over each of q compositions (q×(d−1)): an interpolation in the cell, rounded.
  /// Outside the domain +∞ for the lower hull, −∞ for the upper.
  std::vector<double> heights(std::span<const double> compositions) const;

  /// The height of each of q points (q×d) above the hull ("energy above hull"). The sign is exact: 0 only for
  /// points exactly on the hull, negative below it. The magnitude is rounded, as in heights(). −∞ (+∞ for the
  /// upper hull) outside the domain.
  std::vector<double> height_above(std::span<const double> points) const;

  /// The cells as plain data: dimension d, affine_dimension c (of the cells). For files and pictures; not a
  /// Delaunay triangulation.
  ComplexData to_data() const;

  /// The convex hull that this is a part of: of the points, projected to the composition axes and the height
  /// (negated for the upper hull), and of one point above them all.
  const Polytope& polytope() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace delone
