# SPDX-License-Identifier: BSD-3-Clause
"""What pymatgen does with scipy.spatial, since Debian ships it without its tests: Voronoi neighbors and cells of crystals, Wulff shapes,
phase and Pourbaix diagrams. Expected numbers are those of crystallography."""
import numpy as np
import pytest
from pymatgen.analysis.chempot_diagram import ChemicalPotentialDiagram
from pymatgen.analysis.local_env import VoronoiNN
from pymatgen.analysis.phase_diagram import PDEntry, PhaseDiagram
from pymatgen.analysis.wulff import WulffShape
from pymatgen.core import Composition, Lattice, Structure

CRYSTALS = {"diamond": ("Fd-3m", 3.57, 16, 8), "fcc": ("Fm-3m", 3.6, 12, 4), "bcc": ("Im-3m", 2.87, 14, 2), "simple cubic": ("Pm-3m", 3.35, 6, 1)}


@pytest.mark.parametrize("crystal", CRYSTALS)
def test_voronoi_neighbors_of_crystals(crystal):
    group, a, faces, sites = CRYSTALS[crystal]
    structure = Structure.from_spacegroup(group, Lattice.cubic(a), ["C"], [[0, 0, 0]])
    assert len(structure) == sites
    for i in range(sites):
        cell = VoronoiNN(tol=0).get_voronoi_polyhedra(structure, i)
        assert len(cell) == faces
        np.testing.assert_allclose(sum(face["volume"] for face in cell.values()), a**3 / sites, rtol=1e-6)


@pytest.mark.parametrize("lattice, faces", [(Lattice.cubic(3), 6), (Lattice.hexagonal(3, 5), 8), (Lattice([[0, 2, 2], [2, 0, 2], [2, 2, 0]]), 12),
                                            (Lattice([[-2, 2, 2], [2, -2, 2], [2, 2, -2]]), 14), (Lattice.hexagonal(3.2, 5.2), 8)])
def test_wigner_seitz_cells(lattice, faces):
    assert len(lattice.get_wigner_seitz_cell()) == faces


def test_wulff_shapes():
    cube = WulffShape(Lattice.cubic(4.0), [(1, 0, 0)], [1.0])
    np.testing.assert_allclose([cube.volume, cube.surface_area], [8, 24])
    octahedron = WulffShape(Lattice.cubic(4.0), [(1, 1, 1)], [1.0])
    np.testing.assert_allclose(octahedron.volume, 4 * 3**0.5)
    rhombic = WulffShape(Lattice.cubic(4.0), [(1, 1, 0)], [1.0])
    np.testing.assert_allclose(rhombic.volume, 4 * 2**0.5 * 2 / 2, rtol=1e-9)


ENTRIES = [PDEntry(Composition(formula), energy) for formula, energy in [
    ("Li", -1.9), ("Fe", -8.0), ("O2", -9.8), ("Li2O", -14.3), ("FeO", -13.2), ("Fe2O3", -33.0), ("Fe3O4", -46), ("LiFeO2", -25.2)]]


def test_phase_diagrams():
    diagram = PhaseDiagram(ENTRIES)
    assert sorted(entry.name for entry in diagram.stable_entries) == ["Fe", "Fe2O3", "Li", "Li2O", "LiFeO2", "O2"]
    assert len(diagram.facets) == 5
    assert diagram.get_e_above_hull(ENTRIES[4]) > 0


def test_chemical_potential_diagrams():
    domains = ChemicalPotentialDiagram(ENTRIES).domains
    assert {"Fe2O3", "Li2O"} <= set(domains) and all(len(corners) > 0 for corners in domains.values())
