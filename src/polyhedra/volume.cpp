// SPDX-License-Identifier: BSD-3-Clause
// The volume of a polytope as the sum of those of pyramids over its facets, face after face (after Cohen and
// Hickey, doi:10.1145/322139.322141). Each face is computed once.
//
// A face F of dimension k is measured by its projection onto k axes, J(F): the pivots of the reduced echelon
// form of its directions, which are the first columns that are independent. If G is a facet of F, columns
// that depend on earlier ones in F do so in G, so that J(G) is J(F) without one axis j. Let f be the linear
// function x_j − … of the axes J(F) that is constant on G, with the coefficient 1 at j. The pyramid over G
// with apex p measures |f(p) − f(G)|·measure(G)/k, as taking f for x_j does not change volumes.
#include "polyhedra/faces.hpp"

#include "base/progress_meter.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace delone::polyhedra {
namespace {

namespace mp = boost::multiprecision;
using Number = mp::number<mp::cpp_rational_backend, mp::et_off>;

class PyramidVolume {
 public:
  PyramidVolume(const Description& own, const BitRows& facets) : own_(own), facets_(facets) {}

  Number volume() {
    Face all(facets_.words(), 0);
    for (std::size_t i = 0; i < own_.num_vertices; ++i) insert(all, i);
    return measure(all, own_.dimension).volume;
  }

 private:
  struct Measured {
    std::vector<std::size_t> axes;  // increasing
    Rows directions;                // the reduced echelon form, in the order of the axes
    Number volume;
  };

  /// The direction from one vertex to another, times a positive number.
  Row direction(std::size_t from, std::size_t to) const {
    const Row &a = own_.generators[from], &b = own_.generators[to];
    Row row;
    for (std::size_t c = 0; c < own_.dimension; ++c) row.push_back(b[c] * a.back() - a[c] * b.back());
    return row;
  }
  Number coordinate(std::size_t vertex, std::size_t axis) const {
    return Number(own_.generators[vertex][axis], own_.generators[vertex].back());
  }

  const Measured& measure(const Face& face, std::size_t k) {
    if (const auto found = measured_.find(face); found != measured_.end()) return found->second;
    internal::cancellation_point();
    std::vector<std::size_t> vertices;
    for_each(face, [&](std::size_t i) { vertices.push_back(i); });
    Echelon echelon(own_.dimension);
    for (std::size_t i = 1; echelon.rank() < k; ++i) echelon.add(direction(vertices[0], vertices[i]));
    Measured result;
    result.axes = echelon.pivots();
    std::sort(result.axes.begin(), result.axes.end());
    result.directions = echelon.sorted_rows();
    result.volume = k == 0                     ? Number(1)
                    : vertices.size() == k + 1 ? simplex(vertices, result.axes)
                                               : pyramids(face, vertices[0], k, result.axes);
    return measured_.emplace(face, std::move(result)).first->second;
  }
  Number simplex(const std::vector<std::size_t>& vertices, const std::vector<std::size_t>& axes) const {
    const std::size_t k = axes.size();
    std::vector<Integer> matrix;
    Integer denominator = 1;
    for (std::size_t i = 1; i <= k; ++i) {
      const Row row = direction(vertices[0], vertices[i]);
      for (const std::size_t axis : axes) matrix.push_back(row[axis]);
      denominator *= own_.generators[vertices[0]].back() * own_.generators[vertices[i]].back() * i;
    }
    return Number(mp::abs(kernel::exact_determinant(std::move(matrix), k)), denominator);
  }
  Number pyramids(const Face& face, std::size_t apex, std::size_t k, const std::vector<std::size_t>& axes) {
    Number sum = 0;
    for (const Face& facet : largest_parts(face, facets_)) {
      if (test(facet, apex)) continue;
      const Measured& base = measure(facet, k - 1);
      std::size_t vertex = 0;
      while (!test(facet, vertex)) ++vertex;
      const auto difference = [&](std::size_t axis) {
        return coordinate(apex, axis) - coordinate(vertex, axis);
      };
      const std::size_t missing = *std::mismatch(axes.begin(), axes.end() - 1, base.axes.begin()).first;
      Number height = difference(missing);
      for (std::size_t i = 0; i < base.axes.size(); ++i)
        if (base.directions[i][missing] != 0)
          height -= Number(base.directions[i][missing], base.directions[i][base.axes[i]]) *
                    difference(base.axes[i]);
      sum += mp::abs(height) * base.volume;
    }
    return sum / static_cast<unsigned>(k);
  }

  const Description& own_;
  const BitRows& facets_;
  std::unordered_map<Face, Measured, FaceHash> measured_;
};

}  // namespace

ExactVolume volume_of(const Description& description, const BitRows& generators_of_facets) {
  const Number volume = PyramidVolume(description, generators_of_facets).volume();
  return {mp::numerator(volume), mp::denominator(volume)};
}

}  // namespace delone::polyhedra
