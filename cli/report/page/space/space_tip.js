// Tooltip in the 3D view: the frontmost cell of surface or section under the pointer, or a tool.
"use strict";

Object.assign(SpaceView.prototype, {
  linesAt({x, y}) {
    const found = this.foremostAt(x, y), tool = found ? null : this.toolUnder(x, y), {low} = this.run.head;
    if (!found) return tool === null ? [] : [`tool ${this.run.head.tools[tool].name}${this.forceOn(this.run.head.tools[tool].name)}`];
    const value = this.valueAt(found.cell), shown = unitFor("m", this.width);
    const place = found.at.map((share, k) => `${"xyz"[k]} ${digits((low[k] + share * this.width) * shown.factor)}`);
    return [particleInWords(this.run, this.run.particleOf[found.cell]), ...(value ? [value] : []), `${place.join(", ")} ${shown.label}`];
  },

  forceOn(tool) {
    const sample = this.run.sampleAt(this.run.frames[this.frame].time);
    const force = [..."xyz"].map(axis => this.run.values(`tool/${tool}/force_${axis}`)[sample]);
    return force.every(Number.isFinite) ? `: force ${withUnit(Math.hypot(...force), "N")}` : "";
  },

  // Projects all nodes, once per image.
  nodesSeen() {
    if (this.projected) return this.projected;
    const {position} = this, seen = this.projected = new Float32Array(position.length);
    for (let i = 0; i < seen.length; i += 3)
      seen.set(this.seen([position[i] / SPACE_STEPS, position[i + 1] / SPACE_STEPS, position[i + 2] / SPACE_STEPS]), i);
    return seen;
  },

  // {cell, at} of the visible cell at this point.
  foremostAt(x, y) {
    const {faces, cell} = this.surface, plane = this.plane(), {section} = this;
    let best = null, nearest = Infinity;
    const take = (of, hit, at) => { if (hit < nearest) { nearest = hit; best = {cell: of, at}; } };
    if (!(plane && this.slice)) {
      const seen = this.nodesSeen(), {position} = this;
      for (let f = 0; f < cell.length; ++f) {
        for (const [i, j, k] of [[0, 1, 2], [0, 2, 3]]) {
          const [a, b, c] = [faces[4 * f + i], faces[4 * f + j], faces[4 * f + k]];
          const shares = sharesIn(x, y, seen, 3 * a, 3 * b, 3 * c);
          if (!shares) continue;
          const mean = (of, part) => shares[0] * of[3 * a + part] + shares[1] * of[3 * b + part] + shares[2] * of[3 * c + part];
          const at = [0, 1, 2].map(part => mean(position, part) / SPACE_STEPS);
          if (!plane || plane.normal.reduce((sum, part, n) => sum + part * at[n], 0) <= plane.offset) take(cell[f], mean(seen, 2), at);
        }
      }
    }
    section?.cell.forEach((of, i) => this.tryPolygon(section, i, x, y, (hit, at) => take(of, hit - 1e-4, at)));
    return best;
  },

  tryPolygon({begin, points}, i, x, y, take) {
    const first = begin[i], seen = [], own = points.slice(3 * first, 3 * begin[i + 1]);
    for (let p = 0; p < own.length; p += 3) seen.push(...this.seen(own.slice(p, p + 3)));
    for (let p = 3; p + 3 < seen.length; p += 3) {
      const shares = sharesIn(x, y, seen, 0, p, p + 3);
      if (!shares) continue;
      const mean = (of, part) => shares[0] * of[part] + shares[1] * of[p + part] + shares[2] * of[p + 3 + part];
      take(mean(seen, 2), [0, 1, 2].map(part => mean(own, part)));
    }
  },

  // Corners of the tools, as fractions.
  toolPlaces() {
    const {low} = this.run.head;
    return Array.from(this.corners, (value, i) => (value - low[i % 3]) / this.width);
  },

  // Index of the tool under the pointer, or null.
  toolUnder(x, y) {
    const {toolQuads: quads, toolOfQuad} = this.run;
    if (!this.showTools || !this.corners) return null;
    const places = this.toolPlaces(), seen = places.flatMap((_, i) => i % 3 ? [] : this.seen(places.slice(i, i + 3)));
    for (let q = 0; q < quads.length; q += 4) {
      const [a, b, c, d] = [0, 1, 2, 3].map(k => 3 * quads[q + k]);
      if (sharesIn(x, y, seen, a, b, c) || sharesIn(x, y, seen, a, c, d)) return toolOfQuad[q / 4];
    }
    return null;
  },
});

// Barycentric coordinates of (x, y) in a triangle, or null outside.
function sharesIn(x, y, seen, a, b, c) {
  const ax = seen[a] - x, ay = seen[a + 1] - y, bx = seen[b] - x, by = seen[b + 1] - y, cx = seen[c] - x, cy = seen[c + 1] - y;
  const u = bx * cy - by * cx, v = cx * ay - cy * ax, w = ax * by - ay * bx;
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return null;
  const sum = u + v + w;
  return sum ? [u / sum, v / sum, w / sum] : null;
}
