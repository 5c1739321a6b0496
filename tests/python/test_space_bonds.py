"""Breaking bonds in three dimensions: two balls that are pressed, weld, and are pulled apart."""
import numpy as np
import pytest
from conftest import call
from matplotlib import pyplot as plt

import pulvis
from pulvis.figures import bonds

PULLED = """
family = "compaction"
dimension = 3
title = "Two balls welded and pulled apart"
material = [{ name = "cu", library = "Cu-OFHC" }]
particle = [{ name = "ball", material = "cu", shape = "sphere", diameter = "1 mm", mesh = { divisions = 3, rings = 2 } }]
body = [{ particle = "ball", position = ["0 mm", "0 mm", "0.5 mm"] }, { particle = "ball", position = ["0 mm", "0 mm", "1.5 mm"] }]
tool = [{ name = "bottom", shape = "plane", point = ["0 mm", "0 mm", "0 mm"], normal = [0, 0, 1] },
        { name = "top", shape = "plane", point = ["0 mm", "0 mm", "2 mm"], normal = [0, 0, -1] }]
contact = { friction = 0.2, damping = 0.1 }
output = { samples = 60, frames = 8 }

[[bond]]
between = ["cu", "cu"]
origin = "pressed"
threshold = "20 MPa"
growth = 0.2
strength = "60 MPa"
fracture_energy = "200 J/m^2"

[[bond]]
between = ["cu", "top"]
origin = "pressed"
threshold = "20 MPa"
growth = 0.4
strength = "150 MPa"
fracture_energy = "2 kJ/m^2"

[[bond]]
between = ["cu", "bottom"]
origin = "pressed"
threshold = "20 MPa"
growth = 0.4
strength = "150 MPa"
fracture_energy = "2 kJ/m^2"

[[stage]]
name = "press"
kind = "compact"
duration = "30 us"
move = [{ tool = "top", displacement = ["0 mm", "0 mm", "-0.15 mm"] }]

[[stage]]
name = "pull"
kind = "unload"
duration = "30 us"
move = [{ tool = "top", displacement = ["0 mm", "0 mm", "0.1 mm"] }]
"""


@pytest.fixture(scope="module")
def pulled(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pulled")
    (folder / "scene.toml").write_text(PULLED, encoding="utf-8")
    call("run", folder / "scene.toml", "-o", folder / "run", "--threads", "1")
    yield pulvis.open(folder / "run")
    plt.close("all")


def test_cracks_lie_where_the_balls_touched_and_move_with_their_balls(pulled):
    cracks = pulled.cracks()
    assert len(cracks) == pulled.summary["bonds"]["broken"] > 0
    assert cracks["area"].sum() == pytest.approx(pulled.series("bonds/crack_area")[-1])
    assert cracks.attrs["units"]["area"] == "m^2"
    assert set(cracks["particle"]) == {0, 1} and set(cracks["other"]) == {0, 1}
    then, now = cracks[["x", "y", "z"]].to_numpy(), pulled.frame(-1)["cracks/position"][()]
    assert np.abs(then[:, :2]).max() < 0.2e-3
    upper = cracks["particle"] == 1
    assert then[upper, 2].min() - then[~upper, 2].max() < 0.02e-3
    assert now[upper, 2].min() - now[~upper, 2].max() > 0.04e-3


def test_fragments_are_one_while_the_weld_holds(pulled):
    count = [len(pulled.fragments(frame)) for frame in range(len(pulled.frames))]
    assert count[0] == count[-1] == 2 and 1 in count
    last = pulled.fragments()
    assert list(last["particles"]) == [1, 1]
    assert last["volume"].sum() == pytest.approx(2 * np.pi / 6 * 1e-9, rel=0.05)
    assert last.attrs["units"]["volume"] == "m^3"


def test_bonds_are_those_with_the_tools_in_the_end(pulled):
    left = pulled.bonds()
    assert set(left["other"]) == {-1, -2}
    assert left["area"].sum() == pytest.approx(pulled.series("bonds/area")[-1])
    assert {"x", "y", "z", "damage"} <= set(left)


def test_runs_without_bonds_say_what_they_need(compact):
    for ask in (pulvis.open(compact).cracks, pulvis.open(compact).bonds, pulvis.open(compact).fragments):
        with pytest.raises(pulvis.RunError, match=r"\[\[bond\]\] of origin initial or pressed"):
            ask()


def test_pictures_of_breaking(pulled):
    figure, axes = pulled.plot.breaking()
    assert axes.get_ylabel() == "Crack area $A$ / mm²"
    figure, axes = pulled.plot.fragment_sizes()
    assert {line.get_label() for line in axes.lines} == {"of the volume", "of the number"}
    diameter = figure.table[0][2]
    assert diameter == pytest.approx([1e-3, 1e-3], rel=0.02)
    for name in ("fragment", "damage"):
        assert pulled.plot.field(name)[1].get_title(loc="left").startswith(name.capitalize())


def test_cracks_are_dots_coloured_by_mode(pulled):
    figure, axes = pulled.plot.cracks()
    (dots,) = [one for one in axes.collections if one.get_array() is not None]
    assert len(dots.get_offsets()) == len(pulled.cracks())
    assert dots.get_clim() == (0, 1)
    assert axes.get_title(loc="left").startswith("Cracks at 60 µs: 2 fragments")
    assert [name for name, _, _ in figure.table] == ["x", "y", "z", "time", "area", "shear", "energy"]
    assert {unit for name, unit, _ in figure.table if name == "area"} == {"m^2"}


def test_the_command_draws_them(pulled, tmp_path):
    said = call("figure", pulled.folder, "-o", tmp_path / "drawn")
    for name in ("cracks", "breaking", "fragment_sizes"):
        assert f"{name}.png" in said and (tmp_path / "drawn" / f"{name}.png").stat().st_size > 5000
    call("figure", pulled.folder, "--field", "fragment", "-o", tmp_path / "fragment.svg")


def test_sizes_of_fragments_add_up_by_number_and_by_volume():
    diameter, number, volume = bonds.cumulative(np.array([3.0, 1.0, 4.0]), in_space=True)
    np.testing.assert_allclose(np.pi / 6 * diameter**3, [1, 3, 4])
    np.testing.assert_allclose(number, [1 / 3, 2 / 3, 1])
    np.testing.assert_allclose(volume, [1 / 8, 1 / 2, 1])
