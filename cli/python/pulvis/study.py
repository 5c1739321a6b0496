"""Studies read from their folders: varied parameters, results and runs. Everything is in SI units.

    study = pulvis.open_study("runs/mine-study")
    study.runs[["contact.friction", "peak/top_force"]]
    study.run("friction=0.1,seed=2").plot.forces()
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pulvis.arguments import checked
from pulvis.errors import RunError
from pulvis.frames import table
from pulvis.results import Run

if TYPE_CHECKING:
    import os

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from pandas import DataFrame

SI = ("m", "s", "N", "Pa", "J", "m/s", "N/m", "V", "rad")


@checked
def open_study(folder: str | os.PathLike[str]) -> Study:
    """The study in this folder."""
    return Study(folder)


def quantity_of(text: object) -> tuple[float, str] | None:
    """(number in SI, unit) of "0.5 ms"; None if it is not a quantity."""
    from pulvis.figures.quantities import NUMBER, factor_of

    match = re.fullmatch(rf"({NUMBER})\s*(\S*)", str(text).strip())
    if not match:
        return None
    if not match[2]:
        return float(match[1]), "-"
    for si in SI:
        if factor := factor_of(match[2], si):
            return float(match[1]) * factor, si
    return None


def column_of(texts: list[Any]) -> tuple[np.ndarray, str]:
    """Values of a varied key: SI numbers and their unit if all are quantities of one unit, otherwise unchanged."""
    found = [one for one in map(quantity_of, texts) if one]
    if found and len(found) == len(texts) and len({unit for _, unit in found}) == 1:
        return np.array([value for value, _ in found]), found[0][1]
    return np.array(texts, object), ""


def numbers(values: list[Any]) -> np.ndarray:
    """A numeric array if all values are numbers or None; None becomes NaN."""
    if all(value is None or isinstance(value, (int, float)) for value in values):
        return np.array([np.nan if value is None else value for value in values])
    return np.array(values, object)


class Study:
    """A study folder, with `title`, `summary` (the contents of summary.json) and `names` of its runs."""

    @checked
    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise RunError(f"{self.folder}: no such folder", self.folder)
        if (self.folder / "run.h5").exists():
            raise RunError(f"{self.folder}: a run, not a study: use pulvis.open", self.folder)
        self.summary = self._read("summary.json")
        if "runs" not in self.summary or "effects" not in self.summary:
            raise RunError(f"{self.folder}: not a study: its summary.json has no runs", self.folder)
        self.title = self.summary["title"]
        self.names = [run["name"] for run in self.summary["runs"]]

    def __repr__(self):
        return f"<Study {self.title!r} in {self.folder}: {len(self.names)} runs>"

    def _read(self, name):
        path = self.folder / name
        if not path.is_file():
            there = "" if not (self.folder / "study.toml").exists() else " yet: pulvis study writes it when its runs are finished"
            raise RunError(f"{self.folder}: not a study: there is no {name}{there}", self.folder)
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise RunError(f"{path}: {error}", path) from error

    @property
    def keys(self) -> list[str]:
        """The varied keys."""
        return list(dict.fromkeys(key for run in self.summary["runs"] for key in run["varied"]))

    @property
    def runs(self) -> DataFrame:
        """DataFrame of all runs: varied keys and results; `attrs["units"]` holds their units."""
        runs = self.summary["runs"]
        columns = {name: (numbers([run.get(name) for run in runs]), "") for name in ("variation", "scene", "seed")}
        for key in self.keys:
            columns[key] = column_of([run["varied"].get(key, "") for run in runs])
        named = [{value["name"]: value for value in run["values"]} for run in runs]
        for name in dict.fromkeys(name for values in named for name in values):
            unit = next(values[name]["unit"] for values in named if name in values)
            columns[name] = numbers([values.get(name, {}).get("value") for values in named]), unit
        return table(columns, self.names, "run")

    def _of_variations(self, part):
        variations = self.summary["variations"]
        columns = {key: column_of([one["settings"][k] for one in variations]) for k, key in enumerate(self.keys)}
        columns["runs"] = np.array([one["runs"] for one in variations]), ""
        named = [{value["name"]: value for value in one["values"]} for one in variations]
        for name in dict.fromkeys(name for values in named for name in values):
            unit = next(values[name]["unit"] for values in named if name in values)
            columns[name] = numbers([values.get(name, {}).get(part) for values in named]), unit
        return table(columns, [one["variation"] for one in variations], "variation")

    @property
    def values(self) -> DataFrame:
        """DataFrame of all variations: varied keys, number of runs, and results averaged over the seeds."""
        return self._of_variations("mean")

    @property
    def deviations(self) -> DataFrame:
        """The same, with standard deviations over the seeds."""
        return self._of_variations("standard_deviation")

    @property
    def curves(self) -> list[dict[str, Any]]:
        """Charts of the report as dicts: title, x, y, units, and lines with numpy arrays x, y, low, high."""
        curves = self._read("curves.json")
        for curve in curves:
            curve["lines"] = [{key: np.array(value, float) if isinstance(value, list) else value
                               for key, value in line.items()} for line in curve["lines"]]
        return curves

    @property
    def fits(self) -> list[dict[str, Any]]:
        """Fitted laws, as in summary.json."""
        return self.summary.get("fits", [])

    def run(self, which: int | str) -> Run:
        """A run by its index or name."""
        if isinstance(which, str) and which not in self.names:
            raise RunError(f"{self.folder}: no run {which}; there are: {', '.join(self.names)}", self.folder)
        if not isinstance(which, str) and not -len(self.names) <= which < len(self.names):
            raise RunError(f"{self.folder}: run {which}: there are 0 to {len(self.names) - 1}", self.folder)
        return Run(self.folder / (which if isinstance(which, str) else self.names[which]))

    def chart(self, number: int = 0, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """(Figure, Axes) of a chart of the report, as `pulvis figure` draws it; `look` as in run.plot."""
        from matplotlib import pyplot as plt

        from pulvis.figures.study import draw
        from pulvis.plot import options_of

        options, curves = options_of(look), self._read("curves.json")
        if not 0 <= number < len(curves):
            raise RunError(f"{self.folder}: chart {number}: there are 0 to {len(curves) - 1}", self.folder)
        with plt.rc_context(options.context(ax)):
            figure = draw(curves[number], self.summary, options, ax)
        if figure is None:
            raise RunError(f"{self.folder}: no run has the data of chart {number} shows", self.folder)
        return figure, ax if ax is not None else figure.axes[0]
