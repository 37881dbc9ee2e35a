# SPDX-License-Identifier: BSD-3-Clause
"""Answers to `locate`: arrays, and one query at a time."""
from __future__ import annotations

from typing import Iterator, Tuple

import numpy as np


class Locations:
    """Where queries lie.

    kind : (q,) uint8
        Numbers into `kinds`, the names.
    cell : (q,)
        A cell that contains the query; −1 if there is none.
    face_offsets : (q+1,) int64, face_rows : rows of the input
        The smallest face that contains query i is spanned by the rows ``face_rows[face_offsets[i]:face_offsets[i+1]]``, increasing.

    A sequence: entry i is (name of the kind, cell, tuple of rows).
    """

    __slots__ = ("cell", "face_offsets", "face_rows", "kind", "kinds")

    def __init__(self, kind: np.ndarray, cell: np.ndarray, face_offsets: np.ndarray, face_rows: np.ndarray, kinds: Tuple[str, ...]):
        self.kind, self.cell, self.face_offsets, self.face_rows, self.kinds = kind, cell, face_offsets, face_rows, kinds

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
