# SPDX-License-Identifier: BSD-3-Clause
"""The methods `to_html`: pages for a browser, which the library writes."""
from __future__ import annotations

import os

from . import _core
from ._clipping import checked_box
from ._data import names, values_of
from ._frames import require_index

DOC = """Show {what} on an HTML page for a browser.

    The page needs nothing else, not even a network. It turns, zooms, cuts by a plane, colors, and names what is under the
    pointer.{more}

    Parameters
    ----------
    path : str or os.PathLike, optional
        The file to write, .html or .htm. By default the page is returned.
    values : array_like, optional
        Numbers to color by, one for each of `values_at`; NaN: no color.
    values_at : {{{places}}}, optional
        What the values belong to. By default the first that has as many entries.
    value_name : str, default 'value'
        The name of the values.
    title : str, optional
        The headline, and the name of pictures that are saved from the page.{arguments}

    Returns
    -------
    str or None
        The page, or None if it was written to `path`.

    Raises
    ------
    ValueError
        If values or their place do not suit, or the extension is another one.{errors}
    Error
        If the file cannot be written.

    Notes
    -----
    The file appears whole or not at all. Columns keep their names. Positions are rounded to 2^24 steps along each axis; the
    page says by how much. Removed rows are left out. Cost: linear. A page holds 600 kB of program, and about 13 bytes for each
    triangle or tetrahedron, 34 for a region of the plane and 210 for one of space: a million tetrahedra are a page of 13 MB. A
    browser opens some millions.
    """


def _method(what, places, more="", errors="", rows_of=lambda product: product):
    def to_html(self, path=None, *, values=None, values_at=None, value_name="value", title=""):
        return _written(path, self._to_html(*_options(rows_of(self), places, values, values_at, value_name, title)))
    to_html.__doc__ = DOC.format(what=what, places=", ".join(map(repr, places)), more=more, arguments="", errors=errors)
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
                        " It tells the circumradius and the quality of cells, k times the inradius over the\n    circumradius.")
alpha_complex = _method("the complex", ("points", "cells"), " It tells the circumradius and the quality of cells.",
                        "\n    RuntimeError\n        If points have been added to the triangulation since.", lambda alpha: alpha.triangulation)
convex_hull = _method("the hull", ("points", "facets", "cells"))
intersection = _method("the intersection", ("halfspaces", "facets"), " Unbounded intersections are cut off.",
                       "\n    InputError\n        If there are no interior points.")


def diagram(self, path=None, *, values=None, values_at=None, value_name="value", title="", box=None):
    return _written(path, self._to_html(*_options(self, ("points", "regions"), values, values_at, value_name, title), checked_box(box, self.dimension)))


diagram.__doc__ = DOC.format(what="the regions", places="'points', 'regions'", more="",
                             arguments="\n    box : (low, high), optional\n        Clip regions to this box, two arrays (d,). By default to ``bounding_box()``.",
                             errors="").replace("If the file cannot be written.", "If the file cannot be written, or for more than three dimensions.")
