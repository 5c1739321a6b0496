// Curves of every run with tools: forces, stress ratio, and each recorded series.
"use strict";

// Travel of each moving punch, as an alternative x axis to time.
function travels(run) {
  return run.named(/^tool\/.+\/position_y$/).flatMap(({name}) => {
    const tool = name.split("/")[1], [xs, ys, zs] = [..."xyz"].map(axis => run.values(`tool/${tool}/position_${axis}`));
    if (!xs.length) return [];
    const values = xs.map((x, i) => Math.hypot(x - xs[0], ys[i] - ys[0], zs.length ? zs[i] - zs[0] : 0));
    return largest(values) > 0 ? [{label: `travel of ${tool}`, unit: "m", values}] : [];
  });
}

// The normal of a tool's face, into the powder: given for a plane; for a polyline, that of its dominant direction. Null
// for a constraint, which has no face.
function faceNormal(tool) {
  if (Array.isArray(tool.normal)) return tool.normal;
  if (!Array.isArray(tool.points) || tool.points.length < 2) return null;
  const [from, to] = [tool.points[0], tool.points.at(-1)], dx = to[0] - from[0], dy = to[1] - from[1];
  return Math.abs(dx) >= Math.abs(dy) ? [0, Math.sign(dx)] : [-Math.sign(dy), 0];
}

// The signs of the lines that are drawn.
function signsOf(lines, inSpace) {
  const has = key => lines.some(({name}) => name.endsWith(`/${key}`)), axes = inSpace ? "Fx, Fy, Fz" : "Fx, Fy";
  return ["Forces of the powder on the tools.",
          has("normal") && "Normal: from the powder into the tool, compression > 0, tension < 0.",
          has("tangential") && (inSpace ? "Tangential: along the face." : "Tangential: along the face, > 0 towards +x, or +y on a vertical face."),
          has("axial") && "For a die: along its axis, given by its normal, and across it.",
          has("force_x") && `${axes}: along the axes.`].filter(Boolean).join(" ");
}

// In three dimensions a tangential force has no sign.
function spaceForces({normal, shape}, axes, line) {
  if (normal?.length !== 3) return [..."xyz"].map((axis, k) => line(`F${axis}`, `force_${axis}`, axes[k]));
  const pressed = axes[0].map((_, i) => -axes.reduce((sum, force, k) => sum + force[i] * normal[k], 0));
  const along = pressed.map((force, i) => Math.sqrt(Math.max(0, axes.reduce((sum, part) => sum + part[i] ** 2, 0) - force ** 2)));
  if (shape === "die") return [line("along its axis", "axial", pressed.map(force => -force)), line("across it", "across", along)];
  return [line("normal", "normal", pressed), line("tangential", "tangential", along)];
}

const bySize = (a, b) => largest(b.values) - largest(a.values);

// One sign convention for all tools, whatever their orientation.
function forceLines(run) {
  return run.named(/^tool\/.+\/force_x$/).flatMap(series => {
    const name = series.name.split("/")[1], fx = series.values, fy = run.values(`tool/${name}/force_y`);
    const tool = (run.summary.tools || []).find(one => one.name === name) || {}, normal = faceNormal(tool);
    const line = (label, key, values) => ({...series, label: `${name}, ${label}`, name: `tool/${name}/${key}`, values});
    const fz = run.values(`tool/${name}/force_z`);
    if (fz.length) return spaceForces(tool, [fx, fy, fz], line);
    if (!normal) return [line("Fx", "force_x", fx), line("Fy", "force_y", fy)];
    const [nx, ny] = normal, sign = (Math.abs(ny) >= Math.abs(nx) ? ny : -nx) > 0 ? 1 : -1;
    return [line("normal", "normal", fx.map((f, i) => -f * nx - fy[i] * ny)),
            line("tangential", "tangential", fx.map((f, i) => sign * (f * ny - fy[i] * nx)))];
  }).sort(bySize);
}

addCurves(run => {
  const density = run.has("relative_density") ? [run.series("relative_density", "relative density")] : [];
  const xs = [timeAxis(run), ...travels(run), ...density];
  const ratio = ["axial", "lateral"].filter(name => run.has(`stress_ratio/${name}`));
  const forces = forceLines(run);
  return [{title: "Forces on the tools", xs, y: "force", lines: forces, meaning: signsOf(forces, run.inSpace)},
          {title: "Stress over yield stress", xs: [...density, ...xs.filter(x => !density.includes(x))],
           y: "stress ratio σ / σy", lines: ratio.map(name => run.series(`stress_ratio/${name}`, name))}];
});

addPanel({
  title: "Energies", order: 40,
  when: run => run.named(/^energy\//).some(series => largest(series.values) > 0),
  draw(report, host) {
    const lines = report.run.named(/^energy\//).filter(series => largest(series.values) > 0)
      .map(series => ({...series, label: nameOf(series.name).words.replace(/ energy$/, "")})).sort(bySize);
    report.chart(host, {x: timeAxis(report.run), y: "energy", lines});
  },
});
