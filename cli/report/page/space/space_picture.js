// Draws particles in 3D with WebGL 2 (library/twgl.js): surfaces directly from the page's data, stored in textures;
// sections and tools as triangles and lines that are rebuilt for each image.
"use strict";

const TEXTURE_WIDE = 2048;
const SPACE_SHADERS = (() => {
  const head = `#version 300 es
    precision highp float; precision highp int; precision highp usampler2D; precision highp sampler2D;`;
  // From shares of the powder to what is seen.
  const view = `uniform mat3 turn; uniform vec3 middle; uniform vec2 moved, zoom; uniform float deep, nearer;
    vec4 seenAt(vec3 place) {
      vec3 seen = turn * (place - middle);
      return vec4((seen.xy + moved) * zoom, seen.z * deep - nearer, 1.0);
    }`;
  const surface = [`${head} ${view}
    uniform usampler2D nodes, faces, cells; uniform sampler2D colours, normals;
    out vec3 place, normal; out vec2 corner; flat out vec3 colour;
    ivec2 at(int i) { return ivec2(i % ${TEXTURE_WIDE}, i / ${TEXTURE_WIDE}); }
    float part(int i) { return float(texelFetch(nodes, at(i), 0).r) / 65534.0; }
    void main() {
      int face = gl_VertexID / 6, k = int[6](0, 1, 2, 0, 2, 3)[gl_VertexID % 6];
      int node = int(texelFetch(faces, at(4 * face + k), 0).r), cell = int(texelFetch(cells, at(face), 0).r);
      place = vec3(part(3 * node), part(3 * node + 1), part(3 * node + 2));
      normal = turn * (2.0 * texelFetch(normals, at(node), 0).rgb - 1.0);
      corner = vec2(k == 1 || k == 2, k > 1);
      colour = texelFetch(colours, at(cell), 0).rgb;
      gl_Position = seenAt(place);
    }`, `${head}
    in vec3 place, normal; in vec2 corner; flat in vec3 colour;
    uniform vec4 plane, paper; uniform float edges;
    out vec4 shown;
    void main() {
      if (dot(place, plane.xyz) > plane.w) discard;
      float light = gl_FrontFacing ? 0.6 + 0.42 * max(0.0, dot(normalize(normal), normalize(vec3(-0.35, 0.5, -0.8)))) : 0.45;
      vec2 border = min(corner, 1.0 - corner) / max(fwidth(corner), vec2(1e-6));
      float line = edges * (1.0 - clamp(min(border.x, border.y), 0.0, 1.0));
      shown = vec4(mix(colour * min(light, 1.0) * (1.0 - 0.6 * line), paper.rgb, paper.a), 1.0);
    }`];
  const plain = [`${head} ${view}
    in vec3 position; in vec4 colour; out vec4 own;
    void main() { own = colour; gl_Position = seenAt(position); }`, `${head}
    in vec4 own; out vec4 shown;
    void main() { shown = vec4(own.rgb * own.a, own.a); }`];
  const dots = [`${head} ${view}
    uniform float unit;
    in vec4 position, colour; out vec4 own; out vec3 place;
    void main() {
      own = colour;
      place = position.xyz;
      gl_Position = seenAt(place);
      gl_PointSize = max(2.0 * position.w * unit, 3.0);
    }`, `${head}
    in vec4 own; in vec3 place; uniform vec4 plane; out vec4 shown;
    void main() {
      float far = 2.0 * length(gl_PointCoord - 0.5);
      if (far > 1.0 || dot(place, plane.xyz) > plane.w) discard;
      shown = vec4(own.rgb * (far > 0.8 ? 0.7 : 1.0), 1.0);
    }`];
  return {surface, plain, dots};
})();

class SpacePicture {
  static create(run, surface) {
    const canvas = element("canvas", {}), gl = canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    return gl && new SpacePicture(canvas, gl, run, surface);
  }

  constructor(canvas, gl, run, surface) {
    Object.assign(this, {canvas, gl, run, surface, textures: new Map()});
    this.programs = Object.fromEntries(Object.entries(SPACE_SHADERS).map(([name, shaders]) => [name, twgl.createProgramInfo(gl, shaders)]));
    this.empty = gl.createVertexArray();
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.put("faces", surface.faces, gl.R32UI);
    this.put("cells", surface.cell, gl.R32UI);
  }

  // Values as a texture, one per texel (four bytes per texel in RGBA8).
  put(name, values, internalFormat) {
    const {gl} = this, each = internalFormat === gl.RGBA8 ? 4 : 1, height = Math.max(1, Math.ceil(values.length / each / TEXTURE_WIDE));
    const src = new values.constructor(each * TEXTURE_WIDE * height);
    src.set(values);
    const options = {target: gl.TEXTURE_2D, width: TEXTURE_WIDE, height, internalFormat, src, auto: false, minMag: gl.NEAREST, wrap: gl.CLAMP_TO_EDGE};
    const there = this.textures.get(name);
    if (there) twgl.setTextureFromArray(gl, there, src, options);
    else this.textures.set(name, twgl.createTexture(gl, options));
  }

  // view: SpaceView; colours: packed, one per cell; plane: {normal, offset} or null.
  show(view, colours, plane) {
    const {gl, canvas} = this, {room, height, ratio} = view.place;
    canvas.width = Math.max(1, Math.round(room * ratio));
    canvas.height = Math.max(1, Math.round(height * ratio));
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (this.shown !== view.position) {
      this.put("nodes", view.position, gl.R16UI);
      this.put("normals", SpaceSurface.normals(this.surface, view.position), gl.RGBA8);
      this.shown = view.position;
    }
    this.put("colours", new Uint8Array(colours.buffer), gl.RGBA8);
    const uniforms = this.uniforms(view);
    if (!(plane && view.slice)) this.drawSurface(uniforms, view, plane);
    if (view.section) this.drawSection(uniforms, view.section, colours);
    if (view.showTools && view.corners) this.drawTools(uniforms, view);
    if (view.run.frames[view.frame].cell) this.drawCell(uniforms, view);
    if (view.bondLines) this.drawDots(uniforms, view, plane);
    if (view.lines?.length) this.drawNetwork(uniforms, view, plane);
  }

  uniforms({place: {rows, unit, room, height}, middle, moved}) {
    return {turn: [0, 1, 2].flatMap(k => rows.map(row => row[k])), middle, moved, zoom: [2 * unit / room, 2 * unit / height],
            deep: 0.1, nearer: 0};  // tools may extend far outside
  }

  static planeOf(plane) { return plane ? [...plane.normal, plane.offset] : [0, 0, 0, 1]; }

  drawSurface(uniforms, view, plane) {
    const {gl, programs: {surface}} = this;
    gl.useProgram(surface.program);
    gl.bindVertexArray(this.empty);
    const pale = view.lines?.length || view.bondLines ? 0.7 : 0;  // behind the contact forces or cracks
    twgl.setUniforms(surface, {...uniforms, ...Object.fromEntries(this.textures), edges: view.edges ? 1 : 0,
                               paper: [...(isDark() ? [0.12, 0.15, 0.19] : [1, 1, 1]), pale],
                               plane: SpacePicture.planeOf(plane)});
    gl.drawArrays(gl.TRIANGLES, 0, 6 * this.surface.cell.length);
  }

  // Positions with three components each, colours with four.
  drawPlain(uniforms, mode, position, colour, more = {}) {
    if (!position.length) return;
    const {gl, programs: {plain}} = this;
    const buffers = twgl.createBufferInfoFromArrays(gl, {position: {numComponents: 3, data: new Float32Array(position)},
      colour: {numComponents: 4, data: new Uint8Array(colour), normalize: true}});
    gl.bindVertexArray(null);
    gl.useProgram(plain.program);
    twgl.setBuffersAndAttributes(gl, plain, buffers);
    twgl.setUniforms(plain, {...uniforms, ...more});
    twgl.drawBufferInfo(gl, buffers, mode);
    Object.values(buffers.attribs).forEach(({buffer}) => gl.deleteBuffer(buffer));
  }

  drawSection(uniforms, {cell, begin, points, outer}, colours) {
    const {gl} = this, bytes = new Uint8Array(colours.buffer), filled = {at: [], colour: []}, lines = {at: [], colour: []};
    const take = (to, point, rgba) => { to.at.push(points[3 * point], points[3 * point + 1], points[3 * point + 2]); to.colour.push(...rgba); };
    cell.forEach((c, i) => {
      const rgba = [bytes[4 * c], bytes[4 * c + 1], bytes[4 * c + 2], 255], first = begin[i], end = begin[i + 1];
      for (let p = first; p < end; ++p) {
        const next = p + 1 < end ? p + 1 : first, ink = outer[p] ? [20, 28, 38, 255] : [20, 28, 38, 70];
        if (p > first && p + 1 < end) [first, p, next].forEach(point => take(filled, point, rgba));
        [p, next].forEach(point => take(lines, point, ink));
      }
    });
    this.drawPlain(uniforms, gl.TRIANGLES, filled.at, filled.colour, {nearer: 1e-5});
    gl.enable(gl.BLEND);
    this.drawPlain(uniforms, gl.LINES, lines.at, lines.colour, {nearer: 4e-5});
    gl.disable(gl.BLEND);
  }

  // In front of all particles.
  drawDots(uniforms, view, plane) {
    const {gl, programs: {dots}} = this, {position, colour} = view.bondDots();
    if (!position.length) return;
    const buffers = twgl.createBufferInfoFromArrays(gl, {position: {numComponents: 4, data: position},
      colour: {numComponents: 4, data: colour, normalize: true}});
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.bindVertexArray(null);
    gl.useProgram(dots.program);
    twgl.setBuffersAndAttributes(gl, dots, buffers);
    twgl.setUniforms(dots, {...uniforms, unit: view.place.unit * view.place.ratio, plane: SpacePicture.planeOf(plane)});
    twgl.drawBufferInfo(gl, buffers, gl.POINTS);
    Object.values(buffers.attribs).forEach(({buffer}) => gl.deleteBuffer(buffer));
  }

  // In front of all particles, nearer bands over farther ones, as bands that face the viewer, with a white outline.
  drawNetwork(uniforms, view, plane) {
    const {gl} = this, away = view.place.rows[2], bands = view.networkBands(plane);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.BLEND);
    for (const [rgb, wider, nearer] of [[[255, 255, 255], 0.8 / view.place.unit, 0], [[179, 0, 60], 0, 1e-5]]) {
      const at = [], colour = [];
      for (const {from, to, half} of bands) {
        const along = to.map((x, k) => x - from[k]);
        const side = [0, 1, 2].map(k => along[(k + 1) % 3] * away[(k + 2) % 3] - along[(k + 2) % 3] * away[(k + 1) % 3]);
        const long = Math.hypot(...side);
        if (!long) continue;  // parallel to the view direction
        const [a, b, c, d] = [[from, 1], [to, 1], [to, -1], [from, -1]].map(([end, sign]) =>
          end.map((x, k) => x + sign * (half + wider) / long * side[k]));
        at.push(...a, ...b, ...c, ...a, ...c, ...d);
        for (let k = 0; k < 6; ++k) colour.push(...rgb, 255);
      }
      this.drawPlain(uniforms, gl.TRIANGLES, at, colour, {nearer});
    }
    gl.disable(gl.BLEND);
  }

  // The edges of the periodic cell.
  drawCell(uniforms, view) {
    const {gl} = this, {width, run: {frames, head: {low}}} = view, {cell} = frames[view.frame];
    const corner = at => [0, 1, 2].map(k =>
      (at.reduce((sum, share, j) => sum + share * cell[3 * (j + 1) + k], cell[k]) - low[k]) / width);
    const ends = [];
    for (let axis = 0; axis < 3; ++axis)
      for (const [a, b] of [[0, 0], [0, 1], [1, 0], [1, 1]])
        for (const along of [0, 1]) {
          const at = [0, 0, 0];
          [at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3]] = [along, a, b];
          ends.push(...corner(at));
        }
    this.drawPlain(uniforms, gl.LINES, ends, Array.from({length: 24}, () => [213, 94, 0, 255]).flat());
  }

  // Transparent, with lines along the borders of surfaces. Only faces seen from the inside are filled, so that the
  // particles behind the others keep their colours.
  drawTools(uniforms, view) {
    const {gl} = this, ink = isDark() ? [170, 184, 200] : [70, 84, 100], faces = [], rims = [], places = view.toolPlaces();
    const at = row => places.slice(3 * row, 3 * row + 3), rim = new Map();
    const {toolQuads: quads} = this.run;
    for (let q = 0; q < quads.length; q += 4) {
      for (const k of [0, 1, 2, 0, 2, 3]) faces.push(...at(quads[q + k]));
      for (let k = 0; k < 4; ++k) {
        const a = quads[q + k], b = quads[q + (k + 1) % 4], key = `${Math.min(a, b)} ${Math.max(a, b)}`;
        if (a !== b) rim.has(key) ? rim.delete(key) : rim.set(key, [a, b]);
      }
    }
    for (const [a, b] of rim.values()) rims.push(...at(a), ...at(b));
    const all = (places, alpha) => Array.from({length: places.length / 3}, () => [...ink, alpha]).flat();
    gl.enable(gl.BLEND);
    gl.enable(gl.CULL_FACE);
    gl.depthMask(false);
    this.drawPlain(uniforms, gl.TRIANGLES, faces, all(faces, 40));
    gl.disable(gl.CULL_FACE);
    this.drawPlain(uniforms, gl.LINES, rims, all(rims, 200));
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }
}
