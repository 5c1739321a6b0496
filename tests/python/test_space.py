"""Figures of particles in three dimensions: what is drawn of blocks whose volumes and sections are known."""
import shutil

import h5py
import numpy as np
import pytest
from conftest import call
from matplotlib import pyplot as plt
from PIL import Image

import pulvis
from pulvis.errors import PulvisError
from pulvis.figures.space_mesh import density_along_z, outer_sides, section
from pulvis.figures.space_tools import CrossSection, cross_section, normals, pieces, rims

N = 3  # cells along an edge of a block
SIZE = 1e-3  # m


@pytest.fixture(autouse=True)
def no_figure_stays():
    yield
    plt.close("all")


def block(corner, number):
    """(nodes, hexahedra) of a cube of N^3 cells; numbers of nodes begin with those of `number` blocks."""
    side = N + 1
    x, y, z = np.meshgrid(*[np.linspace(0, SIZE, side)] * 3, indexing="ij")
    nodes = np.stack([x, y, z], axis=-1).transpose(2, 1, 0, 3).reshape(-1, 3) + corner
    i, j, k = (index.ravel() for index in np.meshgrid(*[np.arange(N)] * 3, indexing="ij"))
    first = i + side * j + side**2 * k + number * side**3
    return nodes, np.stack([first + step + up for up in (0, side**2) for step in (0, 1, side + 1, side)], axis=1)


def write(file, name, values, **attributes):
    data = file.create_dataset(name, data=values)
    data.attrs.update({"unit": "-", "meaning": "made up", "components": 1, **attributes})


@pytest.fixture(scope="module")
def blocks(tmp_path_factory):
    """Two blocks on one another in a box of planes twice as wide as they are; they rise by a tenth of their height."""
    folder = tmp_path_factory.mktemp("blocks")
    both = [block([0, 0, level * SIZE], level) for level in (0, 1)]
    nodes, cells = (np.concatenate(parts) for parts in zip(*both))
    with h5py.File(folder / "run.h5", "w") as file:
        file.attrs.update({"title": "Two blocks", "scene_hash": "f00d"})
        write(file, "mesh/hexahedra", cells.astype(np.int32))
        write(file, "mesh/cell_particle", np.repeat([0, 1], N**3).astype(np.int32))
        write(file, "mesh/node_particle", np.repeat([0, 1], (N + 1)**3).astype(np.int32))
        write(file, "mesh/reference", nodes)
        write(file, "particles/material", np.array([0, 1], np.int32), place="particle", names="iron\ncopper")
        write(file, "tools/quads", np.array([[0, 1, 2, 3], [4, 5, 6, 7]], np.int32))
        write(file, "tools/quad_tool", np.array([0, 1], np.int32), names="left\nright", kinds="plane\nplane")
        for k in range(3):
            frame = f"frames/{k:06}"
            write(file, f"{frame}/position", nodes * [1, 1, 1 + 0.05 * k], place="node", components=3, unit="m")
            write(file, f"{frame}/effective_stress", 1e8 * np.arange(2 * N**3) / N**3 * (k + 1), place="cell", unit="Pa")
            x = [0] * 4 + [2 * SIZE] * 4
            y, z = np.array([0, 1, 1, 0, 0, 0, 1, 1]) * SIZE, np.array([0, 0, 2, 2, 0, 2, 2, 0]) * SIZE
            write(file, f"{frame}/tools/outline", np.stack([x, y, z], axis=1), place="list", components=3, unit="m")
            file[frame].attrs.update({"time": 1e-3 * k, "step": k, "complete": 1})
        write(file, "history/time", np.array([0.0, 1e-3, 2e-3]), unit="s")
        write(file, "history/tool/right/force_x", np.array([0.0, 10, 30]), unit="N")
    return folder


def test_is_no_lever(blocks):
    run = pulvis.open(blocks)
    assert run.in_space and not run.is_solid and run.family == "compaction"
    assert run.mesh.cells.shape == (2 * N**3, 8)


def test_outer_sides_are_the_faces_of_the_blocks_and_look_outward(blocks):
    run = pulvis.open(blocks)
    faces, cells = outer_sides(run.mesh.cells)
    assert len(faces) == 2 * 6 * N**2 and set(cells) <= set(range(2 * N**3))
    corners = run.mesh.reference[faces]
    volume = (np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]) / 2 * corners.mean(axis=1)).sum() / 3
    assert volume == pytest.approx(2 * SIZE**3)  # Gauss: the integral of x . n / 3


def area(polygon):
    x, y = polygon.T
    return abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


@pytest.mark.parametrize("axis, expected", [(0, 2), (1, 2), (2, 1)])
def test_a_section_has_the_area_of_the_cut_body(blocks, axis, expected):
    run = pulvis.open(blocks)
    turn = np.array([[np.cos(0.3), -np.sin(0.3), 0], [np.sin(0.3), np.cos(0.3), 0], [0, 0, 1]])
    polygons, cells = section(run.mesh.cells, run.mesh.reference, axis, 0.41 * SIZE)
    assert sum(map(area, polygons)) == pytest.approx(expected * SIZE**2)
    assert len(polygons) == len(cells) == expected * N**2
    if axis == 2:  # the area across z stays, however it is turned about z
        polygons, _ = section(run.mesh.cells, run.mesh.reference @ turn.T, 2, 0.41 * SIZE)
        assert sum(map(area, polygons)) == pytest.approx(SIZE**2)


def test_density_along_z_is_that_of_the_block_in_its_room(blocks):
    run = pulvis.open(blocks)
    frame = run.frame(2)
    room = cross_section(run, frame, frame.nodes)
    assert room.area == pytest.approx(2 * SIZE**2)  # between the two planes, and as wide as the powder across them
    density, z = density_along_z(run.mesh.cells, frame.nodes, room, 7)
    np.testing.assert_allclose(density, 0.5)
    assert z[-1] == pytest.approx(2.2 * SIZE)
    figure, axes = run.plot.density_profile()
    assert axes.get_ylabel() == "$z$ / mm" and len(axes.lines) == 3
    assert "Relative density along z in the box around the powder" in axes.get_title("left")  # there are only two walls


def test_density_along_z_has_the_exact_volume_of_each_slice():
    """A cube of one element on its corner: its section is a triangle, a hexagon, a triangle."""
    turn = np.array([[1, -1, 0], [1, 1, -2], [1, 1, 1]]) / np.sqrt([[2], [6], [3]])
    cube = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    density, z = density_along_z(np.arange(8)[None], cube @ turn.T, CrossSection(2), 9)
    s = np.sqrt(3) * z
    below = sum(sign * np.maximum(s - k, 0)**3 for k, sign in enumerate((1, -3, 3, -1))) / 6
    np.testing.assert_allclose(2 * density * np.diff(z), np.diff(below), atol=1e-14)


def test_density_along_z_is_that_between_the_punches(blocks, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(blocks, folder)
    with h5py.File(folder / "run.h5", "r+") as file:
        for name in ("tools/quads", "tools/quad_tool"):
            del file[name]
        write(file, "tools/quads", np.array([[0, 1, 2, 3], [4, 5, 6, 7]], np.int32))
        write(file, "tools/quad_tool", np.array([0, 1], np.int32), names="bottom\ntop", kinds="plane\nplane")
        for frame in file["frames"].values():
            del frame["tools/outline"]
            square = SIZE * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
            corners = [np.column_stack([square, np.full(4, 0.2 * SIZE)]), np.column_stack([square[::-1], np.full(4, 2.5 * SIZE)])]
            write(frame, "tools/outline", np.concatenate(corners), place="list", components=3, unit="m")
    run = pulvis.open(folder)
    room = cross_section(run, run.frame(0), run.frame(0).nodes)
    density, z = density_along_z(run.mesh.cells, run.frame(0).nodes, room, 23)
    assert (z[0], z[-1]) == pytest.approx((0.2 * SIZE, 2.5 * SIZE))
    np.testing.assert_allclose(density, [1] * 18 + [0] * 5, atol=1e-12)  # what has penetrated the lower one does not count


def test_the_recorded_profile_is_drawn_if_there_is_one(blocks, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(blocks, folder)
    with h5py.File(folder / "run.h5", "r+") as file:
        for frame in file["frames"].values():
            write(frame, "density_profile", np.array([0.25, 0.75]))
            write(frame, "density_grid/z", SIZE * np.array([0.0, 1, 2]))
    _, axes = pulvis.open(folder).plot.density_profile()
    assert {0.25, 0.75} <= set(np.concatenate([line.get_xdata() for line in axes.lines]))


@pytest.fixture(scope="module")
def ejected(blocks, tmp_path_factory):
    """The same blocks in a cylindrical die that ends between them, below a wider face; in the last frame they are above it."""
    folder = tmp_path_factory.mktemp("ejected") / "run"
    shutil.copytree(blocks, folder)
    angles, count = np.arange(8) * np.pi / 4, 8
    rings = [np.stack([r * SIZE * np.cos(angles), r * SIZE * np.sin(angles), np.full(count, z * SIZE)], axis=1)
             for r, z in ((2, -1), (2, 1), (3, 1))]
    quads = [[a * count + i, a * count + (i + 1) % count, (a + 1) * count + (i + 1) % count, (a + 1) * count + i]
             for a in (0, 1) for i in range(count)]
    with h5py.File(folder / "run.h5", "r+") as file:
        for name in ("tools/quads", "tools/quad_tool", *(f"frames/{k:06}/tools/outline" for k in range(3))):
            del file[name]
        write(file, "tools/quads", np.array(quads, np.int32))
        write(file, "tools/quad_tool", np.zeros(len(quads), np.int32), names="die", kinds="die")
        for frame in file["frames"].values():
            write(frame, "tools/outline", np.concatenate(rings), place="list", components=3, unit="m")
        file["frames/000002/position"][...] += [0, 0, 2 * SIZE]
    return folder


def test_density_along_z_ends_at_the_mouth_of_the_die(ejected, tmp_path):
    run = pulvis.open(ejected)
    frame = run.frame(0)
    room = cross_section(run, frame, frame.nodes)
    density, z = density_along_z(run.mesh.cells, frame.nodes, room)
    assert z[-1] == room.high == pytest.approx(SIZE)
    np.testing.assert_allclose(density, 1 / (4 * np.pi))
    _, axes = run.plot.density_profile()
    assert len(axes.lines) == 2  # nothing is left in the die in the last frame
    assert "in the die, below its mouth" in axes.get_title("left")
    call("figure", ejected, "-o", tmp_path, "--format", "csv")
    head = (tmp_path / "density_profile.csv").read_text(encoding="utf-8").splitlines()[0]
    assert head.count("relative density, t = ") == 2  # both curves


def test_density_along_z_ends_at_the_deepest_point_of_a_punch(ejected, tmp_path):
    """Beside a punch with a profile the cavity is not the whole bore."""
    folder = tmp_path / "run"
    shutil.copytree(ejected, folder)
    with h5py.File(folder / "run.h5", "r+") as file:
        quads, kinds = file["tools/quads"][()], file["tools/quad_tool"].attrs["kinds"]
        for name in ("tools/quads", "tools/quad_tool"):
            del file[name]
        write(file, "tools/quads", np.append(quads, [[24, 25, 26, 24], [24, 26, 27, 24]], axis=0).astype(np.int32))
        write(file, "tools/quad_tool", np.append(np.zeros(len(quads)), [1, 1]).astype(np.int32), names="die\ntop", kinds=f"{kinds}\npunch")
        for frame in file["frames"].values():
            outline = frame["tools/outline"][()]
            del frame["tools/outline"]
            punch = SIZE * np.array([[0, 0, 0.6], [0, 2, 0.8], [2, 0, 0.8], [0, -2, 0.8]])  # seen from below
            write(frame, "tools/outline", np.concatenate([outline, punch]), place="list", components=3, unit="m")
    run = pulvis.open(folder)
    room = cross_section(run, run.frame(0), run.frame(0).nodes)
    assert room.top == pytest.approx(0.6 * SIZE) and room.bottom is None


def test_a_die_that_does_not_stand_along_z_has_no_density_along_z(ejected, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(ejected, folder)
    with h5py.File(folder / "run.h5", "r+") as file:
        for frame in file["frames"].values():
            for name in ("position", "tools/outline"):
                frame[name][...] = np.roll(frame[name][()], 1, axis=1)
    run = pulvis.open(folder)
    assert cross_section(run, run.frame(0), run.frame(0).nodes) is None
    with pytest.raises(PulvisError, match="the die does not stand along z"):
        run.plot.density_profile()
    says = call("figure", folder, "-o", tmp_path / "drawn", "--format", "csv")
    assert "no density_profile.csv: the die does not stand along z; needed for a density along z: output.density_cells" in says
    with h5py.File(folder / "run.h5", "r+") as file:  # the recorded one has the true room
        for frame in file["frames"].values():
            write(frame, "density_profile", np.array([0.25, 0.75]))
            write(frame, "density_grid/z", SIZE * np.array([0.0, 1, 2]))
    pulvis.open(folder).plot.density_profile()


def test_frames_without_powder_between_the_tools_have_no_curve(blocks, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(blocks, folder)
    with h5py.File(folder / "run.h5", "r+") as file:
        for k, frame in enumerate(file["frames"].values()):
            write(frame, "density_profile", np.array([0.25, 0.75]) if k < 2 else np.full(2, np.nan))
            write(frame, "density_grid/z", SIZE * np.array([0.0, 1, 2]))
    run = pulvis.open(folder)
    _, axes = run.plot.density_profile()
    assert len(axes.lines) == len(axes.get_legend().get_texts()) == 2
    with pytest.raises(PulvisError, match="no powder between the tools"):
        run.plot.density_profile(frame=2)


def test_edges_between_coplanar_triangles_of_an_stl_tool_are_not_drawn(blocks, tmp_path):
    """Two squares that meet in a ridge, each of two triangles that have their own corners."""
    folder = tmp_path / "run"
    shutil.copytree(blocks, folder)
    corners = SIZE * np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 1], [2, 1, 1]])
    triangles = [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]]
    with h5py.File(folder / "run.h5", "r+") as file:
        for name in ("tools/quads", "tools/quad_tool"):
            del file[name]
        write(file, "tools/quads", np.array([[3 * i, 3 * i + 1, 3 * i + 2, 3 * i + 2] for i in range(4)], np.int32))
        write(file, "tools/quad_tool", np.zeros(4, np.int32), names="vee", kinds="stl")
        for frame in file["frames"].values():
            del frame["tools/outline"]
            write(frame, "tools/outline", np.concatenate(corners[triangles]), place="list", components=3, unit="m")
    run = pulvis.open(folder)
    drawn = {frozenset(int(np.argmin(np.abs(corners - end).sum(axis=1))) for end in edge) for edge in rims(run, run.frame(0))}
    assert drawn == {frozenset(edge) for edge in ((0, 1), (1, 2), (2, 3), (3, 0), (1, 4), (4, 5), (5, 2))}
    run.plot.section()


def test_a_section_is_in_the_powder(blocks, tmp_path):
    says = call("figure", blocks, "-o", tmp_path, "--at", "100mm", code=2)
    assert "--at 100 mm: allowed: 0 m to 1 mm, where the powder is along y" in says and not list(tmp_path.iterdir())
    with pytest.raises(PulvisError, match="where the powder is along z"):
        pulvis.open(blocks).plot.section(across="z", at=-1e-3)


def test_small_powders_have_axes_in_micrometres(blocks, tmp_path):
    small = tmp_path / "small"
    shutil.copytree(blocks, small)
    with h5py.File(small / "run.h5", "r+") as file:
        for name in ("mesh/reference", *(f"frames/{k:06}/{of}" for k in range(3) for of in ("position", "tools/outline"))):
            file[name][...] *= 0.02
    figure, axes = pulvis.open(small).plot.section(frame=0)
    figure.canvas.draw()
    assert axes.get_ylabel() == "$z$ / µm"
    place, text = [(place, label.get_text()) for place, label in zip(axes.get_yticks(), axes.get_yticklabels()) if place > 0][0]
    assert float(text) == pytest.approx(1e3 * place)  # drawn in mm


def test_a_powder_is_no_lever(blocks):
    with pytest.raises(PulvisError, match="nothing recorded of frames of a lever"):
        pulvis.open(blocks).plot.solid()


def test_tools_look_at_the_powder(blocks):
    run = pulvis.open(blocks)
    corners, kinds = pieces(run, run.frame(0))
    np.testing.assert_allclose(normals(corners), [[1, 0, 0], [-1, 0, 0]], atol=1e-12)
    assert list(kinds) == ["plane", "plane"]


def test_the_picture_shows_the_faces_that_look_at_the_reader(blocks):
    run = pulvis.open(blocks)
    figure, axes = run.plot.field(frame=0)
    faces = next(one for one in axes.collections if one.get_zorder() == 1)
    assert len(faces.get_paths()) == 2 * 3 * N**2  # three sides of each block
    assert axes.child_axes[0].get_ylabel().startswith("Effective stress")
    names = [text.get_text() for text in axes.texts]
    assert {"$x$", "$y$", "$z$"} <= set(names) and any(name.endswith("mm") or name.endswith("µm") for name in names)
    figure, axes = run.plot.field("material", frame=0)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["iron", "copper"]


def test_the_section_shows_cells_and_tools(blocks):
    run = pulvis.open(blocks)
    _, axes = run.plot.section(frame=0, across="y", at=0.5 * SIZE)
    cells, tools = axes.collections
    assert len(cells.get_paths()) == 2 * N**2 and len(tools.get_segments()) == 2
    assert axes.get_xlabel() == "$x$ / mm" and axes.get_ylabel() == "$z$ / mm"
    with pytest.raises(PulvisError, match="allowed: x, y, z"):
        run.plot.section(across="w")


def test_the_place_of_a_section_is_a_length_with_its_unit_or_in_metres(blocks):
    run = pulvis.open(blocks)
    for draw in (run.plot.section, run.plot.density):
        with pytest.raises(PulvisError, match="at 2: allowed: a length with its unit"):
            draw(at="2")
    tables = [run.plot.section(across="z", at=at)[0].table for at in ("0.3mm", 0.3e-3, np.float64(0.3e-3))]
    for table in tables[1:]:
        np.testing.assert_allclose(table[1][2], tables[0][1][2], rtol=1e-12)


def test_a_minus_sign_in_a_title_is_one(blocks, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(blocks, folder)
    with h5py.File(folder / "run.h5", "r+") as file:
        for frame in file["frames"].values():
            frame["position"][...] -= [0, 2 * SIZE, 0]
    _, axes = pulvis.open(folder).plot.section(at="-1.3mm")
    assert "$y$ = −1.3 mm" in axes.get_title("left")


def test_the_command_draws_one_section(blocks, tmp_path):
    """--across or --at with one field and a file: not the view from a corner, which has other columns."""
    for words, axes in ((("--across", "z"), "xy"), (("--at", "0.3mm"), "xz"), (("--across", "x", "--at", "0.3mm"), "yz")):
        path = tmp_path / f"{''.join(words)}.csv"
        call("figure", blocks, "-o", path, "--field", "effective_stress", *words)
        head = path.read_text(encoding="utf-8").splitlines()[0]
        assert [name[0] for name in head.split(",")[:-1]] == list(axes)
    for words in (("--series", "time"), ("--animate", tmp_path / "film.gif")):
        says = call("figure", blocks, "--across", "z", *words, code=2, cwd=tmp_path)
        assert "--across and --at are for sections: use them without --series and --animate" in says


def test_sections_are_of_three_dimensions(compact):
    with pytest.raises(PulvisError, match="sections, which only 3D runs have"):
        pulvis.open(compact).plot.section()


@pytest.fixture(scope="module")
def observed(blocks, tmp_path_factory):
    """The same with a contact between the blocks, one with a tool, and densities in 2 x 3 x 4 cells."""
    folder = tmp_path_factory.mktemp("observed")
    shutil.copytree(blocks, folder, dirs_exist_ok=True)
    with h5py.File(folder / "run.h5", "r+") as file:
        for name in file["frames"]:
            frame = f"frames/{name}"
            write(file, f"{frame}/particle_centre", np.array([[0.5, 0.5, 0.5], [0.5, 0.5, 1.5]]) * SIZE, components=3, place="particle")
            write(file, f"{frame}/force_chain", np.array([1, 0], np.int32), place="particle")
            for group, ids, point, force in (("contacts", [0, 1], [0.5, 0.5, 1], 30.0), ("tool_contacts", [0, 0], [0, 0.5, 0.5], 10.0)):
                write(file, f"{frame}/{group}/ids", np.array([ids], np.int32))
                write(file, f"{frame}/{group}/point", np.array([point]) * SIZE, unit="m")
                write(file, f"{frame}/{group}/normal", np.array([[0.0, 0, -1]]))
                write(file, f"{frame}/{group}/normal_force", np.array([force]), unit="N")
            write(file, f"{frame}/local_density", np.arange(24.0).reshape(12, 2) / 24)
            for axis, count in (("x", 2), ("y", 3), ("z", 4)):
                write(file, f"{frame}/density_grid/{axis}", np.linspace(0, 2 * SIZE, count + 1), unit="m")
    return folder


def test_the_network_has_three_axes(observed):
    run = pulvis.open(observed)
    table = run.network()
    assert list(table[["first", "second", "z", "normal_z", "normal_force"]].iloc[0]) == [0, 1, SIZE, -1, 30]
    figure, axes = run.plot.network()
    lines = next(one for one in axes.collections if one.get_zorder() == 3)
    wide = lines.get_linewidths()
    assert len(wide) == 2 and max(wide) == pytest.approx(3 * min(wide)) and lines.get_array().max() == pytest.approx(30)
    assert axes.child_axes[0].get_ylabel().startswith("Normal force")
    with pytest.raises(PulvisError, match="two dimensions"):
        run.plot.rose()


def test_a_frame_without_contacts_says_so(observed, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(observed, folder)
    with h5py.File(folder / "run.h5", "r+") as file:
        for group in ("contacts", "tool_contacts"):
            for name, values in file["frames/000000"][group].items():
                attributes, shape = dict(values.attrs), (0, *values.shape[1:])
                del file["frames/000000"][group][name]
                write(file, f"frames/000000/{group}/{name}", np.empty(shape, values.dtype), **attributes)
    run = pulvis.open(folder)
    with pytest.raises(PulvisError, match="^no contacts in frame 0, at 0 s$"):
        run.plot.network(frame=0)
    run.plot.network()
    assert "no contact_network.png: no contacts in frame 0, at 0 s" in call("figure", folder, "-o", tmp_path / "all", "--frame", "0")


def test_densities_are_indexed_by_the_axes(observed):
    run = pulvis.open(observed)
    values, lines = run.density()
    assert values.shape == (2, 3, 4) and [len(one) for one in lines] == [3, 4, 5]
    assert values[1, 2, 3] == 23 / 24 and values[1, 0, 0] == 1 / 24 and values[0, 1, 0] == 2 / 24 and values[0, 0, 1] == 6 / 24
    _, axes = run.plot.density(across="z", at=1.6 * SIZE)
    np.testing.assert_allclose(axes.collections[0].get_array().ravel(), np.arange(18, 24) / 24)  # rows along y, the top layer
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("$x$ / mm", "$y$ / mm")
    with pytest.raises(PulvisError, match="allowed: x, y, z"):
        run.plot.density(across="w")


def test_densities_of_two_dimensions(compact):
    values, lines = pulvis.open(compact).density()
    assert values.shape == (3, 2) and len(lines) == 2


def test_the_command_draws_layers(observed, tmp_path):
    told = call("figure", observed, "-o", tmp_path / "all", "--across", "x", "--at", "0.2mm")
    assert "contact_network.png" in told and "local_density.png" in told
    assert "allowed: a length with its unit" in call("figure", observed, "-o", tmp_path / "no", "--at", "2", code=2)


def test_all_figures_of_the_command(blocks, tmp_path):
    told = call("figure", blocks, "-o", tmp_path / "all", "--width", "85mm", "--no-title")
    names = sorted(path.name for path in (tmp_path / "all").glob("*.png"))
    assert names == ["density_profile.png", "effective_stress.png", "force.png", "section.png"]
    assert "nothing recorded" not in told and "energies.png" not in told
    with Image.open(tmp_path / "all/effective_stress.png") as picture:
        assert picture.width == pytest.approx(85 / 25.4 * 200, abs=2)
    call("figure", blocks, "--animate", tmp_path / "film.gif", "--range", "0:400MPa", "--cmap", "cividis")
    with Image.open(tmp_path / "film.gif") as film:
        assert film.n_frames == 3
    call("figure", blocks, "-o", tmp_path / "one.csv", "--field", "effective_stress", "--frame", "0")
    assert len(np.genfromtxt(tmp_path / "one.csv", delimiter=",", skip_header=1)) == 2 * N**3
    assert "no field heat" in call("figure", blocks, "-o", tmp_path / "one.png", "--field", "heat", code=2)
