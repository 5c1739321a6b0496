"""Names shown in figures instead of keys, from the table of names (name_table.py).

Each key has words and a symbol, the symbol in matplotlib mathtext; `plain` converts it to plain text.
"""
import re
from collections import namedtuple

from pulvis.figures.name_table import NAMES

Name = namedtuple("Name", "words symbol")

PATTERNS = [(re.compile(pattern.replace("(?<", "(?P<")), words, symbol) for pattern, words, symbol in NAMES["patterns"]]


def worded(key):
    return key.replace("_", " ").replace("/", ", ")


def name_of(key, components=1):
    """The name of a series, a field (NAME:k for component k of `components`) or a study value."""
    if key in NAMES["keys"]:
        return Name(*NAMES["keys"][key])
    base, _, component = key.partition(":")
    if component.isdigit() and base in NAMES["keys"] and 1 <= int(component) <= components:
        words, symbol = NAMES["keys"][base]
        part = NAMES["components"].get(str(components), [str(i + 1) for i in range(components)])[int(component) - 1]
        return Name(words, part if symbol == "x" else f"{symbol}_{{{part}}}")
    if key.startswith("peak/"):
        words, symbol = name_of(key[len("peak/"):])
        return Name(f"{words} at peak density", symbol)
    if key.startswith("energy/"):
        kind = key[len("energy/"):]
        return Name(NAMES["energies"].get(kind, worded(kind)) + ("" if kind in ("external", "balance") else " energy"), "E")
    for pattern, words, symbol in PATTERNS:
        if match := pattern.fullmatch(key):
            for part, value in match.groupdict().items():  # an axis, a tool
                words, symbol = words.replace(f"{{{part}}}", value), symbol.replace(f"{{{part}}}", value)
            return Name(words, symbol)
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


def label(key, unit, components=1, words=None):
    """ "Effective stress σ_eff / MPa", for an axis or a colour bar; `words` replace those of the table."""
    name = name_of(key, components)
    text = capital(words or name.words)
    if name.symbol:
        text += f" ${name.symbol}$"
    return over(text, unit)


def over(text, unit):
    """Quantity over unit, so that the axis shows plain numbers."""
    if unit in ("", "-", None):
        return text
    unit = shown_unit(unit)
    return f"{text} / ({unit})" if "/" in unit or "\u2009" in unit else f"{text} / {unit}"
