// The report of a probe: yield surfaces, moduli and parameters against density, and what the points do not determine.
// Status on <body>: data-ready, data-points (count), data-drawn-lines and in three dimensions data-shells (nets drawn), or
// data-error.
"use strict";

const CRITERIA = {dissipation: head => `${percent(head.dissipation)} of the pressure is dissipated per volume`,
                  offset_strain: head => `the plastic strain is ${digits(head.offset_strain)}`};
const DEGREES = 180 / Math.PI;
const CAP = "drucker_prager_cap", CLAY = "modified_cam_clay", TURNED = "s_clay";
const MODELS = {[CAP]: "Drucker–Prager cap", [CLAY]: "modified Cam-Clay", [TURNED]: "S-CLAY1", fleck_kuhn_mcmeeking: "Fleck–Kuhn–McMeeking",
                gurson: "Gurson", fleck_plane: "Fleck, no cohesion", fleck_plane_cohesive: "Fleck, full cohesion"};
const DASHED = {[CLAY]: [5, 4], [TURNED]: [2, 3]};
const ROUND_OFF = 1e-8;  // of the largest value
const STRESSES = ["xx", "yy", "zz", "xy", "yz", "zx"];

const densityText = state => digits(state.relative_density, 3);
const statesOf = (head, path) => head.states.filter(state => state.path === path);
const pathsOf = head => [...new Set(head.states.map(({path}) => path))];
const pointsOf = (state, criterion) => state.yield[criterion].points;
const modelOf = (state, criterion, name) => state.yield[criterion].models.find(model => model.name === name);
const reportOf = (run, text) => element("a", {textContent: text, href: `${encodeURIComponent(run)}/report.html`});
const isInSpace = ({dimension}) => dimension === 3;
const degreesText = angle => `${digits(angle * DEGREES)}°`;

// The axis of pressing, and its place among the components.
const axisOf = state => isInSpace(state) ? "z" : "y";
const alongAxis = (state, parts) => parts[isInSpace(state) ? 2 : 1];

// "direction 30°", "Lode angle 60°", "shear yz", or the name given in the probe file.
const directionText = ({set, direction, angle}) => set === "axial" ? `direction ${degreesText(angle)}`
  : set === "deviatoric" ? `Lode angle ${degreesText(angle)}` : set === "shear" ? words(direction) : direction;

const marks = (label, unit, x, values, more = {}) => ({label, unit, x, values, low: values, high: values, isMarks: true, ...more});
const paler = hue => { const {lines} = theme(); return lines[hue % lines.length] + "66"; };

function surfaceLines(head, path, criterion) {
  return statesOf(head, path).flatMap((state, hue) => {
    const density = densityText(state), curve = ({surface}) => ({x: surface.map(([p]) => p), values: surface.map(([, q]) => q)});
    const of = (label, isFitted, more) => {
      const found = pointsOf(state, criterion).filter(({fitted}) => fitted === isFitted);
      return marks(label, "Pa", found.map(({p}) => p), found.map(({q}) => q), more);
    };
    const cap = modelOf(state, criterion, CAP), others = [CLAY, TURNED].map(name => modelOf(state, criterion, name)).filter(Boolean);
    return [of(`density ${density}`, true, {hue, fit: cap && curve(cap)}), of(`${density}, other points`, false, {colour: paler(hue)}),
            ...others.map(model => ({label: `${density}, ${MODELS[model.name].replace("modified ", "")}`, unit: "Pa", hue,
                                     dash: DASHED[model.name], ...curve(model)}))];
  }).filter(line => line.values.length);
}

// p and q of a surface in the plane of the axis, as pressures across and along it.
const inAxialPlane = ([p, q]) => [Math.SQRT2 * (p - q / 3), p + 2 * q / 3];

const stressLines = (head, path, criterion) => statesOf(head, path).flatMap((state, hue) => {
  const found = pointsOf(state, criterion).filter(({set}) => set === "axial"), turned = isInSpace(state) && modelOf(state, criterion, TURNED);
  const surface = turned ? turned.surface.map(inAxialPlane) : [];
  return [marks(`density ${densityText(state)}`, "Pa", found.map(({across_along: [x]}) => x), found.map(({across_along: [, y]}) => y), {hue}),
          {label: `${densityText(state)}, S-CLAY1`, unit: "Pa", hue, dash: DASHED[TURNED], x: surface.map(([x]) => x), values: surface.map(([, y]) => y)}];
}).filter(line => line.values.length);

// A value against density, one line per path: points with the standard deviation over seeds, joined.
function againstDensity(head, title, y, unit, values) {
  const lines = pathsOf(head).flatMap((path, hue) => values.map(([name, of], k) => {
    const states = statesOf(head, path).filter(of), x = states.map(state => state.relative_density), found = states.map(of);
    const means = found.map(({mean}) => mean), ends = sign => found.map(({mean, deviation}) => mean + sign * (deviation || 0));
    return {label: [path, name].filter(Boolean).join(", "), unit, x, values: means, low: ends(-1), high: ends(1), isMarks: true,
            hue: hue * values.length + k, fit: {x, values: means}};
  })).filter(line => line.values.length);
  return {title, x: {label: "relative density", unit: "-", values: []}, y, lines};
}

// Mean and standard deviation over the seeds; null: no seed has it.
function modulus(state, pick) {
  const values = state.states.map(pick).filter(Number.isFinite), mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const squares = values.reduce((sum, value) => sum + (value - mean) ** 2, 0);
  return values.length ? {mean, deviation: values.length > 1 ? Math.sqrt(squares / (values.length - 1)) : undefined} : null;
}

// Null: not fitted, or not determined by the points.
function parameter(state, criterion, name, key) {
  const model = modelOf(state, criterion, name), mean = model?.parameters[key];
  return Number.isFinite(mean) ? {mean, deviation: model.scatter[key]?.deviation} : null;
}

function pathCharts(head, path, criterion) {
  const states = statesOf(head, path), inSpace = isInSpace(states[0]), isFitted = states.some(state => modelOf(state, criterion, CAP));
  return [
    {title: `Yield surfaces: ${path}`, x: {label: "pressure p", unit: "Pa", values: []}, y: "von Mises stress q",
     lines: surfaceLines(head, path, criterion), note: `q > 0: compressed more along ${inSpace ? "z" : "y"}.` + (!isFitted ? "" : " Solid: Drucker–Prager " +
       "cap, dashed: modified Cam-Clay, both fitted to the points of full colour; dotted: turned ellipsoid (S-CLAY1) in the plane of the axis, " +
       "fitted to the others too, but those of low pressure.")},
    {title: `Stresses at yield: ${path}`, isEqual: true, x: {label: inSpace ? "√2 × lateral pressure" : "pressure along x", unit: "Pa", values: []},
     y: `pressure along ${inSpace ? "z" : "y"}`, lines: stressLines(head, path, criterion),
     note: inSpace ? `Directions in the plane of the axis (Rendulic plane).${isFitted ? " Dotted: S-CLAY1." : ""}` : ""},
    ...inSpace ? [deviatoricChart(head, path, criterion)] : []];
}

function chartsOf(head, criterion) {
  const of = (name, key) => state => parameter(state, criterion, name, key), mean = pick => state => modulus(state, pick);
  const shapes = [["R, cap", of(CAP, "R")], ["M, Cam-Clay", of(CLAY, "M")], ["M, S-CLAY1", of(TURNED, "M")], ["α, S-CLAY1", of(TURNED, "alpha")]];
  const pressures = [["p_b, cap", of(CAP, "p_b")], ["p_c, Cam-Clay", of(CLAY, "p_c")], ["p_c, S-CLAY1", of(TURNED, "p_c")],
                     ["p_t, S-CLAY1", of(TURNED, "p_t")]];
  const axes = [...new Set(head.states.map(axisOf))].map(axis => axis + axis).join(", ");
  return [...pathsOf(head).flatMap(path => pathCharts(head, path, criterion)),
    againstDensity(head, "Young's modulus", "Young's modulus E", "Pa", [["", mean(one => one.youngs_modulus)]]),
    againstDensity(head, "Poisson's ratio", "Poisson's ratio ν", "-", [["", mean(one => one.poissons_ratio)]]),
    againstDensity(head, "Hardening: pressures of the surfaces", "yield pressure", "Pa", pressures.filter(([, has]) => head.states.some(has))),
    againstDensity(head, "Shape of the surfaces", "R, M, α", "-", shapes.filter(([, has]) => head.states.some(has))),
    againstDensity(head, "Anisotropy of the stiffness", "distance to isotropy", "-", [["", mean(one => one.off?.isotropic)]]),
    againstDensity(head, "Coordination number", "coordination number Z", "-", [["", mean(one => one.coordination)]]),
    againstDensity(head, "Fabric", `fabric ${axes}`, "-", [["", state => modulus(state, one => alongAxis(state, one.fabric))]])]
    .filter(chart => chart.lines.length);
}

// Columns of which at least one cell has a value.
const filled = columns => columns.filter(({cells}) => cells.some(cell => cell !== null && cell !== undefined && !Number.isNaN(cell)));

function fillParameters(head, criterion) {
  const {states} = head, spread = pick => states.map(state => modulus(state, pick)), has = name => states.some(state => modelOf(state, criterion, name));
  const scaled = (found, factor) => found && {mean: found.mean * factor, deviation: found.deviation > 0 ? found.deviation * factor : undefined};
  const column = (title, unit, name, key, factor = 1) =>
    states.some(state => key in (modelOf(state, criterion, name)?.parameters || {}))
      ? [{title, unit, cells: states.map(state => scaled(parameter(state, criterion, name, key), factor))}] : [];
  const misfit = (title, name) => has(name) ? [{title, cells: states.map(state => {
    const model = modelOf(state, criterion, name);
    return model ? percent(model.misfit) : null;
  })}] : [];
  const counts = (title, key) => ({title, cells: states.map(state => {
    const points = pointsOf(state, criterion);
    return `${points.filter(point => point[key]).length} of ${points.length}`;
  })});
  fillColumns(document.getElementById("parameters"), [
    {title: "path", cells: states.map(({path}) => path)}, {title: "density", cells: states.map(densityText)},
    {title: "E", unit: "Pa", cells: spread(one => one.youngs_modulus)}, {title: "ν", unit: "-", cells: spread(one => one.poissons_ratio)},
    counts("points fitted", "fitted"), column("d, cap", "Pa", CAP, "d"), column("β, cap [°]", "-", CAP, "beta", DEGREES),
    column("R, cap", "-", CAP, "R"), column("p_b, cap", "Pa", CAP, "p_b"), misfit("off, cap", CAP),
    column("M, Cam-Clay", "-", CLAY, "M"), column("p_c, Cam-Clay", "Pa", CLAY, "p_c"), misfit("off, Cam-Clay", CLAY),
    counts("points fitted, S-CLAY1", "fitted_in_stresses"), column("M, S-CLAY1", "-", TURNED, "M"), column("p_c, S-CLAY1", "Pa", TURNED, "p_c"),
    column("α, S-CLAY1", "-", TURNED, "alpha"), column("p_t, S-CLAY1", "Pa", TURNED, "p_t"), misfit("off, S-CLAY1", TURNED)].flat()
    .map(one => ({...one, title: one.title.replaceAll("-", "\u2011")})));  // names of models stay on one line
}

const SYMBOLS = {beta: "β", alpha: "α", sigma_y: "σ_y"}, PRESSURES = ["d", "p_b", "p_c", "p_a", "p_t", "p_y", "sigma_y"];

function fillOpen(head, criterion) {
  const told = (key, value) => value === null ? "no bound" : key === "beta" ? degreesText(value) : withUnit(value, PRESSURES.includes(key) ? "Pa" : "-", 3);
  const rows = head.states.flatMap(state => state.yield[criterion].models.flatMap(({name, not_determined, ranges}) =>
    not_determined.map(key => [state.path, densityText(state), MODELS[name] || words(name), SYMBOLS[key] || key, ...ranges[key].map(end => told(key, end))])));
  document.getElementById("open-section").hidden = !rows.length;
  if (rows.length) fillTexts("open", ["path", "density", "model", "parameter", "from", "to"], rows);
}

// The states of all seeds, with what they share.
const seedsOf = head => head.states.flatMap(state => state.states.map(one => ({...one, path: state.path, dimension: state.dimension})));

function fillStates(head) {
  const all = seedsOf(head), of = (title, pick, unit = "-") => ({title, unit, cells: all.map(one => pick(one) ?? null)});
  const fabric = axis => of(`fabric ${axis}${axis}`, one => axisOf(one) === axis ? alongAxis(one, one.fabric) : null);
  const shares = (title, pick) => ({title, cells: all.map(one => { const share = pick(one); return Number.isFinite(share) ? percent(share) : null; })});
  fillColumns(document.getElementById("states"), filled([
    {title: "loading run", cells: all.map(({run}) => reportOf(run, run))},
    {title: "density", cells: all.map(densityText)}, {title: "seed", cells: all.map(({seed}) => String(seed))},
    of("pressure", one => one.pressure, "Pa"), of("q", ({q, pressure}) => q < ROUND_OFF * pressure ? 0 : q, "Pa"),
    of("coordination number", one => one.coordination), fabric("y"), fabric("z"), of("E", one => one.youngs_modulus, "Pa"), of("ν", one => one.poissons_ratio),
    ...["isotropic", "transversely_isotropic", "orthotropic"].map(key => shares(`off ${words(key)}`, one => one.off?.[key])),
    shares("in springs", one => one.released_by_springs)]));
  document.getElementById("symmetry").hidden = !all.some(({off}) => off);
}

// A matrix in one unit.
function fillStiffness(head) {
  const {stiffness = {}} = seedsOf(head)[document.getElementById("stiffness-state").value], {factor, label} = unitFor("Pa", largest(Object.values(stiffness)));
  const most = largest(Object.values(stiffness)), shown = value => Math.abs(value) < ROUND_OFF * most ? 0 : value * factor;
  const value = (i, k) => shown(stiffness[`c${Math.min(i, k) + 1}${Math.max(i, k) + 1}`]);
  const parts = STRESSES.map((_, i) => i).filter(i => Number.isFinite(value(i, i)));
  document.getElementById("stiffness").hidden = !parts.length;
  if (parts.length) fillColumns(document.getElementById("stiffness"), [{title: `c [${label}]`, cells: parts.map(i => `${i + 1} (${STRESSES[i]})`)},
    ...parts.map(k => ({title: `${k + 1} (${STRESSES[k]})`, unit: "-", cells: parts.map(i => value(i, k))}))]);
}

function fillEngineering(head) {
  const all = seedsOf(head).filter(({engineering}) => engineering);
  document.getElementById("engineering-section").hidden = !all.length;
  if (!all.length) return;
  const constants = Object.keys(all[0].engineering);
  fillColumns(document.getElementById("engineering"), [{title: "loading run", cells: all.map(({run}) => reportOf(run, run))},
    {title: "density", cells: all.map(densityText)}, {title: "seed", cells: all.map(({seed}) => String(seed))},
    ...constants.map(key => ({title: key.replace("nu", "ν"), unit: key.startsWith("nu") ? "-" : "Pa", cells: all.map(one => one.engineering[key])}))]);
}

const fitsOf = ({fitted, fitted_in_stresses}) => fitted && fitted_in_stresses ? "all" : fitted ? "cap, Cam-Clay" : fitted_in_stresses ? "S-CLAY1" : "none";
// Of a plastic strain: the components that are not about 0.
const plasticText = parts => parts.map((value, k) => Math.abs(value) < 0.005 ? "" : `${STRESSES[k]} ${digits(value, 3)}`).filter(Boolean).join(", ");

function fillPoints(head, criterion) {
  const all = head.states.flatMap(state => pointsOf(state, criterion).map(point => ({...point, path: state.path, density: densityText(state)})));
  document.getElementById("points-section").hidden = !all.length;
  document.body.dataset.points = all.length;
  if (!all.length) return;
  const of = (title, pick) => ({title, unit: "Pa", cells: all.map(pick)}), most = largest(all.flatMap(({stress}) => stress));
  const stresses = STRESSES.map((part, k) => of(`σ${part}`, ({stress}) => stress[k])).filter(({cells}) => largest(cells) > ROUND_OFF * most);
  const degrees = (title, pick) => ({title, cells: all.map(one => Number.isFinite(pick(one)) ? `${digits(pick(one) * DEGREES, 3)}°` : null)});
  fillColumns(document.getElementById("points"), filled([
    {title: "direction", cells: all.map(point => reportOf(point.run, directionText(point)))},
    {title: "path", cells: all.map(({path}) => path)}, {title: "density", cells: all.map(({density}) => density)},
    of("p", ({p}) => p), of("q", ({q}) => q), degrees("Lode angle", one => one.lode_angle), ...stresses,
    {title: "plastic strain", cells: all.map(({plastic}) => plasticText(plastic))}, degrees("off the normal", one => one.angle_to_normal),
    {title: "in the fits", cells: all.map(fitsOf)}]));
}

const TABLES = [fillParameters, fillOpen, fillStates, fillStiffness, fillEngineering, fillPoints];

// What depends on the dimension, and the choice of a stiffness.
function tellStates(head) {
  const axes = [...new Set(head.states.map(axisOf))], choice = document.getElementById("stiffness-state");
  document.querySelector("#points-section .axis").textContent = axes.join(" or ");
  document.getElementById("directions").textContent = "Direction: the angle of the strain or stress path" +
    (axes.includes("y") ? ", in two dimensions in the x, y plane" : "") + (axes.includes("z") ? ", in three dimensions in the plane of the lateral " +
    "component times √2 and z. Lode angle: 0 when compressed along z, 120° along y, 240° along x" : "") + ".";
  seedsOf(head).forEach((one, i) => choice.add(new Option(`${one.run}, density ${densityText(one)}, seed ${one.seed}`, i)));
}

function leadText(head) {
  const points = criterion => head.states.reduce((sum, state) => sum + pointsOf(state, criterion).length, 0);
  return `${counted(pathsOf(head).length, "loading path")}, ${counted(head.states.length, "state")}: ` +
    `${counted(points("dissipation"), "yield point")} by dissipated energy, ${points("offset_strain")} by plastic strain. Version ${head.version} (${head.commit}).`;
}

function drawCharts(head, criterion) {
  document.getElementById("curves").replaceChildren();
  const charts = chartsOf(head, criterion), hosts = charts.map(chart => card(chart.title));
  charts.forEach((chart, i) => {
    chart.isEqual ? drawEqual(hosts[i], chart, {height: 400}) : drawChart(hosts[i], chart, {height: 340});
    if (chart.note) hosts[i].parentElement.append(element("p", {className: "note", textContent: chart.note}));
  });
  document.body.dataset.drawnLines = charts.reduce((sum, {lines}) => sum + lines.length, 0);
}

// No run got to a state.
function tellNothing() {
  document.querySelectorAll("main > *").forEach(part => { part.hidden = true; });
  document.getElementById("lead").textContent += " No state was reached: the terminal and the log of each run tell why.";
  Object.assign(document.body.dataset, {points: 0, drawnLines: 0, ready: "1"});
}

function main() {
  const head = JSON.parse(document.getElementById("head").textContent), choice = document.getElementById("criterion");
  document.getElementById("lead").textContent = leadText(head);
  placeSettings(document.getElementById("settings"), new Set(["Pa"]), false);
  if (!head.states.length) { tellNothing(); return; }
  Object.entries(CRITERIA).forEach(([name, told]) => choice.add(new Option(told(head), name)));
  tellStates(head);
  const showSpace = placeSpace(head, () => choice.value), fillTables = () => TABLES.forEach(fill => fill(head, choice.value));
  const charts = () => drawCharts(head, choice.value), show = () => [charts, showSpace, fillTables].forEach(one => one());
  choice.onchange = show;
  document.getElementById("stiffness-state").onchange = fillTables;
  show();
  onUnits(fillTables);
  onTheme(charts);  // the paler marks have colours of their own
  document.body.dataset.ready = "1";
}

main();
