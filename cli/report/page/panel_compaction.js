// Compaction: its key figures, and the laws fitted to its density curve.
"use strict";

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
                                       Object.keys(LAWS).some(law => fits.curve[law])),
  draw({run}, host) {
    const {curve} = run.summary.fits, drawn = Object.keys(LAWS).filter(law => curve[law]);
    const lines = [["measured", curve.relative_density], ...drawn.map(law => [LAWS[law][0], curve[law]])]
      .map(([label, values], i) => ({label, unit: "-", values, dash: i ? [7, 4] : undefined}));
    drawChart(host, {x: {label: "pressure", unit: "Pa", values: curve.pressure}, y: "relative density", lines});
  },
});
