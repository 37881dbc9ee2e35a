// SPDX-License-Identifier: BSD-3-Clause
// The canonical hash: tags of points, and an accumulator of vertices and cells. The result depends neither on
// the order of vertices and cells nor on the order of the vertices in a cell. Plain data and the engine's
// complex both feed it.
#pragma once

#include "base/parallel_parts.hpp"
#include "base/random.hpp"

#include <delone/complex.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace delone::complex {

/// 128 bits for one point. Equal coordinates have equal tags, and −0 = +0. A sum of tags stands for a set of
/// points.
struct PointTag {
  std::uint64_t high = 0, low = 0;
  friend bool operator==(const PointTag&, const PointTag&) = default;
  PointTag& operator+=(const PointTag& other) {
    high += other.high;
    low += other.low;
    return *this;
  }
};

/// The tag of a point of R^dimension. O(dimension).
inline PointTag point_tag(const double* point, int dimension) {
  PointTag tag{0x243f6a8885a308d3u,
               0x13198a2e03707344u};  // digits of π: the two halves must start differently
  for (int axis = 0; axis < dimension; ++axis) {
    // Adding 0.0 turns −0 into +0 and changes no other number.
    const auto bits = std::bit_cast<std::uint64_t>(point[axis] + 0.0);
    tag.high = random::mix(tag.high + 0x9e3779b97f4a7c15u + bits);
    tag.low = random::mix((tag.low ^ bits) + 0xd1342543de82ef95u);
  }
  return tag;
}

/// Collects the distinct vertices and the finite cells of a triangulation, in any order.
class HashAccumulator {
 public:
  void add_vertex(const PointTag& vertex) { add(vertices_, vertex); }
  /// `sum_of_vertices`: the sum of the tags of the k+1 vertices of the cell.
  void add_cell(const PointTag& sum_of_vertices) {
    add(cells_, sum_of_vertices);
    ++num_cells_;
  }
  /// Adds all that was added to another accumulator.
  void add(const HashAccumulator& other) {
    vertices_ += other.vertices_;
    cells_ += other.cells_;
    num_cells_ += other.num_cells_;
  }
  /// All that was added as numbers, and the accumulator that gave such numbers.
  std::array<std::uint64_t, 5> words() const {
    return {vertices_.high, vertices_.low, cells_.high, cells_.low, num_cells_};
  }
  static HashAccumulator of_words(const std::array<std::uint64_t, 5>& words) {
    HashAccumulator hash;
    hash.vertices_ = {words[0], words[1]};
    hash.cells_ = {words[2], words[3]};
    hash.num_cells_ = words[4];
    return hash;
  }
  /// The hash of everything added, for points of R^dimension with the given affine dimension.
  CanonicalHash finish(int dimension, int affine_dimension) const {
    const auto shape =
        (static_cast<std::uint64_t>(dimension) << 32) ^ static_cast<std::uint32_t>(affine_dimension);
    return {random::mix(random::mix(random::mix(cells_.high + num_cells_) + vertices_.high) + shape),
            random::mix(random::mix(random::mix(cells_.low ^ num_cells_) ^ vertices_.low) ^ shape)};
  }

 private:
  // Tags are mixed before they are added up. Otherwise cells {a,b} and {c,d} would give the same sum as {a,c}
  // and {b,d}.
  static void add(PointTag& total, const PointTag& tag) {
    total.high += random::mix(tag.high ^ std::rotl(tag.low, 32));
    total.low += random::mix(tag.low + 0x9e3779b97f4a7c15u * tag.high);
  }

  PointTag vertices_, cells_;
  std::uint64_t num_cells_ = 0;
};

/// Adds what add_some(first, last, hash) adds for the parts of 0 … size − 1, in up to `threads` threads.
template <class AddSome>
void add_in_parts(unsigned threads, std::size_t size, HashAccumulator& hash, const AddSome& add_some) {
  constexpr std::size_t part = 16384;
  std::mutex mutex;
  internal::for_parts(threads, size, part,
                      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                        stop();
                        HashAccumulator some;
                        add_some(first, last, some);
                        const std::lock_guard lock(mutex);
                        hash.add(some);
                      });
}

}  // namespace delone::complex
