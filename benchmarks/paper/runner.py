# SPDX-License-Identifier: BSD-3-Clause
"""Runs programs in turn on the same input, each in a process of its own with a limit of time and of memory.

A record is what one program did on one input: experiment, kind, dimension, points, program, outcome ("ok", "failed", "too slow", "too
large", "not tried"), message, and, when ok, the report of the adapter with one entry of seconds and cpu_seconds for each round.
"""
import dataclasses
import json
import math
import pathlib
import resource
import signal
import statistics
import subprocess
import tempfile
import time

from . import estimates, fit, inputs

POLL_SECONDS = 0.05
WALL_FACTOR = 30  # a process may take so many times its processor time by the clock: others may use the machine
ENUMERATORS = ("cddlib", "cddlib_gmp", "lrs", "hull_cddlib", "hull_cddlib_gmp", "hull_lrs")


@dataclasses.dataclass(frozen=True)
class Limits:
    seconds: float             # processor time of one process of a peer
    own_seconds: float         # of one of delone, whose figures go further than those of its peers
    enumerator_seconds: float  # of one that enumerates facets, and soon takes very long
    memory_bytes: float        # of one process
    rounds: int                # at most
    turn_seconds: float        # a program that has taken so much on an input has no further turn

    def of(self, program):
        """The processor time that one process of a program may take."""
        if program.removeprefix("hull_").startswith("delone"):
            return self.own_seconds
        return self.enumerator_seconds if program in ENUMERATORS else self.seconds


def resident_bytes(pid):
    try:
        return int(pathlib.Path(f"/proc/{pid}/statm").read_text().split()[1]) * resource.getpagesize()
    except (OSError, IndexError, ValueError):
        return 0


def cpu_seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run_limited(command, seconds, memory_bytes):
    """(outcome, report or message) of one process."""
    allowed = max(1, math.ceil(seconds))

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (allowed, allowed + 1))  # of every process that it starts, too
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        start = time.monotonic()
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=err, text=True, preexec_fn=limit)
        except OSError as error:
            return "failed", str(error)
        try:
            while True:
                try:
                    process.wait(POLL_SECONDS)
                    break
                except subprocess.TimeoutExpired:
                    pass
                if time.monotonic() - start > WALL_FACTOR * seconds:
                    return "too slow", f"more than {WALL_FACTOR * seconds:g} s by the clock"
                if resident_bytes(process.pid) > memory_bytes:
                    return "too large", f"more than {memory_bytes / 1e9:.1f} GB"
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()
        out.seek(0)
        err.seek(0)
        if process.returncode == 0:
            return "ok", json.loads(out.read().strip().splitlines()[-1])
        if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return "too slow", f"more than {allowed} s"
        lines = [line for line in err.read().splitlines() if line.strip()]
        ended = f"signal {-process.returncode}" if process.returncode < 0 else f"status {process.returncode}"
        return "failed", lines[-1].split(": ", 1)[-1][:300] if lines else f"ended with {ended}"


def repeats(program, points, dimension):
    """How often one process constructs: several times if one construction takes about a millisecond."""
    if program in ENUMERATORS:
        return 1
    return 5 if points <= 2000 and dimension <= 3 else 3 if points <= 1000 and dimension <= 4 else 1


class Runner:
    def __init__(self, programs, build, delone, limits, folder, say=print):
        self.programs, self.build, self.delone, self.limits = programs, build, delone, limits
        self.folder = pathlib.Path(folder)
        self.say = say
        self.history = {}  # (experiment, kind, dimension, program) -> [(points, cpu seconds, peak bytes)], or the reason it stopped

    def measure(self, case):
        """The records of a case, one for each of its programs that is installed."""
        path = self.folder / "points.npy"
        points = inputs.write(case.kind, case.dimension, case.points, path, self.delone)
        records = {}
        for key in case.programs:
            program = self.programs.get(key)
            command = program and program.command_line(self.build, path, case.dimension)
            if not command:
                continue
            records[key] = {"experiment": case.experiment, "kind": case.kind, "dimension": case.dimension, "points": points,
                            "program": key, "name": program.name, "outcome": "ok", "seconds": [], "cpu_seconds": [], "turn_seconds": []}
            records[key]["command"] = command + ["--repeat", str(repeats(key, points, case.dimension))]
            reason = self.reason_to_skip(case, key, points)
            if reason:
                records[key].update(outcome="not tried", message=reason)
        for _ in range(self.limits.rounds):
            for record in records.values():
                if record["outcome"] == "ok" and sum(record["turn_seconds"]) <= self.limits.turn_seconds:
                    self.run_once(record)
        for key, record in records.items():
            record.pop("command")
            self.remember(case, key, record)
            self.say(line(record))
        return list(records.values())

    def run_once(self, record):
        start = cpu_seconds_of_children()
        outcome, result = run_limited(record["command"], self.limits.of(record["program"]), self.limits.memory_bytes)
        record["turn_seconds"].append(round(cpu_seconds_of_children() - start, 3))
        if outcome != "ok":
            record.update(outcome=outcome, message=result)
            return
        record["seconds"].append(statistics.median(result.pop("seconds")))
        record["cpu_seconds"].append(statistics.median(result.pop("cpu_seconds")))
        result["peak_bytes"] = max(result["peak_bytes"], record.get("peak_bytes", 0))
        for name in ("points", "dimension", "program"):
            result.pop(name, None)
        record.update(result)

    def reason_to_skip(self, case, key, points):
        """Why a larger input of a series is not tried: the program stopped at a smaller one, or is expected to."""
        history = self.history.get((*case.series(), key), [])
        if isinstance(history, str):
            return history
        seconds = fit.extrapolate([(n, s) for n, s, _ in history], points)
        memory = fit.extrapolate([(n, m) for n, _, m in history], points)
        if seconds and seconds > self.limits.of(key):
            return f"would take about {seconds:.0f} s"
        if memory and memory > self.limits.memory_bytes:
            return f"would take about {memory / 1e9:.0f} GB"
        return None

    def expected_seconds(self, case):
        """The time that a case will take, from the smaller inputs of its series, or from estimates.py if there are none."""
        total = 0.0
        for key in case.programs:
            program = self.programs.get(key)
            if not program or not program.command_line(self.build, "points.npy", case.dimension) or self.reason_to_skip(case, key, case.points):
                continue
            seconds = fit.extrapolate([(n, s) for n, s, _ in self.history.get((*case.series(), key), [])], case.points)
            if seconds is None:
                seconds = estimates.construction_seconds(case.experiment, key, case.dimension, case.points)
            total += estimates.process_seconds(key, min(seconds, self.limits.of(key)), self.limits)
        return total

    def remember(self, case, key, record):
        series = (*case.series(), key)
        if record["outcome"] != "ok":
            self.history[series] = record["message"]
        elif not isinstance(self.history.get(series), str):
            self.history.setdefault(series, []).append((record["points"], median(record, "cpu_seconds"), record["peak_bytes"]))


def median(record, what):
    return statistics.median(record[what])


def line(record):
    """One line about a record, to print while measuring."""
    head = f"{record['experiment']:<12}{record['kind']:<14}{record['dimension']}D {record['points']:>8}  {record['program']:<16}"
    if record["outcome"] != "ok":
        return f"{head}{record['outcome']}: {record['message']}"
    return (f"{head}{median(record, 'cpu_seconds'):>10.4f} s cpu{median(record, 'seconds'):>10.4f} s wall"
            f"{record['peak_bytes'] / 1e6:>9.1f} MB{record['cells']:>10} cells")
