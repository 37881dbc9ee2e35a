# SPDX-License-Identifier: BSD-3-Clause
"""Qhull's options: each is honoured, without effect, or refused by name, as the table of docs/from-qhull.md says."""
import pathlib
import re

import numpy as np
import pytest

from delone import spatial
from delone.spatial import _options, _tolerance

# Those about how Qhull computes, tests and warns.
ABOUT_COMPUTING = ("Qt", "Qx", "Qs", "Qf", "Qm", "Qr", "Qv", "Qw", "Qa", "Pp", "Tv")
POINTS = np.random.default_rng(3).random((30, 3))
GUIDE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "from-qhull.md"


@pytest.mark.parametrize("option", [
    *ABOUT_COMPUTING, "Q0", "Q3", "Q12", "QJ", "QJ1e-9", *"fimnops", "Fv", "FA", "Ft", "FO", "G", "Gm", "GD2", "PG", "Pg", "Po", "T4", "T-1",
    "Ts", "Tz", "Tc", "TF100", "TP3", "TW.1", "A-0.99", "A0.9", "U1e-4", "V0.1", "R1e-3", "C-0", "C1e-17", "W1e-17", "E1e-17"])
@pytest.mark.parametrize("cls", ["Delaunay", "ConvexHull", "Voronoi"])
def test_options_about_rounding_change_nothing(cls, option):
    plain, other = getattr(spatial, cls)(POINTS), getattr(spatial, cls)(POINTS, qhull_options=option)
    if cls == "Voronoi":
        np.testing.assert_array_equal(plain.vertices, other.vertices)
    else:
        np.testing.assert_array_equal(plain.simplices, other.simplices)


@pytest.mark.parametrize("option", ["Qb0:0", "QB1:1", "Qbk:0Bk:0", "QR7", "QR-3", "QV2", "Qg", "Qi", "TI", "TOfile", "TV3", "TC-2", "TA9",
                                    "Pd0:0.5", "PD1", "PA5", "PF0.1", "PM2", "d", "v", "H0,0", "W-1", "E-1", "Qnonsense", "qhull", "x", "A"])
@pytest.mark.parametrize("cls", ["Delaunay", "ConvexHull", "Voronoi"])
def test_options_without_a_meaning_are_refused_by_name(cls, option):
    with pytest.raises(ValueError, match=re.escape(repr(option))):
        getattr(spatial, cls)(POINTS, qhull_options=f"Qc {option} Pp")


def test_the_options_of_pymatgen_and_others_are_accepted():
    for text in ["Qt i", "QJ i", "QJ Pp", "Qt Qc Pp", "Qbb Qt Qc i", "Fx Tv s"]:
        assert spatial.ConvexHull(POINTS, qhull_options=text).nsimplex > 0


@pytest.mark.parametrize("option", ["Qbb", "QbB", "Qz"])
@pytest.mark.parametrize("cls", ["Delaunay", "ConvexHull", "Voronoi"])
def test_options_are_refused_in_incremental_mode_as_in_scipy(cls, option):
    modules = [spatial]
    try:
        import scipy.spatial
        modules.append(scipy.spatial)
    except ImportError:
        pass
    for module in modules:
        with pytest.raises(ValueError, match=f"{option}.* incompatible with incremental mode"):
            getattr(module, cls)(POINTS, incremental=True, qhull_options=option)


def test_the_tolerance_is_that_of_qhull():
    """Qhull prints the distance within which it merges: `rbox c | qconvex FO` has _one-merge 4.9e-15, `rbox c D5 | …` 1.5e-14."""
    for dimension, expected in [(3, 4.9e-15), (5, 1.5e-14)]:
        assert _tolerance.of_qhull(np.stack([np.full(dimension, 0.5), np.full(dimension, -0.5)])) == pytest.approx(expected, rel=0.02, abs=0)
    cube = np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).reshape(3, -1).T.astype(float)
    assert _tolerance.of_qhull(cube) == pytest.approx(7 * 2**-52 * (1.01 * 3 * 3**0.5 + 1), rel=1e-12, abs=0)
    assert _tolerance.of_qhull(cube * 1000) == pytest.approx(1000 * _tolerance.of_qhull(cube), rel=1e-12, abs=0)
    assert _tolerance.of_qhull(np.full((2, 2), 1e308)) < np.inf
    for text, expected in [("Q0", 0), ("QJ", 0), ("W1e-3", 1e-3), ("E1e-5", 7e-5), ("C-1e-3 E0", 3e-3), ("C1e-3 C-1e-4 E0", 3e-3)]:
        assert _tolerance.of_qhull(cube, _options.parse(text, kind="hull")) == pytest.approx(expected, rel=1e-12, abs=0), text
    assert spatial.ConvexHull(cube).tolerance == _tolerance.of_qhull(cube)
    assert spatial.ConvexHull(cube, tolerance=0).tolerance == 0 == spatial.Voronoi(cube, tolerance=0).tolerance


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
    """Every row of the guide says what the parser does with its options."""
    rows = re.findall(r"^\| (`.*?) \| (.*) \|$", GUIDE.read_text(encoding="utf-8").partition("## Options")[2].partition("## ")[0], re.M)
    listed = {option for names, _ in rows for option in re.findall(r"`([^`]+)`", names)}
    assert {*ABOUT_COMPUTING, "Qbb", "Qc", "Qz", "Qu", "QJ", "Q0", "Cn", "C-n", "En", "Wn", *"fimnops"} <= listed
    for names, meaning in rows:
        if "incremental" in names:
            continue
        for option in re.findall(r"`([^`]+)`", names):
            option = re.sub(r"(?<=.)n$", "3", option).replace("k:n", "0:3").replace("…", "a" if option[0] in "FG" else "4").replace("-n", "-3")
            for kind in ("delaunay", "voronoi", "hull"):
                expected = meaning.startswith("refused") or kind == "hull" and option == "Qu" or kind != "hull" and option[:2] == "QG"
                try:
                    _options.parse(option, kind=kind)
                    refused = False
                except ValueError:
                    refused = True
                assert refused == expected, (option, kind, meaning)
