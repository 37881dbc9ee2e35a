#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The lowest platform tag that a wheel for Linux may have: manylinux_X_Y (PEP 600), from the symbols that its libraries need.

Usage: platform_tag.py WHEEL      prints what each library in it needs, and the tag; exit status 1 if its name claims another one

A library may need others in the wheel, and those of every Linux: at versions that a system with glibc X.Y has. setup.py names wheels
with this module. Where it finds anything else, or no objdump (binutils), the tag is linux_…, which claims nothing.
"""
import dataclasses
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import zipfile

# What every Linux has (PEP 600), as far as a C++ library may need it; zlib is among it.
PLATFORM = re.compile(r"ld-linux.*|ld64|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+|z)")

# The newest versions of symbols that systems with this glibc have: of glibc, libstdc++, its C++ runtime and libgcc. As in the policies of
# auditwheel (6.8, MIT license), which are the common reading of PEP 600; where processors differ, the lower number.
POLICIES = [
    ((2, 17), {"GLIBC": (2, 17), "GLIBCXX": (3, 4, 19), "CXXABI": (1, 3, 7), "GCC": (4, 7)}),
    ((2, 24), {"GLIBC": (2, 24), "GLIBCXX": (3, 4, 22), "CXXABI": (1, 3, 10), "GCC": (4, 7)}),
    ((2, 27), {"GLIBC": (2, 27), "GLIBCXX": (3, 4, 24), "CXXABI": (1, 3, 11), "GCC": (7, 0)}),
    ((2, 28), {"GLIBC": (2, 28), "GLIBCXX": (3, 4, 24), "CXXABI": (1, 3, 11), "GCC": (7, 0)}),
    ((2, 31), {"GLIBC": (2, 31), "GLIBCXX": (3, 4, 28), "CXXABI": (1, 3, 12), "GCC": (7, 0)}),
    ((2, 34), {"GLIBC": (2, 34), "GLIBCXX": (3, 4, 29), "CXXABI": (1, 3, 13), "GCC": (7, 0)}),
    ((2, 35), {"GLIBC": (2, 35), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (11, 0)}),
    ((2, 36), {"GLIBC": (2, 36), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (11, 0)}),
    ((2, 38), {"GLIBC": (2, 38), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (11, 0)}),
    ((2, 39), {"GLIBC": (2, 39), "GLIBCXX": (3, 4, 33), "CXXABI": (1, 3, 15), "GCC": (14, 0)}),
    ((2, 41), {"GLIBC": (2, 41), "GLIBCXX": (3, 4, 33), "CXXABI": (1, 3, 15), "GCC": (14, 0)}),
]
RELATIVE_RELOCATIONS = "GLIBC_ABI_DT_RELR"  # a version of no number: glibc 2.36


@dataclasses.dataclass
class Needs:
    """What one library needs: names of other libraries, and (family, version) of symbols."""
    libraries: set
    versions: set

    def highest(self):
        """family → its highest version."""
        found = {}
        for family, version in self.versions:
            found[family] = max(found.get(family, ()), version)
        return found


def read(printed):
    """The needs of a library, from what `objdump -p` prints of it."""
    versions = set()
    for name in re.findall(r"^ +0x[0-9a-f]+ 0x[0-9a-f]+ \d+ (\S+)$", printed.partition("Version References:")[2], re.M):
        name = "GLIBC_2.36" if name == RELATIVE_RELOCATIONS else name
        family, _, version = name.rpartition("_")
        if not re.fullmatch(r"\d+(\.\d+)*", version):
            raise ValueError(f"there is no rule for symbols of version {name}")
        versions.add((family, tuple(int(part) for part in version.split("."))))
    return Needs(set(re.findall(r"^ +NEEDED +(\S+)$", printed, re.M)), versions)


def needs_of(path):
    """The needs of a file. OSError without objdump, ValueError for what it cannot read."""
    done = subprocess.run(["objdump", "-p", str(path)], capture_output=True, text=True, env={"LC_ALL": "C", "PATH": "/usr/local/bin:/usr/bin:/bin"})
    if done.returncode:
        raise ValueError(done.stderr.strip())
    return read(done.stdout)


def lowest_policy(needs, bundled):
    """(X, Y) of manylinux_X_Y for libraries with these needs, of which some are for the `bundled` ones; ValueError says why there is none."""
    for name in set().union(*(each.libraries for each in needs)) - set(bundled):
        if not PLATFORM.fullmatch(name.partition(".so")[0]):
            raise ValueError(f"{name} is neither in the wheel nor on every Linux")
    versions = set().union(*(each.versions for each in needs))
    for policy, newest in POLICIES:
        if all(version <= newest[family] for family, version in versions if family in newest):
            return policy
    raise ValueError(f"symbols are newer than those of glibc {'.'.join(map(str, POLICIES[-1][0]))}")


def tag(paths, machine=None):
    """(the platform tag of a wheel with these libraries, why it is no better or None)."""
    machine = machine or platform.machine()
    try:
        policy = lowest_policy([needs_of(path) for path in paths], {pathlib.Path(path).name for path in paths})
        return f"manylinux_{policy[0]}_{policy[1]}_{machine}", None
    except (OSError, ValueError) as error:
        return f"linux_{machine}", str(error)


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    wheel = pathlib.Path(sys.argv[1])
    claimed = wheel.stem.split("-")[-1]
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(wheel) as archive:
        paths = [archive.extract(name, folder) for name in archive.namelist() if re.search(r"\.so(\.\d+)*$", name)]
        for path in paths:
            try:
                needs = needs_of(path)
            except (OSError, ValueError) as error:
                print(f"{pathlib.Path(path).name}: {error}")
                continue
            versions = [f"{family}_{'.'.join(map(str, version))}" for family, version in sorted(needs.highest().items())]
            print(f"{pathlib.Path(path).name}: {' '.join(sorted(needs.libraries) + versions)}")
        found, why = tag(paths, re.sub(r"^(manylinux_\d+_\d+|linux)_", "", claimed))
    print(found + (f": {why}" if why else ""))
    if claimed != found:
        sys.exit(f"platform_tag.py: the name of the wheel says {claimed}")


if __name__ == "__main__":
    main()
