// A powder without walls, or in a die driven like one: the stresses are its main result.
"use strict";

addCurves(run => {
  if (!run.has("cell/stress_xx")) return [];
  const parts = run.inSpace ? ["xx", "yy", "zz", "xy", "yz", "zx"] : ["xx", "yy", "xy"];
  const lines = (kind, name) => parts.map(part => run.series(`cell/${kind}_${part}`, `${name}${part}`));
  const density = run.has("relative_density") ? [run.series("relative_density", "relative density")] : [];
  const xs = [timeAxis(run), ...density, ...lines("strain", "strain ")];
  return [{title: "Stresses of the cell", xs, y: "stress", lines: lines("stress", "σ"), first: true, meaning: "tension > 0"},
          {title: "Energies per volume", xs, y: "energy per volume",
           lines: [["stored", "stored"], ["dissipated", "dissipated"]].map(([kind, label]) => run.series(`cell/${kind}_energy`, label))}];
});
