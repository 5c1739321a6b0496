// Display units: results are in SI, engineers read mm, kN and MPa.
"use strict";

const PREFIXES = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""],
                  [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"], [1e-15, "f"]];
const SCALED = new Set(["m", "N", "Pa", "J", "s", "m/s", "V", "W", "N/m", "N/V", "V/N", "m/V", "J/m^2", "J/m^3"]);

// User choice: prefix for each SI unit. Everything that shows numbers listens for changes.
const chosenPrefixes = new Map();
const unitListeners = [];
const onUnits = listener => { unitListeners.push(listener); };

function chooseUnit(unit, prefix) {
  prefix === null ? chosenPrefixes.delete(unit) : chosenPrefixes.set(unit, prefix);
  unitListeners.forEach(listener => listener());
}

const superscripts = unit => unit.replace("^2", "²").replace("^3", "³");

// {factor, label}: multiply an SI number by the factor to show it in the labelled unit.
function unitFor(unit, largest) {
  if (unit === "-" || unit === "") return {factor: 1, label: ""};
  if (chosenPrefixes.has(unit)) {
    const chosen = chosenPrefixes.get(unit);
    return {factor: 1 / PREFIXES.find(([, prefix]) => prefix === chosen)[0], label: chosen + superscripts(unit)};
  }
  if (unit === "1/Pa") {
    const pressure = chosenPrefixes.get("Pa") ?? "M";
    return {factor: PREFIXES.find(([, prefix]) => prefix === pressure)[0], label: `1/${pressure}Pa`};
  }
  if (unit === "m^2" && largest > 0) {  // m², mm², µm² ...: from 0.01 of each, or squares of a chosen unit
    const {factor, label} = unitFor("m", 10 * Math.sqrt(largest));
    return {factor: factor ** 2, label: label + "²"};
  }
  if (!SCALED.has(unit) || !(largest > 0)) return {factor: 1, label: superscripts(unit)};
  const fits = ([size, prefix]) => largest >= size * 0.9995 && !(unit[0] === "m" && size > 1);
  const [size, prefix] = PREFIXES.find(fits) || PREFIXES[PREFIXES.length - 1];
  return {factor: 1 / size, label: prefix + superscripts(unit)};
}

function largest(values) {
  let most = 0;
  for (const v of values) if (Math.abs(v) > most) most = Math.abs(v);
  return most;
}

function digits(value, count = 4) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(Math.max(0, count - 2));
  return String(Number(value.toPrecision(Math.max(count, Math.ceil(Math.log10(size))))));
}

// What was not measured (null) is not 0.
function withUnit(value, unit, count = 4) {
  if (!Number.isFinite(value)) return digits(value);
  const shown = unitFor(unit, Math.abs(value));
  return digits(value * shown.factor, count) + (shown.label ? " " + shown.label : "");
}

// Keys set element properties; names with a dash and "role" set attributes.
function element(tag, properties, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties || {})) {
    name.includes("-") || name === "role" ? made.setAttribute(name, value) : made[name] = value;
  }
  made.append(...children);
  return made;
}

// Runs after the layout that caused the resize; not for what is no longer on the page.
const onResize = (host, action) => new ResizeObserver(() => requestAnimationFrame(() => { if (host.isConnected) action(); })).observe(host);
// action(event): true if it uses the key. Keys pressed with Ctrl, Meta or Alt are left to the browser.
const onKey = (host, action) => host.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || !action(event)) return;
  event.preventDefault();
  event.stopPropagation();
});
// Of pictures and charts: + and − zoom, 0 shows all. zoom(factor): of the width that is seen.
function zoomKey(key, zoom, showAll) {
  const factor = {"+": 0.8, "=": 0.8, "-": 1.25}[key];
  if (factor) zoom(factor);
  else if (key === "0") showAll();
  return Boolean(factor) || key === "0";
}
const percent = value => digits(100 * value, 3) + " %";
// "1 run", "2 runs".
const counted = (count, one) => `${count.toLocaleString("en")} ${one}${count === 1 ? "" : "s"}`;
const words = name => name.replaceAll("_", " ");
const titled = name => words(name).replace(/^./, letter => letter.toUpperCase());
const labelled = (name, unit) => unit ? `${name} [${unit}]` : name;

// Round tick values that divide [low, high] into about `count` intervals.
function niceTicks(low, high, count) {
  const rough = (high - low) / count, size = 10 ** Math.floor(Math.log10(rough));
  const step = size * ([1, 2, 5, 10].find(s => s * size >= rough) || 10);
  const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
  return Array.from({length: Math.max(0, last - first + 1)}, (_, i) => (first + i) * step);
}

// Ticks as text, with enough digits to tell neighbours apart.
function tickText(ticks) {
  const most = largest(ticks), step = ticks.length > 1 ? ticks[1] - ticks[0] : most;
  const count = most > 0 ? 2 + Math.round(Math.log10(most / step)) : 0;
  return tick => digits(tick, Math.min(15, Math.max(4, count)));
}
