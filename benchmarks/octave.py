#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times functions of the Octave package next to those that Octave has, which call Qhull; in turn, in one Octave, on the same points.

  octave.py FOLDER ...          the folders of the installed package: one has +delone, one the compiled function
  octave.py FOLDER ... --only 3D --rounds 3

Figures are medians of processor seconds over the rounds, one thread each.
"""
import argparse
import subprocess

# name -> (the points, what is called; %s is "delone." or nothing)
CASES = {
    "delaunayn 2D 1e5": ("x = rand (1e5, 2);", "%sdelaunayn (x);"),
    "delaunayn 3D 1e5": ("x = rand (1e5, 3);", "%sdelaunayn (x);"),
    "delaunayn 4D 1e4": ("x = rand (1e4, 4);", "%sdelaunayn (x);"),
    "convhulln 3D 1e5, in a cube": ("x = rand (1e5, 3);", "[h, v] = %sconvhulln (x);"),
    "convhulln 3D 1e5, on a sphere": ("x = randn (1e5, 3); x ./= sqrt (sum (x.^2, 2));", "[h, v] = %sconvhulln (x);"),
    "voronoin 3D 1e4": ("x = rand (1e4, 3);", "[c, f] = %svoronoin (x);"),
    "griddata 2D 1e5, linear": ("x = rand (1e5, 2); z = sum (x, 2); [u, v] = meshgrid (linspace (0, 1, 300));",
                                "%sgriddata (x(:,1), x(:,2), z, u, v);"),
    "griddata 2D 1e4, nearest": ("x = rand (1e4, 2); z = sum (x, 2); [u, v] = meshgrid (linspace (0, 1, 100));",
                                 '%sgriddata (x(:,1), x(:,2), z, u, v, "nearest");'),
    "tsearchn 3D 1e3 in 6e3": ("x = rand (1e3, 3); t = delone.delaunayn (x); q = rand (1e3, 3);", "%stsearchn (x, t, q);"),
}


def seconds_of(folders, setup, call, rounds):
    """The medians of Octave and of the package."""
    path = "".join(f'addpath ("{folder}"); ' for folder in folders)
    loop = f"for i = 1:{rounds} begin = cputime (); {call % ''} a(i) = cputime () - begin; begin = cputime (); {call % 'delone.'} b(i) = cputime () - begin; endfor;"
    code = f'{path} rand ("twister", 1); randn ("twister", 1); {setup} {loop} printf ("%g %g\\n", median (a), median (b));'
    done = subprocess.run(["octave-cli", "--norc", "--no-history", "--eval", code], text=True, stdout=subprocess.PIPE, check=True)
    return map(float, done.stdout.split())


def main():
    parser = argparse.ArgumentParser(description="Times functions of the Octave package next to those that Octave has.")
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--only", default="", help="cases whose name contains a text")
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    print(f"{'':32}{'Octave':>10}{'delone':>10}{'ratio':>8}")
    for name, (setup, call) in CASES.items():
        if arguments.only in name:
            octave, delone = seconds_of(arguments.folders, setup, call, arguments.rounds)
            print(f"{name:32}{octave:9.3f}s{delone:9.3f}s{octave / delone:8.1f}", flush=True)


if __name__ == "__main__":
    main()
