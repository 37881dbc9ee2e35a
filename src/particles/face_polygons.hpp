// SPDX-License-Identifier: BSD-3-Clause
// The vertices of one cell, and those of each of its faces in order around it.
#pragma once

#include "particles/proper_faces.hpp"
#include "particles/stars.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace delone::particles {

/// Vertices are numbered by their coordinates, and where these agree by the slots of their cells: neither
/// depends on the ids of cells.
class FacePolygons {
 public:
  /// `centers`: by cell of the triangulation, d coordinates. `classes`: null, or cells of one class have one
  /// vertex.
  FacePolygons(const Stars& stars, std::size_t d, std::span<const double> centers,
               const SphereClasses* classes)
      : complex_(stars.complex()), k_(stars.dimension()), d_(d), centers_(centers), classes_(classes) {}

  /// Of the star of v, whose neighbors are arranged.
  void find(Index v, const Star& star);
  std::size_t num_vertices() const { return representatives_.size(); }
  const double* vertex(std::size_t i) const {
    return centers_.data() + static_cast<std::size_t>(representatives_[i].cell) * d_;
  }
  /// The vertices of the face to a neighbor; −1 stands for infinity. k = 3: counterclockwise, seen from
  /// there, from −1 or the least one on. k = 2: the two ends, counterclockwise around the site. Otherwise
  /// they increase. With classes REQUIRES that the face is proper.
  std::span<const SignedIndex> face(std::size_t slot);

 private:
  /// A cell of the triangulation, and its number in the star.
  struct Corner {
    Index name, cell;
    std::uint32_t in_star;
  };
  /// A cell at an edge. k = 3: it leads from the facet with slot `from` to that with slot `to`. k = 2:
  /// whether it lies to the left is `to`.
  struct Link {
    std::uint32_t from, to;
    SignedIndex vertex;
  };
  void number_vertices(const Star& star);
  void collect_links(Index v, const Star& star);

  Complex complex_;
  std::size_t k_, d_;
  std::span<const double> centers_;
  const SphereClasses* classes_;
  std::vector<Corner> corners_, representatives_;
  std::vector<std::pair<Index, SignedIndex>> number_of_name_;  // by name
  std::vector<SignedIndex> numbers_;                           // by cell of the star; −1 if it is infinite
  std::vector<std::size_t> offsets_, next_;
  std::vector<Link> links_;               // by slot
  std::vector<std::uint32_t> slots_;      // of a cell, by position, without v
  std::vector<std::uint32_t> link_from_;  // by slot: the link that starts there
  std::vector<SignedIndex> face_;
};

}  // namespace delone::particles
