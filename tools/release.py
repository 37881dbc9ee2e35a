#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Walks the checklist of a release, and tags it.

Usage: release.py --dry-run [--build BUILD_DIR] [--skip STEP,...]    checks everything, says what it would do, changes nothing
       release.py --tag [--build BUILD_DIR]                          the same, then makes the tag; publishing stays with a person
       release.py --list                                             lists the steps

Every step is walked, whatever the others found. The packages are built in a scratch folder from the committed files alone, the wheel
with the compiled module of BUILD_DIR if it is given. Exit status 1 if any step finds a fault. Needs Git and python3-yaml.
"""
import argparse
import dataclasses
import datetime
import os
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


@dataclasses.dataclass
class Tree:
    """The files of a release."""
    root: pathlib.Path
    build: pathlib.Path = None
    today: datetime.date = dataclasses.field(default_factory=datetime.date.today)

    def read(self, name):
        path = self.root / name
        return path.read_text(encoding="utf-8") if path.is_file() else ""

    def run(self, *command, **more):
        """Runs a command, in the tree if not told otherwise; what it prints in one."""
        return subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **{"cwd": self.root, **more})

    @property
    def version(self):
        """The one of the CMake project, which all others follow."""
        found = re.search(r"^project\(delone VERSION (\d+\.\d+\.\d+)", self.read("CMakeLists.txt"), re.M)
        return found[1] if found else None

    @property
    def tag(self):
        return f"v{self.version}"


# Where a version is written, beside CMakeLists.txt. Files that do not exist are passed over; one that does must have a version.
PLACES = {
    "CITATION.cff": r"^version: *[\"']?([^\s\"']+)",
    "README.md": r"find_package\(delone ([\d.]+)",
    "docs/guide.md": r"find_package\(delone ([\d.]+)",
    "docs/install.md": r"GIT_TAG v([\d.]+)",
    "docs/c.md": r"libdelone_c\.so\.(\d+\.\d+)",
    "js/package.json": r"\"version\": *\"([^\"]+)\"",
    "octave/DESCRIPTION": r"^Version: ([\d.]+)",
    "docs/octave.md": r"delone-([\d.]+)\.tar\.gz",
    "debian/changelog": r"^delone \(([\d.]+)",
    "packaging/debian/changelog": r"^delone \(([\d.]+)",
    "packaging/conda/meta.yaml": r"set version = \"([^\"]+)\"",
    "packaging/vcpkg/vcpkg.json": r"\"version(?:-semver)?\": *\"([^\"]+)\"",
}


def check_versions(tree):
    if not tree.version:
        return ["CMakeLists.txt has no line 'project(delone VERSION x.y.z'"]
    faults = []
    for name, pattern in PLACES.items():
        if not (tree.root / name).exists():
            continue
        found = re.findall(pattern, tree.read(name), re.M)[:1]
        if not found:
            faults.append(f"{name}: no version was found")
        elif found[0] not in (tree.version, tree.version.rpartition(".")[0] if "find_package" in pattern or "so" in pattern else None):
            faults.append(f"{name}: {found[0]}, and not {tree.version}")
    project = tree.read("pyproject.toml").partition("[project]")[2].partition("\n[")[0]
    if not re.search(r"^dynamic *= *\[[^\]]*\"version\"", project, re.M):
        faults.append("pyproject.toml: 'version' is not dynamic, so that it may differ from that of CMakeLists.txt")
    if tree.build:
        command = tree.build / "delone"
        said = tree.run(command, "--version").stdout.strip() if command.is_file() else f"there is no {command}"
        if said != f"delone {tree.version}":
            faults.append(f"the command of the build says '{said}', and not 'delone {tree.version}'")
    return faults


MOST_LINES_OF_RELEASE = 90
SECTION = re.compile(r"^## \[(?P<version>[^\]]+)\](?: (?:–|-) (?P<date>.+))?$", re.M)


def changelog_date(tree):
    """(the date of the release's section, None) or (None, what is wrong)."""
    sections = list(SECTION.finditer(tree.read("CHANGELOG.md")))
    if not sections:
        return None, "CHANGELOG.md has no section '## [x.y.z] – date'"
    if sections[0]["version"].lower() == "unreleased":
        end = sections[1].start() if len(sections) > 1 else None
        if tree.read("CHANGELOG.md")[sections[0].end():end].strip():
            return None, "CHANGELOG.md: the section [Unreleased] is not empty"
        del sections[0]
    if not sections or sections[0]["version"] != tree.version:
        return None, f"CHANGELOG.md: the newest section is [{sections[0]['version'] if sections else 'Unreleased'}], and not [{tree.version}]"
    try:
        return datetime.date.fromisoformat(sections[0]["date"] or ""), None
    except ValueError:
        return None, f"CHANGELOG.md: the date of [{tree.version}] is '{sections[0]['date']}', and not year-month-day"


def check_changelog(tree):
    date, fault = changelog_date(tree)
    if fault:
        return [fault]
    text = tree.read("CHANGELOG.md")
    sections = list(SECTION.finditer(text))
    here = next(i for i, section in enumerate(sections) if section["version"] == tree.version)
    end = sections[here + 1].start() if here + 1 < len(sections) else len(text)
    faults = [f"CHANGELOG.md: {date} is yet to come"] if date > tree.today else []
    if not re.search(r"^- ", text[sections[here].end():end], re.M):
        faults.append(f"CHANGELOG.md: [{tree.version}] lists no changes")
    lines = text[sections[here].start():end].count("\n")
    if lines > MOST_LINES_OF_RELEASE:
        faults.append(f"CHANGELOG.md: [{tree.version}] has {lines} lines; {MOST_LINES_OF_RELEASE}, one page, are the most")
    return faults


# What the format (citation-file-format.github.io, 1.2.0) requires, and what it allows of what is used here.
CFF_REQUIRED = {"cff-version", "message", "title", "authors"}
CFF_KEYS = CFF_REQUIRED | {"abstract", "commit", "contact", "date-released", "doi", "identifiers", "keywords", "license", "license-url",
                           "preferred-citation", "references", "repository", "repository-artifact", "repository-code", "type", "url", "version"}
CFF_REFERENCE = {"type", "title", "authors", "abstract", "date-published", "doi", "edition", "end", "institution", "issue", "journal", "month", "notes",
                 "number", "pages", "publisher", "section", "start", "url", "version", "volume", "year"}
CFF_REFERENCE_TYPES = {"article", "book", "conference-paper", "report", "software", "thesis", "website", "generic"}


def person_faults(where, people):
    if not isinstance(people, list) or not people:
        return [f"{where}: no authors"]
    return [f"{where}: an author is a person with family-names, or an entity with a name: {who}" for who in people
            if not (isinstance(who, dict) and (isinstance(who.get("name"), str) or isinstance(who.get("family-names"), str)))]


def citation_faults(text):
    """What CITATION.cff breaks of its format."""
    import yaml
    try:
        found = yaml.safe_load(text)
    except yaml.YAMLError as error:
        return [f"CITATION.cff: {' '.join(str(error).split())}"]
    if not isinstance(found, dict):
        return ["CITATION.cff: no mapping"]
    faults = [f"CITATION.cff: {key} is missing" for key in sorted(CFF_REQUIRED - set(found))]
    faults += [f"CITATION.cff: there is no key {key}" for key in sorted(set(found) - CFF_KEYS)]
    if str(found.get("cff-version")) != "1.2.0":
        faults.append("CITATION.cff: cff-version is not 1.2.0")
    if found.get("type", "software") not in ("software", "dataset"):
        faults.append(f"CITATION.cff: type {found['type']}")
    for key in ("title", "message", "abstract"):
        if key in found and (not isinstance(found[key], str) or not found[key].strip()):
            faults.append(f"CITATION.cff: {key} is no text")
    faults += person_faults("CITATION.cff", found.get("authors"))
    for reference in found.get("references", []):
        where = f"CITATION.cff: the reference '{reference.get('title')}'"
        faults += [f"{where} has no {key}" for key in ("type", "title", "authors") if key not in reference]
        faults += [f"{where}: there is no key {key}" for key in sorted(set(reference) - CFF_REFERENCE)]
        if reference.get("type") not in CFF_REFERENCE_TYPES:
            faults.append(f"{where}: type {reference.get('type')}")
        if "doi" in reference and not re.fullmatch(r"10\.\d{4,9}(?:\.\d+)?/\S+", str(reference["doi"])):
            faults.append(f"{where}: doi {reference['doi']}")
        if not isinstance(reference.get("year", 2000), int):
            faults.append(f"{where}: year {reference['year']}")
        faults += person_faults(where, reference.get("authors"))
    return faults


def check_citation(tree):
    faults = citation_faults(tree.read("CITATION.cff"))
    found = re.search(r"^date-released: *[\"']?(\S+?)[\"']?$", tree.read("CITATION.cff"), re.M)
    date, _ = changelog_date(tree)
    if not found:
        faults.append("CITATION.cff: date-released is missing")
    elif date and found[1] != date.isoformat():
        faults.append(f"CITATION.cff: date-released is {found[1]}, but CHANGELOG.md says {date}")
    license_of_project = re.search(r'^LICENSE = "([^"]+)"', tree.read("setup.py"), re.M)
    if license_of_project and f"license: {license_of_project[1]}\n" not in tree.read("CITATION.cff"):
        faults.append(f"CITATION.cff: the license is not {license_of_project[1]}")
    return faults


def check_papers(tree):
    """LICENSE, and SECURITY.md with what somebody who has found a fault has to know."""
    faults = [f"there is no {name}" for name in ("LICENSE", "SECURITY.md", "README.md", "CONTRIBUTING.md") if not tree.read(name)]
    headings = re.findall(r"^## (.+)$", tree.read("SECURITY.md"), re.M)
    return faults + [f"SECURITY.md has no section '{title}'" for title in ("Versions", "What counts", "How to report") if title not in headings]


def check_clean(tree):
    changed = tree.run("git", "status", "--porcelain")
    if changed.returncode:
        return [changed.stdout.strip()]
    return [f"not committed: {line}" for line in changed.stdout.splitlines()]


def check_tag(tree):
    if not tree.version:
        return ["no version"]
    listed = tree.run("git", "tag", "--list", "v*")
    if listed.returncode:
        return [listed.stdout.strip()]
    tags = listed.stdout.split()
    number = [int(part) for part in tree.version.split(".")]
    newer = [tag for tag in tags if re.fullmatch(r"v\d+\.\d+\.\d+", tag) and [int(part) for part in tag[1:].split(".")] > number]
    return [f"the tag {tree.tag} exists"] * (tree.tag in tags) + [f"{tag} is newer than {tree.tag}" for tag in newer]


def check_docs(tree):
    faults = []
    for command in (["tools/check_docs.py", "--prose"], ["tools/check_vocabulary.py"], ["tools/check_layering.py"]):
        done = tree.run(sys.executable, "-B", *command)
        if done.returncode:
            faults.append(f"{' '.join(command)}: {done.stdout.strip()}")
    return faults


def committed(tree, folder):
    """A copy of the committed files in a folder."""
    copy = pathlib.Path(folder) / "tree"
    copy.mkdir()
    archive = subprocess.run(["git", "archive", "HEAD"], cwd=tree.root, check=True, stdout=subprocess.PIPE)
    subprocess.run(["tar", "-x", "-C", str(copy)], input=archive.stdout, check=True)
    return copy


NEEDED_IN_SDIST = ("CMakeLists.txt", "LICENSE", "THIRD_PARTY_LICENSES", "README.md", "pyproject.toml", "setup.py", "c/", "cli/", "cmake/", "data/", "docs/",
                   "examples/", "include/", "mpi/", "packaging/", "src/", "python/", "tests/", "tools/")


def check_sdist(tree):
    """It can be made, and has every file that building and testing the module takes, and its documentation."""
    with tempfile.TemporaryDirectory(prefix="delone_release_") as folder:
        copy = committed(tree, folder)
        done = tree.run(sys.executable, "setup.py", "-q", "sdist", "--formats=gztar", "-d", pathlib.Path(folder) / "dist", cwd=copy)
        made = list(pathlib.Path(folder).glob("dist/*.tar.gz"))
        if done.returncode or len(made) != 1:
            return [f"setup.py sdist failed: {done.stdout.strip()[-2000:]}"]
        with tarfile.open(made[0]) as archive:
            inside = {name.partition("/")[2] for name in archive.getnames()}
        needed = {path for path in tree.run("git", "ls-files").stdout.splitlines() if path.startswith(NEEDED_IN_SDIST)}
        missing = sorted(needed - inside)
        faults = [f"{made[0].name}: {len(missing)} of {len(needed)} files are missing, {', '.join(missing[:3])} …"] if missing else []
        return faults + [f"{made[0].name} is not of version {tree.version}"] * (f"-{tree.version}.tar.gz" not in made[0].name)


LARGEST_WHEEL = 12 * 10**6  # bytes


def platform_faults(wheel):
    """What is wrong with the platform that a wheel's name claims."""
    if not any(re.search(r"\.so(\.\d+)*$", name) for name in zipfile.ZipFile(wheel).namelist()):
        return []
    done = subprocess.run([sys.executable, "-B", str(ROOT / "tools" / "platform_tag.py"), str(wheel)], capture_output=True, text=True)
    if done.returncode:
        return [f"{wheel.name}: {' '.join((done.stdout + done.stderr).splitlines()[-2:])}"]
    return [f"{wheel.name} is for systems like this one only"] * ("-linux_" in wheel.name)


def check_wheel(tree):
    """It can be built, has the module, says truly which systems it is for, and is not too large."""
    with tempfile.TemporaryDirectory(prefix="delone_release_") as folder:
        copy = committed(tree, folder)
        environment = {**os.environ, **({"DELONE_BUILD_DIR": str(tree.build.resolve())} if tree.build else {})}
        done = tree.run(sys.executable, "-m", "pip", "wheel", "-q", "--no-build-isolation", "--no-deps", "--no-index", "-w", pathlib.Path(folder) / "dist", ".",
                        cwd=copy, env=environment)
        made = list(pathlib.Path(folder).glob("dist/*.whl"))
        if done.returncode or len(made) != 1:
            return [f"pip wheel failed: {done.stdout.strip()[-2000:]}"]
        names = zipfile.ZipFile(made[0]).namelist()
        faults = [f"{made[0].name} is not of version {tree.version}"] * (not made[0].name.startswith(f"delone-{tree.version}-"))
        faults += [f"{made[0].name} has no {what}" for what, pattern in {"compiled module": r"delone/_core\..*\.so", "license": r".*/LICENSE",
                                                                         "py.typed": r"delone/py\.typed"}.items()
                   if not any(re.fullmatch(pattern, name) for name in names)]
        size = made[0].stat().st_size
        faults += platform_faults(made[0])
        return faults + [f"{made[0].name} has {size} bytes, more than {LARGEST_WHEEL}"] * (size > LARGEST_WHEEL)


STEPS = {
    "versions": ("the versions agree", check_versions),
    "changelog": ("the changelog has a dated section", check_changelog),
    "citation": ("CITATION.cff is valid and dated", check_citation),
    "papers": ("license, security policy and readme are there", check_papers),
    "clean": ("everything is committed", check_clean),
    "tag": ("the tag is free, and newer than all others", check_tag),
    "docs": ("documentation, vocabulary and layering hold", check_docs),
    "sdist": ("the source distribution is complete", check_sdist),
    "wheel": ("a wheel can be built", check_wheel),
}
# What no script can answer for.
BY_HAND = ("make test, make lint and make docs pass on the commit", "make matrix passes: its table goes into the notes of the release",
           "make bench shows no loss against the last release", "make site builds; its pages are what shall be published")


def plan(tree):
    """The commands of a release, in order. Only the first is run by this script."""
    return [f"git tag --annotate {tree.tag} --message 'delone {tree.version}'", f"git push origin {tree.tag}", "python3 setup.py sdist, make wheel",
            "twine upload the source distribution and the wheels", f"publish build/site, and [{tree.version}] of CHANGELOG.md as notes"]


def walk(tree, skipped=()):
    """Walks all steps, prints what they find. Returns the number of faults."""
    count = 0
    for name, (title, check) in STEPS.items():
        if name in skipped:
            print(f"  –   {name}: skipped")
            continue
        try:
            faults = check(tree)
        except (OSError, ImportError, subprocess.SubprocessError) as error:
            faults = [str(error)]
        print(f"  no  {name}" if faults else f"  ok  {name}: {title}")
        for fault in faults:
            print("        " + fault.replace("\n", "\n        "))
        count += len(faults)
    return count


def main():
    parser = argparse.ArgumentParser(description="Walks the checklist of a release, and tags it.")
    action = parser.add_mutually_exclusive_group(required=True)
    action.add_argument("--dry-run", action="store_true", help="change nothing")
    action.add_argument("--tag", action="store_true", help="make the tag if nothing is wrong")
    action.add_argument("--list", action="store_true", help="list the steps")
    parser.add_argument("--build", type=pathlib.Path, help="a build directory with the command and the Python module")
    parser.add_argument("--skip", default="", help="steps to leave out, separated by commas; only with --dry-run")
    parser.add_argument("--tree", type=pathlib.Path, default=ROOT, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    skipped = [name for name in arguments.skip.split(",") if name]
    if unknown := [name for name in skipped if name not in STEPS]:
        parser.error(f"--skip: there is no step {', '.join(unknown)}")
    if skipped and not arguments.dry_run:
        parser.error("--skip: only with --dry-run")
    if arguments.list:
        for name, (title, _) in STEPS.items():
            print(f"{name:<12}{title}")
        return None
    tree = Tree(arguments.tree.resolve(), arguments.build.resolve() if arguments.build else None)
    print(f"Release {tree.version} of {tree.root}")
    faults = walk(tree, skipped)
    print("To be seen to by hand:")
    print("".join(f"  -   {what}\n" for what in BY_HAND), end="")
    if faults:
        return f"release.py: {faults} fault(s); nothing was done"
    print("What would be done:" if arguments.dry_run else "What remains to be done, after the tag:")
    commands = plan(tree)
    if not arguments.dry_run:
        subprocess.run(["git", "tag", "--annotate", tree.tag, "--message", f"delone {tree.version}"], cwd=tree.root, check=True)
        del commands[0]
    print("".join(f"  {i}.  {command}\n" for i, command in enumerate(commands, 1)), end="")
    return None


if __name__ == "__main__":
    sys.exit(main())
