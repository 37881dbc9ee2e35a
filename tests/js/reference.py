#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Inputs and what the native library makes of them: all members of all objects, by the C interface, for cases.mjs to compare with.

Usage: reference.py LIBRARY OUTPUT.json      LIBRARY: libdelone_c.so
"""
import base64
import ctypes
import hashlib
import itertools
import json
import sys

import numpy as np

ARRAY, INTEGER, REAL, TEXT = 1, 2, 3, 4
TYPES = {1: np.float64, 2: np.int32, 3: np.int64, 4: np.uint8}


class Array(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("type", ctypes.c_int32), ("rank", ctypes.c_int32), ("shape", ctypes.c_size_t * 2)]


class Native:
    """Objects of the library as dictionaries of their members; arrays by their digests."""

    def __init__(self, path):
        self.library = ctypes.CDLL(path)
        for name in ("delone_kind", "delone_member", "delone_error_message"):
            getattr(self.library, name).restype = ctypes.c_char_p

    def call(self, name, *arguments):
        status = getattr(self.library, name)(*arguments)
        if status != 0:
            raise RuntimeError(f"{name}: {self.library.delone_error_message().decode()}")

    def make(self, name, *arguments):
        made = ctypes.c_void_p()
        self.call(name, *arguments, ctypes.byref(made))
        return made

    def members(self, made):
        found, kind = {}, ctypes.c_int()
        for i in itertools.count():
            name = self.library.delone_member(made, ctypes.c_size_t(i), ctypes.byref(kind))
            if name is None:
                return found
            key = name.decode()
            if kind.value == ARRAY:
                array = Array()
                self.call("delone_get_array", made, name, ctypes.byref(array))
                rows, columns = array.shape[0], array.shape[1]
                dtype = np.dtype(TYPES[array.type])
                data = ctypes.string_at(array.data, rows * columns * dtype.itemsize) if rows * columns else b""
                found[key] = digest(np.frombuffer(data, dtype))
            else:
                value = {INTEGER: ctypes.c_int64, REAL: ctypes.c_double, TEXT: ctypes.c_char_p}[kind.value]()
                self.call(f"delone_get_{ {INTEGER: 'integer', REAL: 'real', TEXT: 'text'}[kind.value] }", made, name, ctypes.byref(value))
                found[key] = value.value.decode() if kind.value == TEXT else str(value.value) if kind.value == INTEGER else digest(np.array([value.value]))


def digest(array):
    """Of the numbers: integers as 64 bits, and each NaN as the same one."""
    numbers = array.astype(np.float64) if array.dtype != np.float64 else np.where(np.isnan(array), np.nan, array)
    return hashlib.sha256(numbers.astype("<f8").tobytes()).hexdigest()


def pointer(array):
    return array.ctypes.data_as(ctypes.c_void_p)


def grid(side, d):
    return np.array(list(itertools.product(range(side), repeat=d)), float)


def point_sets():
    """Rows for all products, degenerate ones of every sort among them."""
    random = np.random.default_rng(58)
    for d, n in [(1, 50), (2, 2000), (3, 800), (4, 250), (5, 100), (6, 60), (7, 40), (8, 30), (9, 16)]:
        yield f"uniform {d}", random.random((n, d))
        yield f"flat in {d}", np.hstack([random.integers(-4, 5, (n // 4, max(d - 1, 1))), np.full((n // 4, d - max(d - 1, 1)), 3.0)])
    for d, side in [(2, 14), (3, 6), (4, 4), (5, 3), (6, 2), (7, 2), (8, 2)]:
        yield f"lattice {d}", grid(side, d)
    a = np.arange(-325, 326)
    circle = np.array([(x, y) for x in a for y in a if x * x + y * y == 325 * 325], float)
    yield "cocircular", circle
    yield "cospherical", np.array([p for p in grid(31, 3) - 15 if p @ p == 225])
    nudged = circle.copy()
    nudged[::2, 0] = np.nextafter(nudged[::2, 0], 1e9)
    yield "nudged circle", nudged
    t = np.arange(60.0)
    yield "collinear", np.column_stack([t, 3 * t + 1])
    yield "collinear in space", np.column_stack([0.1 * t, 0.3 * t, 0.7 * t])
    yield "nearly collinear", np.column_stack([t / 7, t / 3])
    yield "coplanar", np.column_stack([random.integers(0, 9, (80, 2)), np.zeros(80)])
    yield "duplicates", np.repeat(random.integers(0, 5, (40, 3)), 3, axis=0).astype(float)
    for d in (2, 3):
        yield f"huge {d}", random.standard_normal((200, d)) * 1e300
        yield f"tiny {d}", random.standard_normal((200, d)) * 1e-300
        yield f"denormal {d}", random.integers(-50, 50, (200, d)) * 5e-324
        yield f"of all sizes {d}", random.standard_normal((150, d)) * 10.0 ** random.integers(-300, 300, (150, 1))
    yield "one point", np.ones((1, 3))
    yield "no point", np.ones((0, 3))


def halfspaces():
    random = np.random.default_rng(59)
    for d, n in [(2, 60), (3, 80), (4, 40), (5, 20)]:
        normals = random.standard_normal((n, d))
        yield f"halfspaces {d}", np.hstack([normals, -np.linalg.norm(normals, axis=1)[:, None]])
    cube = np.vstack([np.eye(3), -np.eye(3)])
    yield "cube", np.hstack([cube, -np.ones((6, 1))])
    yield "corners of a cube", np.hstack([np.vstack([cube, grid(2, 3) * 2 - 1]), -np.r_[np.ones(6), 3 * np.ones(8)][:, None]])
    yield "empty", np.hstack([cube, np.ones((6, 1))])
    yield "flat", np.array([[1, 0, 0, 0], [-1, 0, 0, 0], [0, 1, 0, -1.0]])


def text(array):
    return base64.b64encode(np.ascontiguousarray(array, "<f8").tobytes()).decode()


def main(library, output):
    native, cases = Native(library), []

    def add(name, product, rows, d, made, **more):
        cases.append({"name": name, "product": product, "rows": text(rows), "dimension": d, **more, "members": native.members(made)})

    size = ctypes.c_size_t
    for name, points in point_sets():
        points = np.ascontiguousarray(points, np.float64)
        n, d = points.shape
        given = (pointer(points), size(n), d, None)
        delaunay = native.make("delone_delaunay", *given)
        add(name, "Delaunay", points, d, delaunay)
        add(name, "ConvexHull", points, d, native.make("delone_convex_hull", *given))
        if d <= 3:
            add(name, "FurthestSite", points, d, native.make("delone_furthest_site", *given))
        weights = np.arange(n) % 7 / 8.0
        regular = native.make("delone_regular", pointer(points), pointer(weights), size(n), d, None)
        add(name, "Regular", points, d, regular, weights=text(weights))
        if d > 1:
            add(name, "LowerHull", points, d, native.make("delone_lower_hull", *given))
        if d <= 5:
            add(name, "Voronoi", points, d, native.make("delone_voronoi", delaunay, None))
            add(name, "PowerDiagram", points, d, native.make("delone_voronoi", regular, None), weights=text(weights))
        if d <= 4 and "of all sizes" not in name:
            radius = float(np.ptp(points)) / 8 if n else 1.0
            add(name, "AlphaComplex", points, d, native.make("delone_alpha_complex", delaunay, ctypes.c_double(radius), None), radius=radius)
    for name, rows in halfspaces():
        rows = np.ascontiguousarray(rows, np.float64)
        m, d = rows.shape[0], rows.shape[1] - 1
        add(name, "HalfspaceIntersection", rows, d, native.make("delone_halfspace_intersection", pointer(rows), size(m), d, None, None))
    with open(output, "w", encoding="utf-8") as file:
        json.dump(cases, file)
    print(f"{output}: {len(cases)} objects, {sum(len(case['members']) for case in cases)} members")


if __name__ == "__main__":
    main(*sys.argv[1:])
