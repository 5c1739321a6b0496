// Yield points in spaces of stresses: charts with equal scales, the deviatoric plane, and a view of the space of the normal
// stresses that can be turned.
"use strict";

// A chart in which a pascal is as long along x as along y.
class EqualChart extends Chart {
  around({width, height}) {
    const {x, y, whole, yLabel} = shownChart(this.spec, this.hidden), {left, right, top, bottom} = chartPlace(whole, {width, height}, yLabel);
    const scale = Math.max((whole.x[1] - whole.x[0]) / x.factor / (right - left), (whole.y[1] - whole.y[0]) / y.factor / (bottom - top));
    const range = ([low, high], half) => [(low + high) / 2 - half, (low + high) / 2 + half];
    return {x: range(whole.x, scale * x.factor * (right - left) / 2), y: range(whole.y, scale * y.factor * (bottom - top) / 2)};
  }
  draw() {
    if (!document.contains(this.host)) return;
    const {view} = this;
    this.view ||= this.around({width: Math.max(280, this.host.clientWidth), height: this.height});
    super.draw();
    if (!view) this.shown.whole = this.view;
    this.view = view;
  }
  svg() {
    const size = {width: 640, height: 400};
    return chartSvg(this.spec, {...this, view: this.view || this.around(size), ...size, colours: LIGHT, legend: true});
  }
}

function drawEqual(host, spec, options) {
  const chart = new EqualChart(host, spec, options);
  host.parentElement.querySelector(".card-head").append(chart.saving(spec.title));
}

// Coordinates in the deviatoric plane of a deviator of this length: compression along z is up, along y to the right below.
const inDeviatoricPlane = (length, lode) => [length * Math.sin(lode), length * Math.cos(lode)];

// The normal stresses at a pressure on a net: on each of its lines from pole to pole, by the polynomial through the four points
// around it, or two where the pressure turns.
function sectionOf(shell, pressure) {
  const pressureOf = stress => -(stress[0] + stress[1] + stress[2]) / 3;
  return shell[0].flatMap((_, k) => {
    const i = shell.findIndex((row, n) => n > 0 && (pressureOf(row[k]) - pressure) * (pressureOf(shell[n - 1][k]) - pressure) < 0);
    if (i < 0) return [];
    const four = shell.slice(Math.max(0, i - 2), i + 2).map(row => row[k]);
    const falls = list => list.every((stress, n) => !n || pressureOf(stress) < pressureOf(list[n - 1]));
    const used = falls(four) ? four : [shell[i - 1][k], shell[i][k]], at = used.map(pressureOf);
    const shares = at.map((p, n) => at.reduce((product, other, m) => m === n ? product : product * (pressure - other) / (p - other), 1));
    return [[0, 1, 2].map(part => used.reduce((sum, stress, n) => sum + shares[n] * stress[part], 0))];
  });
}

// A closed curve through the points of a plane, with three more between each two (Catmull and Rom).
const roundThrough = ring => ring.flatMap((_, k) => [0, 0.25, 0.5, 0.75].map(t => {
  const [a, b, c, d] = [-1, 0, 1, 2].map(n => ring[(k + n + ring.length) % ring.length]);
  return [0, 1].map(i => b[i] + t / 2 * (c[i] - a[i] + t * (2 * a[i] - 5 * b[i] + 4 * c[i] - d[i] + t * (3 * (b[i] - c[i]) + d[i] - a[i]))));
}));

// Of a stress, without shear.
const placeInPlane = ([xx, yy, zz]) => [(xx - yy) / Math.SQRT2, (xx + yy - 2 * zz) / Math.sqrt(6)];

function deviatoricChart(head, path, criterion) {
  const lines = statesOf(head, path).flatMap((state, hue) => {
    const found = pointsOf(state, criterion).filter(({set, q}) => set === "deviatoric" && q !== 0), shell = modelOf(state, criterion, TURNED)?.shell;
    if (!found.length) return [];
    const places = found.map(({q, lode_angle}) => inDeviatoricPlane(Math.sqrt(2 / 3) * Math.abs(q), lode_angle));
    const cut = shell ? sectionOf(shell, found.reduce((sum, {p}) => sum + p, 0) / found.length).map(placeInPlane) : [];
    const round = roundThrough(cut), ring = [...round, ...round.slice(0, 1)];
    return [marks(`density ${densityText(state)}`, "Pa", places.map(([x]) => x), places.map(([, y]) => y), {hue}),
            {label: `${densityText(state)}, S-CLAY1`, unit: "Pa", hue, dash: DASHED[TURNED], x: ring.map(([x]) => x), values: ring.map(([, y]) => y)}];
  }).filter(({values}) => values.length);
  const most = largest(lines.flatMap(({x, values}) => x.map((part, i) => Math.hypot(part, values[i]))));
  const axes = [0, 120, 240].flatMap(angle => [[0, 0], inDeviatoricPlane(1.05 * most, angle / DEGREES), [NaN, NaN]]);
  return {title: `Deviatoric plane: ${path}`, isEqual: true, x: {label: "√(2/3) q sin θ", unit: "Pa", values: []}, y: "√(2/3) q cos θ",
          note: "θ: Lode angle. Compressed along z: up, along y: right below, along x: left below. Points of the directions of constant volume or pressure" +
            (lines.some(({dash}) => dash) ? "; dotted: S-CLAY1 at the mean of their pressures." : "."),
          lines: lines.length ? [...lines, {label: "compression along z, y, x", unit: "Pa", colour: "edge",
                                            x: axes.map(([x]) => x), values: axes.map(([, y]) => y)}] : []};
}

const DIAGONAL = Math.atan(Math.SQRT1_2), LOOKS = {free: ["From the side", -2.9, 0.3], h: ["Along equal pressures", -0.75 * Math.PI, DIAGONAL],
  x: ["Along x", -0.5 * Math.PI, 0], y: ["Along y", Math.PI, 0], z: ["From above", Math.PI, 0.5 * Math.PI]};
const SETS = {axial: ["plane of the axis", 0], deviatoric: ["deviatoric plane", 1], shear: ["shear", 3], given: ["given", 4]};

// Positions are pressures along x, y and z, Pa.
class StressSpace {
  constructor(canvas, {tip, told, onLook}) {
    Object.assign(this, {canvas, tip, told, onLook, points: [], net: [], chosen: null, look: "free", zoom: 1, height: 460});
    [, this.turn, this.tilt] = LOOKS.free;
    this.listen();
    onResize(canvas.parentElement, () => { if (canvas.parentElement.clientWidth !== this.width) this.draw(); });
    onUnits(() => this.draw());
    onTheme(() => this.draw());
  }

  // points: yield points; shell: rows of stresses, or none; loaded: stresses of the state.
  show({points, shell, loaded, name}) {
    const pressures = stress => [0, 1, 2].map(k => -stress[k]);
    Object.assign(this, {name, chosen: null, points: points.map(point => ({point, at: pressures(point.stress)})), loaded: loaded.map(pressures),
                         net: (shell || []).map(row => row.map(pressures))});
    this.most = 1.08 * Math.max(1, ...[...this.points.map(({at}) => at), ...this.net.flat(), ...this.loaded].flat());
    const low = Math.min(0, ...[...this.points.map(({at}) => at), ...this.net.flat()].flat());
    this.middle = (this.most + low) / 2;
    this.radius = 0.5 * Math.sqrt(3) * (this.most - low);
    this.tip.hidden = true;
    this.draw();
    this.tell();
  }

  layout() {
    const ratio = Math.min(devicePixelRatio || 1, 2), {canvas, turn, tilt} = this;
    const [ct, st, cu, su] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
    this.width = canvas.parentElement.clientWidth;
    const height = this.drawnHeight = Math.min(this.height, Math.round(0.9 * this.width));
    canvas.style.height = height + "px";
    Object.assign(canvas, {width: Math.round(this.width * ratio), height: Math.round(height * ratio)});
    this.rows = [[ct, -st, 0], [su * st, su * ct, cu], [cu * st, cu * ct, -su]];  // right, up, away
    this.unit = this.zoom * 0.5 * (Math.min(this.width, height) - 30) / (0.74 * this.radius);  // pixels per Pa
    const ctx = canvas.getContext("2d");
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.font = "12px system-ui, sans-serif";
    return ctx;
  }

  // In pixels; the third component is the depth, from -1 (near) to 1.
  seen(at) {
    const [right, up, away] = this.rows.map(row => row.reduce((sum, part, k) => sum + part * (at[k] - this.middle), 0));
    return [this.width / 2 + this.unit * right, this.drawnHeight / 2 - this.unit * up, away / this.radius];
  }

  draw() {
    if (!this.canvas.parentElement.clientWidth) return;
    const ctx = this.layout(), colours = theme();
    this.drawAxes(ctx, colours);
    this.drawNet(ctx, colours);
    this.drawPoints(ctx, colours);
    this.drawKey(ctx, colours);
  }

  line(ctx, from, to) {
    const [a, b] = [this.seen(from), this.seen(to)];
    ctx.beginPath();
    ctx.moveTo(a[0], a[1]);
    ctx.lineTo(b[0], b[1]);
    ctx.stroke();
    return [a, b];
  }

  drawAxes(ctx, colours) {
    const {factor, label} = unitFor("Pa", this.most), ticks = niceTicks(0, this.most * factor, 4).filter(tick => tick > 0), told = tickText(ticks);
    Object.assign(ctx, {strokeStyle: colours.soft, fillStyle: colours.soft, lineWidth: 1, textAlign: "center", textBaseline: "middle"});
    [..."xyz"].forEach((name, k) => {
      const along = length => [0, 1, 2].map(i => i === k ? length : 0), [a, b] = this.line(ctx, along(0), along(this.most));
      const long = Math.hypot(b[0] - a[0], b[1] - a[1]), [dx, dy] = [(b[0] - a[0]) / long, (b[1] - a[1]) / long];
      if (long < 30) return;  // parallel to the direction of view
      const side = dx * (a[1] - this.drawnHeight / 2) - dy * (a[0] - this.width / 2) > 0 ? 1 : -1;  // away from the middle
      for (const tick of long > 120 ? ticks : ticks.slice(-1)) {
        const [x, y] = this.seen(along(tick / factor));
        ctx.fillRect(x - 1.5, y - 1.5, 3, 3);
        ctx.fillText(told(tick), x - side * dy * 17, y + side * dx * 12);
      }
      ctx.fillStyle = colours.ink;
      // Beyond the end of the axis; where there is no room, beside it.
      const x = b[0] + 38 * dx, y = b[1] + 13 * dy, isBeside = y < 8 || y > this.drawnHeight - 8;
      const within = Math.min(Math.max(x + (isBeside ? 42 : 0), 40), this.width - 40);
      ctx.fillText(`−σ${name}${name} [${label}]`, within, isBeside ? Math.min(Math.max(y, 8), this.drawnHeight - 8) : y + (within === x ? 0 : 13));
      ctx.fillStyle = colours.soft;
    });
    ctx.setLineDash([6, 4]);
    this.line(ctx, [0, 0, 0], [1, 1, 1].map(part => 0.8 * part * this.most));
    ctx.setLineDash([]);
  }

  drawNet(ctx, colours) {
    const {net} = this, pieces = net.flatMap((row, i) => row.flatMap((at, k) =>
      [[at, row[(k + 1) % row.length]], ...i + 1 < net.length ? [[at, net[i + 1][k]]] : []]));
    ctx.strokeStyle = colours.lines[5];
    for (const [from, to] of pieces) {
      const depth = (this.seen(from)[2] + this.seen(to)[2]) / 2;
      ctx.globalAlpha = Math.min(0.7, Math.max(0.1, 0.38 - 0.7 * depth));
      this.line(ctx, from, to);
    }
    ctx.globalAlpha = 1;
    document.body.dataset.shells = net.length ? 1 : 0;
  }

  drawPoints(ctx, colours) {
    this.dots = this.points.map(({point, at}, i) => ({point, i, seen: this.seen(at)})).sort((a, b) => b.seen[2] - a.seen[2]);
    for (const {point, i, seen: [x, y, depth]} of this.dots) {
      const colour = colours.lines[SETS[point.set][1]];
      ctx.beginPath();
      ctx.arc(x, y, (i === this.chosen ? 7 : 4.5) - 1.2 * depth, 0, 2 * Math.PI);
      Object.assign(ctx, {fillStyle: point.fitted_in_stresses ? colour : colours.paper, lineWidth: 1.2,
                          strokeStyle: i === this.chosen ? colours.ink : point.fitted_in_stresses ? colours.paper : colour});
      ctx.fill();
      ctx.stroke();
    }
    Object.assign(ctx, {strokeStyle: colours.ink, lineWidth: 1.6});
    for (const [x, y] of this.loaded.map(at => this.seen(at))) {
      ctx.beginPath();
      for (const [dx, dy] of [[6, 0], [0, 6]]) { ctx.moveTo(x - dx, y - dy); ctx.lineTo(x + dx, y + dy); }
      ctx.stroke();
    }
  }

  // Which dots are which, on the left above.
  drawKey(ctx, colours) {
    const sets = Object.entries(SETS).filter(([set]) => this.points.some(({point}) => point.set === set));
    const hasOpen = this.points.some(({point}) => !point.fitted_in_stresses);
    const rows = [...sets.map(([, [text, hue]]) => [text, colours.lines[hue]]), ...hasOpen ? [["open: not in the fit", null]] : [], ["+ loaded to", null]];
    Object.assign(ctx, {textAlign: "left", textBaseline: "middle"});
    rows.forEach(([text, colour], row) => {
      ctx.fillStyle = colour || colours.soft;
      ctx.beginPath();
      if (colour) ctx.arc(8, 12 + 17 * row, 4, 0, 2 * Math.PI);
      ctx.fill();
      ctx.fillStyle = colours.soft;
      ctx.fillText(text, colour ? 18 : 4, 12 + 17 * row);
    });
  }

  dotAt(x, y) {
    const near = this.dots.map(dot => ({dot, far: Math.hypot(dot.seen[0] - x, dot.seen[1] - y)})).filter(({far}) => far < 12);
    return near.length ? near.reduce((best, one) => one.far < best.far ? one : best).dot : null;
  }

  hover(x, y) {
    const dot = this.dotAt(x, y), {tip} = this;
    tip.hidden = !dot;
    if (!dot) return;
    tip.textContent = `${directionText(dot.point)}\np ${withUnit(dot.point.p, "Pa")}, q ${withUnit(dot.point.q, "Pa")}`;
    tip.style.left = Math.max(0, Math.min(dot.seen[0] + 10, this.width - tip.offsetWidth)) + "px";
    tip.style.top = Math.max(0, dot.seen[1] - tip.offsetHeight - 6) + "px";
  }

  choose(i) {
    this.chosen = i;
    this.draw();
    this.tell();
  }

  // The chosen point, with the link to its run.
  tell() {
    const {points, chosen, told, canvas} = this;
    canvas.setAttribute("aria-label", `Yield points in the space of the normal stresses, ${this.name}: ${counted(points.length, "point")}` +
      `${this.net.length ? ", with the net of S-CLAY1" : ""}. Arrows turn, plus and minus zoom, x, y, z and h look along an axis, ` +
      "n and p choose a point, 0 shows all.");
    if (chosen === null) { told.textContent = points.length ? "No point chosen." : "No yield point."; return; }
    const {point, at} = points[chosen], {factor, label} = unitFor("Pa", largest(at));
    told.replaceChildren(`${titled(directionText(point))}: pressures ${at.map((part, k) => `${"xyz"[k]} ${digits(part * factor)}`).join(", ")} ${label}. `,
                         reportOf(point.run, `Report of its run, ${point.run}`));
  }

  lookFrom(look) {
    [, this.turn, this.tilt] = LOOKS[look];
    this.turned(look);
  }
  turnBy(turn, tilt) {
    this.turn += turn;
    this.tilt = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.tilt + tilt));
    this.turned("");
  }
  turned(look) {
    this.onLook(look);
    this.tip.hidden = true;
    this.draw();
  }
  zoomBy(factor) { this.zoom /= factor; this.draw(); }
  showAll() { this.zoom = 1; this.lookFrom("free"); }

  listen() {
    const {canvas} = this;
    canvas.addEventListener("wheel", event => {
      if (!event.ctrlKey && !event.shiftKey) return;  // let the page scroll
      event.preventDefault();
      this.zoomBy(Math.exp(0.0015 * (event.deltaY || event.deltaX)));
    }, {passive: false});
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      this.pressed = this.last = {x: event.offsetX, y: event.offsetY};
    });
    canvas.addEventListener("pointermove", ({buttons, offsetX: x, offsetY: y}) => {
      if (!(buttons & 1 && this.last)) { this.hover(x, y); return; }
      this.turnBy(0.008 * (x - this.last.x), 0.008 * (y - this.last.y));
      this.last = {x, y};
    });
    canvas.addEventListener("pointerup", ({offsetX: x, offsetY: y}) => {
      if (this.pressed && Math.hypot(x - this.pressed.x, y - this.pressed.y) < 4) this.choose(this.dotAt(x, y)?.i ?? null);
      this.pressed = null;
    });
    canvas.addEventListener("pointerleave", () => { this.tip.hidden = true; });
    canvas.addEventListener("dblclick", () => this.showAll());
    onKey(canvas, ({key}) => this.key(key));
  }

  key(key) {
    const turns = {ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, -0.15], ArrowDown: [0, 0.15]}, steps = {n: 1, p: -1}, count = this.points.length;
    if (turns[key]) this.turnBy(...turns[key]);
    else if (key !== "free" && LOOKS[key]) this.lookFrom(key);
    else if (steps[key] && count) this.choose(this.chosen === null ? (steps[key] > 0 ? 0 : count - 1) : (this.chosen + steps[key] + count) % count);
    else return zoomKey(key, factor => this.zoomBy(factor), () => this.showAll());
    return true;
  }
}

// The view with its choices; returns what shows it for the criterion. Only in three dimensions.
function placeSpace(head, criterion) {
  const states = head.states.filter(isInSpace), section = document.getElementById("space-section"), byId = id => document.getElementById(id);
  section.hidden = !states.length;
  if (!states.length) return () => {};
  const choice = byId("space-state"), look = byId("space-look"), onLook = name => { look.value = name; };
  states.forEach((state, i) => choice.add(new Option(`${state.path}, density ${densityText(state)}`, i)));
  Object.entries(LOOKS).forEach(([name, [text]]) => look.add(new Option(text, name)));
  look.append(element("option", {value: "", textContent: "Turned", hidden: true}));
  const view = new StressSpace(byId("space"), {tip: byId("space-tip"), told: byId("space-told"), onLook});
  const show = () => {
    const state = states[choice.value];
    view.show({name: choice.selectedOptions[0].textContent, points: pointsOf(state, criterion()), shell: modelOf(state, criterion(), TURNED)?.shell,
               loaded: state.states.map(({stress}) => stress)});
  };
  choice.value = Math.max(0, states.findLastIndex(state => modelOf(state, criterion(), TURNED)?.shell));
  choice.onchange = show;
  look.onchange = () => view.lookFrom(look.value);
  section.querySelector(".card-head").append(saveButtons("Yield points in the space of the normal stresses",
    {PNG: () => saveCanvas(fileName("normal stresses") + ".png", view.canvas)}));
  return show;
}
