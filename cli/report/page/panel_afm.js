// AFM lever: force curve, friction loop, and stiffness compared with closed-form values.
"use strict";

const meshError = ({mesh_error: of}, name) => of ? `mesh: about ${percent(of[name])} too stiff` : "";

addFigures(({summary: {calibration, loops, force_curves: curves}}) => [
  ...(calibration ? [["normal stiffness", `${digits(calibration.k_n)} N/m`, meshError(calibration, "k_n")],
                     ["lateral stiffness", `${digits(calibration.k_l)} N/m`, meshError(calibration, "k_l")]] : []),
  ...(loops || []).slice(0, 1).flatMap(loop => [["half-width of the loop", withUnit(loop.half_width, "N"), ""],
    loop.friction ? ["friction coefficient", digits(loop.friction, 4), "wedge calibration"] : null]),
  ...(curves || []).slice(0, 1).flatMap(curve => [["pull-off force", withUnit(curve.pull_off, "N"), "of the force curve"],
    ["pull-off work", withUnit(curve.work, "J"), "over the travel of the scanner"],
    curve.work_of_adhesion ? ["work of adhesion", withUnit(curve.work_of_adhesion, "J/m^2"), "from pull-off and radius"] : null])]);

// A series restricted to samples with `kept(sample)` and their neighbours: a separate line on the common axis.
function onlySamples(series, label, kept, more = {}) {
  const values = Array.from(series.values, (v, i) => kept(i) || (i + 1 < series.values.length && kept(i + 1)) ? v : NaN);
  return {...series, label, values, ...more};
}

// Samples of approach and retract: the scanner moves only up or only down. A single such sample is the turn of a raster line.
function verticalMotion(run) {
  const [x, y, z] = ["x", "y", "z"].map(axis => run.values(`scanner/${axis}`));
  const still = (values, i) => !values.length || values[i] === values[i - 1];
  const isVertical = i => i > 0 && i < z.length && still(x, i) && still(y, i) && z[i] !== z[i - 1];
  const moves = (i, sign) => isVertical(i) && (isVertical(i - 1) || isVertical(i + 1)) && sign * (z[i] - z[i - 1]) > 0;
  return z.length ? {approach: i => moves(i, 1), retract: i => moves(i, -1)} : null;
}

// For every friction loop: its samples and the axis of its motion.
function loopParts(run) {
  const {times} = run, loops = run.summary.loops || [];
  const extent = (name, from, to) => {
    const [low, high] = bounds([run.values(name).filter((_, i) => times[i] > from && times[i] <= to)]);
    return high - low || 0;
  };
  return loops.map(({action}) => {
    const lateral = extent("scanner/y", action, action + 1) >= extent("scanner/x", action, action + 1);
    const within = (from, to) => i => times[i] > from + 1e-9 && times[i] <= to + 1e-9;
    return {action, axis: lateral ? "y" : "x", trace: within(action, action + 0.5), retrace: within(action + 0.5, action + 1)};
  });
}

const RETURN = [6, 4];  // dashes for the return motion: retract, retrace

function curveLines(run, name, label) {
  const motion = run.has(name) && verticalMotion(run);
  if (!motion) return [];
  const there = part => run.values(name).some((_, i) => motion[part](i));
  return ["approach", "retract"].filter(there).map((part, k) =>
    onlySamples(run.series(name), label ? `${label}, ${part}` : part, motion[part], {hue: k, dash: k ? RETURN : undefined}));
}

// With the sign of the loop's table: the force that drags the tip is opposite to the force on it.
function loopLines(run, axis, name) {
  const loops = loopParts(run).filter(loop => loop.axis === axis);
  if (!run.has(name)) return [];
  const series = run.series(name), dragging = {...series, values: Array.from(series.values, v => -v)};
  const label = (loop, part) => loops.length > 1 ? `action ${loop.action}, ${part}` : part;
  return loops.flatMap((loop, i) => ["trace", "retrace"].map((part, k) => onlySamples(dragging, label(loop, part), loop[part],
    {hue: loops.length > 1 ? i : k, dash: k ? RETURN : undefined})));
}

addCurves(run => {
  if (run.family !== "afm") return [];
  const x = (name, label) => run.has(name) ? [run.series(name, label)] : [];
  const moved = [...x("scanner/y", "scanner, y"), ...x("scanner/x", "scanner, x"), ...x("scanner/z", "scanner, z")];
  const xs = moved.filter(axis => largest(axis.values) > 0);
  const against = first => [...xs.filter(a => a.label.endsWith(first)), ...xs.filter(a => !a.label.endsWith(first)), timeAxis(run)];
  const whole = names => names.filter(name => run.has(name)).map(name => run.series(name, toldName(name)));
  const group = (title, first, y, lines, more) => ({title, y, xs: against(first), lines, ...more});
  const loops = ["y", "x"].flatMap(axis => {
    const lateral = axis === "y", along = lateral ? "" : " along the lever";
    return [group(`Friction loop${along}`, axis, "force that drags the tip", loopLines(run, axis, `probe/force_${axis}`), {first: true}),
            group(`Friction loop${along}, volts`, axis, "signal, as of that force", loopLines(run, axis, `detector/${lateral ? "lateral" : "normal"}`))];
  });
  return [group("Force curve", "z", "vertical force", curveLines(run, "probe/force_z"), {first: Boolean(run.summary.force_curves)}),
          group("Force curve, volts", "z", "normal signal", curveLines(run, "detector/normal")), ...loops,
          group("Lateral force, whole programme", "y", "lateral force on the tip", whole(["probe/force_y"])),
          group("Detector, whole programme", "y", "signal", whole(["detector/lateral", "detector/normal"]))];
});

// The stiffnesses of a calibration over those of each closed form: 1 where they agree.
addCurves(({summary: {calibration}}) => {
  const forms = (calibration?.closed_forms || []).filter(({does_not_apply: why}) => !why), at = forms.map((_, i) => i);
  const ratios = forms.map(({difference}) => 1 + difference);
  return [{title: "Stiffness over closed forms", first: true, isStill: true, y: "finite elements / closed form",
           xs: [{label: "closed form", unit: "-", values: at, names: forms.map(({quantity, name}) => `${quantity}: ${name}`)}],
           lines: forms.length ? [{label: "finite elements / closed form", unit: "-", values: ratios, low: ratios, high: ratios, isMarks: true},
                                  {label: "1: they agree", unit: "-", values: at.map(() => 1), dash: [5, 4]}] : []}];
});

// A table that scrolls inside its card and is redrawn when the user changes a unit.
function placeColumns(host, columns) {
  const table = element("table", {className: "figures"});
  const fill = () => fillColumns(table, columns);
  host.append(element("div", {className: "scroll"}, table));
  host.parentElement.classList.add("wide");
  fill();
  onUnits(fill);
}

addPanel({
  title: "Stiffness compared with closed forms", order: 20,
  when: ({summary: {calibration}}) => Boolean(calibration && calibration.closed_forms),
  draw({run}, host) {
    const {calibration} = run.summary, forms = calibration.closed_forms, of = pick => forms.map(form => pick(form) ?? null);
    const difference = ({difference: off, does_not_apply: why}) =>
      why ? `does not apply: ${why}` : `${off > 0 ? "+" : ""}${percent(off)}`;
    placeColumns(host, [
      {title: "quantity", cells: of(({quantity}) => quantity)},
      {title: "formula", cells: of(({name}) => name)},
      {title: "value", unit: "N/m", cells: of(({value}) => value)},
      {title: "finite elements", cells: of(difference)}]);
    host.append(element("p", {className: "note", textContent:
      `Lateral displacement of the tip's end: ${percent(calibration.share_twist)} twist, ` +
      `${percent(calibration.share_bending)} lateral bending, ${percent(calibration.share_tip)} in the tip. ` +
      `Torsional stiffness ${digits(calibration.torsional_stiffness)} N m/rad; InvOLS ${withUnit(calibration.invols_normal, "m/V")} normal` +
      (calibration.invols_lateral ? `, ${withUnit(calibration.invols_lateral, "m/V")} lateral.` : ".")}));
  },
});

addPanel({
  title: "Friction loops", order: 21,
  when: ({summary: {loops}}) => Boolean(loops && loops.length),
  draw({run}, host) {
    const {loops} = run.summary, of = pick => loops.map(loop => pick(loop) ?? null);
    placeColumns(host, [
      {title: "action", cells: of(loop => String(loop.action))},
      {title: "load L", unit: "N", cells: of(loop => loop.load)},
      {title: "trace", unit: "N", cells: of(loop => loop.trace)},
      {title: "retrace", unit: "N", cells: of(loop => loop.retrace)},
      {title: "half-width W", unit: "N", cells: of(loop => loop.half_width)},
      {title: "offset Δ", unit: "N", cells: of(loop => loop.offset)},
      {title: "W / L", unit: "-", cells: of(loop => loop.load > 0 ? loop.half_width / loop.load : null)},
      {title: "Δ / L", unit: "-", cells: of(loop => loop.load > 0 ? loop.offset / loop.load : null)},
      {title: "W", unit: "V", cells: of(loop => loop.volts_half_width)},
      {title: "Δ", unit: "V", cells: of(loop => loop.volts_offset)},
      {title: "friction", unit: "-", cells: of(loop => loop.friction)},
      {title: "sensitivity", unit: "N/V", cells: of(loop => loop.sensitivity)}]);
    for (const loop of run.summary.loops.filter(loop => loop.settled === false)) {
      if (loop.touches < 1) {
        host.append(element("p", {className: "note", textContent: loop.touches === 0
          ? `In action ${loop.action} the probe does not touch the sample where W is evaluated.`
          : `In action ${loop.action} the probe is off the sample for part of the scan where W is evaluated.`}));
        continue;
      }
      const why = loop.slides < 1 - 1e-3 ? "the probe still sticks" :
        loop.turned < 1 - 1e-3 ? "friction is not yet aligned with the scan" : "the force still drifts";
      const scan = loop.needed_distance ? `a scan of ${withUnit(loop.needed_distance, "m")}` : "a longer scan, or a scan at constant force,";
      host.append(element("p", {className: "note", textContent:
        `In action ${loop.action} ${why} where W is evaluated: ${scan} is needed.`}));
    }
  },
});

addPanel({
  title: "Force curves", order: 22,
  when: ({summary: {force_curves: curves}}) => Boolean(curves && curves.length),
  draw({run}, host) {
    const of = key => run.summary.force_curves.map(curve => curve[key] ?? null);
    placeColumns(host, [
      {title: "retract from action", cells: of("action").map(String)},
      {title: "largest force", unit: "N", cells: of("greatest_force")},
      {title: "pull-off force", unit: "N", cells: of("pull_off")},
      {title: "pull-off work", unit: "J", cells: of("work")},
      {title: "work of adhesion", unit: "J/m^2", cells: of("work_of_adhesion")}]);
    host.append(element("p", {className: "note", textContent:
      "Work: area below the zero-force line while the probe is retracted, over the travel of the scanner."}));
  },
});
