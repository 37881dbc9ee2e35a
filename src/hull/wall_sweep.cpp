// SPDX-License-Identifier: BSD-3-Clause
#include "hull/wall_sweep.hpp"

#include "base/compiled_dimension.hpp"
#include "kernel/buffer.hpp"
#include "kernel/determinant.hpp"
#include "kernel/predicates.hpp"
#include "kernel/stages.hpp"

#include <delone/error.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace delone::hull {
namespace {

/// As in the engine an infinite vertex is joined to every facet of the hull of the points so far, so that all
/// cells triangulate a sphere. An infinite cell that a point sees becomes finite, as that takes the place of
/// the infinite vertex. Cells are coherently oriented.
///
/// Points are numbered in their order from 1. Number 0 is the infinite vertex, always in slot 0 of a cell.
/// The dimension of the cells grows up to that of the wall; M is the latter, or 0 if it is chosen at run
/// time.
template <int M>
class WallSweep {
  static constexpr Index infinite = 0;

 public:
  WallSweep(const BoundarySites& sites, std::span<const Index> points)
      : sites_(sites), points_(points), m_(sites.dimension() - 1), hull_(sites.ambient) {
    cells_.reserve(2 * points.size() * size());
    neighbors_.reserve(cells_.capacity());
  }

  void run(const std::function<void(std::size_t)>& tick) {
    constexpr std::size_t step = 64;
    begin();
    for (std::size_t i = 2; i < points_.size(); ++i) {
      const Index number = static_cast<Index>(i) + 1;
      if (k_ < m_ && hull_.add(point(number)))
        raise_dimension(number);
      else if (k_ == m_)
        insert<M>(number);
      else
        insert<0>(number);
      if (i % step == 0) tick(i);
    }
  }

  /// The finite cells, once all points are there.
  SweptWall take_wall() {
    std::vector<Index> compact(num_cells(), invalid_index);
    Index count = 0;
    for (Index c = 0; c < num_cells(); ++c)
      if (!is_infinite(c)) compact[c] = count++;
    for (Index c = 0; c < num_cells(); ++c)
      for (std::size_t i = 0; i < size() && compact[c] != invalid_index; ++i) {
        vertex(compact[c], i) = points_[vertex(c, i) - 1];
        neighbor(compact[c], i) = compact[neighbor(c, i)];
      }
    cells_.resize(count * size());
    neighbors_.resize(cells_.size());
    return {size(), std::move(cells_), std::move(neighbors_)};
  }

 private:
  /// An infinite cell at the last point, and the slot of that.
  struct CellOfStar {
    Index cell;
    std::size_t slot;
  };

  /// Of vertices of a cell, in the end.
  std::size_t size() const { return static_cast<std::size_t>(M > 0 ? M : m_) + 1; }
  std::size_t num_cells() const { return cells_.size() / size(); }
  Index append() {
    if (num_cells() >= max_index)
      throw Error(Errc::too_many, "the hull has more cells than this build has ids");
    const auto cell = static_cast<Index>(num_cells());
    cells_.resize(cells_.size() + size());
    neighbors_.resize(cells_.size());
    return cell;
  }
  Index& vertex(Index cell, std::size_t slot) { return cells_[cell * size() + slot]; }
  Index vertex(Index cell, std::size_t slot) const { return cells_[cell * size() + slot]; }
  Index& neighbor(Index cell, std::size_t slot) { return neighbors_[cell * size() + slot]; }
  Index neighbor(Index cell, std::size_t slot) const { return neighbors_[cell * size() + slot]; }
  bool is_infinite(Index cell) const { return vertex(cell, 0) == infinite; }
  const double* point(Index number) const { return sites_.point(points_[number - 1]); }
  /// A segment and its ends. In one dimension infinite cells with the infinite vertex in slot 0 are oriented
  /// coherently at one end only. It is the upper one: at the other one there is never a point.
  void begin() {
    hull_.add(point(1));
    hull_.add(point(2));
    for (const auto& cell : {std::array<Index, 2>{2, 1}, {infinite, 2}, {infinite, 1}}) {
      const Index made = append();
      for (const std::size_t i : {0, 1}) {
        vertex(made, i) = cell[i];
        // Each is next to both others.
        neighbor(made, i) = made == 0 ? static_cast<Index>(2 - i) : i == 0 ? 0 : 3 - made;
      }
    }
    stars_ = {{1, 1}};
  }
  /// The infinite cell at the lower end of a line.
  static constexpr Index lower_end = 2;

  /// The slot of a neighbor across which another one is.
  std::size_t slot_of_neighbor(Index cell, Index other) const {
    std::size_t slot = 0;
    while (neighbor(cell, slot) != other) ++slot;
    return slot;
  }

  /// That of three points of a plane, if it is certain: on a line where a coordinate is constant, as in
  /// lattices, or beyond the error. Each product meets five roundings (docs/predicates.md, "By minors"). Two
  /// that underflow are off by less than 2^−1000; what overflows is never certain.
  std::optional<Sign> certain_orientation(Index p, Index a, Index b) const {
    const double *const x = plane_.data() + 2 * p, *const y = plane_.data() + 2 * a,
                        *const z = plane_.data() + 2 * b;
    if ((y[0] == x[0] && z[0] == x[0]) || (y[1] == x[1] && z[1] == x[1])) return Sign::zero;
    const double plus = (y[0] - x[0]) * (z[1] - x[1]), minus = (y[1] - x[1]) * (z[0] - x[0]);
    const double error = 1.01 * 5 * kernel::unit_roundoff * (std::fabs(plus) + std::fabs(minus)) + 0x1p-1000;
    if (plus - minus > error) return Sign::positive;
    if (plus - minus < -error) return Sign::negative;
    return std::nullopt;
  }
  /// The orientation of a cell with a point in slot 0. K is k_, or 0.
  template <int K>
  Sign orientation_with(Index cell, Index number) const {
    if constexpr (K == 2)
      if (const auto sign = certain_orientation(number, vertex(cell, 1), vertex(cell, 2))) return *sign;
    const auto k = static_cast<std::size_t>(K > 0 ? K : k_);
    kernel::Buffer<const double*, K + (K > 0)> points(k + 1);
    points[0] = point(number);
    for (std::size_t i = 1; i <= k; ++i) points[i] = point(vertex(cell, i));
    return kernel::orientation<K>(hull_.flat(), points.data(), sites_.grid);
  }

  /// A point that is in the flat of those before. It sees a facet at the last of them: otherwise it would be
  /// in the cone of the hull at that point, which has no direction that increases.
  template <int K>
  void insert(Index number) {
    const auto k = static_cast<std::size_t>(K > 0 ? K : k_);
    const auto finish = [&](Index cell) {
      vertex(cell, 0) = number;
      zone_.push_back(cell);
    };
    const auto finish_if_seen = [&](Index cell) {
      if (is_infinite(cell) && orientation_with<K>(cell, number) == orientation_) finish(cell);
    };
    zone_.clear();
    if (k == 1) {
      finish(stars_[0].cell);
    } else {
      for (const CellOfStar& star : stars_) finish_if_seen(star.cell);
      for (std::size_t next = 0; next < zone_.size(); ++next)
        for (std::size_t i = 1; i <= k; ++i) finish_if_seen(neighbor(zone_[next], i));
    }
    stars_.clear();
    for (const Index cell : zone_)
      for (std::size_t i = 1; i <= k; ++i) {
        const Index beyond = neighbor(cell, i);
        if (!is_infinite(beyond)) continue;
        const Index made = append();
        for (std::size_t j = 1; j <= k; ++j) vertex(made, j) = vertex(cell, j);
        vertex(made, 0) = infinite;
        vertex(made, i) = number;
        neighbor(beyond, slot_of_neighbor(beyond, cell)) = made;
        neighbor(made, i) = beyond;
        neighbor(made, 0) = cell;
        neighbor(cell, i) = made;
        stars_.push_back({made, i});
      }
    for (const CellOfStar& star : stars_)
      for (std::size_t i = 1; i <= k; ++i)
        if (i != star.slot) neighbor(star.cell, i) = across_zone(neighbor(star.cell, 0), star.slot, i);
  }

  /// The infinite cell at the end of a rotation about the face of a cell without the vertices in two slots,
  /// across the facet opposite the second one.
  Index across_zone(Index cell, std::size_t from, std::size_t to) const {
    for (;;) {
      const Index next = neighbor(cell, to);
      if (is_infinite(next)) return next;
      const std::size_t opposite = slot_of_neighbor(next, cell);
      std::size_t slot = 0;
      while (vertex(next, slot) != vertex(cell, from)) ++slot;
      from = opposite;
      to = slot;
      cell = next;
    }
  }

  /// A point outside of the flat of those before: all cells are joined to it, and the finite ones to the
  /// infinite vertex, too.
  void raise_dimension(Index number) {
    const auto k = static_cast<std::size_t>(k_);
    const auto num_old = static_cast<Index>(num_cells());
    std::vector<Index> joined_to_infinite(num_old);
    for (Index c = 0; c < num_old; ++c)
      if (!is_infinite(c)) joined_to_infinite[c] = append();
    // A facet that is joined to the infinite vertex is one of the cell made of a finite cell, or of the
    // infinite one at the facet.
    const auto infinite_cell_of = [&](Index c) { return is_infinite(c) ? c : joined_to_infinite[c]; };
    stars_.clear();
    for (Index c = 0; c < num_old; ++c) {
      vertex(c, k + 1) = number;
      if (is_infinite(c)) {
        neighbor(c, k + 1) = joined_to_infinite[neighbor(c, 0)];
        stars_.push_back({c, k + 1});
        continue;
      }
      // The exchange of two vertices gives it the opposite orientation, as the two are on opposite sides of
      // the old cell.
      const Index made = joined_to_infinite[c];
      vertex(made, 0) = infinite;
      vertex(made, k + 1) = vertex(c, 0);
      neighbor(made, 0) = c;
      neighbor(made, k + 1) = infinite_cell_of(neighbor(c, 0));
      for (std::size_t i = 1; i <= k; ++i) {
        vertex(made, i) = vertex(c, i);
        neighbor(made, i) = infinite_cell_of(neighbor(c, i));
      }
      neighbor(c, k + 1) = made;
    }
    if (k == 1) {  // now it can be oriented as the others are
      std::swap(vertex(lower_end, 1), vertex(lower_end, 2));
      std::swap(neighbor(lower_end, 1), neighbor(lower_end, 2));
      for (CellOfStar& star : stars_)
        if (star.cell == lower_end) star.slot = 1;
    }
    ++k_;
    orientation_ = orientation_with<0>(0, vertex(0, 0));
    if (k_ == M && M == 2) {
      plane_.assign(2, 0);  // of the infinite vertex, whose point nobody asks for
      for (const Index site : points_)
        for (const int axis : hull_.axes()) plane_.push_back(sites_.point(site)[axis]);
    }
  }

  const BoundarySites& sites_;
  std::span<const Index> points_;
  int m_;
  int k_ = 1;                      // the dimension of the cells
  kernel::AffineHull hull_;        // of the points so far
  Sign orientation_ = Sign::zero;  // of finite cells, on the axes of that, from k = 2 on
  std::vector<Index> cells_, neighbors_;
  std::vector<double> plane_;  // for M = 2, the points on the axes of the wall, by number
  std::vector<Index> zone_;    // what the last point sees
  std::vector<CellOfStar> stars_;
};

}  // namespace

SweptWall sweep_wall(const BoundarySites& sites, std::span<const Index> sites_of_wall,
                     const std::function<void(std::size_t)>& tick) {
  return internal::with_compiled_dimension<1, 3>(static_cast<std::size_t>(sites.dimension() - 1),
                                                 [&](auto m) {
                                                   WallSweep<m()> sweep(sites, sites_of_wall);
                                                   sweep.run(tick);
                                                   return sweep.take_wall();
                                                 });
}

}  // namespace delone::hull
