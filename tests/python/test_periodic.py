# SPDX-License-Identifier: BSD-3-Clause
"""Periodic triangulations: what may be a lattice, the arrays, files, pickles and refusals."""
import pickle

import numpy as np
import pytest

import delone

points = np.random.default_rng(3).random((200, 3)).astype(np.float32).astype(float)
vectors = np.array([[1, 0, 0], [0.25, 1, 0], [-0.375, 0.3125, 1]])


def volumes(t):
    corners = t.points[t.cells] + t.cell_offsets @ t.lattice
    return np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6


def test_arrays():
    t = delone.PeriodicDelaunay(points, vectors)
    assert (t.dimension, t.affine_dimension, t.rank, t.num_points, t.num_vertices) == (3, 3, 3, 200, 200)
    assert t.cells.shape == t.neighbors.shape == (t.num_cells, 4) and len(t) == t.num_cells
    assert t.cell_offsets.shape == t.neighbor_offsets.shape == (t.num_cells, 4, 3)
    assert t.cell_offsets.dtype == np.int32 and not t.cells.flags.writeable
    assert t.displacement == 0.0
    np.testing.assert_array_equal(t.points, points)
    np.testing.assert_allclose(volumes(t).sum(), 1, rtol=1e-12)
    assert (volumes(t) > 0).all()


def test_neighbors_share_facets():
    t = delone.PeriodicDelaunay(points[:20], vectors)
    named = [[(row, *offset) for row, offset in zip(rows, offsets)] for rows, offsets in zip(t.cells.tolist(), t.cell_offsets.tolist())]
    for cell, (across, shifts) in enumerate(zip(t.neighbors, t.neighbor_offsets)):
        for i in range(4):
            facet = set(named[cell]) - {named[cell][i]}
            other = {(row, *(np.array(offset) + shifts[i])) for row, *offset in named[across[i]]}
            assert facet <= other and named[cell][i] not in other


def test_lattices():
    cube = delone.PeriodicDelaunay(points, 1.0)
    for lattice in (1, [1, 1, 1], np.eye(3), np.eye(3)[::-1], [[1, 0, 0], [3, 1, 0], [0, 0, 1]]):
        assert delone.PeriodicDelaunay(points, lattice).hash == cube.hash
    assert delone.PeriodicDelaunay(points + [1, -2, 3], 1).hash == cube.hash
    slab = delone.PeriodicDelaunay(points, [1, 1, 7], axes=[0, 1])
    assert slab.rank == 2 and (slab.neighbors < 0).any()
    assert delone.PeriodicDelaunay(points, [1, 1, 7], [True, True, False]).hash == slab.hash
    assert delone.PeriodicDelaunay(points, np.eye(3)[:2]).hash == slab.hash
    assert delone.PeriodicDelaunay(points, [1, 1, 7], axes=[]).num_cells == delone.Delaunay(points).num_cells


class Cell:
    """As that of ASE."""

    cellpar = None

    def __init__(self, rows):
        self.rows = np.array(rows, dtype=float)

    def __array__(self, dtype=None, copy=None):
        return self.rows


class Atoms:
    def __init__(self, cell, pbc):
        self.cell, self.pbc = cell, pbc


def test_ase():
    slab = delone.PeriodicDelaunay(points, [1, 1, 1], axes=[0, 1])
    assert delone.PeriodicDelaunay(points, Cell([[1, 0, 0], [0, 1, 0], [0, 0, 0]])).hash == slab.hash
    assert delone.PeriodicDelaunay(points, Atoms(Cell(np.eye(3)), [True, True, False])).hash == slab.hash


def test_weights():
    weights = np.where(np.arange(200) % 2 == 0, 0.01, 0.0)
    t = delone.PeriodicRegular(points, weights, 1.0)
    assert t.num_hidden == (t.vertex_of_point < 0).sum() > 0
    np.testing.assert_array_equal(t.weights, weights)
    assert delone.PeriodicRegular(points, np.zeros(200), 1.0).hash == delone.PeriodicDelaunay(points, 1.0).hash


def test_duplicates_and_few_points():
    t = delone.PeriodicDelaunay([[0.5, 0.5], [1.5, -0.5]], 1.0)
    assert (t.num_vertices, t.num_duplicates, t.num_cells, t.is_simplicial) == (1, 1, 2, False)
    assert t.point_offsets.tolist() == [[0, 0], [1, -1]]


def test_units():
    steps = np.arange(5) * 0.1
    lattice = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    assert 0 < delone.PeriodicDelaunay(lattice, 0.5).displacement < 1e-15
    assert delone.PeriodicDelaunay(lattice, 0.5, unit=0.1, exact=True).num_cells == 50
    with pytest.raises(delone.InputError, match="grid"):
        delone.PeriodicDelaunay(lattice, 0.5, exact=True)


@pytest.mark.parametrize("format", ["npz", "json"])
def test_files(tmp_path, format):
    for t in (delone.PeriodicDelaunay(points, vectors), delone.PeriodicRegular(points, points[:, 0] / 100, vectors, axes=[0, 2])):
        path = tmp_path / ("t." + format)
        t.save(path)
        data = delone.read(path)
        assert data.kind == ("periodic_regular" if isinstance(t, delone.PeriodicRegular) else "periodic_delaunay")
        np.testing.assert_array_equal(data.lattice, t.lattice)
        np.testing.assert_array_equal(data.cell_offsets.reshape(t.cell_offsets.shape), t.cell_offsets)
        report = delone.check(data)
        assert report and report.level == 6
    with pytest.raises(delone.Error):
        t.save(tmp_path / "t.vtu")


def test_pickles():
    for t in (delone.PeriodicDelaunay(points, vectors, axes=[1]), delone.PeriodicRegular(points, points[:, 0] / 100, 1.0)):
        again = pickle.loads(pickle.dumps(t))
        assert type(again) is type(t) and again.hash == t.hash
        np.testing.assert_array_equal(again.cells, t.cells)


@pytest.mark.parametrize("lattice, axes, error, text", [
    ([1, 1], None, ValueError, "lattice"), (np.ones((3, 3)), None, delone.InputError, "singular"), (np.zeros((4, 3)), None, ValueError, "lattice"),
    ([1, 0, 1], None, delone.InputError, "lattice vector 1 is zero"), (np.nan, None, delone.InputError, "not finite"),
    (1, [0, 0], ValueError, "once"), (1, [3], ValueError, "axes"), (1, [True], ValueError, "flags"), (1, ["x"], TypeError, "axes")])
def test_refusals(lattice, axes, error, text):
    with pytest.raises(error, match=text):
        delone.PeriodicDelaunay(points, lattice, axes)


def test_other_refusals():
    with pytest.raises(delone.InputError, match="outside") as caught:
        delone.PeriodicDelaunay([[0.5, 0.5], [1.5, 0]], 1, wrap=False)
    assert list(caught.value.rows) == [1]
    with pytest.raises(ValueError, match="weights"):
        delone.PeriodicRegular(points, [1, 2], 1)
    with pytest.raises(ValueError, match="unit"):
        delone.PeriodicDelaunay(points, 1, unit=0)


def test_interrupt():
    with pytest.raises(delone.CancelledError):
        delone.PeriodicDelaunay(np.random.default_rng(0).random((50000, 3)), 1, progress=lambda fraction: False)


def test_check_takes_the_object():
    t = delone.PeriodicDelaunay([[0.25, 0.25], [0.5, 0.75]], 1.0)
    assert delone.check(t) and delone.check(t.to_data())


def test_a_unit_is_a_number():
    with pytest.raises(TypeError, match="unit"):
        delone.PeriodicDelaunay([[0.1, 0.2]], 1.0, unit="a")


def image(t, rows, offsets):
    return t.points[rows] + offsets @ t.lattice


queries = np.random.default_rng(7).random((300, 3)) * 6 - 3


@pytest.mark.parametrize("lattice, axes", [(1.0, None), (vectors, None), ([1, 1, 1], [0, 1]), ([1, 1, 1], [2])])
def test_location(lattice, axes):
    t = delone.PeriodicDelaunay(points, lattice, axes)
    cells, offsets, weights = t.barycentric(queries)
    inside = cells >= 0
    assert inside.all() == (t.rank == 3) and inside.any()
    corners = t.points[t.cells[cells]] + (t.cell_offsets[cells] + offsets[:, None]) @ t.lattice
    np.testing.assert_allclose((weights[:, :, None] * corners).sum(axis=1)[inside], queries[inside], atol=1e-9)
    assert np.isnan(weights[~inside]).all() and (offsets[~inside] == 0).all()
    again, shifts = t.find_simplex(queries.reshape(30, 10, 3))
    np.testing.assert_array_equal(again.ravel(), cells)
    np.testing.assert_array_equal(shifts.reshape(-1, t.rank), offsets)
    places = t.locate(points + [0, 0, 0])
    assert [place[0] for place in places] == ["on_vertex"] * 200
    np.testing.assert_array_equal(places.face_rows, np.arange(200))
    assert (places.face_lattice == 0).all() and places.offset.shape == (200, t.rank)
    cell, offset = t.find_simplex(queries[0])
    assert (int(cell), offset.tolist()) == (cells[0], offsets[0].tolist())


def test_nearest_is_the_minimum_image():
    t = delone.PeriodicDelaunay(points, 1.0)
    rows, offsets, distances = t.nearest(queries)
    apart = queries[:, None] - points
    apart -= np.round(apart)
    lengths = np.linalg.norm(apart, axis=2)
    np.testing.assert_array_equal(rows, lengths.argmin(axis=1))
    np.testing.assert_allclose(distances, lengths.min(axis=1), rtol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(queries - image(t, rows, offsets), axis=1), distances, rtol=1e-12)
    weights = np.random.default_rng(8).random(200) * 0.01
    power = delone.PeriodicRegular(points, weights, 1.0)
    rows, _, powers = power.nearest(queries)
    np.testing.assert_allclose(powers, (lengths**2 - weights).min(axis=1), rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("kind", [delone.PeriodicLinearInterpolator, delone.PeriodicNaturalNeighborInterpolator])
def test_interpolation(kind):
    t = delone.PeriodicDelaunay(points, vectors)
    values = np.random.default_rng(9).random((200, 2)) + 1j
    f = kind(t, values)
    np.testing.assert_array_equal(f(points), values)
    assert f.triangulation is t and f(queries).shape == (300, 2)
    np.testing.assert_allclose(f(queries), f(queries + 2 * vectors[0] - vectors[2]), atol=1e-9)
    np.testing.assert_allclose(pickle.loads(pickle.dumps(f))(queries), f(queries), rtol=1e-12)
    np.testing.assert_allclose(kind(t, values[:, 0].imag)(queries), 1, atol=1e-9)
    for wrong in (values[1:], 3.0):
        with pytest.raises(ValueError):
            kind(t, wrong)
    with pytest.raises(TypeError):
        kind(delone.Delaunay(points), values)
    slab = kind(delone.PeriodicDelaunay(points, [1, 1, 1], [0, 1]), values.real)
    assert np.isnan(slab([0, 0, 9])).all()
    with pytest.raises(delone.InputError):
        kind(slab.triangulation, values.real, outside="error")([0, 0, 9])
    nearest = slab.triangulation.nearest([0, 0, 9])[0]
    np.testing.assert_array_equal(kind(slab.triangulation, values.real, outside="nearest")([0, 0, 9]), values.real[nearest])
    assert (kind(slab.triangulation, values.real, fill_value=7)([0, 0, 9]) == 7).all()


def test_gradients_and_natural_neighbors():
    t = delone.PeriodicDelaunay(points, vectors)
    z = np.random.default_rng(9).random(200)
    f = delone.PeriodicLinearInterpolator(t, z)
    step = 1e-9 * np.eye(3)[0]
    np.testing.assert_allclose((f(queries + step) - f(queries - step)) / 2e-9, f.gradient(queries)[:, 0], atol=1e-4)
    g = delone.PeriodicNaturalNeighborInterpolator(t, z)
    np.testing.assert_allclose((g(queries + 1e3 * step) - g(queries - 1e3 * step)) / 2e-6, g.gradient(queries)[:, 0], rtol=1e-3, atol=1e-3)
    indptr, rows, offsets, weights = g.natural_neighbors(queries)
    sums = np.add.reduceat(weights[:, None] * image(t, rows, offsets), indptr[:-1])
    np.testing.assert_allclose(sums, queries, atol=1e-8)
    np.testing.assert_allclose(np.add.reduceat(weights * z[rows], indptr[:-1]), g(queries), atol=1e-9)


def test_units_of_queries():
    steps = np.stack(np.meshgrid(*[np.arange(5) * 0.1] * 3), axis=-1).reshape(-1, 3)
    t = delone.PeriodicDelaunay(steps, 0.5, unit=0.1)
    assert (t.locate(steps).kind == 2).all()
    assert float(t.nearest([0.51, 0.0, 0.0])[2]) == pytest.approx(0.01)


def test_refused_queries():
    t = delone.PeriodicDelaunay(points, 1.0)
    for wrong in ([[0, 0, np.nan]], [[0, 0, 1e300]]):
        for ask in (t.find_simplex, t.locate, t.barycentric, t.nearest):
            with pytest.raises(delone.InputError) as error:
                ask(wrong)
            assert error.value.rows == [0]
    with pytest.raises(ValueError):
        t.nearest([0, 0])


def test_what_is_refused_says_why():
    for lattice, words in ((-1, "lengths above 0"), ([1, -1, 1], "lengths above 0"), (object(), "an object"), ({}, "a dict")):
        with pytest.raises(ValueError, match=words):
            delone.PeriodicDelaunay(points, lattice)
    with pytest.raises(delone.InputError, match="too skewed"):
        delone.PeriodicDelaunay(points, [[1, 0, 0], [2.0**31, 1, 0], [0, 0, 1]])
    with pytest.raises(ValueError, match="finite"):
        delone.PeriodicDelaunay(points, 1.0, unit=np.inf)


def test_time_limits_end_questions():
    with pytest.raises(delone.TimeLimitError):
        delone.PeriodicDelaunay(np.zeros((1, 7)), 1.0, time_limit=0.2)


def test_faces():
    t = delone.PeriodicDelaunay(points, vectors)
    counts = [len(t.faces(j)) for j in range(4)]
    assert counts[0] == 200 and counts[3] == t.num_cells and counts[0] - counts[1] + counts[2] - counts[3] == 0
    cells = t.faces(3)
    np.testing.assert_array_equal(cells.vertices, t.cells)
    np.testing.assert_array_equal(cells.offsets, t.cell_offsets)
    edges = t.faces(1)
    ends = t.points[edges.vertices] + edges.offsets @ t.lattice
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    values = t.alpha_values(1)
    assert (values >= lengths**2 / 4 * (1 - 1e-12)).all() and len(values) == counts[1]
    assert not edges.on_hull.any() and delone.PeriodicDelaunay(points, [1, 1, 1], [0, 1]).faces(2).on_hull.any()
    for wrong in (-1, 4):
        with pytest.raises(ValueError):
            t.faces(wrong)


def arrays(t):
    return [t.points, t.cells, t.cell_offsets, t.neighbors, t.neighbor_offsets, t.vertex_of_point, t.point_offsets]


def assert_same(a, b):
    assert a.hash == b.hash
    for one, other in zip(arrays(a), arrays(b)):
        np.testing.assert_array_equal(one, other)


def test_steps():
    random = np.random.default_rng(7)
    x = points.copy()
    t = delone.PeriodicDelaunay(x, vectors)
    first_cells, first = t.cells, t.cells.copy()
    for step in range(5):
        x = x + random.normal(scale=1e-4, size=x.shape)
        x[step] += vectors[step % 3]
        later = t.moved(x)
        assert type(later) is delone.PeriodicDelaunay
        assert_same(later, delone.PeriodicDelaunay(x, vectors))
        t = later
    np.testing.assert_array_equal(first_cells, first)
    wider = vectors * 1.0001
    assert_same(t.moved(x * 1.0001, lattice=wider), delone.PeriodicDelaunay(x * 1.0001, wider))
    slab = delone.PeriodicDelaunay(points, [1, 1, 7], axes=[0, 1], unit=0.125)
    assert_same(slab.moved(points + 0.25), delone.PeriodicDelaunay(points + 0.25, [1, 1, 7], axes=[0, 1], unit=0.125))


def test_steps_with_weights():
    weights = np.linspace(0, 4e-3, 200)
    t = delone.PeriodicRegular(points, weights, 1.0)
    later = t.moved(points + 1e-6)
    np.testing.assert_array_equal(later.weights, weights)
    weights[7] = 0.1
    later = later.moved(points, weights)
    assert type(later) is delone.PeriodicRegular and later.num_hidden > t.num_hidden
    assert_same(later, delone.PeriodicRegular(points, weights, 1.0))


def test_bad_steps_are_refused():
    t = delone.PeriodicDelaunay(points, 1.0)
    bad = points.copy()
    bad[17, 1] = np.nan
    with pytest.raises(delone.InputError, match="17"):
        t.moved(bad)
    with pytest.raises(delone.InputError, match="199 points for 200 rows"):
        t.moved(points[:-1])
    with pytest.raises(ValueError, match=r"shape \(n, 3\)"):
        t.moved(points[:, :2])
    with pytest.raises(delone.InputError, match="lattice"):
        t.moved(points, lattice=np.eye(3)[:2])
    with pytest.raises(delone.InputError, match="weights"):
        delone.PeriodicRegular(points, np.zeros(200), 1.0).moved(points, np.zeros(3))


def test_changed_neighbors():
    def pairs(t):
        edges = t.faces(1)
        found = set()
        for (a, b), (of_a, of_b) in zip(edges.vertices.tolist(), edges.offsets.tolist()):
            offset = np.subtract(of_b, of_a).tolist()
            found.add((a, b, *offset) if a < b else (b, a, *[-k for k in offset]))
        return found

    def listed(rows, offsets):
        return set(map(tuple, np.hstack([rows, offsets]).tolist()))

    t = delone.PeriodicDelaunay(points, 1.0)
    for scale in (1e-4, 0.1):
        later = t.moved(points + np.random.default_rng(1).normal(scale=scale, size=points.shape))
        changes = delone.changed_neighbors(t, later)
        assert listed(changes.began, changes.began_offsets) == pairs(later) - pairs(t)
        assert listed(changes.ended, changes.ended_offsets) == pairs(t) - pairs(later)
        assert not changes.began.flags.writeable and changes.began_offsets.shape == (len(changes.began), 3)
    same = delone.changed_neighbors(t, t)
    assert len(same.began) == len(same.ended) == 0


def test_changed_neighbors_of_open_sets():
    t = delone.Delaunay(points)
    before = t.clone()
    t.move(np.arange(200), points + np.random.default_rng(1).normal(scale=1e-3, size=points.shape))
    changes = delone.changed_neighbors(before, t)
    edges = [set(map(tuple, one.faces(1).vertices.tolist())) for one in (before, t)]
    assert set(map(tuple, changes.began.tolist())) == edges[1] - edges[0]
    assert set(map(tuple, changes.ended.tolist())) == edges[0] - edges[1]
    assert changes.began_offsets.shape == (len(changes.began), 0) and len(changes.began) > 0
    with pytest.raises(TypeError, match="both periodic or none"):
        delone.changed_neighbors(t, delone.PeriodicDelaunay(points, 1.0))
