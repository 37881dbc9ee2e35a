# SPDX-License-Identifier: BSD-3-Clause
"""Is what a program returns a Delaunay triangulation? Its cells are written in one more run and judged by `delone check`, exactly; any
choice among ties is accepted."""
import re
import subprocess

import numpy as np

from . import runner

FAILED = re.compile(r"^level (\d)\s+(.*?)\s+FAILED", re.M)
VIOLATION = re.compile(r"^violation: (.*)$", re.M)
CHECK_SECONDS = 120


def judge(points, cells, delone, folder):
    """{"accepted": …, "level": …, "violation": …} for cells of rows of points."""
    path = folder / "judged.npz"
    np.savez(path, points=points, cells=cells, affine_dimension=np.int64(cells.shape[1] - 1))
    try:
        done = subprocess.run([delone, "check", "--any-orientation", str(path)], capture_output=True, text=True, timeout=CHECK_SECONDS)
    except subprocess.TimeoutExpired:
        return {"accepted": None, "level": "not decided", "violation": f"not decided in {CHECK_SECONDS} s"}
    failed, violation = FAILED.search(done.stdout), VIOLATION.search(done.stdout)
    if done.returncode == 0:
        return {"accepted": True, "level": "", "violation": ""}
    message = violation[1] if violation else (done.stderr.strip().splitlines() or ["?"])[-1].rsplit(f"{path}: ", 1)[-1]
    return {"accepted": False, "level": failed[2] if failed else "storage", "violation": message[:200]}


def verdicts(case, records, programs, build, delone, limits, folder):
    """Adds record["verdict"] to the records of a case whose program gave a result."""
    path, cells_path = folder / "points.npy", folder / "cells.npy"
    points = np.load(path)
    for record in records:
        if record["outcome"] != "ok":
            continue
        command = programs[record["program"]].command_line(build, path, case.dimension)
        outcome, result = runner.run_limited([*command, "--cells", str(cells_path)], limits.of(record["program"]), limits.memory_bytes)
        if outcome != "ok":
            level = "not simplices" if "no simplex" in result else outcome
            record["verdict"] = {"accepted": None, "level": level, "violation": result}
            continue
        record["verdict"] = judge(points, np.load(cells_path), delone, folder)
