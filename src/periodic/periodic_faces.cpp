// SPDX-License-Identifier: BSD-3-Clause
// Faces of the triangulation with ghosts whose lexicographically smallest vertex is a point of the set in the
// box: exactly one of each class. All cells at such a face are cells of the whole set, and so are the faces
// that contain it and their links; therefore its alpha value, which depends on these alone, is that of the
// whole set, too.
#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "periodic/stored_set.hpp"
#include "triangulation/stored_points.hpp"

#include <delone/alpha.hpp>
#include <delone/faces.hpp>
#include <delone/periodic_faces.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace delone {

namespace {

using periodic::CellClasses;
using periodic::GhostTriangulation;
using periodic::Offset;
using periodic::PeriodicSet;
using periodic::StoredSet;

/// A row and its translation.
using FaceVertex = std::pair<SignedIndex, std::vector<std::int32_t>>;

class FaceMaker {
 public:
  explicit FaceMaker(const PeriodicTriangulation& t)
      : set_(StoredSet::set(t)),
        ghosts_(StoredSet::ghosts(t)),
        points_(triangulation::StoredPoints::of(ghosts_.triangulation())),
        affine_dimension_(t.affine_dimension()),
        of_(t) {}

  /// `values`: of all faces of the triangulation with ghosts, or none.
  PeriodicFaceValues make(const Faces& all, std::span<const double> values) const {
    const std::size_t corners = static_cast<std::size_t>(all.dimension) + 1;
    std::vector<Named> chosen;
    std::vector<VertexId> vertices(corners);
    internal::QuickRounds round;
    for (std::size_t i = 0; i < all.size(); ++i) {
      round();
      const auto rows = all.face(i);
      std::ranges::transform(rows, vertices.begin(), [&](SignedIndex row) {
        return ghosts_.triangulation().vertex_at(static_cast<std::size_t>(row));
      });
      const VertexId smallest = smallest_of(vertices);
      if (!ghosts_.is_own(smallest)) continue;
      Named face;
      for (const VertexId v : vertices) face.vertices.push_back(named(v, smallest));
      std::ranges::sort(face.vertices);
      face.is_on_hull = all.on_hull[i];
      if (!values.empty()) face.value = outer_square(values[i]);
      chosen.push_back(std::move(face));
    }
    std::ranges::sort(chosen, [&](const Named& a, const Named& b) {
      round();
      return a.vertices < b.vertices;
    });
    if (all.dimension == affine_dimension_) put_in_order_of_cells(chosen);
    return arrays(chosen, all.dimension, !values.empty());
  }

 private:
  struct Named {
    std::vector<FaceVertex> vertices;
    unsigned char is_on_hull = 0;
    double value = 0;
  };

  VertexId smallest_of(std::span<const VertexId> vertices) const {
    return *std::ranges::min_element(vertices, [&](VertexId v, VertexId w) {
      const double *const x = points_.point(index(v)), *const y = points_.point(index(w));
      return std::lexicographical_compare(x, x + set_.dimension, y, y + set_.dimension);
    });
  }

  FaceVertex named(VertexId v, VertexId smallest) const {
    const std::size_t r = set_.rank, row = ghosts_.image_of(v).row, first = ghosts_.image_of(smallest).row;
    FaceVertex vertex{static_cast<SignedIndex>(row), std::vector<std::int32_t>(r)};
    Offset sum(r);
    for (std::size_t i = 0; i < r; ++i)
      sum[i] = std::int64_t{ghosts_.offset_of(v)[i]} - set_.wraps[row * r + i] + set_.wraps[first * r + i];
    set_.to_given_basis(sum, vertex.second.data());
    return vertex;
  }

  double outer_square(double value) const {
    return set_.unit > 0 ? value * set_.unit * set_.unit : std::ldexp(value, 2 * set_.scale);
  }

  /// Puts cells, which are sorted, and their vertices in the order of PeriodicTriangulation::cells().
  void put_in_order_of_cells(std::vector<Named>& chosen) const {
    const std::size_t corners = static_cast<std::size_t>(affine_dimension_) + 1, r = set_.rank;
    using Cell = std::vector<FaceVertex>;
    std::vector<Cell> cells(of_.num_cells());
    std::vector<std::pair<Cell, std::size_t>> names;
    internal::QuickRounds round;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      round();
      for (std::size_t i = 0; i < corners; ++i) {
        const auto offset = of_.cell_offsets().subspan((c * corners + i) * r, r);
        cells[c].emplace_back(of_.cells()[c * corners + i],
                              std::vector<std::int32_t>(offset.begin(), offset.end()));
      }
      names.emplace_back(cells[c], c);
      std::ranges::sort(names.back().first);
    }
    std::ranges::sort(names);
    std::vector<Named> in_order(chosen.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const std::size_t c = names[i].second;
      in_order[c] = std::move(chosen[i]);
      in_order[c].vertices = std::move(cells[c]);
    }
    chosen = std::move(in_order);
  }

  PeriodicFaceValues arrays(const std::vector<Named>& chosen, int dimension, bool has_values) const {
    PeriodicFaceValues made;
    made.faces.dimension = dimension;
    made.faces.rank = static_cast<int>(set_.rank);
    for (const Named& face : chosen) {
      for (const auto& [row, offset] : face.vertices) {
        made.faces.vertices.push_back(row);
        made.faces.offsets.insert(made.faces.offsets.end(), offset.begin(), offset.end());
      }
      made.faces.on_hull.push_back(face.is_on_hull);
      if (has_values) made.values.push_back(face.value);
    }
    return made;
  }

  const PeriodicSet& set_;
  const GhostTriangulation& ghosts_;
  const sites::VertexPoints& points_;
  int affine_dimension_;
  const PeriodicTriangulation& of_;
};

}  // namespace

PeriodicFaces faces(const PeriodicTriangulation& triangulation, int j, const Execution& how) {
  return internal::guarded("the faces", [&] {
    const internal::ProgressMeter meter(how.progress);
    const Faces all = faces(StoredSet::ghosts(triangulation).triangulation(), j, {.threads = how.threads});
    return FaceMaker(triangulation).make(all, {}).faces;
  });
}

PeriodicFaceValues alpha_values(const PeriodicTriangulation& triangulation, int j, const Execution& how) {
  return internal::guarded("the alpha values", [&] {
    const internal::ProgressMeter meter(how.progress);
    const FaceValues all =
        alpha_values(StoredSet::ghosts(triangulation).triangulation(), j, {.threads = how.threads});
    return FaceMaker(triangulation).make(all.faces, all.values);
  });
}

}  // namespace delone
