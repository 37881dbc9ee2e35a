// SPDX-License-Identifier: BSD-3-Clause
// Exact Delaunay and regular triangulations of periodic sets: points and all their translates by a lattice.
#pragma once

#include <delone/complex.hpp>
#include <delone/data.hpp>
#include <delone/error.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/options.hpp>
#include <delone/points.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace delone {

/// The translations of a periodic set: all sums of integer multiples of r ≤ d linearly independent vectors of
/// R^d, in any position and of either orientation. In the directions orthogonal to them the set is not
/// periodic: a slab has two vectors in space, a wire one.
struct DELONE_EXPORT Lattice {
  int dimension = 0;            ///< d
  std::vector<double> vectors;  ///< r×d, row by row

  int rank() const { return dimension < 1 ? 0 : static_cast<int>(vectors.size()) / dimension; }
  /// That of a box with these sides along the axes. Throws Errc::invalid_argument for a negative length.
  static Lattice box(std::span<const double> lengths);
  /// The same for a set that is periodic along these axes only; other lengths do not matter. Throws
  /// Errc::invalid_argument unless axes are different and 0 … d−1.
  static Lattice box(std::span<const double> lengths, std::span<const int> axes);
};

/// What is done with the input of a periodic triangulation.
struct PeriodicOptions {
  /// Refuse points and lattices that are not on the grid, instead of reporting the displacement.
  bool exact = false;
  /// Move points outside of the box into it; false: refuse them. Either way the result is in terms of the
  /// points as they were given.
  bool wrap = true;
  /// Coordinates are multiples of this number, such as 0.001 for data with three decimals: points and lattice
  /// become integers, and ties of the decimal numbers are ties. 0: none.
  double unit = 0;
};

/// The triangulation of a periodic set S + L in R^d, S the given points and L the lattice: what
/// PeriodicDelaunay<D> and PeriodicRegular<D> have in common.
///
/// *Cells.* All cells of S + L, one of each class of translates: m×(k+1) rows of points, and for each an
/// offset of r integers, which says by how many lattice vectors the point is translated. The
/// lexicographically smallest vertex of a cell has offset 0. k, the affine dimension, is d unless all points
/// and lattice vectors lie in a flat. Two cells may have the same rows, and a cell the same row several
/// times, with other offsets: is_simplicial(). So there is a result for every set, of one point, too.
///
/// *Grid.* Images of points must be doubles: points and lattice vectors are rounded to multiples of 2^(e−53),
/// where 2^e exceeds the coordinates of all images that are looked at, in a cube of side L those up to 3L. So
/// about 50 bits of the box remain. displacement() tells how far that has moved a coordinate: 0 for data that
/// have no more bits, as single precision.
///
/// *Result.* Exact for the points on the grid, ties perturbed as in Triangulation. It is a function of the
/// set S + L: not of which translates were given, of the basis of the lattice, order or seed. Arrays are
/// functions of the given points and the lattice, also after moved(). Of points that are translates of each
/// other the first counts, the others are duplicates; with weights the heaviest counts.
/// Method: the points in the box and as many images as their cells are in conflict with
/// (docs/decisions/0038-periodic-sets-have-ghosts.md). Cost: in space for uniform points about twice that of
/// the triangulation of the points alone; more for few points.
///
/// `const` members may be called from several threads at once. Arrays are made on first use, which throws
/// Errc::out_of_memory, and unsupported if offsets do not fit into 32 bits.
class DELONE_EXPORT PeriodicTriangulation {
 public:
  PeriodicTriangulation(const PeriodicTriangulation&) = delete;
  PeriodicTriangulation& operator=(const PeriodicTriangulation&) = delete;

  int dimension() const;           ///< d
  int affine_dimension() const;    ///< k, of S + L; −1 without points
  int rank() const;                ///< r
  bool is_regular() const;         ///< whether points have weights
  std::size_t num_points() const;  ///< the given ones
  std::size_t num_vertices() const;
  std::size_t num_duplicates() const;  ///< translates of earlier points
  std::size_t num_hidden() const;
  std::size_t num_cells() const;  ///< m

  /// The lattice as it was given, on the grid.
  const Lattice& lattice() const;
  /// The most that a coordinate of a point or of a lattice vector has moved onto the grid.
  double displacement() const;
  /// n×d: the points as they were given, on the grid; not wrapped.
  std::span<const double> points() const;
  std::span<const double> weights() const;  ///< n, or none

  /// m×(k+1) rows, positively oriented when k = d.
  std::span<const SignedIndex> cells() const;
  /// m×(k+1)×r: vertex i of a cell is the point of its row plus Σ offset_j · lattice vector j.
  std::span<const std::int32_t> cell_offsets() const;
  /// m×(k+1): neighbor i is across the facet opposite vertex i; −1 where r < k and the facet is outside.
  std::span<const SignedIndex> neighbors() const;
  /// m×(k+1)×r: the neighbor is the cell of that number, translated by this.
  std::span<const std::int32_t> neighbor_offsets() const;
  /// n: the row of the vertex at each point; −1: hidden.
  std::span<const SignedIndex> vertex_of_point() const;
  /// n×r: a point is that of its vertex, translated by this; 0 for hidden points.
  std::span<const std::int32_t> point_offsets() const;
  /// Whether cells are told by their rows: no two edges have the same ends, and none the same end twice. O(n)
  /// on first use.
  bool is_simplicial() const;

  /// The hash of the set S + L and of all cells: the same for all sets S and bases of L that stand for it.
  /// O(n·d·r + m·k·d).
  CanonicalHash hash(const Execution& how = {}) const;
  /// A plain copy, of kind periodic_delaunay or periodic_regular.
  ComplexData to_data() const;
  /// What the triangulation has cost.
  Statistics statistics() const;
  /// How many images were inserted.
  std::size_t num_ghosts() const;

 protected:
  struct DELONE_HIDDEN Impl;

  PeriodicTriangulation(std::span<const double> points, std::span<const double> weights, bool is_regular,
                        const Lattice& lattice, int dimension, const PeriodicOptions& how,
                        const Options& options);
  /// `lattice`: null for the same.
  PeriodicTriangulation(const PeriodicTriangulation& before, std::span<const double> points,
                        std::span<const double> weights, const Lattice* lattice);
  PeriodicTriangulation(PeriodicTriangulation&&) noexcept;
  PeriodicTriangulation& operator=(PeriodicTriangulation&&) noexcept;
  ~PeriodicTriangulation();

  const Impl& impl() const { return *impl_; }

  template <int D>
  static std::span<const double> coordinates_of(const AnyPoints<D>& points, const Lattice& lattice) {
    points.require_dimension(lattice.dimension);
    return points.coordinates();
  }

 private:
  std::unique_ptr<Impl> impl_;
};

/// The Delaunay triangulation of a periodic set in R^D; in R^d, d that of the lattice, for D = dynamic.
template <int D = dynamic>
class PeriodicDelaunay : public PeriodicTriangulation {
  static_assert(D >= 0, "the dimension of the space is at least 1, or delone::dynamic");

 public:
  /// Throws Errc::not_finite, bad_dimension (of points, lattice or D); invalid_argument for a singular
  /// lattice and what PeriodicOptions refuse; unsupported, cancelled, too_many, out_of_memory, time_limit.
  PeriodicDelaunay(const AnyPoints<D>& points, const Lattice& lattice, const PeriodicOptions& how = {},
                   const Options& options = {})
      : PeriodicTriangulation(coordinates_of(points, lattice), {}, false, lattice,
                              D == dynamic ? lattice.dimension : D, how, options) {}

  /// A time step: what a new construction of these points would be, with the options of this one. Point i is
  /// where that of row i has moved to, anywhere, as at first. If most points have moved little, beyond the
  /// border or not, a copy of the triangulation is repaired and certified; otherwise everything is
  /// constructed. In space, with steps of a thousandth of the mean distance of neighbors, it takes about half
  /// the time of a construction. This object stays as it is; t = t.moved(points) goes on. `lattice`: another
  /// one of the same rank, for boxes that change. Throws as the constructor; bad_dimension also for another
  /// number of points.
  PeriodicDelaunay moved(const AnyPoints<D>& to) const { return {*this, to, nullptr}; }
  PeriodicDelaunay moved(const AnyPoints<D>& to, const Lattice& lattice) const {
    return {*this, to, &lattice};
  }

 private:
  PeriodicDelaunay(const PeriodicDelaunay& before, const AnyPoints<D>& to, const Lattice* lattice)
      : PeriodicTriangulation(before, coordinates_of(to, before.lattice()), {}, lattice) {}
};

/// The regular triangulation of weighted points and their translates; a translate has the weight of its
/// point. See Regular for weights and hidden points.
template <int D = dynamic>
class PeriodicRegular : public PeriodicTriangulation {
  static_assert(D >= 0, "the dimension of the space is at least 1, or delone::dynamic");

 public:
  /// Throws as PeriodicDelaunay; bad_dimension also unless there is one weight per point, not_finite also for
  /// a weight.
  PeriodicRegular(const AnyPoints<D>& points, std::span<const double> weights, const Lattice& lattice,
                  const PeriodicOptions& how = {}, const Options& options = {})
      : PeriodicTriangulation(coordinates_of(points, lattice), weights, true, lattice,
                              D == dynamic ? lattice.dimension : D, how, options) {}

  /// As PeriodicDelaunay::moved(). Points keep their weights, unless others are given, one for each.
  PeriodicRegular moved(const AnyPoints<D>& to) const { return moved(to, weights()); }
  PeriodicRegular moved(const AnyPoints<D>& to, const Lattice& lattice) const {
    return moved(to, weights(), lattice);
  }
  PeriodicRegular moved(const AnyPoints<D>& to, std::span<const double> weights) const {
    return {*this, to, weights, nullptr};
  }
  PeriodicRegular moved(const AnyPoints<D>& to, std::span<const double> weights,
                        const Lattice& lattice) const {
    return {*this, to, weights, &lattice};
  }

 private:
  PeriodicRegular(const PeriodicRegular& before, const AnyPoints<D>& to, std::span<const double> weights,
                  const Lattice* lattice)
      : PeriodicTriangulation(before, coordinates_of(to, before.lattice()), weights, lattice) {}
};

}  // namespace delone
