"""What Python may write into a simulation: what a scene may say, and all or nothing."""
import numpy as np
import pytest

import pulvis

# Column, a value that a scene refuses, and what is told to be allowed.
REFUSED = [
    ("hardening_modulus", -1e12, ">= 0 and <= 2e+11"),
    ("hardening_modulus", 3e11, "<= 2e+11"),  # of Young's modulus
    ("hardening_modulus", np.nan, "not finite"),
    ("yield_stress", -1.0, ">= 0.001 and < 2e+11"),
    ("yield_stress", 2e11, "< 2e+11"),
    ("yield_stress", np.inf, "not finite"),
    ("mass_damping", -1.0, ">= 0 and <= 1e+15"),
    ("mass_damping", 1e16, "<= 1e+15"),
    ("velocity", np.nan, "not finite"),
    ("velocity", 1e300, ">= -100000 and <= 100000"),
]


@pytest.fixture
def damped(make_cell):
    """With every column that can be written."""
    return make_cell(overrides={"material.316L.damping.mass_proportional": "10 1/s"})


def test_there_is_a_case_for_every_writable_column(damped):
    writable = {info.name.split(".")[1] for info in damped.simulation().columns if info.writable}
    assert writable == {column for column, _, _ in REFUSED}


@pytest.mark.parametrize("column, value, allowed", REFUSED)
def test_a_column_refuses_what_a_scene_refuses(damped, column, value, allowed):
    sim = damped.simulation().step(3)
    before = np.array(sim.column(column))
    with pytest.raises(pulvis.RangeError) as refused:
        with sim.writable(column) as written:
            written[0][...] = before[0] * 1.5  # a good value of the same particle is not kept either
            written[0][-1, -1] = value
    said = str(refused.value)
    assert f".{column}': particle 0" in said and allowed in said and "nothing of what was written is kept" in said
    assert ("row" in said) == (column == "velocity")
    assert np.array_equal(np.array(sim.column(column)), before) and sim.driven == set()
    assert isinstance(refused.value, ValueError) and isinstance(refused.value, pulvis.RunError)
    assert sim.step(1).steps == 4


def test_the_limits_are_those_of_a_scene(make_cell):
    for key, value in (("hardening_modulus", "3e11 Pa"), ("yield_stress", "2e11 Pa"), ("damping.mass_proportional", "1e16 1/s")):
        with pytest.raises(pulvis.SceneError, match="allowed"):
            make_cell(overrides={f"material.316L.{key}": value})


def test_blocks_are_checked_too_and_written_as_a_whole(scenes):
    sim = pulvis.Scene(scenes / "compaction/regular-25.toml").simulation().step(2)
    before = np.array(sim.column("velocity"))
    with pytest.raises(pulvis.RangeError, match="particle 17, row 4, number 1: inf m/s"):
        with sim.writable("velocity") as velocity:
            for numbers, values in velocity.blocks:
                values[..., 0] += 1.0
                values[numbers == 17, 4, 1] = np.inf
    assert np.array_equal(np.array(sim.column("velocity")), before)
    with sim.writable("velocity") as velocity:
        for _, values in velocity.blocks:
            values[..., 0] += 1.0  # lanes without a particle, too: they are left alone
        assert np.array_equal(velocity[17][:, 0], np.array(velocity)[17 * len(velocity[17]):18 * len(velocity[17]), 0])
    after = np.array(sim.column("velocity"))
    assert np.array_equal(after[:, 0], before[:, 0] + 1.0) and np.array_equal(after[:, 1], before[:, 1])


def test_what_is_kept_of_a_block_changes_nothing_later(cell):
    sim = cell.simulation().step(2)
    with sim.writable("velocity") as velocity:
        part = velocity[0][:, 0]
    before = np.array(sim.column("velocity"))
    part[:] = np.nan
    assert np.array_equal(np.array(sim.column("velocity")), before)
    with pytest.raises(pulvis.RunError, match="in a with block only"):
        sim.writable("velocity")[0]


def test_steps_within_a_block_are_refused(cell):
    sim = cell.simulation().step(2)
    with pytest.raises(pulvis.RunError, match="steps were taken within the with block"):
        with sim.writable("velocity") as velocity:
            velocity[0][:] = 1.0
            sim.step(1)
    assert sim.driven == set() and sim.step(1).steps == 4


def test_columns_in_space_have_limits(scenes):
    sim = pulvis.Scene(scenes / "compaction-3d/one-sphere.toml", accuracy="draft").simulation()
    with pytest.raises(pulvis.RangeError, match="row 5, number 2: 1e[+]09 m/s"):
        with sim.writable("velocity") as velocity:
            velocity[0][5, 2] = 1e9
    with pytest.raises(pulvis.RangeError, match="hardening_modulus': particle 0: -1 Pa"):
        with sim.writable("hardening_modulus") as modulus:
            modulus[0][:] = -1


def test_a_cell_has_no_damping_of_its_frame(scenes):
    sim = pulvis.Scene({"extends": str(scenes / "periodic/square.toml"),
                        "material": [{"name": "316L", "damping": {"stiffness_proportional": "1e-12 s"}}]}).simulation()
    with pytest.raises(pulvis.RangeError, match="mass_damping': particle 0: 1 1/s, allowed: .* <= 0"):
        with sim.writable("mass_damping") as damping:
            damping[0][:] = 1
