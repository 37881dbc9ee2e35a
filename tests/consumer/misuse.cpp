// SPDX-License-Identifier: BSD-3-Clause
// Mistakes that the compiler must refuse, one per value of MISUSE; 0 is the correct program. Those about
// types of points are in misuse_points.cpp.
#include <delone/delone.hpp>

#include <array>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

using Points = std::vector<std::array<double, 3>>;

#if MISUSE == 0
void print(const delone::Delaunay<3>& t) { std::cout << t.hash() << delone::check(t.to_data()); }
delone::Delaunay<3> correct(const Points& points) { return delone::Delaunay<3>(points); }
std::size_t any_kind(const delone::Triangulation& t) { return t.num_points(); }
std::size_t correct(const delone::Delaunay<3>& a, const delone::Regular<>& b) {
  return any_kind(a) + any_kind(b);
}
#elif MISUSE == 1   // no space has dimension −1
delone::Delaunay<-1> nowhere() { return delone::Delaunay<-1>(); }
#elif MISUSE == 2   // points of the plane in a triangulation of space
delone::Delaunay<3> too_short(const std::vector<std::array<double, 2>>& points) {
  return delone::Delaunay<3>(points);
}
#elif MISUSE == 3   // integers
delone::Delaunay<1> integers(const std::vector<long long>& points) { return delone::Delaunay<1>(points); }
#elif MISUSE == 4   // one point of the plane
void point_of_the_plane(delone::Delaunay<3>& t) { t.insert(std::array<double, 2>{1, 2}); }
#elif MISUSE == 5   // the id of a vertex is not the id of a cell
delone::VertexId mixed(const delone::Triangulation& t, delone::VertexId v) {
  return t.complex().vertex(v, 0);
}
#elif MISUSE == 6   // a triangulation is moved, never copied by accident
delone::Delaunay<3> copied(const delone::Delaunay<3>& t) { return t; }
#elif MISUSE == 7   // a triangulation is of some kind
delone::Triangulation sliced(delone::Delaunay<3>&& t) { return delone::Triangulation(std::move(t)); }
#elif MISUSE == 8   // owned as a triangulation of any kind
std::unique_ptr<delone::Triangulation> owned() { return std::make_unique<delone::Delaunay<3>>(); }
#elif MISUSE == 9   // deleted as one
void deleted(delone::Triangulation* t) { delete t; }
#elif MISUSE == 10  // weighted points take a weight
void without_weight(delone::Regular<3>& t) { t.insert({1, 2, 3}); }
#elif MISUSE == 11  // of how many dimensions?
delone::Delaunay<> which(const std::vector<double>& coordinates) { return delone::Delaunay<>(coordinates); }
#endif
