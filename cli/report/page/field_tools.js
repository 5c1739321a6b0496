// The tools in the view of a 2D run: finite bodies, with their outlines from run.h5.
"use strict";

Object.assign(FieldView.prototype, {
  // For every tool: its name and its corners in this frame, m; the last two are behind its face.
  tools() {
    if (!this.corners) return [];
    return this.run.head.tools.map(({name, first, count}) =>
      ({name, points: Array.from({length: count}, (_, i) => [this.corners[2 * (first + i)], this.corners[2 * (first + i) + 1]])}));
  },

  pathOn(ctx, points) {
    const {scale, x, y} = this.place;
    ctx.beginPath();
    for (const [px, py] of points) ctx.lineTo(x + scale * px, y - scale * py);
  },

  drawBodies(ctx) {
    ctx.fillStyle = theme().body;
    for (const {points} of this.tools()) {
      this.pathOn(ctx, points);
      ctx.fill();
    }
  },

  drawFaces(ctx) {
    Object.assign(ctx, {strokeStyle: theme().surface, lineWidth: 2, lineJoin: "round"});
    for (const {points} of this.tools()) {
      this.pathOn(ctx, points.slice(0, -2));
      ctx.stroke();
    }
  },

  // The tool whose body covers this point, m.
  toolAt(px, py) {
    const crosses = ([ax, ay], [bx, by]) => (ay > py) !== (by > py) && px < ax + (bx - ax) * (py - ay) / (by - ay);
    return this.tools().find(({points}) =>
      points.filter((point, i) => crosses(point, points[(i + 1) % points.length])).length % 2);
  },

  // The point on the face of a tool closest to a given point.
  closestOnFace({points}, [px, py]) {
    let best = points[0], least = Infinity;
    for (let i = 0; i + 3 < points.length; ++i) {
      const [ax, ay] = points[i], dx = points[i + 1][0] - ax, dy = points[i + 1][1] - ay, square = dx * dx + dy * dy;
      const at = square > 0 ? Math.min(1, Math.max(0, ((px - ax) * dx + (py - ay) * dy) / square)) : 0;
      const point = [ax + at * dx, ay + at * dy], far = Math.hypot(point[0] - px, point[1] - py);
      if (far < least) { least = far; best = point; }
    }
    return best;
  },
});
