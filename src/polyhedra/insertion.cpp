// SPDX-License-Identifier: BSD-3-Clause
// Rows (c, b) are points c/b if each b is a power of two, and a facet of their hull is a ray. Otherwise they
// are halfspaces c·x + b ≥ 0, and vertices and directions are rays; row (0, 1) has all directions. Only the
// sets of rows that meet are taken from there, and coordinates are minors of these rows.
#include "polyhedra/insertion.hpp"

#include "base/progress_meter.hpp"
#include "base/stopwatch.hpp"
#include "polyhedra/arithmetic.hpp"
#include "polyhedra/minors.hpp"

#include <delone/convex_hull.hpp>
#include <delone/halfspaces.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <span>
#include <utility>
#include <vector>

namespace delone::polyhedra {
namespace {

/// Whether x is a double.
bool try_double(const Integer& x, double& rounded) {
  if (bit_length(x) > 1023) return false;
  rounded = x.convert_to<double>();
  return Integer(rounded) == x;
}
bool is_power_of_two(const Integer& x) {
  return x > 0 && boost::multiprecision::lsb(x) == boost::multiprecision::msb(x);
}

/// Options that end a construction after some seconds. Meanwhile the meter around it is asked.
class LimitedTime {
 public:
  explicit LimitedTime(double seconds) : seconds_(seconds), around_(internal::current_meter) {
    options_.progress = [this](double fraction) {
      fraction_ = fraction;
      try {
        if (around_ != nullptr) around_->poll();
      } catch (...) {
        failure_ = std::current_exception();
        return false;
      }
      return stopwatch_.seconds() < seconds_;
    };
  }
  const Options& options() const { return options_; }
  /// The share that was done when the clock was read last.
  double fraction() const { return fraction_; }
  /// Whether work() has come to its end in time. Throws what the meter around it does.
  template <class Work>
  bool allows(const Work& work) {
    try {
      work();
      return true;
    } catch (const Error& error) {
      if (failure_) std::rethrow_exception(failure_);
      if (error.code() == Errc::cancelled) return false;
      throw;
    }
  }

 private:
  double seconds_, fraction_ = 0;
  internal::ProgressMeter* around_;
  internal::Stopwatch stopwatch_;
  std::exception_ptr failure_;
  Options options_;
};

/// For each ray rows that it lies on.
using RowsOfRays = std::vector<std::vector<std::size_t>>;

/// Those of all rays, if the work has ended. None: the cone is flat.
struct FoundRows {
  bool has_ended = true;
  double fraction = 0;
  RowsOfRays rows;
};

FoundRows facets_of_hull(const PointedCone& cone, double seconds) {
  const std::size_t d = cone.first_rays.size() - 1;
  std::vector<double> coordinates;
  for (const Row& row : cone.rows) {
    double denominator = 0, numerator = 0;
    if (!try_double(row[d], denominator)) return {};
    for (std::size_t c = 0; c < d; ++c) {
      if (!try_double(row[c], numerator)) return {};
      coordinates.push_back(numerator / denominator);
      if (coordinates.back() * denominator != numerator) return {};  // subnormal
    }
  }
  LimitedTime time(seconds);
  FoundRows result;
  result.has_ended = time.allows([&] {
    const ConvexHull<> hull(PointsView(coordinates, static_cast<int>(d)), time.options());
    const HullData& data = hull.data();
    for (std::size_t f = 0; f < data.num_facets(); ++f) {
      const auto at = [&](std::size_t i) {
        return data.facet_vertices.begin() + static_cast<std::ptrdiff_t>(data.facet_offsets[i]);
      };
      result.rows.emplace_back(at(f), at(f + 1));
    }
  });
  result.fraction = time.fraction();
  return result;
}

FoundRows vertices_of_intersection(const PointedCone& cone, double seconds) {
  const std::size_t d = cone.first_rays.size() - 1;
  std::vector<double> halfspaces;
  std::size_t infinity = cone.rows.size();
  for (std::size_t i = 0; i < cone.rows.size(); ++i) {
    const Row& row = cone.rows[i];
    if (row[d] > 0 && std::all_of(row.begin(), row.end() - 1, [](const Integer& x) { return x == 0; }))
      infinity = i;
    double entry = 0;
    for (const Integer& x : row) {
      if (!try_double(x, entry)) return {};
      halfspaces.push_back(-entry);
    }
  }
  if (infinity == cone.rows.size()) return {};
  LimitedTime time(seconds);
  FoundRows result;
  result.has_ended = time.allows([&] {
    const HalfspaceIntersection<> intersection(halfspaces, static_cast<int>(d), time.options());
    if (intersection.state() != IntersectionState::full) return;
    const IntersectionData& data = intersection.data();
    for (std::size_t i = 0; i < data.num_vertices(); ++i) {
      const std::span<const SignedIndex> rows = data.halfspaces_of_vertex(i);
      result.rows.emplace_back(rows.begin(), rows.end());
    }
    for (std::size_t i = 0; i < data.num_directions(); ++i) {
      const std::span<const SignedIndex> rows = data.halfspaces_of_direction(i);
      result.rows.emplace_back(rows.begin(), rows.end()).push_back(infinity);
    }
  });
  result.fraction = time.fraction();
  return result;
}

/// The ray on which d − 1 of these rows are zero, with entries of type T, which all minors fit.
template <class T>
bool try_ray(const std::vector<const T*>& rows, std::size_t d, Row& ray) {
  std::array<T, most_dimensions_of_insertion> minors;
  find_minors(
      d - 1, [&](std::size_t row, std::size_t c) { return rows[row][c]; }, minors.data());
  ray.assign(minors.begin(), minors.begin() + static_cast<std::ptrdiff_t>(d));
  make_primitive(ray);
  return !is_zero(ray);
}

/// The rays that lie on these rows.
class RaysOfRows {
 public:
  explicit RaysOfRows(const PointedCone& cone) : cone_(cone), d_(cone.first_rays.size()) {
    // Minors are sums of products of one entry of each row, below the product of the sums of magnitudes.
    int bits = 0;
    for (const Row& row : cone.rows)
      for (const Integer& x : row) bits = std::max(bits, bit_length(x));
    constexpr int most_bits = 126, bits_of_sum = 3;  // of 7 entries
    if ((bits + bits_of_sum) * static_cast<int>(d_ - 1) > most_bits) return;
    for (const Row& row : cone.rows)
      for (const Integer& x : row) entries_.push_back(static_cast<Int128>(x));
  }

  Row ray_on(const std::vector<std::size_t>& rows) const {
    Row ray;
    if (rows.size() == d_ - 1) {
      const bool found = entries_.empty() ? try_ray(pointers<Integer>(rows), d_, ray)
                                          : try_ray(pointers<Int128>(rows), d_, ray);
      if (found) return directed(std::move(ray), rows);
    }
    Echelon echelon(d_);
    for (const std::size_t row : rows) echelon.add(cone_.rows[row]);
    return directed(echelon.kernel().front(), rows);
  }

 private:
  template <class T>
  std::vector<const T*> pointers(const std::vector<std::size_t>& rows) const {
    std::vector<const T*> result;
    for (const std::size_t row : rows)
      if constexpr (std::is_same_v<T, Integer>)
        result.push_back(cone_.rows[row].data());
      else
        result.push_back(entries_.data() + row * d_);
    return result;
  }
  /// With the sign for which all rows are not negative.
  Row directed(Row ray, const std::vector<std::size_t>& rows) const {
    for (std::size_t row = 0;; ++row) {
      if (std::find(rows.begin(), rows.end(), row) != rows.end()) continue;
      const Integer product = scalar_product(cone_.rows[row], ray);
      if (product == 0) continue;
      if (product < 0)
        for (Integer& x : ray) x = -x;
      return ray;
    }
  }

  const PointedCone& cone_;
  std::size_t d_;
  std::vector<Int128> entries_;  // of all rows, if minors fit
};

}  // namespace

InsertedRays find_rays_by_insertion(const PointedCone& cone, double seconds) {
  const std::size_t d = cone.first_rays.size();
  if (d < 3 || d > most_dimensions_of_insertion) return {};
  // Coordinates with other denominators are no doubles.
  const bool are_points = std::all_of(cone.rows.begin(), cone.rows.end(),
                                      [](const Row& row) { return is_power_of_two(row.back()); });
  const FoundRows found =
      are_points ? facets_of_hull(cone, seconds) : vertices_of_intersection(cone, seconds);
  if (!found.has_ended) return {std::nullopt, true, found.fraction};
  if (found.rows.empty()) return {};
  const RaysOfRows rays(cone);
  PointedRays result;
  result.zeros = BitRows(found.rows.size(), cone.rows.size());
  result.rays.reserve(found.rows.size());
  for (std::size_t i = 0; i < found.rows.size(); ++i) {
    internal::cancellation_point();
    for (const std::size_t row : found.rows[i]) insert(result.zeros[i], row);
    result.rays.push_back(rays.ray_on(found.rows[i]));
  }
  return {std::move(result), false, 1};
}

}  // namespace delone::polyhedra
