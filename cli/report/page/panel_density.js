// Local densities and contact directions of the current frame.
"use strict";

// Maps metres to the canvas, centred and as large as fits: (x, y) => [px, py].
function fitting([x0, x1], [y0, y1], width, height, margin) {
  const scale = Math.min((width - 2 * margin) / (x1 - x0), (height - 2 * margin) / (y1 - y0));
  const left = (width - scale * (x1 - x0)) / 2, top = (height - scale * (y1 - y0)) / 2;
  return (x, y) => [left + scale * (x - x0), height - top - scale * (y - y0)];
}

// After ejection of the compact, no cell between the punches has any space.
function sayEmpty(ctx, width, height) {
  ctx.fillStyle = theme().soft;
  ctx.textAlign = "center";
  ctx.fillText("nothing between the tools", width / 2, height / 2);
}

function drawCells(ctx, width, height, {cells, x, y}, [low, high]) {
  if (!(low <= high)) return sayEmpty(ctx, width, height);
  const at = fitting([x[0], x.at(-1)], [y[0], y.at(-1)], width - LEGEND_WIDTH, height, 2);
  const columns = x.length - 1, written = columns <= 8;
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  cells.forEach((value, c) => {
    const i = c % columns, j = Math.floor(c / columns);
    const [left, bottom] = at(x[i], y[j]), [right, top] = at(x[i + 1], y[j + 1]);
    const share = high > low ? (value - low) / (high - low) : 0.5;
    ctx.fillStyle = value === null ? theme().body : colour(share);
    ctx.fillRect(left, top, right - left - 1, bottom - top - 1);
    if (!written || value === null) return;
    ctx.fillStyle = inkOn(share);
    ctx.fillText(value.toFixed(3), (left + right) / 2, (top + bottom) / 2);
  });
  drawScale(ctx, width - LEGEND_WIDTH + 14, 26, height - 40, {low, high, unit: "-"});
  return `${low} ${high}`;
}

// Steps, one per row of cells; range at least 0.01, so that round-off does not look like a profile.
function drawProfile(ctx, width, height, {profile, y}, [least, most]) {
  if (!(least <= most) || !known(profile).length) return sayEmpty(ctx, width, height);
  const middle = (least + most) / 2, half = Math.max(0.005, 0.55 * (most - least));
  const low = middle - half, high = middle + half, unit = unitFor("m", y.at(-1) - y[0]);
  const left = 52, base = height - 40, top = 8, right = width - 14;
  const px = value => left + (value - low) / (high - low) * (right - left);
  const py = value => base - (value - y[0]) / (y.at(-1) - y[0]) * (base - top);
  ctx.strokeStyle = theme().grid;
  ctx.fillStyle = theme().soft;
  const line = (x0, y0, x1, y1) => {
    ctx.beginPath();
    ctx.moveTo(x0, y0);
    ctx.lineTo(x1, y1);
    ctx.stroke();
  };
  ctx.textAlign = "center";
  for (const tick of niceTicks(low, high, 5)) {
    line(px(tick), top, px(tick), base);
    ctx.fillText(digits(tick), px(tick), base + 16);
  }
  ctx.fillText("relative density", (left + right) / 2, base + 34);
  ctx.textAlign = "right";
  for (const tick of niceTicks(y[0] * unit.factor, y.at(-1) * unit.factor, 6)) {
    line(left, py(tick / unit.factor), right, py(tick / unit.factor));
    ctx.fillText(digits(tick), left - 6, py(tick / unit.factor) + 4);
  }
  ctx.save();
  ctx.translate(14, (top + base) / 2);
  ctx.rotate(-Math.PI / 2);
  ctx.textAlign = "center";
  ctx.fillText(labelled("height", unit.label), 0, 0);
  ctx.restore();
  ctx.strokeStyle = theme().lines[0];
  ctx.lineWidth = 2;
  ctx.beginPath();
  profile.forEach((value, j) => {
    if (value === null) return;
    j && profile[j - 1] !== null ? ctx.lineTo(px(value), py(y[j])) : ctx.moveTo(px(value), py(y[j]));
    ctx.lineTo(px(value), py(y[j + 1]));
  });
  ctx.stroke();
}

// Fractions per sector over half a turn, mirrored to the other half.
function drawRose(ctx, width, height, {number, force}, most) {
  const sectors = number.length, step = Math.PI / sectors, radius = Math.min(width, height) / 2 - 22;
  ctx.translate(width / 2, height / 2);
  const petals = (shares, fill, stroke) => shares.forEach((share, k) => {
    for (const turn of [0, Math.PI]) {
      const middle = -(k * step + turn);  // the y axis of the canvas points down
      ctx.beginPath();
      ctx.moveTo(0, 0);
      ctx.arc(0, 0, radius * share / most, middle - step / 2, middle + step / 2);
      ctx.closePath();
      if (fill) { ctx.fillStyle = fill; ctx.fill(); }
      ctx.strokeStyle = stroke;
      ctx.stroke();
    }
  });
  ctx.strokeStyle = theme().grid;
  for (const share of [0.5, 1]) {
    ctx.beginPath();
    ctx.arc(0, 0, radius * share, 0, 2 * Math.PI);
    ctx.stroke();
  }
  ctx.fillStyle = theme().soft;
  ctx.textAlign = "center";
  ctx.fillText(percent(most), 0, -radius - 8);
  const [blue, orange] = theme().lines;
  petals(force, blue + "8c", blue);
  petals(number, null, orange);
}

const known = cells => cells.filter(value => value !== null);
const rangeText = values => !values.length ? "nothing" : "from " + bounds([values]).map(value => digits(value)).join(" to ");
const rangeOf = (frames, name) => bounds(frames.filter(frame => frame.density).map(frame => known(frame.density[name])));
const largestShare = frames => Math.max(...frames.filter(({network}) => network?.number)
  .flatMap(({network: {number, force}}) => [...number, ...force])) || 1;
const hasDensity = run => run.densities.length > 0;
const atTime = frame => `at ${withUnit(frame.time, "s")}`;

addPanel({
  title: "Local relative density", order: 10, when: hasDensity,
  draw(report, host) {
    const grids = report.run.frames.map(frame => frame.density), {x, y, merged} = grids[0];
    const extent = axis => largest(grids.map(grid => grid[axis].at(-1) - grid[axis][0]));
    report.figure(host, {
      title: "Local relative density", shape: Math.min(4, extent("y") / extent("x")),
      draw: (ctx, width, height, {density}, frames) => drawCells(ctx, width, height, density, rangeOf(frames, "cells")),
      note: frame => `${titled(rangeText(known(frame.density.cells)))} in ${x.length - 1} × ${y.length - 1} cells ` +
        `between the tools${merged > 1 ? `, each the mean of ${merged} × ${merged}` : ""}, ${atTime(frame)}.`,
      columns: ({density: {cells, x: xs, y: ys}}) => {
        const wide = xs.length - 1, middle = (lines, i) => (lines[i] + lines[i + 1]) / 2;
        return [{label: "x", unit: "m", values: cells.map((_, c) => middle(xs, c % wide))},
                {label: "y", unit: "m", values: cells.map((_, c) => middle(ys, Math.floor(c / wide)))},
                {label: "relative density", unit: "-", values: cells}];
      }});
  },
});

addPanel({
  title: "Relative density along the height", order: 11, when: hasDensity,
  draw(report, host) {
    report.figure(host, {
      title: "Relative density along the height", shape: 0.75,
      draw: (ctx, width, height, {density}, frames) => drawProfile(ctx, width, height, density, rangeOf(frames, "profile")),
      note: frame => `For every row of cells, ${atTime(frame)}.`,
      columns: ({density: {profile, y}}) => [
        {label: "y", unit: "m", values: profile.map((_, j) => (y[j] + y[j + 1]) / 2)},
        {label: "relative density", unit: "-", values: profile}]});
  },
});

addPanel({
  title: "Directions of the contact normals", order: 12,
  when: run => run.frames.some(frame => frame.network?.number?.some(share => share > 0)),
  draw(report, host) {
    report.figure(host, {
      title: "Directions of the contact normals", shape: 0.8,
      draw: (ctx, width, height, {network}, frames) => drawRose(ctx, width, height, network, largestShare(frames)),
      note: frame => `Between particles, ${atTime(frame)}. Filled: share of the normal force; outlined: share of the number.`,
      columns: ({network: {number, force}}) => [
        {label: "direction", unit: "degree", values: number.map((_, k) => 180 * k / number.length)},
        {label: "share of the number", unit: "-", values: number}, {label: "share of the force", unit: "-", values: force}]});
  },
});
