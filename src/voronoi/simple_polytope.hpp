// SPDX-License-Identifier: BSD-3-Clause
// Volumes of simple polytopes: of dimension m, each corner on exactly m facets, which are named by labels.
// This is what the dual of a triangulation and a polytope cut by perturbed hyperplanes are; corners may
// coincide, so that nothing is special about degenerate input.
#pragma once

#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

namespace delone::internal {

/// A sum with the rounding errors of all additions added at the end (Neumaier 1974,
/// doi:10.1002/zamm.19740540106).
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
  /// The m-volume: a face of dimension j has 1/j times the volumes of its facets times their distances from
  /// one of its corners (Cohen and Hickey 1979, doi:10.1145/322139.322141). A face, known by the facets that
  /// it lies on, is measured once however many faces it belongs to, which makes the cost one of faces, not of
  /// flags: about Σ over faces of (corners)·m·log. See Büeler, Enge and Fukuda 2000,
  /// doi:10.1007/978-3-0348-8438-9_6. Distances by Gram–Schmidt. Never negative; 0 for no corners.
  double volume();

 private:
  struct Entry {
    std::size_t label, corner;
  };
  /// What is known of a face: its volume, and unless that is 0 a point of it and an orthonormal basis of its
  /// directions (as many rows of d as its dimension).
  struct Face {
    double volume;
    std::size_t origin, basis;  // a corner; a place in bases_
  };
  struct LabelsHash {
    std::size_t operator()(const std::vector<std::size_t>& labels) const;
  };
  /// The face of the given dimension on the facets on_, whose corners are face_[first…last).
  Face find_face(std::size_t dimension, std::size_t first, std::size_t last);
  Face measure_face(std::size_t dimension, std::size_t first, std::size_t last);
  /// The distance of a corner from the flat of a face; normal_ becomes the unit vector to it unless it is 0.
  double height(std::size_t corner, const Face& face, std::size_t dimension);

  std::size_t m_ = 0, d_ = 0;
  std::vector<const double*> x_;
  std::vector<std::size_t> labels_;          // m per corner
  std::vector<std::size_t> face_;            // a stack of lists of corners
  std::vector<std::vector<Entry>> entries_;  // by dimension
  std::vector<std::size_t> on_;              // the labels of the face in hand, sorted
  std::vector<double> bases_, normal_;
  std::vector<std::vector<double>> best_normals_;  // by dimension
  std::unordered_map<std::vector<std::size_t>, Face, LabelsHash> known_;
  double scale_ = 1;
};

}  // namespace delone::internal
