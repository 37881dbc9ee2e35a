// SPDX-License-Identifier: BSD-3-Clause
// Checks and hashes have one result for every number of threads; a violation is the one that one thread
// finds.
#include "base/random.hpp"

#include <delone/check.hpp>
#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace delone {
namespace {

constexpr unsigned numbers_of_threads[] = {2, 3, 8};

std::vector<double> random_rows(std::size_t count) {
  std::vector<double> rows(count);
  for (std::size_t i = 0; i < count; ++i)
    rows[i] = std::ldexp(static_cast<double>(random::mix(i) >> 11), -53);
  return rows;
}

/// Enough cells for several parts.
ComplexData in_plane() { return Delaunay<2>(random_rows(2 * 6000)).to_data(); }
ComplexData in_space() { return Delaunay<3>(random_rows(3 * 2000)).to_data(); }

void expect_one_report(const ComplexData& data, const CheckOptions& options = {}) {
  const CheckReport expected = check(data, options);
  for (const unsigned threads : numbers_of_threads) {
    const CheckReport report = check(data, options, {.threads = threads});
    EXPECT_EQ(report.ok, expected.ok);
    EXPECT_EQ(report.reached.number, expected.reached.number);
    EXPECT_EQ(report.violation, expected.violation) << threads;
    EXPECT_EQ(report.cells, expected.cells);
    EXPECT_EQ(report.points, expected.points);
    EXPECT_EQ(report.ties, expected.ties);
  }
}

TEST(CheckThreads, NoViolation) {
  expect_one_report(in_plane());
  expect_one_report(in_space(), {.canonical = true});
  std::vector<double> lattice;
  for (int x = 0; x < 80; ++x)
    for (int y = 0; y < 80; ++y) lattice.insert(lattice.end(), {double(x), double(y)});
  const ComplexData data = Delaunay<2>(lattice).to_data();
  expect_one_report(data);
  EXPECT_GT(check(data, {}, {.threads = 3}).ties, 0u);
}

TEST(CheckThreads, HiddenPoints) {
  std::vector<double> weights = random_rows(1500);
  for (double& w : weights) w = w > 0.9 ? 0.01 : 0;
  ComplexData data = Regular<2>(random_rows(2 * 1500), weights).to_data();
  expect_one_report(data);
  for (std::size_t row = 1000; row < 1500; ++row)
    if (data.vertex_of_point[row] < 0) data.weights[row] = 1;
  expect_one_report(data);
}

/// Every kind of fault, twice and more: the first one is reported.
TEST(CheckThreads, TheFirstViolation) {
  const ComplexData good = in_plane();
  const std::size_t last = good.num_cells() - 1;
  ComplexData data = good;
  for (const std::size_t c : {last, last / 2, last / 3}) data.cells[3 * c] = data.cells[3 * c + 1];
  expect_one_report(data);
  data = good;
  for (const std::size_t c : {last, last / 2, last / 3}) std::swap(data.cells[3 * c], data.cells[3 * c + 1]);
  expect_one_report(data);
  data = good;
  for (const std::size_t c : {last, last / 2, last / 3})
    for (std::size_t i = 0; i < 3; ++i) data.cells[3 * c + i] = data.cells[3 * (c / 4) + i];
  data.neighbors.clear();
  expect_one_report(data);
  data = good;
  data.points[2 * 5000] += 0.3;
  data.points[2 * 3000] += 0.3;
  expect_one_report(data);
  data = in_space();
  for (const std::size_t row : {1500, 900, 1900}) data.points[3 * row] += 1e-3;
  expect_one_report(data);
  data = good;  // falls apart: a copy elsewhere
  const auto n = static_cast<SignedIndex>(good.num_points());
  for (const double x : good.points) data.points.push_back(x + 10);
  for (const SignedIndex row : good.cells) data.cells.push_back(row + n);
  data.neighbors.clear();
  data.vertex_of_point.clear();
  expect_one_report(data);
}

TEST(CheckThreads, Hashes) {
  const Delaunay<3> t(random_rows(3 * 4000));
  const ComplexData data = t.to_data();
  for (const unsigned threads : numbers_of_threads) {
    EXPECT_EQ(t.hash({.threads = threads}), t.hash());
    EXPECT_EQ(canonical_hash(data, {.threads = threads}), t.hash());
  }
  ComplexData bad = data;
  for (const std::size_t c : {bad.num_cells() - 1, bad.num_cells() / 2}) bad.cells[4 * c] = -5;
  const auto message = [&](unsigned threads) {
    try {
      canonical_hash(bad, {.threads = threads});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const unsigned threads : numbers_of_threads) EXPECT_EQ(message(threads), message(1));
}

}  // namespace
}  // namespace delone
