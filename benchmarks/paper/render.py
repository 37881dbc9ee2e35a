# SPDX-License-Identifier: BSD-3-Clause
"""Fills experiments.md.in. {{NAME}} is replaced by what PIECES says: a table, a sentence with measured figures, or a fact about the
run. A name that is not known, and a piece that no template asks for, is an error."""
import pathlib
import re

from . import plots, report_2008, tables
from .results import Results, cpu, cpu_ratio, memory_ratio

TEMPLATE = pathlib.Path(__file__).with_name("experiments.md.in")


def spread(ratios):
    """Words for the ratios theirs/ours of several inputs."""
    ratios = [r for r in ratios if r]
    if not ratios:
        return "has not been measured here"
    low, high = min(ratios), max(ratios)
    if low >= 1:
        return f"takes {tables.number(low)} to {tables.number(high)} times as long"
    if high <= 1:
        return f"takes {tables.number(low)} to {tables.number(high)} of the time"
    return f"takes {tables.number(low)} to {tables.number(high)} times the time"


def ratios_to_delone(results, experiment, key, ratio=cpu_ratio, dimensions=None):
    found = []
    for record in results.of(experiment, key):
        if dimensions and record["dimension"] not in dimensions:
            continue
        found.append(ratio(record, results.at(experiment, record["kind"], record["dimension"], record["points"], "delone")))
    return [r for r in found if r]


def largest(results, key, dimension):
    """The ratio theirs / delone at the largest uniform input that both did."""
    found = ratios_to_delone(results, "uniform", key, dimensions=[dimension])
    return found[-1] if found else None


def per_dimension(results, key):
    """"2D 0.9 ×, 3D 2.7 ×, …" at the largest input of each dimension."""
    words = [f"{d}D {tables.times(largest(results, key, d))}" for d in results.dimensions("uniform") if largest(results, key, d)]
    return ", ".join(words) if words else "not measured"


def crossings(results, key):
    """From which size on delone is the faster one, in words."""
    words = []
    for d in results.dimensions("uniform"):
        pairs = [(r["points"], cpu_ratio(r, results.at("uniform", "uniform", d, r["points"], "delone"))) for r in results.of("uniform", key, dimension=d)]
        pairs = [(n, ratio) for n, ratio in pairs if ratio]
        slower = [n for n, ratio in pairs if ratio < 1]
        if pairs:
            words.append(f"{d}D: " + ("at every size measured" if not slower else
                                      "at no size measured" if slower[-1] == pairs[-1][0] else f"above {tables.count(slower[-1])} points"))
    if words and all(word.endswith("at every size measured") for word in words):
        return "at every size measured in every dimension"
    return "; ".join(words) if words else "not measured"


def memory_words(results, key, dimensions):
    """The range of the ratio of memory at the largest sizes of these dimensions, in words."""
    found = [ratios[-1] for d in dimensions if (ratios := ratios_to_delone(results, "uniform", key, memory_ratio, [d]))]
    return f"is {tables.number(min(found))} to {tables.number(max(found))} times that of delone" if found else "has not been measured here"


def ours_against(results, key, dimension):
    ratio = largest(results, key, dimension)
    return f"{tables.number(1 / ratio)} times" if ratio else "an unmeasured multiple of"


def then_and_now(results, key):
    """The report's fit over the time of a program of today, at its largest input of each dimension."""
    words = []
    for d in report_2008.FIT:
        records = results.ok("uniform", key, d)
        if records:
            words.append(f"{d}D {tables.times(report_2008.seconds(d, records[-1]['points']) / cpu(records[-1]))}")
    return ", ".join(words) if words else "not measured"


def created(results):
    """Cells created by rounds, and by one curve, to those created in random order, at the largest size of each dimension."""
    words = []
    for d in results.dimensions("order"):
        last = [results.ok("order", key, d)[-1:] for key in ("delone:report", "delone:curve", "delone:shuffled")]
        if all(last):
            rounds, curve, shuffled = (r[0]["created_cells"] / r[0]["insertions"] for r in last)
            words.append(f"{d}D {rounds / shuffled:.2f} and {curve / shuffled:.2f}")
    return ", ".join(words) if words else "not measured"


def kind_of_run(about):
    return ("This is a quick run: small sizes, few rounds. Its times are short and its fits rough." if about["quick"] else
            "This is a full run.")


def pieces(results):
    about = results.about
    return {
        "machine_2008": report_2008.MACHINE,
        "kind_of_run": kind_of_run(about),
        "date": about["date"],
        "commit": about["commit"],
        "machine": about["machine"],
        "system": about["system"],
        "memory": f"{about['memory_bytes'] / 2**30:.0f} GiB",
        "compiler": about["compiler"],
        "load": f"{about['load'][0]:.1f} at its start and {about['load'][1]:.1f} at its end, on {about['cores']} cores",
        "busy": busy(about),
        "rounds": rounds(results),
        "notes": "".join(f"{note} " for note in about.get("notes", [])),
        "limits": f"{about['limit_seconds']:g} seconds of processor time and {about['limit_memory'] / 2**30:.0f} GiB",
        "elapsed": f"{about['elapsed_seconds'] / 60:.0f} minutes",
        "versions": tables.versions(results),
        "table_1": tables.fits(results),
        "uniform": tables.uniform(results),
        "valence": tables.valence(results),
        "orders": tables.orders(results),
        "specialised": tables.specialised(results),
        "ours_2d": ours_against(results, "cgal_2", 2),
        "ours_3d": ours_against(results, "cgal_3", 3),
        "slower_2d": report_2008.SLOWER_THAN_SPECIALISED[2],
        "slower_3d": report_2008.SLOWER_THAN_SPECIALISED[3],
        "manifold": tables.manifold(results),
        "qhull": tables.against(results, "qhull"),
        "qhull_crossings": crossings(results, "qhull"),
        "qhull_largest": per_dimension(results, "qhull"),
        "qhull_memory": memory_words(results, "qhull", [4, 5]),
        "clarkson": clarkson(results),
        "small": tables.by_program(results, "small"),
        "cgal_d": tables.against(results, "cgal_d"),
        "cgal_d_largest": per_dimension(results, "cgal_d"),
        "cgal_d_spread": spread(ratios_to_delone(results, "uniform", "cgal_d")),
        "cgal_d_then": then_and_now(results, "cgal_d"),
        "created": created(results),
        "scipy": tables.against(results, "scipy"),
        "hulls": tables.by_program(results, "hulls"),
        "degenerate": tables.by_program(results, "degenerate"),
        "accepted": tables.accepted(results),
        "scoreboard": tables.scoreboard(results),
        "wrong": tables.what_was_wrong(results),
    }


def rounds(results):
    """How often the programs took turns; short cases have more rounds."""
    found = [len(r["seconds"]) for r in results.records if r["outcome"] == "ok"]
    low, high = min(found), max(found)
    few = sum(n == 1 for n in found) / len(found)
    return f"{high} times" if low == high else f"{low} to {high} times" + (f" ({100 * few:.0f} % of the figures are of one round)" if few else "")


def busy(about):
    """A warning, where other work went on."""
    if max(about["load"]) <= about["cores"]:
        return "It was quiet."
    return "It was busy with other work, which shows in all times, and most where caches matter: take the ratios, and those roughly."


def clarkson(results):
    records = results.of("small", "clarkson")
    if not records:
        return "_No executable of Hull was named in this run._"
    return f"With the executable named, Hull {spread(ratios_to_delone(results, 'small', 'clarkson'))} as delone; the table of section 5.7 has the figures."


def fill(template, values):
    asked = set(re.findall(r"\{\{(\w+)\}\}", template))
    unknown, unused = asked - set(values), set(values) - asked
    if unknown or unused:
        raise KeyError(f"the template asks for {sorted(unknown)} in vain and leaves {sorted(unused)}")
    return re.sub(r"\{\{(\w+)\}\}", lambda match: str(values[match[1]]), template)


def write(document, docs):
    """Writes docs/experiments.md and its pictures."""
    results = Results(document)
    docs = pathlib.Path(docs)
    plots.all_figures(results, docs / "pictures" / "experiments")
    text = fill(TEMPLATE.read_text(encoding="utf-8"), pieces(results))
    (docs / "experiments.md").write_text(text, encoding="utf-8")
    return docs / "experiments.md"
