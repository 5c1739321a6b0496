// Rasterises quads into an image of cell numbers: one pass over the cells, independent of colours. The pixel
// under the pointer gives its cell, a new field needs only a new colour table, and no GPU is required.
"use strict";

class Raster {
  resize(width, height) {
    if (this.width === width && this.height === height) return;
    Object.assign(this, {width, height, cells: new Int32Array(width * height),
                         canvas: element("canvas", {width, height})});
    this.image = new ImageData(width, height);
    this.pixels = new Uint32Array(this.image.data.buffer);
  }

  // at: x, y of every node in pixels. A quad with two equal nodes is a triangle.
  fill(quads, at) {
    this.cells.fill(-1);
    for (let c = 0; 4 * c < quads.length; ++c) {
      const a = 2 * quads[4 * c], b = 2 * quads[4 * c + 1], d = 2 * quads[4 * c + 2], e = 2 * quads[4 * c + 3];
      this.triangle(c, at[a], at[a + 1], at[b], at[b + 1], at[d], at[d + 1]);
      if (d !== e) this.triangle(c, at[a], at[a + 1], at[d], at[d + 1], at[e], at[e + 1]);
    }
  }

  // A pixel belongs to the triangle that contains its centre: neighbours have no gaps and never overlap.
  triangle(cell, x0, y0, x1, y1, x2, y2) {
    let swap;
    if (y1 < y0) { swap = x0; x0 = x1; x1 = swap; swap = y0; y0 = y1; y1 = swap; }
    if (y2 < y0) { swap = x0; x0 = x2; x2 = swap; swap = y0; y0 = y2; y2 = swap; }
    if (y2 < y1) { swap = x1; x1 = x2; x2 = swap; swap = y1; y1 = y2; y2 = swap; }
    const first = Math.max(0, Math.ceil(y0 - 0.5)), last = Math.min(this.height - 1, Math.ceil(y2 - 0.5) - 1);
    const long = (x2 - x0) / (y2 - y0), upper = (x1 - x0) / (y1 - y0), lower = (x2 - x1) / (y2 - y1);
    for (let row = first; row <= last; ++row) {
      const y = row + 0.5, xa = x0 + long * (y - y0);
      const xb = y < y1 ? x0 + upper * (y - y0) : x1 + lower * (y - y1);
      const from = Math.max(0, Math.ceil(Math.min(xa, xb) - 0.5));
      const to = Math.min(this.width, Math.ceil(Math.max(xa, xb) - 0.5)), start = row * this.width;
      for (let i = start + from, end = start + to; i < end; ++i) this.cells[i] = cell;
    }
  }

  // colours: one packed colour per cell. groups (with `line`): pixels at group edges get the colour `line`.
  paint(colours, groups, line) {
    const {cells, pixels, width} = this, last = cells.length - 1;
    for (let i = 0; i <= last; ++i) {
      const cell = cells[i];
      pixels[i] = cell < 0 ? 0 : colours[cell];
      if (!groups || cell < 0) continue;
      const right = i < last ? cells[i + 1] : -1, below = i + width <= last ? cells[i + width] : -1;
      if (right !== cell && (right < 0 || groups[right] !== groups[cell]) ||
          below !== cell && (below < 0 || groups[below] !== groups[cell])) pixels[i] = line;
    }
    this.canvas.getContext("2d").putImageData(this.image, 0, 0);
    return this.canvas;
  }
}

// A packed colour for ImageData: bytes red, green, blue, opaque, in native byte order.
const packed = (red, green, blue) => new Uint32Array(new Uint8Array([red, green, blue, 255]).buffer)[0];
