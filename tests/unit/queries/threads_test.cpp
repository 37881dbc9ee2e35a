// SPDX-License-Identifier: BSD-3-Clause
// Batches of queries have one result for every number of threads: byte for byte, errors included.
#include "base/random.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/interpolation.hpp>
#include <delone/natural_neighbors.hpp>
#include <delone/point_locator.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace delone::queries {
namespace {

std::vector<unsigned> numbers_of_threads() {
  if (test::scale() == test::Scale::small) return {3};
  return {2, 3, 8};
}

struct Input {
  std::string name;
  int dimension;
  std::vector<double> points, queries;
};

std::vector<double> random_rows(std::size_t count, std::uint64_t seed, double scale = 1) {
  std::vector<double> rows(count);
  for (std::size_t i = 0; i < count; ++i)
    rows[i] = scale * std::ldexp(static_cast<double>(random::mix(seed + i) >> 11), -53);
  return rows;
}

/// As many queries as make three parts. Those of lattices are halves of lattice points, most of them on faces
/// of several cells.
constexpr std::size_t num_queries = 4500;

std::vector<Input> inputs() {
  std::vector<Input> all;
  for (const int d : {2, 3, 5})
    all.push_back({"random " + std::to_string(d), d, random_rows(static_cast<std::size_t>(d) * 100, 1),
                   random_rows(static_cast<std::size_t>(d) * num_queries, 7, 1.1)});
  Input lattice{"lattice", 2, {}, {}}, flat{"flat", 3, {}, {}}, extreme{"extreme", 2, {}, {}};
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 12; ++y) {
      lattice.points.insert(lattice.points.end(), {double(x), double(y)});
      flat.points.insert(flat.points.end(), {double(x), double(y), double(x + y)});
      extreme.points.insert(extreme.points.end(), {std::ldexp(x, 990), std::ldexp(y, -990)});
    }
  for (std::size_t i = 0; i < num_queries; ++i) {
    const std::uint64_t bits = random::mix(i);
    const double x = double(bits % 25) / 2 - 0.5, y = double(bits / 32 % 25) / 2 - 0.5;
    lattice.queries.insert(lattice.queries.end(), {x, y});
    flat.queries.insert(flat.queries.end(), {x, y, i % 5 == 0 ? x : x + y});
    extreme.queries.insert(extreme.queries.end(), {std::ldexp(x, 990), std::ldexp(y, -990)});
  }
  for (Input* input : {&lattice, &flat, &extreme}) all.push_back(*input);
  return all;
}

/// All that a batch has answered, as bits.
using Bits = std::vector<std::uint64_t>;
Bits bits_of(const std::vector<double>& numbers) {
  Bits bits;
  for (const double x : numbers) bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}

void expect_one_result(const std::string& name, const std::function<Bits(unsigned threads)>& run) {
  const Bits expected = run(1);
  for (const unsigned threads : numbers_of_threads())
    EXPECT_TRUE(run(threads) == expected) << name << ", threads " << threads;
}

std::size_t size_of(const Input& input) {
  return input.queries.size() / static_cast<std::size_t>(input.dimension);
}

TEST(QueryThreads, LocationsDoNotDependOnThem) {
  for (const Input& input : inputs()) {
    const Delaunay<> t(input.points, input.dimension);
    const PointLocator locator(t);
    for (const double tolerance : {0.0, 0.02}) {
      if (tolerance > 0 && input.name != "lattice" && input.name != "random 2") continue;
      expect_one_result(input.name, [&](unsigned threads) {
        std::vector<Bits> answers(size_of(input));
        const auto note = [&](std::size_t query, const LocatedPoint& where) {
          Bits& answer = answers[query];
          EXPECT_TRUE(answer.empty());
          answer = {static_cast<std::uint64_t>(where.kind), index(where.cell),
                    std::bit_cast<std::uint64_t>(where.distance)};
          for (const double w : where.barycentric) answer.push_back(std::bit_cast<std::uint64_t>(w));
        };
        locator.locate(input.queries, {.tolerance = tolerance}, note, {.threads = threads});
        Bits all;
        for (const Bits& answer : answers) {
          EXPECT_FALSE(answer.empty());
          all.insert(all.end(), answer.begin(), answer.end());
        }
        return all;
      });
    }
  }
}

TEST(QueryThreads, NearestVerticesDoNotDependOnThem) {
  for (const Input& input : inputs()) {
    const Delaunay<> t(input.points, input.dimension);
    const PointLocator locator(t);
    expect_one_result(input.name, [&](unsigned threads) {
      Bits all(4 * size_of(input), 0);
      locator.nearest(input.queries, [&](std::size_t query, VertexId v) { all[4 * query] = index(v); },
                      {.threads = threads});
      if (input.name == "extreme") return all;
      locator.nearest(input.queries, 3,
                      [&](std::size_t query, std::span<const VertexId> found) {
                        for (std::size_t i = 0; i < found.size(); ++i)
                          all[4 * query + 1 + i] = index(found[i]);
                      },
                      {.threads = threads});
      return all;
    });
  }
}

TEST(QueryThreads, InterpolatedValuesDoNotDependOnThem) {
  for (const Input& input : inputs()) {
    const auto d = static_cast<std::size_t>(input.dimension);
    const Delaunay<> t(input.points, input.dimension);
    const LinearInterpolator f(t, random_rows(2 * input.points.size() / d, 3), 2);
    for (const Outside outside : {Outside::fill, Outside::nearest, Outside::project}) {
      if (outside == Outside::project && input.name != "lattice") continue;
      if (outside == Outside::nearest && d == 5) continue;
      expect_one_result(input.name, [&](unsigned threads) {
        std::vector<double> values(2 * size_of(input)), gradients(2 * input.queries.size());
        const EvaluateOptions options{.outside = outside};
        const Execution how{.threads = threads};
        f.evaluate(input.queries, values, options, how);
        f.gradients(input.queries, gradients, options, how);
        values.insert(values.end(), gradients.begin(), gradients.end());
        return bits_of(values);
      });
    }
  }
}

TEST(QueryThreads, NaturalNeighborsDoNotDependOnThem) {
  for (const Input& input : inputs()) {
    if (input.dimension == 5) continue;
    const auto d = static_cast<std::size_t>(input.dimension);
    const std::span<const double> queries =
        std::span(input.queries).first(d * test::scaled_size(input.name == "random 2" ? 400 : 200, 100));
    const Delaunay<> t(input.points, input.dimension);
    const NaturalNeighborInterpolator f(t, random_rows(input.points.size() / d, 3), 1, d == 2);
    expect_one_result(input.name, [&](unsigned threads) {
      std::vector<double> values(queries.size() / d), gradients(queries.size());
      f.evaluate(queries, values, {.outside = Outside::nearest}, {.threads = threads});
      f.gradients(queries, gradients, {}, {.threads = threads});
      values.insert(values.end(), gradients.begin(), gradients.end());
      return bits_of(values);
    });
  }
}

TEST(QueryThreads, CellsWithinARadiusDoNotDependOnThem) {
  const Input input = inputs()[0];
  const Delaunay<> t(input.points, input.dimension);
  const PointLocator locator(t);
  expect_one_result(input.name, [&](unsigned threads) {
    std::vector<Bits> cells(size_of(input));
    locator.cells_within(input.queries, 0.02,
                         [&](std::size_t query, CellId cell) {
                           cells[query].push_back(index(cell));
                           return true;
                         },
                         {.threads = threads});
    Bits all;
    for (const Bits& one : cells) {
      all.push_back(one.size());
      all.insert(all.end(), one.begin(), one.end());
    }
    return all;
  });
}

TEST(QueryThreads, ErrorsNameTheSameQuery) {
  Input input = inputs()[1];
  const Delaunay<> t(input.points, input.dimension);
  const LinearInterpolator f(t, random_rows(input.points.size() / 3, 3));
  std::vector<double> values(size_of(input));
  const auto failed = [&](Outside outside, unsigned threads) {
    try {
      f.evaluate(input.queries, values, {.outside = outside}, {.threads = threads});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const std::string expected = failed(Outside::error, 1);
  EXPECT_NE(expected, "none");
  for (const unsigned threads : numbers_of_threads()) EXPECT_EQ(failed(Outside::error, threads), expected);
  input.queries[3 * 5] = std::nan("");
  const std::string message = failed(Outside::fill, 3);
  EXPECT_NE(message.find("query 5"), std::string::npos) << message;
}

TEST(QueryThreads, ProgressComesFromTheCallingThreadAndCancels) {
  const Input input = inputs()[0];
  const Delaunay<> t(input.points, input.dimension);
  const NaturalNeighborInterpolator f(t, random_rows(input.points.size() / 2, 3));
  std::vector<double> values(size_of(input));
  const std::thread::id caller = std::this_thread::get_id();
  for (const unsigned threads : {1u, 2u, 8u}) {
    std::size_t calls = 0;
    double last = 0;
    f.evaluate(input.queries, values, {.outside = Outside::nearest},
               {.threads = threads, .progress = [&](double done) {
                  EXPECT_EQ(std::this_thread::get_id(), caller);
                  EXPECT_GE(done, last);
                  EXPECT_LE(done, 1);
                  last = done;
                  ++calls;
                  return true;
                }});
    EXPECT_GE(calls, 1u);
    try {
      f.evaluate(input.queries, values, {}, {.threads = threads, .progress = [](double) { return false; }});
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::cancelled);
    }
  }
}

TEST(QueryThreads, SeveralBatchesAtOnce) {
  const Input input = inputs()[0];
  const Delaunay<> t(input.points, input.dimension);
  const LinearInterpolator f(t, random_rows(input.points.size() / 2, 3));
  std::vector<double> expected(size_of(input));
  f.evaluate(input.queries, expected);
  std::vector<std::vector<double>> results(3, std::vector<double>(size_of(input)));
  std::vector<std::thread> callers;
  for (auto& result : results)
    callers.emplace_back([&] { f.evaluate(input.queries, result, {}, {.threads = 4}); });
  for (std::thread& caller : callers) caller.join();
  for (const auto& result : results) EXPECT_EQ(bits_of(result), bits_of(expected));
}

}  // namespace
}  // namespace delone::queries
