// SPDX-License-Identifier: BSD-3-Clause
// Alpha complexes of Delaunay and regular triangulations: which faces belong to an object that is known by
// sample points.
#pragma once

#include <delone/data.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/faces.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace delone {

/// The alpha values of the faces of one dimension. The *alpha value* of a face is the least squared radius of
/// a sphere that is orthogonal to its vertices (without weights: that passes through them), and has no other
/// vertex strictly inside: |x − p|² − w is at least the squared radius for the center x and every vertex (p,
/// w). The face is in the alpha complex if and only if alpha² is at least this value, which may be negative
/// if there are weights.
///
/// Each value is the least double that is not below the exact one (+infinity beyond the range of doubles). So
/// for every double s, the face is in the complex of alpha² = s if and only if its value is ≤ s; equal exact
/// values are equal doubles; no face has a greater value than a face that contains it.
struct DELONE_EXPORT_TYPE FaceValues {
  Faces faces;
  std::vector<double> values;  ///< one per face
};

/// The faces of dimension j and their alpha values; none for k < j ≤ d.
///
/// Method: a face is in conflict with a vertex of its link or not (Gabriel), decided exactly by the center of
/// the face and that vertex; without conflict its value is the squared radius of its smallest orthosphere,
/// otherwise the least value of the faces of one dimension more that contain it. Edelsbrunner and Mücke,
/// "Three-dimensional alpha shapes", doi:10.1145/174462.156635; with weights Edelsbrunner, "Weighted alpha
/// shapes", UIUCDCS-R-92-1760 (1992). Ties are decided exactly: cospherical cells have equal values.
///
/// Throws Errc::invalid_argument (j < 0 or j > d), unsupported (a furthest-site triangulation, k > 63),
/// out_of_memory, too_many, cancelled. Cost: that of the faces of all dimensions from j on, and a solve of i
/// equations for each of dimension i; integers if certified bounds in binary64 do not decide.
DELONE_EXPORT FaceValues alpha_values(const Triangulation& triangulation, int j, const Execution& how = {});

/// The same for all dimensions 0 … k at once, at the cost of dimension 0. Throws as alpha_values().
DELONE_EXPORT std::vector<FaceValues> alpha_filtration(const Triangulation& triangulation,
                                                       const Execution& how = {});

/// The alpha complex of a Delaunay or regular triangulation below a radius r: the faces with an alpha value
/// of at most r². Its union has the shape (the homotopy type) of the union of the balls of radius r about the
/// points; with weights, of radius √(r² + w).
///
/// Exact for every double r, even if r² is not a double: rounding never decides.
///
/// Refers to the triangulation, which must outlive it and not change. Points that span a k-flat have their
/// complex inside the flat. Throws Errc::invalid_argument (a radius that is negative or NaN; infinity gives
/// all faces), unsupported (a furthest-site triangulation), out_of_memory, cancelled. Cost: O(m·k³) for m
/// cells.
class DELONE_EXPORT AlphaComplex {
 public:
  AlphaComplex(const Triangulation& triangulation, double radius, const Execution& how = {});
  /// The faces with a value of at most `square`, of any sign: weights make some values negative. Throws
  /// Errc::invalid_argument for NaN, otherwise as the constructor.
  static AlphaComplex of_squared_radius(const Triangulation& triangulation, double square,
                                        const Execution& how = {});
  AlphaComplex(AlphaComplex&&) noexcept;
  AlphaComplex& operator=(AlphaComplex&&) noexcept;
  ~AlphaComplex();

  int dimension() const;         ///< d
  int affine_dimension() const;  ///< k
  /// Its cells, as rows of Triangulation::to_data().cells, increasing.
  std::span<const SignedIndex> cell_numbers() const;
  /// b×k point rows: the facets that belong to exactly one cell of the complex, in the order of these cells.
  /// They enclose the cells. With a point of the cell put first they are positively oriented when k = d > 1:
  /// counterclockwise as seen from outside in space.
  std::span<const SignedIndex> boundary() const;
  std::span<const SignedIndex> boundary_cells() const;  ///< b: the cell of each
  /// s×k point rows, increasing in each: the singular facets, which are in the complex although no cell that
  /// contains them is.
  std::span<const SignedIndex> singular_facets() const;

  /// Its faces of dimension j; none for k < j ≤ d. Throws as alpha_values(). Cost: that of the faces of all
  /// dimensions from j on.
  Faces faces(int j, const Execution& how = {}) const;

  /// The cells as a triangulation, with all points; neighbors are −1 beyond the boundary. column_names are
  /// empty here and in boundary_data().
  ComplexData to_data() const;
  /// The boundary as simplices of dimension k−1, with all points and without neighbors.
  ComplexData boundary_data() const;

 private:
  struct DELONE_HIDDEN Impl;
  explicit AlphaComplex(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace delone
