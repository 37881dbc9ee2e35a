// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/cone.hpp"

#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace delone::polyhedra {
namespace {

namespace mp = boost::multiprecision;

/// Coordinates y of the solutions x = Σ y[i]·basis[i] of equations; without equations y is x.
class Solutions {
 public:
  Solutions(const Rows& equations, std::size_t dimension) : dimension_(dimension) {
    const Echelon echelon(dimension, equations);
    has_equations_ = echelon.rank() > 0;
    if (has_equations_) basis_ = echelon.kernel();
  }
  std::size_t dimension() const { return has_equations_ ? basis_.size() : dimension_; }
  /// A row as a function of y.
  Row restricted(const Row& row) const {
    if (!has_equations_) return row;
    Row result;
    result.reserve(basis_.size());
    for (const Row& vector : basis_) result.push_back(scalar_product(row, vector));
    return result;
  }
  /// x for a y, primitive.
  Row lifted(Row y) const {
    if (!has_equations_) return y;
    Row x(dimension_, Integer(0));
    for (std::size_t i = 0; i < y.size(); ++i)
      if (y[i] != 0)
        for (std::size_t j = 0; j < dimension_; ++j)
          if (basis_[i][j] != 0) x[j] += y[i] * basis_[i][j];
    make_primitive(x);
    return x;
  }

 private:
  std::size_t dimension_;
  bool has_equations_;
  Rows basis_;
};

/// Lexicographic, the last entry first: offsets before normals.
bool is_taken_before(const Row& a, const Row& b) {
  if (a.back() != b.back()) return a.back() < b.back();
  return a < b;
}

/// Rows of one row each, primitive and sorted, with the numbers that they had.
struct DistinctRows {
  static constexpr std::size_t zero = static_cast<std::size_t>(-1);
  Rows rows;
  std::vector<std::size_t> number_of;  // by row of the input: its number among them, or `zero`
};

DistinctRows distinct_rows(const Rows& input, const Solutions& solutions) {
  Rows reduced;
  reduced.reserve(input.size());
  for (const Row& row : input) {
    internal::cancellation_point();
    reduced.push_back(solutions.restricted(row));
    make_primitive(reduced.back());
  }
  std::vector<std::size_t> order;
  DistinctRows result;
  result.number_of.assign(input.size(), DistinctRows::zero);
  for (std::size_t i = 0; i < input.size(); ++i)
    if (!is_zero(reduced[i])) order.push_back(i);
  internal::QuickRounds round;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    round();
    return is_taken_before(reduced[a], reduced[b]);
  });
  for (const std::size_t i : order) {
    round();
    if (result.rows.empty() || result.rows.back() != reduced[i]) result.rows.push_back(reduced[i]);
    result.number_of[i] = result.rows.size() - 1;
  }
  return result;
}

/// The rays of the cone of d independent rows of R^d: the columns of the inverse of their matrix, each times
/// a positive number. Rows (row, e_i) are reduced until only pivots remain on the left; to the right of the
/// pivot of column c then is that multiple of row c of the inverse.
Rows rays_of_simplicial(const Rows& rows, std::size_t d) {
  Echelon echelon(d);
  for (std::size_t i = 0; i < d; ++i) {
    Row row = rows[i];
    row.resize(2 * d, Integer(0));
    row[d + i] = 1;
    echelon.add(std::move(row));
  }
  Rows rays(d, Row(d, Integer(0)));
  for (std::size_t i = 0; i < d; ++i) {
    Integer scale = 1;
    for (std::size_t r = 0; r < d; ++r)
      if (echelon.rows()[r][d + i] != 0) scale = mp::lcm(scale, echelon.rows()[r][echelon.pivots()[r]]);
    for (std::size_t r = 0; r < d; ++r) {
      const std::size_t column = echelon.pivots()[r];
      rays[i][column] = echelon.rows()[r][d + i] * (scale / echelon.rows()[r][column]);
    }
    make_primitive(rays[i]);
  }
  return rays;
}

/// The order in which rows are taken: those that are independent of the rows before them, then the others.
struct RowOrder {
  std::vector<std::size_t> rows;
  std::vector<std::size_t> axes;  // pivots of the rows, increasing
  Rows lineality;
};

RowOrder order_rows(const Rows& rows, std::size_t dimension) {
  RowOrder order;
  std::vector<std::size_t> others;
  Echelon echelon(dimension);
  internal::QuickRounds round;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    round();
    (echelon.rank() < dimension && echelon.add(rows[i]) ? order.rows : others).push_back(i);
  }
  order.rows.insert(order.rows.end(), others.begin(), others.end());
  order.axes = echelon.pivots();
  std::sort(order.axes.begin(), order.axes.end());
  order.lineality = echelon.kernel();
  return order;
}

}  // namespace

ConeRays find_rays(const Rows& input, const Rows& equations, std::size_t dimension, unsigned threads,
                   PointedMethod method) {
  const Solutions solutions(equations, dimension);
  const DistinctRows distinct = distinct_rows(input, solutions);
  const RowOrder order = order_rows(distinct.rows, solutions.dimension());
  const std::size_t d = order.axes.size();

  ConeRays result;
  for (const Row& line : order.lineality) result.lines.push_back(solutions.lifted(line));
  if (d == 0) {
    result.zeros = BitRows(0, input.size());
    return result;
  }
  PointedCone cone;
  std::vector<std::size_t> position(distinct.rows.size());
  for (const std::size_t i : order.rows) {
    internal::cancellation_point();
    position[i] = cone.rows.size();
    Row row;
    for (const std::size_t axis : order.axes) row.push_back(distinct.rows[i][axis]);
    make_primitive(row);
    cone.rows.push_back(std::move(row));
  }
  cone.first_rays = rays_of_simplicial(cone.rows, d);
  PointedRays found = method(cone, threads);

  std::vector<std::vector<std::size_t>> inputs(cone.rows.size());
  std::vector<std::size_t> zero_rows;
  for (std::size_t i = 0; i < input.size(); ++i)
    if (const std::size_t number = distinct.number_of[i]; number == DistinctRows::zero)
      zero_rows.push_back(i);
    else
      inputs[position[number]].push_back(i);
  result.zeros = BitRows(found.rays.size(), input.size());
  result.rays.resize(found.rays.size());
  const auto take = [&](std::size_t ray) {
    Row y = std::move(found.rays[ray]);
    if (d < solutions.dimension()) {
      Row of_axes(solutions.dimension(), Integer(0));
      for (std::size_t i = 0; i < d; ++i) of_axes[order.axes[i]] = std::move(y[i]);
      y = std::move(of_axes);
    }
    result.rays[ray] = solutions.lifted(std::move(y));
    const Bits zeros = result.zeros[ray];
    for (const std::size_t i : zero_rows) insert(zeros, i);
    for_each(std::as_const(found.zeros)[ray], [&](std::size_t row) {
      for (const std::size_t i : inputs[row]) insert(zeros, i);
    });
  };
  constexpr std::size_t part = 1024;
  internal::for_parts(threads, found.rays.size(), part,
                      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                        for (std::size_t ray = first; ray < last; ++ray) {
                          stop();
                          take(ray);
                        }
                      });
  return result;
}

}  // namespace delone::polyhedra
