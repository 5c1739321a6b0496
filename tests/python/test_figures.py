"""What the pictures say: curves that can be told apart, ticks that are true."""
import struct
import types
import unittest

import matplotlib

matplotlib.use("Agg")
import made_up
import numpy as np
from matplotlib import pyplot as plt

from pulvis.figures import afm, bonds, cell, colours, look, network, probe, study

plt.rcParams.update(look.STYLE)


class Frame(dict):
    attrs = {"time": 1e-3}


class Shares(list):
    """As a dataset of HDF5: read whole by [()]."""

    def __getitem__(self, key):
        return np.array(list(self)) if key == () else list.__getitem__(self, key)


class FiguresTest(unittest.TestCase):
    def test_curves_of_a_figure_differ_in_colour_or_dash(self):
        x = "time", np.linspace(0, 1, 5), "s"
        lines = [(f"energy {i}", i * x[1], "J") for i in range(12)]
        axes = look.draw_lines(types.SimpleNamespace(title="", labels={}), x, lines, "energy", "Energies").axes[0]
        looks = {(line.get_color(), line.get_linestyle()) for line in axes.lines if len(line.get_xdata()) == 5}
        self.assertEqual(len(looks), 12)
        self.assertEqual(len({line.get_color() for line in axes.lines[:9]}), 9)

    def drawn(self, *curves):
        """The dashes of curves in one figure, with a sample of the picture along each."""
        x = "time", np.linspace(0, 1, 300), "s"
        lines = [(f"{i}", values(x[1]), "N") for i, values in enumerate(curves)]
        figure = look.draw_lines(types.SimpleNamespace(title="", labels={}), x, lines, ("force", "F"), "Forces")
        figure.canvas.draw()
        picture, axes = np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int), figure.axes[0]
        return [line for line in axes.lines if len(line.get_xdata()) == 300], picture, axes

    def share_seen(self, line, picture, axes):
        """Of the pixels along a curve, those in its colour."""
        at = np.round(axes.transData.transform(line.get_xydata())[5:-5]).astype(int)
        colour = 255 * np.array(matplotlib.colors.to_rgb(line.get_color()))
        return np.mean(np.abs(picture[len(picture) - 1 - at[:, 1], at[:, 0]] - colour).max(axis=1) < 60)

    def test_curves_that_lie_on_one_another_are_all_seen(self):
        for count in (2, 3, 4):
            lines, picture, axes = self.drawn(*[lambda x: 5e3 * x ** 2] * count, lambda x: 8e3 * x)
            for line in lines[:count]:
                self.assertGreater(self.share_seen(line, picture, axes), 0.5 / count)
            self.assertGreater(self.share_seen(lines[count], picture, axes), 0.9)
            self.assertEqual([line.get_linestyle() for line in (lines[0], lines[count])], ["-", "-"])

    def test_only_curves_that_hide_others_are_dashed(self):
        lines, *_ = self.drawn(lambda x: x, lambda x: 1.05 * x, lambda x: x * (x < 0.5) + (1 - x) * (x >= 0.5), lambda x: 0 * x)
        self.assertEqual([line.get_linestyle() for line in lines], ["-"] * 4)
        lines, *_ = self.drawn(lambda x: x, lambda x: 1.001 * x, lambda x: np.where(x < 0.5, x, np.nan))
        self.assertEqual([line.get_linestyle() for line in lines], ["-", "--", "-"])  # the last one hides half of it

    def test_curves_of_a_study_that_lie_on_one_another_are_dashed(self):
        lines = [{"variation": f"{n} samples", "runs": 1, "x": np.linspace(0.1, 1, n).tolist(),
                  "y": (np.linspace(0.1, 1, n) ** 2).tolist()} for n in (60, 97)]
        curve = {"x": "time", "x_unit": "s", "y": "energy/kinetic", "y_unit": "J", "title": "Energies", "lines": lines}
        axes = study.draw(curve, {"title": "A study"}, look.Options()).axes[0]
        self.assertEqual([line.get_linestyle() for line in axes.lines], ["-", "--"])

    def test_ticks_of_the_rose_stand_where_they_say(self):
        for most in (0.2, 0.13, 0.07, 0.5):
            number = Shares([most, most / 2, most / 3, most / 4])
            frame = Frame({"rose/number": number, "rose/force": number, "rose": None})
            run = types.SimpleNamespace(frames=[0], frame=lambda _, one=frame: one, title="")
            figure = network.rose(run)
            figure.canvas.draw()
            axes = figure.axes[0]
            for place, label in zip(axes.yaxis.get_ticklocs(), axes.yaxis.get_ticklabels()):
                self.assertAlmostEqual(place, float(label.get_text().removesuffix(" %")), places=9)
            self.assertGreater(axes.yaxis.get_ticklocs()[0], 0)  # 0 would be under the bars
            rim, legend = axes.get_window_extent(), axes.get_legend().get_window_extent()
            self.assertLess(legend.y1, rim.y0)

    def test_arrows_of_a_yield_surface_stay_in_its_frame(self):
        angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
        points = [made_up.yield_point(50e6, a, "axial", 2) for a in angle]
        state = {"asked": 0.9, "dimension": 2, "yield": {"offset_strain": {"points": points, "models": []}}, "states": [{"across_along": [50e6, 50e6]}]}
        _, axes = plt.subplots()
        probe.draw_stresses(axes, [state], "offset_strain", {0.9: "k"}, 1e-6)
        low, high = axes.get_xlim()
        length = (high - low) / probe.ARROWS
        for point in points:
            tip = 1e-6 * np.array(point["across_along"]) + length * np.array(point["plastic_across_along"])
            for at, (first, last) in zip(tip, (axes.get_xlim(), axes.get_ylim())):
                self.assertTrue(first < at < last)

    def test_points_left_out_of_a_fit_are_open_circles_and_the_legend_is_below(self):
        points = [{"p": 1e6 * p, "q": 1e6 * q, "plane_p": 1e6 * p, "plane_shear": 1e6 * q, "fitted": q > 0}
                  for p, q in ((10, -5), (10, 5), (20, 4))]
        law = {"name": "modified_cam_clay", "surface": [[0, 0], [2e7, 0]], "misfit": 0.01}
        state = {"path": "iso", "relative_density": 0.9, "dimension": 2, "yield": {"dissipation": {"points": points, "models": [law]}}}
        figure = probe.models({"title": "", "states": [state]}, look.Options())
        figure.canvas.draw()
        axes = figure.axes[0]
        full, hollow = axes.lines[:2]
        self.assertEqual((len(full.get_xdata()), len(hollow.get_xdata())), (2, 1))
        self.assertEqual(hollow.get_markerfacecolor(), "none")
        self.assertLess(axes.get_legend().get_window_extent().y1, axes.get_window_extent().y0)

    def test_a_parameter_that_is_not_determined_is_left_out(self):
        states = [made_up.probe_state("die", density, strength, 3) for density, strength in ((0.85, 2e7), (0.9, 6e7))]
        _, axes = plt.subplots()
        probe.draw_parameter(axes, states, probe.SHAPES[0], "k")
        self.assertEqual(axes.lines[0].get_xdata().tolist(), [states[1]["relative_density"]])
        for state in states:
            for model in state["yield"]["dissipation"]["models"]:
                model["parameters"] = dict.fromkeys(model["parameters"])
        for seen in probe.parameters({"title": "", "states": states}, look.Options()).axes[2:]:
            self.assertEqual([text.get_text() for text in seen.texts], ["not determined\nby the points"])

    def test_a_ball_is_cut_in_a_circle_of_the_deviatoric_plane(self):
        ring = probe.section_of(made_up.ball(5e7), 4e7)  # about the pressure of 5e7 with this radius
        np.testing.assert_allclose(np.hypot(*ring.T), np.sqrt(5e7**2 - 3 * 1e7**2), rtol=1e-3)
        np.testing.assert_array_equal(ring[0], ring[-1])
        self.assertEqual(len(probe.section_of(made_up.ball(5e7), 2e8)), 0)

    def test_an_ellipsoid_about_the_pressures_is_symmetric_to_them_in_the_axial_plane(self):
        places = probe.in_axial_plane([[3e7, 0], [2e7, 1e7], [2e7, -1e7]])
        np.testing.assert_allclose(places[0], 3e7 * np.array([np.sqrt(2), 1]))
        middle = 0.5 * (places[1] + places[2])
        np.testing.assert_allclose(middle, 2e7 * np.array([np.sqrt(2), 1]))
        self.assertAlmostEqual((places[1] - places[2]) @ [np.sqrt(2), 1], 0, places=3)  # at right angles

    def test_fragments_are_counted_in_whole_numbers(self):
        series = {"time": np.linspace(0, 1, 5), "bonds/fragments": np.ones(5)}
        run = types.SimpleNamespace(title="", labels={}, in_space=False, has=lambda _: True, series=lambda name: series.get(name, np.zeros(5)))
        figure = bonds.breaking(run)
        figure.canvas.draw()
        ticks = figure.axes[-1].get_yticks()
        self.assertTrue(np.all(ticks == np.round(ticks)), ticks)

    def test_every_fragment_keeps_its_colour_and_neighbours_differ(self):
        found = colours.fragment_colours(np.arange(60))
        self.assertEqual(len({tuple(np.round(one, 3)) for one in found}), 60)
        self.assertTrue(np.array_equal(found[[7, 3]], colours.fragment_colours([7, 3])))
        apart = np.abs(found[:, None] - found[None]).max(axis=2) + np.eye(60)
        self.assertGreater(apart.min(), 0.015)
        self.assertGreater(np.diag(apart, 1).min(), 0.1)

    def test_sizes_of_fragments_add_up_by_number_and_by_area(self):
        diameter, number, area = bonds.cumulative(np.array([3.0, 1.0, 4.0]))
        np.testing.assert_allclose(np.pi / 4 * diameter ** 2, [1, 3, 4])
        np.testing.assert_allclose(number, [1 / 3, 2 / 3, 1])
        np.testing.assert_allclose(area, [1 / 8, 1 / 2, 1])

    def test_particles_are_drawn_inside_the_cell_and_again_across_its_borders(self):
        square = 0.1 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
        centres = np.array([[1.2, 0.5], [0.05, 0.05], [0.6, 0.5]])  # outside, in a corner, in the middle
        vectors = np.array([[2.0, 0.1], [0.5, 1.0]])
        stored = (centres[:, None] + square).reshape(-1, 2) @ vectors + [3, 4]
        frame = {"cell": np.vstack([[3, 4], vectors]), "position": Shares(stored.tolist())}
        mesh = {"mesh/node_particle": Shares(np.repeat(np.arange(3), 4).tolist()), "mesh/quads": Shares([]),
                "mesh/cell_particle": Shares([])}
        drawn = cell.Cell(types.SimpleNamespace(file=mesh), frame)
        np.testing.assert_allclose(drawn.shift, [-vectors[0], [0, 0], [0, 0]], atol=1e-12)
        again = sorted((int(p), *np.round(np.linalg.solve(vectors.T, (at[4 * p] - drawn.position[4 * p])))) for
                       at, shown in drawn.images for p in np.flatnonzero(shown))
        self.assertEqual(again, [(1, 0, 1), (1, 1, 0), (1, 1, 1)])
        end = drawn.other_end(np.array([[2, 0]]), centres @ vectors + [3, 4], np.array([[0.4, 0.5]]) @ vectors + [3, 4])
        np.testing.assert_allclose(end, [[0.2, 0.5]] @ vectors + [3, 4])

    def test_without_a_cell_particles_stay_where_they_are(self):
        mesh = {"mesh/node_particle": Shares([0, 0]), "mesh/quads": Shares([]), "mesh/cell_particle": Shares([])}
        drawn = cell.Cell(types.SimpleNamespace(file=mesh), {"position": Shares([[0, 0], [1, 2]])})
        self.assertFalse(drawn.here or drawn.images or drawn.shift.any())
        np.testing.assert_allclose(drawn.limits(), [[-0.06, -0.06], [1.06, 2.06]])

    def test_a_simple_field_is_what_gwyddions_manual_describes(self):
        values = np.arange(12, dtype=float).reshape(3, 4) * 1e-9 + 1e-7
        for title in ("a", "ab", "abc", "abcd", "Höhe"):  # all lengths of the padding
            fields, data = simple_field_of(afm.simple_field(title, "m", values, (2e-8, 5e-8)))
            self.assertEqual((fields["XRes"], fields["YRes"]), ("4", "3"))
            self.assertAlmostEqual(float(fields["XReal"]), 8e-8, places=20)
            self.assertAlmostEqual(float(fields["YReal"]), 15e-8, places=20)
            self.assertEqual((fields["XYUnits"], fields["ZUnits"], fields["Title"]), ("m", "m", title))
            for row in range(3):  # the upper row first: the last line of the scan
                np.testing.assert_allclose(data[row], values[2 - row], rtol=1e-6)

    def test_levelling_takes_a_plane_or_the_median_of_each_line_off(self):
        y, x = np.mgrid[:7, :9]
        plane, bump = 3 + 0.5 * x - 0.25 * y, np.zeros((7, 9))
        np.testing.assert_allclose(afm.levelled(plane, "plane"), 0, atol=1e-12)
        bump[3, 4] = 1
        off = afm.levelled(plane + bump, "plane")
        self.assertAlmostEqual(off[3, 4] - off.mean(), 1 - 1 / 63, places=12)  # the bump is in the middle
        lines = afm.levelled(bump + 10.0 * y, "lines")
        np.testing.assert_allclose(lines, bump, atol=1e-12)
        self.assertIs(afm.levelled(plane, "none"), plane)


def simple_field_of(content):
    """Reads a Gwyddion Simple Field byte by byte, by its description alone."""
    magic = b"Gwyddion Simple Field 1.0\n"
    assert content.startswith(magic)
    end = content.index(b"\0")
    fields = dict(line.split(" = ", 1) for line in content[len(magic):end].decode("utf-8").splitlines())
    begin = end
    while begin == end or begin % 4:
        assert content[begin] == 0
        begin += 1
    wide, tall = int(fields["XRes"]), int(fields["YRes"])
    assert len(content) == begin + 4 * wide * tall
    numbers = struct.unpack(f"<{wide * tall}f", content[begin:])
    return fields, [numbers[wide * row:wide * (row + 1)] for row in range(tall)]

