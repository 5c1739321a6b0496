// The curves. A chart is {x, y, lines}: x and each line are {label, unit, values}, values in SI; y
// is what stands at the axis.
"use strict";

const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7",
                 "#e69f00", "#56b4e9", "#555555", "#8c6d1f"];

const isSorted = values => values.every((v, i) => i === 0 || v >= values[i - 1]);
const scaled = (values, factor) => Array.from(values, v => Number.isFinite(v) ? v * factor : null);

// A framed place for one chart, under its title and, where given, its controls.
function card(title, ...controls) {
  const box = element("div", {className: "card"}), host = element("div", {});
  box.append(element("h2", {textContent: title}), ...controls, host);
  document.getElementById("curves").append(box);
  return host;
}

function axis(label, size) {
  return {label, size, labelSize: 20, labelGap: 2,
          labelFont: "13px sans-serif", font: "12px sans-serif", stroke: "#5b6775",
          grid: {stroke: "#e8ecf1", width: 1}, ticks: {stroke: "#c4cdd8", size: 5}};
}

// Curves whose x turns back (unloading, a shear loop): drawn in the order of time.
function drawInOrder(u, index) {
  const [xs, ys] = u.data[index], line = new Path2D();
  let pen = false;
  xs.forEach((x, i) => {
    if (x === null || ys[i] === null) { pen = false; return; }
    const at = [u.valToPos(x, "x", true), u.valToPos(ys[i], "y", true)];
    pen ? line.lineTo(...at) : line.moveTo(...at);
    pen = true;
  });
  const {left, top, width, height} = u.bbox, ctx = u.ctx;
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, width, height);
  ctx.clip();
  ctx.strokeStyle = u.series[index].stroke();
  ctx.lineWidth = 2 * devicePixelRatio;
  ctx.stroke(line);
  ctx.restore();
  return null;
}

const bounds = lists => lists.flat().reduce(
  ([low, high], v) => v === null ? [low, high] : [Math.min(low, v), Math.max(high, v)],
  [Infinity, -Infinity]);

function withMargin([low, high], share) {
  if (!(low <= high) || (low === 0 && high === 0)) return [0, 1];
  const margin = (high - low) * share || Math.abs(high) * 0.1 || 1;
  return [low === 0 ? 0 : low - margin, high === 0 ? 0 : high + margin];
}

const legendValue = (u, v) => v === null || v === undefined ? "–" : digits(v);

function chartOptions(host, x, y, lines) {
  const width = Math.max(300, host.clientWidth);
  return {width, height: 300, padding: [10, 12, 0, 0], axes: [axis(x, 32), axis(y, 50)],
          cursor: {drag: {x: true, y: true, uni: 20}},
          series: [{label: x, value: legendValue}, ...lines.map((line, i) =>
            ({label: line.label, stroke: line.colour || COLOURS[i % COLOURS.length],
              dash: line.dash, width: 2,
              points: {show: false}, value: legendValue}))]};
}

// Keeps a chart as wide as its place.
function fitted(plot, host) {
  new ResizeObserver(() => {
    const width = host.clientWidth;
    if (width > 0 && width !== plot.width) plot.setSize({width, height: plot.height});
  }).observe(host);
  return plot;
}

function drawChart(host, {x, y, lines}) {
  const xUnit = unitFor(x.unit, largest(x.values)), unit = lines[0].unit;
  const yUnit = unitFor(unit, Math.max(...lines.map(line => largest(line.values))));
  const xs = scaled(x.values, xUnit.factor), ys = lines.map(l => scaled(l.values, yUnit.factor));
  const xLabel = labelled(x.label, xUnit.label), yLabel = labelled(y, yUnit.label);
  const options = chartOptions(host, xLabel, yLabel, lines);
  options.scales = {x: {time: false, range: (u, low, high) => [low, high]}};
  if (isSorted(xs)) return fitted(new uPlot(options, [xs, ...ys], host), host);
  const xRange = withMargin(bounds([xs]), 0.02), yRange = withMargin(bounds(ys), 0.05);
  options.mode = 2;
  options.scales = {x: {time: false, range: xRange}, y: {range: yRange}};
  options.legend = {live: false};
  options.cursor = {drag: {x: false, y: false}, points: {show: false}};
  options.series = [null, ...options.series.slice(1).map(s => ({...s, paths: drawInOrder}))];
  return fitted(new uPlot(options, [null, ...ys.map(values => [xs, values])], host), host);
}

// Which curves a run has: each place... function makes a place and returns what draws into it.

const timeAxis = history => ({label: "time", unit: "s", values: history.get("time").values});

// Punches that move: how far each has come, as an x axis beside time.
function travels(history) {
  const found = [];
  for (const name of history.keys()) {
    const tool = (name.match(/^tool\/(.+)\/position_y$/) || [])[1];
    if (!tool || !history.has(`tool/${tool}/position_x`)) continue;
    const xs = history.get(`tool/${tool}/position_x`).values, ys = history.get(name).values;
    const values = xs.map((x, i) => Math.hypot(x - xs[0], ys[i] - ys[0]));
    if (largest(values) > 0) found.push({label: `travel of ${tool}`, unit: "m", values});
  }
  return found;
}

// Forces worth a curve: at least 1 % of the largest. One that pulls down mostly is shown turned
// over, and says so, so that both punches can be compared.
function forceLines(history) {
  const forces = [...history.values()].filter(s => /^tool\/.+\/force_[xyz]$/.test(s.name));
  const most = Math.max(0, ...forces.map(s => largest(s.values)));
  return forces.filter(s => most > 0 && largest(s.values) >= 0.01 * most).map(s => {
    const [, tool, along] = s.name.match(/^tool\/(.+)\/force_([xyz])$/);
    const turned = -Math.min(...s.values) > Math.max(...s.values);
    return {label: `${tool}, ${turned ? "−" : ""}F${along}`, unit: s.unit,
            values: turned ? s.values.map(v => -v) : s.values};
  });
}

function placeForces(history) {
  const lines = forceLines(history);
  if (!lines.length) return null;
  const choices = [timeAxis(history), ...travels(history)];
  const select = element("select", {}), label = element("label", {});
  const controls = element("div", {className: "controls"});
  choices.forEach((choice, i) => select.add(new Option(choice.label, i)));
  label.append("against ", select);
  controls.append(label);
  const host = card("Forces on the tools", controls);
  select.onchange = () => {
    host.replaceChildren();
    drawChart(host, {x: choices[select.value], y: "force", lines});
  };
  return select.onchange;
}

function placeStressRatio(history) {
  const names = ["axial", "lateral"].filter(name => history.has(`stress_ratio/${name}`));
  if (!names.length) return null;
  const density = history.get("relative_density");
  const x = density ? {label: "relative density", unit: "-", values: density.values}
                    : timeAxis(history);
  const lines = names.map(label => ({...history.get(`stress_ratio/${label}`), label}));
  const host = card(`Stress over yield stress against ${x.label}`);
  return () => drawChart(host, {x, y: "stress ratio σ / σy", lines});
}

function placeEnergies(history) {
  const lines = [...history.values()]
    .filter(s => s.name.startsWith("energy/") && largest(s.values) > 0)
    .map(s => ({...s, label: s.name.slice("energy/".length)}));
  if (!lines.length) return null;
  const host = card("Energies");
  return () => drawChart(host, {x: timeAxis(history), y: "energy", lines});
}

function placeAnySeries(history) {
  const names = [...history.keys()].filter(name => name !== "time");
  if (!names.length) return null;
  document.getElementById("any-section").hidden = false;
  const select = document.getElementById("any"), host = document.getElementById("any-chart");
  names.forEach(name => select.add(new Option(name, name)));
  select.value = history.has("relative_density") ? "relative_density" : names[0];
  select.onchange = () => {
    const series = {...history.get(select.value), label: select.value};
    document.getElementById("any-note").textContent = series.meaning;
    host.replaceChildren();
    drawChart(host, {x: timeAxis(history), y: series.name, lines: [series]});
  };
  return select.onchange;
}

// First all places, then the charts: a chart takes the width its place has at the end.
function drawCharts(history) {
  if (!history.get("time").values.length) return;
  const charts = [placeForces, placeStressRatio, placeEnergies, placeAnySeries];
  for (const draw of charts.map(place => place(history))) if (draw) draw();
}
