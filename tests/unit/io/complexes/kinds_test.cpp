// SPDX-License-Identifier: BSD-3-Clause
// What files say that they hold: written, read, missing, damaged.
#include "complex_support.hpp"
#include "io/npy.hpp"
#include "small_results.hpp"

#include <delone/alpha.hpp>
#include <delone/check.hpp>
#include <delone/convex_hull.hpp>
#include <delone/furthest_site.hpp>
#include <delone/halfspaces.hpp>
#include <delone/lower_hull.hpp>
#include <delone/point_sets.hpp>
#include <delone/trim.hpp>
#include <delone/voronoi.hpp>

#include <gmock/gmock.h>

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace delone;
using namespace delone_test;
using ::testing::HasSubstr;

using Kinds = ResultFiles;

/// Results of all kinds but hull_boundary, of points in space.
std::map<DataKind, AnyData> results() {
  const std::vector<double> points = make_point_set("uniform", 3, 30, 1);
  std::vector<double> weights(30);
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 0.01 * static_cast<double>(i % 4);
  const Delaunay<> delaunay(points, 3);
  const Regular<> regular(points, weights, 3);
  const FurthestSite<> furthest(points, 3);
  const AlphaComplex alpha(delaunay, 0.4);
  Options coarse;
  coarse.tolerance = 0.125;
  std::map<DataKind, AnyData> all;
  const auto add = [&](auto data) { all.emplace(data.kind, data); };
  add(delaunay.to_data());
  add(regular.to_data());
  add(furthest.to_data());
  add(alpha.to_data());
  add(alpha.boundary_data());
  add(trim(delaunay, 0.2).data);
  add(LowerHull<>(points, 3).to_data());
  add(LowerHull<>(points, 3, HullSide::upper, coarse).to_data());
  add(ConvexHull<>(points, 3).to_data());
  add(HalfspaceIntersection<>(std::vector<double>{1, 0, -1, -1, 0, -1, 0, 1, -1, 0, -1, -1}, 2).to_data());
  add(Voronoi<>(delaunay).to_data());
  add(PowerDiagram<>(regular).to_data());
  add(FurthestVoronoi<>(furthest).to_data());
  return all;
}

DataKind kind_of(const AnyData& data) {
  return std::visit([](const auto& held) { return held.kind; }, data);
}
void write_any(const std::string& path, const AnyData& data) {
  std::visit([&](const auto& held) { write(path, held); }, data);
}

TEST_F(Kinds, AreKeptByArrays) {
  const auto all = results();
  EXPECT_EQ(all.size(), 13u);
  for (const auto& [kind, data] : all)
    for (const std::string format : {"npz", "json"}) {
      const std::string name = std::string(name_of(kind)) + "." + format;
      write_any(path(name), data);
      const AnyData read_back = delone::read(path(name));
      EXPECT_EQ(kind_of(read_back), kind) << name;
      EXPECT_EQ(read_back.index(), data.index()) << name;
      const bool ok = std::visit([](const auto& held) { return check(held).ok; }, read_back);
      EXPECT_TRUE(ok) << name;
      write_any(path("again_" + name), read_back);
      EXPECT_EQ(content("again_" + name), content(name)) << name;
    }
}

TEST_F(Kinds, ToleranceOfLowerHulls) {
  const ComplexData data = std::get<ComplexData>(results().at(DataKind::upper_hull));
  ASSERT_EQ(data.tolerance, 0.125);
  for (const std::string format : {"npz", "json"}) {
    write(path("a." + format), data);
    EXPECT_EQ(read_as<ComplexData>(path("a." + format)).tolerance, 0.125);
  }
}

TEST_F(Kinds, AreKeptByCommentsOfOff) {
  for (const auto& [kind, data] : results()) {
    const auto* const complex = std::get_if<ComplexData>(&data);
    if (complex == nullptr) continue;
    write(path("a.off"), *complex);
    const ComplexData read_back = read_as<ComplexData>(path("a.off"));
    // A file without the tolerance says nothing.
    EXPECT_EQ(read_back.kind, complex->tolerance == 0 ? kind : DataKind::unknown);
    EXPECT_EQ(read_back.cells, complex->cells);
    EXPECT_EQ(read_back.affine_dimension, complex->affine_dimension);
    if (complex->weights.empty() && complex->tolerance == 0) {
      EXPECT_TRUE(check(read_back).ok) << name_of(kind);
    }
    EXPECT_EQ(read_points(path("a.off")).num_points(), 30u);
  }
  write(path("hull.off"), std::get<HullData>(results().at(DataKind::convex_hull)));
  const ComplexData hull = read_as<ComplexData>(path("hull.off"));
  EXPECT_EQ(hull.kind, DataKind::hull_boundary);
  EXPECT_TRUE(check(hull).ok) << check(hull).violation;
  for (const std::string format : {"npz", "json"}) {  // it stays what it is
    write(path("hull." + format), hull);
    EXPECT_EQ(read_as<ComplexData>(path("hull." + format)).kind, DataKind::hull_boundary);
  }
}

TEST_F(Kinds, CommentsOfOtherFormats) {
  const ComplexData data = std::get<ComplexData>(results().at(DataKind::furthest_site));
  write(path("a.ply"), data);
  EXPECT_THAT(content("a.ply"), HasSubstr("\ncomment kind furthest_site\nelement vertex 30\n"));
  EXPECT_EQ(read_points(path("a.ply")).num_points(), 30u);
  write(path("a.vtu"), data);
  EXPECT_THAT(content("a.vtu"), HasSubstr("?>\n<!-- kind furthest_site -->\n<VTKFile"));
  write(path("b.vtu"), FurthestVoronoi<>(FurthestSite<>(make_point_set("uniform", 2, 9, 1), 2)));
  EXPECT_THAT(content("b.vtu"), HasSubstr("<!-- kind furthest_voronoi -->"));
}

TEST_F(Kinds, FilesThatDoNotSay) {
  for (const std::string format : {"npz", "json"}) {
    ComplexData data = test::small_triangulation();
    write(path("a." + format), data);
    EXPECT_EQ(read_as<ComplexData>(path("a." + format)).kind, DataKind::unknown);
    write(path("b." + format), test::small_diagram());
    EXPECT_EQ(read_as<VoronoiData>(path("b." + format)).kind, DataKind::voronoi);
    VoronoiData power = test::small_diagram();
    power.weights.assign(power.num_points(), 0);
    write(path("c." + format), power);
    EXPECT_EQ(read_as<VoronoiData>(path("c." + format)).kind, DataKind::power_diagram);
  }
}

const std::string json_of_triangle =
    R"("points": [[0, 0], [1, 0], [0, 1]], "cells": [[0, 1, 2]], "dimension": 2, "affine_dimension": 2})";

TEST_F(Kinds, DamageIsRefused) {
  const auto refused = [&](const std::string& kind, const std::vector<std::string>& parts) {
    const std::string name = file("a.json", "{\"kind\": " + kind + ", " + json_of_triangle);
    expect_error(Errc::bad_format, parts, [&] { delone::read(name); });
  };
  refused("\"delauny\"", {"a.json: kind: 'delauny' is none of delaunay, regular, furthest_site"});
  refused("\"\"", {"a.json: kind: '' is none of"});
  refused("3", {"a.json: kind: expected a string, found '3'"});
  refused("[\"delaunay\"]", {"a.json: kind: expected a string"});
  refused("null", {"a.json: kind"});
  refused("\"convex_hull\"", {"a.json: there is no member 'neighbors'"});
  refused("\"voronoi\"", {"a.json: there is no member 'vertices'"});
  refused("\"halfspace_intersection\"", {"a.json: there is no member 'rank'"});
  EXPECT_EQ(read_as<ComplexData>(file("b.json", "{\"kind\": \"alpha_complex\", " + json_of_triangle)).kind,
            DataKind::alpha_complex);
  expect_error(Errc::bad_format, {"holds a lower hull, not a convex hull"},
               [&] { read_as<HullData>(file("c.json", "{\"kind\": \"lower_hull\", " + json_of_triangle)); });
}

TEST_F(Kinds, DamageOfArchivesIsRefused) {
  const std::string points = npy_of<double>("<f8", "(3, 2)", {0, 0, 1, 0, 0, 1}),
                    cells = npy("<i4", "(1, 3)", std::string("\0\0\0\0\1\0\0\0\2\0\0\0", 12));
  const auto with = [&](const std::string& kind) {
    return npz("a.npz", {{"points", points}, {"cells", cells}, {"kind", kind}});
  };
  EXPECT_EQ(read_as<ComplexData>(with(io::npy_of_text("regular"))).kind, DataKind::regular);
  expect_error(Errc::bad_format, {"a.npz: kind: 'x' is none of"},
               [&] { delone::read(with(io::npy_of_text("x"))); });
  expect_error(Errc::bad_format, {"a.npz: kind: expected a 0-D array of Unicode strings"},
               [&] { delone::read(with(npy_of<double>("<f8", "(1,)", {1}))); });
  expect_error(Errc::bad_format, {"a.npz: kind: expected a 0-D array"},
               [&] { delone::read(with(io::npy_of_texts({"regular"}))); });
}

TEST_F(Kinds, DamageOfOffIsRefused) {
  const auto off = [&](const std::string& comment) {
    return file("a.off", "OFF\n" + comment + "\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  };
  EXPECT_EQ(read_as<ComplexData>(off("# delone: lower_hull\r")).kind, DataKind::lower_hull);
  EXPECT_EQ(read_as<ComplexData>(off("# made by hand")).kind, DataKind::unknown);
  expect_error(Errc::bad_format, {"a.off: kind: 'chair' is none of"},
               [&] { delone::read(off("# delone: chair")); });
  expect_error(Errc::bad_format, {"a.off: the file says that it holds a Voronoi diagram"},
               [&] { delone::read(off("# delone: voronoi")); });
  EXPECT_EQ(read_points(off("# delone: chair")).num_points(), 3u);
  const std::string triangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(read_as<ComplexData>(file("b.off", triangle + "\n# delone: trimmed")).kind, DataKind::trimmed);
  expect_error(Errc::bad_format, {"b.off: kind: 'chair' is none of"},
               [&] { delone::read(file("b.off", triangle + "# delone: chair\n")); });
  ComplexData data = square();
  data.kind = DataKind::delaunay;
  write(path("c.off"), data);
  EXPECT_TRUE(content("c.off").ends_with("3 1 3 2\n# delone: delaunay\n"));
}

TEST_F(Kinds, ThatAreOfOtherArraysAreNotWritten) {
  ComplexData data = square();
  data.kind = DataKind::voronoi;
  expect_error(Errc::invalid_argument, {"the kind is voronoi, which has other arrays"},
               [&] { write(path("a.npz"), data); });
  VoronoiData diagram = test::small_diagram();
  diagram.kind = DataKind::regular;
  expect_error(Errc::invalid_argument, {"the kind is regular"}, [&] { write(path("a.json"), diagram); });
  EXPECT_EQ(num_files(), 0u);
}

}  // namespace
