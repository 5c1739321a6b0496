// The page of lab records that are reduced to tables and curves: its head lists the contents, as charts
// (see chart.js) and tables. A cell is text, a number, or {value, error, unit}.
// Status on <body>: data-ready, data-charts, or data-error.
"use strict";

function cellText(cell) {
  if (cell === null || cell === undefined) return "–";
  if (typeof cell === "object") return measured(cell, cell.unit || "-");
  return typeof cell === "number" ? digits(cell) : cell;
}

function placeTable({title, head, rows, note}) {
  const table = element("table", {className: "figures"}), scroll = element("div", {className: "scroll"}, table);
  if (head.length) addRow(table, head, true);
  for (const row of rows) addRow(table, row.map(cellText));
  const box = element("section", {}, element("h2", {textContent: title}), scroll);
  if (note) box.append(element("p", {className: "note", textContent: note}));
  document.getElementById("settings").before(box);
}

const inColours = line => ({...line, colour: line.isSimulated ? "ink" : line.colour,
                            dash: line.isSimulated ? [8, 4] : line.dash});

function main() {
  const page = JSON.parse(document.getElementById("head").textContent);
  document.getElementById("lead").textContent = page.lead;
  document.getElementById("version").textContent = `Version ${page.version} (${page.commit}).`;
  document.getElementById("values-file").textContent = page.values;
  document.getElementById("settings-text").textContent = page.settings;
  for (const {title, x, y, lines, note} of page.charts) {
    const place = card(title);
    drawChart(place, {x: {...x, values: []}, y, lines: lines.map(inColours)});
    const cut = uncertainMarks(lines).map(({line, i}) =>
      `${line.label}: ${withSpread(line.values[i], (line.high[i] - line.low[i]) / 2)} at ${digits(line.x[i])}`);
    const all = [note, cut.length && `Too uncertain for the scale, bar cut off: ${cut.join("; ")}.`].filter(Boolean).join(" ");
    if (all) place.parentElement.append(element("p", {className: "note", textContent: all}));
  }
  page.tables.forEach(placeTable);
  document.body.dataset.charts = page.charts.length;
  document.body.dataset.ready = "1";
}

main();
