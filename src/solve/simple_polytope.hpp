// SPDX-License-Identifier: BSD-3-Clause
// Volumes and centroids of simple polytopes: each corner of a polytope of dimension m is on exactly m facets,
// which have labels. Duals of triangulations are simple, and so are polytopes cut by perturbed hyperplanes.
// Corners may coincide, so degenerate input is not a special case.
#pragma once

#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

namespace delone::solve {

/// Collects the corners of a polytope and computes its volume. Keeps its scratch memory from one polytope to
/// the next.
class SimplePolytope {
 public:
  /// Starts a polytope of dimension m ≥ 1 in R^d.
  void start(std::size_t m, std::size_t d);
  /// `x`: d coordinates, which are not copied and must stay valid; `labels`: the m facets that meet at the
  /// corner.
  void add_corner(const double* x, std::span<const std::size_t> labels);
  /// The m-volume. The volume of a face of dimension j is 1/j times the sum, over its facets, of volume times
  /// distance from one corner of the face (Cohen and Hickey 1979, doi:10.1145/322139.322141). A face is
  /// identified by the facets that contain it and measured once, however many faces it belongs to. So the
  /// cost is one of faces, not of flags: about Σ (corners)·m·log over all faces (Büeler, Enge and Fukuda
  /// 2000, doi:10.1007/978-3-0348-8438-9_6). Distances by Gram–Schmidt. Never negative; zero without corners.
  double volume();

  struct Facet {
    std::size_t label, num_corners;
    double volume;  ///< (m−1)-volume
  };
  struct Measures {
    double volume = 0;
    std::vector<double> centroid;  ///< d; empty if the volume is 0
    std::vector<Facet> facets;     ///< all that have corners, by label
  };
  /// The volume, the centroid and the facets. REQUIRES finite corners.
  Measures measures();

 private:
  struct Entry {
    std::size_t label, corner;
  };
  /// A measured face: its volume and, unless that is zero, one of its points and an orthonormal basis of its
  /// directions, one row of d numbers per dimension.
  struct Face {
    double volume;
    std::size_t origin, basis;  // a corner; an offset in bases_
    std::size_t centroid = 0;   // an offset in centroids_, if they are wanted; not of corners
  };
  struct LabelsHash {
    std::size_t operator()(const std::vector<std::size_t>& labels) const;
  };
  /// The unit of length for these corners; false if all are in one place, or one is at infinity.
  bool set_scale();
  void start_measuring(bool with_centroids);
  double unscaled(double volume, std::size_t dimension) const;
  /// Adds a pyramid of `part`, dimension times its volume, to the sum that a centroid is made from.
  void add_pyramid(std::size_t apex, const Face& base, std::size_t dimension, double part,
                   std::vector<double>& sum) const;
  /// The face of the given dimension on the facets on_, with the corners face_[first…last).
  Face find_face(std::size_t dimension, std::size_t first, std::size_t last);
  Face measure_face(std::size_t dimension, std::size_t first, std::size_t last);
  Face measure_edge(std::size_t first, std::size_t last);
  void gather(std::size_t first, std::size_t last, std::vector<Entry>& entries);
  /// The distance of a corner from the flat of a face. Sets normal_ to the unit vector from the flat to the
  /// corner, unless the distance is zero.
  double height(std::size_t corner, const Face& face, std::size_t dimension);
  template <std::size_t D>
  double height_in(std::size_t corner, const Face& face, std::size_t dimension);

  std::size_t m_ = 0, d_ = 0;
  std::vector<const double*> x_;
  std::vector<std::size_t> labels_;          // m per corner
  std::vector<std::size_t> face_;            // a stack of lists of corners
  std::vector<std::vector<Entry>> entries_;  // by dimension
  std::vector<std::size_t> on_;              // the labels of the current face, sorted
  std::vector<char> is_of_origin_;   // by label; 0 but while entries are gathered; empty if labels are many
  std::vector<std::size_t> places_;  // by label, while entries are sorted
  std::vector<Entry> sorted_;
  std::vector<double> bases_, normal_, centroids_;
  bool with_centroids_ = false;
  std::vector<std::vector<double>> best_normals_;  // by dimension
  std::unordered_map<std::vector<std::size_t>, Face, LabelsHash> known_;
  double scale_ = 1;
};

}  // namespace delone::solve
