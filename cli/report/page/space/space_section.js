// Hexahedra cut by a plane, and the surface of the particles: the drawn geometry of 3D cells.
"use strict";

// As in cli/report/report_space_mesh.hpp: counter-clockwise from outside.
const HEXAHEDRON_SIDES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
// Two corners, then the two faces that meet at this edge.
const HEXAHEDRON_EDGES = [[0, 1, 0, 2], [1, 2, 0, 3], [2, 3, 0, 4], [3, 0, 0, 5], [4, 5, 1, 2], [5, 6, 1, 3], [6, 7, 1, 4],
                          [7, 4, 1, 5], [0, 4, 2, 5], [1, 5, 2, 3], [2, 6, 3, 4], [3, 7, 4, 5]];

class SpaceSurface {
  // faces: four nodes each; cell: of each face; isOuter: for each side of each cell.
  static of({surface, cells}) {
    const faces = new Uint32Array(4 * surface.length), cell = new Uint32Array(surface.length);
    const isOuter = new Uint8Array(6 * cells.length / 8);
    surface.forEach((code, f) => {
      cell[f] = Math.floor(code / 6);
      isOuter[code] = 1;
      HEXAHEDRON_SIDES[code % 6].forEach((corner, k) => { faces[4 * f + k] = cells[8 * cell[f] + corner]; });
    });
    return {faces, cell, isOuter};
  }

  // Unit node normals: area-weighted means over the adjacent faces. Encoded as 0 to 255.
  static normals({faces}, position) {
    const sum = new Float32Array(position.length), coded = new Uint8Array(position.length / 3 * 4).fill(128);
    for (let f = 0; f < faces.length; f += 4) {
      const [a, b, c, d] = [3 * faces[f], 3 * faces[f + 1], 3 * faces[f + 2], 3 * faces[f + 3]];
      const ux = position[c] - position[a], uy = position[c + 1] - position[a + 1], uz = position[c + 2] - position[a + 2];
      const vx = position[d] - position[b], vy = position[d + 1] - position[b + 1], vz = position[d + 2] - position[b + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      for (const n of [a, b, c, d]) { sum[n] += x; sum[n + 1] += y; sum[n + 2] += z; }
    }
    for (let n = 0, to = 0; n < sum.length; n += 3, to += 4) {
      const long = Math.hypot(sum[n], sum[n + 1], sum[n + 2]) || 1;
      for (let k = 0; k < 3; ++k) coded[to + k] = Math.round(127.5 + 127.5 * sum[n + k] / long);
    }
    return coded;
  }
}

// Two unit vectors orthogonal to a normal.
function acrossOf(normal) {
  const least = normal.reduce((best, part, k) => Math.abs(part) < Math.abs(normal[best]) ? k : best, 0);
  const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
  const first = cross(normal, [0, 1, 2].map(k => k === least ? 1 : 0)), long = Math.hypot(...first);
  const unit = first.map(part => part / long);
  return [unit, cross(normal, unit)];
}

// The section of the cells by a plane. cell: of each polygon; begin: its first point, and the end of the last; points:
// three fractions each; outer: whether the edge that starts at each point is on the surface.
function sectionOf(cells, position, {normal, offset}, isOuter) {
  const nodes = position.length / 3, away = new Float32Array(nodes), [u, v] = acrossOf(normal);
  for (let n = 0; n < nodes; ++n) {
    away[n] = (normal[0] * position[3 * n] + normal[1] * position[3 * n + 1] + normal[2] * position[3 * n + 2]) / SPACE_STEPS - offset;
  }
  const section = {cell: [], begin: [0], points: [], outer: []};
  for (let c = 0; c < cells.length / 8; ++c) {
    let above = 0;
    for (let k = 0; k < 8; ++k) above += away[cells[8 * c + k]] > 0;
    if (above === 0 || above === 8) continue;
    const corners = [];
    HEXAHEDRON_EDGES.forEach(([i, j], edge) => {
      const a = cells[8 * c + i], b = cells[8 * c + j];
      if (away[a] > 0 === away[b] > 0) return;
      const share = away[a] / (away[a] - away[b]);
      corners.push({edge, at: [0, 1, 2].map(k => (position[3 * a + k] + share * (position[3 * b + k] - position[3 * a + k])) / SPACE_STEPS)});
    });
    addPolygon(section, c, corners, u, v, isOuter);
  }
  return section;
}

// Sorted by angle around their centre.
function addPolygon(section, cell, corners, u, v, isOuter) {
  if (corners.length < 3) return;
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2], count = corners.length;
  const flat = corners.map(({at}) => [dot(at, u), dot(at, v)]), mid = [0, 1].map(k => flat.reduce((sum, one) => sum + one[k], 0) / count);
  const angles = flat.map(([x, y]) => Math.atan2(y - mid[1], x - mid[0]));
  const order = corners.map((_, i) => i).sort((i, j) => angles[i] - angles[j]);
  order.forEach((i, k) => {
    const [, , a, b] = HEXAHEDRON_EDGES[corners[i].edge], [, , c, d] = HEXAHEDRON_EDGES[corners[order[(k + 1) % count]].edge];
    const side = a === c || a === d ? a : b === c || b === d ? b : -1;
    section.points.push(...corners[i].at);
    section.outer.push(side >= 0 && isOuter[6 * cell + side]);
  });
  section.cell.push(cell);
  section.begin.push(section.outer.length);
}
