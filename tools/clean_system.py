# SPDX-License-Identifier: BSD-3-Clause
"""A Debian in a folder, made by mmdebstrap, and commands that run in it. Needs root, a Debian, and a mirror in /etc/apt."""
import pathlib
import re
import shutil
import subprocess

SOURCES = pathlib.Path("/etc/apt/sources.list.d/debian.sources")
# The mounts are gone when the command has ended.
ENTER = 'mount --rbind /proc "$0/proc" && mount --rbind /dev "$0/dev" && exec chroot "$0" "$@"'


def run(*command, **more):
    print("+", *command, flush=True)
    return subprocess.run([str(word) for word in command], check=True, **more)


def make(root, release=None, packages=()):
    """Makes the folder root: the packages that every Debian has, and these, of a release: by default the one of this machine."""
    shutil.rmtree(root, ignore_errors=True)
    own = re.search(r"^VERSION_CODENAME=(\w+)", pathlib.Path("/etc/os-release").read_text(encoding="utf-8"), re.M)[1]
    release = release or own
    mirror = []
    if SOURCES.exists():
        mirror = [root.parent / f"{release}.sources"]
        mirror[0].write_text(SOURCES.read_text(encoding="utf-8").replace(own, release), encoding="utf-8")
    included = [f"--include={','.join(packages)}"] if packages else []
    run("mmdebstrap", "--quiet", "--variant=minbase", *included, release, root, *mirror)


def inside(root):
    """The words before a command that runs in it, as root and with an environment of its own; assignments to variables may follow."""
    return ["unshare", "--mount", "sh", "-c", ENTER, root, "env", "-i", "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "HOME=/root", "LC_ALL=C.UTF-8",
            "DEBIAN_FRONTEND=noninteractive"]
