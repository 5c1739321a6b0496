"""What goes wrong, by its kind: all are PulvisError."""


class PulvisError(Exception):
    """Something that Pulvis refuses or cannot do. `file`, `line` and `key` say where, if that is known."""

    def __init__(self, message, file=None, line=None, key=None):
        super().__init__(message)
        self.message, self.file, self.line, self.key = message, file, line, key


class SceneError(PulvisError):
    """A scene that is refused: before the first step."""


class RunError(PulvisError):
    """A run that went wrong, or results that are not there."""
