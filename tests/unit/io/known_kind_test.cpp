// SPDX-License-Identifier: BSD-3-Clause
// Words for kinds of data: those that files may have, and the message about others.
#include "io/known_kind.hpp"

#include "io_support.hpp"

namespace delone_test {
namespace {

using namespace delone;

TEST(KnownKind, OfEveryNameThatIsWritten) {
  for (int i = 1; i <= static_cast<int>(DataKind::furthest_voronoi); ++i) {
    const auto kind = static_cast<DataKind>(i);
    EXPECT_EQ(io::known_kind(name_of(kind), "f"), kind) << name_of(kind);
  }
}

TEST(KnownKind, OthersAreRefusedWithAllNames) {
  for (const char* const wrong : {"", "Delaunay", "delaunay ", "unknown\n"})
    expect_error(Errc::bad_format, {"f: kind: '", "is none of delaunay, ", ", furthest_voronoi"},
                 [&] { io::known_kind(wrong, "f"); });
}

}  // namespace
}  // namespace delone_test
