// SPDX-License-Identifier: BSD-3-Clause
#include <delone/points.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <forward_list>
#include <list>
#include <ranges>
#include <valarray>
#include <vector>

namespace my {
struct Vertex {  // nothing but its coordinates
  double x, y, z;
};
struct Particle {  // also something else
  double mass;
  float position[3];
};
}  // namespace my

template <>
struct delone::PointTraits<my::Vertex> {
  static constexpr int dimension = 3;
  static constexpr bool is_contiguous = true;
};
template <>
struct delone::PointTraits<my::Particle> {
  static constexpr int dimension = 3;
  static std::array<double, 3> coordinates(const my::Particle& p) {
    return {p.position[0], p.position[1], p.position[2]};
  }
};

namespace delone {
namespace {

using testing::ElementsAre;

std::vector<double> to_vector(std::span<const double> numbers) { return {numbers.begin(), numbers.end()}; }

/// The coordinates that the argument refers to, and whether they are where `in_place` is.
template <int D, class Range>
void expect_in_place(Range&& range, const void* in_place, const std::vector<double>& expected) {
  const AnyPoints<D> points(range);
  EXPECT_EQ(points.coordinates().data(), in_place);
  EXPECT_EQ(to_vector(points.coordinates()), expected);
}
template <int D, class Range>
void expect_copied(Range&& range, const std::vector<double>& expected) {
  const AnyPoints<D> points(range);
  EXPECT_EQ(to_vector(points.coordinates()), expected);
}

template <class Function>
Error error_of(Function function) {
  try {
    function();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return Error(Errc::unsupported, "");
}

const std::vector<double> six{1, 2, 3, 4, 5, 6};

TEST(AnyPoints, ContiguousDoublesAreReadInPlace) {
  expect_in_place<3>(six, six.data(), six);
  expect_in_place<2>(std::span(six), six.data(), six);
  const std::vector<std::array<double, 3>> arrays{{1, 2, 3}, {4, 5, 6}};
  expect_in_place<3>(arrays, arrays.data(), six);
  expect_in_place<3>(std::span(arrays), arrays.data(), six);
  const double table[2][3] = {{1, 2, 3}, {4, 5, 6}};
  expect_in_place<3>(table, table, six);
  const std::array<std::array<double, 2>, 3> nested{{{1, 2}, {3, 4}, {5, 6}}};
  expect_in_place<2>(nested, nested.data(), six);
  const std::vector<my::Vertex> own{{1, 2, 3}, {4, 5, 6}};
  expect_in_place<3>(own, own.data(), six);
  const std::valarray<double> flat{1, 2, 3, 4, 5, 6};
  expect_in_place<3>(flat, &flat[0], six);
  expect_in_place<3>(PointsView(six, 3), six.data(), six);
}

TEST(AnyPoints, RowsOfTheirOwnAreCopied) {
  expect_copied<3>(std::vector<std::vector<double>>{{1, 2, 3}, {4, 5, 6}}, six);
  expect_copied<2>(std::vector<std::valarray<double>>{{1, 2}, {3, 4}, {5, 6}},
                   six);  // of the size of 2 doubles
  expect_copied<2>(std::vector<std::span<const double>>{std::span(six).first(2), std::span(six).last(2)},
                   {1, 2, 5, 6});
  expect_copied<3>(std::list<std::array<double, 3>>{{1, 2, 3}, {4, 5, 6}}, six);
  expect_copied<3>(std::forward_list<my::Vertex>{{1, 2, 3}, {4, 5, 6}}, six);
  expect_copied<3>(std::vector<std::array<float, 3>>{{1, 2, 3}, {4, 5, 6}}, six);
  expect_copied<6>(std::vector<std::array<float, 6>>{{1, 2, 3, 4, 5, 6}}, six);
  expect_copied<3>(std::vector<std::list<float>>{{1, 2, 3}, {4, 5, 6}}, six);
  expect_copied<3>(std::vector<my::Particle>{{9, {1, 2, 3}}, {9, {4, 5, 6}}}, six);
}

#if !defined(__clang__) || __clang_major__ >= 16  // older ones do not compile the views of libstdc++
TEST(AnyPoints, ViewsAreCopied) {
  const std::vector<std::array<double, 3>> arrays{{1, 2, 3}, {9, 9, 9}, {4, 5, 6}};
  expect_copied<3>(arrays | std::views::filter([](const auto& p) { return p[0] < 9; }), six);
  expect_copied<2>(std::views::iota(0, 3) | std::views::transform([](int i) {
                     return std::array<double, 2>{2. * i + 1, 2. * i + 2};
                   }),
                   six);
  expect_copied<2>(six | std::views::take(3) | std::views::transform([](double x) {
                     return std::vector<double>{x, -x};
                   }),
                   {1, -1, 2, -2, 3, -3});
}
#endif

TEST(AnyPoints, RowsOfOtherSizesAreNamed) {
  const std::vector<std::vector<double>> rows{{1, 2, 3}, {4, 5}};
  const Error error = error_of([&] { AnyPoints<3>{rows}; });
  EXPECT_EQ(error.code(), Errc::bad_dimension);
  EXPECT_THAT(error.rows(), ElementsAre(1));
  EXPECT_STREQ(error.what(), "row 1 has 2 entries, not 3");
  EXPECT_THAT(error_of([&] { AnyPoints<2>{rows}; }).rows(), ElementsAre(0));
  EXPECT_THAT(error_of([&] { AnyPoints<>{rows}; }).rows(), ElementsAre(1));
  EXPECT_EQ(error_of([&] { AnyPoints<2>{PointsView(six, 3)}; }).code(), Errc::bad_dimension);
  EXPECT_EQ(error_of([] { AnyPoints<>{std::vector<std::vector<double>>{{}}}; }).code(), Errc::bad_dimension);
}

TEST(AnyPoints, OfDynamicDimensionTellWhatTheirTypeTells) {
  EXPECT_EQ(AnyPoints<>(six).dimension(), 0);
  EXPECT_EQ(AnyPoints<>(std::vector<std::array<double, 3>>{{1, 2, 3}}).dimension(), 3);
  EXPECT_EQ(AnyPoints<>(std::vector<std::vector<double>>{{1, 2, 3}}).dimension(), 3);
  EXPECT_EQ(AnyPoints<>(PointsView(six, 2)).dimension(), 2);
  EXPECT_NO_THROW(AnyPoints<>(six).require_dimension(5));
  EXPECT_NO_THROW(AnyPoints<>(PointsView(six, 2)).require_dimension(2));
  EXPECT_EQ(error_of([] { AnyPoints<>(PointsView(six, 2)).require_dimension(3); }).code(),
            Errc::bad_dimension);
}

TEST(AnyPoints, OfNoPointsAreEmpty) {
  EXPECT_TRUE(AnyPoints<3>(std::vector<std::array<double, 3>>()).coordinates().empty());
  EXPECT_TRUE(AnyPoints<>(std::vector<std::vector<double>>()).coordinates().empty());
  EXPECT_TRUE(AnyPoints<3>(PointsView()).coordinates().empty());
}

TEST(AnyPoints, ContainersThatAreMovedInAreConsumedOnRequest) {
  std::vector<std::array<double, 3>> arrays{{1, 2, 3}, {4, 5, 6}};
  AnyPoints<3> points(std::move(arrays));
  EXPECT_EQ(points.coordinates().data(), arrays.data()->data());
  points.release();
  EXPECT_EQ(arrays.capacity(), 0u);
  EXPECT_TRUE(points.coordinates().empty());
  std::vector<double> kept = six;
  AnyPoints<3> seen(kept);
  seen.release();
  EXPECT_EQ(kept, six);
}

TEST(AnyPoint, TakesBracesSpansArraysAndRanges) {
  const auto coordinates = [](const AnyPoint<3>& point) { return to_vector(point.coordinates()); };
  const std::vector<double> expected{1, 2, 3};
  EXPECT_EQ(coordinates({1, 2.0, 3.0f}), expected);
  EXPECT_EQ(coordinates(std::array<double, 3>{1, 2, 3}), expected);
  EXPECT_EQ(coordinates(std::array<float, 3>{1, 2, 3}), expected);
  EXPECT_EQ(coordinates(std::span(six).first(3)), expected);
  EXPECT_EQ(coordinates(std::span(six).first<3>()), expected);
  EXPECT_EQ(coordinates(std::vector<double>{1, 2, 3}), expected);
  EXPECT_EQ(coordinates(std::list<float>{1, 2, 3}), expected);
  EXPECT_EQ(coordinates(std::valarray<double>{1, 2, 3}), expected);
  EXPECT_EQ(coordinates(my::Vertex{1, 2, 3}), expected);
  EXPECT_EQ(coordinates(my::Particle{9, {1, 2, 3}}), expected);
  const double array[3] = {1, 2, 3};
  EXPECT_EQ(coordinates(array), expected);
  EXPECT_EQ(AnyPoint<3>(array).coordinates().data(), array);
  const auto any = [](const AnyPoint<>& point) { return to_vector(point); };
  EXPECT_EQ(any({1, 2, 3}), expected);
  EXPECT_EQ(any(my::Particle{9, {1, 2, 3}}), expected);
  EXPECT_EQ(any(std::vector<double>{7}), std::vector<double>{7});
}

TEST(AnyPoint, OfAnotherSizeIsRefused) {
  EXPECT_EQ(error_of([] { AnyPoint<3>{std::vector<double>{1, 2}}; }).code(), Errc::bad_dimension);
  EXPECT_EQ(error_of([] { AnyPoint<3>{std::list<double>{1, 2, 3, 4}}; }).code(), Errc::bad_dimension);
}

}  // namespace
}  // namespace delone
