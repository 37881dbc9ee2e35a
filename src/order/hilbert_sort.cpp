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

#include <array>
#include <cstddef>

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
void sort_in_dimension(PointsView points, std::span<Index> rows, const Position& start) {
  std::vector<PackedRow<D>> packed(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double* x = points.data() + static_cast<std::size_t>(rows[i]) * D;
    std::copy_n(x, D, packed[i].x.begin());
    packed[i].row = rows[i];
  }
  sort_packed(Curve(D), start, packed.data(), packed.data() + packed.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = packed[i].row;
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
      return sort_in_dimension<1>(points, rows, start);
    case 2:
      return sort_in_dimension<2>(points, rows, start);
    case 3:
      return sort_in_dimension<3>(points, rows, start);
    case 4:
      return sort_in_dimension<4>(points, rows, start);
    default:
      break;
  }
  std::vector<KeyedRow> keyed(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) keyed[i] = {0, rows[i]};
  sort_keyed(Curve(points.dimension()), start, points, keyed.data(), keyed.data() + keyed.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = keyed[i].row;
}

}  // namespace delone::order
