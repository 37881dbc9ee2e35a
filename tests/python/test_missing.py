# SPDX-License-Identifier: BSD-3-Clause
"""Attributes that are not there say what they are called here; text that is none is a ValueError."""
import copy
import re

import numpy as np
import pytest

import delone
from delone import _missing, spatial

POINTS = np.random.default_rng(0).random((30, 3))
CUBE = np.concatenate([np.c_[np.eye(3), -np.ones(3)], np.c_[-np.eye(3), -np.ones(3)]])
MADE = {
    delone.Delaunay: lambda: delone.Delaunay(POINTS), delone.Regular: lambda: delone.Regular(POINTS, np.zeros(30)),
    delone.FurthestSite: lambda: delone.FurthestSite(POINTS), delone.ConvexHull: lambda: delone.ConvexHull(POINTS),
    delone.Voronoi: lambda: delone.Voronoi(POINTS), delone.HalfspaceIntersection: lambda: delone.HalfspaceIntersection(CUBE),
}


@pytest.mark.parametrize("kind", MADE)
def test_what_is_missing_names_what_is_there(kind):
    made = MADE[kind]()
    owner = next(owner for owner in _missing._OF_SCIPY if isinstance(made, owner))
    names = {**_missing._OF_OTHERS[owner], **_missing._OF_SCIPY[owner]}
    for name, here in names.items():
        assert not hasattr(made, name)
        with pytest.raises(AttributeError, match=re.escape(f"{kind.__name__!r} object has no attribute {name!r}; here it is {here}")):
            getattr(made, name)
        for each in re.findall(r"[a-z]\w+", re.sub(r"\(.*?\)|, or|and", "", here)):
            assert hasattr(made, each), (name, each)
    with pytest.raises(AttributeError, match=f"^{kind.__name__!r} object has no attribute 'neighbours'$"):
        made.neighbours
    assert not hasattr(made, "__array_interface__") and copy.copy(made) is not made


@pytest.mark.parametrize("name", ["Delaunay", "ConvexHull", "Voronoi", "HalfspaceIntersection"])
def test_the_class_with_names_of_scipy_has_them(name):
    ours, kind = getattr(delone, name), getattr(spatial, name)
    made = kind(CUBE, np.zeros(3)) if name == "HalfspaceIntersection" else kind(POINTS)
    owner = next(owner for owner in _missing._OF_SCIPY if issubclass(ours, owner))
    for each in _missing._OF_SCIPY[owner]:
        if each != "vertices":  # deprecated
            assert hasattr(made, each), each
        with pytest.raises(AttributeError, match=f"delone.spatial.{name} has the names of SciPy"):
            getattr(MADE[ours](), each)


def test_halves_of_surrogate_pairs_are_value_errors(tmp_path):
    t = delone.Delaunay(POINTS)
    for use, name in [(lambda: t.to_html(title="a\ud800b"), "title"), (lambda: t.to_html(values=POINTS[:, 0], value_name="\udfff"), "value_name"),
                      (lambda: delone.ConvexHull(POINTS).to_html(title="\udc00"), "title"),
                      (lambda: t.save(tmp_path / "x.npz", "\ud800"), "format"), (lambda: delone.Delaunay(POINTS, order="\ud800"), "order")]:
        with pytest.raises(ValueError, match=rf"^{name}: '\S+' has half of a surrogate pair"):
            use()


def test_the_layer_of_scipy_says_how_halfspaces_are_made():
    with pytest.raises(ValueError, match=r"must be a \(ndim-1,\) array; A x <= b is one array of halfspaces, numpy.c_\[A, -b\]"):
        spatial.HalfspaceIntersection(CUBE[:, :-1], -CUBE[:, -1])
    with pytest.raises(ValueError, match=r"must be a \(ndim-1,\) array$"):
        spatial.HalfspaceIntersection(CUBE, [0, 0])
