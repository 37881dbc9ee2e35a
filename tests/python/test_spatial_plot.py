# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of delone.spatial: what is drawn, and that nothing but drawing needs Matplotlib, and nothing at all scipy."""
import subprocess
import sys

import numpy as np
import pytest

from delone import spatial

POINTS = np.random.default_rng(1).random((30, 2))


@pytest.fixture
def plt():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    yield plt
    plt.close("all")


def test_modules_are_imported_when_needed_only():
    code = ("import sys, delone.spatial as s; s.Voronoi([[0, 0], [1, 0], [0, 1]]).regions; s.Delaunay([[0, 0], [1, 0], [0, 1]]).equations; "
            "print(sorted({m.split('.')[0] for m in sys.modules} & {'scipy', 'matplotlib'}))")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_triangulations_are_drawn(plt):
    figure = spatial.delaunay_plot_2d(spatial.Delaunay(POINTS))
    assert len(figure.gca().lines) == 3  # points, edges, and Matplotlib's empty line of markers
    axes = plt.figure().gca()
    assert spatial.delaunay_plot_2d(spatial.Delaunay([[0, 0], [1, 1], [2, 2]], flat="result"), ax=axes) is axes.figure


def test_hulls_are_drawn(plt):
    hull = spatial.ConvexHull(POINTS)
    figure = spatial.convex_hull_plot_2d(hull)
    assert len(figure.gca().collections[0].get_segments()) == len(hull.simplices)
    spatial.convex_hull_plot_2d(spatial.ConvexHull([[0, 0], [1, 1], [2, 2]], flat="result"))


def test_diagrams_are_drawn(plt):
    diagram = spatial.Voronoi(POINTS)
    axes = spatial.voronoi_plot_2d(diagram, line_colors="orange", line_width=2, line_alpha=0.6, point_size=2).gca()
    assert len(axes.lines) == 2
    assert sum(len(lines.get_segments()) for lines in axes.collections) == len(diagram.ridge_points)
    axes = spatial.voronoi_plot_2d(diagram, show_points=False, show_vertices=False).gca()
    assert len(axes.lines) == 0


def test_rays_point_away_from_the_other_points(plt):
    """In a flat triangle the ray of the long side starts beyond that side, so the middle of the points does not tell its direction."""
    points = np.array([[0, 0], [10, 0], [5, 1.0]])
    diagram = spatial.Voronoi(points)
    axes = spatial.voronoi_plot_2d(diagram).gca()
    for start, end in axes.collections[1].get_segments():
        middle = (np.asarray(start) + end) / 2
        near = np.argsort(np.linalg.norm(points - end, axis=1))[:2]
        pair = tuple(sorted(near.tolist()))
        assert -1 in {tuple(sorted(k)): v for k, v in diagram.ridge_dict.items()}[pair]
        np.testing.assert_allclose(*np.linalg.norm(points[near] - middle, axis=1), rtol=1e-9)


def test_only_the_plane_is_drawn(plt):
    cube = np.random.default_rng(1).random((10, 3))
    for plot, cls in [(spatial.delaunay_plot_2d, "Delaunay"), (spatial.convex_hull_plot_2d, "ConvexHull"),
                      (spatial.voronoi_plot_2d, "Voronoi")]:
        with pytest.raises(ValueError, match="is not 2-D"):
            plot(getattr(spatial, cls)(cube))
