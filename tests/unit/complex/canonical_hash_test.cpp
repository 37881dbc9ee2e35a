// SPDX-License-Identifier: BSD-3-Clause
#include "complex/canonical_hash.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

namespace delone::complex {
namespace {

/// Two triangles on a unit square.
ComplexData square() {
  ComplexData data;
  data.dimension = data.affine_dimension = 2;
  data.points = {0, 0, 1, 0, 1, 1, 0, 1};
  data.cells = {0, 1, 2, 0, 2, 3};
  return data;
}

std::string hash(const ComplexData& data) { return canonical_hash(data).hex(); }

TEST(CanonicalHash, IsWrittenInHexadecimals) {
  EXPECT_EQ((CanonicalHash{0x0123456789abcdefu, 1}).hex(), "0123456789abcdef0000000000000001");
  EXPECT_EQ(CanonicalHash{}.hex(), std::string(32, '0'));
  std::ostringstream out;
  out << std::uppercase << CanonicalHash{0x0123456789abcdefu, 1} << ' ' << std::setw(34) << CanonicalHash{};
  EXPECT_EQ(out.str(), "0123456789abcdef0000000000000001   " + std::string(32, '0'));
}

// Recorded values: hashes in files and in test suites elsewhere depend on them.
TEST(CanonicalHash, StaysTheSame) {
  EXPECT_EQ(hash(square()), "cfa682191e459fb5bf80a2825f224a39");
  EXPECT_EQ(hash(ComplexData{}), "8b32c408e8c2c97c8b32c408e8c2c97c");
}

TEST(CanonicalHash, IsThatOfTheTriangulation) {
  const Delaunay<2> t(std::vector<std::array<double, 2>>{{0, 0}, {3, 0}, {0, 3}, {1, 1}, {3, 0}, {-0.0, 0}});
  EXPECT_EQ(hash(t.to_data()), t.hash().hex());
}

TEST(CanonicalHash, DependsOnNoOrder) {
  ComplexData data = square();
  data.cells = {2, 3, 0, 2, 0, 1};
  EXPECT_EQ(hash(data), hash(square()));
  data.points = {1, 1, 0, 1, 0, 0, 1, 0};  // rows 2 3 0 1 of the square
  data.cells = {2, 3, 0, 2, 0, 1};
  EXPECT_EQ(hash(data), hash(square()));
}

TEST(CanonicalHash, TellsTriangulationsApart) {
  ComplexData other = square();
  other.cells = {0, 1, 3, 1, 2, 3};  // the other diagonal
  EXPECT_NE(hash(other), hash(square()));
  other = square();
  other.points[7] = std::nextafter(1.0, 2.0);
  EXPECT_NE(hash(other), hash(square()));
  other = square();
  other.cells.resize(3);
  EXPECT_NE(hash(other), hash(square()));
  ComplexData point;
  point.dimension = 2;
  point.affine_dimension = 0;
  point.points = {1, 2};
  point.cells = {0};
  ComplexData longer = point;
  longer.dimension = 1;
  longer.points = {1};
  EXPECT_NE(hash(point), hash(longer));
}

// Cells {a, b}, {c, d} and {a, c}, {b, d} have the same vertices, and as many.
TEST(CanonicalHash, KnowsWhichVerticesAreTogether) {
  ComplexData data;
  data.dimension = data.affine_dimension = 1;
  data.points = {0, 1, 2, 3};
  data.cells = {0, 1, 2, 3};
  ComplexData other = data;
  other.cells = {0, 2, 1, 3};
  EXPECT_NE(hash(data), hash(other));
}

TEST(CanonicalHash, IgnoresDuplicatesAndSignsOfZero) {
  ComplexData data = square();
  data.points.insert(data.points.end(), {1, 1, 0, 0});
  EXPECT_EQ(hash(data), hash(square()));
  data.cells = {5, 1, 4, 0, 4, 3};  // by the rows of duplicates
  EXPECT_EQ(hash(data), hash(square()));
  data.points[0] = -0.0;
  EXPECT_EQ(hash(data), hash(square()));
  ComplexData more = square();
  more.points.insert(more.points.end(), {7, 7});  // a point of no cell
  EXPECT_NE(hash(more), hash(square()));
}

TEST(CanonicalHash, IgnoresHiddenPoints) {
  ComplexData data = square();
  data.points.insert(data.points.end(), {7, 7});
  data.vertex_of_point = {0, 1, 2, 3, -1};
  EXPECT_EQ(hash(data), hash(square()));
  data.weights = {0, 0, 0, 0, -9};
  EXPECT_EQ(hash(data), hash(square()));
}

// Equal weights are no weights.
TEST(CanonicalHash, CountsWeightsThatDiffer) {
  ComplexData data = square();
  data.weights = {5, 5, 5, 5};
  EXPECT_EQ(hash(data), hash(square()));
  data.weights = {0, -0.0, 0, 0};
  EXPECT_EQ(hash(data), hash(square()));
  data.weights = {5, 5, 5, 6};
  const std::string different = hash(data);
  EXPECT_NE(different, hash(square()));
  data.weights = {5, 5, 6, 5};
  EXPECT_NE(hash(data), different);
}

TEST(CanonicalHash, RefusesWhatIsNoTriangulation) {
  ComplexData data = square();
  data.cells[4] = 4;
  EXPECT_THROW(canonical_hash(data), Error);
  data.cells[4] = -1;
  EXPECT_THROW(canonical_hash(data), Error);
  data = square();
  data.weights = {1};
  EXPECT_THROW(canonical_hash(data), Error);
}

TEST(PointTag, OfEqualPointsIsEqual) {
  const double a[] = {1, -0.0}, b[] = {1, 0.0}, c[] = {0.0, 1};
  EXPECT_EQ(point_tag(a, 2), point_tag(b, 2));
  EXPECT_FALSE(point_tag(b, 2) == point_tag(c, 2));
  EXPECT_FALSE(point_tag(b, 1) == point_tag(b, 2));
}

}  // namespace
}  // namespace delone::complex
