"""Converts Python values to TOML for the scene reader."""

import json
import math
import numbers
import re

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml_text(tables):
    """A TOML document from nested dictionaries and lists of dictionaries."""
    lines: list[str] = []
    _write(lines, tables, ())
    return "\n".join(lines) + "\n"


def toml_value(value):
    """A value on one line: numbers, strings, lists, dictionaries, numpy numbers and arrays, pint quantities."""
    if hasattr(value, "magnitude") and hasattr(value, "units"):
        return _quantity(value)
    if hasattr(value, "tolist"):  # numpy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        number = float(value)
        if not math.isfinite(number):
            return {math.inf: "inf", -math.inf: "-inf"}.get(number, "nan")
        return repr(number)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(one) for one in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(k)} = {toml_value(v)}" for k, v in value.items()) + "}"
    return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007f")


def _quantity(value):
    """A pint quantity as a string; an array becomes a list."""
    magnitude = value.magnitude
    if hasattr(magnitude, "tolist"):
        magnitude = magnitude.tolist()
    unit = format(value.units, "~C").replace("**", "^").replace("µ", "u").replace("μ", "u")
    if isinstance(magnitude, list):
        return "[" + ", ".join(json.dumps(f"{one!r} {unit}", ensure_ascii=False) for one in magnitude) + "]"
    return json.dumps(f"{magnitude!r} {unit}".strip(), ensure_ascii=False) if unit else repr(magnitude)


def _key(name):
    name = str(name)
    return name if _BARE.fullmatch(name) else json.dumps(name, ensure_ascii=False)


def _is_tables(value):
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(one, dict) for one in value)


def _write(lines, table, path):
    nested = []
    for key, value in table.items():
        if isinstance(value, dict) or _is_tables(value):
            nested.append((key, value))
        else:
            lines.append(f"{_key(key)} = {toml_value(value)}")
    for key, value in nested:
        below = (*path, _key(key))
        for one in [value] if isinstance(value, dict) else value:
            name = ".".join(below)
            lines.append(f"\n[{name}]" if isinstance(value, dict) else f"\n[[{name}]]")
            _write(lines, one, below)
