// The page of an AFM run: calibration, force curve, friction loops.
// <body> tells how it went: data-ready, data-charts, or data-error.
"use strict";

function fillTable(id, rows) {
  const table = document.getElementById(id);
  rows.forEach((cells, i) => {
    const row = table.insertRow();
    for (const text of cells) {
      row.append(element(i ? "td" : "th", {textContent: text ?? "–"}));
    }
  });
}

const signed = share => `${share >= 0 ? "+" : "−"}${digits(Math.abs(100 * share), 3)} %`;

function fillCalibration(c) {
  const names = {k_n: "normal stiffness", k_l: "lateral stiffness"};
  const rows = [["", "from", "value", "finite elements less this"]];
  for (const key of ["k_n", "k_l"]) {
    rows.push([names[key], "finite elements", withUnit(c[key], "N/m"), ""]);
    for (const form of c.closed_forms.filter(f => f.quantity === key)) {
      rows.push(["", form.name, withUnit(form.value, "N/m"), signed(form.difference)]);
    }
  }
  rows.push(["torsional stiffness", "finite elements", `${digits(c.torsional_stiffness)} N m/rad`, ""],
            ["stiffness along the lever", "finite elements", withUnit(c.k_x, "N/m"), ""],
            ["InvOLS, normal", "finite elements", `${digits(c.invols_normal)} m/V`, ""]);
  if (c.invols_lateral) {
    rows.push(["InvOLS, lateral", "finite elements", `${digits(c.invols_lateral)} m/V`, ""]);
  }
  fillTable("calibration", rows);
  document.getElementById("shares").textContent =
    `The tip's end is ${withUnit(c.arm, "m")} from the lever's middle plane. Of its lateral ` +
    `displacement ${percent(c.share_twist)} is twist of the lever, ${percent(c.share_bending)} ` +
    `lateral bending, ${percent(c.share_tip)} is in the tip.`;
}

function fillLoops(loops) {
  document.getElementById("loops-section").hidden = !loops.length;
  fillTable("loops", [["action", "load", "W", "Δ", "W / load", "Δ / load", "W, volts", "Δ, volts",
                       "friction", "sensitivity"],
    ...loops.map(l => [l.action, withUnit(l.load, "N"), withUnit(l.half_width, "N"),
      withUnit(l.offset, "N"), digits(l.half_width / l.load), digits(l.offset / l.load),
      withUnit(l.volts_half_width, "V"), withUnit(l.volts_offset, "V"),
      l.friction && digits(l.friction), l.sensitivity && `${digits(l.sensitivity)} N/V`])]);
}

function fillExpectations(verdicts) {
  document.getElementById("expectations-section").hidden = !verdicts.length;
  fillTable("expectations", [["what", "measured", "expected", ""],
    ...verdicts.map(v => [v.what, v.measured, v.expected, v.met ? "met" : "not met"])]);
}

// Samples of an action: its time runs from its position to the next one's, both included.
const samplesOf = (time, action) => [...time.keys()].filter(
  i => time[i] >= action - 1e-6 && time[i] <= action + 1 + 1e-6);

const picked = (series, samples, label) =>
  ({...series, label, values: Float32Array.from(samples, i => series.values[i])});

function placeForceCurve(history, actions) {
  const time = history.get("time").values;
  const samples = actions.flatMap((action, i) =>
    action.kind === "press" || action.kind === "retract" ? samplesOf(time, i) : []);
  if (samples.length < 2) return [];
  const host = card("Force curve: force against the height of the sample");
  const force = picked(history.get("probe/force_z"), samples, "normal force");
  const height = picked(history.get("scanner/z"), samples, "height of the sample");
  return [() => drawChart(host, {x: height, y: "force", lines: [force]})];
}

function placeLoop(history, action, index) {
  const samples = samplesOf(history.get("time").values, index), {axis} = action;
  if (samples.length < 2) return [];
  const way = picked(history.get(`scanner/${axis}`), samples, `sample along ${axis}`);
  const volts = axis === "y" ? "detector/lateral" : "detector/normal";
  return [["force", `probe/force_${axis}`, "Force along the scan"],
          ["volts", volts, "Detector along the scan"]].map(([y, name, title]) => {
    const host = card(`${title}, action ${index}${action.back ? ": forth and back" : ""}`);
    return () => drawChart(host, {x: way, y, lines: [picked(history.get(name), samples, name)]});
  });
}

function placeProbeForces(history) {
  const host = card("Forces of the sample on the probe against actions done");
  const lines = ["x", "y", "z"].map(k => ({...history.get(`probe/force_${k}`), label: `F${k}`}));
  const time = {...history.get("time"), label: "actions done"};
  return [() => drawChart(host, {x: time, y: "force", lines})];
}

async function main() {
  const head = JSON.parse(document.getElementById("head").textContent), {summary, actions} = head;
  const c = summary.calibration, history = await readHistory(head);
  document.getElementById("lead").textContent = `${summary.outcome}: k_n ${withUnit(c.k_n, "N/m")}, ` +
    `k_l ${withUnit(c.k_l, "N/m")}; ${summary.elements} elements, ${digits(summary.wall_seconds, 2)} s.`;
  document.getElementById("version").textContent = `Version ${summary.version} (${summary.commit}).`;
  fillCalibration(c);
  fillLoops(summary.loops || []);
  fillExpectations(summary.expectations || []);
  const charts = [];
  if (head.samples > 1) {
    charts.push(...placeForceCurve(history, actions));
    actions.forEach((action, i) => {
      if (action.kind === "scan" && charts.length < 12) charts.push(...placeLoop(history, action, i));
    });
    charts.push(...placeProbeForces(history));
  }
  for (const draw of charts) draw();
  document.body.dataset.charts = charts.length;
  document.body.dataset.ready = "1";
}

main().catch(fail);
