# SPDX-License-Identifier: BSD-3-Clause
"""Many threads: queries at once, queries beside insertions, and no thread keeps the interpreter to itself."""
import copy
import pickle
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import delone
from hostile_support import members, run


def run_together(actions):
    """Starts all actions at the same time; returns their results, or raises what one of them raised."""
    barrier = threading.Barrier(len(actions))

    def wait_and(action):
        barrier.wait()
        return action()

    with ThreadPoolExecutor(len(actions)) as pool:
        return [future.result(timeout=60) for future in [pool.submit(wait_and, action) for action in actions]]


def test_queries_at_once():
    random = np.random.default_rng(0)
    points, queries = random.random((3000, 3)), random.random((4000, 3)) * 1.1
    values = points.sum(axis=1)
    reference = delone.Delaunay(points)
    expected = reference.find_simplex(queries), reference.nearest(queries)[0], reference.cells.copy(), reference.vertex_neighbors[1].copy()
    function = delone.LinearInterpolator(reference, values)
    interpolated = function(queries)
    for _ in range(3):
        t = delone.Delaunay(points)  # new: what is made on first use is made by several threads at once
        results = run_together([lambda: t.find_simplex(queries), lambda: t.nearest(queries)[0], lambda: t.cells, lambda: t.vertex_neighbors[1],
                                lambda: t.find_simplex(queries[:100]), lambda: function(queries), lambda: t.hash])
        for result, wanted in zip(results, expected):
            np.testing.assert_array_equal(result, wanted)
        np.testing.assert_array_equal(results[5], interpolated)
        assert results[6] == reference.hash


def test_hulls_and_diagrams_at_once():
    points = np.random.default_rng(1).standard_normal((2000, 3))
    hull = delone.ConvexHull(points)
    results = run_together([lambda: hull.contains(points * 1.01), lambda: hull.volume, lambda: hull.facets[1], lambda: delone.Voronoi(points).vertices] * 2)
    for a, b in zip(results[:4], results[4:]):
        np.testing.assert_array_equal(a, b)
    intersection = delone.HalfspaceIntersection(np.c_[points[:200], -np.ones(200)])
    results = run_together([lambda: intersection.vertices, lambda: intersection.volume] * 2)
    np.testing.assert_array_equal(results[0], results[2])


@pytest.mark.parametrize("make", [delone.Delaunay, delone.ConvexHull])
def test_queries_beside_insertions_see_all_of_them_or_none(make):
    points = np.random.default_rng(2).random((1200, 3))
    sizes = [200 + 100 * i for i in range(11)]
    expected = {make(points[:n]).hash for n in sizes}
    made = make(points[:200])
    seen = []

    def ask():
        while made.num_points < 1200:
            seen.append(made.hash)
            cells = made.cells
            assert cells.min() >= 0
            made.locate(points[:20])

    def add():
        for n in sizes[1:]:
            made.insert_range(points[n - 100:n])

    run_together([ask, ask, add])
    assert set(seen) <= expected and made.hash == make(points).hash


def test_two_threads_may_insert():
    points = np.random.default_rng(3).random((1000, 2))
    t = delone.Delaunay(points[:100])
    run_together([lambda i=i: t.insert_range(points[i:i + 100]) for i in range(100, 1000, 100)])
    assert t.num_points == 1000 and t.hash == delone.Delaunay(points).hash


def test_questions_without_end_do_not_hold_up_insertions():
    points = np.random.default_rng(5).random((4000, 3))
    t = delone.Delaunay(points[:3000])
    done, late = threading.Event(), time.monotonic() + 30

    def ask():
        while not done.is_set() and time.monotonic() < late:
            t.alpha_values(1)

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for i in range(3000, 4000, 250):
        t.insert_range(points[i:i + 250])
    done.set()
    assert time.monotonic() < late
    for thread in threads:
        thread.join()


def test_other_threads_run_during_construction():
    points = np.random.default_rng(4).random((2000, 5))
    ticks = []
    done = threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    ticker = threading.Thread(target=tick)
    ticker.start()
    begin = time.perf_counter()
    delone.Delaunay(points)
    end = time.perf_counter()
    done.set()
    ticker.join()
    during = [t for t in ticks if begin < t < end]
    assert len(during) >= 10 * (end - begin), f"{len(during)} ticks in {end - begin:.2f} s"


def test_a_progress_function_that_asks_its_object_is_told_off():
    made = delone.Delaunay([[0.0] * 5])
    errors = []

    def progress(fraction):
        try:
            made.find_simplex([0.5] * 5)
        except RuntimeError as error:
            errors.append(str(error))
        return not errors

    with pytest.raises(delone.CancelledError):
        made.insert_range(np.random.default_rng(5).random((20_000, 5)), progress=progress)
    assert errors == ["the object is being changed"] and made.num_points == 1


def on_sphere(n):
    points = np.random.default_rng(6).standard_normal((n, 7))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


@pytest.mark.parametrize("make, rows", [
    (delone.Delaunay, lambda: np.random.default_rng(5).random((20_000, 5))), (delone.FurthestSite, lambda: on_sphere(900)),
    (delone.ConvexHull, lambda: on_sphere(900)), (lambda h: delone.HalfspaceIntersection(h, [0] * 6), lambda: np.c_[on_sphere(3000)[:, :6], -np.ones(3000)]),
    (lambda p: delone.Regular(p, np.zeros(len(p))), lambda: np.random.default_rng(5).random((20_000, 5))),
])
def test_any_use_in_a_progress_function_is_told_off_or_answered(make, rows):
    rows = rows()
    made, answers = make(rows[:20]), {}
    uses = {name: lambda name=name: getattr(made, name) for name in members(type(made))}
    uses |= {f.__name__: lambda f=f: f(made) for f in (copy.copy, copy.deepcopy, pickle.dumps, repr, len, delone.Voronoi, delone.PowerDiagram)}
    uses |= {f.__name__: lambda f=f: f(made, np.zeros(20)) for f in (delone.LinearInterpolator, delone.NaturalNeighborInterpolator)}
    uses |= {f"{name}()": lambda name=name: getattr(made, name)(rows[:3]) for name in ("find_simplex", "insert_range", "locate", "nearest")
             if hasattr(made, name)}

    def progress(fraction):
        for name, use in uses.items():
            try:
                use()
            except Exception as error:
                answers[name] = error
        return False

    arguments = (rows, np.zeros(len(rows))) if isinstance(made, delone.Regular) else (rows,)
    with pytest.raises(delone.CancelledError):
        made.insert_range(*arguments, progress=progress)
    for name, error in answers.items():
        assert isinstance(error, (TypeError, ValueError)) or (type(error) is RuntimeError and str(error) == "the object is being changed"), (name, error)
    assert sum(isinstance(error, RuntimeError) for error in answers.values()) > 10 and "copy" in answers and "dumps" in answers
    assert len(copy.copy(made)) == len(made)


@pytest.mark.parametrize("kind", ["Delaunay", "FurthestSite", "Regular", "ConvexHull"])
def test_copies_beside_insertions(kind):
    """In a process of its own: where one thread waits for the other, and the other for the interpreter, it never ends."""
    output = run('''
import copy, pickle, sys, threading, time
import numpy as np
import delone

kind = getattr(delone, sys.argv[1])
sys.setswitchinterval(1e-5)
random, more = np.random.default_rng(0), np.random.default_rng(1)

def arguments(random, n):
    return (random.standard_normal((n, 3)), *([np.zeros(n)] if kind is delone.Regular else []))

made = kind(*arguments(random, 100))
end = time.monotonic() + 0.7
counts = []

def repeat(action):
    count = 0
    while count < 3 or time.monotonic() < end:
        action()
        count += 1
    counts.append(count)

def take_copy():
    other = pickle.loads(pickle.dumps(made)) if random.random() < 0.5 else copy.copy(made)
    assert other.cells.max() < len(other.points) == other.num_points and len(other.cells) == len(other.neighbors)

def look():
    assert len(made.points) >= 100 and len(repr(made)) > 5 and len(made.hash) == 32

threads = [threading.Thread(target=repeat, args=(action,)) for action in (lambda: made.insert_range(*arguments(more, 5)), take_copy, look)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
assert len(counts) == 3, counts
print("done")
''', kind, seconds=60)
    assert output == "done\n"


def test_a_copy_during_a_long_insertion_waits_for_it():
    """While the thread that inserts can have the interpreter, which it needs for its progress function."""
    output = run('''
import pickle, threading, time
import numpy as np
import delone

made = delone.Delaunay(np.random.default_rng(0).random((20, 5)))
fractions = []
thread = threading.Thread(target=lambda: made.insert_range(np.random.default_rng(1).random((6_000, 5)), progress=fractions.append))
thread.start()
while not fractions:
    time.sleep(0.001)
print(pickle.loads(pickle.dumps(made)).num_points, len(fractions) > 1)
thread.join()
''', seconds=60)
    assert output.split() == ["6020", "True"]
