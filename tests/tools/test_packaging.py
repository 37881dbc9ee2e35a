# SPDX-License-Identifier: BSD-3-Clause
"""The recipes of packaging/ agree with the tree: they parse, their options and dependencies are those of the build, the C symbols those
of the header. Exit status 77 without PyYAML and Jinja2.
"""
import json
import os
import pathlib
import re
import subprocess
import sys

try:
    import jinja2
    import yaml
except ImportError:
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PACKAGING = ROOT / "packaging"


def read(path):
    return (ROOT / path).read_text(encoding="utf-8")


VERSION = re.search(r"^project\(delone VERSION (\S+)", read("CMakeLists.txt"), re.M)[1]
API = ".".join(VERSION.split(".")[:2]) if VERSION.startswith("0.") else VERSION.split(".")[0]
OPTIONS = set(re.findall(r"^(?:option\(|set\()(DELONE_\w+)", read("cmake/options.cmake"), re.M))
LISTED = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*CMakeLists.txt", "cmake/*.cmake"], cwd=ROOT, text=True,
                        stdout=subprocess.PIPE, check=False).stdout.split()
BUILD_FILES = "\n".join(read(path) for path in LISTED if path.startswith(("CMakeLists", "cmake/", "src/", "cli/", "python/")))

# What the build looks for, and its names among packages of Debian, conda-forge and vcpkg.
DEPENDENCIES = {
    "find_package(Boost": ("libboost-dev", "libboost-headers", "boost-multiprecision"),
    "find_package(CLI11": ("libcli11-dev", "cli11", "cli11"),
    "fast_float/fast_float.h": ("libfast-float-dev", "fast_float", "fast-float"),
    "find_package(fmt": ("libfmt-dev", "fmt", "fmt"),
    "find_package(hwy": ("libhwy-dev", "libhwy", "highway"),
    "find_package(nlohmann_json": ("nlohmann-json3-dev", "nlohmann_json", "nlohmann-json"),
    "find_package(TBB": ("libtbb-dev", "tbb-devel", "tbb"),
    "find_package(ZLIB": ("zlib1g-dev", "zlib", "zlib"),
    "find_package(pybind11": ("pybind11-dev", "pybind11", None),
    "find_package(Python 3": ("python3-dev", "python", None),
    "import numpy": ("python3-numpy", "numpy", None),
}
TOOLS = {
    0: {"cmake", "debhelper-compat", "dh-sequence-python3", "ninja-build", "pkgconf", "python3-setuptools"},
    1: {"cmake", "ninja", "compiler_c", "compiler_cxx", "stdlib_c", "libdelone", "setuptools"},
    2: {"vcpkg-cmake", "vcpkg-cmake-config"},
}


def check_dependencies(named, column, without=()):
    """Every package that is named is one that the build looks for, or a tool; and all that the build looks for are named."""
    known = {names[column] for names in DEPENDENCIES.values() if names[column]}
    assert named - known - TOOLS[column] == set(), named - known - TOOLS[column]
    assert known - named - set(without) == set(), known - named - set(without)


def check_options(text):
    used = set(re.findall(r"(?<![\w])-D(DELONE_\w+)", text)) | set(re.findall(r"^ +\w+ (DELONE_\w+)", text, re.M))
    assert used and used - OPTIONS == set(), used - OPTIONS


def test_build_files():
    for words in DEPENDENCIES:
        assert words in BUILD_FILES, f"the build does not look for {words}"


def package_names(requirements):
    return {str(each).split()[0] for each in requirements}


def test_conda():
    text = read("packaging/conda/meta.yaml")
    text = re.sub(r"  # \[\w+\]$", "", text, flags=re.M)  # selectors of platforms
    rendered = jinja2.Environment(undefined=jinja2.StrictUndefined).from_string(text).render(
        compiler=lambda language: f"compiler_{language}", stdlib=lambda language: f"stdlib_{language}",
        pin_subpackage=lambda name, **_: f"{name} {VERSION}")
    recipe = yaml.safe_load(rendered)
    assert str(recipe["package"]["version"]) == VERSION
    assert [output["name"] for output in recipe["outputs"]] == ["libdelone", "delone-cli", "delone"]
    named = set()
    for output in recipe["outputs"]:
        assert output["about"]["license"] == "BSD-3-Clause"
        script = PACKAGING / "conda" / output["script"]
        assert os.access(script, os.X_OK), script
        subprocess.run(["bash", "-n", str(script)], check=True)
        check_options(script.read_text(encoding="utf-8"))
        requirements = output["requirements"]
        named |= package_names(requirements["build"]) | package_names(requirements["host"])
    check_dependencies(named, 1)
    assert any(f"libdelone.so.{API}" in command for command in recipe["outputs"][0]["test"]["commands"])


def test_vcpkg():
    port = json.loads(read("packaging/vcpkg/vcpkg.json"))
    assert port["version"] == VERSION and port["license"] == "BSD-3-Clause"
    assert set(port) <= {"$schema", "name", "version", "description", "license", "supports", "dependencies", "default-features", "features", "homepage"}
    assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", port["name"])
    portfile = read("packaging/vcpkg/portfile.cmake")
    check_options(portfile)
    named = set()
    for part in [port, *port["features"].values()]:
        for dependency in part.get("dependencies", []):
            named.add(dependency if isinstance(dependency, str) else dependency["name"])
    check_dependencies(named, 2)
    offered = dict(re.findall(r"^    (\w+) (DELONE_\w+)", portfile, re.M))
    assert set(offered) == set(port["features"]), offered
    assert set(port["default-features"]) <= set(port["features"])
    assert "delone::delone" in read("packaging/vcpkg/usage")


def paragraphs(text):
    return [dict(re.findall(r"^([\w-]+):[ \n]*((?:.*\n(?: .*\n)*))", part + "\n", re.M)) for part in text.strip().split("\n\n")]


def test_debian():
    source, *binaries = paragraphs(read("packaging/debian/control"))
    named = {word.split()[0] for word in source["Build-Depends"].split(",")}
    check_dependencies(named, 0)
    names = {each["Package"].strip() for each in binaries}
    assert names == {f"libdelone{API}", f"libdelone-c{API}", "libdelone-dev", "delone", "python3-delone", "delone-doc"}, names
    check_options(read("packaging/debian/rules"))
    for each in PACKAGING.glob("debian/*.install"):
        assert each.stem in names, each
    for each in paragraphs(read("packaging/debian/tests/control")):
        for name in each["Tests"].split():
            assert os.access(PACKAGING / "debian/tests" / name, os.X_OK), name
    declared = set(re.findall(r"^DELONE_C_API [^;(]*?(\w+)\(", read("include/delone/delone.h"), re.M))
    symbols = set(re.findall(rf"^ (delone_\w+)@DELONE_C_{API} ", read(f"packaging/debian/libdelone-c{API}.symbols"), re.M))
    assert symbols == declared, symbols ^ declared


if __name__ == "__main__":
    for name, test in sorted(globals().items()):
        if name.startswith("test_"):
            test()
