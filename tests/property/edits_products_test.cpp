// SPDX-License-Identifier: BSD-3-Clause
// What is made of a triangulation that has been edited, with gaps in the numbers of its rows and vertices, is
// what is made of one of the rows that are left.
#include "compare.hpp"
#include "degenerate.hpp"
#include "memory_folder.hpp"

#include <gtest/gtest.h>
#include <delone/delone.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone {
namespace {

template <class Product>
constexpr bool has_weights = std::is_same_v<Product, Regular<>>;

/// A triangulation after many edits, and one of the rows that are left.
template <class Product>
class EditedAndFresh {
 public:
  EditedAndFresh(const test::PointSet& set, std::uint64_t seed)
      : d_(set.dimension), edited(set.dimension), fresh(set.dimension) {
    test::Random random(seed);
    points_ = set.points;
    const std::size_t n = set.size();
    for (std::size_t row = 0; row < n; ++row) weights_.push_back(0.05 * random.real());
    insert(edited, points_, weights_);
    std::vector<bool> is_there(n, true);
    for (std::size_t row = 0; row < n; ++row) switch (random.integer(0, 5)) {
        case 0:
        case 1:
          edited.remove(row);
          is_there[row] = false;
          break;
        case 2: {  // to a place where another one was, or is
          const std::vector<double> to = test::reordered(set.points, d_, {random.bits() % n});
          edited.move(row, to);
          std::copy(to.begin(), to.end(), points_.begin() + static_cast<std::ptrdiff_t>(row) * d_);
          break;
        }
        default:
          break;
      }
    std::vector<double> left, of_left;
    for (std::size_t row = 0; row < n; ++row) {
      to_fresh.push_back(is_there[row] ? static_cast<SignedIndex>(of_left.size()) : -1);
      if (!is_there[row]) continue;
      const std::vector<double> x = test::reordered(points_, d_, {row});
      left.insert(left.end(), x.begin(), x.end());
      of_left.push_back(weights_[row]);
    }
    insert(fresh, left, of_left);
    EXPECT_EQ(edited.hash(), fresh.hash());
  }

  /// Rows of the edited one as those of the other.
  std::vector<SignedIndex> renumbered(std::span<const SignedIndex> rows) const {
    std::vector<SignedIndex> result;
    for (const SignedIndex row : rows)
      result.push_back(row < 0 ? row : to_fresh[static_cast<std::size_t>(row)]);
    return result;
  }
  /// The row of a vertex of either, as a row of the fresh one.
  SignedIndex row(const Triangulation& t, VertexId v) const {
    const auto row = static_cast<SignedIndex>(t.row_of(v));
    return &t == &edited ? to_fresh[static_cast<std::size_t>(row)] : row;
  }
  std::vector<SignedIndex> rows(const Triangulation& t, std::span<const SignedIndex> of_t) const {
    return &t == &edited ? renumbered(of_t) : std::vector<SignedIndex>(of_t.begin(), of_t.end());
  }
  std::vector<SignedIndex> sorted_rows(const Triangulation& t, std::span<const SignedIndex> of_t) const {
    std::vector<SignedIndex> result = rows(t, of_t);
    std::sort(result.begin(), result.end());
    return result;
  }
  /// The same number for each row that is left, NaN for the others.
  std::vector<double> values(const Triangulation& t) const {
    std::vector<double> result(t.num_rows(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t row = 0; row < to_fresh.size(); ++row) {
      if (to_fresh[row] < 0) continue;
      const auto number = static_cast<std::size_t>(to_fresh[row]);
      result[&t == &edited ? row : number] = std::sin(static_cast<double>(number));
    }
    return result;
  }
  std::vector<double> queries() const {
    std::vector<double> result = make_point_set("uniform", d_, 60, 77);
    for (double& x : result) x = 1.3 * x - 0.1;
    result.insert(result.end(), points_.begin(), points_.end());
    return result;
  }

 private:
  static void insert(Product& product, const std::vector<double>& points,
                     const std::vector<double>& weights) {
    if constexpr (has_weights<Product>)
      product.insert_range(points, weights);
    else
      product.insert_range(points);
  }

  int d_;
  std::vector<double> points_, weights_;

 public:
  Product edited, fresh;
  std::vector<SignedIndex> to_fresh;
};

std::vector<test::PointSet> sets() {
  std::vector<test::PointSet> all;
  for (const int d : {1, 2, 3}) {
    all.push_back({"uniform", d, make_point_set("uniform", d, d == 3 ? 60 : 50, 1)});
    all.push_back(test::scaled(test::small_integers(d, 60, 0, 4, 2), 0.25));
    if (d > 1)
      all.push_back(test::scaled(test::embedded(test::small_integers(d - 1, 40, 0, 4, 2), d, true, 5), 0.25));
  }
  all.push_back({"uniform", 4, make_point_set("uniform", 4, 30, 1)});
  return all;
}

template <class Product>
struct ProductsOfEdited : testing::Test {
  /// `compare` is told both triangulations of each set, and how rows correspond.
  template <class Compare>
  static void for_each_set(Compare compare) {
    for (const test::PointSet& set : sets()) {
      SCOPED_TRACE(testing::Message() << set.name << ", " << set.dimension << "D");
      const EditedAndFresh<Product> both(set, 5);
      ASSERT_NO_FATAL_FAILURE(compare(both));
    }
  }
};
using Products = testing::Types<Delaunay<>, Regular<>, FurthestSite<>>;
struct Names {
  template <class Product>
  static std::string GetName(int) {
    return has_weights<Product>                      ? "Regular"
           : std::is_same_v<Product, FurthestSite<>> ? "FurthestSite"
                                                     : "Delaunay";
  }
};
TYPED_TEST_SUITE(ProductsOfEdited, Products, Names);

using Face = std::vector<SignedIndex>;

TYPED_TEST(ProductsOfEdited, Data) {
  const test::MemoryFolder folder;
  this->for_each_set([&](const auto& both) {
    CheckOptions all;
    all.canonical = true;
    all.furthest_site = both.edited.kind() == TriangulationKind::furthest_site;
    const ComplexData data = both.edited.to_data(), right = both.fresh.to_data();
    EXPECT_EQ(canonical_hash(data), both.fresh.hash());
    EXPECT_EQ(data.num_points(), both.edited.num_rows());
    const CheckReport report = check(data, all);
    EXPECT_TRUE(report.ok) << report.reached.name << ": " << report.violation;
    for (std::size_t row = 0; row < both.to_fresh.size(); ++row)
      if (both.to_fresh[row] < 0) {
        EXPECT_EQ(data.vertex_of_point[row], -1) << "a row that was removed";
      } else {
        EXPECT_EQ(both.renumbered({&data.vertex_of_point[row], 1}).front(),
                  right.vertex_of_point[static_cast<std::size_t>(both.to_fresh[row])]);
      }
    // Files have no gaps; a page leaves removed rows out.
    auto without_gaps = both.edited.clone();
    without_gaps.compact_ids();
    const ComplexData closed = without_gaps.to_data();
    EXPECT_EQ(test::sorted_cells(closed), test::sorted_cells(right));
    EXPECT_EQ(closed.vertex_of_point, right.vertex_of_point);
    EXPECT_EQ(closed.points, right.points);
    for (const std::string format : {"npz", "json", "vtu", "off", "ply", "svg", "txt", "html"}) {
      const std::string path = folder.file("data." + format);
      const auto error_of = [&](const ComplexData& what) -> std::string {
        try {
          write(path, what);
          return {};
        } catch (const Error& error) {
          return error.what();
        }
      };
      if (format == "html") {
        EXPECT_EQ(error_of(data), error_of(right));
      } else {
        EXPECT_FALSE(error_of(data).empty()) << format;
      }
      EXPECT_EQ(error_of(closed), error_of(right)) << format;
      if (format != "npz" && format != "json") continue;
      EXPECT_EQ(canonical_hash(read_as<ComplexData>(path)), both.fresh.hash()) << format;
    }
  });
}

TYPED_TEST(ProductsOfEdited, Ids) {
  this->for_each_set([&](const auto& both) {
    const Complex complex = both.edited.complex(), right = both.fresh.complex();
    EXPECT_EQ(both.edited.hash({.threads = 3}), both.fresh.hash());
    std::map<SignedIndex, std::set<SignedIndex>> around, around_right;
    for (const VertexId v : complex.finite_vertices())
      for (const VertexId w : complex.adjacent_vertices(v))
        around[both.row(both.edited, v)].insert(both.row(both.edited, w));
    for (const VertexId v : right.finite_vertices())
      for (const VertexId w : right.adjacent_vertices(v))
        around_right[both.row(both.fresh, v)].insert(both.row(both.fresh, w));
    EXPECT_EQ(around, around_right);
    EXPECT_EQ(complex.hull_facets().size(), right.hull_facets().size());
    for (int j = 0; j <= complex.affine_dimension(); ++j)
      EXPECT_EQ(complex.faces(j).size(), right.faces(j).size()) << j;
    auto copy = both.edited.clone();
    copy.compact();
    EXPECT_EQ(copy.hash(), both.fresh.hash());
    copy.sort_cells();
    EXPECT_EQ(copy.hash(), both.fresh.hash());
    copy.compact_ids();
    EXPECT_EQ(copy.num_rows(), both.fresh.num_rows());
    EXPECT_EQ(copy.hash(), both.fresh.hash());
  });
}

TYPED_TEST(ProductsOfEdited, FacesAndAlphaValues) {
  this->for_each_set([&](const auto& both) {
    for (int j = 0; j <= both.fresh.dimension(); ++j) {
      const auto listed = [&](const Triangulation& t) {
        std::map<Face, unsigned char> result;
        const Faces found = faces(t, j);
        for (std::size_t i = 0; i < found.size(); ++i)
          result[both.sorted_rows(t, found.face(i))] = found.on_hull[i];
        return result;
      };
      EXPECT_EQ(listed(both.edited), listed(both.fresh)) << j;
      if (both.fresh.kind() == TriangulationKind::furthest_site) continue;
      const auto valued = [&](const Triangulation& t) {
        std::map<Face, double> result;
        const FaceValues found = alpha_values(t, j);
        for (std::size_t i = 0; i < found.faces.size(); ++i)
          result[both.sorted_rows(t, found.faces.face(i))] = found.values[i];
        return result;
      };
      EXPECT_EQ(valued(both.edited), valued(both.fresh)) << j;
      const auto boundary = [&](const Triangulation& t) {
        std::set<Face> result;
        const AlphaComplex alpha(t, 0.15);
        const auto k = static_cast<std::size_t>(alpha.affine_dimension());
        for (std::size_t i = 0; k > 0 && i < alpha.boundary().size(); i += k)
          result.insert(both.sorted_rows(t, alpha.boundary().subspan(i, k)));
        for (std::size_t i = 0; k > 0 && i < alpha.singular_facets().size(); i += k)
          result.insert(both.sorted_rows(t, alpha.singular_facets().subspan(i, k)));
        const Faces found = alpha.faces(j);
        for (std::size_t i = 0; i < found.size(); ++i) result.insert(both.sorted_rows(t, found.face(i)));
        EXPECT_EQ(alpha.to_data().num_cells(), alpha.cell_numbers().size());
        EXPECT_EQ(alpha.boundary_data().num_cells(), alpha.boundary_cells().size());
        return result;
      };
      EXPECT_EQ(boundary(both.edited), boundary(both.fresh)) << j;
    }
  });
}

TYPED_TEST(ProductsOfEdited, MeasuresAndTrimming) {
  this->for_each_set([&](const auto& both) {
    const auto measured = [&](const Triangulation& t) {
      std::map<Face, std::vector<double>> result;
      const ComplexData data = t.to_data();
      const std::vector<double> radii = circumradii(t), centers = circumcenters(t),
                                ratios = qualities(t, QualityMeasure::radius_ratio);
      const TrimResult trimmed = trim(t, 0.03);
      const auto corners = static_cast<std::size_t>(data.affine_dimension) + 1,
                 d = static_cast<std::size_t>(data.dimension);
      for (std::size_t c = 0; c < data.num_cells(); ++c) {
        std::vector<double>& of_cell =
            result[both.sorted_rows(t, std::span(data.cells).subspan(c * corners, corners))];
        of_cell = {radii[c], ratios[c], static_cast<double>(trimmed.kept[c])};
        of_cell.insert(of_cell.end(), centers.begin() + static_cast<std::ptrdiff_t>(c * d),
                       centers.begin() + static_cast<std::ptrdiff_t>((c + 1) * d));
      }
      Face orphans = both.sorted_rows(t, trimmed.orphans);
      std::vector<double>& of_all = result[{-1}];
      of_all.assign(orphans.begin(), orphans.end());
      of_all.push_back(trimmed.depth);
      of_all.push_back(static_cast<double>(trimmed.num_removed));
      return result;
    };
    const auto found = measured(both.edited), right = measured(both.fresh);
    ASSERT_EQ(found.size(), right.size());
    for (const auto& [cell, numbers] : right) {
      ASSERT_TRUE(found.contains(cell));
      ASSERT_EQ(found.at(cell).size(), numbers.size());
      for (std::size_t i = 0; i < numbers.size(); ++i)
        EXPECT_NEAR(found.at(cell)[i], numbers[i], 1e-9 * std::fabs(numbers[i]));
    }
  });
}

/// What a diagram is by points: regions by their sites, vertices by their coordinates.
template <class Both>
auto described(const Both& both, const Triangulation& t, const Diagram& diagram) {
  struct Description {
    std::multiset<std::vector<double>> vertices;
    std::map<SignedIndex, std::multiset<std::vector<double>>> regions;
    std::map<Face, std::multiset<std::vector<double>>> ridges;
    std::multiset<Face> rays;
    std::map<SignedIndex, std::vector<double>> volumes;
    std::vector<SignedIndex> point_region;  // as the sites of the regions
  } result;
  const auto corner = [&](SignedIndex v) {
    if (v < 0) return std::vector<double>{};
    const auto x = diagram.vertex(static_cast<std::size_t>(v));
    return std::vector<double>(x.begin(), x.end());
  };
  const auto site = [&](std::size_t region) {
    return both.rows(t, diagram.region_points().subspan(region, 1)).front();
  };
  for (std::size_t v = 0; v < diagram.num_vertices(); ++v)
    result.vertices.insert(corner(static_cast<SignedIndex>(v)));
  for (std::size_t region = 0; region < diagram.num_regions(); ++region)
    for (const SignedIndex v : diagram.region(region)) result.regions[site(region)].insert(corner(v));
  for (std::size_t ridge = 0; ridge < diagram.num_ridges(); ++ridge)
    for (const SignedIndex v : diagram.ridge(ridge))
      result.ridges[both.sorted_rows(t, diagram.ridge_points().subspan(2 * ridge, 2))].insert(corner(v));
  const auto k = static_cast<std::size_t>(std::max(diagram.affine_dimension(), 0));
  for (std::size_t ray = 0; ray < diagram.num_rays(); ++ray)
    result.rays.insert(both.sorted_rows(t, diagram.ray_points().subspan(ray * k, k)));
  const std::vector<double> volumes = diagram.region_volumes(),
                            in_box = diagram.region_volumes(diagram.bounding_box());
  for (std::size_t region = 0; region < diagram.num_regions(); ++region)
    result.volumes[site(region)] = {volumes[region], in_box[region]};
  for (std::size_t row = 0; row < diagram.num_points(); ++row) {
    const SignedIndex region = diagram.point_region()[row];
    if (&t == &both.edited && both.to_fresh[row] < 0) {
      EXPECT_EQ(region, -1) << "a row that was removed";
      continue;
    }
    result.point_region.push_back(region < 0 ? -1 : site(static_cast<std::size_t>(region)));
  }
  return result;
}

TYPED_TEST(ProductsOfEdited, Diagrams) {
  this->for_each_set([&](const auto& both) {
    const auto compare = [&](const Diagram& diagram, const Diagram& right_diagram) {
      const auto found = described(both, both.edited, diagram),
                 right = described(both, both.fresh, right_diagram);
      EXPECT_EQ(found.vertices, right.vertices);
      EXPECT_EQ(found.regions, right.regions);
      EXPECT_EQ(found.ridges, right.ridges);
      EXPECT_EQ(found.rays.size(), right.rays.size());
      EXPECT_EQ(found.point_region, right.point_region);
      EXPECT_EQ(found.volumes.size(), right.volumes.size());
      for (const auto& [site, volumes] : right.volumes)
        for (std::size_t i = 0; i < volumes.size(); ++i) {
          const double volume = found.volumes.at(site)[i];
          EXPECT_TRUE(volume == volumes[i] || std::fabs(volume - volumes[i]) <= 1e-9 * volumes[i] + 1e-12)
              << volume << " and " << volumes[i];
        }
      const CheckReport report = check(diagram.to_data());
      EXPECT_TRUE(report.ok) << report.reached.name << ": " << report.violation;
    };
    for (const double tolerance : {0.0, 0.02}) {
      DiagramOptions options;
      options.tolerance = tolerance;
      if constexpr (std::is_same_v<TypeParam, Delaunay<>>)
        compare(Voronoi<>(both.edited, options), Voronoi<>(both.fresh, options));
      if constexpr (has_weights<TypeParam>)
        compare(PowerDiagram<>(both.edited, options), PowerDiagram<>(both.fresh, options));
    }
  });
}

TYPED_TEST(ProductsOfEdited, Locations) {
  this->for_each_set([&](const auto& both) {
    const std::vector<double> queries = both.queries();
    const auto d = static_cast<std::size_t>(both.fresh.dimension());
    struct Found {
      Location::Kind kind;
      std::map<SignedIndex, double> barycentric;
      Face nearest;
    };
    const auto found_in = [&](const Triangulation& t) {
      std::vector<Found> result(queries.size() / d);
      const PointLocator locator(t);
      locator.locate(queries, [&](std::size_t query, const LocatedPoint& where) {
        result[query].kind = where.kind;
        for (std::size_t i = 0; i < where.barycentric.size(); ++i)
          if (where.barycentric[i] > 0)
            result[query].barycentric[both.row(t, t.vertices(where.cell)[i])] = where.barycentric[i];
      });
      if (t.kind() != TriangulationKind::furthest_site)
        locator.nearest(queries, 4, [&](std::size_t query, std::span<const VertexId> nearest) {
          for (const VertexId v : nearest) result[query].nearest.push_back(both.row(t, v));
        });
      EXPECT_EQ(locator.edges().offsets.size(), std::size_t{t.complex().num_vertex_slots()} + 1);
      return result;
    };
    const std::vector<Found> found = found_in(both.edited), right = found_in(both.fresh);
    for (std::size_t query = 0; query < right.size(); ++query) {
      SCOPED_TRACE(testing::Message() << "query " << query);
      EXPECT_EQ(found[query].kind, right[query].kind);
      EXPECT_EQ(found[query].nearest, right[query].nearest);
      ASSERT_EQ(found[query].barycentric.size(), right[query].barycentric.size());
      for (const auto& [row, number] : right[query].barycentric)
        EXPECT_NEAR(found[query].barycentric.at(row), number, 1e-9);
      const std::span<const double> x = std::span(queries).subspan(query * d, d);
      const Location here = both.edited.locate(x), there = both.fresh.locate(x);
      EXPECT_EQ(here.kind, there.kind);
      Face face, right_face;
      for (const VertexId v : here.face) face.push_back(both.row(both.edited, v));
      for (const VertexId v : there.face) right_face.push_back(both.row(both.fresh, v));
      std::sort(face.begin(), face.end());
      std::sort(right_face.begin(), right_face.end());
      EXPECT_EQ(face, right_face);
      const auto zone = [&](const TypeParam& t) {
        if constexpr (has_weights<TypeParam>)
          return t.conflict_zone(x, 0.01).size();
        else
          return t.conflict_zone(x).size();
      };
      EXPECT_EQ(zone(both.edited), zone(both.fresh));
    }
    if constexpr (has_weights<TypeParam>) {
      for (const std::size_t row : both.edited.hidden_rows())
        EXPECT_TRUE(both.edited.complex().is_cell(both.edited.hiding_cell(row)));
    }
  });
}

void expect_near(const std::vector<double>& found, const std::vector<double>& right, double tolerance) {
  ASSERT_EQ(found.size(), right.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_EQ(std::isnan(found[i]), std::isnan(right[i])) << i;
    if (std::isnan(right[i])) continue;
    EXPECT_NEAR(found[i], right[i], tolerance * (1 + std::fabs(right[i]))) << i;
  }
}

TYPED_TEST(ProductsOfEdited, Interpolation) {
  this->for_each_set([&](const auto& both) {
    const std::vector<double> queries = both.queries();
    const auto d = static_cast<std::size_t>(both.fresh.dimension());
    for (const Outside outside : {Outside::fill, Outside::nearest, Outside::project}) {
      if (both.fresh.kind() == TriangulationKind::furthest_site && outside == Outside::nearest) continue;
      EvaluateOptions options;
      options.outside = outside;
      const auto linear = [&](const Triangulation& t) {
        std::vector<double> result(queries.size() / d);
        LinearInterpolator(t, both.values(t)).evaluate(queries, result, options);
        return result;
      };
      expect_near(linear(both.edited), linear(both.fresh), 1e-9);
      // Where the projection is rounded out of the hull, natural neighbors are not those of the cells alone.
      if (both.fresh.kind() != TriangulationKind::delaunay || outside == Outside::project) continue;
      for (const bool smooth : {false, true}) {
        const auto natural = [&](const Triangulation& t) {
          std::vector<double> result(queries.size() / d);
          NaturalNeighborInterpolator(t, both.values(t), 1, smooth).evaluate(queries, result, options);
          return result;
        };
        expect_near(natural(both.edited), natural(both.fresh), 1e-7);
      }
    }
    if (both.fresh.kind() != TriangulationKind::delaunay) return;
    const auto neighbors = [&](const Triangulation& t) {
      std::vector<std::map<SignedIndex, double>> result(queries.size() / d);
      NaturalNeighborCoordinates(t).find(queries, [&](std::size_t query, const NaturalNeighbors& found) {
        for (std::size_t i = 0; i < found.vertices.size(); ++i)
          if (found.weights[i] > 1e-9) result[query][both.row(t, found.vertices[i])] = found.weights[i];
      });
      return result;
    };
    const auto found = neighbors(both.edited), right = neighbors(both.fresh);
    for (std::size_t query = 0; query < right.size(); ++query) {
      ASSERT_EQ(found[query].size(), right[query].size());
      for (const auto& [row, weight] : right[query]) EXPECT_NEAR(found[query].at(row), weight, 1e-7);
    }
  });
}

}  // namespace
}  // namespace delone
