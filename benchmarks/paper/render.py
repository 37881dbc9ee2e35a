# SPDX-License-Identifier: BSD-3-Clause
"""Fills experiments.md.in. {{NAME}} is replaced by what pieces() says: a table, a sentence with measured figures, or a fact about
the run. An unknown name is an error, and so is a piece that the template does not use. Lines of prose are wrapped."""
import os
import pathlib
import re
import textwrap

from . import plan, plots, report_2008, tables
from .inputs import ROOT
from .results import Results, cpu, cpu_ratio, memory_ratio, wall

TEMPLATE = pathlib.Path(__file__).with_name("experiments.md.in")
WIDTH = 120  # of lines of prose


def spread(ratios):
    """Words for the ratios theirs / delone of several inputs."""
    ratios = [r for r in ratios if r]
    if not ratios:
        return "has not been measured here"
    return f"takes {tables.number(min(ratios))} to {tables.number(max(ratios))} times as long as delone"


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
    """From which size on delone is faster, in words."""
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


def specialised_largest(results, dimension):
    """The times of triangulations made for one dimension, one thread, at the largest size, divided by delone's."""
    words = []
    for key in plan.SPECIALISED[dimension]:
        ratio = largest(results, key, dimension)
        if ratio and not tables.has_threads(results.ok("uniform", key, dimension)[-1]):
            words.append(f"{results.ok('uniform', key, dimension)[-1]['name']} {tables.times(ratio)}")
    return ", ".join(words) if words else "not measured"


def then_and_now(results, key):
    """The report's fit divided by the time of a program of today, at its largest input of each dimension."""
    words = []
    for d in report_2008.FIT:
        records = results.ok("uniform", key, d)
        if records:
            words.append(f"{d}D {tables.times(report_2008.seconds(d, records[-1]['points']) / cpu(records[-1]))}")
    return ", ".join(words) if words else "not measured"


def created(results):
    """Cells created by rounds, and by one curve, divided by those of random order, at the largest size of each dimension."""
    words = []
    for d in results.dimensions("order"):
        last = [results.ok("order", key, d)[-1:] for key in ("delone:report", "delone:curve", "delone:shuffled")]
        if all(last):
            rounds, curve, shuffled = (r[0]["created_cells"] / r[0]["insertions"] for r in last)
            words.append(f"{d}D {rounds / shuffled:.2f} and {curve / shuffled:.2f}")
    return ", ".join(words) if words else "not measured"


def kind_of_run(about):
    """What kind of run it was, and what it left out, all from the record."""
    words = ["This is a quick run: small sizes, short limits; its times are short and its fits rough." if about["quick"] else "This is a full run."]
    if about["sittings"] > 1:
        words.append(f"It was measured in {about['sittings']} sittings.")
    if about["missing"]:
        words.append(f"Not installed or not built here, and so not measured: {', '.join(about['missing'])}.")
    if about["left_out"]:
        words.append(f"It had {about['minutes']:g} minutes, in which these inputs no longer fitted: {left_out(about['left_out'])}.")
    return " ".join(words)


def left_out(keys):
    """"section 5.1, 6D, n = 64 000 and more" for "uniform uniform 6 64000" and "uniform uniform 6 128000"."""
    sizes = {}
    place = list(NAMES)
    for key in sorted(keys, key=lambda key: (place.index(key.split()[0]), *key.split()[1:3])):
        experiment, kind, dimension, points = key.split()
        kind = "" if kind in ("uniform", "manifold") else kind.removeprefix("real:") + ", "
        sizes.setdefault(f"{NAMES[experiment]}, {kind}{dimension}D", []).append(int(points))
    words = []
    for series, points in sizes.items():
        size = f", n = {tables.count(min(points))}" if min(points) else ""
        words.append(f"{series}{size}{' and more' if len(points) > 1 else ''}")
    return "; ".join(words)


NAMES = {"uniform": "section 5.1", "order": "section 5.2", "manifold": "section 5.4", "small": "cddlib and lrs", "hulls": "convex hulls",
         "degenerate": "degenerate input", "tiny": "degenerate input of few points"}


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
        "load": load(results),
        "rounds": rounds(results),
        "limits": limits(about),
        "agreement": agreement(results),
        "elapsed": f"{about['elapsed_seconds'] / 60:.0f} minutes",
        "versions": tables.versions(results),
        "table_1": tables.fits(results),
        "uniform": tables.uniform(results),
        "valence": tables.valence(results),
        "orders": tables.orders(results),
        "specialised": tables.specialised(results),
        "ours_2d": ours_against(results, "cgal_2", 2),
        "ours_3d": ours_against(results, "cgal_3", 3),
        "specialised_2d": specialised_largest(results, 2),
        "specialised_3d": specialised_largest(results, 3),
        "slower_2d": report_2008.SLOWER_THAN_SPECIALISED[2],
        "slower_3d": report_2008.SLOWER_THAN_SPECIALISED[3],
        "manifold": tables.manifold(results),
        "qhull": tables.against(results, "qhull"),
        "qhull_crossings": crossings(results, "qhull"),
        "qhull_largest": per_dimension(results, "qhull"),
        "qhull_memory": memory_words(results, "qhull", [4, 5]),
        "clarkson": clarkson(results),
        "small": tables.with_failures(results, "small"),
        "cgal_d": tables.against(results, "cgal_d"),
        "cgal_d_largest": per_dimension(results, "cgal_d"),
        "cgal_d_spread": spread(ratios_to_delone(results, "uniform", "cgal_d")),
        "cgal_d_then": then_and_now(results, "cgal_d"),
        "created": created(results),
        "scipy": tables.against(results, "scipy"),
        "hulls": tables.with_failures(results, "hulls"),
        "degenerate": tables.by_program(results, "degenerate"),
        "accepted": tables.accepted(results),
        "scoreboard": tables.scoreboard(results, "degenerate"),
        "tiny": tables.by_program(results, "tiny"),
        "tiny_scoreboard": tables.scoreboard(results, "tiny"),
        "wrong": tables.what_was_wrong(results),
    }


def rounds(results):
    """How often the programs took turns."""
    limits = results.about["limits"]
    found = [len(r["seconds"]) for r in results.records if r["outcome"] == "ok"]
    one = sum(n == 1 for n in found)
    if limits["rounds"] == 1:
        return "once"
    return (f"up to {limits['rounds']} times (a program that has taken more than {limits['turn_seconds']:g} s on an input gets no "
            f"further turn, so that {one} of the {len(found)} figures are of one turn)")


def agreement(results):
    """Do the programs find the same number of cells? Not asked of degenerate input, where a choice among ties decides it."""
    inputs, different = 0, []
    for experiment in ("uniform", "order", "manifold", "small", "hulls"):
        for kind, d, n in results.inputs(experiment):
            found = [r for r in results.of(experiment, kind=kind, dimension=d) if r["points"] == n and r["outcome"] == "ok"]
            inputs += len(found) > 1
            others = [r for r in found if r["cells"] != found[0]["cells"]]
            if others:
                words = ", ".join(f"{r['name']} {tables.count(r['cells'])}" for r in [found[0], *others])
                different.append(f"{NAMES[experiment]}, {d}D, n = {tables.count(n)}: {words}")
    agreeing = f"{inputs - len(different)} of {inputs}" if different else f"all {inputs}"
    said = f"On {agreeing} inputs that are not degenerate all programs return the same number of cells."
    return said + (f" The others: {'; '.join(different)}." if different else "")


def limits(about):
    given = about["limits"]
    words = f"{given['seconds']:g} seconds of processor time and {given['memory_bytes'] / 2**30:.0f} GiB"
    if given["own_seconds"] != given["seconds"]:
        words += f"; delone, whose sizes go further, {given['own_seconds']:g} seconds"
    if given["enumerator_seconds"] != given["seconds"]:
        words += f"; cddlib and lrs {given['enumerator_seconds']:g}"
    return words


def load(results):
    """How busy the machine was: its load, and wall-clock beside processor time of programs of one thread."""
    about = results.about
    words = f"The load of the machine was {about['load'][0]:.1f} at the start and {about['load'][1]:.1f} at the end, on {about['cores']} cores"
    waits = sorted(wall(r) / cpu(r) for r in results.records if r["outcome"] == "ok" and r.get("threads", 1) == 1 and cpu(r) > 0.1)
    if not waits:
        return words + "."
    median, tenth = waits[len(waits) // 2], waits[9 * len(waits) // 10]
    words += (f"; constructions on one thread took {median:.2f} times their processor time by the wall clock in the median, {tenth:.2f} in the "
              "worst tenth")
    return words + (": it was quiet." if tenth < 1.2 and max(about["load"]) < 2 else
                    ": other work went on beside, which shows in all times, and most where caches matter.")


def clarkson(results):
    """The report's figures in a row, the executable's beside them, and its picture where there was one."""
    found = [ratio for d in results.dimensions("uniform") if (ratio := largest(results, "clarkson", d))]
    memory = ratios_to_delone(results, "uniform", "clarkson", memory_ratio)
    rows = [["the report, Hull 0.7 to its program", "about 2 ×", "“much more”"],
            ["here, Hull to delone", f"{tables.times(min(found))} to {tables.times(max(found))}" if found else "no executable was named",
             f"{tables.times(min(memory))} to {tables.times(max(memory))}" if memory else tables.NONE]]
    words = tables.table(["", "time, largest input of each dimension", "memory"], rows)
    if found:
        words += f"\n\n![Time and memory beside Hull](pictures/experiments/figure-6.png)\n\n{tables.against(results, 'clarkson')}"
    return words


def fill(template, values):
    asked = set(re.findall(r"\{\{(\w+)\}\}", template))
    unknown, unused = asked - set(values), set(values) - asked
    if unknown or unused:
        raise KeyError(f"the template names {sorted(unknown)}, which do not exist, and does not use {sorted(unused)}")
    return wrapped(re.sub(r"\{\{(\w+)\}\}", lambda match: str(values[match[1]]), template))


CODE = re.compile(r"`[^`]{1,100}`")


def wrapped(text):
    """The text with paragraphs and list items in lines of at most WIDTH characters; other lines stay as they are."""
    lines, paragraph = [], []

    def close():
        if paragraph:
            words = CODE.sub(lambda match: match[0].replace(" ", "\0"), " ".join(paragraph))
            indent = "  " if words.startswith("- ") else ""
            lines.extend(line.replace("\0", " ") for line in
                         textwrap.wrap(words, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False))
            paragraph.clear()

    for line in text.split("\n"):
        stays = not line or line.startswith(("|", "#", "!", "<!--"))
        if stays or line.startswith("- "):
            close()
        if stays:
            lines.append(line)
        else:
            paragraph.append(line.strip())
    close()
    return "\n".join(lines)


def write(document, folder):
    """Writes experiments.md and its pictures in a folder; links of the template are relative to docs/."""
    results = Results(document)
    folder = pathlib.Path(folder)
    plots.all_figures(results, folder / "pictures" / "experiments")
    template = TEMPLATE.read_text(encoding="utf-8").replace("](../", f"]({os.path.relpath(ROOT, folder)}/")
    (folder / "experiments.md").write_text(fill(template, pieces(results)), encoding="utf-8")
    return folder / "experiments.md"
