// Tooltip in the view of a 2D run: particle, position and value under the pointer. It is updated when the view changes
// under a pointer at rest.
"use strict";

Object.assign(FieldView.prototype, {
  tellPointer() {
    const {pointer, place, tip} = this, lines = pointer && place && pointer.x < place.room ? this.linesAt(pointer) : [];
    tip.hidden = !lines.length;
    if (tip.hidden) return;
    tip.textContent = lines.join("\n");
    tip.style.left = Math.max(0, Math.min(pointer.x + 14, place.room - tip.offsetWidth)) + "px";
    tip.style.top = Math.max(0, pointer.y - tip.offsetHeight - 8) + "px";
  },

  linesAt({x, y}) {
    const {place: {scale, ratio, x: x0, y: y0}, raster, run} = this, px = (x - x0) / scale, py = (y0 - y) / scale;
    const cell = raster.cells[Math.floor(y * ratio) * raster.width + Math.floor(x * ratio)] ?? -1;
    const tool = cell < 0 && this.toolAt(px, py), value = this.valueAt(cell, px, py);
    if (cell < 0 && !tool && !value) return [];
    const shown = unitFor("m", this.width), number = v => digits(v * shown.factor);
    return [...(cell >= 0 ? [particleInWords(run, run.particleOf[cell])] : tool ? [`tool ${tool.name}${this.forceOn(tool.name)}`] : []),
            ...(value ? [value] : []), `x ${number(px)}, y ${number(py)} ${shown.label}`];
  },

  valueAt(cell, px, py) {
    if (this.shown === "density") {
      const density = this.densityAt(px, py);
      return density === null ? "" : `local density ${digits(density)}`;
    }
    const code = cell >= 0 && this.codes ? this.codes[cell] : NO_NUMBER;
    if (code === NO_NUMBER) return "";
    return this.showsNumbers ? `${nameOf(this.field.name).words} ${Math.round(this.valueOf(code))}`
      : `${nameOf(this.field.name).words} ${withUnit(this.valueOf(code), this.field.unit)}`;
  },

  densityAt(px, py) {
    const {density} = this.run.frames[this.frame];
    const between = (edges, v) => edges.findIndex((edge, i) => v >= edge && v < edges[i + 1]);
    const column = density ? between(density.x, px) : -1, row = density ? between(density.y, py) : -1;
    return column < 0 || row < 0 ? null : density.cells[row * (density.x.length - 1) + column] ?? null;
  },

  forceOn(tool) {
    const sample = this.run.sampleAt(this.run.frames[this.frame].time);
    const force = ["x", "y"].map(axis => this.run.values(`tool/${tool}/force_${axis}`)[sample]);
    return force.every(Number.isFinite) ? `: force ${withUnit(Math.hypot(...force), "N")}` : "";
  },
});
