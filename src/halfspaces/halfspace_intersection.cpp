// SPDX-License-Identifier: BSD-3-Clause
// HalfspaceIntersectionBase: rows to distinct sites, rank, interior point; hull/boundary.hpp makes the
// boundary, intersection_arrays.hpp the arrays.
#include "base/build_limits.hpp"
#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/require_dimension.hpp"
#include "base/require_finite.hpp"
#include "base/require_tolerance.hpp"
#include "base/stopwatch.hpp"
#include "halfspaces/halfspace_cone.hpp"
#include "halfspaces/interior_point.hpp"
#include "halfspaces/intersection_arrays.hpp"
#include "halfspaces/row_sieve.hpp"
#include "halfspaces/sites_to_insert.hpp"
#include "kernel/direct.hpp"
#include "kernel/predicates.hpp"

#include <delone/arithmetic.hpp>
#include <delone/convex_hull.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <new>
#include <numeric>
#include <utility>

namespace delone {
namespace {

using halfspaces::InteriorPoint;
using halfspaces::IntersectionParts;
using halfspaces::SitesToInsert;

bool has_normal(const double* row, std::size_t d) {
  return std::any_of(row, row + d, [](double x) { return x != 0; });
}

std::string and_more(std::size_t more) {
  return more == 0 ? "" : " (and of " + std::to_string(more) + " more)";
}

}  // namespace

struct HalfspaceIntersectionBase::Impl {
  Impl(int dimension, Options given) : d(static_cast<std::size_t>(dimension)), options(std::move(given)) {}
  Impl(const Impl& other)
      : d(other.d),
        options(other.options),
        rows(other.rows),
        current(std::make_unique<IntersectionParts>(other.locked().parts)),
        order_seconds(other.order_seconds),
        build_seconds(other.build_seconds),
        most_threads(other.most_threads) {}

  std::size_t d;
  Options options;
  std::vector<double> rows;                    // m×(d+1)
  std::unique_ptr<IntersectionParts> current;  // analyse() gives sites to rows, under the mutex
  double order_seconds = 0, build_seconds = 0;
  unsigned most_threads = 1;
  mutable std::mutex mutex;
  mutable std::shared_ptr<const IntersectionData> data;

  std::size_t num_rows() const { return rows.size() / (d + 1); }

  /// The state, while no other thread changes it.
  struct Locked {
    std::unique_lock<std::mutex> lock;
    const IntersectionParts& parts;
  };
  Locked locked() const { return {std::unique_lock(mutex), *current}; }

  /// Throws unless all is well with new rows.
  void check_rows(std::span<const double> added) const {
    if (added.size() % (d + 1) != 0)
      throw Error(Errc::bad_dimension, "the number of entries is not a multiple of the dimension and one");
    internal::require_finite(added, d + 1, "an entry", "halfspace");
    if (added.size() / (d + 1) > max_index - 1 - num_rows())
      throw Error(Errc::too_many, "more halfspaces than this build has ids");
  }

  /// Throws unless p is strictly inside the rows from `first` on, which the error counts from 0.
  void check_interior(const std::vector<double>& all, std::size_t first, const InteriorPoint& p) const {
    std::vector<std::size_t> bad;
    for (std::size_t r = first; r * (d + 1) < all.size(); ++r) {
      const double* const row = &all[r * (d + 1)];
      // Then p is strictly inside, or the row has no normal and all points are.
      if (p.is_exact() &&
          kernel::direct_affine_form(row, p.rounded.data(), static_cast<int>(d)) == Sign::negative)
        continue;
      if (has_normal(row, d) ? !halfspaces::is_strictly_inside(row, p) : row[d] > 0) bad.push_back(r - first);
    }
    if (!bad.empty())
      throw Error(Errc::invalid_argument,
                  "the interior point is not strictly inside halfspace " + std::to_string(bad.front()) +
                      and_more(bad.size() - 1),
                  bad);
  }

  /// The first rows.
  void start(std::span<const double> given, const InteriorPoint* known) {
    check_rows(given);
    rows.assign(given.begin(), given.end());
    current = build(rows, known);
  }

  /// The state of all given rows, with an interior point or none known.
  std::unique_ptr<IntersectionParts> build(const std::vector<double>& all, const InteriorPoint* known) {
    if (known != nullptr) check_interior(all, 0, *known);
    auto next = std::make_unique<IntersectionParts>(d);
    const std::size_t m = all.size() / (d + 1);
    std::vector<std::size_t> proper;
    proper.reserve(m);
    for (std::size_t r = 0; r < m; ++r) {
      if (has_normal(&all[r * (d + 1)], d)) {
        proper.push_back(r);
      } else if (all[r * (d + 1) + d] > 0 && next->state == IntersectionState::full) {
        next->state = IntersectionState::empty;  // 0 < 0
        next->witness = {static_cast<SignedIndex>(r)};
      }
    }
    if (next->state == IntersectionState::full) {
      if (known != nullptr) {
        next->interior = *known;
      } else {
        halfspaces::InteriorSearch search = halfspaces::find_interior_point(all, static_cast<int>(d), proper);
        next->state = search.state;
        next->interior = std::move(search.point);
        next->witness.assign(search.witness.begin(), search.witness.end());
      }
    }
    internal::Stopwatch stopwatch;
    std::vector<Index> having_site(proper.begin(), proper.end());
    if (next->state == IntersectionState::full)
      next->redundant = halfspaces::remove_redundant(all, next->interior, options, having_site);
    next->add_rows(all, having_site);
    if (next->state != IntersectionState::full) return next;
    span_rows(*next);
    order_seconds += stopwatch.seconds();
    construct(*next, 1);
    return next;
  }

  /// Adds the sites of new rows and their dual points.
  void add_sites(IntersectionParts& parts, const std::vector<double>& all, std::size_t first) const {
    const std::span<const double> added = std::span(all).subspan(first * (d + 1));
    std::vector<Index> having_normal;
    for (std::size_t r = 0; r * (d + 1) < added.size(); ++r)
      if (has_normal(&added[r * (d + 1)], d)) having_normal.push_back(static_cast<Index>(r));
    parts.add_rows(added, having_normal);
  }

  /// The rank of the normals, its axes and a basis; then all dual points.
  void span_rows(IntersectionParts& parts) const {
    kernel::AffineHull normals(static_cast<int>(d));
    const std::vector<double> origin(d, 0.0);
    normals.add(origin.data());
    parts.basis = {0};
    for (Index site = 1; site < parts.sites.size() && normals.dimension() < static_cast<int>(d); ++site)
      if (normals.add(parts.sites.point(site))) parts.basis.push_back(site);
    parts.sites.axes = normals.axes();
    parts.sites.axes.push_back(static_cast<int>(d));
    parts.add_duals(0);
  }

  /// Inserts the sites from `first` on; makes the cone if there is none.
  void construct(IntersectionParts& parts, Index first) {
    if (parts.rank() == 0) return;
    internal::Stopwatch stopwatch;
    const SitesToInsert sites = halfspaces::sites_to_insert(parts, first, options);
    order_seconds += stopwatch.seconds();
    stopwatch.restart();
    std::vector<Index> order = sites.order;
    if (!parts.cone) {
      parts.cone.emplace(parts.sites, parts.basis,
                         halfspaces::view_from_inside(parts.sites, parts.basis, parts.interior));
      std::erase_if(order, [&](Index site) {
        return std::binary_search(parts.basis.begin(), parts.basis.end(), site);
      });
    } else {
      parts.cone->include_sites(first);
    }
    internal::ProgressMeter progress(options.progress, order.size());
    // As given means in that order.
    const bool is_shared =
        options.order != InsertionOrder::as_given && parts.cone->shares_batches_of(order.size());
    // The order of sites is no function of timing; that of their rows is none either.
    if (is_shared || parts.cone->was_shared()) parts.cone->prepare_for_threads(order);
    const unsigned threads =
        is_shared ? engine::threads_for_batch(options.threads, order.size(), parts.rank() - 1) : 1;
    parts.cone->insert_all(order, sites.rounds, threads, [&](std::size_t done) { progress(done); });
    most_threads = std::max(most_threads, threads);
    build_seconds += stopwatch.seconds();
  }

  /// Adds rows, all or none.
  void add(std::span<const double> added) {
    check_rows(added);
    if (added.empty()) return;
    const std::size_t first = num_rows();
    const double order_before = order_seconds, build_before = build_seconds;
    rows.insert(rows.end(), added.begin(), added.end());
    try {
      const bool is_full = current->state == IntersectionState::full;
      if (is_full) check_interior(rows, first, current->interior);
      if (is_full && current->cone && !raises_rank(added))
        extend(*current, first);
      else
        current = build(rows, is_full ? &current->interior : nullptr);
    } catch (...) {
      rows.resize(first * (d + 1));
      order_seconds = order_before;
      build_seconds = build_before;
      throw;
    }
    data.reset();
  }

  /// Inserts the rows from `first` on into a cone whose rank they do not raise, all or none.
  void extend(IntersectionParts& parts, std::size_t first) {
    parts.give_redundant_rows_sites(rows);
    const sites::GrowingSites::Mark before = parts.sites.mark();
    parts.cone->begin_batch();
    try {
      add_sites(parts, rows, first);
      construct(parts, static_cast<Index>(before.sites));
    } catch (...) {
      parts.cone->undo_batch();
      parts.sites.rollback(before);
      throw;
    }
    parts.cone->keep_batch();
  }

  bool raises_rank(std::span<const double> added) const {
    if (current->rank() == static_cast<int>(d)) return false;
    kernel::AffineHull normals(static_cast<int>(d));
    const std::vector<double> origin(d, 0.0);
    normals.add(origin.data());
    for (const Index site : current->basis)
      if (site != 0) normals.add(current->sites.point(site));
    for (std::size_t i = 0; i < added.size(); i += d + 1)
      if (normals.add(&added[i])) return true;
    return false;
  }

  template <class Work>
  void within_limits(Work&& work) const {
    internal::BuildLimits limits(options.memory_limit, options.time_limit, "halfspaces");
    const internal::ProgressMeter meter(options.progress);
    limits.guard(std::forward<Work>(work));
  }

  const std::shared_ptr<const IntersectionData>& analyse() const {
    const std::lock_guard lock(mutex);
    if (!data) {
      data = internal::guarded("the faces of the intersection", [&] {
        current->give_redundant_rows_sites(rows);
        return std::make_shared<const IntersectionData>(halfspaces::intersection_arrays(*current));
      });
    }
    return data;
  }

  IntersectionVertices vertices() const {
    const std::lock_guard lock(mutex);
    if (data) return {data->bounded, data->vertices, data->vertex_offsets, data->vertex_halfspaces};
    return internal::guarded("the vertices of the intersection",
                             [&] { return halfspaces::intersection_vertices(*current); });
  }
};

HalfspaceIntersectionBase::HalfspaceIntersectionBase(const AnyPoints<>& halfspaces, int dimension,
                                                     const Options& options) {
  const ArithmeticScope arithmetic;
  internal::require_dimension(dimension);
  internal::refuse_tolerance(options.tolerance, options.axis_tolerances, "intersections of halfspaces");
  halfspaces.require_dimension(dimension + 1);
  internal::guarded("the intersection", [&] {
    impl_ = std::make_unique<Impl>(dimension, options);
    impl_->within_limits([&] { impl_->start(halfspaces.coordinates(), nullptr); });
  });
}

HalfspaceIntersectionBase::HalfspaceIntersectionBase(const AnyPoints<>& halfspaces, int dimension,
                                                     std::span<const double> interior_point,
                                                     const Options& options) {
  const ArithmeticScope arithmetic;
  internal::require_dimension(dimension);
  internal::refuse_tolerance(options.tolerance, options.axis_tolerances, "intersections of halfspaces");
  halfspaces.require_dimension(dimension + 1);
  if (interior_point.size() != static_cast<std::size_t>(dimension))
    throw Error(Errc::bad_dimension, "the interior point has not as many coordinates as the space");
  for (const double x : interior_point)
    if (!std::isfinite(x)) throw Error(Errc::not_finite, "a coordinate of the interior point is not finite");
  internal::guarded("the intersection", [&] {
    impl_ = std::make_unique<Impl>(dimension, options);
    InteriorPoint point;
    point.rounded.assign(interior_point.begin(), interior_point.end());
    impl_->within_limits([&] { impl_->start(halfspaces.coordinates(), &point); });
  });
}

HalfspaceIntersectionBase::HalfspaceIntersectionBase(detail::Clone, const HalfspaceIntersectionBase& other)
    : impl_(internal::guarded("the intersection", [&] { return std::make_unique<Impl>(*other.impl_); })) {}
HalfspaceIntersectionBase::HalfspaceIntersectionBase(HalfspaceIntersectionBase&&) noexcept = default;
HalfspaceIntersectionBase& HalfspaceIntersectionBase::operator=(HalfspaceIntersectionBase&&) noexcept =
    default;
HalfspaceIntersectionBase::~HalfspaceIntersectionBase() = default;

void HalfspaceIntersectionBase::insert_rows(const AnyPoints<>& halfspaces) {
  halfspaces.require_dimension(dimension() + 1);
  internal::guarded("the intersection",
                    [&] { impl_->within_limits([&] { impl_->add(halfspaces.coordinates()); }); });
}

int HalfspaceIntersectionBase::dimension() const { return static_cast<int>(impl_->d); }
int HalfspaceIntersectionBase::rank() const { return impl_->current->rank(); }
std::size_t HalfspaceIntersectionBase::num_halfspaces() const { return impl_->num_rows(); }
IntersectionState HalfspaceIntersectionBase::state() const { return impl_->current->state; }
std::size_t HalfspaceIntersectionBase::count(HalfspaceKind kind) const {
  return static_cast<std::size_t>(std::count(data().kinds.begin(), data().kinds.end(), kind));
}
const IntersectionData& HalfspaceIntersectionBase::data() const { return *impl_->analyse(); }
std::shared_ptr<const IntersectionData> HalfspaceIntersectionBase::shared_data() const {
  return impl_->analyse();
}
IntersectionVertices HalfspaceIntersectionBase::to_vertices() const { return impl_->vertices(); }
IntersectionData HalfspaceIntersectionBase::to_data() const {
  IntersectionData copy = data();
  copy.halfspaces = impl_->rows;
  return copy;
}

Measure HalfspaceIntersectionBase::volume() const {
  const ArithmeticScope arithmetic;
  const IntersectionData& found = data();
  if (found.state != IntersectionState::full) return {};
  if (!found.bounded) return {.value = std::numeric_limits<double>::infinity()};
  Options options = impl_->options;
  options.memory_limit = 0;  // limits are those of insertions
  options.time_limit = 0;
  const ConvexHull<> hull(found.vertices, dimension(), options);
  // Rounded vertices may be flat, where a hull has the volume within its flat.
  return hull.affine_dimension() == dimension() ? hull.volume() : Measure();
}
double HalfspaceIntersectionBase::volume_of_faces() const {
  const ArithmeticScope arithmetic;
  return halfspaces::volume_of_faces(impl_->locked().parts);
}
Measure HalfspaceIntersectionBase::dual_volume() const {
  const ArithmeticScope arithmetic;
  return halfspaces::dual_measure(impl_->locked().parts, true);
}
Measure HalfspaceIntersectionBase::dual_area() const {
  const ArithmeticScope arithmetic;
  return halfspaces::dual_measure(impl_->locked().parts, false);
}

std::size_t HalfspaceIntersectionBase::num_cells() const {
  const ArithmeticScope arithmetic;
  const auto& [lock, parts] = impl_->locked();
  return parts.cone ? parts.cone->make_hull().num_cells() : 0;
}

Statistics HalfspaceIntersectionBase::statistics() const {
  Statistics s;
  s.order_seconds = impl_->order_seconds;
  s.build_seconds = impl_->build_seconds;
  s.threads = impl_->most_threads;
  const auto& [lock, parts] = impl_->locked();
  if (!parts.cone) return s;
  const engine::Effort effort = parts.cone->effort();
  s.created_cells = effort.created_cells;
  s.visited_cells = effort.visited_cells;
  s.insertions = parts.cone->insertions();
  s.filter = effort.stages.filter;
  s.direct = effort.stages.direct;
  s.exact = effort.stages.exact;
  s.perturbed = effort.stages.perturbed;
  s.cell_bytes = parts.cone->bytes();
  return s;
}

}  // namespace delone
