"""Levers: stiffness against mesh, element, thickness and run time; prints the tables in docs/accuracy.md and
bench/results/levers.md.

  /usr/bin/python3 bench/levers.py [table-4.2] [table-4.3] [thickness] [fronts] [feet]      (all: about 15 minutes)

Fronts are printed as tables and drawn (--draw FILE.png).
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/cli/pulvis"
THESIS = {(2, 2, 2.2): 0.466, (1, 2, 2.2): 0.457, (2, 2, 0.7): 0.430, (1.3, 2, 0.7): 0.427,
          (1, 1.1, 1.1): 0.353}  # Table 4.2: element width, length, thickness in um: N/m
L, W, T = 440, 50, 2.2


def calibrate(scene, overrides=(), runs=2):
    """Runs a scene; returns its calibration, the minimum wall time of two runs in s, and its element count."""
    best = None
    for _ in range(runs):
        with tempfile.TemporaryDirectory() as folder:
            command = [PROGRAM, "run", ROOT / "scenes/afm" / scene, "-o", f"{folder}/run", "--threads", "1"]
            for override in overrides:
                command += ["--set", override]
            done = subprocess.run(command, capture_output=True, text=True)
            if not pathlib.Path(f"{folder}/run/summary.json").exists():
                sys.exit(done.stderr)
            summary = json.loads(pathlib.Path(f"{folder}/run/summary.json").read_text())
        seconds = summary["wall_seconds"]
        best = seconds if best is None else min(best, seconds)
    return summary["calibration"], best, summary["elements"]


def divided(width, length, thickness):
    counts = [round(L / length), round(W / width), round(T / thickness)]
    return [f"lever.elements_along={counts[0]}", f"lever.elements_across={counts[1]}",
            f"lever.layers={counts[2]}"]


def converged():
    """Plate elements of 2 x 2 x 1.1 um: as fine as most rows below, and ten times finer than needed."""
    return calibrate("tipless-beam.toml", divided(2, 2, 1.1), 1)[0]["k_n"]


def table_42():
    reference = converged()
    print(f"Converged (plate elements, divisions 2 : 2 : 1.1): {reference:.4f} N/m\n")
    print("| division: width, length, thickness, um | elements | the thesis | standard | solid | plate |")
    print("|---|---|---|---|---|---|")
    for division, thesis in THESIS.items():
        row, elements = [], 0
        for element in ("standard", "solid", "plate"):
            c, _, elements = calibrate("tipless-beam.toml",
                                       divided(*division) + [f"lever.element={element}"], 1)
            row.append(f"{c['k_n']:.4f} ({100 * (c['k_n'] / reference - 1):+.1f}%)")
        print(f"| {division[0]} : {division[1]} : {division[2]} | {elements} | {thesis:.3f} "
              f"({100 * (thesis / reference - 1):+.0f}%) | " + " | ".join(row) + " |")


def table_43():
    c, seconds, elements = calibrate("calibration-v.toml")
    print("| V, 115 um, arms 20 um, 30 deg, 0.6 um thick, load 4 um from the point, h = 4 um "
          "| k_n, N/m | k_l, N/m | k_l/k_n |")
    print("|---|---|---|---|")
    of = {}
    for form in c["closed_forms"]:
        of.setdefault(form["name"].split(",")[0].replace(" corrected", ""), {})[form["quantity"]] = \
            form["value"]
    of["finite elements"] = {"k_n": c["k_n"], "k_l": c["k_l"]}
    for name, value in of.items():
        k_l = f"{value['k_l']:.1f}" if "k_l" in value else ""
        ratio = f"{value['k_l'] / value['k_n']:.1f}" if "k_l" in value else ""
        print(f"| {name} | {value['k_n']:.4f} | {k_l} | {ratio} |")
    print(f"\n{elements} elements, {seconds:.2f} s, {100 * c['share_bending']:.1f}% lateral bending")


def thickness():
    print("| t, um | L/t | elements | k_n over 3EI/L^3 | clamp force less load, over the load | wall s |")
    print("|---|---|---|---|---|---|")
    for t in (0.1, 0.22, 0.44, 1, 2.2, 5, 10):
        c, seconds, elements = calibrate("tipless-beam.toml", [f"lever.thickness={t} um"])
        theory = 200e9 * W * t ** 3 / (4 * L ** 3) * 1e-6
        print(f"| {t} | {L / t:.0f} | {elements} | {c['k_n'] / theory:.4f} | {c['imbalance']:.0e} "
              f"| {seconds:.2f} |")


# Coarse to fine: edge length in general, at the sides, at the rim of the foot; the last one is the reference.
MESHES = {"half": (9, 1, 0.06), "default": (6, 0.5, 0.03), "twice": (3, 0.25, 0.015),
          "reference": (2, 0.2, 0.01)}
FRONTS = ("tipless-beam.toml", "calibration-beam.toml", "calibration-v.toml")


def keys_of(mesh, tip):
    aspect, side, foot = MESHES[mesh]
    return [f"lever.aspect={aspect}", f"lever.side_aspect={side}"] + ([f"lever.foot_edge={foot}"] if tip else [])


def fronts(picture):
    curves = []
    for scene in FRONTS:
        tip = "tipless" not in scene
        reference = calibrate(scene, keys_of("reference", tip), 1)[0]
        keys = ["k_n", "k_l"] if tip else ["k_n"]
        print(f"\n{scene}: reference {' '.join(keys_of('reference', tip))}, " +
              ", ".join(f"{key} {reference[key]:.5g} N/m" for key in keys) + "\n")
        print("| element | mesh | elements | wall s | " + " | ".join(keys) + " | told |")
        print("|" + "---|" * (5 + len(keys)))
        for element in ("plate", "solid", "standard"):
            points = []
            for mesh in ("half", "default", "twice"):
                c, seconds, elements = calibrate(scene, keys_of(mesh, tip) + [f"lever.element={element}"])
                errors = [c[key] / reference[key] - 1 for key in keys]
                points.append((seconds, max(map(abs, errors))))
                told = ", ".join(f"{100 * c['mesh_error'][key]:.2f}%" for key in keys)
                print(f"| {element} | {mesh} | {elements} | {seconds:.2f} | " +
                      " | ".join(f"{100 * e:+.2f}%" for e in errors) + f" | {told} |")
            curves.append((f"{scene[:-5]}, {element}", points))
    if picture:
        draw(curves, picture)


SOLIDS = {  # graded meshes of solid elements only, from another program: k_l, N/m
    "beam, 2 um, 1 um from its end": ("calibration-beam.toml", [], 76.46),
    "beam, 4 um at its end, tip 13.7 um high": (
        "calibration-beam.toml", ["tip.height=13.7 um", "tip.foot=4 um", "tip.set_back=2 um"], 73.9),
    "the same, of the lever's material": (
        "calibration-beam.toml",
        ["tip.height=13.7 um", "tip.foot=4 um", "tip.set_back=2 um", "tip.material=lever"], 72.6),
    "V, 1 um": ("calibration-v.toml", [], 91.8),
    "beam, 1.1 um (half a thickness)": ("calibration-beam.toml", ["tip.foot=1.1 um"], None),
    "beam, 12.5 um (a quarter of the width)": (
        "calibration-beam.toml", ["tip.foot=12.5 um", "tip.set_back=10 um"], None),
}


def feet():
    print("| foot | elements | wall s | k_l, N/m | told | solids | reference mesh |")
    print("|---|---|---|---|---|---|---|")
    for name, (scene, keys, solids) in SOLIDS.items():
        c, seconds, elements = calibrate(scene, keys)
        fine = calibrate(scene, keys + keys_of("reference", True), 1)[0]["k_l"]
        beside = f"{solids} ({100 * (c['k_l'] / solids - 1):+.2f}%)" if solids else ""
        print(f"| {name} | {elements} | {seconds:.2f} | {c['k_l']:.2f} | {100 * c['mesh_error']['k_l']:.1f}% | "
              f"{beside} | {fine:.2f} ({100 * (c['k_l'] / fine - 1):+.2f}%) |")


def draw(curves, picture):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axis = plt.subplots(figsize=(8, 5), layout="constrained")
    styles = {"plate": "o-", "solid": "s--", "standard": "^:"}
    for label, points in curves:
        axis.loglog([p[0] for p in points], [100 * p[1] for p in points],
                    styles[label.split(", ")[1]], label=label)
    axis.set(xlabel="wall time, s", ylabel="largest error of k_n and k_l, %")
    axis.axhline(1, color="#888888", lw=0.8)
    axis.legend()
    axis.grid(which="both", alpha=0.3)
    figure.savefig(picture, dpi=110)


def main():
    words = sys.argv[1:]
    picture = words.pop(words.index("--draw") + 1) if "--draw" in words else None
    wanted = [w for w in words if w != "--draw"] or ["table-4.2", "table-4.3", "thickness", "fronts", "feet"]
    for name, make in (("table-4.2", table_42), ("table-4.3", table_43), ("thickness", thickness),
                       ("fronts", lambda: fronts(picture)), ("feet", feet)):
        if name in wanted:
            print(f"\n## {name}\n")
            make()


if __name__ == "__main__":
    main()
