// SPDX-License-Identifier: BSD-3-Clause
// The canonical hash of a triangulation as plain data, from any source.
#include "complex/canonical_hash.hpp"

#include "base/guarded.hpp"
#include "base/progress_meter.hpp"

#include <delone/data.hpp>
#include <delone/error.hpp>
#include <delone/triangulation.hpp>

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <vector>

namespace delone {

std::string CanonicalHash::hex() const {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text(32, '0');
  for (std::size_t i = 0; i < 16; ++i) {
    text[15 - i] = digits[(high >> (4 * i)) & 15];
    text[31 - i] = digits[(low >> (4 * i)) & 15];
  }
  return text;
}

std::ostream& operator<<(std::ostream& out, const CanonicalHash& hash) { return out << hash.hex(); }

namespace {

// Adds each distinct tag once. Distinct points share a tag with probability below n²/2^129.
void add_distinct(const std::vector<complex::PointTag>& tags, complex::HashAccumulator& hash) {
  const std::size_t capacity = std::bit_ceil(2 * tags.size() + 1);
  std::vector<std::size_t> table(capacity, 0);  // 1 + row; 0 is an empty place
  for (std::size_t row = 0; row < tags.size(); ++row) {
    std::size_t place = tags[row].low & (capacity - 1);
    while (table[place] != 0 && tags[table[place] - 1] != tags[row]) place = (place + 1) & (capacity - 1);
    if (table[place] != 0) continue;
    table[place] = row + 1;
    hash.add_vertex(tags[row]);
  }
}

/// The tags of weighted points. Hidden points do not count. Weights count only if those of the vertices
/// differ.
std::vector<complex::PointTag> weighted_tags(const ComplexData& data, complex::HashAccumulator& hash) {
  const std::size_t n = data.num_points(), d = static_cast<std::size_t>(data.dimension);
  if (data.weights.size() != n)
    throw Error(Errc::invalid_argument,
                std::to_string(data.weights.size()) + " weights for " + std::to_string(n) + " points");
  std::vector<std::size_t> vertices;
  for (const SignedIndex row : data.cells)
    if (row >= 0 && static_cast<std::size_t>(row) < n) vertices.push_back(static_cast<std::size_t>(row));
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const bool weights_differ = std::any_of(vertices.begin(), vertices.end(), [&](std::size_t row) {
    return data.weights[row] != data.weights[vertices.front()];
  });
  std::vector<complex::PointTag> tags(n);
  std::vector<double> point(d + 1);
  for (const std::size_t row : vertices) {
    std::copy_n(data.points.begin() + static_cast<std::ptrdiff_t>(row * d), d, point.begin());
    point[d] = data.weights[row];
    tags[row] = complex::point_tag(point.data(), data.dimension + (weights_differ ? 1 : 0));
    hash.add_vertex(tags[row]);
  }
  return tags;
}

}  // namespace

CanonicalHash canonical_hash(const ComplexData& data, const Execution& how) {
  return internal::guarded("the hash", [&] {
    const internal::ProgressMeter meter(how.progress);
    if (data.is_periodic())
      throw Error(Errc::unsupported, "the hash of a periodic triangulation is that of PeriodicTriangulation");
    const std::size_t n = data.num_points();
    std::vector<complex::PointTag> tags(n);
    complex::HashAccumulator hash;
    if (data.weights.empty()) {
      internal::for_parts(
          how.threads, n, 16384, [&](std::size_t first, std::size_t last, const internal::StopPoint&) {
            for (std::size_t row = first; row < last; ++row)
              tags[row] = complex::point_tag(
                  data.points.data() + row * static_cast<std::size_t>(data.dimension), data.dimension);
          });
      if (std::find(data.vertex_of_point.begin(), data.vertex_of_point.end(), -1) ==
          data.vertex_of_point.end()) {
        add_distinct(tags, hash);
      } else {  // hidden points do not count
        std::vector<complex::PointTag> visible;
        for (std::size_t row = 0; row < n; ++row)
          if (row >= data.vertex_of_point.size() || data.vertex_of_point[row] >= 0)
            visible.push_back(tags[row]);
        add_distinct(visible, hash);
      }
    } else {
      tags = weighted_tags(data, hash);
    }
    const std::size_t corners = static_cast<std::size_t>(data.affine_dimension + 1);
    const auto add_cells = [&](std::size_t begin, std::size_t end, complex::HashAccumulator& some) {
      for (std::size_t cell = begin; cell < end; ++cell) {
        complex::PointTag sum;
        for (std::size_t i = 0; i < corners; ++i) {
          const SignedIndex row = data.cells[cell * corners + i];
          if (row < 0 || static_cast<std::size_t>(row) >= n)
            throw Error(Errc::invalid_argument, "cell " + std::to_string(cell) + " has the vertex " +
                                                    std::to_string(row) + ", but there are " +
                                                    std::to_string(n) + " points");
          sum += tags[static_cast<std::size_t>(row)];
        }
        some.add_cell(sum);
      }
    };
    complex::add_in_parts(how.threads, data.num_cells(), hash, add_cells);
    return hash.finish(data.dimension, data.affine_dimension);
  });
}

}  // namespace delone
