# SPDX-License-Identifier: BSD-3-Clause
"""Qhull's options: what they ask for, if it has a meaning here.

Three kinds. Some ask for something that delone also does (Qc, Qu, QG, the scaling of the paraboloid by Qbb and Qz, tolerances of hulls
and diagrams, and the boxes QbB and Qbb in which these count). Many are about rounding errors, memory, the order of work, or what the program prints; no result depends on them, so they
change nothing. The rest would change the result in a way that has no equivalent here; they are refused by name.
"""
from __future__ import annotations

import functools
import re
from typing import NamedTuple, Optional

from delone import _core

# Options without an effect, and why: the tests and docs/from-qhull.md go through these tables.
NO_EFFECT = {
    "Qt": "all cells are simplices",
    "Qx": "merging steers no result",
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
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
# Patterns are compiled when an option is looked for: most programs give none, and imports stay short.
NO_EFFECT_PATTERNS = [
    (r"Q\d+", "Q1 … Q15 steer merging and memory"),
    (r"[fimnops]|F[A-Za-z]|G[a-zA-Z]?|GD\d|Po|Pg|PG", "the arrays are the output"),
    (rf"T(?:-1|\d+|[acsz]|[FMPRW]{_NUMBER})", "nothing is traced"),
    (rf"[AUVR]-?{_NUMBER}", "signs are exact"),
]

# What an option would ask for that has no equivalent here.
REFUSED = [
    (r"Q[bB][k\d].*", "it scales or drops a coordinate: do so to the points"),
    (r"QR-?\d*", "it rotates the points: do so to the points"),
    (r"QV-?\d*", "facets are not selected by a vertex; see vertex_to_simplex"),
    (r"Qg", "facets that are not good are built as well; see the attribute good"),
    (r"Qi", "of points inside a hull no list is kept"),
    (r"Qu", "only triangulations and diagrams have furthest sites"),
    (r"QG-?", "the number of a row is missing"),
    (r"QG.*", "only hulls have facets that a point sees"),
    (r"T[ACV]-?\d+", "it stops before all points are in"),
    (r"T[IO].*", "it names a file; arguments and attributes are arrays"),
    (r"P[dD]\d.*|P[AFM]\d+.*", "it selects facets: do so with the arrays"),
    (r"[dv]|H.*", "it asks for another program: use the class of that name"),
]

_GOOD = r"QG(-?)(\d+)"
_JOGGLE = rf"QJ(?:{_NUMBER})?"
_TOLERANCE = rf"(C-|[CEW])({_NUMBER})"
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
    delaunay = kind in ("delaunay", "voronoi")
    if text is None:
        text = ("Qc" if incremental else "Qbb Qc Qz") if delaunay else ""
    if isinstance(text, bytes):
        text = text.decode("latin1")
    found = {"furthest": furthest_site}
    for option in text.split():
        if incremental and option in _NOT_INCREMENTAL:
            raise ValueError(f"Qhull option {_core._represented(option)} is incompatible with incremental mode")
        if option == "Qbb":
            found["scaled" if delaunay else "last_in_box"] = True
        elif option == "QbB":
            found["in_cube"] = True
        elif option == "Qz":
            found["at_infinity"] = delaunay
        elif option == "Qc":
            found["keep_coplanar"] = True
        elif option == "Qu" and delaunay:
            found["furthest"] = True
        elif option == "Q0":
            found["unmerged"] = True
        elif re.fullmatch(_JOGGLE, option):
            found["joggled"] = found["unmerged"] = True
        elif tolerance := re.fullmatch(_TOLERANCE, option):
            _set_tolerance(found, tolerance[1], float(tolerance[2]))
        elif kind == "hull" and (good := re.fullmatch(_GOOD, option)):
            found["good_row"], found["good_visible"] = int(good[2]), not good[1]
        elif option not in NO_EFFECT and not any(re.fullmatch(pattern, option) for pattern, _ in NO_EFFECT_PATTERNS):
            raise ValueError(f"Qhull option {_core._represented(option)}: {_refusal(option)}")
    if found["furthest"]:
        found["at_infinity"] = False
    return Options(**found)


def _set_tolerance(found: dict, option: str, value: float) -> None:
    if value < 0:
        raise ValueError(f"Qhull option '{option}{value:g}': a tolerance is not negative")
    if option == "E":
        found["roundoff"] = value
    elif option == "W":
        found["width"] = value
    else:
        found["centrum"] = max(found.get("centrum", 0.0), value)


def _refusal(option: str) -> str:
    for pattern, reason in REFUSED:
        if re.fullmatch(pattern, option):
            return reason
    return "not known, or without a meaning here"
