// SPDX-License-Identifier: BSD-3-Clause
// The names of the kinds of data.
#include <delone/check.hpp>
#include <delone/data.hpp>

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace delone::complex {
namespace {

TEST(DataKind, NamesAreDistinctAndFound) {
  std::set<std::string_view> names, descriptions;
  for (int i = 0; i <= static_cast<int>(DataKind::furthest_voronoi); ++i) {
    const auto kind = static_cast<DataKind>(i);
    EXPECT_TRUE(names.insert(name_of(kind)).second) << name_of(kind);
    EXPECT_TRUE(descriptions.insert(description_of(kind)).second) << description_of(kind);
    EXPECT_FALSE(check_levels(kind).empty());
    if (kind == DataKind::unknown) continue;
    EXPECT_EQ(find_data_kind(name_of(kind)), kind);
  }
  EXPECT_EQ(name_of(DataKind::unknown), "");
  EXPECT_EQ(name_of(DataKind::furthest_site), "furthest_site");
  EXPECT_EQ(description_of(DataKind::lower_hull), "a lower hull");
}

TEST(DataKind, OtherNamesAreNone) {
  for (const char* name : {"", "Delaunay", "delaunay ", "unknown", "voronoi_diagram"})
    EXPECT_EQ(find_data_kind(name), std::nullopt) << name;
}

}  // namespace
}  // namespace delone::complex
