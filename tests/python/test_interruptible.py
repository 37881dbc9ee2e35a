# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C ends every call that can take long within a second. The table has an entry for each public function, class and member of the
module: one that is new fails test_the_table_is_complete until it has one."""
import importlib
import inspect
import signal
import subprocess
import sys

import pytest

from hostile_support import MODULES, classes, is_large

# Entries that return what is there, or make one pass over what they return: a second for some 10^8 numbers.
QUICK = {
    "delone.ConvexHull": "__repr__ affine_dimension axes axis_tolerances columns dimension max_distance num_cells num_duplicates num_points plot statistics to_frame to_meshio "
                         "to_pyvista to_vtk tolerance",
    "delone.LowerHull": "__getstate__ __len__ __repr__ cells columns composition_axes composition_dimension dimension facet_of_cell max_distance neighbors "
                        "num_cells num_facets num_points plot points side to_data to_meshio to_pyvista to_vtk tolerance vertices",
    "delone.Data": "__init__ __reduce__ __repr__ columns members",
    "delone.ComplexData": "__init__",
    "delone.ConvexHulls": "__getitem__ __init__ __iter__ __len__ __repr__",
    "delone.Changes": "__init__ __repr__",
    "delone.ClippedRegions": "__getitem__ __init__ __iter__ __len__ __repr__",
    "delone.Delaunay": "__getstate__",
    "delone.SiteCells": "__init__ __len__ __repr__ neighbors_of polygons_of",
    "delone.FurthestSite": "__copy__ __getstate__ clone hidden num_hidden",
    "delone.Regular": "__copy__ __getstate__ clone hidden num_hidden weights",
    "delone.HalfspaceIntersection": "__getstate__ columns dimension halfspaces num_halfspaces plot rank state statistics to_meshio to_pyvista "
                                    "to_vtk",
    "delone._core.PeriodicTriangulation": "__len__ __repr__ affine_dimension dimension displacement lattice num_cells num_duplicates num_ghosts num_hidden "
                                          "num_points num_vertices point_offsets points rank statistics vertex_of_point",
    "delone.PeriodicRegular": "weights",
    "delone.PeriodicFaces": "__init__ __len__ __repr__",
    "delone.NeighborChanges": "__init__ __repr__",
    "delone.PeriodicLinearInterpolator": "__getstate__ __repr__ triangulation values",
    "delone.PeriodicNaturalNeighborInterpolator": "__getstate__ __repr__ triangulation values",
    "delone.PolyhedraVertices": "__getitem__ __init__ __iter__ __len__ __repr__",
    "delone.Polyhedron": "__repr__ affine_dimension dimension empty facets_of_ray facets_of_vertex is_bounded is_empty num_equations num_inequalities "
                         "num_lines num_rays num_vertices rays_of_facet redundant_rows row_kinds space vertices_of_facet",
    "delone.LinearInterpolator": "__getstate__ __repr__ tolerance triangulation values",
    "delone.NaturalNeighborInterpolator": "__getstate__ __repr__ smooth tolerance triangulation values",
    "delone.PowerDiagram": "__repr__ weights",
    "delone.FurthestVoronoi": "__repr__",
    "delone.Voronoi": "__repr__",
    "delone.TrimResult": "__getstate__ __repr__ cells depth kept lost_volume neighbors num_removed orphans",
    "delone.Faces": "__getstate__ __len__ __repr__ cells dimension on_hull vertices",
    "delone.AlphaComplex": "__len__ __repr__ boundary boundary_cells cell_numbers cells plot radius singular_facets to_data to_meshio to_pyvista to_vtk "
                           "triangulation",
    "delone._core.Diagram": "affine_dimension axis_tolerances bounding_box columns dimension is_bounded max_displacement num_points num_rays num_regions num_ridges "
                            "num_vertices plot point_region points ray_directions ray_points ray_vertices region region_offsets region_points "
                            "region_vertices ridge ridge_offsets ridge_points ridge_vertices to_data to_frame to_meshio to_pyvista to_vtk tolerance vertices",
    "delone._core.Triangulation": "can_undo cell_ids changes compact_ids has_row num_rows record_changes record_undo undo vertex_ids "
                                  "__len__ __repr__ affine_dimension axes cell_of_point columns dimension duplicates hash hull_facets "
                                  "num_cells num_duplicates num_points num_vertices plot points statistics to_data to_frame to_meshio to_pyvista to_vtk "
                                  "vertex_of_point",
    "delone._locations.Locations": "__getitem__ __init__ __iter__ __len__ __repr__",
    "delone.spatial._base.Incremental": "__copy__ __getstate__ close",
    "delone.spatial._base.OfPoints": "points",
    "delone.spatial._convex_hull.ConvexHull": "__getstate__ area coplanar equations good vertices volume",
    "delone.spatial._delaunay.Delaunay": "convex_hull coplanar good lift_points paraboloid_scale paraboloid_shift vertex_neighbor_vertices "
                                         "vertex_to_simplex vertices",
    "delone.spatial._halfspaces.HalfspaceIntersection": "dual_area dual_equations dual_facets dual_points dual_vertices dual_volume halfspaces",
    "delone.spatial._voronoi.Voronoi": "regions ridge_dict ridge_vertices",
    "delone.interpolate._base.Interpolator": "__init__",
    "delone.interpolate._base.OnTriangulation": "__init__ values",
    "delone.interpolate._nearest.NearestNDInterpolator": "__init__",
    "delone.tiles.Tiles": "__getitem__ __init__ __iter__ __len__ __repr__ affine_dimension dimension folder hash lattice num_cells num_duplicates num_hidden "
                          "num_hull_facets num_points num_vertices parts unit weighted",
    "delone": "ball_halfspaces cylinder_halfspaces forecast generate patch_scipy read scipy_is_patched unpatch_scipy write_points",
    "delone.spatial": "convex_hull_plot_2d delaunay_plot_2d distance_matrix geometric_slerp minkowski_distance minkowski_distance_p "
                      "procrustes voronoi_plot_2d",
}

# What the programs have: points that are hard for some reason.
HELPERS = '''
def sphere(n, d):
    """Points of the unit sphere, all of them extreme."""
    points = random.standard_normal((n, d))
    return points / np.linalg.norm(points, axis=1, keepdims=True)

def wild(n, d):
    """Points of all exponents, for which only integers of thousands of bits decide."""
    return random.standard_normal((n, d)) * 10.0 ** random.integers(-300, 301, (n, d))

def halfspaces(n, d):
    return np.c_[sphere(n, d), -np.ones(n)]

def cube(d):
    return delone.Polyhedron(np.r_[np.eye(d), -np.eye(d)], np.ones(2 * d))
'''

# The work that is interrupted, after some preparation. `of`: other entries that do the same.
HULL = "hull = delone.ConvexHull(wild(14, 9))"
DIAGRAM = "diagram = delone.Voronoi(random.random((250, 7)))"
SCRATCH = "import tempfile; from delone import tiles; folder = tempfile.TemporaryDirectory()"
MILLIONS = "t = delone.Delaunay(random.random((1_000_000, 3)))"  # seven of cells, which have no numbers yet
SIMPLEX = "points = np.r_[np.zeros((1, 8)), np.eye(8)]"
LONG = {
    "delone.Delaunay.__init__": ("", "delone.Delaunay(random.random((300_000, 6)))"),
    "delone.Delaunay.insert_range": (f"{SIMPLEX}; made = delone.Delaunay(points)", "made.insert_range(random.random((300_000, 8)))"),
    "delone.Regular.__init__": ("", "delone.Regular(random.random((300_000, 6)), np.zeros(300_000))"),
    "delone.Regular.insert_range": (f"{SIMPLEX}; made = delone.Regular(points, np.zeros(9))",
                                    "made.insert_range(random.random((300_000, 8)), np.zeros(300_000))"),
    "delone.FurthestSite.__init__": ("", "delone.FurthestSite(sphere(300_000, 7))"),
    "delone.FurthestSite.insert_range": (f"{SIMPLEX}; made = delone.FurthestSite(points)", "made.insert_range(sphere(300_000, 8))"),
    "delone.Delaunay.edit": (f"{SIMPLEX}; made = delone.Delaunay(points)", "made.edit(insert=random.random((300_000, 8)))"),
    "delone.Regular.edit": (f"{SIMPLEX}; made = delone.Regular(points, np.zeros(9))",
                            "made.edit(insert=random.random((300_000, 8)), insert_weights=np.zeros(300_000))", "set_weights"),
    "delone.FurthestSite.edit": (f"{SIMPLEX}; made = delone.FurthestSite(points)", "made.edit(insert=sphere(300_000, 8))"),
    "delone.Delaunay.clone": (MILLIONS, "for _ in range(20): t.clone()", "__copy__"),
    "delone._core.Triangulation.cells": (MILLIONS, "t.cells", "neighbors"),
    "delone._core.Triangulation.remove": ("t = delone.Delaunay(random.random((3000, 6)))", "t.remove(np.arange(600))", "move"),
    "delone._core.Triangulation.find_simplex": ("t = delone.Delaunay(random.random((500, 5)))", "t.find_simplex(random.random((6_000_000, 5)))"),
    "delone._core.Triangulation.locate": ("t = delone.Delaunay(random.random((300, 7)))", "t.locate(random.random((1_000_000, 7)))"),
    "delone._core.Triangulation.barycentric": ("t = delone.Delaunay(random.random((2000, 2)))", "t.barycentric(wild(1_000_000, 2))"),
    "delone._core.Triangulation.nearest": ("t = delone.Delaunay(random.random((5000, 4)))", "t.nearest(random.random((20_000, 4)), k=500)"),
    "delone._core.Triangulation.nearest, millions": ("t = delone.Delaunay(random.random((300_000, 3)))", "t.nearest(random.random((3_000_000, 3)))"),
    "delone._core.Triangulation.faces": ("t = delone.Delaunay(random.random((20_000, 5)))", "t.faces(1)"),
    "delone._core.Triangulation.alpha_values": ("t = delone.Delaunay(random.random((20_000, 5)))", "t.alpha_values(0)", "alpha_filtration"),
    "delone._core.Triangulation.optimal_alpha_value": ("t = delone.Delaunay(random.random((30_000, 5)))", "t.optimal_alpha_value()"),
    "delone._core.Triangulation.alpha_complex": ("t = delone.Delaunay(random.random((20_000, 5)))", "t.alpha_complex(0.3)"),
    "delone._core.Triangulation.circumradii": ("t = delone.Delaunay(random.random((10_000, 6)))", "t.circumradii", "circumcenters"),
    "delone._core.Triangulation.qualities": ("t = delone.Delaunay(random.random((10_000, 6)))", "t.qualities()"),
    "delone.Delaunay.site_cells": (MILLIONS, "for _ in range(10): t.site_cells(neighbors=True)"),
    "delone.Delaunay.dtfe_densities": (MILLIONS, "for _ in range(10): t.dtfe_densities()"),
    "delone.PeriodicDelaunay.dtfe_densities": ("t = delone.PeriodicDelaunay(random.random((300_000, 3)), 1.0)",
                                               "for _ in range(20): t.dtfe_densities()"),
    "delone.dtfe_density": ("t = delone.Delaunay(random.random((2000, 3)))", "delone.dtfe_density(t, 400)"),
    "delone.Delaunay.site_cells, clipped": ("t = delone.Delaunay(random.random((30_000, 3)))",
                                            "t.site_cells(box=([0.4] * 3, [0.41] * 3), faces='proper')"),
    "delone.Regular.site_cells": ("t = delone.Regular(random.random((20_000, 5)), np.zeros(20_000))", "t.site_cells()"),
    "delone._core.PeriodicTriangulation.site_cells": ("t = delone.PeriodicDelaunay(random.random((300_000, 3)), 1.0)",
                                                      "for _ in range(10): t.site_cells(neighbors=True)"),
    "delone._core.Triangulation.circumradii, millions": (MILLIONS, "t.circumradii"),
    "delone._core.Triangulation.qualities, millions": (MILLIONS, "t.qualities()"),
    "delone._core.Triangulation.to_html": ("t = delone.Delaunay(random.random((300_000, 3)))", "t.to_html()"),
    "delone.AlphaComplex.to_html": ("complex = delone.Delaunay(random.random((300_000, 3))).alpha_complex(0.1)", "complex.to_html()"),
    "delone.AlphaComplex.faces": ("complex = delone.Delaunay(random.random((20_000, 5))).alpha_complex(0.3)", "complex.faces(1)", "save"),
    "delone.AlphaComplex.boundary_components": ("complex = delone.Delaunay(random.random((30_000, 5))).alpha_complex(0.3)", "complex.boundary_components()"),
    "delone.AlphaComplex.polygons": ("complex = delone.Delaunay(random.random((3_000_000, 2))).alpha_complex(0.0004)", "complex.polygons()"),
    "delone._core.Triangulation.trim": ("t = delone.Delaunay(random.random((20_000, 4)))", "t.trim(0.5)"),
    "delone._core.Triangulation.transform": ("t = delone.Delaunay(random.random((100_000, 4)))", "t.transform"),
    "delone._core.Triangulation.vertex_neighbors": ("t = delone.Delaunay(random.random((20_000, 5)))", "t.vertex_neighbors"),
    "delone.ConvexHull.__init__": ("", "delone.ConvexHull(sphere(100_000, 8))"),
    "delone.ConvexHull.of_extreme_points": ("", "delone.ConvexHull.of_extreme_points(sphere(100_000, 8))"),
    "delone.ConvexHull.insert_range": (f"{SIMPLEX}; hull = delone.ConvexHull(points)", "hull.insert_range(sphere(100_000, 8))"),
    "delone.ConvexHull.locate": ("hull = delone.ConvexHull(wild(11, 8))", "hull.locate(wild(300_000, 8))"),
    "delone.ConvexHull.contains": ("hull = delone.ConvexHull(wild(11, 8))", "hull.contains(wild(300_000, 8))"),
    "delone.ConvexHull.visible_facets": (HULL, "[hull.visible_facets(each) for each in wild(1000, 9)]"),
    "delone.ConvexHull.plane_distance": ("hull = delone.ConvexHull(sphere(300, 5)); hull.equations", "hull.plane_distance(random.random((30_000, 5)))"),
    "delone.ConvexHull.num_facets": ("hull = delone.ConvexHull(sphere(3000, 7))", "hull.num_facets",
                                     "__len__ num_vertices num_ridges cells neighbors facet_of_cell vertices vertex_of_point facets ridges "
                                     "equations equation_errors point_kinds points to_data __getstate__"),
    "delone.ConvexHull.to_html": ("hull = delone.ConvexHull(sphere(300_000, 3))", "hull.to_html()"),
    "delone.ConvexHull.save": ("hull = delone.ConvexHull(sphere(1000, 7))", "hull.save('/dev/null', 'json')"),
    "delone.ConvexHull.f_vector": ("hull = delone.ConvexHull(sphere(40, 7))", "hull.f_vector"),
    "delone.ConvexHull.volume": ("hull = delone.ConvexHull(sphere(1500, 7))", "hull.volume", "volume_error area area_error"),
    "delone.ConvexHull.hash": ("hull = delone.ConvexHull(sphere(2500, 7))", "[hull.hash for _ in range(100)]"),
    "delone.LowerHull.__init__": ("", "delone.LowerHull(sphere(100_000, 8))"),
    "delone.LowerHull.height_above": ("hull = delone.LowerHull(random.random((300, 6)))", "hull.height_above(random.random((1_000_000, 6)))",
                                      "heights find_simplex to_frame"),
    "delone.LowerHull.save": ("hull = delone.LowerHull(sphere(1000, 7))", "hull.save('/dev/null', 'json')"),
    "delone.estimate": ("points = random.random((1_000_000, 6))", "delone.estimate(points, sample_seconds=60)"),
    "delone.lower_hull": ("", "delone.lower_hull(sphere(100_000, 8))"),
    "delone._core.Triangulation.save": ("t = delone.Delaunay(random.random((20_000, 5)))", "t.save('/dev/null', 'json')"),
    "delone.Data.save": ("data = delone.Delaunay(random.random((20_000, 5))).to_data()", "data.save('/dev/null', 'json')"),
    "delone.check": ("data = delone.Delaunay(random.random((20_000, 5))).to_data()", "delone.check(data)"),
    "delone._core.Diagram.save": ("v = delone.Voronoi(random.random((3000, 5)))", "v.save('/dev/null', 'json')"),
    "delone._core.Diagram.to_html": ("v = delone.Voronoi(random.random((100_000, 3)))", "v.to_html()"),
    "delone.HalfspaceIntersection.save": ("made = delone.HalfspaceIntersection(halfspaces(500, 7), [0] * 7)", "made.save('/dev/null', 'json')"),
    "delone.convex_hulls": ("", "delone.convex_hulls(random.random((300_000, 40, 3)))"),
    "delone.ConvexHulls.intersection_volumes": ("hulls = delone.convex_hulls(random.random((600, 30, 4)))", "hulls.intersection_volumes()"),
    "delone.HalfspaceIntersection.__init__": ("", "delone.HalfspaceIntersection(halfspaces(100_000, 8), [0] * 8)"),
    "delone.HalfspaceIntersection.insert_range": ("made = delone.HalfspaceIntersection(np.r_[np.c_[np.eye(8), -np.ones(8)], np.c_[-np.eye(8), -np.ones(8)]])",
                                                  "made.insert_range(halfspaces(100_000, 8))"),
    "delone.HalfspaceIntersection.vertices": ("made = delone.HalfspaceIntersection(halfspaces(500, 7), [0] * 7)", "made.vertices",
                                              "__len__ __repr__ axes direction_halfspaces direction_offsets directions dual_equations dual_points edges "
                                              "facet_halfspaces facet_offsets facet_vertices first_of_halfspace interior_point is_bounded "
                                              "kinds lineality num_facets num_vertices rays to_data to_frame to_html vertex_halfspaces vertex_offsets witness"),
    "delone.HalfspaceIntersection.volume": ("made = delone.HalfspaceIntersection(halfspaces(40, 7), [0] * 7)", "made.volume"),
    "delone.HalfspaceIntersection.dual_volume": ("made = delone.HalfspaceIntersection(halfspaces(2000, 7), [0] * 7)", "made.dual_volume",
                                                 "dual_area"),
    "delone.PeriodicDelaunay.__init__": ("", "delone.PeriodicDelaunay(random.random((300_000, 3)), 1.0)", "__getstate__"),
    "delone.PeriodicRegular.__init__": ("", "delone.PeriodicRegular(random.random((200_000, 3)), random.random(200_000) * 1e-5, 1.0)", "__getstate__"),
    "delone._core.PeriodicTriangulation.cells": ("t = delone.PeriodicDelaunay(random.random((300_000, 3)), 1.0)", "t.cells",
                                                 "cell_offsets neighbors neighbor_offsets is_simplicial save to_data"),
    "delone._core.PeriodicTriangulation.faces": ("t = delone.PeriodicDelaunay(random.random((20_000, 4)), 1.0)", "t.faces(1)", "alpha_values"),
    "delone._core.PeriodicTriangulation.find_simplex": ("t = delone.PeriodicDelaunay(random.random((300, 4)), 1.0)",
                                                        "t.find_simplex(random.random((3_000_000, 4)))", "locate barycentric nearest"),
    "delone.PeriodicLinearInterpolator.__init__": ("t = delone.PeriodicDelaunay(random.random((300_000, 3)), 1.0); z = random.random(300_000)",
                                                   "delone.PeriodicLinearInterpolator(t, z)"),
    "delone.PeriodicLinearInterpolator.__call__": ("t = delone.PeriodicDelaunay(random.random((300, 4)), 1.0); "
                                                   "f = delone.PeriodicLinearInterpolator(t, random.random(300))",
                                                   "f(random.random((3_000_000, 4)))", "gradient"),
    "delone.PeriodicNaturalNeighborInterpolator.__init__": ("t = delone.PeriodicDelaunay(random.random((300_000, 3)), 1.0); z = random.random(300_000)",
                                                            "delone.PeriodicNaturalNeighborInterpolator(t, z)"),
    "delone.PeriodicNaturalNeighborInterpolator.__call__": ("t = delone.PeriodicDelaunay(random.random((3000, 3)), 1.0); "
                                                            "f = delone.PeriodicNaturalNeighborInterpolator(t, random.random(3000))",
                                                            "f(random.random((300_000, 3)))", "gradient natural_neighbors"),
    "delone.PeriodicDelaunay.moved": ("x = random.random((300_000, 3)); t = delone.PeriodicDelaunay(x, 1.0)",
                                      "t.moved(x + 1e-6 * random.random((300_000, 3)))"),
    "delone.PeriodicRegular.moved": ("x = random.random((200_000, 3)); w = random.random(200_000) * 1e-5; t = delone.PeriodicRegular(x, w, 1.0)",
                                     "t.moved(x + 1e-6 * random.random((200_000, 3)))"),
    "delone.changed_neighbors": ("x = random.random((300_000, 3)); t = delone.Delaunay(x); s = delone.Delaunay(x[::-1])",
                                 "delone.changed_neighbors(t, s)"),
    "delone._core.PeriodicTriangulation.hash": ("t = delone.PeriodicDelaunay(random.random((300_000, 3)), 1.0)", "t.hash"),
    "delone.HalfspaceIntersection.to_polyhedron": ("made = delone.HalfspaceIntersection(np.c_[sphere(90, 9), -np.ones(90)])", "made.to_polyhedron()"),
    "delone.ConvexHull.to_polyhedron": ("made = delone.ConvexHull(sphere(90, 9))", "made.to_polyhedron()"),
    "delone.Polyhedron.__init__": ("", "delone.Polyhedron(sphere(90, 9), np.ones(90))",
                                   "from_generators convex_union image intersection minkowski_sum polar preimage projection"),
    "delone.Polyhedron.vertices": ("p = cube(17)", "p.vertices", "__getstate__ equation_integers equations inequalities inequality_integers line_integers "
                                   "lines ray_integers rays vertex_integers"),
    "delone.Polyhedron.vertex_fractions": ("p = cube(17)", "p.vertex_fractions"),
    "delone.Polyhedron.adjacent_vertices": ("p = cube(17)", "p.adjacent_vertices", "adjacent_facets"),
    "delone.Polyhedron.f_vector": ("p = cube(12)", "p.f_vector"),
    "delone.Polyhedron.volume": ("p = cube(12)", "p.volume", "volume_fraction"),
    "delone.Polyhedron.contains": ("p = cube(8)", "p.contains(random.random((300_000, 8)))"),
    "delone.Polyhedron.includes": ("p, q = cube(16), cube(16)", "p.includes(q)"),
    "delone.Polyhedron.maximize": ("p = cube(16)", "[p.maximize(c) for c in random.random((100, 16))]", "minimize"),
    "delone.Polyhedron.bounding_box": ("p = cube(17)", "p.bounding_box", "bounding_box_fractions integer_bounding_box"),
    "delone.Polyhedron.hash": ("p = cube(17)", "[p.hash for _ in range(100)]"),
    "delone.Polyhedron.product": ("p, q = cube(9), cube(9)", "p.product(q)"),
    "delone.Polyhedron.save": ("p = cube(17)", "p.save('/dev/null', 'ext')"),
    "delone.read_polyhedron": ("import tempfile; path = tempfile.mkdtemp() + '/a.ine'; rows = np.c_[np.ones(60), sphere(60, 9)]; file = open(path, 'w'); "
                               "file.write('begin\\n60 10 real\\n' + '\\n'.join(' '.join(map(repr, row)) for row in rows.tolist()) + '\\nend\\n'); file.close()",
                               "delone.read_polyhedron(path)"),
    "delone.polyhedra_vertices": ("b = np.ones((1_000_000, 8)); A = random.standard_normal((1_000_000, 8, 3))", "delone.polyhedra_vertices(A, b)"),
    "delone.intersections": ("all = [delone.Polyhedron.from_generators(random.integers(0, 50, (15, 4))) for _ in range(14)]", "delone.intersections(all)"),
    "delone.union_volume": ("all = [delone.Polyhedron.from_generators(random.integers(0, 50, (15, 4))) for _ in range(14)]", "delone.union_volume(all)"),
    "delone.coordination": ("t = delone.PeriodicDelaunay(random.random((50_000, 3)), 1.0)", "for _ in range(20): delone.coordination(t)"),
    "delone.lloyd": ("points = random.random((100_000, 3))", "delone.lloyd(points, lattice=1.0, steps=30)"),
    "delone.prescribed_volumes": ("points = random.random((100_000, 3))", "delone.prescribed_volumes(points, lattice=1.0)"),
    "delone.FurthestVoronoi.__init__": ("t = delone.FurthestSite(sphere(1000, 6))", "delone.FurthestVoronoi(t)"),
    "delone.Voronoi.__init__": ("t = delone.Delaunay(random.random((3000, 6)))", "delone.Voronoi(t)"),
    "delone.PowerDiagram.__init__": ("t = delone.Regular(random.random((3000, 6)), np.zeros(3000))", "delone.PowerDiagram(t, tolerance=0.01)"),
    "delone._core.Diagram.region_volumes": (DIAGRAM, "diagram.region_volumes()"),
    "delone._core.Diagram.region_volumes, box": ("diagram = delone.Voronoi(random.random((150, 6)))",
                                                 "diagram.region_volumes((np.zeros(6), np.ones(6)))"),
    "delone._core.Diagram.clipped_regions": ("diagram = delone.Voronoi(random.random((30_000, 3)))", "diagram.clipped_regions()"),
    "delone._core.Diagram.ridge_volumes": (DIAGRAM, "diagram.ridge_volumes()"),
    "delone.LinearInterpolator.__init__": ("", "delone.LinearInterpolator(random.random((300_000, 6)), np.zeros(300_000))"),
    "delone.LinearInterpolator.__call__": ("f = delone.LinearInterpolator(random.random((500, 5)), np.zeros(500))", "f(random.random((6_000_000, 5)))"),
    "delone.LinearInterpolator.gradient": ("f = delone.LinearInterpolator(random.random((500, 5)), np.zeros(500))",
                                           "f.gradient(random.random((6_000_000, 5)))"),
    "delone.NaturalNeighborInterpolator.__init__": ("t = delone.Delaunay(random.random((3000, 4)))",
                                                    "delone.NaturalNeighborInterpolator(t, np.zeros(3000), smooth=True)"),
    "delone.NaturalNeighborInterpolator.__call__": ("f = delone.NaturalNeighborInterpolator(random.random((300, 4)), np.zeros(300))",
                                                    "f(random.random((100_000, 4)))"),
    "delone.NaturalNeighborInterpolator.gradient": ("f = delone.NaturalNeighborInterpolator(random.random((300, 4)), np.zeros(300))",
                                                    "f.gradient(random.random((100_000, 4)))"),
    "delone.NaturalNeighborInterpolator.natural_neighbors": ("f = delone.NaturalNeighborInterpolator(random.random((300, 4)), np.zeros(300))",
                                                             "f.natural_neighbors(random.random((100_000, 4)))"),
    "delone.NaturalNeighborInterpolator.site_gradients": ("f = delone.NaturalNeighborInterpolator(random.random((3000, 4)), np.zeros(3000))",
                                                          "f.site_gradients"),
    "delone.natural_neighbors": ("t = delone.Delaunay(random.random((100, 6)))", "delone.natural_neighbors(t, random.random((1000, 6)))"),
    "delone.spatial._delaunay.Delaunay.__init__": ("", "spatial.Delaunay(random.random((300_000, 6)))"),
    "delone.spatial._base.OfPoints.add_points": ("made = spatial.Delaunay(random.random((50, 6)), incremental=True)",
                                                 "made.add_points(random.random((300_000, 6)))"),
    "delone.spatial._delaunay.Delaunay.find_simplex": ("made = spatial.Delaunay(random.random((500, 5)))", "made.find_simplex(random.random((6_000_000, 5)))"),
    "delone.spatial._delaunay.Delaunay.transform": ("made = spatial.Delaunay(random.random((100_000, 4)))", "made.transform", "equations"),
    "delone.spatial._delaunay.Delaunay.plane_distance": ("made = spatial.Delaunay(random.random((500, 3))); xi = random.random((100_000, 3))",
                                                         "[made.plane_distance(x) for x in xi]"),
    "delone.spatial._convex_hull.ConvexHull.__init__": ("", "spatial.ConvexHull(sphere(100_000, 8))"),
    "delone.spatial._voronoi.Voronoi.__init__": ("", "spatial.Voronoi(random.random((300_000, 6)))"),
    "delone.spatial._halfspaces.HalfspaceIntersection.__init__": ("", "spatial.HalfspaceIntersection(halfspaces(100_000, 8), np.zeros(8))"),
    "delone.spatial._halfspaces.HalfspaceIntersection.add_halfspaces": (
        "made = spatial.HalfspaceIntersection(halfspaces(20, 8), np.zeros(8), incremental=True)", "made.add_halfspaces(halfspaces(100_000, 8))"),
    "delone.spatial.tsearch": ("made = spatial.Delaunay(random.random((500, 5)))", "spatial.tsearch(made, random.random((6_000_000, 5)))"),
    "delone.interpolate._linear.LinearNDInterpolator.__init__": ("", "interpolate.LinearNDInterpolator(random.random((300_000, 6)), np.zeros(300_000))"),
    "delone.interpolate._base.OnTriangulation.__call__": ("f = interpolate.LinearNDInterpolator(random.random((500, 5)), np.zeros(500))",
                                                          "f(random.random((6_000_000, 5)))"),
    "delone.interpolate._clough_tocher.CloughTocher2DInterpolator.__init__": (
        "points = random.random((200_000, 2))", "interpolate.CloughTocher2DInterpolator(points, random.random(200_000), tol=0, maxiter=10_000)"),
    "delone.interpolate._clough_tocher.CloughTocher2DInterpolator.gradient": (
        "points = random.random((1000, 2)); f = interpolate.CloughTocher2DInterpolator(points, random.random(1000))", "f.gradient(random.random((10_000_000, 2)))"),
    "delone.interpolate._natural_neighbors.NaturalNeighborInterpolator.__init__": (
        "points = random.random((3000, 4))", "interpolate.NaturalNeighborInterpolator(points, np.zeros(3000), smooth=True)"),
    "delone.interpolate._natural_neighbors.NaturalNeighborInterpolator.gradient": (
        "f = interpolate.NaturalNeighborInterpolator(random.random((300, 4)), np.zeros(300))", "f.gradient(random.random((100_000, 4)))"),
    "delone.interpolate._nearest.NearestNDInterpolator.__call__": ("f = interpolate.NearestNDInterpolator(random.random((2000, 4)), np.zeros(2000))",
                                                                   "f(random.random((3_000_000, 4)))"),
    "delone.interpolate.griddata": ("", "interpolate.griddata(random.random((300_000, 6)), np.zeros(300_000), random.random((10, 6)))"),
    "delone.tiles.make_tiles": (SCRATCH, "tiles.make_tiles(random.random((300_000, 6)), folder.name)"),
    "delone.tiles.Tiles.check": (f"{SCRATCH}; made = tiles.make_tiles(random.random((2000, 6)), folder.name, tiles=2)", "made.check()"),
}
# In every run; the others at full size only.
USUAL = ["delone.ConvexHull.locate", "delone.ConvexHull.num_facets", "delone.HalfspaceIntersection.volume", "delone._core.Diagram.region_volumes",
         "delone._core.Triangulation.nearest"]

PROGRAM = """
import signal, time
import numpy as np
import delone
from delone import interpolate, spatial

random = np.random.default_rng(0)
{helpers}
{prepare}
signal.signal(signal.SIGPROF, signal.default_int_handler)
begin = time.process_time()
signal.setitimer(signal.ITIMER_PROF, {after})
try:
    {work}
    signal.setitimer(signal.ITIMER_PROF, 0)
    print("finished", time.process_time() - begin)
except KeyboardInterrupt:
    print("interrupted", time.process_time() - begin - {after})
"""


def public():
    """All functions, constructors and members, by the class that has them."""
    called = {"__call__", "__copy__", "__getitem__", "__getstate__", "__init__", "__iter__", "__len__", "__reduce__", "__repr__"}
    for cls in classes():
        if cls.__name__ not in ("Forecast", "HullOfSet", "Part", "PartIndex", "Report", "CheckReport", "GeneratorsOfPolyhedron", "Optimum", "PolyhedraIntersection", "_Patched"):
            plain = cls.__module__ == "delone" or cls.__module__.startswith("delone._c") and cls.__name__ == "ConvexHulls"
            place = f"delone.{cls.__name__}" if plain else f"{cls.__module__}.{cls.__name__}"
            for name, member in vars(cls).items():
                if name == "__reduce__" and type(member).__name__ == "instancemethod":
                    continue  # does what __getstate__ does, or is quick
                if (not name.startswith("_") or name in called) and not inspect.ismemberdescriptor(member):
                    if callable(member) or isinstance(member, (property, classmethod, staticmethod)) or hasattr(member, "__get__"):
                        yield place, name
    for module_name in MODULES:
        module = importlib.import_module(module_name)
        for name, function in inspect.getmembers(module, inspect.isroutine):
            if not name.startswith("_") and module_name != "delone._core" and function.__module__ != "typing":
                yield module_name, name


def test_the_table_is_complete():
    quick = {(place, name) for place, names in QUICK.items() for name in names.split()}
    long = set()
    for entry, (_, _, *others) in LONG.items():
        place, name = entry.split(",")[0].rsplit(".", 1)
        long |= {(place, each) for each in [name, *(others[0].split() if others else [])]}
    there = set(public())
    assert not quick & long
    missing = {f"{place}.{name}" for place, name in there - quick - long if not (name == "__init__" and is_not_made(place))}
    assert not missing, "they need an entry: in LONG with an input that takes long, or in QUICK"
    assert not (quick | long) - there, "no longer there"


def is_not_made(place):
    """Classes without a constructor of their own."""
    return place in ("delone._core.Triangulation", "delone._core.Diagram", "delone._core.PeriodicTriangulation", "delone.TrimResult", "delone.Faces", "delone.AlphaComplex",
                     "delone.spatial._base.OfPoints")


@pytest.mark.skipif(not hasattr(signal, "ITIMER_PROF"), reason="timers as POSIX has them")
@pytest.mark.parametrize("entry", LONG if is_large() else USUAL)
def test_ctrl_c_ends_it_within_a_second(entry):
    """Of processor time, so that a busy machine makes no difference."""
    prepare, work, *_ = LONG[entry]
    program = PROGRAM.format(helpers=HELPERS, prepare=prepare, work=work, after=0.3)
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=600)
    assert result.returncode == 0, result.stderr
    word, seconds = result.stdout.split()
    if word == "finished":
        pytest.skip(f"takes {seconds} s: the input is too small by now")
    assert float(seconds) < 1
