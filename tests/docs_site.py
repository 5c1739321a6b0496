"""The documentation is built as one site without a warning: every page is in it, every link leads somewhere, and nothing is
fetched from the network. Also without the compiled Python module.

usage: docs_site.py SOURCE_DIR, with the Python package in PYTHONPATH, if it is built
"""
import os
import re
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from importlib.util import find_spec
from pathlib import Path
from urllib.parse import unquote

SOURCE = Path(sys.argv[1]).resolve()
DOCS = SOURCE / "docs"
NAMES = ("pulvis.Simulation.run_until", "pulvis.plot.Plot.field")  # besides the public ones


class Page(HTMLParser):
    """Names and addresses of a page; `fetched` are those that a browser opens on its own."""

    def __init__(self, file):
        super().__init__()
        self.ids, self.links, self.fetched, self.entries = set(), [], [], 0
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids.add(given.get("id"))
        self.entries += tag == "dt" and "sig" in (given.get("class") or "").split()
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        elif tag == "link" and given.get("rel") in ("stylesheet", "icon", "preload") and "href" in given:
            self.fetched.append(given["href"])
        elif "src" in given:
            self.fetched.append(given["src"])


def sphinx(site, *options, package=None):
    environment = dict(os.environ, PYTHONDONTWRITEBYTECODE="1")
    if package:
        environment["PYTHONPATH"] = str(package)
    return subprocess.run([sys.executable, "-m", "sphinx", "-q", "-b", "html", "-d", f"{site}-trees", "-c", DOCS / "site", *options,
                           DOCS, site], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def built_file(site, source):
    return site / source.relative_to(DOCS).with_suffix(".html")


def missing_pages(site):
    sources = [file for kind in ("md", "rst", "ipynb") for file in sorted(DOCS.rglob(f"*.{kind}"))
               if "site" not in file.relative_to(DOCS).parts and ".ipynb_checkpoints" not in file.parts]
    if len(sources) < 45:
        yield f"only {len(sources)} pages in {DOCS}: are they looked for?"
    searched = (site / "searchindex.js").read_text(encoding="utf-8")
    for source in sources:
        name = source.relative_to(DOCS)
        if not built_file(site, source).is_file():
            yield f"{name}: not in the site"
        elif f'"{name.with_suffix("").as_posix()}"' not in searched:
            yield f"{name}: not in the search"


def broken_links(site, pages):
    for file, page in pages.items():
        for link in page.links + page.fetched:
            if re.match(r"(https?:)?//", link) and link in page.fetched:
                yield f"{file.relative_to(site)}: fetches {link}"
            if re.match(r"[a-z]+:|//", link) or link == "#":
                continue
            name, _, anchor = unquote(link).partition("#")
            target = Path(os.path.normpath(file.parent / name.partition("?")[0])) if name else file
            if not target.is_file():
                yield f"{file.relative_to(site)}: {link}: no such file"
            elif anchor and target in pages and anchor not in pages[target].ids:
                yield f"{file.relative_to(site)}: {link}: no such place"


def broken_ways(pages, site):
    """The first page leads to every way to start, and to the three pages of each, in this order."""
    linked = [name for link in pages[site / "index.html"].links if (name := link.partition("#")[0])]
    ways = sorted(DOCS.glob("path-*.md"))
    if len(ways) != 5:
        yield f"{len(ways)} ways to start, expected five"
    for way in ways:
        steps = re.findall(r"^\d\. \*\*\[.+?\]\(([\w./-]+)", way.read_text(encoding="utf-8"), re.M)
        wanted = [str(built_file(Path(), DOCS / name)) for name in [way.name, *steps]]
        if len(steps) != 3:
            yield f"{way.name}: {len(steps)} pages, expected three"
        if not any(linked[i:i + len(wanted)] == wanted for i in range(len(linked))):
            yield f"index.md does not link {', '.join(wanted)} in this order"


def missing_names(page, compiled, declarations=None):
    import pulvis
    names = [f"pulvis.{name}" for name in pulvis.__all__] + list(NAMES)
    yield from (f"{name} is not in the reference" for name in names if name not in page.ids)
    if compiled and "pulvis.declarations.Stage" not in declarations.ids:
        yield "the scene language is not in the reference"
    if page.entries < 150:
        yield f"only {page.entries} entries in the reference"


def other_versions():
    version = re.search(r"project\(pulvis VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())[1]
    if f"\nversion: {version}\n" not in (SOURCE / "CITATION.cff").read_text():
        yield f"CITATION.cff: the version is not {version}"


def whole_site(site):
    done = sphinx(site, "-W", "--keep-going")
    if done.returncode:
        sys.exit(f"the documentation was not built, or with warnings:\n{done.stdout}")
    pages = {file: Page(file) for file in sorted(site.rglob("*.html"))}
    compiled = find_spec("pulvis._core") is not None
    reference = (pages[site / "python-api/index.html"], compiled, pages[site / "python-api/declarations.html"])
    wrong = [*missing_pages(site), *broken_links(site, pages), *broken_ways(pages, site), *missing_names(*reference),
             *other_versions()]
    if wrong:
        sys.exit("\n".join(wrong))
    links = sum(len(page.links) for page in pages.values())
    print(f"ok: {len(pages)} pages with {links} links, {'with' if compiled else 'WITHOUT'} the compiled Python module")


def reference_without_module(site):
    """Only the reference is read, so that other pages are unknown to it; there is no other warning."""
    done = sphinx(site, "-D", "include_patterns=python-api/*", "-D", "root_doc=python-api/index", package=SOURCE / "cli/python")
    warnings = [line for line in done.stdout.splitlines() if "WARNING" in line and "unknown document" not in line]
    if done.returncode or warnings:
        sys.exit(f"the reference was not built without the compiled module:\n{done.stdout}")
    wrong = list(missing_names(Page(site / "python-api/index.html"), compiled=False))
    if "without the compiled module" not in (site / "python-api/declarations.html").read_text(encoding="utf-8"):
        wrong.append("the page of the scene language does not say that the module is missing")
    if wrong:
        sys.exit("\n".join(wrong))
    print("ok: the reference without the compiled module")


def main():
    sys.path.append(str(SOURCE / "cli/python"))  # where no package is built
    with tempfile.TemporaryDirectory() as folder:
        whole_site(Path(folder).resolve() / "site")
        reference_without_module(Path(folder).resolve() / "reference")


if __name__ == "__main__":
    main()
