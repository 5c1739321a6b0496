"""Small results folders that are made up, with everything that figures show: no run is needed to draw them.

Labels and units are those of run.h5 (docs/series.md); the longest of them are here.
"""
import json

import h5py
import numpy as np

SIZE = 0.01  # m, of a particle
SAMPLES = 60
STRESS = ["stress/axial_top", "stress/axial_bottom"]
DENSITY = r"relative density $\rho$"
AXIAL, LATERAL, ROUND = r"$\sigma_\mathrm{ax}$", r"$\sigma_\mathrm{lat}$", r"$\sigma_\mathrm{rad}$"
ENERGIES = {"balance": "balance error", "bonds": "energy in bonds", "contact": "contact energy", "damping": "contact damping energy",
            "elastic": "elastic energy", "external": "external work", "fracture": "fracture energy", "friction": "friction energy",
            "hourglass": "hourglass energy", "indentation": "indentation energy", "kinetic": "kinetic energy", "plastic": "plastic energy"}
LAWS = {"heckel": [("K", 9.767e-9, "1/Pa"), ("A", 0.4702, "-"), ("yield_pressure", 1.0238e8, "Pa")],
        "kawakita": [("a", 0.671, "-"), ("b", 2.37e-8, "1/Pa")]}


def put(file, name, values, unit="-", **attributes):
    data = file.create_dataset(name, data=values)
    data.attrs.update({"unit": unit, "meaning": "made up", "components": 1, **attributes})


def grid_mesh(cells, corner, first):
    """(nodes, cells) of a block of `cells` along each axis; numbers of nodes begin with `first`."""
    count = np.array(cells) + 1
    places = np.meshgrid(*[np.linspace(0, SIZE, n) for n in count], indexing="ij")
    nodes = np.stack([place.ravel(order="F") for place in places], axis=1) + corner
    number = first + np.arange(count.prod()).reshape(count, order="F")
    low, high = slice(None, -1), slice(1, None)
    square = [(low, low), (high, low), (high, high), (low, high)]
    corners = square if len(cells) == 2 else [(*way, up) for up in (low, high) for way in square]
    return nodes, np.stack([number[way].ravel(order="F") for way in corners], axis=1)


def blocks(cells, numbers):
    """(nodes, cells, particle of each node, particle of each cell) of blocks side by side: `numbers` along each axis."""
    nodes, quads, first = [], [], 0
    for place in np.ndindex(*numbers):
        mine, corners = grid_mesh(cells, SIZE * np.array(place), first)
        nodes, quads, first = [*nodes, mine], [*quads, corners], first + len(mine)
    of_node, of_cell = (np.repeat(np.arange(len(parts)), [len(part) for part in parts]).astype("i4") for parts in (nodes, quads))
    return np.concatenate(nodes), np.concatenate(quads).astype("i4"), of_node, of_cell


def write_mesh(file, kind, mesh):
    nodes, cells, of_node, of_cell = mesh
    for name, values in ((kind, cells), ("cell_particle", of_cell), ("node_particle", of_node)):
        put(file, f"mesh/{name}", values)
    put(file, "mesh/reference", nodes, "m")


def write_particles(file, count):
    number = np.arange(count, dtype="i4")
    for name, values, names in (("material", number % 3, "microcrystalline cellulose\nlactose monohydrate\nmagnesium stearate"),
                                ("class", number % 2, "coarse granule\nfine granule"), ("number", number, "")):
        put(file, f"particles/{name}", values, label={"number": "particle"}.get(name, name), place="particle",
            **({"names": names} if names else {}))


def loading():
    """(time, density, pressure): pressed, then unloaded."""
    time = np.linspace(0, 2e-3, SAMPLES)
    full = time[42]
    load = np.minimum(time / full, 1)
    density = 0.6 + 0.34 * load
    pressure = 4.2e8 * load**3
    back = time > full
    pressure[back] *= np.maximum(0, 1 - (time[back] - full) / 2e-4)
    density[back] -= 0.004 * np.minimum((time[back] - full) / 2e-4, 1)
    return time, density, pressure


def write_history(file, series):
    """series: {name: (values, unit, label)}"""
    for name, (values, unit, label) in series.items():
        put(file, f"history/{name}", values, unit, label=label)


def series_of_a_die(axis, walls):
    time, density, pressure = loading()
    series = {"time": (time, "s", "time $t$"), "relative_density": (density, "-", DENSITY),
              "stress_ratio/axial": (pressure / 2.6e8, "-", rf"axial stress over yield stress {AXIAL[:-1]}/\sigma_y$"),
              "stress_ratio/lateral": (pressure / 4e8, "-", rf"lateral stress over yield stress {LATERAL[:-1]}/\sigma_y$"),
              "stress/transmission": (0.97 + 0 * time, "-", "transmission of the axial force"),
              "density/deviation": (0.02 * density, "-", r"standard deviation of local densities $s_\rho$")}
    for tool, force in (("top", pressure), ("bottom", -0.998 * pressure)):
        series[f"tool/{tool}/force_{axis}"] = (5e-5 * force, "N", f"force on {tool} $F_{axis}$")
        series[f"tool/{tool}/position_{axis}"] = (1e-3 / density, "m", f"position of {tool} ${axis}$")
        series[f"stress/axial_{tool}"] = (np.abs(force), "Pa", f"axial stress on the {tool} tool {AXIAL}")
    for wall, label in walls.items():
        series[f"stress/{wall}"] = (0.6 * pressure + 2e7 * (time > time[42]), "Pa", label)
    for k, (name, words) in enumerate(ENERGIES.items()):
        series[f"energy/{name}"] = (1.37 / (k + 1) * density**2 * np.linspace(0, 1, SAMPLES) ** (1 + k % 3), "J", f"{words} $E$")
    return series


def series_of_bonds(in_space):
    time, broken = loading()[0], np.linspace(0, 1, SAMPLES)
    size, unit, symbol = ("area", "m^2", "A") if in_space else ("length", "m", r"\ell")
    return {f"bonds/crack_{size}": (2.4e-5 * broken, unit, f"crack {size} ${symbol}$"),
            "bonds/fragments": (np.floor(1 + 8 * broken), "-", "fragments"), "time": (time, "s", "time $t$")}


def series_of_shear():
    way = np.linspace(0, 1.7e-3, SAMPLES)
    return {"shear/distance": (way, "m", "sliding distance $s$"), "shear/friction": (0.3 * np.tanh(4e3 * way), "-", r"friction coefficient $\mu$")}


def write_contacts(file, frame, ids, centre, dimensions):
    """Contacts between all neighbours in `ids`, and of the first particle with a tool."""
    point = (centre[ids[:, 0]] + centre[ids[:, 1]]) / 2
    for group, pairs, place in (("contacts", ids, point), ("tool_contacts", np.array([[0, 0]]), centre[:1] - SIZE / 2)):
        put(file, f"{frame}/{group}/ids", pairs.astype("i4"))
        put(file, f"{frame}/{group}/point", place, "m")
        put(file, f"{frame}/{group}/normal_force", 1.2e4 / (1.0 + np.arange(len(pairs))), "N")
    put(file, f"{frame}/particle_centre", centre, "m", components=dimensions)
    put(file, f"{frame}/force_chain", np.arange(len(centre), dtype="i4") % 2, place="particle", label="force chain")
    put(file, f"{frame}/coordination", np.arange(len(centre), dtype="i4") % 5, place="particle", label="coordination number $Z$")


def write_fields(file, frame, cells, dimensions):
    values = np.linspace(0, 1, cells)
    for name, scale, unit, label in (("effective_stress", 3.84e8, "Pa", r"effective stress $\sigma_\mathrm{eff}$"),
                                     ("plastic_strain", 0.731, "-", r"plastic strain $\bar\varepsilon_p$"),
                                     ("damage", 1, "-", "damage $d$")):
        put(file, f"{frame}/{name}", scale * values, unit, label=label, place="cell")
    parts = 4 if dimensions == 2 else 6
    put(file, f"{frame}/stress", -1.2e8 * np.outer(values, np.ones(parts)), "Pa", label=r"stress $\sigma$", place="cell", components=parts)


def write_densities(file, frame, cells, size, step):
    count = np.prod(cells)
    put(file, f"{frame}/local_density", 0.6 + 0.08 * step + 0.04 * np.sin(np.arange(count)).reshape(-1, cells[0]),
        label=r"local relative density $\rho$", place="list", components=int(cells[0]))
    put(file, f"{frame}/density_profile", 0.6 + 0.08 * step + 0.02 * np.linspace(-1, 1, cells[-1]), label=DENSITY, place="list")
    for axis, n, width in zip("xyz", cells, size):
        put(file, f"{frame}/density_grid/{axis}", np.linspace(0, width, n + 1), "m", label=f"grid lines ${axis}$", place="list")


def write_breaking(file, frame, places, in_space):
    """Bonds and cracks at `places`; the cracks of the run are as many."""
    count = len(places)
    for group in ("bonds", "cracks"):
        for name, off in (("position", 0),) if in_space else (("start", -2e-3), ("end", 2e-3)):
            put(file, f"{frame}/{group}/{name}", places + off, "m")
        put(file, f"{frame}/{group}/area", np.full(count, 1e-6), "m^2")
        put(file, f"{frame}/{group}/ids", np.zeros((count, 2), "i4"))
    put(file, f"{frame}/fragments/number", np.arange(4, dtype="i4"))
    put(file, f"{frame}/fragments/{'volume' if in_space else 'area'}", np.array([1.0, 2, 3, 4]) * (1e-9 if in_space else 1e-6))
    size = "area" if in_space else "length"
    if "cracks" not in file:
        for name, scale, unit in (("time", 1e-3, "s"), (size, 1e-6, "m^2"), ("shear", 1, "-"), ("energy", 1e-3, "J")):
            put(file, f"cracks/{name}", scale * np.linspace(0.05, 1, count), unit)
        put(file, "cracks/particle", np.zeros(count, "i4"))


def write_summary(folder, title, **more):
    curve = np.linspace(2e7, 4.2e8, 50)
    fits = {"samples": 50, "pressure": [2e7, 4.2e8], "laws": [
        {"law": law, "parameters": [dict(zip(("name", "value", "unit"), one)) for one in found], "rms": 0.08, "rms_unit": "-", "r_squared": 0.989,
         "rms_density": 0.03} for law, found in LAWS.items()],
        "curve": {"pressure": curve.tolist(), "heckel": (1 - np.exp(-9.767e-9 * curve - 0.4702)).tolist()}}
    (folder / "summary.json").write_text(json.dumps({"title": title, "outcome": "done", "fits": fits, "tools": [], **more}), encoding="utf-8")


def end_frame(file, frame, step):
    file[frame].attrs.update({"time": 4.853e-4 * step, "step": 100 * step, "complete": 1})


def powder(folder, title="Microcrystalline cellulose and lactose, pressed in a die and sheared over a ground plate"):
    """A run in two dimensions: a die, local densities, contacts, bonds that break, a target that is drawn."""
    folder.mkdir(parents=True)
    mesh = blocks((2, 2), (4, 5))
    nodes, cells, of_node, _ = mesh
    count = of_node.max() + 1
    centre = np.array([nodes[of_node == k].mean(axis=0) for k in range(count)])
    with h5py.File(folder / "run.h5", "w") as file:
        write_mesh(file, "quads", mesh)
        write_particles(file, count)
        put(file, "tools/line_tool", np.repeat([0, 1], 4).astype("i4"), names="bottom\ntop")
        for step in range(5):
            frame, press = f"frames/{step:06}", [1, 1 - 0.04 * step]
            put(file, f"{frame}/position", nodes * press, "m", place="node", components=2)
            write_fields(file, frame, len(cells), 2)
            put(file, f"{frame}/fragment", np.arange(count, dtype="i4") % 4, place="particle", label="fragment")
            write_contacts(file, frame, np.column_stack([np.arange(count - 1), np.arange(1, count)]), centre * press, 2)
            write_densities(file, frame, (4, 6), np.array([4, 5]) * SIZE * press, step)
            write_breaking(file, frame, centre[:6] * press, in_space=False)
            for name in ("number", "force"):
                put(file, f"{frame}/rose/{name}", (1 + np.cos(np.arange(18) / 3)) / 18)
            top = 5 * SIZE * press[1]
            put(file, f"{frame}/tools/outline", np.array([[0, 0], [4 * SIZE, 0], [4 * SIZE, -4e-3], [0, -4e-3],
                                                          [0, top], [4 * SIZE, top], [4 * SIZE, top + 4e-3], [0, top + 4e-3]]), "m")
            end_frame(file, frame, step)
        walls = {f"radial_{side}": f"lateral stress on the {side} wall {LATERAL}" for side in ("left", "right")}
        write_history(file, {**series_of_a_die("y", walls), **series_of_bonds(False), **series_of_shear()})
        file.attrs.update({"title": title, "scene_hash": "f00d"})
    write_summary(folder, title, shear={"static_friction": 0.2873, "dynamic_friction": 0.3001})
    return folder


def round_die(heights, radius, parts=16):
    """(corners, quads) of a cylinder about z between two heights."""
    angle = 2 * np.pi * np.arange(parts) / parts
    ring = radius * np.column_stack([np.cos(angle), np.sin(angle)]) + 2 * SIZE
    corners = np.concatenate([np.column_stack([ring, np.full(parts, z)]) for z in heights])
    k = np.arange(parts)
    return corners, np.column_stack([(k + 1) % parts, k, k + parts, (k + 1) % parts + parts])


def tablet(folder, title="A tablet of microcrystalline cellulose and lactose, pressed from both sides"):
    """A run in three dimensions in a cylindrical die, flat so that pictures are low: local densities, contacts, bonds that break."""
    folder.mkdir(parents=True)
    mesh = blocks((2, 2, 2), (4, 4, 1))
    nodes, cells, of_node, _ = mesh
    count = of_node.max() + 1
    centre = np.array([nodes[of_node == k].mean(axis=0) for k in range(count)])
    corners, quads = round_die((0, SIZE), 2.9 * SIZE)
    with h5py.File(folder / "run.h5", "w") as file:
        write_mesh(file, "hexahedra", mesh)
        write_particles(file, count)
        put(file, "tools/quads", quads.astype("i4"))
        put(file, "tools/quad_tool", np.zeros(len(quads), "i4"), names="die", kinds="die")
        for step in range(5):
            frame, press = f"frames/{step:06}", [1, 1, 1 - 0.04 * step]
            put(file, f"{frame}/position", nodes * press, "m", place="node", components=3)
            write_fields(file, frame, len(cells), 3)
            put(file, f"{frame}/fragment", np.arange(count, dtype="i4") % 4, place="particle", label="fragment")
            write_contacts(file, frame, np.column_stack([np.arange(count - 1), np.arange(1, count)]), centre * press, 3)
            write_densities(file, frame, (6, 6, 3), np.array([4, 4, 1]) * SIZE * press, step)
            write_breaking(file, frame, centre[:6] * press, in_space=True)
            put(file, f"{frame}/tools/outline", corners, "m", place="list", components=3)
            end_frame(file, frame, step)
        write_history(file, {**series_of_a_die("z", {"radial": f"stress on the die wall {ROUND}"}), **series_of_bonds(True)})
        file.attrs.update({"title": title, "scene_hash": "f00d"})
    write_summary(folder, title)
    return folder


def lever(folder, title="A V-shaped lever with a blunt tip, calibrated and drawn over a rough plane"):
    """A run of a lever: force curve, friction loops, raster images, plastic zone, frames."""
    folder.mkdir(parents=True)
    nodes, cells = grid_mesh((6, 2, 2), 0, 0)
    nodes = nodes / SIZE * [2e-4, 4e-5, 1e-6]
    t = np.linspace(0, 1, 40)
    there, back = np.sin(np.pi * t) * 1e-6, np.zeros(40)
    moves = {"z": [there, back, back], "y": [back, there, there], "x": [back, back, back]}
    time = np.concatenate([k + t for k in range(3)])
    drag = np.concatenate([back, np.where(t < 0.5, -3e-8, 3e-8), np.where(t < 0.5, -4e-8, 4e-8)])
    press = np.concatenate([4e-8 * np.sin(np.pi * t), np.full(80, 4e-8)])
    series = {"time": (time, "-", "actions completed")}
    for axis, parts in moves.items():
        series[f"scanner/{axis}"] = (np.concatenate(parts), "m", f"scanner ${axis}$")
    for axis, values in (("x", 0.1 * press), ("y", drag), ("z", press)):
        series[f"probe/force_{axis}"] = (values, "N", f"force on the tip $F_{axis}$")
    series["detector/lateral"] = (1e6 * drag, "V", "lateral signal $U_l$")
    series["detector/normal"] = (1e6 * press, "V", "normal signal $U_n$")
    with h5py.File(folder / "run.h5", "w") as file:
        write_mesh(file, "hexahedra", (nodes, cells.astype("i4"), np.zeros(len(nodes), "i4"), (np.arange(len(cells)) % 3).astype("i4")))
        for step in range(5):
            frame = f"frames/{step:06}"
            put(file, f"{frame}/position", nodes + step * 1e-6 * np.outer(nodes[:, 0] / 2e-4, [0, 0.1, 1]), "m", place="node", components=3)
            put(file, f"{frame}/plastic_strain", 0.0123 * step * np.linspace(0, 1, len(cells)) ** 2,
                label=r"plastic strain $\bar\varepsilon_p$", place="cell")
            file[frame].attrs.update({"time": 0.74 * step, "step": min(1 + 29 * step, len(time)), "complete": 1})
        write_history(file, series)
        for channel, unit, label, scale in (("topography", "m", "topography $z$", 1.3e-8), ("deflection", "V", "deflection $U_n$", 0.4),
                                            ("friction", "V", "friction signal $U_l$", 0.02)):
            for way in ("trace", "retrace"):
                put(file, f"images/action_1/{channel}_{way}", scale * np.random.default_rng(1).normal(size=(6, 8)), unit, label=label,
                    pixel_width=5e-8, pixel_height=5e-8)
        file.attrs.update({"title": title, "scene_hash": "f00d"})
    write_summary(folder, title, loops=[{"action": 1}, {"action": 2}])
    return folder


def study(folder, title="Friction, hardening and the size of the granules in a die of 36 mm"):
    """Charts of a study of twelve variations, with the fitted laws of each kind."""
    folder.mkdir(parents=True)
    x = np.linspace(0.6, 0.97, SAMPLES)
    names = [f"friction={mu:g}, hardening_modulus={h} MPa, diameter={d} mm" for mu in (0.05, 0.2) for h in (100, 440) for d in (3, 6, 9)]

    def curve(title, keys, units, scales, names):
        lines = []
        for k, name in enumerate(names):
            y = scales[1] * (1 + 0.2 * k) * x**9
            lines.append({"variation": name, "runs": 3, "x": (scales[0] * x).tolist(), "y": y.tolist(), "low": (0.95 * y).tolist(),
                          "high": (1.05 * y).tolist(), "standard_deviation": (0.03 * y).tolist()})
        return {"title": title, "x": keys[0], "y": keys[1], "x_unit": units[0], "y_unit": units[1], "lines": lines}

    curves = [curve("stress_ratio/axial against relative_density", ("relative_density", "stress_ratio/axial"), "--", (1, 3), names[:4]),
              curve("Force on the right platen", ("travel/right-platen", "tool/right-platen/force_x"), ("m", "N"), (1e-3, 800), names),
              curve("Standard deviation of the density over the height of the compact, in the die", ("relative_density", "density/deviation"),
                    "--", (1, 0.02), names[:1])]
    labels = {"relative_density": DENSITY, "stress_ratio/axial": rf"axial stress over yield stress {AXIAL[:-1]}/\sigma_y$",
              "density/deviation": r"standard deviation of local densities $s_\rho$", "travel/right-platen": "travel of right-platen $s$",
              "tool/right-platen/force_x": "force on right-platen $F_x$", "contact.friction": r"friction coefficient $\mu$"}
    fits = [{"title": "Green strength against porosity", "law": "ryshkewitch_duckworth", "unit": "Pa",
             "groups": fit_groups(["k", "r_squared"], "porosity", (0.04, 0.2), "strength", (7e6, 5e5))},
            {"title": "Crushing strength of single granules", "law": "weibull", "unit": "Pa",
             "groups": fit_groups(["modulus"], "strength", (2e7, 6e7), "failure_probability", (0.05, 0.95))},
            {"title": "Largest force against friction", "law": "power", "unit": "N", "series": "tool/right-platen/force_x",
             "key": "contact.friction", "key_unit": "-", "groups": fit_groups(["exponent"], "key", (0.05, 0.4), "value", (300, 900))}]
    (folder / "curves.json").write_text(json.dumps(curves), encoding="utf-8")
    (folder / "summary.json").write_text(json.dumps({"title": title, "labels": labels, "fits": fits}), encoding="utf-8")
    return folder


def fit_groups(parameters, x, x_ends, y, y_ends):
    groups = []
    for k, name in enumerate(("hardening_modulus=100 MPa", "hardening_modulus=440 MPa")):
        columns = np.linspace(*x_ends, 9), (1 + 0.02 * k) * np.linspace(*y_ends, 9)
        groups.append({"name": name, "parameters": [{"name": one, "value": 16.52 + k} for one in parameters],
                       "points": [{x: a, y: b} for a, b in zip(*columns)], "line": {x: columns[0].tolist(), y: columns[1].tolist()}})
    return groups


def probe(folder, title="Copper discs of three sizes", dimension=2):
    """Yield surfaces of two paths at three densities, with models and their scatter."""
    folder.mkdir(parents=True)
    (folder / "probe.toml").write_text("", encoding="utf-8")
    states = [probe_state(path, density, strength, dimension) for path in ("isostatic", "die")
              for density, strength in ((0.85, 2e7), (0.9, 6e7), (0.95, 1.8e8))]
    (folder / "summary.json").write_text(json.dumps({"title": title, "offset_strain": 0.002, "dissipation": 0.01, "states": states}),
                                         encoding="utf-8")
    return folder


def probe_in_space(folder):
    """The same in three dimensions, with points in the deviatoric plane and in shear."""
    return probe(folder, "Copper spheres of three sizes", 3)


def yield_point(strength, angle, kind, dimension):
    """A point of a set of directions; q changes its sign with the angle."""
    sine, cosine = np.sin(angle), np.cos(angle)
    pair = {"across_along": [strength * (1 + cosine), strength * (1 + sine)], "plastic_across_along": [cosine, sine]}
    plane = {"plane_p": strength * (1 + 0.8 * cosine), "plane_shear": 0.6 * strength * sine}
    return {"set": kind, "p": strength * (1 + 0.8 * cosine), "q": strength * sine, "fitted": bool(sine > -0.1) and kind != "shear",
            "fitted_in_stresses": True, **(pair if kind == "axial" else {}), **({"lode_angle": angle} if dimension == 3 else plane)}


def ball(strength):
    """A net of stresses, as of a model in terms of them."""
    polar, lode = np.meshgrid(np.linspace(0, np.pi, 17), np.linspace(0, 2 * np.pi, 24, endpoint=False), indexing="ij")
    mean, across, up = -np.ones(3) / np.sqrt(3), np.array([1, -1, 0]) / np.sqrt(2), np.array([1, 1, -2]) / np.sqrt(6)
    ways = (np.cos(polar)[..., None] * mean + np.sin(polar)[..., None]
            * (np.sin(lode)[..., None] * across + np.cos(lode)[..., None] * up))
    return (strength * (np.sqrt(3) * mean + ways)).tolist()


def probe_models(strength, dimension):
    """Those of the probes in this dimension; a parameter that the points do not determine has no value."""
    names = ["drucker_prager_cap", "modified_cam_clay", "s_clay", "fleck_kuhn_mcmeeking", "gurson",
             *(["fleck_plane", "fleck_plane_cohesive"] if dimension == 2 else [])]
    turn = np.linspace(0, np.pi, 20)
    surface = strength * np.column_stack([1 + np.cos(turn), np.sin(turn)])
    both = np.concatenate([surface, surface[::-1] * [1, -1]])
    values = {"p_b": 2.2 * strength, "R": 0.61, "p_c": 2 * strength, "M": 0.91, "alpha": 0.35}
    models = [{"name": name, "surface": (both if name == "s_clay" else surface).tolist(), "misfit": 0.0123 * (k + 1),
               "parameters": dict(values), "scatter": {one: {"deviation": 0.1} for one in ("R", "M")}} for k, name in enumerate(names)]
    models[0]["parameters"]["R"] = None if strength < 3e7 else 0.61
    if dimension == 3:
        models[2]["shell"] = ball(strength)
    return models


def probe_state(path, density, strength, dimension):
    points = [yield_point(strength, angle, "axial", dimension) for angle in np.linspace(-np.pi, np.pi, 16, endpoint=False)]
    if dimension == 3:
        points += [yield_point(strength, angle, "deviatoric", dimension) for angle in np.linspace(0, 2 * np.pi, 12, endpoint=False)]
    points += [yield_point(strength, 0.7, "shear", dimension)]
    found = {"points": points, "models": probe_models(strength, dimension)}
    seeds = [{"stress": [-strength, -strength * s, -strength, 0, 0, 0], "across_along": [strength, strength * s], "coordination": 6.1 * s,
              "fabric": [0.31, 0.33, 0.36 * s, 0, 0, 0], "youngs_modulus": 200 * strength * s, "poissons_ratio": 0.32 * s,
              **({"off": {"isotropic": 0.1 * s}} if dimension == 3 else {})} for s in (1, 1.06)]
    return {"path": path, "asked": density, "relative_density": density + 0.0013, "dimension": dimension,
            "yield": {"offset_strain": found, "dissipation": found}, "states": seeds}
