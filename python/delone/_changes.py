# SPDX-License-Identifier: BSD-3-Clause
"""What a change of a triangulation has done."""
from __future__ import annotations

import numpy as np


class Changes:
    """Ids of the cells and vertices that the last change of a triangulation affected.

    All are increasing int32 arrays. See `Delaunay.changes`.

    Parameters
    ----------
    removed_cells : ndarray of int
        Cells that the change removed, by their `cell_ids` before the change.
    created_cells : ndarray of int
        Created cells, by their `cell_ids` after it. A created cell may have the id of a removed one. A cell in neither array
        has the same id and vertices as before, but its vertices may have moved, and its neighbors may be new.
    added_vertices : ndarray of int
        Added vertices, hidden or not, by their `vertex_ids`.
    removed_vertices : ndarray of int
        Removed vertices, without any row left. Their ids are not reused.
    hidden_vertices : ndarray of int
        Vertices that became hidden: they have rows, but no cells any more.
    reappeared_vertices : ndarray of int
        Vertices that were hidden and have cells now.
    moved_vertices : ndarray of int
        Vertices with other coordinates or another weight.

    Examples
    --------
    >>> import delone
    >>> t = delone.Delaunay([[0, 0], [2, 0], [0, 2]])
    >>> t.record_changes()
    >>> t.insert_range([[0.5, 0.5]])
    >>> t.changes
    <delone.Changes: removed_cells=1, created_cells=3, added_vertices=1>
    """

    __slots__ = ("removed_cells", "created_cells", "added_vertices", "removed_vertices", "hidden_vertices", "reappeared_vertices",
                 "moved_vertices")

    def __init__(self, removed_cells: np.ndarray, created_cells: np.ndarray, added_vertices: np.ndarray, removed_vertices: np.ndarray,
                 hidden_vertices: np.ndarray, reappeared_vertices: np.ndarray, moved_vertices: np.ndarray):
        self.removed_cells, self.created_cells = removed_cells, created_cells
        self.added_vertices, self.removed_vertices = added_vertices, removed_vertices
        self.hidden_vertices, self.reappeared_vertices, self.moved_vertices = hidden_vertices, reappeared_vertices, moved_vertices

    def __repr__(self) -> str:
        counts = [(len(getattr(self, name)), name) for name in self.__slots__]
        return f"<delone.Changes: {', '.join(f'{name}={count}' for count, name in counts if count) or 'none'}>"
