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
    return [of(`density ${density}`, true, {hue, fit: cap && curve(cap)}), of(`${density}, q < 0 or shear`, false, {colour: paler(hue)}),
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
  const inSpace = isInSpace(statesOf(head, path)[0]);
  return [
    {title: `Yield surfaces: ${path}`, x: {label: "pressure p", unit: "Pa", values: []}, y: "von Mises stress q",
     lines: surfaceLines(head, path, criterion), note: `q > 0: compressed more along ${inSpace ? "z" : "y"}. Solid: Drucker–Prager cap, dashed: ` +
       `modified Cam-Clay, both fitted to the full points; dotted: turned ellipsoid (S-CLAY1), in the plane of the axis, fitted to the pale ones as well.`},
    {title: `Stresses at yield: ${path}`, isEqual: true, x: {label: inSpace ? "√2 × lateral pressure" : "pressure along x", unit: "Pa", values: []},
     y: `pressure along ${inSpace ? "z" : "y"}`, lines: stressLines(head, path, criterion),
     note: inSpace ? "Directions in the plane of the axis (Rendulic plane). Dotted: S-CLAY1." : ""},
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

function main() {
  const head = JSON.parse(document.getElementById("head").textContent), choice = document.getElementById("criterion");
  document.getElementById("lead").textContent = leadText(head);
  placeSettings(document.getElementById("settings"), new Set(["Pa"]), false);
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
