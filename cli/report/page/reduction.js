// The page of a data reduction: friction curves, forces, clocks and key data of sliding-plate tests.
// Status on <body>: data-ready, data-charts, or data-error.
"use strict";

// A table of the page as columns {name, unit, kind, label, values}.
async function readTable(head, name) {
  const {rows, columns} = head.tables[name], all = await floats(name);
  return columns.map((column, k) =>
    ({...column, label: column.name, values: all.subarray(k * rows, (k + 1) * rows)}));
}

const inMm = value => `${digits(value * 1e3, 3)} mm`;

function fillFigures(summary) {
  const table = document.getElementById("figures");
  addRow(table, ["", "static", "at", "dynamic", "trend per 10 mm", "stick-slip", "in shear force",
                 "period", "force on punch", "reaches target"], true);
  for (const run of summary.runs) {
    const slip = run.stick_slip;
    addRow(table, [run.name,
      digits(run.static_friction) + (run.static_is_distinct ? "" : " (not distinct)"),
      inMm(run.static_distance), digits(run.dynamic_friction) +
        (run.elastic_dynamic_friction === undefined ? ""
          : ` (${digits(run.elastic_dynamic_friction)} with K = ν/(1 − ν))`),
      digits(run.dynamic_trend * 0.01, 2), slip && digits(slip.amplitude, 3),
      slip && withUnit(slip.shear_force_amplitude, "N", 3), slip && inMm(slip.period),
      withUnit(run.punch_force, "N"), percent(run.target_force / run.punch_force)]);
  }
  if (summary.runs.length < 2) return;
  const sign = half => half === "half_width" ? "± " : "";
  const of = (key, half) => summary[key] && summary[key].count > 1 &&
    (half ? sign(half) + digits(summary[key][half], 2) : digits(summary[key].mean));
  const keys = ["static_friction", null, "dynamic_friction", null, "stick_slip_amplitude", null];
  const period = half => summary.stick_slip_period && summary.stick_slip_period.count > 1 &&
    sign(half) + inMm(summary.stick_slip_period[half || "mean"]);
  const row = (name, half) => addRow(table,
    [name, ...keys.map(key => key ? of(key, half) || "–" : ""), period(half) || "–", "", ""]);
  row("mean of the runs");
  row("standard deviation", "deviation");
  const level = percent(summary.confidence);
  row(`${level} interval`, "half_width");
  document.getElementById("confidence").textContent =
    `Interval: ${level} confidence of the mean, from Student's distribution.`;
}

function fillClocks(summary) {
  const table = document.getElementById("clocks");
  addRow(table, ["", "offset", "found from", "drift", "sliding starts, press", "logger", "speed"],
         true);
  for (const {name, clock, sliding_speed} of summary.runs) {
    addRow(table, [name, `${clock.offset.toFixed(3)} s` +
      (clock.found_from === "given" ? "" : ` ± ${clock.offset_uncertainty.toFixed(3)} s`),
      clock.found_from,
      clock.drift === undefined ? "not found"
        : `${clock.drift.toExponential(1)} ± ${clock.drift_uncertainty.toExponential(1)}${
            clock.drift_is_applied ? "" : ", not applied"}`,
      `${clock.start_on_press_clock.toFixed(2)} s`, `${clock.start_on_logger_clock.toFixed(2)} s`,
      `${(sliding_speed * 1e3).toFixed(2)} mm/s`]);
  }
}

const pair = (x, y, lines) => ({x, y, lines});
const shareOf = line => {
  const finite = Array.from(line.values).filter(Number.isFinite);
  const low = Math.min(...finite), range = Math.max(...finite) - low || 1;
  return {...line, unit: "-", values: line.values.map(v => (v - low) / range)};
};

function placeRecords(records, runs) {
  const select = element("select", {}), label = element("label", {});
  const controls = element("div", {className: "controls"});
  runs.forEach((run, i) => select.add(new Option(run.name, i)));
  label.append("run ", select);
  controls.append(label);
  const forces = card("Forces against time", controls);
  const clocks = card("On one clock: both instruments record the plate's start and stop");
  select.onchange = () => {
    const [time, distance, punch, normal, shear] = records[select.value];
    const from = time.values.findIndex(t => t >= -5), seen = one =>
      ({...one, values: one.values.subarray(Math.max(0, from))});
    forces.replaceChildren();
    clocks.replaceChildren();
    drawChart(forces, pair(seen(time), "force", [seen(normal), seen(shear)]));
    drawChart(clocks, pair(seen(time), "share of the range",
                           [seen(distance), seen(punch)].map(shareOf)));
  };
  return select.onchange;
}

function placeCurves(friction, shear, mean, summary) {
  const [x, ...lines] = friction, simulated = lines.some(line => line.kind === "simulation");
  const host = card(`Friction coefficient against sliding distance${
    simulated ? ": tests and simulation" : ""}`);
  const named = lines.map(line => line.kind === "simulation"
    ? {...line, label: `simulation ${line.name}`, colour: "ink", dash: [8, 4]} : line);
  const charts = [() => drawChart(host, pair(x, "friction coefficient", named))];
  const runs = summary.runs.length;
  if (runs > 1) {
    const place = card(`Mean of ${runs} runs, with its ${percent(summary.confidence)} interval`);
    const [at, ...values] = mean;
    charts.push(() => drawChart(place, pair(at, "friction coefficient", values.map(line =>
      line.kind === "mean" ? line : {...line, colour: "#9cc4de"}))));
  }
  const place = card("Shear force against sliding distance");
  charts.push(() => drawChart(place, pair(shear[0], "shear force", shear.slice(1))));
  return charts;
}

const lead = summary => {
  const {runs, static_friction: peak, dynamic_friction: mean} = summary;
  return `${runs.length} run${runs.length > 1 ? "s" : ""}: static coefficient ` +
    `${withSpread(peak.mean, peak.half_width)}, dynamic ${withSpread(mean.mean, mean.half_width)}.`;
};

async function main() {
  const head = JSON.parse(document.getElementById("head").textContent), summary = head.summary;
  const [friction, shear, mean] =
    await Promise.all(["friction", "shear", "mean"].map(name => readTable(head, name)));
  const records = await Promise.all(summary.runs.map((run, i) => readTable(head, `record-${i}`)));
  document.getElementById("lead").textContent = lead(summary);
  document.getElementById("version").textContent = `Version ${summary.version} (${summary.commit}).`;
  fillFigures(summary);
  fillClocks(summary);
  const charts = placeCurves(friction, shear, mean, summary);
  charts.push(placeRecords(records, summary.runs));
  for (const draw of charts) draw();
  document.body.dataset.charts = charts.length + 1;
  document.body.dataset.ready = "1";
}

main().catch(fail);
