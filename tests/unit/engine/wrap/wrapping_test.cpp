// SPDX-License-Identifier: BSD-3-Clause
// Wrapping gives the cells that insertion gives, or none; the result accepts insertions; and no wrong set of
// cells passes the proof.
#include "engine/wrap/wrapping.hpp"

#include "base/random.hpp"
#include "compare.hpp"
#include "compiled/points_to_wrap.hpp"
#include "compiled/triangulation_engine.hpp"
#include "engine/wrap/proof.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "geometry/facet_search/facet_search.hpp"
#include "kernel/predicates.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace delone::engine {

using sites::VertexPoints;

namespace {

using Coordinates = std::vector<double>;

std::vector<int> all_axes(int k) {
  std::vector<int> axes(static_cast<std::size_t>(k));
  std::iota(axes.begin(), axes.end(), 0);
  return axes;
}

geometry::Frame frame_of(int k, const Coordinates& coordinates) {
  const auto d = static_cast<std::size_t>(k);
  Coordinates low(coordinates.begin(), coordinates.begin() + k), high = low;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    low[i % d] = std::min(low[i % d], coordinates[i]);
    high[i % d] = std::max(high[i % d], coordinates[i]);
  }
  return {low, high};
}

/// An engine for the first points, in a frame of all.
class GrowingHull {
 public:
  GrowingHull(int k, const Coordinates& all, std::size_t count)
      : all_(all), points_(k, kernel::RowForm::point), width_(static_cast<std::size_t>(k)) {
    while (points_.last_vertex() < count) append();
    engine_ = compiled::make_triangulation_engine(all_axes(k), points_, frame_of(k, all), {}, false);
  }

  bool wrap(unsigned threads = 1) {
    return engine_->wrap(threads, [](double) {});
  }
  /// Inserts the points so far one by one.
  void seed() {
    kernel::AffineHull span(points_.ambient);
    std::vector<Index> simplex, others;
    for (Index v = 1; v <= points_.last_vertex(); ++v)
      (span.add(points_.point(v)) ? simplex : others).push_back(v);
    engine_->seed(simplex);
    for (const Index v : others) engine_->insert(v, invalid_index);
  }
  /// Inserts all other points.
  void insert_others() {
    while (points_.last_vertex() * width_ < all_.size()) {
      append();
      engine_->insert(points_.last_vertex(), invalid_index);
    }
  }

  /// The vertices and neighbors of all cells, in their order.
  std::vector<Index> links() const {
    const Complex complex = complex_of(*engine_, points_.last_vertex(), {});
    std::vector<Index> result;
    for (const CellId cell : complex.all_cells())
      for (int i = 0; i <= complex.affine_dimension(); ++i) {
        result.push_back(index(complex.vertex(cell, i)));
        result.push_back(index(complex.neighbor(cell, i)));
      }
    return result;
  }

  /// The vertices of all cells. Expects that their neighbors are right, and finite ones oriented positively.
  test::Cells cells() const {
    const Complex complex = complex_of(*engine_, points_.last_vertex(), {});
    test::Cells result;
    for (const CellId cell : complex.all_cells()) {
      result.emplace_back();
      for (int i = 0; i <= complex.affine_dimension(); ++i) {
        result.back().push_back(static_cast<SignedIndex>(index(complex.vertex(cell, i))));
        const CellId neighbor = complex.neighbor(cell, i);
        EXPECT_TRUE(complex.is_cell(neighbor) &&
                    complex.neighbor(neighbor, complex.mirror_index(cell, i)) == cell);
      }
      if (!complex.is_infinite(cell)) {
        std::vector<const double*> corners;
        for (const SignedIndex v : result.back()) corners.push_back(points_.point(static_cast<Index>(v)));
        const std::vector<int> axes = all_axes(points_.ambient);
        EXPECT_EQ(kernel::orientation({points_.ambient, axes}, corners), Sign::positive);
      }
      std::sort(result.back().begin(), result.back().end());
    }
    std::sort(result.begin(), result.end());
    EXPECT_EQ(result.size(), complex.num_finite_cells() + complex.num_infinite_cells());
    EXPECT_EQ(std::count_if(result.begin(), result.end(), [](const auto& cell) { return cell[0] == 0; }),
              complex.num_infinite_cells());
    return result;
  }

 private:
  void append() {
    const double* x = all_.data() + points_.last_vertex() * width_;
    points_.coordinates.insert(points_.coordinates.end(), x, x + width_);
    points_.grid.include(points_.point(points_.last_vertex()));
  }

  const Coordinates& all_;
  VertexPoints points_;
  std::size_t width_;
  std::unique_ptr<compiled::TriangulationEngine> engine_;
};

/// Wraps all points but the last ones, and inserts those; where that fails, all are inserted. Returns whether
/// it did not fail.
bool expect_the_same_as_insertion(int k, const Coordinates& all, std::size_t later = 3) {
  const std::size_t n = all.size() / static_cast<std::size_t>(k), first = n > k + 1 + later ? n - later : n;
  SCOPED_TRACE(testing::Message() << first << " of " << n << " points in dimension " << k);
  GrowingHull wrapped(k, all, first), inserted(k, all, first);
  const bool is_wrapped = wrapped.wrap(1 + n % 3);
  if (!is_wrapped) wrapped.seed();
  inserted.seed();
  EXPECT_TRUE(test::same_cells(inserted.cells(), wrapped.cells()));
  wrapped.insert_others();
  inserted.insert_others();
  EXPECT_TRUE(test::same_cells(inserted.cells(), wrapped.cells()));
  return is_wrapped;
}

/// Whether those that are wrapped are.
bool is_of_full_dimension(int k, const Coordinates& points, std::size_t later = 3) {
  kernel::AffineHull span(k);
  for (std::size_t i = 0; i + later * static_cast<std::size_t>(k) < points.size();
       i += static_cast<std::size_t>(k))
    span.add(points.data() + i);
  return span.dimension() == k;
}

/// As many points as take about as long in any dimension.
std::vector<std::size_t> sizes(int k, std::size_t divisor = 1) {
  const auto d = static_cast<std::size_t>(k);
  static constexpr std::size_t largest[] = {0, 0, 400, 300, 120, 70, 45, 34, 26};
  return {d + 1, d + 2, d + 3, 2 * d + 3, std::max(test::scaled_count(largest[k] / divisor), 2 * d + 4)};
}

/// Only engines that are compiled for a dimension wrap.
constexpr int largest_dimension = std::min(8, internal::largest_compiled_dimension);

TEST(Wrap, GivesWhatInsertionGives) {
  for (int k = 2; k <= largest_dimension; ++k)
    for (const char* kind : {"uniform", "gaussian", "offset"})
      for (const std::size_t n : sizes(k)) {
        SCOPED_TRACE(kind);
        EXPECT_TRUE(expect_the_same_as_insertion(k, make_point_set(kind, k, n, n)));
      }
}

/// x_d = sin(π·x_1)
Coordinates make_sine(int k, std::size_t n) {
  const auto d = static_cast<std::size_t>(k);
  Coordinates points = make_point_set("uniform", k, n, 3);
  for (std::size_t i = 0; i < points.size(); i += d)
    points[i + d - 1] = std::sin(3.14159265358979 * points[i]);
  return points;
}

/// Each point nearer to 0 than the one before, all distances and directions.
Coordinates make_spiral(int k, std::size_t n, double ratio) {
  const auto d = static_cast<std::size_t>(k);
  Coordinates points = make_point_set("gaussian", k, n, 4);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] *= std::pow(ratio, static_cast<double>(i / d));
  return points;
}

/// Pairs of points that are very close to each other, of the size of all.
Coordinates make_pairs(int k, std::size_t n, double distance) {
  const auto d = static_cast<std::size_t>(k);
  Coordinates points = make_point_set("uniform", k, n, 5);
  random::Generator generator(n);
  for (std::size_t i = d; i < points.size(); ++i)
    if (i / d % 2 == 1) points[i] = points[i - d] + distance * (generator.uniform() - 0.5);
  return points;
}

TEST(Wrap, GivesWhatInsertionGivesOrNothingWherePointsAreFarFromUniform) {
  std::size_t wrapped = 0, all = 0;
  for (int k = 2; k <= largest_dimension; ++k) {
    const auto expect_the_same = [&](const std::string& name, const Coordinates& points) {
      SCOPED_TRACE(name);
      wrapped += expect_the_same_as_insertion(k, points) ? 1 : 0;
      ++all;
    };
    for (const std::size_t n : sizes(k, 2)) {
      for (const char* kind : {"sphere", "clusters", "plummer", "mixed_scales", "manifold", "moment"}) {
        const bool is_slow =
            k > 4 && (kind == std::string("mixed_scales") || (kind == std::string("moment") && n > 12));
        if (!is_slow)
          expect_the_same(kind, make_point_set(kind, k, n, 7));  // exact arithmetic of long numbers
      }
      expect_the_same("sine", make_sine(k, n));
      for (const double ratio : {0.9, 0.5, k > 4 ? 0.8 : 0.1})
        expect_the_same("spiral", make_spiral(k, n, ratio));
      for (const double distance : {1e-3, 1e-6, 1e-9, 1e-12})
        expect_the_same("pairs", make_pairs(k, n, distance));
    }
  }
  EXPECT_GT(wrapped, all / 3);
}

TEST(Wrap, GivesWhatInsertionGivesOrNothingWherePointsAreNotInGeneralPosition) {
  for (int k = 2; k <= largest_dimension; ++k) {
    const auto d = static_cast<std::size_t>(k);
    for (const char* kind :
         {"grid", "tilted_grid", "nudged_grid", "cube01", "cospherical", "ulp_sphere", "duplicates"})
      for (const std::size_t n : sizes(k, 2)) {
        SCOPED_TRACE(kind);
        const Coordinates points = make_point_set(kind, k, n, 7);
        if (is_of_full_dimension(k, points)) expect_the_same_as_insertion(k, points);  // lattices are cut off
      }
    for (const std::size_t n : sizes(k, 2)) {
      Coordinates points = make_point_set("uniform", k, n, 8);
      std::copy_n(points.begin() + (k - 1) * k, k, points.end() - k);  // equal to an earlier one
      if (n > d + 1) {
        EXPECT_FALSE(expect_the_same_as_insertion(k, points, 0));
      }
      points = make_point_set("uniform", k, n, 9);
      for (std::size_t i = 0; i < n; i += 2)
        points[i * d + d - 1] = 0;  // on the hull, if many then more than a facet has
      expect_the_same_as_insertion(k, points, 0);
    }
  }
}

TEST(Wrap, DoesNotDecideTies) {
  for (int k = 2; k <= largest_dimension; ++k) {
    SCOPED_TRACE(testing::Message() << "dimension " << k);
    if (k <= 5) {
      EXPECT_FALSE(expect_the_same_as_insertion(k, make_point_set("cube01", k, std::size_t{1} << k), 0));
    }
    EXPECT_FALSE(expect_the_same_as_insertion(
        k, make_point_set("cospherical", k, 4 * static_cast<std::size_t>(k)), 0));
  }
}

TEST(Wrap, GivesTheSameCellsInTheSameOrderInThreads) {
  for (int k = 2; k <= largest_dimension; ++k) {
    SCOPED_TRACE(k);
    static constexpr std::size_t usual[] = {0, 0, 3000, 800, 300, 120, 60, 40, 30};
    const std::size_t n = std::max(test::scaled_count(usual[k]), static_cast<std::size_t>(k) + 4);
    const Coordinates points = make_point_set(k % 2 == 0 ? "uniform" : "clusters", k, n, 8);
    GrowingHull reference(k, points, n);
    ASSERT_TRUE(reference.wrap());
    for (const unsigned threads : {2u, 3u, 8u}) {
      GrowingHull wrapped(k, points, n);
      ASSERT_TRUE(wrapped.wrap(threads));
      EXPECT_EQ(wrapped.links(), reference.links());
    }
  }
}

TEST(Wrap, BuildsBatchesOfFewPointsInSevenDimensions) {
  if (largest_dimension < 7) GTEST_SKIP() << "no engine for it is compiled";
  constexpr std::size_t d = 7, n = 210;
  Coordinates points = make_point_set("uniform", d, n, 3);
  points.insert(points.end(), points.begin(), points.begin() + 5 * d);  // duplicates
  Options inserting;
  inserting.force_runtime_dimension = true;
  const Delaunay<> wrapped(points, d), inserted(points, d, inserting);
  EXPECT_EQ(wrapped.hash(), inserted.hash());
  EXPECT_EQ(wrapped.num_duplicates(), 5u);
  for (std::size_t row = 0; row < 5; ++row) EXPECT_EQ(wrapped.vertex_at(n + row), wrapped.vertex_at(row));
  const Complex complex = wrapped.complex();
  EXPECT_EQ(wrapped.statistics().created_cells, complex.num_finite_cells() + complex.num_infinite_cells());
  EXPECT_GT(inserted.statistics().created_cells, 2 * wrapped.statistics().created_cells);
  EXPECT_EQ(wrapped.num_vertices(), n);

  // Cancelled on the way, all is as if nothing had been inserted.
  for (const unsigned threads : {1u, 2u}) {
    Options cancelling;
    cancelling.threads = threads;
    int calls_left = static_cast<int>(threads);
    cancelling.progress = [&](double) { return --calls_left > 0; };
    Delaunay<> cancelled(d, cancelling);
    EXPECT_THROW(cancelled.insert_range(points), Error);
    EXPECT_EQ(cancelled.num_vertices(), 0u);
    EXPECT_EQ(cancelled.affine_dimension(), -1);
  }
}

TEST(Wrap, LeavesWhatQueriesNeedToTheFirst) {
  if (largest_dimension < 7) GTEST_SKIP() << "no engine for it is compiled";
  constexpr std::size_t d = 7;
  const Coordinates points = make_point_set("uniform", d, 210, 3),
                    queries = make_point_set("uniform", d, 40, 4);
  Options inserting;
  inserting.force_runtime_dimension = true;
  Delaunay<> wrapped(points, d);
  const Delaunay<> inserted(points, d, inserting);
  const auto rows_of = [](const Delaunay<>& t, const CellId cell) {
    std::vector<std::size_t> rows;
    for (const VertexId v : t.vertices(cell))
      rows.push_back(v == infinite_vertex ? ~std::size_t{0} : t.row_of(v));
    std::sort(rows.begin(), rows.end());
    return rows;
  };
  const auto answers_of = [&](const Delaunay<>& t) {
    std::vector<std::vector<std::size_t>> answers;
    for (std::size_t i = 0; i < queries.size(); i += d) {
      const std::span query(queries.data() + i, d);
      const Location found = t.locate(query);
      answers.push_back({static_cast<std::size_t>(found.kind)});
      if (found.kind == Location::Kind::in_cell) answers.push_back(rows_of(t, found.cell));
      const std::size_t before = answers.size();
      for (const CellId cell : t.conflict_zone(query)) answers.push_back(rows_of(t, cell));
      std::sort(answers.begin() + static_cast<std::ptrdiff_t>(before), answers.end());
    }
    return answers;
  };
  const auto right = answers_of(inserted);
  const std::size_t bytes = wrapped.statistics().cell_bytes;
  std::vector<std::vector<std::vector<std::size_t>>> answers(4);
  std::vector<std::thread> threads;
  for (auto& of_thread : answers) threads.emplace_back([&] { of_thread = answers_of(wrapped); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& of_thread : answers) EXPECT_EQ(of_thread, right);
  EXPECT_GT(wrapped.statistics().cell_bytes, bytes);

  // A point outside the box of all others changes what would have been computed.
  Delaunay<> grown(points, d);
  grown.insert(Coordinates(d, 3.0));
  Coordinates more = points;
  more.insert(more.end(), d, 3.0);
  EXPECT_EQ(grown.hash(), Delaunay<>(more, d, inserting).hash());

  Delaunay<> compacted(points, d);
  compacted.compact();
  EXPECT_EQ(answers_of(compacted), right);
}

/// Cells for which proofs are sought.
template <int K>
struct Proposed {
  explicit Proposed(const Coordinates& coordinates)
      : points(K, kernel::RowForm::point),
        memory(K),
        some_cells(K),
        cells(memory),
        geometry(some_cells, all_axes(K), K, points.coordinates, points.grid, frame_of(K, coordinates)),
        num_vertices(static_cast<Index>(coordinates.size() / K)) {
    points.coordinates.insert(points.coordinates.end(), coordinates.begin(), coordinates.end());
    for (Index v = 1; v <= num_vertices; ++v) points.grid.include(geometry.point(v));
    geometry.keep_rows(num_vertices);
    some_cells.reserve(Proof<K, geometry::DelaunayGeometry<K>>::batch_size);
  }

  /// Proposes a triangulation of the first vertices.
  void wrap(Index vertices) {
    cells.clear();
    ForThread<geometry::FacetSearch> search[] = {{geometry::FacetSearch(
        K, geometry.kept_rows(), vertices, [this](const Index* cell, int slot, std::span<const Index> among) {
          return geometry.first_beyond(cell, slot, among, points.grid);
        })}};
    ASSERT_TRUE((Wrapping<K, geometry::FacetSearch>(cells, search, vertices).run([](double) {})));
  }

  test::Cells all() const {
    test::Cells result;
    for (Index cell = 0; cell < cells.num_slots(); ++cell)
      result.emplace_back(cells.wide_vertices(cell), cells.wide_vertices(cell) + K + 1);
    return result;
  }

  /// Proposes cells, linked where they have common facets. Returns whether every facet has two cells.
  bool propose(const test::Cells& proposal) {
    cells.clear();
    cells.reserve(proposal.size());
    std::map<std::vector<SignedIndex>, std::pair<Index, int>> open;
    for (const auto& vertices : proposal) {
      const Index cell = cells.allocate();
      for (int i = 0; i <= K; ++i) {
        cells.wide_vertices(cell)[i] = static_cast<Index>(vertices[static_cast<std::size_t>(i)]);
        auto facet = vertices;
        facet.erase(facet.begin() + i);
        const auto [found, is_new] = open.try_emplace(facet, cell, i);
        cells.neighbors(cell)[i] = invalid_index;
        if (is_new) continue;
        cells.neighbors(cell)[i] = found->second.first;
        cells.neighbors(found->second.first)[found->second.second] = cell;
        open.erase(found);
      }
    }
    return open.empty();
  }

  /// That of the cells, and that a point is on the inner side of the hull.
  bool is_proved(const Coordinates& point, unsigned threads = 1) {
    using Geometry = geometry::DelaunayGeometry<K>;
    std::deque<CellMemory<K>> memories;
    std::deque<Geometry> of_threads;
    std::vector<Geometry*> geometries{&geometry};
    while (geometries.size() < threads) {
      memories.emplace_back(K).reserve(Proof<K, Geometry>::batch_size);
      geometries.push_back(&of_threads.emplace_back(memories.back(), all_axes(K), K, points.coordinates,
                                                    points.grid, geometry.frame()));
      geometries.back()->keep_rows(num_vertices);
    }
    std::vector<typename geometry::DelaunayGeometry<K>::Query> queries;
    for (Index v = 0; v <= num_vertices; ++v) queries.push_back(geometry.make_query(geometry.point(v)));
    const kernel::Grid grid = points.grid_with(point.data());
    StageCounts counts;
    return Proof<K, Geometry, 64>(cells, geometries, queries, counts)
        .run(geometry.make_query(point.data(), grid), [](double) {});
  }
  /// The same with a point that is.
  bool is_proved(unsigned threads = 1) {
    Coordinates mean(K);
    for (Index v = 1; v <= num_vertices; ++v)
      for (std::size_t j = 0; j < K; ++j) mean[j] += points.point(v)[j] / num_vertices;
    return is_proved(mean, threads);
  }

  VertexPoints points;
  CellMemory<K> memory, some_cells;
  CellStore<K> cells;
  geometry::DelaunayGeometry<K> geometry;
  Index num_vertices;
};

template <int K>
void expect_no_proof_with_an_exchanged_vertex() {
  SCOPED_TRACE(testing::Message() << "dimension " << K);
  Proposed<K> proposed(make_point_set("uniform", K, K + 6, 1));
  ASSERT_NO_FATAL_FAILURE(proposed.wrap(proposed.num_vertices));
  const test::Cells right = proposed.all();
  ASSERT_TRUE(proposed.propose(right) && proposed.is_proved());
  for (Index cell = 0; cell < right.size(); ++cell)
    for (std::size_t slot = 0; slot <= K; ++slot)
      for (Index other = 0; other <= proposed.num_vertices; ++other) {
        proposed.propose(right);
        Index* vertices = proposed.cells.wide_vertices(cell);
        Index* neighbors = proposed.cells.neighbors(cell);
        if (std::find(vertices, vertices + K + 1, other) != vertices + K + 1) continue;
        vertices[slot] = other;
        for (std::size_t i = 1; i <= K; ++i)  // in order again
          for (std::size_t j = i; j > 0 && vertices[j] < vertices[j - 1]; --j) {
            std::swap(vertices[j], vertices[j - 1]);
            std::swap(neighbors[j], neighbors[j - 1]);
          }
        ASSERT_FALSE(proposed.is_proved()) << "cell " << cell << ", slot " << slot << ", vertex " << other;
      }
}

TEST(Proof, NoticesAnExchangedVertex) {
  expect_no_proof_with_an_exchanged_vertex<2>();
  expect_no_proof_with_an_exchanged_vertex<3>();
  expect_no_proof_with_an_exchanged_vertex<4>();
}

template <int K>
void expect_no_proof_with_wrong_links() {
  SCOPED_TRACE(testing::Message() << "dimension " << K);
  Proposed<K> proposed(make_point_set("uniform", K, K + 4, 2));
  ASSERT_NO_FATAL_FAILURE(proposed.wrap(proposed.num_vertices));
  const test::Cells right = proposed.all();
  for (Index a = 0; a < right.size(); ++a)
    for (int i = 0; i <= K; ++i)
      for (Index c = 0; c < right.size(); ++c)
        for (int j = 0; j <= K; ++j)
          for (const bool crosswise : {true, false}) {
            ASSERT_TRUE(proposed.propose(right));
            auto& cells = proposed.cells;
            const Index b = cells.neighbors(a)[i], d = cells.neighbors(c)[j];
            if (b == d || (a == d && b == c)) continue;
            const int of_b = cells.slot_of_neighbor(b, a), of_d = cells.slot_of_neighbor(d, c);
            cells.neighbors(a)[i] = d;
            if (crosswise) {
              cells.neighbors(d)[of_d] = a;
              cells.neighbors(c)[j] = b;
              cells.neighbors(b)[of_b] = c;
            }
            ASSERT_FALSE(proposed.is_proved())
                << (crosswise ? "each of them has" : "the first has") << " the neighbor of the other: " << a
                << " in slot " << i << ", " << c << " in slot " << j;
          }
  // One link that is missing.
  for (Index a = 0; a < right.size(); ++a)
    for (int i = 0; i <= K; ++i)
      for (const Index wrong : {invalid_index, a}) {
        ASSERT_TRUE(proposed.propose(right));
        proposed.cells.neighbors(a)[i] = wrong;
        ASSERT_FALSE(proposed.is_proved());
      }
}

TEST(Proof, NoticesWrongLinks) {
  expect_no_proof_with_wrong_links<2>();
  expect_no_proof_with_wrong_links<3>();
}

// All triangulations that a flip makes of the Delaunay triangulation, and those that are none.
TEST(Proof, NoticesAFlip) {
  Proposed<2> proposed(make_point_set("uniform", 2, std::max<std::size_t>(test::scaled_count(100), 20), 3));
  ASSERT_NO_FATAL_FAILURE(proposed.wrap(proposed.num_vertices));
  const test::Cells right = proposed.all();
  ASSERT_TRUE(proposed.propose(right));
  std::vector<std::pair<Index, Index>> pairs;
  for (Index cell = 0; cell < right.size(); ++cell)
    for (int i = 0; i <= 2; ++i)
      if (proposed.cells.neighbors(cell)[i] > cell)
        pairs.emplace_back(cell, proposed.cells.neighbors(cell)[i]);
  for (const auto& [a, b] : pairs) {
    test::Cells wrong = right;
    std::vector<SignedIndex> common, different;
    std::set_intersection(right[a].begin(), right[a].end(), right[b].begin(), right[b].end(),
                          std::back_inserter(common));
    std::set_symmetric_difference(right[a].begin(), right[a].end(), right[b].begin(), right[b].end(),
                                  std::back_inserter(different));
    for (const std::size_t i : {0u, 1u}) {
      auto& cell = wrong[i == 0 ? a : b];
      cell = different;
      cell.push_back(common[i]);
      std::sort(cell.begin(), cell.end());
    }
    if (!proposed.propose(wrong)) continue;  // the other diagonal was there
    ASSERT_FALSE(proposed.is_proved()) << "flipped " << test::to_text(common);
  }
}

template <int K>
void expect_no_proof_of_what_is_right_elsewhere() {
  SCOPED_TRACE(testing::Message() << "dimension " << K);
  std::size_t different = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Coordinates here = make_point_set("uniform", K, K + 10, seed);
    Coordinates there = here;
    random::Generator generator(seed);
    for (double& c : there) c *= 1 + 0.2 * (generator.uniform() - 0.5);
    Proposed<K> a(here), b(there);
    ASSERT_NO_FATAL_FAILURE(a.wrap(a.num_vertices));
    ASSERT_NO_FATAL_FAILURE(b.wrap(b.num_vertices));
    test::Cells of_a = a.all(), of_b = b.all();
    std::sort(of_a.begin(), of_a.end());
    std::sort(of_b.begin(), of_b.end());
    ASSERT_TRUE(b.propose(of_a));
    EXPECT_EQ(b.is_proved(), of_a == of_b);
    different += of_a == of_b ? 0 : 1;
  }
  EXPECT_GT(different, 0u);
}

TEST(Proof, NoticesThatPointsAreElsewhere) {
  expect_no_proof_of_what_is_right_elsewhere<2>();
  expect_no_proof_of_what_is_right_elsewhere<3>();
  expect_no_proof_of_what_is_right_elsewhere<5>();
}

// In many parts, so that orientations of neighbors are often compared at the end.
TEST(Proof, IsTheSameInThreads) {
  const std::size_t n = std::max<std::size_t>(test::scaled_count(200), 30);
  const Coordinates here = make_point_set("uniform", 3, n, 6);
  Coordinates there = here;  // flatter: spheres are others, orientations are not
  for (std::size_t i = 0; i < there.size(); i += 3) there[i] *= 0.9;
  Proposed<3> a(here), b(there);
  ASSERT_NO_FATAL_FAILURE(a.wrap(a.num_vertices));
  const test::Cells right = a.all();
  ASSERT_TRUE(a.propose(right) && a.is_proved());
  const test::Cells oriented = a.all();
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    SCOPED_TRACE(threads);
    ASSERT_TRUE(a.propose(right));
    EXPECT_TRUE(a.is_proved(threads));
    EXPECT_EQ(a.all(), oriented);
    ASSERT_TRUE(b.propose(right));
    EXPECT_FALSE(b.is_proved(threads));
    // A vertex that is on the other side of some of the facets opposite it.
    for (Index v = 1; v <= 5; ++v) {
      Coordinates moved = here;
      for (std::size_t j = 0; j < 3; ++j) moved[3 * (v - 1) + j] = 1 - moved[3 * (v - 1) + j];
      Proposed<3> folded(moved);
      ASSERT_TRUE(folded.propose(right));
      EXPECT_FALSE(folded.is_proved(threads));
    }
  }
}

TEST(Proof, NoticesAVertexWithoutCells) {
  Proposed<3> proposed(make_point_set("uniform", 3, 30, 4));
  ASSERT_NO_FATAL_FAILURE(proposed.wrap(29));
  EXPECT_FALSE(proposed.is_proved());
  ASSERT_NO_FATAL_FAILURE(proposed.wrap(30));
  EXPECT_TRUE(proposed.is_proved());
}

TEST(Proof, NoticesTies) {
  const test::Cells square{{1, 2, 3}, {2, 3, 4}, {0, 1, 2}, {0, 1, 3}, {0, 2, 4}, {0, 3, 4}};
  Proposed<2> tied({0, 0, 1, 0, 0, 1, 1, 1}), inside({0, 0, 1, 0, 0, 1, 1, 1 - 0x1p-52}),
      outside({0, 0, 1, 0, 0, 1, 1, 1 + 0x1p-52});
  for (Proposed<2>* proposed : {&tied, &inside, &outside}) {
    ASSERT_TRUE(proposed->propose(square));
    EXPECT_EQ(proposed->is_proved(), proposed == &outside);
  }
  // 4 is on the edge of 1 and 2, in the triangulation and beside it.
  Proposed<2> collinear({0, 0, 2, 0, 1, 3, 1, 0});
  for (const test::Cells& cells :
       {test::Cells{{1, 3, 4}, {2, 3, 4}, {0, 1, 4}, {0, 2, 4}, {0, 1, 3}, {0, 2, 3}},
        test::Cells{{1, 2, 3}, {1, 2, 4}, {0, 1, 4}, {0, 2, 4}, {0, 1, 3}, {0, 2, 3}}}) {
    ASSERT_TRUE(collinear.propose(cells));
    EXPECT_FALSE(collinear.is_proved());
  }
}

// Ten triangles around one vertex that turn about it twice: everything is right but their number.
TEST(PointInOneCell, NoticesTwoTurnsAboutAVertex) {
  const auto around = [](int turns) {
    Coordinates points{0, 0};
    for (int i = 0; i < 5 * turns; ++i) {
      const double angle = 2 * 3.14159265358979 * (i / 5.0 + i / 1000.0), radius = 1 + i / 100.0;
      points.insert(points.end(), {radius * std::cos(angle), radius * std::sin(angle)});
    }
    return points;
  };
  const auto fan = [](SignedIndex size) {
    test::Cells cells;
    for (SignedIndex i = 0; i < size; ++i) {
      const SignedIndex a = i + 2, b = (i + 1) % size + 2;
      cells.push_back({1, std::min(a, b), std::max(a, b)});
      cells.push_back({0, std::min(a, b), std::max(a, b)});
    }
    return cells;
  };
  for (const int turns : {1, 2}) {
    Proposed<2> proposed(around(turns));
    ASSERT_TRUE(proposed.propose(fan(5 * turns)));
    ASSERT_TRUE(proposed.is_proved());
    ASSERT_TRUE(proposed.propose(fan(5 * turns)));
    const auto point = compiled::find_point_in_one_cell(proposed.cells, proposed.geometry, proposed.points);
    EXPECT_EQ(point && proposed.is_proved(*point), turns == 1);
  }
}

}  // namespace
}  // namespace delone::engine
