// SPDX-License-Identifier: BSD-3-Clause
// Sets of bits that have many members in common with one of them: eight 64-bit words at a time, for several
// instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::polyhedra {

/// A set, and how many members it has in common with another one.
struct Overlap {
  std::uint32_t set;
  std::uint32_t count;
};

/// Appends the sets number first, …, size − 1 that have at least `least` members in common with `set`.
/// `words`: word w of set i is at words[w·stride + i]. REQUIRES a stride that is a multiple of 32 and at
/// least `size`.
void find_overlaps(const std::uint64_t* words, std::size_t stride, std::size_t size,
                   std::span<const std::uint64_t> set, std::size_t first, std::uint32_t least,
                   std::vector<Overlap>& found);

}  // namespace delone::polyhedra
