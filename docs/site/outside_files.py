"""Links from a page to files outside docs/ lead to pages that show those files: scenes, sources, tables of results.

The repository has no address in the web, and a site may be read where the repository is not.
"""
import os
import re
import shutil
from pathlib import Path

from docutils import nodes
from markdown_it import MarkdownIt
from sphinx.util.osutil import relative_uri

LINK = re.compile(r"(?P<picture>!?)\[(?P<text>(?:[^\[\]]|\[[^\[\]]*\])*)\]\((?P<target>[^()\s]+)\)")
LEFT_AS_IT_IS = re.compile(r"^ *```.*?^ *```|`[^`\n]*`", re.M | re.S)
SCHEME = "outside:"
LANGUAGES = {".toml": "toml", ".hpp": "cpp", ".cpp": "cpp", ".py": "python", ".js": "js", ".json": "json", ".sh": "bash"}


def outside_code(text, change):
    """The text with its links changed, but not those in blocks and spans of code."""
    parts = re.compile(f"{LINK.pattern}|(?P<code>{LEFT_AS_IT_IS.pattern})", re.M | re.S)
    return parts.sub(lambda match: match[0] if match["code"] else change(match), text)


class Rewriter:
    """Of the links of one page, whose text stands in a file of this folder."""

    def __init__(self, app, page, folder):
        self.app, self.folder = app, folder
        self.docs = Path(app.srcdir)
        self.page_folder = (self.docs / page).parent
        self.shown = {(self.docs.parent / file): name + ".md" for name, file in app.config.shown_whole.items()}

    def __call__(self, link):
        name, _, anchor = link["target"].partition("#")
        if re.match(r"[a-z]+:", name) or not name:
            return link[0]
        file = Path(os.path.normpath(self.folder / name))
        text = link["text"]
        if text.endswith(".md"):  # the site has pages, not files
            text = Path(text).stem
        if file in self.shown:
            file = self.docs / self.shown[file]
        elif self.docs not in file.parents and not link["picture"] and file.is_file():
            self.app.env.note_dependency(str(file))
            return f"[{text}]({SCHEME}{file.relative_to(self.docs.parent).as_posix()})"
        target = os.path.relpath(file, self.page_folder)
        return f"{link['picture']}[{text}]({target}{'#' + anchor if anchor else ''})"


def rewrite_links(app, page, source):
    file = Path(app.env.doc2path(page))
    if page in app.config.shown_whole:
        file = Path(app.srcdir).parent / app.config.shown_whole[page]
        app.env.note_dependency(str(file))
        source[0] = file.read_text(encoding="utf-8")
    if file.suffix != ".rst":
        source[0] = outside_code(source[0], Rewriter(app, page, file.parent))


def lead_to_pages(app, tree, page):
    for link in tree.findall(nodes.reference):
        if link.get("refuri", "").startswith(SCHEME):
            file = link["refuri"][len(SCHEME):]
            app.outside_files.add(file)
            link["refuri"] = relative_uri(app.builder.get_target_uri(page), f"files/{file}.html")
            link["internal"] = True


def markdown_page(app, file):
    """As HTML; pictures beside it are copied, links to docs/ lead to its pages, others are dropped."""
    docs, place = Path(app.srcdir), Path(app.outdir) / "files" / file
    source = docs.parent / file

    def change(link):
        name, _, anchor = link["target"].partition("#")
        target = Path(os.path.normpath(source.parent / name))
        if link["picture"] and target.is_file():
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(target, place.parent)
            return link[0]
        page = app.env.path2doc(str(target)) if docs in target.parents else None
        if page not in app.env.found_docs:
            return link["text"]
        uri = relative_uri(f"files/{file}.html", app.builder.get_target_uri(page))
        return f"[{Path(link['text']).stem}]({uri}{'#' + anchor if anchor else ''})"

    text = outside_code(source.read_text(encoding="utf-8"), change)
    html = MarkdownIt("commonmark").enable("table").render(text)
    return html.replace("<table>", '<div class="table-wrapper"><table class="docutils">').replace("</table>", "</table></div>")


def pages_of_files(app):
    for file in sorted(app.outside_files):
        if file.endswith(".md"):
            body = markdown_page(app, file)
        else:
            text = (Path(app.srcdir).parent / file).read_text(encoding="utf-8")
            body = f"<h1>{Path(file).name}</h1>" + app.builder.highlighter.highlight_block(
                text, LANGUAGES.get(Path(file).suffix, "none"))
        where = f'<p class="file-of-the-sources">The file <code class="docutils literal">{file}</code> of the source folder.</p>'
        yield f"files/{file}", {"title": Path(file).name, "body": body + where}, "page.html"


def setup(app):
    app.outside_files = set()
    app.add_config_value("shown_whole", {}, "env")
    app.connect("source-read", rewrite_links, priority=600)
    app.connect("doctree-resolved", lead_to_pages)
    app.connect("html-collect-pages", pages_of_files)
    return {"parallel_read_safe": True, "parallel_write_safe": False}
