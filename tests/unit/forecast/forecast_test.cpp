// SPDX-License-Identifier: BSD-3-Clause
// Forecasts and estimates against triangulations of all named point sets, at small sizes. Numbers of cells do
// not depend on the machine; times are left to the benchmark.
#include <delone/forecast.hpp>

#include "forecast/lattice_points.hpp"
#include "forecast/memory_warning.hpp"
#include "forecast/model/tiles_share.hpp"
#include "forecast/sampling.hpp"
#include "forecast/speed.hpp"
#include "messages/readable.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace delone {
namespace {

/// What is promised, and some room for sets as small as these.
constexpr double promised = 1.5;

void expect_close(const ForecastQuantity& cells, double actual, const std::string& what) {
  if (actual < 200) return;  // a few cells are not worth a forecast
  EXPECT_LT(cells.expected, promised * actual) << what;
  EXPECT_GT(cells.expected, actual / promised) << what;
  EXPECT_LE(cells.low, cells.expected) << what;
  EXPECT_GE(cells.high, cells.expected) << what;
}

std::vector<std::size_t> sizes(std::string_view kind, int d) {
  if (kind == "moment" && d >= 3) return {d == 3 ? 400u : d <= 5 ? 60u : 30u};  // n^⌈d/2⌉ cells
  if (test::scale() == test::Scale::small) return {d <= 2 ? 700u : 100u};
  if (test::scale() == test::Scale::usual) return {d <= 3 ? 700u : d <= 5 ? 150u : 40u};
  if (d <= 3) return {700, 3000};
  if (d <= 5) return {150, 400};
  return {60};
}

TEST(Forecast, FewPointsAreOneFlatCell) {
  for (const std::size_t n : {1u, 3u, 4u}) {
    const Forecast found = forecast(4, n);
    EXPECT_EQ(found.affine_dimension, static_cast<int>(n) - 1);
    EXPECT_EQ(found.cells.expected, 1) << n;
  }
}

TEST(Forecast, AllKinds) {
  for (const PointSetKind& kind : point_set_kinds())
    for (int d = 1; d <= (test::scale() == test::Scale::small ? 2 : 7); ++d) {
      if (d == 1 && (kind.name == "flat" || kind.name == "cospherical" || kind.name == "ulp_sphere"))
        continue;
      for (const std::size_t n : sizes(kind.name, d)) {
        const std::string what = std::string(kind.name) + " " + std::to_string(d) + "D " + std::to_string(n);
        if (kind.name == "mixed_scales" && (d > 4 || n > 700)) continue;  // slow
        const std::vector<double> points = make_point_set(kind.name, d, n, 7);
        const Delaunay<> t(points, d);
        const auto cells = static_cast<double>(t.num_finite_cells());
        const Forecast forecasted = forecast(d, n, kind.name);
        expect_close(forecasted.cells, cells, "forecast " + what);
        const Forecast estimated = estimate(points, d, {.sample_seconds = 1e-9});
        expect_close(estimated.cells, cells, "estimate " + what);
        EXPECT_EQ(estimated.num_points, t.num_points());
        EXPECT_EQ(estimated.affine_dimension, t.affine_dimension()) << what;
      }
    }
}

bool contains(const ForecastQuantity& range, double x) { return range.low <= x && x <= range.high; }

TEST(Forecast, ManyDimensions) {
  if (test::scale() == test::Scale::small) GTEST_SKIP() << "some seconds in a slow build";
  for (const auto& [d, n] : {std::pair{9, 32}, {10, 28}, {11, 24}, {12, 24}, {15, 23}}) {
    const std::vector<double> points = make_point_set("uniform", d, static_cast<std::size_t>(n), 7);
    const auto cells = static_cast<double>(Delaunay<>(points, d).num_finite_cells());
    const Forecast forecasted = forecast(d, static_cast<std::size_t>(n));
    expect_close(forecasted.cells, cells, std::to_string(d) + "D");
    EXPECT_TRUE(contains(forecasted.cells, cells)) << d;
  }
  // These take minutes.
  for (const auto& [d, n, cells] : {std::tuple{9, 128, 1475837.0}, {10, 100, 2415858.0}, {12, 48, 940858.0}})
    EXPECT_TRUE(contains(forecast(d, static_cast<std::size_t>(n)).cells, cells)) << d;
}

/// The closed form, samples and what a limit says are one forecast.
TEST(Forecast, ForecastsAgree) {
  if (test::scale() == test::Scale::small) GTEST_SKIP() << "some seconds in a slow build";
  for (const auto& [d, n] : {std::pair{3, 200000}, {6, 20000}, {8, 2000}, {10, 1000}, {12, 1000}}) {
    const std::vector<double> points = make_point_set("uniform", d, static_cast<std::size_t>(n), 7);
    const Forecast closed = forecast(d, static_cast<std::size_t>(n)), sampled = estimate(points, d);
    for (const auto member : {&Forecast::cells, &Forecast::bytes}) {
      EXPECT_TRUE(contains(closed.*member, (sampled.*member).expected)) << d << "D";
      EXPECT_TRUE(contains(sampled.*member, (closed.*member).expected)) << d << "D";
    }
    EXPECT_LT(closed.bytes.high / closed.bytes.low, 6) << d << "D";
    EXPECT_LT(sampled.bytes.high / sampled.bytes.low, 40) << d << "D";
  }
}

TEST(Forecast, NoSampleIsWorkWithoutBounds) {
  // A thousand and three points in a thousand dimensions take hours.
  const std::vector<double> points = make_point_set("uniform", 1000, 1100, 7);
  const Forecast found = estimate(points, 1000);
  EXPECT_EQ(found.num_sampled, 0u);
  EXPECT_GE(found.seconds.high / found.seconds.low, 100);
  const auto code = [&] {
    try {
      estimate(points, 1000, {.progress = [](double) { return false; }});
    } catch (const Error& error) {
      return error.code();
    }
    return Errc::unsupported;
  };
  EXPECT_EQ(code(), Errc::cancelled);
}

TEST(Forecast, WithoutTimeForASampleTheRangeSaysSo) {
  cost_model::SampledSet set;
  set.dimension = 4;
  set.num_points = 100000;
  set.most = 100000;
  set.num_distinct = 100000;
  set.sample = [](std::size_t m) { return make_point_set("moment", 4, m, 7); };
  set.spent = 1000;
  const Forecast none = cost_model::forecast_by_samples(set, {});
  EXPECT_EQ(none.num_sampled, 0u);
  EXPECT_GE(none.cells.high / none.cells.low, 100);
  EXPECT_TRUE(contains(none.cells, forecast(4, 100000).cells.expected));
}

TEST(Forecast, WarnsOfMemoryThatIsNotThere) {
  const Forecast large = forecast(3, 1000000);
  EXPECT_EQ(cost_model::memory_warning(large, 1.01 * large.bytes.expected), "");
  EXPECT_EQ(cost_model::memory_warning(large, 0), "");  // not known
  const std::string text = cost_model::memory_warning(large, 1e8);
  EXPECT_NE(text.find("about " + messages::readable_bytes(large.bytes.expected)), std::string::npos) << text;
  EXPECT_NE(text.find("100 MB is available; tiles would fit"), std::string::npos) << text;
  EXPECT_EQ(cost_model::memory_warning(forecast(10, 1000), 1e9).find("tiles"), std::string::npos);
  EXPECT_EQ(memory_warning(make_point_set("uniform", 3, 1000), 3), "");
  EXPECT_NE(memory_warning(forecast(12, 100000)), "");  // no machine has that much
}

TEST(Forecast, ASmallSetIsNoReasonToAskForMemory) {
  const auto must_not_ask = [] {
    ADD_FAILURE();
    return 1.0;
  };
  EXPECT_FALSE(cost_model::may_exceed(3, 20000, must_not_ask));
  EXPECT_FALSE(cost_model::may_exceed(6, 200, must_not_ask));
  EXPECT_TRUE(cost_model::may_exceed(6, 100000, [] { return 1e9; }));
  EXPECT_FALSE(cost_model::may_exceed(6, 100000, [] { return 1e12; }));
  EXPECT_FALSE(cost_model::may_exceed(6, 100000, [] { return 0.0; }));
}

TEST(Forecast, TilesPayWherePointsOfOtherTilesAreFew) {
  EXPECT_TRUE(tiles_pay(3, 100000000, std::size_t{4} << 30));
  EXPECT_TRUE(tiles_pay(4, 1000000, std::size_t{1} << 30));
  EXPECT_FALSE(tiles_pay(3, 1000, 1000));  // no tile is so small
  EXPECT_FALSE(tiles_pay(6, 100000, std::size_t{1} << 30));
  EXPECT_FALSE(tiles_pay(10, 1000, std::size_t{16} << 30));
  EXPECT_FALSE(tiles_pay(10, 1000000, std::size_t{16} << 30));
  EXPECT_EQ(cost_model::inner_faces(3, 1e6), 6);
}

TEST(Forecast, SamplesThatAreAllPointsGiveTheNumbersThemselves) {
  for (const int d : {2, 3, 4}) {
    std::vector<double> points = make_point_set("duplicates", d, 60, 3);
    const Delaunay<> t(points, d);
    const Forecast all = estimate(points, d, {.sample_seconds = 10});
    EXPECT_EQ(all.cells.expected, static_cast<double>(t.num_finite_cells()));
    EXPECT_EQ(all.vertices.expected, static_cast<double>(t.num_vertices()));
  }
}

TEST(Forecast, EstimatesDependOnTheSetOfPointsAlone) {
  std::vector<double> points = make_point_set("gaussian", 3, 4000, 3), turned;
  for (std::size_t i = 4000; i-- > 0;) turned.insert(turned.end(), &points[3 * i], &points[3 * i] + 3);
  // So little time that only the first sample is built.
  const ForecastOptions options{.sample_seconds = 1e-9};
  EXPECT_EQ(estimate(points, 3, options).cells.expected, estimate(turned, 3, options).cells.expected);
}

TEST(Forecast, FewPointsAndBadArguments) {
  EXPECT_EQ(estimate(std::vector<double>{}, 3).cells.expected, 0);
  EXPECT_EQ(estimate(std::vector<double>{1, 2, 3}, 3).cells.expected, 1);
  EXPECT_EQ(forecast(3, 0).cells.expected, 0);
  EXPECT_GT(forecast(12, 1000).cells.expected, forecast(12, 100).cells.expected);
  const auto code = [](auto work) {
    try {
      work();
    } catch (const Error& error) {
      return error.code();
    }
    return Errc::unsupported;
  };
  EXPECT_EQ(code([] { forecast(0, 10); }), Errc::bad_dimension);
  EXPECT_EQ(code([] { forecast(3, 10, "unknown"); }), Errc::invalid_argument);
  const std::vector<double> points{1, 2, 3, std::numeric_limits<double>::quiet_NaN(), 2, 3};
  EXPECT_EQ(code([&] { estimate(points, 3); }), Errc::not_finite);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(code([&] { estimate(std::vector<double>{1}, 1, {.sample_seconds = bad}); }),
              Errc::invalid_argument);
  EXPECT_EQ(code([] {
              estimate(make_point_set("uniform", 3, 20000), 3, {.progress = [](double) { return false; }});
            }),
            Errc::cancelled);
}

TEST(Forecast, NumbersBeyondAllNumbersAreFinite) {
  for (const char* const kind : {"uniform", "grid", "flat"}) {
    const Forecast huge = forecast(1000, std::size_t{1} << 60, kind);
    for (const ForecastQuantity& quantity : {huge.vertices, huge.cells, huge.bytes, huge.seconds}) {
      EXPECT_TRUE(std::isfinite(quantity.high)) << kind;
      EXPECT_LE(quantity.low, quantity.expected) << kind;
      EXPECT_LE(quantity.expected, quantity.high) << kind;
    }
    EXPECT_EQ(messages::readable_bytes(huge.bytes.expected), "more than 1000 EB");
  }
}

TEST(Forecast, PatchesAreTheNearestPoints) {
  const std::vector<double> line{5, 0, 3, 1, 4, 2, 3};
  EXPECT_EQ(cost_model::patch_around(line, 1, 2, 4), (std::vector<double>{3, 3, 4, 2}));
  EXPECT_EQ(cost_model::patch_around(line, 1, 1, 9), (std::vector<double>{0, 1, 2, 3, 3, 4, 5}));
  EXPECT_TRUE(cost_model::patch_around(line, 1, 1, 0).empty());
}

TEST(Forecast, MoreThreadsTakeLessTime) {
  const Forecast one = forecast(3, 10000000), two = forecast(3, 10000000, "uniform", {.threads = 2});
  EXPECT_EQ(one.threads, 1u);
  EXPECT_LE(two.seconds.low, one.seconds.low);
}

TEST(Forecast, TheSpeedOfAMachineIsThatOfAComputer) {
  const double nanoseconds = cost_model::machine_nanoseconds();
  EXPECT_GT(nanoseconds, 5);
  EXPECT_LT(nanoseconds, 1e5);
}

}  // namespace
}  // namespace delone
