// SPDX-License-Identifier: BSD-3-Clause
// What the tests of files of results share: archives as numpy.savez makes them, and small triangulations.
#pragma once

#include "../io_support.hpp"
#include "io/atomic_file.hpp"
#include "io/zip.hpp"

#include <string>
#include <utility>
#include <vector>

namespace delone_test {

using delone::ComplexData;
using delone::SignedIndex;
using Indices = std::vector<SignedIndex>;

/// A folder for files.
class ResultFiles : public delone_test::TemporaryDirectory {
 protected:
  /// An archive as numpy.savez makes it.
  std::string npz(const std::string& name,
                  const std::vector<std::pair<std::string, std::string>>& members) const {
    delone::io::AtomicFile out(path(name));
    delone::io::ZipWriter zip(out);
    for (const auto& [member, bytes] : members) zip.add(member + ".npy", bytes, "");
    zip.finish();
    out.commit();
    return path(name);
  }
};

/// Two triangles of a square, and a duplicate of its first corner.
inline ComplexData square() {
  ComplexData data;
  data.dimension = 2;
  data.affine_dimension = 2;
  data.points = {0, 0, 1, 0, 0, 1, 1, 1.5, 0, 0};
  data.cells = {0, 1, 2, 1, 3, 2};
  data.neighbors = {1, -1, -1, -1, 0, -1};
  data.vertex_of_point = {0, 1, 2, 3, 0};
  return data;
}

/// One cell of dimension k, in R^d, with awkward coordinates.
inline ComplexData one_cell(int k, int d) {
  ComplexData data;
  data.dimension = d;
  data.affine_dimension = k;
  for (int i = 0; i <= k; ++i) {
    for (int j = 0; j < d; ++j) data.points.push_back(i == j + 1 ? 0.1 : -0.0);
    data.cells.push_back(i);
    data.neighbors.push_back(-1);
    data.vertex_of_point.push_back(i);
  }
  return data;
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

inline void expect_same(const ComplexData& a, const ComplexData& b, bool all_members,
                        const std::string& what) {
  EXPECT_EQ(a.dimension, b.dimension) << what;
  EXPECT_EQ(a.affine_dimension, b.affine_dimension) << what;
  ASSERT_EQ(a.points.size(), b.points.size()) << what;
  EXPECT_TRUE(same_bits(a.points, b.points)) << what;
  EXPECT_EQ(a.cells, b.cells) << what;
  if (all_members) {
    EXPECT_EQ(a.neighbors, b.neighbors) << what;
    EXPECT_EQ(a.vertex_of_point, b.vertex_of_point) << what;
    EXPECT_TRUE(same_bits(a.weights, b.weights)) << what;
  }
}

}  // namespace delone_test
