// SPDX-License-Identifier: BSD-3-Clause
// What cannot be done with hulls, intersections and diagrams, one mistake per value of MISUSE; 0 is the
// correct program.
#include <delone/delone.hpp>

#include <array>
#include <memory>
#include <vector>

using Points = std::vector<std::array<double, 3>>;

#if MISUSE == 0
std::size_t correct(const Points& points) {
  const delone::ConvexHull hull(points);
  const delone::ConvexHullBase& base = hull;
  delone::ConvexHull<3> copy = hull.clone();
  copy.insert({1, 2, 3});
  const delone::Delaunay triangulation(points);
  const delone::Voronoi diagram(triangulation);
  const delone::PowerDiagram<> power(delone::Regular<>(3));
  const delone::FurthestVoronoi furthest{delone::FurthestSite(points)};
  return base.num_facets() + copy.num_facets() + diagram.num_regions() + power.num_regions() +
         furthest.num_regions();
}
#elif MISUSE == 1   // a base has no object of its own: nothing to delete
void deleted(delone::ConvexHullBase* hull) { delete hull; }
#elif MISUSE == 2   // likewise
void owned(std::unique_ptr<delone::HalfspaceIntersectionBase> intersection) { intersection.reset(); }
#elif MISUSE == 3   // nor to copy: that would cut the product off
void sliced(const delone::ConvexHull<3>& hull) { const delone::ConvexHullBase copy = hull; }
#elif MISUSE == 4   // copies are made by clone()
delone::LowerHull<3> copied(const delone::LowerHull<3>& hull) { return hull; }
#elif MISUSE == 5   // points of another dimension
delone::ConvexHull<2> too_long(const Points& points) { return delone::ConvexHull<2>(points); }
#elif MISUSE == 6   // halfspaces of the plane have three numbers
delone::HalfspaceIntersection<3> too_short(const Points& rows) {
  return delone::HalfspaceIntersection<3>(rows);
}
#elif MISUSE == 7   // a lower hull needs a composition
delone::LowerHull<1> nothing_below() { return delone::LowerHull<1>(std::vector<double>{1, 2}); }
#elif MISUSE == 8   // the dual of furthest sites is another diagram
delone::Voronoi<3> furthest(const delone::FurthestSite<3>& t) { return delone::Voronoi<3>(t); }
#elif MISUSE == 9   // the dual of weighted points is a power diagram
std::size_t weighted(const delone::Regular<3>& t) { return delone::Voronoi(t).num_regions(); }
#elif MISUSE == 10  // a triangulation of any kind may be one of these
std::size_t unknown(const delone::Triangulation& t) { return delone::Voronoi(t).num_regions(); }
#elif MISUSE == 11  // without weights there is no power
std::size_t weightless(const delone::Delaunay<3>& t) { return delone::PowerDiagram(t).num_regions(); }
#elif MISUSE == 12  // a diagram as such is made from nothing
std::size_t base(const delone::Delaunay<3>& t) {
  return delone::Diagram(t, {}, delone::DiagramOptions{}, delone::Execution{}).num_regions();
}
#elif MISUSE == 13  // nearest sites have another dual
std::size_t nearest(const delone::Delaunay<3>& t) { return delone::FurthestVoronoi(t).num_regions(); }
#endif
