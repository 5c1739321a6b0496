"""The examples of docs/python.md, and those in docstrings."""
import doctest
import re

import pytest

from conftest import SOURCE


def test_examples_of_the_guide(tmp_path, monkeypatch):
    (tmp_path / "scenes").symlink_to(SOURCE / "scenes")
    monkeypatch.chdir(tmp_path)
    text = (SOURCE / "docs/python.md").read_text()
    code = "\n".join(re.findall(r"^```python\n(.*?)^```$", text, re.M | re.S))
    test = doctest.DocTestParser().get_doctest(code, {}, "docs/python.md", "docs/python.md", 0)
    assert len(test.examples) > 30
    lines = []
    results = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test, out=lines.append)
    if results.failed:
        pytest.fail("".join(lines))
