// SPDX-License-Identifier: BSD-3-Clause
// Every public operation without memory: whichever allocation fails, alone or with all later ones, it throws
// or does with less, leaves the object as it was, leaks nothing, and works when there is memory again.
// Batches are in all_or_nothing_test.cpp.
#include "allocations.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <delone/delone.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace {

using namespace delone;
using test::allocations;

/// What can be seen of an object, or what an operation gives.
using Seen = std::vector<double>;

void add(Seen& seen, double x) { seen.push_back(x); }
template <class T>
void add_all(Seen& seen, const T& numbers) {
  for (const auto x : numbers) seen.push_back(static_cast<double>(x));
}
void add(Seen& seen, const CanonicalHash& hash) {
  for (const std::uint64_t half : {hash.high, hash.low})
    for (const std::uint64_t part : {half >> 32, half & 0xffffffff}) add(seen, static_cast<double>(part));
}

/// `make` gives an object, `act` does something to it and may write what it gives, `see` is what can be seen
/// of it.
template <class Make, class Act, class See>
void expect_all_or_nothing(const char* name, Make make, Act act, See see) {
  SCOPED_TRACE(name);
  Seen right, right_object;
  {
    auto object = make();
    act(object, right);  // also allocates what stays for all later calls
    right_object = see(object);
  }
  std::size_t num_allocations;
  {
    auto object = make();
    Seen given;
    allocations = {};
    act(object, given);
    num_allocations = allocations.count;
  }
  std::mt19937 random(9);
  const std::size_t most = test::scale() == test::Scale::large ? 4000 : test::scaled_count(20);
  const std::size_t trials = std::min(most, num_allocations);
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const std::size_t failing = trials == num_allocations ? trial + 1 : 1 + random() % num_allocations;
    const bool all_later = trial % 2 == 1;
    SCOPED_TRACE(testing::Message() << "allocation " << failing << " of " << num_allocations
                                    << (all_later ? " and all later" : ""));
    const std::int64_t live = test::num_live_allocations;
    std::int64_t leaked;
    bool is_same = true, is_right = true;
    {
      auto object = make();
      Seen given;
      const Seen before = see(object);
      bool has_failed = false;
      allocations = {0, failing, all_later};
      try {
        act(object, given);
      } catch (const Error& error) {
        has_failed = true;
        allocations = {};
        EXPECT_TRUE(error.code() == Errc::out_of_memory) << error.what();
      } catch (const std::bad_alloc&) {
        has_failed = true;
      }
      allocations = {};
      if (has_failed) {
        is_same = see(object) == before;
        given.clear();
        act(object, given);
      }
      is_right = given == right && see(object) == right_object;
    }
    leaked = test::num_live_allocations - live;
    EXPECT_TRUE(is_same) << "something has changed";
    EXPECT_TRUE(is_right) << "another result";
    EXPECT_EQ(leaked, 0) << "allocations";
    if (testing::Test::HasFailure()) return;
  }
}

/// An operation on no object, or on one that it does not change.
template <class Act>
void expect_throws_or_gives(const char* name, Act act) {
  expect_all_or_nothing(
      name, [] { return 0; }, [&](int, Seen& seen) { act(seen); }, [](int) { return Seen{}; });
}

std::vector<double> points_of(int d, std::size_t n) { return make_point_set("uniform", d, n, 3); }
std::vector<double> weights_of(std::size_t n) {
  std::vector<double> weights = make_point_set("uniform", 1, n, 4);
  for (double& w : weights) w *= 0.05;
  return weights;
}
/// Around the origin.
std::vector<double> halfspaces_of(int d, std::size_t n) {
  std::vector<double> rows = make_point_set("sphere", d, n, 5), result;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.push_back(rows[i]);
    if (i % static_cast<std::size_t>(d) == static_cast<std::size_t>(d) - 1) result.push_back(-1);
  }
  return result;
}

/// One by one, and copies.
template <class Product, class Insert>
void expect_changes_all_or_nothing(const char* name, std::function<Product()> make, Insert insert) {
  const auto see = [](const Product& product) {
    Seen seen;
    add(seen, product.hash());
    add(seen, static_cast<double>(product.num_points()));
    return seen;
  };
  expect_all_or_nothing(
      name, make, [&](Product& product, Seen&) { insert(product); }, see);
  expect_all_or_nothing(
      name, make, [](Product& product, Seen& seen) { add(seen, product.clone().hash()); }, see);
}

TEST(AllocationFailure, TriangulationsThatChange) {
  for (const int d : {2, 3, 9}) {
    const std::size_t n = d == 9 ? 13 : 30;
    const std::vector<double> outside(static_cast<std::size_t>(d), 1.5),
        inside(static_cast<std::size_t>(d), 0.4);
    for (const auto& point : {outside, inside}) {
      expect_changes_all_or_nothing<Delaunay<>>(
          "Delaunay", [&] { return Delaunay<>(points_of(d, n), d); },
          [&](Delaunay<>& t) { t.insert(point); });
      expect_changes_all_or_nothing<Regular<>>(
          "Regular", [&] { return Regular<>(points_of(d, n), weights_of(n), d); },
          [&](Regular<>& t) { t.insert(point, 0.1); });
      expect_changes_all_or_nothing<FurthestSite<>>(
          "FurthestSite", [&] { return FurthestSite<>(points_of(d, n), d); },
          [&](FurthestSite<>& t) { t.insert(point); });
      expect_changes_all_or_nothing<ConvexHull<>>(
          "ConvexHull", [&] { return ConvexHull<>(points_of(d, n), d); },
          [&](ConvexHull<>& hull) { hull.insert(point); });
    }
    expect_changes_all_or_nothing<Delaunay<>>(
        "compact", [&] { return Delaunay<>(points_of(d, n), d); }, [](Delaunay<>& t) { t.compact(); });
    expect_changes_all_or_nothing<ConvexHull<>>(
        "extreme points", [&] { return ConvexHull<>(d); },
        [&](ConvexHull<>& hull) { hull.insert_extreme_points(points_of(d, n)); });
  }
}

TEST(AllocationFailure, Constructions) {
  for (const int d : {1, 2, 3, 4}) {
    const std::size_t n = 30;
    expect_throws_or_gives("Delaunay", [&](Seen& seen) { add(seen, Delaunay<>(points_of(d, n), d).hash()); });
    expect_throws_or_gives(
        "Regular", [&](Seen& seen) { add(seen, Regular<>(points_of(d, n), weights_of(n), d).hash()); });
    expect_throws_or_gives("FurthestSite",
                           [&](Seen& seen) { add(seen, FurthestSite<>(points_of(d, n), d).hash()); });
    expect_throws_or_gives("ConvexHull",
                           [&](Seen& seen) { add(seen, ConvexHull<>(points_of(d, n), d).hash()); });
    if (d > 1)
      expect_throws_or_gives("LowerHull", [&](Seen& seen) {
        const LowerHull<> hull(points_of(d, n), d);
        add_all(seen, hull.cells());
        add_all(seen, hull.heights(std::vector<double>(static_cast<std::size_t>(d) - 1, 0.5)));
        add_all(seen, hull.height_above(points_of(d, 3)));
        add(seen, static_cast<double>(hull.clone().to_data().cells.size()));
      });
    expect_throws_or_gives("with a tolerance", [&](Seen& seen) {
      Options options;
      options.tolerance = 0.05;
      add(seen, static_cast<double>(ConvexHull<>(points_of(d, n), d, options).data().cells.size()));
      if (d > 1) add_all(seen, LowerHull<>(points_of(d, n), d, HullSide::upper, options).cells());
    });
    expect_throws_or_gives("many hulls", [&](Seen& seen) {
      const std::vector<std::size_t> offsets{0, 10, 20, 30};
      add_all(seen, convex_hulls(points_of(d, n), d, offsets).cells);
    });
    expect_throws_or_gives("HalfspaceIntersection", [&](Seen& seen) {
      const HalfspaceIntersection<> all(halfspaces_of(d, n), d);
      add_all(seen, all.to_data().vertices);
      add(seen, all.is_bounded() ? all.volume().value : 0);
      add(seen, static_cast<double>(all.clone().num_facets()));
    });
    expect_all_or_nothing(
        "insertion of halfspaces",
        [&] {
          return HalfspaceIntersection<>(halfspaces_of(d, n), d,
                                         std::vector<double>(static_cast<std::size_t>(d), 0.0));
        },
        [&](HalfspaceIntersection<>& all, Seen&) {
          std::vector<double> row(static_cast<std::size_t>(d) + 1, 1.0);
          row.back() = -0.5;
          all.insert(row);
        },
        [](const HalfspaceIntersection<>& all) {
          Seen seen;
          add_all(seen, all.data().vertices);
          std::sort(seen.begin(), seen.end());  // their order depends on that of the cells
          add(seen, static_cast<double>(all.num_halfspaces()));
          return seen;
        });
  }
}

TEST(AllocationFailure, PeriodicTriangulations) {
  const Lattice lattice{3, {1, 0, 0, .25, 1, 0, 0, .5, 1}};
  const auto see = [](const PeriodicTriangulation& t, Seen& seen) {
    add(seen, t.hash());
    add_all(seen, t.cells());
    add_all(seen, t.cell_offsets());
    add_all(seen, t.neighbors());
    add(seen, t.is_simplicial() ? 1 : 0);
    add(seen, check(t.to_data()).ok ? 1 : 0);
  };
  expect_throws_or_gives("periodic Delaunay", [&](Seen& seen) {
    see(PeriodicDelaunay<>(PointsView(points_of(3, 9), 3), lattice), seen);
  });
  expect_throws_or_gives("periodic regular", [&](Seen& seen) {
    see(PeriodicRegular<>(PointsView(points_of(3, 9), 3), weights_of(9), lattice), seen);
  });
  expect_all_or_nothing(
      "arrays of a periodic triangulation",
      [&] { return PeriodicDelaunay<>(PointsView(points_of(3, 9), 3), lattice); },
      [&](const PeriodicDelaunay<>& t, Seen& seen) { see(t, seen); },
      [](const PeriodicDelaunay<>& t) {
        return Seen{t.displacement(), static_cast<double>(t.num_vertices())};
      });
}

TEST(AllocationFailure, Queries) {
  for (const int d : {2, 3, 4}) {
    const std::vector<double> points = points_of(d, 25), queries = make_point_set("uniform", d, 5, 8);
    const std::vector<double> values = make_point_set("uniform", 1, 25, 9);
    const Delaunay<> triangulation(points, d);
    expect_throws_or_gives("location", [&](Seen& seen) {
      const PointLocator locator(triangulation);
      locator.locate(queries,
                     [&](std::size_t, const LocatedPoint& where) { add_all(seen, where.barycentric); });
      locator.nearest(queries, 3, [&](std::size_t, std::span<const VertexId> nearest) {
        for (const VertexId v : nearest) add(seen, index(v));
      });
      locator.cells_within(queries, 0.1, [&](std::size_t, CellId cell) {
        add(seen, index(cell));
        return true;
      });
      add(seen, static_cast<double>(locator.edges().vertices.size()));
      add(seen, static_cast<double>(
                    triangulation.locate(std::span(queries).first(static_cast<std::size_t>(d))).kind));
      add(seen,
          static_cast<double>(
              triangulation.conflict_zone(std::span(queries).first(static_cast<std::size_t>(d))).size()));
    });
    expect_throws_or_gives("location with a tolerance", [&](Seen& seen) {
      LocateOptions options;
      options.tolerance = 0.01;
      PointLocator(triangulation).locate(queries, options, [&](std::size_t, const LocatedPoint& where) {
        add_all(seen, where.barycentric);
      });
    });
    expect_throws_or_gives("interpolation", [&](Seen& seen) {
      std::vector<double> result(5), gradients(5 * static_cast<std::size_t>(d));
      EvaluateOptions options;
      options.outside = Outside::project;
      const LinearInterpolator linear(triangulation, values);
      linear.evaluate(queries, result, options);
      linear.gradients(queries, gradients, options);
      add_all(seen, result);
      add_all(seen, gradients);
    });
    expect_throws_or_gives("natural neighbors", [&](Seen& seen) {
      std::vector<double> result(5);
      EvaluateOptions options;
      options.outside = Outside::nearest;
      const NaturalNeighborInterpolator natural(triangulation, values, 1, true);
      natural.evaluate(queries, result, options);
      add_all(seen, result);
      natural.coordinates().find(
          queries, [&](std::size_t, const NaturalNeighbors& found) { add_all(seen, found.weights); });
    });
    expect_throws_or_gives("trimming", [&](Seen& seen) {
      add(seen, static_cast<double>(trim(triangulation, 0.1).num_removed));
    });
    expect_throws_or_gives("data", [&](Seen& seen) {
      add_all(seen, triangulation.to_data().cells);
      add(seen, canonical_hash(triangulation.to_data()));
      add_all(seen, triangulation.axes());
      add_all(seen, triangulation.hidden_rows());
    });
  }
}

TEST(AllocationFailure, QueriesOfHulls) {
  for (const int d : {2, 3, 5}) {
    const std::vector<double> points = points_of(d, 20), far(static_cast<std::size_t>(d), 2.0);
    // A new hull each time: some of these are computed at the first call and kept.
    expect_all_or_nothing(
        "hull", [&] { return ConvexHull<>(points, d); },
        [&](const ConvexHull<>& hull, Seen& seen) {
          add_all(seen, hull.f_vector());
          add(seen, hull.volume().value);
          add(seen, hull.area().value);
          add(seen, static_cast<double>(hull.num_facets()));
          add(seen, static_cast<double>(hull.num_ridges()));
          add(seen, static_cast<double>(hull.locate(far).cell));
          add_all(seen, hull.visible_facets(far));
          for (std::size_t row = 0; row < 20; ++row) add(seen, static_cast<double>(hull.kind(row)));
          add_all(seen, hull.data().facet_of_cell);
        },
        [](const ConvexHull<>& hull) {
          Seen seen;
          add(seen, hull.hash());
          return seen;
        });
    expect_throws_or_gives("predicates", [&](Seen& seen) {
      const std::span<const double> simplex = std::span(points).first(static_cast<std::size_t>((d + 1) * d));
      add(seen, static_cast<double>(orientation(simplex, d)));
      add(seen, static_cast<double>(in_sphere(simplex, far, d)));
      add(seen, static_cast<double>(in_sphere_perturbed(simplex, far, d)));
      add(seen, affine_dimension(points, d));
    });
  }
}

TEST(AllocationFailure, Diagrams) {
  for (const int d : {2, 3, 4}) {
    const Delaunay<> triangulation(points_of(d, 15), d);
    const Regular<> regular(points_of(d, 15), weights_of(15), d);
    const Box box{std::vector<double>(static_cast<std::size_t>(d), 0.0),
                  std::vector<double>(static_cast<std::size_t>(d), 1.0)};
    const auto see = [&](const Diagram& diagram, Seen& seen) {
      add_all(seen, diagram.vertices());
      add_all(seen, diagram.ridge_vertices());
      add_all(seen, diagram.ridge_volumes());
      add_all(seen, diagram.region_volumes(box));
      add_all(seen, diagram.bounding_box().low);
      if (d <= 3)
        diagram.for_each_clipped_region(
            box, [&](std::size_t, const ClippedRegion& region) { add_all(seen, region.corners); });
      if (d <= 3) add_all(seen, diagram.clipped_regions(box).neighbors);
      add_all(seen, diagram.to_data().region_vertices);
    };
    expect_throws_or_gives("Voronoi", [&](Seen& seen) { see(Voronoi<>(triangulation), seen); });
    expect_throws_or_gives("power", [&](Seen& seen) { see(PowerDiagram<>(regular), seen); });
    expect_throws_or_gives("Voronoi with a tolerance", [&](Seen& seen) {
      DiagramOptions options;
      options.tolerance = 0.02;
      add_all(seen, Voronoi<>(triangulation, options).vertices());
    });
  }
}

/// Files are whole or not there, and nothing else is left in the folder.
class AllocationFailureOfFiles : public testing::Test {
 protected:
  AllocationFailureOfFiles()
      : folder_(std::filesystem::temp_directory_path() / ("delone_allocations." + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~AllocationFailureOfFiles() override { std::filesystem::remove_all(folder_); }

  /// Writes a file, and reads it if `read` can.
  template <class Write, class Read>
  void expect_whole_or_nothing(const std::string& extension, Write write, Read read) {
    const std::string path = (folder_ / ("file." + extension)).string();
    expect_all_or_nothing(
        extension.c_str(),
        [&] {
          std::filesystem::remove(path);
          return 0;
        },
        [&](int, Seen&) { write(path); },
        [&](int) {
          Seen seen;
          for (const auto& entry : std::filesystem::directory_iterator(folder_))
            add(seen, static_cast<double>(entry.file_size()));
          return seen;
        });
    write(path);
    expect_throws_or_gives(("reading " + extension).c_str(), [&](Seen& seen) { read(path, seen); });
    std::filesystem::remove(path);
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(AllocationFailureOfFiles, Points) {
  PointTable table;
  table.dimension = 3;
  table.coordinates = points_of(3, 12);
  for (const char* format : {"csv", "tsv", "txt", "npy", "qhull", "off", "ply"}) try {
      expect_whole_or_nothing(
          format, [&](const std::string& path) { write_points(path, table, format); },
          [&](const std::string& path, Seen& seen) {
            add_all(seen, read_points(path, {.format = format, .columns = {}}).coordinates);
          });
    } catch (const Error& error) {
      if (error.code() != Errc::unsupported) throw;  // to be read only
    }
}

TEST_F(AllocationFailureOfFiles, Results) {
  const Delaunay<> triangulation(points_of(2, 12), 2);
  const Voronoi<> diagram(triangulation);
  const AnyData all[] = {triangulation.to_data(), ConvexHull<>(points_of(3, 12), 3).to_data(),
                         HalfspaceIntersection<>(halfspaces_of(2, 8), 2).to_data(), diagram.to_data()};
  for (const AnyData& data : all)
    for (const char* format : {"json", "npz", "vtu", "off", "ply", "svg", "txt"}) try {
        expect_whole_or_nothing(
            format,
            [&](const std::string& path) {
              std::visit([&](const auto& held) { write(path, held, format); }, data);
            },
            [&](const std::string& path, Seen& seen) {
              try {
                add(seen,
                    std::visit([](const auto& held) { return check(held).ok; }, read(path, format)) ? 1 : 0);
              } catch (const Error& error) {  // written only
                if (error.code() == Errc::out_of_memory) throw;
              }
            });
      } catch (const Error& error) {
        if (error.code() != Errc::unsupported) throw;
      }
}

TEST(AllocationFailure, Checks) {
  const Delaunay<> triangulation(points_of(3, 15), 3);
  const AnyData all[] = {triangulation.to_data(), ConvexHull<>(points_of(3, 12), 3).to_data(),
                         HalfspaceIntersection<>(halfspaces_of(3, 8), 3).to_data(),
                         Voronoi<>(triangulation).to_data()};
  for (const AnyData& data : all)
    expect_throws_or_gives("check", [&](Seen& seen) {
      const CheckReport report = std::visit([](const auto& held) { return check(held); }, data);
      add(seen, report.ok ? 1 : 0);
      add(seen, report.reached.number);
    });
}

}  // namespace
