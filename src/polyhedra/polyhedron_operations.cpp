// SPDX-License-Identifier: BSD-3-Clause
// Polyhedron: questions about points and linear functions, and operations that make other polyhedra.
#include "base/require_dimension.hpp"
#include "polyhedra/fraction.hpp"
#include "polyhedra/polyhedron_impl.hpp"

#include <delone/polyhedron.hpp>

#include <algorithm>
#include <string>

namespace delone {

using polyhedra::Description;
using polyhedra::Fraction;
using polyhedra::Integer;
using polyhedra::Row;
using polyhedra::Rows;
using polyhedra::scalar_product;
using polyhedra::within_limits;

namespace {

void require_entries(std::size_t found, std::size_t expected, const char* what) {
  if (found != expected)
    throw Error(Errc::bad_dimension, std::string(what) + " has " + std::to_string(found) + " entries, not " +
                                         std::to_string(expected));
}

void require_same_dimension(const Description& a, const Description& b) {
  if (a.dimension != b.dimension)
    throw Error(Errc::bad_dimension, "polyhedra in " + std::to_string(a.dimension) + " and " +
                                         std::to_string(b.dimension) + " dimensions");
}

Rows joined(const Rows& a, const Rows& b) {
  Rows result = a;
  result.insert(result.end(), b.begin(), b.end());
  return result;
}

/// x ↦ M·x + t as rows of integers for (x, x_0), and a common denominator: (y, y_0) with y = (M·x + t·x_0)·s
/// and y_0 = s·x_0.
struct AffineMap {
  Rows rows;
  Integer denominator = 1;

  AffineMap(const RationalRows& matrix, std::span<const Rational> translation, std::size_t num_rows,
            std::size_t num_columns) {
    if (!matrix.empty() || num_rows > 0) {
      require_entries(matrix.size(), num_rows, "the number of rows of the matrix: it");
      if (num_rows > 0) require_entries(matrix.width(), num_columns, "a row of the matrix");
    }
    if (!translation.empty()) require_entries(translation.size(), num_rows, "the translation");
    for (std::size_t i = 0; i < num_rows; ++i) {
      std::vector<Rational> row(matrix[i].begin(), matrix[i].end());
      row.push_back(translation.empty() ? Rational() : translation[i]);
      rows.push_back(polyhedra::common_integers(row));
      denominator = boost::multiprecision::lcm(denominator, rows.back().back());
    }
    for (Row& row : rows) {
      const Integer factor = denominator / row.back();
      row.pop_back();
      for (Integer& x : row) x *= factor;
    }
  }
  Row image(const Row& x) const {
    Row y;
    for (const Row& row : rows) y.push_back(scalar_product(row, x));
    y.push_back(denominator * x.back());
    return y;
  }
  /// The function f(y) of an inequality or equation as a function of x.
  Row pulled_back(const Row& f, std::size_t num_columns) const {
    Row g(num_columns + 1, Integer(0));
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t c = 0; c <= num_columns; ++c) g[c] += f[i] * rows[i][c];
    g[num_columns] += f.back() * denominator;
    return g;
  }
};

/// The row among others: `before` zeros, the entries without the last one, `after` zeros, and the last one.
Row embedded(const Row& row, std::size_t before, std::size_t after) {
  Row result(before, Integer(0));
  result.insert(result.end(), row.begin(), row.end() - 1);
  result.resize(result.size() + after, Integer(0));
  result.push_back(row.back());
  return result;
}

/// The sum of two points.
Row sum_of_points(const Row& a, const Row& b) {
  Row sum;
  for (std::size_t i = 0; i < a.size(); ++i) sum.push_back(a[i] * b.back() + b[i] * a.back());
  sum.back() = a.back() * b.back();
  return sum;
}

}  // namespace

bool Polyhedron::contains(std::span<const Rational> point) const {
  const Description& own = impl_->description;
  require_entries(point.size(), own.dimension, "the point");
  return internal::guarded("a query", [&] {
    const Row x = polyhedra::common_integers(point);
    return std::all_of(own.facets.begin(), own.facets.end(),
                       [&](const Row& facet) { return scalar_product(facet, x) >= 0; }) &&
           std::all_of(own.equations.begin(), own.equations.end(),
                       [&](const Row& equation) { return scalar_product(equation, x) == 0; });
  });
}

bool Polyhedron::includes(const Polyhedron& other) const {
  require_same_dimension(impl_->description, other.impl_->description);
  return internal::guarded("a query",
                           [&] { return polyhedra::includes(impl_->description, other.impl_->description); });
}

Optimum Polyhedron::maximize(std::span<const Rational> c) const {
  const Description& own = impl_->description;
  require_entries(c.size(), own.dimension, "the linear function");
  return internal::guarded("an optimum", [&] {
    Optimum result;
    if (own.is_empty()) return result;
    Row function = polyhedra::common_integers(c);
    const Integer scale = std::exchange(function.back(), Integer(0));
    const auto rises_on = [&](const Row& direction) { return scalar_product(function, direction) > 0; };
    if (std::any_of(own.lines.begin(), own.lines.end(),
                    [&](const Row& line) { return scalar_product(function, line) != 0; }) ||
        std::any_of(own.generators.begin() + static_cast<std::ptrdiff_t>(own.num_vertices),
                    own.generators.end(), rises_on)) {
      result.state = Optimum::State::unbounded;
      return result;
    }
    result.state = Optimum::State::attained;
    Integer best, denominator = 0;
    for (std::size_t i = 0; i < own.num_vertices; ++i) {
      internal::cancellation_point();
      const Integer value = scalar_product(function, own.generators[i]);
      const Integer& x0 = own.generators[i].back();
      const Integer difference = denominator == 0 ? Integer(1) : Integer(value * denominator - best * x0);
      if (difference < 0) continue;
      if (difference > 0) {
        best = value;
        denominator = x0;
        result.vertices.clear();
      }
      result.vertices.push_back(i);
    }
    for (std::size_t i = own.num_vertices; i < own.generators.size(); ++i)
      if (scalar_product(function, own.generators[i]) == 0) result.rays.push_back(i - own.num_vertices);
    result.value = Fraction::to_rational(best, denominator * scale);
    return result;
  });
}

Optimum Polyhedron::minimize(std::span<const Rational> c) const {
  std::vector<Rational> opposite;
  for (const Rational& x : c) {
    const Fraction fraction = Fraction::of(x);
    opposite.push_back(Fraction::to_rational(-fraction.numerator, fraction.denominator));
  }
  Optimum result = maximize(opposite);
  const Fraction value = Fraction::of(result.value);
  result.value = Fraction::to_rational(-value.numerator, value.denominator);
  return result;
}

Polyhedron Polyhedron::intersection(const Polyhedron& other, const Options& options) const {
  const Description &a = impl_->description, &b = other.impl_->description;
  require_same_dimension(a, b);
  return within_limits(options, [&] {
    return of(polyhedra::from_inequalities(joined(a.facets, b.facets), joined(a.equations, b.equations),
                                           a.dimension, nullptr, options.threads));
  });
}

Polyhedron Polyhedron::convex_union(const Polyhedron& other, const Options& options) const {
  const Description &a = impl_->description, &b = other.impl_->description;
  require_same_dimension(a, b);
  if (a.is_empty()) return other;
  if (b.is_empty()) return *this;
  return within_limits(options, [&] {
    return of(polyhedra::from_generators(joined(a.generators, b.generators), joined(a.lines, b.lines),
                                         a.dimension, nullptr, options.threads));
  });
}

Polyhedron Polyhedron::minkowski_sum(const Polyhedron& other, const Options& options) const {
  const Description &a = impl_->description, &b = other.impl_->description;
  require_same_dimension(a, b);
  if (a.is_empty()) return *this;
  if (b.is_empty()) return other;
  return within_limits(options, [&] {
    Rows generators;
    for (std::size_t i = 0; i < a.num_vertices; ++i) {
      internal::cancellation_point();
      for (std::size_t j = 0; j < b.num_vertices; ++j)
        generators.push_back(sum_of_points(a.generators[i], b.generators[j]));
    }
    for (const Description* part : {&a, &b})
      generators.insert(generators.end(),
                        part->generators.begin() + static_cast<std::ptrdiff_t>(part->num_vertices),
                        part->generators.end());
    return of(polyhedra::from_generators(std::move(generators), joined(a.lines, b.lines), a.dimension,
                                         nullptr, options.threads));
  });
}

Polyhedron Polyhedron::product(const Polyhedron& other) const {
  const Description &a = impl_->description, &b = other.impl_->description;
  const std::size_t d = a.dimension, e = b.dimension;
  if (a.is_empty() || b.is_empty()) return empty(static_cast<int>(d + e));
  return internal::guarded("the polyhedron", [&] {
    const auto both = [&](const Rows& of_a, const Rows& of_b) {
      Rows rows;
      for (const Row& row : of_a) rows.push_back(embedded(row, 0, e));
      for (const Row& row : of_b) rows.push_back(embedded(row, d, 0));
      return rows;
    };
    const auto rays_of = [](const Description& part) {
      return Rows(part.generators.begin() + static_cast<std::ptrdiff_t>(part.num_vertices),
                  part.generators.end());
    };
    Rows generators = both(rays_of(a), rays_of(b));
    for (std::size_t i = 0; i < a.num_vertices; ++i) {
      internal::cancellation_point();
      for (std::size_t j = 0; j < b.num_vertices; ++j)
        generators.push_back(sum_of_points(embedded(a.generators[i], 0, e), embedded(b.generators[j], d, 0)));
    }
    return of(polyhedra::from_minimal_rows(both(a.facets, b.facets), both(a.equations, b.equations),
                                           std::move(generators), both(a.lines, b.lines), d + e));
  });
}

Polyhedron Polyhedron::polar(const Options& options) const {
  const Description& own = impl_->description;
  return within_limits(options, [&] {
    Rows inequalities = own.generators;
    for (Row& row : inequalities)
      for (std::size_t c = 0; c < own.dimension; ++c) row[c] = -row[c];
    return of(polyhedra::from_inequalities(std::move(inequalities), own.lines, own.dimension, nullptr,
                                           options.threads));
  });
}

Polyhedron Polyhedron::projection(std::span<const int> axes, const Options& options) const {
  const std::size_t d = impl_->description.dimension;
  std::vector<char> is_kept(d, 0);
  RationalRows matrix;
  for (const int axis : axes) {
    if (axis < 0 || axis >= dimension())
      throw Error(Errc::invalid_argument, "there is no axis " + std::to_string(axis));
    if (std::exchange(is_kept[static_cast<std::size_t>(axis)], 1) != 0)
      throw Error(Errc::invalid_argument, "axis " + std::to_string(axis) + " comes twice");
    std::vector<Rational> row(d);
    row[static_cast<std::size_t>(axis)] = 1;
    matrix.push_back(row);
  }
  return image(matrix, {}, options);
}

Polyhedron Polyhedron::image(const RationalRows& matrix, std::span<const Rational> translation,
                             const Options& options) const {
  const Description& own = impl_->description;
  return within_limits(options, [&] {
    const AffineMap map(matrix, translation, matrix.size(), own.dimension);
    Rows generators, lines;
    for (const Row& row : own.generators) generators.push_back(map.image(row));
    for (const Row& row : own.lines) lines.push_back(map.image(row));
    return of(
        polyhedra::from_generators(std::move(generators), lines, matrix.size(), nullptr, options.threads));
  });
}

Polyhedron Polyhedron::preimage(const RationalRows& matrix, int dimension,
                                std::span<const Rational> translation, const Options& options) const {
  const Description& own = impl_->description;
  if (dimension < 0) throw Error(Errc::bad_dimension, "the dimension must be at least 0");
  if (dimension > 0) internal::require_dimension(dimension);
  const auto e = static_cast<std::size_t>(dimension);
  return within_limits(options, [&] {
    const AffineMap map(matrix, translation, own.dimension, e);
    Rows inequalities, equations;
    for (const Row& row : own.facets) inequalities.push_back(map.pulled_back(row, e));
    for (const Row& row : own.equations) equations.push_back(map.pulled_back(row, e));
    return of(polyhedra::from_inequalities(std::move(inequalities), equations, e, nullptr, options.threads));
  });
}

}  // namespace delone
