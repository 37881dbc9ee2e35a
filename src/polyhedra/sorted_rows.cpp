// SPDX-License-Identifier: BSD-3-Clause
// Rows are compared by keys of 64 bits first: two rows with different keys have their order. Keys are what
// fits of the first entries.
#include "polyhedra/sorted_rows.hpp"

#include "base/parallel_parts.hpp"
#include "polyhedra/arithmetic.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace delone::polyhedra {
namespace {

constexpr int bits_of_keys = 63;  // one is left to tell vertices from rays

struct KeyedRow {
  std::uint64_t key;
  std::size_t row;
};

bool is_point(const Row& generator) { return generator.back() > 0; }

bool precedes(const Row& a, const Row& b) {
  if (is_point(a) != is_point(b)) return is_point(a);
  if (a.back() == b.back()) return a < b;
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    const Integer left = a[i] * b.back(), right = b[i] * a.back();
    if (left != right) return left < right;
  }
  return false;
}

bool precedes_as_inequality(const Row& a, const Row& b) {
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    if (a[i] != b[i]) return a[i] > b[i];
  return a.back() < b.back();
}

/// Adds keys in the lexicographic order of the rows without their last entries, or the reverse order: entries
/// side by side, each with as many bits as the largest in its column needs, and the leading bits of the first
/// one that does not fit.
void add_entries(const Rows& rows, std::vector<KeyedRow>& keys, bool is_reversed) {
  if (keys.empty()) return;
  int left = bits_of_keys;
  for (std::size_t c = 0; c + 1 < rows[keys.front().row].size() && left > 0; ++c) {
    int bits = 0;
    for (const KeyedRow& keyed : keys) bits = std::max(bits, bit_length(rows[keyed.row][c]));
    if (bits == 0) continue;
    const int taken = std::min(bits + 1, left), dropped = bits + 1 - taken;
    for (KeyedRow& keyed : keys) {
      internal::cancellation_point();
      const Integer& entry = rows[keyed.row][c];
      if (bits < 62) {  // the same in numbers of one word
        const auto small = static_cast<std::int64_t>(entry);
        const std::int64_t above = (is_reversed ? -small : small) + (std::int64_t{1} << bits);
        keyed.key = keyed.key << taken | static_cast<std::uint64_t>(above) >> dropped;
        continue;
      }
      Integer above = is_reversed ? Integer(-entry) : entry;  // 0 … 2^(bits + 1), without the end
      above += Integer(1) << static_cast<unsigned>(bits);
      keyed.key = keyed.key << taken | static_cast<std::uint64_t>(above >> static_cast<unsigned>(dropped));
    }
    left -= taken;
  }
}

/// Adds keys of vertices by the first coordinate, times a power of two, without what is behind the point.
void add_first_coordinates(const Rows& rows, std::vector<KeyedRow>& keys) {
  if (keys.empty() || rows[keys.front().row].size() < 2) return;
  int most = -bits_of_keys;  // coordinates are below 2^most
  for (const KeyedRow& keyed : keys) {
    const Row& row = rows[keyed.row];
    if (row[0] != 0) most = std::max(most, bit_length(row[0]) - bit_length(row.back()) + 1);
  }
  const int shift = bits_of_keys - 1 - most;
  for (KeyedRow& keyed : keys) {
    internal::cancellation_point();
    const Row& row = rows[keyed.row];
    const Integer quotient = shift >= 0 ? Integer((row[0] << static_cast<unsigned>(shift)) / row.back())
                                        : Integer(row[0] / (row.back() << static_cast<unsigned>(-shift)));
    keyed.key = static_cast<std::uint64_t>(static_cast<std::int64_t>(quotient) +
                                           (std::int64_t{1} << (bits_of_keys - 1)));
  }
}

/// Sorts by a total order: parts, each twice as long as those of the round before.
template <class Precedes>
void sort_in_parts(std::vector<KeyedRow>& keys, unsigned threads, const Precedes& before) {
  constexpr std::size_t parts = 8, few = 10000;
  const auto at = [&](std::size_t i) { return keys.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t n = keys.size();
  if (n < few) threads = 1;
  const auto stopping = [&](const internal::StopPoint& stop) {
    return [&](const KeyedRow& a, const KeyedRow& b) {
      if (a.key != b.key) return a.key < b.key;
      stop();
      return before(a.row, b.row);
    };
  };
  std::size_t part = threads == 1 ? n : (n + parts - 1) / parts;
  internal::for_parts(threads, n, part,
                      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                        std::sort(at(first), at(last), stopping(stop));
                      });
  for (; part < n; part *= 2)
    internal::for_parts(threads, n, 2 * part,
                        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                          if (last - first > part)
                            std::inplace_merge(at(first), at(first + part), at(last), stopping(stop));
                        });
}

template <class Precedes>
std::vector<std::size_t> sort_by(Rows& rows, std::vector<KeyedRow>& keys, unsigned threads,
                                 const Precedes& before) {
  sort_in_parts(keys, threads, [&](std::size_t a, std::size_t b) { return before(rows[a], rows[b]); });
  std::vector<std::size_t> order;
  order.reserve(rows.size());
  Rows sorted;
  sorted.reserve(rows.size());
  for (const KeyedRow& keyed : keys) {
    order.push_back(keyed.row);
    sorted.push_back(std::move(rows[keyed.row]));
  }
  rows = std::move(sorted);
  return order;
}

}  // namespace

std::vector<std::size_t> sort_inequalities(Rows& rows, unsigned threads) {
  std::vector<KeyedRow> keys;
  keys.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) keys.push_back({0, i});
  add_entries(rows, keys, true);
  return sort_by(rows, keys, threads, precedes_as_inequality);
}

std::vector<std::size_t> sort_generators(Rows& rows, unsigned threads) {
  std::vector<KeyedRow> vertices, rays;
  bool has_one_denominator = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    (is_point(rows[i]) ? vertices : rays).push_back({0, i});
    if (is_point(rows[i]))
      has_one_denominator = has_one_denominator && rows[i].back() == rows[vertices.front().row].back();
  }
  if (has_one_denominator)
    add_entries(rows, vertices, false);
  else
    add_first_coordinates(rows, vertices);
  add_entries(rows, rays, false);
  for (KeyedRow& keyed : rays) {
    keyed.key |= std::uint64_t{1} << bits_of_keys;
    vertices.push_back(keyed);
  }
  return sort_by(rows, vertices, threads, precedes);
}

}  // namespace delone::polyhedra
