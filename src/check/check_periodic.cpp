// SPDX-License-Identifier: BSD-3-Clause
// The levels of check() for periodic triangulations.
//
// Why they suffice if all directions of the flat are periodic (r = k). The cells are closed up along their
// facets, mutually and with their offsets (level 2), every cell is positively oriented and neighbors lie on
// different sides of their facets (level 4): so the cells are mapped to the torus without a fold, and every
// point of general position is covered the same number of times. The volumes add up to that of the torus, so
// that number is one. Local convexity of the lifted surface, which is convex in the whole space as it is so
// at each facet, is the empty-sphere property. If some directions are free, the cells form a slab or a prism
// instead: its outer facets are parallel to the lattice and convex where they meet (level 5), every facet is
// in two cells or outside once, and Euler's number is 0 (level 3).
#include "check/check_periodic.hpp"

#include "base/quick_rounds.hpp"
#include "base/random.hpp"
#include "check/levels.hpp"
#include "check/periodic_cells.hpp"
#include "complex/canonical_hash.hpp"
#include "kernel/predicates.hpp"

#include <delone/periodic.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace delone::internal {

namespace {

using complex::PointTag;
using Vertices = std::vector<PeriodicVertex>;

void require_size(std::size_t found, std::size_t expected, const char* what) {
  if (found != expected) throw Violation{fmt::format("{} {} instead of {}", found, what, expected)};
}

void check_sizes(const ComplexData& data) {
  const int d = data.dimension, k = data.affine_dimension;
  if (d < 1) throw Violation{fmt::format("the dimension is {}, less than 1", d)};
  if (k < -1 || k > d) throw Violation{fmt::format("the affine dimension is {}, outside -1...{}", k, d)};
  if (data.points.size() % static_cast<std::size_t>(d) != 0 ||
      data.lattice.size() % static_cast<std::size_t>(d) != 0)
    throw Violation{fmt::format("the coordinates of points and lattice are no vectors of {} numbers", d)};
  const std::size_t n = data.num_points(), corners = static_cast<std::size_t>(k + 1), r = data.rank();
  if (k < 0 && !data.cells.empty()) throw Violation{"there are cells, but the affine dimension is -1"};
  if (k >= 0 && data.cells.size() % corners != 0)
    throw Violation{fmt::format("{} cell vertices are not a multiple of {}", data.cells.size(), corners)};
  require_size(data.cell_offsets.size(), data.cells.size() * r, "numbers in cell_offsets");
  require_size(data.neighbors.size(), data.cells.size(), "neighbors");
  require_size(data.neighbor_offsets.size(), data.cells.size() * r, "numbers in neighbor_offsets");
  require_size(data.weights.size(), data.kind == DataKind::periodic_regular ? n : 0, "weights");
  if (!data.vertex_of_point.empty())
    require_size(data.vertex_of_point.size(), n, "entries in vertex_of_point");
  if (!data.point_offsets.empty()) require_size(data.point_offsets.size(), n * r, "numbers in point_offsets");
  const auto require_range = [](std::span<const SignedIndex> rows, std::size_t width, SignedIndex least,
                                std::size_t count, const char* what) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i] < least || (rows[i] >= 0 && static_cast<std::size_t>(rows[i]) >= count))
        throw Violation{fmt::format("{} of row {} is {}, but there are {}", what, i / width, rows[i], count)};
  };
  require_range(data.cells, std::max<std::size_t>(corners, 1), 0, n, "a vertex");
  require_range(data.neighbors, std::max<std::size_t>(corners, 1), -1, data.num_cells(), "a neighbor");
  require_range(data.vertex_of_point, 1, -1, n, "vertex_of_point");
}

class PeriodicCheck {
 public:
  PeriodicCheck(const ComplexData& data, bool is_canonical)
      : data_(data),
        cells_(data),
        is_canonical_(is_canonical),
        corners_(cells_.corners()),
        r_(cells_.rank()) {
    if (cells_.affine_dimension() != data.affine_dimension && data.num_points() > 0)
      throw Violation{fmt::format("the affine dimension is {}, not {}", cells_.affine_dimension(),
                                  data.affine_dimension)};
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      round_();
      for (std::size_t i = 0; i < corners_; ++i)
        for (std::size_t j = i + 1; j < corners_; ++j)
          if (cells_.vertex(c, i) == cells_.vertex(c, j))
            throw Violation{fmt::format("cell {} has a vertex twice", c), {c}};
    }
  }

  void check_incidence() {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      round_();
      for (std::size_t i = 0; i < corners_; ++i) {
        if (data_.neighbors[c * corners_ + i] < 0) {
          if (is_closed())
            throw Violation{
                fmt::format("facet {} of cell {} is outside, but the set is periodic everywhere", i, c), {c}};
          for (std::size_t l = 0; l < r_; ++l)
            if (data_.neighbor_offsets[(c * corners_ + i) * r_ + l] != 0)
              throw Violation{fmt::format("facet {} of cell {} is outside, but has a neighbor offset", i, c),
                              {c}};
          continue;
        }
        check_neighbor(c, i);
      }
    }
  }

  void check_euler() {
    std::int64_t euler = 0;
    for (std::size_t size = 1; size <= corners_; ++size) {
      std::vector<std::pair<std::uint64_t, std::uint64_t>> tags;
      for (std::size_t c = 0; c < cells_.size(); ++c) {
        round_();
        add_faces(c, size, tags);
      }
      std::sort(tags.begin(), tags.end());
      if (size + 1 == corners_) check_facets(tags);
      tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
      if (size == corners_ && tags.size() != cells_.size())
        throw Violation{"two cells are translates of each other"};
      euler += (size % 2 == 1 ? 1 : -1) * static_cast<std::int64_t>(tags.size());
    }
    const std::int64_t expected = cells_.size() == 0 ? 0 : r_ == 0 ? 1 : 0;
    if (euler != expected)
      throw Violation{fmt::format("the Euler characteristic is {}, not {}", euler, expected)};
  }

  void check_volume() {
    kernel::Integer total = 0;
    const kernel::Flat flat = cells_.flat();
    orientation_ = Sign::positive;
    for (std::size_t c = 0; c < cells_.size() && corners_ > 1; ++c) {
      round_();
      const Vertices vertices = cells_.vertices(c);
      Placed placed = place(vertices, vertices[0], c);
      const Sign sign = kernel::orientation(flat, placed.pointers);
      if (c == 0 && data_.affine_dimension < data_.dimension) orientation_ = sign;
      if (sign == Sign::zero) throw Violation{fmt::format("cell {} is flat", c), {c}};
      if (sign != orientation_) throw Violation{fmt::format("cell {} is not positively oriented", c), {c}};
      if (is_closed()) total += volume(placed);
      check_sides(c, vertices);
    }
    if (!is_closed() || cells_.size() == 0 || r_ == 0) return;
    std::vector<kernel::Integer> edges;
    for (std::size_t i = 0; i < r_; ++i)
      for (const int axis : cells_.axes()) edges.push_back(in_units(cells_.set().period.vector(i)[axis]));
    kernel::Integer of_lattice =
        r_ == 0 ? kernel::Integer(1) : abs(kernel::exact_determinant(std::move(edges), r_));
    for (std::size_t i = 2; i <= r_; ++i) of_lattice *= i;
    if (total != of_lattice)
      throw Violation{fmt::format("the volumes of the cells add up to {} times that of the box",
                                  kernel::nearest_double(total, of_lattice, 0))};
  }

  /// Returns the ties.
  std::size_t check_local_convexity() {
    std::size_t ties = 0;
    const kernel::Flat flat = cells_.flat();
    for (std::size_t c = 0; c < cells_.size() && corners_ > 1; ++c) {
      round_();
      const Vertices vertices = cells_.vertices(c);
      for (std::size_t i = 0; i < corners_; ++i) {
        if (data_.neighbors[c * corners_ + i] < 0) {
          check_outer_facet(c, i, vertices);
          continue;
        }
        const PeriodicVertex& base = vertices[i == 0 ? 1 : 0];
        const Placed placed = place(vertices, base, c);
        const std::vector<double> apex = cells_.place(apex_across(c, i, vertices), base, c);
        Sign side = kernel::in_sphere(flat, placed.pointers, orientation_, apex.data());
        if (side == Sign::zero) {
          ++ties;
          if (is_canonical_)
            side = kernel::in_sphere_perturbed(flat, placed.pointers, orientation_, apex.data());
        }
        if (side == Sign::negative)
          throw Violation{fmt::format("the vertex of cell {} opposite cell {} is inside its sphere",
                                      data_.neighbors[c * corners_ + i], c),
                          {c, static_cast<std::size_t>(data_.neighbors[c * corners_ + i])}};
      }
    }
    check_outer_ridges();
    return ties / 2;
  }

  void check_completeness() {
    std::vector<bool> is_vertex(data_.num_points());
    for (const SignedIndex row : data_.cells) is_vertex[static_cast<std::size_t>(row)] = true;
    std::map<std::vector<double>, std::size_t> row_of;  // of the vertices in the box
    const auto position = [&](std::size_t row) {
      return std::vector<double>(cells_.set().row(row), cells_.set().row(row) + cells_.set().row_size());
    };
    for (std::size_t row = 0; row < is_vertex.size(); ++row)
      if (is_vertex[row] && !row_of.emplace(position(row), row).second)
        throw Violation{fmt::format("points {} and {} are translates of each other, and both are vertices",
                                    row_of[position(row)], row),
                        {},
                        {row_of[position(row)], row}};
    std::vector<std::size_t> hidden;
    for (std::size_t row = 0; row < is_vertex.size(); ++row) {
      round_();
      const auto at = row_of.find(position(row));
      const SignedIndex said = data_.vertex_of_point.empty() ? -2 : data_.vertex_of_point[row];
      if (at == row_of.end()) {
        if (said >= 0 || data_.weights.empty())
          throw Violation{fmt::format("point {} is no vertex, nor a translate of one", row), {}, {row}};
        hidden.push_back(row);
        continue;
      }
      if (said != -2 && said != static_cast<SignedIndex>(at->second))
        throw Violation{fmt::format("point {} is a translate of point {}, and vertex_of_point says {}", row,
                                    at->second, said),
                        {},
                        {row}};
      if (data_.point_offsets.empty()) continue;
      PeriodicVertex v{static_cast<SignedIndex>(at->second), {}}, point{static_cast<SignedIndex>(row), {}};
      for (std::size_t l = 0; l < r_; ++l) v.offset.push_back(data_.point_offsets[row * r_ + l]);
      point.offset.assign(r_, 0);
      if (!cells_.is_same_place(v, point))
        throw Violation{fmt::format("the offset of point {} from its vertex is wrong", row), {}, {row}};
    }
    if (!hidden.empty()) check_hidden(hidden);
  }

 private:
  struct Placed {
    std::vector<std::vector<double>> rows;
    std::vector<const double*> pointers;
  };
  Placed place(const Vertices& vertices, const PeriodicVertex& base, std::size_t c) const {
    Placed placed;
    for (const PeriodicVertex& v : vertices) placed.rows.push_back(cells_.place(v, base, c));
    for (const auto& row : placed.rows) placed.pointers.push_back(row.data());
    return placed;
  }
  /// Whether there is no boundary.
  bool is_closed() const { return data_.affine_dimension == static_cast<int>(r_); }

  void check_neighbor(std::size_t c, std::size_t i) const {
    const Vertices mine = cells_.vertices(c), theirs = cells_.neighbor_of(c, i);
    const auto wrong = [&](const char* what) {
      const auto other = static_cast<std::size_t>(data_.neighbors[c * corners_ + i]);
      throw Violation{fmt::format("cells {} and {}, neighbors across facet {}: {}", c, other, i, what),
                      {c, other}};
    };
    std::size_t apex = corners_;
    for (std::size_t j = 0; j < corners_; ++j) {
      const auto at = std::find(mine.begin(), mine.end(), theirs[j]);
      if (at == mine.end() && apex == corners_)
        apex = j;
      else if (at == mine.end() || at - mine.begin() == static_cast<std::ptrdiff_t>(i))
        wrong("they do not share it");
    }
    if (apex == corners_) wrong("they are the same cell");
    const auto other = static_cast<std::size_t>(data_.neighbors[c * corners_ + i]);
    if (data_.neighbors[other * corners_ + apex] != static_cast<SignedIndex>(c)) wrong("they are not mutual");
    for (std::size_t l = 0; l < r_; ++l)
      if (data_.neighbor_offsets[(other * corners_ + apex) * r_ + l] !=
          -data_.neighbor_offsets[(c * corners_ + i) * r_ + l])
        wrong("their offsets are not opposite");
  }
  /// The vertex of the neighbor that the cell does not have. REQUIRES level 2.
  PeriodicVertex apex_across(std::size_t c, std::size_t i, const Vertices& mine) const {
    for (PeriodicVertex& v : cells_.neighbor_of(c, i))
      if (std::find(mine.begin(), mine.end(), v) == mine.end()) return std::move(v);
    return {};
  }

  /// Equal for translates of a face, and for others with a chance of 2⁻¹²⁸: its lexicographically smallest
  /// vertex, and the others relative to it.
  static std::pair<std::uint64_t, std::uint64_t> tag_of(const Vertices& face) {
    const auto tag = [&](const PeriodicVertex& v) {
      std::vector<double> numbers{static_cast<double>(v.row)};
      for (std::size_t l = 0; l < v.offset.size(); ++l)
        numbers.push_back(static_cast<double>(v.offset[l] - face[0].offset[l]));
      return complex::point_tag(numbers.data(), static_cast<int>(numbers.size()));
    };
    PointTag sum = tag(face[0]);
    sum.high = random::mix(sum.high);
    for (std::size_t i = 1; i < face.size(); ++i) sum += tag(face[i]);
    return {sum.high, sum.low};
  }
  Vertices sorted_vertices(std::size_t c) const {
    const Vertices vertices = cells_.vertices(c);
    const Placed placed = place(vertices, vertices[0], c);
    std::vector<std::size_t> order(corners_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return placed.rows[a] < placed.rows[b]; });
    Vertices sorted;
    for (const std::size_t i : order) sorted.push_back(vertices[i]);
    return sorted;
  }
  void add_faces(std::size_t c, std::size_t size,
                 std::vector<std::pair<std::uint64_t, std::uint64_t>>& tags) const {
    const Vertices sorted = sorted_vertices(c);
    std::vector<bool> chosen(corners_, false);
    std::fill(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(size), true);
    do {
      Vertices face;
      for (std::size_t i = 0; i < corners_; ++i)
        if (chosen[i]) face.push_back(sorted[i]);
      tags.push_back(tag_of(face));
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
  }
  void check_facets(const std::vector<std::pair<std::uint64_t, std::uint64_t>>& sorted_tags) const {
    std::size_t once = 0;
    for (std::size_t first = 0, last = 0; first < sorted_tags.size(); first = last) {
      while (last < sorted_tags.size() && sorted_tags[last] == sorted_tags[first]) ++last;
      if (last - first > 2) throw Violation{fmt::format("{} cells share a facet", last - first)};
      once += last - first == 1 ? 1 : 0;
    }
    const auto outside =
        static_cast<std::size_t>(std::count(data_.neighbors.begin(), data_.neighbors.end(), -1));
    if (once != outside)
      throw Violation{fmt::format("{} facets are in one cell, and {} are outside", once, outside)};
  }

  /// k! times the volume of a cell on the axes of the flat, in units of the grid.
  kernel::Integer volume(const Placed& placed) const {
    std::vector<kernel::Integer> edges;
    for (std::size_t i = 1; i < corners_; ++i)
      for (const int axis : cells_.axes())
        edges.push_back(in_units(placed.rows[i][static_cast<std::size_t>(axis)]) -
                        in_units(placed.rows[0][static_cast<std::size_t>(axis)]));
    return abs(kernel::exact_determinant(std::move(edges), corners_ - 1));
  }
  kernel::Integer in_units(double x) const {
    return kernel::scaled_integer(x, cells_.set().grid - cells_.set().scale);
  }

  void check_sides(std::size_t c, const Vertices& vertices) const {
    for (std::size_t i = 0; i < corners_; ++i) {
      if (data_.neighbors[c * corners_ + i] < 0) continue;
      const PeriodicVertex& base = vertices[i == 0 ? 1 : 0];
      Placed placed = place(vertices, base, c);
      const std::vector<double> apex = cells_.place(apex_across(c, i, vertices), base, c);
      placed.pointers[i] = apex.data();
      if (kernel::orientation(cells_.flat(), placed.pointers) != -orientation_) {
        const auto other = static_cast<std::size_t>(data_.neighbors[c * corners_ + i]);
        throw Violation{fmt::format("cells {} and {} lie on one side of their common facet", c, other),
                        {c, other}};
      }
    }
  }

  void check_outer_facet(std::size_t c, std::size_t i, const Vertices& vertices) const {
    const PeriodicVertex& base = vertices[i == 0 ? 1 : 0];
    for (std::size_t l = 0; l < r_; ++l) {
      Placed placed = place(vertices, base, c);
      std::vector<double>& moved = placed.rows[i];
      moved = placed.rows[i == 0 ? 1 : 0];
      for (std::size_t j = 0; j < cells_.set().dimension; ++j) moved[j] += cells_.set().period.vector(l)[j];
      placed.pointers[i] = moved.data();
      if (kernel::orientation(cells_.flat(), placed.pointers) != Sign::zero)
        throw Violation{fmt::format("facet {} of cell {} is outside and not parallel to the lattice", i, c),
                        {c}};
    }
  }

  /// Where two outer facets meet, the cells are on the inner side of both.
  void check_outer_ridges() {
    if (is_closed() || corners_ < 3) return;
    struct Ridge {
      std::pair<std::uint64_t, std::uint64_t> tag;
      std::size_t cell, facet, opposite;
      PeriodicVertex smallest;
    };
    std::vector<Ridge> ridges;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (std::size_t i = 0; i < corners_; ++i) {
        if (data_.neighbors[c * corners_ + i] >= 0) continue;
        round_();
        const PeriodicVertex outer = cells_.vertex(c, i);
        for (std::size_t j = 0; j < corners_; ++j) {
          if (j == i) continue;
          Vertices ridge = sorted_vertices(c);
          std::erase(ridge, outer);
          std::erase(ridge, cells_.vertex(c, j));
          ridges.push_back({tag_of(ridge), c, i, j, ridge[0]});
        }
      }
    std::sort(ridges.begin(), ridges.end(), [](const Ridge& a, const Ridge& b) { return a.tag < b.tag; });
    for (std::size_t at = 0; at < ridges.size(); at += 2) {
      if (at + 1 == ridges.size() || ridges[at].tag != ridges[at + 1].tag ||
          (at + 2 < ridges.size() && ridges[at + 2].tag == ridges[at].tag))
        throw Violation{
            fmt::format("an outer facet of cell {} meets no other one, or several", ridges[at].cell),
            {ridges[at].cell}};
      const Ridge &a = ridges[at], &b = ridges[at + 1];
      Placed placed = place(cells_.vertices(a.cell), a.smallest, a.cell);
      const std::vector<double> other = cells_.place(cells_.vertex(b.cell, b.opposite), b.smallest, b.cell);
      placed.pointers[a.facet] = other.data();
      if (kernel::orientation(cells_.flat(), placed.pointers) == -orientation_)
        throw Violation{fmt::format("the outer facets of cells {} and {} are not convex", a.cell, b.cell),
                        {a.cell, b.cell}};
    }
  }

  /// The triangulation of all points hides the same: it is a function of the set.
  void check_hidden(const std::vector<std::size_t>& hidden) const {
    Lattice lattice{data_.dimension, data_.lattice};
    const PeriodicRegular<> again(PointsView(data_.points, data_.dimension), data_.weights, lattice,
                                  {.unit = data_.unit});
    for (const std::size_t row : hidden)
      if (again.vertex_of_point()[row] >= 0)
        throw Violation{fmt::format("point {} is no vertex, and not hidden", row), {}, {row}};
  }

  const ComplexData& data_;
  PeriodicCells cells_;
  const bool is_canonical_;
  const std::size_t corners_, r_;
  Sign orientation_ = Sign::positive;
  QuickRounds round_;
};

}  // namespace

CheckReport check_periodic(const ComplexData& data, const CheckOptions& options) {
  std::optional<PeriodicCheck> examined;
  return run_levels(
      std::span<const CheckLevel>(levels_of_periodic), options,
      [&](CheckReport&) {
        check_sizes(data);
        examined.emplace(data, options.canonical);
      },
      [&](CheckReport&) { examined->check_incidence(); }, [&](CheckReport&) { examined->check_euler(); },
      [&](CheckReport&) { examined->check_volume(); },
      [&](CheckReport& report) { report.ties = examined->check_local_convexity(); },
      [&](CheckReport&) { examined->check_completeness(); });
}

}  // namespace delone::internal
