// Animated view of a 2D run: cells coloured by value, outlines, tools, contact forces, density cells.
"use strict";

const MOST_STROKED = 12000;  // edges drawn as lines; more are drawn pixel by pixel
const MOST_SEARCHED = 100000;  // maximum number of cells searched for outline edges
const LEGEND_WIDTH = 84, MOST_LEGEND_WIDTH = 180;
const MARGIN = 0.07;  // around the powder, as a fraction of its size

// Fields that number something, with the number of none; and fields that count.
const NUMBERED = {fragment: -1, force_chain: 0}, COUNTS = new Set(["coordination", "tools_touched"]);

// Edges that belong to only one cell: the outlines of the particles. [a0, b0, a1, b1, ...]
function outlineEdges(cells, nodes) {
  const once = new Map();
  for (let i = 0; i < cells.length; ++i) {
    const a = cells[i], b = cells[i % 4 === 3 ? i - 3 : i + 1];
    if (a === b) continue;
    const key = Math.min(a, b) * nodes + Math.max(a, b);
    once.has(key) ? once.delete(key) : once.set(key, [a, b]);
  }
  return [...once.values()].flat();
}

class FieldView {
  // whole: initial {width, height} of the view in metres, for views with a common scale; name: of the run, beside others.
  constructor(host, run, {whole = null, most = 560, name = ""} = {}) {
    Object.assign(this, {
      run,
      whole,
      most,
      of: name ? ` of ${name}` : '',
      shown: '',
      contacts: false,
      bonds: false,
      sameRange: true,
      ranges: null,
      frame: run.frames.length - 1,
      share: 1,
      raster: new Raster()
    });
    this.measure();
    this.canvas = element("canvas", {className: "picture", tabIndex: 0, role: "img"});
    this.tip = element("div", {className: "tip", hidden: true});
    this.note = element("p", {className: "note"});
    this.fit = element("button", {type: "button", className: "fit", textContent: "Fit", title: "Show all (0)",
                                  hidden: true, onclick: () => this.showAll()});
    host.classList.add("field");
    host.replaceChildren(this.canvas, this.tip, this.fit, this.note);
    this.prepare();
    this.listen();
    for (const on of [onUnits, onTheme, onMap]) on(() => { if (this.canvas.isConnected) this.draw(); });
    onResize(host, () => { if (this.at && host.clientWidth !== this.drawnWidth) this.draw(); });
  }

  measure() {
    const {low, high} = this.run.head;
    this.width = Math.max(...high.map((end, k) => end - low[k])) || 1;
  }

  // The same particles in more frames: the view stays.
  async renew(run) {
    while (this.busy) await this.busy;  // what it loads belongs to the extent of the run as it was
    this.run = run;
    this.measure();
    return this.showShare(this.share);
  }

  prepare() {
    const {run} = this, {drawn_cells: cells, drawn_nodes: nodes, fans} = run.head.mesh;
    const edges = cells <= (fans ? MOST_STROKED : MOST_SEARCHED) ? outlineEdges(run.cells, nodes) : [];
    this.outline = edges.length / 2 <= MOST_STROKED ? edges : [];
  }

  // The available fields: [value, label].
  get choices() {
    const fields = this.run.head.fields.map(field => [field.name, titled(nameOf(field.name).words)]);
    if (this.run.densities.length) fields.push(["density", "Local density"]);
    this.run.tags.forEach(({name}) => fields.push([name, titled(name)]));
    return [...fields, ["number", "Particle number"], ["", "Outlines only"]];
  }

  // Bounds over all frames, so that the canvas keeps its shape on the page.
  wholeSize() {
    const {low, high} = this.run.head, {width, height} = this.whole || {width: high[0] - low[0], height: high[1] - low[1]};
    const margin = 2 * MARGIN * Math.max(width, height);
    return {width: width + margin, height: height + margin};
  }

  // Bounds of the powder in this frame, with the adjacent tool faces.
  frameView() {
    const {low} = this.run.head, step = this.width / 65534, {whole} = this;
    const box = [0, 1].map(k => {
      let least = Infinity, most = -Infinity;
      for (let i = k; i < this.position.length; i += 2) {
        least = Math.min(least, this.position[i]);
        most = Math.max(most, this.position[i]);
      }
      return [low[k] + step * least, low[k] + step * most];
    });
    const take = point => box.forEach((range, k) => {
      range[0] = Math.min(range[0], point[k]);
      range[1] = Math.max(range[1], point[k]);
    });
    const {cell} = this.run.frames[this.frame];
    if (cell) {
      const [x0, y0, ax, ay, bx, by] = cell;
      [[0, 0], [1, 0], [0, 1], [1, 1]].forEach(([i, j]) => take([x0 + i * ax + j * bx, y0 + i * ay + j * by]));
    }
    const middle = box.map(([from, to]) => (from + to) / 2), far = Math.hypot(...box.map(([from, to]) => to - from));
    for (const tool of this.tools()) {
      const point = this.closestOnFace(tool, middle);
      if (Math.hypot(point[0] - middle[0], point[1] - middle[1]) < far) take(point);
    }
    const [wide, tall] = whole ? [whole.width, whole.height] : box.map(([from, to]) => to - from);
    const margin = MARGIN * Math.max(wide, tall), [x, y] = box.map(([from, to]) => (from + to) / 2);
    return {x0: x - wide / 2 - margin, x1: x + wide / 2 + margin, y0: y - tall / 2 - margin, y1: y + tall / 2 + margin};
  }

  async load() {
    const {run, frame} = this, field = run.field(this.shown);
    const [position, codes, corners, lines, bondLines] = await Promise.all([
      run.positions(frame), field < 0 ? null : run.codes(frame, field), run.toolCorners(frame),
      this.contacts ? run.contactLines(frame) : null, this.bonds ? run.bondLines(frame) : null
    ]);
    const tag = field < 0 ? tagsOf(run).find(({name}) => name === this.shown) : null;
    Object.assign(this, {position, codes, corners, lines, bondLines, tag, field: run.head.fields[field]});
  }

  // Requests may come faster than frames can be unpacked: the last one wins.
  async show(change) {
    Object.assign(this, change);
    if (this.busy) { this.again = true; return this.busy; }
    this.busy = (async () => {
      try {
        do { this.again = false; await this.load(); this.draw(); } while (this.again);
      } finally { this.busy = null; }
    })();
    return this.busy;
  }
  showShare(share = this.share) {
    this.share = share;
    return this.show({frame: this.run.frameAt(share * this.run.frames.at(-1).time)});
  }

  layout() {
    const ratio = Math.min(devicePixelRatio || 1, 2), whole = this.wholeSize(), {canvas} = this;
    const view = this.view || this.frameView();  // without a user-chosen view, follow the powder
    const width = this.drawnWidth = canvas.parentElement.clientWidth, room = width - this.legendWidth();
    const height = Math.round(Math.min(Math.max(room * whole.height / whole.width, 200), this.most));
    canvas.style.height = height + "px";
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const scale = Math.min(room / (view.x1 - view.x0), height / (view.y1 - view.y0));
    const left = (room - scale * (view.x1 - view.x0)) / 2, top = (height - scale * (view.y1 - view.y0)) / 2;
    this.place = {ratio, width, room, height, scale, view, x: left - scale * view.x0, y: height - top + scale * view.y0};
  }

  legendWidth() {
    if (!this.tag || !this.tag.names.length) return LEGEND_WIDTH;
    const ctx = this.canvas.getContext("2d");
    ctx.font = "12px system-ui, sans-serif";
    const widest = Math.max(...this.tag.names.map(name => ctx.measureText(name).width));
    return Math.min(MOST_LEGEND_WIDTH, Math.max(LEGEND_WIDTH, Math.ceil(widest) + 38));
  }

  // Canvas coordinates of all nodes of the frame, x and y interleaved.
  nodesOnCanvas() {
    const {scale, x, y} = this.place, step = this.width / 65534, [lowX, lowY] = this.run.head.low;
    const at = new Float32Array(this.position.length);
    for (let i = 0; i < at.length; i += 2) {
      at[i] = x + scale * (lowX + step * this.position[i]);
      at[i + 1] = y - scale * (lowY + step * this.position[i + 1]);
    }
    return at;
  }

  // The colour limits, in SI.
  range() {
    if (this.ranges) return this.ranges(this.shown);
    const density = this.shown === "density", {run, field, sameRange} = this;
    if (this.tag) return [0, run.head.mesh.particles - 1];
    if (density) {
      return bounds([sameRange ? run.densities : this.densityCells().filter(value => value !== null)]);
    }
    if (sameRange || !this.codes) return [field.low, field.high];
    let low = NO_NUMBER, high = -1;
    for (const code of this.codes) {
      if (code !== NO_NUMBER) { low = Math.min(low, code); high = Math.max(high, code); }
    }
    return low < high ? [this.valueOf(low), this.valueOf(high)] : [field.low, field.high];
  }
  valueOf(code) { return this.field.low + (this.field.high - this.field.low) * code / this.field.levels; }
  densityCells() { return this.run.frames[this.frame].density?.cells || []; }

  draw() {
    if (!this.position) return;
    const start = performance.now();
    this.layout();
    const ctx = this.canvas.getContext("2d"), {ratio, room, height} = this.place;
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.font = "12px system-ui, sans-serif";
    ctx.save();
    ctx.beginPath();
    ctx.rect(0, 0, room, height);
    ctx.clip();
    this.at = this.nodesOnCanvas();
    this.drawBodies(ctx);
    this.drawCells(ctx);
    if (this.shown === "density") this.drawDensity(ctx);
    this.drawOutlines(ctx);
    this.drawCell(ctx);
    this.drawFaces(ctx);
    if (this.bondLines) this.drawBonds(ctx);
    if (this.lines) this.drawContacts(ctx);
    ctx.restore();
    this.drawScaleBar(ctx);
    this.drawLegend(ctx);
    this.tell();
    this.tellPointer();
    this.fit.hidden = !this.view;
    this.canvas.dataset.drawnIn = (performance.now() - start).toFixed(1);
    this.canvas.dataset.drawn = `${this.frame} ${this.shown}`;
  }

  // One packed colour per cell.
  cellColours() {
    const none = theme().none.match(/\w\w/g).map(two => parseInt(two, 16)), plain = packed(...none);
    const count = this.run.particleOf.length, colours = new Uint32Array(count).fill(plain);
    if (this.tag && this.tag.names.length) {
      const {values} = this.tag, table = this.tagColours().map(rgb => packed(...rgb));
      return colours.map((_, c) => table[values[this.run.particleOf[c]]]);
    }
    if (this.tag) {
      const [low, high] = this.range(), share = number => high > low ? (number - low) / (high - low) : 0.5;
      return colours.map((_, c) => packed(...mapColour(share(this.run.particleOf[c]))));
    }
    if (!this.codes) return colours;
    if (this.showsNumbers) {
      for (let c = 0; c < count; ++c) {
        const number = this.codes[c] === NO_NUMBER ? NaN : Math.round(this.valueOf(this.codes[c]));
        if (number !== NUMBERED[this.field.name] && number >= 0) colours[c] = packed(...fragmentColour(number));
      }
      return colours;
    }
    const [low, high] = this.range(), table = Array.from({length: 256}, (_, i) => packed(...mapColour(i / 255)));
    const {field} = this, step = (field.high - field.low) / field.levels, factor = high > low ? 256 / (high - low) : 0;
    for (let c = 0; c < count; ++c) {
      const code = this.codes[c];
      if (code === NO_NUMBER) continue;
      colours[c] = table[Math.max(0, Math.min(255, Math.floor((field.low + step * code - low) * factor)))];
    }
    return colours;
  }

  // One colour per name; runs shown side by side use the same colour for the same name.
  tagColours() {
    const {tag} = this, all = this.allNames ? this.allNames(tag.name) : tag.names;
    return tag.names.map(name => tagColour(all.indexOf(name), all.length));
  }

  get showsNumbers() {
    return this.codes && this.field.name in NUMBERED;
  }

  // Thin lines along the bonds; cracks coloured by fracture mode.
  drawBonds(ctx) {
    const {bonds, cracks} = this.bondLines, {scale, x, y} = this.place;
    const line = (lines, i) => {
      ctx.moveTo(x + scale * lines[i], y - scale * lines[i + 1]);
      ctx.lineTo(x + scale * lines[i + 2], y - scale * lines[i + 3]);
    };
    ctx.lineCap = 'round';
    ctx.beginPath();
    for (let i = 0; i < bonds.length; i += 4) line(bonds, i);
    Object.assign(ctx, {strokeStyle: isDark() ? '#9aa6b4' : '#5b6672', lineWidth: 1});
    ctx.stroke();
    ctx.lineWidth = 2;
    for (let i = 0; i < cracks.length; i += 5) {
      ctx.beginPath();
      line(cracks, i);
      ctx.strokeStyle = modeColour(cracks[i + 4]);
      ctx.stroke();
    }
  }

  drawCells(ctx) {
    const {ratio, room, height} = this.place, {run, raster} = this;
    raster.resize(Math.max(1, Math.round(room * ratio)), Math.max(1, Math.round(height * ratio)));
    raster.fill(run.cells, ratio === 1 ? this.at : this.at.map(v => v * ratio));
    const size = Math.sqrt(this.place.scale ** 2 * (run.head.high[0] - run.head.low[0]) *
      (run.head.high[1] - run.head.low[1]) / run.head.mesh.particles);
    const edged = !this.outline.length && size > 7;  // smaller particles would consist of outline only
    const line = packed(...(isDark() ? [12, 16, 21] : [29, 39, 51]));
    ctx.drawImage(raster.paint(this.cellColours(), edged ? run.particleOf : null, line), 0, 0, room, height);
  }

  drawOutlines(ctx) {
    const {outline, at} = this, path = this.outlinePath = new Path2D();
    for (let i = 0; i < outline.length; i += 2) {
      path.moveTo(at[2 * outline[i]], at[2 * outline[i] + 1]);
      path.lineTo(at[2 * outline[i + 1]], at[2 * outline[i + 1] + 1]);
    }
    ctx.strokeStyle = isDark() && !this.codes && !this.tag ? "#c4cdd8" : "#1d2733";
    ctx.lineWidth = 0.7;
    ctx.stroke(path);
  }

  // The periodic cell, with pale outlines of the periodic images around it.
  drawCell(ctx) {
    const {cell} = this.run.frames[this.frame], {scale, x, y} = this.place;
    if (!cell) return;
    const [x0, y0, ...vectors] = cell, [ax, ay, bx, by] = vectors.map(length => scale * length);
    ctx.save();
    ctx.strokeStyle = isDark() ? "#c4cdd8" : "#1d2733";
    ctx.lineWidth = 0.7;
    ctx.globalAlpha = 0.3;
    for (let i = -1; i <= 1; ++i) {
      for (let j = -1; j <= 1; ++j) {
        if (!i && !j) continue;
        ctx.translate(i * ax + j * bx, -i * ay - j * by);
        ctx.stroke(this.outlinePath);
        ctx.translate(-i * ax - j * bx, i * ay + j * by);
      }
    }
    ctx.restore();
    ctx.beginPath();
    ctx.moveTo(x + scale * x0, y - scale * y0);
    for (const [i, j] of [[1, 0], [1, 1], [0, 1]])
      ctx.lineTo(x + scale * x0 + i * ax + j * bx, y - scale * y0 - i * ay - j * by);
    ctx.closePath();
    Object.assign(ctx, {strokeStyle: "#d55e00", lineWidth: 1.2});
    ctx.stroke();
  }

  drawDensity(ctx) {
    const density = this.run.frames[this.frame].density, {scale, x: x0, y: y0} = this.place;
    if (!density) return;
    const [low, high] = this.range(), columns = density.x.length - 1;
    density.cells.forEach((value, c) => {
      const i = c % columns, j = Math.floor(c / columns);
      if (value === null) return;
      const left = x0 + scale * density.x[i], top = y0 - scale * density.y[j + 1];
      const wide = scale * (density.x[i + 1] - density.x[i]), tall = scale * (density.y[j + 1] - density.y[j]);
      ctx.globalAlpha = 0.88;
      ctx.fillStyle = colour(high > low ? (value - low) / (high - low) : 0.5);
      ctx.fillRect(left, top, wide - 1, tall - 1);
      ctx.globalAlpha = 1;
      if (wide < 42) return;
      ctx.fillStyle = inkOn(high > low ? (value - low) / (high - low) : 0.5);
      ctx.textAlign = "center";
      ctx.fillText(value.toFixed(3), left + wide / 2, top + tall / 2 + 4);
    });
  }

  // Lines between centres with width proportional to force; five numbers each: both ends, force.
  drawContacts(ctx) {
    const {lines, run} = this, {scale, x, y} = this.place;
    const most = this.mostForce = largest(lines.filter((_, i) => i % 5 === 4)) || 1;
    const size = Math.sqrt((run.head.high[0] - run.head.low[0]) * (run.head.high[1] - run.head.low[1]) /
      run.head.mesh.particles), widest = Math.max(2, 0.15 * size * scale);
    ctx.lineCap = "round";
    for (const [stroke, more] of [["#ffffff", 1.6], ["#b3003c", 0]]) {
      ctx.strokeStyle = stroke;
      for (let i = 0; i < lines.length; i += 5) {
        const wide = widest * lines[i + 4] / most;
        if (wide < 0.15) continue;
        ctx.lineWidth = wide + more;
        ctx.beginPath();
        ctx.moveTo(x + scale * lines[i], y - scale * lines[i + 1]);
        ctx.lineTo(x + scale * lines[i + 2], y - scale * lines[i + 3]);
        ctx.stroke();
      }
    }
  }

  drawScaleBar(ctx) {
    const {room, height, scale} = this.place, most = 66 / scale, power = 10 ** Math.floor(Math.log10(most));
    const metres = [5, 2, 1].find(k => k * power <= most) * power;
    ctx.fillStyle = theme().ink;
    ctx.fillRect(room + 14, height - 6, metres * scale, 3);
    ctx.textAlign = "left";
    ctx.fillText(withUnit(metres, "m"), room + 14, height - 12);
  }

  drawLegend(ctx) {
    const {width, room, height} = this.place, density = this.shown === "density", {tag} = this;
    if (tag && tag.names.length) { drawTagLegend(ctx, room + 14, 16, tag, this.tagColours(), width - room - 14); return; }
    if (!density && !tag && (!this.codes || this.showsNumbers)) return;
    const [low, high] = this.range();
    if (!(low <= high)) return;  // no cell has a value
    drawScale(ctx, room + 14, 26, Math.min(height - 76, 320), {low, high, unit: density || tag ? "-" : this.field.unit,
      isWhole: Boolean(tag) || !density && COUNTS.has(this.field.name)});
  }

  bondsInWords() {
    return ' Grey lines: bonds; cracks from orange (mode I) to blue (mode II).';
  }

  tell() {
    const {run, frame, field} = this, {time, step} = run.frames[frame];
    const name = this.shown === "density" ? "Local relative density" : field ? titled(nameOf(field.name).words)
      : this.tag ? this.tag.names.length ? titled(this.tag.name) : "Particle number" : "Outlines";
    const meaning = field && this.shown !== "density" ? ` (${field.meaning})` : "";
    const contacts = this.lines?.length ? ` Lines: normal contact forces, widest ${withUnit(this.mostForce, "N")}.` : "";
    const bonds = this.bondLines ? this.bondsInWords() : '';
    this.note.textContent = `${name}${meaning} at ${withUnit(time, 's')}, step ${
        step.toLocaleString('en')}.${contacts}${bonds}`;
    this.canvas.setAttribute("aria-label", `Picture of the particles${this.of}. ${this.note.textContent} ` +
      "Plus and minus zoom, 0 shows all.");
  }

  zoomBy(factor, px, py) {
    const {scale, x, y, room, height} = this.place, view = this.own();
    const atX = ((px ?? room / 2) - x) / scale, atY = (y - (py ?? height / 2)) / scale;
    for (const side of ["x0", "x1"]) view[side] = atX + factor * (view[side] - atX);
    for (const side of ["y0", "y1"]) view[side] = atY + factor * (view[side] - atY);
    this.draw();
  }
  moveBy(px, py) {
    const view = this.own(), {scale} = this.place;
    for (const side of ["x0", "x1"]) view[side] -= px / scale;
    for (const side of ["y0", "y1"]) view[side] += py / scale;
    this.draw();
  }
  // A view chosen by the user, which stays fixed.
  own() { return this.view = this.view || {...this.place.view}; }
  showAll() { this.view = null; this.draw(); }

  listen() {
    const {canvas} = this;
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.zoomBy(Math.exp(0.0015 * event.deltaY), event.offsetX, event.offsetY);
    }, {passive: false});
    canvas.addEventListener("pointerdown", event => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", event => {
      this.pointer = {x: event.offsetX, y: event.offsetY};
      event.buttons & 1 ? this.moveBy(event.movementX, event.movementY) : this.tellPointer();
    });
    canvas.addEventListener("pointerleave", () => { this.pointer = null; this.tellPointer(); });
    canvas.addEventListener("dblclick", () => this.showAll());
    onKey(canvas, event => this.key(event));
  }
  key({key}) { return zoomKey(key, factor => this.zoomBy(factor), () => this.showAll()); }
}
