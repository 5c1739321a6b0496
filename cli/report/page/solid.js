// 3D view of a lever: its surface, coloured by displacement, rotated by dragging.
"use strict";

const FIRST_VIEW = {turn: -0.9, tilt: 0.42};

// Of a node, from the displacements of all: their size, or a component.
const shownOf = (moved, shown, node) => shown === "size" ? Math.hypot(moved[3 * node], moved[3 * node + 1], moved[3 * node + 2])
  : moved[3 * node + Number(shown)];

class SolidView {
  static async load(host, run, name) {
    const view = new SolidView(host, run, name);
    [view.faces, view.reference] = await Promise.all([integers(run.prefix + "faces", 4), floats(run.prefix + "reference")]);
    view.measure();
    return view;
  }

  constructor(host, run, name = "") {
    Object.assign(this, {run, of: name ? ` of ${name}` : "", frame: run.frames.length - 1, ...FIRST_VIEW, zoom: 1, larger: 0,
                         shown: "size"});
    this.canvas = element("canvas", {className: "picture", tabIndex: 0, role: "img"});
    this.note = element("p", {className: "note"});
    host.classList.add("field");
    host.replaceChildren(this.canvas, this.note);
    this.listen();
    for (const on of [onUnits, onTheme, onMap]) on(() => { if (this.canvas.isConnected) this.draw(); });
    onResize(host, () => { if (this.moved && host.clientWidth !== this.drawnWidth) this.draw(); });
  }

  get choices() { return [["size", "Displacement"], ["2", "Deflection, along z"], ["1", "Lateral, along y"], ["0", "Along x"]]; }

  measure() {
    const axis = k => bounds([this.reference.filter((_, i) => i % 3 === k)]);
    this.box = [0, 1, 2].map(axis);
    this.middle = this.box.map(([low, high]) => (low + high) / 2);
    this.size = Math.hypot(...this.box.map(([low, high]) => high - low)) || 1;
  }

  // The same lever in more frames: the view stays.
  renew(run) {
    Object.assign(this, {run, larger: 0});
    return this.showShare(this.share ?? 1);
  }

  // Over all frames: the colour limits of every choice, and the largest displacement. It is magnified to an eighth of the
  // size; never reduced.
  async findScale() {
    const names = this.choices.map(([name]) => name), limits = new Map(names.map(name => [name, [Infinity, -Infinity]]));
    let most = 0;
    for (let i = 0; i < this.run.frames.length; ++i) {
      const moved = await this.run.displacements(i);
      most = Math.max(most, largest(moved));
      for (const name of names) {
        limits.set(name, bounds([limits.get(name), Float32Array.from({length: moved.length / 3}, (_, node) => shownOf(moved, name, node))]));
      }
    }
    Object.assign(this, {most, limits});
    const wanted = most > 0 ? this.size / 8 / most : 1, power = 10 ** Math.floor(Math.log10(wanted));
    this.larger = wanted > 1.5 ? Math.floor(wanted / power) * power : 1;
  }

  async show(change) {
    Object.assign(this, change);
    if (!this.larger) await this.findScale();
    const frame = this.frame, moved = await this.run.displacements(frame);
    if (frame !== this.frame) return;
    this.moved = moved;
    this.draw();
  }
  showShare(share) { this.share = share; return this.show({frame: this.run.frameAt(share * this.run.frames.at(-1).time)}); }

  // Colour limits, the same in all frames.
  range() { return this.limits.get(this.shown); }

  valueOf(node) { return shownOf(this.moved, this.shown, node); }

  // Pixels per metre that fit the whole lever in the initial view, including its motion; `zoom` multiplies it.
  fit() {
    const [right, up] = [0, 1].map(k => {
      const [low, high] = bounds([this.corners().map(corner => this.seen(corner, FIRST_VIEW)[k])]);
      return high - low + this.larger * this.most;
    });
    return 0.95 * Math.min(this.place.room / right, this.place.height / up);
  }
  corners() {
    return [0, 1, 2, 3, 4, 5, 6, 7].map(i => [0, 1, 2].map(k => this.box[k][i >> k & 1] - this.middle[k]));
  }

  // Coordinates to the right, up and away from the viewer.
  seen([dx, dy, dz], {turn, tilt}) {
    const [ct, st, cu, su] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
    const deep = st * dx + ct * dy;
    return [ct * dx - st * dy, cu * dz + su * deep, cu * deep - su * dz];
  }

  // x to the right, y into the page, z up, turned about z and tilted; {x, y, far} in pixels.
  project() {
    const out = new Float32Array(this.reference.length), {height, room} = this.place;
    const scale = this.zoom * this.fit();
    for (let i = 0; i < out.length; i += 3) {
      const from = [0, 1, 2].map(k => this.reference[i + k] + this.larger * this.moved[i + k] - this.middle[k]);
      const [right, up, far] = this.seen(from, this);
      out.set([room / 2 + scale * right, height / 2 - scale * up, far], i);
    }
    return out;
  }

  draw() {
    if (!this.moved) return;
    const ratio = Math.min(devicePixelRatio || 1, 2), {canvas} = this, width = this.drawnWidth = canvas.parentElement.clientWidth;
    const height = Math.round(Math.min(Math.max(0.6 * width, 220), 460)), room = width - LEGEND_WIDTH;
    this.place = {height, room};
    canvas.style.height = height + "px";
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const ctx = canvas.getContext("2d");
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.font = "12px system-ui, sans-serif";
    ctx.save();
    ctx.beginPath();
    ctx.rect(0, 0, room, height);
    ctx.clip();
    const range = this.drawFaces(ctx, this.project());
    ctx.restore();
    this.drawAxes(ctx);
    drawScale(ctx, room + 14, 26, height - 60, {low: range[0], high: range[1], unit: "m"});
    const {time} = this.run.frames[this.frame], drawn = this.larger === 1 ? "true to scale" : `displacements × ${digits(this.larger)}`;
    this.note.textContent = `Lever, ${this.run.isCalibration ? loadCase(time) : digits(time, 3) + " actions completed"}, ${drawn}; largest displacement ${withUnit(this.most, "m")}. Drag to turn.`;
    canvas.setAttribute("aria-label", `Picture of the lever${this.of} in three dimensions. ${this.note.textContent} Shift and arrows turn, plus and minus zoom, 0 shows all.`);
    canvas.dataset.drawn = `${this.frame} ${this.shown}`;
  }

  // Far faces first; shaded by viewing angle.
  drawFaces(ctx, at) {
    const {faces} = this, count = faces.length / 4, far = new Float32Array(count), value = new Float32Array(count);
    for (let f = 0; f < count; ++f) {
      for (let k = 0; k < 4; ++k) {
        far[f] += at[3 * faces[4 * f + k] + 2];
        value[f] += this.valueOf(faces[4 * f + k]) / 4;
      }
    }
    const [low, high] = this.ranges ? this.ranges() : this.range();
    const order = Array.from(far.keys()).sort((a, b) => far[b] - far[a]);
    ctx.lineJoin = "round";
    ctx.lineWidth = 0.4;
    for (const f of order) {
      const corner = k => 3 * faces[4 * f + k];
      const [a, b, c, d] = [0, 1, 2, 3].map(corner);
      const turned = (at[c] - at[a]) * (at[d + 1] - at[b + 1]) - (at[d] - at[b]) * (at[c + 1] - at[a + 1]);
      if (turned > 0) continue;  // back face
      ctx.beginPath();
      for (const i of [a, b, c, d]) ctx.lineTo(at[i], at[i + 1]);
      ctx.closePath();
      ctx.fillStyle = colour(high > low ? (value[f] - low) / (high - low) : 0.5);
      ctx.strokeStyle = count < 6000 ? "rgba(10, 20, 30, 0.45)" : ctx.fillStyle;
      ctx.fill();
      ctx.stroke();
    }
    return [low, high];
  }

  drawAxes(ctx) {
    const {height} = this.place, x0 = 34, y0 = height - 30, long = 24;
    const [ct, st, cu, su] = [Math.cos(this.turn), Math.sin(this.turn), Math.cos(this.tilt), Math.sin(this.tilt)];
    ctx.strokeStyle = ctx.fillStyle = theme().soft;
    ctx.lineWidth = 1;
    ctx.textAlign = "center";
    for (const [name, x, y] of [["x", ct, su * st], ["y", -st, su * ct], ["z", 0, cu]]) {
      ctx.beginPath();
      ctx.moveTo(x0, y0);
      ctx.lineTo(x0 + long * x, y0 - long * y);
      ctx.stroke();
      ctx.fillText(name, x0 + 1.4 * long * x, y0 - 1.4 * long * y + 4);
    }
  }

  listen() {
    const {canvas} = this;
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.zoomBy(Math.exp(-0.0015 * event.deltaY));
    }, {passive: false});
    canvas.addEventListener("pointerdown", event => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", event => {
      if (event.buttons & 1) this.turnBy(0.008 * event.movementX, 0.008 * event.movementY);
    });
    canvas.addEventListener("dblclick", () => this.showAll());
    onKey(canvas, event => this.key(event));
  }
  key({key, shiftKey}) {
    const turns = {ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, -0.15], ArrowDown: [0, 0.15]};
    if (!shiftKey || !turns[key]) return zoomKey(key, factor => this.zoomBy(1 / factor), () => this.showAll());
    this.turnBy(...turns[key]);
    return true;
  }
  showAll() { Object.assign(this, {zoom: 1, ...FIRST_VIEW}); this.draw(); }
  zoomBy(factor) { this.zoom *= factor; this.draw(); }
  turnBy(turn, tilt) {
    this.turn += turn;
    this.tilt = Math.min(1.5, Math.max(-1.5, this.tilt + tilt));
    this.draw();
  }
}
