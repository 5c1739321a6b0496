// The report of a probe: yield surfaces, moduli and parameters against density, and what the points do not determine.
// Status on <body>: data-ready, data-points (count) and data-drawn-lines, or data-error.
"use strict";

const CRITERIA = {dissipation: head => `${percent(head.dissipation)} of the pressure is dissipated per volume`,
                  offset_strain: head => `the plastic strain is ${digits(head.offset_strain)}`};
const DEGREES = 180 / Math.PI;
const CAP = "drucker_prager_cap", CLAY = "modified_cam_clay";

const densityText = state => digits(state.relative_density, 3);
const statesOf = (head, path) => head.states.filter(state => state.path === path);
const pathsOf = head => [...new Set(head.states.map(({path}) => path))];
const modelOf = (state, criterion, name) => state.yield[criterion].models.find(model => model.name === name);
const reportOf = (run, text) => element("a", {textContent: text, href: `${encodeURIComponent(run)}/report.html`});

const marks = (label, unit, x, values, more = {}) => ({label, unit, x, values, low: values, high: values, isMarks: true, ...more});

function surfaceLines(head, path, criterion) {
  return statesOf(head, path).flatMap((state, hue) => {
    const {points} = state.yield[criterion], clay = modelOf(state, criterion, CLAY), cap = modelOf(state, criterion, CAP);
    const curve = model => ({x: model.surface.map(([p]) => p), values: model.surface.map(([, q]) => q)});
    return [marks(`density ${densityText(state)}`, "Pa", points.map(({p}) => p), points.map(({q}) => q), {hue, fit: cap && curve(cap)}),
            ...clay ? [{label: `${densityText(state)}, Cam-Clay`, unit: "Pa", hue, dash: [5, 4], ...curve(clay)}] : []];
  }).filter(line => line.values.length);
}

const stressLines = (head, path, criterion) => statesOf(head, path).map((state, hue) => {
  const {points} = state.yield[criterion];
  return marks(`density ${densityText(state)}`, "Pa", points.map(({stress}) => -stress[0]), points.map(({stress}) => -stress[1]), {hue});
}).filter(line => line.values.length);

function meanOf(values) {
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const deviation = values.length > 1 ? Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / (values.length - 1)) : 0;
  return {mean, deviation};
}
const modulus = (state, key) => meanOf(state.states.map(one => one[key]));
const parameter = (state, criterion, name, key) => {
  const model = modelOf(state, criterion, name);
  return model ? {mean: model.parameters[key], deviation: model.scatter[key]?.deviation ?? 0} : null;
};

// A value against density, one line per path: points with the standard deviation over seeds, joined.
function againstDensity(head, title, y, unit, values) {
  const lines = pathsOf(head).flatMap((path, hue) => values.map(([name, of], k) => {
    const states = statesOf(head, path).filter(of), x = states.map(state => state.relative_density), found = states.map(of);
    const means = found.map(({mean}) => mean), ends = sign => found.map(({mean, deviation}) => mean + sign * deviation);
    return {label: [path, name].filter(Boolean).join(", "), unit, x, values: means, low: ends(-1), high: ends(1), isMarks: true,
            hue: hue * values.length + k, fit: {x, values: means}};
  })).filter(line => line.values.length);
  return {title, x: {label: "relative density", unit: "-", values: []}, y, lines};
}

function chartsOf(head, criterion) {
  const of = (name, key) => state => parameter(state, criterion, name, key), surfaces = pathsOf(head).flatMap(path => [
    {title: `Yield surfaces: ${path}`, x: {label: "pressure p", unit: "Pa", values: []}, y: "von Mises stress q",
     lines: surfaceLines(head, path, criterion), note: "Points: yield points, q > 0: compressed more along y. Solid: Drucker–Prager cap, dashed: modified Cam-Clay, fitted to q > 0."},
    {title: `Stresses at yield: ${path}`, x: {label: "pressure along x", unit: "Pa", values: []}, y: "pressure along y",
     lines: stressLines(head, path, criterion)}]);
  return [...surfaces,
    againstDensity(head, "Young's modulus", "Young's modulus E", "Pa", [["", state => modulus(state, "youngs_modulus")]]),
    againstDensity(head, "Poisson's ratio", "Poisson's ratio ν", "-", [["", state => modulus(state, "poissons_ratio")]]),
    againstDensity(head, "Hardening: pressures of the caps", "yield pressure", "Pa", [["p_b, cap", of(CAP, "p_b")], ["p_c, Cam-Clay", of(CLAY, "p_c")]]),
    againstDensity(head, "Shape of the surfaces", "eccentricity R, slope M", "-", [["R, cap", of(CAP, "R")], ["M, Cam-Clay", of(CLAY, "M")]])]
    .filter(chart => chart.lines.length);
}

function fillParameters(head, criterion) {
  const {states} = head, isOpen = (state, name, key) => modelOf(state, criterion, name)?.not_determined.includes(key);
  const column = (title, unit, name, key, factor = 1) => {
    const cells = states.map(state => {
      const found = parameter(state, criterion, name, key);
      return found && {mean: found.mean * factor, deviation: found.deviation > 0 ? found.deviation * factor : undefined};
    });
    const {title: head, cells: texts} = shownColumn({title, unit, cells});
    return {title: head, cells: texts.map((text, i) => isOpen(states[i], name, key) ? `${text} *` : text)};
  };
  const spread = key => states.map(state => { const {mean, deviation} = modulus(state, key); return {mean, deviation: deviation || undefined}; });
  const misfit = name => states.map(state => { const model = modelOf(state, criterion, name); return model ? percent(model.misfit) : null; });
  fillColumns(document.getElementById("parameters"), [
    {title: "path", cells: states.map(({path}) => path)}, {title: "density", cells: states.map(densityText)},
    {title: "E", unit: "Pa", cells: spread("youngs_modulus")}, {title: "ν", unit: "-", cells: spread("poissons_ratio")},
    {title: "points in the fit", cells: states.map(state => { const {points} = state.yield[criterion]; return `${points.filter(({fitted}) => fitted).length} of ${points.length}`; })},
    column("d", "Pa", CAP, "d"), column("β [°]", "-", CAP, "beta", DEGREES), column("R", "-", CAP, "R"), column("p_b", "Pa", CAP, "p_b"),
    {title: "off", cells: misfit(CAP)}, column("M", "-", CLAY, "M"), column("p_c", "Pa", CLAY, "p_c"), {title: "off", cells: misfit(CLAY)}]);
}

const MODELS = {[CAP]: "Drucker–Prager cap", [CLAY]: "modified Cam-Clay"};
const PRESSURES = ["d", "p_b", "p_c", "p_a"];

function fillOpen(head, criterion) {
  const rows = head.states.flatMap(state => Object.keys(MODELS).flatMap(name => {
    const model = modelOf(state, criterion, name);
    const told = (key, value) => value === null ? "no bound" : key === "beta" ? `${digits(value * DEGREES, 3)}°` : withUnit(value, PRESSURES.includes(key) ? "Pa" : "-", 3);
    return (model?.not_determined || []).map(key => [state.path, densityText(state), MODELS[name], key === "beta" ? "β" : key,
      told(key, model.parameters[key]), told(key, model.ranges[key][0]), told(key, model.ranges[key][1])]);
  }));
  document.getElementById("open-section").hidden = !rows.length;
  if (rows.length) fillTexts("open", ["path", "density", "model", "parameter", "fitted", "from", "to"], rows);
}

function fillStates(head) {
  const all = head.states.flatMap(state => state.states.map(one => ({...one, path: state.path})));
  fillColumns(document.getElementById("states"), [
    {title: "loading run", cells: all.map(({run}) => reportOf(run, run))},
    {title: "density", cells: all.map(densityText)}, {title: "seed", cells: all.map(({seed}) => String(seed))},
    {title: "pressure", unit: "Pa", cells: all.map(({pressure}) => pressure)},
    ...["c11", "c12", "c22"].map(key => ({title: key, unit: "Pa", cells: all.map(one => one[key])})),
    {title: "G", unit: "Pa", cells: all.map(one => one.shear_modulus)},
    {title: "E", unit: "Pa", cells: all.map(one => one.youngs_modulus)}, {title: "ν", unit: "-", cells: all.map(one => one.poissons_ratio)},
    {title: "in springs", cells: all.map(one => one.released_by_springs === undefined ? "–" : percent(one.released_by_springs))}]);
}

function fillPoints(head, criterion) {
  const all = head.states.flatMap(state => state.yield[criterion].points.map(point => ({...point, path: state.path, density: densityText(state)})));
  document.getElementById("points-section").hidden = !all.length;
  document.body.dataset.points = all.length;
  if (!all.length) return;
  const of = (title, pick) => ({title, unit: "Pa", cells: all.map(pick)});
  fillColumns(document.getElementById("points"), [
    {title: "direction", cells: all.map(({run, direction}) => reportOf(run, `${digits(direction * DEGREES)}°`))},
    {title: "path", cells: all.map(({path}) => path)}, {title: "density", cells: all.map(({density}) => density)},
    of("p", ({p}) => p), of("q", ({q}) => q), of("σxx", ({stress}) => stress[0]), of("σyy", ({stress}) => stress[1]), of("σzz", ({stress}) => stress[3]),
    {title: "plastic strain along x, y", cells: all.map(({plastic}) => plastic.map(value => digits(value, 3)).join(", "))},
    {title: "off the normal", cells: all.map(one => one.angle_to_normal === undefined ? "–" : `${digits(one.angle_to_normal * DEGREES, 3)}°`)},
    {title: "in the fit", cells: all.map(({fitted}) => fitted ? "yes" : "no")}]);
}

function leadText(head) {
  const points = criterion => head.states.reduce((sum, state) => sum + state.yield[criterion].points.length, 0);
  return `${counted(pathsOf(head).length, "loading path")}, ${counted(head.states.length, "state")}: ` +
    `${counted(points("dissipation"), "yield point")} by dissipated energy, ${points("offset_strain")} by plastic strain. Version ${head.version} (${head.commit}).`;
}

function main() {
  const head = JSON.parse(document.getElementById("head").textContent), choice = document.getElementById("criterion");
  document.getElementById("lead").textContent = leadText(head);
  placeSettings(document.getElementById("settings"), new Set(["Pa"]), false);
  Object.entries(CRITERIA).forEach(([name, told]) => choice.add(new Option(told(head), name)));
  const fillTables = () => [fillParameters, fillOpen, fillStates, fillPoints].forEach(fill => fill(head, choice.value));
  const show = () => {
    document.getElementById("curves").replaceChildren();
    const charts = chartsOf(head, choice.value), hosts = charts.map(chart => card(chart.title));
    charts.forEach((chart, i) => {
      drawChart(hosts[i], chart, {height: 340});
      if (chart.note) hosts[i].parentElement.append(element("p", {className: "note", textContent: chart.note}));
    });
    document.body.dataset.drawnLines = charts.reduce((sum, {lines}) => sum + lines.length, 0);
    fillTables();
  };
  choice.onchange = show;
  show();
  onUnits(fillTables);
  document.body.dataset.ready = "1";
}

main();
