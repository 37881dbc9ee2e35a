# SPDX-License-Identifier: BSD-3-Clause
"""Putting delone in the place of scipy, in the manner of scikit-learn-intelex's patch_sklearn."""
from __future__ import annotations

import importlib
import threading
import types
from typing import Iterable, Optional

# The modules of scipy, the names replaced in each, and modules behind them from which programs import these names, too: those where
# they are made, and old ones that forward them.
_REPLACED = {
    "scipy.spatial": (("ConvexHull", "Delaunay", "HalfspaceIntersection", "Voronoi", "convex_hull_plot_2d", "delaunay_plot_2d", "tsearch",
                       "voronoi_plot_2d"), ("scipy.spatial._qhull", "scipy.spatial._plotutils", "scipy.spatial.qhull")),
    "scipy.interpolate": (("CloughTocher2DInterpolator", "LinearNDInterpolator", "NearestNDInterpolator", "griddata"),
                          ("scipy.interpolate._interpnd", "scipy.interpolate._ndgriddata", "scipy.interpolate.interpnd",
                           "scipy.interpolate.ndgriddata")),
}
_ABSENT = object()
_originals: dict = {}  # (module, name): what was there
_lock = threading.RLock()


class _Patched:
    """What patch_scipy returns: a context manager that takes back, at the end of the block, what that call replaced."""

    def __init__(self, places):
        self._places = places

    def __enter__(self):
        return self

    def __exit__(self, *_):
        _restore(self._places)

    def __repr__(self):
        return f"<delone.patch_scipy: {', '.join(sorted({name for _, name in self._places})) or 'nothing replaced'}>"


def patch_scipy(names: Optional[Iterable[str]] = None):
    """Make programs that use scipy use delone.

    Replaces classes and functions of scipy.spatial and scipy.interpolate by those of `delone.spatial` and `delone.interpolate`.
    Call it before the program's imports: a module keeps what it has imported before by ``from scipy.spatial import Delaunay``.

    Parameters
    ----------
    names : str or iterable of str, optional
        The names to replace; None: ConvexHull, Delaunay, HalfspaceIntersection, Voronoi, tsearch, the plots in the plane,
        LinearNDInterpolator, NearestNDInterpolator, CloughTocher2DInterpolator and griddata.

    Returns
    -------
    context manager
        Restores the names that this call replaced at the end of a ``with`` block. May be ignored.

    Raises
    ------
    ImportError
        If scipy is missing.
    ValueError
        If a name is not one of these.

    See Also
    --------
    scipy_is_patched : Whether names are replaced.
    unpatch_scipy : Restore scipy's names.

    Notes
    -----
    ``python -m delone program.py`` runs a program patched. While scipy is patched, `delone.spatial.QhullError` is scipy's own. A
    second call replaces nothing. Modules that have imported delone's names keep them after `unpatch_scipy`. The names are also replaced
    in the modules of scipy that define or forward them, such as ``scipy.spatial._qhull``. Pickles of scipy's objects are to be loaded
    before.

    Examples
    --------
    >>> import delone
    >>> with delone.patch_scipy():
    ...     from scipy.spatial import Delaunay
    >>> Delaunay.__module__
    'delone.spatial._delaunay'
    """
    chosen = {names} if isinstance(names, str) else None if names is None else set(names)
    known = {name for replaced, _ in _REPLACED.values() for name in replaced}
    if chosen is not None and not chosen <= known:
        raise ValueError(f"patch_scipy: {', '.join(sorted(map(repr, chosen - known)))} is not replaced; known are {', '.join(sorted(known))}")
    places = []
    with _lock:
        for module_name, (replaced, behind) in _REPLACED.items():
            wanted = [name for name in replaced if chosen is None or name in chosen]
            if wanted:
                theirs, ours = importlib.import_module(module_name), importlib.import_module("delone" + module_name[len("scipy"):])
                places += [_replace(theirs, name, getattr(ours, name)) for name in wanted]
                for module in _existing(behind):
                    places += [_replace(module, name, getattr(ours, name)) for name in wanted if _has(module, name)]
        if ("scipy.spatial._qhull", "Delaunay") in _originals:
            places += [_keep_qhull(module) for module in _existing(("scipy.interpolate._interpnd", "scipy.interpolate.interpnd"))]
        spatial, theirs = importlib.import_module("delone.spatial"), importlib.import_module("scipy.spatial")
        if hasattr(theirs, "QhullError"):
            places.append(_replace(spatial, "QhullError", theirs.QhullError))
    return _Patched([place for place in places if place])


def unpatch_scipy() -> None:
    """Restore all names that `patch_scipy` has replaced."""
    with _lock:
        _restore(list(_originals))


def scipy_is_patched() -> bool:
    """Return whether names of scipy are replaced.

    Returns
    -------
    bool
        True from `patch_scipy` to `unpatch_scipy`.
    """
    return bool(_originals)


def _existing(names):
    """Those of the modules that this version of scipy has."""
    for name in names:
        try:
            yield importlib.import_module(name)
        except ImportError:
            continue


def _has(module, name) -> bool:
    """Whether the name is one of the module, or one that it forwards."""
    return name in vars(module) or "__getattr__" in vars(module) and name in getattr(module, "__all__", ())


def _keep_qhull(module):
    """scipy's own interpolators look up Delaunay in the module of Qhull at each call, and need the one that they are compiled for: they
    get a copy of that module."""
    qhull = vars(module).get("qhull")
    if getattr(qhull, "__name__", None) != "scipy.spatial._qhull":
        return None
    copy = types.ModuleType(qhull.__name__)
    vars(copy).update(vars(qhull))
    vars(copy).update({name: original for (place, name), original in _originals.items() if place == qhull.__name__})
    return _replace(module, "qhull", copy)


def _replace(module, name, value):
    place = module.__name__, name
    if place in _originals:
        return None
    _originals[place] = vars(module).get(name, _ABSENT)
    setattr(module, name, value)
    return place


def _restore(places) -> None:
    with _lock:
        for place in places:
            original = _originals.pop(place, None)
            if original is _ABSENT:
                delattr(importlib.import_module(place[0]), place[1])
            elif original is not None:
                setattr(importlib.import_module(place[0]), place[1], original)
