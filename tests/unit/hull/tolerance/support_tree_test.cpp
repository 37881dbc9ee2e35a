// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/support_tree.hpp"

#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace delone::hull {
namespace {

struct Example {
  Example(std::vector<double> x, int d) : coordinates(std::move(x)), dimension(d) {
    for (std::size_t at = 0; at < coordinates.size(); at += static_cast<std::size_t>(d))
      points.push_back(coordinates.data() + at);
  }
  std::vector<double> coordinates;
  int dimension;
  std::vector<const double*> points;
};

std::vector<double> on_sphere(int d, std::size_t n, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<double> x(n * static_cast<std::size_t>(d));
  for (auto p = x.begin(); p != x.end(); p += d) {
    double square = 0;
    for (int j = 0; j < d; ++j) square += (p[j] = normal(random)) * p[j];
    for (int j = 0; j < d; ++j) p[j] /= std::sqrt(square);
  }
  return x;
}

double product(const double* q, const std::vector<double>& n, const double* w) {
  double sum = 0;
  for (std::size_t j = 0; j < n.size(); ++j) sum += n[j] * (q[j] - w[j]);
  return sum;
}

/// Whether n·(q − w) ≥ x, with integers.
bool is_at_least(const double* q, const std::vector<double>& n, const double* w, double x) {
  const int grid = -700;
  kernel::Integer sum(0);
  for (std::size_t j = 0; j < n.size(); ++j)
    sum += kernel::scaled_integer(n[j], grid) *
           (kernel::scaled_integer(q[j], grid) - kernel::scaled_integer(w[j], grid));
  return sum >= kernel::scaled_integer(x, grid) << -grid;
}

std::vector<Index> all_of(const Example& example) {
  std::vector<Index> all(example.points.size());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

void expect_answers(const Example& example, const SupportTree& tree, const std::vector<Index>& in,
                    std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  for (int round = 0; round < 20; ++round) {
    const double* q = example.points[random() % example.points.size()];
    std::vector<double> n(q, q + example.dimension);  // about normal to the sphere
    for (double& x : n) x += 0.1 * normal(random);
    const auto by_product = [&](Index a, Index b) {
      const double x = product(q, n, example.points[a]), y = product(q, n, example.points[b]);
      return x != y ? x < y : a < b;
    };
    const Index best = *std::min_element(in.begin(), in.end(), by_product);
    const auto found = tree.support(q, n, std::vector<Index>{in[random() % in.size()]});
    EXPECT_EQ(found.point, best);
    EXPECT_EQ(found.least, product(q, n, example.points[best]));
    EXPECT_LE(found.certain, found.least);
    EXPECT_GE(found.certain, found.least - 1e-13);
    for (const Index w : in) EXPECT_TRUE(is_at_least(q, n, example.points[w], found.certain));
  }
}

TEST(SupportTree, FindsTheFarthestOfThoseThatAreIn) {
  std::mt19937_64 random(3);
  for (const int d : {1, 2, 3, 4, 6}) {
    const Example example(on_sphere(d, 500, random), d);
    SupportTree tree(example.points, d, all_of(example));
    std::vector<Index> in;
    for (const std::size_t target : {1u, 9u, 200u, 450u, 60u, 3u}) {
      while (in.size() < target) {
        const auto p = static_cast<Index>(random() % 500);
        if (std::find(in.begin(), in.end(), p) != in.end()) continue;
        tree.insert(p);
        in.push_back(p);
      }
      while (in.size() > target) {
        std::swap(in[random() % in.size()], in.back());
        tree.erase(in.back());
        in.pop_back();
      }
      EXPECT_EQ(tree.size(), target);
      expect_answers(example, tree, in, random);
    }
  }
}

// Of equal products the first point is the answer, whatever the shape of the tree.
TEST(SupportTree, OfLatticesAndOfCoincidentPoints) {
  std::vector<double> x;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) x.insert(x.end(), {1.0 * i, 1.0 * j, 0.0});
  x.insert(x.end(), x.begin(), x.end());
  const Example example(x, 3);
  SupportTree tree(example.points, 3, all_of(example));
  for (Index p = 288; p-- > 1;) tree.insert(p);
  const std::vector<double> along{1, 0, 0}, across{0, 0, 1};
  EXPECT_EQ(tree.support(x.data(), along, {}).point, 132u);
  EXPECT_EQ(tree.support(x.data(), along, {}).least, -11.0);
  EXPECT_EQ(tree.support(x.data(), across, std::vector<Index>{77}).point, 1u);
  EXPECT_EQ(tree.support(x.data(), across, {}).certain, 0.0);
}

TEST(SupportTree, IsUncertainWhereProductsOverflow) {
  std::vector<double> x;
  for (int i = 0; i < 40; ++i) x.insert(x.end(), {i % 2 == 0 ? 1e308 : -1e308, i * 1e306});
  const Example example(x, 2);
  SupportTree tree(example.points, 2, all_of(example));
  for (Index p = 0; p < 40; ++p) tree.insert(p);
  EXPECT_FALSE(tree.support(x.data(), std::vector<double>{1e100, 1}, {}).certain > 0);
  EXPECT_FALSE(tree.support(x.data(), std::vector<double>{-1e100, 1}, {}).certain > 0);
}

}  // namespace
}  // namespace delone::hull
