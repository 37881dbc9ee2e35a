# SPDX-License-Identifier: BSD-3-Clause
"""Pictures: how many shapes there are, where they are and in which colors; what notebooks show."""
import builtins
import re
import warnings
import xml.etree.ElementTree

import numpy as np
import pytest

import delone
from delone import _clipping

RANDOM = np.random.default_rng(1)
PLANE, SPACE, FOUR = RANDOM.random((40, 2)), RANDOM.random((40, 3)), RANDOM.random((12, 4))
CUBE = np.array(np.meshgrid([0.0, 1], [0.0, 1], [0.0, 1])).reshape(3, -1).T
HALFPLANES = np.array([[-1.0, 0, 0], [0, -1, 0], [-1, -1, 0.3]])


@pytest.fixture
def plt():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    yield plt
    plt.close("all")


def test_edges_of_a_triangulation_are_drawn_once(plt):
    t = delone.Delaunay(PLANE)
    ax = t.plot(linewidth=3)
    lines, = ax.collections
    segments = {tuple(sorted(map(tuple, segment))) for segment in lines.get_segments()}
    assert len(segments) == len(lines.get_segments()) == (3 * len(t) + len(t.hull_facets)) // 2
    assert lines.get_linewidth()[0] == 3
    assert len(ax.lines) == 1 and len(ax.lines[0].get_xdata()) == 40  # the points
    assert ax.get_aspect() == 1 and ax.get_xlim()[0] < PLANE[:, 0].min()


def test_given_axes_are_used_and_kept(plt):
    ax = plt.figure().add_subplot()
    ax.set(xlim=(0, 5), ylim=(0, 7))
    for product in (delone.Delaunay(PLANE), delone.ConvexHull(PLANE), delone.Voronoi(PLANE), delone.HalfspaceIntersection(HALFPLANES)):
        assert product.plot(ax) is ax
        assert (ax.get_xlim(), ax.get_ylim(), ax.get_aspect()) == ((0, 5), (0, 7), "auto")
    assert len(plt.get_fignums()) == 1
    with pytest.raises(ValueError, match="ax: three dimensions need axes that have them"):
        delone.Delaunay(SPACE).plot(ax)
    with pytest.raises(TypeError, match="ax: Axes of Matplotlib, not Figure"):
        delone.Delaunay(PLANE).plot(ax.figure)
    with pytest.raises(ValueError, match="ax: two dimensions need axes that have two"):
        delone.Delaunay(PLANE).plot(plt.figure().add_subplot(projection="3d"))


def test_values_are_colors(plt):
    t = delone.Delaunay(PLANE)
    of_points, of_cells = PLANE[:, 0], np.arange(len(t)) + 0.5
    smooth, = t.plot(values=of_points, cmap="magma", vmax=2).collections
    assert len(smooth.get_array()) == 40 and smooth.get_clim() == (of_points.min(), 2) and smooth.get_cmap().name == "magma"
    flat, = t.plot(values=of_points, shading="flat").collections
    np.testing.assert_allclose(flat.get_array(), of_points[t.cells].mean(axis=1))
    ax = t.plot(values=of_cells, colorbar="a label", norm=plt.matplotlib.colors.LogNorm())
    cells, = ax.collections
    assert len(cells.get_paths()) == len(t) and (cells.get_array() == of_cells).all() and isinstance(cells.norm, plt.matplotlib.colors.LogNorm)
    assert ax.figure.axes[1].get_ylabel() == "a label"
    assert len(t.plot(values=of_cells, colorbar=False).figure.axes) == 1
    masked, = t.plot(values=np.where(of_cells > 9, np.nan, of_cells)).collections
    assert masked.get_array().mask.sum() == (of_cells > 9).sum()
    masked, = t.plot(values=np.ma.masked_greater(of_cells, 9)).collections
    assert masked.get_array().mask.sum() == (of_cells > 9).sum()
    masked, = t.plot(values=np.ma.masked_equal(np.arange(40), 7), shading="flat").collections
    assert masked.get_array().mask.sum() == (t.cells == 7).any(axis=1).sum()
    with_a_gap = np.where(np.arange(40) == 7, np.nan, of_points)  # triangles at a point without a value are left out
    assert len(t.plot(values=with_a_gap).collections[0]._triangulation.triangles) == (t.cells != 7).all(axis=1).sum()
    kept = t.cells.max(axis=1) < 30
    chosen, = t.plot(cells=kept, values=of_cells).collections
    assert (chosen.get_array() == of_cells[kept]).all()
    chosen, = t.plot(cells=np.flatnonzero(kept), facecolor="red", points=False).collections
    assert len(chosen.get_paths()) == kept.sum() and chosen.get_facecolor()[0].tolist() == [1, 0, 0, 1]


def test_values_belong_to_points_unless_it_is_said(plt):
    t = delone.Delaunay([[0, 0], [4, 0], [4, 4], [0, 4], [2, 2.5]][:3] + [[1, 0.5], [2, 1]])
    assert len(t) == 5 == t.num_points
    assert len(t.plot(values=range(5), values_at="cells").collections[0].get_paths()) == 5
    assert t.plot(values=range(5)).collections[0].__class__.__name__ == "TriMesh"
    for wrong, text in [({"values": [1, 2]}, r"values: one number for each of the points \(5\) or cells \(5\), not an array of shape \(2,\)"),
                        ({"values": range(5), "values_at": "edges"}, "values_at: 'points' or 'cells', not 'edges'"),
                        ({"values": range(5), "shading": "flatt"}, "shading: 'gouraud' or 'flat', not 'flatt'"),
                        ({"values": ["a"] * 5}, "values: numbers, not <U1"), ({"cells": [5]}, "cells: a mask of 5, or numbers from 0 to 4"),
                        ({"values": range(5), "norm": plt.matplotlib.colors.Normalize(), "vmin": 1}, "norm: has limits of its own")]:
        with pytest.raises(ValueError, match=text):
            t.plot(**wrong)


def test_surfaces_of_triangulations_in_space(plt):
    t = delone.Delaunay(SPACE)
    ax = t.plot()
    assert ax.name == "3d" and len(ax.collections[0]._segslices) == len(t.hull_facets)
    values = np.arange(len(t), dtype=float)
    assert set(t.plot(values=values).collections[0].get_array()) <= set(values)
    one = t.plot(cells=[3], values=SPACE[:, 2]).collections[0]
    corners = SPACE[t.cells[3], 2]
    np.testing.assert_allclose(sorted(one.get_array()), sorted((corners.sum() - corners) / 3))
    plane = delone.Delaunay(np.c_[PLANE, np.ones(40)])
    assert len(plane.plot().collections[0]._segslices) == len(plane)


def test_projections_of_all_dimensions(plt):
    t = delone.Delaunay(FOUR)
    with pytest.raises(ValueError, match=r"dimension is 4, .* axes=\(0, 1\)"):
        t.plot()
    with pytest.raises(ValueError, match="dimension is 1, and a picture has 2 or 3$"):
        delone.Delaunay([[0.0], [1]]).plot()
    for wrong in [(0,), (0, 0), (0, 4), (0, 1, 2, 3), (0.5, 1)]:
        with pytest.raises(ValueError, match="axes: two or three different coordinates from 0 to 3"):
            t.plot(axes=wrong)
    ax = t.plot(axes=(3, 1), values=np.arange(12))
    edges, dots = ax.collections
    assert len(edges.get_segments()) == len(t.vertex_neighbors[1]) // 2
    assert (dots.get_offsets() == FOUR[:, [3, 1]]).all() and (ax.get_xlabel(), ax.get_ylabel()) == ("x3", "x1")
    box = delone.HalfspaceIntersection(np.c_[np.r_[np.eye(4), -np.eye(4)], -np.ones(8)])
    for product, names in ((delone.Voronoi(FOUR), ["regions", "box"]), (box, ["values", "box", "cmap", "colorbar"])):
        for name in names:
            with pytest.raises(ValueError, match=name + ": not together with axes"):
                product.plot(axes=(0, 1), **{name: [0]})
    for product in (delone.ConvexHull(FOUR), delone.Voronoi(FOUR), delone.Delaunay(SPACE), box):
        assert product.plot(axes=(0, 1)).name == "rectilinear" and product.plot(axes=(2, 0, 1)).name == "3d"


def test_hulls(plt):
    h = delone.ConvexHull(PLANE)
    outline, = h.plot().collections
    assert len(outline.get_paths()) == 1 and len(outline.get_paths()[0].vertices) == h.num_vertices + 1
    sides, = h.plot(values=np.arange(h.num_facets)).collections
    assert len(sides.get_segments()) == h.num_facets
    cube = delone.ConvexHull(np.concatenate([CUBE, SPACE]))
    faces = cube.plot().collections[0]
    assert [each.stop - each.start for each in faces._segslices] == [4] * 6
    corners = faces._vec[:3].T.reshape(6, 4, 3)
    assert (np.abs(np.roll(corners, -1, axis=1) - corners).sum(axis=2) == 1).all()  # around each square, not across
    assert cube.plot(values=np.arange(6), colorbar=False).collections[0].get_array().tolist() == [0, 1, 2, 3, 4, 5]
    assert len(cube.plot(values=np.arange(cube.num_cells)).collections[0]._segslices) == cube.num_cells
    np.testing.assert_allclose(sorted(delone.ConvexHull(CUBE).plot(values=CUBE[:, 2]).collections[0].get_array()), [0, 0.5, 0.5, 0.5, 0.5, 1])
    assert len(delone.ConvexHull([[0, 0], [1, 1], [2, 2]]).plot().collections[0].get_segments()) == 1


def area(polygon):
    x, y = polygon.T
    return 0.5 * np.abs(np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1)))


@pytest.mark.parametrize("points", [PLANE, PLANE[:3], PLANE[:2], PLANE[:1], [[0, 0], [1, 1], [2, 2], [4, 4]], [[0, 0], [1, 0], [0, 1], [1, 1]],
                                    [[0, 0], [1, 0], [2, 0], [3, 0], [1, 5]], [[0, 0], [1, 1e-12], [2, 0]], [[0, 0], [1, -1e-16], [2, 0], [3, 0]],
                                    [[0, 0], [1, 1e-320], [2, 0]]])
def test_regions_fill_the_box(points):
    """The cut regions have the areas that the library computes exactly, whatever is unbounded."""
    v = delone.Voronoi(points)
    box = v.bounding_box(0.3)
    polygons = _clipping.polygons_of_regions(v, np.arange(v.num_regions), *box)
    np.testing.assert_allclose([area(polygon) if len(polygon) else 0 for polygon in polygons], v.region_volumes(box), rtol=1e-9, atol=1e-12)
    sides = [np.stack([polygon, np.roll(polygon, -1, axis=0)], axis=1) for polygon in polygons if len(polygon)]
    inner = [side for side in np.concatenate(sides) if not any((side[:, j] == bound).all() for j in range(2) for bound in (box[0][j], box[1][j]))]
    edges = _clipping.edges_of_diagram(v, *box)
    lengths = [np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum() if len(ends) else 0 for ends in (np.reshape(inner, (-1, 2, 2)), edges)]
    assert lengths[0] == pytest.approx(2 * lengths[1], rel=1e-9, abs=1e-12)
    assert ((edges >= box[0] - 1e-9) & (edges <= box[1] + 1e-9)).all()


@pytest.mark.parametrize("make", [lambda: delone.PowerDiagram(PLANE, np.arange(40) * 0.0005), lambda: delone.FurthestVoronoi(PLANE)])
def test_regions_of_other_diagrams_fill_the_box(make):
    diagram = make()
    box = diagram.bounding_box()
    polygons = _clipping.polygons_of_regions(diagram, np.arange(diagram.num_regions), *box)
    np.testing.assert_allclose(sum(area(polygon) for polygon in polygons if len(polygon)), np.prod(box[1] - box[0]))


def test_diagrams(plt):
    v = delone.Voronoi(PLANE)
    ax = v.plot(linestyle="dotted")
    lines, = ax.collections
    edges = _clipping.edges_of_diagram(v, *v.bounding_box())
    assert len(lines.get_segments()) == len(edges) <= v.num_ridges
    assert ax.get_xlim() == tuple(np.transpose(v.bounding_box())[0])
    regions, = v.plot(values=np.arange(40.0), box=([0, 0], [0.5, 1])).collections
    assert set(regions.get_array()) < set(range(40)) and regions.get_array().max() > 20
    chosen, lines = v.plot(regions=[7, 3]).collections
    assert len(chosen.get_paths()) == 2 and len(lines.get_segments()) == len(edges)
    with pytest.raises(ValueError, match=r"box: \(low, high\), each of 2 finite numbers"):
        v.plot(box=([0, 0], [0, 1]))
    assert len(delone.Voronoi(np.empty((0, 2))).plot().collections) == 0
    doubled = delone.Voronoi(np.concatenate([PLANE, PLANE[:5]]))
    assert len(doubled.plot(values=np.arange(45)).collections[0].get_paths()) == 40


def test_diagrams_in_space(plt):
    v = delone.Voronoi(SPACE)
    bounded = np.flatnonzero(v.is_bounded)
    faces = v.plot(regions=bounded[:1], values=np.arange(40)).collections[0]
    assert set(faces.get_array()) == {v.region_points[bounded[0]]}
    assert len(faces._segslices) == (v.point_region[v.ridge_points] == bounded[0]).any(axis=1).sum()
    with pytest.raises(ValueError, match="in 3D only bounded ones are drawn"):
        v.plot(regions=~v.is_bounded)
    assert v.plot().name == "3d"


def test_intersections(plt):
    h = delone.HalfspaceIntersection(HALFPLANES)
    fill, lines = h.plot(values=[5, 6, 7]).collections
    assert len(lines.get_segments()) == 3 and lines.get_array().tolist() == [5, 6, 7]
    fill, lines = h.plot(box=([0, 0], [2, 1])).collections
    assert area(fill.get_paths()[0].vertices[:-1]) == pytest.approx(2 - 0.045)
    strip = delone.HalfspaceIntersection([[1, 0, -1], [-1, 0, -1]])  # it contains lines
    assert strip.rank == 1 and len(strip.plot().collections[1].get_segments()) == 2
    cube = delone.HalfspaceIntersection(np.c_[np.r_[np.eye(3), -np.eye(3)], -np.ones(6)])
    faces = cube.plot(values=range(6)).collections[0]
    assert [each.stop - each.start for each in faces._segslices] == [4] * 6 and faces.get_array().tolist() == list(range(6))
    with pytest.raises(ValueError, match="the intersection is empty, there is nothing to draw"):
        delone.HalfspaceIntersection([[1, 0, 0], [-1, 0, 1]]).plot()
    with pytest.raises(ValueError, match="box: no point of its interior"):
        h.plot(box=([-2, -2], [-1, -1]))


def test_without_matplotlib_it_is_said_what_to_install(monkeypatch):
    original = builtins.__import__
    monkeypatch.setattr(builtins, "__import__", lambda name, *rest: original("no." + name if name.startswith("matplotlib") else name, *rest))
    with pytest.raises(ImportError, match="pip install matplotlib"):
        delone.Delaunay(PLANE).plot()


@pytest.mark.parametrize("points", [np.empty((0, 2)), [[1, 2]], [[0, 0, 0], [1, 1, 1]], PLANE, SPACE, FOUR, PLANE * 1e300, PLANE * 1e-300, [[0.0], [1], [3]],
                                    RANDOM.random((3000, 2)), RANDOM.random((500, 3)), RANDOM.random((100, 5))])
def test_notebooks_show_a_picture_and_figures(points):
    products = [delone.Delaunay(points), delone.ConvexHull(points), delone.Voronoi(points), delone.FurthestSite(points)]
    products.append(delone.PowerDiagram(points, np.arange(len(points)) / 1000))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pages = [product._repr_html_() for product in products]
    for product, page in zip(products, pages):
        assert len(page) < 20_500 and f"delone.{type(product).__name__}" in page
        root = xml.etree.ElementTree.fromstring(page)
        figures = {row[0].text: row[1].text for row in root.iter("tr")}
        assert figures["points"] == f"{len(points):,}".replace(",", " ")
        for place in re.findall(r"M(-?\d+) (-?\d+)", page):
            assert all(-260 <= int(x) <= 520 for x in place)
    t = products[0]
    assert t._repr_html_() == delone.Delaunay(points, threads=2, order="shuffled")._repr_html_()


def test_notebooks_say_how_much_is_drawn():
    page = delone.Delaunay(RANDOM.random((3000, 2)))._repr_html_()
    assert re.search(r"6\d\d of 5 9\d\d cells drawn", page)
    assert page.count("z") > 600
    assert "points drawn; 2 of 5 coordinates" in delone.Delaunay(RANDOM.random((100, 5)))._repr_html_()


@pytest.mark.parametrize("rows", [HALFPLANES, [[1, 0, 0], [-1, 0, 1]], [[1, 0, 0]], np.c_[SPACE - 0.5, -np.ones(40)]])
def test_notebooks_show_intersections(rows):
    page = delone.HalfspaceIntersection(rows)._repr_html_()
    assert xml.etree.ElementTree.fromstring(page) is not None and "delone.HalfspaceIntersection" in page


OTHERS = np.random.default_rng(2)


@pytest.mark.parametrize("points, radius, drawn", [
    (PLANE, 0.2, "all cells"), (SPACE, 0.3, "all boundary facets"), (FOUR, 0.6, "all cells"), ([[0.0], [1], [3]], 0.6, "all cells"), (PLANE, 0.0, "^$"),
    (OTHERS.random((3000, 2)), 0.05, r"of 5 [89]\d\d cells"), (OTHERS.random((3000, 3)), 0.08, r"of \d \d\d\d boundary facets")])
def test_notebooks_show_alpha_complexes(points, radius, drawn):
    alpha = delone.Delaunay(points).alpha_complex(radius)
    page = alpha._repr_html_()
    assert len(page) < 20_500 and "delone.AlphaComplex" in page
    figures = {row[0].text: row[1].text for row in xml.etree.ElementTree.fromstring(page).iter("tr")}
    assert (figures["cells"], figures["boundary facets"]) == tuple(f"{len(of):,}".replace(",", " ") for of in (alpha, alpha.boundary))
    assert figures["radius"] == f"{radius:.6g}"
    assert re.search(drawn, "".join(re.findall(r"opacity:.7'>([^<]*)<", page)))
    assert (page.count("<path") > 0) == (len(alpha) > 0)


def test_alpha_complexes_of_changed_points_show_no_picture():
    t = delone.Delaunay(PLANE)
    alpha = t.alpha_complex(squared_radius=0.04)
    assert "radius" not in re.sub("<svg.*</svg>", "", alpha._repr_html_())
    t.insert_range([[5.0, 5]])
    assert alpha._repr_html_() is None


def test_what_notebooks_show_never_raises():
    broken = delone.Delaunay.__new__(delone.Delaunay)
    assert broken._repr_html_() is None


def test_lower_hulls_and_alpha_complexes(plt):
    for d, name in ((2, "rectilinear"), (3, "rectilinear"), (4, "3d")):
        hull = delone.lower_hull(RANDOM.random((30, d)))
        ax = hull.plot(values=hull.height_above(hull.points), colorbar="above")
        assert ax.name == name and len(ax.collections) == 2 and len(ax.collections[1].get_offsets()) == 30
        assert hull._repr_html_().count("<path") >= 1
    with pytest.raises(ValueError, match="plot: compositions of 4 numbers"):
        delone.lower_hull(RANDOM.random((30, 5))).plot()
    t = delone.Delaunay(PLANE)
    shape = t.alpha_complex(np.median(t.circumradii))
    assert len(shape.plot(points=False).collections[0].get_paths()) == len(shape)
    t.insert_range(PLANE + 2)
    with pytest.raises(RuntimeError, match="points have been added"):
        shape.plot()
