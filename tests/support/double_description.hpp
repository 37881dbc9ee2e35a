// SPDX-License-Identifier: BSD-3-Clause
// The double description method of cddlib in rational numbers (Fukuda and Prodon 1996,
// doi:10.1007/3-540-61576-8_77): exact vertices of halfspaces and exact facets of points, degenerate or not.
// An oracle; tests that need it skip themselves without.
#pragma once

#if DELONE_HAVE_CDDLIB

#include <delone/types.hpp>

#define GMPRATIONAL 1
#include <cddlib/setoper.h>
// in this order
#include <cddlib/cdd.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <cstddef>
#include <cstdlib>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace delone::test {

struct DoubleDescription {
  using Rational = boost::multiprecision::cpp_rational;
  using Row = std::vector<Rational>;
  using Rows = std::vector<SignedIndex>;

  /// Of halfspaces: the vertices (1, x) and directions (0, u). Of points: the facets (b, a) with b + a·x ≥ 0.
  /// With each the rows of the input that hold with equality, increasing. Rows are divided by their first
  /// entry that is not 0, in magnitude.
  std::map<Row, Rows> found;
  std::size_t linearities = 0;  ///< lines, or equations that all points satisfy; they are not in `found`
  Rows essential;  ///< rows of the input that are not redundant. REQUIRES that no two are the same

  /// Of halfspaces n·x + c ≤ 0, each (n, c).
  static DoubleDescription of_halfspaces(std::span<const double> rows, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    return DoubleDescription(rows, d + 1, dd_Inequality);
  }
  static DoubleDescription of_points(std::span<const double> points, int dimension) {
    return DoubleDescription(points, static_cast<std::size_t>(dimension), dd_Generator);
  }

 private:
  DoubleDescription(std::span<const double> input, std::size_t columns,
                    dd_RepresentationType representation) {
    dd_set_global_constants();
    const std::size_t n = input.size() / columns;
    const bool are_points = representation == dd_Generator;
    const std::size_t d = are_points ? columns : columns - 1;
    dd_MatrixPtr matrix = dd_CreateMatrix(static_cast<dd_rowrange>(n), static_cast<dd_colrange>(d + 1));
    matrix->representation = representation;
    matrix->numbtype = dd_Rational;
    for (std::size_t i = 0; i < n; ++i) {
      mpq_set_d(matrix->matrix[i][0], are_points ? 1.0 : -input[i * columns + d]);
      for (std::size_t j = 0; j < d; ++j)
        mpq_set_d(matrix->matrix[i][j + 1], are_points ? input[i * columns + j] : -input[i * columns + j]);
    }
    dd_ErrorType error = dd_NoError;
    const dd_rowset redundant = dd_RedundantRows(matrix, &error);
    for (std::size_t i = 0; i < n; ++i)
      if (!set_member(static_cast<long>(i + 1), redundant)) essential.push_back(static_cast<SignedIndex>(i));
    set_free(redundant);
    dd_PolyhedraPtr polyhedron = dd_DDMatrix2Poly(matrix, &error);
    dd_MatrixPtr output = are_points ? dd_CopyInequalities(polyhedron) : dd_CopyGenerators(polyhedron);
    dd_SetFamilyPtr incidence = dd_CopyIncidence(polyhedron);
    for (long i = 0; i < output->rowsize; ++i) {
      if (set_member(i + 1, output->linset)) {
        ++linearities;
        continue;
      }
      Row row;
      for (std::size_t j = 0; j <= d; ++j) row.push_back(rational(output->matrix[i][j]));
      const auto first = std::find_if(row.begin(), row.end(), [](const Rational& x) { return x != 0; });
      if (first == row.end()) continue;  // "infinity"
      const Rational scale = abs(*first);
      for (Rational& x : row) x /= scale;
      Rows on;
      for (std::size_t r = 0; r < n; ++r)
        if (set_member(static_cast<long>(r + 1), incidence->set[i]))
          on.push_back(static_cast<SignedIndex>(r));
      if (are_points && on.empty()) continue;  // 1 ≥ 0
      found.emplace(std::move(row), std::move(on));
    }
    dd_FreeSetFamily(incidence);
    dd_FreeMatrix(output);
    dd_FreePolyhedra(polyhedron);
    dd_FreeMatrix(matrix);
    dd_free_global_constants();
  }

  static Rational rational(mpq_t x) {
    const auto integer = [](mpz_t z) {
      char* const text = mpz_get_str(nullptr, 10, z);
      boost::multiprecision::cpp_int result(text);
      std::free(text);
      return result;
    };
    return Rational(integer(mpq_numref(x)), integer(mpq_denref(x)));
  }
};

}  // namespace delone::test

#endif
