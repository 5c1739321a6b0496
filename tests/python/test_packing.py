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


def surface_volume(points, faces):
    """Gauss: the integral of x . n / 3 over the bilinear faces, four triangles about the middle of each."""
    corners = points[faces]
    middle = corners.mean(axis=1, keepdims=True)
    following = np.roll(corners, -1, axis=1)
    return np.sum(np.cross(corners, following) * middle) / 6


def test_a_packing_in_space_is_that_of_the_program(scenes, program, tmp_path):
    file = scenes / "compaction-3d/tablet.toml"
    done = program("pack", file, "-o", tmp_path / "packing.csv")
    assert done.returncode == 0, done.stderr
    packing = pulvis.pack(pulvis.Scene(file))
    packing.save(tmp_path / "ours.csv")
    assert (tmp_path / "ours.csv").read_text() == (tmp_path / "packing.csv").read_text()
    assert packing.centres.shape == (60, 3) and packing.radii == pytest.approx(4.5e-3, rel=1e-9)
    apart = np.linalg.norm(packing.centres[:, None] - packing.centres[None], axis=2)
    np.fill_diagonal(apart, np.inf)
    assert apart.min() > 0.999 * 9e-3
    reach = np.linalg.norm(packing.surface(7) - packing.centres[7], axis=1)
    assert reach == pytest.approx(4.5e-3, rel=0.05)


def test_surfaces_are_turned_with_their_particles(scenes):
    scene = pulvis.Scene(scenes / "compaction-3d/superquadrics.toml")
    packing, number = pulvis.pack(scene), 3
    mesh = pulvis.mesh(scene, packing.names[packing.classes[number]])
    own, turned = mesh.nodes[: mesh.surface_nodes], packing.surface(number) - packing.centres[number]
    w, x, y, z = packing.rotations[number]
    rows = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    np.testing.assert_allclose(turned, own @ rows.T, atol=1e-12)


def test_a_mesh_in_space_fills_its_surface(scenes):
    scene = pulvis.Scene(scenes / "compaction-3d/one-sphere.toml", accuracy="draft")
    mesh = pulvis.mesh(scene, "ball")
    assert mesh.volume == pytest.approx(4 / 3 * np.pi * 125e-9, rel=1e-9)
    assert surface_volume(mesh.nodes, mesh.faces) == pytest.approx(mesh.volume, rel=0.02)
    assert set(mesh.faces.ravel()) == set(range(mesh.surface_nodes)) and mesh.hexahedra.max() == len(mesh.nodes) - 1
    with pytest.raises(KeyError, match="allowed: ball"):
        pulvis.mesh(scene, "disc")


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


def test_a_particle_of_grains_has_the_meshes_of_its_grains(scenes):
    scene = pulvis.Scene(scenes / "bonds/brazilian-disc.toml")
    packing = pulvis.pack(scene)
    of_disc = "particles of class 'disc' consist of grains and have no {} of their own, allowed: .*'disc#1.1' to 'disc#1.60'"
    for disc in ("disc", 0):
        with pytest.raises(ValueError, match=of_disc.format("mesh")):
            pulvis.mesh(scene, disc)
    with pytest.raises(ValueError, match=of_disc.format("outline")):
        packing.outline(0)
    assert packing.areas == pytest.approx([np.pi * 25e-6], rel=1e-6)
    grains = [pulvis.mesh(scene, f"disc#1.{n + 1}") for n in range(60)]
    assert sum(grain.area for grain in grains) == pytest.approx(packing.areas[0], rel=1e-9)
    assert sum(len(grain.quads) for grain in grains) == 1560
