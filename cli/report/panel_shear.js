// Shear over a target: friction and dilation against the way.
"use strict";

addFigures(({summary: {shear}}) => shear ? [
  ["static friction", digits(shear.static_friction, 3), "largest in the first quarter of the way"],
  ["dynamic friction", digits(shear.dynamic_friction, 3), `± ${digits(shear.dynamic_deviation, 2)} over the second half`],
  ["normal stress", withUnit(shear.normal_stress, "Pa", 3), "on the target"],
  ["dilation", withUnit(shear.dilation, "m", 3), "way of the punch off the target"]] : []);

addCurves(run => {
  if (!run.has("shear/friction")) return [];
  const xs = [run.series("shear/distance", "sliding distance"), timeAxis(run)];
  const group = (title, y, names) => ({title, xs, y, lines: names.filter(name => run.has(name))
    .map(name => run.series(name, words(name.slice("shear/".length))))});
  return [{...group("Friction coefficient", "lateral / normal force", ["shear/friction"]), first: true},
          group("Stresses on the target", "stress", ["shear/normal_stress", "shear/lateral_stress", "shear/punch_lateral_stress"]),
          group("Dilation", "way off the target", ["shear/dilation"])];
});
