# SPDX-License-Identifier: BSD-3-Clause
"""delone.patch_scipy, and the names of scipy.spatial that delone.spatial passes on."""
import importlib
import pickle
import subprocess
import sys

import numpy as np
import pytest

import delone
from delone import interpolate, spatial

PLANE = np.array([[0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1], [0.3, 0.4, 1]])


@pytest.fixture
def scipy_spatial():
    module = pytest.importorskip("scipy.spatial")
    yield module
    delone.unpatch_scipy()


def test_patching_replaces_and_restores(scipy_spatial):
    import scipy.interpolate
    names, others = ["ConvexHull", "Delaunay", "HalfspaceIntersection", "Voronoi", "tsearch"], dict(vars(scipy_spatial))
    cubic, own_error = scipy.interpolate.CloughTocher2DInterpolator, spatial.QhullError
    assert not delone.scipy_is_patched()
    delone.patch_scipy()
    delone.patch_scipy()
    assert delone.scipy_is_patched()
    for name in names:
        assert getattr(scipy_spatial, name) is getattr(spatial, name)
    assert scipy.interpolate.griddata is interpolate.griddata and scipy_spatial.KDTree is others["KDTree"]
    assert spatial.QhullError is scipy_spatial.QhullError is others["QhullError"]
    with pytest.raises(scipy_spatial.QhullError):
        scipy_spatial.Delaunay(PLANE)
    delone.unpatch_scipy()
    delone.unpatch_scipy()
    assert {name: getattr(scipy_spatial, name) for name in names} == {name: others[name] for name in names}
    assert scipy.interpolate.CloughTocher2DInterpolator is cubic and spatial.QhullError is own_error
    assert not delone.scipy_is_patched()


def test_a_block_takes_back_what_it_has_replaced(scipy_spatial):
    original = scipy_spatial.Delaunay
    with delone.patch_scipy("ConvexHull"):
        assert scipy_spatial.ConvexHull is spatial.ConvexHull and scipy_spatial.Delaunay is original
        with delone.patch_scipy(["Delaunay", "ConvexHull"]) as patched:
            assert scipy_spatial.Delaunay is spatial.Delaunay and "Delaunay" in repr(patched)
        assert scipy_spatial.Delaunay is original and scipy_spatial.ConvexHull is spatial.ConvexHull
    assert scipy_spatial.ConvexHull is not spatial.ConvexHull and not delone.scipy_is_patched()
    with pytest.raises(ZeroDivisionError), delone.patch_scipy():
        1 / 0
    assert scipy_spatial.Delaunay is original
    with pytest.raises(ValueError, match="'KDTree' is not replaced"):
        delone.patch_scipy(["KDTree"])


def places():
    """(module, name) of all that can be replaced in the modules behind scipy.spatial and scipy.interpolate."""
    found = []
    for module, names in [
            ("scipy.spatial._qhull", "ConvexHull Delaunay HalfspaceIntersection Voronoi tsearch"), ("scipy.spatial._plotutils", "voronoi_plot_2d"),
            ("scipy.spatial.qhull", "ConvexHull Delaunay HalfspaceIntersection Voronoi"),
            ("scipy.interpolate._interpnd", "LinearNDInterpolator CloughTocher2DInterpolator"),
            ("scipy.interpolate.interpnd", "LinearNDInterpolator CloughTocher2DInterpolator"),
            ("scipy.interpolate._ndgriddata", "LinearNDInterpolator NearestNDInterpolator griddata"),
            ("scipy.interpolate.ndgriddata", "LinearNDInterpolator NearestNDInterpolator griddata")]:
        try:
            found += [(importlib.import_module(module), name) for name in names.split()]
        except ImportError:  # not in this version
            continue
    return found


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_the_modules_behind_are_patched_too(scipy_spatial):
    before = [getattr(*place) for place in places()]
    held = [dict(vars(module)) for module, _ in places()]
    assert any(module.__name__ == "scipy.spatial._qhull" for module, _ in places())
    delone.patch_scipy()
    for module, name in places():
        ours = spatial if ".spatial" in module.__name__ else interpolate
        assert getattr(module, name) is getattr(ours, name), (module, name)
    delone.unpatch_scipy()
    assert [getattr(*place) for place in places()] == before
    for (module, _), names in zip(places(), held):
        assert {name: value for name, value in vars(module).items() if name in names} == names
    with delone.patch_scipy("Voronoi"):
        assert scipy_spatial._qhull.Voronoi is spatial.Voronoi and scipy_spatial._qhull.Delaunay is not spatial.Delaunay


def test_what_was_imported_before_goes_on_with_qhull(scipy_spatial):
    import scipy.interpolate
    linear, cubic, triangulation = (scipy.interpolate.LinearNDInterpolator, scipy.interpolate.CloughTocher2DInterpolator, scipy_spatial.Delaunay)
    points = np.random.default_rng(1).random((30, 2))
    made = triangulation(points)
    expected = [kind(made, points[:, 0])(points[:5] * 0.9) for kind in (linear, cubic)]
    for names in (None, "griddata", "Delaunay"):
        with delone.patch_scipy(names):
            for kind, values in zip((linear, cubic), expected):
                np.testing.assert_array_equal(kind(made, points[:, 0])(points[:5] * 0.9), values)
                assert type(kind(points, points[:, 0]).tri) is triangulation
            assert triangulation(points).simplices.shape == made.simplices.shape
    assert delone.patch_scipy("Delaunay") and delone.patch_scipy()  # one after the other
    assert type(linear(points, points[:, 0]).tri) is triangulation


def test_pickles_of_scipy_are_not_taken_for_ours(scipy_spatial):
    import scipy.interpolate
    points = np.random.default_rng(1).random((30, 2))
    pickles = [pickle.dumps(kind(points)) for kind in (scipy_spatial.Delaunay, scipy_spatial.ConvexHull, scipy_spatial.Voronoi)]
    pickles.append(pickle.dumps(scipy.interpolate.LinearNDInterpolator(points, points[:, 0], rescale=True)))
    pickles.append(pickle.dumps(scipy.interpolate.NearestNDInterpolator(points, points[:, 0])))
    with delone.patch_scipy():
        for each in pickles:
            with pytest.raises(TypeError, match="a pickle of scipy's class: load it before patch_scipy"):
                pickle.loads(each)
    for each in pickles:
        assert type(pickle.loads(each)).__module__.startswith("scipy")


def test_scipy_works_while_it_is_patched(scipy_spatial):
    import scipy.interpolate
    random = np.random.default_rng(1)
    sphere = random.standard_normal((40, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    points, queries = random.random((30, 2)), random.random((9, 2))
    before = scipy.interpolate.LinearNDInterpolator
    expected = before(points, points[:, 0])(queries)
    areas = scipy_spatial.SphericalVoronoi(sphere).calculate_areas()
    with delone.patch_scipy():
        np.testing.assert_allclose(scipy_spatial.SphericalVoronoi(sphere).calculate_areas(), areas, rtol=1e-9)
        np.testing.assert_allclose(before(points, points[:, 0])(queries), expected, rtol=1e-9)
        np.testing.assert_allclose(scipy.interpolate.LinearNDInterpolator(points, points[:, 0])(queries), expected, rtol=1e-9)


def test_the_command_runs_programs_patched(scipy_spatial, tmp_path):
    program = tmp_path / "program.py"
    program.write_text("import sys\nfrom scipy.spatial import Delaunay\nimport beside\nprint(Delaunay.__module__, sys.argv[1:], __name__)\n")
    (tmp_path / "beside.py").write_text("")
    done = subprocess.run([sys.executable, "-m", "delone", str(program), "-x"], capture_output=True, text=True, check=True)
    assert done.stdout == "delone.spatial._delaunay ['-x'] __main__\n"
    done = subprocess.run([sys.executable, "-m", "delone", "-m", "program", "y"], capture_output=True, text=True, check=True, cwd=tmp_path)
    assert done.stdout == "delone.spatial._delaunay ['y'] __main__\n"
    done = subprocess.run([sys.executable, "-m", "delone"], capture_output=True, text=True)
    assert done.returncode == 1 and "python -m delone program.py" in done.stderr
    done = subprocess.run([sys.executable, "-m", "delone", "--verson"], capture_output=True, text=True)
    assert done.returncode == 1 and "there is no option --verson" in done.stderr
    done = subprocess.run([sys.executable, "-m", "delone", "--version"], capture_output=True, text=True, check=True)
    assert done.stdout == f"delone {delone.__version__}\n"


def test_other_names_are_those_of_scipy(scipy_spatial):
    from delone.spatial import Delaunay, KDTree, Rectangle, SphericalVoronoi, cKDTree, distance  # noqa: F401
    assert Delaunay is spatial.Delaunay and cKDTree is scipy_spatial.cKDTree and distance is scipy_spatial.distance
    for name in set(scipy_spatial.__all__) - {"qhull", *spatial.__all__}:
        assert getattr(spatial, name) is getattr(scipy_spatial, name), name
    assert {"KDTree", "distance", "ConvexHull", "transform"} <= set(dir(spatial))
    code = ("from delone.spatial.distance import pdist; import delone.spatial.transform, scipy.spatial; "
            "print(delone.spatial.transform is scipy.spatial.transform, pdist is scipy.spatial.distance.pdist)")
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "True True\n"


def test_names_that_nobody_has_are_attribute_errors():
    for name in ("Delaunayy", "_qhull", "qhull", "__wrapped__"):
        with pytest.raises(AttributeError, match=f"module 'delone.spatial' has no attribute '{name}'"):
            getattr(spatial, name)


def test_without_scipy_its_names_are_import_errors():
    code = """
import sys
sys.modules["scipy"] = None
import delone, delone.spatial as s
for get in (lambda: s.cKDTree, delone.patch_scipy):
    try:
        get()
    except ImportError as error:
        print(str(error)[:49])
print(hasattr(s, "unknown"), hasattr(s, "Delaunay"), delone.scipy_is_patched())
"""
    lines = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.splitlines()
    assert lines[0] == "delone.spatial.cKDTree is that of scipy.spatial, " and "scipy" in lines[1]
    assert lines[2] == "False True False"
