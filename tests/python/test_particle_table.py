"""Particles as extended XYZ: places, semi-axes, orientations and stresses, read back from the text."""
import re

import h5py
import numpy as np
import pytest
from conftest import call

import pulvis
from pulvis.errors import RunError
from pulvis.particle_table import Points

RADIUS = 2e-3


def ball(divisions=6):
    """Nodes and hexahedra of a cube whose points are moved onto spheres."""
    line = np.linspace(-1, 1, divisions + 1)
    cube = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    norm = np.linalg.norm(cube, axis=1)
    nodes = RADIUS * cube * (np.abs(cube).max(axis=1) / np.where(norm > 0, norm, 1))[:, None]
    number = np.arange(len(cube)).reshape((divisions + 1,) * 3)
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = [number[i:divisions + i, j:divisions + j, k:divisions + k].ravel() for i, j, k in corners]
    return nodes, np.stack(cells, axis=1)


def disc(divisions=8):
    """Nodes and quads of a square whose points are moved onto circles."""
    line = np.linspace(-1, 1, divisions + 1)
    square = np.stack(np.meshgrid(line, line, indexing="ij"), axis=-1).reshape(-1, 2)
    norm = np.linalg.norm(square, axis=1)
    nodes = RADIUS * square * (np.abs(square).max(axis=1) / np.where(norm > 0, norm, 1))[:, None]
    number = np.arange(len(square)).reshape((divisions + 1,) * 2)
    cells = [number[i:divisions + i, j:divisions + j].ravel() for i, j in [(0, 0), (1, 0), (1, 1), (0, 1)]]
    return nodes, np.stack(cells, axis=1)


def turned_about(axis, angle):
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def write_run(folder, mesh, frames, stress=None):
    """A run of two equal particles, the second 5 mm further along x. frames: functions of the nodes of both."""
    nodes, cells = mesh
    shift = np.zeros(nodes.shape[1])
    shift[0] = 5e-3
    both = np.concatenate([nodes, nodes + shift])
    folder.mkdir()
    with h5py.File(folder / "run.h5", "w") as run:
        kind = "hexahedra" if nodes.shape[1] == 3 else "quads"
        run[f"mesh/{kind}"] = np.concatenate([cells, cells + len(nodes)]).astype("i4")
        run["mesh/cell_particle"] = np.repeat([0, 1], len(cells)).astype("i4")
        run["mesh/node_particle"] = np.repeat([0, 1], len(nodes)).astype("i4")
        run["mesh/reference"] = both
        for name, values, names in (("number", [7, 9], ""), ("material", [1, 0], "iron\ncopper and tin"), ("class", [0, 0], "ball")):
            run[f"particles/{name}"] = np.array(values, "i4")
            run[f"particles/{name}"].attrs["names"] = names
        for number, move in enumerate(frames):
            frame = run.create_group(f"frames/{number:06}")
            frame.attrs.update({"time": 1e-5 * number, "step": 10 * number, "complete": 1})
            frame["position"] = move(both)
            if stress is not None:
                frame["stress"] = stress
    return pulvis.open(folder)


def parse(path):
    """Frames of an extended XYZ file: (attributes, columns)."""
    lines, found = path.read_text(encoding="utf-8").splitlines(), []
    while lines:
        count, head, rows = int(lines[0]), lines[1], [line.split() for line in lines[2:2 + int(lines[0])]]
        lines = lines[2 + count:]
        attributes = {key: quoted or plain for key, quoted, plain in re.findall(r'(\w+)=(?:"([^"]*)"|(\S+))', head)}
        words, columns, at = attributes["Properties"].split(":"), {}, 0
        for name, kind, width in zip(words[::3], words[1::3], words[2::3]):
            part = [row[at:at + int(width)] for row in rows]
            columns[name] = np.array(part, {"R": float, "I": int, "S": str}[kind])
            at += int(width)
        assert all(len(row) == at for row in rows)
        found.append((attributes, columns))
    return found


def matrix(quaternion):
    x, y, z, w = quaternion
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


@pytest.mark.parametrize("mesh", [ball(), disc()], ids=["sphere", "disc"])
def test_a_sphere_has_its_radius_and_its_place(tmp_path, mesh):
    run = write_run(tmp_path / "run", mesh, [lambda nodes: nodes, lambda nodes: nodes + 1e-3])
    run.write_xyz(tmp_path / "p.xyz")
    frames = parse(tmp_path / "p.xyz")
    assert [(float(a["Time"]), int(a["Step"])) for a, _ in frames] == [(0, 0), (1e-5, 10)]
    for number, (_, columns) in enumerate(frames):
        assert columns["id"].ravel().tolist() == [7, 9]
        assert columns["species"].ravel().tolist() == ["copper_and_tin", "iron"]
        expected = np.array([[0, 0, 0], [5e-3, 0, 0]]) + number * 1e-3 * np.array([1, 1, mesh[0].shape[1] == 3])
        assert columns["pos"] == pytest.approx(expected, abs=1e-9)
        assert columns["aspherical_shape"] == pytest.approx(RADIUS, rel=0.04)  # the facets are inside the sphere
        assert columns["aspherical_shape"].max() <= RADIUS
        assert columns["orientation"] == pytest.approx(np.tile([0, 0, 0, 1], (2, 1)), abs=1e-9)
        assert "stress" not in columns


def test_a_rotation_is_that_of_the_quaternion(tmp_path):
    turn = turned_about(np.array([2, -1, 2]) / 3, 2.5)
    run = write_run(tmp_path / "run", ball(), [lambda nodes: nodes @ turn.T])
    run.write_xyz(tmp_path / "p.xyz")
    columns = parse(tmp_path / "p.xyz")[0][1]
    for name in ("orientation", "rotation"):
        for quaternion in columns[name]:
            assert matrix(quaternion) == pytest.approx(turn, abs=1e-6)
            assert np.linalg.norm(quaternion) == pytest.approx(1, abs=1e-8)


def test_a_rotation_in_the_plane_is_about_z(tmp_path):
    turn = turned_about(np.array([0, 0, 1]), -0.7)[:2, :2]
    run = write_run(tmp_path / "run", disc(), [lambda nodes: nodes @ turn.T])
    run.write_xyz(tmp_path / "p.xyz")
    columns = parse(tmp_path / "p.xyz")[0][1]
    assert columns["orientation"] == pytest.approx(np.tile([0, 0, np.sin(-0.35), np.cos(0.35)], (2, 1)), abs=1e-6)


def test_a_stretched_and_turned_sphere_is_its_ellipsoid(tmp_path):
    stretch, turn = np.diag([0.6, 1.3, 1.0]), turned_about(np.array([1, 2, 2]) / 3, 0.9)
    deformed = turn @ stretch
    run = write_run(tmp_path / "run", ball(), [lambda nodes: nodes, lambda nodes: nodes @ deformed.T])
    run.write_xyz(tmp_path / "p.xyz")
    before, after = (columns for _, columns in parse(tmp_path / "p.xyz"))
    assert after["aspherical_shape"] == pytest.approx(before["aspherical_shape"] @ stretch, rel=1e-6)
    for quaternion, material in zip(after["orientation"], after["rotation"]):
        assert matrix(quaternion) == pytest.approx(turn, abs=1e-6)
        assert matrix(material) == pytest.approx(turn, abs=1e-6)


def test_a_shear_turns_the_ellipsoid_further_than_the_material(tmp_path):
    shear = np.array([[1, 0.5, 0], [0, 1, 0], [0, 0, 1.0]])
    run = write_run(tmp_path / "run", ball(), [lambda nodes: nodes @ shear.T])
    run.write_xyz(tmp_path / "p.xyz")
    columns = parse(tmp_path / "p.xyz")[0][1]
    for lengths, quaternion in zip(columns["aspherical_shape"], columns["orientation"]):
        axes = matrix(quaternion)
        size = lengths[2]  # not stretched
        assert axes @ np.diag((lengths / size)**2) @ axes.T == pytest.approx(shear @ shear.T, abs=1e-5)


def test_stresses_are_the_means_of_the_elements(tmp_path):
    nodes, cells = ball(4)
    values = np.random.default_rng(1).normal(size=(2 * len(cells), 6)) * 1e6
    run = write_run(tmp_path / "run", (nodes, cells), [lambda nodes: nodes], values)
    run.write_xyz(tmp_path / "p.xyz")
    columns = parse(tmp_path / "p.xyz")[0][1]
    volumes = Points(run).volumes(run.frame(0).nodes).reshape(len(run.mesh.cells), -1).sum(axis=1)
    for particle in range(2):
        mine = run.mesh.cell_particle == particle
        mean = np.average(values[mine], axis=0, weights=volumes[mine])
        assert columns["stress"][particle] == pytest.approx(mean[[0, 1, 2, 3, 5, 4]], rel=1e-6)
        assert columns["stress"][particle, :3].sum() == pytest.approx(mean[:3].sum(), rel=1e-6)
        assert columns["pressure"][particle, 0] == pytest.approx(-mean[:3].mean(), rel=1e-6)


def test_volumes_of_elements_are_exact(tmp_path):
    box = np.array([[0, 0, 0], [2, 0, 0], [2, 3, 0], [0, 3, 0], [0, 0, 1], [1, 0, 1], [1, 3, 1], [0, 3, 1.0]])  # a wedge cut off
    run = write_run(tmp_path / "run", (box, np.arange(8)[None]), [lambda nodes: nodes])
    assert Points(run).volumes(run.frame(0).nodes).reshape(2, -1).sum(axis=1) == pytest.approx([4.5, 4.5])


def test_one_frame_is_written_alone_and_a_missing_one_refused(tmp_path):
    run = write_run(tmp_path / "run", disc(), [lambda nodes: nodes, lambda nodes: 2 * nodes])
    run.write_xyz(tmp_path / "p.xyz", frame=1)
    assert [a["Step"] for a, _ in parse(tmp_path / "p.xyz")] == ["10"]
    with pytest.raises(RunError, match="frame 2: there are 0 to 1"):
        run.write_xyz(tmp_path / "p.xyz", frame=2)


def test_the_command_writes_the_particles_of_a_run(compact, tmp_path):
    call("figure", compact, "--format", "xyz", "-o", tmp_path)
    call("figure", compact, "-o", tmp_path / "one.xyz", "--frame", "1")
    frames = parse(tmp_path / "particles.xyz")
    assert len(frames) == len(pulvis.open(compact).frames) and len(frames[0][1]["pos"]) == 25
    stress = pulvis.open(compact).frame(-1).field("particle_stress")
    assert frames[-1][1]["stress"][:, :4] == pytest.approx(stress, rel=1e-6)
    assert parse(tmp_path / "one.xyz")[0][0] == frames[1][0]
    assert "without --series" in call("figure", compact, "--format", "xyz", "--field", "pressure", code=2)


def test_a_lever_has_no_particles(loop, tmp_path):
    assert "no particles" in call("figure", loop, "--format", "xyz", "-o", tmp_path, code=2)
