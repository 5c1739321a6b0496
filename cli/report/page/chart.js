// Line charts. A chart is {title, x, y, lines}: x and each line are {label, unit, values}, values in SI; y is
// the axis label. A line may have separate x values (x), a band around it (low, high), and standard-deviation
// bars (deviation) at some samples, and a `hue` or `colour` (strokeOf). Lines close to zero are hidden at first. A line with isMarks is drawn as
// markers with bars from low to high, with the fitted line (fit: x, values) on top.
"use strict";

const LIGHT = {ink: "#1d2733", soft: "#56616f", grid: "#e8ecf1", edge: "#c4cdd8", paper: "#ffffff",
               body: "#e2e6eb", surface: "#3d4855", none: "#c9d0d8",
               lines: ["#0072b2", "#d55e00", "#1d1d1d", "#009e73", "#e69f00", "#6f4fc8", "#cc79a7", "#882255", "#7fb069"]};
const DARK = {ink: "#e6ebf1", soft: "#9aa6b4", grid: "#2a323c", edge: "#4a5563", paper: "#171d24",
              body: "#2b343f", surface: "#a9b4c0", none: "#4b5562",
              lines: ["#56b4e9", "#ff8f4a", "#e6e6e6", "#35c9a0", "#b9e0ff", "#3f7fd6", "#e59bc4", "#a08cff", "#4c8f5c"]};

const darkWished = matchMedia("(prefers-color-scheme: dark)");
const isDark = () => (document.documentElement.dataset.theme || (darkWished.matches ? "dark" : "light")) === "dark";
const theme = () => isDark() ? DARK : LIGHT;
const themeListeners = [];
const onTheme = listener => { themeListeners.push(listener); };
const themeChanged = () => themeListeners.forEach(listener => listener());
darkWished.addEventListener("change", themeChanged);

const markup = text => text.replace(/[&<>"]/g, c => `&#${c.charCodeAt(0)};`);

function isSorted(values) {
  for (let i = 1; i < values.length; ++i) if (values[i] < values[i - 1]) return false;
  return true;
}

const bounds = lists => lists.reduce((range, list) => {
  for (const v of list) {
    if (!Number.isFinite(v)) continue;
    if (v < range[0]) range[0] = v;
    if (v > range[1]) range[1] = v;
  }
  return range;
}, [Infinity, -Infinity]);

const isRoundOff = (value, range) => Math.abs(value) < 1e-9 * Math.max(...range.map(Math.abs));

// A limit of zero is kept: force curves start on the axis.
function withMargin([low, high], share) {
  if (!(low <= high) || (low === 0 && high === 0)) return [0, 1];
  const margin = (high - low) * share || Math.abs(high) * 0.1;
  return [low === 0 ? 0 : low - margin, high === 0 ? 0 : high + margin];
}

// Samples drawn as marks whose error bar is many times longer than is usual in the chart: {line, i}. They do not scale
// the axis; their bars are cut off at its ends.
const UNCERTAIN = 20;  // over the median length

function uncertainMarks(lines) {
  const bars = lines.filter(line => line.isMarks).flatMap(line =>
    Array.from(line.values, (_, i) => ({line, i, length: line.high[i] - line.low[i]}))).filter(({length}) => length > 0);
  const median = bars.map(({length}) => length).sort((a, b) => a - b)[bars.length >> 1];
  return bars.filter(({length}) => length > UNCERTAIN * median);
}

// The chart data in display units, for drawing and for the cursor readout.
function shownChart(spec, hidden) {
  const xsOf = line => line.x || spec.x.values, uncertain = uncertainMarks(spec.lines);
  const most = lists => Math.max(0, ...lists.map(largest));
  const certain = (line, values) => (values || []).filter((_, i) => !uncertain.some(one => one.line === line && one.i === i));
  const x = unitFor(spec.x.unit, most(spec.lines.map(xsOf)));
  const y = unitFor(spec.lines[0].unit, most(spec.lines.map(line => certain(line, line.values))));
  const shown = spec.lines.filter((_, i) => !hidden.has(i));
  const ends = line => !line.deviation ? [] : barSamples(line).flatMap(i => [line.values[i] - line.deviation[i], line.values[i] + line.deviation[i]]);
  const fits = shown.map(line => line.fit).filter(Boolean);
  return {x, y, xLabel: labelled(spec.x.label, x.label), yLabel: labelled(spec.y, y.label),
          whole: {x: spec.x.names ? [-0.5, spec.x.names.length - 0.5]
                    : withMargin(bounds([...shown.map(xsOf), ...fits.map(fit => fit.x)]), 0.02).map(v => v * x.factor),
                  y: withMargin(bounds([...shown.flatMap(line => [...[line.values, line.low, line.high].map(values => certain(line, values)), ends(line)]),
                                        ...fits.map(fit => fit.values)]), 0.05).map(v => v * y.factor)}};
}

// Width of text as drawn in charts, pixels.
function textWidth(text) {
  const ctx = textWidth.context ||= element("canvas", {}).getContext("2d");
  ctx.font = "12px system-ui, sans-serif";
  return ctx.measureText(text).width;
}

// The title of a vertical axis, in lines that fit its height.
function titleLines(title, tall) {
  const lines = [];
  for (const word of title.split(" ")) {
    const longer = lines.length ? `${lines.at(-1)} ${word}` : word;
    if (lines.length && textWidth(longer) <= tall) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

const LINE_HEIGHT = 15, LEAST_LEFT = 62;

// Room to the left of the plot: for the ticks and the title beside them.
function roomOnTheLeft(ticks, title, tall) {
  const widest = Math.max(0, ...ticks.map(tickText(ticks)).map(textWidth));
  return Math.max(LEAST_LEFT, Math.ceil(6 + LINE_HEIGHT * titleLines(title, tall).length + 6 + widest + 7));
}

// The title of a vertical axis as SVG, from the left edge of the figure.
function axisTitleSvg(title, top, bottom) {
  return titleLines(title, bottom - top).map((line, i) =>
    `<text x="0" y="0" text-anchor="middle" transform="translate(${15 + LINE_HEIGHT * i} ${(top + bottom) / 2}) rotate(-90)">${markup(line)}</text>`).join("");
}

const valueTicks = ([low, high]) => niceTicks(low, high, 5);

// The plot rectangle within the figure, and the mapping from values to it.
function chartPlace({x: [x0, x1], y: [y0, y1]}, {width, height}, yLabel) {
  const right = width - 12, top = 10, bottom = height - 44, left = roomOnTheLeft(valueTicks([y0, y1]), yLabel, bottom - top);
  const sx = (right - left) / (x1 - x0), sy = (bottom - top) / (y1 - y0);
  return {left, right, top, bottom, px: v => left + (v - x0) * sx, py: v => bottom - (v - y0) * sy,
          xAt: p => x0 + (p - left) / sx, yAt: p => y0 + (bottom - p) / sy};
}

function pathOf(xs, ys, kx, ky, {px, py}) {
  let path = "", pen = false;
  for (let i = 0; i < ys.length; ++i) {
    const x = xs[i] * kx, y = ys[i] * ky;
    if (!Number.isFinite(x) || !Number.isFinite(y)) { pen = false; continue; }
    path += `${pen ? "L" : "M"}${px(x).toFixed(1)} ${py(y).toFixed(1)}`;
    pen = true;
  }
  return path;
}

function bandOf(xs, line, kx, ky, place) {
  const there = Array.from(xs), back = there.slice().reverse();
  return pathOf([...there, ...back], [...line.low, ...Array.from(line.high).reverse()], kx, ky, place) + "Z";
}

// Samples with standard-deviation bars: about a dozen, shifted between lines so that bars do not overlap.
function barSamples(line, shift = 0) {
  const count = line.values.length, step = Math.max(1, Math.floor(count / 12));
  return Array.from({length: Math.ceil(count / step)}, (_, k) => Math.min(count - 1, k * step + (step >> 1) + shift % step));
}

function barsOf(xs, line, kx, ky, {px, py}, stroke, shift) {
  const bar = i => {
    const x = px(xs[i] * kx), y = sign => py((line.values[i] + sign * line.deviation[i]) * ky).toFixed(1), [left, right] = [x - 3, x + 3].map(v => v.toFixed(1));
    return `M${left} ${y(-1)}H${right}M${x.toFixed(1)} ${y(-1)}V${y(1)}M${left} ${y(1)}H${right}`;
  };
  return `<path class="error-bar" d="${barSamples(line, shift).map(bar).join("")}" stroke="${stroke}" stroke-width="1.2"/>`;
}

// A line has the colour of its place, of another place of the palette (`hue`), or `colour`: the name of one in the theme, or any.
const strokeOf = ({hue, colour}, i, colours) => colours[colour] || colour || colours.lines[(hue ?? i) % colours.lines.length];

// Circles, with error bars where the error is known.
function marksOf(xs, line, kx, ky, {px, py}, stroke) {
  return Array.from(line.values, (value, i) => {
    const x = px(xs[i] * kx).toFixed(1), y = v => py(v * ky).toFixed(1);
    return `<circle class="mark" cx="${x}" cy="${y(value)}" r="3.5" fill="${stroke}"/>` +
      (line.high[i] > line.low[i] ? `<path d="M${x} ${y(line.low[i])}L${x} ${y(line.high[i])}" stroke="${stroke}"/>` : "");
  }).join("");
}

// The x axis may be categorical: names that are wider than their place stand in two rows.
const inTwoRows = ({names}, [low, high], wide) => Boolean(names) && Math.max(...names.map(textWidth)) > wide / (high - low) - 6;
const abscissaTicks = ({names}, [low, high], count) => names ? names.map((_, i) => i).filter(i => i >= low && i <= high)
  : niceTicks(low, high, Math.max(3, count));
const abscissaText = ({names}, told = digits) => value => names ? names[Math.round(value)] ?? "" : told(value);

// The line sample for the legend.
const keySvg = ({dash, isMarks}, stroke) => `<svg width="26" height="8" viewBox="0 0 26 8">` + (isMarks
  ? `<circle cx="13" cy="4" r="3.5" fill="${stroke}"/>`
  : `<path d="M0 4H26" stroke="${stroke}" stroke-width="2.4"${dash ? ` stroke-dasharray="${dash.join(" ")}"` : ""}/>`) + "</svg>";

// The chart as SVG text: shown on the page and saved by the buttons.
function chartSvg(spec, {view, hidden, width, height, colours, legend}) {
  const shown = shownChart(spec, hidden), range = view || shown.whole, visible = spec.lines.map((_, i) => i).filter(i => !hidden.has(i));
  const rows = legend ? visible.length * 16 : 0;
  const place = chartPlace(range, {width, height}, shown.yLabel), {left, right, top, bottom, px, py} = place;
  const text = (x, y, anchor, content, more = "") =>
    `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}" ${more}>${markup(content)}</text>`;
  const line = (x0, y0, x1, y1, stroke) =>
    `<path d="M${x0.toFixed(1)} ${y0.toFixed(1)}L${x1.toFixed(1)} ${y1.toFixed(1)}" stroke="${stroke}"/>`;
  const out = [`<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height + rows}" ` +
               `viewBox="0 0 ${width} ${height + rows}" font-family="system-ui, sans-serif" font-size="12" ` +
               `fill="${colours.soft}">`];
  if (legend) out.push(`<rect width="100%" height="100%" fill="${colours.paper}"/>`);
  const across = abscissaTicks(spec.x, range.x, (right - left) / 90), acrossText = abscissaText(spec.x, tickText(across));
  const staggered = inTwoRows(spec.x, range.x, right - left);
  for (const tick of across) {
    out.push(line(px(tick), top, px(tick), bottom, colours.grid),
             text(Math.min(px(tick), width - 30), bottom + (staggered && tick % 2 ? 28 : 16), "middle", acrossText(tick)));
  }
  const ticks = valueTicks(range.y), told = tickText(ticks);
  for (const tick of ticks) {
    out.push(line(left, py(tick), right, py(tick), colours.grid), text(left - 7, py(tick) + 4, "end", told(tick)));
  }
  if (range.y[0] < 0 && range.y[1] > 0) out.push(line(left, py(0), right, py(0), colours.edge));
  out.push(text((left + right) / 2, height - (staggered ? 3 : 8), "middle", shown.xLabel),
           axisTitleSvg(shown.yLabel, top, bottom));
  const clip = `plot-${chartSvg.count = (chartSvg.count || 0) + 1}`;
  out.push(`<clipPath id="${clip}"><rect x="${left}" y="${top}" width="${right - left}" ` +
           `height="${bottom - top}"/></clipPath><g clip-path="url(#${clip})" fill="none" ` +
           `stroke-width="1.8" stroke-linejoin="round">`);
  spec.lines.forEach((one, i) => {
    if (hidden.has(i)) return;
    const stroke = strokeOf(one, i, colours), xs = one.x || spec.x.values;
    if (one.isMarks) {
      out.push(marksOf(xs, one, shown.x.factor, shown.y.factor, place, stroke));
      if (one.fit) {
        out.push(`<path class="curve" d="${pathOf(one.fit.x, one.fit.values, shown.x.factor, shown.y.factor, place)}" ` +
                 `stroke="${stroke}"/>`);
      }
      return;
    }
    if (one.low) {
      out.push(`<path d="${bandOf(xs, one, shown.x.factor, shown.y.factor, place)}" fill="${stroke}" fill-opacity="0.2"/>`);
    }
    out.push(`<path class="curve" d="${pathOf(xs, one.values, shown.x.factor, shown.y.factor, place)}" ` +
             `stroke="${stroke}"${one.dash ? ` stroke-dasharray="${one.dash.join(" ")}"` : ""}/>`);
  });
  spec.lines.forEach((one, i) => {
    if (hidden.has(i) || !one.deviation) return;
    const stroke = strokeOf(one, i, colours);
    out.push(barsOf(one.x || spec.x.values, one, shown.x.factor, shown.y.factor, place, stroke, 4 * i));
  });
  out.push("</g>");
  if (legend) {
    visible.forEach((i, row) => {
      const one = spec.lines[i], y = height + 16 * row + 6, stroke = strokeOf(one, i, colours);
      out.push(`<g transform="translate(${left} ${y - 8})">${keySvg(one, stroke)}</g>`, text(left + 34, y, "start", one.label));
    });
  }
  return out.join("") + "</svg>";
}

// Three lines per dash pattern: nine can be told apart by colour, and by pattern and lightness for colour-blind readers
// or in greyscale. tests/line_colours.py checks this for the palettes above. Further lines use longer dashes.
const DASHES = [undefined, [8, 4], [2, 3]];

function dashOf(i) {
  const around = Math.floor(i / LIGHT.lines.length), dash = DASHES[Math.floor(i % LIGHT.lines.length / 3)];
  return around ? [...(dash || [14, 3]), 2 + around, 3] : dash;
}

// The value of a line at x, between its samples.
function valueAt(xs, values, x) {
  let low = 0, high = xs.length - 1;
  if (!(x >= xs[low] && x <= xs[high])) return NaN;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (xs[middle] <= x) low = middle;
    else high = middle;
  }
  return xs[high] > xs[low] ? values[low] + (values[high] - values[low]) * (x - xs[low]) / (xs[high] - xs[low]) : values[high];
}

const areEqual = (a, b) => a === b || (a.length === b.length && a.every((value, i) => value === b[i]));

// Lines of one chart may have samples of their own, as those of several runs.
function coincide(line, other, axis) {
  const scale = 0.005 * largest(line.values), xs = line.x || axis, there = other.x || axis;
  const apart = (value, from) => Math.abs(value - from) > scale;
  if (areEqual(xs, there)) return line.values.length === other.values.length && line.values.every((value, i) => !apart(value, other.values[i]));
  if (!isSorted(xs) || !isSorted(there)) return false;
  const values = Array.from(xs, x => valueAt(there, other.values, x)), shared = values.filter(Number.isFinite).length;
  return shared > 0.5 * xs.length && line.values.every((value, i) => !apart(value, values[i]));
}

// A line that covers an earlier one of the same pattern has gaps in which that is seen.
function distinct(spec) {
  const lines = [], axis = spec.x?.values || [];
  spec.lines.forEach((line, i) => {
    const isGiven = line.dash || line.colour || line.hue !== undefined || line.isMarks, own = isGiven ? line.dash : dashOf(i);
    const covered = isGiven ? [] : lines.filter(other => !other.isMarks && coincide(line, other, axis)).map(({dash}) => String(dash));
    const dash = covered.includes(String(own)) ? DASHES.find(one => one && !covered.includes(String(one))) || own : own;
    lines.push(isGiven ? line : {...line, dash});
  });
  return {...spec, lines};
}

const NEAR_ZERO = 0.01;  // fraction of the largest line

// Indices of the lines that are negligible compared with the largest.
function nearZero(lines) {
  const most = Math.max(0, ...lines.map(line => largest(line.values)));
  return new Set(lines.flatMap((line, i) => line.isMarks || largest(line.values) >= NEAR_ZERO * most ? [] : [i]));
}

class Chart {
  // onCursor(sample): called when the pointer is at this sample.
  constructor(host, spec, {height = 300, onCursor = null} = {}) {
    Object.assign(this, {host, spec: distinct(spec), height, onCursor, hidden: nearZero(spec.lines), wanted: new Map(), view: null, marked: null});
    host.classList.add("chart");
    host.chart = this;
    this.picture = element("div", {className: "plot", tabIndex: 0, role: "img", "aria-label": this.label()});
    this.over = element("canvas", {className: "over", "aria-hidden": "true"});
    this.legend = element("div", {className: "legend"});
    this.readout = element("p", {className: "readout", "aria-live": "off"});
    host.replaceChildren(element("div", {className: "plot-place"}, this.picture, this.over), this.legend, this.readout);
    this.listen();
    this.draw();
    onResize(host, () => { if (host.clientWidth > 0 && host.clientWidth !== this.width) this.draw(); });
    onUnits(() => { this.view = null; this.draw(); });
    onTheme(() => this.draw());
  }

  label() {
    const {spec, host} = this, heading = host.parentElement?.querySelector("h2")?.textContent;
    return `${heading ? heading + ". " : ""}Chart of ${spec.y} against ${spec.x.label}: ${spec.lines.map(line => line.label).join(", ")}. ` +
      "Plus and minus zoom, 0 shows all.";
  }

  show(spec) {
    Object.assign(this, {spec: distinct(spec), view: null, hidden: nearZero(spec.lines), wanted: new Map(), marked: null});
    this.picture.setAttribute("aria-label", this.label());
    this.draw();
  }

  // The same chart with more samples: zoom and chosen lines stay.
  renew(spec, {view, wanted} = this) {
    Object.assign(this, {spec: distinct(spec), hidden: nearZero(spec.lines), view, wanted});
    spec.lines.forEach(({label}, i) => {
      if (wanted.has(label)) wanted.get(label) ? this.hidden.delete(i) : this.hidden.add(i);
    });
    if (this.hidden.size === spec.lines.length) this.hidden.clear();
    if (this.at >= spec.lines[0].values.length) this.at = undefined;
    this.draw();
  }

  draw() {
    if (!document.contains(this.host)) return;
    this.width = Math.max(280, this.host.clientWidth);
    const options = {...this, colours: theme(), legend: false};
    this.picture.innerHTML = chartSvg(this.spec, options);
    this.shown = shownChart(this.spec, this.hidden);
    this.place = chartPlace(this.view || this.shown.whole, this, this.shown.yLabel);
    this.drawLegend();
    this.drawOver();
  }

  drawLegend() {
    const colours = theme(), negligible = nearZero(this.spec.lines);
    this.legend.replaceChildren(...this.spec.lines.map((line, i) => {
      const key = element("i", {}), tiny = negligible.has(i);
      key.innerHTML = keySvg(line, strokeOf(line, i, colours));
      const button = element("button", {type: "button", "aria-pressed": String(!this.hidden.has(i)),
        title: tiny ? "Below 1 % of the largest value. Show or hide" : "Show or hide"}, key, line.label);
      button.onclick = () => {
        this.wanted.set(line.label, this.hidden.delete(i) || !this.hidden.add(i));
        if (this.hidden.size === this.spec.lines.length) this.hidden.clear();
        this.draw();
      };
      return button;
    }));
  }

  pointOf(line, sample) {
    const xs = line.x || this.spec.x.values;
    return [this.place.px(xs[sample] * this.shown.x.factor), this.place.py(line.values[sample] * this.shown.y.factor)];
  }

  // Moving parts: the cursor, the sample of the current frame, the zoom box.
  drawOver() {
    const ratio = devicePixelRatio || 1, {place, over, width, height} = this, colours = theme();
    over.width = width * ratio;
    over.height = height * ratio;
    over.style.width = width + "px";
    over.style.height = height + "px";
    const ctx = over.getContext("2d");
    ctx.scale(ratio, ratio);
    const sample = this.at ?? this.marked;
    if (sample !== null && sample !== undefined) {
      this.spec.lines.forEach((line, i) => {
        if (this.hidden.has(i)) return;
        const [x, y] = this.pointOf(line, Math.min(sample, line.values.length - 1));
        if (i === 0 || line.x) {
          ctx.fillStyle = colours.edge;
          ctx.fillRect(x - 0.5, place.top, 1, place.bottom - place.top);
        }
        if (!Number.isFinite(y) || x < place.left - 1 || x > place.right + 1) return;
        ctx.beginPath();
        ctx.arc(x, y, 4, 0, 2 * Math.PI);
        ctx.fillStyle = strokeOf(line, i, colours);
        ctx.fill();
        ctx.strokeStyle = colours.paper;
        ctx.lineWidth = 1.5;
        ctx.stroke();
      });
    }
    if (this.box) {
      const {x0, y0, x1, y1} = this.box;
      ctx.fillStyle = "rgba(80, 130, 180, 0.2)";
      ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
    }
    this.tell(sample);
  }

  tell(sample) {
    const {spec, shown} = this;
    if (sample === null || sample === undefined) { this.readout.textContent = ""; return; }
    const value = (v, unit, range) => digits(isRoundOff(v * unit.factor, range) ? 0 : v * unit.factor) + (unit.label ? " " + unit.label : "");
    const read = spec.lines.filter((line, i) => !this.hidden.has(i) && !Number.isNaN(line.values[Math.min(sample, line.values.length - 1)]));
    const lines = (read.length ? read : spec.lines.filter((_, i) => !this.hidden.has(i)))
      .map(line => `${line.label} ${value(line.values[Math.min(sample, line.values.length - 1)], shown.y, shown.whole.y)}`);
    const xs = spec.x.values || [];
    this.readout.textContent = (xs.length ? `${spec.x.label} ${spec.x.names ? abscissaText(spec.x)(xs[sample]) : value(xs[sample], shown.x, shown.whole.x)}: ` : "") + lines.join(", ");
  }

  // Marks the sample of the frame shown elsewhere.
  mark(sample) {
    this.marked = sample;
    if (this.at === undefined) this.drawOver();
  }

  // The sample nearest to a point in the chart, over all visible lines.
  sampleNear(x, y) {
    let best = null, least = Infinity;
    this.spec.lines.forEach((line, i) => {
      if (this.hidden.has(i)) return;
      const turns = !isSorted(line.x || this.spec.x.values);  // then the vertical distance counts, too
      for (let k = 0; k < line.values.length; ++k) {
        const [px, py] = this.pointOf(line, k), far = (px - x) ** 2 + (turns ? (py - y) ** 2 : 0);
        if (far < least) { least = far; best = k; }
      }
    });
    return best;
  }

  zoom(factor, x, y) {
    const range = this.view || this.shown.whole;
    const around = ([low, high], middle) => [middle + (low - middle) * factor, middle + (high - middle) * factor];
    const middle = ([low, high]) => (low + high) / 2;
    this.view = {x: around(range.x, x ?? middle(range.x)), y: around(range.y, y ?? middle(range.y))};
    this.draw();
  }

  zoomToBox({x0, y0, x1, y1}) {
    const {xAt, yAt} = this.place, sorted = (a, b) => a < b ? [a, b] : [b, a];
    this.view = {x: sorted(xAt(x0), xAt(x1)), y: sorted(yAt(y0), yAt(y1))};
    this.draw();
  }

  listen() {
    const {picture} = this;
    const at = event => {
      const box = picture.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    picture.addEventListener("pointermove", event => {
      const [x, y] = at(event);
      if (this.box) {
        Object.assign(this.box, {x1: x, y1: y});
      } else {
        this.at = this.sampleNear(x, y) ?? undefined;
        if (this.onCursor && this.at !== undefined) this.onCursor(this.at);
      }
      this.drawOver();
    });
    picture.addEventListener("pointerleave", () => { this.at = undefined; this.drawOver(); });
    picture.addEventListener("pointerdown", event => {
      if (event.pointerType !== "mouse" || event.button !== 0) return;
      const [x, y] = at(event);
      picture.setPointerCapture(event.pointerId);
      this.box = {x0: x, y0: y, x1: x, y1: y};
    });
    const release = () => {
      const {box} = this;
      this.box = null;
      if (box && Math.abs(box.x1 - box.x0) > 8 && Math.abs(box.y1 - box.y0) > 8) this.zoomToBox(box);
      else this.drawOver();
    };
    picture.addEventListener("pointerup", release);
    picture.addEventListener("pointercancel", release);
    picture.addEventListener("dblclick", () => this.showAll());
    picture.addEventListener("wheel", event => {
      if (!event.ctrlKey && !event.shiftKey) return;  // let the page scroll
      event.preventDefault();
      const [x, y] = at(event), turn = event.deltaY || event.deltaX;
      this.zoom(Math.exp(0.002 * turn), this.place.xAt(x), this.place.yAt(y));
    }, {passive: false});
    onKey(picture, event => this.key(event));
  }
  key({key}) { return zoomKey(key, factor => this.zoom(factor), () => this.showAll()); }
  showAll() { this.view = null; this.draw(); }

  columns() {
    const {spec} = this;
    if (!spec.lines.some(line => line.x)) return [spec.x, ...spec.lines];
    return spec.lines.flatMap(line => [{...spec.x, label: `${spec.x.label}, ${line.label}`,
                                        values: line.x || spec.x.values}, line]);
  }

  svg() { return chartSvg(this.spec, {...this, width: 640, height: 400, colours: LIGHT, legend: true}); }

  saving(title) {
    const name = () => fileName(this.spec.title || title);
    return saveButtons(title, {
      SVG: () => saveText(name() + ".svg", this.svg(), "image/svg+xml"),
      PNG: () => saveAsPng(name() + ".png", this.svg(), 640, 400 + 16 * (this.spec.lines.length - this.hidden.size)),
      CSV: () => saveText(name() + ".csv", csvOf(this.columns()), "text/csv")});
  }
}

// A card for one figure, with its title and optional controls.
function card(title, ...controls) {
  const box = element("section", {className: "card"}), host = element("div", {});
  const head = element("div", {className: "card-head"}, element("h2", {textContent: title}));
  box.append(head, ...controls, host);
  const all = document.getElementById("curves");
  all.insertBefore(box, all.querySelector(":scope > section[id]"));  // the fixed sections of the page come last
  return host;
}

function drawChart(host, spec, options) {
  const title = spec.title || host.parentElement.querySelector("h2").textContent;
  const chart = new Chart(host, spec, options), head = host.parentElement.querySelector(".card-head");
  head.querySelector(".save")?.remove();
  head.append(chart.saving(title));
  return chart;
}
