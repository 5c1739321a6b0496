// What a shear stage adds to the report: friction, stresses, dilation and work against the way of the target.
"use strict";

const FROM_SHEAR = {
  "Friction of the target against its way": [["friction", "lateral / normal force"]],
  "Stress against the way of the target": [["normal_stress", "normal, on the target"],
                                           ["lateral_stress", "lateral, on the target"],
                                           ["punch_lateral_stress", "lateral, on the punch"]],
  "Dilation against the way of the target": [["dilation", "way of the punch outwards"]],
  "Share of the lateral force that the wall bears": [["wall_share", "wall / target"]],
  "Particles that go along with the target": [["locked", "within 10 % of its speed"]],
  "Work of the target against its way": [["work", "lateral force times way"]]};

// Static and dynamic coefficients as lines across, where the summary has them.
function frictionLevels({shear}, count) {
  if (!shear) return [];
  return [["static_friction", "largest of the first quarter"],
          ["dynamic_friction", "mean of the second half"]]
    .filter(([key]) => Number.isFinite(shear[key]))
    .map(([key, label]) => ({label, unit: "-", dash: [6, 4], values: Array(count).fill(shear[key])}));
}

function drawShear(history, summary) {
  const distance = history.get("shear/distance");
  if (!distance || !(largest(distance.values) > 0)) return;
  const first = distance.values.findIndex(way => way > 0);
  const x = {label: "way of the target", unit: "m", values: distance.values.slice(first)};
  const charts = [];
  for (const [title, series] of Object.entries(FROM_SHEAR)) {
    const lines = series.filter(([name]) => history.has(`shear/${name}`)).map(([name, label]) => {
      const {unit, values} = history.get(`shear/${name}`);
      return {label, unit, values: values.slice(first)};
    });
    if (!lines.length) continue;
    if (series[0][0] === "friction") lines.push(...frictionLevels(summary, x.values.length));
    const host = card(title);
    const y = lines[0].unit === "Pa" ? "stress" : words(series[0][0]);
    charts.push(() => drawChart(host, {x, y, lines}));
  }
  for (const draw of charts) draw();
}
