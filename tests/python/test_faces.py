# SPDX-License-Identifier: BSD-3-Clause
"""Faces, circumscribed spheres, quality, alpha values and complexes."""
import fractions
import itertools
import pickle

import numpy as np
import pytest

import delone


def uniform(n, d, seed=1):
    return np.random.default_rng(seed).random((n, d))


def rows_of(faces):
    return {tuple(sorted(face)) for face in faces.vertices.tolist()}


@pytest.mark.parametrize("d", [1, 2, 3, 4])
def test_faces_are_all_subsets_of_cells(d):
    t = delone.Delaunay(uniform(40, d))
    for j in range(d + 1):
        faces = t.faces(j)
        assert isinstance(faces, delone.Faces) and faces.dimension == j and len(faces) == len(faces.vertices) == len(faces.cells)
        expected = {tuple(sorted(face)) for cell in t.cells.tolist() for face in itertools.combinations(cell, j + 1)}
        assert rows_of(faces) == expected and len(faces) == len(expected)
        hull = {tuple(sorted(face)) for facet in t.hull_facets.tolist() for face in itertools.combinations(facet, j + 1)}
        assert rows_of(faces) & hull == {tuple(sorted(face)) for face in faces.vertices[faces.on_hull].tolist()}
        for face, cell in zip(faces.vertices.tolist(), faces.cells.tolist()):
            assert set(face) <= set(t.cells[cell].tolist())
    assert "of dimension" in repr(faces) and not faces.vertices.flags.writeable
    again = pickle.loads(pickle.dumps(faces))
    assert again.dimension == d and all((getattr(again, name) == getattr(faces, name)).all() for name in ("vertices", "cells", "on_hull"))


def test_circumscribed_spheres_and_quality():
    t = delone.Delaunay(uniform(300, 3))
    radii, centers = t.circumradii, t.circumcenters
    assert radii.shape == (len(t),) and centers.shape == (len(t), 3)
    distances = np.linalg.norm(t.points[t.cells] - centers[:, None], axis=2)
    np.testing.assert_allclose(distances, np.broadcast_to(radii[:, None], distances.shape), rtol=1e-6)
    edges = np.linalg.norm(t.points[t.cells][:, :, None] - t.points[t.cells][:, None], axis=3)
    np.testing.assert_allclose(t.qualities("radius_edge_ratio"), radii / np.where(edges > 0, edges, np.inf).min(axis=(1, 2)), rtol=1e-9)
    volumes = np.abs(np.linalg.det(t.points[t.cells][:, 1:] - t.points[t.cells][:, :1])) / 6
    squares = (edges**2).sum(axis=(1, 2)) / 2
    np.testing.assert_allclose(t.qualities("mean_ratio"), 12 * (3 * volumes) ** (2 / 3) / squares, rtol=1e-6, atol=1e-12)
    assert ((t.qualities() > 0) & (t.qualities() <= 1)).all() and (t.qualities() == t.qualities(measure="radius_ratio")).all()
    with pytest.raises(ValueError, match="measure: .*not beauty"):
        t.qualities("beauty")


def test_alpha_values_tell_the_complex_exactly():
    grid = np.array(list(itertools.product(range(4), repeat=3)), float)
    for t in (delone.Delaunay(grid), delone.Delaunay(uniform(200, 3)), delone.Regular(uniform(200, 2), 0.01 * uniform(200, 1)[:, 0])):
        levels = t.alpha_filtration()
        assert len(levels) == t.affine_dimension + 1
        above = {}
        for j in reversed(range(len(levels))):
            faces, values = levels[j]
            np.testing.assert_array_equal(t.alpha_values(j), values)
            np.testing.assert_array_equal(t.faces(j).vertices, faces.vertices)
            own = {tuple(sorted(face)): value for face, value in zip(faces.vertices.tolist(), values.tolist())}
            for face, value in above.items():
                for facet in itertools.combinations(face, len(face) - 1):
                    assert own[facet] <= value
            above = own
        for squared in np.quantile(levels[-1][1], [0, 0.5]):
            complex = t.alpha_complex(squared_radius=squared)
            for j, (faces, values) in enumerate(levels):
                np.testing.assert_array_equal(complex.faces(j).vertices, faces.vertices[values <= squared])
            np.testing.assert_array_equal(complex.cell_numbers, np.flatnonzero(levels[-1][1] <= squared))
            np.testing.assert_array_equal(complex.cells, t.cells[complex.cell_numbers])
            assert len(complex) == len(complex.cells)


def test_radius_is_exact():
    t = delone.Delaunay([[0, 0], [3, 0], [3, 4], [0, 4]])
    assert len(t.alpha_complex(2.5)) == 2 and t.alpha_complex(2.5).radius == 2.5
    assert len(t.alpha_complex(np.nextafter(2.5, 0))) == 0
    assert len(t.alpha_complex(float("inf"))) == 2 and np.isnan(t.alpha_complex(squared_radius=1).radius)
    complex = t.alpha_complex(2.5)
    assert {tuple(edge) for edge in complex.boundary.tolist()} == {(0, 1), (1, 2), (2, 3), (3, 0)}
    assert len(complex.boundary_cells) == 4 and complex.singular_facets.shape == (0, 2)
    points = uniform(100, 2)
    t = delone.Delaunay(points)
    exact = [[fractions.Fraction(x) for x in p] for p in points.tolist()]
    for value, (a, b) in zip(t.alpha_values(1), t.faces(1).vertices):
        square = sum((x - y) ** 2 for x, y in zip(exact[a], exact[b])) / 4
        assert fractions.Fraction(value) >= square


def test_boundary_encloses_the_volume_of_the_cells():
    t = delone.Delaunay(uniform(500, 3))
    complex = t.alpha_complex(0.12)
    corners = t.points[complex.cells]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
    assert np.linalg.det(t.points[complex.boundary]).sum() / 6 == pytest.approx(volume)


def test_few_points_and_wrong_arguments():
    empty = delone.Delaunay(np.empty((0, 2)))
    assert empty.alpha_filtration() == [] and empty.alpha_complex(1).cells.shape == (0, 0) and len(empty.faces(1)) == 0
    flat = delone.Delaunay([[0, 0, 0], [1, 1, 1], [1, 1, 1]])
    assert flat.alpha_values(1).tolist() == [0.75] and flat.alpha_values(2).shape == (0,) and flat.circumradii.shape == (1,)
    t = delone.Delaunay(uniform(20, 2))
    for wrong in (lambda: t.alpha_complex(-1), lambda: t.alpha_complex(float("nan")), lambda: t.alpha_complex(), lambda: t.faces(3),
                  lambda: t.alpha_complex(1, squared_radius=1), lambda: t.alpha_complex(squared_radius=float("nan")), lambda: t.alpha_values(-1)):
        with pytest.raises(ValueError):
            wrong()
    with pytest.raises(delone.Error):
        delone.FurthestSite(uniform(20, 2)).alpha_complex(1)
    complex = t.alpha_complex(0.1)
    boundary = complex.boundary.copy()
    with pytest.raises(delone.CancelledError):  # which changes nothing
        t.insert_range(uniform(1_000_000, 2), progress=lambda fraction: False)
    np.testing.assert_array_equal(complex.faces(2).cells, complex.cell_numbers)
    t.insert_range([[5, 5]])
    np.testing.assert_array_equal(complex.boundary, boundary)
    with pytest.raises(RuntimeError, match="added"):
        complex.faces(1)


def test_against_gudhi():
    gudhi = pytest.importorskip("gudhi")
    points = uniform(300, 3)
    tree = gudhi.AlphaComplex(points=points.tolist()).create_simplex_tree()
    theirs = {tuple(sorted(simplex)): value for simplex, value in tree.get_filtration()}
    ours = {tuple(sorted(face)): value for faces, values in delone.Delaunay(points).alpha_filtration()
            for face, value in zip(faces.vertices.tolist(), values.tolist())}
    assert ours.keys() == theirs.keys()
    for face, value in ours.items():
        assert value == pytest.approx(theirs[face], rel=1e-6)
