# SPDX-License-Identifier: BSD-3-Clause
"""What a change of a triangulation has done."""
from __future__ import annotations

import numpy as np


class Changes:
    """What the last change of a triangulation did: arrays of ids, each increasing.

    killed, born : ids of cells
        Cells that are no more, by the `cell_ids` of before, and new ones, by those of now. An id may be in both. A cell in neither has
        its id and its vertices still, but its neighbors may be new, and its vertices may have moved.
    came : ids of vertices
        New ones, hidden or not.
    gone : ids of vertices
        Those that have no row any more. Their ids are not used again.
    hid, reappeared : ids of vertices
        Those that had cells and have none, but still have rows; those that had rows but no cells, and have cells now.
    moved : ids of vertices
        Those with other coordinates or another weight.
    """

    __slots__ = ("killed", "born", "came", "gone", "hid", "reappeared", "moved")

    def __init__(self, killed: np.ndarray, born: np.ndarray, came: np.ndarray, gone: np.ndarray, hid: np.ndarray, reappeared: np.ndarray,
                 moved: np.ndarray):
        self.killed, self.born, self.came, self.gone, self.hid, self.reappeared, self.moved = killed, born, came, gone, hid, reappeared, moved

    def __repr__(self) -> str:
        counts = [(len(getattr(self, name)), name) for name in self.__slots__]
        return f"<delone.Changes: {', '.join(f'{count} {name}' for count, name in counts if count) or 'none'}>"
