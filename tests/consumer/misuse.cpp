// SPDX-License-Identifier: BSD-3-Clause
// Mistakes that the compiler must refuse, one per value of MISUSE; 0 is the correct program.
#include <delone/delone.hpp>

#include <array>
#include <list>
#include <vector>

using Points = std::vector<std::array<double, 3>>;

#if MISUSE == 0
delone::Delaunay<3> correct(const Points& points) { return delone::Delaunay<3>(points); }
#elif MISUSE == 1  // no space has dimension 0
delone::Delaunay<0> nowhere() { return delone::Delaunay<0>(); }
#elif MISUSE == 2  // points of the plane in a triangulation of space
delone::Delaunay<3> too_short(const std::vector<std::array<double, 2>>& points) {
  return delone::Delaunay<3>(points);
}
#elif MISUSE == 3  // single precision would be read as garbage
delone::Delaunay<3> not_double(const std::vector<std::array<float, 3>>& points) {
  return delone::Delaunay<3>(points);
}
#elif MISUSE == 4  // a list is not contiguous
delone::Delaunay<3> scattered(const std::list<std::array<double, 3>>& points) {
  return delone::Delaunay<3>(points);
}
#elif MISUSE == 5  // the id of a vertex is not the id of a cell
delone::VertexId mixed(const delone::Triangulation& t, delone::VertexId v) {
  return t.complex().vertex(v, 0);
}
#elif MISUSE == 6  // a triangulation is moved, never copied by accident
delone::Delaunay<3> copied(const delone::Delaunay<3>& t) { return t; }
#elif MISUSE == 7  // of the right size, of the wrong type
delone::Delaunay<3> floats(const std::vector<std::array<float, 6>>& points) {
  return delone::Delaunay<3>(points);
}
#elif MISUSE == 8  // likewise
delone::Delaunay<1> integers(const std::vector<long long>& points) { return delone::Delaunay<1>(points); }
#endif
