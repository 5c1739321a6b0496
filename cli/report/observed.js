// Local densities and the contact network of the last frame, where the run has recorded them.
"use strict";

// A canvas in a card of its own; `shape`: height over width of what draw(ctx, width, height) draws.
// Returns what paints it: the card has its width when all of them stand.
function figureCard(title, note, shape, draw) {
  const canvas = element("canvas", {className: "figure"}), host = card(title);
  host.append(canvas, element("p", {className: "note", textContent: note}));
  return () => {
    const ratio = devicePixelRatio || 1, width = host.clientWidth;
    const height = Math.min(Math.max(shape * width, 160), 400);
    canvas.style.height = height + "px";
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const ctx = canvas.getContext("2d");
    ctx.scale(ratio, ratio);
    ctx.font = "12px sans-serif";
    draw(ctx, width, height);
  };
}

// From metres to the canvas, as large as it fits, in the middle: (x, y) => [px, py].
function fitting([x0, x1], [y0, y1], width, height, margin) {
  const scale = Math.min((width - 2 * margin) / (x1 - x0), (height - 2 * margin) / (y1 - y0));
  const left = (width - scale * (x1 - x0)) / 2, top = (height - scale * (y1 - y0)) / 2;
  return (x, y) => [left + scale * (x - x0), height - top - scale * (y - y0)];
}

function drawCells(ctx, width, height, {cells, x, y}) {
  const at = fitting([x[0], x.at(-1)], [y[0], y.at(-1)], width, height, 2);
  const known = cells.filter(value => value !== null);
  const low = Math.min(...known), high = Math.max(...known);
  const columns = x.length - 1, written = columns <= 8;
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  cells.forEach((value, c) => {
    const i = c % columns, j = Math.floor(c / columns);
    const [left, bottom] = at(x[i], y[j]), [right, top] = at(x[i + 1], y[j + 1]);
    const share = high > low ? (value - low) / (high - low) : 0.5;
    ctx.fillStyle = value === null ? "#e2e6eb" : colour(share);
    ctx.fillRect(left, top, right - left - 1, bottom - top - 1);
    if (!written || value === null) return;
    ctx.fillStyle = share > 0.6 ? "#1d2733" : "#ffffff";
    ctx.fillText(value.toFixed(3), (left + right) / 2, (top + bottom) / 2);
  });
}

// Steps, one a row of cells; at least a hundredth wide, so that round-off does not look like a profile.
function drawProfile(ctx, width, height, {profile, y}) {
  const known = profile.filter(value => value !== null);
  const middle = (Math.min(...known) + Math.max(...known)) / 2;
  const half = Math.max(0.005, 0.55 * (Math.max(...known) - Math.min(...known)));
  const low = middle - half, high = middle + half, unit = unitFor("m", y.at(-1) - y[0]);
  const left = 52, base = height - 40, top = 8, right = width - 14;
  const px = value => left + (value - low) / (high - low) * (right - left);
  const py = value => base - (value - y[0]) / (y.at(-1) - y[0]) * (base - top);
  ctx.strokeStyle = "#e8ecf1";
  ctx.fillStyle = "#5b6775";
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
  ctx.strokeStyle = COLOURS[0];
  ctx.lineWidth = 2;
  ctx.beginPath();
  profile.forEach((value, j) => {
    if (value === null) return;
    j && profile[j - 1] !== null ? ctx.lineTo(px(value), py(y[j])) : ctx.moveTo(px(value), py(y[j]));
    ctx.lineTo(px(value), py(y[j + 1]));
  });
  ctx.stroke();
}

function placeDensity(density) {
  const {cells, x, y} = density, known = cells.filter(value => value !== null);
  const note = `From ${digits(Math.min(...known))} to ${digits(Math.max(...known))} in ` +
    `${x.length - 1} × ${y.length - 1} cells between the tools, in the last frame.`;
  return [figureCard("Local relative density", note, (y.at(-1) - y[0]) / (x.at(-1) - x[0]),
                     (ctx, width, height) => drawCells(ctx, width, height, density)),
          figureCard("Relative density along the height", "Of every row of cells, in the last frame.",
                     0.75, (ctx, width, height) => drawProfile(ctx, width, height, density))];
}

// lines: x, y of both ends and the force, five numbers each.
function drawNetwork(ctx, width, height, lines) {
  const ends = k => lines.filter((_, i) => i % 5 === k || i % 5 === k + 2);
  const range = values => values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)],
                                        [Infinity, -Infinity]);
  const at = fitting(range(ends(0)), range(ends(1)), width, height, 8);
  const most = largest(lines.filter((_, i) => i % 5 === 4));
  ctx.lineCap = "round";
  for (let i = 0; i < lines.length; i += 5) {
    const share = lines[i + 4] / most;
    ctx.strokeStyle = colour(0.9 * (1 - share));
    ctx.lineWidth = Math.max(0.5, 9 * share);
    ctx.beginPath();
    ctx.moveTo(...at(lines[i], lines[i + 1]));
    ctx.lineTo(...at(lines[i + 2], lines[i + 3]));
    ctx.stroke();
  }
}

// Shares of sectors of half a turn, drawn on both sides.
function drawRose(ctx, width, height, {number, force}) {
  const sectors = number.length, step = Math.PI / sectors, radius = Math.min(width, height) / 2 - 22;
  const most = Math.max(...number, ...force) || 1;
  ctx.translate(width / 2, height / 2);
  const petals = (shares, fill, stroke) => shares.forEach((share, k) => {
    for (const turn of [0, Math.PI]) {
      const middle = -(k * step + turn);  // the canvas looks down
      ctx.beginPath();
      ctx.moveTo(0, 0);
      ctx.arc(0, 0, radius * share / most, middle - step / 2, middle + step / 2);
      ctx.closePath();
      if (fill) { ctx.fillStyle = fill; ctx.fill(); }
      ctx.strokeStyle = stroke;
      ctx.stroke();
    }
  });
  ctx.strokeStyle = "#dde3ea";
  for (const share of [0.5, 1]) {
    ctx.beginPath();
    ctx.arc(0, 0, radius * share, 0, 2 * Math.PI);
    ctx.stroke();
  }
  ctx.fillStyle = "#5b6775";
  ctx.textAlign = "center";
  ctx.fillText(percent(most), 0, -radius - 8);
  petals(force, "rgba(0, 114, 178, 0.55)", "#0072b2");
  petals(number, null, "#d55e00");
}

async function placeNetwork(network) {
  const lines = await floats("network");
  if (!lines.length) return [];
  const most = withUnit(largest(lines.filter((_, i) => i % 5 === 4)), network.unit);
  return [
    figureCard("Contact forces", "Lines join the centres of particles that touch, and lead to the " +
               `tools; as wide as the normal force. Largest: ${most}. Last frame.`, 0.9,
               (ctx, width, height) => drawNetwork(ctx, width, height, lines)),
    figureCard("Directions of the contact normals", "Between particles. Filled: shares of the " +
               "normal force; outlined: shares of the number. Last frame.", 0.9,
               (ctx, width, height) => drawRose(ctx, width, height, network))];
}

async function showObserved(head) {
  const figures = [...(head.density ? placeDensity(head.density) : []),
                   ...(head.network ? await placeNetwork(head.network) : [])];
  const paint = () => figures.forEach(figure => figure());
  paint();
  addEventListener("resize", paint);
}
