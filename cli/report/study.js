// The report of a study: verdicts, curves of all variations over each other, and the table of its runs.
// <body> tells how it went: data-ready with the number of lines drawn, or data-error.
"use strict";

const linkTo = run => element("a", {textContent: run.name,
                                    href: `${encodeURIComponent(run.name)}/report.html`});

function leadText(head) {
  const bad = head.runs.filter(run => run.failure).length;
  const unmet = head.expectations.filter(one => !one.met).length;
  const parts = [`${counted(head.runs.length, "run")} of ` +
                 counted(new Set(head.runs.map(run => run.variation)).size, "variation"),
                 bad ? `${bad} failed` : "all good"];
  if (head.expectations.length) {
    parts.push(unmet ? `${unmet} of ${counted(head.expectations.length, "expectation")} not met`
                     : `${head.expectations.length > 1 ? "all " : ""}${counted(head.expectations.length, "expectation")} met`);
  }
  return parts.join(", ") + `. Version ${head.version} (${head.commit}).`;
}

function fillExpectations(list) {
  document.getElementById("expectations-section").hidden = !list.length;
  const body = document.querySelector("#expectations tbody");
  for (const one of list) {
    const row = body.insertRow();
    for (const text of [one.what, one.measured, one.expected]) row.insertCell().textContent = text;
    const verdict = row.insertCell();
    verdict.textContent = one.met ? "met" : "NOT met";
    verdict.className = one.met ? "within" : "beyond";
  }
}

// rows: [[cell, ...]] of texts or elements.
function fillTable(id, titles, rows, isBad = () => false) {
  const head = document.querySelector(`#${id} thead`).insertRow();
  titles.forEach(title => head.append(element("th", {textContent: title})));
  const body = document.querySelector(`#${id} tbody`);
  rows.forEach((cells, i) => {
    const row = body.insertRow();
    if (isBad(i)) row.className = "bad";
    cells.forEach(cell => row.insertCell().append(cell));
  });
}

const figureOf = (run, name) => run.values.find(figure => figure.name === name);

function figureText(figure) {
  if (!figure || figure.value === null || figure.value === "") return "–";
  if (typeof figure.value === "string") return figure.value;
  if (figure.unit === "") return figure.value.toLocaleString("en");
  return withUnit(figure.value, figure.unit);
}

const COLUMNS = [["particles", "particles"], ["steps", "steps"], ["wall_seconds", "computing time"],
                 ["relative_density", "relative density"], ["stress_ratio/axial", "σ axial / σy"],
                 ["stress_ratio/lateral", "σ lateral / σy"], ["top_force_end", "top force"],
                 ["elements", "elements"], ["increments", "increments"],
                 ["k_n", "k_n"], ["k_l", "k_l"], ["k_x", "k_x"], ["k_l/k_n", "k_l/k_n"],
                 ["torsional_stiffness", "torsional stiffness"], ["share_twist", "share of twist"],
                 ["share_bending", "share of lateral bending"], ["share_tip", "share of the tip"],
                 ["invols_normal", "InvOLS normal"], ["invols_lateral", "InvOLS lateral"],
                 ["loop/load", "load of the loop"], ["loop/half_width", "W"], ["loop/offset", "Δ"],
                 ["loop/friction", "friction"], ["loop/sensitivity", "sensitivity"],
                 ["curve/pull_off", "pull-off"], ["curve/work_of_adhesion", "work of adhesion"],
                 ["bottom_force_end", "bottom force"], ["top_force_max", "largest top force"],
                 ["energy_balance_error", "energy balance error"], ["kinetic_ratio", "kinetic ratio"],
                 ["expectations_met", "expectations met"]];

function fillRuns(head) {
  const keys = Object.keys(head.runs[0].varied);
  const columns = COLUMNS.filter(([name]) => head.runs.some(run => {
    const figure = figureOf(run, name);
    return figure && figure.value !== null && figure.value !== "";
  }));
  const rows = head.runs.map(run => [
    run.values.some(figure => figure.name === "outcome" && figure.value) ? linkTo(run) : run.name,
    ...keys.map(key => run.varied[key] || "–"), String(run.seed),
    run.failure ? run.failure : figureText(figureOf(run, "outcome")),
    ...columns.map(([name]) => figureText(figureOf(run, name)))]);
  fillTable("runs", ["run", ...keys, "seed", "outcome", ...columns.map(([, title]) => title)], rows,
            i => Boolean(head.runs[i].failure));
}

function fillLaws(head) {
  const runs = head.runs.filter(run => run.fits && Array.isArray(run.fits.laws));
  document.getElementById("laws-section").hidden = !runs.length;
  const told = law => law.not_fitted ? `not fitted: ${law.not_fitted}`
                                     : law.parameters.map(parameterText).join(", ");
  const rows = runs.flatMap(run => run.fits.laws.map(law => [
    run.name, (LAWS[law.law] || [law.law])[0], told(law),
    law.not_fitted ? "–" : digits(law.r_squared, 5),
    law.not_fitted ? "–" : digits(law.rms_density, 3)]));
  fillTable("laws", ["run", "law", "parameters", "R²", "rms of D"], rows);
}

function fillBelow(head) {
  const runs = head.runs.filter(run => run.transmission && run.transmission.shares);
  document.getElementById("below-section").hidden = !runs.length;
  const rows = runs.map(({name, transmission}) => [
    name, digits(transmission.wall_friction),
    ...TRANSMISSION.map(([key]) => digits(transmission.shares.at(-1)[key])),
    transmission.not_compared || ""]);
  fillTable("below", ["run", "wall µ", ...TRANSMISSION.map(([, title]) => title), ""], rows);
}

const strengthLaws = head => Array.isArray(head.fits) ? head.fits : [];

function limitedText(parameter) {
  const {low, high, unit} = parameter;
  return parameterText(parameter) +
    (low === undefined ? "" : ` (${withUnit(low, unit, 3)} to ${withUnit(high, unit, 3)})`);
}

function fillStrength(head) {
  const laws = strengthLaws(head);
  document.getElementById("strength-section").hidden = !laws.length;
  const row = (law, name, group) => [
    law.title, name, group.diameter ? withUnit(group.diameter, "m") : "–", String(group.points.length),
    group.not_fitted ? `not fitted: ${group.not_fitted}` : group.parameters.map(limitedText).join(", ")];
  const rows = laws.flatMap(law => [
    ...law.groups.map(group => row(law, group.name, group)),
    ...(law.size_effect ? [row(law, "size effect", {points: law.groups.flatMap(group => group.points),
                                                    parameters: law.size_effect})] : [])]);
  fillTable("strength", ["fit", "of", "diameter", "runs", "found"], rows);
}

const spread = (values, count = 60) => {
  const low = Math.min(...values), high = Math.max(...values);
  return Array.from({length: count}, (_, i) => low + (high - low) * i / (count - 1));
};
const parameterOf = (group, name) => group.parameters.find(parameter => parameter.name === name).value;

function markedLine(law, group, unit, x, values, fit) {
  return {label: law.groups.length > 1 ? group.name : counted(group.points.length, "run"), unit, x, values, low: values,
          high: values, isMarks: true, fit: group.not_fitted ? null : fit()};
}

function weibullPlot(law) {
  const [unit, factor] = law.unit === "Pa" ? ["MPa", 1e-6] : [law.unit, 1];
  const lines = law.groups.filter(group => !group.not_fitted).map(group => {
    const x = group.points.map(point => Math.log(point.strength * factor));
    const values = group.points.map(point => Math.log(-Math.log(1 - point.failure_probability)));
    return markedLine(law, group, "-", x, values, () => {
      const modulus = parameterOf(group, "modulus"), middle = Math.log(parameterOf(group, "scale") * factor);
      const along = spread(x, 2);
      return {x: along, values: along.map(v => modulus * (v - middle))};
    });
  });
  return {title: law.title, x: {label: unit === "-" ? "ln(strength)" : `ln(strength / ${unit})`, unit: "-", values: []},
          y: "ln(−ln(1 − P))", lines};
}

function porosityPlot(law) {
  const lines = law.groups.filter(group => group.points.length).map(group => {
    const x = group.points.map(point => point.porosity), values = group.points.map(point => point.strength);
    return markedLine(law, group, law.unit, x, values, () => {
      const dense = parameterOf(group, "dense_strength"), k = parameterOf(group, "k"), along = spread(x);
      return {x: along, values: along.map(porosity => dense * Math.exp(-k * porosity))};
    });
  });
  return {title: law.title, x: {label: "porosity", unit: "-", values: []}, y: "strength", lines};
}

function powerPlot(law) {
  const lines = law.groups.filter(group => group.points.length).map(group => {
    const x = group.points.map(point => point.key), values = group.points.map(point => point.value);
    return markedLine(law, group, law.unit, x, values, () => {
      const [exponent, value, at] = ["exponent", "value", "at"].map(name => parameterOf(group, name));
      const along = spread(x);
      return {x: along, values: along.map(key => value * (key / at) ** exponent)};
    });
  });
  return {title: law.title, x: {label: law.key, unit: law.key_unit, values: []}, y: law.series, lines};
}

const PLOTS = {weibull: weibullPlot, ryshkewitch_duckworth: porosityPlot, power: powerPlot};
const strengthPlots = head => strengthLaws(head)
  .map(law => PLOTS[law.law](law))
  .filter(plot => plot.lines.length);

function lineData(line, numbers) {
  const part = k => numbers.subarray(line.first + k * line.count, line.first + (k + 1) * line.count);
  return {x: part(0), y: part(1), low: line.band ? part(2) : null, high: line.band ? part(3) : null};
}

const seriesLabel = name => words(name).replaceAll("/", " ");

// Every curve has an abscissa of its own, and a band over its seeds.
function overlay(curve, numbers) {
  const lines = curve.lines.map(line => {
    const {x, y, low, high} = lineData(line, numbers);
    const label = line.band ? `${line.variation}, mean of ${line.runs} seeds, band from min to max` : line.variation;
    return {label, unit: curve.y_unit, x, values: y, low, high};
  });
  return {title: seriesLabel(curve.title), x: {label: seriesLabel(curve.x), unit: curve.x_unit, values: []},
          y: seriesLabel(curve.y), lines};
}

async function main() {
  const head = JSON.parse(document.getElementById("head").textContent);
  const numbers = await floats("numbers");
  document.getElementById("lead").textContent = leadText(head);
  fillExpectations(head.expectations);
  fillRuns(head);
  fillLaws(head);
  fillBelow(head);
  fillStrength(head);
  const drawn = [...strengthPlots(head),
                 ...head.curves.filter(curve => curve.lines.length).map(curve => overlay(curve, numbers))];
  const hosts = drawn.map(chart => card(chart.title));  // first all places: they share the width
  drawn.forEach((chart, i) => drawChart(hosts[i], chart, {height: 340}));
  document.body.dataset.drawnLines = drawn.reduce((sum, chart) => sum + chart.lines.length, 0);
  document.body.dataset.ready = "1";
}

main().catch(fail);
