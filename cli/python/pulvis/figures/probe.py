"""Figures of a probe: yield surfaces in planes of stresses, moduli and parameters of models, in 3D also their anisotropy."""
import json

import numpy as np

from matplotlib import pyplot as plt
from matplotlib.lines import Line2D

from pulvis.errors import RunError
from pulvis.figures.hidden import dash_hidden
from pulvis.figures.look import COLOURS, Options, unit_for
from pulvis.figures.names import label, over
from pulvis.figures.room import legend_below, legend_under, subplots

CAP, CLAY, TURNED = "drucker_prager_cap", "modified_cam_clay", "s_clay"
SURFACES = {CAP: ("Drucker–Prager cap", "-"), CLAY: ("modified Cam-Clay", "--"), TURNED: ("turned ellipsoid (S-CLAY1)", ":")}
MODELS = {CAP: SURFACES[CAP], CLAY: SURFACES[CLAY], "fleck_kuhn_mcmeeking": ("Fleck–Kuhn–McMeeking", ":"), "gurson": ("Gurson", "-.")}
PLANE_MODELS = {"fleck_plane": ("Fleck, no cohesion", "-"), "fleck_plane_cohesive": ("Fleck, full cohesion", ":")}
LOOKS = {CAP: "o-", CLAY: "s--", TURNED: "^:"}  # of parameters
PRESSURES = [(CAP, "p_b", LOOKS[CAP]), (CLAY, "p_c", LOOKS[CLAY]), (TURNED, "p_c", LOOKS[TURNED])]
SHAPES = [(CAP, "R", LOOKS[CAP]), (CLAY, "M", LOOKS[CLAY]), (TURNED, "M", LOOKS[TURNED]), (TURNED, "alpha", "v-.")]

WIDE_LEGEND = 4.4  # inches of a figure for each axes, from which their legend has two columns
WORDS_FROM = 6  # inches: narrower figures have symbols only, or one column
ARROWS = 18  # of unit length fit side by side into the width of the axes
OPEN = {"markerfacecolor": "none", "markeredgewidth": 0.8}


def colours(states):
    densities = sorted({state["asked"] for state in states})
    shades = plt.get_cmap("viridis")(np.linspace(0.1, 0.85, len(densities)))
    return dict(zip(densities, shades))


def of_path(summary, path):
    return [state for state in summary["states"] if state["path"] == path]


def paths_of(summary):
    return list(dict.fromkeys(state["path"] for state in summary["states"]))


def in_space(states):
    return states[0]["dimension"] == 3


def is_short(options):
    return bool(options.width) and options.width < WORDS_FROM


def all_points(states, criterion, key):
    return np.array([point[key] for state in states for point in state["yield"][criterion]["points"]])


def dot_size(axes):
    """Points, of the marks of yield points."""
    return 3.5 if axes.figure.get_figwidth() / axes.get_gridspec().ncols > 0.5 * WORDS_FROM else 2.2


def model_of(state, criterion, name):
    return next((model for model in state["yield"][criterion]["models"] if model["name"] == name), None)


def how_found(summary, criterion):
    return f"offset strain {summary['offset_strain']:g}" if criterion == "offset_strain" else \
        f"dissipation {summary['dissipation']:g} of the pressure"


def draw_invariants(axes, states, criterion, colour, factor):
    """p and q with its sign. The isotropic models are those of q > 0; points of which they are not fitted are open."""
    for state in states:
        shade, mine = colour[state["asked"]], state["yield"][criterion]
        for fitted, look in ((True, {}), (False, OPEN)):
            points = [point for point in mine["points"] if point["fitted"] == fitted]
            axes.plot([factor * point["p"] for point in points], [factor * point["q"] for point in points], "o",
                      markersize=dot_size(axes), color=shade, **look)
        for model in mine["models"]:
            if model["name"] in SURFACES:
                axes.plot(*(factor * np.array(model["surface"]).T), SURFACES[model["name"]][1], color=shade, linewidth=1)
    highest = factor * max((point["p"] for state in states for point in state["yield"][criterion]["points"]), default=1)
    ends = [line.get_xdata().max() for line in axes.lines if len(line.get_xdata())]
    axes.set_xlim(-0.1 * highest, 1.08 * min(max(ends, default=highest), 1.3 * highest))
    axes.axhline(0, color="0.8", linewidth=0.6)


def make_room(axes, places, share):
    """Equal limits in both directions, with `share` of the width free around all `places`: for the arrows."""
    low, high = np.min(places, axis=0), np.max(places, axis=0)
    half = 0.5 * max(*(high - low), 1e-9) / (1 - 2 * share)
    for of, middle in zip((axes.set_xlim, axes.set_ylim), 0.5 * (low + high)):
        of(middle - half, middle + half)


def in_axial_plane(surface):
    """p and q in three dimensions as pressures: the lateral one times the root of 2, and that along z."""
    p, q = np.array(surface).T
    return np.column_stack([np.sqrt(2) * (p - q / 3), p + 2 * q / 3])


def draw_stresses(axes, states, criterion, colour, factor):
    """Pressure along the axis against that across it, with the direction of the plastic strain at each point."""
    places = [np.zeros(2)]
    for state in states:
        points, shade = [point for point in state["yield"][criterion]["points"] if point["set"] == "axial"], colour[state["asked"]]
        x, y = factor * np.array([point["across_along"] for point in points]).reshape(-1, 2).T
        axes.plot(x, y, "o", markersize=dot_size(axes) - 0.5, color=shade)
        plastic = np.array([point["plastic_across_along"] for point in points]).reshape(-1, 2)
        axes.quiver(x, y, plastic[:, 0], plastic[:, 1], color=shade, angles="xy", scale_units="width", scale=ARROWS,
                    units="inches", width=0.012 if dot_size(axes) > 3 else 0.006)
        middle = factor * np.mean([one["across_along"] for one in state["states"]], axis=0)
        axes.plot(*middle, "+", color=shade, markersize=9)
        turned = model_of(state, criterion, TURNED)
        if turned and in_space([state]):
            axes.plot(*(factor * in_axial_plane(turned["surface"])).T, SURFACES[TURNED][1], color=shade, linewidth=1)
        places += [middle, *np.column_stack([x, y])]
    make_room(axes, np.array(places), 1.2 / ARROWS)
    axes.axline((0, 0), slope=np.sqrt(0.5) if in_space(states) else 1, color="0.8", linewidth=0.6)
    axes.set_aspect("equal")


def dots_of(summary, colour):
    """Legend entries: one colour per density."""
    found = {state["asked"]: state["relative_density"] for state in summary["states"]}
    return [Line2D([], [], marker="o", linestyle="", markersize=3.5, color=colour[asked], label=f"density {found[asked]:.3f}")
            for asked in sorted(found)]


def lines_of(summary, criterion, names):
    """Legend entries of the models that were fitted."""
    return [Line2D([], [], linestyle=SURFACES[name][1], color="0.4", linewidth=1, label=SURFACES[name][0]) for name in names
            if any(model_of(state, criterion, name) for state in summary["states"])]


def keys_of_surfaces(summary, criterion, colour):
    """Legend entries: densities, models, the points that are not fitted, the state, the plastic strain."""
    keys = [*dots_of(summary, colour), *lines_of(summary, criterion, SURFACES)]
    if not all(all_points(summary["states"], criterion, "fitted")):
        keys.append(Line2D([], [], marker="o", linestyle="", markersize=3.5, color="0.4", label="not in the isotropic fits", **OPEN))
    return [*keys, Line2D([], [], marker="+", linestyle="", markersize=7, color="0.4", label="state"),
            Line2D([], [], marker="$\\rightarrow$", linestyle="", markersize=8, color="0.4", label="plastic strain")]


def name_planes(row, states, unit, short):
    axis = "z" if in_space(states) else "y"
    row[0].set_xlabel(over("$p$", unit) if short else label(("pressure", "p"), unit))
    row[0].set_ylabel(over("$q$" if short else f"Von Mises' stress $q$, > 0: {axis}{axis} pressed more", unit))
    across = (r"$\sqrt{2}\,p_\mathrm{lat}$", r"$\sqrt{2}$ times lateral pressure") if in_space(states) else ("$p_x$", "Pressure in $x$")
    row[1].set_xlabel(over(across[0 if short else 1], unit))
    row[1].set_ylabel(over(f"$p_{axis}$" if short else f"Pressure in ${axis}$", unit))


def surfaces(summary, criterion, options):
    paths = paths_of(summary)
    colour = colours(summary["states"])
    pressures = all_points(summary["states"], criterion, "p")
    if not len(pressures):
        return None
    factor, unit = unit_for("Pa", pressures)
    figure, axes = subplots(len(paths), 2, figsize=options.size(9.6, 4.8 * len(paths)), squeeze=False)
    for row, path in zip(axes, paths):
        states = of_path(summary, path)
        draw_invariants(row[0], states, criterion, colour, factor)
        draw_stresses(row[1], states, criterion, colour, factor)
        name_planes(row, states, unit, is_short(options))
        row[0].set_title(path, loc="left")
    legend_below(figure, keys_of_surfaces(summary, criterion, colour), not options.height)
    if options.title:
        figure.suptitle(f"{summary['title']}: yield surfaces by {how_found(summary, criterion)}", x=0.01, ha="left")
    return figure


def finer(ring, times=16):
    """A closed smooth curve through evenly spaced points, with so many times as many (trigonometric interpolation)."""
    waves, half = np.fft.fft(ring, axis=0), len(ring) // 2
    between = np.zeros(((times - 1) * len(ring), *ring.shape[1:]))
    return times * np.fft.ifft(np.concatenate([waves[:half], between, waves[half:]]), axis=0).real


def section_of(shell, pressure):
    """Where a net of stresses [rows, columns, 3] has this pressure, as a closed curve in the deviatoric plane."""
    shell, found = np.array(shell), []
    columns = shell.shape[1]
    for k in range(columns // 2):
        line = finer(np.concatenate([shell[:, k], shell[-2:0:-1, k + columns // 2]]))
        away = -line.mean(axis=1) - pressure
        for i in np.flatnonzero(away * np.roll(away, -1) < 0):
            share = away[i] / (away[i] - away[(i + 1) % len(away)])
            found.append(line[i] + share * (line[(i + 1) % len(line)] - line[i]))
    xx, yy, zz = np.array(found).reshape(-1, 3).T
    ring = np.column_stack([(xx - yy) / np.sqrt(2), (xx + yy - 2 * zz) / np.sqrt(6)])
    if len(ring):
        ring = ring[np.argsort(np.arctan2(*(ring - ring.mean(axis=0)).T))]
        ring = finer(ring, 8) if len(ring) == columns else ring
    return np.concatenate([ring, ring[:1]])


def draw_deviators(axes, states, criterion, colour, factor):
    """The Lode angle goes clockwise from compression along z, which is up; the length is that of the deviator."""
    longest = 0
    for state in states:
        points, shade = [point for point in state["yield"][criterion]["points"] if point["set"] == "deviatoric"], colour[state["asked"]]
        if not points:
            continue
        length = factor * np.sqrt(2 / 3) * np.abs([point["q"] for point in points])
        angle = np.array([point["lode_angle"] for point in points])
        axes.plot(length * np.sin(angle), length * np.cos(angle), "o", markersize=dot_size(axes), color=shade)
        turned, ring = model_of(state, criterion, TURNED), np.zeros((0, 2))
        if turned and "shell" in turned:
            ring = factor * section_of(turned["shell"], np.mean([point["p"] for point in points]))
            axes.plot(*ring.T, SURFACES[TURNED][1], color=shade, linewidth=1)
        longest = max(longest, length.max(), np.hypot(*ring.T).max(initial=0))
    for angle, name in zip(np.deg2rad((0, 120, 240)), "zyx"):
        way = np.array([np.sin(angle), np.cos(angle)])
        axes.plot(*(1.08 * longest * np.array([0 * way, way])).T, color="0.7", linewidth=0.7, zorder=0)
        axes.text(*(1.2 * longest * way), f"${name}$", ha="center", va="center", color="0.4")
    axes.set(xlim=(-1.32 * longest, 1.32 * longest), ylim=(-1.32 * longest, 1.32 * longest), aspect="equal")


def deviatoric_plane(summary, criterion, options):
    """The yield points of the deviatoric directions, with the turned ellipsoid at the mean of their pressures."""
    states = [state for state in summary["states"] if any(point["set"] == "deviatoric" and point["q"] for point in
                                                          state["yield"][criterion]["points"])]
    if not states:
        return None
    colour, paths = colours(summary["states"]), paths_of({"states": states})
    factor, unit = unit_for("Pa", all_points(states, criterion, "q"))
    columns = 1 if is_short(options) else min(2, len(paths))
    rows = -(-len(paths) // columns)
    figure, axes = subplots(rows, columns, figsize=options.size(4.8 * columns, 4.8 * rows), squeeze=False)
    for side in axes.flat[len(paths):]:
        side.set_visible(False)
    for side, path in zip(axes.flat, paths):
        draw_deviators(side, of_path({"states": states}, path), criterion, colour, factor)
        side.set_title(path, loc="left")
        side.set_xlabel(over(r"$\sqrt{2/3}\,q\,\sin\theta$", unit))
        side.set_ylabel(over(r"$\sqrt{2/3}\,q\,\cos\theta$", unit))
    legend_below(figure, [*dots_of(summary, colour), *lines_of(summary, criterion, [TURNED])], not options.height)
    if options.title:
        figure.suptitle(f"{summary['title']}: deviatoric plane, yield by {how_found(summary, criterion)}", x=0.01, ha="left")
    return figure


def draw_fitted(axes, points, x, y, factor):
    """Yield points, those left out of the fit as open circles."""
    for fitted, look in ((True, {}), (False, {**OPEN, "label": "not in the fit"})):
        mine = [point for point in points if point["fitted"] == fitted]
        if mine:
            axes.plot([factor * point[x] for point in mine], [factor * abs(point[y]) for point in mine], "ko",
                      markersize=3.5, **look)


def draw_models(axes, state, names, x, y):
    """Points and models in terms of x and y; returns the unit of pressures."""
    mine = state["yield"]["dissipation"]
    factor, unit = unit_for("Pa", np.array([point["p"] for point in mine["points"]]))
    draw_fitted(axes, mine["points"], x, y, factor)
    curves = []
    for model in mine["models"]:
        if model["name"] in names:
            name, line = names[model["name"]]
            curves += axes.plot(*(factor * np.array(model["surface"]).T), line, label=f"{name}, off by {100 * model['misfit']:.1f}%")
    dash_hidden(axes, curves)
    return unit


def models(summary, options):
    """The densest state of each path with a fit compared with powder models, each with its fitted strength."""
    found = {state["path"]: state for state in summary["states"] if state["yield"]["dissipation"]["models"]}
    if not found:
        return None
    kinds = {"p": MODELS, "plane_p": PLANE_MODELS}
    panels = [(state, x) for state in found.values() for x in (("p",) if in_space([state]) else kinds)]
    columns = 1 if is_short(options) or len(panels) == 1 else 2
    size = (4.8, 3.1 * len(panels)) if columns == 1 else (9.6, 4.6 * -(-len(panels) // 2))
    figure, axes = subplots(-(-len(panels) // columns), columns, figsize=options.size(*size), squeeze=False)
    for side in axes.flat[len(panels):]:
        side.set_visible(False)
    for side, (state, x) in zip(axes.flat, panels):
        unit = draw_models(side, state, kinds[x], x, "q" if x == "p" else "plane_shear")
        legend_under(side, fontsize=7, ncols=2 if figure.get_figwidth() / axes.shape[1] > WIDE_LEGEND else 1)
        side.set_xlabel(label(("pressure", "p"), unit) if x == "p" else over("Pressure in the plane", unit))
        side.set_ylabel(over("$|q|$" if x == "p" else "Shear in the plane", unit))
        if x == "p":
            side.set_title(f"{state['path']}, density {state['relative_density']:.3f}", loc="left")
    if options.title:
        figure.suptitle(f"{summary['title']}: laws fitted to the yield points by dissipation", x=0.01, ha="left")
    return figure


def spread(values):
    return np.mean(values), (np.std(values, ddof=1) if len(values) > 1 else 0)


def draw_moduli(axes, summary, colour, pick, name, unit):
    """pick: the value of a state. With the standard deviation over seeds."""
    rows = {path: [(state["relative_density"], *spread([pick(one) for one in state["states"]])) for state in of_path(summary, path)]
            for path in colour}
    factor, shown = unit_for(unit, np.array([mean for found in rows.values() for _, mean, _ in found]))
    curves = []
    for path, found in rows.items():
        density, mean, bars = np.array(found).T
        curves.append(axes.errorbar(density, factor * mean, factor * bars, marker="o", markersize=4, linestyle="-", capsize=3,
                                    color=colour[path], label=path).lines[0])
    axes.set_ylabel(over(name, shown))
    axes.set_xlabel(label(("relative density", r"\rho"), ""))
    dash_hidden(axes, curves)


def draw_parameter(axes, states, of, colour, factor=1):
    """A parameter of a model against density, with its standard deviation over seeds. States without it are left out."""
    name, key, look = of
    found = [(state["relative_density"], model["parameters"][key], model["scatter"].get(key, {"deviation": 0})["deviation"])
             for state in states if (model := model_of(state, "dissipation", name)) and model["parameters"].get(key) is not None]
    if found:
        density, value, bars = np.array(found).T
        axes.errorbar(density, factor * value, factor * bars, fmt=look, markersize=4, capsize=3, color=colour)


def draw_parameters(axes, summary, colour, parts, factor=1):
    for path, shade in colour.items():
        for of in parts:
            draw_parameter(axes, of_path(summary, path), of, shade, factor)
    axes.set_xlabel(label(("relative density", r"\rho"), ""))
    if not axes.has_data():
        fits = any(state["yield"]["dissipation"]["models"] for state in summary["states"])
        axes.text(0.5, 0.5, "not determined\nby the points" if fits else "too few yield\npoints for a fit", ha="center", va="center",
                  transform=axes.transAxes)


def colours_of_paths(summary):
    return {path: COLOURS[k % len(COLOURS)] for k, path in enumerate(paths_of(summary))}


def keys_of_paths(colour):
    return [Line2D([], [], color=shade, linestyle="-", linewidth=3, label=path) for path, shade in colour.items()]


def parameters(summary, options):
    if not summary["states"]:
        return None
    figure, axes = subplots(2, 2, figsize=options.size(8.4, 9.2 if is_short(options) else 6.8))
    colour = colours_of_paths(summary)
    draw_moduli(axes[0][0], summary, colour, lambda one: one["youngs_modulus"], "Young's modulus", "Pa")
    draw_moduli(axes[0][1], summary, colour, lambda one: one["poissons_ratio"], "Poisson's ratio", "")
    draw_parameters(axes[1][0], summary, colour, PRESSURES, 1e-6)
    draw_parameters(axes[1][1], summary, colour, SHAPES)
    axes[1][0].set_ylabel("Yield pressure $p_b$, $p_c$ / MPa")
    axes[1][1].set_ylabel(r"$R$, $M$, $\alpha$" if is_short(options) else r"Eccentricity $R$, slope $M$, rotation $\alpha$")
    texts = ("$p_b$, $R$: Drucker–Prager cap", "$p_c$, $M$: modified Cam-Clay", "$p_c$, $M$: S-CLAY1", r"$\alpha$: S-CLAY1")
    keys = [Line2D([], [], color="0.4", linestyle=look[1:], marker=look[0], markersize=4, label=text)
            for (_, _, look), text in zip(SHAPES, texts)]
    legend_below(figure, [*keys_of_paths(colour), *keys], not options.height)
    if options.title:
        figure.suptitle(f"{summary['title']}: parameters, bars: standard deviation over seeds", x=0.01, ha="left")
    return figure


def anisotropy(summary, options):
    """In three dimensions: how far the stiffness is from an isotropic one, and the contacts between the particles."""
    if not all("off" in one for state in summary["states"] for one in state["states"]):
        return None
    short, colour = is_short(options), colours_of_paths(summary)
    figure, axes = subplots(*((3, 1) if short else (1, 3)), figsize=options.size(*((4.8, 8.4) if short else (10.2, 3.6))))
    draw_moduli(axes[0], summary, colour, lambda one: one["off"]["isotropic"], "Distance of the stiffness to isotropy", "")
    draw_moduli(axes[1], summary, colour, lambda one: one["fabric"][2], "Fabric $F_{zz}$", "")
    draw_moduli(axes[2], summary, colour, lambda one: one["coordination"], "Coordination number $Z$", "")
    axes[1].axhline(1 / 3, color="0.8", linewidth=0.6, zorder=0)
    legend_below(figure, keys_of_paths(colour), not options.height)
    if options.title:
        figure.suptitle(f"{summary['title']}: anisotropy, bars: standard deviation over seeds", x=0.01, ha="left")
    return figure


def figures_of_probe(folder, options=None):
    """Name and figure of each; None if there are too few yield points."""
    options = options or Options()
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    if any("dimension" not in state for state in summary["states"]):
        raise RunError(f"{folder} was written by an earlier version: repeat its `pulvis probe`, which keeps the runs")
    found = [("yield_surfaces", surfaces(summary, "offset_strain", options)),
             ("yield_surfaces_dissipation", surfaces(summary, "dissipation", options)),
             ("models", models(summary, options)), ("parameters", parameters(summary, options))]
    if not summary["states"] or not in_space(summary["states"]):
        return found
    return [*found, ("deviatoric_plane", deviatoric_plane(summary, "dissipation", options)), ("anisotropy", anisotropy(summary, options))]
