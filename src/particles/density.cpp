// SPDX-License-Identifier: BSD-3-Clause
// Masses over the volumes of stars, and the linear function of the results on a grid.
#include <delone/density.hpp>

#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/require_finite.hpp"
#include "particles/periodic_sites.hpp"
#include "particles/star_volumes.hpp"

#include <delone/error.hpp>
#include <delone/interpolation.hpp>
#include <delone/periodic_queries.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone {
namespace particles {
namespace {

constexpr int most_star_dimension = 12;

void require_masses(std::span<const double> masses, std::size_t rows) {
  if (!masses.empty() && masses.size() != rows)
    throw Error(Errc::bad_dimension,
                "masses: " + std::to_string(masses.size()) + " numbers, not " + std::to_string(rows));
  internal::require_finite(masses, 1, "the mass");
}

void require_stars(const Triangulation& triangulation) {
  if (triangulation.kind() != TriangulationKind::delaunay)
    throw Error(Errc::unsupported, "DTFE densities are those of a Delaunay triangulation");
  if (triangulation.affine_dimension() > most_star_dimension)
    throw Error(Errc::unsupported,
                "DTFE densities are available up to dimension " + std::to_string(most_star_dimension));
}

/// `vertex_of`: the vertex of each row, or invalid_index. `outer`: converts a volume to the numbers of the
/// caller.
template <class Outer>
std::vector<double> densities(const Triangulation& triangulation, std::vector<unsigned char> wanted,
                              std::span<const Index> vertex_of, std::span<const double> masses,
                              unsigned threads, const Outer& outer) {
  const int k = triangulation.affine_dimension();
  const Complex complex = triangulation.complex();
  std::vector<double> at(complex.num_vertex_slots(), 0.0);  // masses and then densities
  for (std::size_t row = 0; row < vertex_of.size(); ++row)
    if (vertex_of[row] != invalid_index) at[vertex_of[row]] += masses.empty() ? 1.0 : masses[row];
  if (k > 0) {
    const std::vector<double> volumes =
        star_volumes(triangulation, Stars(complex, std::move(wanted)), threads);
    for (std::size_t v = 0; v < at.size(); ++v)
      if (at[v] != 0) at[v] /= outer(volumes[v]) / (k + 1);
  }
  std::vector<double> result(vertex_of.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < result.size(); ++row)
    if (vertex_of[row] != invalid_index) result[row] = at[vertex_of[row]];
  return result;
}

/// Throws unless the grid has d dimensions. Returns the number of its parts.
std::size_t checked_size(const DensityGrid& grid, std::size_t d) {
  if (grid.origin.size() != d || grid.sides.size() != d * d || grid.shape.size() != d)
    throw Error(Errc::invalid_argument,
                "a grid for " + std::to_string(d) +
                    " dimensions has as many coordinates, sides and numbers of parts");
  const auto is_finite = [](double x) { return std::isfinite(x); };
  if (!std::ranges::all_of(grid.origin, is_finite) || !std::ranges::all_of(grid.sides, is_finite))
    throw Error(Errc::invalid_argument, "the origin and the sides of a grid are finite");
  std::size_t size = 1;
  for (const std::size_t parts : grid.shape) {
    if (parts == 0) throw Error(Errc::invalid_argument, "a grid has at least one part along each side");
    if (size > (std::size_t{1} << 40) / parts) throw Error(Errc::too_many, "a grid has at most 2^40 parts");
    size *= parts;
  }
  return size;
}

/// The centers of the parts of a grid that is `samples` times as fine.
class Places {
 public:
  Places(const DensityGrid& grid, std::size_t samples)
      : grid_(grid), samples_(samples), d_(grid.shape.size()) {}

  /// Appends the places in part `part` of the grid itself.
  void append(std::size_t part, std::vector<double>& places) const {
    std::vector<std::size_t> first(d_), inner(d_, 0);
    for (std::size_t j = d_; j-- > 0; part /= grid_.shape[j]) first[j] = part % grid_.shape[j];
    for (std::size_t j = 0; j < d_;) {
      for (std::size_t i = 0; i < d_; ++i) {
        double x = grid_.origin[i];
        for (std::size_t a = 0; a < d_; ++a)
          x += fraction(a, first[a] * samples_ + inner[a]) * grid_.sides[a * d_ + i];
        places.push_back(x);
      }
      for (j = 0; j < d_ && ++inner[j] == samples_; ++j) inner[j] = 0;
    }
  }

 private:
  double fraction(std::size_t axis, std::size_t i) const {
    return (static_cast<double>(i) + 0.5) / static_cast<double>(grid_.shape[axis] * samples_);
  }

  const DensityGrid& grid_;
  std::size_t samples_, d_;
};

/// Of a function that is 0 outside.
template <class Function>
std::vector<double> means_on_grid(std::size_t d, const Function& function, const DensityGrid& grid,
                                  std::size_t samples, const Execution& how) {
  const std::size_t size = checked_size(grid, d);
  if (samples == 0) throw Error(Errc::invalid_argument, "a part of a grid has at least one sample");
  std::size_t in_part = 1;
  for (std::size_t j = 0; j < d; ++j) {
    if (in_part > (std::size_t{1} << 24) / samples)
      throw Error(Errc::too_many, "a part of a grid has at most 2^24 samples");
    in_part *= samples;
  }
  const internal::ProgressMeter watch(how.progress);
  const double nothing[] = {0.0};
  std::vector<double> result(size), places, values;
  const std::size_t block = std::max<std::size_t>(1, (std::size_t{1} << 18) / in_part);
  internal::ProgressMeter meter(how.progress, size);
  const Places all(grid, samples);
  for (std::size_t first = 0; first < size; first += block) {
    const std::size_t last = std::min(first + block, size);
    places.clear();
    for (std::size_t part = first; part < last; ++part) all.append(part, places);
    values.assign((last - first) * in_part, 0.0);
    function.evaluate(places, values, {.fill = nothing}, {.threads = how.threads});
    for (std::size_t part = first; part < last; ++part) {
      double sum = 0;
      for (std::size_t i = 0; i < in_part; ++i) sum += values[(part - first) * in_part + i];
      result[part] = sum / static_cast<double>(in_part);
    }
    meter(last);
  }
  return result;
}

}  // namespace
}  // namespace particles

std::vector<double> dtfe_densities(const Triangulation& triangulation, std::span<const double> masses,
                                   const Execution& how) {
  particles::require_masses(masses, triangulation.num_rows());
  particles::require_stars(triangulation);
  return internal::guarded("the densities", [&] {
    const internal::ProgressMeter meter(how.progress);
    std::vector<Index> vertex_of(triangulation.num_rows(), invalid_index);
    for (std::size_t row = 0; row < vertex_of.size(); ++row)
      if (triangulation.has_row(row)) vertex_of[row] = index(triangulation.vertex_at(row));
    return particles::densities(triangulation, {}, vertex_of, masses, how.threads,
                                [](double volume) { return volume; });
  });
}

std::vector<double> dtfe_densities(const PeriodicTriangulation& triangulation, std::span<const double> masses,
                                   const Execution& how) {
  particles::require_masses(masses, triangulation.num_points());
  return internal::guarded("the densities", [&] {
    const internal::ProgressMeter meter(how.progress);
    const particles::PeriodicSites sites(triangulation);
    const Triangulation& ghosts = sites.triangulation();
    particles::require_stars(ghosts);
    const auto k = static_cast<std::size_t>(std::max(ghosts.affine_dimension(), 0));
    std::vector<Index> vertex_of;
    for (const SignedIndex row : triangulation.vertex_of_point())
      vertex_of.push_back(index(ghosts.vertex_at(static_cast<std::size_t>(row))));
    return particles::densities(ghosts, sites.have_cells(), vertex_of, masses, how.threads,
                                [&](double volume) { return sites.outer(volume, k); });
  });
}

DensityGrid DensityGrid::of(const Box& box, std::vector<std::size_t> shape) {
  const std::size_t d = box.low.size();
  if (box.high.size() != d)
    throw Error(Errc::bad_dimension, "the corners of the box have different numbers of coordinates");
  DensityGrid grid{box.low, std::vector<double>(d * d, 0.0), std::move(shape)};
  for (std::size_t j = 0; j < d; ++j) grid.sides[j * d + j] = box.high[j] - box.low[j];
  return grid;
}

DensityGrid DensityGrid::of(const Lattice& lattice, std::vector<std::size_t> shape) {
  if (lattice.rank() != lattice.dimension)
    throw Error(Errc::invalid_argument,
                "a grid of one period is for sets that are periodic along all directions; give it a box");
  return {std::vector<double>(static_cast<std::size_t>(lattice.dimension), 0.0), lattice.vectors,
          std::move(shape)};
}

std::vector<double> density_on_grid(const Triangulation& triangulation, std::span<const double> densities,
                                    const DensityGrid& grid, std::size_t samples, const Execution& how) {
  return internal::guarded("the grid", [&] {
    const LinearInterpolator function(triangulation, densities);
    return particles::means_on_grid(static_cast<std::size_t>(triangulation.dimension()), function, grid,
                                    samples, how);
  });
}

std::vector<double> density_on_grid(const PeriodicTriangulation& triangulation,
                                    std::span<const double> densities, const DensityGrid& grid,
                                    std::size_t samples, const Execution& how) {
  return internal::guarded("the grid", [&] {
    const PeriodicLinearInterpolator function(triangulation, densities, 1, {.threads = how.threads});
    return particles::means_on_grid(static_cast<std::size_t>(triangulation.dimension()), function, grid,
                                    samples, how);
  });
}

}  // namespace delone
