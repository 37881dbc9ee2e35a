// SPDX-License-Identifier: BSD-3-Clause
#include <delone/polyhedra_vertices.hpp>

#include "base/parallel_parts.hpp"
#include "base/require_dimension.hpp"
#include "polyhedra/fraction.hpp"
#include "polyhedra/polyhedron_impl.hpp"
#include "polyhedra/small_cone.hpp"

#include <delone/polyhedron.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>

namespace delone {
namespace {

using polyhedra::SmallCone;

/// The polyhedra that one thread takes at a time.
constexpr std::size_t polyhedra_in_part = 64;

/// What has been found of a part, with offsets that count from it.
struct PartOfVertices {
  std::vector<int> affine_dimensions;
  std::vector<std::size_t> num_vertices, num_rays, num_lines;
  std::vector<double> vertices, rays, lines;
};

void append(const std::vector<double>& from, std::vector<double>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

class VertexFinder {
 public:
  VertexFinder(std::span<const double> matrices, std::span<const double> bounds, std::size_t num_rows,
               std::size_t dimension)
      : matrices_(matrices), bounds_(bounds), num_rows_(num_rows), dimension_(dimension) {}

  void find(std::size_t polyhedron, PartOfVertices& part) {
    const auto a = matrices_.subspan(polyhedron * num_rows_ * dimension_, num_rows_ * dimension_);
    const auto b = bounds_.subspan(polyhedron * num_rows_, num_rows_);
    if (cone_.try_find(a, b, dimension_))
      take_cone(part);
    else
      take(polyhedron_of(a, b), part);
  }

 private:
  void take_cone(PartOfVertices& part) const {
    const std::size_t d = dimension_, count = cone_.vertices().size() / d;
    part.affine_dimensions.push_back(count == 0 ? -1 : static_cast<int>(d));
    part.num_vertices.push_back(count);
    part.num_rays.push_back(cone_.rays().size());
    part.num_lines.push_back(0);
    append(cone_.vertices(), part.vertices);
    if (cone_.rays().empty()) return;
    RationalRows rays;
    for (const polyhedra::Row& ray : cone_.rays()) {
      std::vector<Rational> row;
      for (const polyhedra::Integer& x : ray) row.push_back(polyhedra::Fraction::to_rational(x));
      rays.push_back(row);
    }
    append(rays.to_scaled_doubles(d), part.rays);
  }
  void take(const Polyhedron& found, PartOfVertices& part) const {
    part.affine_dimensions.push_back(found.affine_dimension());
    part.num_vertices.push_back(found.num_vertices());
    part.num_rays.push_back(found.num_rays());
    part.num_lines.push_back(found.num_lines());
    append(found.vertices().to_doubles(), part.vertices);
    append(found.rays().to_scaled_doubles(dimension_), part.rays);
    append(found.lines().to_scaled_doubles(dimension_), part.lines);
  }
  Polyhedron polyhedron_of(std::span<const double> a, std::span<const double> b) const {
    RationalRows rows;
    std::vector<Rational> row(dimension_ + 1);
    for (std::size_t i = 0; i < num_rows_; ++i) {
      std::copy_n(a.begin() + static_cast<std::ptrdiff_t>(i * dimension_), dimension_, row.begin());
      row[dimension_] = b[i];
      rows.push_back(row);
    }
    return Polyhedron::from_inequalities(rows, {}, static_cast<int>(dimension_));
  }

  std::span<const double> matrices_, bounds_;
  std::size_t num_rows_, dimension_;
  SmallCone cone_;
};

void require_finite(std::span<const double> numbers, std::size_t row_width, std::size_t num_rows,
                    const char* what) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (std::isfinite(numbers[i])) continue;
    const std::size_t row = i / row_width, polyhedron = row / num_rows;
    throw Error(Errc::not_finite,
                std::string(what) + " of row " + std::to_string(row % num_rows) + " of polyhedron " +
                    std::to_string(polyhedron) + " is not finite",
                {polyhedron});
  }
}

std::size_t checked_size(std::span<const double> matrices, std::span<const double> bounds,
                         std::size_t num_rows, int dimension) {
  internal::require_dimension(dimension);
  const auto d = static_cast<std::size_t>(dimension);
  if (num_rows == 0)
    throw Error(Errc::invalid_argument, "the number of rows of a polyhedron must be at least 1");
  if (bounds.size() % num_rows != 0 || matrices.size() != bounds.size() * d)
    throw Error(Errc::bad_dimension, std::to_string(matrices.size()) + " coefficients and " +
                                         std::to_string(bounds.size()) + " bounds for polyhedra of " +
                                         std::to_string(num_rows) + " rows in dimension " +
                                         std::to_string(dimension));
  require_finite(matrices, d, num_rows, "a coefficient");
  require_finite(bounds, 1, num_rows, "the bound");
  return bounds.size() / num_rows;
}

PolyhedraVertices joined(std::vector<PartOfVertices> parts, int dimension) {
  PolyhedraVertices all;
  all.dimension = dimension;
  all.vertex_offsets = all.ray_offsets = all.line_offsets = {0};
  const auto append_counts = [](const std::vector<std::size_t>& counts, std::vector<std::size_t>& offsets) {
    for (const std::size_t count : counts) offsets.push_back(offsets.back() + count);
  };
  for (PartOfVertices& part : parts) {
    internal::cancellation_point();
    all.affine_dimensions.insert(all.affine_dimensions.end(), part.affine_dimensions.begin(),
                                 part.affine_dimensions.end());
    append_counts(part.num_vertices, all.vertex_offsets);
    append_counts(part.num_rays, all.ray_offsets);
    append_counts(part.num_lines, all.line_offsets);
    append(part.vertices, all.vertices);
    append(part.rays, all.rays);
    append(part.lines, all.lines);
    part = {};
  }
  return all;
}

}  // namespace

PolyhedraVertices polyhedra_vertices(std::span<const double> matrices, std::span<const double> bounds,
                                     std::size_t num_rows, int dimension, const Options& options) {
  const std::size_t count = checked_size(matrices, bounds, num_rows, dimension);
  return internal::guarded("the polyhedra", [&] {
    internal::BuildLimits limits(options.memory_limit, options.time_limit, "polyhedra");
    limits.set_independent();
    internal::ProgressMeter progress(options.progress, count);
    return limits.guard([&] {
      std::vector<PartOfVertices> parts((count + polyhedra_in_part - 1) / polyhedra_in_part);
      const auto caller = std::this_thread::get_id();
      internal::work_in_parts(options.threads, count, polyhedra_in_part, [&] {
        return [&, finder = VertexFinder(matrices, bounds, num_rows, static_cast<std::size_t>(dimension))](
                   std::size_t first, std::size_t last, const internal::StopPoint& stop) mutable {
          for (std::size_t i = first; i < last; ++i) {
            stop();
            finder.find(i, parts[first / polyhedra_in_part]);
          }
          if (std::this_thread::get_id() == caller) progress(last);
        };
      });
      return joined(std::move(parts), dimension);
    });
  });
}

}  // namespace delone
