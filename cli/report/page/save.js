// Saves figures and their data as files, generated in the page.
"use strict";

function saveBlob(name, blob) {
  const link = element("a", {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const saveText = (name, text, type) => saveBlob(name, new Blob([text], {type}));
const saveCanvas = (name, canvas) => canvas.toBlob(blob => saveBlob(name, blob), "image/png");
// Named after the page, then the figure.
const fileName = title => `${document.title} ${title}`.toLowerCase().replace(/[^a-z0-9.]+/g, "-").replace(/^-|-$/g, "");

// Converts an SVG to an image with four pixels per unit, enough for print.
function saveAsPng(name, svg, width, height) {
  const image = new Image(), canvas = element("canvas", {width: 4 * width, height: 4 * height});
  image.onload = () => {
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    saveCanvas(name, canvas);
  };
  image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(svg);
}

// columns: [{label, unit, values}] in SI; lengths may differ. A label that a spreadsheet would read as a
// formula is prefixed with an apostrophe, as in study.csv.
function csvOf(columns) {
  const tame = text => /^[=+@\t\r-]/.test(text) ? "'" + text : text;
  const quoted = text => /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  const cell = text => quoted(tame(text));
  const rows = Math.max(0, ...columns.map(column => column.values.length));
  const lines = [columns.map(column => cell(`${column.label} [${column.unit || "-"}]`)).join(",")];
  for (let i = 0; i < rows; ++i) {
    lines.push(columns.map(({values}) => Number.isFinite(values[i]) ? values[i] : "").join(","));
  }
  return lines.join("\n") + "\n";
}

// One button per file type: {PNG: action, ...}.
function saveButtons(title, kinds) {
  const group = element("span", {className: "save", role: "group", "aria-label": `Save: ${title}`});
  for (const [kind, action] of Object.entries(kinds)) {
    group.append(element("button", {type: "button", textContent: kind, onclick: action,
                                    title: `Save as ${kind}`}));
  }
  return group;
}
