// SPDX-License-Identifier: BSD-3-Clause
// Volumes of simple polytopes: of dimension m, each corner on exactly m facets, which are named by labels. This is what the
// dual of a triangulation and a polytope cut by perturbed hyperplanes are; corners may coincide, so that nothing is special
// about degenerate input.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace delone::front_ends {

/// A sum with the rounding errors of all additions added at the end (Neumaier 1974, doi:10.1002/zamm.19740540106).
class CompensatedSum {
 public:
  void add(double x);
  double value() const { return sum_ + compensation_; }

 private:
  double sum_ = 0, compensation_ = 0;
};

/// Collects the corners of a polytope, then its volume. Scratch memory is kept from one polytope to the next.
class SimplePolytope {
 public:
  /// A polytope of dimension m ≥ 1 in R^d; forgets the one before.
  void start(std::size_t m, std::size_t d);
  /// `x`: d coordinates, which must stay where they are; `labels`: the m facets through it.
  void add_corner(const double* x, std::span<const std::size_t> labels);
  /// The m-volume. Pulling triangulation: a face is the union of the pyramids over its facets that miss one of its corners,
  /// and so on down to edges. Simplices are measured by Gram–Schmidt. Never negative; 0 for no corners.
  double volume();

 private:
  struct Entry {
    std::size_t label, corner;
  };
  /// Adds the volumes, times `product`, of the simplices that join the flag of apexes so far to a face of the given dimension,
  /// whose corners are face_[first…last).
  void add_face(std::size_t dimension, std::size_t first, std::size_t last, const double* apex, double product);
  /// The length of to − from orthogonal to the basis, which it joins unless the length is 0.
  double push(const double* from, const double* to);

  std::size_t m_ = 0, d_ = 0;
  std::vector<const double*> x_;
  std::vector<std::size_t> labels_;          // m per corner
  std::vector<std::size_t> face_;            // a stack of lists of corners
  std::vector<std::vector<Entry>> entries_;  // by dimension
  std::vector<double> basis_;                // orthonormal rows of d
  double scale_ = 1;
  CompensatedSum sum_;
};

}  // namespace delone::front_ends
