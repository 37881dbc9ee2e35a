// SPDX-License-Identifier: BSD-3-Clause
// A batch is inserted whole or not at all: cancelled, or out of memory at any allocation, everything is as it
// was before, and the batch can be inserted again.
#include "allocations.hpp"
#include "degenerate.hpp"
#include "halfspace_sets.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>
#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/halfspaces.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <memory>
#include <new>
#include <optional>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace {

using namespace delone;
using namespace delone::test;

/// A batch of d coordinates each, or of d + 1 entries: weights, or those of halfspaces.
using Rows = std::vector<double>;

/// Everything that can be seen of a triangulation.
struct Seen {
  CanonicalHash hash;
  std::size_t num_rows, num_points, num_duplicates, num_hidden;
  Index num_vertices;
  std::vector<SignedIndex> cells, neighbors, vertex_of_point, ids;
  bool operator==(const Seen&) const = default;
};

struct DelaunayProduct {
  static constexpr const char* name = "Delaunay";
  DelaunayProduct(int d, const Options& options) : object(d, options) {}
  static std::size_t width(int d) { return static_cast<std::size_t>(d); }
  void insert(const Rows& rows) { object.insert_range(rows); }
  std::size_t num_hidden() const { return 0; }
  Delaunay<> object;
};

struct RegularProduct {
  static constexpr const char* name = "regular";
  RegularProduct(int d, const Options& options) : object(d, options) {}
  static std::size_t width(int d) { return static_cast<std::size_t>(d) + 1; }
  void insert(const Rows& rows) {
    const auto d = static_cast<std::size_t>(object.dimension());
    Rows coordinates, weights;
    for (std::size_t i = 0; i < rows.size(); i += d + 1) {
      coordinates.insert(coordinates.end(), rows.begin() + static_cast<std::ptrdiff_t>(i),
                         rows.begin() + static_cast<std::ptrdiff_t>(i + d));
      weights.push_back(rows[i + d]);
    }
    object.insert_range(coordinates, weights);
  }
  std::size_t num_hidden() const { return object.num_hidden(); }
  Regular<> object;
};

struct FurthestSiteProduct {
  static constexpr const char* name = "furthest-site";
  FurthestSiteProduct(int d, const Options& options) : object(d, options) {}
  static std::size_t width(int d) { return static_cast<std::size_t>(d); }
  void insert(const Rows& rows) { object.insert_range(rows); }
  std::size_t num_hidden() const { return object.num_hidden(); }
  FurthestSite<> object;
};

template <class Product>
Seen seen(const Product& product) {
  const Triangulation& t = product.object;
  const ComplexData data = t.to_data();
  Seen result{t.hash(),         t.num_rows(), t.num_points(), t.num_duplicates(),   product.num_hidden(),
              t.num_vertices(), data.cells,   data.neighbors, data.vertex_of_point, {}};
  const Complex complex = t.complex();
  for (const CellId cell : complex.all_cells()) {
    result.ids.push_back(static_cast<SignedIndex>(index(cell)));
    for (int i = 0; i <= complex.affine_dimension(); ++i) {
      result.ids.push_back(static_cast<SignedIndex>(index(complex.vertex(cell, i))));
      result.ids.push_back(static_cast<SignedIndex>(index(complex.neighbor(cell, i))));
    }
  }
  return result;
}

struct HullProduct {
  static constexpr const char* name = "hull";
  HullProduct(int d, const Options& options) : object(d, options) {}
  static std::size_t width(int d) { return static_cast<std::size_t>(d); }
  void insert(const Rows& rows) { object.insert_range(rows); }
  ConvexHull<> object;
};
Seen seen(const HullProduct& product) {
  const HullData data = product.object.to_data();
  Seen result{product.object.hash(),
              product.object.num_points(),
              0,
              product.object.num_duplicates(),
              0,
              0,
              data.cells,
              data.neighbors,
              {},
              {}};
  for (std::size_t row = 0; row < product.object.num_points(); ++row)
    result.ids.push_back(static_cast<SignedIndex>(product.object.kind(row)));
  return result;
}

/// The origin is inside of all.
struct HalfspaceProduct {
  static constexpr const char* name = "halfspaces";
  HalfspaceProduct(int d, const Options& given)
      : object(Rows{}, d, Rows(static_cast<std::size_t>(d), 0.0), given) {}
  static std::size_t width(int d) { return static_cast<std::size_t>(d) + 1; }
  void insert(const Rows& rows) { object.insert_range(rows); }
  HalfspaceIntersection<> object;
};
Seen seen(const HalfspaceProduct& product) {
  const IntersectionData data = product.object.to_data();
  Seen result{{}, product.object.num_halfspaces(), product.object.num_cells(), 0, 0, 0, {}, {}, {}, {}};
  result.cells.assign(data.vertex_halfspaces.begin(), data.vertex_halfspaces.end());
  result.neighbors.assign(data.edges.begin(), data.edges.end());
  for (const HalfspaceKind kind : data.kinds) result.ids.push_back(static_cast<SignedIndex>(kind));
  return result;
}
/// What does not depend on the order in which cells were made.
CanonicalHash hash_of(const HalfspaceProduct&) { return {}; }
template <class Product>
CanonicalHash hash_of(const Product& product) {
  return product.object.hash();
}

/// Rows of a kind: 0 general, 1 of a coarse lattice with duplicates, 2 in a hyperplane.
Rows make_rows(std::size_t width, std::size_t n, int kind, bool halfspaces, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_int_distribution<int> coarse(-1, 1);
  Rows rows;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < width; ++j) {
      const bool is_last = j + 1 == width;
      const double x = kind == 1 ? coarse(random) : uniform(random);
      rows.push_back(halfspaces && is_last ? -1.0 : kind == 2 && j == 0 ? 0.0 : x);
    }
  return rows;
}

/// Inserts `second` after `first`, and fails on the way.
template <class Product>
void expect_all_or_nothing(int d, const Rows& first, const Rows& second, std::mt19937& random) {
  bool cancels = false;
  Options options;
  options.progress = [&](double) { return !cancels; };
  options.force_runtime_dimension = random() % 4 != 0;  // allocates at every turn
  Product whole(d, options);
  if (!first.empty()) whole.insert(first);
  allocations.count = 0;
  whole.insert(second);
  const std::size_t num_allocations = allocations.count;

  Product product(d, options);
  if (!first.empty()) product.insert(first);
  const Seen before = seen(product);
  for (std::size_t trial = 0; trial < scaled_count(12); ++trial) {
    bool has_failed = false;
    try {
      cancels = trial == 0;
      if (!cancels) {
        allocations = {0, 1 + random() % num_allocations, trial % 2 == 0};
      }
      product.insert(second);
    } catch (const Error&) {
      has_failed = true;
    } catch (const std::bad_alloc&) {  // without memory for a message
      has_failed = true;
    }
    allocations = {};
    cancels = false;
    if (!has_failed) {  // did with less
      ASSERT_EQ(hash_of(product), hash_of(whole));
      return;
    }
    ASSERT_TRUE(seen(product) == before) << "trial " << trial;
  }
  product.insert(second);
  ASSERT_EQ(hash_of(product), hash_of(whole));
  const Seen at_last = seen(product), right = seen(whole);
  ASSERT_EQ(at_last.num_rows, right.num_rows);
  ASSERT_EQ(at_last.num_points, right.num_points);
  ASSERT_EQ(at_last.num_duplicates, right.num_duplicates);
  ASSERT_EQ(at_last.num_hidden, right.num_hidden);
  ASSERT_EQ(at_last.cells.size(), right.cells.size());
}

template <class Product>
class AllOrNothing : public ::testing::Test {};
using Products =
    ::testing::Types<DelaunayProduct, RegularProduct, FurthestSiteProduct, HullProduct, HalfspaceProduct>;
struct Names {
  template <class Product>
  static std::string GetName(int) {
    return Product::name;
  }
};
TYPED_TEST_SUITE(AllOrNothing, Products, Names);

TYPED_TEST(AllOrNothing, IsWhatBecomesOfABatchThatFails) {
  constexpr bool halfspaces = std::is_same_v<TypeParam, HalfspaceProduct>;
  std::mt19937 random(7);
  for (int d = 1; d <= 5; ++d)
    for (int of_first = 0; of_first < 3; ++of_first)
      for (int of_second = 0; of_second < 3; ++of_second)
        for (const std::size_t n :
             {std::size_t{0}, std::size_t{1}, d < 4 ? std::size_t{40} : std::size_t{20}}) {
          SCOPED_TRACE(testing::Message() << d << "D, " << n << " rows of kind " << of_first
                                          << ", then some of kind " << of_second);
          const std::size_t width = TypeParam::width(d);
          const Rows first = make_rows(width, n, of_first, halfspaces, random),
                     second = make_rows(width, d < 4 ? 40 : 15, of_second, halfspaces, random);
          ASSERT_NO_FATAL_FAILURE(expect_all_or_nothing<TypeParam>(d, first, second, random));
        }
}

TEST(AllOrNothingAfterCompact, LeavesCellsInTheirPlaces) {
  const Rows first = make_point_set("uniform", 3, 200, 1), second = make_point_set("ball", 3, 200, 2);
  bool cancels = true;
  Options options;
  options.progress = [&](double) { return !cancels; };
  cancels = false;
  DelaunayProduct product(3, options);
  product.insert(first);
  product.object.compact();
  const Seen before = seen(product);
  cancels = true;
  EXPECT_THROW(product.insert(second), Error);
  EXPECT_TRUE(seen(product) == before);
  cancels = false;
  product.insert(second);
  DelaunayProduct whole(3, {});
  whole.insert(second);
  whole.insert(first);
  EXPECT_EQ(product.object.hash(), whole.object.hash());
}

/// The same in several threads, any of which may be the one that runs out of memory.
template <class Product>
void expect_all_or_nothing_in_threads(const Rows& first, const Rows& second) {
  SCOPED_TRACE(Product::name);
  Options options;
  options.threads = 3;
  std::size_t num_failures = 0;
  for (long allowed = 0;; allowed = allowed < 40 ? allowed + 1 : allowed + allowed / 6) {
    Product product(3, options);
    product.insert(first);
    const Seen before = seen(product);
    left_for_all_threads = allowed;
    try {
      product.insert(second);
      left_for_all_threads = -1;
      break;
    } catch (const Error& error) {
      left_for_all_threads = -1;
      EXPECT_EQ(error.code(), Errc::out_of_memory);
      ++num_failures;
      Seen after = seen(product);
      EXPECT_EQ(after.hash, before.hash);
      EXPECT_EQ(after.num_points, before.num_points);
      EXPECT_EQ(after.vertex_of_point, before.vertex_of_point);
      if constexpr (!std::is_same_v<Product, DelaunayProduct>) {
        EXPECT_EQ(after.cells, before.cells);
        EXPECT_EQ(after.neighbors, before.neighbors);
        EXPECT_EQ(after.ids, before.ids);
      }
    }
    product.insert(second);
    EXPECT_EQ(seen(product).num_rows, before.num_rows + second.size() / Product::width(3));
  }
  EXPECT_GT(num_failures, 20u);
}

TEST(AllOrNothing, OutOfMemoryInAnyThread) {
  expect_all_or_nothing_in_threads<DelaunayProduct>(make_point_set("uniform", 3, 400, 1),
                                                    make_point_set("uniform", 3, 1500, 2));
  for (const std::size_t first : {20u, 400u})
    expect_all_or_nothing_in_threads<HullProduct>(make_point_set("sphere", 3, first, 1),
                                                  make_point_set("sphere", 3, 700, 2));
  const auto tangent = [](std::size_t n, std::uint64_t seed) {
    const Rows normals = make_point_set("sphere", 3, n, seed);
    Rows rows;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      rows.push_back(normals[i]);
      if (i % 3 == 2) rows.push_back(-1);
    }
    return rows;
  };
  expect_all_or_nothing_in_threads<HalfspaceProduct>(tangent(200, 1), tangent(500, 2));
}

}  // namespace
