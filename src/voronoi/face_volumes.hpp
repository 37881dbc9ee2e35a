// SPDX-License-Identifier: BSD-3-Clause
// Volumes of all faces of a simple cell complex at once, each face measured once: the faces of a Voronoi or
// power diagram, or those of one simple polytope.
//
// A face is named by the labels of the sites whose regions it belongs to; it is orthogonal to the flat of
// their points. A corner of dimension m has m + 1 labels, and a face of dimension j has m + 1 − j. The volume
// of a face is 1/j times the sum, over its facets, of volume times distance from one corner of the face
// (Cohen and Hickey 1979, doi:10.1145/322139.322141). With σ the labels of the face and σ ∪ {w} those of the
// facet, let n be the height of the point of w over the flat of σ. Then the distance of corner o from the
// facet is
//     (x − o)·(p_w − p_s)/n    for any corner x of the facet and any s in σ,
// as x − o is orthogonal to σ, and n is the ratio of the volumes of two simplices. All terms are at least 0.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace delone::voronoi {

class FaceVolumes {
 public:
  /// Corners of dimension m in R^d.
  FaceVolumes(std::size_t m, std::size_t d) : m_(m), d_(d) {}

  /// The points of all labels, d coordinates each, in any unit of length. They are not copied.
  void set_points(std::span<const double> points) { points_ = points; }
  void clear();
  /// A corner, off by at most `error` along each axis, and its labels, which must increase.
  void add_corner(std::span<const double> x, double error, std::span<const Index> labels);
  std::size_t num_corners() const { return errors_.size(); }

  /// A face of `size` labels. The volume is uncertain where the bound is not of the order of rounding errors.
  struct Face {
    std::span<const Index> labels;
    double volume;
    /// Whether the result is about as good as one from the corners alone: points of the labels that are
    /// nearly dependent magnify rounding errors.
    bool is_accurate;
  };
  /// Visits all faces with `size` labels, some of which are wanted. REQUIRES all corners of these faces, size
  /// ≤ m, and that no product of m lengths overflows or underflows. Cost O(m·(m + d)) per pair of a face and
  /// a facet of it, memory for the faces of two dimensions.
  void measure(std::size_t size, const std::vector<unsigned char>& wanted,
               const std::function<void(const Face&)>& visit);

 private:
  /// The faces of one dimension.
  struct Level {
    std::size_t size = 0;  ///< labels per face
    std::vector<Index> labels;
    std::vector<std::uint64_t> keys;  ///< sums over the labels
    std::vector<double> volumes, errors;
    std::vector<double> least_errors;  ///< what errors of the corners alone would do
    std::vector<double> simplices;  ///< (size − 1)! times the volume of the simplex of the labels' points
    std::vector<double> simplex_errors;  ///< relative
    std::vector<Index> corners;          ///< one of each face

    std::size_t count() const { return keys.size(); }
    std::span<const Index> labels_of(std::size_t face) const { return {labels.data() + face * size, size}; }
  };
  Level corners_as_faces() const;
  Level next(const Level& level, const std::vector<unsigned char>& wanted);
  void measure_simplex(std::span<const Index> labels, double& volume, double& error);
  const double* point(Index label) const { return points_.data() + std::size_t{label} * d_; }
  const double* corner(Index c) const { return x_.data() + std::size_t{c} * d_; }
  std::span<const Index> labels_of_corner(Index c) const {
    return {labels_.data() + std::size_t{c} * (m_ + 1), m_ + 1};
  }

  std::size_t m_, d_;
  std::span<const double> points_;
  std::vector<double> x_, errors_;       // of the corners
  std::vector<Index> labels_;            // m + 1 per corner
  std::vector<Index> table_;             // of the level being made
  std::vector<double> edges_, lengths_;  // of a simplex
};

}  // namespace delone::voronoi
