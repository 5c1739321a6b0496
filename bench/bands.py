"""Scatter of one result over the seeds of a study: for every variation the median, minimum and maximum.

  ./pulvis study scenes/studies/wall-friction-seeds.toml -o runs/wall-friction-seeds
  /usr/bin/python3 bench/bands.py runs/wall-friction-seeds tool/bottom/force_y --from 0.84 --until 0.87

The result is the mean of a series in history.csv between two values of another series, or with --at its value there.
--ratio A B divides A by B for the same seed and may be repeated; --relative divides by the last value before --from,
so that a force is relative to its value at the start of shear. --largest-rise H: the largest rise of the series over steps
H of the other between --from and --until, relative to its value there: 1 over the number of steps if it grows uniformly.
"""
import argparse
import csv
import re
import statistics
import sys
from pathlib import Path


def history_of(run):
    """Samples by series name."""
    with open(run / "history.csv", encoding="utf-8") as file:
        rows = csv.reader(file)
        names = [name.split(" [")[0] for name in next(rows)]
        return [dict(zip(names, map(float, row))) for row in rows]


def crossing(samples, series, against, value):
    """The value of the series where `against` first crosses the value, by linear interpolation."""
    for a, b in zip(samples, samples[1:]):
        if a[against] < value <= b[against]:
            share = (value - a[against]) / (b[against] - a[against])
            return a[series] + share * (b[series] - a[series])
    return None


def largest_rise(samples, args):
    steps = round((args.until - args.begin) / args.largest_rise)
    values = [crossing(samples, args.series, args.against, args.begin + i * args.largest_rise) for i in range(steps + 1)]
    return None if None in values else max(b - a for a, b in zip(map(abs, values), map(abs, values[1:]))) / abs(values[-1])


def number_of(samples, args):
    """The requested result, or None if the run does not get that far."""
    if args.largest_rise:
        return largest_rise(samples, args)
    if args.per:
        samples = [{**s, args.series: s[args.series] / s[args.per]} for s in samples if s[args.per] != 0]
    unit = 1.0
    if args.relative:
        unit = [s for s in samples if s[args.against] <= args.begin][-1][args.series]
    if args.at is not None:
        value = crossing(samples, args.series, args.against, args.at)
        return None if value is None else value / unit
    first = next((i for i, s in enumerate(samples) if s[args.against] >= args.begin), len(samples))
    last = next((i for i, s in enumerate(samples) if i >= first and s[args.against] > args.until), len(samples))
    values = [s[args.series] for s in samples[first:last]]
    return statistics.fmean(values) / unit if values else None


def read(folder, args):
    """{variation: {seed: result}}."""
    found = {}
    for run in sorted(folder.iterdir()):
        if not (run / "summary.json").exists() or not (run / "history.csv").exists():
            continue
        match = re.fullmatch(r"(.*?)(?:,seed=(\d+))?", run.name)
        number = number_of(history_of(run), args)
        if number is not None:
            found.setdefault(match[1], {})[match[2]] = number
    return found


def band(name, values):
    listed = ", ".join(f"{v:.4g}" for v in values)
    print(f"| {name} | {len(values)} | {statistics.median(values):.4g} ({min(values):.4g} to {max(values):.4g}) | {listed} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="results of a study")
    parser.add_argument("series", help="a series of history.csv")
    parser.add_argument("--per", help="a series that it is divided by, sample by sample")
    parser.add_argument("--against", default="relative_density")
    parser.add_argument("--from", dest="begin", type=float, default=float("-inf"), help="in SI units")
    parser.add_argument("--until", type=float, default=float("inf"))
    parser.add_argument("--at", type=float)
    parser.add_argument("--largest-rise", type=float, metavar="H")
    parser.add_argument("--relative", action="store_true")
    parser.add_argument("--ratio", nargs=2, action="append", default=[], metavar=("A", "B"))
    args = parser.parse_args()
    found = read(args.folder, args)
    if not found:
        sys.exit(f"bands: {args.folder}: no finished runs that come so far")
    print("| variation | runs | median (smallest to largest) | seeds |\n|---|---|---|---|")
    for name, values in found.items():
        band(name, list(values.values()))
    for a, b in args.ratio:
        if not {a, b} <= found.keys():
            sys.exit(f"bands: --ratio {a} {b}: allowed: {', '.join(found)}")
        band(f"{a} / {b}", [found[a][seed] / found[b][seed] for seed in found[a] if seed in found[b]])


if __name__ == "__main__":
    main()
