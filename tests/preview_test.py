#!/usr/bin/python3
"""`pulvis preview`: every kind of shipped scene is drawn, with the names of its tools and stages and all of its particles,
nothing beside the sheet and no text over another.

usage: preview_test.py PROGRAM SOURCE_DIR [--all]

Of each folder of scenes a few are drawn, folders to come included; --all draws every one, which takes minutes.
"""
import io
import json
import math
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ALL = "--all" in sys.argv and not sys.argv.remove("--all")
PROGRAM, SOURCE = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]).resolve()
del sys.argv[1:3]
sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCE / "cli" / "python"))

from pulvis.preview import words
from pulvis.preview.draw import draw
from pulvis.preview.sheet import plt

SCENES = SOURCE / "scenes"
NO_SCENES = {"studies", "probes", "lab", "parts", "materials"}
# Beside some of every folder: what only few scenes have.
CHOSEN = ["afm/calibration-beam", "afm/colloid-316l", "afm/force-curve", "afm/incline-friction", "afm/meshed-v",
          "afm/raster", "basic/groove-wedge", "basic/oblique-impact", "basic/tension", "benchmark/cattaneo-mindlin",
          "bonds/double-cantilever", "bonds/green-strength", "bonds/sheared-blocks", "brittle/salt-and-copper",
          "compaction/ejection-25", "compaction/random-100", "compaction-3d/tablet-adhesion",
          "extreme/friction-20-cycles", "extreme/one-particle-free", "extreme/size-metres",
          "extreme/size-micrometres", "extreme/space-taylor-rod",
          "basic/flow-laws", "basic/spinning-disc", "periodic/cap-die", "periodic/shear", "shear/grooves-16", "shear/stick-slip"]
# Two cylinders, glued end to end, above a floor.
GLUED = """
family = "compaction"
dimension = 3
material = [{ name = "stone", density = "2000 kg/m^3", youngs_modulus = "20 GPa", poissons_ratio = 0.0 }]
body = [{ particle = "rod", position = ["0 mm", "0 mm", "0.506 mm"] }, { particle = "rod", position = ["0 mm", "0 mm", "1.518 mm"] }]
tool = [{ name = "floor", shape = "plane", point = ["0 mm", "0 mm", "0 mm"], normal = [0, 0, 1] }]
stage = [{ name = "rest", kind = "settle", duration = "10 us" }]

[[bond]]
between = ["stone", "stone"]
origin = "initial"
reach = 0.3
strength = "100 MPa"
fracture_energy = "2 kJ/m^2"

[[bond]]
between = ["stone", "floor"]
origin = "pressed"
threshold = "5 MPa"
growth = 0.1
strength = "50 MPa"
fracture_energy = "2 kJ/m^2"

[[particle]]
name = "rod"
material = "stone"
shape = "cylinder"
diameter = "1 mm"
height = "1 mm"
rounding = "0.05 mm"
mesh = { divisions = 3, rings = 2, axial_divisions = 6, grid = "extruded" }
"""
SVG = "{http://www.w3.org/2000/svg}"


def shipped():
    folders = sorted(folder for folder in SCENES.iterdir() if folder.is_dir() and folder.name not in NO_SCENES
                     and any(folder.glob("*.toml")))
    for folder in folders:
        scenes = sorted(folder.glob("*.toml"))
        yield from scenes if ALL else [scenes[0], scenes[-1]]
    yield from () if ALL else (SCENES / f"{name}.toml" for name in CHOSEN)


def run(*words_of_command, folder):
    return subprocess.run([PROGRAM, *words_of_command], cwd=folder, capture_output=True, text=True, check=False)


def kinds_of(setup):
    """What there is to draw in a set-up."""
    if setup["family"] == "afm":
        surface = setup["surface"] or {"shape": "calibration"}
        return {f"lever {setup['lever']['shape']}", f"tip {setup['tip']['shape']}", f"surface {surface['shape']}",
                *(f"action {action['kind']}" for action in setup["actions"])}
    kinds = {name for name in ("velocity", "angular_velocity") if any(name in one for one in setup["particles"])}
    kinds |= {f"tool {tool['shape']}" for tool in setup["tools"]} | {f"stage {stage['kind']}" for stage in setup["stages"]}
    for name in ("moves", "servos", "until", "cell"):
        if any(stage.get(name) for stage in setup["stages"]):
            kinds.add(f"stage with {name}")
    if setup["bonds"]["laws"]:
        kinds.add("laws of bonds")
    if setup.get("dimension") == 3:
        return {f"space {kind}" for kind in kinds}
    if len(setup["particles"]) > setup["count"]:
        kinds.add("grains")
    if setup["bonds"]["edges"]:
        kinds.add("bonds")
    if len(setup["classes"]) > 1:
        kinds.add("classes")
    if any(len(one["loops"]) > 1 for one in setup["particles"]):
        kinds.add("hole")
    return kinds | {name for name in ("cell", "die", "density_cells") if setup.get(name)}


MUST_COVER = {"lever beam", "lever v", "lever mesh", "tip none", "tip block", "tip cone", "tip sphere", "surface plane",
              "surface map", "surface bump", "surface calibration", "action press", "action retract", "action scan",
              "action raster", "tool plane", "tool polyline", "tool constraint", "stage compact", "stage eject",
              "stage shear", "stage hold", "stage with moves", "stage with servos", "stage with cell",
              "grains", "bonds", "classes", "velocity", "angular_velocity", "cell", "die",
              "space velocity", "space tool plane", "space stage with moves", "space laws of bonds"}


def drawn_count(svg):
    """Particles or grains in the groups of that name."""
    count = 0
    for group in svg.iter(f"{SVG}g"):
        if group.get("id", "").startswith("particles-"):
            used = len(list(group.iter(f"{SVG}use")))
            count += used or len(list(group.iter(f"{SVG}path")))
    return count


def texts_of(figure):
    """Without the numbers of the axes."""
    of_axes = [(*axes.get_children(), axes.xaxis.label, axes.yaxis.label) for axes in figure.axes]
    for text in [*figure.texts, *(text for texts in of_axes for text in texts)]:
        if isinstance(text, plt.Text) and text.get_text().strip():
            yield text


def overlaps(figure):
    """Texts that lie over each other, and those that leave the sheet."""
    renderer = figure.canvas.get_renderer()
    figure.draw(renderer)
    sheet = figure.bbox
    boxes = [(text.get_text(), plt.Text.get_window_extent(text, renderer)) for text in texts_of(figure)]
    for text, box in boxes:
        if box.x0 < sheet.x0 or box.x1 > sheet.x1 or box.y0 < sheet.y0 or box.y1 > sheet.y1:
            yield f"'{text}' leaves the sheet"
    for i, (first, a) in enumerate(boxes):
        for second, b in boxes[i + 1:]:
            common = max(0, min(a.x1, b.x1) - max(a.x0, b.x0)) * max(0, min(a.y1, b.y1) - max(a.y0, b.y0))
            if common > 0.12 * min(a.width * a.height, b.width * b.height):
                yield f"'{first}' over '{second}'"


def roundness(setup):
    """The mean over the particles of the largest over the smallest distance from the middle."""
    ratios = []
    for one in setup["particles"]:
        x, y = one["loops"][0][::2], one["loops"][0][1::2]
        away = [math.hypot(a - sum(x) / len(x), b - sum(y) / len(y)) for a, b in zip(x, y)]
        ratios.append(max(away) / min(away))
    return sum(ratios) / len(ratios)


class PreviewTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def setup_of(self, scene):
        told = run("preview", str(scene), "-o", "setup.json", folder=self.folder.name)
        self.assertEqual(told.returncode, 0, told.stderr)
        return json.loads((Path(self.folder.name) / "setup.json").read_text(encoding="utf-8")), told.stdout

    def check_particles(self, setup, told, svg, written):
        count = int(re.search(r": good: (\d+) particle", told)[1])
        self.assertEqual(setup["count"], count)
        self.assertEqual(sum(one["count"] for one in setup["classes"]), count)
        for tool in setup["tools"]:
            self.assertIn(tool["name"], written)
        if setup.get("dimension") == 3:  # drawn by faces
            self.assertEqual(len(setup["particles"]), count)
            return
        self.assertEqual(len({one["particle"] for one in setup["particles"]}), count)
        self.assertEqual(drawn_count(svg), len(setup["particles"]))
        if setup["die"]:
            left, right = setup["die"]["x"]
            self.assertIn(words.quantity(right - left, "m"), written)

    def test_every_kind_of_scene_is_drawn(self):
        covered, seen = set(), set()
        for scene in shipped():
            if scene in seen:
                continue
            seen.add(scene)
            with self.subTest(scene=str(scene.relative_to(SCENES))):
                setup, told = self.setup_of(scene)
                covered |= kinds_of(setup)
                figure = draw(setup)
                picture = io.BytesIO()
                figure.savefig(picture, format="svg")
                svg = ElementTree.fromstring(picture.getvalue())
                written = " ".join("".join(text.itertext()) for text in svg.iter(f"{SVG}text"))
                for stage in [*setup.get("stages", []), *setup.get("actions", [])][:10]:
                    self.assertIn((stage["name"] or stage["kind"])[:15], written)
                if setup["family"] == "particles":
                    self.check_particles(setup, told, svg, written)
                else:
                    self.assertIn(words.quantity(setup["lever"]["length"], "m"), written)
                    self.assertIn("thickness", written)
                self.assertEqual(list(overlaps(figure)), [])
                plt.close(figure)
        self.assertEqual(MUST_COVER - covered, set())

    def test_bonds_in_space_are_listed_with_the_faces_they_start_on(self):
        scene = Path(self.folder.name) / "glued.toml"
        scene.write_text(GLUED)
        setup, _ = self.setup_of(scene)
        self.assertEqual([(law["origin"], law["strength"]) for law in setup["bonds"]["laws"]], [("initial", 1e8), ("pressed", 5e7)])
        self.assertGreater(setup["bonds"]["faces"], 20)
        figure = draw(setup)
        written = " ".join(text.get_text() for text in texts_of(figure)).replace("\n", " ")
        for line in ("stone – stone: from the start, strength 100 MPa", f"{setup['bonds']['faces']} faces bonded at the start",
                     "stone – floor: formed by pressure, strength 50 MPa"):
            self.assertIn(line, written)
        self.assertEqual(list(overlaps(figure)), [])  # a tall scene: its views from the sides take the whole height
        plt.close(figure)

    def arrows_of(self, axes):
        """(straight, curved) arrows: ends of each, points of each."""
        straight = [(mark.xyann, mark.xy) for mark in axes.texts if mark.get_gid() == "velocity"]
        return straight, [line.get_xydata() for line in axes.lines if line.get_gid() == "spin-arc"]

    def moving(self, scene, **motion):
        """The figure of a set-up whose first particle has other motions, and what is written in it."""
        setup, _ = self.setup_of(scene)
        setup["particles"][0].update(motion)
        figure = draw(setup)
        self.addCleanup(plt.close, figure)
        self.assertEqual(list(overlaps(figure)), [])
        return figure, " ".join(text.get_text() for text in texts_of(figure))

    def test_velocities_and_spins_have_arrows_and_their_largest_in_the_key(self):
        figure, written = self.moving(SCENES / "extreme" / "space-taylor-rod.toml", angular_velocity=[0, 0, 1500.0])
        self.assertIn("initial velocity, up to 227 m/s", written)
        self.assertIn("initial spin, up to 1,500 rad/s", written)
        self.assertIn("rod: cylinder, diameter 6.4 mm, height 32.4 mm", written)
        for axes in figure.axes:  # from a corner, along y, along x
            [(begin, end)], [arc] = self.arrows_of(axes)
            self.assertAlmostEqual(begin[0], end[0], 9)
            self.assertLess(end[1], begin[1])
            self.assertEqual(axes is figure.axes[0], float(max(arc[:, 1]) - min(arc[:, 1])) > 1e-9)  # seen from its side elsewhere
        for spin, sign in ((4e4, 1), (-4e4, -1)):
            figure, written = self.moving(SCENES / "basic" / "spinning-disc.toml", angular_velocity=spin)
            self.assertIn("initial spin, up to 40,000 rad/s", written)
            straight, [arc] = self.arrows_of(figure.axes[0])
            self.assertEqual(straight, [])
            turn = arc[:-1, 0] * arc[1:, 1] - arc[:-1, 1] * arc[1:, 0]
            self.assertTrue((sign * turn > 0).all())

    def test_the_program_writes_the_spin_of_a_particle_in_space(self):
        setup, _ = self.setup_of(SOURCE / "tests" / "keys" / "scenes-3d" / "shapes.toml")
        self.assertEqual([one["angular_velocity"] for one in setup["particles"] if "angular_velocity" in one], [[10.0, 0.0, 0.0]])
        rod = next(one for one in setup["classes"] if one["name"] == "rod")
        self.assertEqual((rod["width"], rod["height"]), ([6e-3, 6e-3], [12e-3, 12e-3]))

    def test_numbers_of_scans_leave_their_lengths_free(self):
        setup, _ = self.setup_of(SCENES / "afm" / "loop-v-0.toml")
        setup["actions"] += setup["actions"]
        figure = draw(setup)
        self.assertEqual(sum("and back" in text.get_text() for text in texts_of(figure)), 4)  # in the drawing and in the list
        self.assertEqual(list(overlaps(figure)), [])
        plt.close(figure)

    def test_numbers_are_read_as_an_engineer_writes_them(self):
        for value, unit, text in ((50e-3, "m", "50 mm"), (5.0000001e-4, "m", "500 µm"), (2, "m", "2 m"), (3e3, "m", "3,000 m"),
                                  (-40e6, "Pa", "−40 MPa"), (1e13, "Pa", "10 TPa"), (0, "N", "0 N"), (20e-9, "N", "20 nN"),
                                  (1.98412, "m/s", "1.984 m/s"), (0.9999e-3, "m", "999.9 µm")):
            self.assertEqual(words.quantity(value, unit), text)
        self.assertEqual(words.span(2e-4, 1e-3, "m"), "0.2 to 1 mm")
        self.assertEqual(words.span(1e-3, 1e-3, "m"), "1 mm")
        self.assertEqual(words.number(1.25e-7), "1.25 · 10⁻⁷")
        self.assertEqual([words.way(v) for v in ((1, 0), (0, -2), (-1, 1), (0, 0))], ["→", "↓", "↖", "·"])

    def test_the_program_draws_what_it_is_asked_for(self):
        scene = str(SCENES / "compaction" / "regular-25.toml")
        for name, magic in (("a.png", b"\x89PNG"), ("b.pdf", b"%PDF"), ("c.svg", b"<?xml")):
            told = run("preview", scene, "-o", name, "--set", "title=Twenty-five", folder=self.folder.name)
            self.assertEqual(told.returncode, 0, told.stderr)
            self.assertEqual((Path(self.folder.name) / name).read_bytes()[:len(magic)], magic)
            self.assertEqual(told.stdout.splitlines()[-1], name)
        self.assertIn("Twenty-five", (Path(self.folder.name) / "c.svg").read_text(encoding="utf-8"))
        checked = run("check", scene, folder=self.folder.name).stdout.splitlines()
        self.assertEqual(len(told.stdout.splitlines()), len(checked) + 1)
        self.assertEqual(told.stdout.splitlines()[0], checked[0])

    def test_warnings_stand_in_the_picture(self):
        setup, told = self.setup_of(SCENES / "compaction" / "regular-25.toml")
        self.assertEqual(setup["warnings"], [])
        told = run("preview", str(SCENES / "compaction" / "regular-25.toml"), "-o", "fast.svg", "--set",
                   "stage.press.duration=0.1 ms", folder=self.folder.name)
        self.assertIn("warning: stage 'press': tool 'top' moves at up to", told.stdout)
        self.assertIn("Warning: stage 'press'", (Path(self.folder.name) / "fast.svg").read_text(encoding="utf-8"))

    def test_a_kept_state_is_drawn_as_it_is(self):
        text = (SCENES / "periodic" / "soft-discs.toml").read_text(encoding="utf-8")
        for old, new in (("number = 300", "number = 12"), ("18 mm", "3.8 mm"), ('"8 ms"', '"1 ms"'),
                         ('kind = "compact"\n', 'kind = "compact"\nkeep_state = true\n')):
            self.assertIn(old, text)
            text = text.replace(old, new)
        folder = Path(self.folder.name)
        (folder / "first.toml").write_text(re.sub(r"expect = \[.*?\n\]", "", text, flags=re.S), encoding="utf-8")
        told = run("run", "first.toml", "-o", "first", "--quiet", folder=folder)
        self.assertEqual(told.returncode, 0, told.stderr)
        (folder / "second.toml").write_text('extends = "first.toml"\ninitial_state = "first/state-press.h5"\n')
        before, _ = self.setup_of(folder / "first.toml")
        after, _ = self.setup_of(folder / "second.toml")
        shrunk = math.exp(-0.112)  # along both vectors
        for axis in range(2):
            self.assertAlmostEqual(after["cell"]["vectors"][axis][axis] / before["cell"]["vectors"][axis][axis], shrunk, 3)
        self.assertLess(roundness(before), 1.01)
        self.assertGreater(roundness(after), 1.05)

    def test_a_wrong_scene_is_refused_as_the_reader_does(self):
        wrong = Path(self.folder.name) / "wrong.toml"
        wrong.write_text((SCENES / "compaction" / "regular-25.toml").read_text().replace("[[stage]]", "[[stagee]]", 1))
        told = run("preview", "wrong.toml", folder=self.folder.name)
        checked = run("check", "wrong.toml", folder=self.folder.name)
        self.assertEqual((told.returncode, told.stderr), (2, checked.stderr))
        self.assertRegex(told.stderr, r"wrong\.toml:\d+:\d+: .*stagee")
        self.assertFalse((Path(self.folder.name) / "preview.png").exists())

    def test_other_files_are_not_replaced(self):
        mine = Path(self.folder.name) / "mine.png"
        mine.write_text("mine")
        told = run("preview", str(SCENES / "basic" / "tension.toml"), "-o", "mine.png", folder=self.folder.name)
        self.assertEqual((told.returncode, mine.read_text()), (2, "mine"))
        self.assertEqual(run("preview", str(SCENES / "basic" / "tension.toml"), "-o", "mine.gif",
                             folder=self.folder.name).returncode, 2)


if __name__ == "__main__":
    unittest.main()
