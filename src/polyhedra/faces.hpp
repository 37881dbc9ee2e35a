// SPDX-License-Identifier: BSD-3-Clause
// Faces of polyhedra as sets of generators, or of facets, and what is found by going through them.
#pragma once

#include "polyhedra/bit_rows.hpp"
#include "polyhedra/description.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::polyhedra {

using Face = std::vector<std::uint64_t>;

struct FaceHash {
  std::size_t operator()(const Face& face) const;
};

/// The largest of the sets face ∩ sets[i] that are not all of the face, each once. If the face is one of
/// generators, and the sets are those of all facets, they are its facets.
std::vector<Face> largest_parts(const Face& face, const BitRows& sets);

/// f_0 … f_(k−1) of a polyhedron that is not empty.
std::vector<std::size_t> count_faces(const Description& description, const BitRows& generators_of_facets);

/// The d-dimensional volume of a polytope of affine dimension d, as a fraction.
struct ExactVolume {
  Integer numerator, denominator;
};
ExactVolume volume_of(const Description& description, const BitRows& generators_of_facets);

}  // namespace delone::polyhedra
