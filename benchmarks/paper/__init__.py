# SPDX-License-Identifier: BSD-3-Clause
"""The experiments of section 5 of the report, measured on this machine and written up as experiments.md.

S. Hornus and J.-D. Boissonnat, "An efficient implementation of Delaunay triangulations in medium dimensions", INRIA RR-6743 (2008).

plan.py lists the cases, programs.py the programs, and runner.py runs them. Results are records in one JSON file, from which tables.py
and plots.py fill experiments.md.in. No number of the result is written by hand.
"""
