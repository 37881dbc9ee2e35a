# SPDX-License-Identifier: BSD-3-Clause
"""Records of measurements, benchmarks/history/DATE-COMMIT-KIND.json, with their machine and build."""
import datetime
import json
import os
import pathlib
import platform
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
HISTORY = ROOT / "benchmarks" / "history"


class NoRecord(Exception):
    """There is no record of the kind."""


def machine():
    try:
        lines = open("/proc/cpuinfo", encoding="utf-8").read().splitlines()
        model = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
        processors = sum(line.startswith("processor") for line in lines)
    except (OSError, StopIteration):
        model, processors = platform.processor(), 0
    return f"{model}, {processors} processors, {platform.system()} {platform.machine()}"


def build_folder(program):
    """The build that a program is from: the nearest folder above it that has a CMake cache, or None."""
    path = pathlib.Path(program).resolve()
    return next((folder for folder in path.parents if (folder / "CMakeCache.txt").exists()), None)


def cache_entry(folder, name):
    """A variable of the CMake cache of a build."""
    for line in (folder / "CMakeCache.txt").read_text().splitlines() if folder else []:
        if line.startswith(name + ":"):
            return line.split("=", 1)[1]
    return "unknown"


def describe(program):
    """What a record holds besides its results. "load" is the load average of the last five minutes."""
    folder = build_folder(program)
    compiler = cache_entry(folder, "CMAKE_CXX_COMPILER")
    version = "unknown"
    if compiler != "unknown":
        version = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True).stdout.split("\n")[0]
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
    now = datetime.datetime.now()
    return {"date": now.date().isoformat(), "time": now.isoformat(timespec="minutes"), "commit": commit, "machine": machine(), "threads": 1, "load": round(os.getloadavg()[1], 1),
            "compiler": version, "flags": " ".join(cache_entry(folder, f"CMAKE_CXX_FLAGS{kind}") for kind in ("", "_RELEASE")).strip()}


def compact(document):
    """The text of a record: JSON on one line."""
    return json.dumps(document, ensure_ascii=False, separators=(",", ":")) + "\n"


def save(kind, document):
    """Writes the record of a kind, which has its date and commit. Returns the path."""
    path = HISTORY / f"{document['date']}-{document['commit']}-{kind}.json"
    HISTORY.mkdir(exist_ok=True)
    path.write_text(compact(document), encoding="utf-8")
    return path


def write(kind, program, results):
    """Adds results to the record of this kind, day and commit."""
    record = {"kind": kind, **describe(program)}
    path = HISTORY / f"{record['date']}-{record['commit']}-{kind}.json"
    earlier = json.loads(path.read_text())["results"] if path.exists() else {}
    record["results"] = {**earlier, **results}
    return save(kind, record)


def newest(kind):
    """The newest record of a kind."""
    records = [json.loads(path.read_text()) for path in HISTORY.glob("*.json")]
    records = [record for record in records if record.get("kind") == kind]
    if not records:
        raise NoRecord(f"benchmarks/history/ has no record of the kind {kind}")
    return max(records, key=lambda record: record["time"])
