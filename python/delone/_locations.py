# SPDX-License-Identifier: BSD-3-Clause
"""Answers to `locate`: arrays, and one query at a time."""
from __future__ import annotations

from typing import Iterator, Optional, Tuple

import numpy as np


class Locations:
    """Where queries lie; a sequence of (kind, cell, face).

    Entry i is the name of the kind, the cell, and the rows of the face as a tuple.

    Parameters
    ----------
    kind : (q,) ndarray of uint8
        The kind of each query, a number into `kinds`.
    cell : (q,) ndarray of int
        A cell that contains each query; -1 if there is none.
    face_offsets : (q+1,) ndarray of int64
        The offsets of the faces: that of query i is ``face_rows[face_offsets[i]:face_offsets[i+1]]``.
    face_rows : ndarray of int
        The input rows that span the smallest face that contains each query, increasing.
    kinds : tuple of str
        The names of the kinds.
    offset : (q, r) ndarray of int32, optional
        Of a periodic triangulation with r lattice vectors: the translation of each cell. None for others.
    face_lattice : (len(face_rows), r) ndarray of int32, optional
        Likewise the translations of the points of faces.

    Examples
    --------
    >>> import delone
    >>> t = delone.Delaunay([[0, 0], [2, 0], [0, 2]])
    >>> for place in t.locate([[0.5, 0.5], [1, 0], [3, 3]]):
    ...     print(place)
    ('in_cell', 0, (0, 1, 2))
    ('on_face', 0, (0, 1))
    ('outside_hull', -1, ())
    """

    __slots__ = ("cell", "face_lattice", "face_offsets", "face_rows", "kind", "kinds", "offset")

    def __init__(self, kind: np.ndarray, cell: np.ndarray, face_offsets: np.ndarray, face_rows: np.ndarray, kinds: Tuple[str, ...],
                 offset: Optional[np.ndarray] = None, face_lattice: Optional[np.ndarray] = None):
        self.kind, self.cell, self.face_offsets, self.face_rows, self.kinds = kind, cell, face_offsets, face_rows, kinds
        self.offset, self.face_lattice = offset, face_lattice

    def __len__(self) -> int:
        return len(self.kind)

    def __getitem__(self, i: int) -> Tuple[str, int, Tuple[int, ...]]:
        i = range(len(self))[i]
        rows = self.face_rows[self.face_offsets[i]:self.face_offsets[i + 1]]
        return self.kinds[self.kind[i]], int(self.cell[i]), tuple(rows.tolist())

    def __iter__(self) -> Iterator[Tuple[str, int, Tuple[int, ...]]]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        counts = np.bincount(self.kind, minlength=len(self.kinds))
        return f"<delone.Locations: {', '.join(f'{count} {name}' for name, count in zip(self.kinds, counts) if count) or 'none'}>"
