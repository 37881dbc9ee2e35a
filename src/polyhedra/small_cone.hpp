// SPDX-License-Identifier: BSD-3-Clause
// Double description for small polyhedra in few dimensions, without allocating memory: what many of them at
// once are made by.
//
// Rows are doubles scaled to integers. A ray is a set of d rows on which it is zero, and the minors of these
// in binary64. Signs are certain where the sums of the magnitudes of all products are below 2^53, because
// nothing is rounded then; otherwise where they exceed the bound of the error, and where not, integers of 512
// bits decide. Vertices are the quotients of two minors, correctly rounded: in pairs of doubles, or exactly.
//
// Not all is done here: try_find() says no for polyhedra that are flat or have lines, for numbers of very
// different sizes, and for many rows or rays. It never says anything that is not certain.
#pragma once

#include "polyhedra/integer_rows.hpp"
#include "polyhedra/minors.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace delone::polyhedra {

class SmallCone {
 public:
  static constexpr std::size_t most_dimensions = most_rows_of_minors;
  static constexpr std::size_t most_rows = 63;  // beside that of infinity

  /// Finds the generators of {x : a·x ≤ b}: rows a of `matrix`, numbers b of `bounds`, finite ones. Returns
  /// false if this is not for it.
  bool try_find(std::span<const double> matrix, std::span<const double> bounds, std::size_t dimension);

  // What it has found. The polyhedron is empty if there are no vertices, and otherwise not flat.
  const std::vector<double>& vertices() const { return vertices_; }  ///< sorted, rounded to the nearest
  const Rows& rays() const { return directions_; }                   ///< primitive and sorted, d entries each

 private:
  static constexpr std::size_t most_rays = 256;
  static constexpr std::size_t most_entries = most_dimensions + 1;
  using Wide = boost::multiprecision::number<
      boost::multiprecision::cpp_int_backend<512, 512, boost::multiprecision::signed_magnitude,
                                             boost::multiprecision::unchecked, void>,
      boost::multiprecision::et_off>;
  using RowSet = std::uint64_t;

  struct Ray {
    RowSet zeros = 0;                                ///< of the rows so far those that it lies on
    std::array<std::uint8_t, most_dimensions> on{};  ///< d independent ones of them
    std::array<double, most_entries> x{}, magnitudes{};
    bool is_negated = false;  ///< whether x is the opposite of the minors
    bool is_exact = false;    ///< whether x is not rounded
  };
  /// A vertex before it is sorted.
  struct Corner {
    const Ray* ray;
    std::array<double, most_dimensions> at;
  };

  bool try_set_rows(std::span<const double> matrix, std::span<const double> bounds);
  bool try_begin(RowSet& done);
  bool try_cut(std::size_t row, RowSet done);
  bool try_make_ray(RowSet zeros, RowSet common, RowSet done, Ray& made) const;
  void set_minors(Ray& ray) const;
  bool is_surely_a_ray(const Ray& ray) const;
  static Wide as_wide(double x);
  int sign_at(std::size_t row, const Ray& ray) const;
  std::array<Wide, most_entries> exact_minors(const Ray& ray) const;
  Row exact_ray(const Ray& ray) const;
  bool is_edge(const Ray& a, const Ray& b) const;
  void collect();
  void round(Corner& corner) const;
  bool try_round(Corner& corner) const;
  bool precedes(const Corner& a, const Corner& b) const;

  std::size_t dimension_ = 0;
  std::vector<std::array<double, most_entries>> rows_;  // the first one is that of infinity
  std::array<RowSet, most_dimensions> axis_rows_{};     // those of the form x[c] ≤ b or ≥ b
  std::vector<Ray> rays_, next_;
  std::vector<double> vertices_;
  Rows directions_;
};

}  // namespace delone::polyhedra
