// Text of the report: what was run, how it ended, and whether the results are reliable.
"use strict";

const countOf = value => Math.round(value).toLocaleString("en");

// The maximum: at the end the compact may be unloaded and ejected.
function pressedDensity(run) {
  const reached = run.values("relative_density").filter(Number.isFinite);
  return reached.length ? Math.max(...reached) : run.summary.relative_density;
}
// Not in a tension test, whose density is highest at the start.
function wasPressed(run) {
  const start = run.values("relative_density").find(Number.isFinite);
  return pressedDensity(run) !== undefined && !(pressedDensity(run) <= 1.0001 * start);
}

function did(run) {
  const {family, head, summary} = run;
  if (family === "afm") return "A lever was calibrated" + (summary.loops ? " and scanned over a surface" :
                               (head.frames || []).length && summary.increments ? " and moved against a surface" : "");
  const particles = counted(head.mesh.particles, "particle");
  if (!run.times.length) return `${titled(particles)} had not moved yet`;
  if (family === "shear" && largest(run.values("shear/distance")) > 0) return `A target was slid under a compact of ${particles}`;
  const were = head.mesh.particles === 1 ? "was" : "were";
  return !wasPressed(run) ? `${titled(particles)} ${were} moved and deformed`
    : `${titled(particles)} ${were} pressed to a relative density of ` +
      digits(pressedDensity(run), 3);
}

// Other outcomes are words that follow "The run": "failed: ...".
const OUTCOMES = {
  done: "", interrupted: "The run was interrupted before its end.",
  running: "The run has not ended: it is still running, or was killed. What is shown is as far as it had come when this page was written."};

// What was done, how it ended, and whether the result is reliable, in words.
function leadOf(run) {
  const {summary, head} = run, figures = qualityFigures(run);
  const elements = head.mesh ? head.mesh.cells : head.solid ? head.solid.cells : 0;
  const parts = [`${did(run)}, in ${counted(elements, "element")}.`];
  if (summary.wall_seconds > 0) parts.push(`Computed in ${duration(summary.wall_seconds)}.`);
  if (OUTCOMES[run.outcome] !== "") parts.push(OUTCOMES[run.outcome] ?? `The run ${run.outcome}.`);
  const beyond = figures.filter(isBeyond);
  const limited = figures.filter(figure => typeof figure.limit === "number");
  if (beyond.length) {
    parts.push(`Beyond ${beyond.length > 1 ? "their limits" : "its limit"}: ` +
               `${beyond.map(figure => figure.name.toLowerCase()).join(", ")}; see the card on quality for remedies.`);
  }
  if (!beyond.length && limited.length && run.outcome !== "running") parts.push("Every quality value is within its limit.");
  const missed = (summary.expectations || []).filter(one => !one.met).length;
  if (summary.expectations) parts.push(missed ? `${missed} of ${counted(summary.expectations.length, "expectation")} not met.`
                                              : summary.expectations.length > 1 ? `All ${summary.expectations.length} expectations met.` : "The expectation is met.");
  return parts.join(" ");
}

function duration(seconds) {
  if (seconds < 120) return digits(seconds, 3) + " s";
  const minutes = Math.round(seconds / 60);
  return minutes < 120 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

const bytesInWords = bytes =>
  bytes >= 1e9 ? digits(bytes / 1e9, 3) + " GB" : digits(bytes / 1e6, 3) + " MB";

function largestForce(run) {
  let most = {value: 0};
  for (const {name, values} of run.named(/^tool\/.+\/force_[xyz]$/)) {
    const value = largest(values);
    if (value > most.value) most = {value, tool: name.split("/")[1]};
  }
  return most;
}

addFigures(run => {
  const {value, tool} = largestForce(run);
  return [value > 0 && ["largest force", withUnit(value, "N", 3), `on ${tool}`]];
});

// Units of material parameters: the summary is in plain SI.
const MATERIAL_UNITS = {density: "kg/m³", youngs_modulus: "Pa", poissons_ratio: "-",
                        yield_stress: "Pa", hardening_modulus: "Pa", mass_proportional: "1/s", stiffness_proportional: "s"};

function materialRows(materials) {
  const named = key => words(key).replace(/^(young|poisson)s/, (_, name) => `${titled(name)}'s`);
  const told = (key, value) => value !== null && typeof value === "object"
    ? Object.entries(value).map(([inner, one]) => `${named(key)} ${told(inner, one)}`).join(", ")
    : `${named(key)} ${typeof value === "number" ? withUnit(value, MATERIAL_UNITS[key] || "-") : value}`;
  return (Array.isArray(materials) ? materials : []).map(({name, ...numbers}) =>
    [`Material ${name || ""}`, Object.entries(numbers).map(one => told(...one)).join(", "),
     ["materials"]]);
}

// What set the time step at the start, when it was shortest, and at the end, as the program says it (cli/step_limits.hpp).
const stepRows = limits => !Array.isArray(limits) ? [] : [
  ...limits.map(({when, time, text}) => [when === "shortest" ? `Shortest time step (at ${withUnit(time, "s")})` : `Time step at the ${when}`, text, ["time_step"]]),
  ...limits.slice(-1).map(({when, slowest}) => [`Time step at the ${when === "shortest" ? "time of the shortest" : when} by its elements`, slowest, []])];

const NOT_ENCLOSED = "none: the tools do not enclose the powder";
// Undefined if the run has none; null if its tools did not enclose the powder.
function finalDensity(run) {
  const density = run.summary.relative_density ?? run.end("relative_density");
  return density === undefined || Number.isFinite(density) ? density : null;
}

// Rows for keys with special meaning: [label, text or null, the keys it covers].
function knownRows(run) {
  const {head, summary: s} = run, has = key => typeof s[key] === "number", count = countOf;
  const density = finalDensity(run);
  const mesh = head.mesh || {}, force = largestForce(run);
  return [
    ["Outcome", run.outcome === "running" ? "not ended" : run.outcome, ["outcome"]],
    ["Particles", mesh.particles ? count(mesh.particles) : null, ["particles"]],
    ["Elements", has("elements") || mesh.cells ? count(s.elements ?? mesh.cells) : null, ["elements"]],
    [run.hasEnded ? "Final relative density" : "Relative density so far", density === undefined ? null : density === null ? NOT_ENCLOSED : digits(density),
     ["relative_density"]],
    ["Largest force", force.value > 0 ? `${withUnit(force.value, "N")} on ${force.tool}` : null, []],
    ["Thickness of the slice", has("thickness") ? withUnit(s.thickness, "m") : null, ["thickness"]],
    ...materialRows(s.materials),
    ["Simulated time", has("time") ? withUnit(s.time, "s") : null, ["time"]],
    ["Steps", has("steps") ? count(s.steps) : null, ["steps"]],
    ...stepRows(s.time_step),
    ["Computing time", has("wall_seconds") ? duration(s.wall_seconds) +
      (has("threads") ? ` on ${counted(s.threads, "thread")}` : "") : null,
     ["wall_seconds", "threads"]],
    ["Speed", has("element_updates_per_second") ?
      `${digits(s.element_updates_per_second / 1e6, 3)} million element updates per second` : null,
     ["element_updates_per_second"]],
    ["Peak memory", has("peak_memory_bytes") ? bytesInWords(s.peak_memory_bytes) : null,
     ["peak_memory_bytes"]],
    ["Version", s.version ? s.version + (s.commit ? ` (${s.commit})` : "") : null,
     ["version", "commit"]],
  ];
}

// Units of other numbers; those of a lever's values are in the head of the page.
const SUMMARY_UNITS = {begin: "s", end: "s", seconds_a_step: "s", crack_length: "m", crack_area: "m^2", fracture_energy: "J", crack_energy: "J",
                       d10: "m", d50: "m", d90: "m", sensitivity: "N/V"};

// All other entries, one row per number or text, nested names joined.
function otherRows(value, name, rows, {units, unit = "-"}) {
  if (value === null || value === "") return;
  if (typeof value !== "object") {
    const text = typeof value === "number" ? withUnit(value, unit, 6) : String(value);
    rows.push([titled(name), Number.isInteger(value) && unit === "-" ? String(value) : text]);
  } else if (Array.isArray(value) && value.every(item => typeof item !== "object")) {
    rows.push([titled(name), value.map(v => typeof v === "number" ? withUnit(v, unit, 6) : v).join(", ")]);
  } else {
    for (const [key, item] of Object.entries(value)) {
      const inner = Array.isArray(value) && item && item.name ? item.name : key;
      const told = inner === key ? toldName(key) : words(inner);
      if (key !== "name") otherRows(item, name ? `${name}, ${told}` : told, rows, {units, unit: units[key] || unit});
    }
  }
}

function fillSummary(run) {
  const known = knownRows(run);
  const told = new Set(["title", "tools", "limits", "quality", "energy_balance_error", "family", "shear",
                        "kinetic_ratio", "penetration", "fits", "transmission", "expectations", "calibration",
                        "loops", "force_curves", "cost", "contact_quality", "warnings", ...known.flatMap(row => row[2])]);
  const rows = known.filter(row => row[1]);
  const units = {...SUMMARY_UNITS, ...run.head.units};
  for (const [key, value] of Object.entries(run.summary)) {
    if (!told.has(key)) otherRows(value, key === "values" ? "" : toldName(key), rows, {units, unit: units[key]});
  }
  const table = document.getElementById("summary");
  table.replaceChildren();
  for (const [label, text] of rows) {
    const row = table.insertRow();
    row.append(element("th", {scope: "row", textContent: label}));
    row.insertCell().textContent = text;
  }
}

function fillFigures(run) {
  document.getElementById("figures").replaceChildren(...figuresOf(run).map(([label, value, note]) =>
    element("div", {className: "tile"}, element("dt", {textContent: label}), element("dd", {textContent: value}),
            element("small", {textContent: note}))));
}

// As rated by the program (scenes/results/run_quality.hpp).
const qualityFigures = run => (run.summary.quality || []).filter(figure => Number.isFinite(figure.value));
const isBeyond = ({value, limit}) => typeof limit === "number" && !(Math.abs(value) <= limit);

function fillQuality(run) {
  const figures = qualityFigures(run), expected = run.summary.expectations || [];
  document.getElementById("quality-section").hidden =
    !figures.length && !expected.length && !run.summary.warnings;
  document.getElementById("quality-note").hidden = !figures.length;
  const body = document.querySelector("#quality tbody");
  body.replaceChildren();
  const add = (name, note, cells, verdict, good) => {
    const row = body.insertRow(), head = element("th", {scope: "row", textContent: titled(name)});
    head.append(element("small", {textContent: note || ""}));
    row.append(head);
    cells.forEach(text => { row.insertCell().append(...readable(text)); });
    row.append(element("td", {className: verdict && (good ? "within" : "beyond"), textContent: verdict}));
    return row;
  };
  for (const figure of figures) {
    const {name, meaning, value, limit, advice} = figure, limited = typeof limit === "number", within = !isBeyond(figure);
    const row = add(name, meaning, [percent(value), limited ? percent(limit) : figure.judged || "none set"],
                    limited ? within ? "within" : "beyond" : "", within);
    if (advice) row.firstChild.append(element("small", {className: "advice", textContent: `What to do: ${advice}.`}));
  }
  for (const text of run.summary.warnings || []) add("Warning", text, ["", ""], "", false);
  for (const one of expected) {
    add(toldExpectation(one.what), `${one.what.split(/[\s,]/)[0]}, expected by the scene`, [one.measured, one.expected], one.met ? "met" : "NOT met", one.met);
  }
}

// The cost of the run, by system if it was measured.
function fillCost(run) {
  const {cost} = run.summary;
  if (!Array.isArray(cost) || !cost.length) return;
  document.getElementById("cost-section").hidden = false;
  const table = document.getElementById("cost"), sum = cost.reduce((total, one) => total + one.seconds, 0);
  table.replaceChildren();
  for (const {system, seconds} of cost.slice().sort((a, b) => b.seconds - a.seconds)) {
    const row = table.insertRow(), bar = element("i", {className: "bar"});
    bar.style.width = 100 * seconds / cost.reduce((most, one) => Math.max(most, one.seconds), 0) + "%";
    row.append(element("th", {scope: "row", textContent: words(system)}), element("td", {}, bar),
               element("td", {textContent: percent(seconds / sum)}), element("td", {textContent: duration(seconds)}));
  }
}
