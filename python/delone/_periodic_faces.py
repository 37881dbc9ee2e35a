# SPDX-License-Identifier: BSD-3-Clause
"""Faces of periodic triangulations."""
from __future__ import annotations

import numpy as np


class PeriodicFaces:
    """Faces of one dimension of a periodic triangulation, one of each class of translates, as read-only arrays.

    Made by `PeriodicDelaunay.faces` and `PeriodicRegular.faces`.

    Parameters
    ----------
    vertices : (n, j+1) ndarray of int
        The rows of the vertices; those of cells as in `PeriodicDelaunay.cells`, others increasing.
    offsets : (n, j+1, r) ndarray of int32
        Their translations: vertex i of face f is ``points[vertices[f, i]] + offsets[f, i] @ lattice``. 0 for the lexicographically smallest
        vertex of a face.
    on_hull : (n,) ndarray of bool
        Whether each face is outside, where the set is not periodic in all directions.

    Examples
    --------
    >>> import delone
    >>> edges = delone.PeriodicDelaunay([[0.0, 0.0]], 1.0).faces(1)
    >>> edges.vertices.tolist(), edges.offsets.tolist()
    ([[0, 0], [0, 0], [0, 0]], [[[0, 0], [0, 1]], [[0, 0], [1, -1]], [[0, 0], [1, 0]]])
    """

    __slots__ = ("offsets", "on_hull", "vertices")

    def __init__(self, vertices: np.ndarray, offsets: np.ndarray, on_hull: np.ndarray):
        self.vertices, self.offsets, self.on_hull = vertices, offsets, on_hull

    def __len__(self) -> int:
        return len(self.vertices)

    def __repr__(self) -> str:
        return f"<delone.PeriodicFaces: {len(self)} of dimension {self.vertices.shape[1] - 1}>"


def periodic_faces(self, dimension: int) -> PeriodicFaces:
    """The faces of one dimension, one of each class of translates.

    Parameters
    ----------
    dimension : int
        The dimension, 0 to d: 0 for the vertices, 1 for the edges.

    Returns
    -------
    PeriodicFaces
        The faces, increasing by rows and offsets; cells in the order of `cells`.

    Raises
    ------
    ValueError
        If the dimension is out of range.

    Notes
    -----
    Cost: that of finding the faces of all dimensions from this one on, of the points in the box and their images.

    Examples
    --------
    >>> import delone
    >>> t = delone.PeriodicDelaunay([[0.0, 0.0, 0.0]], 1.0)
    >>> [len(t.faces(j)) for j in range(4)]
    [1, 7, 12, 6]
    """
    return PeriodicFaces(*self._faces(dimension))
