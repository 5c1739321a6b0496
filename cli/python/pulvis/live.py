"""A run under way in a notebook: the page of ``pulvis watch`` in a cell."""

import html
import pathlib
import re
import shutil
import subprocess
import weakref

from pulvis.errors import PulvisError


def _program():
    """The program beside this package in the folder of a build, or the installed one."""
    beside = pathlib.Path(__file__).parent.parent.parent / "cli" / "pulvis"
    found = str(beside) if beside.is_file() else shutil.which("pulvis")
    if found is None:
        raise PulvisError("the program pulvis is not found: it shows the run; allowed: a folder on PATH that has it")
    return found


def _end(process):
    process.kill()  # it writes nothing
    process.wait()
    process.stdin.close()
    process.stderr.close()


class LiveView:
    """The view of a run, shown where it is the last value of a cell. It ends with the kernel, or with :meth:`close`.

    Attributes
    ----------
    address : str
        For a browser on the machine of the kernel.
    height : int
        Height in the notebook in pixels.
    """

    def __init__(self, folder, height=900):
        # `--of-run`: it ends when this process does, and an interrupted cell does not interrupt it.
        self._process = subprocess.Popen([_program(), "watch", str(folder), "--of-run"], stdin=subprocess.PIPE,
                                         stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        errors = self._process.stderr
        told = errors.readline() if errors else ""
        found = re.search(r"http://\S+", told)
        if found is None:
            rest = self._process.communicate()[1]
            raise PulvisError((told + rest).strip() or "the live view has not started", str(folder))
        self.address = found[0]
        self.height = height
        self._end = weakref.finalize(self, _end, self._process)

    def close(self):
        """End the view, not the run."""
        self._end()

    def __repr__(self):
        return f"<live view at {self.address}>"

    def _repr_html_(self):
        return (f'<iframe src="{html.escape(self.address)}" style="width: 100%; height: {self.height}px; border: 0" '
                'title="Live view of a run"></iframe>')


def watch(folder, height=900):
    """Show a run under way in the notebook: picture, curves and time left, as they come.

    Parameters
    ----------
    folder : str or Path
        Folder of a run, under way or ended, started by any process.
    height : int
        Height in pixels.

    Returns
    -------
    LiveView
        Shown as the last value of a cell. Its ``address`` is for a browser on the machine of the kernel only.
    """
    return LiveView(folder, height)
