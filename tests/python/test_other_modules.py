# SPDX-License-Identifier: BSD-3-Clause
"""What delone's compiled module does to pybind11 is not seen by other modules that use pybind11 in the process."""
import pytest

from hostile_support import run

pytest.importorskip("other_module", reason="compiled with the tests in a build tree")


@pytest.mark.parametrize("first, second", [("other_module", "delone"), ("delone", "other_module")])
def test_the_base_the_metaclass_and_the_translators_are_not_shared(first, second):
    output = run(f"""
import {first}, {second}
import delone._core

other = other_module.Thing
assert other.__mro__[-2].__name__ == "pybind11_object" and other.__mro__[-2] is not delone.Delaunay.__mro__[-2]
assert type(other).__name__ == "pybind11_type" and type(other) is not type(delone.Delaunay)
try:
    other_module.exhaust_memory()
except MemoryError as error:
    print(error)
print(type(other()).__name__, delone.Delaunay([[0, 0], [1, 0], [0, 1]]).num_cells)
""")
    assert output.split() == ["std::bad_alloc", "Thing", "1"]
