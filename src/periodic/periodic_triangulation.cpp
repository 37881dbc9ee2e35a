// SPDX-License-Identifier: BSD-3-Clause
// The members of PeriodicTriangulation.
#include "base/guarded.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "base/require_dimension.hpp"
#include "base/require_tolerance.hpp"
#include "periodic/periodic_hash.hpp"
#include "periodic/periodic_triangulation_impl.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <string>

namespace delone {

Lattice Lattice::box(std::span<const double> lengths) {
  std::vector<int> axes(lengths.size());
  std::iota(axes.begin(), axes.end(), 0);
  return box(lengths, axes);
}

Lattice Lattice::box(std::span<const double> lengths, std::span<const int> axes) {
  Lattice lattice;
  lattice.dimension = static_cast<int>(lengths.size());
  std::vector<bool> seen(lengths.size());
  for (const int axis : axes) {
    if (axis < 0 || axis >= lattice.dimension)
      throw Error(Errc::invalid_argument, "axis " + std::to_string(axis) + " is not one of the " +
                                              std::to_string(lengths.size()) + " of the box");
    const auto j = static_cast<std::size_t>(axis);
    if (seen[j]) throw Error(Errc::invalid_argument, "axis " + std::to_string(axis) + " is given twice");
    seen[j] = true;
    if (lengths[j] < 0)
      throw Error(Errc::invalid_argument, "length " + std::to_string(axis) + " of the box is negative");
    lattice.vectors.resize(lattice.vectors.size() + lengths.size(), 0.0);
    lattice.vectors[lattice.vectors.size() - lengths.size() + j] = lengths[j];
  }
  return lattice;
}

const periodic::CellClasses& PeriodicTriangulation::Impl::classes() const {
  const std::lock_guard lock(mutex_);
  if (!classes_) internal::guarded("the cells", [&] { classes_.emplace(ghosts, set); });
  return *classes_;
}

const periodic::Quotient& PeriodicTriangulation::Impl::quotient() const {
  const periodic::CellClasses& of_cells = classes();
  const std::lock_guard lock(mutex_);
  if (!quotient_)
    quotient_ = internal::guarded("the cells", [&] { return make_quotient(ghosts, set, of_cells); });
  return *quotient_;
}

bool PeriodicTriangulation::Impl::is_simplicial() const {
  const std::lock_guard lock(mutex_);
  if (!is_simplicial_)
    is_simplicial_ = internal::guarded("the edges", [&] { return periodic::is_simplicial(ghosts); });
  return *is_simplicial_;
}

PeriodicTriangulation::PeriodicTriangulation(std::span<const double> points, std::span<const double> weights,
                                             bool is_regular, const Lattice& lattice, int dimension,
                                             const PeriodicOptions& how, const Options& options) {
  const ArithmeticScope arithmetic;
  internal::require_dimension(dimension);
  internal::refuse_tolerance(options.tolerance, options.axis_tolerances, "triangulations");
  internal::require_time_limit(options.time_limit);
  if (lattice.dimension != dimension)
    throw Error(Errc::bad_dimension, "the lattice has " + std::to_string(lattice.dimension) +
                                         " dimensions, not " + std::to_string(dimension));
  const auto d = static_cast<std::size_t>(dimension);
  if (points.size() % d != 0)
    throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  const std::size_t n = points.size() / d;
  if (is_regular && weights.size() != n)
    throw Error(Errc::bad_dimension,
                std::to_string(weights.size()) + " weights for " + std::to_string(n) + " points");
  internal::guarded("the periodic triangulation", [&] {
    const internal::ProgressMeter meter(options.progress);
    periodic::SetInput input{points,   weights,  lattice.vectors, d, is_regular, how.exact,
                             how.wrap, how.unit, options.threads};
    impl_ = std::make_unique<Impl>(input, lattice, how, options);
    impl_->describe(points, weights);
  });
}

PeriodicTriangulation::PeriodicTriangulation(const PeriodicTriangulation& before,
                                             std::span<const double> points, std::span<const double> weights,
                                             const Lattice* lattice) {
  const Impl& from = *before.impl_;
  const auto d = static_cast<std::size_t>(from.lattice.dimension);
  const Lattice& of_step = lattice == nullptr ? from.given_lattice : *lattice;
  if (of_step.dimension != from.lattice.dimension ||
      of_step.vectors.size() != from.given_lattice.vectors.size())
    throw Error(Errc::bad_dimension, "moved: another lattice of rank " + std::to_string(of_step.rank()) +
                                         " in " + std::to_string(of_step.dimension) +
                                         " dimensions than that of the triangulation");
  if (points.size() != before.num_points() * d)
    throw Error(Errc::bad_dimension, "moved: " + std::to_string(points.size() / d) + " points for " +
                                         std::to_string(before.num_points()) + " rows");
  if (weights.size() != from.weights.size())
    throw Error(Errc::bad_dimension, "moved: " + std::to_string(weights.size()) + " weights for " +
                                         std::to_string(before.num_points()) + " points");
  internal::guarded("the periodic triangulation", [&] {
    const internal::ProgressMeter meter(from.options.progress);
    impl_ = std::make_unique<Impl>(
        periodic::SetInput{points, weights, of_step.vectors, d, from.set.weighted, from.how.exact,
                           from.how.wrap, from.how.unit, from.options.threads},
        of_step, from);
    impl_->describe(points, weights);
  });
}

PeriodicTriangulation::PeriodicTriangulation(PeriodicTriangulation&&) noexcept = default;
PeriodicTriangulation& PeriodicTriangulation::operator=(PeriodicTriangulation&&) noexcept = default;
PeriodicTriangulation::~PeriodicTriangulation() = default;

void PeriodicTriangulation::Impl::describe(std::span<const double> given,
                                           std::span<const double> given_weights) {
  lattice.dimension = given_lattice.dimension;
  for (const double x : set.lattice) lattice.vectors.push_back(set.outer(x));
  const std::size_t n = set.num_points(), r = set.rank;
  points = set.given_points(given, options.threads);
  weights.assign(given_weights.begin(), given_weights.end());
  vertex_of_point.resize(n);
  point_offsets.resize(n * r);
  constexpr std::size_t rows_in_part = 4096;
  std::atomic<std::size_t> vertices = 0, hidden = 0;
  internal::for_parts(options.threads, n, rows_in_part,
                      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                        stop();
                        std::vector<std::int64_t> offset(r);
                        std::size_t of_part = 0, hidden_of_part = 0;
                        for (std::size_t row = first; row < last; ++row) {
                          const VertexId v = ghosts.vertex_of_row(row);
                          if (v == invalid_vertex) {
                            vertex_of_point[row] = -1;
                            ++hidden_of_part;
                            continue;
                          }
                          const std::uint32_t same = ghosts.image_of(v).row;
                          vertex_of_point[row] = static_cast<SignedIndex>(same);
                          if (same == row) {
                            ++of_part;
                            continue;
                          }
                          for (std::size_t i = 0; i < r; ++i)
                            offset[i] = std::int64_t{set.wraps[row * r + i]} - set.wraps[same * r + i];
                          set.to_given_basis(offset, &point_offsets[row * r]);
                        }
                        vertices += of_part;
                        hidden += hidden_of_part;
                      });
  num_vertices = vertices;
  num_hidden = hidden;
}

int PeriodicTriangulation::dimension() const { return impl_->lattice.dimension; }
int PeriodicTriangulation::affine_dimension() const {
  return impl_->ghosts.triangulation().affine_dimension();
}
int PeriodicTriangulation::rank() const { return impl_->lattice.rank(); }
bool PeriodicTriangulation::is_regular() const { return impl_->set.weighted; }
std::size_t PeriodicTriangulation::num_points() const { return impl_->set.num_points(); }
std::size_t PeriodicTriangulation::num_vertices() const { return impl_->num_vertices; }
std::size_t PeriodicTriangulation::num_duplicates() const {
  return num_points() - impl_->num_vertices - impl_->num_hidden;
}
std::size_t PeriodicTriangulation::num_hidden() const { return impl_->num_hidden; }
std::size_t PeriodicTriangulation::num_cells() const {
  return cells().size() / static_cast<std::size_t>(std::max(affine_dimension(), 0) + 1);
}

const Lattice& PeriodicTriangulation::lattice() const { return impl_->lattice; }
double PeriodicTriangulation::displacement() const { return impl_->set.displacement; }
std::span<const double> PeriodicTriangulation::points() const { return impl_->points; }
std::span<const double> PeriodicTriangulation::weights() const { return impl_->weights; }
std::span<const SignedIndex> PeriodicTriangulation::cells() const { return impl_->quotient().cells; }
std::span<const std::int32_t> PeriodicTriangulation::cell_offsets() const {
  return impl_->quotient().cell_offsets;
}
std::span<const SignedIndex> PeriodicTriangulation::neighbors() const { return impl_->quotient().neighbors; }
std::span<const std::int32_t> PeriodicTriangulation::neighbor_offsets() const {
  return impl_->quotient().neighbor_offsets;
}
std::span<const SignedIndex> PeriodicTriangulation::vertex_of_point() const { return impl_->vertex_of_point; }
std::span<const std::int32_t> PeriodicTriangulation::point_offsets() const { return impl_->point_offsets; }
bool PeriodicTriangulation::is_simplicial() const { return impl_->is_simplicial(); }
std::size_t PeriodicTriangulation::num_ghosts() const { return impl_->ghosts.effort().num_ghosts; }
Statistics PeriodicTriangulation::statistics() const { return impl_->ghosts.triangulation().statistics(); }

ComplexData PeriodicTriangulation::to_data() const {
  return internal::guarded("a copy", [&] {
    const periodic::Quotient& made = impl_->quotient();
    ComplexData data;
    data.dimension = dimension();
    data.affine_dimension = affine_dimension();
    data.kind = is_regular() ? DataKind::periodic_regular : DataKind::periodic_delaunay;
    data.points = impl_->points;
    data.weights = impl_->weights;
    data.cells = made.cells;
    data.neighbors = made.neighbors;
    data.vertex_of_point = impl_->vertex_of_point;
    data.lattice = impl_->lattice.vectors;
    data.cell_offsets = made.cell_offsets;
    data.neighbor_offsets = made.neighbor_offsets;
    data.point_offsets = impl_->point_offsets;
    data.unit = impl_->set.unit;
    return data;
  });
}

CanonicalHash PeriodicTriangulation::hash(const Execution& how) const {
  return internal::guarded("the hash", [&] {
    const internal::ProgressMeter meter(how.progress);
    return periodic::hash_of(impl_->ghosts, impl_->set);
  });
}

}  // namespace delone
