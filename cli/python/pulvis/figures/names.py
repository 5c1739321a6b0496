"""Labels for axes: words and a symbol in matplotlib mathtext, "relative density $\\rho$".

Results have theirs in run.h5, other keys in name_table.py.
"""
import re
from collections import namedtuple

from pulvis.figures.name_table import NAMES

Name = namedtuple("Name", "words symbol")


def split(text):
    """The words and the symbol of a label."""
    return Name(*re.fullmatch(r"(.*?)(?: \$([^$]*)\$)?", text, re.DOTALL).groups(""))


def worded(key):
    return key.replace("_", " ").replace("/", ", ")


def component_of(name, number, components):
    part = NAMES["components"].get(str(components), [str(i + 1) for i in range(components)])[number - 1]
    return Name(name.words, part if name.symbol in ("x", "") else f"{name.symbol}_{{{part}}}")


def name_of(key, labels, components=1):
    """The name of a series, a field (NAME:k for component k of `components`) or a study value. labels: of the run or study."""
    if text := labels.get(key) or NAMES["keys"].get(key):
        return split(text)
    base, _, component = key.partition(":")
    if component.isdigit() and 1 <= int(component) <= components:
        return component_of(name_of(base, labels), int(component), components)
    if key.startswith("peak/"):
        name = name_of(key[len("peak/"):], labels)
        return Name(f"{name.words} at peak density", name.symbol)
    return Name(worded(key), "")


def plain(symbol):
    """A symbol, or words with symbols, without mathtext."""
    for tex, letter in NAMES["letters"].items():
        symbol = symbol.replace(tex, letter)
    return symbol.replace("{", "").replace("}", "").replace("$", "").replace("_", "")


def capital(text):
    return text[:1].upper() + text[1:]


def shown_unit(unit):
    """Typographic form: "J/m^3" becomes J/m³."""
    unit = re.sub(r"\^(-?\d)", lambda power: power[1].translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")), unit)
    return unit.replace(" ", "\u2009")


def joined(words, symbol):
    return words + (f" ${symbol}$" if symbol else "")


def label(name, unit):
    """ "Effective stress σ_eff / MPa", for an axis or a colour bar. name: (words, symbol)."""
    return over(capital(joined(*name)), unit)


def over(text, unit):
    """Quantity over unit, so that the axis shows plain numbers."""
    if unit in ("", "-", None):
        return text
    unit = shown_unit(unit)
    return f"{text} / ({unit})" if "/" in unit or "\u2009" in unit else f"{text} / {unit}"
