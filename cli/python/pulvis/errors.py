"""What goes wrong: every error of the package is a PulvisError."""


class PulvisError(Exception):
    """Base of all errors of the package.

    Attributes
    ----------
    file : str or None
        The file that is to blame, where there is one.
    line, column : int or None
        Where in the file, from 1.
    key : str or None
        The key of the scene language, as ``material[0].yield_stress``.
    problems : list of dict
        All that was found at once, each with ``file``, ``line``, ``column``, ``key``, ``override`` and ``message``.
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
    """A scene, or a value in it, was refused before anything ran."""


class RunError(PulvisError):
    """A run failed, or was asked for what it cannot give."""
