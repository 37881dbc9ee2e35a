# SPDX-License-Identifier: BSD-3-Clause
"""DataFrames in and out, meshes of meshio and VTK, and progress bars. Each test is left out where its library is missing."""
import copy
import io
import pickle
import subprocess
import sys

import numpy as np
import pytest

import delone
from delone import _frames

RANDOM = np.random.default_rng(2)
PLANE, SPACE = RANDOM.random((40, 2)), RANDOM.random((40, 3))
SQUARE_ROWS = np.array([[1.0, 0, -1], [-1, 0, -1], [0, 1, -1], [0, -1, -1]])


@pytest.fixture
def pandas():
    return pytest.importorskip("pandas")


def test_nothing_is_imported_before_it_is_needed():
    code = ("import sys, delone; t = delone.Delaunay([[0, 0], [1, 0], [0, 1.0]]); t._repr_html_(); t.find_simplex([[0, 0]]); "
            "print(sorted({'pandas', 'tqdm', 'meshio', 'vtkmodules', 'pyvista', 'matplotlib'} & set(sys.modules)))")
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_columns_have_names(pandas):
    frame = pandas.DataFrame(PLANE, columns=["east", "north"])
    weights = pandas.Series(RANDOM.random(40) * 0.01)
    products = [delone.Delaunay(frame), delone.Regular(frame, weights), delone.FurthestSite(frame), delone.ConvexHull(frame),
                delone.ConvexHull.of_extreme_points(frame)[0], delone.Voronoi(frame), delone.PowerDiagram(frame, weights)]
    for product in products + [pickle.loads(pickle.dumps(product)) for product in products] + [copy.copy(products[0])]:
        assert product.columns == ("east", "north")
        assert (product.points == PLANE[:product.num_points]).all() or product is not products[0]
    assert products[0].hash == delone.Delaunay(PLANE).hash
    assert delone.HalfspaceIntersection(pandas.DataFrame(SQUARE_ROWS, columns=list("abc"))).columns == ("a", "b", "c")
    assert delone.Delaunay(PLANE).columns is None and delone.Delaunay(pandas.DataFrame(PLANE)).columns is None
    assert delone.Delaunay(frame.rename(columns={"east": ("x", 1)})).columns == (("x", 1), "north")


def test_queries_are_dataframes(pandas):
    frame = pandas.DataFrame(PLANE, columns=["east", "north"])
    t, h = delone.Delaunay(frame), delone.ConvexHull(frame)
    queries = RANDOM.random((9, 2))
    for asked in (pandas.DataFrame(queries, columns=["east", "north"]), pandas.DataFrame(queries)):
        assert (t.find_simplex(asked) == t.find_simplex(queries)).all() and (t.nearest(asked)[0] == t.nearest(queries)[0]).all()
        assert (t.barycentric(asked)[0] == t.find_simplex(queries)).all() and (h.contains(asked) == h.contains(queries)).all()
        assert list(t.locate(asked)) == list(t.locate(queries)) and list(h.locate(asked)) == list(h.locate(queries))
    linear = delone.LinearInterpolator(frame, pandas.DataFrame({"v": PLANE[:, 0], "w": PLANE[:, 1]}))
    np.testing.assert_allclose(linear(frame), PLANE)
    assert delone.NaturalNeighborInterpolator(t, frame["east"])(frame).shape == (40,)
    swapped = frame[["north", "east"]]
    for wrong in (t.find_simplex, t.nearest, h.contains, linear, linear.gradient, t.insert_range, h.insert_range):
        with pytest.raises(ValueError, match="the columns 'north', 'east', not 'east', 'north', in this order"):
            wrong(swapped)
    t.insert_range(frame + 1)
    assert t.num_points == 80 and t.columns == ("east", "north")


def test_errors_name_the_column_and_the_row(pandas):
    frame = pandas.DataFrame({"depth": [1.0, 2, 3], "n": [1, 2, 2**53 + 1], "site": ["a", "b", "c"], "when": pandas.to_datetime(["2020-01-01"] * 3)},
                             index=["r1", "r2", "r3"])
    for columns, text, rows in [(["depth", "site"], "points: column 'site': row 0: 'a' is not a number", [0]),
                                (["depth", "when"], r"points: column 'when': not real numbers, but 'datetime64\[ns\]'", []),
                                (["depth", "n"], "points: column 'n': row 2: 9007199254740993 is not exact in double precision", [2])]:
        with pytest.raises(delone.InputError, match=text) as caught:
            delone.Delaunay(frame[columns])
        assert list(caught.value.rows) == rows
    frame["n"] = [1, np.nan, np.inf]
    with pytest.raises(delone.InputError, match=r"points: row 1 \(label 'r2'\), column 'n': nan is not finite \(and 1 more rows\)") as caught:
        delone.ConvexHull(frame[["depth", "n"]])
    assert caught.value.rows == [1, 2]
    t = delone.Delaunay(PLANE)
    with pytest.raises(delone.InputError, match="queries: row 1, column 1: nan is not finite"):
        t.find_simplex(pandas.DataFrame([[0.5, 0.5], [0.5, np.nan]]))
    assert np.isnan(delone.LinearInterpolator(t, pandas.DataFrame({"v": [np.nan] * 40})).values).all()  # of values NaN is one
    with pytest.raises(ValueError, match="points: an array of shape"):
        delone.Delaunay(pandas.DataFrame(index=range(3)))


def test_all_numeric_columns_are_taken(pandas):
    numbers = {"i1": np.int8([1, 2, -3]), "u8": np.uint64([1, 2, 3]), "f4": np.float32([0.5, 2, 3]), "b": [True, False, True],
               "Int": pandas.array([1, 2, 3], dtype="Int64"), "Float": pandas.array([0.25, 2, 3], dtype="Float64"), "object": np.array([1, 2.5, 3], dtype=object),
               "f8": [1.0, 2, 3], "category": pandas.Categorical([3, 1, 3])}
    frame = pandas.DataFrame(numbers)
    expected = np.stack([np.array(list(values), dtype=float) for values in numbers.values()], axis=1)
    assert (delone.Delaunay(frame).points == expected).all()
    frame["Int"] = pandas.array([1, None, 3], dtype="Int64")
    with pytest.raises(delone.InputError, match="points: row 1, column 'Int': nan is not finite"):
        delone.Delaunay(frame)


def test_values_have_the_index_of_the_points(pandas):
    frame = pandas.DataFrame(PLANE, columns=["east", "north"], index=[f"p{i}" for i in range(40)])
    values, some = frame["east"], frame[frame["north"] > 0.5]
    t, h, v = delone.Delaunay(frame), delone.ConvexHull(frame), delone.Voronoi(frame)
    for right in (values, values.to_numpy(), values.reset_index(drop=True), frame):
        delone.LinearInterpolator(frame, right), delone.NaturalNeighborInterpolator(t, right)
    for wrong in (values[::-1], values.rename(dict(p3="q"))):
        for use in (lambda: delone.LinearInterpolator(frame, wrong), lambda: delone.NaturalNeighborInterpolator(t, wrong), lambda: t.to_html(values=wrong),
                    lambda: h.to_html(values=wrong), lambda: v.to_html(values=wrong)):
            with pytest.raises(ValueError, match="values: the index is not that of the points"):
                use()
        for use in (lambda: delone.Regular(frame, wrong), lambda: delone.Regular(PLANE[:1], [0]).insert_range(frame, wrong),
                    lambda: delone.PowerDiagram(frame, wrong)):
            with pytest.raises(ValueError, match="weights: the index is not that of the points"):
                use()
    counted = frame.reset_index(drop=True)
    delone.LinearInterpolator(counted, values[::-1])  # labels against none
    for points, given in ((counted, counted["east"].sort_values()), (counted[::-1], counted["east"])):
        with pytest.raises(ValueError, match="in another order"):
            delone.LinearInterpolator(points, given)
    with pytest.raises(ValueError, match="values: 40 rows"):
        delone.LinearInterpolator(some, values)
    assert t.find_simplex(frame.iloc[0]) == t.find_simplex(PLANE[0])
    with pytest.raises(ValueError, match="queries: the columns 'north', 'east', not 'east', 'north'"):
        t.find_simplex(frame[["north", "east"]].iloc[0])
    corners, rows = delone.ConvexHull.of_extreme_points(frame)
    corners.to_html(values=values.iloc[rows])
    t.insert_range(frame + 1)
    t.to_html(values=pandas.concat([values, values]), values_at="points")


def test_data_are_copied_once_at_most(pandas):
    array = RANDOM.random((1000, 3))
    shared = pandas.DataFrame(array, copy=False)
    assert np.shares_memory(_frames.numbers(shared, "points", True), array)
    by_columns = pandas.DataFrame({name: array[:, i].copy() for i, name in enumerate("abc")})
    for frame in (pandas.DataFrame(np.asfortranarray(array)), shared[[2, 0, 1]], shared[::2], shared.iloc[:, :2], by_columns):
        result = _frames.numbers(frame, "points", True)
        assert result.flags.c_contiguous and (result == frame.to_numpy()).all()


def test_results_as_dataframes(pandas):
    t = delone.Regular(pandas.DataFrame([[0, 0], [4, 0], [0, 4], [1, 1], [4, 0]], columns=["x", "y"]), [0, 0, 0, -9, 0])
    frame = t.to_frame()
    assert list(frame.columns) == ["x", "y", "weight", "vertex", "cell"]
    assert frame["vertex"].tolist() == [0, 1, 2, -1, 1] and frame["weight"].tolist() == [0, 0, 0, -9, 0] and frame["x"].tolist() == [0, 4, 0, 1, 4]
    frame = delone.ConvexHull([[0, 0], [4, 0], [0, 4], [2, 0], [1, 1], [0, 0]]).to_frame()
    assert frame["kind"].tolist() == ["extreme"] * 3 + ["boundary", "interior", "duplicate"]
    frame = delone.HalfspaceIntersection([*SQUARE_ROWS, [1, 0, -1], [1, 0, -5], [1, 1, -2], [0, 0, -1]]).to_frame()
    assert list(frame.columns) == ["a0", "a1", "b", "kind"]
    assert frame["kind"].tolist() == ["facet"] * 4 + ["duplicate", "redundant", "touching", "trivial"]
    assert list(delone.HalfspaceIntersection(frame[["a0", "a1", "b"]]).to_frame().columns) == ["a0", "a1", "b", "kind"]
    frame = delone.Voronoi(t.points[:4]).to_frame()
    assert list(frame.columns) == ["x0", "x1", "region", "bounded"] and frame["bounded"].tolist() == [False, False, False, True]


@pytest.mark.parametrize("points", [PLANE, SPACE, PLANE[:1], [[0, 0, 0], [1, 1, 1]], np.empty((0, 2)), np.c_[PLANE, np.ones(40)]])
def test_meshio_takes_simplices(points):
    pytest.importorskip("meshio")
    for product in (delone.Delaunay(points), delone.ConvexHull(points)):
        height = np.arange(product.num_points)
        mesh = product.to_meshio(point_data={"height": height}, cell_data={"number": np.arange(product.num_cells)})
        assert (mesh.points == product.points).all() and (mesh.point_data["height"] == height).all()
        assert sum(len(block.data) for block in mesh.cells) == product.num_cells
        if product.num_cells:
            block, = mesh.cells
            assert block.type == ["vertex", "line", "triangle", "tetra"][product.cells.shape[1] - 1] and (block.data == product.cells).all()
            assert (mesh.cell_data["number"][0] == np.arange(product.num_cells)).all()


def written(mesh, extension, folder, file_format=None):
    path = folder / ("mesh" + extension)
    mesh.write(path, file_format)
    return sys.modules["meshio"].read(path)


def test_meshio_writes_what_it_is_given(tmp_path):
    pytest.importorskip("meshio")
    t = delone.Delaunay(SPACE)
    again = written(t.to_meshio(cell_data={"volume": np.arange(len(t)) * 0.5}), ".vtu", tmp_path)
    assert (again.cells[0].data == t.cells).all() and again.cell_data["volume"][0][-1] == (len(t) - 1) / 2
    v = delone.Voronoi(SPACE)
    again = written(v.to_meshio(cell_data={"size": v.region_volumes()}), ".vtu", tmp_path)
    assert sum(len(block.data) for block in again.cells) == v.is_bounded.sum()


@pytest.mark.parametrize("product", [delone.Delaunay(PLANE), delone.ConvexHull(PLANE), delone.Delaunay(SPACE), delone.ConvexHull(SPACE)])
def test_meshio_writes_for_gmsh(tmp_path, product):
    pytest.importorskip("meshio")
    again = written(product.to_meshio(), ".msh", tmp_path, "gmsh22")
    assert (again.points[:, :product.dimension] == product.points).all() and (again.cells[0].data == product.cells).all()


@pytest.mark.parametrize("product", [delone.Delaunay(PLANE), delone.ConvexHull(SPACE)])
def test_meshio_writes_surfaces(tmp_path, product):
    pytest.importorskip("meshio")
    again = written(product.to_meshio(), ".stl", tmp_path)
    corners = again.points[again.cells[0].data]
    assert len(corners) == product.num_cells
    if product.dimension == 3:  # the divergence theorem: triangles are counterclockwise seen from outside
        assert np.linalg.det(corners.astype(float)).sum() / 6 == pytest.approx(product.volume, rel=1e-5)
    mesh = product.to_meshio()
    if product.dimension == 2:  # the writer of OBJ needs three coordinates
        mesh.points = np.c_[mesh.points, np.zeros(len(mesh.points))]
    again = written(mesh, ".obj", tmp_path)
    assert np.allclose(again.points, mesh.points) and (again.cells[0].data == product.cells).all()


def test_meshio_takes_regions():
    pytest.importorskip("meshio")
    v = delone.Voronoi(PLANE)
    mesh = v.to_meshio(cell_data={"x": PLANE[:, 0]})
    sites = np.concatenate(mesh.cell_data["point"])
    assert (v.region_points[np.concatenate(mesh.cell_data["region"])] == sites).all()
    assert sorted(sites) == v.region_points[v.is_bounded].tolist() and {block.type for block in mesh.cells} == {"polygon"}
    assert (np.concatenate(mesh.cell_data["x"]) == PLANE[sites, 0]).all()
    for block, rows in zip(mesh.cells, mesh.cell_data["point"]):
        for polygon, row in zip(block.data, rows):
            assert polygon.tolist() == v.region(v.point_region[row]).tolist()
    v = delone.Voronoi(SPACE)
    for block, rows in zip(v.to_meshio().cells, v.to_meshio().cell_data["point"]):
        for faces, row in zip(block.data, rows):
            assert set(np.concatenate(faces)) == set(v.region(v.point_region[row]))
    empty = delone.Voronoi(PLANE[:3]).to_meshio()
    assert empty.cells == []


def test_meshio_takes_intersections():
    pytest.importorskip("meshio")
    square = delone.HalfspaceIntersection(SQUARE_ROWS).to_meshio(cell_data={"side": [7, 8, 9, 10]})
    assert square.cells[0].type == "line" and square.cell_data["side"][0].tolist() == [7, 8, 9, 10]
    cube = delone.HalfspaceIntersection(np.c_[np.r_[np.eye(3), -np.eye(3)], -np.ones(6)])
    block, = cube.to_meshio().cells
    assert block.type == "polygon" and block.data.shape == (6, 4) and sorted(np.ravel(block.data)) == sorted(list(range(8)) * 3)


def test_pyvista_wraps_what_vtk_has(monkeypatch):
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    monkeypatch.setitem(sys.modules, "pyvista", type(sys)("pyvista"))
    sys.modules["pyvista"].wrap = lambda grid: ("wrapped", grid.GetNumberOfCells())
    t = delone.Delaunay(SPACE)
    assert t.to_pyvista() == ("wrapped", len(t))


@pytest.mark.parametrize("call, text", [
    (lambda: delone.Delaunay(RANDOM.random((9, 4))).to_meshio(), "dimension is 4: meshes have at most 3"),
    (lambda: delone.Voronoi([[0, 0], [1, 1]]).to_meshio(), "affine_dimension is 1"),
    (lambda: delone.HalfspaceIntersection(SQUARE_ROWS[:2]).to_meshio(), "meshes have bounded intersections only"),
    (lambda: delone.Delaunay(PLANE).to_meshio(point_data={"a": [1, 2]}),
     r"point_data\['a'\]: one entry for each of the points \(40\), not an array of shape \(2,\)"),
    (lambda: delone.ConvexHull(PLANE).to_meshio(cell_data={"a": ["x"] * 3}), r"cell_data\['a'\]: numbers, not <U1")])
def test_meshes_refuse_what_they_cannot_have(call, text):
    with pytest.raises(ValueError, match=text):
        call()


def test_vtk_takes_everything():
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    for product, kind in ((delone.Delaunay(SPACE), 10), (delone.Delaunay(PLANE), 5), (delone.ConvexHull(SPACE), 5), (delone.ConvexHull(PLANE), 3)):
        grid = product.to_vtk(point_data={"p": product.points}, cell_data={"odd": np.arange(product.num_cells) % 2 == 1})
        assert (grid.GetNumberOfPoints(), grid.GetNumberOfCells(), grid.GetCellType(0)) == (40, product.num_cells, kind)
        assert (vtk_to_numpy(grid.GetPoints().GetData())[:, :product.dimension] == product.points).all()
        assert (vtk_to_numpy(grid.GetCells().GetConnectivityArray()) == product.cells.ravel()).all()
        assert (vtk_to_numpy(grid.GetPointData().GetArray("p")) == product.points).all()
        for given in (np.arange(40, dtype=">f8"), np.arange(40, dtype=np.float16), np.arange(40, dtype=np.longdouble)):
            assert (vtk_to_numpy(product.to_vtk(point_data={"p": given}).GetPointData().GetArray("p")) == np.arange(40)).all()
        masked = product.to_vtk(point_data={"p": np.ma.masked_equal(np.arange(40), 7)}).GetPointData().GetArray("p")
        assert np.flatnonzero(np.isnan(vtk_to_numpy(masked))).tolist() == [7]
        assert vtk_to_numpy(grid.GetCellData().GetArray("odd")).tolist() == [i % 2 for i in range(product.num_cells)]


def volume_within(faces):
    """Of a convex polyhedron, whose faces are polygons: pyramids over fans of triangles."""
    apex = np.mean([face[0] for face in faces], axis=0)
    return sum(abs(np.linalg.det([face[0] - apex, face[i] - apex, face[i + 1] - apex])) / 6 for face in faces for i in range(1, len(face) - 1))


def test_vtk_has_the_volumes_of_regions():
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    for points in (SPACE, PLANE):
        v = delone.Voronoi(points)
        grid = v.to_vtk()
        sites = vtk_to_numpy(grid.GetCellData().GetArray("point"))
        assert sorted(sites) == v.region_points[v.is_bounded].tolist()
        for i, volume in enumerate(v.region_volumes()[v.point_region[sites]]):
            cell = grid.GetCell(i)
            if points is PLANE:
                x, y, _ = vtk_to_numpy(cell.GetPoints().GetData()).T
                assert (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2 == pytest.approx(volume)  # counterclockwise
            else:
                faces = [vtk_to_numpy(cell.GetFace(j).GetPoints().GetData()).copy() for j in range(cell.GetNumberOfFaces())]
                assert volume_within(faces) == pytest.approx(volume)


@pytest.mark.parametrize("name, missing, text", [("to_meshio", "meshio", "pip install meshio"), ("to_vtk", "vtkmodules.util.numpy_support", "pip install vtk"),
                                                 ("to_pyvista", "pyvista", "pip install pyvista"), ("to_frame", "pandas", "pip install pandas")])
def test_it_is_said_what_to_install(monkeypatch, name, missing, text):
    monkeypatch.setitem(sys.modules, missing, None)
    with pytest.raises(ImportError, match=text):
        getattr(delone.Delaunay(PLANE), name)()


@pytest.mark.parametrize("is_there", [True, False])
def test_progress_is_a_bar(monkeypatch, is_there):
    if is_there:
        pytest.importorskip("tqdm")
    else:
        monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    stderr = io.StringIO()
    monkeypatch.setattr(sys, "stderr", stderr)
    t = delone.Delaunay(RANDOM.random((5000, 3)), progress=True)
    assert "  0%|" in stderr.getvalue() and "100%|" in stderr.getvalue()
    for call in (lambda: t.insert_range([[2, 2, 2]], progress=True), lambda: delone.ConvexHull(SPACE, progress=True),
                 lambda: delone.convex_hulls([SPACE], progress=True), lambda: delone.HalfspaceIntersection(SQUARE_ROWS, progress=True)):
        stderr.seek(0), stderr.truncate()
        call()
        assert "100%|" in stderr.getvalue()
    stderr.seek(0), stderr.truncate()
    with pytest.raises(delone.InputError):
        delone.Delaunay([[np.nan, 1]], progress=True)
    assert "100%" not in stderr.getvalue()
    delone.Delaunay(SPACE, progress=False)
    with pytest.raises(TypeError, match="progress: True, a function of the fraction done, or None, not int"):
        delone.Delaunay(SPACE, progress=1)
