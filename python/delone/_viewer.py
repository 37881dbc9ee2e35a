# SPDX-License-Identifier: BSD-3-Clause
"""The methods `to_html`: pages for a browser, which the library writes."""
from __future__ import annotations

import os

from . import _core
from ._clipping import checked_box
from ._data import names, values_of
from ._frames import require_index

DOC = """One HTML page that shows {what} in a browser and needs nothing else, no network either: it turns, zooms, is cut by a plane, colored,
and names what is under the pointer. Returned as a str; with `path`, it is written there, whole or not at all.

values: numbers to color by, NaN for none, for each of `values_at`: {places}; None: of whichever there are as many. title: the
headline, and the name of pictures that are saved there. Columns with names keep them. {more}Positions are rounded to 2^24 steps along
each axis, and the page says by how much. ValueError for values or a place that do not suit, and for another
extension of `path` than .html or .htm. Cost: linear; about 20 bytes of page for each
triangle of the plane."""


def _method(what, places, more=""):
    def to_html(self, path=None, *, values=None, values_at=None, value_name="value", title=""):
        return _written(path, self._to_html(*_options(self, places, values, values_at, value_name, title)))
    to_html.__doc__ = DOC.format(what=what, places=", ".join(f'"{place}"' for place in places), more=more)
    return to_html


def _options(product, places, values, values_at, value_name, title):
    if values_at is not None and values_at not in places:
        raise ValueError(f"values_at: one of {', '.join(map(repr, places))} was expected, not {_core._represented(values_at)}")
    if values is not None:
        given, values = values, values_of(values, "values")
        if values_at == "points" or values_at is None and places[0] == "points" and values.shape == (getattr(product, "num_rows", product.num_points),):
            require_index(given, product._index, "values")
    return str(title), names(product), values, values_at or "", str(value_name)


def _written(path, page):
    if path is None:
        return page
    extension = os.path.splitext(os.fsdecode(path))[1]
    if extension.lower() not in ("", ".html", ".htm"):
        raise ValueError(f"path: a page is HTML, in a file .html or .htm, not {_core._represented(extension)}; plot() draws pictures")
    _core._write_text(os.fsencode(path), page)
    return None


triangulation = _method("the triangulation", ("points", "cells"),
                        "Cells have their circumradius and their quality, k times the inradius over the circumradius. ")
convex_hull = _method("the hull", ("points", "facets", "cells"))
intersection = _method("the intersection", ("halfspaces", "facets"), "Unbounded ones are cut off. InputError for one without interior points. ")


def diagram(self, path=None, *, values=None, values_at=None, value_name="value", title="", box=None):
    return _written(path, self._to_html(*_options(self, ("points", "regions"), values, values_at, value_name, title), checked_box(box, self.dimension)))


diagram.__doc__ = DOC.format(what="the regions", places='"points", "regions"',
                             more="box: (low, high), where regions are cut off; the bounding box enlarged by a tenth if None. Diagrams of "
                                  "furthest sites are not shown, nor those of more than three dimensions: Error. ")
