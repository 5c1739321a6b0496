"""Notebooks as pages: their texts, their code, and the outputs that are stored in them. Nothing is executed."""
import json
from pathlib import Path


def block(language, text):
    fence = "`" * (4 if "```" in text else 3)
    return f"{fence}{language}\n{text.rstrip()}\n{fence}\n"


def output_text(output):
    """The richest form of an output that a page can show."""
    data = output.get("data", {})
    if "image/png" in data:
        png = "".join("".join(data["image/png"]).split())
        return f"![Picture made by the code above](data:image/png;base64,{png})\n"
    if "text/html" in data:
        return block("{raw} html", '<div class="table-wrapper">' + "".join(data["text/html"]) + "</div>")
    return block("text", "".join(output.get("text", data.get("text/plain", ""))))


def page_of(notebook, name):
    parts = []
    for cell in notebook["cells"]:
        text = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(text)
        elif text:
            parts += [block("python", text), *map(output_text, cell["outputs"])]
    title, _, rest = parts[0].partition("\n")
    source = f"The notebook itself is {{download}}`docs/notebooks/{name} <{name}>`; [the page of all notebooks](README.md) says how to start it."
    return "\n\n".join([title, source, rest, *parts[1:]]) + "\n"


def read_notebook(app, page, source):
    file = Path(app.env.doc2path(page))
    if file.suffix == ".ipynb":
        source[0] = page_of(json.loads(source[0]), file.name)


def setup(app):
    app.connect("source-read", read_notebook, priority=400)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
