# SPDX-License-Identifier: BSD-3-Clause
"""What an ordinary user may not write: an error that names the path, and nothing left behind. Nothing is refused to root."""
import os
import subprocess
import sys
import tempfile

import pytest

AS_SOMEBODY_ELSE = """
import os, sys
import numpy as np
import delone, delone.tiles

locked = sys.argv[1]
points = np.random.default_rng(0).random((30, 2))
triangulation = delone.Delaunay(points)
file = os.path.join(locked, "out")
writers = [lambda: triangulation.save(file + ".npz"), lambda: triangulation.save(file + ".vtu"), lambda: triangulation.save(file, qhull="o"),
           lambda: triangulation.to_data().save(file + ".json"), lambda: triangulation.to_html(file + ".html"),
           lambda: delone.ConvexHull(points).save(file + ".off"), lambda: delone.Voronoi(triangulation).save(file + ".npz"),
           lambda: delone.tiles.make_tiles(points, file), lambda: delone.tiles.make_tiles(points, locked)]
for number, write in enumerate(writers):
    try:
        write()
    except delone.Error as error:
        assert str(error).startswith(locked) and str(error).endswith("Permission denied"), (number, str(error))
    else:
        raise AssertionError(number)
    assert not os.listdir(locked), number
"""


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
def test_a_folder_of_somebody_else():
    nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
    with tempfile.TemporaryDirectory() as folder:  # those of pytest are private
        os.chmod(folder, 0o755)
        locked = os.path.join(folder, "locked")
        os.mkdir(locked)
        os.chmod(locked, 0o555)
        program = [sys.executable, "-c", AS_SOMEBODY_ELSE, locked]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), "PYTHONDONTWRITEBYTECODE": "1"}
        try:
            subprocess.run([sys.executable, "-c", "import delone"], env=environment, check=True, capture_output=True, timeout=120, **nobody)
        except (OSError, subprocess.SubprocessError) as error:
            pytest.skip(f"another user cannot run this Python: {error}")
        done = subprocess.run(program, env=environment, capture_output=True, text=True, timeout=120, **nobody)
        assert done.returncode == 0, done.stderr
