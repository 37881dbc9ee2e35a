# SPDX-License-Identifier: BSD-3-Clause
"""Pages for browsers: what is in them, and what is refused. What browsers make of them: tests/site/test_viewer.py."""
import json
import re

import numpy as np
import pytest

import delone

POINTS = np.random.default_rng(3).uniform(size=(40, 3))


def scene(page):
    return json.loads(re.search(r'id="delone-scene">(.*?)</script>', page).group(1))


CUBE = np.c_[np.vstack([np.eye(3), -np.eye(3)]), -np.ones(6)]


@pytest.mark.parametrize("make, kind, cells", [
    (lambda: delone.Delaunay(POINTS), "triangulation", "num_cells"), (lambda: delone.Regular(POINTS, np.zeros(40)), "triangulation", "num_cells"),
    (lambda: delone.ConvexHull(POINTS), "hull", "num_cells"), (lambda: delone.Voronoi(POINTS), "diagram", "num_regions"),
    (lambda: delone.PowerDiagram(POINTS, np.zeros(40)), "diagram", "num_regions"),
    (lambda: delone.HalfspaceIntersection(CUBE), "intersection", "num_facets")])
def test_pages(make, kind, cells, tmp_path):
    product = make()
    page = product.to_html(title="A <title>")
    assert scene(page)["kind"] == kind
    assert scene(page)["title"] == "A <title>"
    assert scene(page)["numCells"] == getattr(product, cells)
    assert product.to_html(tmp_path / "page.html", title="A <title>") is None
    assert (tmp_path / "page.html").read_text() == page


def test_alpha_complexes():
    t = delone.Delaunay(POINTS)
    alpha = t.alpha_complex(0.25)
    assert 0 < len(alpha) < t.num_cells
    page = scene(alpha.to_html(values=np.arange(40.0)))
    assert page["kind"] == "alpha" and page["title"] == "Alpha complex" and page["numCells"] == len(alpha)
    assert page["valueOfVertices"] and not page["dual"]
    assert not scene(alpha.to_html(values=np.arange(len(alpha)), values_at="cells"))["valueOfVertices"]
    with pytest.raises(ValueError, match="values_at: one of 'points', 'cells'"):
        alpha.to_html(values=np.zeros(40), values_at="facets")
    t.insert_range([[2.0, 2, 2]])
    with pytest.raises(RuntimeError, match="points have been added"):
        alpha.to_html()


def test_removed_rows_are_left_out(tmp_path):
    t = delone.Regular(POINTS, np.zeros(40))
    t.remove([0, 7, 39])
    page = t.to_html(values=np.arange(40.0))
    rest = np.delete(POINTS, [0, 7, 39], axis=0)
    assert not re.search("nan|null", page[page.index("delone-scene"):page.index("delone-positions")], re.IGNORECASE)
    found = scene(page)
    assert (found["numVertices"], found["numCells"]) == (37, delone.Delaunay(rest).num_cells)
    assert found["low"] == rest.min(axis=0).tolist() and found["high"] == rest.max(axis=0).tolist()
    assert (found["blocks"]["value"]["low"], found["blocks"]["value"]["high"]) == (1, 38)
    assert scene(t.alpha_complex(np.inf).to_html())["numVertices"] == 37
    t.save(tmp_path / "page.html")
    assert scene((tmp_path / "page.html").read_text())["numVertices"] == 37
    with pytest.raises(delone.Error, match="row 0 was removed"):
        t.save(tmp_path / "page.npz")


def test_values():
    t = delone.Delaunay(POINTS)
    page = scene(t.to_html(values=np.arange(40.0), value_name="height"))
    assert page["valueOfVertices"] and page["valueName"] == "height"
    assert page["blocks"]["value"]["high"] == 39
    assert not scene(t.to_html(values=np.arange(t.num_cells), values_at="cells"))["valueOfVertices"]
    missing = np.arange(40.0)
    missing[7] = np.nan
    assert scene(t.to_html(values=missing))["blocks"]["value"]["high"] == 39
    for given in (np.ma.masked_equal(np.arange(40), 7), np.arange(40, dtype=">f4"), np.arange(40, dtype=np.float16), [*range(39), None]):
        assert scene(t.to_html(values=given))["blocks"]["value"]["high"] == (38 if isinstance(given, list) else 39)
    box = scene(delone.Voronoi(POINTS).to_html(box=[[-1] * 3, [2] * 3]))
    assert box["low"] == [-1, -1, -1] and box["high"] == [2, 2, 2]


def test_columns_have_names():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(CUBE, columns=["x", "y", "z", "offset"])
    for product in (delone.HalfspaceIntersection(frame), delone.Delaunay(pandas.DataFrame(POINTS, columns=["x", "y", "z"]))):
        assert '"x","y","z"' in product.to_html()


def test_what_is_refused(tmp_path):
    t = delone.Delaunay(POINTS)
    with pytest.raises(ValueError, match="path: a page is HTML, in a file .html or .htm, not '.png'"):
        t.to_html(tmp_path / "a.png")
    assert not any(tmp_path.iterdir())
    with pytest.raises(ValueError, match="3 numbers for 40 rows"):
        t.to_html(values=[1, 2, 3])
    with pytest.raises(ValueError, match="values_at: one of 'points', 'cells'"):
        t.to_html(values=np.zeros(40), values_at="facets")
    with pytest.raises(ValueError, match="values"):
        t.to_html(values=np.zeros((40, 1)))
    with pytest.raises(delone.Error, match="item 0 is infinite"):
        t.to_html(values=np.full(40, np.inf))
    with pytest.raises(delone.Error, match="missing"):
        t.to_html(tmp_path / "missing" / "page.html")
    with pytest.raises(delone.Error, match="at most 3 dimensions"):
        delone.Voronoi(np.random.default_rng(0).uniform(size=(9, 4))).to_html()
    assert "<html" in delone.FurthestVoronoi(POINTS).to_html()
    with pytest.raises(delone.Error, match="no interior points"):
        delone.HalfspaceIntersection([[1.0, 0, 1], [-1, 0, 1]]).to_html()
