"""Packings and meshes alone."""
import numpy as np
import pytest

import pulvis


def test_a_packing_is_that_of_the_program(scenes, program, tmp_path):
    file = scenes / "compaction/random-100.toml"
    done = program("pack", file, "-o", tmp_path / "packing.csv")
    assert done.returncode == 0, done.stderr
    packing = pulvis.pack(pulvis.Scene(file))
    packing.save(tmp_path / "ours.csv")
    assert (tmp_path / "ours.csv").read_text() == (tmp_path / "packing.csv").read_text()
    assert packing.centres.shape == (len(packing), 2) and len(packing) == len(packing.radii)


def test_no_two_particles_overlap_and_outlines_have_their_area(scenes):
    packing = pulvis.pack(pulvis.Scene(scenes / "compaction/random-100.toml"))
    apart = np.hypot(*(packing.centres[:, None] - packing.centres[None]).transpose(2, 0, 1))
    np.fill_diagonal(apart, np.inf)
    reach = packing.radii[:, None] + packing.radii[None]
    assert (apart > 0.99 * reach).all()
    x, y = packing.outline(7).T
    area = 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    assert area == pytest.approx(packing.areas[7], rel=0.02)
    assert np.hypot(x - packing.centres[7, 0], y - packing.centres[7, 1]).max() == pytest.approx(packing.radii[7], rel=0.01)


def test_a_mesh_fills_its_outline(scenes):
    scene = pulvis.Scene(scenes / "compaction/unit-cell.toml")
    mesh = pulvis.mesh(scene, "disc")
    assert mesh.area == pytest.approx(np.pi * 25e-6, rel=1e-6)
    x, y = mesh.nodes[mesh.quads].transpose(2, 0, 1)
    areas = 0.5 * ((x[:, 0] - x[:, 2]) * (y[:, 1] - y[:, 3]) - (x[:, 1] - x[:, 3]) * (y[:, 0] - y[:, 2]))
    assert (areas > 0).all() and areas.sum() == pytest.approx(mesh.area, rel=0.01)
    assert len(mesh.outline) == mesh.boundary_nodes == 40
    assert np.array_equal(pulvis.mesh(scene).nodes, mesh.nodes)
    with pytest.raises(KeyError, match="allowed: disc"):
        pulvis.mesh(scene, "ball")
