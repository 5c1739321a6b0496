"""Figures of a probe: yield surfaces in the p-q plane and in the stress plane, moduli and cap parameters."""
import json

import numpy as np

from matplotlib import pyplot as plt
from matplotlib.lines import Line2D

from pulvis.figures.hidden import dash_hidden
from pulvis.figures.look import COLOURS, Options, unit_for
from pulvis.figures.names import label, over
from pulvis.figures.room import legend_below, legend_under, subplots

MODELS = {"drucker_prager_cap": ("Drucker–Prager cap", "-"), "modified_cam_clay": ("modified Cam-Clay", "--"),
          "fleck_kuhn_mcmeeking": ("Fleck–Kuhn–McMeeking", ":"), "gurson": ("Gurson", "-.")}
PLANE_MODELS = {"fleck_plane": ("Fleck, no cohesion", "-"), "fleck_plane_cohesive": ("Fleck, full cohesion", ":")}


WIDE_LEGEND = 4.4  # inches of a figure for each axes, from which their legend has two columns
WORDS_FROM = 6  # inches: narrower figures have symbols only, or one column
ARROWS = 18  # of unit length fit side by side into the width of the axes


def colours(states):
    densities = sorted({state["asked"] for state in states})
    shades = plt.get_cmap("viridis")(np.linspace(0.1, 0.85, len(densities)))
    return dict(zip(densities, shades))


def of_path(summary, path):
    return [state for state in summary["states"] if state["path"] == path]


def paths_of(summary):
    return list(dict.fromkeys(state["path"] for state in summary["states"]))


def all_points(states, criterion, key):
    return np.array([point[key] for state in states for point in state["yield"][criterion]["points"]])


def draw_invariants(axes, states, criterion, colour, factor):
    """p and q: points with their sign of q, model surfaces on both sides."""
    for state in states:
        shade, mine = colour[state["asked"]], state["yield"][criterion]
        axes.plot([factor * point["p"] for point in mine["points"]], [factor * point["q"] for point in mine["points"]],
                  "o", markersize=3.5, color=shade)
        for model in mine["models"]:
            if model["name"] in ("drucker_prager_cap", "modified_cam_clay"):
                p, q = factor * np.array(model["surface"]).T
                for side in (1, -1):
                    axes.plot(p, side * q, MODELS[model["name"]][1], color=shade, linewidth=1)
    highest = factor * max((point["p"] for state in states for point in state["yield"][criterion]["points"]), default=1)
    axes.set_xlim(-0.1 * highest, 1.08 * highest)
    axes.axhline(0, color="0.8", linewidth=0.6)


def make_room(axes, places, share):
    """Equal limits in both directions, with `share` of the width free around all `places`: for the arrows."""
    low, high = np.min(places, axis=0), np.max(places, axis=0)
    half = 0.5 * max(*(high - low), 1e-9) / (1 - 2 * share)
    for of, middle in zip((axes.set_xlim, axes.set_ylim), 0.5 * (low + high)):
        of(middle - half, middle + half)


def draw_stresses(axes, states, criterion, colour, factor):
    """Pressure yy against xx, with the plastic strain direction at each point."""
    places = [np.zeros(2)]
    for state in states:
        points, shade = state["yield"][criterion]["points"], colour[state["asked"]]
        x = -factor * np.array([point["stress"][0] for point in points])
        y = -factor * np.array([point["stress"][1] for point in points])
        axes.plot(x, y, "o", markersize=3, color=shade)
        plastic = -np.array([point["plastic"] for point in points]).reshape(-1, 2)
        axes.quiver(x, y, plastic[:, 0], plastic[:, 1], color=shade, angles="xy", width=0.003, scale=ARROWS)
        middle = -factor * np.mean([one["stress"][:2] for one in state["states"]], axis=0)
        axes.plot(*middle, "+", color=shade, markersize=9)
        places += [middle, *np.column_stack([x, y])]
    make_room(axes, np.array(places), 1.2 / ARROWS)
    axes.axline((0, 0), slope=1, color="0.8", linewidth=0.6)
    axes.set_aspect("equal")


def keys_of_surfaces(summary, colour):
    """Legend entries: one colour per density, the models, the state."""
    found = {state["asked"]: state["relative_density"] for state in summary["states"]}
    dots = [Line2D([], [], marker="o", linestyle="", markersize=3.5, color=colour[asked], label=f"density {found[asked]:.3f}")
            for asked in sorted(found)]
    lines = [Line2D([], [], linestyle=MODELS[name][1], color="0.4", linewidth=1, label=MODELS[name][0])
             for name in ("drucker_prager_cap", "modified_cam_clay")]
    return [*dots, *lines, Line2D([], [], marker="+", linestyle="", markersize=7, color="0.4", label="state"),
            Line2D([], [], marker="$\\rightarrow$", linestyle="", markersize=8, color="0.4", label="plastic strain")]


def surfaces(summary, criterion, options):
    paths = paths_of(summary)
    colour = colours(summary["states"])
    pressures = all_points(summary["states"], criterion, "p")
    if not len(pressures):
        return None
    factor, unit = unit_for("Pa", pressures)
    figure, axes = subplots(len(paths), 2, figsize=options.size(9.6, 4.8 * len(paths)), squeeze=False)
    short = options.width and options.width < WORDS_FROM
    for row, path in zip(axes, paths):
        states = of_path(summary, path)
        draw_invariants(row[0], states, criterion, colour, factor)
        draw_stresses(row[1], states, criterion, colour, factor)
        row[0].set_xlabel(over("$p$", unit) if short else label(("pressure", "p"), unit))
        row[0].set_ylabel(over("$q$" if short else "Von Mises' stress $q$, > 0: yy pressed more", unit))
        row[1].set_xlabel(over("$p_x$" if short else "Pressure in $x$", unit))
        row[1].set_ylabel(over("$p_y$" if short else "Pressure in $y$", unit))
        row[0].set_title(path, loc="left")
    legend_below(figure, keys_of_surfaces(summary, colour), not options.height)
    how = f"offset strain {summary['offset_strain']:g}" if criterion == "offset_strain" else \
        f"dissipation {summary['dissipation']:g} of the pressure"
    if options.title:
        figure.suptitle(f"{summary['title']}: yield surfaces by {how}", x=0.01, ha="left")
    return figure


def draw_fitted(axes, points, x, y, factor):
    """Yield points, those left out of the fit as open circles; probes of earlier versions do not tell them apart."""
    for fitted, look in ((True, {}), (False, {"markerfacecolor": "none", "label": "not in the fit"})):
        mine = [point for point in points if point.get("fitted", True) == fitted]
        if mine:
            axes.plot([factor * point[x] for point in mine], [factor * abs(point[y]) for point in mine], "ko",
                      markersize=3.5, **look)


def models(summary, options):
    """The densest state of each path compared with powder models, each with its fitted strength."""
    paths = [path for path in paths_of(summary) if of_path(summary, path)[-1]["yield"]["dissipation"]["models"]]
    if not paths:
        return None
    alone = options.width and options.width < WORDS_FROM  # each pair one above the other
    size = (4.8, 2 * 3.1 * len(paths)) if alone else (9.6, 4.6 * len(paths))
    figure, axes = subplots(2 * len(paths) if alone else len(paths), 1 if alone else 2, figsize=options.size(*size), squeeze=False)
    for row, path in zip(axes.reshape(-1, 2), paths):
        state = of_path(summary, path)[-1]
        mine = state["yield"]["dissipation"]
        factor, unit = unit_for("Pa", np.array([point["p"] for point in mine["points"]]))
        for side, names, x, y in ((row[0], MODELS, "p", "q"), (row[1], PLANE_MODELS, "plane_p", "plane_shear")):
            draw_fitted(side, mine["points"], x, y, factor)
            curves = []
            for model in mine["models"]:
                if model["name"] in names:
                    name, line = names[model["name"]]
                    curves += side.plot(*(factor * np.array(model["surface"]).T), line,
                                        label=f"{name}, off by {100 * model['misfit']:.1f}%")
            dash_hidden(side, curves)
            legend_under(side, fontsize=7, ncols=2 if figure.get_figwidth() / axes.shape[1] > WIDE_LEGEND else 1)
        row[0].set_title(f"{path}, density {state['relative_density']:.3f}", loc="left")
        row[0].set_xlabel(label(("pressure", "p"), unit))
        row[0].set_ylabel(over("$|q|$", unit))
        row[1].set_xlabel(over("Pressure in the plane", unit))
        row[1].set_ylabel(over("Shear in the plane", unit))
    if options.title:
        figure.suptitle(f"{summary['title']}: laws fitted to the yield points by dissipation", x=0.01, ha="left")
    return figure


def spread(values):
    return np.mean(values), (np.std(values, ddof=1) if len(values) > 1 else 0)


def parameters(summary, options):
    high = 9.2 if options.width and options.width < WORDS_FROM else 6.8
    figure, axes = subplots(2, 2, figsize=options.size(8.4, high))
    rows = (("youngs_modulus", "Young's modulus", "Pa"), ("poissons_ratio", "Poisson's ratio", ""))
    colour = {path: COLOURS[k % len(COLOURS)] for k, path in enumerate(paths_of(summary))}
    curves = [[], []]
    for path in colour:
        states = of_path(summary, path)
        density = [state["relative_density"] for state in states]
        for side, mine, (key, name, unit) in zip(axes[0], curves, rows):
            means = np.array([spread([one[key] for one in state["states"]]) for state in states])
            factor, shown = unit_for(unit, means[:, 0])
            mine.append(side.errorbar(density, factor * means[:, 0], factor * means[:, 1], marker="o", markersize=4, linestyle="-",
                                      capsize=3, color=colour[path], label=path).lines[0])
            side.set_ylabel(over(name, shown))
        for side, names in zip(axes[1], (("p_b", "p_c"), ("R", "M"))):
            for name, line in zip(names, ("-", "--")):
                draw_parameter(side, states, name, line, colour[path])
    for side in axes.flat:
        side.set_xlabel(label(("relative density", r"\rho"), ""))
        if not side.has_data():
            side.text(0.5, 0.5, "too few yield\npoints for a fit", ha="center", va="center", transform=side.transAxes)
    for side, mine in zip(axes[0], curves):
        dash_hidden(side, mine)
    axes[1][0].set_ylabel("Yield pressure $p_b$, $p_c$ / MPa")
    axes[1][1].set_ylabel("Eccentricity $R$, slope $M$")
    models = [Line2D([], [], color="0.4", linestyle=line, label=text) for line, text in
              (("-", "$p_b$, $R$: Drucker–Prager cap"), ("--", "$p_c$, $M$: modified Cam-Clay"))]
    paths = [Line2D([], [], color=shade, marker="o", markersize=4, linestyle="-", label=path) for path, shade in colour.items()]
    legend_below(figure, [*paths, *models], not options.height)
    if options.title:
        figure.suptitle(f"{summary['title']}: parameters, bars: standard deviation over seeds", x=0.01, ha="left")
    return figure


def draw_parameter(axes, states, name, line, colour):
    model = 0 if name in ("p_b", "R") else 1
    found = [(state["relative_density"], state["yield"]["dissipation"]["models"][model]) for state in states
             if state["yield"]["dissipation"]["models"]]
    if not found:
        return
    factor = 1e-6 if name.startswith("p_") else 1
    values = [factor * one["parameters"][name] for _, one in found]
    bars = [factor * one["scatter"].get(name, {"deviation": 0})["deviation"] for _, one in found]
    axes.errorbar([density for density, _ in found], values, bars, linestyle=line, marker="o", markersize=4, capsize=3, color=colour)


def figures_of_probe(folder, options=None):
    """Name and figure of each; None if there are too few yield points."""
    options = options or Options()
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return [("yield_surfaces", surfaces(summary, "offset_strain", options)),
            ("yield_surfaces_dissipation", surfaces(summary, "dissipation", options)),
            ("models", models(summary, options)), ("parameters", parameters(summary, options))]
