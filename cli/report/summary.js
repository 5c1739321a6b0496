// The words of the report: what was run, how it went, and whether its numbers can be believed.
"use strict";

function leadOf(head, history) {
  const s = head.summary, time = history.get("time").values;
  const parts = [`${head.mesh.particles.toLocaleString("en")} particles`,
                 `${head.mesh.cells.toLocaleString("en")} elements`];
  if (time.length) parts.push(`${withUnit(time[time.length - 1], "s")} of simulated time`);
  if (s.wall_seconds > 0) parts.push(`computed in ${duration(s.wall_seconds)}`);
  return parts.join(", ") + ".";
}

function duration(seconds) {
  if (seconds < 120) return digits(seconds, 3) + " s";
  const minutes = Math.round(seconds / 60);
  return minutes < 120 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

const bytesInWords = bytes =>
  bytes >= 1e9 ? digits(bytes / 1e9, 3) + " GB" : digits(bytes / 1e6, 3) + " MB";

function largestForce(history) {
  let most = null;
  for (const [name, series] of history) {
    const match = name.match(/^tool\/(.+)\/force_([xy])$/);
    const value = match ? largest(series.values) : 0;
    if (match && (!most || value > most.value)) most = {value, tool: match[1]};
  }
  return most && most.value > 0 ? `${withUnit(most.value, "N")} on ${most.tool}` : null;
}

function lastOf(history, name) {
  const values = history.has(name) ? history.get(name).values : [];
  return values.length ? values[values.length - 1] : undefined;
}

// Units of a material's numbers: the summary is plain SI.
const MATERIAL_UNITS = {density: "kg/m³", youngs_modulus: "Pa", poissons_ratio: "-",
                        yield_stress: "Pa", hardening_modulus: "Pa"};

function materialRows(materials) {
  const named = key => words(key).replace(/^(young|poisson)s/, (_, name) => `${titled(name)}'s`);
  const told = (key, value) => `${named(key)} ` +
    (typeof value === "number" ? withUnit(value, MATERIAL_UNITS[key] || "-") : value);
  return (Array.isArray(materials) ? materials : []).map(({name, ...numbers}) =>
    [`Material ${name || ""}`, Object.entries(numbers).map(one => told(...one)).join(", "),
     ["materials"]]);
}

// Rows for the keys with a meaning of their own: [label, text or null, the keys it tells].
function knownRows(head, history) {
  const s = head.summary, has = key => typeof s[key] === "number";
  const last = lastOf(history, "relative_density");
  const density = has("relative_density") ? s.relative_density : last;
  const count = value => Math.round(value).toLocaleString("en");
  return [
    ["Outcome", s.outcome, ["outcome"]],
    ["Particles", count(has("particles") ? s.particles : head.mesh.particles), ["particles"]],
    ["Elements", count(has("elements") ? s.elements : head.mesh.cells), ["elements"]],
    ["Final relative density", density === undefined ? null : digits(density),
     ["relative_density"]],
    ["Largest force", largestForce(history), []],
    ["Thickness of the slice", has("thickness") ? withUnit(s.thickness, "m") : null, ["thickness"]],
    ...materialRows(s.materials),
    ["Simulated time", has("time") ? withUnit(s.time, "s") : null, ["time"]],
    ["Steps", has("steps") ? count(s.steps) : null, ["steps"]],
    ["Computing time", has("wall_seconds") ? duration(s.wall_seconds) +
      (has("threads") ? ` on ${s.threads} thread${s.threads === 1 ? "" : "s"}` : "") : null,
     ["wall_seconds", "threads"]],
    ["Speed", has("element_updates_per_second") ?
      `${digits(s.element_updates_per_second / 1e6, 3)} million element updates a second` : null,
     ["element_updates_per_second"]],
    ["Peak memory", has("peak_memory_bytes") ? bytesInWords(s.peak_memory_bytes) : null,
     ["peak_memory_bytes"]],
    ["Version", s.version ? s.version + (s.commit ? ` (${s.commit})` : "") : null,
     ["version", "commit"]],
  ];
}

// What the program tells beyond that, one row a number or text, nested names joined.
function otherRows(value, name, rows) {
  if (value === null || value === "") return;
  if (typeof value !== "object") {
    const text = typeof value === "number" ? digits(value, 6) : String(value);
    rows.push([titled(name), Number.isInteger(value) ? String(value) : text]);
  } else if (Array.isArray(value) && value.every(item => typeof item !== "object")) {
    rows.push([titled(name), value.map(v => typeof v === "number" ? digits(v, 6) : v).join(", ")]);
  } else {
    for (const [key, item] of Object.entries(value)) {
      const inner = Array.isArray(value) && item && item.name ? item.name : key;
      if (key !== "name") otherRows(item, `${name}, ${words(inner)}`, rows);
    }
  }
}

function fillSummary(head, history) {
  const known = knownRows(head, history);
  const told = new Set(["title", "tools", "limits", "quality", "energy_balance_error",
                        "kinetic_ratio", "penetration", "fits", "transmission",
                        ...known.flatMap(row => row[2])]);
  const rows = known.filter(row => row[1]);
  for (const [key, value] of Object.entries(head.summary)) {
    if (!told.has(key)) otherRows(value, key, rows);
  }
  const table = document.getElementById("summary");
  for (const [label, text] of rows) {
    const row = table.insertRow();
    row.insertCell().textContent = label;
    row.insertCell().textContent = text;
  }
}

// Figures made from the history, where the program gave none of its own.
function qualityFigures(head, history) {
  const s = head.summary, limits = s.limits || {};
  if (Array.isArray(s.quality)) return s.quality;
  const most = name => history.has(name) ? largest(history.get(name).values) : NaN;
  const given = (key, other) => typeof s[key] === "number" ? s[key] : other;
  const internal = Math.max(most("energy/elastic") || 0, most("energy/plastic") || 0);
  const balance = given("energy_balance_error",
    most("energy/balance") / Math.max(internal, most("energy/kinetic") || 0));
  return [
    {name: "Energy balance error", value: balance, limit: limits.energy_balance ?? 0.05,
     meaning: "energy lost or made by the calculation, of the largest energy in the run"},
    {name: "Kinetic energy", limit: limits.kinetic_energy,
     value: given("kinetic_ratio", most("energy/kinetic") / internal),
     meaning: "kinetic energy, of the internal energy"},
    {name: "Hourglass energy", value: most("energy/hourglass") / internal, limit: 0.03,
     meaning: "largest energy of bending inside the elements, plastic work included, of the largest internal energy"},
    {name: "Penetration", value: most("penetration"), limit: limits.penetration,
     meaning: "deepest overlap of two surfaces, of the length of a boundary edge"},
  ].filter(figure => Number.isFinite(figure.value));
}

function fillQuality(head, history) {
  const figures = qualityFigures(head, history);
  document.getElementById("quality-section").hidden = figures.length === 0;
  const body = document.querySelector("#quality tbody");
  for (const figure of figures) {
    const row = body.insertRow(), name = row.insertCell();
    const limited = typeof figure.limit === "number";
    name.textContent = titled(figure.name);
    name.append(element("small", {textContent: figure.meaning || ""}));
    row.insertCell().textContent = percent(figure.value);
    row.insertCell().textContent = limited ? percent(figure.limit) : "none set";
    const within = Math.abs(figure.value) <= figure.limit, verdict = row.insertCell();
    verdict.textContent = !limited ? "" : within ? "within" : "beyond";
    verdict.className = verdict.textContent;
  }
}
