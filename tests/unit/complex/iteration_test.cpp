// SPDX-License-Identifier: BSD-3-Clause
// Loops over cells, their vertices and their neighbors allocate nothing; ids out of range are refused in a
// hardened build.
#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace {
std::size_t num_allocations = 0;
}

// Not inlined: compilers would pair malloc() with delete, and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++num_allocations;
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
// Sanitizers would serve these two themselves, with memory that is not from malloc().
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++num_allocations;
  return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace delone::complex {
namespace {

TEST(Iteration, AllocatesNothing) {
  for (const int d : {1, 2, 3, 5}) {
    SCOPED_TRACE(d);
    const Delaunay<> t(make_point_set("uniform", d, 100, 1), d);
    const std::size_t before = num_allocations;
    Index sum = 0;
    for (const CellId c : t.all_cells()) {
      for (const VertexId v : t.vertices(c)) sum += index(v);
      for (const CellId n : t.neighbors(c)) sum += index(n);
    }
    for (const CellId c : t.finite_cells()) sum += index(t.vertices(c)[0]) + t.complex().mirror_index(c, 0);
    EXPECT_EQ(num_allocations, before);
    EXPECT_GT(sum, 0u);
  }
}

TEST(Iteration, AnIteratorOutlivesItsRange) {
  const Delaunay<> t(make_point_set("uniform", 2, 40, 1), 2);
  std::vector<CellId> of_range, of_iterator;
  for (const CellId c : t.finite_cells()) of_range.push_back(c);
  auto cell = t.finite_cells().begin();
  const auto end = t.finite_cells().end();
  for (; cell != end; ++cell) of_iterator.push_back(*cell);
  EXPECT_EQ(of_iterator, of_range);
}

TEST(Iteration, AComplexOfOnePointHasNoEdges) {
  Delaunay<3> t;
  EXPECT_TRUE(t.complex().edges().empty());
  t.insert({1, 2, 3});
  EXPECT_TRUE(t.complex().edges().empty());
}

TEST(Iteration, RefusesIdsOutOfRangeWhenHardened) {
  if (!DELONE_HARDENED) GTEST_SKIP() << "not a hardened build";
  const Delaunay<> t(make_point_set("uniform", 3, 20, 1), 3);
  const Complex complex = t.complex();
  const CellId cell = *complex.finite_cells().begin(), beyond{complex.num_cell_slots()};
  EXPECT_THROW((void)complex.vertex(beyond, 0), Error);
  EXPECT_THROW((void)complex.neighbor(invalid_cell, 0), Error);
  EXPECT_THROW((void)complex.vertex(cell, 4), Error);
  EXPECT_THROW((void)complex.neighbor(cell, -1), Error);
  EXPECT_THROW((void)complex.vertices(beyond), Error);
  EXPECT_THROW((void)complex.neighbors(cell)[4], Error);
  EXPECT_THROW((void)complex.index_of(beyond, infinite_vertex), Error);
  EXPECT_THROW((void)complex.incident_cell(VertexId{complex.num_vertex_slots()}), Error);
}

}  // namespace
}  // namespace delone::complex
