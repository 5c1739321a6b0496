// The page of a wedge calibration: friction loops in volts against load, with the fitted lines, and
// the resulting friction and detector constants.
// Status on <body>: data-ready, data-charts, or data-error.
"use strict";

const inDegrees = slope => `${slope > 0 ? "+" : ""}${digits(slope * 180 / Math.PI, 4)}°`;
const mean = values => values.reduce((sum, v) => sum + v, 0) / values.length;

// The loops of a facet as markers, with their least-squares line. A single load gives no line.
function facetLine(facet, loops, key) {
  const own = loops.filter(loop => loop.slope === facet.slope);
  const x = own.map(loop => loop.load), values = own.map(loop => loop[key]);
  const error = own.map(loop => loop[`${key}_error`] ?? 0);
  const middle = mean(x), about = mean(values);
  const slope = mean(x.map((load, i) => (load - middle) * (values[i] - about))) / mean(x.map(load => (load - middle) ** 2));
  const at = load => about + slope * (load - middle), ends = [0, Math.max(...x)];
  return {label: inDegrees(facet.slope), unit: "V", x, values, isMarks: true,
          low: values.map((v, i) => v - error[i]), high: values.map((v, i) => v + error[i]),
          fit: facet.loads > 1 ? {x: ends, values: ends.map(at)} : undefined};
}

function placeCharts({facets}, loops) {
  const load = {label: "load", unit: "N", values: []};
  const draw = (title, y, key) => drawChart(card(title), {x: load, y, lines: facets.map(facet => facetLine(facet, loops, key))});
  draw("Half-width W of the loops against load", "half-width W", "half_width");
  draw("Offset Δ of the loops against load", "offset Δ", "offset");
  return 2;
}

function fillTables(summary, loops) {
  const facets = document.getElementById("facets");
  addRow(facets, ["slope", "loops", "loads", "W′", "Δ′", "adhesion", "friction", "sensitivity"], true);
  for (const facet of summary.facets) {
    addRow(facets, [inDegrees(facet.slope), facet.loops, facet.loads, measured(facet.half_width_by_load, "V/N"),
      measured(facet.offset_by_load, "V/N"), measured(facet.adhesion, "N"),
      facet.friction || summary.flat_friction === undefined ? measured(facet.friction)
        : `${digits(summary.flat_friction)}, with the sensitivity below`,
      measured(facet.sensitivity, "N/V")]);
  }
  addRow(facets, ["all", "", "", "", "", "", measured(summary.friction), measured(summary.sensitivity, "N/V")]);
  const table = document.getElementById("loops");
  addRow(table, ["slope", "load", "half-width W", "offset Δ"], true);
  for (const loop of loops) {
    const of = key => measured({value: loop[key], error: loop[`${key}_error`]}, "V");
    addRow(table, [inDegrees(loop.slope), withUnit(loop.load, "N"), of("half_width"), of("offset")]);
  }
}

function fillTiles(summary) {
  const tile = (name, value, note) => document.getElementById("tiles").append(element("div", {className: "tile"},
    element("dt", {textContent: name}), element("dd", {textContent: value}), element("small", {textContent: note})));
  const inclined = summary.facets.filter(facet => facet.friction).length;
  tile("friction coefficient", measured(summary.friction), `of ${inclined} inclined facet${inclined > 1 ? "s" : ""}`);
  tile("lateral sensitivity", measured(summary.sensitivity, "N/V"), "force per detector signal");
  if (summary.root_by === "undecided") {
    tile("or else, friction coefficient", measured(summary.other_root.friction), "the loops fit both");
    tile("with a lateral sensitivity of", measured(summary.other_root.sensitivity, "N/V"), "the loops do not decide");
  }
  if (summary.root_by === "double root") tile("both roots", "not told apart", "near this friction W and Δ hardly depend on it");
  if (summary.crosstalk) tile("signal of the load itself", measured(summary.crosstalk, "V/N"), "of the flat facet, subtracted");
  if (summary.flat_friction !== undefined) tile("friction on the flat facet", digits(summary.flat_friction), "with that sensitivity, as a check");
}

function main() {
  const {summary, loops, file, settings} = JSON.parse(document.getElementById("head").textContent);
  document.getElementById("lead").textContent = `${counted(loops.length, "friction loop")} on ` +
    `${counted(summary.facets.length, "facet")}, from ${file}.`;
  document.getElementById("version").textContent = `Version ${summary.version} (${summary.commit}).`;
  document.getElementById("settings-text").textContent = settings;
  fillTiles(summary);
  fillTables(summary, loops);
  document.body.dataset.charts = placeCharts(summary, loops);
  document.body.dataset.ready = "1";
}

main();
