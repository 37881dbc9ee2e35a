// SPDX-License-Identifier: BSD-3-Clause
// Why the vertices of its link tell the alpha value of a face. Let τ have the smallest orthosphere with
// center c and squared radius R². All points x with the same power π(x) with respect to all vertices of τ
// form a flat orthogonal to that of τ, on which π(x) = R² + |x − c|². V(τ) is the part of it where no vertex
// has a smaller power, and the alpha value of τ is the least π on V(τ). V(τ) is the intersection of the
// halfspaces H_v, where v has no smaller power, for the vertices v of the link of τ alone: these are the
// facets of V(τ) in the triangulation of slightly perturbed weights, whose limit is V(τ). (That the halfspace
// of another vertex contains their intersection has, by the lemma of Farkas, a proof by fixed multipliers,
// which one combination of the finitely many gives for arbitrarily small perturbations, and in the limit.)
//
// If c ∈ V(τ), the value is R². Otherwise it is π at the point x* ∈ V(τ) that is next to c. c − x* is a sum
// of outward normals of halfspaces whose boundaries contain x*, with factors of at least 0, so c is strictly
// outside of one of these. Its vertex v is strictly inside the smallest orthosphere of τ, and x* is in V(τ ∪
// {v}) ⊂ V(τ). So the value of τ is the least one of the faces τ ∪ {v} for which v is in conflict with τ.
// That is so if and only if v and the center of the smallest orthosphere of τ ∪ {v} are strictly on different
// sides of τ. Ties need no care: v on the orthosphere of τ gives τ ∪ {v} the same orthosphere.
#include <delone/alpha.hpp>

#include "base/guarded.hpp"
#include "base/large_vector.hpp"
#include "base/quick_rounds.hpp"
#include "faces/face_blocks.hpp"
#include "faces/face_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace delone {
namespace internal {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();  // no value yet

/// The levels from dimension k down, and the alpha values of their faces.
class Filtration {
 public:
  Filtration(const Triangulation& triangulation, unsigned threads)
      : triangulation_(triangulation),
        threads_(threads),
        unit_(unit_of(triangulation)),
        level_(level_of_cells(triangulation)) {
    reserve_large(values_, level_.size());
    values_.assign(level_.size(), none);
    find_values();
  }

  FaceLevel& level() { return level_; }
  std::vector<double>& values() { return values_; }

  /// To the level of one dimension less. Returns the level before, and its values.
  std::pair<FaceLevel, std::vector<double>> descend() {
    const Complex complex = triangulation_.complex();
    sizes_.push_back(level_.size());
    // Euler's formula for the edges in space: vertices − edges + triangles − cells = 1.
    const std::size_t expected =
        sizes_.size() == 2 && level_.dimension == 2 ? complex.num_vertices() + sizes_[1] - sizes_[0] - 1 : 0;
    FaceLevel below = facets_of(level_, complex.num_vertex_slots(), threads_, expected);
    const std::size_t corners = level_.corners();
    std::vector<double> values;
    reserve_large(values, below.size());
    values.assign(below.size(), none);
    QuickRounds round;
    for (std::size_t face = 0; face < level_.size(); ++face) {
      round();
      for (std::size_t i = 0; i < corners; ++i) {
        if (!masks_.has(face, i)) continue;
        double& value = values[level_.facets[face * corners + i]];
        if (!(value <= values_[face])) value = values_[face];
      }
    }
    level_.facets = {};
    level_.neighbors = {};
    std::swap(values_, values);
    std::swap(level_, below);
    find_values();
    return {std::move(below), std::move(values)};
  }

 private:
  /// The values of the faces without one, which are in no conflict, and the masks of all.
  void find_values() {
    masks_ = Masks(level_.size(), level_.corners());
    using Want = Orthospheres::Want;
    const bool has_beyond =
        level_.dimension > 1 || triangulation::StoredPoints::of(triangulation_).weighted();
    for_wanted_faces(
        triangulation_, level_, unit_, threads_, [](std::size_t) { return true; },
        [&](FaceBlocks& blocks, std::span<std::size_t> faces) {
          const auto middle = std::partition(faces.begin(), faces.end(),
                                             [&](std::size_t face) { return std::isnan(values_[face]); });
          blocks.find({faces.begin(), middle}, has_beyond ? Want::both : Want::square,
                      [&](std::size_t face, const Orthospheres::Answer& answer) {
                        masks_.set(face, has_beyond ? answer.beyond : 0);
                        values_[face] = answer.square;
                      });
          if (has_beyond)
            blocks.find({middle, faces.end()}, Want::beyond,
                        [&](std::size_t face, const Orthospheres::Answer& answer) {
                          masks_.set(face, answer.beyond);
                        });
        });
  }

  const Triangulation& triangulation_;
  const unsigned threads_;
  const int unit_;
  FaceLevel level_;
  std::vector<double> values_;
  Masks masks_{0, 1};
  std::vector<std::size_t> sizes_;  // of the levels above
};

}  // namespace

void require_alpha(const Triangulation& triangulation) {
  if (triangulation.kind() == TriangulationKind::furthest_site)
    throw Error(Errc::unsupported, "a furthest-site triangulation has no alpha complex");
  if (triangulation.affine_dimension() > 63)
    throw Error(Errc::unsupported, "alpha complexes of cells with more than 64 vertices");
}

}  // namespace internal

FaceValues alpha_values(const Triangulation& triangulation, int j, const Execution& how) {
  internal::require_face_dimension(triangulation, j);
  internal::require_alpha(triangulation);
  return internal::guarded("the alpha values", [&] {
    const internal::ProgressMeter meter(how.progress);
    FaceValues result;
    result.faces.dimension = j;
    if (j > triangulation.affine_dimension()) return result;
    internal::Filtration filtration(triangulation, how.threads);
    while (filtration.level().dimension > j) filtration.descend();
    result.values = std::move(filtration.values());
    result.faces = internal::faces_by_rows(triangulation, std::move(filtration.level()), j, how.threads, {},
                                           &result.values);
    return result;
  });
}

std::vector<FaceValues> alpha_filtration(const Triangulation& triangulation, const Execution& how) {
  internal::require_alpha(triangulation);
  return internal::guarded("the alpha values", [&] {
    const internal::ProgressMeter meter(how.progress);
    const int k = triangulation.affine_dimension();
    std::vector<FaceValues> result(static_cast<std::size_t>(k + 1));
    if (k < 0) return result;
    internal::Filtration filtration(triangulation, how.threads);
    for (int j = k; j >= 0; --j) {
      FaceValues& to = result[static_cast<std::size_t>(j)];
      internal::FaceLevel level;
      if (j > 0) {
        std::tie(level, to.values) = filtration.descend();
      } else {
        std::swap(level, filtration.level());
        std::swap(to.values, filtration.values());
      }
      to.faces = internal::faces_by_rows(triangulation, std::move(level), j, how.threads, {}, &to.values);
    }
    return result;
  });
}

}  // namespace delone
