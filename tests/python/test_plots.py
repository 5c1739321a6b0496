"""What run.plot and `pulvis figure` draw: what stands at the axes, sizes, colours, films, refusals."""
import re
import shutil
import subprocess
import zlib

import h5py
import matplotlib
import numpy as np
import pytest
from conftest import call
from matplotlib import pyplot as plt
from PIL import Image

import pulvis
from pulvis.figures.lever_film import VISIBLE, magnification
from pulvis.figures.names import label, name_of, over, plain
from pulvis.figures.quantities import inches, limits_of, unit_for


@pytest.fixture(autouse=True)
def no_figure_stays():
    yield
    plt.close("all")


def main_axes(figure):
    """Without colour bars."""
    return [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]


def bars(axes):
    return [child for child in axes.child_axes if child.get_ylabel() or child.get_yticks().size]


def test_curves_have_names_symbols_and_units(compact):
    run = pulvis.open(compact)
    figure, axes = run.plot.forces()
    assert axes.get_xlabel() == "Time $t$ / µs"
    assert re.fullmatch(r"Force \$F\$ / k?N", axes.get_ylabel())
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert "top, $F_y$" in labels and "left, $-F_x$" in labels  # what pulls is turned over
    top = axes.lines[labels.index("top, $F_y$")]
    unit = {"N": 1, "kN": 1e-3}[axes.get_ylabel().split(" / ")[1]]
    np.testing.assert_allclose(top.get_ydata(), unit * run.series("tool/top/force_y"))
    _, axes = run.plot.curve("relative_density", "stress_ratio/axial")
    assert axes.get_xlabel() == r"Relative density $\rho$"
    assert axes.get_ylabel() == r"Axial stress over yield stress $\sigma_\mathrm{ax}/\sigma_y$"
    np.testing.assert_array_equal(axes.lines[0].get_xdata(), run.series("relative_density"))


def test_a_picture_goes_into_axes_of_ones_own(compact):
    run = pulvis.open(compact)
    figure, places = plt.subplots(1, 3)
    for draw, place in ((run.plot.forces, places[0]), (run.plot.field, places[1]), (run.plot.network, places[2])):
        drawn, axes = draw(ax=place)
        assert drawn is figure and axes is place and place.has_data()
    assert len(main_axes(figure)) == 3
    assert figure.get_size_inches() == pytest.approx(plt.rcParams["figure.figsize"])


def test_axes_of_ones_own_keep_their_letters_and_lines(compact):
    run = pulvis.open(compact)
    with plt.rc_context({"font.size": 6}):
        _, (left, right) = plt.subplots(1, 2)
        run.plot.network(ax=left)
    assert {bar.yaxis.label.get_size() for bar in bars(left)} == {6}
    lines = next(c for c in left.collections if c.get_array() is not None)
    alone = next(c for c in run.plot.network()[1].collections if c.get_array() is not None)
    assert 0 < max(lines.get_linewidths()) < 0.6 * max(alone.get_linewidths())  # of half a figure


def test_drawing_leaves_the_look_of_other_figures_alone(compact):
    before = dict(matplotlib.rcParams)
    pulvis.open(compact).plot.field(width="85mm")
    assert dict(matplotlib.rcParams) == before


def test_a_field_has_its_range_unit_and_colours(compact):
    run = pulvis.open(compact)
    figure, axes = run.plot.field("pressure", frame=2, limits="-10:20 MPa", cmap="cividis")
    (bar,) = bars(axes)
    assert bar.get_ylabel() == "Pressure $p$ / MPa" and bar.get_ylim() == (-10, 20)
    faces = axes.collections[0]
    np.testing.assert_allclose(faces.get_array(), 1e-6 * run.frame(2).field("pressure"))
    assert faces.get_cmap().name == "cividis" and len(faces.get_paths()) == len(run.mesh.cells)
    assert axes.get_title("left").startswith("Pressure at 10.")
    _, axes = run.plot.field("stress:2", title=False)
    assert bars(axes)[0].get_ylabel().startswith(r"Stress $\sigma_{yy}$ / ") and axes.get_title("left") == ""


def test_fields_of_whole_numbers_have_a_legend(tagged):
    run = pulvis.open(tagged)
    _, axes = run.plot.field("material")
    legend = axes.get_legend()
    assert legend.get_title().get_text() == "Material"
    assert [text.get_text() for text in legend.get_texts()] == ["steel", "copper"]
    faces = axes.collections[0].get_facecolor()[:, :3]
    patches = [patch.get_facecolor()[:3] for patch in legend.get_patches()]
    of_cell = run.frame(0).field("material")[run.mesh.cell_particle]
    np.testing.assert_allclose(faces, np.array(patches)[of_cell], atol=1e-9)
    _, axes = run.plot.field("number")
    assert axes.get_legend() is None and len(np.unique(axes.collections[0].get_facecolor(), axis=0)) == 25
    _, axes = run.plot.field("coordination")
    steps = bars(axes)[0].get_yticks()
    assert np.array_equal(steps, np.unique(run.frame(-1).field("coordination")))
    with pytest.raises(pulvis.PulvisError, match="a colour for each number"):
        run.plot.field("class", limits=(0, 1))


def test_tools_are_drawn_as_recorded_or_as_lines(compact, tagged):
    _, axes = pulvis.open(tagged).plot.field()
    bodies = [c for c in axes.collections if len(c.get_paths()) == 2]
    top = bodies[0].get_paths()[0].vertices
    assert top[:, 0].max() == pytest.approx(50) and np.ptp(top[:, 1]) == pytest.approx(5)  # mm
    with h5py.File(compact / "run.h5") as file:
        recorded = "tools" in file
    if not recorded:
        _, axes = pulvis.open(compact).plot.field()
        assert len(axes.lines) == 4


def test_a_network_has_a_line_for_every_contact(compact):
    run = pulvis.open(compact)
    _, axes = run.plot.network()
    lines = next(c for c in axes.collections if c.get_array() is not None)
    assert len(lines.get_segments()) == len(run.network()) + len(run.network(tools=True))
    assert re.fullmatch(r"Normal force \$F_n\$ / k?N", bars(axes)[0].get_ylabel())


def test_densities_of_a_frame_and_of_the_run(compact):
    run = pulvis.open(compact)
    figure, axes = run.plot.density()
    assert len(main_axes(figure)) == 1
    assert axes.collections[0].get_array().size == 6
    figure, _ = run.plot.density(frame=None)
    assert sum(axes.get_title().startswith("$t$ = ") for axes in figure.axes) == 4


def test_what_was_not_recorded_is_said(loop, compact, tmp_path):
    with pytest.raises(pulvis.RunError, match=r"\[\[bond\]\]"):
        pulvis.open(compact).plot.cracks()
    with pytest.raises(pulvis.RunError, match="nothing recorded of forces"):
        pulvis.open(loop).plot.forces()
    with pytest.raises(pulvis.RunError, match="no contacts in frame 0, at 0 s"):
        pulvis.open(compact).plot.network(frame=0)
    with pytest.raises(pulvis.RunError, match="no contacts between particles in frame 0"):
        pulvis.open(compact).plot.rose(frame=0)
    with pytest.raises(pulvis.RunError, match="frame 'a': there are 0 to 4"):
        pulvis.open(compact).frame("a")
    for draw in (pulvis.open(compact).plot.forces, lambda ax: pulvis.open(compact).plot.animate("pressure", tmp_path / "film.gif", ax)):
        with pytest.raises(pulvis.RunError, match="ax = 3: allowed: axes of matplotlib"):
            draw(ax=3)
    with pytest.raises(TypeError, match="allowed: cmap, dpi"):
        pulvis.open(compact).plot.forces(colour="red")


def test_a_lever_has_its_curves(loop, pull_off):
    _, axes = pulvis.open(loop).plot.friction_loop()
    assert [text.get_text() for text in axes.get_legend().get_texts()][:2] in (
        ["trace", "retrace"], ["action 1, trace", "action 1, retrace"])
    assert axes.get_ylabel().startswith("Force that drags the tip / ")
    shown = [np.nanmedian(line.get_ydata()) for line in axes.lines]
    values = pulvis.open(loop).loops[0].values
    assert np.sign(shown[0]) == np.sign(values["trace"]) and np.sign(shown[1]) == np.sign(values["retrace"])
    _, axes = pulvis.open(pull_off).plot.force_curve()
    assert [line.get_label() for line in axes.lines] == ["approach", "retract"]
    assert axes.get_xlabel() == "Scanner $z$ / µm" and axes.get_ylabel().startswith("Force on the tip $F_z$ / ")


def test_a_notebook_shows_a_table_and_a_picture(compact, pull_off):
    for folder, says in ((compact, "Relative density"), (pull_off, "Pull-off force")):
        run = pulvis.open(folder)
        page = run._repr_html_()
        assert page.count("<img ") == 1 and says in page and run.hash in page
        assert run._repr_png_().startswith(b"\x89PNG")
    assert not plt.get_fignums()


def pdf_size(path):
    """mm"""
    box = re.search(rb"/MediaBox \[ ?0 0 ([\d.]+) ([\d.]+)", path.read_bytes())
    return [float(side) * 25.4 / 72 for side in box.groups()]


def test_files_have_the_size_that_was_asked_for(compact, tmp_path):
    call("figure", compact, "--width", "85mm", "--height", "2.5in", "--format", "pdf", "-o", tmp_path / "pdf")
    sizes = {path.name: pdf_size(path) for path in (tmp_path / "pdf").iterdir() if path.suffix == ".pdf"}
    assert len(sizes) == 11 and "effective_stress.pdf" in sizes and "contact_network.pdf" in sizes
    for name, (wide, tall) in sizes.items():
        assert wide == pytest.approx(85, abs=0.05) and tall == pytest.approx(63.5, abs=0.05), name
    call("figure", compact, "--field", "pressure", "--width", "8.5 cm", "--dpi", "300", "-o", tmp_path / "p.png")
    with Image.open(tmp_path / "p.png") as picture:
        assert picture.size[0] == int(85 / 25.4 * 300) and picture.info["dpi"][0] == pytest.approx(300, abs=1)
        assert 0.6 < picture.size[1] / picture.size[0] < 1.1  # as high as a square die takes, with its axes
    call("figure", compact, "--series", "dt", "--width", "170mm", "-o", tmp_path / "s.svg")
    width = re.search(r'<svg[^>]* width="([\d.]+)pt"', (tmp_path / "s.svg").read_text(encoding="utf-8"))
    assert float(width[1]) * 25.4 / 72 == pytest.approx(170, abs=0.1)


def test_titles_can_be_left_out(compact, tmp_path):
    for more, times in (((), 1), (("--no-title",), 0)):
        path = tmp_path / f"p{times}.svg"
        call("figure", compact, "--field", "pressure", *more, "-o", path)
        text = path.read_text(encoding="utf-8")
        assert text.count("Regular matrix of 25 discs") == times
        assert len(re.findall("σ|Pressure", text)) >= 1


@pytest.mark.parametrize(("words", "says"), [
    (("--width", "5mm"), "--width 5mm: allowed: 10 mm to 2 m"),
    (("--width", "85"), "--width 85: allowed: a length from 10 mm to 2 m"),
    (("--height", "nan mm"), "--height nan mm: allowed"),
    (("--dpi", "5"), "--dpi 5: allowed: 20 to 2400"),
    (("--cmap", "virids"), "--cmap virids: no such colour map; allowed: those of matplotlib, e.g. viridis"),
    (("--field", "pressure", "--range", "1:0 MPa"), "--range 1:0 MPa: allowed: LOW below HIGH"),
    (("--field", "pressure", "--range", "0:1 mm"), "mm is not a unit of the plotted quantity; allowed: LOW:HIGH in Pa"),
    (("--field", "pressure", "--range", "5"), "--range 5: allowed: LOW:HIGH in Pa"),
    (("--field", "pressure", "--range", "0:400"), "--range 0:400: 0 has no unit; allowed: LOW:HIGH in Pa, e.g. 0:400 MPa"),
    (("--field", "pressure", "--series", "dt"), "--field draws a field, --series curves: give one of them"),
    (("--level", "plane"), "--level is for raster images, and "),
    (("--animate", "f.gif", "--series", "dt"), "figures: --animate names its output file"),
    (("--against", "dt"), "error: --against gives the horizontal axis of --series"),
    (("--animate", "film.avi"), "--animate film.avi: allowed: a .mp4 or .gif file"),
    (("--field", "presure"), "no field presure of cells or particles; there are: "),
    (("--frame", "7"), "frame 7: there are 0 to 4"),
    (("--across", "z"), "figures: --across and --at are for sections, which only 3D runs have"),
    (("--at", "1mm"), "--across and --at are for sections"),
])
def test_wrong_options_are_refused_by_name_value_and_what_is_allowed(compact, tmp_path, words, says):
    assert says in call("figure", compact, *words, code=2, cwd=tmp_path)
    assert not list(tmp_path.glob("*.*"))


def frames_of(film):
    done = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-of", "csv=p=0",
                           "-show_entries", "stream=nb_read_frames,width,height,pix_fmt,r_frame_rate", film],
                          capture_output=True, text=True, check=True).stdout
    return done.strip().split(",")


def test_films_have_every_frame(compact, tmp_path):
    if not shutil.which("ffprobe"):
        pytest.skip("ffmpeg is not installed")
    call("figure", compact, "--animate", "film.mp4", "--field", "pressure", "--width", "61mm", cwd=tmp_path)
    wide, tall, form, rate, count = frames_of(tmp_path / "film.mp4")
    assert count == "5" and rate == "12/1" and form == "yuv420p"
    assert int(wide) % 2 == int(tall) % 2 == 0 and abs(int(wide) - 61 / 25.4 * 150) <= 1
    call("figure", compact, "--animate", "film.gif", "--dpi", "50", cwd=tmp_path)
    with Image.open(tmp_path / "film.gif") as film:
        assert film.n_frames == 5
        looks = []
        for k in range(5):
            film.seek(k)
            looks.append(np.asarray(film.convert("RGB"), int))
    assert all(np.abs(a - b).max() > 60 for a, b in zip(looks, looks[1:]))  # particles and colours move


def test_a_film_without_ffmpeg_says_what_to_install(compact, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", "/nowhere")
    says = call("figure", compact, "--animate", "film.mp4", code=4, cwd=tmp_path)
    assert "needs the program ffmpeg (Debian: apt install ffmpeg)" in says


def test_films_are_made_from_python(compact, tmp_path):
    figure, axes = pulvis.open(compact).plot.animate("effective_stress", tmp_path / "run.gif", dpi=40, width="85mm")
    with Image.open(tmp_path / "run.gif") as film:
        assert film.n_frames == 5 and film.size[0] == int(85 / 25.4 * 40)
    assert axes.get_title("left").startswith("Effective stress at 20 µs")
    assert len(figure.axes) == 1 and bars(axes)[0].get_ylabel().startswith(r"Effective stress $\sigma_\mathrm{eff}$ / ")


def test_a_film_keeps_colours_and_legend(tagged, tmp_path):
    run = pulvis.open(tagged)
    _, axes = run.plot.animate("material", tmp_path / "m.gif", dpi=30)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["steel", "copper"]
    _, axes = run.plot.animate("pressure", tmp_path / "p.gif", dpi=30)
    pressures = [frame.field("pressure") for frame in run.frames]
    ends = np.array([np.min(pressures), np.max(pressures)])
    unit = {"kPa": 1e-3, "MPa": 1e-6, "GPa": 1e-9}[bars(axes)[0].get_ylabel().split(" / ")[1]]
    assert bars(axes)[0].get_ylim() == pytest.approx(unit * ends)  # of all frames


@pytest.mark.parametrize("dpi", [60, 150, 300])
def test_no_seams_between_elements(compact, tmp_path, dpi):
    """Of one colour, a particle is one area: no pixel inside of it has another one."""
    run = pulvis.open(compact)
    figure, axes = run.plot.field("effective_stress", frame=0, limits=(1e9, 2e9), dpi=dpi, title=False)
    figure.savefig(tmp_path / "f.png", dpi=dpi)
    pixels = np.asarray(Image.open(tmp_path / "f.png").convert("RGB"), int)
    centre = axes.transData.transform([[25, 25], [25 + 3.6, 25]])  # mm: middle particle, well inside of its radius of 5
    radius = (centre[1, 0] - centre[0, 0]) * dpi / figure.dpi
    x, y = centre[0] * dpi / figure.dpi
    rows, columns = np.mgrid[:pixels.shape[0], :pixels.shape[1]]
    inside = (columns + 0.5 - x) ** 2 + (pixels.shape[0] - rows - 0.5 - y) ** 2 < radius ** 2
    assert inside.sum() > 300
    assert np.ptp(pixels[inside], axis=0).max() <= 2  # of 255: rounding


def test_no_seams_in_vector_files(compact, tmp_path):
    """Edges of elements are drawn in the colour of their faces, wide enough to cover what smoothing leaves."""
    call("figure", compact, "--field", "pressure", "-o", tmp_path / "p.svg")
    text = (tmp_path / "p.svg").read_text(encoding="utf-8")
    styles = re.findall(r'style="fill: (#\w{6}); stroke: (#\w{6}); stroke-width: ([\d.]+)', text)
    assert len(styles) >= 3500
    assert sum(face == edge and width == "0.35" for face, edge, width in styles) >= 3500
    call("figure", compact, "--field", "pressure", "-o", tmp_path / "p.pdf")
    streams = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", (tmp_path / "p.pdf").read_bytes(), re.S)
    drawn = b"".join(zlib.decompress(stream) for stream in streams if stream[:1] == b"x")
    assert drawn.count(b"0.35 w") >= 1


def test_csv_holds_the_numbers_in_si(compact, tmp_path):
    call("figure", compact, "--field", "pressure", "-o", tmp_path / "p.csv")
    lines = (tmp_path / "p.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "x [m],y [m],pressure [Pa]"
    values = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
    np.testing.assert_array_equal(values[:, 2], pulvis.open(compact).frame(-1).field("pressure"))


def test_a_study_is_drawn_by_the_same_command(study, tmp_path):
    says = call("figure", study, "--format", "svg", "-o", tmp_path / "s")
    drawn = sorted(path.name for path in (tmp_path / "s").glob("*.svg"))
    assert len(drawn) == 3 and "1-stress-ratio-axial-relative-density.svg" in drawn, says
    figure, axes = pulvis.open_study(study).chart(0)
    assert axes.get_ylabel().startswith("Axial stress over yield stress")
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["friction=0.1 (2 seeds)", "friction=0.3 (2 seeds)"]
    colours = [handle.get_color() for handle in axes.get_legend().get_lines()]
    assert len(set(colours)) == 2
    assert [line.get_color() for line in axes.lines if line.get_label().startswith("friction")] == colours


def test_labels_have_words_and_a_symbol():
    labels = {"stress": r"stress $\sigma$", "tool/upper punch/force_y": "force on upper punch $F_y$", "contacts": "boundary edges in contact"}
    for key, components, shown in (("tool/upper punch/force_y", 1, "Force on upper punch $F_y$ / kN"),
                                   ("stress:4", 4, r"Stress $\sigma_{xy}$ / kN"), ("stress:6", 6, r"Stress $\sigma_{zx}$ / kN"),
                                   ("contacts", 1, "Boundary edges in contact / kN"), ("peak/top_force", 1, "Top force at peak density $F$ / kN")):
        assert label(name_of(key, labels, components), "kN") == shown
    assert name_of("something/of_mine", labels).words == "something, of mine"
    assert over("Energy", "J/m^3") == "Energy / (J/m³)"
    assert plain(r"axial $\sigma_\mathrm{ax}$") == "axial σax"


def test_every_recorded_series_and_field_has_a_label(compact, loop):
    for folder in (compact, loop):
        run = pulvis.open(folder)
        assert set(run.names) | set(run.frame(-1).fields) <= set(run.labels)


def test_a_run_without_labels_is_drawn_with_words_from_its_names(compact, tmp_path):
    shutil.copytree(compact, tmp_path / "old")
    with h5py.File(tmp_path / "old/run.h5", "r+") as file:
        file.visititems(lambda _, item: item.attrs.__delitem__("label") if "label" in item.attrs else None)
    old = pulvis.open(tmp_path / "old")
    assert old.labels == {}
    assert old.plot.field("stress:2")[1].get_title("left").startswith("Stress")
    assert old.plot.series("relative_density")[1].get_ylabel() == "Relative density"


def test_lengths_and_ranges_are_read_with_their_units():
    assert inches("--width", "25.4mm") == pytest.approx(1) and inches("--width", "72 pt") == 1
    assert inches("--width", 3.5) == 3.5
    assert limits_of("0:400MPa", "Pa") == (0, 4e8) and limits_of("10 kPa:1 MPa", "Pa") == (1e4, 1e6)
    assert limits_of(":2 kN", "N") == (None, 2000) and limits_of((0.5, None), "-") == (0.5, None)
    assert limits_of("5 um:0.1mm", "m") == pytest.approx((5e-6, 1e-4)) and limits_of("0:50 %", "-") == (0, 0.5)
    assert limits_of((-1, 1), "Pa") == (-1, 1)
    assert limits_of("0:2 mm^2", "m^2") == pytest.approx((0, 2e-6))
    for most, shown in ((2e-8, "mm^2"), (0.5e-8, "µm^2"), (3e-3, "mm^2"), (0.02, "m^2"), (1e-12, "µm^2")):
        factor, unit = unit_for("m^2", [0, most])
        assert unit == shown and 0.01 <= factor * most < 1e4


def test_a_lever_s_film_has_its_frames_and_marks_the_forces(loop, tmp_path):
    """The solid moves; the marks stand on the curves of the forces at the time of the frame."""
    run = pulvis.open(loop)
    call("figure", loop, "--animate", "film.gif", "--dpi", "40", cwd=tmp_path)
    with Image.open(tmp_path / "film.gif") as film:
        assert film.n_frames == len({frame.time for frame in run.frames})  # the end may be there twice
        looks = []
        for k in range(film.n_frames):
            film.seek(k)
            looks.append(np.asarray(film.convert("RGB"), int))
    assert all(np.abs(a - b).max() > 60 for a, b in zip(looks, looks[1:]))
    figure, axes = run.plot.animate("solid", tmp_path / "again.gif", dpi=30)
    _, forces = figure.axes
    assert axes.name == "3d" and forces.get_ylabel() == "Force / nN"
    (x,), (y,) = forces.get_lines()[1].get_data()
    assert x == run.series("time")[-1] and y == pytest.approx(1e9 * run.series("probe/force_z")[-1])


def test_a_lever_s_displacements_are_drawn_so_that_they_are_seen(loop):
    run, times = pulvis.open(loop), magnification(pulvis.open(loop))
    moved = max(np.linalg.norm(frame.nodes - run.mesh.reference, axis=1).max() for frame in run.frames)
    length = np.ptp(run.mesh.reference, axis=0).max()
    assert times > 1 and 0.4 * VISIBLE < times * moved / length <= VISIBLE
    figure, _ = run.plot.animate("solid", loop.parent / "film.gif", dpi=30)
    assert f"displacements × {times:g}" in figure.axes[0].texts[0].get_text()


def test_a_lever_s_film_as_mp4(loop, tmp_path):
    if not shutil.which("ffprobe"):
        pytest.skip("ffmpeg is not installed")
    call("figure", loop, "--animate", "film.mp4", cwd=tmp_path)
    wide, tall, _, rate, count = frames_of(tmp_path / "film.mp4")
    assert count == str(len(pulvis.open(loop).frames)) and rate == "3/1" and int(wide) % 2 == int(tall) % 2 == 0


def test_what_a_lever_has_not_is_not_filmed(loop, tmp_path):
    says = call("figure", loop, "--animate", "film.gif", "--field", "pressure", code=2, cwd=tmp_path)
    assert "--field pressure: a lever is animated as one of: solid" in says


def test_friction_of_a_target(scenes, tmp_path):
    call("run", scenes / "shear/steady-sliding.toml", "-o", tmp_path / "run", "--threads", "1")
    run = pulvis.open(tmp_path / "run")
    _, axes = run.plot.friction()
    assert axes.get_xlabel().startswith("Sliding distance $s$ / ") and axes.get_ylabel() == r"Friction coefficient $\mu$"
    static, dynamic = (run.summary["shear"][f"{kind}_friction"] for kind in ("static", "dynamic"))
    assert [text.get_text() for text in axes.get_legend().get_texts()][1:] == [f"static: {static:.3g}", f"dynamic: {dynamic:.3g}"]
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), run.series("shear/friction")[run.series("shear/distance") != 0])
