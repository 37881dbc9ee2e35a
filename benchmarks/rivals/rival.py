# SPDX-License-Identifier: BSD-3-Clause
"""The interface of rival.hpp for adapters in Python: peers that are Python modules, or commands run in a process of their own."""
import argparse
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time

import numpy as np


class Refused(Exception):
    """The peer gave up, or refuses the input."""


def peak_bytes(pid="self"):
    """The largest resident size of a process so far; 0 if it is gone."""
    try:
        return int(re.search(r"VmHWM:\s*(\d+)", pathlib.Path(f"/proc/{pid}/status").read_text())[1]) * 1024
    except (OSError, TypeError):
        return 0


def cpu_seconds(who=resource.RUSAGE_SELF):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def parser(description):
    made = argparse.ArgumentParser(description=description)
    made.add_argument("points")
    made.add_argument("--repeat", type=int, default=1)
    made.add_argument("--cells")
    return made


def run_command(command, stdout, environment=None):
    """Runs a command to its end; (seconds, cpu seconds, peak bytes) of its process. Raises Refused if it fails."""
    start, cpu, peak = time.perf_counter(), cpu_seconds(resource.RUSAGE_CHILDREN), 0
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=stdout, stderr=subprocess.PIPE, text=True, env=environment)
    try:
        while True:
            peak = max(peak, peak_bytes(process.pid))
            try:
                _, messages = process.communicate(timeout=0.002 if peak < 1 << 26 else 0.05)
                break
            except subprocess.TimeoutExpired:
                pass
    finally:
        if process.poll() is None:
            process.kill()
    seconds = time.perf_counter() - start
    if process.returncode == -signal.SIGXCPU:  # over a limit that was set for both: end as it did
        os.kill(os.getpid(), signal.SIGKILL)
    if process.returncode != 0:
        last = [line for line in messages.splitlines() if line.strip()][-1:]
        raise Refused(last[0] if last else f"{os.path.basename(command[0])} ended with status {process.returncode}")
    return seconds, cpu_seconds(resource.RUSAGE_CHILDREN) - cpu, peak


def main(adapter, arguments):
    """Runs an adapter made from (points, arguments): program(), construct() → None or (seconds, cpu seconds, peak bytes) of the process
    that did it, num_cells(), cells() → (m, k) array. Prints the report; ends the process with status 2 where the peer gives up."""
    try:
        points = np.load(arguments.points)
        made = adapter(points, arguments)
        report = {"points": len(points), "dimension": points.shape[1], "input_bytes": peak_bytes(), "seconds": [], "cpu_seconds": []}
        peak = 0
        for _ in range(arguments.repeat):
            start, cpu = time.perf_counter(), cpu_seconds()
            other = made.construct()
            own = (time.perf_counter() - start, cpu_seconds() - cpu, peak_bytes())
            seconds, cpu, used = other or own
            report["seconds"].append(seconds)
            report["cpu_seconds"].append(cpu)
            peak = max(peak, used)
        report.update(made.program(), cells=made.num_cells(), peak_bytes=peak)
        if arguments.cells:
            with open(arguments.cells, "wb") as out:
                np.save(out, np.ascontiguousarray(made.cells(), dtype=np.int64))
        print(json.dumps(report))
    except (Refused, ValueError, OSError) as error:
        print(f"{sys.argv[0]}: {' '.join(str(error).split())[:300]}", file=sys.stderr)
        sys.exit(2)


def lifted_fractions(points):
    """The points (x, |x|²) as exact fractions, one list of strings "p/q" for each point."""
    from fractions import Fraction

    rows = []
    for point in points:
        exact = [Fraction(float(x)) for x in point]
        rows.append([str(x) for x in (*exact, sum(x * x for x in exact))])
    return rows


def temporary_folder():
    return tempfile.TemporaryDirectory(prefix="rival-")
