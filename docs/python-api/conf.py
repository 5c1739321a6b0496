"""Sphinx: the reference of the Python package. `cmake --build --preset release --target python_docs` builds it."""
import re

project = "Pulvis"
html_title = "Pulvis from Python"
extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon"]
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
napoleon_google_docstring = False
nitpicky = False
html_theme = "alabaster"
html_theme_options = {"description": "Powders whose particles deform", "page_width": "1080px", "fixed_sidebar": True}
html_sidebars = {"**": ["about.html", "localtoc.html", "searchbox.html"]}
toc_object_entries = False
html_show_sphinx = False
html_copy_source = False


def escape_generated_text(app, what, name, obj, options, lines):
    """Texts of the scene language are plain ones: |x| and * are no markup there."""
    if name.startswith("pulvis.declarations."):
        lines[:] = [line.replace("|", r"\|").replace("*", r"\*") for line in lines]


def keep_colons(app, what, name, obj, options, lines):
    """Napoleon takes what stands before the colon in a property's docstring for its type."""
    if what == "property" and lines:
        lines[0] = re.sub(r"(?<=\w): ", " – ", lines[0])


def setup(app):
    app.connect("autodoc-process-docstring", escape_generated_text, priority=1)
    app.connect("autodoc-process-docstring", keep_colons, priority=1)
