// Raster images: trace and retrace side by side, levelled as usual in microscopy, with axes in micrometres.
"use strict";

// Subtracts the least-squares plane; values are stored line by line.
function levelledPlane(values, pixels, lines) {
  const n = pixels * lines, mx = (pixels - 1) / 2, my = (lines - 1) / 2;
  let mean = 0, bx = 0, by = 0;
  values.forEach((v, i) => {
    mean += v / n;
    bx += v * (i % pixels - mx);
    by += v * (Math.floor(i / pixels) - my);
  });
  bx /= Math.max(1, lines * pixels * (pixels * pixels - 1) / 12);
  by /= Math.max(1, pixels * lines * (lines * lines - 1) / 12);
  return values.map((v, i) => v - mean - bx * (i % pixels - mx) - by * (Math.floor(i / pixels) - my));
}

// Subtracts the median of each line.
function levelledLines(values, pixels) {
  const levelled = Float32Array.from(values);
  for (let from = 0; from < levelled.length; from += pixels) {
    const line = levelled.subarray(from, from + pixels), sorted = line.slice().sort(), middle = pixels >> 1;
    const median = pixels % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
    line.forEach((v, i) => { line[i] = v - median; });
  }
  return levelled;
}

const LEVELS = {none: ["as measured", values => values], plane: ["plane subtracted", levelledPlane],
                lines: ["median of each line subtracted", levelledLines]};

// The rasters of a run: {action, channels: {topography: {trace, retrace}, ...}}.
function rastersOf(run) {
  const rasters = new Map();
  for (const image of run.images) {
    const [, action, channel, way] = /^(.+)\/(.+)_(trace|retrace)$/.exec(image.name) || [];
    if (!action) continue;
    if (!rasters.has(action)) rasters.set(action, {action, channels: {}});
    (rasters.get(action).channels[channel] ||= {})[way] = image;
  }
  return [...rasters.values()];
}

// The images of a channel: trace, retrace, and for friction half of their difference, from which the slope of the surface
// cancels. Each is levelled separately.
function mapsOf(channel, {trace, retrace}, level) {
  const levelled = image => LEVELS[level][1](image.values, image.pixels, image.lines);
  const maps = [["trace", levelled(trace)], ...(retrace ? [["retrace", levelled(retrace)]] : [])];
  if (channel === "friction" && retrace) {
    const half = trace.values.map((v, i) => (v - retrace.values[i]) / 2);
    maps.push(["(trace − retrace)/2", LEVELS[level][1](half, trace.pixels, trace.lines)]);
  }
  return maps.map(([title, values]) => ({title, values, range: bounds([values])}));
}

// One map in a frame with axes and a separate colour bar; line 0 is at the bottom.
function drawMap(ctx, {left, top, wide, tall}, image, map) {
  const picture = element("canvas", {width: image.pixels, height: image.lines});
  const [low, high] = map.range, data = new ImageData(image.pixels, image.lines);
  map.values.forEach((value, i) => {
    const row = image.lines - 1 - Math.floor(i / image.pixels), at = 4 * (row * image.pixels + i % image.pixels);
    const [red, green, blue] = mapColour(high > low ? (value - low) / (high - low) : 0.5);
    data.data.set([red, green, blue, 255], at);
  });
  picture.getContext("2d").putImageData(data, 0, 0);
  ctx.imageSmoothingEnabled = false;
  ctx.drawImage(picture, left, top, wide, tall);
  const across = (image.pixel_width || 1) * image.pixels, up = (image.pixel_height || 1) * image.lines;
  const unit = image.pixel_width ? {factor: 1e6, label: "µm"} : {factor: 1, label: "pixels"};
  ctx.fillStyle = theme().soft;
  ctx.textAlign = "center";
  ctx.fillText(map.title, left + wide / 2, top - 8);
  for (const tick of niceTicks(0, across * unit.factor, Math.max(2, wide / 60))) {
    const x = left + wide * tick / (across * unit.factor);
    ctx.fillRect(x - 0.5, top + tall, 1, 4);
    ctx.fillText(digits(tick), x, top + tall + 16);
  }
  ctx.fillText(`along the scan [${unit.label}]`, left + wide / 2, top + tall + 32);
  ctx.save();
  ctx.translate(left - 40, top + tall / 2);
  ctx.rotate(-Math.PI / 2);
  ctx.fillText(`across [${image.pixel_height ? "µm" : "lines"}]`, 0, 0);
  ctx.restore();
  ctx.textAlign = "right";
  for (const tick of niceTicks(0, up * unit.factor, Math.max(2, tall / 50))) {
    const y = top + tall * (1 - tick / (up * unit.factor));
    ctx.fillRect(left - 4, y - 0.5, 4, 1);
    ctx.fillText(digits(tick), left - 7, y + 4);
  }
  drawScale(ctx, left + wide + 8, top + 14, tall - 14, {low, high, unit: image.unit});
}

const MAP_LEFT = 52, MAP_SIDES = MAP_LEFT + 74, LEAST_MAP = 150, MOST_MAP = 380;

// As many maps side by side as are not too small: {columns, wide}.
function mapsInARow(width, count) {
  const columns = Math.max(1, Math.min(Math.max(2, count), Math.floor(width / (MAP_SIDES + LEAST_MAP))));
  return {columns, wide: Math.max(20, Math.min(width / columns - MAP_SIDES, MOST_MAP))};
}

function drawRaster(canvas, image, maps) {
  const ratio = devicePixelRatio || 1, width = canvas.parentElement.clientWidth || 900;
  const {columns, wide} = mapsInARow(width, maps.length), cell = wide + MAP_SIDES;
  const up = (image.pixel_height || 1) * image.lines / ((image.pixel_width || 1) * image.pixels);
  const tall = Math.min(Math.max(wide * up, 60), 2 * wide), row = tall + 70, height = row * Math.ceil(maps.length / columns);
  canvas.style.height = height + "px";
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const ctx = canvas.getContext("2d");
  ctx.scale(ratio, ratio);
  ctx.font = "12px system-ui, sans-serif";
  maps.forEach((map, i) =>
    drawMap(ctx, {left: i % columns * cell + MAP_LEFT, top: Math.floor(i / columns) * row + 26, wide, tall}, image, map));
  canvas.dataset.wide = wide;
  canvas.dataset.scale = maps.map(map => map.range.join(" ")).join(" ");
}

// Maps of runs side by side share the same limits.
function sharedRanges(maps, rasters, channel, level) {
  const all = rasters.filter(({channels}) => channels[channel]?.trace).flatMap(({channels}) => mapsOf(channel, channels[channel], level));
  return maps.map(map => ({...map, range: bounds(all.filter(({title}) => title === map.title).map(({range}) => range))}));
}

// beside: the same raster of all runs shown.
function placeRaster({action, channels}, host, beside) {
  const channel = element("select", {className: "channel"}), level = element("select", {className: "level"});
  Object.keys(channels).filter(name => channels[name].trace).forEach(name => channel.add(new Option(name, name)));
  Object.entries(LEVELS).forEach(([name, [label]]) => level.add(new Option(label, name)));
  const canvas = element("canvas", {className: "figure", role: "img"}), note = element("p", {className: "note"});
  host.append(element("div", {className: "controls"}, element("label", {}, "Channel ", channel),
                      element("label", {}, "Levelling ", level)), canvas, note);
  host.parentElement.classList.add("wide");
  if (channels.topography) channel.value = "topography";
  const chosen = () => channels[channel.value];
  const maps = () => sharedRanges(mapsOf(channel.value, chosen(), level.value), beside, channel.value, level.value);
  const paint = () => {
    const {trace} = chosen(), drawn = maps();
    drawRaster(canvas, trace, drawn);
    note.textContent = `${trace.pixels} × ${trace.lines} pixels` +
      (trace.stride > 1 ? ` (every ${trace.stride} of run.h5)` : "") +
      drawn.map(({title, range: [low, high]}) => `; ${title} from ${withUnit(low, trace.unit)} to ${withUnit(high, trace.unit)}`).join("") + ".";
    canvas.setAttribute("aria-label", `${host.parentElement.querySelector("h2").textContent}: ${channel.value}, ${LEVELS[level.value][0]}. ${note.textContent}`);
  };
  channel.onchange = level.onchange = paint;
  [onUnits, onTheme, onMap].forEach(on => on(paint));
  let width = 0;
  onResize(host, () => { if (host.clientWidth !== width) { width = host.clientWidth; paint(); } });
  const name = () => fileName(`${action} ${channel.value} ${level.value}`);
  host.parentElement.querySelector(".card-head").append(saveButtons(`images of ${action}`, {
    PNG: () => saveCanvas(name() + ".png", canvas),
    CSV: () => saveText(name() + ".csv", csvOf(maps().map(({title, values}) =>
      ({label: `${channel.value}, ${title}`, unit: chosen().trace.unit, values}))), "text/csv")}));
  paint();
}

addPanel({
  title: "Images", order: 5, when: run => rastersOf(run).length > 0,
  draw({run, beside}, host) {
    const all = beside.flatMap(rastersOf);
    rastersOf(run).forEach((raster, i) => placeRaster(raster, i ? card(`Images of ${words(raster.action)}`) : host,
                                                      all.filter(({action}) => action === raster.action)));
  },
});
