"""Exceptions: what is wrong with a scene or a run is a PulvisError.

Arguments of a wrong type, names and numbers that there are not raise Python's own TypeError, KeyError and IndexError.
"""


class PulvisError(Exception):
    """Base of all errors of the package.

    Attributes
    ----------
    file : str or None
        The file that caused the error, if any.
    line, column : int or None
        Position in the file, counted from 1.
    key : str or None
        The key in the scene, such as ``material[0].yield_stress``.
    problems : list of dict
        All problems found, each with ``file``, ``line``, ``column``, ``key``, ``override`` and ``message``.
    """

    def __init__(self, message, file=None, *, line=None, column=None, key=None, problems=()):
        super().__init__(message)
        self.message = message
        self.file = file
        self.line = line
        self.column = column
        self.key = key
        self.problems = list(problems)


class SceneError(PulvisError):
    """A scene, or a value in it, is invalid; nothing was run."""


class RunError(PulvisError):
    """A run failed, or the request does not apply to it."""


class RangeError(RunError, ValueError):
    """A value given to a simulation is out of the range that the scene language allows."""


class Named(dict):
    """A dict whose KeyError tells the names that there are; `kind` is what they name."""

    def __init__(self, kind, *args):
        super().__init__(*args)
        self.kind = kind

    def __missing__(self, name):
        raise KeyError(f"no {self.kind} {name!r}, allowed: {', '.join(map(str, self)) or 'none'}")
