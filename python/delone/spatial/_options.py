# SPDX-License-Identifier: BSD-3-Clause
"""Qhull's options: what they ask for, if it has a meaning here.

Three kinds. Some ask for something that delone also does (Qc, Qu, QG, the scaling of the paraboloid by Qbb and Qz). Many
are about rounding errors, memory or the order of work; no result depends on them, so they change nothing. The rest would change the
result in a way that an exact computation has no equivalent for; they are refused by name.
"""
from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Optional

# Options without an effect, and why: the tests and docs/from-qhull.md go through this table.
NO_EFFECT = {
    "Qt": "all cells are simplices",
    "QJ": "nothing needs to be joggled: every point is a vertex, every cell a simplex (QJn as well)",
    "QbB": "exact signs need no scaling; coordinates and volumes are those of the points as given",
    "Qx": "nothing is merged, so nothing is merged late",
    "Qs": "the first simplex does not matter",
    "Qf": "the order of work does not matter",
    "Qm": "the order of work does not matter",
    "Qr": "the order of work does not matter",
    "Qv": "convexity is exact",
    "Qw": "there is nothing to be warned of",
    "Qa": "there is nothing to be warned of",
    "Pp": "there is nothing to be warned of",
    "Tv": "a result can be verified with delone.check",
}
NO_EFFECT_PATTERNS = [(re.compile(r"Q\d+"), "Q0 … Q15 steer merging and memory"), (re.compile(r"QJ[\d.eE+-]*"), NO_EFFECT["QJ"])]

# What an option would ask for that has no equivalent here.
REFUSED = [
    (re.compile(r"Q[bB][k\d].*"), "it scales or drops a coordinate: do so to the points"),
    (re.compile(r"QR-?\d*"), "it rotates the points: do so to the points"),
    (re.compile(r"QV-?\d*"), "facets are not selected by a vertex; see vertex_to_simplex"),
    (re.compile(r"Qi"), "of points inside a hull no list is kept"),
    (re.compile(r"Qu"), "only triangulations and diagrams have furthest sites"),
    (re.compile(r"QG.*"), "only hulls have facets that a point sees"),
    (re.compile(r"[ACVWEUR]-?[\d.].*"), "it is a tolerance, and an exact computation has none"),
    (re.compile(r"[FGT].*|P.*"), "it asks the program for a kind of output"),
]

_GOOD = re.compile(r"QG(-?)(\d+)")


@dataclass(frozen=True)
class Options:
    """What the options of a constructor ask for."""

    scaled: bool = False  # Qbb: the last coordinate of the paraboloid is scaled to [0, largest |coordinate|]
    at_infinity: bool = False  # Qz: a point above the paraboloid takes part in that scaling
    keep_coplanar: bool = False  # Qc: rows that are no vertex are listed in `coplanar`
    furthest: bool = False  # Qu
    good_row: Optional[int] = None  # QGn, QG-n: the facets that row n sees, or does not see
    good_visible: bool = True


def parse(text, *, kind: str, ndim: int = 0, furthest_site: bool = False, incremental: bool = False) -> Options:
    """The meaning of a string of Qhull options; None stands for scipy's default of the kind.

    `kind` is "delaunay", "voronoi", "hull" or "halfspaces". Raises ValueError for an option without a meaning here, naming it.
    """
    delaunay = kind in ("delaunay", "voronoi")
    if text is None:
        text = ("Qc" if incremental else "Qbb Qc Qz") if delaunay else ""
    if isinstance(text, bytes):
        text = text.decode("latin1")
    found = {"furthest": bool(furthest_site)}
    for option in text.split():
        good = _GOOD.fullmatch(option)
        if option == "Qbb":
            found["scaled"] = delaunay
        elif option == "Qz":
            found["at_infinity"] = delaunay
        elif option == "Qc":
            found["keep_coplanar"] = True
        elif option == "Qu" and delaunay:
            found["furthest"] = True
        elif good and kind == "hull":
            found["good_row"], found["good_visible"] = int(good[2]), not good[1]
        elif option not in NO_EFFECT and not any(pattern.fullmatch(option) for pattern, _ in NO_EFFECT_PATTERNS):
            raise ValueError(f"Qhull option {option!r}: {_refusal(option)}")
    if found["furthest"]:
        found["at_infinity"] = False
    return Options(**found)


def _refusal(option: str) -> str:
    for pattern, reason in REFUSED:
        if pattern.fullmatch(option):
            return reason
    return "not known, or without a meaning here"
