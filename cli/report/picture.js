// The moving picture: quads filled by value on a canvas, particle outlines, tools, legend.
"use strict";

// Viridis, which the colour-blind can read and a grey printer keeps in order.
const VIRIDIS = [[68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142],
                 [33, 145, 140], [34, 168, 132], [68, 191, 112], [122, 209, 81], [189, 223, 38],
                 [253, 231, 37]];
const COLOUR_COUNT = 256, NO_NUMBER = 65535, MOST_EDGED = 300000;

function colour(share) {
  const last = VIRIDIS.length - 1, at = share * last, i = Math.min(Math.floor(at), last - 1);
  const mix = k => Math.round(VIRIDIS[i][k] + (at - i) * (VIRIDIS[i + 1][k] - VIRIDIS[i][k]));
  return `rgb(${mix(0)},${mix(1)},${mix(2)})`;
}
const COLOUR_TABLE = Array.from({length: COLOUR_COUNT}, (_, i) => colour(i / (COLOUR_COUNT - 1)));

// Edges that one quad alone has: the outlines of the particles. [a0, b0, a1, b1, ...]
function outlineEdges(quads, nodes) {
  if (quads.length / 4 > MOST_EDGED) return [];
  const once = new Map();
  for (let i = 0; i < quads.length; ++i) {
    const a = quads[i], b = quads[i % 4 === 3 ? i - 3 : i + 1];
    const key = Math.min(a, b) * nodes + Math.max(a, b);
    once.has(key) ? once.delete(key) : once.set(key, [a, b]);
  }
  return [...once.values()].flat();
}

class Picture {
  constructor(head, quads, history) {
    Object.assign(this, {head, quads, history, field: 0, sameRange: true});
    this.frame = head.frames.length - 1;
    this.canvas = document.getElementById("picture");
    this.outline = outlineEdges(quads, head.mesh.nodes);
    this.width = Math.max(head.high[0] - head.low[0], head.high[1] - head.low[1]) || 1;
    this.view = this.wholeView();
    this.listen();
  }

  // The part of the world to be seen: the frames' extent and, where near, the tools' surfaces.
  wholeView() {
    const [x0, y0] = this.head.low, [x1, y1] = this.head.high, margin = 0.03 * this.width;
    return {x0: x0 - margin, y0: y0 - margin, x1: x1 + margin, y1: y1 + margin};
  }

  async load() {
    const prefix = `frame-${this.frame}-`;
    this.position = await shorts(prefix + "position", 2);
    this.codes = this.head.fields.length ? await shorts(prefix + this.field, 1) : null;
  }

  // Frames and fields may be asked for faster than they can be unpacked: the last request wins.
  async show(change) {
    Object.assign(this, change);
    if (this.busy) { this.again = true; return; }
    this.busy = true;
    try {
      do { this.again = false; await this.load(); } while (this.again);
    } finally { this.busy = false; }
    this.draw();
  }

  layout() {
    const ratio = devicePixelRatio || 1, whole = this.wholeView();
    const width = this.canvas.clientWidth, room = width - 130;
    const shape = (whole.y1 - whole.y0) / (whole.x1 - whole.x0);
    const height = Math.round(Math.min(Math.max(room * shape, 240), 640));
    this.canvas.style.height = height + "px";
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const {x0, y0, x1, y1} = this.view;
    const scale = Math.min(room / (x1 - x0), height / (y1 - y0));
    const left = (room - scale * (x1 - x0)) / 2, top = (height - scale * (y1 - y0)) / 2;
    this.place = {ratio, room, height, scale, x: left - scale * x0, y: height - top + scale * y0};
  }

  // Canvas coordinates of every node of the frame, x and y interleaved.
  nodesOnCanvas() {
    const {scale, x, y} = this.place, step = this.width / 65534, [lowX, lowY] = this.head.low;
    const at = new Float32Array(this.position.length);
    for (let i = 0; i < at.length; i += 2) {
      at[i] = x + scale * (lowX + step * this.position[i]);
      at[i + 1] = y - scale * (lowY + step * this.position[i + 1]);
    }
    return at;
  }

  // The codes that the two ends of the colours stand for.
  codeRange() {
    if (this.sameRange || !this.codes) return [0, 65534];
    let low = 65534, high = 0;
    for (const code of this.codes) {
      if (code !== NO_NUMBER) { low = Math.min(low, code); high = Math.max(high, code); }
    }
    return low < high ? [low, high] : [0, 65534];
  }

  valueOf(code) {
    const {low, high} = this.head.fields[this.field];
    return low + (high - low) * code / 65534;
  }

  draw() {
    this.layout();
    const ctx = this.canvas.getContext("2d"), {ratio, room, height} = this.place;
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.save();
    ctx.beginPath();
    ctx.rect(0, 0, room, height);
    ctx.clip();
    this.at = this.nodesOnCanvas();
    this.forTools(ctx, far => ctx.fillRect(-far, 0, 2 * far, far), "#e2e6eb");
    this.drawPolylines(ctx, true);
    const drawn = this.drawQuads(ctx);
    this.drawOutlines(ctx);
    this.drawSurfaces(ctx);
    ctx.restore();
    this.drawScaleBar(ctx);
    if (this.codes) this.drawLegend(ctx);
    this.caption();
    document.body.dataset.drawnQuads = drawn;
  }

  // One path a colour: 256 fills instead of one a quad.
  drawQuads(ctx) {
    const count = this.quads.length / 4, bins = Array.from({length: COLOUR_COUNT + 1}, () => []);
    const [low, high] = this.codeRange(), last = COLOUR_COUNT - 1;
    for (let c = 0; c < count; ++c) {
      const code = this.codes ? this.codes[c] : NO_NUMBER;
      const bin = code === NO_NUMBER ? COLOUR_COUNT :
        Math.min(Math.floor((code - low) / (high - low) * COLOUR_COUNT), last);
      bins[bin].push(c);
    }
    ctx.lineWidth = 0.6;  // hides the seams that antialiasing leaves between neighbours
    ctx.lineJoin = "round";
    bins.forEach((cells, bin) => {
      if (!cells.length) return;
      ctx.fillStyle = ctx.strokeStyle = bin === COLOUR_COUNT ? "#c9d0d8" : COLOUR_TABLE[bin];
      ctx.beginPath();
      for (const c of cells) this.tracePath(ctx, c);
      ctx.fill();
      if (count <= MOST_EDGED) ctx.stroke();
    });
    return count;
  }

  tracePath(ctx, cell) {
    for (let k = 0; k < 4; ++k) {
      const node = 2 * this.quads[4 * cell + k], x = this.at[node], y = this.at[node + 1];
      k ? ctx.lineTo(x, y) : ctx.moveTo(x, y);
    }
    ctx.closePath();
  }

  drawOutlines(ctx) {
    ctx.beginPath();
    for (let i = 0; i < this.outline.length; i += 2) {
      ctx.moveTo(this.at[2 * this.outline[i]], this.at[2 * this.outline[i] + 1]);
      ctx.lineTo(this.at[2 * this.outline[i + 1]], this.at[2 * this.outline[i + 1] + 1]);
    }
    ctx.strokeStyle = "#1d2733";
    ctx.lineWidth = 0.8;
    ctx.stroke();
  }

  // A tool's point in this frame: the summary has its end, the history how it came there.
  toolPoint(tool) {
    const time = this.history.get("time").values, now = this.head.frames[this.frame].time;
    let sample = time.findIndex(t => t >= now * (1 - 1e-6));
    if (sample < 0) sample = time.length - 1;
    return ["x", "y"].map((axis, k) => {
      const series = this.history.get(`tool/${tool.name}/position_${axis}`);
      if (!series || sample < 0) return tool.point[k];
      return tool.point[k] + series.values[sample] - series.values[time.length - 1];
    });
  }

  // Runs `action` for each tool, in axes where the tool's body is all that lies below y = 0.
  forTools(ctx, action, style) {
    const {scale, x, y, room, height} = this.place;
    ctx.fillStyle = style;
    for (const tool of this.head.summary.tools || []) {
      if (!Array.isArray(tool.point) || !Array.isArray(tool.normal)) continue;
      const [px, py] = this.toolPoint(tool), before = ctx.getTransform();
      ctx.translate(x + scale * px, y - scale * py);
      ctx.rotate(Math.atan2(tool.normal[0], tool.normal[1]));
      action(2 * (room + height));
      ctx.setTransform(before);
    }
  }

  // The surfaces as lines, each only where no other tool's body covers it.
  drawSurfaces(ctx) {
    const thick = 2;
    ctx.save();
    this.forTools(ctx, far => {
      ctx.beginPath();
      ctx.rect(-far, thick - far, 2 * far, far);
      ctx.clip();
    });
    this.forTools(ctx, far => ctx.fillRect(-far, 0, 2 * far, thick), "#3d4855");
    this.drawPolylines(ctx, false);
    ctx.restore();
  }

  // Tools given by points: filled to the right of the way along them, or as a line. Both ends go on
  // straight.
  drawPolylines(ctx, filled) {
    const {scale, x, y, room, height} = this.place, far = 2 * (room + height);
    for (const tool of this.head.summary.tools || []) {
      if (!Array.isArray(tool.points)) continue;
      const [px, py] = this.toolPoint({name: tool.name, point: [0, 0]});
      const points = tool.points.map(p => [x + scale * (p[0] + px), y - scale * (p[1] + py)]);
      const beyond = (end, inner) => {
        const dx = end[0] - inner[0], dy = end[1] - inner[1], length = Math.hypot(dx, dy);
        return [far * dx / length, far * dy / length];
      };
      const last = points.length - 1;
      const [ax, ay] = beyond(points[0], points[1]), [bx, by] = beyond(points[last], points[last - 1]);
      const from = [points[0][0] + ax, points[0][1] + ay];
      const to = [points[last][0] + bx, points[last][1] + by];
      ctx.beginPath();
      for (const p of [from, ...points, to]) ctx.lineTo(p[0], p[1]);
      ctx.strokeStyle = "#3d4855";
      ctx.lineWidth = 2;
      if (!filled) { ctx.stroke(); continue; }
      ctx.lineTo(to[0] - by, to[1] + bx);
      ctx.lineTo(from[0] + ay, from[1] - ax);
      ctx.fillStyle = "#e2e6eb";
      ctx.fill();
    }
  }

  drawScaleBar(ctx) {
    const {room, height, scale} = this.place, metres = niceTicks(0, 100 / scale, 2.5)[1];
    const left = room + 22, base = height - 4;
    ctx.fillStyle = "#1d2733";
    ctx.fillRect(left, base - 3, metres * scale, 3);
    ctx.font = "12px sans-serif";
    ctx.textAlign = "left";
    ctx.fillText(withUnit(metres, "m"), left, base - 9);
  }

  drawLegend(ctx) {
    const {room, height} = this.place, field = this.head.fields[this.field];
    const left = room + 22, top = 34, tall = height - top - 54, wide = 18;
    for (let i = 0; i < tall; ++i) {
      ctx.fillStyle = COLOUR_TABLE[Math.round((1 - i / (tall - 1)) * (COLOUR_COUNT - 1))];
      ctx.fillRect(left, top + i, wide, 1.5);
    }
    const [low, high] = this.codeRange().map(code => this.valueOf(code));
    const unit = unitFor(field.unit, Math.max(Math.abs(low), Math.abs(high)));
    ctx.fillStyle = "#1d2733";
    ctx.font = "12px sans-serif";
    ctx.textAlign = "left";
    ctx.fillText(unit.label || "–", left, top - 14);
    if (!(high > low)) {
      ctx.fillText(digits(low * unit.factor), left + wide + 8, top + 8);
      return;
    }
    for (const tick of niceTicks(low * unit.factor, high * unit.factor, 6)) {
      const at = top + tall * (1 - (tick / unit.factor - low) / (high - low));
      ctx.fillRect(left + wide, at - 0.5, 5, 1);
      ctx.fillText(digits(tick), left + wide + 9, at + 4);
    }
  }

  caption() {
    const {frames, fields} = this.head, {time, step} = frames[this.frame];
    const field = fields[this.field], meaning = field ? field.meaning + ". " : "";
    document.getElementById("picture-title").textContent = field ? titled(field.name) : "Particles";
    document.getElementById("picture-note").textContent =
      `${meaning}Frame ${this.frame + 1} of ${frames.length}: ${withUnit(time, "s")}, ` +
      `step ${step.toLocaleString("en")}.`;
  }

  // The cell under a point of the canvas, or -1.
  cellAt(px, py) {
    for (let c = 0; c < this.quads.length / 4; ++c) {
      let inside = false;
      for (let k = 0, before = 3; k < 4; before = k++) {
        const a = 2 * this.quads[4 * c + k], b = 2 * this.quads[4 * c + before];
        const ax = this.at[a], ay = this.at[a + 1], bx = this.at[b], by = this.at[b + 1];
        if (ay > py !== by > py && px < (bx - ax) * (py - ay) / (by - ay) + ax) inside = !inside;
      }
      if (inside) return c;
    }
    return -1;
  }

  tellValue(event) {
    if (!this.at || !this.codes) return;
    const cell = this.cellAt(event.offsetX, event.offsetY), code = this.codes[cell];
    this.canvas.title = cell < 0 || code === NO_NUMBER ? "" :
      withUnit(this.valueOf(code), this.head.fields[this.field].unit);
  }

  zoom(event) {
    event.preventDefault();
    const factor = Math.exp(0.0015 * event.deltaY), {scale, x, y} = this.place, view = this.view;
    const atX = (event.offsetX - x) / scale, atY = (y - event.offsetY) / scale;
    for (const side of ["x0", "x1"]) view[side] = atX + factor * (view[side] - atX);
    for (const side of ["y0", "y1"]) view[side] = atY + factor * (view[side] - atY);
    this.draw();
  }

  drag(event) {
    const dx = event.movementX / this.place.scale, dy = event.movementY / this.place.scale;
    this.view.x0 -= dx;
    this.view.x1 -= dx;
    this.view.y0 += dy;
    this.view.y1 += dy;
    this.draw();
  }

  listen() {
    const canvas = this.canvas;
    canvas.addEventListener("wheel", event => this.zoom(event), {passive: false});
    canvas.addEventListener("pointerdown", event => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove",
                            event => event.buttons & 1 ? this.drag(event) : this.tellValue(event));
    canvas.addEventListener("dblclick", () => { this.view = this.wholeView(); this.draw(); });
    addEventListener("resize", () => { if (this.at) this.draw(); });
  }
}
