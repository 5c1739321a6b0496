"""Friction of irregular particles on surfaces of different roughness: prints the values in docs/thesis.md and draws its figure.

  ./pulvis study scenes/studies/irregular-roughness.toml -o runs/irregular-roughness
  /usr/bin/python3 bench/roughness.py runs/irregular-roughness [PICTURE.png]

For every variation the median, minimum and maximum over its seeds. Friction is averaged over the sliding distance
from 4 mm on; the others are final values. Needs python3-numpy and python3-matplotlib.
"""
import csv
import re
import statistics
import sys
from pathlib import Path

STEADY = 4e-3  # m, distance from which friction is averaged


def history_of(run):
    """Rows of the shear stage by series name."""
    with open(run / "history.csv", encoding="utf-8") as file:
        rows = csv.reader(file)
        names = [name.split(" [")[0] for name in next(rows)]
        samples = [dict(zip(names, map(float, row))) for row in rows]
    return [sample for sample in samples if sample["shear/distance"] > 1e-5]


def mean_friction(samples):
    steps = [(b["shear/distance"] - a["shear/distance"], b["shear/friction"])
             for a, b in zip(samples, samples[1:]) if a["shear/distance"] >= STEADY]
    return sum(step * friction for step, friction in steps) / sum(step for step, _ in steps)


def punch_work(samples):
    return -sum(0.5 * (a["tool/top/force_y"] + b["tool/top/force_y"]) * (b["shear/dilation"] - a["shear/dilation"])
                for a, b in zip(samples, samples[1:]))


def figures_of(run):
    samples = history_of(run)
    end = samples[-1]
    return {
        "friction": mean_friction(samples),
        "dilation [mm]": 1e3 * end["shear/dilation"],
        "ploughing": end["shear/ploughing"],
        "plastic work [J]": end["shear/plastic_work"],
        "work of the punch [J]": punch_work(samples),
        "work of the target [J]": end["shear/work"],
        "plastic work beyond the punch's / work of the target":
            (end["shear/plastic_work"] - punch_work(samples)) / end["shear/work"],
        "relative density": end["relative_density"],
        "penetration": end["penetration"],
        "kinetic / internal": max(s["energy/kinetic"] / (s["energy/elastic"] + s["energy/plastic"])
                                  for s in samples),
        "balance error": max(abs(s["energy/balance"]) for s in samples) / abs(end["energy/external"]),
    }


def read(folder):
    """{Ra/D: results of its runs}."""
    found = {}
    for run in sorted(folder.glob("ra-*D,seed=*")):
        if (run / "summary.json").exists():
            roughness = float(re.match(r"ra-([0-9.]+)D", run.name)[1])
            found.setdefault(roughness, []).append(figures_of(run))
    return dict(sorted(found.items()))


def print_table(found):
    names = list(next(iter(found.values()))[0])
    print("| Ra/D | runs | " + " | ".join(names) + " |")
    print("|---" * (len(names) + 2) + "|")
    for roughness, runs in found.items():
        cells = []
        for name in names:
            values = [run[name] for run in runs]
            cells.append(f"{statistics.median(values):.3g} ({min(values):.3g} to {max(values):.3g})")
        print(f"| {roughness:g} | {len(runs)} | " + " | ".join(cells) + " |")


def draw(found, path):
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
    from figures import STYLE, plt
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True)

    def band(axis, name, label):
        values = [[run[name] for run in runs] for runs in found.values()]
        line, = axis.semilogx(list(found), [statistics.median(v) for v in values], "o-", label=label)
        axis.fill_between(list(found), [min(v) for v in values], [max(v) for v in values],
                          color=line.get_color(), alpha=0.2, linewidth=0)
        axis.set_xlabel("Ra / D")

    band(axes[0], "friction", "friction coefficient")
    band(axes[0], "ploughing", "plastic work / (normal force x distance)")
    axes[0].axhline(0.1, color="grey", linestyle=":", label="friction of the contacts")
    axes[0].legend(fontsize=8)
    axes[0].set_title("Friction and ploughing", loc="left")
    band(axes[1], "dilation [mm]", "")
    axes[1].set_title("Dilation at the end [mm]", loc="left")
    figure.savefig(path, dpi=110)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    found = read(Path(sys.argv[1]))
    if not found:
        sys.exit(f"roughness: {sys.argv[1]}: no finished runs")
    print_table(found)
    if len(sys.argv) == 3:
        draw(found, sys.argv[2])


if __name__ == "__main__":
    main()
