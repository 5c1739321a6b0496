// Compaction: its key figures, and the laws fitted to its density curve.
"use strict";

const drawnLaws = ({laws, curve}) => laws.filter(law => fitsWell(law) && curve[law.law]).map(({law}) => law);
const atTheEnd = run => run.hasEnded ? "at the end" : "so far";

addFigures(run => {
  const ratio = run.end("stress_ratio/axial"), density = finalDensity(run);
  if (density === undefined) return [];
  return [["relative density", density === null ? "none" : digits(density, 4), atTheEnd(run)],
          run.family === "compaction" && ratio > 0 && ["axial stress / yield stress", digits(ratio, 3), atTheEnd(run)]];
});

addPanel({
  title: "Relative density against punch pressure, and the fitted laws", order: 60,
  when: ({summary: {fits}}) => Boolean(fits && fits.curve && fits.curve.pressure.length &&
                                       drawnLaws(fits).length),
  draw({run}, host) {
    const {fits} = run.summary, {curve} = fits, drawn = drawnLaws(fits);
    const order = Array.from(curve.pressure.keys()).sort((i, j) => curve.pressure[i] - curve.pressure[j]);
    const sorted = values => order.map(i => values[i]), x = sorted(curve.pressure);
    const lines = [...drawn.map((law, i) => ({label: LAWS[law][0], unit: "-", x, values: sorted(curve[law]), hue: i + 1, dash: [7, 4]})),
                   {label: "measured", unit: "-", values: curve.relative_density, hue: 0}];
    drawChart(host, {x: {label: "pressure", unit: "Pa", values: curve.pressure}, y: "relative density", lines});
    const poor = fits.laws.filter(law => !law.not_fitted && !fitsWell(law)).map(({law}) => (LAWS[law] || [law])[0]);
    if (poor.length) host.append(element("p", {className: "note", textContent: `${poor.join(", ")}: not drawn, R² is below ${LEAST_R_SQUARED}.`}));
  },
});
