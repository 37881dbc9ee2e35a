# SPDX-License-Identifier: BSD-3-Clause
"""Edits: whatever the history, the result is that of the rows that are left; changes, undo, ids, copies, and calls that fail."""
import copy
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import delone

KINDS = (delone.Delaunay, delone.Regular, delone.FurthestSite)
ARRAYS = ("cells", "neighbors", "points", "vertex_of_point", "cell_ids", "vertex_ids", "duplicates", "cell_of_point")


def make(kind, points, weights, **options):
    return kind(points, weights, **options) if kind is delone.Regular else kind(points, **options)


def arrays(t):
    """Copies of what can be asked of rows, cells and ids."""
    hidden = {"hidden": t.hidden} if hasattr(t, "hidden") else {}
    weights = {"weights": t.weights} if hasattr(t, "weights") else {}
    return {**{name: np.array(getattr(t, name)) for name in ARRAYS}, **hidden, **weights, "hash": t.hash, "num_rows": t.num_rows,
            "num_points": t.num_points, "affine_dimension": t.affine_dimension}


def assert_same(a, b):
    assert a.keys() == b.keys()
    for name in a:
        np.testing.assert_array_equal(a[name], b[name], err_msg=name)


class History:
    """A triangulation that is edited at random, and the rows that it must have."""

    def __init__(self, kind, dimension, count, seed, lattice=None):
        self.kind, self.d, self.random, self.lattice = kind, dimension, np.random.default_rng(seed), lattice
        self.points, self.weights = self.some(count)
        self.there = np.ones(count, bool)
        self.t = make(kind, self.points, self.weights)

    def some(self, count):
        """Points, with weights large enough to hide some."""
        if self.lattice:
            return self.random.integers(0, self.lattice, (count, self.d)) * 1.0, self.random.integers(0, 3, count) * 0.5
        return self.random.standard_normal((count, self.d)), self.random.random(count) * 0.5

    def rows(self, most):
        there = np.flatnonzero(self.there)
        return self.random.permutation(there)[:self.random.integers(1, most + 1)]

    def remove(self, rows):
        self.t.remove(rows)
        self.there[rows] = False

    def move(self, rows, points):
        self.t.move(rows, points)
        self.points[rows] = points

    def edit(self, most):
        """Changes some rows, at most so many of a kind."""
        choice = self.random.integers(0, 6)
        rows, (points, weights) = self.rows(most), self.some(most)
        if len(rows) == 0 or choice == 5:
            self.edit_all(rows, *self.some(self.random.integers(1, most + 1)))
        elif choice == 0:
            self.remove(int(rows[0]))
        elif choice == 1:
            self.remove(rows.astype(self.random.choice([np.int8, np.uint16, np.int64])))
        elif choice == 2:
            nearby = self.points[rows[0]] + (0 if self.lattice else 0.01 * points[0])
            self.move(rows[0], nearby)
        elif choice == 3 or self.kind is not delone.Regular:
            self.move(rows.tolist(), points[:len(rows)])
        else:
            self.t.set_weights(rows, weights[:len(rows)])
            self.weights[rows] = weights[:len(rows)]

    def edit_all(self, rows, points, weights):
        gone, moved = np.split(rows, [len(rows) // 2])
        to, others = self.some(len(moved))
        more = {}
        if self.kind is delone.Regular:
            weighed = moved[::2]
            more = {"insert_weights": weights, "weights": (weighed, others[::2])}
        self.t.edit(insert=points, remove=gone, move=(moved, to), **more)
        if self.kind is delone.Regular:
            self.weights[weighed] = others[::2]
        self.there[gone], self.points[moved] = False, to
        self.points, self.weights = np.concatenate([self.points, points]), np.concatenate([self.weights, weights])
        self.there = np.append(self.there, np.ones(len(points), bool))

    def fresh(self):
        return make(self.kind, self.points[self.there], self.weights[self.there])

    def check(self):
        t, fresh, old = self.t, self.fresh(), np.flatnonzero(self.there)
        assert t.hash == fresh.hash
        assert (t.num_rows, t.num_points, t.num_vertices) == (len(self.there), len(old), fresh.num_vertices)
        np.testing.assert_array_equal(t.has_row(np.arange(t.num_rows)), self.there)
        np.testing.assert_array_equal(t.points, np.where(self.there[:, None], self.points, np.nan))
        expected = np.full(t.num_rows, -1)
        expected[old] = np.where(fresh.vertex_of_point >= 0, old[fresh.vertex_of_point], -1) if len(old) else -1
        np.testing.assert_array_equal(t.vertex_of_point, expected)
        assert {tuple(sorted(cell)) for cell in t.cells.tolist()} == {tuple(sorted(cell)) for cell in old[fresh.cells].tolist()}
        if self.kind is delone.Regular:
            np.testing.assert_array_equal(t.weights, np.where(self.there, self.weights, np.nan))
        if self.kind is not delone.Delaunay:
            np.testing.assert_array_equal(t.hidden, old[fresh.hidden])
            assert t.num_hidden == fresh.num_hidden


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("dimension", [2, 3, 4])
def test_the_result_is_that_of_the_rows_that_are_left(kind, dimension):
    for seed in range(2):
        history = History(kind, dimension, 60, seed)
        for _ in range(10):
            history.edit(6)
            history.check()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("dimension, size, count", [(1, 4, 3), (2, 2, 3), (2, 3, 8), (3, 2, 6), (4, 2, 10)])
def test_histories_of_few_lattice_points(kind, dimension, size, count):
    """They change the affine dimension, down to no point, and have many ties and duplicates."""
    for seed in range(3):
        history = History(kind, dimension, count, seed, size)
        for _ in range(12):
            history.edit(count)
            history.check()


@pytest.mark.parametrize("kind", KINDS)
def test_an_edit_of_nearly_everything(kind):
    """Cells are built anew."""
    history = History(kind, 3, 300, 5)
    history.edit_all(np.arange(280), *history.some(40))
    history.check()
    history.remove(np.flatnonzero(history.there))
    history.check()
    assert history.t.affine_dimension == -1 and len(history.t) == 0 and history.t.num_points == 0
    history.edit_all(np.arange(0), *history.some(50))
    history.check()


def by_id(t):
    return dict(zip(t.cell_ids.tolist(), map(tuple, t.vertex_ids[t.cells].tolist())))


class Follower:
    """What belongs to cells and vertices, kept by what changes say."""

    def __init__(self, t):
        self.t, self.gone = t, set()
        self.payload = np.full(0, -1)
        self.write(t.cell_ids)
        self.remember()

    def sums(self):
        """What belongs to the cells, in their order."""
        return (self.t.vertex_ids[self.t.cells].astype(np.int64) ** 2).sum(1)

    def write(self, ids):
        cell_ids = self.t.cell_ids
        if len(cell_ids) and cell_ids[-1] >= len(self.payload):
            self.payload = np.append(self.payload, np.full(cell_ids[-1] + 1 - len(self.payload), -1))
        self.payload[ids] = self.sums()[np.searchsorted(cell_ids, ids)]

    def remember(self):
        t = self.t
        self.cells, self.vertices, self.rows = by_id(t), t.vertex_ids, np.c_[t.points, t.weights if isinstance(t, delone.Regular) else t.points]

    def follow(self):
        t, made = self.t, self.t.changes
        cells = by_id(t)
        removed, created, added, gone, hidden, reappeared, moved = (getattr(made, name).tolist() for name in made.__slots__)
        for ids in (removed, created, added, gone, hidden, reappeared, moved):
            assert ids == sorted(set(ids))
        assert set(removed) <= self.cells.keys() and set(created) <= cells.keys()
        assert self.cells.keys() - removed == cells.keys() - created
        assert all(self.cells[i] == cells[i] for i in cells.keys() - created)

        before, after = set(self.vertices.tolist()) - {-1}, set(t.vertex_ids.tolist()) - {-1}
        assert after - before == set(added) & after | set(reappeared) and before - after == set(gone) & before | set(hidden)
        assert not set(added) & before and not set(gone) & after and set(hidden) <= before and set(reappeared) <= after
        rows = np.c_[t.points, t.weights if isinstance(t, delone.Regular) else t.points]
        n = min(len(rows), len(self.rows))
        same_vertex = (self.vertices[:n] == t.vertex_ids[:n]) & (self.vertices[:n] > 0)
        differs = same_vertex & (rows[:n] != self.rows[:n]).any(1)
        assert set(t.vertex_ids[:n][differs].tolist()) <= set(moved) and not set(moved) & (set(gone) | set(added))
        assert not set(moved) & set(t.vertex_ids[:n][same_vertex & ~differs].tolist())

        self.payload[removed] = -1
        self.write(made.created_cells)
        np.testing.assert_array_equal(self.payload[t.cell_ids], self.sums())
        assert np.count_nonzero(self.payload >= 0) == len(t)
        assert not self.gone & set(added)  # ids are not used again
        self.gone |= set(gone)
        self.remember()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("dimension, count, lattice", [(2, 60, None), (2, 12, 3), (3, 50, None), (3, 8, 2), (4, 40, None)])
def test_changes_lead_from_one_state_to_the_next(kind, dimension, count, lattice):
    history = History(kind, dimension, count, 7, lattice)
    assert history.t.changes is None
    history.t.record_changes()
    assert repr(history.t.changes) == "<delone.Changes: none>"
    follower = Follower(history.t)
    for _ in range(12):
        history.edit(5)
        follower.follow()
    points, weights = history.some(5)
    history.t.insert_range(*([points, weights] if kind is delone.Regular else [points]))
    follower.follow()
    history.t.record_changes(False)
    assert history.t.changes is None


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("dimension, count, lattice", [(1, 6, 4), (2, 30, None), (2, 9, 3), (3, 40, None), (3, 8, 2), (4, 30, None)])
def test_undo(kind, dimension, count, lattice):
    history = History(kind, dimension, count, 11, lattice)
    t = history.t
    t.record_undo()
    t.record_changes()
    assert not t.can_undo
    follower = Follower(t)
    for step in range(12):
        before, model = arrays(t), (history.points.copy(), history.weights.copy(), history.there.copy())
        if step == 9:  # cells are built anew
            history.edit_all(np.flatnonzero(history.there), *history.some(30))
        elif step == 10:
            history.remove(np.flatnonzero(history.there))
        elif step == 11:
            points, weights = history.some(4)
            t.insert_range(*([points, weights] if kind is delone.Regular else [points]))
        else:
            history.edit(6)
        follower.follow()
        if step % 2 == 0 and step < 9:  # this one stays
            continue
        assert t.can_undo
        t.undo()
        assert not t.can_undo
        assert_same(arrays(t), before)
        follower.gone.clear()
        follower.follow()
        follower.gone.clear()  # ids of added vertices are free again
        history.points, history.weights, history.there = model
        with pytest.raises(delone.InputError, match="undo"):
            t.undo()
    history.check()


def test_undo_is_of_the_last_edit_only_and_may_be_switched_off():
    t = delone.Delaunay(np.random.default_rng(0).random((50, 3)))
    with pytest.raises(delone.InputError):
        t.undo()
    t.record_undo()
    t.remove(0)
    t.remove(1)
    t.undo()
    assert t.has_row([0, 1]).tolist() == [False, True] and not t.can_undo
    t.remove(1)
    t.record_undo(False)
    assert not t.can_undo


@pytest.mark.parametrize("kind", KINDS)
def test_compact_ids(kind):
    history = History(kind, 3, 60, 3)
    t = history.t
    t.record_undo()
    for _ in range(6):
        history.edit(8)
    history.remove(np.flatnonzero(history.there)[::3])
    before = arrays(t)
    vertices, rows = t.compact_ids()
    assert len(vertices) > before["vertex_ids"].max() and len(rows) == before["num_rows"] and vertices[0] == 0 and not t.can_undo
    np.testing.assert_array_equal(rows >= 0, history.there)
    np.testing.assert_array_equal(rows[history.there], np.arange(t.num_rows))
    assert sorted(vertices[vertices > 0]) == list(range(1, 1 + np.count_nonzero(vertices > 0)))
    history.points, history.weights = history.points[history.there], history.weights[history.there]
    history.there = history.there[history.there]
    history.check()
    np.testing.assert_array_equal(t.cells, rows[before["cells"]])
    np.testing.assert_array_equal(t.cell_ids, before["cell_ids"])
    old = before["vertex_ids"][rows >= 0]
    np.testing.assert_array_equal(t.vertex_ids, np.where(old > 0, vertices[old], -1))
    if kind is delone.Delaunay:
        assert delone.check(t)
    history.edit(8)
    history.check()


COPIES = {"clone": lambda t: t.clone(), "copy": copy.copy, "deepcopy": copy.deepcopy, "pickle": lambda t: pickle.loads(pickle.dumps(t))}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("duplicate", COPIES)
def test_copies_of_what_was_edited(kind, duplicate):
    history = History(kind, 3, 50, 4)
    history.edit_all(np.array([0, 3, 7, 20, 21, 22]), *history.some(4))
    history.remove(np.array([53]))
    t = history.t
    t.record_changes()
    before = arrays(t)
    other = COPIES[duplicate](t)
    assert type(other) is kind and not other.can_undo
    if duplicate == "pickle":  # is built again, with cells and vertices in another order
        skipped = {"cells", "neighbors", "cell_ids", "vertex_ids", "cell_of_point"}
        assert_same({k: v for k, v in arrays(other).items() if k not in skipped}, {k: v for k, v in before.items() if k not in skipped})
    else:
        assert_same(arrays(other), before)
    history.t = other
    history.check()
    for _ in range(3):
        history.edit(5)
        history.check()
    assert_same(arrays(t), before)
    t.remove(np.flatnonzero(t.has_row(np.arange(t.num_rows))))
    empty = COPIES[duplicate](t)
    assert (empty.num_points, empty.num_rows, len(empty), empty.affine_dimension) == (0, t.num_rows, 0, -1) and np.isnan(empty.points).all()
    empty.move(np.arange(0), np.zeros((0, 3)))


@pytest.mark.parametrize("kind", KINDS)
def test_what_comes_of_rows_that_were_removed(kind, tmp_path):
    history = History(kind, 3, 40, 8)
    history.edit_all(np.array([0, 5, 39, 7]), *history.some(2))
    t = history.t
    assert delone.check(t) and (kind is delone.FurthestSite or delone.check(t.to_data()))
    np.testing.assert_array_equal(t.to_data().points, t.points)
    assert (t.cell_of_point[~history.there] == -1).all() and (t.vertex_ids[~history.there] == -1).all()
    indptr, _ = t.vertex_neighbors
    assert (np.diff(indptr)[~history.there] == 0).all()
    diagrams = {delone.Regular: delone.PowerDiagram, delone.FurthestSite: delone.FurthestVoronoi}
    diagram, of_fresh = diagrams.get(kind, delone.Voronoi)(t), history.fresh()
    of_fresh = type(diagram)(of_fresh)
    old = np.flatnonzero(history.there)
    assert (diagram.point_region[~history.there] == -1).all() and len(diagram.point_region) == t.num_rows
    np.testing.assert_array_equal(diagram.point_region[old], of_fresh.point_region)
    assert sorted(map(tuple, diagram.ridge_points)) == sorted(map(tuple, old[of_fresh.ridge_points]))
    with pytest.raises(delone.InputError):
        t.save(tmp_path / "t.npz")
    t.compact_ids()
    t.save(tmp_path / "t.npz")
    np.testing.assert_array_equal(delone.read(tmp_path / "t.npz").cells, t.cells)


def test_copies_of_a_derived_class_are_of_that_class():
    class Mine(delone.Delaunay):
        pass

    t = Mine([[0, 0], [1, 0], [0, 1], [1, 1]])
    t.remove(0)
    for other in (copy.copy(t), copy.deepcopy(t)):
        assert type(other) is Mine and other.hash == t.hash and not other.has_row(0)


def test_arrays_stay_and_what_depends_on_cells_says_so():
    points = np.random.default_rng(1).random((40, 2))
    t = delone.Delaunay(points)
    taken = {name: (getattr(t, name), np.array(getattr(t, name))) for name in ARRAYS}
    function, shape = delone.LinearInterpolator(t, points[:, 0]), t.alpha_complex(0.2)
    t.edit(remove=[1, 2], move=(0, [0.5, 0.5]), insert=[[2, 2]])
    for name, (view, content) in taken.items():
        np.testing.assert_array_equal(view, content)
        assert not view.flags.writeable
    with pytest.raises(RuntimeError, match="the triangulation has changed"):
        function([0.5, 0.5])
    with pytest.raises(RuntimeError):
        shape.triangulation
    values = np.append(points[:, 0], 2)
    values[0], values[[1, 2]] = 0.5, np.nan  # what belongs to rows that were removed does not matter
    for kind in (delone.LinearInterpolator, delone.NaturalNeighborInterpolator):
        queries = points[3:][(points[3:] > 0.2).all(1) & (points[3:] < 0.8).all(1)] + 0.01
        np.testing.assert_allclose(kind(t, values)(queries), queries[:, 0], rtol=1e-9)
    smooth = delone.NaturalNeighborInterpolator(t, values, smooth=True)
    np.testing.assert_array_equal(np.isnan(smooth.site_gradients).all(1), ~t.has_row(np.arange(41)))
    with pytest.raises(ValueError, match="rows were removed"):
        delone.interpolate.LinearNDInterpolator(t, values)


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_refused_changes_nothing(kind):
    history = History(kind, 3, 30, 2)
    t = history.t
    t.record_undo()
    t.record_changes()
    history.remove(np.array([4, 9]))
    before, made = arrays(t), t.changes
    point = [0.0, 1.0, 2.0]
    refused = [
        (delone.InputError, "^remove: row 30 is not a row", lambda: t.remove(30)),
        (delone.InputError, r"^remove\[1\]: row -1 is not a row", lambda: t.remove([0, -1])),
        (delone.InputError, "^remove: row 18446744073709551615 is not a row", lambda: t.remove(np.array([2**64 - 1], np.uint64))),
        (delone.InputError, r"^remove\[1\]: row 9 was removed", lambda: t.remove([3, 9])),
        (delone.InputError, r"^remove\[2\]: row 3 is given twice, see remove\[0\]", lambda: t.remove([3, 5, 3])),
        (delone.InputError, "^move: row 4 was removed", lambda: t.move(4, point)),
        (delone.InputError, "^move: row 2 is removed, see remove", lambda: t.edit(remove=2, move=(2, point))),
        (delone.InputError, "^points: row 1, column 2: nan is not finite", lambda: t.move([1, 2], [point, [0, 0, np.nan]])),
        (delone.InputError, "^move: points: row 0, column 2: nan is not finite", lambda: t.edit(move=([1], [[0, 0, np.nan]]))),
        (delone.InputError, "^insert: row 0, column 0: inf is not finite", lambda: t.edit(insert=[[np.inf, 0, 0]], remove=1)),
        (ValueError, r"\(3,\), not \(2,\)", lambda: t.move(1, [0, 1])), (ValueError, r"\(2, 3\), not \(1, 3\)", lambda: t.move([1, 2], [point])),
        (ValueError, r"\(m,\), not \(1, 1\)", lambda: t.remove([[1]])), (TypeError, "rows: integers, or a mask, not float64", lambda: t.remove([1.0])),
        (ValueError, r"rows: a mask of shape \(30,\), not \(29,\)", lambda: t.remove(np.ones(29, bool))), (TypeError, "not bool", lambda: t.remove(True)),
        (delone.InputError, r"^remove\[4\]: row 4 was removed", lambda: t.remove(np.arange(30) < 5)),
        (TypeError, "rows: integers, or a mask, not object", lambda: t.remove(None)),
        (TypeError, "rows: an array, not a str", lambda: t.remove("all")), (TypeError, "a pair", lambda: t.edit(move=[1, 2, 3])),
        (TypeError, "progress", lambda: t.remove(1, progress=3)), (delone.InputError, r"^has_row\[1\]: row 31 is not a row", lambda: t.has_row([1, 31])),
    ]
    if kind is delone.Regular:
        refused += [
            (delone.InputError, "^set_weights: the weight for row 1 is not finite", lambda: t.set_weights(1, np.nan)),
            (ValueError, r"\(2,\), not \(\)", lambda: t.set_weights([1, 2], 1.0)),
            (ValueError, "weights: a number", lambda: t.set_weights(1, [1.0])), (ValueError, "insert_weights", lambda: t.edit(insert=[point])),
            (ValueError, "insert_weights", lambda: t.edit(insert_weights=[1.0])),
            (delone.InputError, "^set_weights: row 9 was removed", lambda: t.set_weights([9], [1.0])),
            (delone.InputError, r"^insert\[1\]: the weight is not finite", lambda: t.edit(insert=[point, point], insert_weights=[0.0, np.inf])),
        ]
    for error, match, call in refused:
        with pytest.raises(error, match=match):
            call()
    assert_same(arrays(t), before)
    assert t.can_undo and made.removed_cells.tolist() == t.changes.removed_cells.tolist()
    with pytest.raises(delone.InputError) as raised:
        t.remove([0, 1, 9])
    assert raised.value.rows == [2]  # in the argument
    t.undo()
    history.there[:] = True
    history.check()


@pytest.mark.parametrize("kind", KINDS)
def test_masks_are_rows(kind):
    random = np.random.default_rng(1)
    points, weights = random.random((40, 3)), random.random(40) * 0.01
    a, b = make(kind, points, weights), make(kind, points, weights)
    masks = [random.random(40) < 0.2 for _ in range(3)]
    masks[1] &= ~masks[0]
    rows = [np.flatnonzero(mask) for mask in masks]
    to = random.random((len(rows[1]), 3))
    a.remove(masks[0]), b.remove(rows[0])
    a.move(masks[1].tolist(), to), b.move(rows[1], to)
    assert_same(arrays(a), arrays(b))
    a.insert_range(points[masks[0]], *([weights[masks[0]]] if kind is delone.Regular else []))
    assert a.has_row(np.append(masks[2], np.zeros(len(rows[0]), bool))).tolist() == b.has_row(rows[2]).tolist()
    c, d = make(kind, points, weights), make(kind, points, weights)
    c.edit(remove=masks[0], move=(masks[1], to)), d.edit(remove=rows[0], move=(rows[1], to))
    if kind is delone.Regular:
        c.set_weights(masks[1], weights[masks[1]] + 0.1), d.set_weights(rows[1], weights[rows[1]] + 0.1)
    assert_same(arrays(c), arrays(d))
    e = make(kind, points, weights)
    e.remove(np.zeros(40, bool))
    assert e.num_points == 40
    e.remove(np.ones(40, bool))
    assert e.num_points == 0


def test_one_point_is_inserted_as_one_row():
    points = np.random.default_rng(2).random((20, 3))
    for kind in KINDS:
        a, b = make(kind, points, np.zeros(20)), make(kind, points, np.zeros(20))
        weight = ([0.5], [[0.5]]) if kind is delone.Regular else ([], [])
        a.insert_range([2.0, 2.0, 2.0], *weight[0]), b.insert_range([[2.0, 2.0, 2.0]], *weight[1])
        assert_same(arrays(a), arrays(b))
        if kind is not delone.Regular:
            a.edit(insert=[3.0, 2.0, 2.0]), b.edit(insert=[[3.0, 2.0, 2.0]])
            assert_same(arrays(a), arrays(b))
        for wrong in ([1.0, 2.0], [1.0, 2.0, 3.0, 4.0], 3.0):
            with pytest.raises(ValueError, match="^points: an array of shape"):
                a.insert_range(wrong, *weight[0])
        with pytest.raises(delone.InputError, match="^points: row 0, column 1: nan"):
            a.insert_range([0, np.nan, 0], *weight[0])
    hull = delone.ConvexHull(points)
    hull.insert_range([2, 2, 2])
    assert hull.hash == delone.ConvexHull([*points, [2, 2, 2]]).hash
    halfspaces = delone.HalfspaceIntersection([[1, 0, -1], [-1, 0, 0], [0, 1, -1], [0, -1, 0]])
    halfspaces.insert_range([1, 1, -1.5])
    assert halfspaces.num_halfspaces == 5 and halfspaces.volume == 0.875


def test_undo_without_a_record_names_it():
    t = delone.Delaunay([[0, 0], [1, 0], [0, 1]])
    t.remove(0)
    with pytest.raises(delone.InputError, match="nothing to undo; only edits after record_undo"):
        t.undo()


def test_edits_of_nothing():
    t = delone.Delaunay(np.random.default_rng(0).random((20, 2)))
    t.record_undo()
    t.remove(3)
    for nothing in (lambda: t.remove([]), lambda: t.move([], np.zeros((0, 2))), lambda: t.edit(), lambda: t.insert_range(np.zeros((0, 2)))):
        nothing()
    assert t.can_undo
    t.undo()
    assert t.has_row(3)


class Alarm(Exception):
    pass


def long_edits(kind):
    """A triangulation, and edits of it that take long: one vertex after the other, and by cells that are built anew."""
    random, n = np.random.default_rng(6), 200 if kind is delone.FurthestSite else 1200
    points, more = random.standard_normal((n, 6)), random.standard_normal((100_000, 6))
    if kind is delone.FurthestSite:  # none is inside
        points /= np.linalg.norm(points, axis=1, keepdims=True)
        more /= np.linalg.norm(more, axis=1, keepdims=True)
    t = make(kind, points, np.zeros(n))
    weights = {"insert_weights": np.zeros(100_000)} if kind is delone.Regular else {}
    gone, moved = np.split(np.arange(n // 8), [n // 16])
    anew = {"remove": [0, 1], "insert": more, **weights}
    if kind is delone.FurthestSite:  # so few cells take no time one by one
        return t, [anew, anew]
    return t, [{"remove": gone, "move": (moved, more[moved])}, anew]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("which", [0, 1])
def test_an_edit_that_is_stopped_changes_nothing(kind, which):
    t, edits = long_edits(kind)
    t.record_changes()
    t.record_undo()
    t.move(100, t.points[100] * 1.0001)
    before, made, told = arrays(t), repr(t.changes), []

    def stop(fraction):
        told.append(fraction)
        with pytest.raises(RuntimeError, match="the object is being changed"):
            t.changes
        return False

    def fail(fraction):
        raise Alarm

    with pytest.raises(delone.CancelledError):
        t.edit(**edits[which], progress=stop)
    with pytest.raises(Alarm):
        t.edit(**edits[which], progress=fail)
    assert len(told) == 1 and told[0] >= 0
    assert_same(arrays(t), before)
    assert repr(t.changes) == made


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="interval timers")
@pytest.mark.parametrize("which", [0, 1])
def test_a_signal_ends_an_edit(which):
    def ring(signum, frame):
        raise Alarm

    t, edits = long_edits(delone.Delaunay)
    before, handler = arrays(t), signal.signal(signal.SIGALRM, ring)
    try:
        with pytest.raises(Alarm):
            signal.setitimer(signal.ITIMER_REAL, 0.05)
            t.edit(**edits[which])
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, handler)
    assert_same(arrays(t), before)


def test_questions_and_copies_beside_edits_see_all_of_one_or_nothing():
    points = np.random.default_rng(2).random((300, 3))
    t = delone.Delaunay(points)
    t.remove(np.arange(150, 300))
    allowed = {t.hash, delone.Delaunay(points[50:150]).hash}
    seen, copied, done = set(), set(), threading.Event()

    def look(into, ask):
        while not done.is_set():
            into.add(ask())

    threads = [threading.Thread(target=look, args=arguments) for arguments in ((seen, lambda: t.hash), (copied, lambda: pickle.loads(pickle.dumps(t)).hash))]
    for thread in threads:
        thread.start()
    t.record_undo()
    end = time.monotonic() + 0.2
    try:
        while time.monotonic() < end:
            t.remove(np.arange(50))
            t.undo()
    finally:
        done.set()
        for thread in threads:
            thread.join()
    assert seen <= allowed and copied <= allowed and seen and copied


def test_frames():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(np.random.default_rng(0).random((10, 2)), columns=["x", "y"])
    t = delone.Delaunay(frame)
    t.remove(3)
    t.move([1], pandas.DataFrame([[0.5, 0.25]], columns=["x", "y"]))
    t.move(2, pandas.Series([0.25, 0.5], index=["x", "y"]))
    table = t.to_frame()
    assert table["vertex"].tolist() == [0, 1, 2, -1, *range(4, 10)] and table["x"].isna().tolist() == [i == 3 for i in range(10)]
    for wrong in (lambda: t.move([1], pandas.DataFrame([[0.5, 0.5]], columns=["y", "x"])), lambda: t.edit(insert=pandas.DataFrame({"x": [1.0], "z": [1.0]}))):
        with pytest.raises(ValueError, match="columns"):
            wrong()
    assert t.clone().columns == ("x", "y") == pickle.loads(pickle.dumps(t)).columns
