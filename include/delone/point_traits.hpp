// SPDX-License-Identifier: BSD-3-Clause
// Which types are points: PointTraits, and what follows from types alone.
#pragma once

#include <delone/types.hpp>

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <tuple>
#include <type_traits>

namespace delone {

/// Makes a type a point. Specialize it with `static constexpr int dimension` and one of
///   `static constexpr bool is_contiguous = true`, if an object is nothing but `dimension` doubles: ranges of
///   such points are read in place;
///   `static std::array<double, dimension> coordinates(const P&)`: ranges of such points are copied.
template <class P>
struct PointTraits {};

template <std::size_t N>
struct PointTraits<std::array<double, N>> {
  static constexpr int dimension = static_cast<int>(N);
  static constexpr bool is_contiguous = true;
};
template <std::size_t N>
struct PointTraits<double[N]> {
  static constexpr int dimension = static_cast<int>(N);
  static constexpr bool is_contiguous = true;
};

namespace detail {

template <class P>
concept HasTraits = requires {
  { PointTraits<P>::dimension } -> std::convertible_to<int>;
};
template <class P>
concept HasCoordinates = HasTraits<P> && requires(const P& point) {
  { PointTraits<P>::coordinates(point) } -> std::same_as<std::array<double, PointTraits<P>::dimension>>;
};
/// A fixed-size vector of doubles as Eigen has it, and no map of or expression in others: those have another
/// PlainObject.
template <class P>
concept FixedVector = requires {
  typename P::Scalar;
  requires std::same_as<typename P::Scalar, double>;
  requires std::same_as<typename P::PlainObject, P>;
  requires(bool(P::IsVectorAtCompileTime) && int(P::SizeAtCompileTime) > 0);
  requires sizeof(P) == static_cast<std::size_t>(P::SizeAtCompileTime) * sizeof(double);
};
/// A vector of any size as Eigen has it, whose coordinates lie somewhere in memory.
template <class P>
concept MappedVector = requires(const P& point) {
  requires bool(P::IsVectorAtCompileTime);
  { point.data() } -> std::convertible_to<const typename P::Scalar*>;
  { point.innerStride() } -> std::integral;
};
template <class T>
concept Coordinate = std::same_as<T, double> || std::same_as<T, float>;
template <class R>
concept ContiguousCoordinates = requires {
  requires std::ranges::contiguous_range<R>;
  requires std::ranges::sized_range<R>;
  requires std::same_as < std::ranges::range_value_t<R>,
  double > ;
};
template <class R>
concept CoordinateRange = std::ranges::input_range<R> && Coordinate<std::ranges::range_value_t<R>>;

/// The number of coordinates of a point type, as far as the type tells; else 0.
template <class P>
constexpr int dimension_of() {
  if constexpr (HasTraits<P>)
    return PointTraits<P>::dimension;
  else if constexpr (requires { requires(bool(P::IsVectorAtCompileTime) && int(P::SizeAtCompileTime) > 0); })
    return static_cast<int>(P::SizeAtCompileTime);
  else if constexpr (requires { std::tuple_size<P>::value; })
    return static_cast<int>(std::tuple_size<P>::value);
  else
    return static_cast<int>(std::extent_v<P>);
}

/// An object of the type is its coordinates, as contiguous doubles.
template <class P>
constexpr bool is_contiguous_point() {
  if constexpr (HasTraits<P>) {
    if constexpr (requires { requires PointTraits<P>::is_contiguous; }) {
      static_assert(std::is_standard_layout_v<P> && std::is_trivially_copyable_v<P> &&
                        sizeof(P) == static_cast<std::size_t>(PointTraits<P>::dimension) * sizeof(double),
                    "PointTraits<P>::is_contiguous needs a standard-layout, trivially copyable type of the "
                    "size of its `dimension` doubles");
      return true;
    }
    return false;
  } else {
    return FixedVector<P>;
  }
}

/// Whether the type is that of a point of D coordinates, as far as types tell.
template <int D, class P>
constexpr bool is_point() {
  if constexpr (dimension_of<P>() != 0 && D != dynamic && dimension_of<P>() != D)
    return false;
  else
    return is_contiguous_point<P>() || HasCoordinates<P> || (!HasTraits<P> && CoordinateRange<const P>) ||
           (!HasTraits<P> && CoordinateRange<P> && std::is_copy_constructible_v<P>);
}

/// The number as it is, subnormal or not: a conversion in code compiled with -ffast-math may make 0 of it.
inline double as_double(double x) { return x; }
inline double as_double(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  if ((bits & 0x7f800000) != 0) return static_cast<double>(x);
  const double size = static_cast<double>(bits & 0x007fffff) * 0x1p-149;  // normal, or 0
  return bits >> 31 != 0 ? -size : size;
}
template <std::integral T>
double as_double(T x) {
  return static_cast<double>(x);
}

/// Calls visit(coordinate) for each coordinate of a point in order.
template <class P, class Visit>
void for_each_coordinate(P&& point, Visit visit) {
  using Type = std::remove_cvref_t<P>;
  if constexpr (HasCoordinates<Type>) {
    for (const double coordinate : PointTraits<Type>::coordinates(point)) visit(coordinate);
  } else if constexpr (is_contiguous_point<Type>()) {
    const auto* const first = reinterpret_cast<const double*>(&point);
    for (std::size_t i = 0; i < sizeof(Type) / sizeof(double); ++i) visit(first[i]);
  } else {
    for (const auto coordinate : point) visit(as_double(coordinate));
  }
}

/// A matrix as Eigen has it, a point per row. Its vectors are ranges of coordinates instead.
template <class M>
concept Matrix = !MappedVector<M> && requires(const M& m) {
  { m.rows() } -> std::integral;
  { m.cols() } -> std::integral;
  { m.data() } -> std::convertible_to<const void*>;
  { M::IsRowMajor } -> std::convertible_to<bool>;
  typename M::Scalar;
};

template <class R>
concept MaybePoints =
    std::ranges::input_range<R> || Matrix<std::remove_cvref_t<R>> || MappedVector<std::remove_cvref_t<R>>;

/// A container that a caller gives away.
template <class R>
concept Expiring = !std::is_reference_v<R> && !std::is_const_v<R> && !std::ranges::view<R>;

template <class T>
constexpr bool always_false = false;

/// The dimension that a range of points has by its type; 0 if it does not tell.
template <class Range>
constexpr int dimension_of_range() {
  if constexpr (std::ranges::input_range<Range> && !MappedVector<std::remove_cvref_t<Range>>)
    return dimension_of<std::ranges::range_value_t<Range>>();
  else if constexpr (Matrix<std::remove_cvref_t<Range>>)
    return std::remove_cvref_t<Range>::ColsAtCompileTime > 0
               ? static_cast<int>(std::remove_cvref_t<Range>::ColsAtCompileTime)
               : 0;
  else
    return 0;
}

}  // namespace detail

}  // namespace delone
