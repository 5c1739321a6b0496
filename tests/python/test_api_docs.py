"""The reference of the package is built without a warning, and has all public names."""
import re
import subprocess
import sys

from conftest import SOURCE

import pulvis


def test_the_reference_is_built_without_a_warning(tmp_path):
    words = ["-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", "-d", tmp_path / "trees", SOURCE / "docs/python-api",
             tmp_path / "html"]
    done = subprocess.run([sys.executable, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "html/index.html").read_text()
    for name in pulvis.__all__:
        assert f'id="pulvis.{name}"' in page, name
    for name in ("pulvis.Simulation.run_until", "pulvis.plot.Plot.field", "pulvis.declarations.Stage"):
        assert f'id="{name}"' in page, name
    assert len(re.findall(r'<dt class="sig', page)) > 150
