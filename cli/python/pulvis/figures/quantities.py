"""Quantities as given on the command line or in Python: "85 mm", "0:400 MPa"."""
import re
from numbers import Real

import numpy as np

from pulvis.errors import PulvisError

PREFIXES = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")]
SCALED = {"m", "N", "Pa", "J", "s", "m/s", "N/m", "V", "J/m^3"}
INCHES = {"mm": 1 / 25.4, "cm": 1 / 2.54, "m": 1 / 0.0254, "in": 1.0, "inch": 1.0, "pt": 1 / 72}
SHORTEST, LONGEST = 10 / 25.4, 2 / 0.0254  # inches, limits of the figure size
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"


def unit_for(unit, values):
    """The factor from SI to a convenient unit, and the name of that unit."""
    values = np.asarray(values, float)
    finite = np.abs(values[np.isfinite(values)]) if np.size(values) else np.array([])
    most = finite.max() if finite.size else 0
    if unit in ("-", ""):
        return 1.0, ""
    if unit == "m^2" and most > 0:  # m², mm², µm² ...: from 0.01 of each
        factor, shown = unit_for("m", 10 * np.sqrt(most))
        return factor**2, shown + "^2"
    if unit not in SCALED or not most > 0:
        return 1.0, unit
    for size, prefix in PREFIXES:
        if most >= 0.9995 * size and not (unit[0] == "m" and size > 1):
            return 1 / size, prefix + unit
    return 1e9, "n" + unit


def with_unit(value, unit):
    """ "1.2 ms"."""
    factor, shown = unit_for(unit, np.array([value]))
    return f"{factor * value:.4g} {shown}".rstrip()


def inches(option, given):
    """A figure dimension: "85mm", "3.35 in", "8.5 cm", "240 pt", or a number of inches."""
    if given is None:
        return None
    match = re.fullmatch(rf"\s*({NUMBER})\s*([A-Za-z]*)\s*", str(given))
    unit = match[2] if match else ""
    if isinstance(given, (int, float)):
        unit = "in"
    if not match or unit not in INCHES:
        raise PulvisError(f"{option} {given}: allowed: a length from 10 mm to 2 m, in mm, cm, m, in or pt, e.g. 85mm", key=option)
    length = float(match[1]) * INCHES[unit]
    if not SHORTEST <= length <= LONGEST:
        raise PulvisError(f"{option} {given}: allowed: 10 mm to 2 m", key=option)
    return length


def length(option, given):
    """A coordinate in the powder, m: "2mm", "-35 µm", or from Python a number of metres."""
    if given is None:
        return None
    if isinstance(given, Real):
        return float(given)
    match = re.fullmatch(rf"\s*({NUMBER})\s*(\S*)\s*", str(given))
    factor = factor_of(match[2], "m") if match and match[2] else None
    if factor is None:
        raise PulvisError(f"{option} {given}: allowed: a length with its unit, e.g. 2mm", key=option)
    return factor * float(match[1])


def factor_of(unit, si):
    """The factor from a unit to the SI unit `si`, by its prefix; None if it is not a multiple of it."""
    if unit in ("", si) or si in ("-", "") and unit in ("", "-"):
        return 1.0
    if unit == "%" and si in ("-", ""):
        return 0.01
    unit = unit.replace("μ", "µ")
    unit = "µ" + unit[1:] if unit.startswith("u") else unit
    power = 2 if si == "m^2" else 1
    sizes = [size**power for size, prefix in [*PREFIXES, (1e-12, "p")] if unit == prefix + si]
    return sizes[0] if sizes else None


def limits_of(given, si):
    """(low, high) in SI from "LOW:HIGH", where each end is a number with a unit or empty, or from such a pair; numbers
    from Python may be in SI without a unit."""
    if given is None:
        return None, None
    plain = isinstance(given, (tuple, list)) and any(isinstance(end, Real) for end in given)
    ends = [str(end) if end is not None else "" for end in given] if isinstance(given, (tuple, list)) else str(given).split(":")
    allowed = f"allowed: LOW:HIGH in {si}, e.g. 0:400 M{si}" if si == "Pa" else f"allowed: LOW:HIGH in {si or '-'}, e.g. {f'0:1 {si}'.rstrip(' -')}"
    shown = ":".join(ends)
    matches = [re.fullmatch(rf"\s*(?:({NUMBER})\s*([^\d\s]\S*)?)?\s*", end) for end in ends]
    if len(ends) != 2 or not all(matches):
        raise PulvisError(f"--range {shown}: {allowed}; either end may be omitted", key="--range")
    shared = matches[1][2] or ""  # 0:400 MPa: the unit applies to both
    values = []
    for match in matches:
        unit = match[2] or shared
        if match[1] and not unit and si not in ("-", "") and not plain:
            raise PulvisError(f"--range {shown}: {match[1]} has no unit; {allowed}", key="--range")
        factor = factor_of(unit, si)
        if factor is None:
            raise PulvisError(f"--range {shown}: {unit} is not a unit of the plotted quantity; {allowed}", key="--range")
        values.append(None if match[1] is None else factor * float(match[1]))
    if None not in values and not values[0] < values[1]:
        raise PulvisError(f"--range {shown}: allowed: LOW below HIGH", key="--range")
    return tuple(values)
