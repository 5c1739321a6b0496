// Curves that every run with tools has: forces, stress ratio, and each recorded series alone.
"use strict";

// Punches that move: how far each has come, as an x axis beside time.
function travels(run) {
  return run.named(/^tool\/.+\/position_y$/).flatMap(({name}) => {
    const tool = name.split("/")[1], ys = run.values(name), xs = run.values(`tool/${tool}/position_x`);
    if (!xs.length) return [];
    const values = xs.map((x, i) => Math.hypot(x - xs[0], ys[i] - ys[0]));
    return largest(values) > 0 ? [{label: `travel of ${tool}`, unit: "m", values}] : [];
  });
}

// Forces worth a curve: at least 1 % of the largest. One that pulls down mostly is shown turned over, and
// says so, so that both punches can be compared.
function forceLines(run) {
  const forces = run.named(/^tool\/.+\/force_[xyz]$/), most = Math.max(0, ...forces.map(s => largest(s.values)));
  return forces.filter(s => most > 0 && largest(s.values) >= 0.01 * most).map(s => {
    const [, tool, along] = s.name.match(/^tool\/(.+)\/force_([xyz])$/), [low, high] = bounds([s.values]);
    const turned = -low > high;
    return {...s, turned, label: `${tool}, ${turned ? "−" : ""}F${along}`, values: turned ? s.values.map(v => -v) : s.values};
  });
}

addCurves(run => {
  const density = run.has("relative_density") ? [run.series("relative_density", "relative density")] : [];
  const xs = [timeAxis(run), ...travels(run), ...density];
  const ratio = ["axial", "lateral"].filter(name => run.has(`stress_ratio/${name}`));
  return [{title: "Forces on the tools", xs, y: "force", lines: forceLines(run)},
          {title: "Stress over yield stress", xs: [...density, ...xs.filter(x => !density.includes(x))],
           y: "stress ratio σ / σy", lines: ratio.map(name => run.series(`stress_ratio/${name}`, name))}];
});

addPanel({
  title: "Energies", order: 40,
  when: run => run.named(/^energy\//).some(series => largest(series.values) > 0),
  draw(report, host) {
    const lines = report.run.named(/^energy\//).filter(series => largest(series.values) > 0)
      .map(series => ({...series, label: words(series.name.slice("energy/".length))}));
    report.chart(host, {x: timeAxis(report.run), y: "energy", lines});
  },
});
