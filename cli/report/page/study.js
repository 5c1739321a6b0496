// The report of a study: checks, overlaid curves of all variations, and the table of its runs.
// Status on <body>: data-ready, data-drawn-lines and data-effects (counts), or data-error.
"use strict";

function leadText(head) {
  const bad = head.runs.filter(run => run.failure).length;
  const unmet = head.expectations.filter(one => !one.met).length;
  const parts = [`${counted(head.runs.length, "run")} of ` +
                 counted(new Set(head.runs.map(run => run.variation)).size, "variation"),
                 bad ? `${bad} failed` : "all ran to their end"];
  if (head.expectations.length) {
    parts.push(unmet ? `${unmet} of ${counted(head.expectations.length, "expectation")} not met`
                     : `${head.expectations.length > 1 ? "all " : ""}${counted(head.expectations.length, "expectation")} met`);
  }
  return parts.join(", ") + `. Version ${head.version} (${head.commit}).`;
}

function fillExpectations(list) {
  document.getElementById("expectations-section").hidden = !list.length;
  const body = document.querySelector("#expectations tbody");
  body.replaceChildren();
  for (const one of list) {
    const row = body.insertRow();
    row.insertCell().textContent = toldExpectation(one.what);
    for (const text of [one.measured, one.expected]) row.insertCell().append(...readable(text));
    const verdict = row.insertCell();
    verdict.textContent = one.met ? "met" : "NOT met";
    verdict.className = one.met ? "within" : "beyond";
  }
}

// Only runs that reached their end can be compared.
const completeRuns = ({runs}) => runs.filter(run => run.complete);

function leftOutNote(head) {
  const count = head.runs.length - completeRuns(head).length;
  return count ? `${counted(count, "run")} that did not reach ${count > 1 ? "their end are" : "its end is"} left out.` : "";
}

function fillLaws(head) {
  const runs = completeRuns(head).filter(run => run.fits && Array.isArray(run.fits.laws));
  document.getElementById("laws-left-out").textContent = leftOutNote(head);
  document.getElementById("laws-section").hidden = !runs.length;
  fillTexts("laws", LAW_TITLES, runs.flatMap(run => lawRows(run.name, run.fits)));
}

function fillBelow(head) {
  const runs = completeRuns(head).filter(run => run.transmission && run.transmission.shares);
  document.getElementById("below-left-out").textContent = leftOutNote(head);
  document.getElementById("below-section").hidden = !runs.length;
  const some = runs.some(({transmission}) => transmission.not_compared);
  const rows = runs.map(({name, transmission}) => [
    name, digits(transmission.wall_friction),
    ...TRANSMISSION.map(([key]) => digits(transmission.shares.at(-1)[key])),
    ...some ? [transmission.not_compared || ""] : []]);
  fillTexts("below", ["run", "wall µ", ...TRANSMISSION.map(([, title]) => title), ...some ? ["not compared because"] : []], rows);
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
  fillTexts("strength", ["fit", "of", "diameter", "runs", "found"], rows);
}

// Points and line of a fitted law: what is drawn against what, as named in summary.json.
const DRAWN = {weibull: ["failure_probability", "strength"], ryshkewitch_duckworth: ["strength", "porosity"], power: ["value", "key"]};

function lawLines(law, groups, unit, toX = x => x, toY = y => y) {
  const [y, x] = DRAWN[law.law];
  return groups.map(({name, points, line}) => {
    const values = points.map(point => toY(point[y]));
    return {label: law.groups.length > 1 ? name : counted(points.length, "run"), unit, x: points.map(point => toX(point[x])), values,
            low: values, high: values, isMarks: true, fit: line ? {x: line[x].map(toX), values: line[y].map(toY)} : null};
  });
}

function weibullPlot(law) {
  const [unit, factor] = law.unit === "Pa" ? ["MPa", 1e-6] : [law.unit, 1];
  const lines = lawLines(law, law.groups.filter(group => !group.not_fitted), "-", x => Math.log(x * factor), y => Math.log(-Math.log(1 - y)));
  return {title: titled(titleOfChart(law.title)), x: {label: unit === "-" ? "ln(strength)" : `ln(strength / ${unit})`, unit: "-", values: []},
          y: "ln(−ln(1 − P))", lines};
}

function lawPlot(law) {
  const [x, unit, y] = law.law === "power" ? [toldName(law.key), law.key_unit, toldName(law.series)] : ["porosity", "-", "strength"];
  return {title: titled(titleOfChart(law.title)), x: {label: x, unit, values: []}, y, lines: lawLines(law, law.groups.filter(group => group.points.length), law.unit)};
}

const strengthPlots = head => strengthLaws(head)
  .map(law => (law.law === "weibull" ? weibullPlot : lawPlot)(law))
  .filter(plot => plot.lines.length);

function lineData(line, numbers) {
  const part = k => numbers.subarray(line.first + k * line.count, line.first + (k + 1) * line.count);
  return {x: part(0), y: part(1), ...(line.band ? {low: part(2), high: part(3), deviation: part(4)} : {})};
}

const titleOfChart = title => title.split(" ").map(word => /[_/]/.test(word) ? nameOf(word).words : word).join(" ");

function seedsNote(lines) {
  const seeds = [...new Set(lines.filter(line => line.band).map(line => line.runs))].sort((a, b) => a - b);
  return seeds.length ? `Mean over ${seeds.join(" or ")} seeds; bars: ± standard deviation; band: from min to max.` : "";
}

// Every curve has its own x values, and a band over its seeds.
function overlay(curve, numbers, leftOut) {
  const lines = curve.lines.map(line => {
    const {x, y, low, high, deviation} = lineData(line, numbers);
    return {label: line.variation, unit: curve.y_unit, x, values: y, low, high, deviation};
  });
  return {title: titled(titleOfChart(curve.title)), x: {label: toldName(curve.x), unit: curve.x_unit, values: []},
          y: toldName(curve.y), lines, note: [seedsNote(curve.lines), leftOut].filter(Boolean).join(" ")};
}

async function main() {
  const head = JSON.parse(document.getElementById("head").textContent);
  keepLabels(head.labels);
  const numbers = await floats("numbers");
  document.getElementById("lead").textContent = leadText(head);
  const units = [...head.runs.flatMap(run => run.values), ...head.curves.flatMap(({x_unit, y_unit}) => [{unit: x_unit}, {unit: y_unit}])];
  placeSettings(document.getElementById("settings"), new Set(units.map(({unit}) => unit)), false);
  const fillTables = () => {
    fillExpectations(head.expectations);
    [fillRuns, fillVariations, fillLaws, fillBelow, fillStrength].forEach(fill => fill(head));
  };
  fillTables();
  onUnits(fillTables);
  fillThumbnails(head);
  const drawn = [...strengthPlots(head),
                 ...head.curves.filter(curve => curve.lines.length).map(curve => overlay(curve, numbers, leftOutNote(head)))];
  const hosts = drawn.map(chart => card(chart.title));  // create all cards first: they share the width
  drawn.forEach((chart, i) => drawChart(hosts[i], chart, {height: 340}));
  drawn.forEach((chart, i) => {
    if (chart.note) hosts[i].parentElement.append(element("p", {className: "note", textContent: chart.note}));
  });
  document.body.dataset.effects = drawEffects(head);
  document.body.dataset.drawnLines = drawn.reduce((sum, chart) => sum + chart.lines.length, 0);
  document.body.dataset.ready = "1";
}

main().catch(fail);
