// A lever of an atomic force microscope: force curve, loop, and its stiffness beside the closed forms.
"use strict";

const meshError = ({mesh_error: of}, name) => of ? `mesh: some ${percent(of[name])} too stiff` : "";

addFigures(({summary: {calibration, loops, force_curves: curves}}) => [
  ...(calibration ? [["normal stiffness", `${digits(calibration.k_n)} N/m`, meshError(calibration, "k_n")],
                     ["lateral stiffness", `${digits(calibration.k_l)} N/m`, meshError(calibration, "k_l")]] : []),
  ...(loops || []).slice(0, 1).flatMap(loop => [["half width of the loop", withUnit(loop.half_width, "N"), ""],
    loop.friction ? ["friction coefficient", digits(loop.friction, 4), "wedge calibration"] : null]),
  ...(curves || []).slice(0, 1).flatMap(curve => [["pull-off force", withUnit(curve.pull_off, "N"), "of the force curve"],
    ["pull-off work", withUnit(curve.work, "J"), "over the travel of the scanner"],
    curve.work_of_adhesion ? ["work of adhesion", `${digits(1e3 * curve.work_of_adhesion)} mJ/m²`, "of pull-off and radius"] : null])]);

addCurves(run => {
  if (run.family !== "afm") return [];
  const x = (name, label) => run.has(name) ? [run.series(name, label)] : [];
  const moved = [...x("scanner/y", "scanner, y"), ...x("scanner/x", "scanner, x"), ...x("scanner/z", "scanner, z")];
  const xs = moved.filter(axis => largest(axis.values) > 0);
  const group = (title, first, y, names) => ({title, y, xs: [...xs.filter(a => a.label.endsWith(first)),
    ...xs.filter(a => !a.label.endsWith(first)), timeAxis(run)],
    lines: names.filter(name => run.has(name)).map(name => run.series(name, words(name.replace("/", ", "))))});
  return [group("Force curve", "z", "force", ["probe/force_z"]),
          {...group("Friction loop", "y", "force", ["probe/force_y"]), first: Boolean(run.summary.loops)},
          group("Detector", "y", "signal", ["detector/lateral", "detector/normal"])];
});

addPanel({
  title: "Stiffness beside the closed forms", order: 20,
  when: ({summary: {calibration}}) => Boolean(calibration && calibration.closed_forms),
  draw({run}, host) {
    const {calibration} = run.summary, table = element("table", {className: "figures"});
    const row = (cells, tag = "td") => table.insertRow().append(...cells.map(textContent => element(tag, {textContent})));
    row(["", "formula", "value", "finite elements"], "th");
    for (const {quantity, name, value, difference, does_not_apply: why} of calibration.closed_forms) {
      row([quantity, name, `${digits(value)} N/m`,
        why ? `does not apply: ${why}` : `${difference > 0 ? "+" : ""}${percent(difference)}`]);
    }
    host.append(element("div", {className: "scroll"}, table), element("p", {className: "note", textContent:
      `Lateral displacement of the tip's end: ${percent(calibration.share_twist)} twist, ` +
      `${percent(calibration.share_bending)} lateral bending, ${percent(calibration.share_tip)} in the tip. ` +
      `Torsional stiffness ${digits(calibration.torsional_stiffness)} N m/rad; InvOLS ${digits(calibration.invols_normal)} m/V normal` +
      (calibration.invols_lateral ? `, ${digits(calibration.invols_lateral)} m/V lateral.` : ".")}));
  },
});

addPanel({
  title: "Friction loops", order: 21,
  when: ({summary: {loops}}) => Boolean(loops && loops.length),
  draw({run}, host) {
    const table = element("table", {className: "figures"});
    const row = (cells, tag = "td") => table.insertRow().append(...cells.map(textContent => element(tag, {textContent})));
    row(["action", "load", "half width W", "offset Δ", "W / load", "Δ / load", "W, volts", "Δ, volts", "friction", "N/V"], "th");
    for (const loop of run.summary.loops) {
      row([String(loop.action), withUnit(loop.load, "N"), withUnit(loop.half_width, "N"), withUnit(loop.offset, "N"),
           digits(loop.half_width / loop.load), digits(loop.offset / loop.load),
           withUnit(loop.volts_half_width, "V"), withUnit(loop.volts_offset, "V"),
           loop.friction ? digits(loop.friction) : "–", loop.sensitivity ? digits(loop.sensitivity) : "–"]);
    }
    host.append(element("div", {className: "scroll"}, table));
    for (const loop of run.summary.loops.filter(loop => loop.settled === false)) {
      const why = loop.slides < 1 - 1e-3 ? "the probe still sticks" :
        loop.turned < 1 - 1e-3 ? "friction has not turned along the scan" : "the force still drifts";
      const scan = loop.needed_distance ? `a scan of ${withUnit(loop.needed_distance, "m")}` : "a longer scan, or one at a kept force,";
      host.append(element("p", {className: "note", textContent:
        `In action ${loop.action} ${why} where W is taken from: ${scan} is needed.`}));
    }
  },
});
