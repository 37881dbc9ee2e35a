# SPDX-License-Identifier: BSD-3-Clause
"""Builds the compiled module of the Python package with CMake; everything else is in pyproject.toml.

    pip install .                                                 fetches the build tools
    pip install --no-build-isolation .                            uses those that are installed
    DELONE_BUILD_DIR=build/release pip install --no-build-isolation .    takes the module from a build tree that has it

A wheel stands alone: libraries that not every system has are built in, or are put beside the module; its name says which Linux it
needs (tools/platform_tag.py). Variables of the environment:

    DELONE_CMAKE_ARGS             arguments for CMake, for example "-DDELONE_LARGEST_COMPILED_DIMENSION=6". Libraries that are not installed
                                  are fetched; "-DDELONE_FETCH_DEPENDENCIES=ALL" builds all from sources, OFF fetches none
    DELONE_SYSTEM_LIBRARIES=1     the module uses the system's libraries where they are, for packages of a distribution: the wheel has none,
                                  its name claims nothing, and nothing is fetched
    CMAKE_BUILD_PARALLEL_LEVEL    jobs of the compiler
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

import setuptools
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70.1
    try:
        from wheel.bdist_wheel import bdist_wheel
    except ImportError:  # what makes no wheel does not need it
        bdist_wheel = object

ROOT = pathlib.Path(__file__).resolve().parent
SCRATCH = ROOT / "build" / "wheel"  # what setuptools leaves behind goes where everything built goes
LICENSE = "BSD-3-Clause"
BILL = "delone.cdx.json"  # of materials: the libraries in a wheel (python/sbom.cmake)
SYSTEM_LIBRARIES = os.environ.get("DELONE_SYSTEM_LIBRARIES", "0") not in ("", "0")

sys.path.insert(0, str(ROOT / "tools"))
import platform_tag  # noqa: E402


def version():
    """The version of the CMake project."""
    found = re.search(r"^project\(delone VERSION (\d+(?:\.\d+)+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)
    if not found:
        sys.exit("setup.py: CMakeLists.txt has no line 'project(delone VERSION ...'")
    return found[1]


class CMakeBuild(build_ext):
    """Compiles delone._core with CMake, or takes it from the build tree that DELONE_BUILD_DIR names, by its install component."""

    def build_extension(self, extension):
        build = os.environ.get("DELONE_BUILD_DIR")
        build = pathlib.Path(build).resolve() if build else self.configure_and_build()
        prefix = pathlib.Path(self.build_temp).resolve() / "install"
        shutil.rmtree(prefix, ignore_errors=True)
        component = "python" if SYSTEM_LIBRARIES else "wheel"
        subprocess.run(["cmake", "--install", str(build), "--component", component, "--prefix", str(prefix)], check=True)
        name = pathlib.Path(self.get_ext_filename(extension.name)).name
        found = list(prefix.rglob(name))
        if not found:
            sys.exit(f"setup.py: {build} has no {name}; it was built for another Python, without DELONE_BUILD_PYTHON, or as a shared library")
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).parent
        target.mkdir(parents=True, exist_ok=True)
        for old in target.glob("*.so*"):  # of a build with other libraries
            old.unlink()
        shutil.copy2(found[0], target)
        if not SYSTEM_LIBRARIES:
            shutil.copy2(prefix / BILL, self.build_temp)
        # The libraries beside it, each by the name that the module asks for, which may be that of a link.
        libraries = [path for path in prefix.rglob("*.so*") if path != found[0]]
        named = {path.resolve() for path in libraries if path.is_symlink()}
        for library in libraries:
            if library not in named:
                shutil.copy2(library, target / library.name)

    def configure_and_build(self):
        build = pathlib.Path(self.build_temp).resolve() / "cmake"
        configure = ["cmake", "-S", str(ROOT), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release", "-DDELONE_BUILD_PYTHON=ON", "-DBUILD_SHARED_LIBS=OFF",
                     "-DDELONE_BUILD_CLI=OFF", "-DDELONE_BUILD_C=OFF", "-DDELONE_BUILD_MPI=OFF", "-DDELONE_INSTALL=OFF",
                     f"-DPython_EXECUTABLE={sys.executable}"]
        if not SYSTEM_LIBRARIES:
            configure += ["-DDELONE_FETCH_DEPENDENCIES=MISSING"]
        if shutil.which("ninja"):
            configure += ["-G", "Ninja"]
        if shutil.which("ccache"):
            configure += ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
        try:
            import pybind11
            configure.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        except ImportError:
            pass  # CMake looks for a system-wide one
        subprocess.run(configure + shlex.split(os.environ.get("DELONE_CMAKE_ARGS", "")), check=True)
        jobs = [] if "CMAKE_BUILD_PARALLEL_LEVEL" in os.environ else ["--parallel", str(os.cpu_count() or 1)]
        target = "delone_python" if SYSTEM_LIBRARIES else "delone_wheel"
        subprocess.run(["cmake", "--build", str(build), "--target", target, *jobs], check=True)
        return build


class Wheel(bdist_wheel):
    """Has the bill of materials that CMake made. For Linux it is named by what its libraries need, if no --plat-name is given."""

    def write_wheelfile(self, folder, *rest, **options):
        super().write_wheelfile(folder, *rest, **options)
        if not SYSTEM_LIBRARIES:
            sboms = pathlib.Path(folder) / "sboms"
            sboms.mkdir()
            shutil.copy2(pathlib.Path(self.get_finalized_command("build_ext").build_temp) / BILL, sboms)

    def get_tag(self):
        python, abi, system = super().get_tag()
        libraries = sorted(pathlib.Path(self.bdist_dir).rglob("*.so*"))
        if libraries and system.startswith("linux_") and not self.plat_name_supplied and not SYSTEM_LIBRARIES:
            system, why = platform_tag.tag(libraries, system.partition("_")[2])
            if why:
                print(f"setup.py: this wheel is for systems like this one: {why}", file=sys.stderr)
        return python, abi, system


def license_metadata():
    """The license as an expression (PEP 639) where setuptools knows that form, and in the older one before. pyproject.toml would have to
    choose: the new form is an error before setuptools 77, and the old one is deprecated since."""
    new = int(setuptools.__version__.partition(".")[0]) >= 77
    return {"license_expression" if new else "license": LICENSE}


SCRATCH.mkdir(parents=True, exist_ok=True)
os.chdir(ROOT)
setup(
    **license_metadata(),
    version=version(),
    ext_modules=[Extension("delone._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild, **({} if bdist_wheel is object else {"bdist_wheel": Wheel})},
    options={"build": {"build_base": "build/wheel"}, "egg_info": {"egg_base": "build/wheel"}},
)
