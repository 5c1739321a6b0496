// Tables of figures with their uncertainties.
"use strict";

function addRow(table, cells, isHead) {
  const row = table.insertRow();
  for (const text of cells) {
    row.append(element(isHead ? "th" : "td", {textContent: text ?? "–"}));
  }
}

const withError = (value, error, count = 3) =>
  error === undefined ? digits(value, count) : `${digits(value, count)} ± ${digits(error, 2)}`;

// {value, error} in a unit for people, both in the same.
function measured(known, unit = "-") {
  if (!known) return "–";
  const {factor, label} = unitFor(unit, Math.abs(known.value));
  const error = known.error === undefined ? undefined : known.error * factor;
  return withError(known.value * factor, error, 4) + (label ? " " + label : "");
}
