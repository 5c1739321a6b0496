"""Figures of powders pressed in a die: compaction curve, Heckel plot, radial over axial stress, density maps on request."""
import made_up
import numpy as np
import pytest
from conftest import call
from matplotlib import pyplot as plt

import pulvis
from pulvis.figures import curves, look, pressing


@pytest.fixture(autouse=True)
def no_figure_stays():
    yield
    plt.close("all")


def main_axes(figure):
    """Without colour bars."""
    return [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]


def test_compaction_curve_and_heckel_plot_of_a_die(compact, tmp_path):
    run = pulvis.open(compact)
    _, axes = run.plot.compaction_curve()
    assert [line.get_label() for line in axes.lines] == ["top punch", "bottom punch"]
    assert axes.get_xlabel() == r"Relative density $\rho$" and axes.get_ylabel() == "Pressure of the punch $P$ / MPa"
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 1e-6 * run.series("stress/axial_top"))
    figure, axes = run.plot.heckel()
    assert axes.get_xlabel() == "Pressure of the top punch $P$ / MPa" and axes.get_ylabel() == r"$\ln[1/(1 - \rho)]$"
    (_, _, pressure), (_, _, density), (_, _, ordinate), *_ = figure.table
    np.testing.assert_allclose(ordinate, np.log(1 / (1 - density)))
    assert len(pressure) == run.summary["fits"]["samples"]  # those that the program has fitted
    assert [pressure.min(), pressure.max()] == pytest.approx(run.summary["fits"]["pressure"])
    law = next(law for law in run.summary["fits"]["laws"] if law["law"] == "heckel")
    assert len(axes.lines) == (2 if "parameters" in law else 1)
    figure, axes = run.plot.radial_ratio()
    assert axes.get_ylabel() == r"Lateral over axial stress $\sigma_\mathrm{lat}/\sigma_\mathrm{ax}$"
    call("figure", compact, "--format", "csv", "-o", tmp_path / "csv")
    assert (tmp_path / "csv/heckel.csv").read_text().startswith("pressure [Pa],relative density [-],ln 1/(1 - D) [-]")


def test_density_maps_are_scaled_by_their_own_frame_on_request(compact, tmp_path):
    run = pulvis.open(compact)
    figure, _ = run.plot.density(frame=None)
    assert len({one.collections[0].get_clim() for one in main_axes(figure)}) == 1
    figure, _ = run.plot.density(frame=None, limits="frame")
    for axes in main_axes(figure):
        values = axes.collections[0].get_array()
        low, high = axes.collections[0].get_clim()
        assert low <= values.min() and values.max() <= high and high - low <= max(np.ptp(values), 0.02) + 1e-12
    assert sum(axes.get_label() == "<colorbar>" for axes in figure.axes) == len(main_axes(figure))
    call("figure", compact, "--field", "local_density", "--frame", "2", "--range", "0.5:1", "-o", tmp_path / "one.png")
    call("figure", compact, "--field", "local_density", "--range", "frame", "-o", tmp_path / "maps.svg")
    assert "--range frame is for density maps" in call("figure", compact, "--range", "frame", "--animate", "f.gif", code=2, cwd=tmp_path)


@pytest.fixture(scope="module")
def tablet(tmp_path_factory):
    return pulvis.open(made_up.tablet(tmp_path_factory.mktemp("pressed") / "tablet"))


def test_the_fitted_line_is_that_of_the_summary(tablet):
    _, axes = tablet.plot.heckel()
    run, line = axes.lines
    x, y = line.get_data()
    np.testing.assert_allclose(y, 9.767e-9 * 1e6 * x + 0.4702)  # in MPa
    assert axes.get_legend().get_texts()[1].get_text() == "line: $1/K$ = 102.4 MPa, $A$ = 0.47, $r^2$ = 0.989"
    assert np.diff(tablet.series("relative_density"))[: len(run.get_xdata()) - 1].min() >= 0  # no unloading


def test_a_law_that_was_not_fitted_has_no_line(tablet, monkeypatch):
    monkeypatch.setitem(tablet.summary, "fits", {"laws": [{"law": "heckel", "not_fitted": "too few samples"}]})
    assert len(tablet.plot.heckel()[1].lines) == 1


def test_a_round_die_has_radial_stress(tablet):
    figure, axes = tablet.plot.radial_ratio()
    assert axes.get_ylabel() == r"Radial over axial stress $\sigma_\mathrm{rad}/\sigma_\mathrm{ax}$"
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 0.6 / 0.999)
    assert [unit for _, unit, _ in figure.table] == ["-", "-"]


def test_runs_without_a_die_have_none_of_them(loop):
    run = pulvis.open(loop)
    assert not any(draw(run) for draw in (pressing.compaction_curve, pressing.heckel, pressing.radial_ratio))


def test_the_force_of_the_bottom_punch_is_seen_through_that_of_the_top(tablet):
    """They differ by a part of 500: one would hide the other."""
    with plt.rc_context(look.STYLE):
        figure = curves.forces(tablet, look.Options(width=85 / 25.4))
    assert [line.get_linestyle() for line in figure.axes[0].lines] == ["-", "--"]


def test_the_compaction_curve_ends_when_the_top_punch_is_free(tablet):
    _, axes = tablet.plot.compaction_curve()
    pressure = axes.lines[0].get_ydata()
    assert pressure[-1] == 0 and np.count_nonzero(pressure[1:] == 0) == 1 and len(pressure) < len(tablet.series("time"))
