# SPDX-License-Identifier: BSD-3-Clause
"""Volumes, centroids, surfaces, neighbors and vertices of the cells of sites, from a triangulation alone; coordination numbers."""
from __future__ import annotations

import numpy as np

from . import _core


class SiteCells:
    """The cells of the sites of a triangulation, as read-only arrays with an entry for each row of the points.

    The cell of a site belongs to the first row there. Rows without a cell (hidden, removed, or duplicates of earlier ones) have volume, area
    and number of faces 0, centroid NaN and no neighbors. Made by `Delaunay.site_cells`, `Regular.site_cells`, `PeriodicDelaunay.site_cells` and
    `PeriodicRegular.site_cells`.

    Parameters
    ----------
    volumes : (n,) ndarray of float64
        The volumes; infinity for unbounded cells.
    centroids : (n, d) ndarray of float64
        The centroids; NaN for unbounded cells.
    areas : (n,) ndarray of float64
        The areas of the surfaces; infinity for unbounded cells.
    num_faces : (n,) ndarray of int
        The numbers of faces.
    neighbor_offsets : (n+1,) ndarray of int64, optional
        Row i has the neighbors ``neighbors[neighbor_offsets[i]:neighbor_offsets[i+1]]``. None, as all below, unless neighbors are wanted.
    neighbors : ndarray of int, optional
        The row of the site on the other side of each face, increasing for each cell; -1, last, for walls: faces on the boundary of the box.
    face_areas : ndarray of float64, optional
        The area of each face; infinity for unbounded ones.
    distances : ndarray of float64, optional
        From the site to each neighbor, or to the wall.
    num_edges : ndarray of int, optional
        The number of edges of each face, the two rays of an unbounded one included; None unless cells have 3 dimensions.
    neighbor_lattice : (f, r) ndarray of int32, optional
        Of a periodic set with r lattice vectors: neighbor i is at ``points[neighbors[i]] + neighbor_lattice[i] @ lattice``. None for others.
    vertex_offsets : (n+1,) ndarray of int64, optional
        The cell of row i has the vertices ``vertices[vertex_offsets[i]:vertex_offsets[i+1]]``. None, as all below, unless vertices are wanted.
    vertices : (v, d) ndarray of float64, optional
        The vertices of each cell: one for each finite cell of the triangulation at the site, so some may coincide; with proper faces, one for
        each empty sphere. They are the centers of the spheres, correctly rounded. A cell that a box or halfspaces cut has one, rounded as well,
        for each set of d faces that meet; with proper faces, one for each point where they do. Of a periodic set, they lie around the point
        where it was given, so that cells across the border are whole.
    face_vertex_offsets : (f+1,) ndarray of int64, optional
        Face i, that to ``neighbors[i]``, has the vertices ``face_vertices[face_vertex_offsets[i]:face_vertex_offsets[i+1]]``.
    face_vertices : ndarray of int, optional
        Numbers, from 0 on, among the vertices of the cell; -1 stands for infinity, where an unbounded face has its rays. Cells of three
        dimensions: in order around the face, counterclockwise seen from the neighbor or from beyond the wall, from -1 or the least number on. Of two: both ends of the
        edge, counterclockwise around the site. Otherwise they increase. In a flat, counterclockwise is meant of the coordinates along
        `Delaunay.axes`.

    Examples
    --------
    >>> import delone
    >>> cells = delone.Delaunay([[0, 0], [2, 0], [0, 2], [2, 2], [1, 1]]).site_cells(neighbors=True)
    >>> cells.volumes.tolist()
    [inf, inf, inf, inf, 2.0]
    >>> cells.neighbors_of(4).tolist()
    [0, 1, 2, 3]
    """

    __slots__ = ("areas", "centroids", "distances", "face_areas", "face_vertex_offsets", "face_vertices", "neighbor_lattice", "neighbor_offsets",
                 "neighbors", "num_edges", "num_faces", "vertex_offsets", "vertices", "volumes")

    def __init__(self, volumes, centroids, areas, num_faces, neighbor_offsets=None, neighbors=None, face_areas=None, distances=None,
                 num_edges=None, neighbor_lattice=None, vertex_offsets=None, vertices=None, face_vertex_offsets=None, face_vertices=None):
        self.volumes, self.centroids, self.areas, self.num_faces = volumes, centroids, areas, num_faces
        self.neighbor_offsets, self.neighbors, self.face_areas = neighbor_offsets, neighbors, face_areas
        self.distances, self.num_edges, self.neighbor_lattice = distances, num_edges, neighbor_lattice
        self.vertex_offsets, self.vertices = vertex_offsets, vertices
        self.face_vertex_offsets, self.face_vertices = face_vertex_offsets, face_vertices

    def __len__(self) -> int:
        return len(self.volumes)

    def neighbors_of(self, row: int) -> np.ndarray:
        """The neighbors of a row.

        Parameters
        ----------
        row : int
            A row of the points.

        Returns
        -------
        ndarray of int
            The rows of the sites that its cell has a face with; -1 for walls. In a periodic set a row may occur several times.

        Raises
        ------
        ValueError
            If neighbors were not wanted.
        IndexError
            If there is no such row.
        """
        if self.neighbors is None:
            raise ValueError("neighbors_of: the cells were made without neighbors=True")
        row = self._checked(row)
        return self.neighbors[self.neighbor_offsets[row]:self.neighbor_offsets[row + 1]]

    def polygons_of(self, row: int) -> tuple[np.ndarray, list[np.ndarray]]:
        """The vertices of the cell of a row, and those of each of its faces.

        Parameters
        ----------
        row : int
            A row of the points.

        Returns
        -------
        vertices : (v, d) ndarray of float64
            The vertices of the cell.
        faces : list of ndarray of int
            For each of `neighbors_of`, numbers of vertices in the order of `face_vertices`; -1 stands for infinity.

        Raises
        ------
        ValueError
            If vertices were not wanted.
        IndexError
            If there is no such row.

        Examples
        --------
        >>> import delone
        >>> cells = delone.Delaunay([[0, 0], [2, 0], [0, 2], [2, 2], [1, 1]]).site_cells(vertices=True)
        >>> vertices, faces = cells.polygons_of(4)
        >>> vertices.tolist()
        [[0.0, 1.0], [1.0, 0.0], [1.0, 2.0], [2.0, 1.0]]
        >>> [face.tolist() for face in faces]
        [[0, 1], [1, 3], [2, 0], [3, 2]]
        """
        if self.vertices is None:
            raise ValueError("polygons_of: the cells were made without vertices=True")
        row = self._checked(row)
        first, last = self.neighbor_offsets[row], self.neighbor_offsets[row + 1]
        begin, end = self.face_vertex_offsets[first:last], self.face_vertex_offsets[first + 1:last + 1]
        return (self.vertices[self.vertex_offsets[row]:self.vertex_offsets[row + 1]],
                [self.face_vertices[i:j] for i, j in zip(begin, end)])

    def _checked(self, row: int) -> int:
        if not -len(self) <= row < len(self):
            raise IndexError(f"row {row} of {len(self)}")
        return row % len(self)

    def __repr__(self) -> str:
        faces = "" if self.neighbors is None else f", {len(self.neighbors)} faces"
        return f"<delone.SiteCells: {len(self)} rows{faces}>"


def site_cells(self, *, neighbors=False, vertices=False, faces="triangulated", box=None, halfspaces=None) -> SiteCells:
    """Volumes, centroids, surfaces, neighbors and vertices of the cells of all sites, without a diagram.

    Cells are those of the Voronoi diagram of the points, with weights those of the power diagram.

    Parameters
    ----------
    neighbors : bool, optional
        Whether to list neighbors, areas of faces and distances.
    vertices : bool, optional
        Whether to list vertices, and those of each face in order. Neighbors are listed as well.
    faces : {"triangulated", "proper"}, optional
        Which faces count. "triangulated": one for each edge of the triangulation at the site. Where more than d+1 points have one empty
        sphere, some have no area; which ones, the triangulation says. "proper": those with an area, decided exactly.
    box : (low, high), optional
        Two arrays (d,) of finite numbers: cells are clipped to this box.
    halfspaces : (m, d+1) array_like, optional
        Rows [A, b] of halfspaces A x + b <= 0, which clip the cells in the box as well.

    Returns
    -------
    SiteCells
        The arrays, by row of the points.

    Raises
    ------
    InputError
        If the box does not have finite limits low < high, a normal is 0, or there are halfspaces without a box.
    ValueError
        If an argument has another shape, or `faces` another value.
    Error
        If d is larger than 12.

    See Also
    --------
    Voronoi.region_volumes : The volumes of the regions of a diagram.

    Notes
    -----
    A cell is the sum of signed pieces. The volume of one that no box cuts is off by at most 1e-12 times the sum of their absolute volumes; where
    rounding errors may be larger, wider arithmetic takes over. Nothing depends on the number of threads. Points that span only a k-flat have
    their cells inside the flat; with a box cells are those of the space. Cost: about that of the triangulation; cells that the box cuts cost
    some hundred microseconds each.

    Examples
    --------
    >>> import delone
    >>> t = delone.Delaunay([[0, 0], [2, 0]])
    >>> cells = t.site_cells(box=([-1, -1], [3, 1]), neighbors=True)
    >>> cells.volumes.tolist(), cells.centroids.tolist()
    ([4.0, 4.0], [[0.0, 0.0], [2.0, 0.0]])
    >>> cells.neighbors_of(0).tolist()
    [1, -1, -1, -1]
    """
    if halfspaces is not None:
        halfspaces = _core._doubles(halfspaces, "halfspaces")
        if halfspaces.ndim != 2 or halfspaces.shape[1] != self.dimension + 1:
            raise ValueError(f"halfspaces: an array of shape {halfspaces.shape}, not (m, {self.dimension + 1})")
    arrays = self._site_cells(bool(neighbors), bool(vertices), _are_proper(faces), box, halfspaces)
    return SiteCells(*(arrays if neighbors or vertices else arrays[:4]))


def periodic_site_cells(self, *, neighbors=False, vertices=False, faces="triangulated") -> SiteCells:
    """Volumes, centroids, surfaces, neighbors and vertices of the cells of all points, each around the point where it was given.

    Cells are those of the Voronoi diagram of the points and all their translates, with weights those of the power diagram.

    Parameters
    ----------
    neighbors : bool, optional
        Whether to list neighbors, areas of faces, distances, and by which lattice vectors each neighbor is translated.
    vertices : bool, optional
        Whether to list vertices, and those of each face in order. Neighbors are listed as well.
    faces : {"triangulated", "proper"}, optional
        Which faces count. "triangulated": one for each edge of the triangulation at the point. Where more than d+1 points have one empty
        sphere, some have no area; which ones, the triangulation says. "proper": those with an area, decided exactly.

    Returns
    -------
    SiteCells
        The arrays, by row of the points. A row may be a neighbor several times, with other translations, also that of the point itself.

    Raises
    ------
    ValueError
        If `faces` has another value.
    Error
        If d is larger than 12, or translations do not fit into 32 bits.

    See Also
    --------
    Delaunay.site_cells : Of points without a lattice.

    Notes
    -----
    If the set is periodic along all directions, volumes add up to that of the box. Otherwise cells at the hull are unbounded: volume and area are
    infinity, the centroid is NaN. Accuracy is that of `Delaunay.site_cells`. Lengths are those of `points` and `lattice`, which are on a grid; see
    `displacement`. Nothing depends on the number of threads.

    Examples
    --------
    >>> import delone
    >>> t = delone.PeriodicDelaunay([[0.25, 0.5]], 1.0)
    >>> cells = t.site_cells(neighbors=True, faces="proper")
    >>> cells.volumes.tolist(), cells.centroids.tolist()
    ([1.0], [[0.25, 0.5]])
    >>> cells.neighbors.tolist(), cells.neighbor_lattice.tolist()
    ([0, 0, 0, 0], [[-1, 0], [0, -1], [0, 1], [1, 0]])
    """
    arrays = self._site_cells(bool(neighbors), bool(vertices), _are_proper(faces))
    return SiteCells(*(arrays if neighbors or vertices else arrays[:4]))


def coordination(triangulation, *, weight="solid_angle", tolerance=0.0) -> tuple[np.ndarray, np.ndarray, SiteCells]:
    """The coordination number of each site: how many faces of its cell are large enough.

    Parameters
    ----------
    triangulation : Delaunay, Regular, PeriodicDelaunay or PeriodicRegular
        The triangulation of the sites, in three dimensions.
    weight : {"solid_angle", "area"}, optional
        How large a face is: the solid angle at which the site sees it, or its area.
    tolerance : float, optional
        A neighbor counts if the weight of its face is more than this share, at least 0 and less than 1, of the largest one of the cell.

    Returns
    -------
    numbers : (n,) ndarray of int
        The coordination numbers; -1 for sites with unbounded cells, 0 for rows without a cell.
    weights : (f,) ndarray of float64
        The weight of each face, solid angles in steradians; NaN for unbounded cells. The angles of a cell that holds its site add up to 4 pi.
        Where a cell of a power diagram does not, faces that the site sees from outside have negative ones.
    cells : SiteCells
        The cells, with the proper faces that the weights are of, and their vertices.

    Raises
    ------
    ValueError
        If the points do not span three dimensions, `weight` has another value, or the tolerance is out of range.

    See Also
    --------
    Delaunay.site_cells : Neighbors, areas, vertices.

    Notes
    -----
    Faces are proper ones, decided exactly. So a crystal in exact coordinates has its ideal numbers without a tolerance. Noise makes small
    faces, which a tolerance leaves out. Solid angles are sums over triangles (Van Oosterom and Strackee 1983,
    doi:10.1109/TBME.1983.325207). Weights are compared with the largest one, as proposed by O'Keeffe (1979,
    doi:10.1107/S0567739479001765). Cost: some times that of `Delaunay.site_cells`.

    Examples
    --------
    >>> import delone
    >>> iron = delone.PeriodicDelaunay([[0, 0, 0], [0.5, 0.5, 0.5]], 1.0)
    >>> delone.coordination(iron)[0].tolist(), delone.coordination(iron, tolerance=0.5)[0].tolist()
    ([14, 14], [8, 8])
    """
    if weight not in ("solid_angle", "area"):
        raise ValueError(f"weight: 'solid_angle' or 'area', not {weight!r}")
    if not 0 <= tolerance < 1:
        raise ValueError(f"tolerance: at least 0 and less than 1, not {tolerance}")
    if triangulation.dimension != 3 or triangulation.affine_dimension != 3:
        raise ValueError("coordination: points that span three dimensions are needed")
    cells = triangulation.site_cells(vertices=True, faces="proper")
    n = len(cells)
    owner = np.repeat(np.arange(n), np.diff(cells.neighbor_offsets))
    bounded = np.isfinite(cells.volumes)
    if weight == "area":
        weights = np.array(cells.face_areas)
    else:
        weights = _solid_angles(cells, owner, bounded, np.asarray(triangulation.points)[:, :3])
    weights[~bounded[owner]] = np.nan
    largest = np.zeros(n)
    np.maximum.at(largest, owner, np.nan_to_num(weights))
    numbers = np.bincount(owner[weights > tolerance * largest[owner]], minlength=n)
    numbers[~bounded] = -1
    return numbers, weights, cells


def _solid_angles(cells, owner, bounded, points):
    """Each face of a bounded cell is a fan of triangles at its first vertex."""
    triangles = np.where(bounded[owner], np.diff(cells.face_vertex_offsets) - 2, 0)
    face = np.repeat(np.arange(len(owner)), triangles)
    first = cells.face_vertex_offsets[face]
    place = np.arange(len(face)) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    site = owner[face]
    a, b, c = (cells.vertices[cells.vertex_offsets[site] + cells.face_vertices[at]] - points[site]
               for at in (first, first + place + 1, first + place + 2))

    def dot(x, y):
        return np.einsum("ij,ij->i", x, y)

    of_a, of_b, of_c = (np.sqrt(dot(x, x)) for x in (a, b, c))
    below = of_a * of_b * of_c + dot(a, b) * of_c + dot(b, c) * of_a + dot(c, a) * of_b
    return np.bincount(face, 2 * np.arctan2(dot(a, np.cross(b, c)), below), len(owner)).astype(float)


def _are_proper(faces) -> bool:
    if faces not in ("triangulated", "proper"):
        raise ValueError(f"faces: 'triangulated' or 'proper', not {faces!r}")
    return faces == "proper"
