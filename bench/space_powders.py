"""3D powders for space_laws.py: stress of a dense powder, and cost of many particles."""
import csv
import json
import math
import resource
import statistics
import subprocess

import numpy as np

from space_scenes import PLASTIC, ball, body, contact, head, plane, stage


def packed(bench, name, count, mesh, side, density):
    """Scene of `count` randomly packed spheres in a box, each with velocity `rate` times its position from the centre."""
    rate = 4000.0  # 1/s
    folder = bench.folder
    text = head("Cost", PLASTIC) + mesh
    walls, moves = "", {}
    for axis, low, high in ((0, "left", "right"), (1, "front", "back"), (2, "bottom", "top")):
        for wall, at, sign in ((low, 0, 1), (high, side, -1)):
            unit = np.eye(3)[axis]
            walls += plane(wall, at * unit, [int(c) for c in sign * unit])
            moves[wall] = tuple(0.1 * side * sign * unit)
    packing = (f'\n[[packing]]\nkind = "random"\nwidth = "{side} m"\ndepth = "{side} m"\ndensity = {density}\n'
               f'[[packing.class]]\nparticle = "ball"\nnumber = {count}\n')
    (folder / f"{name}-packing.toml").write_text(text + packing + walls + stage(1e-4, {}, kind="settle"), encoding="utf-8")
    table = folder / f"{name}.csv"
    table.unlink(missing_ok=True)
    subprocess.run([bench.program, "pack", folder / f"{name}-packing.toml", "-o", table], check=True,
                   stdout=subprocess.DEVNULL)
    with open(table, encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for row in rows:
        at = np.array([float(row[f"{c} [m]"]) for c in "xyz"])
        v = ", ".join(f'"{c} m/s"' for c in -rate * (at - side / 2))
        text += body(*at, more=f"velocity = [{v}]\n")
    # Wall speed: rate times half the side length.
    return text + walls + stage(0.1 / (rate / 2), moves, ramp=1e-3) + contact(friction=0.1, damping=0.1)


def dense(bench):
    """How coarse meshes increase the stress of a dense powder, and soft contacts reduce it."""
    count, start, at = 27, 0.5, (0.7, 0.8, 0.85, 0.88, 0.9, 0.92, 0.93, 0.94)
    side = (count * math.pi / 6 * 1e-6 / start) ** (1 / 3)
    print("law dense: 27 spheres of 316L in a box that closes on all sides, friction 0.1: axial stress over sigma_y at relative densities")
    print(f"{'mesh':>5} {'elements':>8} {'stiffness':>9} {'':>7} {'steps':>6}  " + "  ".join(f"{d:6}" for d in at) + "   told to be lost")
    neither = "hardness = 1000\ninertance = 0\n"
    for divisions, rings, stiffness, more in [
            (d, r, k, neither) for d, r, k in ((4, 4, 0.5), (4, 4, 2), (4, 4, 10), (7, 1, 0.5), (7, 1, 2), (7, 1, 10), (8, 2, 0.5),
                                               (8, 2, 10), (12, 2, 10))] + [
            (d, r, 20, "") for d, r in ((4, 4), (7, 1), (8, 2), (12, 2))]:
        name = f"dense-{divisions}-{rings}-{stiffness}" + ("" if more else "-indenting")
        text = packed(bench, name, count, ball(0.01, divisions, rings, 'phase = "random"\n'), side, start)
        text = text.replace("[[stage.move]]", "[stage.until]\nrelative_density = 0.945\n[[stage.move]]", 1)
        text += f"stiffness = {stiffness}\n{more}[output]\nframes = 1\nsamples = 400\n[limits]\nenergy_balance = 0.05\n"
        h = bench.run(name, text)
        summary = json.loads((bench.folder / name / "summary.json").read_text(encoding="utf-8"))
        density, stress = h["relative_density"], h["stress_ratio/axial"]
        print(f"{f'{divisions},{rings}':>5} {summary['elements']:8d} {stiffness:9g} {'' if more else 'indents':>7} {summary['steps']:6d}  " +
              "  ".join(f"{np.mean(stress[np.abs(density - d) < 0.005]):6.3f}" for d in at) +
              f"   {-summary['contact_quality']['force_error']:.1%}", flush=True)


def cost(bench):
    """A box shrinks uniformly, and its spheres move with it from the start, so that the whole powder deforms at once, whatever its
    size. The cost at a density is the difference in CPU time between runs to just below and just above it."""
    before, after, start, rounds = 0.62, 0.72, 0.5, bench.rounds
    print(f"law cost: random packings of 316L, plastic, friction and damping 0.1, relative density from {before} to {after}, one thread;")
    print(f"ns an element and step, least and median of {rounds} rounds in turns; share of the bodies; bytes an element of the program")
    print(f"{'mesh':>5} {'spheres':>7} {'elements':>9} {'steps':>6} {'least':>7} {'median':>7} {'M updates/s':>12} {'bodies':>7} {'bytes':>7}",
          flush=True)
    few = "\n[output]\nframes = 1\nsamples = 10\n[limits]\nenergy_balance = 0.05\n"
    for divisions, rings in ((4, 4), (7, 1)):
        mesh = ball(0.01, divisions, rings, 'phase = "random"\n')
        scenes = {}
        for count in (27, 125, 1000):
            side = (count * math.pi / 6 * 1e-6 / start) ** (1 / 3)
            scenes[count] = packed(bench, f"cost-{count}-{divisions}-{rings}", count, mesh, side, start)
        seconds, found = {count: [] for count in scenes}, {}
        for _ in range(rounds):
            for count, text in scenes.items():
                spent, summary = [], []
                for density in (before, after):
                    name = f"cost-{count}-{divisions}-{rings}-{density}"
                    cut = text.replace("[[stage.move]]", f"[stage.until]\nrelative_density = {density}\n[[stage.move]]", 1) + few
                    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
                    bench.run(name, cut, "--threads", "1")
                    used = resource.getrusage(resource.RUSAGE_CHILDREN)
                    spent.append(used.ru_utime + used.ru_stime - usage.ru_utime - usage.ru_stime)
                    summary.append(json.loads((bench.folder / name / "summary.json").read_text(encoding="utf-8")))
                steps, elements = summary[1]["steps"] - summary[0]["steps"], summary[1]["elements"]
                seconds[count].append(1e9 * (spent[1] - spent[0]) / steps / elements)
                costs = [{c["system"]: c["seconds"] for c in s["cost"]} for s in summary]
                gained = {system: costs[1][system] - costs[0].get(system, 0) for system in costs[1]}
                found[count] = (elements, steps, gained, summary[1]["peak_memory_bytes"] / elements)
        for count, (elements, steps, gained, memory) in found.items():
            least, median, share = min(seconds[count]), statistics.median(seconds[count]), gained["plastic_force"] / sum(gained.values())
            print(f"{f'{divisions},{rings}':>5} {count:7d} {elements:9d} {steps:6d} {least:7.1f} {median:7.1f} {1e3 / least:12.2f} {share:7.0%} "
                  f"{memory:7.0f}   " + ", ".join(f"{s} {1e9 * t / steps / elements:.1f}" for s, t in
                                                sorted(gained.items(), key=lambda x: -x[1])[:7]), flush=True)
