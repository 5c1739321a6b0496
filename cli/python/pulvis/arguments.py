"""Arguments of the public functions, checked against their annotations before anything else happens.

A wrong type is refused with a TypeError that names the function, the argument, its value and what is allowed. The compiled
module therefore receives only what it accepts, and its own messages, which speak of C++, reach nobody.
"""

from __future__ import annotations

import functools
import operator
import os
from typing import Any, Callable, TypeVar

T = TypeVar("T", bound=Callable[..., Any])
C = TypeVar("C", bound=type)

# A number in SI units, a string with its unit, or a pint quantity.
Quantity = Any

_LARGEST = 2**63 - 1  # of the compiled module's whole numbers


class _No(Exception):
    """Not of this type."""


def shown(value: object) -> str:
    """A value in a message: never longer than a line."""
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _whole(value):
    if isinstance(value, bool):
        raise _No
    try:
        number = operator.index(value)
    except TypeError:
        raise _No from None
    if abs(number) > _LARGEST:
        raise ValueError(f"allowed: -{_LARGEST} to {_LARGEST}")
    return number


def _number(value):
    if isinstance(value, (bool, str, bytes, bytearray)):
        raise _No
    try:
        return float(value)
    except TypeError:
        raise _No from None
    except (OverflowError, ValueError) as error:
        raise ValueError(f"{error}, allowed: a number") from None


def _flag(value):
    if not isinstance(value, bool) and type(value).__name__ not in ("bool_", "bool"):  # of numpy
        raise _No
    return bool(value)


def _text(value):
    if not isinstance(value, str):
        raise _No
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise ValueError(f"{error}, allowed: text that UTF-8 can express") from None
    return value


def utf8(where: str, text: str) -> str:
    """A text for the compiled module."""
    try:
        return _text(text)
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from None


def _path(value):
    if not isinstance(value, (str, os.PathLike)) or not isinstance(os.fspath(value), str):
        raise _No
    if "\0" in _text(os.fspath(value)):
        raise ValueError("allowed: a path without null characters")
    return value


def _quantity(value):
    if isinstance(value, str):
        return _text(value)
    return value if hasattr(value, "magnitude") and hasattr(value, "to") else _number(value)


def _callable(value):
    if not callable(value):
        raise _No
    return value


def _none(value):
    if value is not None:
        raise _No
    return None


_KINDS: dict[str, tuple[Callable[[Any], Any], str]] = {
    "None": (_none, "None"),
    "bool": (_flag, "True or False"),
    "int": (_whole, "a whole number"),
    "float": (_number, "a number"),
    "str": (_text, "a string"),
    "os.PathLike": (_path, "a path"),
    "Quantity": (_quantity, "a number in SI units, a string with its unit, or a pint quantity"),
    "Callable": (_callable, "a function"),
}


def _of_class(name: str) -> tuple[Callable[[Any], Any], str]:
    """By name, since the annotations of classes may be known to type checkers only."""

    def check(value):
        if not any(base.__name__ == name for base in type(value).__mro__):
            raise _No
        return value

    return check, f"a {name}"


def _words_of(annotation: str) -> list[str]:
    """The alternatives of a union without the types in their brackets: "Callable[[A | B], C] | None" has two."""
    words, depth = [""], 0
    for letter in annotation:
        if letter == "|" and depth == 0:
            words.append("")
            continue
        depth += (letter == "[") - (letter == "]")
        if depth == 0 and letter not in "] ":
            words[-1] += letter
    if "os.PathLike" in words:
        words.remove("str")  # a path may be given as either
    return words


def _check_of(where: str, annotation: str) -> Callable[[Any], Any] | None:
    words = _words_of(annotation)
    if "Any" in words or "object" in words:
        return None
    kinds = [_KINDS.get(word) or _of_class(word.rpartition(".")[2]) for word in words]
    allowed = " or ".join(text for _, text in kinds)

    def check(value):
        for convert, _ in kinds:
            try:
                return convert(value)
            except _No:
                continue
            except ValueError as error:
                raise ValueError(f"{where} = {shown(value)}: {error}") from None
        raise TypeError(f"{where} = {shown(value)} of type {type(value).__name__}, allowed: {allowed}")

    return check


def checked(function: T) -> T:
    """The function, which checks and converts its arguments as they are annotated."""
    code = function.__code__
    names = code.co_varnames[: code.co_argcount]
    of = function.__qualname__.replace(".__init__", "").replace(".__getitem__", "[]")
    checks = {name: check for name, annotation in function.__annotations__.items()
              if name != "return" and (check := _check_of(f"{of}: {name}", annotation))}
    if not checks:
        return function

    @functools.wraps(function)
    def call(*args, **keys):
        given = [checks[name](value) if name in checks else value for name, value in zip(names, args)]
        named = {name: checks[name](value) if name in checks else value for name, value in keys.items()}
        return function(*given, *args[len(names):], **named)

    return call  # type: ignore[return-value]


def checked_class(made: C) -> C:
    """The class, all of whose public methods, its constructor and its [] check their arguments."""
    for name, member in list(vars(made).items()):
        if name.startswith("_") and name not in ("__init__", "__getitem__"):
            continue
        inner = member.__func__ if isinstance(member, (classmethod, staticmethod)) else member
        if not hasattr(inner, "__code__") or inner.__code__.co_filename == "<string>":  # written by dataclass
            continue
        setattr(made, name, type(member)(checked(inner)) if inner is not member else checked(inner))
    return made


def in_si(where: str, value: Any, unit: str) -> float:
    """A `Quantity` as a number in this SI unit."""
    value = _check_of(where, "Quantity")(value)  # type: ignore[misc]
    if isinstance(value, str):
        from pulvis import _core

        return _core.quantity(value, unit)
    if not hasattr(value, "magnitude"):
        return value
    try:
        return float(value.to(unit).magnitude)
    except Exception as error:  # pint's own
        raise ValueError(f"{where} = {shown(value)}: {error}, allowed: a quantity in {unit}") from None
