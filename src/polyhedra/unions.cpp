// SPDX-License-Identifier: BSD-3-Clause
// What several polyhedra have in common, and the volume of their union.
#include "base/progress_meter.hpp"
#include "polyhedra/fraction.hpp"
#include "polyhedra/polyhedron_impl.hpp"

#include <delone/polyhedron.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace delone {

using polyhedra::Fraction;

namespace {

using Quotient =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

void require_one_dimension(std::span<const Polyhedron> polyhedra) {
  for (std::size_t i = 1; i < polyhedra.size(); ++i)
    if (polyhedra[i].dimension() != polyhedra[0].dimension())
      throw Error(Errc::bad_dimension, "polyhedron " + std::to_string(i) + " has dimension " +
                                           std::to_string(polyhedra[i].dimension()) + ", and the first one " +
                                           std::to_string(polyhedra[0].dimension()));
}

bool is_full(const Polyhedron& p) { return p.affine_dimension() == p.dimension(); }

/// Adds a part, unless it is flat or within another one. Removes parts that are within it.
void add_part(Polyhedron part, std::vector<Polyhedron>& parts) {
  if (!is_full(part)) return;
  for (const Polyhedron& other : parts) {
    internal::cancellation_point();
    if (other.includes(part)) return;
  }
  std::erase_if(parts, [&](const Polyhedron& other) {
    internal::cancellation_point();
    return part.includes(other);
  });
  parts.push_back(std::move(part));
}

/// The volume of the union of bounded polyhedra. Progress counts those whose share is known.
Quotient volume_of_union(std::span<const Polyhedron> polyhedra, const Options& how) {
  const std::function<bool(double)> none;
  internal::ProgressMeter progress(none, polyhedra.size());
  std::vector<Polyhedron> distinct;
  for (const Polyhedron& p : polyhedra) add_part(p, distinct);
  Quotient sum = 0;
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    progress(i);
    const Fraction volume = Fraction::of(*distinct[i].volume());
    sum += Quotient(volume.numerator, volume.denominator);
    std::vector<Polyhedron> common;
    for (std::size_t j = 0; j < i; ++j) add_part(distinct[i].intersection(distinct[j], how), common);
    sum -= volume_of_union(common, how);
  }
  return sum;
}

/// Adds one member after the other to each set of members, in lexicographic order. All that may come next
/// have equal shares of the progress of the set.
class IntersectionSearch {
 public:
  IntersectionSearch(std::span<const Polyhedron> polyhedra, std::size_t most_members, const Options& how)
      : most_members_(most_members), how_(how), progress_(none_, std::size_t{1} << 30) {
    for (std::size_t i = 0; i < polyhedra.size(); ++i)
      if (is_full(polyhedra[i])) single_.push_back({{i}, polyhedra[i]});
  }

  std::vector<PolyhedraIntersection> run() {
    if (most_members_ != 1)
      for (std::size_t i = 0; i < single_.size(); ++i)
        extend(single_[i], i + 1, share_of(i), share_of(i + 1));
    std::stable_sort(found_.begin(), found_.end(),
                     [](const auto& a, const auto& b) { return a.members.size() < b.members.size(); });
    return std::move(found_);
  }

 private:
  double share_of(std::size_t i) const {
    return static_cast<double>(i) / static_cast<double>(single_.size());
  }

  /// By the polyhedra from `next` on. Of the progress, this is from `begin` to `end`.
  void extend(const PolyhedraIntersection& part, std::size_t next, double begin, double end) {
    const double step = (end - begin) / static_cast<double>(std::max<std::size_t>(single_.size() - next, 1));
    for (; next < single_.size(); ++next, begin += step) {
      progress_(static_cast<std::size_t>(std::ldexp(begin, 30)));
      const PolyhedraIntersection& other = single_[next];
      PolyhedraIntersection smaller{part.members, part.polyhedron.intersection(other.polyhedron, how_)};
      if (!is_full(smaller.polyhedron)) continue;
      smaller.members.push_back(other.members.front());
      found_.push_back(smaller);
      if (most_members_ == 0 || smaller.members.size() < most_members_)
        extend(smaller, next + 1, begin, begin + step);
    }
  }

  const std::size_t most_members_;
  const Options how_;
  const std::function<bool(double)> none_;
  internal::ProgressMeter progress_;
  std::vector<PolyhedraIntersection> single_, found_;
};

}  // namespace

std::vector<PolyhedraIntersection> intersections(std::span<const Polyhedron> polyhedra,
                                                 std::size_t most_members, const Options& options) {
  require_one_dimension(polyhedra);
  const auto work = [&] {
    IntersectionSearch search(polyhedra, most_members, {.threads = options.threads});
    return search.run();
  };
  return polyhedra::within_limits(options, work, "polyhedra");
}

std::optional<Rational> union_volume(std::span<const Polyhedron> polyhedra, const Options& options) {
  require_one_dimension(polyhedra);
  const auto is_infinite = [](const Polyhedron& p) { return is_full(p) && !p.is_bounded(); };
  if (std::any_of(polyhedra.begin(), polyhedra.end(), is_infinite)) return std::nullopt;
  const auto work = [&] {
    const Quotient volume = volume_of_union(polyhedra, Options{.threads = options.threads});
    return std::optional(Fraction::to_rational(boost::multiprecision::numerator(volume),
                                               boost::multiprecision::denominator(volume)));
  };
  return polyhedra::within_limits(options, work, "polyhedra");
}

}  // namespace delone
