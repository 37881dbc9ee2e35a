// SPDX-License-Identifier: BSD-3-Clause
// Ids, views of coordinates and the small vocabulary shared by every header.
#pragma once

#include <delone/config.hpp>
#include <delone/error.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace delone {

/// The integer behind every id: 32 bits, or 64 in a build with DELONE_64BIT_IDS.
#if DELONE_64BIT_IDS
using Index = std::uint64_t;
using SignedIndex = std::int64_t;
#else
using Index = std::uint32_t;
using SignedIndex = std::int32_t;
#endif

/// A vertex of the complex. Vertex 0 is the infinite vertex; finite vertices count from 1 in the order of
/// insertion or edit.
enum class VertexId : Index {};

/// A cell of the complex: a slot in the cell arrays. An id stays valid until its cell is destroyed by an
/// insertion or edit.
enum class CellId : Index {};

inline constexpr VertexId infinite_vertex{0};
inline constexpr Index invalid_index = std::numeric_limits<Index>::max();
inline constexpr CellId invalid_cell{invalid_index};
inline constexpr VertexId invalid_vertex{invalid_index};

/// The largest id that is ever assigned. Ids also fit the signed type of the same width, which files and
/// arrays use.
inline constexpr Index max_index = static_cast<Index>(std::numeric_limits<SignedIndex>::max()) - 1;

constexpr Index index(VertexId v) { return static_cast<Index>(v); }
constexpr Index index(CellId c) { return static_cast<Index>(c); }

/// A facet of the complex: a cell and the index of the vertex opposite the facet.
struct Facet {
  CellId cell = invalid_cell;
  int opposite = 0;
  friend bool operator==(const Facet&, const Facet&) = default;
};

/// The dimension of a class template whose dimension is given to the constructor.
inline constexpr int dynamic = 0;

/// The sign of an exactly evaluated real number.
enum class Sign : int { negative = -1, zero = 0, positive = 1 };

constexpr Sign operator-(Sign s) { return static_cast<Sign>(-static_cast<int>(s)); }
constexpr Sign operator*(Sign a, Sign b) {
  return static_cast<Sign>(static_cast<int>(a) * static_cast<int>(b));
}

/// The side of a sphere or hyperplane that a point lies on, decided exactly. Positive is inside.
enum class Side : signed char { outside = -1, on = 0, inside = 1 };

/// A length, area or volume: the exact one differs from `value` by at most `error`.
struct Measure {
  double value = 0;
  double error = 0;
};

/// A read-only view of n points in R^d: n·d contiguous doubles, row-major (one point after the other).
class PointsView {
 public:
  PointsView() = default;
  /// Throws Errc::bad_dimension unless dimension ≥ 1 and coordinates.size() is a multiple of it.
  PointsView(std::span<const double> coordinates, int dimension)
      : coordinates_(coordinates), dimension_(dimension) {
    if (dimension < 1 || coordinates.size() % static_cast<std::size_t>(dimension) != 0)
      throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  }

  int dimension() const { return dimension_; }
  std::size_t size() const {
    return dimension_ == 0 ? 0 : coordinates_.size() / static_cast<std::size_t>(dimension_);
  }
  bool empty() const { return coordinates_.empty(); }
  const double* data() const { return coordinates_.data(); }
  std::span<const double> coordinates() const { return coordinates_; }
  std::span<const double> operator[](std::size_t row) const {
    return coordinates_.subspan(row * static_cast<std::size_t>(dimension_),
                                static_cast<std::size_t>(dimension_));
  }

 private:
  std::span<const double> coordinates_;
  int dimension_ = 0;
};

}  // namespace delone
