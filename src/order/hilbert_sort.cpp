// SPDX-License-Identifier: BSD-3-Clause
// Rows sorted along a Hilbert curve of any dimension by recursive median splits: RR-6743, appendix A, with the curve of
// Hamilton and Rau-Chaplin, "Compact Hilbert indices", doi:10.1016/j.ipl.2007.08.034, followed one bit at a time.
//
// One level of the curve visits the 2^d subcubes i = 0 … 2^d−1 of a cube. Subcube i lies at the corner with the bits
// rotl(gc(i), δ+1) xor e: gc is the Gray code, e the corner at which the curve enters the cube, δ the axis along which
// entry and exit differ. Splitting the points in two halves for each bit of i, from the highest one, visits the axes
// δ, δ−1, …, δ+1 (mod d) once each. In the subcube the curve enters at e', along δ':
//   (1) corner bit on the axis of bit b = (bit b of i) xor (bit b+1 of i) xor e;
//   (2) e' = e for i = 0; otherwise the corner of i with bit 0 flipped, and bit ctz(i) flipped too if i is even;
//   (3) δ' = δ + 1 + (0 for i = 0; ctz(i) for even i; the number of trailing ones of i for odd i)  (mod d).
// So the length of the last run of equal bits of i is all there is to remember of i, and e is overwritten by the corner.
#include "order/insertion_order.hpp"
#include "order/select.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace delone::order {
namespace {

/// Where a part of the points lies on the curve: the bits of i read so far, and the frame (e, δ) of the cube.
struct Position {
  std::uint64_t corner = 0;  ///< per axis: e, replaced by the bit of the subcube's corner once that axis is split
  int axis = 0;              ///< the axis of the next split
  int bits_read = 0;         ///< of i, at this level
  int run = 0;               ///< length of the last run of equal bits of i
  bool last_bit = false;
};

/// Steps on the curve. Halving fewer than 2^64 points never gets beyond bit 63 of i: for d ≥ 64 the first level is never
/// completed, no axis is split twice, and e = 0 on all axes still to come needs no storage.
class Curve {
 public:
  explicit Curve(int dimension) : dimension_(dimension) {}

  /// Does the first half of the curve lie at the high end of the axis?
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

/// A row with its coordinates beside it: no access to far memory while sorting.
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
  split_at(first, middle, last, Less{static_cast<std::size_t>(position.axis), curve.first_is_high(position) ? -1.0 : 1.0});
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

/// The curve as an automaton: a state for each frame (e, δ); the corner of a subcube gives its number on the curve and the
/// state in it.
template <int D>
class Automaton {
 public:
  static constexpr std::uint32_t num_corners = 1u << D, num_states = D << D;
  struct Step {
    std::uint8_t digit, next;
  };

  Automaton() {
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
        steps_[state * num_corners + corner] = {static_cast<std::uint8_t>(digit), static_cast<std::uint8_t>(state_of(p))};
      }
  }
  Step step(std::uint32_t state, std::uint32_t corner) const { return steps_[state * num_corners + corner]; }

  static std::uint32_t state_of(const Position& p) {
    return static_cast<std::uint32_t>(p.axis) << D | static_cast<std::uint32_t>(p.corner);
  }
  static Position position(std::uint32_t state) {
    Position p;
    p.corner = state & (num_corners - 1);
    p.axis = static_cast<int>(state >> D);
    return p;
  }

 private:
  std::array<Step, std::size_t{num_states} * num_corners> steps_;
};

/// Sorts 64-bit words by their upper halves, of which only the lowest `bits` bits are not zero.
void sort_by_upper_half(std::vector<std::uint64_t>& words, int bits) {
  constexpr int digit_bits = 11;
  std::vector<std::uint64_t> other(words.size());
  for (int shift = 32; shift < 32 + bits; shift += digit_bits) {
    std::array<std::size_t, std::size_t{1} << digit_bits> begin{};
    const auto digit = [shift](std::uint64_t word) { return word >> shift & ((std::uint64_t{1} << digit_bits) - 1); };
    for (const std::uint64_t word : words) ++begin[digit(word)];
    std::size_t sum = 0;
    for (std::size_t& count : begin) sum += std::exchange(count, sum);
    for (const std::uint64_t word : words) other[begin[digit(word)]++] = word;
    words.swap(other);
  }
}

/// Splits the box of the points into equal cubes, about one per point, and sorts the points by the cubes' numbers on the curve:
/// a few instructions per bit, where halving takes a few passes. Halves only what is left together in one cube.
template <int D>
void sort_by_cubes(const Position& start, PointsView points, std::span<Index> rows) {
  static const Automaton<D> automaton;
  const int levels = (static_cast<int>(std::bit_width(rows.size())) + D - 1) / D;  // D·levels is at most 32 + D − 1
  const auto cubes = static_cast<double>(std::uint64_t{1} << levels);
  std::vector<std::array<double, D>> near(rows.size());  // the points beside each other: they are read twice
  std::array<double, D> low, high, scale;
  std::copy_n(points.data() + std::size_t{rows[0]} * D, D, low.begin());
  high = low;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < D; ++j) {
      const double x = near[i][j] = points.data()[std::size_t{rows[i]} * D + j];
      low[j] = std::min(low[j], x);
      high[j] = std::max(high[j], x);
    }
  for (std::size_t j = 0; j < D; ++j) {
    scale[j] = cubes / (high[j] - low[j]);
    if (!(scale[j] > 0 && scale[j] < 1e300)) return sort_by_halves<D>(start, points, rows);  // flat, tiny or huge
  }
  std::vector<std::uint64_t> words(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::array<std::uint32_t, D> cube;
    for (std::size_t j = 0; j < D; ++j)
      cube[j] = static_cast<std::uint32_t>(std::min((near[i][j] - low[j]) * scale[j], cubes - 1));
    std::uint32_t state = Automaton<D>::state_of(start);
    std::uint64_t number = 0;
    for (int level = levels - 1; level >= 0; --level) {
      std::uint32_t corner = 0;
      for (std::size_t j = 0; j < D; ++j) corner |= (cube[j] >> level & 1) << j;
      const auto [digit, next] = automaton.step(state, corner);
      number = number << D | digit;
      state = next;
    }
    words[i] = number << 32 | rows[i];
  }
  sort_by_upper_half(words, D * levels);
  constexpr std::size_t few = 8;
  for (std::size_t first = 0, last; first < rows.size(); first = last) {
    for (last = first; last < rows.size() && words[last] >> 32 == words[first] >> 32; ++last)
      rows[last] = static_cast<Index>(words[last]);
    if (last - first > few) sort_by_halves<D>(start, points, rows.subspan(first, last - first));
  }
}

template <int D>
void sort_in_dimension(const Position& start, PointsView points, std::span<Index> rows) {
  constexpr std::size_t many = 1000;
  if (rows.size() < many || D * ((std::bit_width(rows.size()) + D - 1) / D) > 32 || sizeof(Index) > 4)
    sort_by_halves<D>(start, points, rows);
  else
    sort_by_cubes<D>(start, points, rows);
}

/// Any dimension: the coordinate in use is gathered anew for each split.
void sort_keyed(const Curve& curve, const Position& position, PointsView points, KeyedRow* first, KeyedRow* last) {
  const std::ptrdiff_t size = last - first;
  if (size < 2) return;
  const auto dimension = static_cast<std::size_t>(points.dimension()), axis = static_cast<std::size_t>(position.axis);
  for (KeyedRow* i = first; i != last; ++i) i->key = points.data()[static_cast<std::size_t>(i->row) * dimension + axis];
  KeyedRow* middle = first + size / 2;
  split_at(first, middle, last, Less{axis, curve.first_is_high(position) ? -1.0 : 1.0});
  sort_keyed(curve, curve.half(position, false), points, first, middle);
  sort_keyed(curve, curve.half(position, true), points, middle, last);
}

}  // namespace

void hilbert_sort(PointsView points, std::span<Index> rows, int first_axis) {
  if (rows.size() < 2) return;
  Position start;
  start.axis = first_axis;
  switch (points.dimension()) {
    case 1:
      return sort_by_halves<1>(start, points, rows);
    case 2:
      return sort_in_dimension<2>(start, points, rows);
    case 3:
      return sort_in_dimension<3>(start, points, rows);
    case 4:
      return sort_in_dimension<4>(start, points, rows);
    default:
      break;
  }
  std::vector<KeyedRow> keyed(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) keyed[i] = {0, rows[i]};
  sort_keyed(Curve(points.dimension()), start, points, keyed.data(), keyed.data() + keyed.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = keyed[i].row;
}

}  // namespace delone::order
