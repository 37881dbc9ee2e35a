// SPDX-License-Identifier: BSD-3-Clause
// The two loops of a search for the cells of a hole: from the functions of a cell to those of a neighbor, and
// over all vertices that may be beyond its facets. Compiled for several instruction sets; the best one of the
// machine is chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace delone::geometry {

/// The k + 2 functions of a cell are affine functions of images: its barycentric coordinates, and its
/// functional without the lift. Their coefficients are stored by image coordinate: coefficient r of function
/// f is entry r·width + f, and the constants come last, r = k.
constexpr std::size_t width_of_functions(int k) {
  const auto count = static_cast<std::size_t>(k) + 2;
  return count <= 4 ? 4 : (count + 7) / 8 * 8;
}
constexpr std::size_t size_of_functions(int k) {
  return (static_cast<std::size_t>(k) + 1) * width_of_functions(k);
}

/// The functions of the cell that has another vertex in a slot. `row`: the image and lift of that vertex. Not
/// finite where the vertex is on the facet opposite the slot. Cost O(k²).
void replace_vertex(int k, const double* functions, int slot, const double* row, double* replaced);

/// A search of the vertices that come first in the pencils of facets of one cell. T: float or double, in
/// which values are computed.
template <class T>
struct PencilTask {
  int k;
  const double* functions;
  const int* slots;  ///< of the vertices opposite the facets
  std::size_t num_slots;
  double side;  ///< −1: beyond the facets; 1: on the side of the cell
  /// Coordinate r of candidate i is entry r·stride + i, and the lifts come last, infinite for what must not
  /// be found. The stride is a multiple of 16.
  const T* rows;
  std::size_t stride;
  double largest_lift;       ///< of their magnitudes
  T* heights;                ///< scratch memory, stride numbers
  T* distances;              ///< the same
  const std::uint32_t* own;  ///< the candidates that are vertices of the cell: these are not found
  std::size_t num_own;
  bool* is_certain;  ///< for each facet, receives whether some candidate is certainly on the side
};

/// How many words have a bit for each candidate.
constexpr std::size_t words_of_candidates(std::size_t stride) { return (stride + 63) / 64; }

/// For one facet after the other, sets the bits of all candidates that may be first, and clears the others:
/// those may be whose least possible ratio of height and distance from the facet is at most the least
/// possible one of all that are certainly on the side. Cost O(k) per candidate and facet. In float, more
/// candidates may be first, and all of them where numbers are too large.
void find_first(const PencilTask<float>& task, std::uint64_t* found);
void find_first(const PencilTask<double>& task, std::uint64_t* found);

}  // namespace delone::geometry
