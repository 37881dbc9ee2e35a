// SPDX-License-Identifier: BSD-3-Clause
// How levels are run, whatever they examine.
#include "check/levels.hpp"

#include "small_results.hpp"

#include <gtest/gtest.h>

#include <new>
#include <set>
#include <sstream>

namespace delone {
namespace {

using internal::Violation;

template <class Data>
class Levels : public ::testing::Test {
 public:
  static Data sound() {
    if constexpr (std::same_as<Data, ComplexData>) return test::small_triangulation();
    if constexpr (std::same_as<Data, HullData>) return test::small_hull();
    if constexpr (std::same_as<Data, IntersectionData>) return test::small_intersection();
    if constexpr (std::same_as<Data, VoronoiData>) return test::small_diagram();
  }
};
using Kinds = ::testing::Types<ComplexData, HullData, IntersectionData, VoronoiData>;
TYPED_TEST_SUITE(Levels, Kinds);

TYPED_TEST(Levels, AreNumberedFromOneAndNamed) {
  int number = 0;
  std::set<std::string_view> names;
  for (const CheckLevel& level : check_levels<TypeParam>()) {
    EXPECT_EQ(level.number, ++number);
    EXPECT_TRUE(names.insert(level.name).second) << level.name;
    EXPECT_FALSE(level.meaning.empty());
  }
  EXPECT_EQ(check_levels<TypeParam>().front().name, "storage");
}

TYPED_TEST(Levels, SoundDataReachTheLevelThatIsWanted) {
  const TypeParam data = this->sound();
  for (const CheckLevel& level : check_levels<TypeParam>()) {
    const CheckReport report = check(data, {.up_to = level.number});
    EXPECT_TRUE(report.ok) << report.violation;
    EXPECT_EQ(report.reached.number, level.number);
    EXPECT_EQ(report.reached.name, level.name);
  }
  const int last = check_levels<TypeParam>().back().number;
  EXPECT_EQ(check(data).reached.number, last);
  EXPECT_EQ(check(data, {.up_to = last + 1}).reached.number, last);
}

TYPED_TEST(Levels, ReportsAreWrittenInALine) {
  const auto written = [](const CheckReport& report) { return (std::ostringstream() << report).str(); };
  const TypeParam data = this->sound();
  EXPECT_EQ(written(check(data, {.up_to = 1})), "ok up to level 1, storage");
  CheckReport report = check(data);
  report.not_examined = "the tolerance";
  EXPECT_EQ(written(report), "ok up to level " + std::to_string(report.reached.number) + ", " +
                                 std::string(report.reached.name) + "; not examined: the tolerance");
  TypeParam damaged = data;
  damaged.dimension = -1;
  const CheckReport violation = check(damaged);
  EXPECT_EQ(written(violation), "violation at level 1, storage: " + violation.violation);
}

TYPED_TEST(Levels, WrongOptionsAreRefused) {
  const TypeParam data = this->sound();
  const auto code = [&](const CheckOptions& options) {
    try {
      static_cast<void>(check(data, options));
      return -1;
    } catch (const Error& error) {
      return static_cast<int>(error.code());
    }
  };
  constexpr int refused = static_cast<int>(Errc::invalid_argument);
  EXPECT_EQ(code({.up_to = 0}), refused);
  EXPECT_EQ(code({.up_to = -3}), refused);
  constexpr int else_refused = std::same_as<TypeParam, ComplexData> ? -1 : refused;
  EXPECT_EQ(code({.canonical = true}), else_refused);
  EXPECT_EQ(code({.oriented = false}), else_refused);
  EXPECT_EQ(code({.furthest_site = true}), else_refused);
}

TEST(RunLevels, StopsAtTheFirstViolation) {
  int steps = 0;
  const CheckReport report = internal::run_levels<IntersectionData>(
      {}, [&](CheckReport& r) { r.ties = 7, ++steps; },
      [&](CheckReport&) {
        ++steps;
        throw Violation{
            .message = "wrong", .cells = {1}, .points = {2, 3}, .vertices = {4}, .halfspaces = {5}};
      },
      [&](CheckReport&) { ++steps; });
  EXPECT_EQ(steps, 2);
  EXPECT_FALSE(report.ok);
  EXPECT_EQ(report.reached.name, "support");
  EXPECT_EQ(report.violation, "wrong");
  EXPECT_EQ(report.cells, std::vector<std::size_t>{1});
  EXPECT_EQ(report.points, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(report.vertices, std::vector<std::size_t>{4});
  EXPECT_EQ(report.halfspaces, std::vector<std::size_t>{5});
  EXPECT_EQ(report.ties, 7u) << "what passed levels found stays";
}

TEST(RunLevels, ExhaustedMemoryIsAnError) {
  const auto nothing = [](CheckReport&) {};
  try {
    internal::run_levels<IntersectionData>(
        {}, nothing, [](CheckReport&) { throw std::bad_alloc(); }, nothing);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::out_of_memory);
  }
}

}  // namespace
}  // namespace delone
