# SPDX-License-Identifier: BSD-3-Clause
"""Qhull's options: what they ask for, if it has a meaning here.

delone::parse_qhull_options knows them. Here are the defaults of SciPy, and what SciPy refuses.
"""
from __future__ import annotations

import functools
from typing import NamedTuple, Optional

from delone import _core

# scipy's: they would scale with points that are not there yet.
_NOT_INCREMENTAL = ("Qbb", "QbB", "Qz")


class Options(NamedTuple):
    """What the options of a constructor ask for."""

    scaled: bool = False  # Qbb: the last coordinate of the paraboloid is scaled to [0, largest |coordinate|]
    last_in_box: bool = False  # Qbb of hulls: tolerances count where the last column is scaled to that
    in_cube: bool = False  # QbB: tolerances count where all columns are scaled to [-0.5, 0.5]
    at_infinity: bool = False  # Qz: a point above the paraboloid takes part in that scaling
    keep_coplanar: bool = False  # Qc: rows that are no vertex are listed in `coplanar`
    furthest: bool = False  # Qu
    good_row: Optional[int] = None  # QGn, QG-n: the facets that row n sees, or does not see
    good_visible: bool = True
    joggled: bool = False  # QJ: flat input has results
    unmerged: bool = False  # Q0, QJ: the default tolerance is 0
    centrum: float = 0.0  # Cn, C-n: added to the round-off of a distance
    roundoff: Optional[float] = None  # En: takes the place of the round-off of a distance
    width: float = 0.0  # Wn: the least tolerance

    @property
    def sets_tolerance(self) -> bool:
        """Whether an option gives a distance."""
        return self.roundoff is not None or self.centrum > 0 or self.width > 0


def parse(text, *, kind: str, furthest_site: bool = False, incremental: bool = False) -> Options:
    """The meaning of a string of Qhull options; None stands for scipy's default of the kind.

    `kind` is "delaunay", "voronoi", "hull" or "halfspaces". Raises ValueError for an option without a meaning here, naming it.
    """
    return _parsed(text, kind, bool(furthest_site), bool(incremental))


@functools.lru_cache(maxsize=128)
def _parsed(text, kind: str, furthest_site: bool, incremental: bool) -> Options:
    if text is None:
        text = ("Qc" if incremental else "Qbb Qc Qz") if kind in ("delaunay", "voronoi") else ""
    if isinstance(text, bytes):
        text = text.decode("latin1")
    if incremental:
        for option in text.split():
            if option in _NOT_INCREMENTAL:
                raise ValueError(f"Qhull option {_core._represented(option)} is incompatible with incremental mode")
    options = Options(**_core._qhull_options(text.encode("utf-8", "surrogatepass"), kind))
    return options._replace(furthest=True, at_infinity=False) if furthest_site else options
