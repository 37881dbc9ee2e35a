#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the documentation site: Sphinx from the Markdown pages and the docstrings, Doxygen from the headers, pages of the command's help.

Usage: make_site.py BUILD_DIR [-o build/site]

BUILD_DIR holds the command and, in python/, the module for the Python that runs this; that Python has Sphinx, myst_parser and furo.
The pages are gathered in OUT/../site-pages: docs/site/*.md and docs/*.md at its top, the others where they are in the tree. Links between
pages, and to files of the tree, are rewritten accordingly; a link to a folder goes to a page that lists it. Any warning is an error. Then
every link and anchor of the finished site is followed. The page to try delone computes with build/js/delone, which `make npm` makes.
"""
import argparse
import html.parser
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse
import xml.etree.ElementTree

import check_docs
import command_manual

ROOT = check_docs.ROOT
IMAGE = re.compile(r"!\[[^\]]*\]\((?!https?://)([^)\s]+)\)")


def place(path):
    """Where a file of the tree is on the site."""
    name = path.relative_to(ROOT).as_posix()
    if name == "README.md":
        return "readme.md"
    return name.removeprefix("docs/").removeprefix("site/")


def listing(folder):
    """The page that a link to a folder goes to."""
    return place(folder) + "/index.md"


def rewritten(path, pages, text=None):
    """The text of a page, or the given one, with its links as they are on the site. Files that it links to and that are no pages are added to `pages`."""
    text = path.read_text(encoding="utf-8") if text is None else text
    here = os.path.dirname(place(path)) or "."

    def moved(match):
        target = (path.parent / match[1]).resolve()
        if not match[1] or not target.exists():
            return match[0]
        if target.is_dir():
            new = listing(target)
        else:
            new = place(target)
            pages.setdefault(target, None)
        at, end = match.start(1) - match.start(), match.end(1) - match.start()
        return match[0][:at] + os.path.relpath(new, here) + match[0][end:]

    parts = re.split(r"(^```.*?^```$)", text, flags=re.M | re.S)
    return "".join(part if part.startswith("```") else IMAGE.sub(moved, check_docs.LINK.sub(moved, part)) for part in parts)


def front_page(path, pages):
    """The text of docs/site/index.md, with the table of README.md of what one may want to do."""
    readme = ROOT / "README.md"
    table = readme.read_text(encoding="utf-8").partition("## What do you want to do?\n\n")[2].partition("\n\n## ")[0]
    text, mark = rewritten(path, pages), "<!-- the table of README.md -->"
    assert table and mark in text
    return text.replace(mark, rewritten(readme, pages, table))


def folder_page(title, text, entries):
    return f"# {title}\n\n{text}\n\n```{{toctree}}\n:maxdepth: 2\n\n" + "\n".join(entries) + "\n```\n"


def gather(stage):
    """Writes the pages."""
    documents = [*check_docs.documents(), ROOT / "SECURITY.md"]
    pages = dict.fromkeys(documents)
    for path in documents:
        pages[path] = front_page(path, pages) if place(path) == "index.md" else rewritten(path, pages)
    for path, text in pages.items():
        target = stage / place(path)
        target.parent.mkdir(parents=True, exist_ok=True)
        if text is None:
            shutil.copy2(path, target)
        else:
            target.write_text(text, encoding="utf-8")
    names = sorted(path.stem for path in (ROOT / "docs" / "decisions").glob("*.md"))
    text = "What was chosen, what it costs, and how one would see that it was wrong."
    (stage / "decisions" / "index.md").write_text(folder_page("Decisions", text, names))
    inside = sorted(place(path)[len("benchmarks/"):-len(".md")] for path in documents if place(path).startswith("benchmarks/"))
    (stage / "benchmarks" / "index.md").write_text(folder_page("Measurements", "What was measured, and when.", inside))
    examples = sorted((ROOT / "examples").glob("*.cpp"))
    (stage / "examples").mkdir(exist_ok=True)
    text = "# Examples\n\nShort programs, compiled and run by the tests.\n"
    for path in examples:
        shutil.copy2(path, stage / "examples")
        text += f"\n## {path.stem.replace('_', ' ')}\n\n```{{literalinclude}} {path.name}\n:language: cpp\n:lines: 2-\n```\n"
    (stage / "examples" / "index.md").write_text(text, encoding="utf-8")


def describe_commands(build, stage):
    """Pages of the help of `delone`, and of `delone-mpi` if it was built."""
    (stage / "commands").mkdir()
    names = [name for name in ("delone", "delone-mpi") if name == "delone" or (build / name).is_file()]
    for name in names:
        _, top, others = command_manual.describe([str(build / name)])
        command_manual.write_markdown(stage / "commands", top, others)
    text = "What each command says with `--help`. Where it is installed, `man delone` and `man delone-hull` say the same."
    (stage / "commands.md").write_text(folder_page("Commands", text, ["commands/" + name for name in names]))


def run_doxygen(build, stage, scratch):
    """Doxygen's pages, below scratch/cpp, and the page that lists them."""
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / "cpp").mkdir(parents=True)
    version = re.search(r"^project\(delone VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)[1]
    settings = f"""@INCLUDE = {ROOT}/docs/site/Doxyfile
PROJECT_NUMBER = {version}
INPUT = "{ROOT}/include/delone" "{build}/include"
STRIP_FROM_PATH = "{ROOT}/include" "{build}/include"
STRIP_FROM_INC_PATH = "{ROOT}/include" "{build}/include"
OUTPUT_DIRECTORY = "{scratch}/cpp"
GENERATE_TAGFILE = "{scratch}/tags.xml"
"""
    subprocess.run(["doxygen", "-"], input=settings, text=True, check=True, cwd=ROOT)
    tags = xml.etree.ElementTree.parse(scratch / "tags.xml").getroot()

    def links(kinds, named):
        found = sorted((named(compound), compound.findtext("filename")) for compound in tags if compound.get("kind") in kinds)
        for name, page in found:
            yield name, f'<a href="cpp/{page if page.endswith(".html") else page + ".html"}"><code>{name}</code></a>'

    def summary(name):
        for folder in (ROOT / "include", build / "include"):
            if (folder / name).is_file():
                comment = re.search(r"\A// SPDX.*\n((?://(?!/) ?.*\n)+)", (folder / name).read_text(encoding="utf-8"))
                text = " ".join(line.lstrip("/ ") for line in comment[1].splitlines()) if comment else ""
                return ": " + command_manual.markdown(re.match(r"(?:[^.]|\.(?! |$))*", text)[0]) + "." if text else ""
        return ""

    text = '# C++ reference\n\nFrom the public headers, by Doxygen: <a href="cpp/index.html">all of it</a>, with its own search.\n\n## Headers\n\n'
    headers = links(["file"], lambda compound: (compound.findtext("path") + compound.findtext("name")).rpartition("include/")[2])
    text += "".join(f"- {link}{summary(name)}\n" for name, link in headers)
    classes = links(["class", "struct"], lambda compound: compound.findtext("name").removeprefix("delone::"))
    text += "\n## Classes\n\n" + "".join(f"- {link}\n" for name, link in classes if "<" not in name)
    (stage / "cpp-reference.md").write_text(text, encoding="utf-8")


def prose_of_comment(comment):
    """A comment of C as Markdown: paragraphs, with names as code; indented lines are a block of code."""
    lines = [re.sub(r"^(?:/\*| \*) ?", "", line) for line in re.sub(r" ?\*/$", "", comment).split("\n")]
    text = ""
    for block in re.split(r"\n{2,}", "\n".join(lines)):
        for part in re.split(r"((?:^ {2,}.*\n?)+)", block, flags=re.M):
            if part.startswith("  "):
                text += f"\n```text\n{part.rstrip()}\n```\n"
            elif part.strip():
                pieces = re.split(r"(`[^`]*`)", re.sub(r"(?<![`\w])((?:delone|DELONE)_\w+(?:\(\)|::\w+)?\**)(?!`)", r"`\1`", part.strip()))
                text += "\n" + "".join(p if p.startswith("`") else re.sub(r"([*<\[_])", r"\\\1", p) for p in pieces) + "\n"
    return text


def describe_c(stage):
    """The page of the C interface: the sections of its header, comments as text and declarations as code."""
    header = (ROOT / "include" / "delone" / "delone.h").read_text(encoding="utf-8")
    opening, *sections = re.split(r"^/\* -+ (.*?) -+ \*/$", re.sub(r"^/\* clang-format o.*\n", "", header, flags=re.M), flags=re.M)
    sections[-1] = sections[-1].partition("\n#ifdef __cplusplus")[0]
    text = "# C reference\n\n[From other languages](c.md) shows how its parts work together.\n"
    text += prose_of_comment(re.search(r"^/\* The C interface.*?\*/$", opening, re.M | re.S)[0])
    for title, section in zip(sections[::2], sections[1::2]):
        text += f"\n## {title}\n"
        for part in re.split(r"(^/\*(?:.|\n)*?\*/$)", section, flags=re.M):
            if part.startswith("/*"):
                text += prose_of_comment(part)
            elif part.strip():
                for name in re.findall(r"^DELONE_C_API .*?(delone_\w+)\(", part, re.M):
                    text += f"\n```{{index}} single: {name}\n```\n"
                text += f"\n```c\n{part.strip()}\n```\n"
    (stage / "c-reference.md").write_text(text.replace("DELONE_C_API ", ""), encoding="utf-8")


class Page(html.parser.HTMLParser):
    """The anchors of a page, and where it links to."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif name in ("href", "src") and value and not urllib.parse.urlsplit(value).scheme and not value.startswith("//"):
                self.links.append(value)


def bundle_theme(site):
    """Makes the site whole where the theme is packaged in parts, as on Debian: one script, and no styles of the server's."""
    script, styles = site / "_static" / "scripts" / "furo.js", site / "_static" / "styles" / "furo.css"
    text = script.read_text(encoding="utf-8")
    if imported := re.match(r'import Gumshoe from "\./(.*)";\n', text):
        script.write_text((script.parent / imported[1]).read_text(encoding="utf-8") + text[imported.end():], encoding="utf-8")
    text = styles.read_text(encoding="utf-8")
    if imported := re.match(r"@import url\(/(javascript/.*?)\);", text):
        styles.write_text((pathlib.Path("/usr/share") / imported[1]).read_text(encoding="utf-8") + text[imported.end():], encoding="utf-8")


def add_package(site):
    """Copies the npm package. Without it the page to try delone says how to make it."""
    package = ROOT / "build" / "js" / "delone"
    if (package / "module.wasm").is_file():
        shutil.copytree(package, site / "_static" / "delone")
    else:
        missing = "This copy of the site was made without emscripten, by which this page computes. `make npm` installs it, then `make site` makes the page."
        (site / "_static" / "delone").mkdir()
        (site / "_static" / "delone" / "index.js").write_text(f"throw new Error({json.dumps(missing)});\n", encoding="utf-8")
        print("make_site.py: " + missing)


def broken_links(site):
    """The links of the site's pages to files and anchors that are not there."""
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted(site.rglob("*.html"))}
    for path, page in pages.items():
        for link in page.links:
            name, _, anchor = link.partition("#")
            name = urllib.parse.unquote(name.partition("?")[0])
            target = (path.parent / name).resolve() if name else path
            if target.is_dir():
                target /= "index.html"
            if not target.is_file():
                yield f"{path.relative_to(site)}: there is no {link}"
            elif anchor and target in pages and urllib.parse.unquote(anchor) not in pages[target].anchors:
                yield f"{path.relative_to(site)}: {target.relative_to(site)} has no anchor #{anchor}"


def main():
    parser = argparse.ArgumentParser(description="Builds the documentation site.")
    parser.add_argument("build", type=pathlib.Path, help="a build directory that holds the command and the Python module")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "build" / "site")
    arguments = parser.parse_args()
    build, site = arguments.build.resolve(), arguments.output.resolve()
    stage, scratch = site.parent / (site.name + "-pages"), site.parent / (site.name + "-scratch")
    for folder in (stage, site):
        shutil.rmtree(folder, ignore_errors=True)
    gather(stage)
    try:
        describe_commands(build, stage)
        run_doxygen(build, stage, scratch)
        describe_c(stage)
        environment = {**os.environ, "PYTHONPATH": str(build / "python"), "DELONE_SITE_CPP": str(scratch), "PYTHONDONTWRITEBYTECODE": "1"}
        (scratch / "tags.xml").unlink()
        subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", "-d", str(scratch.parent / "site-doctrees"),
                        "-c", str(ROOT / "docs" / "site"), str(stage), str(site)], check=True, env=environment)
        bundle_theme(site)
        add_package(site)
    except (command_manual.HelpError, OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"make_site.py: {error}")
    faults = list(broken_links(site))
    print("\n".join(faults) if faults else f"{site}/index.html: {len(list(site.rglob('*.html')))} pages, all links and anchors inside exist")
    sys.exit(f"make_site.py: {len(faults)} broken links" if faults else None)


if __name__ == "__main__":
    main()
