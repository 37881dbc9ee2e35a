# SPDX-License-Identifier: BSD-3-Clause
"""The measured records, and queries of them for tables and plots."""
import statistics

from . import fit


class Results:
    def __init__(self, document):
        self.about = document["about"]
        self.records = document["records"]

    def of(self, experiment, program=None, kind=None, dimension=None):
        """Records with these properties, by growing size."""
        found = [r for r in self.records if r["experiment"] == experiment and (program is None or r["program"] == program)
                 and (kind is None or r["kind"] == kind) and (dimension is None or r["dimension"] == dimension)]
        return sorted(found, key=lambda r: (r["dimension"], r["points"]))

    def ok(self, experiment, program, dimension=None, kind=None):
        return [r for r in self.of(experiment, program, kind, dimension) if r["outcome"] == "ok"]

    def dimensions(self, experiment):
        return sorted({r["dimension"] for r in self.records if r["experiment"] == experiment})

    def inputs(self, experiment):
        """(kind, dimension, points) of an experiment, in the order of measurement."""
        return list(dict.fromkeys((r["kind"], r["dimension"], r["points"]) for r in self.records if r["experiment"] == experiment))

    def programs(self, experiment):
        """The keys of those that were measured there, in the order of measurement."""
        return list(dict.fromkeys(r["program"] for r in self.records if r["experiment"] == experiment))

    def at(self, experiment, kind, dimension, points, program):
        """The record of one program on one input, or None."""
        for r in self.records:
            if (r["experiment"], r["kind"], r["dimension"], r["points"], r["program"]) == (experiment, kind, dimension, points, program):
                return r
        return None

    def name(self, program):
        return next((r["name"] for r in self.records if r["program"] == program), program)


def cpu(record):
    return statistics.median(record["cpu_seconds"])


def wall(record):
    return statistics.median(record["seconds"])


def cpu_ratio(record, to):
    """The time of a record divided by that of `to`, both measured in turn; None unless both have a result."""
    if not record or not to or record["outcome"] != "ok" or to["outcome"] != "ok":
        return None
    return fit.median_ratio(record["cpu_seconds"], to["cpu_seconds"])


def wall_ratio(record, to):
    if not record or not to or record["outcome"] != "ok" or to["outcome"] != "ok":
        return None
    return fit.median_ratio(record["seconds"], to["seconds"])


def memory_ratio(record, to):
    if not record or not to or record["outcome"] != "ok" or to["outcome"] != "ok":
        return None
    return record["peak_bytes"] / to["peak_bytes"]


def cells_at_a_vertex(record):
    return (record["dimension"] + 1) * record["cells"] / record["points"]


def time_fit(records):
    """(k, alpha) for the processor seconds of the records."""
    return fit.power_law([r["points"] for r in records], [cpu(r) for r in records])
