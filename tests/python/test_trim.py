# SPDX-License-Identifier: BSD-3-Clause
"""Triangulation.trim: grids that were turned are grids again."""
import numpy as np
import pytest

import delone


def turned_grid(side, degrees):
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side), indexing="ij"), -1).reshape(-1, 2).astype(float)
    a = np.deg2rad(degrees)
    return grid @ np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])


@pytest.mark.parametrize("degrees", [7.77, 31.5])
def test_slivers_go(degrees):
    points = turned_grid(20, degrees)
    t = delone.Delaunay(points)
    trimmed = t.trim(1e-12)
    assert trimmed.num_removed == len(t) - len(trimmed.cells) > 0 and len(trimmed.cells) == 2 * 19 * 19
    assert 0 < trimmed.depth <= 1e-12 and 0 < trimmed.lost_volume < 1e-11 and len(trimmed.orphans) == 0
    np.testing.assert_array_equal(trimmed.cells, t.cells[trimmed.kept])
    number = np.append(np.where(trimmed.kept, np.cumsum(trimmed.kept) - 1, -1), -1)
    np.testing.assert_array_equal(trimmed.neighbors, number[t.neighbors][trimmed.kept])
    p = points[trimmed.cells]
    areas = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]) / 2
    assert abs(areas.sum() - 19**2) < 1e-9 and areas.min() > 0.4
    assert not trimmed.cells.flags.writeable and not trimmed.kept.flags.writeable
    assert "removed" in repr(trimmed) and len(t) == len(t.cells)


def test_exact_grids_stay():
    t = delone.Delaunay(turned_grid(5, 0))
    trimmed = t.trim(1e-9)
    assert trimmed.num_removed == 0 and trimmed.depth == 0 and trimmed.kept.all()
    np.testing.assert_array_equal(trimmed.neighbors, t.neighbors)


def test_orphans():
    trimmed = delone.Delaunay([[0.0], [1.0], [3.0], [6.0]]).trim(3)
    assert trimmed.orphans.tolist() == [0, 1] and trimmed.num_removed == 2 and (trimmed.depth, trimmed.lost_volume) == (3, 3)
    assert trimmed.cells.tolist() == [[2, 3]] and trimmed.neighbors.tolist() == [[-1, -1]]
    trimmed = delone.Delaunay([[0, 0], [4, 0], [0, 4], [4, 4], [2, 0.01]]).trim(0.1)
    assert len(trimmed.orphans) == 0 and trimmed.num_removed == 1
    assert abs(trimmed.depth - 0.01) < 1e-12 and abs(trimmed.lost_volume - 0.02) < 1e-12


@pytest.mark.parametrize("tolerance", [-1.0, np.nan, np.inf, 1e3])
def test_bad_tolerances(tolerance):
    with pytest.raises(ValueError, match="the tolerance"):
        delone.Delaunay(turned_grid(4, 3)).trim(tolerance)
