// The page for converting AFM volts to friction: force curves with fits, loops, friction against load,
// the Monte Carlo distribution and the contributions to its uncertainty.
// Status on <body>: data-ready, data-charts, or data-error.
"use strict";

const QUANTITIES = [
  ["friction", "friction coefficient", "-"], ["friction_of_loops", "mean of the loops, with adhesion", "-"],
  ["adhesion", "adhesion, pull-off", "N"], ["adhesion_of_line", "adhesion, friction at zero load", "N"],
  ["normal_sensitivity", "normal sensitivity", "N/V"], ["lateral_sensitivity", "lateral sensitivity", "N/V"]];

let charts = 0;
function draw(title, spec) {
  drawChart(card(title), spec);
  ++charts;
}

function drawCurves(title, curves, y) {
  if (!curves) return;
  const lines = curves.slice(0, 1).flatMap(curve => [
    {label: "approach", unit: "V", ...curve.approach},
    ...(curve.retract.x.length > 1 ? [{label: "retract", unit: "V", ...curve.retract}] : []),
    {label: "contact line", unit: "V", ...curve.fit, dash: [6, 4]},
    ...(curve.pull_off ? [{label: "pull-off", unit: "V", isMarks: true, x: [curve.pull_off.x],
                           values: [curve.pull_off.value], low: [curve.pull_off.value],
                           high: [curve.pull_off.value]}] : [])]);
  draw(title, {x: {label: "displacement of the piezo", unit: "m", values: []}, y, lines});
}

// The measured loops: trace and retrace at the smallest, a middle and the largest load.
function drawTraces(title, record) {
  const raw = record.loops.filter(loop => loop.traces);
  if (!raw.length) return;
  const chosen = [...new Set([0, raw.length >> 1, raw.length - 1])].map(i => raw[i]);
  const lines = chosen.flatMap((loop, i) => ["trace", "retrace"].map((direction, k) =>
    ({label: `${withUnit(loop.load, record.load_unit, 3)}, ${direction}`, unit: "V", x: loop.traces.position,
      values: loop.traces[direction], hue: i, dash: k ? [5, 3] : undefined})));
  draw(title, {x: {label: record.position_unit ? "position" : "place", unit: record.position_unit, values: []},
               y: "lateral signal", lines});
}

const atDegrees = slope => `${slope > 0 ? "+" : ""}${digits(slope * 180 / Math.PI, 4)}°`;

function leastSquares(x, y) {
  const mean = list => list.reduce((sum, v) => sum + v, 0) / list.length, mx = mean(x), my = mean(y);
  const spread = x.reduce((sum, v) => sum + (v - mx) ** 2, 0);
  const slope = x.reduce((sum, v, i) => sum + (v - mx) * (y[i] - my), 0) / spread;
  const ends = [Math.min(0, ...x), Math.max(...x)];
  return {slope, zero: my - slope * mx, fit: {x: ends, values: ends.map(v => my + slope * (v - mx))}};
}

function drawWedge(record) {
  if (!record) return;
  const slopes = [...new Set(record.loops.map(loop => loop.slope))];
  const lines = slopes.flatMap(slope => ["half_width", "offset"].map(key => {
    const own = record.loops.filter(loop => loop.slope === slope);
    const x = own.map(loop => loop.load), values = own.map(loop => loop[key]);
    const error = own.map(loop => loop.half_width_error || 0);
    return {label: `${atDegrees(slope)}, ${key === "offset" ? "offset Δ" : "half-width W"}`, unit: "V", isMarks: true, x,
            values, low: values.map((v, i) => v - error[i]), high: values.map((v, i) => v + error[i]),
            fit: x.length > 1 && Math.max(...x) > Math.min(...x) ? leastSquares(x, values).fit : undefined};
  }));
  draw("Loops on slopes: half-width and offset against load",
       {x: {label: "load", unit: record.load_unit, values: []}, y: "lateral signal", lines});
}

// Friction against load, down to the zero of the line, which is the adhesion; error bars from the half-widths only.
function drawFriction(summary, record) {
  const x = summary.loops.map(loop => loop.load), values = summary.loops.map(loop => loop.force);
  const error = record.loops.map(loop => (loop.half_width_error || 0) * summary.lateral_sensitivity.value);
  const line = {label: "loops on the sample", unit: "N", isMarks: true, x, values,
                low: values.map((v, i) => v - error[i]), high: values.map((v, i) => v + error[i])};
  if (Math.max(...x) > Math.min(...x)) {
    const {slope, zero} = leastSquares(x, values), ends = [-zero / slope, Math.max(...x)];
    line.fit = {x: ends, values: ends.map(v => zero + slope * v)};
  }
  const lines = [line];
  if (summary.adhesion.value > 0) {
    lines.push({label: "pull-off", unit: "N", isMarks: true, x: [-summary.adhesion.value], values: [0], low: [0], high: [0]});
  }
  draw("Friction against normal load", {x: {label: "normal load", unit: "N", values: []}, y: "friction", lines});
}

function drawHistogram({from, until, counts}, {friction, confidence}, draws) {
  if (!(until > from)) return;
  const wide = (until - from) / counts.length, x = [], values = [];
  counts.forEach((count, i) => {
    x.push(from + i * wide, from + (i + 1) * wide);
    values.push(count / draws / wide, count / draws / wide);
  });
  const top = Math.max(...values);
  const upright = (label, at, dash) => ({label, unit: "-", x: [at, at], values: [0, top], dash});
  draw("Friction coefficient: distribution of the draws",
       {x: {label: "friction coefficient", unit: "-", values: []}, y: "probability density",
        lines: [{label: counted(draws, "draw"), unit: "-", x, values}, upright("value", friction.value),
                upright(`${percent(confidence)} from`, friction.low, [5, 4]),
                upright("to", friction.high, [5, 4])]});
}

// Bars: variance fraction with only one input sampled; tick: fraction by the law of error propagation.
function barsSvg(groups, contributions, colours, width) {
  const left = 210, right = width - 60, tall = 26, height = tall * groups.length + 34;
  const px = share => left + (right - left) * Math.min(1, share);
  const text = (x, y, anchor, content) => `<text x="${x}" y="${y}" text-anchor="${anchor}">${markup(content)}</text>`;
  const out = [`<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
    `viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif" font-size="12" fill="${colours.soft}">`];
  for (const tick of [0, 0.25, 0.5, 0.75, 1]) {
    out.push(`<path d="M${px(tick)} 4V${height - 26}" stroke="${colours.grid}"/>`,
             text(px(tick), height - 10, "middle", `${100 * tick} %`));
  }
  groups.forEach((group, i) => {
    const {share, linear} = contributions[group], y = 6 + tall * i;
    out.push(text(left - 8, y + 15, "end", group),
      `<rect class="bar" x="${left}" y="${y + 3}" width="${Math.max(0.5, px(share) - left).toFixed(1)}" height="15" ` +
      `fill="${colours.lines[0]}"/>`,
      `<path d="M${px(linear).toFixed(1)} ${y + 1}v19" stroke="${colours.lines[1]}" stroke-width="2"/>`,
      text(px(Math.max(share, linear)) + 6, y + 15, "start", percent(share)));
  });
  return out.join("") + "</svg>";
}

function drawBars(groups, {friction}) {
  const title = "Contributions to the uncertainty of the friction coefficient", host = card(title);
  const shown = groups.filter(group => friction.contributions[group].share > 0 || friction.contributions[group].linear > 0);
  const plot = element("div", {className: "bars", role: "img", "aria-label": title});
  host.append(element("div", {className: "scroll"}, plot), element("p", {className: "note", textContent:
    "Bar: variance with only that input drawn, relative to that with all inputs drawn. Tick: the same by the law of propagation of uncertainty."}));
  const svg = (colours, width) => barsSvg(shown, friction.contributions, colours, width);
  const redraw = () => { plot.innerHTML = svg(theme(), Math.max(380, host.clientWidth)); };
  redraw();
  onResize(host, redraw);
  onTheme(redraw);
  host.parentElement.querySelector(".card-head").append(saveButtons(title, {
    SVG: () => saveText(fileName("contributions") + ".svg", svg(LIGHT, 640), "image/svg+xml")}));
  ++charts;
}

function fillResults(summary) {
  const table = document.getElementById("results"), level = percent(summary.confidence);
  addRow(table, ["", "value", "standard uncertainty", `${level} from`, "to", "by the law of propagation"], true);
  const shown = QUANTITIES.filter(([key]) => summary[key]).map(([key, name, unit]) => [summary[key], name, unit]);
  summary.loops.forEach((loop, i) => shown.push([summary[`friction_of_loop_${i + 1}`],
    `friction of the loop at ${withUnit(loop.load, "N", 3)}`, "-"]));
  for (const [known, name, unit] of shown) {
    const {factor, label} = unitFor(unit, Math.abs(known.value)), of = (v, n) => digits(v * factor, n);
    addRow(table, [labelled(name, label), of(known.value), of(known.error, 2), of(known.low), of(known.high), of(known.linear_error, 2)]);
  }
  document.getElementById("results-note").textContent =
    `${counted(summary.draws, "draw")} of all inputs from normal distributions (seed ${summary.seed})` +
    (summary.failed_draws ? `; ${summary.failed_draws} gave no valid friction and were left out.` : ".");
}

function fillContributions(groups, summary) {
  const table = document.getElementById("contributions"), shown = QUANTITIES.filter(([key]) => summary[key]);
  addRow(table, ["", ...shown.map(([, name]) => name)], true);
  const counts = group => shown.some(([key]) => summary[key].contributions[group].linear > 0);
  for (const group of groups.filter(counts)) {
    addRow(table, [group, ...shown.map(([key]) => {
      const {share, linear} = summary[key].contributions[group];
      return share || linear ? `${percent(share)} (${percent(linear)})` : "–";
    })]);
  }
}

function fillTables({summary, groups, loops}) {
  fillResults(summary);
  fillContributions(groups, summary);
  const table = document.getElementById("loops");
  addRow(table, ["load", "half-width", "offset", "friction", "F/(L + A)"], true);
  summary.loops.forEach((loop, i) => {
    const raw = loops.loops[i];
    addRow(table, [withUnit(loop.load, "N"), measured({value: raw.half_width, error: raw.half_width_error}, "V"),
                   withUnit(raw.offset, "V"), withUnit(loop.force, "N"), measured(summary[`friction_of_loop_${i + 1}`])]);
  });
  const curves = document.getElementById("force-curves");
  addRow(curves, ["surface", "curve", "slope, approach [V/nm]", "slope, retract [V/nm]", "curvature", "pull-off", "pull-off work", "crosstalk"], true);
  const perNm = known => known ? withSpread(known.value * 1e-9, known.error, 1e-9) : "–";
  for (const [surface, set] of Object.entries(summary.force_curves)) {
    for (const one of set.curves) {
      addRow(curves, [surface, one.curve, perNm(one.approach), perNm(one.retract), percent(one.curvature),
                      withUnit(one.pull_off_force, "N"), withUnit(one.pull_off_work, "J"), measured(one.crosstalk)]);
    }
  }
  const inputs = document.getElementById("inputs");
  addRow(inputs, ["group", "input", "value", "standard uncertainty", "unit"], true);
  for (const {group, name, value, error, unit} of summary.inputs) addRow(inputs, [group, name, digits(value, 5), digits(error, 2), unit]);
}

function fillTiles(summary) {
  const tile = (name, value, note) => document.getElementById("tiles").append(element("div", {className: "tile"},
    element("dt", {textContent: name}), element("dd", {textContent: value}), element("small", {textContent: note})));
  const {friction, confidence} = summary;
  tile("friction coefficient", measured(friction), `${percent(confidence)}: ${digits(friction.low)} to ${digits(friction.high)}`);
  tile("adhesion", measured(summary.adhesion, "N"), "pull-off of the force curves");
  tile("normal sensitivity", measured(summary.normal_sensitivity, "N/V"), "k_n over the slope of force curves");
  tile("lateral sensitivity", measured(summary.lateral_sensitivity, "N/V"),
       summary.lateral === "wedge" ? "loops on slopes" : "test probe");
  if (summary.with_other_root) {
    const {friction: other, lateral_sensitivity: sensitivity} = summary.with_other_root;
    tile("or else, friction coefficient", measured(other), `with ${measured(sensitivity, "N/V")}: the loops on slopes fit both`);
  }
  if (summary.crosstalk) tile("crosstalk", measured(summary.crosstalk), "of the normal signal, removed");
}

function main() {
  const head = JSON.parse(document.getElementById("head").textContent), {summary} = head;
  document.getElementById("lead").textContent = `${counted(summary.loops.length, "friction loop")} on the sample from ${head.loops.file}, ` +
    `${counted(summary.force_curves.hard.curves.length, "force curve")} on a hard surface, ` +
    (head.wedge ? `${counted(head.wedge.loops.length, "loop")} on slopes.` : "side contacts of a test probe.");
  document.getElementById("version").textContent = `Version ${summary.version} (${summary.commit}).`;
  document.getElementById("settings-text").textContent = head.settings;
  fillTiles(summary);
  fillTables(head);
  drawFriction(summary, head.loops);
  drawBars(head.groups, summary);
  drawHistogram(head.histogram, summary, summary.draws - summary.failed_draws);
  drawTraces("Friction loops on the sample", head.loops);
  drawCurves("Force curve on the hard surface", head.hard, "normal signal");
  drawCurves("Force curve on the sample", head.sample, "normal signal");
  drawWedge(head.wedge);
  drawCurves("Side contact of the test probe", head.side, "lateral signal");
  document.body.dataset.charts = charts;
  document.body.dataset.ready = "1";
}

main();
