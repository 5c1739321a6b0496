// Local densities in 3D: one layer of cells normal to an axis chosen by the user.
"use strict";

// {cells, x, y} of a layer, as expected by drawCells; its axes are the other two, in order.
function layerOf(grid, axis, layer) {
  const count = [..."xyz"].map(name => grid[name].length - 1), [first, second] = [0, 1, 2].filter(k => k !== axis), cells = [];
  const at = [0, 0, 0];
  at[axis] = layer;
  for (at[second] = 0; at[second] < count[second]; ++at[second])
    for (at[first] = 0; at[first] < count[first]; ++at[first]) cells.push(grid.cells[(at[2] * count[1] + at[1]) * count[0] + at[0]]);
  return {cells, x: grid["xyz"[first]], y: grid["xyz"[second]], names: ["xyz"[first], "xyz"[second]]};
}

addPanel({
  title: "Local relative density", order: 10, when: run => run.frames.some(frame => frame.grid),
  draw(report, host) {
    const {run} = report, grids = run.frames.map(frame => frame.grid), chosen = {axis: 1, share: 0.5};
    const count = () => grids[0]["xyz"[chosen.axis]].length - 1;
    const layer = () => Math.min(count() - 1, Math.floor(chosen.share * count()));
    const across = element("select", {"aria-label": "Axis normal to the layer"});
    [..."xyz"].forEach((name, k) => across.add(new Option(`normal to ${name}`, k)));
    across.value = chosen.axis;
    const place = element("input", {type: "range", min: 0, step: 1, "aria-label": "Layer of cells"});
    host.append(element("div", {className: "controls"}, element("label", {}, "Layer ", across), place));
    const most = largest(grids.flatMap(grid => [..."xyz"].map(name => grid[name].at(-1) - grid[name][0])));
    const wide = Math.min(...[..."xyz"].map(name => largest(grids.map(grid => grid[name].at(-1) - grid[name][0]))));
    const all = frames => bounds(frames.filter(frame => frame.grid).map(({grid: {cells}}) => known(cells)));
    const spanOf = ({grid}) => grid["xyz"[chosen.axis]].slice(layer(), layer() + 2).map(end => withUnit(end, "m", 3)).join(" to ");
    const paint = report.figure(host, {
      title: "Local relative density", shape: Math.min(1, most / wide),
      draw: (ctx, width, height, {grid}) => drawCells(ctx, width, height, layerOf(grid, chosen.axis, layer()), all(report.beside.flatMap(one => one.frames))),
      note: frame => {
        const part = layerOf(frame.grid, chosen.axis, layer()), {merged} = frame.grid;
        return `${titled(rangeText(known(part.cells)))} in ${part.x.length - 1} × ${part.y.length - 1} cells, ${part.names[0]} to the right, ` +
          `${part.names[1]} up, ${"xyz"[chosen.axis]} from ${spanOf(frame)}${merged > 1 ? `, each the mean of ${merged}³` : ""}, ${atTime(frame)}.`;
      },
      columns: ({grid}) => {
        const middle = (lines, i) => (lines[i] + lines[i + 1]) / 2, [nx, ny] = [grid.x.length - 1, grid.y.length - 1];
        return [{label: "x", unit: "m", values: grid.cells.map((_, c) => middle(grid.x, c % nx))},
                {label: "y", unit: "m", values: grid.cells.map((_, c) => middle(grid.y, Math.floor(c / nx) % ny))},
                {label: "z", unit: "m", values: grid.cells.map((_, c) => middle(grid.z, Math.floor(c / nx / ny)))},
                {label: "relative density", unit: "-", values: grid.cells}];
      }});
    const tell = () => {
      place.max = count() - 1;
      place.value = layer();
      place.setAttribute("aria-valuetext", `layer ${layer() + 1} of ${count()}`);
      paint();
    };
    across.onchange = () => { chosen.axis = Number(across.value); tell(); };
    place.oninput = () => { chosen.share = (Number(place.value) + 0.5) / count(); tell(); };
    tell();
  },
});
