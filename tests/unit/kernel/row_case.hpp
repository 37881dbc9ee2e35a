// SPDX-License-Identifier: BSD-3-Clause
// Rows for the tests of the predicates, with the right answers from integers and independent code.
#pragma once

#include "base/random.hpp"
#include "brute_force.hpp"
#include "kernel/flat.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace delone::kernel {

/// Rows of one form, in full dimension unless axes are given, with their grid; the last row is the query.
struct RowCase {
  RowCase(RowForm row_form, int row_ambient, std::vector<double> all, std::vector<int> chosen_axes = {})
      : form(row_form),
        ambient(row_ambient),
        numbers(std::move(all)),
        axes(std::move(chosen_axes)),
        grid(ambient, form == RowForm::weighted_point) {
    if (axes.empty()) {
      axes.resize(static_cast<std::size_t>(ambient));
      std::iota(axes.begin(), axes.end(), 0);
    }
    const auto row_size = static_cast<std::size_t>(flat().row_size());
    for (std::size_t i = 0; i < numbers.size(); i += row_size) {
      if (form != RowForm::homogeneous) grid.include(numbers.data() + i);
      rows.push_back(numbers.data() + i);
    }
  }
  RowCase(const RowCase&) = delete;
  RowCase& operator=(const RowCase&) = delete;
  Flat flat() const { return {ambient, axes, form}; }
  const double* q() const { return rows.back(); }

  RowForm form;
  int ambient;
  std::vector<double> numbers;
  std::vector<int> axes;
  Grid grid;
  std::vector<const double*> rows;
};

/// Now and then a small integer times a power of two; |x| ≤ 4·2^range.
inline double random_double(random::Generator& generator, int range) {
  const double mantissa =
      generator.below(4) == 0 ? static_cast<double>(generator.below(9)) - 4 : 2 * generator.uniform() - 1;
  return std::ldexp(mantissa,
                    static_cast<int>(generator.below(static_cast<std::uint64_t>(2 * range))) - range);
}

/// Numbers of one kind: 0 uniform, 1 small integers, 2 multiples of 0.1, 3 of many magnitudes, 4 of all
/// magnitudes, 5 small multiples of the least denormal number.
inline std::vector<double> random_numbers(std::size_t count, std::size_t kind, random::Generator& generator) {
  std::vector<double> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = generator.uniform();
    const auto wide = [&](int range) {
      return std::ldexp(u - 0.5,
                        static_cast<int>(generator.below(static_cast<std::uint64_t>(2 * range))) - range);
    };
    all.push_back(kind == 0   ? u - 0.5
                  : kind == 1 ? std::floor(3 * u) - 1
                  : kind == 2 ? 0.1 * std::floor(4 * u)
                  : kind == 3 ? wide(60)
                  : kind == 4 ? wide(1000)
                              : std::ldexp(std::floor(5 * u) - 2, -1074));
  }
  return all;
}

/// x·2^−exponent. REQUIRES an integer.
inline test::Integer integer_at(double x, int exponent) {
  int top;
  const test::Integer mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &top), 53));
  const int shift = top - 53 - exponent;
  return shift >= 0 ? test::Integer(mantissa << shift)
                    : test::Integer(mantissa / (test::Integer(1) << -shift));
}

/// x·2^exponent
inline test::Integer shifted(test::Integer x, int exponent) {
  x <<= exponent;
  return x;
}

/// The rows (chosen coordinates, |x|² − w, 1), with coordinates and lifts as integers.
inline test::Matrix lifted_rows(const RowCase& c) {
  int exponent = 0;
  for (const double* row : c.rows) {
    for (int j = 0; j < c.ambient; ++j)
      if (row[j] != 0) exponent = std::min(exponent, trailing_exponent(row[j]));
    if (c.flat().weighted() && row[c.ambient] != 0)
      exponent = std::min(exponent, (trailing_exponent(row[c.ambient]) - 1) / 2);
  }
  test::Matrix lifted;
  for (const double* row : c.rows) {
    lifted.emplace_back();
    for (const int axis : c.axes) lifted.back().push_back(integer_at(row[axis], exponent));
    test::Integer lift = 0;
    for (int j = 0; j < c.ambient; ++j) {
      const test::Integer x = integer_at(row[j], exponent);
      lift += x * x;
    }
    if (c.flat().weighted()) lift -= integer_at(row[c.ambient], 2 * exponent);
    lifted.back().push_back(lift);
    lifted.back().push_back(1);
  }
  return lifted;
}

/// The sign of det(p_i − p_0) of the first k+1 of k+2 lifted rows.
inline Sign true_orientation_of(const test::Matrix& lifted) {
  test::Matrix m;
  for (std::size_t i = 1; i + 1 < lifted.size(); ++i) {
    m.emplace_back();
    for (std::size_t j = 0; j + 2 < lifted[0].size(); ++j) m.back().push_back(lifted[i][j] - lifted[0][j]);
  }
  return test::sign_of(test::determinant(m));
}

/// The position of the last row: the determinant is linear in its lift, and a query that is lifted far up is
/// outside.
inline Sign true_side_of_sphere(const test::Matrix& lifted) {
  test::Matrix far_up = lifted;
  for (auto& x : far_up.back()) x = 0;
  far_up.back()[far_up.back().size() - 2] = 1;
  return test::sign_of(test::determinant(lifted)) * test::sign_of(test::determinant(far_up));
}

}  // namespace delone::kernel
