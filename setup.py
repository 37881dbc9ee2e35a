# SPDX-License-Identifier: BSD-3-Clause
"""Builds the compiled module of the Python package with CMake; everything else is in pyproject.toml.

    pip install .                                                 fetches the build tools
    pip install --no-build-isolation .                            uses those that are installed
    DELONE_BUILD_DIR=build/release pip install --no-build-isolation .    takes the module from a build tree that has it

Arguments for CMake: DELONE_CMAKE_ARGS, for example "-DDELONE_LARGEST_COMPILED_DIMENSION=6". The compiler's jobs: CMAKE_BUILD_PARALLEL_LEVEL.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
SCRATCH = ROOT / "build" / "wheel"  # what setuptools leaves behind goes where everything built goes


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
        subprocess.run(["cmake", "--install", str(build), "--component", "python", "--prefix", str(prefix)], check=True)
        name = pathlib.Path(self.get_ext_filename(extension.name)).name
        found = list(prefix.rglob(name))
        if not found:
            sys.exit(f"setup.py: {build} has no {name}; it was built for another Python, or without DELONE_BUILD_PYTHON")
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(found[0], target)
        for library in prefix.rglob("libtbb.so*"):  # what the module needs beside it
            shutil.copy2(library, target.parent)

    def configure_and_build(self):
        build = pathlib.Path(self.build_temp).resolve() / "cmake"
        configure = ["cmake", "-S", str(ROOT), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release", "-DDELONE_BUILD_PYTHON=ON",
                     "-DDELONE_BUILD_CLI=OFF", "-DDELONE_BUILD_MPI=OFF", f"-DPython_EXECUTABLE={sys.executable}"]
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
        subprocess.run(["cmake", "--build", str(build), "--target", "delone_python", *jobs], check=True)
        return build


SCRATCH.mkdir(parents=True, exist_ok=True)
os.chdir(ROOT)
setup(
    version=version(),
    ext_modules=[Extension("delone._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    options={"build": {"build_base": "build/wheel"}, "egg_info": {"egg_base": "build/wheel"}},
)
