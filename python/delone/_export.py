# SPDX-License-Identifier: BSD-3-Clause
"""Results as meshes of other programs: meshio, VTK and PyVista, each imported when it is asked for."""
from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional

import numpy as np

from . import _core
from ._data import values_of
from ._frames import require_index

SIMPLICES = ("vertex", "line", "triangle", "tetra")
VTK_TYPES = {"vertex": 1, "line": 3, "triangle": 5, "tetra": 10, "polygon": 7, "polyhedron": 42}


class Mesh(NamedTuple):
    """Cells of one kind. Those of simplices and polygons are (offsets, points); those of polyhedra (offsets, faces), with the faces in
    face_offsets and face_points."""

    kind: str
    points: np.ndarray
    offsets: np.ndarray
    items: np.ndarray
    point_data: Dict[str, np.ndarray]
    cell_data: Dict[str, np.ndarray]
    face_offsets: Optional[np.ndarray] = None
    face_points: Optional[np.ndarray] = None

    def __len__(self):
        return len(self.offsets) - 1

    def face(self, i) -> np.ndarray:
        return self.face_points[self.face_offsets[i]:self.face_offsets[i + 1]]

    def faces_of(self, cell) -> List[np.ndarray]:
        return [self.face(i) for i in self.items[self.offsets[cell]:self.offsets[cell + 1]]]


def _data(given, name, counts, index=None) -> Dict[str, np.ndarray]:
    """Arrays by their names, with one entry for each of what is counted; of `counts`, (what, number, which entries cells have).
    `index`: that of the points, see _frames.index()."""
    found = {}
    for key, values in ({} if given is None else dict(given)).items():
        array = values_of(values, f"{name}[{_core._represented(key)}]")
        for what, count, which in counts:
            if array.ndim in (1, 2) and len(array) == count:
                if what == "points":
                    require_index(values, index, f"{name}[{_core._represented(key)}]")
                found[str(key)] = array if which is None else array[which]
                break
        else:
            wanted = " or ".join(f"{what} ({count})" for what, count, _ in counts)
            raise ValueError(f"{name}[{_core._represented(key)}]: one entry for each of the {wanted}, not an array of shape {array.shape}")
    return found


def _points(product, points):
    if points.shape[1] > 3:
        raise ValueError(f"dimension is {product.dimension}: meshes have at most 3")
    return points


def _of_simplices(points, cells, point_data, cell_data) -> Mesh:
    return Mesh(SIMPLICES[cells.shape[1] - 1], points, np.arange(len(cells) + 1) * cells.shape[1], cells.ravel(), point_data, cell_data)


def _cells(product):
    """The cells as rows of vertices; of no point at all, whose cells have no corner, (0, 1)."""
    cells = product.cells
    return cells if cells.shape[1] else cells.reshape(0, 1)


def triangulation(self, point_data, cell_data) -> Mesh:
    x, cells = _points(self, self.points), _cells(self)
    return _of_simplices(x, cells, _data(point_data, "point_data", [("points", len(x), None)], self._index),
                         _data(cell_data, "cell_data", [("cells", len(cells), None)]))


def alpha_complex(self, point_data, cell_data) -> Mesh:
    whole = self.triangulation
    x, cells = _points(whole, whole.points), _cells(self)
    counts = [("cells", len(cells), None), ("cells of the triangulation", whole.num_cells, self.cell_numbers)]
    return _of_simplices(x, cells, _data(point_data, "point_data", [("points", len(x), None)], whole._index), _data(cell_data, "cell_data", counts))


def lower_hull(self, point_data, cell_data) -> Mesh:
    x, cells = _points(self, self.points), _cells(self)
    counts = [("cells", len(cells), None), ("facets", self.num_facets, self.facet_of_cell)]
    return _of_simplices(x, cells, _data(point_data, "point_data", [("points", len(x), None)], self._index), _data(cell_data, "cell_data", counts))


def convex_hull(self, point_data, cell_data) -> Mesh:
    x, cells = _points(self, self.points), _cells(self)
    counts = [("cells", self.num_cells, None), ("facets", self.num_facets, self.facet_of_cell)]
    return _of_simplices(x, cells, _data(point_data, "point_data", [("points", len(x), None)], self._index), _data(cell_data, "cell_data", counts))


def diagram(self, point_data, cell_data) -> Mesh:
    x = _points(self, self.vertices)
    k = self.affine_dimension
    if k not in (2, 3):
        raise ValueError(f"affine_dimension is {k}: meshes have the regions of diagrams of 2 or 3")
    finite = np.isfinite(x).all(axis=1)
    closed = np.append(finite, False)[self.region_vertices]
    counts = np.diff(self.region_offsets)
    kept = counts > 0
    kept[kept] = np.logical_and.reduceat(closed, self.region_offsets[:-1][kept]) if kept.any() else False
    regions = np.flatnonzero(kept)
    sites = self.region_points[regions]
    points = _data(point_data, "point_data", [("vertices", len(x), None)])
    of_cells = [("points", self.num_points, sites), ("regions", self.num_regions, regions)]
    data = {"region": regions, "point": sites, **_data(cell_data, "cell_data", of_cells, self._index)}
    if k == 2:
        offsets = np.append(0, np.cumsum(counts[regions]))
        return Mesh("polygon", x, offsets, self.region_vertices[np.repeat(kept, counts)], points, data)
    sides = self.point_region[self.ridge_points]
    ridge = np.repeat(np.arange(len(sides)), 2)
    number = np.full(self.num_regions, -1)
    number[regions] = np.arange(len(regions))
    owner = number[sides.ravel()]
    ridge, owner = ridge[owner >= 0], owner[owner >= 0]
    order = np.argsort(owner, kind="stable")
    offsets = np.append(0, np.cumsum(np.bincount(owner, minlength=len(regions))))
    return Mesh("polyhedron", x, offsets, ridge[order], points, data, self.ridge_offsets, self.ridge_vertices)


def intersection(self, point_data, cell_data) -> Mesh:
    x, d = _points(self, self.vertices), self.dimension
    if d < 2 or not self.is_bounded:
        raise ValueError(f"dimension is {d}: meshes have intersections of 2 or 3" if d < 2 else "meshes have bounded intersections only")
    rows = self.facet_halfspaces
    counts = [("halfspaces", self.num_halfspaces, rows), ("facets", len(rows), None)]
    return Mesh("line" if d == 2 else "polygon", x, np.array(self.facet_offsets), self.facet_vertices,
                _data(point_data, "point_data", [("vertices", len(x), None)]), {"halfspace": rows, **_data(cell_data, "cell_data", counts)})


def _to_meshio(mesh: Mesh) -> Any:
    try:
        import meshio
    except ImportError as error:
        raise ImportError("to_meshio() needs meshio: install it, for example by `pip install meshio`, or as the package python3-meshio of Debian "
                          "and Ubuntu") from error
    counts = np.diff(mesh.offsets)
    if mesh.kind == "polyhedron":
        faces = [mesh.faces_of(i) for i in range(len(mesh))]
        counts = np.array([len(np.unique(np.concatenate(each))) for each in faces], dtype=np.intp)
    blocks, members = [], []
    for count in np.unique(counts).tolist():  # meshio wants cells of so many points together
        chosen = np.flatnonzero(counts == count)
        members.append(chosen)
        if mesh.kind == "polyhedron":
            blocks.append((f"polyhedron{count}", [faces[i] for i in chosen]))
        else:
            blocks.append((mesh.kind, mesh.items[mesh.offsets[chosen][:, None] + np.arange(count)].astype(np.int64)))
    cell_data = {name: [values[chosen] for chosen in members] for name, values in mesh.cell_data.items()}
    return meshio.Mesh(np.array(mesh.points), blocks, point_data=mesh.point_data, cell_data=cell_data)


def _to_vtk(mesh: Mesh) -> Any:
    try:
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid
    except ImportError as error:
        raise ImportError("to_vtk() needs VTK 9: install it, for example by `pip install vtk`, or as the package python3-vtk9 of Debian and "
                          "Ubuntu") from error
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    places = np.zeros((len(mesh.points), 3))
    places[:, :mesh.points.shape[1]] = mesh.points
    points.SetData(numpy_to_vtk(places, deep=1))
    grid.SetPoints(points)
    kind = VTK_TYPES[mesh.kind]
    if mesh.kind == "polyhedron":
        grid.Allocate(len(mesh))
        for i in range(len(mesh)):
            faces = mesh.faces_of(i)
            stream = vtkIdList()
            stream.InsertNextId(len(faces))
            for face in faces:
                stream.InsertNextId(len(face))
                for point in face.tolist():
                    stream.InsertNextId(point)
            grid.InsertNextCell(kind, stream)
    else:
        cells = vtkCellArray()
        cells.SetData(numpy_to_vtkIdTypeArray(mesh.offsets.astype(np.int64), deep=1), numpy_to_vtkIdTypeArray(mesh.items.astype(np.int64), deep=1))
        grid.SetCells(kind, cells)
    for target, data in ((grid.GetPointData(), mesh.point_data), (grid.GetCellData(), mesh.cell_data)):
        for name, values in data.items():
            array = numpy_to_vtk(np.ascontiguousarray(values.view(np.uint8) if values.dtype == bool else values), deep=1)
            array.SetName(name)
            target.AddArray(array)
    return grid


def _to_pyvista(mesh: Mesh) -> Any:
    try:
        import pyvista
    except ImportError as error:
        raise ImportError("to_pyvista() needs PyVista: install it, for example by `pip install pyvista`; to_vtk() needs VTK only") from error
    return pyvista.wrap(_to_vtk(mesh))


SIMPLICIAL = """
    Points keep their rows.
"""
POINTS = "point_data : dict of str to (n,) or (n, c) array_like, optional\n        Values for each point, by their names."
VERTICES = "point_data : dict of str to (v,) or (v, c) array_like, optional\n        Values for each vertex, by their names."
AT_MOST_3 = "If there are more than 3 dimensions, or an array has another length."

# What a mesh shows, the arguments that it takes, and when it raises ValueError.
CELLS = {
    triangulation: ("the cells as vertices, lines, triangles or tetrahedra", SIMPLICIAL, f"""{POINTS}
    cell_data : dict of str to (m,) or (m, c) array_like, optional
        Values for each cell, by their names.""", AT_MOST_3),
    alpha_complex: ("the cells of the complex as vertices, lines, triangles or tetrahedra", SIMPLICIAL, f"""{POINTS}
    cell_data : dict of str to (m,) or (m, c) array_like, optional
        Values for each cell of the complex, or of the triangulation, by their names.""", f"""{AT_MOST_3}
    RuntimeError
        If points have been added to the triangulation since."""),
    lower_hull: ("the cells as vertices, lines or triangles", """
    The height is the last coordinate. Points keep their rows.
""", f"""{POINTS}
    cell_data : dict of str to (m,) or (m, c) array_like, optional
        Values for each cell, or for each facet, by their names.""", AT_MOST_3),
    convex_hull: ("the cells of the boundary as vertices, lines or triangles", SIMPLICIAL, f"""{POINTS}
    cell_data : dict of str to (m,) or (m, c) array_like, optional
        Values for each cell, or for each facet, by their names.""", AT_MOST_3),
    diagram: ("the bounded regions as polygons or polyhedra", """
    The points are those of `vertices`. Unbounded regions are left out. Cell data `region` is the number of each region, and
    `point` the row of its site.
""", f"""{VERTICES}
    cell_data : dict of str to (n,) or (regions,) array_like, optional
        Values for each point, or for each region, by their names; rows of numbers are allowed.""",
              "If the affine dimension is not 2 or 3, there are more than 3 dimensions, or an array has another length."),
    intersection: ("the facets of a bounded intersection as lines or polygons", """
    The points are those of `vertices`. Cell data `halfspace` is the row of each facet.
""", f"""{VERTICES}
    cell_data : dict of str to (m,) or (f,) array_like, optional
        Values for each halfspace, or for each facet, by their names; rows of numbers are allowed.""",
                   "If the dimension is not 2 or 3, if the intersection is unbounded, flat or empty, or an array has another length."),
}
TARGETS = {"to_meshio": ("meshio.Mesh", "meshio", _to_meshio),
           "to_vtk": ("vtkUnstructuredGrid", "VTK", _to_vtk),
           "to_pyvista": ("pyvista.UnstructuredGrid", "PyVista", _to_pyvista)}
DOC = """Return {shown} for {program}.
{more}
    Parameters
    ----------
    {arguments}

    Returns
    -------
    {result}
        The mesh.

    Raises
    ------
    ValueError
        {errors}
    ImportError
        If {program} is missing.

    Notes
    -----
    Cost: a copy, and for polyhedra a loop over all faces.
    """


def methods(make_mesh) -> Dict[str, Any]:
    """The methods of the products that make_mesh(product, point_data, cell_data) takes."""
    return {name: _method(make_mesh, name) for name in TARGETS}


def _method(make_mesh, name: str):
    result, program, convert = TARGETS[name]
    shown, more, arguments, errors = CELLS[make_mesh]

    def export(self, *, point_data=None, cell_data=None):
        return convert(make_mesh(self, point_data, cell_data))
    export.__doc__ = DOC.format(shown=shown, more=more, arguments=arguments, result=result, errors=errors, program=program)
    return export
