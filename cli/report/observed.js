// Local densities and the contact network of the last frame, where the run has recorded them.
"use strict";

// A canvas in a card of its own; `shape`: height over width of what draw(ctx, width, height) draws.
function figureCard(title, note, shape, draw) {
  const canvas = element("canvas", {className: "figure"}), host = card(title);
  host.append(canvas, element("p", {className: "note", textContent: note}));
  const paint = () => {
    const ratio = devicePixelRatio || 1, width = host.clientWidth;
    const height = Math.min(Math.max(shape * width, 160), 480);
    canvas.style.height = height + "px";
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const ctx = canvas.getContext("2d");
    ctx.scale(ratio, ratio);
    ctx.font = "12px sans-serif";
    draw(ctx, width, height);
  };
  new ResizeObserver(paint).observe(host);
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
  const columns = x.length - 1, written = columns <= 10;
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

function showDensity(density) {
  const {cells, profile, x, y} = density, known = cells.filter(value => value !== null);
  const note = `From ${digits(Math.min(...known))} to ${digits(Math.max(...known))} in ` +
    `${x.length - 1} × ${y.length - 1} cells between the tools, in the last frame.`;
  figureCard("Local relative density", note, (y.at(-1) - y[0]) / (x.at(-1) - x[0]),
             (ctx, width, height) => drawCells(ctx, width, height, density));
  const rows = profile.map((value, j) => [value, (y[j] + y[j + 1]) / 2])
    .filter(([value]) => value !== null);
  if (rows.length < 2) return;
  const xs = {label: "relative density", unit: "-", values: rows.map(row => row[0])};
  drawChart(card("Relative density along the height"),
            {x: xs, y: "height", lines: [{label: "height", unit: "m", values: rows.map(r => r[1])}]});
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

async function showNetwork(network) {
  const lines = await floats("network");
  if (!lines.length) return;
  const most = withUnit(largest(lines.filter((_, i) => i % 5 === 4)), network.unit);
  figureCard("Contact forces", "Lines join the centres of particles that touch, and lead to the " +
             `tools; as wide as the normal force. Largest: ${most}. Last frame.`, 1,
             (ctx, width, height) => drawNetwork(ctx, width, height, lines));
  figureCard("Directions of the contact normals", "Between particles. Filled: shares of the normal " +
             "force; outlined: shares of the number. Last frame.", 1,
             (ctx, width, height) => drawRose(ctx, width, height, network));
}

async function showObserved(head) {
  if (head.density) showDensity(head.density);
  if (head.network) await showNetwork(head.network);
}
