# SPDX-License-Identifier: BSD-3-Clause
"""What a change of a triangulation has done."""
from __future__ import annotations

import numpy as np


class Changes:
    """Ids of the cells and vertices that the last change of a triangulation affected.

    All are increasing int32 arrays. See `Delaunay.changes`.

    Parameters
    ----------
    killed : ndarray of int
        Destroyed cells, by their `cell_ids` before the change.
    born : ndarray of int
        Created cells, by their `cell_ids` after it. A created cell may have the id of a destroyed one. A cell in neither array
        has the same id and vertices as before, but its vertices may have moved, and its neighbors may be new.
    came : ndarray of int
        Added vertices, hidden or not, by their `vertex_ids`.
    gone : ndarray of int
        Removed vertices, without any row left. Their ids are not reused.
    hid : ndarray of int
        Vertices that became hidden: they have rows, but no cells any more.
    reappeared : ndarray of int
        Vertices that were hidden and have cells now.
    moved : ndarray of int
        Vertices with other coordinates or another weight.

    Examples
    --------
    >>> import delone
    >>> t = delone.Delaunay([[0, 0], [2, 0], [0, 2]])
    >>> t.record_changes()
    >>> t.insert_range([[0.5, 0.5]])
    >>> t.changes
    <delone.Changes: 1 killed, 3 born, 1 came>
    """

    __slots__ = ("killed", "born", "came", "gone", "hid", "reappeared", "moved")

    def __init__(self, killed: np.ndarray, born: np.ndarray, came: np.ndarray, gone: np.ndarray, hid: np.ndarray, reappeared: np.ndarray,
                 moved: np.ndarray):
        self.killed, self.born, self.came, self.gone, self.hid, self.reappeared, self.moved = killed, born, came, gone, hid, reappeared, moved

    def __repr__(self) -> str:
        counts = [(len(getattr(self, name)), name) for name in self.__slots__]
        return f"<delone.Changes: {', '.join(f'{count} {name}' for count, name in counts if count) or 'none'}>"
