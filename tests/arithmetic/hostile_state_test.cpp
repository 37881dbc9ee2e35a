// SPDX-License-Identifier: BSD-3-Clause
// What the library computes, bit for bit, does not depend on the floating-point state of the caller, and the
// caller finds its state unchanged.
//
// Compiled twice, once with -ffast-math. So nothing here computes with doubles: inputs are made of bits, and
// results are compared as bits.
#include <gtest/gtest.h>

#include <delone/delone.hpp>
#include <delone/tiles.hpp>

#include <array>
#include <bit>
#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "memory_folder.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace delone {
namespace {

/// Rounding, and what the processor has besides.
struct State {
  int rounding = FE_TONEAREST;
  std::uint64_t control = 0;
  bool operator==(const State&) const = default;
};
#if defined(__SSE2__)
constexpr std::uint64_t usual_control = 0x1f80, flush_to_zero = 0x8040, masks_of_traps = 0x0e80;
std::uint64_t control() { return _mm_getcsr() & 0x9fc0; }  // without rounding and flags
void set_control(std::uint64_t word) { _mm_setcsr(static_cast<unsigned>((_mm_getcsr() & 0x6000) | word)); }
#elif defined(__aarch64__)
constexpr std::uint64_t usual_control = 0, flush_to_zero = 1 << 24, masks_of_traps = 0;
std::uint64_t control() {
  std::uint64_t word;
  __asm__ __volatile__("mrs %0, fpcr" : "=r"(word));
  return word & ~std::uint64_t{0xc00000};
}
void set_control(std::uint64_t word) {
  std::uint64_t now;
  __asm__ __volatile__("mrs %0, fpcr" : "=r"(now));
  now = (now & 0xc00000) | word;
  __asm__ __volatile__("msr fpcr, %0" : : "r"(now));
}
#else
constexpr std::uint64_t usual_control = 0, flush_to_zero = 0, masks_of_traps = 0;
std::uint64_t control() { return 0; }
void set_control(std::uint64_t) {}
#endif

State state() { return {std::fegetround(), control()}; }
void set_state(const State& state) {
  std::fesetround(state.rounding);
  set_control(state.control);
}

const State usual{FE_TONEAREST, usual_control};
const std::vector<std::pair<std::string, State>> hostile_states{
    {"flush to zero", {FE_TONEAREST, usual_control | flush_to_zero}},
    {"upward", {FE_UPWARD, usual_control}},
    {"downward", {FE_DOWNWARD, usual_control}},
    {"toward zero", {FE_TOWARDZERO, usual_control}},
    {"upward, flush to zero", {FE_UPWARD, usual_control | flush_to_zero}},
    {"traps", {FE_TONEAREST, usual_control & ~masks_of_traps}}};

/// 64 bits that depend on all that was added.
class Digest {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(std::span<const T> items) {
    add_bytes(reinterpret_cast<const unsigned char*>(items.data()), items.size_bytes());
  }
  template <class T>
  void add(const std::vector<T>& items) {
    add(std::span<const T>(items));
  }
  void add(const std::string& text) {
    add_bytes(reinterpret_cast<const unsigned char*>(text.data()), text.size());
  }
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void add(T number) {
    add_bytes(reinterpret_cast<const unsigned char*>(&number), sizeof number);
  }
  void add(const Measure& measure) {
    add(measure.value);
    add(measure.error);
  }
  void add(const ComplexData& data) {
    add(data.affine_dimension);
    add(data.points);
    add(data.weights);
    add(data.cells);
    add(data.neighbors);
    add(data.vertex_of_point);
  }
  void add(const Diagram& diagram) {
    const VoronoiData data = diagram.to_data();
    add(data.vertices);
    add(data.ridge_vertices);
    add(data.region_vertices);
    add(data.ray_directions);
    add(diagram.ridge_volumes());
    add(diagram.region_volumes());
    add(diagram.bounding_box().low);
    if (diagram.dimension() <= 2 && diagram.affine_dimension() == diagram.dimension())
      add(diagram.region_volumes(diagram.bounding_box()));
  }
  void add(const CheckReport& report) {
    add(report.violation);
    add(report.ties);
  }
  std::uint64_t value() const { return value_; }

 private:
  void add_bytes(const unsigned char* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3;
  }
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// Numbers of bits: SplitMix64.
class Bits {
 public:
  explicit Bits(std::uint64_t seed) : state_(seed) {}
  std::uint64_t operator()(int count) {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
    x = (x ^ x >> 27) * 0x94d049bb133111eb;
    return (x ^ x >> 31) >> (64 - count);
  }

 private:
  std::uint64_t state_;
};

double of_bits(std::uint64_t bits) { return std::bit_cast<double>(bits); }
/// ±1.f · 2^exponent.
double number(Bits& bits, int exponent, int fraction_bits = 52) {
  const std::uint64_t fraction = bits(fraction_bits) << (52 - fraction_bits);
  return of_bits(bits(1) << 63 | static_cast<std::uint64_t>(exponent + 1023) << 52 | fraction);
}

using Set = std::pair<std::string, std::vector<double>>;

std::vector<Set> sets(std::size_t n, int d) {
  const std::size_t size = n * static_cast<std::size_t>(d);
  std::vector<double> least, subnormal, small, usual_numbers, lattice, large, all;
  Bits bits(static_cast<std::uint64_t>(d));
  for (std::size_t i = 0; i < size; ++i) {
    least.push_back(of_bits(bits(3)));  // 0 … 7 times the least number
    subnormal.push_back(of_bits(bits(1) << 63 | bits(52)));
    small.push_back(number(bits, -997 - static_cast<int>(bits(3))));  // 1e-300
    usual_numbers.push_back(number(bits, -1 - static_cast<int>(bits(2))));
    lattice.push_back(bits(2) == 0 ? 0.0 : number(bits, static_cast<int>(bits(1)), 1));
    large.push_back(number(bits, 996 - static_cast<int>(bits(3))));  // 1e300
    all.push_back(number(bits, static_cast<int>(bits(10)) - 512));
  }
  return {{"least", least},     {"subnormal", subnormal}, {"small", small}, {"usual", usual_numbers},
          {"lattice", lattice}, {"large", large},         {"all", all}};
}

/// Runs some work, and returns what it has added, or the message of its error.
std::uint64_t digest_of(const std::function<void(Digest&)>& work) {
  Digest digest;
  try {
    work(digest);
  } catch (const Error& error) {
    digest.add(std::string(error.what()));
  }
  return digest.value();
}

/// The work gives the same in all states, and leaves them.
void expect_same(const std::string& what, const std::function<void(Digest&)>& work) {
  const State own = state();
  set_state(usual);
  const std::uint64_t expected = digest_of(work);
  for (const auto& [name, hostile] : hostile_states) {
    set_state(hostile);
    const std::uint64_t found = digest_of(work);
    const State left = state();
    set_state(usual);
    EXPECT_EQ(found, expected) << what << ": " << name;
    EXPECT_TRUE(left == hostile) << what << " changes the state: " << name;
  }
  set_state(own);
}

/// For all sets of points in some dimensions.
void expect_same_of_points(const std::string& what, std::size_t n,
                           const std::function<void(Digest&, const std::vector<double>&, int)>& work) {
  for (const int d : {1, 2, 3})
    for (const auto& [name, points] : sets(n, d))
      expect_same(what + " of " + name + " points in dimension " + std::to_string(d),
                  [&, &points = points](Digest& digest) { work(digest, points, d); });
}

std::vector<double> some_weights(const std::vector<double>& points, int d) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < points.size(); i += static_cast<std::size_t>(d)) weights.push_back(points[i]);
  return weights;
}

TEST(HostileState, Delaunay) {
  expect_same_of_points("Delaunay", 40, [](Digest& digest, const std::vector<double>& points, int d) {
    const Delaunay<> t(points, d);
    digest.add(t.hash().hex());
    digest.add(canonical_hash(t.to_data()).hex());
    digest.add(t.to_data());
    digest.add(check(t.to_data()));
  });
}

TEST(HostileState, Threads) {
  const auto all = sets(3000, 3);
  for (const auto& [name, points] : all) {
    if (name != "subnormal" && name != "usual") continue;  // many exact tests of the others take a minute
    expect_same("four threads: " + name, [&, &points = points](Digest& digest) {
      Delaunay<> t(points, 3, {.threads = 4});
      t.sort_cells();
      digest.add(t.hash({.threads = 4}).hex());
      digest.add(t.to_data().cells);
      digest.add(circumradii(t, {.threads = 4}));
      std::vector<VertexId> nearest(3000);
      PointLocator(t).nearest(points, [&](std::size_t q, VertexId v) { nearest[q] = v; }, {.threads = 4});
      digest.add(nearest);
    });
  }
}

TEST(HostileState, RegularAndPowerDiagram) {
  expect_same_of_points("Regular", 20, [](Digest& digest, const std::vector<double>& points, int d) {
    Regular<> t(points, some_weights(points, d), d);
    digest.add(t.hash().hex());
    digest.add(canonical_hash(t.to_data()).hex());
    digest.add(t.to_data());
    digest.add(PowerDiagram<>(t));
    t.set_weight(1, of_bits(1));
    digest.add(t.hash().hex());
  });
}

TEST(HostileState, FurthestSite) {
  expect_same_of_points("FurthestSite", 30, [](Digest& digest, const std::vector<double>& points, int d) {
    const FurthestSite<> t(points, d);
    digest.add(t.hash().hex());
    digest.add(t.to_data());
    digest.add(FurthestVoronoi<>(t));
  });
}

TEST(HostileState, Voronoi) {
  expect_same_of_points("Voronoi", 20, [](Digest& digest, const std::vector<double>& points, int d) {
    const Delaunay<> t(points, d);
    digest.add(Voronoi<>(t));
    const Voronoi<> diagram(t, {.tolerance = of_bits(5)});
    digest.add(diagram);
    digest.add(check(diagram.to_data()));
  });
}

TEST(HostileState, ConvexHull) {
  expect_same_of_points("ConvexHull", 40, [](Digest& digest, const std::vector<double>& points, int d) {
    ConvexHull<> hull(points, d);
    const HullData data = hull.to_data();
    digest.add(hull.hash().hex());
    digest.add(data.cells);
    digest.add(data.equations);
    digest.add(data.equation_errors);
    digest.add(hull.volume());
    digest.add(hull.area());
    digest.add(check(data));
    for (std::size_t i = 0; i + 1 < points.size() / static_cast<std::size_t>(d); i += 3) {
      const std::span q(points.data() + i * static_cast<std::size_t>(d) + (d > 1 ? 1 : 0),
                        static_cast<std::size_t>(d));
      digest.add(hull.locate(q).kind);
      digest.add(hull.contains(q));
      digest.add(hull.visible_facets(q));
    }
    hull.insert(std::vector<double>(static_cast<std::size_t>(d), of_bits(9)));
    digest.add(hull.hash().hex());
    const ConvexHull<> tolerant(points, d, {.tolerance = of_bits(2)});
    digest.add(tolerant.num_vertices());
    digest.add(tolerant.max_distance());
  });
}

TEST(HostileState, LowerHullAndManyHulls) {
  expect_same_of_points("LowerHull", 30, [](Digest& digest, const std::vector<double>& points, int d) {
    const std::vector<std::size_t> offsets{0, 10, 30};
    const ConvexHulls hulls = convex_hulls(points, d, offsets);
    digest.add(hulls.equations);
    digest.add(hulls.volumes);
    const LowerHull<> hull(points, d);
    digest.add(hull.to_data());
    digest.add(hull.height_above(points));
    digest.add(hull.heights(std::span(points).first(10 * static_cast<std::size_t>(d - 1))));
  });
}

TEST(HostileState, HalfspaceIntersection) {
  expect_same_of_points("HalfspaceIntersection", 20,
                        [](Digest& digest, const std::vector<double>& points, int d) {
                          std::vector<double> rows;
                          for (std::size_t i = 0; i < points.size(); ++i) {
                            rows.push_back(points[i]);
                            if ((i + 1) % static_cast<std::size_t>(d) == 0) rows.push_back(-1.0);
                          }
                          const HalfspaceIntersection<> made(rows, d);
                          const IntersectionData data = made.to_data();
                          digest.add(data.state);
                          digest.add(data.vertices);
                          digest.add(data.directions);
                          digest.add(data.interior_point);
                          digest.add(data.dual_equations);
                          digest.add(made.volume());
                          digest.add(made.dual_volume());
                          digest.add(check(data));
                        });
}

TEST(HostileState, AlphaComplexAndMeasures) {
  expect_same_of_points("AlphaComplex", 30, [](Digest& digest, const std::vector<double>& points, int d) {
    const Delaunay<> t(points, d);
    for (int j = 0; j <= d; ++j) digest.add(alpha_values(t, j).values);
    for (const double square : {of_bits(3), 1e-3, 1.0, 1e300}) {
      const AlphaComplex complex = AlphaComplex::of_squared_radius(t, square);
      digest.add(complex.cell_numbers());
      digest.add(complex.boundary());
    }
    digest.add(circumradii(t));
    digest.add(circumcenters(t));
    for (const auto measure :
         {QualityMeasure::radius_ratio, QualityMeasure::mean_ratio, QualityMeasure::radius_edge_ratio})
      digest.add(qualities(t, measure));
    digest.add(trim(t, of_bits(4)).data);
  });
}

TEST(HostileState, Edits) {
  expect_same_of_points("edits", 40, [](Digest& digest, const std::vector<double>& points, int d) {
    const auto width = static_cast<std::size_t>(d);
    const std::span<const double> all = points;
    Delaunay<> t(all.first(20 * width), d);
    t.record_undo(true);
    t.insert_range(all.subspan(20 * width));
    for (std::size_t row = 3; row < 20; row += 4) t.remove(row);
    digest.add(t.hash().hex());
    t.move(5, all.subspan(7 * width, width));
    digest.add(t.hash().hex());
    t.undo();
    digest.add(t.hash().hex());
    t.insert(std::vector<double>(width, of_bits(6)));
    digest.add(t.hash().hex());
    const Delaunay<> copy = t.clone();
    digest.add(copy.hash().hex());
    t.compact();
    digest.add(t.to_data());
  });
}

TEST(HostileState, Queries) {
  expect_same_of_points("queries", 40, [](Digest& digest, const std::vector<double>& points, int d) {
    const auto width = static_cast<std::size_t>(d);
    const std::span<const double> all = points;
    const Delaunay<> t(all.first(30 * width), d);
    const PointLocator locator(t);
    const CellNumbers numbers(t.complex());
    for (const double tolerance : {0.0, of_bits(2)}) {
      std::vector<double> barycentric(40 * static_cast<std::size_t>(t.affine_dimension() + 1)), distances(40);
      std::vector<SignedIndex> cells(40);
      locator.locate(all, {.tolerance = tolerance}, numbers,
                     {.cells = cells, .barycentric = barycentric, .distances = distances});
      digest.add(cells);
      digest.add(barycentric);
      digest.add(distances);
    }
    locator.nearest(all, 3, [&](std::size_t, std::span<const VertexId> found) { digest.add(found); });
    locator.cells_within(all, of_bits(7), [&](std::size_t, CellId cell) {
      digest.add(cell);
      return true;
    });
    for (std::size_t i = 30; i < 40; ++i) {
      const auto q = all.subspan(i * width, width);
      digest.add(t.locate(q).kind);
      digest.add(t.conflict_zone(q));
      if (t.affine_dimension() == d) digest.add(t.in_sphere(*t.complex().finite_cells().begin(), q));
      digest.add(compare_distances(q, all.first(width), all.subspan(width, width)));
    }
    digest.add(affine_dimension(all, d));
    digest.add(orientation(all.first((width + 1) * width), d));
    digest.add(in_sphere_perturbed(all.first((width + 1) * width), all.last(width), d));
    digest.add(in_power_sphere_perturbed(all.first((width + 1) * width), all.last(width + 1), all.last(width),
                                         of_bits(1), d));
    digest.add(homogeneous_orientation(all.first((width + 1) * (width + 1)), d));
    digest.add(side_of_hyperplane(all.first(width + 1), all.last(width), d));
  });
}

TEST(HostileState, Interpolation) {
  expect_same_of_points("interpolation", 40, [](Digest& digest, const std::vector<double>& points, int d) {
    const auto width = static_cast<std::size_t>(d);
    const std::span<const double> all = points;
    const Delaunay<> t(all.first(30 * width), d);
    const std::vector<double> values(all.begin(), all.begin() + 30);
    std::vector<double> result(40), gradients(40 * width);
    const LinearInterpolator linear(t, values);
    linear.evaluate(all, result, {.outside = Outside::nearest});
    linear.gradients(all, gradients);
    digest.add(result);
    digest.add(gradients);
    for (const bool smooth : {false, true}) {
      const NaturalNeighborInterpolator natural(t, values, 1, smooth);
      natural.evaluate(all, result, {.tolerance = of_bits(3)});
      natural.gradients(all, gradients);
      digest.add(result);
      digest.add(gradients);
    }
    NaturalNeighborCoordinates(t).find(
        all, [&](std::size_t, const NaturalNeighbors& found) { digest.add(found.weights); });
  });
}

TEST(HostileState, Files) {
  const test::MemoryFolder folder;
  expect_same_of_points("files", 20, [&](Digest& digest, const std::vector<double>& points, int d) {
    PointTable table;
    table.dimension = d;
    table.coordinates = points;
    ReadOptions options;
    for (const char* const format : {"csv", "txt", "npy", "qhull"}) {
      const std::string path = folder.file(std::string("points.") + format);
      options.format = format;
      write_points(path, table, format);
      digest.add(test::content(path));
      digest.add(read_points(path, options).coordinates);
    }
    const ComplexData data = Delaunay<>(points, d).to_data();
    for (const char* const format : {"json", "npz"}) {
      const std::string path = folder.file(std::string("data.") + format);
      write(path, data, format);
      digest.add(read_as<ComplexData>(path, format));
    }
    digest.add(to_html(data));
    std::filesystem::remove_all(folder.file("tiles"));
    TilesOptions tiles;
    tiles.tiles = 2;
    tiles.resume = false;
    digest.add(make_tiles(PointsView(points, d), folder.file("tiles"), tiles).hash.hex());
  });
  // What no format of this library would write: more digits than a double has.
  write_text(folder.file("digits.csv"),
             "4.9406564584124654e-324,2.47e-324,2.4703282292062327208299e-324\n"
             "0.1000000000000000055511151231257827021181583404541015625,0.3,1e-400\n"
             "2.2250738585072011e-308,9007199254740993,1.7976931348623157e308\n");
  expect_same("text",
              [&](Digest& digest) { digest.add(read_points(folder.file("digits.csv")).coordinates); });
}

TEST(HostileState, Forecasts) {
  expect_same("forecast", [](Digest& digest) { digest.add(forecast(3, 100000, "uniform").cells.expected); });
  // Of larger sets the size of the samples depends on time.
  expect_same("forecast from samples",
              [](Digest& digest) { digest.add(forecast(3, 300, "sphere").cells.expected); });
  for (const auto& [name, points] : sets(300, 2))
    expect_same("estimate of " + name, [&, &points = points](Digest& digest) {
      digest.add(estimate(points, 2, {.sample_seconds = 100}).cells.expected);
    });
}

TEST(HostileState, PointSets) {
  for (const char* const kind : {"uniform", "sphere", "gaussian", "lattice", "cluster"})
    expect_same(kind, [&](Digest& digest) { digest.add(make_point_set(kind, 3, 500, 1)); });
}

TEST(HostileState, Polyhedron) {
  expect_same_of_points("Polyhedron", 8, [](Digest& digest, const std::vector<double>& points, int d) {
    const auto made = Polyhedron::from_generators(
        {std::span<const double>(points), static_cast<std::size_t>(d)}, {}, {}, d);
    digest.add(made.hash().hex());
    digest.add(made.vertices().to_doubles());
    if (const auto volume = made.volume()) digest.add(volume->to_double());
    digest.add(made.contains(std::vector<Rational>(static_cast<std::size_t>(d), Rational(of_bits(3)))));
  });
  expect_same("Rational", [](Digest& digest) {
    for (const char* const text : {"1/3", "4.9e-324", "1e-400", "2/7", "-0.1", "123456789012345678901/3"})
      digest.add(Rational(text).to_double());
    digest.add(Rational(of_bits(1)).to_string());
  });
}

/// Absolute results: whoever computes them.
TEST(HostileState, SubnormalPointsStayDistinct) {
  const std::vector<double> points{of_bits(0), of_bits(0), of_bits(1), of_bits(0), of_bits(0), of_bits(1),
                                   of_bits(7), of_bits(2), of_bits(3), of_bits(9), of_bits(5), of_bits(5)};
  std::vector<std::array<float, 2>> floats;
  for (std::size_t i = 0; i < points.size(); i += 2)
    floats.push_back(
        {std::bit_cast<float>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(points[i]))),
         std::bit_cast<float>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(points[i + 1])))});
  const State own = state();
  const auto check_now = [&] {
    const Delaunay<> t(points, 2);
    const bool of_doubles = t.affine_dimension() == 2 && t.num_vertices() == 6;
    const Delaunay<2> of(floats);
    const bool of_floats = of.affine_dimension() == 2 && of.num_vertices() == 6;
    return of_doubles && of_floats;
  };
  EXPECT_TRUE(check_now());  // in the state in which the program begins
  for (const auto& [name, hostile] : hostile_states) {
    set_state(hostile);
    const bool is_right = check_now();
    set_state(own);
    EXPECT_TRUE(is_right) << name;
  }
}

#if defined(__FAST_MATH__) && defined(__x86_64__) && defined(__linux__)
TEST(HostileState, TheProgramBeginsInOne) { EXPECT_NE(control() & flush_to_zero, 0u); }
#endif

TEST(HostileState, NotFiniteIsRefused) {
  const std::vector<double> points{of_bits(0x7ff8000000000000), of_bits(0), of_bits(0),
                                   of_bits(0x7ff0000000000000)};
  try {
    const Delaunay<> t(points, 2);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::not_finite);
    EXPECT_EQ(error.rows().size(), 2u);
  }
  ComplexData data;
  data.dimension = data.affine_dimension = 1;
  data.points = {of_bits(0x7ff8000000000000), of_bits(0x7ff0000000000000)};
  data.vertex_of_point = {-1, -1};
  EXPECT_TRUE(data.is_removed(0));
  EXPECT_FALSE(data.is_removed(1));
}

/// An exception leaves the state as it was, and progress functions run in it.
TEST(HostileState, OfTheCallerInItsFunctionsAndAfterErrors) {
  const State own = state();
  const auto points = sets(20000, 3)[3].second;
  for (const auto& [name, hostile] : hostile_states) {
    set_state(hostile);
    State in_progress, in_scope;
    int calls = 0;
    Errc code{};
    try {
      const ProgressScope scope([&](double) {
        in_scope = state();
        return true;
      });
      const Delaunay<> t(points, 3, {.threads = 2, .progress = [&](double) {
                                       in_progress = state();
                                       return ++calls < 2;
                                     }});
    } catch (const Error& error) {
      code = error.code();
    }
    const State after = state();
    set_state(own);
    EXPECT_TRUE(after == hostile) << name;
    if (calls < 2) continue;  // a machine so fast
    EXPECT_EQ(code, Errc::cancelled);
    EXPECT_TRUE(in_progress == hostile) << name;
    EXPECT_TRUE(in_scope == hostile) << name;
  }
}

}  // namespace
}  // namespace delone
