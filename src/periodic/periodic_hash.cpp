// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/periodic_hash.hpp"

#include "base/quick_rounds.hpp"
#include "base/random.hpp"
#include "complex/canonical_hash.hpp"
#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"
#include "periodic/cell_classes.hpp"
#include "periodic/lattice_reduction.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace delone::periodic {

namespace {

using complex::PointTag;
using kernel::Integer;

/// Numbers one after the other as a tag.
class Tagger {
 public:
  void add(std::uint64_t word) {
    tag_.high = random::mix(tag_.high + 0x9e3779b97f4a7c15u + word);
    tag_.low = random::mix((tag_.low ^ word) + 0xd1342543de82ef95u);
  }
  void add(const Integer& number) {
    add(std::uint64_t{number < 0});
    Integer rest = number < 0 ? Integer(-number) : number;
    do {
      add(static_cast<std::uint64_t>(rest & std::numeric_limits<std::uint64_t>::max()));
      rest >>= 64;
    } while (rest != 0);
  }
  PointTag tag() const { return tag_; }

 private:
  PointTag tag_{0x452821e638d01377u, 0xbe5466cf34e90c6cu};  // digits of π, others than those of point_tag()
};

Integer floor_quotient(const Integer& a, const Integer& b) {
  Integer quotient = a / b;
  if (quotient * b > a) quotient -= 1;
  return quotient;
}

}  // namespace

/// Rows in echelon form with positive pivots, and what is above a pivot at least 0 and below it.
class PeriodicTags::HermiteForm {
 public:
  HermiteForm(std::vector<Integer> rows, std::size_t rank, std::size_t width)
      : rows_(std::move(rows)), width_(width) {
    std::size_t column = 0;
    for (std::size_t row = 0; row < rank; ++row) {
      while (!eliminate(row, rank, column)) ++column;
      pivots_.push_back(column);
      for (std::size_t above = 0; above < row; ++above)
        add(above, -floor_quotient(at(above, column), at(row, column)), row);
      ++column;
    }
  }

  const std::vector<Integer>& rows() const { return rows_; }
  /// The translate of x that has coordinates at the pivots that are at least 0 and below them.
  void reduce(std::vector<Integer>& x) const {
    for (std::size_t row = 0; row < pivots_.size(); ++row) {
      const Integer factor = floor_quotient(x[pivots_[row]], at(row, pivots_[row]));
      if (factor == 0) continue;
      for (std::size_t j = 0; j < width_; ++j) x[j] -= factor * at(row, j);
    }
  }

 private:
  Integer& at(std::size_t row, std::size_t column) { return rows_[row * width_ + column]; }
  const Integer& at(std::size_t row, std::size_t column) const { return rows_[row * width_ + column]; }
  void add(std::size_t to, const Integer& factor, std::size_t from) {
    for (std::size_t j = 0; j < width_; ++j) at(to, j) += factor * at(from, j);
  }
  /// Euclid's algorithm on a column of the rows from `first` on; false if it is 0 there.
  bool eliminate(std::size_t first, std::size_t rank, std::size_t column) {
    for (;;) {
      std::size_t least = rank, others = 0;
      for (std::size_t row = first; row < rank; ++row) {
        if (at(row, column) == 0) continue;
        ++others;
        if (least == rank || abs(at(row, column)) < abs(at(least, column))) least = row;
      }
      if (least == rank) return false;
      if (least != first)
        for (std::size_t j = 0; j < width_; ++j) std::swap(at(least, j), at(first, j));
      if (at(first, column) < 0)
        for (std::size_t j = 0; j < width_; ++j) at(first, j) = -at(first, j);
      if (others == 1) return true;
      for (std::size_t row = first + 1; row < rank; ++row)
        add(row, -floor_quotient(at(row, column), at(first, column)), first);
    }
  }

  std::vector<Integer> rows_;
  std::size_t width_;
  std::vector<std::size_t> pivots_;
};

PeriodicTags::PeriodicTags(const PeriodicSet& set, int grid)
    : set_(set), grid_(grid == no_grid ? 0 : grid), x_(set.dimension) {
  std::vector<Integer> rows;
  for (std::size_t i = 0; i < set.rank; ++i)
    for (std::size_t j = 0; j < set.dimension; ++j)
      rows.push_back(kernel::scaled_integer(set.period.vector(i)[j], grid_));
  form_ = std::make_unique<const HermiteForm>(std::move(rows), set.rank, set.dimension);
}

PeriodicTags::~PeriodicTags() = default;

PointTag PeriodicTags::of_lattice() const {
  Tagger tagger;
  tagger.add(static_cast<std::uint64_t>(set_.rank));
  tagger.add(static_cast<std::uint64_t>(std::int64_t{grid_} + set_.scale));
  tagger.add(std::bit_cast<std::uint64_t>(set_.unit));
  for (const Integer& one : form_->rows()) tagger.add(one);
  return tagger.tag();
}

PointTag PeriodicTags::of_vertex(const double* point, bool with_weight) {
  for (std::size_t j = 0; j < x_.size(); ++j) x_[j] = kernel::scaled_integer(point[j], grid_);
  form_->reduce(x_);
  Tagger tagger;
  for (const Integer& one : x_) tagger.add(one);
  if (with_weight)
    tagger.add(std::bit_cast<std::uint64_t>(std::ldexp(point[set_.dimension], 2 * set_.scale) + 0.0));
  return tagger.tag();
}

PointTag PeriodicTags::of_difference(std::span<const std::uint64_t> units) const {
  Tagger tagger;
  for (const std::uint64_t one : units) tagger.add(one);
  return tagger.tag();
}

int finest_bit(const double* x, std::size_t d) {
  int grid = no_grid;
  for (std::size_t j = 0; j < d; ++j) grid = std::min(grid, kernel::trailing_exponent(x[j]));
  return grid;
}

int finest_bit(const Period& period) {
  int grid = no_grid;
  for (std::size_t i = 0; i < period.rank(); ++i)
    grid = std::min(grid, finest_bit(period.vector(i), period.dimension()));
  return grid;
}

CanonicalHash hash_of(const GhostTriangulation& ghosts, const PeriodicSet& set) {
  const Complex complex = ghosts.triangulation().complex();
  const auto& points = triangulation::StoredPoints::of(ghosts.triangulation());
  const std::size_t d = set.dimension;
  std::vector<VertexId> own;
  for (const VertexId v : complex.finite_vertices())
    if (ghosts.is_own(v)) own.push_back(v);
  int grid = finest_bit(set.period);
  for (const VertexId v : own) grid = std::min(grid, finest_bit(points.point(index(v)), d));
  PeriodicTags tagger(set, grid);
  complex::HashAccumulator hash;
  hash.add_vertex(tagger.of_lattice());
  const bool with_weights = set.weighted && std::any_of(own.begin(), own.end(), [&](VertexId v) {
                              return points.point(index(v))[d] != points.point(index(own.front()))[d];
                            });
  std::vector<PointTag> tags(complex.num_vertex_slots());
  internal::QuickRounds round;
  for (const VertexId v : own) {
    round();
    hash.add_vertex(tags[index(v)] = tagger.of_vertex(points.point(index(v)), with_weights));
  }
  const CanonicalCells canonical = find_canonical_cells(ghosts);
  std::vector<std::uint64_t> units(d);
  for (std::size_t number = 0; number < canonical.cells.size(); ++number) {
    round();
    const VertexId smallest = canonical.smallest[number];
    const double* const from = points.point(index(smallest));
    PointTag sum = tags[index(smallest)];
    for (const VertexId v : complex.vertices(canonical.cells[number])) {
      const double* const to = points.point(index(v));
      for (std::size_t j = 0; j < d; ++j) units[j] = tagger.units(to[j]) - tagger.units(from[j]);
      sum += tagger.of_difference(units);
    }
    hash.add_cell(sum);
  }
  return hash.finish(static_cast<int>(d), complex.affine_dimension());
}

}  // namespace delone::periodic
