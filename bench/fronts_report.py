"""Plots and tables of bench/fronts.py: error against CPU time, and the settings on the Pareto front."""
import json

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

MARKERS = "osD^vP*Xdh<>"


def usable(rows):
    """[(row, errors, cpu)] without the reference run, whether separate or in a family."""
    runs = [(row, json.loads(row["errors"]), float(row["cpu_s"])) for row in rows
            if not row["note"] and row["family"] != "reference"]
    return [run for run in runs if any(run[1].values())]


def front(points):
    """The Pareto-optimal points of [(cpu, error, row)]."""
    best, chosen = float("inf"), []
    for point in sorted(points, key=lambda p: p[:2]):
        if point[1] < best:
            best = point[1]
            chosen.append(point)
    return chosen


def picture(problem, rows, reference, folder):
    runs = usable(rows)
    measures = list(runs[0][1])
    figure, panels = plt.subplots(1, len(measures), figsize=(1 + 6 * len(measures), 5.4),
                                  squeeze=False, layout="constrained")
    for axis, measure in zip(panels[0], measures):
        draw(axis, runs, measure, reference.uncertainty.get(measure))
    panels[0][-1].legend(fontsize=8)
    figure.suptitle(f"{problem.title}\nreference: {reference.text}", fontsize=9)
    figure.savefig(folder / f"{problem.name}.png", dpi=110)
    plt.close(figure)


def draw(axis, runs, measure, uncertainty):
    families = list(dict.fromkeys(row["family"] for row, _, _ in runs))
    shipped = next((cpu, errors[measure]) for row, errors, cpu in runs
                   if row["family"] == "as shipped")
    for i, family in enumerate(f for f in families if f != "as shipped"):
        of = [(cpu, 100 * errors[measure], row["setting"]) for row, errors, cpu in runs
              if row["family"] == family]
        axis.plot([p[0] for p in of], [p[1] for p in of], MARKERS[i % len(MARKERS)] + ("" if "," in family else "-"),
                  color=f"C{i}", lw=0.6, ms=5, label=family)
        for cpu, error, label in of:
            axis.annotate(label, (cpu, error), fontsize=6, color=f"C{i}", xytext=(3, 3),
                          textcoords="offset points")
    best = front([(cpu, 100 * errors[measure], row["setting"]) for row, errors, cpu in runs])
    axis.step([p[0] for p in best], [p[1] for p in best], "k--", where="post", lw=1.2,
              label="front", zorder=1)
    axis.plot(shipped[0], 100 * shipped[1], "k*", ms=16, mfc="none", label="as shipped")
    if uncertainty:
        axis.axhspan(0, 100 * uncertainty, color="0.9", zorder=0, label="reference uncertain")
    axis.set(xscale="log", yscale="log", xlabel="CPU time, s", ylabel=f"error: {measure}, %")
    axis.grid(True, which="both", lw=0.3)


def table(rows, measures):
    lines = ["| family | setting | " + " | ".join(f"{m} %" for m in measures) +
             " | CPU s | steps | dt ns | quads |", "|" + "---|" * (len(measures) + 6)]
    for row, errors, cpu in rows:
        values = " | ".join(f"{100 * errors[m]:.2f}" for m in measures)
        lines.append(f"| {row['family']} | {row['setting']} | {values} | {cpu:.3g} | {row['steps']} | "
                     f"{1e9 * float(row['dt_s']):.1f} | {row['elements']} |")
    return lines


def section(problem, rows, reference, provenance, folder):
    """Writes <problem>.md: the front for each measure, every run, and the runs left out."""
    runs = usable(rows)
    measures = list(runs[0][1])
    lines = [f"## {problem.name}: {problem.title}", "", f"![front]({problem.name}.png)", "",
             f"`scenes/{problem.scene}`; reference: {reference.text}"]
    uncertain = ", ".join(f"{m} {100 * u:.2f}%" for m, u in reference.uncertainty.items() if u)
    lines += [f"(uncertain by: {uncertain})." if uncertain else "(exact).", ""]
    for measure in measures:
        best = front([(cpu, errors[measure], i) for i, (_, errors, cpu) in enumerate(runs)])
        names = [f"{runs[i][0]['family']} {runs[i][0]['setting']} ({100 * error:.2g}%, {cpu:.2g} s)"
                 for cpu, error, i in best]
        lines += [f"Front of {measure}: " + "; ".join(names) + ".", ""]
    lines += table(runs, measures) + [""]
    lines += [f"- left out: {row['family']} {row['setting']}: {row['note']}"
              for row in rows if row["note"]]
    lines += ["", "; ".join(f"{k} {v}" for k, v in provenance.items()), ""]
    (folder / f"{problem.name}.md").write_text("\n".join(lines))


def summary(names, folder):
    sections = [(folder / f"{name}.md").read_text() for name in names
                if (folder / f"{name}.md").exists()]
    head = ["# Error against run time", "",
            "Made by `/usr/bin/python3 bench/fronts.py`; times are CPU times of one thread, for "
            "comparison with each other.", ""]
    (folder / "summary.md").write_text("\n".join(head) + "\n" + "\n".join(sections))
