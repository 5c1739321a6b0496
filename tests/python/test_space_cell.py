"""Everything that is drawn or written of spheres in a periodic cell: particles, bonds, cracks and contacts are in one place."""
import re

import numpy as np
import pytest
from conftest import SOURCE, call
from matplotlib import pyplot as plt

import pulvis
from pulvis.figures.cell import Cell
from pulvis.figures.space_bonds import places_of_bonds

GLUED = """
[[bond]]
between = ["Cu", "Cu"]
origin = "pressed"
strength = "1 MPa"
fracture_energy = "1 J/m^2"
threshold = "1 MPa"
growth = 0.5
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Two spheres, welded to each other and to their images as they are pressed; the drawn cell begins between them."""
    folder = tmp_path_factory.mktemp("cell")
    text = (SOURCE / "tests/keys/scenes-3d/cell-box.toml").read_text(encoding="utf-8")
    (folder / "glued.toml").write_text(text + GLUED, encoding="utf-8")
    call("run", folder / "glued.toml", "-o", folder / "run", "--threads", "1", "--set", "output.contacts=true",
         "--set", 'cell.corner=["0.7 mm", "-0.2 mm", "0.3 mm"]')
    yield pulvis.open(folder / "run")
    plt.close("all")


def test_particles_are_drawn_inside_the_cell(run):
    frame = run.frames[-1]
    cell, owner = Cell(run, frame), run.file["mesh/node_particle"][()]
    assert len(cell.edges()) == 12 and np.any(cell.shift != 0)
    for particle in range(owner.max() + 1):
        middle = cell.position[owner == particle].mean(axis=0)
        share = np.linalg.solve(cell.vectors.T, middle - cell.corner)
        assert np.all((share >= -1e-9) & (share <= 1 + 1e-9)), (particle, share)


def test_bonds_are_drawn_on_their_particles(run):
    frame = run.frames[-1]
    cell, owner = Cell(run, frame), run.file["mesh/node_particle"][()]
    ids = frame["bonds/ids"][:, 0]
    assert len(ids) > 0
    places, cracks = places_of_bonds(run, frame, cell)
    assert len(cracks) == len(frame["cracks/position"])
    for place, particle in zip(places, ids):
        nearest = np.linalg.norm(cell.position[owner == particle] - place, axis=1).min()
        assert nearest < 0.3e-3, (particle, nearest)  # less than the size of a face


def test_contact_lines_reach_to_an_image_of_the_other_particle(run):
    frame = run.frames[-1]
    cell, centre = Cell(run, frame), frame["particle_centre"][()]
    ids = frame["contacts/ids"][()]
    ends = cell.other_end(ids, centre, frame["contacts/point"][()])
    assert len(ids) > 0
    periods = np.linalg.solve(cell.vectors.T, (ends - centre[ids[:, 1]]).T).T
    np.testing.assert_allclose(periods, np.round(periods), atol=1e-9)
    lengths = np.linalg.norm(ends - centre[ids[:, 0]], axis=1)
    assert np.all((lengths > 0.5e-3) & (lengths < 1.3e-3)), lengths


def test_the_table_of_particles_has_the_cell(run, tmp_path):
    run.write_xyz(tmp_path / "p.xyz", frame=-1)
    head = (tmp_path / "p.xyz").read_text(encoding="utf-8").splitlines()[1]
    assert 'pbc="T T T"' in head
    lattice = np.array(re.search(r'Lattice="([^"]*)"', head)[1].split(), float).reshape(3, 3)
    np.testing.assert_allclose(lattice, run.frames[-1]["cell"][1:], rtol=1e-8, atol=1e-15)


def test_every_figure_is_drawn(run, tmp_path):
    call("figure", run.folder, "-o", tmp_path)
    drawn = {file.stem for file in tmp_path.glob("*.png")}
    assert {"effective_stress", "section", "contact_network", "cracks"} <= drawn
    assert "density_profile" not in drawn  # a powder without walls has no ends
    call("figure", run.folder, "--animate", tmp_path / "film.gif")
    call("preview", SOURCE / "tests/keys/scenes-3d/cell.toml", "-o", tmp_path / "preview.png")
