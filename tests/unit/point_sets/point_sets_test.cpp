// SPDX-License-Identifier: BSD-3-Clause
// Every kind of point set: its size, and its reproducibility.
#include <delone/error.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace delone {
namespace {

Errc error_of(std::string_view kind, int d, std::size_t n) {
  try {
    make_point_set(kind, d, n, 0);
  } catch (const Error& e) {
    return e.code();
  }
  ADD_FAILURE() << kind << " should have thrown";
  return Errc::cancelled;
}

std::uint64_t fingerprint(const std::vector<double>& x) {
  std::uint64_t h = 14695981039346656037u;
  for (double v : x) h = (h ^ std::bit_cast<std::uint64_t>(v)) * 1099511628211u;
  return h;
}

TEST(PointSets, AreListedInAlphabeticalOrder) {
  const auto& kinds = point_set_kinds();
  EXPECT_TRUE(std::is_sorted(kinds.begin(), kinds.end(), [](auto& a, auto& b) { return a.name < b.name; }));
  EXPECT_EQ(kinds.size(), 20u);
  for (const auto& kind : kinds) EXPECT_FALSE(kind.description.empty());
}

TEST(PointSets, HaveTheSizeAskedForFiniteCoordinatesAndDependOnTheSeedOnly) {
  for (const auto& kind : point_set_kinds())
    for (int d : {1, 2, 3, 6, 70})
      for (std::size_t n : {0u, 1u, 2u, 50u}) {
        const std::string name(kind.name);
        if (d == 1 && (name == "flat" || name == "cospherical" || name == "ulp_sphere")) {
          EXPECT_EQ(error_of(name, d, n), Errc::invalid_argument);
          continue;
        }
        const auto x = make_point_set(name, d, n, 7);
        const std::size_t expected =
            name == "cube01" && d < 6 ? std::min<std::size_t>(n, std::size_t{1} << d) : n;
        EXPECT_EQ(x.size(), expected * static_cast<std::size_t>(d)) << name << " " << d;
        for (double v : x) EXPECT_TRUE(std::isfinite(v)) << name;
        EXPECT_EQ(x, make_point_set(name, d, n, 7)) << name;
        if (n == 50 && name != "grid" && name != "cube01" && !(name == "sphere" && d == 1) &&
            !(name == "tilted_grid" && d == 1)) {
          EXPECT_NE(x, make_point_set(name, d, n, 8)) << name << " " << d;
        }
      }
}

TEST(PointSets, TheSameBitsOnEveryPlatform) {
  // Golden values: a change of a generator changes published data sets, and must be a decision.
  const std::map<std::string_view, std::uint64_t> golden{
      {"ball", 0x59d8a7771426e114u},       {"clusters", 0xa8b734b6cd71275cu},
      {"collinear", 0xd73e939c95ef4315u},  {"cospherical", 0x2bb9c092fe7f4315u},
      {"cube01", 0x68d23fd7003c2305u},     {"duplicates", 0xac10d031105ed1fcu},
      {"equal", 0x3c39e125653d6385u},      {"flat", 0x51d81b4197df4315u},
      {"gaussian", 0x10ad2153b4b37431u},   {"grid", 0x6cd11692fe7f4315u},
      {"manifold", 0x4882a055e9ee9b98u},   {"mixed_scales", 0x346ffa71df826bd6u},
      {"moment", 0x7c8ac017e752be29u},     {"nudged_grid", 0xa7040fecd441a82au},
      {"offset", 0x2494aa37038e6765u},     {"plummer", 0xc16b803f2f9c9a56u},
      {"sphere", 0xdb2b39c46842f859u},     {"tilted_grid", 0x1bd91692fe7f4315u},
      {"ulp_sphere", 0x85e46800667d119eu}, {"uniform", 0x671c3e2e9083c5adu}};
  for (const auto& kind : point_set_kinds()) {
    const auto found = golden.find(kind.name);
    ASSERT_NE(found, golden.end()) << kind.name;
    EXPECT_EQ(fingerprint(make_point_set(kind.name, 3, 100, 1)), found->second) << kind.name;
  }
}

TEST(PointSets, Errors) {
  EXPECT_EQ(error_of("no_such_kind", 3, 10), Errc::invalid_argument);
  EXPECT_EQ(error_of("uniform", 0, 10), Errc::invalid_argument);
  EXPECT_EQ(error_of("uniform", -1, 10), Errc::invalid_argument);
  EXPECT_EQ(error_of("cospherical", 2, 200000), Errc::invalid_argument);
  EXPECT_EQ(error_of("uniform", 1000, ~std::size_t{0} / 1000), Errc::too_many);
}

}  // namespace
}  // namespace delone
