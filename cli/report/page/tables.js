// Tables of values with their uncertainties.
"use strict";

function addRow(table, cells, isHead) {
  const row = (isHead ? table.createTHead() : table.tBodies[0] || table.createTBody()).insertRow();
  cells.forEach((text, i) => {
    const scope = isHead ? "col" : i ? "" : "row";
    row.append(element(scope ? "th" : "td", {textContent: text ?? "–", ...scope && {scope}}));
  });
}

// Tables that are wider than their place scroll by keys, too: such places have the focus in turn, and the name of their card.
function nameScrollers() {
  for (const place of document.querySelectorAll(".scroll")) {
    const isWide = place.scrollWidth > place.clientWidth, title = place.closest("section")?.querySelector("h2")?.textContent;
    const set = (name, value) => isWide ? place.setAttribute(name, value) : place.removeAttribute(name);
    set("tabindex", "0");
    set("role", "region");
    set("aria-label", `${title || "Table"}, scrolls`);
  }
}
new MutationObserver(nameScrollers).observe(document.body, {attributes: true, attributeFilter: ["data-ready"]});
onResize(document.body, nameScrollers);

// Numbers in a text, and values with a unit: "0.1", "9048.9, 10201 N".
const NUMBERS = (() => {
  const one = "-?\\d+(?:\\.\\d+)?(?:e[+-]\\d+)?";
  return new RegExp(`(?<![\\w.])((?:${one}, )*${one})(?: ([^\\s,;]+))?`, "g");
})();

// The values of a text in the units of the page, unbroken at the ends of lines.
function readable(text) {
  const parts = [];
  let from = 0;
  for (const {0: found, 1: numbers, 2: unit, index} of text.matchAll(NUMBERS)) {
    const values = numbers.split(", ").map(Number), isKnown = SCALED.has(unit), shown = unitFor(unit || "-", largest(values));
    const kept = isKnown || unit === "%" ? found : numbers;
    const told = isKnown ? `${values.map(value => digits(value * shown.factor, 6)).join(", ")} ${shown.label}` : kept;
    parts.push(text.slice(from, index), element("span", {className: "unbroken", textContent: told}));
    from = index + kept.length;
  }
  return [...parts, text.slice(from)];
}

// {value, error} in a readable unit, the same for both.
function measured(known, unit = "-") {
  if (!known) return "–";
  const {factor, label} = unitFor(unit, Math.abs(known.value));
  return withSpread(known.value * factor, known.error, factor) + (label ? " " + label : "");
}

// columns: [{title, unit, cells}]; a cell is a number, {mean, deviation}, a text, an element or null. A column of numbers
// with a unit uses one unit throughout.
function fillColumns(table, columns, isBad = () => false) {
  const shown = columns.map(shownColumn), head = element("tr", {}), body = element("tbody", {});
  table.replaceChildren(element("thead", {}, head), body);
  shown.forEach(({title, isNumber}) => head.append(element("th", {textContent: title, scope: "col",
                                                                  className: isNumber ? "number" : ""})));
  for (let i = 0; i < columns[0].cells.length; ++i) {
    const row = body.insertRow();
    if (isBad(i)) row.className = "bad";
    shown.forEach(({cells, isNumber}, k) => {
      const cell = k ? element("td", {className: isNumber ? "number" : ""}) : element("th", {scope: "row"});
      cell.append(cells[i]);
      row.append(cell);
    });
  }
}

// rows: [[cell, ...]], each cell a text; into the table of this id.
const fillTexts = (id, titles, rows) =>
  fillColumns(document.getElementById(id), titles.map((title, k) => ({title, cells: rows.map(row => row[k])})));

const isSample = cell => cell !== null && typeof cell === "object" && "mean" in cell;
const numberOf = cell => isSample(cell) ? cell.mean : cell;

function shownColumn({title, unit, cells}) {
  const numbers = cells.map(numberOf).filter(Number.isFinite);
  if (!numbers.length) return {title, cells: cells.map(cell => cell === null || cell === "" ? "–" : cell)};
  const {factor, label} = unitFor(unit || "-", largest(numbers));
  const text = cell => isSample(cell) ? withSpread(cell.mean * factor, cell.deviation, factor)
    : !Number.isFinite(cell) ? "–" : unit ? digits(cell * factor) : cell.toLocaleString("en");
  return {title: labelled(title, label), cells: cells.map(text), isNumber: true};
}

// The mean, rounded to the second digit of its deviation, at most six digits.
function withSpread(mean, deviation, factor = 1) {
  if (deviation === undefined || deviation === null) return digits(mean);
  const spread = deviation * factor;
  if (!(spread > 0)) return `${digits(mean)} ± 0`;
  const wanted = 2 + Math.floor(Math.log10(Math.abs(mean) || spread)) - Math.floor(Math.log10(spread));
  const count = Math.min(6, Math.max(2, wanted));
  return `${digits(mean, count)} ± ${digits(spread, 2)}`;
}
