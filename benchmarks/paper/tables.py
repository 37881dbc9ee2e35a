# SPDX-License-Identifier: BSD-3-Clause
"""Tables of the write-up, in Markdown, from the records."""
from . import plan, report_2008
from .results import cells_at_a_vertex, cpu, cpu_ratio, memory_ratio, time_fit, wall, wall_ratio

NONE = "–"


def table(header, rows):
    """A Markdown table; an empty one says so."""
    if not rows:
        return "_Not measured in this run._"
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(str(cell).replace("|", "\\|") for cell in line) + " |" for line in lines)


def number(value, digits=2):
    """Three or so significant digits, without an exponent where that can be read."""
    if value is None:
        return NONE
    if value == 0:
        return "0"
    magnitude = abs(value)
    if magnitude >= 1e6 or magnitude < 1e-3:
        mantissa, exponent = f"{value:.{digits}e}".split("e")
        return f"{mantissa}·10{superscript(int(exponent))}"
    if magnitude >= 100:
        return f"{value:.0f}"
    if magnitude >= 10:
        return f"{value:.1f}"
    return f"{value:.{digits}f}" if magnitude >= 0.1 else f"{value:.{digits + 2}f}"


def superscript(value):
    return "".join("⁰¹²³⁴⁵⁶⁷⁸⁹"[int(c)] if c.isdigit() else "⁻" for c in str(value))


def count(value):
    """Digits in groups of three."""
    return f"{value:,}".replace(",", " ")


def times(value):
    return NONE if value is None else f"{number(value)} ×"


def has_threads(record):
    return record.get("threads", 1) > 1


def outcome(record):
    """Processor seconds (wall-clock seconds with several threads), or why there are none."""
    if record is None:
        return NONE
    return number(wall(record) if has_threads(record) else cpu(record)) if record["outcome"] == "ok" else record["outcome"]


def fits(results):
    rows = []
    for d in results.dimensions("uniform"):
        records = results.ok("uniform", "delone", d)
        thousands = [r for r in records if r["points"] >= 1000]  # the report's range; what is smaller bends the line
        fitted = time_fit(thousands if len(thousands) >= 3 else records)
        printed = report_2008.FIT.get(d)
        quicker = None
        if printed and records:
            last = records[-1]
            quicker = report_2008.seconds(d, last["points"]) / cpu(last)
        rows.append([d, *((number(printed[0]), f"{printed[1]:.4f}".rstrip("0")) if printed else (NONE, NONE)),
                     *((number(fitted[0]), f"{fitted[1]:.3f}") if fitted else (NONE, NONE)),
                     count(records[-1]["points"]) if records else NONE,
                     number(report_2008.seconds(d, records[-1]["points"])) if printed and records else NONE,
                     number(cpu(records[-1])) if records else NONE, times(quicker)])
    return table(["d", "k, 2008", "α, 2008", "k here", "α here", "at n =", "its fit, s", "here, s", "2008 / here"], rows)


def uniform(results):
    rows = [[r["dimension"], count(r["points"]), count(r["cells"]), number(cpu(r)), number(wall(r)), number(r["cells"] / cpu(r)),
             number(r["peak_bytes"] / 1e6), bytes_per_cell(r), number(1e9 * cpu(r) / r["created_cells"])]
            for r in results.ok("uniform", "delone")]
    rows += [[r["dimension"], count(r["points"]), f"{r['outcome']}: {r['message']}", *[NONE] * 6]
             for r in stopping(results.of("uniform", "delone")) if r["outcome"] != "ok"]
    return table(["d", "n", "cells", "CPU s", "wall s", "cells per s", "peak MB", "bytes per cell", "ns per created cell"], rows)


def stopping(records):
    """Records up to the first of each dimension that has no result, in a list of one program by dimension and size."""
    kept, stopped = [], set()
    for r in records:
        if r["dimension"] not in stopped:
            kept.append(r)
        if r["outcome"] != "ok":
            stopped.add(r["dimension"])
    return kept


def bytes_per_cell(record):
    """Memory that construction added to the process, per cell; not given for small inputs."""
    return number((record["peak_bytes"] - record["input_bytes"]) / record["cells"]) if record["cells"] > 20_000 else NONE


def valence(results):
    rows = []
    for d in results.dimensions("uniform"):
        records = results.ok("uniform", "delone", d)
        if not records:
            continue
        last = records[-1]
        rows.append([d, report_2008.CELLS_AT_A_VERTEX.get(d, NONE), number(cells_at_a_vertex(last)), count(last["points"]),
                     number(report_2008.cells_at_a_vertex(d)), number(cells_at_a_vertex(last) / report_2008.cells_at_a_vertex(d))])
    return table(["d", "2008", "here", "at n =", "without a boundary", "here / without"], rows)


def orders(results):
    rows = []
    for kind, d, n in results.inputs("order"):
        ours, rounds, curve, shuffled = (results.at("order", kind, d, n, key)
                                         for key in ("delone", "delone:report", "delone:curve", "delone:shuffled"))
        if not all(r and r["outcome"] == "ok" for r in (ours, rounds, curve, shuffled)):
            continue
        visited = [r["visited_cells"] / r["insertions"] for r in (ours, rounds, curve, shuffled)]
        created = [r["created_cells"] / r["insertions"] for r in (ours, rounds, curve, shuffled)]
        rows.append([d, count(n), *(number(v) for v in visited), times(visited[3] / visited[1]), *(number(c) for c in created),
                     *(times(cpu_ratio(r, shuffled)) for r in (ours, rounds, curve))])
    return table(["d", "n", "visited: ours", "rounds", "curve", "shuffled", "shuffled / rounds", "created: ours", "rounds", "curve", "shuffled",
                  "time to shuffled: ours", "rounds", "curve"], rows)


def specialised(results):
    rows = []
    for d, key in ((d, key) for d, keys in plan.SPECIALISED.items() for key in keys):
        for r in stopping(results.of("uniform", key, dimension=d)):
            ours = results.at("uniform", "uniform", d, r["points"], "delone")
            ratio = (wall_ratio if has_threads(r) else cpu_ratio)(ours, r)
            theirs = [number(cpu(r)), number(wall(r))] if r["outcome"] == "ok" else [r["outcome"], NONE]
            rows.append([d, r["name"], count(r["points"]), outcome(ours), *theirs, times(ratio), times(memory_ratio(ours, r))])
    return table(["d", "who", "n", "delone, CPU s", "theirs, CPU s", "theirs, wall s", "time: delone / theirs", "memory: delone / theirs"], rows)


def manifold(results):
    rows = []
    for kind, d, n in results.inputs("manifold"):
        ours = results.at("manifold", kind, d, n, "delone")
        flat = results.at("uniform", "uniform", d, n, "delone")
        peers = [results.at("manifold", kind, d, n, key) for key in ("cgal_d", "qhull", "cgal_2", "cgal_3")]
        special = peers[2] or peers[3]
        if not ours:
            continue
        both = ours["outcome"] == "ok" and flat is not None and flat["outcome"] == "ok"
        rows.append([d, count(n), count(ours["cells"]) if ours["outcome"] == "ok" else NONE, outcome(ours),
                     number(ours["peak_bytes"] / 1e6) if ours["outcome"] == "ok" else NONE,
                     times(ours["cells"] / flat["cells"]) if both else NONE, times(cpu(ours) / cpu(flat)) if both else NONE,
                     *(times(cpu_ratio(peer, ours)) for peer in (peers[0], peers[1], special))])
    return table(["d", "n", "cells", "CPU s", "peak MB", "cells to uniform", "time to uniform", "CGAL dD / delone", "Qhull / delone",
                  "CGAL 2D, 3D / delone"], rows)


def against(results, key):
    """One general peer on uniform points."""
    rows = []
    for r in stopping(results.of("uniform", key)):
        ours = results.at("uniform", "uniform", r["dimension"], r["points"], "delone")
        rows.append([r["dimension"], count(r["points"]), outcome(ours), outcome(r), times(cpu_ratio(r, ours)),
                     number(ours["peak_bytes"] / 1e6) if ours and ours["outcome"] == "ok" else NONE,
                     number(r["peak_bytes"] / 1e6) if r["outcome"] == "ok" else NONE, times(memory_ratio(r, ours))])
    name = results.name(key)
    return table(["d", "n", "delone, CPU s", f"{name}, CPU s", f"{name} / delone", "delone, MB", f"{name}, MB", f"{name} / delone"], rows)


def by_program(results, experiment):
    """Seconds of every program, ratios to the first in parentheses."""
    keys = results.programs(experiment)
    rows = []
    for kind, d, n in results.inputs(experiment):
        first = results.at(experiment, kind, d, n, keys[0])
        cells = first["cells"] if first and first["outcome"] == "ok" else None
        row = [f"{kind.removeprefix('real:')} {d}D", count(n), count(cells) if cells is not None else NONE, outcome(first)]
        for key in keys[1:]:
            record = results.at(experiment, kind, d, n, key)
            ratio = (wall_ratio if record and has_threads(record) else cpu_ratio)(record, first)
            row.append(outcome(record) + (f" ({times(ratio)})" if ratio else ""))
        rows.append(row)
    return table(["input", "n", "cells", *(results.name(key) for key in keys)], rows)


def with_failures(results, experiment):
    """by_program(), and the messages of the programs that failed."""
    failed = [f"- {r['kind']} {r['dimension']}D, n = {count(r['points'])}: {r['name']} failed: {plain(r['message'])}"
              for r in results.of(experiment) if r["outcome"] == "failed"]
    return "\n".join([by_program(results, experiment), *([""] if failed else []), *failed])


def scoreboard(results, experiment):
    keys = results.programs(experiment)
    rows = []
    for kind, d, n in results.inputs(experiment):
        row = [f"{kind.removeprefix('real:')} {d}D", count(n)]
        for key in keys:
            record = results.at(experiment, kind, d, n, key)
            row.append(NONE if record is None else verdict(record))
        rows.append(row)
    return table(["input", "n", *(results.name(key) for key in keys)], rows)


def verdict(record):
    if record["outcome"] != "ok":
        return "**no result**" if record["outcome"] == "failed" else record["outcome"]
    judged = record.get("verdict")
    if judged is None:
        return "not judged"
    if judged["accepted"] is None:
        return judged["level"]
    return "accepted" if judged["accepted"] else f"**{judged['level']}**"


def what_was_wrong(results):
    """The message of every failure; the programs that say the same of the same input are named together."""
    found = {}
    for r in [*results.of("degenerate"), *results.of("tiny")]:
        judged = r.get("verdict", {})
        where = f"{r['kind'].removeprefix('real:')} {r['dimension']}D, n = {count(r['points'])}"
        if r["outcome"] == "failed":
            found.setdefault((where, f"no result: {plain(r['message'])}"), []).append(r["name"])
        elif judged.get("accepted") is False:
            found.setdefault((where, f"{judged['level']}: {plain(judged['violation'])}"), []).append(r["name"])
    lines = [f"- {where}: {'; '.join(dict.fromkeys(names))}: {message}" for (where, message), names in found.items()]
    return "\n".join(lines) if lines else "Nothing."


def plain(text):
    """Text of a program, escaped for Markdown."""
    return "`" + " ".join(text.replace("`", "'").split()) + "`"


def accepted(results):
    """How many results of each program were accepted, wrong, missing or not judged."""
    rows = []
    for experiment in ("degenerate", "tiny"):
        for key in results.programs(experiment):
            if (experiment, key) == ("tiny", "delone"):
                continue  # its row is that of the larger inputs
            records = results.of(experiment, key)
            yes = sum(r.get("verdict", {}).get("accepted") is True for r in records)
            wrong = sum(r.get("verdict", {}).get("accepted") is False for r in records)
            none = sum(r["outcome"] == "failed" for r in records)
            no_simplices = sum(r.get("verdict", {}).get("level") == "not simplices" for r in records)
            rows.append([results.name(key), len(records), yes, wrong, none, no_simplices, len(records) - yes - wrong - none - no_simplices])
    return table(["who", "inputs", "accepted", "not a Delaunay triangulation", "no result", "cells that are no simplices", "too slow, or not decided"], rows)


def versions(results):
    seen = {}
    for r in results.records:
        if r["outcome"] == "ok":
            seen.setdefault(r["name"], (r["version"], r["flags"]))
    return table(["program", "version", "flags"], [[name, version, f"`{flags}`" if flags else NONE] for name, (version, flags) in seen.items()])
