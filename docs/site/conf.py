"""Sphinx: every page of docs/, the notebooks and the Python reference as one site. `./pulvis docs` builds it in build/docs.

By hand: python3 -m sphinx -W --keep-going -b html -c docs/site docs build/docs
"""
import re
import sys
from importlib.util import find_spec
from pathlib import Path

from pygments.lexers import XmlLexer

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(Path(__file__).parent))

project = "Pulvis"
author = "The Pulvis developers"
copyright = "the Pulvis developers. Licence: GPL-3.0-or-later"
version = release = re.search(r"project\(pulvis VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "outside_files", "notebooks", "pages"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext", ".ipynb": "markdown"}
exclude_patterns = ["site", "**.ipynb_checkpoints"]
shown_whole = {"contributing": "CONTRIBUTING.md"}  # pages that are a file outside docs/
highlight_language = "none"
toc_object_entries = False

# Anchors as GitHub makes them, at every level. Formulas between dollars become MathML, which needs neither script nor network.
myst_heading_anchors = 6
myst_enable_extensions = ["dollarmath"]
myst_url_schemes = ["http", "https", "mailto", "outside"]
html_math_renderer = "mathml"

html_theme = "furo"
html_title = f"Pulvis {version}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_theme_options = {"light_css_variables": {"color-brand-primary": "#1c5d99", "color-brand-content": "#1c5d99"},
                      "dark_css_variables": {"color-brand-primary": "#7db7ea", "color-brand-content": "#7db7ea"}}
html_use_index = html_domain_indices = html_show_sphinx = False
html_copy_source = False

# The package of PYTHONPATH, else that of the build. Where the compiled module is missing, its names are made up, and the
# page that is written from it, that of the scene language, says so.
sys.path += [str(ROOT / "build/release/python"), str(ROOT / "cli/python")]
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
napoleon_google_docstring = False
napoleon_attr_annotations = False  # of the scene language all are Any
try:
    from pulvis import _core  # noqa: F401
    compiled = find_spec("pulvis.declarations") is not None
except ImportError:
    compiled = False
if not compiled:
    autodoc_mock_imports = ["pulvis._core"]


def without_what_is_missing(app, page, source):
    """The gallery is made by a script, the classes of the scene language by the build."""
    if page == "index" and not (ROOT / "docs/gallery.md").exists():
        source[0] = re.sub(r"^gallery\n", "", source[0], flags=re.M)
    if page == "python-api/declarations" and not compiled:
        source[0] = source[0].split(".. automodule::")[0] + (
            "This site was built without the compiled module, which these classes are made from. ``./pulvis docs`` builds it "
            "first. The keys themselves are in :doc:`/scene`.\n")


def escape_generated_text(app, what, name, obj, options, lines):
    """Texts of the scene language are Markdown: `code` there is no title, and |x|, * and --set are no markup."""
    if name.startswith("pulvis.declarations."):
        parts = re.split(r"`([^`]+)`", "\n".join(lines))
        parts[::2] = [re.sub(r"(?<!\w)(--\w+)", r"``\1``", re.sub(r"([|*])", r"\\\1", text)) for text in parts[::2]]
        lines[:] = "``".join(parts).split("\n")


def keep_colons(app, what, name, obj, options, lines):
    """Napoleon takes what stands before the colon in a property's docstring for its type."""
    if what == "property" and lines:
        lines[0] = re.sub(r"(?<=\w): ", " – ", lines[0])


def setup(app):
    app.add_lexer("svg", XmlLexer)
    app.connect("source-read", without_what_is_missing)
    app.connect("autodoc-process-docstring", escape_generated_text, priority=1)
    app.connect("autodoc-process-docstring", keep_colons, priority=1)
