# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C, and progress functions: long work ends within a second, and nothing has changed."""
import inspect
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import delone


def on_sphere(n, dimension):
    """Points of the unit sphere: none is inside, whatever has been added before."""
    points = np.random.default_rng(0).standard_normal((n, dimension))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


# Each would take minutes (millions of cells for each thousand points), the queries seconds.
LONG = {
    "Delaunay": "delone.Delaunay(random.random((300_000, 6)))",
    "Regular": "delone.Regular(random.random((300_000, 6)), np.zeros(300_000))",
    "ConvexHull": "delone.ConvexHull(on_sphere(100_000, 8))",
    "HalfspaceIntersection": "delone.HalfspaceIntersection(np.c_[on_sphere(100_000, 8), -np.ones(100_000)], [0] * 8)",
    "spatial": "delone.spatial.Delaunay(random.random((300_000, 6)))",
    "queries": "t.find_simplex(queries)",
}

PROGRAM = """
import signal, sys, time
import numpy as np
import delone, delone.spatial

{on_sphere}
random = np.random.default_rng(0)
{prepare}
signal.signal(signal.SIGPROF, signal.default_int_handler)
print("ready", flush=True)
begin = time.process_time()
signal.setitimer(signal.ITIMER_PROF, {after})
try:
    {long}
except KeyboardInterrupt:
    print("interrupted", time.process_time() - begin, flush=True)
"""


def program_of(name, after):
    """A process that has prepared its work, and is interrupted after some seconds of processor time (0: it is not)."""
    prepare = "t = delone.Delaunay(random.random((500, 5))); queries = np.tile(random.random((500_000, 5)), (12, 1))" if name == "queries" else ""
    code = PROGRAM.format(on_sphere=inspect.getsource(on_sphere), prepare=prepare, long=LONG[name], after=after)
    program = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert program.stdout.readline() == "ready\n"
    return program


@pytest.mark.skipif(not hasattr(signal, "ITIMER_PROF"), reason="timers as POSIX has them")
@pytest.mark.parametrize("name", LONG)
def test_a_signal_ends_long_work_within_a_second(name):
    """Of processor time, so that a busy machine makes no difference."""
    program = program_of(name, 0.5)
    try:
        word, seconds = program.stdout.readline().split()
        assert word == "interrupted" and float(seconds) < 1.5
        assert program.wait(20) == 0
    finally:
        program.kill()
        program.stdout.close()
        program.wait()


@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
def test_ctrl_c():
    program = program_of("Delaunay", 0)
    try:
        time.sleep(0.5)
        program.send_signal(signal.SIGINT)
        assert program.stdout.readline().startswith("interrupted")
        assert program.wait(20) == 0
    finally:
        program.kill()
        program.stdout.close()
        program.wait()


class Alarm(Exception):
    pass


@pytest.fixture
def alarm():
    """alarm(seconds): an exception then, from a signal handler."""
    if not hasattr(signal, "setitimer"):
        pytest.skip("no interval timers")

    def ring(signum, frame):
        raise Alarm

    before = signal.signal(signal.SIGALRM, ring)
    yield lambda seconds: signal.setitimer(signal.ITIMER_REAL, seconds)
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("make", [delone.Delaunay, delone.FurthestSite, delone.ConvexHull])
def test_after_an_interrupted_addition_everything_is_as_before(make, alarm):
    random = np.random.default_rng(1)
    first, many, more = random.standard_normal((150, 5)), random.standard_normal((200_000, 5)) * 3, random.standard_normal((10, 5))
    if make is not delone.Delaunay:
        many /= np.linalg.norm(many, axis=1, keepdims=True) / 10  # all of them extreme: others are done with at once
    made = make(first)
    cells, digest = made.cells.copy(), made.hash
    alarm(0.4)
    with pytest.raises(Alarm):
        made.insert_range(many)
    assert made.num_points == 150 and made.hash == digest and len(made.points) == 150
    if make is not delone.ConvexHull:
        np.testing.assert_array_equal(made.cells, cells)
    made.insert_range(more)
    assert made.hash == make(np.concatenate([first, more])).hash


def test_progress():
    fractions = []
    points = np.random.default_rng(2).random((30_000, 5))  # some twenty times what passes between two calls
    delone.Delaunay(points, progress=fractions.append)
    for truthy in (np.True_, 1, "yes", [0]):
        delone.Delaunay(points[:10_000], progress=lambda fraction: truthy)
    assert len(fractions) >= 2 and fractions == sorted(fractions) and 0 <= fractions[0] and fractions[-1] <= 1


@pytest.mark.parametrize("make", [
    lambda progress: delone.Delaunay(np.random.default_rng(3).random((100_000, 6)), progress=progress),
    lambda progress: delone.Regular(np.random.default_rng(3).random((100_000, 6)), np.zeros(100_000), progress=progress),
    lambda progress: delone.ConvexHull(on_sphere(50_000, 8), progress=progress),
    lambda progress: delone.HalfspaceIntersection(np.c_[on_sphere(20_000, 8), -np.ones(20_000)], [0] * 8, progress=progress),
])
def test_progress_can_stop_and_raise(make):
    with pytest.raises(delone.CancelledError):
        make(lambda fraction: False)

    for falsy in (np.False_, 0, 0.0, "", [], np.float64(0)):
        with pytest.raises(delone.CancelledError):
            make(lambda fraction: falsy)

    def fail(fraction):
        raise ZeroDivisionError("from the progress function")

    with pytest.raises(ZeroDivisionError, match="from the progress function"):
        make(fail)

    with pytest.raises(ValueError, match="ambiguous"):
        make(lambda fraction: np.array([True, False]))


def test_signals_are_for_the_main_thread():
    """A build in another thread goes on when the main thread is interrupted, and stops by its progress function."""
    stop, result = threading.Event(), []

    def build():
        try:
            delone.Delaunay(np.random.default_rng(4).random((100_000, 6)), progress=lambda fraction: not stop.is_set())
        except delone.Error as error:
            result.append(type(error))

    thread = threading.Thread(target=build)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
        time.sleep(1)
    assert thread.is_alive()
    stop.set()
    thread.join(10)
    assert result == [delone.CancelledError]
