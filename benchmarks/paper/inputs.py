# SPDX-License-Identifier: BSD-3-Clause
"""The inputs: sets of points that the command generates, and the real ones of data/, as .npy files."""
import pathlib
import subprocess

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]

# name -> (file of data/, columns)
REAL = {
    "earthquakes": ("earthquakes.csv", ("longitude", "latitude", "depth_km")),
    "protein": ("protein.csv", ("x", "y", "z")),
    "cars": ("cars.csv", ("Miles_per_Gallon", "Displacement", "Horsepower", "Weight_in_lbs", "Acceleration")),
}
SEED = 1


def read_real(name):
    """The chosen columns of a file of data/, an (n, d) array."""
    file, columns = REAL[name]
    with open(ROOT / "data" / file, encoding="utf-8") as stream:
        header = stream.readline().strip().split(",")
        table = np.loadtxt(stream, delimiter=",", ndmin=2)
    return np.ascontiguousarray(table[:, [header.index(column) for column in columns]])


def write(kind, dimension, points, path, delone):
    """Writes the named set to an .npy file and returns how many points it has; the kind "real:NAME" is a file of data/."""
    if kind.startswith("real:"):
        array = read_real(kind.removeprefix("real:"))
        np.save(path, array)
        return len(array)
    subprocess.run([delone, "generate", kind, "-d", str(dimension), "-n", str(points), "--seed", str(SEED), "-o", str(path)], check=True,
                   capture_output=True)
    return len(np.load(path, mmap_mode="r"))
