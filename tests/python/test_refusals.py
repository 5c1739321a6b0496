"""Records that `pulvis reduce` and `pulvis fit` refuse: by the cause, and before anything runs."""
import pytest

from conftest import SOURCE, call

LOOPS = "slope [deg],load [nN],half_width [mV],offset [mV]\n"
LAB = SOURCE / "scenes/lab"


@pytest.mark.parametrize("content, said", [
    (b"", "is empty"),
    (LOOPS.encode(), "has no rows"),
    ((LOOPS + "14,20,3,5\n14,40,6\n").encode(), ":3:1: row: has 3 fields, allowed: 4"),
    ((LOOPS + "14,20,3,5,7\n").encode(), ":2:1: row: has 5 fields, allowed: 4"),
    ((LOOPS + "14,20,3,5\n").encode("utf-16"), "the file is UTF-16, allowed: text in UTF-8"),
])
def test_records_that_cannot_be_read_say_why(content, said, tmp_path):
    record = tmp_path / "loops.csv"
    record.write_bytes(content)
    told = call("reduce", record, "-o", tmp_path / "out", code=2)
    assert "loops.csv:" in told and said in told and "compact.length" not in told
    assert not (tmp_path / "out").exists()


def test_a_folder_is_no_record(tmp_path):
    assert "compact.length" not in call("reduce", tmp_path, "-o", tmp_path / "out", code=2)


@pytest.mark.parametrize("settings", ["wedge.toml", "volts.toml"])
def test_a_simulation_is_not_compared_with_an_afm_calibration(settings, tmp_path):
    told = call("reduce", LAB / settings, "--simulation", tmp_path, "-o", tmp_path / "out", code=2)
    assert "simulation: is not compared with an AFM calibration" in told


def test_a_short_record_is_refused_before_the_first_simulation(tmp_path):
    fit = (LAB / "plate-fit.toml").read_text(encoding="utf-8")
    (tmp_path / "plate-fit.toml").write_text(fit.replace('"plate-scene.toml"', f'"{LAB}/plate-scene.toml"'), encoding="utf-8")
    lines = (LAB / "plate-measured.csv").read_text(encoding="utf-8").splitlines(keepends=True)
    (tmp_path / "plate-measured.csv").write_text("".join(lines[:15]), encoding="utf-8")
    told = call("fit", tmp_path / "plate-fit.toml", "-o", tmp_path / "fit", code=2)
    assert "measured.record: " in told and "would end at" in told and "round 1" not in told
    assert not (tmp_path / "fit").exists()
