// SPDX-License-Identifier: BSD-3-Clause
// What can be passed as a point or as points: AnyPoint and AnyPoints, the parameter types of the products.
#pragma once

#include <delone/error.hpp>
#include <delone/point_traits.hpp>
#include <delone/types.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone {
namespace detail {

[[noreturn]] inline void throw_wrong_size(std::size_t row, std::size_t found, std::size_t expected) {
  throw Error(Errc::bad_dimension,
              "row " + std::to_string(row) + " has " + std::to_string(found) +
                  (expected == 0 ? " entries" : " entries, not " + std::to_string(expected)),
              {row});
}

[[noreturn]] inline void throw_wrong_dimension(const char* list, int found, int expected) {
  throw Error(Errc::bad_dimension, std::string(list) + ": points in " + std::to_string(found) +
                                       " dimensions, not " + std::to_string(expected));
}

}  // namespace detail

/// A point of R^D as an argument. Made from {x, y, z}; a span, vector or other range of D doubles or floats;
/// a fixed-size vector of Eigen; a type with PointTraits. Contiguous doubles are read in place, others
/// copied. D = dynamic: any number of coordinates. Throws Errc::bad_dimension unless there are D.
template <int D = dynamic>
class AnyPoint {
 public:
  template <class P>
  requires(!std::same_as<std::remove_cvref_t<P>, AnyPoint> && !std::is_arithmetic_v<std::remove_cvref_t<P>>)
      AnyPoint(const P& point) {
    if constexpr (!detail::is_point<D, P>()) {
      static_assert(detail::always_false<P>,
                    "a point must be of D doubles: a std::array<double, D> or Eigen vector of that size, a "
                    "range of doubles or floats, or a type for which delone::PointTraits is specialized");
    } else if constexpr (detail::is_contiguous_point<P>()) {
      coordinates_ = {reinterpret_cast<const double*>(&point), sizeof(P) / sizeof(double)};
    } else if constexpr (detail::ContiguousCoordinates<const P>) {
      coordinates_ = {std::ranges::data(point), std::ranges::size(point)};
    } else {
      copy(point);
    }
    if (D != dynamic && coordinates_.size() != static_cast<std::size_t>(D))
      throw Error(Errc::bad_dimension, "the point has " + std::to_string(coordinates_.size()) +
                                           " coordinates, not " + std::to_string(D));
  }
  /// {x, y, z}: D numbers that doubles hold exactly.
  template <class... C>
  requires(D != dynamic && sizeof...(C) == D &&
           ((detail::Coordinate<C> || (std::integral<C> && sizeof(C) <= 4)) && ...))
      AnyPoint(C... coordinates)
      : copy_{detail::as_double(coordinates)...}, coordinates_(copy_) {}
  AnyPoint(std::initializer_list<double> coordinates) requires(D == dynamic)
      : copy_(coordinates), coordinates_(copy_) {}
  AnyPoint(const AnyPoint&) = delete;  // it may refer to itself
  AnyPoint& operator=(const AnyPoint&) = delete;

  std::span<const double> coordinates() const { return coordinates_; }
  operator std::span<const double>() const { return coordinates_; }

 private:
  template <class P>
  void copy(const P& point) {
    if constexpr (D == dynamic) {
      detail::for_each_coordinate(point, [&](double coordinate) { copy_.push_back(coordinate); });
      coordinates_ = copy_;
    } else {
      std::size_t count = 0;
      detail::for_each_coordinate(point, [&](double coordinate) {
        if (count < copy_.size()) copy_[count] = coordinate;
        ++count;
      });
      coordinates_ = {copy_.data(), count};  // of another count the caller throws
    }
  }

  std::conditional_t<D == dynamic, std::vector<double>, std::array<double, (D > 0 ? D : 1)>> copy_;
  std::span<const double> coordinates_;
};

namespace detail {
/// The tag of the constructors behind clone().
struct Clone {};
}  // namespace detail

/// Points of R^D as an argument, made from:
///   read in place: contiguous ranges of doubles (D per point), of std::array<double, D>, double[D],
///     fixed-size vectors of Eigen, types with PointTraits that are contiguous; row-major matrices of doubles
///     of D columns, dense; a PointsView. Containers that are moved in are consumed if the function says
///     so.
///   copied: any other range of points (AnyPoint), as vectors of vectors and lists; matrices with gaps
///     between their rows.
/// Throws Errc::bad_dimension, naming the row, if a point has another number of coordinates. Other types do
/// not compile. D = dynamic: all points have the same number of coordinates, and plain doubles fit any
/// dimension.
template <int D = dynamic>
class AnyPoints {
 public:
  template <class Range>
  requires(!std::same_as<std::remove_cvref_t<Range>, AnyPoints> && detail::MaybePoints<Range>)
      AnyPoints(Range&& points) {
    using Type = std::remove_cvref_t<Range>;
    if constexpr (detail::Matrix<Type>) {
      read_matrix(points);
    } else if constexpr (detail::MappedVector<Type>) {
      read_vector(points);
    } else if constexpr (std::ranges::contiguous_range<Range> && std::ranges::sized_range<Range>) {
      read_contiguous(points);
    } else {
      copy_range(points);
    }
    if constexpr (detail::Expiring<Range> && std::move_constructible<Type> &&
                  !std::is_trivially_destructible_v<Type>) {
      if (copy_.empty() && !coordinates_.empty()) {
        container_ = &points;
        consume_ = [](void* container) { const Type taken = std::move(*static_cast<Type*>(container)); };
      }
    }
  }
  AnyPoints(PointsView points) : coordinates_(points.coordinates()) {
    if (!points.empty()) check(0, static_cast<std::size_t>(points.dimension()));
  }
  AnyPoints(AnyPoints&&) noexcept = default;
  AnyPoints& operator=(AnyPoints&&) noexcept = default;

  /// All coordinates, one point after the other.
  std::span<const double> coordinates() const { return coordinates_; }
  /// The number of coordinates of each point; 0 for plain doubles if D is dynamic.
  int dimension() const { return dimension_; }
  /// Throws Errc::bad_dimension if the points have another number of coordinates.
  void require_dimension(int expected) const {
    if (dimension_ != 0 && dimension_ != expected && !coordinates_.empty())
      detail::throw_wrong_size(0, static_cast<std::size_t>(dimension_), static_cast<std::size_t>(expected));
  }
  /// The same, with a message that names a list of an edit.
  void require_dimension(int expected, const char* list) const {
    if (dimension_ != 0 && dimension_ != expected && !coordinates_.empty())
      detail::throw_wrong_dimension(list, dimension_, expected);
  }
  /// Releases the memory of a copy, and of a container that was moved in. There are no coordinates
  /// afterwards.
  void release() {
    coordinates_ = {};
    copy_ = std::vector<double>();
    if (consume_ != nullptr) std::exchange(consume_, nullptr)(container_);
  }

 private:
  void check(std::size_t row, std::size_t found) {
    if (dimension_ == 0) dimension_ = static_cast<int>(found);
    if (found != static_cast<std::size_t>(dimension_) || found == 0)
      detail::throw_wrong_size(row, found, static_cast<std::size_t>(dimension_));
  }

  template <class Element>
  static constexpr void require_point() {
    static_assert(detail::is_point<D, Element>(),
                  "a point must be of D doubles: a std::array<double, D> or Eigen vector of that size, a "
                  "range of doubles or floats, or a type for which delone::PointTraits is specialized");
  }

  template <class Range>
  void read_contiguous(Range& points) {
    using Element = std::ranges::range_value_t<Range>;
    if constexpr (std::same_as<Element, double>) {
      coordinates_ = {std::ranges::data(points), static_cast<std::size_t>(std::ranges::size(points))};
    } else if constexpr (detail::is_point<D, Element>() && detail::is_contiguous_point<Element>()) {
      // Each element is its coordinates: is_contiguous_point().
      coordinates_ = {reinterpret_cast<const double*>(std::ranges::data(points)),
                      static_cast<std::size_t>(std::ranges::size(points)) * sizeof(Element) / sizeof(double)};
      dimension_ = detail::dimension_of<Element>();
    } else {
      copy_range(points);
    }
  }

  template <class Range>
  void copy_range(Range& points) {
    using Element = std::remove_cvref_t<std::ranges::range_reference_t<Range>>;
    require_point<Element>();
    if constexpr (detail::is_point<D, Element>()) {
      std::size_t row = 0;
      for (auto&& point : points) {
        const std::size_t before = copy_.size();
        detail::for_each_coordinate(point, [&](double coordinate) { copy_.push_back(coordinate); });
        check(row++, copy_.size() - before);
      }
      coordinates_ = copy_;
    }
  }

  template <class Vector>
  void read_vector(const Vector& vector) {
    if constexpr (std::same_as<typename Vector::Scalar, double>) {
      const auto size = static_cast<std::size_t>(vector.size());
      const auto stride = static_cast<std::size_t>(vector.innerStride());
      if (stride == 1) {
        coordinates_ = {vector.data(), size};
      } else {
        for (std::size_t i = 0; i < size; ++i) copy_.push_back(vector.data()[i * stride]);
        coordinates_ = copy_;
      }
    } else {
      require_point<typename Vector::Scalar>();
    }
  }

  template <class M>
  void read_matrix(const M& matrix) {
    static_assert(std::same_as<typename M::Scalar, double>, "a point must be of D doubles: a matrix of them");
    static_assert(bool(M::IsRowMajor),
                  "points are the rows of a row-major matrix: use Eigen::RowMajor, or, for a column-major "
                  "matrix whose columns are the points, pass matrix.transpose()");
    if constexpr (std::same_as<typename M::Scalar, double> && bool(M::IsRowMajor)) {
      const auto rows = static_cast<std::size_t>(matrix.rows());
      const auto columns = static_cast<std::size_t>(matrix.cols());
      if (rows > 0) check(0, columns);
      std::size_t inner = 1, outer = columns;
      if constexpr (requires { matrix.innerStride(); })
        inner = static_cast<std::size_t>(matrix.innerStride());
      if constexpr (requires { matrix.outerStride(); })
        outer = static_cast<std::size_t>(matrix.outerStride());
      if (inner == 1 && outer == columns) {
        coordinates_ = {matrix.data(), rows * columns};
      } else {
        copy_.reserve(rows * columns);
        for (std::size_t i = 0; i < rows; ++i)
          for (std::size_t j = 0; j < columns; ++j) copy_.push_back(matrix.data()[i * outer + j * inner]);
        coordinates_ = copy_;
      }
    }
  }

  std::vector<double> copy_;
  std::span<const double> coordinates_;
  int dimension_ = D;
  void* container_ = nullptr;
  void (*consume_)(void*) = nullptr;
};

}  // namespace delone
