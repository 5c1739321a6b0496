"""Scenes from files, dictionaries or dataclasses, all read by the same parser as on the command line."""

from __future__ import annotations

import dataclasses
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pulvis import _core
from pulvis.arguments import checked_class, utf8
from pulvis.errors import RunError, SceneError
from pulvis.toml_text import toml_text, toml_value

if TYPE_CHECKING:
    from pulvis.afm import Lever
    from pulvis.simulation import Simulation

# File name of a scene without a file; its paths are relative to the working directory.
NO_FILE = "<python>"


@checked_class
class Scene:
    """A scene of the scene language (docs/scene.md), read and checked.

    Parameters
    ----------
    source : str, Path, dict or dataclass
        A scene file, a dictionary with the same tables and keys, or a `pulvis.declarations.Document`. Quantities are
        strings with a unit, ``"10 um"``, or pint quantities.
    overrides : dict, optional
        ``{"contact.friction": 0.2, "material.316L.yield_stress": "100 MPa"}``: paths as in ``--set``.
    **keys
        The same, with double underscores in place of dots: ``contact__friction=0.2``.

    Raises
    ------
    SceneError
        With the file, line and key of the error.
    """

    def __init__(self, source: Any, overrides: dict[str, Any] | None = None, **keys: Any) -> None:
        if overrides is not None and not isinstance(overrides, dict):
            raise TypeError(f"overrides: a {type(overrides).__name__}, allowed: a dict of paths and values")
        given = dict(overrides or {})
        given.update({key.replace("__", "."): value for key, value in keys.items()})
        words = [utf8("overrides", f"{path}={toml_value(value)}") for path, value in given.items()]
        try:
            self._core = loaded(source, words)
        except SceneError as error:
            if hint := dots_meant(keys, error):
                raise SceneError(f"{error}\n{hint}", error.file, line=error.line, column=error.column, key=error.key,
                                 problems=error.problems) from None
            raise
        self._source, self._given = source, given

    @property
    def text(self) -> str:
        """The complete scene as TOML, with base scenes, overrides and defaults resolved."""
        return self._core.text_in_place

    @property
    def hash(self) -> str:
        """16 hexadecimal digits, equal for all equivalent scenes."""
        return self._core.hash

    @property
    def title(self) -> str:
        """Title of the scene."""
        return self._core.title

    @property
    def is_afm(self) -> bool:
        """Whether this is an AFM lever; otherwise it is a powder."""
        return self._core.is_afm

    @property
    def file(self) -> Path | None:
        """Path of the scene file, or None."""
        return None if self._core.file == NO_FILE else Path(self._core.file)

    def warnings(self) -> list[str]:
        """Possible problems of the scene, although each value is valid, as `pulvis check` tells them: list of str.

        Builds the scene, which takes as long as before a run.
        """
        return self._core.warnings()

    def with_(self, overrides: dict[str, Any] | None = None, **keys: Any) -> Scene:
        """The same scene with other values; arguments as for `Scene`."""
        given = {**self._given, **(overrides or {})}
        given.update({key.replace("__", "."): value for key, value in keys.items()})
        return Scene(self._source, given)

    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Writes ``scene.toml`` and copies of the files it refers to into `folder`; returns the path."""
        self._core.save(os.fspath(folder))
        return Path(folder) / "scene.toml"

    def simulation(self, threads: int = 0, folder: str | os.PathLike[str] | None = None, overwrite: bool = False,
                   checkpoint_every: float = 60.0, checkpoint_steps: int = 0) -> Simulation:
        """Creates a simulation of the scene, at its start.

        A scene of the family "afm" gives its `Lever`; `lever` does the same and has its type.

        Parameters
        ----------
        threads : int
            Worker threads; 0: all processors. Results are bitwise identical for any number.
        folder : str or Path, optional
            Where the run's files go (docs/overview.md, "What a run leaves"). Without it, nothing is written.
        overwrite : bool
            Replace a run that is already in the folder.
        checkpoint_every : float
            Wall-clock seconds between checkpoints.
        checkpoint_steps : int
            Also write one every this many steps (of a lever: increments); 0: off.

        Returns
        -------
        Simulation
        """
        if self.is_afm:
            return self.lever(threads, folder, overwrite, checkpoint_every, checkpoint_steps)  # type: ignore[return-value]
        from pulvis.simulation import Simulation

        where = "" if folder is None else os.fspath(folder)
        run = _core.Run(self._core, where, threads, overwrite, checkpoint_every, checkpoint_steps)
        return Simulation(run, self, folder)

    def lever(self, threads: int = 0, folder: str | os.PathLike[str] | None = None, overwrite: bool = False,
              checkpoint_every: float = 60.0, checkpoint_steps: int = 0) -> Lever:
        """Creates the AFM lever of a scene of the family "afm", at its start; arguments as for `simulation`.

        Raises
        ------
        RunError
            If this is not an AFM scene.
        """
        if not self.is_afm:
            raise RunError(f"{self.title}: a powder has no lever; allowed: a scene with family = \"afm\"")
        from pulvis.afm import Lever

        return Lever(self, threads, folder, overwrite, checkpoint_every, checkpoint_steps)

    def calibration(self, threads: int = 0) -> dict[str, float]:
        """Stiffnesses and detector constants of a lever, in SI units: dict (docs/afm.md).

        Raises
        ------
        RunError
            If this is not an AFM scene.
        """
        if not self.is_afm:
            raise RunError(f"{self.title}: a powder has no lever to calibrate; allowed: a scene with family = \"afm\"")
        return self.lever(threads=threads).calibration

    def __repr__(self) -> str:
        return f"<pulvis.Scene {self.title!r} {self.hash}>"


def loaded(source: Any, words: list[str]) -> Any:
    """The scene of the compiled module."""
    if isinstance(source, (str, os.PathLike)):
        return _core.load_scene(utf8("scene", str(os.fspath(source))), words)
    if not isinstance(source, dict) and not dataclasses.is_dataclass(source):
        raise TypeError(f"scene: a {type(source).__name__}, allowed: a path, a dict or a dataclass")
    return _core.load_scene_text(utf8("scene", toml_text(as_tables(source))), NO_FILE, words)


def dots_meant(keys: dict[str, Any], error: SceneError) -> str:
    """What to write where a keyword has one underscore in place of a dot, and the error is of that keyword; or ""."""
    for key in keys:
        if "_" in key and "__" not in key and any(key in str(problem.get("message", "")) or problem.get("key") == key
                                                  for problem in [*error.problems, {"message": str(error)}]):
            return f"{key}=: two underscores stand for a dot: {key.replace('_', '__', 1)}= is {key.replace('_', '.', 1)}"
    return ""


def as_tables(source: Any) -> Any:
    """Converts nested dataclasses to plain dictionaries and lists; None values are omitted."""
    if dataclasses.is_dataclass(source) and not isinstance(source, type):
        pairs = ((field.metadata.get("key", field.name), getattr(source, field.name))
                 for field in dataclasses.fields(source))
        return {key: as_tables(value) for key, value in pairs if value is not None}
    if isinstance(source, dict):
        return {key: as_tables(value) for key, value in source.items() if value is not None}
    if isinstance(source, (list, tuple)):
        return [as_tables(value) for value in source]
    return source
