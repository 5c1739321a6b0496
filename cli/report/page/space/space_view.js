// Animated view of particles in 3D: rotated by dragging, cut by a plane, coloured like the 2D view.
// Lengths here are fractions of the largest extent of the powder, from its lowest corner over all frames; `seen` gives
// them to the right, up and away from the viewer.
"use strict";

const SPACE_STEPS = 65534;  // quantisation steps of a position
const SPACE_VIEWS = {
  isometric: ["Isometric", -Math.PI / 4, Math.atan(Math.SQRT1_2)],
  x: ["Along x", -Math.PI / 2, 0],
  y: ["Along y", 0, 0],
  z: ["From above", 0, Math.PI / 2],
};
const SPACE_KEYS = "Shift and arrows turn, plus and minus zoom, x, y, z and i look along an axis or from a corner, 0 shows all.";

class SpaceView extends FieldView {
  static radiusOf({head: {low, high}}) { return Math.hypot(...high.map((end, k) => end - low[k])) / 2 || 1; }

  measure() {
    super.measure();
    const {low, high} = this.run.head;
    this.box = high.map((end, k) => (end - low[k]) / this.width);
    this.middle = this.box.map(length => length / 2);
    this.radius = (this.whole?.radius || SpaceView.radiusOf(this.run)) / this.width;
    if (this.gl) this.gl.run = this.run;
  }

  prepare() {
    const [, turn, tilt] = SPACE_VIEWS.isometric;
    Object.assign(this, {turn, tilt, zoom: 1, moved: [0, 0], cut: "", cutAt: 0.5, cutNormal: [1, 0, 0], slice: false,
                         showTools: true, edges: false, surface: SpaceSurface.of(this.run)});
    this.gl = SpacePicture.create(this.run, this.surface);
    this.outline = [];
  }

  get direction() {
    const [ct, st, cu, su] = [Math.cos(this.turn), Math.sin(this.turn), Math.cos(this.tilt), Math.sin(this.tilt)];
    return [[ct, -st, 0], [su * st, su * ct, cu], [cu * st, cu * ct, -su]];  // rows: right, up, away
  }

  layout() {
    const ratio = Math.min(devicePixelRatio || 1, 2), {canvas} = this;
    const width = this.drawnWidth = canvas.parentElement.clientWidth, room = width - this.legendWidth();
    const height = Math.round(Math.min(Math.max(0.85 * room, 220), this.most));
    canvas.style.height = height + "px";
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const unit = this.zoom * 0.5 * Math.min(room, height) / this.radius;  // pixels
    this.place = {ratio, width, room, height, unit, scale: unit / this.width, rows: this.direction};
  }

  // In canvas pixels; the third component is the depth, as a fraction.
  seen([x, y, z]) {
    const {rows, unit, room, height} = this.place, [a, b, c] = this.middle, [dx, dy, dz] = [x - a, y - b, z - c];
    const [right, up, away] = rows.map(row => row[0] * dx + row[1] * dy + row[2] * dz);
    return [room / 2 + unit * (right + this.moved[0]), height / 2 - unit * (up + this.moved[1]), away];
  }

  // {normal, offset}: everything beyond is cut away; null: nothing is. A cut normal to an axis always opens towards the
  // viewer, from whichever side.
  plane() {
    const axis = "xyz".indexOf(this.cut);
    if (!this.cut) return null;
    const side = axis < 0 || this.direction[2][axis] <= 0 ? 1 : -1;
    const normal = axis < 0 ? this.cutNormal : [0, 1, 2].map(k => k === axis ? side : 0);
    const reach = this.box.map((length, k) => length * normal[k]), low = reach.reduce((sum, part) => sum + Math.min(0, part), 0);
    const high = reach.reduce((sum, part) => sum + Math.max(0, part), 0), share = side > 0 ? this.cutAt : 1 - this.cutAt;
    return {normal, side, offset: low + share * (high - low) + 1e-6};  // avoids passing through nodes of a lattice
  }

  // The contact forces as {from, to, half}: half the band width, proportional to force; without those cut away.
  networkBands(plane) {
    const {lines, width, box, run: {head: {low, mesh}}} = this, bands = [];
    const most = this.mostForce = largest(lines.filter((_, i) => i % 7 === 6)) || 1;
    const widest = 0.06 * Math.cbrt(box[0] * box[1] * box[2] / mesh.particles);
    const beyond = point => plane ? plane.normal.reduce((sum, part, k) => sum + part * point[k], -plane.offset) : -1;
    for (let i = 0; i < lines.length; i += 7) {
      const half = widest * lines[i + 6] / most;
      if (half * this.place.unit < 0.07) continue;
      let [from, to] = [0, 3].map(first => [0, 1, 2].map(k => (lines[i + first + k] - low[k]) / width));
      const a = beyond(from), b = beyond(to);
      if (a > 0 && b > 0) continue;
      if (a > 0 || b > 0) {
        const cut = from.map((x, k) => x + a / (a - b) * (to[k] - x));
        [from, to] = a > 0 ? [cut, to] : [from, cut];
      }
      bands.push({from, to, half});
    }
    return bands;
  }

  // Bonds and cracks as discs with a quarter of the area of each, so that neighbours stay apart: {position: three fractions
  // and the radius, colour: four bytes}.
  bondDots() {
    const {bonds, cracks} = this.bondLines, {width, run: {head: {low}}} = this, grey = isDark() ? [154, 166, 180] : [91, 102, 114];
    const position = new Float32Array(bonds.length + cracks.length / 5 * 4), colour = new Uint8Array(position.length).fill(255);
    let to = 0;
    const add = (dots, i, rgb) => {
      position.set([...[0, 1, 2].map(k => (dots[i + k] - low[k]) / width), Math.sqrt(dots[i + 3] / Math.PI) / 2 / width], to);
      colour.set(rgb, to);
      to += 4;
    };
    for (let i = 0; i < bonds.length; i += 4) add(bonds, i, grey);
    for (let i = 0; i < cracks.length; i += 5) add(cracks, i, modeRgb(cracks[i + 4]));
    return {position, colour};
  }

  draw() {
    if (!this.position) return;
    const start = performance.now();
    this.layout();
    const ctx = this.canvas.getContext("2d"), {ratio, room, height} = this.place, colours = this.cellColours();
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.font = "12px system-ui, sans-serif";
    const plane = this.plane();
    this.section = plane ? sectionOf(this.run.cells, this.position, plane, this.surface.isOuter) : null;
    this.projected = null;
    if (this.gl) {
      this.gl.show(this, colours, plane);
      ctx.drawImage(this.gl.canvas, 0, 0, room, height);
    } else {
      ctx.fillStyle = theme().soft;
      ctx.fillText("This browser has no WebGL 2, which pictures in three dimensions need.", 12, 24);
    }
    this.at = this.place;
    this.drawSpaceAxes(ctx);
    this.drawScaleBar(ctx);
    this.drawLegend(ctx);
    this.tell();
    this.tellPointer();
    this.fit.hidden = !this.isMoved();
    this.onDraw?.();
    this.canvas.dataset.drawnIn = (performance.now() - start).toFixed(1);
    this.canvas.dataset.drawn = `${this.frame} ${this.shown}`;
    this.canvas.dataset.cracks = this.bondLines ? this.bondLines.cracks.length / 5 : "";
    this.canvas.dataset.contacts = this.lines ? this.lines.length / 7 : "";
    this.canvas.dataset.cells = this.section ? this.section.cell.length : "";
  }

  drawSpaceAxes(ctx) {
    const {height, rows} = this.place, x0 = 34, y0 = height - 30, long = 24;
    Object.assign(ctx, {strokeStyle: theme().soft, fillStyle: theme().soft, lineWidth: 1, textAlign: "center"});
    [..."xyz"].forEach((name, k) => {
      const [x, y] = [rows[0][k], rows[1][k]];
      if (Math.hypot(x, y) < 0.1) return;  // parallel to the view direction
      ctx.beginPath();
      ctx.moveTo(x0, y0);
      ctx.lineTo(x0 + long * x, y0 - long * y);
      ctx.stroke();
      ctx.fillText(name, x0 + 1.4 * long * x, y0 - 1.4 * long * y + 4);
    });
  }

  bondsInWords() {
    const {bonds, cracks} = this.run.frames[this.frame], drawn = this.bondLines;
    const part = (all, count) => all > count ? ` (${countOf(count)} of ${countOf(all)} drawn)` : "";
    return ` Dots: bonds grey${part(bonds, drawn.bonds.length / 4)}; cracks from orange (mode I) to blue (mode II)` +
      `${part(cracks, drawn.cracks.length / 5)}.`;
  }

  cutInWords() {
    const plane = this.plane(), {low} = this.run.head;
    if (!plane) return "";
    const at = plane.side * (plane.offset * this.width + plane.normal.reduce((sum, part, k) => sum + part * low[k], 0));
    return this.cut === "free" ? "chosen plane" : `${this.cut} = ${withUnit(at, "m", 3)}`;
  }

  tell() {
    super.tell();
    const cut = this.cutInWords();
    if (cut) this.note.textContent += ` Cut at ${cut}${this.slice ? ", the slice only" : ""}.`;
    this.canvas.setAttribute("aria-label", `Picture of the particles${this.of} in three dimensions. ${this.note.textContent} ${SPACE_KEYS}`);
  }

  // The name of the direction of the view; none after turning.
  get looks() {
    return Object.keys(SPACE_VIEWS).find(name => SPACE_VIEWS[name][1] === this.turn && SPACE_VIEWS[name][2] === this.tilt) || "";
  }
  isMoved() { return this.zoom !== 1 || this.looks !== "isometric" || this.moved.some(part => part !== 0); }
  showAll() { this.zoom = 1; this.moved = [0, 0]; this.lookFrom("isometric"); }
  lookFrom(name) {
    [, this.turn, this.tilt] = SPACE_VIEWS[name];
    this.draw();
  }
  turnBy(turn, tilt) {
    this.turn += turn;
    this.tilt = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.tilt + tilt));
    this.draw();
  }
  // factor: of the zoom, as in the 2D view.
  zoomBy(factor, px = this.place.room / 2, py = this.place.height / 2) {
    const {unit, room, height} = this.place, [x, y] = [(px - room / 2) / unit, (height / 2 - py) / unit];
    this.zoom /= factor;
    this.moved = [this.moved[0] + x * (factor - 1), this.moved[1] + y * (factor - 1)];
    this.draw();
  }
  moveBy(px, py) {
    const {unit} = this.place;
    this.moved = [this.moved[0] + px / unit, this.moved[1] - py / unit];
    this.draw();
  }

  listen() {
    const {canvas} = this;
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.zoomBy(Math.exp(0.0015 * event.deltaY), event.offsetX, event.offsetY);
    }, {passive: false});
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("pointerdown", event => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", event => {
      this.pointer = {x: event.offsetX, y: event.offsetY};
      if (event.buttons & 2 || event.buttons & 1 && event.shiftKey) this.moveBy(event.movementX, event.movementY);
      else if (event.buttons & 1) this.turnBy(0.008 * event.movementX, 0.008 * event.movementY);
      else this.tellPointer();
    });
    canvas.addEventListener("pointerleave", () => { this.pointer = null; this.tellPointer(); });
    canvas.addEventListener("dblclick", () => this.showAll());
    onKey(canvas, event => this.key(event));
  }
  key(event) {
    const {key, shiftKey} = event;
    const turns = {ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, -0.15], ArrowDown: [0, 0.15]};
    const views = {x: "x", y: "y", z: "z", i: "isometric"};
    if (shiftKey && turns[key]) this.turnBy(...turns[key]);
    else if (views[key]) this.lookFrom(views[key]);
    else return super.key(event);
    return true;
  }
}

// Controls above the 3D view besides the field: view, cut, tools, edges.
function spaceControls(view) {
  const note = element("output", {className: "told"}), change = what => { view.show(what).then(() => { note.textContent = view.cutInWords(); }); };
  const select = (id, entries, onchange) => {
    const made = element("select", {id});
    entries.forEach(([value, label]) => made.add(new Option(label, value)));
    made.onchange = () => onchange(made.value);
    return made;
  };
  const tick = (id, label, name) => {
    const box = element("input", {type: "checkbox", id, checked: view[name]});
    box.onchange = () => change({[name]: box.checked});
    return element("label", {}, box, " " + label);
  };
  const look = select("view", Object.entries(SPACE_VIEWS).map(([value, [label]]) => [value, label]), value => view.lookFrom(value));
  look.append(element("option", {value: "", textContent: "Turned", hidden: true}));
  view.onDraw = () => { look.value = view.looks; };
  const at = element("input", {type: "range", id: "cut-at", min: 0, max: 1, step: 0.005, value: 0.5, disabled: true, "aria-label": "Place of the cut"});
  at.oninput = () => change({cutAt: Number(at.value)});
  const slice = tick("slice", "slice only", "slice"), sliceBox = slice.querySelector("input");
  sliceBox.disabled = true;
  const cut = select("cut", [["", "nothing"], ["x", "across x"], ["y", "across y"], ["z", "across z"], ["free", "facing the view"]], value => {
    at.disabled = sliceBox.disabled = !value;
    change({cut: value, ...value === "free" ? {cutNormal: view.direction[2].map(part => -part)} : {}});
  });
  const tools = view.run.toolQuads ? [tick("tools", "tools", "showTools")] : [];
  return [element("label", {}, "View ", look), element("label", {}, "Cut ", cut), at, note, slice,
          tick("edges", "element edges", "edges"), ...tools];
}
