// SPDX-License-Identifier: BSD-3-Clause
// Rows sorted along a Hilbert curve of any dimension by recursive median splits: RR-6743, appendix A, with
// the curve of Hamilton and Rau-Chaplin, "Compact Hilbert indices", doi:10.1016/j.ipl.2007.08.034, followed
// one bit at a time.
//
// One level of the curve visits the 2^d subcubes i = 0 … 2^d−1 of a cube. Subcube i lies at the corner with
// the bits rotl(gc(i), δ+1) xor e: gc is the Gray code, e the corner at which the curve enters the cube, δ
// the axis along which entry and exit differ. Splitting the points in two halves for each bit of i, from the
// highest one, visits the axes δ, δ−1, …, δ+1 (mod d) once each. In the subcube the curve enters at e', along
// δ':
//   (1) corner bit on the axis of bit b = (bit b of i) xor (bit b+1 of i) xor e;
//   (2) e' = e for i = 0; otherwise the corner of i with bit 0 flipped, and bit ctz(i) flipped too if i is even;
//   (3) δ' = δ + 1 + (0 for i = 0; ctz(i) for even i; the number of trailing ones of i for odd i)  (mod d).
// So of i only the length of its last run of equal bits is kept, and e is overwritten by the corner.
#include "base/compiled_dimension.hpp"
#include "base/compiler.hpp"
#include "base/parallel.hpp"
#include "base/progress_meter.hpp"
#include "order/insertion_order.hpp"
#include "order/select.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace delone::order {
namespace {

/// Where a part of the points lies on the curve: the bits of i read so far, and the frame (e, δ) of the cube.
struct Position {
  /// Per axis: e, replaced by the bit of the subcube's corner once that axis is split.
  std::uint64_t corner = 0;
  int axis = 0;       ///< the axis of the next split
  int bits_read = 0;  ///< of i, at this level
  int run = 0;        ///< length of the last run of equal bits of i
  bool last_bit = false;
};

/// Steps on the curve. Halving fewer than 2^64 points never gets beyond bit 63 of i: for d ≥ 64 the first
/// level is never completed, no axis is split twice, and e, which is 0 on all axes still to come, need not
/// be stored.
class Curve {
 public:
  explicit Curve(int dimension) : dimension_(dimension) {}

  /// Whether the first half of the curve lies at the high end of the axis.
  bool first_is_high(const Position& p) const { return flipped(p, p.axis) != p.last_bit; }

  Position half(Position p, bool second) const {
    const bool high = first_is_high(p) != second;
    assign(p, p.axis, high);
    p.run = p.bits_read > 0 && p.last_bit == second ? p.run + 1 : 1;
    p.last_bit = second;
    if (++p.bits_read < dimension_) {
      p.axis = p.axis == 0 ? dimension_ - 1 : p.axis - 1;
      return p;
    }
    return next_level(p);
  }

 private:
  /// All bits of i are read; the axis split last is that of bit 0, δ+1.
  Position next_level(Position p) const {
    const bool even = !p.last_bit;
    const bool zero = even && p.run == dimension_;
    const int bit_0 = p.axis;
    Position next;
    next.corner = p.corner;
    if (!zero) {
      assign(next, bit_0, !flipped(next, bit_0));
      if (even) {
        const int bit_run = (bit_0 + p.run) % dimension_;
        assign(next, bit_run, !flipped(next, bit_run));
      }
    }
    next.axis = (bit_0 + (zero ? 0 : p.run)) % dimension_;
    return next;
  }

  static bool flipped(const Position& p, int axis) { return axis < 64 && (p.corner >> axis & 1) != 0; }
  static void assign(Position& p, int axis, bool value) {
    if (axis < 64) p.corner = (p.corner & ~(std::uint64_t{1} << axis)) | (std::uint64_t{value} << axis);
  }

  int dimension_;
};

/// A row with its coordinates, so that sorting has no cache misses for the points.
template <int D>
struct PackedRow {
  std::array<double, static_cast<std::size_t>(D)> x;
  Index row;
};

/// A row with the one coordinate in use.
struct KeyedRow {
  double key;
  Index row;
};

/// Ties are broken by row, so the result is the same for every selection algorithm.
struct Less {
  std::size_t axis;
  double sign;
  template <class Packed>
  bool operator()(const Packed& a, const Packed& b) const {
    const double x = sign * a.x[axis], y = sign * b.x[axis];
    return (x < y) | ((x == y) & (a.row < b.row));
  }
  bool operator()(const KeyedRow& a, const KeyedRow& b) const {
    const double x = sign * a.key, y = sign * b.key;
    return (x < y) | ((x == y) & (a.row < b.row));
  }
};

template <class Packed>
void sort_packed(const Curve& curve, const Position& position, Packed* first, Packed* last) {
  const std::ptrdiff_t size = last - first;
  if (size < 2) return;
  Packed* middle = first + size / 2;
  split_at(first, middle, last,
           Less{static_cast<std::size_t>(position.axis), curve.first_is_high(position) ? -1.0 : 1.0});
  sort_packed(curve, curve.half(position, false), first, middle);
  sort_packed(curve, curve.half(position, true), middle, last);
}

template <int D>
void sort_by_halves(const Position& start, PointsView points, std::span<Index> rows) {
  std::vector<PackedRow<D>> packed(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double* x = points.data() + static_cast<std::size_t>(rows[i]) * D;
    std::copy_n(x, D, packed[i].x.begin());
    packed[i].row = rows[i];
  }
  sort_packed(Curve(D), start, packed.data(), packed.data() + packed.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = packed[i].row;
}

/// The curve as an automaton: a state for each frame (e, δ). In a cube, the place of a subcube some levels
/// below gives its number on the curve and the state in it. Each step depends on the one before, so a step
/// takes as many levels as a table in the L1 cache allows.
template <int D>
class Automaton {
 public:
  static constexpr int levels_per_step = D == 2 ? 4 : D == 3 ? 3 : 2;  // tables of 4, 24 and 32 KB
  static constexpr std::uint32_t num_corners = 1u << D, num_states = D << D;

  Automaton() {
    OneLevel one_level;
    const Curve curve(D);
    for (std::uint32_t state = 0; state < num_states; ++state)
      for (std::uint32_t digit = 0; digit < num_corners; ++digit) {
        Position p = position(state);
        std::uint32_t corner = 0;
        for (int b = D - 1; b >= 0; --b) {
          const bool second = (digit >> b & 1) != 0;
          corner |= static_cast<std::uint32_t>(curve.first_is_high(p) != second) << p.axis;
          p = curve.half(p, second);
        }
        one_level[state * num_corners + corner] = {digit, state_of(p)};
      }
    for (std::uint32_t state = 0; state < num_states; ++state)
      fill(one_level, state, levels_per_step, state << step_bits, 0);
  }

  /// The number on a curve of levels_per_step·steps levels of the cube with these integer coordinates.
  std::uint64_t number(const Position& start, const std::array<std::uint32_t, D>& cube, int steps) const {
    std::uint64_t number = 0;
    std::uint32_t state = state_of(start) << step_bits;
    for (int shift = levels_per_step * (steps - 1); shift >= 0; shift -= levels_per_step) {
      std::uint32_t place = 0;
      for (std::size_t j = 0; j < D; ++j) place |= (cube[j] >> shift & (side - 1)) << (j * levels_per_step);
      const std::uint32_t step = steps_[state | place];
      number = number << step_bits | (step & ((1u << step_bits) - 1));
      state = step & ~((1u << step_bits) - 1);
    }
    return number;
  }

 private:
  static constexpr int step_bits = D * levels_per_step;
  static constexpr std::uint32_t side = 1u << levels_per_step;

  struct Step {
    std::uint32_t digit, next;
  };
  using OneLevel = std::array<Step, std::size_t{num_states} * num_corners>;

  /// The entries whose highest levels are those of `entry`, where these lead to `state` and `number`.
  void fill(const OneLevel& one_level, std::uint32_t state, int levels_left, std::uint32_t entry,
            std::uint32_t number) {
    if (levels_left == 0) {
      steps_[entry] = static_cast<std::uint16_t>(state << step_bits | number);
      return;
    }
    for (std::uint32_t corner = 0; corner < num_corners; ++corner) {
      std::uint32_t below = entry;
      for (int j = 0; j < D; ++j) below |= (corner >> j & 1) << (j * levels_per_step + levels_left - 1);
      const auto [digit, next] = one_level[state * num_corners + corner];
      fill(one_level, next, levels_left - 1, below, number << D | digit);
    }
  }

  static std::uint32_t state_of(const Position& p) {
    return static_cast<std::uint32_t>(p.axis) << D | static_cast<std::uint32_t>(p.corner);
  }
  static Position position(std::uint32_t state) {
    Position p;
    p.corner = state & (num_corners - 1);
    p.axis = static_cast<int>(state >> D);
    return p;
  }

  /// At state·2^step_bits + the place in the cube, axis 0 in the lowest bits: next state·2^step_bits +
  /// number.
  std::array<std::uint16_t, std::size_t{num_states} << step_bits> steps_;
};

/// Sorts 64-bit words by the lowest `bits` bits of their upper halves, the others being equal, and writes
/// their lower halves to `rows`; equal numbers keep their order. Distributes by the highest bits first, so
/// that the rest happens in parts that fit the caches. `other` is memory of as many words. Calls
/// crowded(first, last) where more than `few` rows have one number. `threads` share the parts.
template <class Crowded>
void sort_by_number(std::uint64_t* words, std::uint64_t* other, std::size_t size, int bits, Index* rows,
                    std::uint32_t few, const Crowded& crowded, unsigned threads = 1) {
  constexpr int last_bits = 12, max_bits = 10;
  if (size == 0) return;
  internal::cancellation_point();
  if (bits <= last_bits) {
    std::array<std::uint32_t, std::size_t{1} << last_bits> begin;
    const std::size_t numbers = std::size_t{1} << bits;
    const auto number = [numbers](std::uint64_t word) { return word >> 32 & (numbers - 1); };
    std::fill_n(begin.begin(), numbers, 0u);
    std::uint32_t sum = 0, most = 0;
    for (std::size_t i = 0; i < size; ++i) most = std::max(most, ++begin[number(words[i])]);
    for (std::size_t i = 0; i < numbers; ++i) sum += std::exchange(begin[i], sum);
    for (std::size_t i = 0; i < size; ++i) rows[begin[number(words[i])]++] = static_cast<Index>(words[i]);
    if (most <= few) return;
    for (std::size_t i = 0, first = 0; i < numbers; first = begin[i++])
      if (begin[i] - first > few) crowded(rows + first, rows + begin[i]);
    return;
  }
  const int digit_bits = std::min(bits - last_bits, max_bits), shift = 32 + bits - digit_bits;
  const std::uint64_t mask = (std::uint64_t{1} << digit_bits) - 1;
  std::array<std::uint32_t, std::size_t{1} << max_bits> begin{};
  for (std::size_t i = 0; i < size; ++i) ++begin[words[i] >> shift & mask];
  std::uint32_t sum = 0;
  for (std::uint32_t& count : begin) sum += std::exchange(count, sum);
  for (std::size_t i = 0; i < size; ++i) other[begin[words[i] >> shift & mask]++] = words[i];
  const auto sort_parts = [&](std::size_t digit, std::size_t end) {
    for (std::size_t first = digit == 0 ? 0 : begin[digit - 1]; digit < end; first = begin[digit++])
      sort_by_number(other + first, words + first, begin[digit] - first, bits - digit_bits, rows + first, few,
                     crowded);
  };
  if (threads == 1) return sort_parts(0, mask + 1);
  internal::parallel_for(threads, mask + 1, 16, sort_parts);
}

/// Splits the box of the points into equal cubes, about one per point, and sorts the points by the cubes'
/// numbers on the curve: a few instructions per bit of the number, where halving takes a few passes over the
/// points. Only rows that share a cube are then sorted by halves.
template <int D>
void sort_by_cubes(const Position& start, PointsView points, std::span<Index> rows, unsigned threads) {
  static const Automaton<D> automaton;
  constexpr int levels_per_step = Automaton<D>::levels_per_step;
  const int levels =
      (static_cast<int>(std::bit_width(rows.size())) + D - 1) / D;  // D·levels is at most 32 + D − 1
  const int steps = (levels + levels_per_step - 1) / levels_per_step,
            spare = steps * levels_per_step - levels;
  const auto cubes = static_cast<double>(std::uint64_t{1} << levels);
  const std::size_t size = rows.size();
  // Holds the coordinates first, contiguous as they are read twice, and then the words to sort: memory that
  // is used twice has half of the page faults.
  const std::unique_ptr<std::uint64_t[]> memory(new std::uint64_t[D * size]);
  const auto point = [&](std::size_t i) { return points.data() + std::size_t{rows[i]} * D; };
  std::array<double, D> low, high, scale;
  std::copy_n(point(0), D, low.begin());
  high = low;
  constexpr std::size_t part = 16384;
  std::mutex mutex;
  internal::parallel_for(threads, size, part, [&](std::size_t first, std::size_t last) {
    std::array<double, D> least, most;
    std::copy_n(point(first), D, least.begin());
    most = least;
    for (std::size_t i = first; i < last; ++i) {
      constexpr std::size_t ahead = 32;
      const double* next = point(std::min(i + ahead, size - 1));
      internal::prefetch(next);
      internal::prefetch(next + D - 1);  // often in the next cache line
      for (std::size_t j = 0; j < D; ++j) {
        const double x = point(i)[j];
        memory[i * D + j] = std::bit_cast<std::uint64_t>(x);
        least[j] = std::min(least[j], x);
        most[j] = std::max(most[j], x);
      }
    }
    const std::lock_guard lock(mutex);
    for (std::size_t j = 0; j < D; ++j) {
      low[j] = std::min(low[j], least[j]);
      high[j] = std::max(high[j], most[j]);
    }
  });
  for (std::size_t j = 0; j < D; ++j) {
    scale[j] = cubes / (high[j] - low[j]);
    if (!(scale[j] > 0 && scale[j] < 1e300))
      return sort_by_halves<D>(start, points, rows);  // flat, tiny or huge
  }
  const auto word = [&](std::size_t i) {
    std::array<std::uint32_t, D> cube;
    for (std::size_t j = 0; j < D; ++j) {
      const double x = std::bit_cast<double>(memory[i * D + j]);
      cube[j] =
          static_cast<std::uint32_t>(static_cast<std::int32_t>(std::min((x - low[j]) * scale[j], cubes - 1)))
          << spare;
    }
    return automaton.number(start, cube, steps) >> (D * spare) << 32 | rows[i];
  };
  // The words replace the coordinates from the beginning on, so threads need memory of their own for them.
  std::unique_ptr<std::uint64_t[]> apart;
  std::uint64_t* words = memory.get();
  std::uint64_t* other = words + size;
  if (threads == 1) {
    for (std::size_t i = 0; i < size; ++i) words[i] = word(i);
  } else {
    apart.reset(new std::uint64_t[size]);
    words = apart.get();
    other = memory.get();
    internal::parallel_for(threads, size, part, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) words[i] = word(i);
    });
  }
  constexpr std::uint32_t few = 8;
  sort_by_number(
      words, other, size, D * levels, rows.data(), few,
      [&](Index* first, Index* last) {
        sort_by_halves<D>(start, points, {first, last});
      },
      threads);
}

template <int D>
void sort_in_dimension(const Position& start, PointsView points, std::span<Index> rows, unsigned threads) {
  constexpr std::size_t many = 1000;
  if (rows.size() < many || D * ((std::bit_width(rows.size()) + D - 1) / D) > 32 || sizeof(Index) > 4)
    sort_by_halves<D>(start, points, rows);
  else
    sort_by_cubes<D>(start, points, rows, threads);
}

/// Any dimension: the coordinate in use is gathered again for each split.
void sort_keyed(const Curve& curve, const Position& position, PointsView points, KeyedRow* first,
                KeyedRow* last) {
  const std::ptrdiff_t size = last - first;
  if (size < 2) return;
  internal::cancellation_point();
  const auto dimension = static_cast<std::size_t>(points.dimension()),
             axis = static_cast<std::size_t>(position.axis);
  for (KeyedRow* i = first; i != last; ++i)
    i->key = points.data()[static_cast<std::size_t>(i->row) * dimension + axis];
  KeyedRow* middle = first + size / 2;
  split_at(first, middle, last, Less{axis, curve.first_is_high(position) ? -1.0 : 1.0});
  sort_keyed(curve, curve.half(position, false), points, first, middle);
  sort_keyed(curve, curve.half(position, true), points, middle, last);
}

}  // namespace

void hilbert_sort(PointsView points, std::span<Index> rows, int first_axis, unsigned threads) {
  if (rows.size() < 2) return;
  Position start;
  start.axis = first_axis;
  internal::with_compiled_dimension<1, 4>(static_cast<std::size_t>(points.dimension()), [&](auto d) {
    if constexpr (d() > 1) {
      sort_in_dimension<d()>(start, points, rows, threads);
    } else if constexpr (d() == 1) {
      sort_by_halves<1>(start, points, rows);
    } else {
      std::vector<KeyedRow> keyed(rows.size());
      for (std::size_t i = 0; i < rows.size(); ++i) keyed[i] = {0, rows[i]};
      sort_keyed(Curve(points.dimension()), start, points, keyed.data(), keyed.data() + keyed.size());
      for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = keyed[i].row;
    }
  });
}

}  // namespace delone::order
