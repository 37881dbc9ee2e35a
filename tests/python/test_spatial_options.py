# SPDX-License-Identifier: BSD-3-Clause
"""Qhull's options: each is honoured, without effect, or refused by name, as the table of docs/from-qhull.md says."""
import pathlib
import re

import numpy as np
import pytest

from delone import spatial
from delone.spatial import _options

POINTS = np.random.default_rng(3).random((30, 3))
GUIDE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "from-qhull.md"


@pytest.mark.parametrize("option", [*_options.NO_EFFECT, "Q0", "Q3", "Q12", "QJ1e-9"])
@pytest.mark.parametrize("cls", ["Delaunay", "ConvexHull", "Voronoi"])
def test_options_about_rounding_change_nothing(cls, option):
    plain, other = getattr(spatial, cls)(POINTS), getattr(spatial, cls)(POINTS, qhull_options=option)
    if cls == "Voronoi":
        np.testing.assert_array_equal(plain.vertices, other.vertices)
    else:
        np.testing.assert_array_equal(plain.simplices, other.simplices)


@pytest.mark.parametrize("option", ["Qb0:0", "QB1:1", "Qbk:0Bk:0", "QR7", "QR-3", "QV2", "Qi", "W1e-3", "C-0", "A-0.99", "V0.1", "U1e-4", "E1e-9",
                                    "R1e-3", "Fv", "FA", "Ft", "TI", "TO", "Pd0:0.5", "PG", "Gm", "s", "Qnonsense", "qhull"])
@pytest.mark.parametrize("cls", ["Delaunay", "ConvexHull", "Voronoi"])
def test_options_without_a_meaning_are_refused_by_name(cls, option):
    with pytest.raises(ValueError, match=re.escape(repr(option))):
        getattr(spatial, cls)(POINTS, qhull_options=f"Qc {option} Pp")


def test_options_belong_to_their_kind():
    with pytest.raises(ValueError, match="'Qu'"):
        spatial.ConvexHull(POINTS, qhull_options="Qu")
    with pytest.raises(ValueError, match="'QG3'"):
        spatial.Delaunay(POINTS, qhull_options="QG3")


def test_the_defaults_are_those_of_scipy():
    assert _options.parse(None, kind="delaunay") == _options.parse("Qbb Qc Qz Qx Q12", kind="delaunay")
    assert _options.parse(None, kind="voronoi", incremental=True) == _options.parse("Qc", kind="voronoi")
    assert _options.parse(None, kind="hull") == _options.parse("Qx", kind="hull") == _options.Options()


def test_the_guide_lists_every_option():
    table = set(re.findall(r"`(Q\w+|Pp|Tv)`", GUIDE.read_text(encoding="utf-8")))
    assert {*_options.NO_EFFECT, "Qbb", "Qc", "Qz", "Qu"} <= table
