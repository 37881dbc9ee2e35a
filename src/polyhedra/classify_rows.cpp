// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/classify_rows.hpp"

#include "base/progress_meter.hpp"

#include <algorithm>
#include <numeric>

namespace delone::polyhedra {
namespace {

bool is_equal(ConstBits a, ConstBits b) { return std::equal(a.begin(), a.end(), b.begin()); }

}  // namespace

ConeRows classify_rows(const BitRows& zeros, const BitRows& columns) {
  const std::size_t n = zeros.size(), m = columns.size();
  std::vector<std::size_t> num_rays(m), num_rows(n);
  for (std::size_t i = 0; i < m; ++i) num_rays[i] = count(columns[i]);
  for (std::size_t r = 0; r < n; ++r) num_rows[r] = count(zeros[r]);
  ConeRows result{std::vector<ConeRow>(m, ConeRow::facet), std::vector<std::size_t>(m)};
  std::iota(result.first.begin(), result.first.end(), std::size_t{0});

  // Rows with no ray are facets of a cone of one ray only, and the same there.
  const bool is_one_ray =
      std::all_of(num_rays.begin(), num_rays.end(), [&](std::size_t k) { return k == 0 || k == n; });
  std::size_t first_without = m;
  for (std::size_t i = 0; i < m; ++i) {
    internal::cancellation_point();
    if (num_rays[i] == n) {
      result.kinds[i] = ConeRow::whole;
      continue;
    }
    if (num_rays[i] == 0) {
      if (!is_one_ray) {
        result.kinds[i] = ConeRow::redundant;
      } else if (first_without == m) {
        first_without = i;
      } else {
        result.kinds[i] = ConeRow::duplicate;
        result.first[i] = first_without;
      }
      continue;
    }
    // A larger set has all these rays, so the one with the fewest rows names all candidates.
    std::size_t ray = n;
    for_each(columns[i], [&](std::size_t r) {
      if (ray == n || num_rows[r] < num_rows[ray]) ray = r;
    });
    for_each(zeros[ray], [&](std::size_t j) {
      if (result.kinds[i] != ConeRow::facet || j == i || num_rays[j] == n || num_rays[j] < num_rays[i])
        return;
      if (num_rays[j] > num_rays[i]) {
        if (contains(columns[j], columns[i])) result.kinds[i] = ConeRow::redundant;
      } else if (j < i && is_equal(columns[j], columns[i])) {
        result.kinds[i] = ConeRow::duplicate;
        result.first[i] = j;
      }
    });
    if (result.kinds[i] == ConeRow::duplicate) {  // of a row that need not be a facet
      const std::size_t first = result.first[i];
      if (result.kinds[first] == ConeRow::redundant) {
        result.kinds[i] = ConeRow::redundant;
        result.first[i] = i;
      }
    }
  }
  return result;
}

}  // namespace delone::polyhedra
