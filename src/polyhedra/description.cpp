// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/description.hpp"

#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "polyhedra/classify_rows.hpp"
#include "polyhedra/cone.hpp"
#include "polyhedra/sorted_rows.hpp"

#include <algorithm>
#include <utility>

namespace delone::polyhedra {
namespace {

/// x_0, the function of the inequality of infinity.
Row row_of_infinity(std::size_t dimension) {
  Row row(dimension + 1, Integer(0));
  row[dimension] = 1;
  return row;
}

Description empty_description(std::size_t dimension) {
  Description result;
  result.dimension = dimension;
  result.equations.push_back(row_of_infinity(dimension));
  return result;
}

bool is_vertex(const Row& generator) { return generator.back() > 0; }

void reduce_all(Rows& rows, const Echelon& by, unsigned threads) {
  constexpr std::size_t part = 1024;
  internal::for_parts(threads, rows.size(), part,
                      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                        for (std::size_t i = first; i < last; ++i) {
                          stop();
                          by.reduce(rows[i]);
                        }
                      });
}

/// Reduces and sorts the rows of a description whose incidences are those of its generators and facets.
void make_canonical(Description& description, const Echelon& equations, const Echelon& lines,
                    unsigned threads) {
  description.equations = equations.sorted_rows();
  description.lines = lines.sorted_rows();
  reduce_all(description.facets, equations, threads);
  reduce_all(description.generators, lines, threads);
  const std::vector<std::size_t> facet_order = sort_inequalities(description.facets, threads);
  const std::vector<std::size_t> order = sort_generators(description.generators, threads);
  std::vector<std::size_t> place(facet_order.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[facet_order[i]] = i;
  BitRows incidence(order.size(), facet_order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    for_each(std::as_const(description.incidence)[order[i]],
             [&](std::size_t facet) { insert(incidence[i], place[facet]); });
  description.incidence = std::move(incidence);
  description.num_vertices = static_cast<std::size_t>(
      std::count_if(description.generators.begin(), description.generators.end(), is_vertex));
}

RowKind row_kind_of(ConeRow kind) {
  switch (kind) {
    case ConeRow::whole:
      return RowKind::implicit;
    case ConeRow::facet:
      return RowKind::essential;
    case ConeRow::duplicate:
      return RowKind::duplicate;
    default:
      return RowKind::redundant;
  }
}

}  // namespace

Description from_inequalities(Rows inequalities, const Rows& equations, std::size_t dimension,
                              std::vector<RowKind>* kinds, unsigned threads) {
  const std::size_t m = inequalities.size();
  inequalities.push_back(row_of_infinity(dimension));
  ConeRays cone = find_rays(inequalities, equations, dimension + 1, threads);
  Description result;
  result.dimension = dimension;
  if (std::none_of(cone.rays.begin(), cone.rays.end(), is_vertex)) {
    if (kinds != nullptr) kinds->assign(m, RowKind::redundant);
    return empty_description(dimension);
  }
  const BitRows columns = cone.zeros.transposed(inequalities.size());
  const ConeRows rows = classify_rows(cone.zeros, columns);
  Echelon affine_hull(dimension + 1, equations);
  std::vector<std::size_t> facet_of_row(m, m);
  if (kinds != nullptr) kinds->resize(m);
  for (std::size_t i = 0; i < m; ++i) {
    internal::cancellation_point();
    // Points at infinity alone are no facet.
    bool has_vertex = false;
    for_each(columns[i], [&](std::size_t ray) { has_vertex = has_vertex || is_vertex(cone.rays[ray]); });
    const ConeRow kind = rows.kinds[i] == ConeRow::whole || has_vertex ? rows.kinds[i] : ConeRow::redundant;
    if (kinds != nullptr) (*kinds)[i] = is_zero(inequalities[i]) ? RowKind::redundant : row_kind_of(kind);
    if (kind == ConeRow::whole) affine_hull.add(inequalities[i]);
    if (kind != ConeRow::facet) continue;
    facet_of_row[i] = result.facets.size();
    result.facets.push_back(std::move(inequalities[i]));
  }
  result.generators = std::move(cone.rays);
  result.incidence = BitRows(result.generators.size(), result.facets.size());
  for (std::size_t i = 0; i < result.generators.size(); ++i)
    for_each(std::as_const(cone.zeros)[i], [&](std::size_t row) {
      if (row < m && facet_of_row[row] < m) insert(result.incidence[i], facet_of_row[row]);
    });
  make_canonical(result, affine_hull, Echelon(dimension + 1, cone.lines), threads);
  return result;
}

Description from_generators(Rows generators, const Rows& lines, std::size_t dimension,
                            std::vector<RowKind>* kinds, unsigned threads) {
  const std::size_t m = generators.size();
  if (generators.empty() && lines.empty()) {
    if (kinds != nullptr) kinds->clear();
    return empty_description(dimension);
  }
  if (std::none_of(generators.begin(), generators.end(), is_vertex))
    generators.push_back(row_of_infinity(dimension));  // as a point it is the origin
  ConeRays cone = find_rays(generators, lines, dimension + 1, threads);
  const ConeRows rows = classify_rows(cone.zeros, cone.zeros.transposed(generators.size()));
  Description result;
  result.dimension = dimension;
  Echelon lineality(dimension + 1, lines);
  std::vector<std::size_t> kept;
  if (kinds != nullptr) kinds->resize(m);
  for (std::size_t i = 0; i < generators.size(); ++i) {
    if (kinds != nullptr && i < m)
      (*kinds)[i] = is_zero(generators[i]) ? RowKind::redundant : row_kind_of(rows.kinds[i]);
    if (rows.kinds[i] == ConeRow::whole) lineality.add(generators[i]);
    if (rows.kinds[i] == ConeRow::facet) kept.push_back(i);
  }
  // All facets but that at infinity, which has no vertex.
  std::vector<std::size_t> number(generators.size(), generators.size());
  for (std::size_t i = 0; i < kept.size(); ++i) number[kept[i]] = i;
  std::vector<std::size_t> facets;
  for (std::size_t f = 0; f < cone.rays.size(); ++f) {
    bool has_vertex = false;
    for_each(std::as_const(cone.zeros)[f],
             [&](std::size_t i) { has_vertex = has_vertex || is_vertex(generators[i]); });
    if (has_vertex) facets.push_back(f);
  }
  result.incidence = BitRows(kept.size(), facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for_each(std::as_const(cone.zeros)[facets[f]], [&](std::size_t i) {
      if (number[i] < generators.size()) insert(result.incidence[number[i]], f);
    });
    result.facets.push_back(std::move(cone.rays[facets[f]]));
  }
  for (const std::size_t i : kept) result.generators.push_back(std::move(generators[i]));
  make_canonical(result, Echelon(dimension + 1, cone.lines), lineality, threads);
  return result;
}

Description from_minimal_rows(Rows facets, const Rows& equations, Rows generators, const Rows& lines,
                              std::size_t dimension) {
  Description result;
  result.dimension = dimension;
  result.facets = std::move(facets);
  result.generators = std::move(generators);
  result.incidence = BitRows(result.generators.size(), result.facets.size());
  for (std::size_t i = 0; i < result.generators.size(); ++i) {
    internal::cancellation_point();
    for (std::size_t f = 0; f < result.facets.size(); ++f)
      if (scalar_product(result.generators[i], result.facets[f]) == 0) insert(result.incidence[i], f);
  }
  make_canonical(result, Echelon(dimension + 1, equations), Echelon(dimension + 1, lines), 1);
  return result;
}

BitRows Description::incidence_with_infinity() const {
  BitRows sets(generators.size(), facets.size() + 1);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    std::copy(incidence[i].begin(), incidence[i].end(), sets[i].begin());
    if (i >= num_vertices) insert(sets[i], facets.size());
  }
  return sets;
}

bool includes(const Description& whole, const Description& part) {
  if (part.is_empty()) return true;
  if (whole.is_empty()) return false;
  const auto all_on = [&](const Rows& rows, const Rows& functions) {
    return std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
      internal::cancellation_point();
      return std::all_of(functions.begin(), functions.end(),
                         [&](const Row& function) { return scalar_product(row, function) == 0; });
    });
  };
  return all_on(part.lines, whole.facets) && all_on(part.lines, whole.equations) &&
         all_on(part.generators, whole.equations) &&
         std::all_of(part.generators.begin(), part.generators.end(), [&](const Row& row) {
           internal::cancellation_point();
           return std::all_of(whole.facets.begin(), whole.facets.end(),
                              [&](const Row& facet) { return scalar_product(row, facet) >= 0; });
         });
}

}  // namespace delone::polyhedra
