"""What pages need beyond Markdown: one title each, the anchors of GitHub in their addresses, formulas as MathML."""
from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.transforms import SphinxTransform
from sphinx.util import logging


class OneTitle(SphinxTransform):
    """Further headings of the first level become sections of the page, which has one entry in the table of contents."""
    default_priority = 400

    def apply(self):
        first, *others = [node for node in self.document.children if isinstance(node, nodes.section)] or [None]
        for section in others:
            self.document.remove(section)
            first += section


class Anchors(SphinxTransform):
    """page.html#8-tools-that-move leads where page.md#8-tools-that-move does: docutils' own names drop the number."""
    default_priority = 410

    def apply(self):
        for section in self.document.findall(nodes.section):
            slug = section.get("slug") or section.get("myst-anchor", "").rpartition("#")[2]
            if slug and slug not in section["ids"]:
                section["ids"].append(slug)


def mathml(self, node, attributes=""):
    try:
        html = tex2mathml(node.astext()).replace("<math", "<math" + attributes, 1)
    except (SyntaxError, ValueError) as error:
        logging.getLogger(__name__).warning("formula: %s", error, location=node)
        html = f"<code>{self.encode(node.astext())}</code>"
    self.body.append(html)
    raise nodes.SkipNode


def displayed_mathml(self, node):
    mathml(self, node, ' display="block"')


def setup(app):
    app.add_transform(OneTitle)
    app.add_transform(Anchors)
    app.add_html_math_renderer("mathml", (mathml, None), (displayed_mathml, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
