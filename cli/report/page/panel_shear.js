// Shear over a target: friction, stresses, dilation and work against target travel.
"use strict";

addFigures(({summary: {shear}}) => shear ? [
  ["static friction", digits(shear.static_friction, 3), "largest in the first quarter of the travel"],
  ["dynamic friction", digits(shear.dynamic_friction, 3), `± ${digits(shear.dynamic_deviation, 2)} over the second half`],
  ["normal stress", withUnit(shear.normal_stress, "Pa", 3), "on the target"],
  ["dilation", withUnit(shear.dilation, "m", 3), "travel of the punch away from the target"]] : []);

// [title, axis label, [[series, label], ...]]
const OF_SHEAR = [
  ["Friction of the target", "coefficient", [["friction", "lateral / normal force"]]],
  ["Stresses in shear", "stress", [["normal_stress", "normal, on the target"], ["lateral_stress", "lateral, on the target"],
                                   ["punch_lateral_stress", "lateral, on the punch"]]],
  ["Dilation", "travel away from the target", [["dilation", "travel of the punch outwards"]]],
  ["Share of the lateral force carried by the wall", "share", [["wall_share", "wall / target"]]],
  ["Particles moving with the target", "particles", [["locked", "within 10 % of its speed"]]],
  ["Work of the target", "work", [["work", "lateral force times travel"]]]];

// Static and dynamic coefficients as horizontal lines, if the summary has them.
function frictionLevels({summary: {shear}, times}) {
  return [["static_friction", "static"], ["dynamic_friction", "dynamic"]]
    .filter(([key]) => shear && Number.isFinite(shear[key]))
    .map(([key, label]) => ({label, unit: "-", dash: [6, 4], values: new Float32Array(times.length).fill(shear[key])}));
}

addCurves(run => {
  if (!run.has("shear/distance") || !(largest(run.values("shear/distance")) > 0)) return [];
  const xs = [run.series("shear/distance", "travel of the target"), timeAxis(run)];
  return OF_SHEAR.map(([title, y, names]) => {
    const lines = names.filter(([name]) => run.has(`shear/${name}`)).map(([name, label]) => run.series(`shear/${name}`, label));
    const friction = names[0][0] === "friction";
    return {title, xs, y, first: friction, lines: friction && lines.length ? [...lines, ...frictionLevels(run)] : lines};
  });
});
