"""Scenes from files, dictionaries and dataclasses are one; errors name file, line and key."""
import numpy as np
import pytest

import pulvis
from pulvis.toml_text import toml_text


def tables():
    return {
        "family": "compaction",
        "title": 'Two "balls"',
        "material": [{"name": "316L", "density": "7990 kg/m^3", "youngs_modulus": "200 GPa", "poissons_ratio": 0.3}],
        "particle": [{"name": "ball", "material": "316L", "outline": "disc", "diameter": "10 mm",
                      "mesh": {"boundary_edges": 40, "rings": 1}}],
        "body": [{"particle": "ball", "position": ["5 mm", "5 mm"]}, {"particle": "ball", "position": ["15 mm", "5 mm"]}],
        "tool": [{"name": "bottom", "shape": "plane", "point": ["0 mm", "0 mm"], "normal": [0, 1]},
                 {"name": "top", "shape": "plane", "point": ["0 mm", "10 mm"], "normal": [0, -1]}],
        "stage": [{"name": "press", "kind": "compact", "duration": "20 us",
                   "move": [{"tool": "top", "displacement": ["0 mm", "-0.02 mm"]}]}],
        "contact": {"friction": 0.1},
    }


def test_a_dictionary_is_the_scene_of_its_file(tmp_path):
    file = tmp_path / "scene.toml"
    file.write_text(toml_text(tables()))
    from_file, from_tables = pulvis.Scene(file), pulvis.Scene(tables())
    assert from_file.hash == from_tables.hash
    assert from_file.file == file and from_tables.file is None
    assert from_tables.title == 'Two "balls"'
    runs = [scene.simulation(folder=tmp_path / str(i)).run() for i, scene in enumerate((from_file, from_tables))]
    assert runs[0].hash == runs[1].hash
    assert pulvis.Scene(tmp_path / "1/scene.toml").hash == from_tables.hash  # what is saved says the same


def test_dataclasses_are_the_same(tmp_path):
    from pulvis import declarations as d

    given = tables()
    document = d.Document(
        family=given["family"], title=given["title"], material=[d.Material(**given["material"][0])],
        particle=[d.Particle(**{**given["particle"][0], "mesh": d.ParticleMesh(boundary_edges=40, rings=1)})],
        body=[d.Body(**one) for one in given["body"]], tool=[d.Tool(**one) for one in given["tool"]],
        stage=[d.Stage(name="press", kind="compact", duration="20 us",
                       move=[d.StageMove(tool="top", displacement=["0 mm", "-0.02 mm"])])],
        contact=d.Contact(friction=0.1))
    assert pulvis.Scene(document).hash == pulvis.Scene(given).hash
    assert "kg/m^3" in d.Material.__doc__ and "density" in d.Material.__doc__


def test_quantities_of_pint_and_numbers_of_numpy():
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    given = tables()
    given["particle"][0]["diameter"] = 10.0 * unit.mm
    given["material"][0]["density"] = 7990 * unit.kg / unit.m**3
    given["body"][0]["position"] = np.array([5.0, 5.0]) * unit.mm
    given["stage"][0]["duration"] = 20 * unit.us
    given["contact"]["friction"] = np.float64(0.1)
    assert pulvis.Scene(given).simulation().run().hash == pulvis.Scene(tables()).simulation().run().hash
    assert '"3 um"' in toml_text({"a": 3 * unit.um})


def test_overrides_are_those_of_set(scenes):
    file = scenes / "compaction/regular-25.toml"
    by_words = pulvis.Scene(file, contact__friction=0.2)
    assert by_words.hash == pulvis.Scene(file, overrides={"contact.friction": 0.2}).hash
    assert by_words.hash == pulvis.Scene(file).with_(contact__friction=0.2).hash
    assert by_words.hash != pulvis.Scene(file).hash
    assert "friction = 0.2" in by_words.text
    moved = pulvis.Scene(tables(), overrides={"tool.top.point": ["0 m", "10.1 mm"]})
    assert "10.1 mm" in moved.text


def test_errors_name_file_line_and_key(tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text(toml_text(tables()).replace('diameter = "10 mm"', "diameter = 10"))
    line = file.read_text().splitlines().index("diameter = 10") + 1
    with pytest.raises(pulvis.SceneError) as caught:
        pulvis.Scene(file)
    error = caught.value
    assert (error.file, error.line, error.key) == (str(file), line, "particle[0].diameter")
    assert isinstance(error, pulvis.PulvisError) and str(file) in str(error)

    given = tables()
    given["material"][0]["poisons_ratio"] = given["material"][0].pop("poissons_ratio")
    given["contact"]["friction"] = -1
    with pytest.raises(pulvis.SceneError, match="did you mean 'poissons_ratio'") as caught:
        pulvis.Scene(given)
    keys = {problem["key"] for problem in caught.value.problems}
    assert len(caught.value.problems) >= 2 and any("poisons_ratio" in key for key in keys)

    with pytest.raises(pulvis.SceneError) as caught:
        pulvis.Scene(tables(), contact__friction="much")
    assert caught.value.key == "contact.friction" and caught.value.line is None
    assert caught.value.problems[0]["override"] == 'contact.friction="much"'
    with pytest.raises(pulvis.SceneError, match="nowhere.toml"):
        pulvis.Scene(tmp_path / "nowhere.toml")


def test_a_folder_that_holds_a_run_is_not_replaced_unasked(tmp_path):
    scene = pulvis.Scene(tables())
    scene.simulation(folder=tmp_path / "run").run()
    with pytest.raises(pulvis.RunError, match="overwrite=True"):
        scene.simulation(folder=tmp_path / "run")
    sim = scene.simulation(folder=tmp_path / "run", overwrite=True)
    with pytest.raises(pulvis.RunError, match="another run"):
        scene.simulation(folder=tmp_path / "run", overwrite=True)
    sim.close()
    with pytest.raises(pulvis.RunError, match="no checkpoint|cannot resume"):
        pulvis.resume(tmp_path)


def test_a_run_that_fails_says_so_and_its_files_are_whole(tmp_path, read_summary):
    scene = pulvis.Scene(tables(), limits__energy_balance=1e-9)
    sim = scene.simulation(folder=tmp_path / "run")
    with pytest.raises(pulvis.RunError, match="energy_balance"):
        sim.run()
    assert sim.finished and sim.outcome.startswith("failed: energies")
    assert read_summary(tmp_path / "run")["outcome"] == sim.outcome
    assert sim.run() is sim  # nothing more happens


def test_expectations_are_told(tmp_path):
    given = tables()
    given["expect"] = [{"series": "tool/top/force_y", "when": "max", "above": "1 N"},
                       {"series": "tool/top/force_y", "when": "max", "above": "1 GN"}]
    sim = pulvis.Scene(given).simulation().run()
    assert [verdict["met"] for verdict in sim.verdicts] == [True, True, False]  # the outcome first


def test_what_may_be_wrong_is_told(scenes):
    file = scenes / "compaction/unit-cell.toml"
    assert pulvis.Scene(file).warnings() == []
    assert any("top" in line for line in pulvis.Scene(file, stage__press__duration="10 us").warnings())


def test_a_servo_without_time_is_told_of():
    given = tables()
    del given["stage"][0]["move"]
    given["stage"][0].update(duration="1 us", servo=[{"tool": "top", "force": "1 N"}])
    assert any("may not reach" in line for line in pulvis.Scene(given).warnings())


def test_one_underscore_in_place_of_a_dot_is_told():
    with pytest.raises(pulvis.SceneError, match="contact__friction= is contact.friction"):
        pulvis.Scene(tables(), contact_friction=0.2)
    with pytest.raises(pulvis.SceneError) as error:
        pulvis.Scene(tables(), contact__frictoin=0.2)
    assert "underscores" not in str(error.value)


def test_a_powder_has_no_lever():
    with pytest.raises(pulvis.RunError, match="a powder has no lever"):
        pulvis.Scene(tables()).lever()
