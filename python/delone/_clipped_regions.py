# SPDX-License-Identifier: BSD-3-Clause
"""The regions of a diagram, clipped to a box and to halfspaces, as polygons and polyhedra."""
from __future__ import annotations

from typing import Iterator, List, Tuple, Union

import numpy as np

from . import _core


class ClippedRegions:
    """Regions of a diagram, clipped to a convex polytope; a sequence of regions.

    In the plane entry i is the polygon of region i: its corners, (c, 2), counterclockwise; none if no part of the region's interior is
    inside. In space it is ``(corners, faces)``: (c, 3), and for each face the numbers of its corners, counterclockwise seen from outside.
    The arrays are read-only and hold all regions. Made by `Diagram.clipped_regions`.

    Parameters
    ----------
    vertices : (v, d) ndarray of float64
        The corners of all regions. Regions that share a face have the same vertices there.
    face_vertices : ndarray of int
        The vertices of face j are ``face_vertices[face_offsets[j]:face_offsets[j+1]]``.
    face_offsets : (f+1,) ndarray of int64
        The offsets of `face_vertices`.
    region_offsets : (regions+1,) ndarray of int64
        Region i has the faces ``region_offsets[i]:region_offsets[i+1]``; in the plane one, the polygon, or none.
    neighbors : ndarray of int
        The region on the other side of each face, (f,); in the plane of each edge, from an entry of `face_vertices` to the next one of
        its face. -1 on the boundary of the polytope.

    Examples
    --------
    >>> import delone
    >>> regions = delone.Voronoi([[0, 0], [2, 0]]).clipped_regions(([-1, -1], [3, 1]))
    >>> regions[0].tolist()
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
    >>> regions.neighbors.tolist()
    [-1, 1, -1, -1, -1, -1, 0, -1]
    """

    __slots__ = ("face_offsets", "face_vertices", "neighbors", "region_offsets", "vertices")

    def __init__(self, vertices, face_vertices, face_offsets, region_offsets, neighbors):
        self.vertices, self.face_vertices, self.face_offsets = vertices, face_vertices, face_offsets
        self.region_offsets, self.neighbors = region_offsets, neighbors

    def __len__(self) -> int:
        return len(self.region_offsets) - 1

    def __getitem__(self, i: Union[int, slice]) -> Union[np.ndarray, Tuple[np.ndarray, List[np.ndarray]], list]:
        if isinstance(i, slice):
            return [self[j] for j in range(*i.indices(len(self)))]
        if not -len(self) <= i < len(self):
            raise IndexError(f"region {i} of {len(self)}")
        first, last = self.region_offsets[i % len(self):][:2]
        offsets = self.face_offsets[first:last + 1]
        own = self.face_vertices[offsets[0]:offsets[-1]]
        if self.vertices.shape[1] == 2:
            return self.vertices[own]
        used, numbers = np.unique(own, return_inverse=True)
        return self.vertices[used], np.split(numbers, offsets[1:-1] - offsets[0]) if last > first else []

    def __iter__(self) -> Iterator:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<delone.ClippedRegions: {len(self)} regions, {len(self.vertices)} vertices, {len(self.face_offsets) - 1} faces>"


def clipped_regions(self, box=None, *, halfspaces=None) -> ClippedRegions:
    """Clip the regions to a box and to halfspaces, as polygons or polyhedra.

    Parameters
    ----------
    box : (low, high), optional
        Two arrays (d,) of finite numbers. By default `bounding_box`, or the bounding box of the halfspaces if there are some.
    halfspaces : (m, d+1) array_like, optional
        Rows [A, b] of halfspaces A x + b <= 0, as of `HalfspaceIntersection`: a convex polytope. ``ConvexHull.equations`` are such rows.

    Returns
    -------
    ClippedRegions
        The regions, in their order; unbounded ones are no special case.

    Raises
    ------
    InputError
        If the box does not have finite limits low < high, or a normal is 0.
    ValueError
        If an array has another shape, or the halfspaces are unbounded and no box is given.
    Error
        If d is not 2 or 3.

    See Also
    --------
    region_volumes : Volumes in a box, in any dimension.

    Notes
    -----
    Which vertices, edges and faces there are is exact, also in degenerate cases: each region is closed, regions that share a face have the
    same vertices there, and all of them fill the polytope. Each coordinate is the double nearest to the exact one. So different vertices may
    have equal coordinates, and faces need not be plane to the last digit. With a tolerance of the diagram they are those of the exact
    regions. Cost: an exact solution for each vertex; less than a millisecond for each region of random points in space.

    Examples
    --------
    >>> import delone
    >>> vor = delone.Voronoi([[0, 0], [2, 0], [0, 2], [2, 2]])
    >>> triangle = [[-1, 0, -1], [0, -1, -1], [1, 1, -4]]
    >>> [len(polygon) for polygon in vor.clipped_regions(halfspaces=triangle)]
    [4, 4, 4, 3]
    """
    d = self.dimension
    if halfspaces is None:
        rows = np.empty((0, d + 1))
    else:
        rows = _core._doubles(halfspaces, "halfspaces")
        if rows.ndim != 2 or rows.shape[1] != d + 1:
            raise ValueError(f"halfspaces: an array of shape {rows.shape}, not (m, {d + 1})")
    if box is None:
        box = self.bounding_box()
        if len(rows):
            polytope = _core.HalfspaceIntersection(rows)
            if polytope.state == "full":
                if not polytope.is_bounded:
                    raise ValueError("halfspaces: their intersection is unbounded; a box is needed, too")
                box = np.nextafter(polytope.vertices.min(axis=0), -np.inf), np.nextafter(polytope.vertices.max(axis=0), np.inf)
    return ClippedRegions(*self._clipped_regions(box, rows))
