// SPDX-License-Identifier: BSD-3-Clause
#include "check/periodic_cells.hpp"

#include "check/levels.hpp"
#include "kernel/predicates.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace delone::internal {

PeriodicCells::PeriodicCells(const ComplexData& data)
    : data_(data), corners_(static_cast<std::size_t>(data.affine_dimension + 1)) {
  periodic::SetInput input;
  input.points = data.points;
  input.weights = data.weights;
  input.lattice = data.lattice;
  input.dimension = static_cast<std::size_t>(data.dimension);
  input.is_weighted = !data.weights.empty();
  input.unit = data.unit;
  try {
    set_ = periodic::make_periodic_set(input);
  } catch (const Error& error) {
    if (error.code() != Errc::invalid_argument) throw;
    throw Violation{error.what()};
  }
  if (set_.displacement > 0)
    throw Violation{
        fmt::format("points or lattice vectors are not on the grid of the box, but up to {} away from it",
                    set_.displacement)};
  // The inverse of an integer matrix of determinant ±1, column by column.
  const std::size_t r = set_.rank;
  to_reduced_.resize(r * r);
  for (std::size_t column = 0; column < r; ++column) {
    std::vector<kernel::Integer> augmented;
    for (std::size_t i = 0; i < r; ++i) {
      for (std::size_t l = 0; l < r; ++l) augmented.emplace_back(set_.sums[i * r + l]);
      augmented.emplace_back(i == column ? 1 : 0);
    }
    const kernel::Fractions solution = kernel::solve_exactly(std::move(augmented), r);
    for (std::size_t i = 0; i < r; ++i)
      to_reduced_[i * r + column] =
          static_cast<std::int64_t>(kernel::Integer(solution.numerators[i] * solution.denominator));
  }
  kernel::AffineHull hull(data.dimension);
  for (std::size_t row = 0; row < set_.num_points(); ++row)
    if (hull.dimension() < data.dimension) hull.add(set_.row(row));
  for (std::size_t i = 0; i < r && set_.num_points() > 0; ++i) {
    std::vector<double> x(set_.row(0), set_.row(0) + data.dimension);
    for (std::size_t j = 0; j < x.size(); ++j) x[j] += set_.period.vector(i)[j];
    hull.add(x.data());
  }
  axes_ = hull.axes();
}

PeriodicVertex PeriodicCells::vertex(std::size_t cell, std::size_t i) const {
  const std::size_t entry = cell * corners_ + i, r = rank();
  PeriodicVertex v{data_.cells[entry], {}};
  for (std::size_t l = 0; l < r; ++l) v.offset.push_back(data_.cell_offsets[entry * r + l]);
  return v;
}

std::vector<PeriodicVertex> PeriodicCells::vertices(std::size_t cell) const {
  std::vector<PeriodicVertex> all;
  for (std::size_t i = 0; i < corners_; ++i) all.push_back(vertex(cell, i));
  return all;
}

std::vector<PeriodicVertex> PeriodicCells::neighbor_of(std::size_t cell, std::size_t i) const {
  const std::size_t entry = cell * corners_ + i, r = rank();
  std::vector<PeriodicVertex> all = vertices(static_cast<std::size_t>(data_.neighbors[entry]));
  for (PeriodicVertex& v : all)
    for (std::size_t l = 0; l < r; ++l) v.offset[l] += data_.neighbor_offsets[entry * r + l];
  return all;
}

/// Component i, in terms of the reduced lattice, of the translation from the row in the box.
std::int64_t PeriodicCells::shift(const PeriodicVertex& v, std::size_t i) const {
  const std::size_t r = rank();
  std::int64_t sum = set_.wraps[static_cast<std::size_t>(v.row) * r + i];
  for (std::size_t l = 0; l < r; ++l) sum += v.offset[l] * to_reduced_[l * r + i];
  return sum;
}

bool PeriodicCells::is_same_place(const PeriodicVertex& v, const PeriodicVertex& w) const {
  for (std::size_t i = 0; i < rank(); ++i)
    if (shift(v, i) != shift(w, i)) return false;
  const double *const a = set_.row(static_cast<std::size_t>(v.row)), *const b = set_.row(
                                                                         static_cast<std::size_t>(w.row));
  return std::equal(a, a + set_.row_size(), b);
}

std::vector<double> PeriodicCells::place(const PeriodicVertex& v, const PeriodicVertex& base,
                                         std::size_t cell) const {
  const double* const row = set_.row(static_cast<std::size_t>(v.row));
  std::vector<double> x(row, row + set_.row_size());
  std::vector<std::int32_t> k(rank());
  for (std::size_t i = 0; i < rank(); ++i) {
    const std::int64_t apart = shift(v, i) - shift(base, i);
    if (apart > set_.period.reach(i) || apart < -set_.period.reach(i))
      throw Violation{
          fmt::format("cell {} or a neighbor of it is larger than the empty spheres of the lattice", cell),
          {cell}};
    k[i] = static_cast<std::int32_t>(apart);
  }
  set_.period.translate(k, x.data());
  return x;
}

}  // namespace delone::internal
