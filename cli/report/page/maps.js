// Colormaps that are colour-blind safe and stay monotonic in greyscale.
"use strict";

const MAPS = {
  viridis: [[68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 140],
            [34, 168, 132], [68, 191, 112], [122, 209, 81], [189, 223, 38], [253, 231, 37]],
  cividis: [[0, 34, 78], [18, 53, 112], [59, 73, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120],
            [165, 156, 116], [195, 179, 105], [225, 204, 85], [254, 232, 56]],
  greys: [[240, 240, 240], [20, 20, 20]],
};
let chosenMap = "viridis";
const mapListeners = [];
const onMap = listener => { mapListeners.push(listener); };

function chooseMap(name) {
  chosenMap = name;
  mapListeners.forEach(listener => listener());
}

function mapColour(share) {
  const points = MAPS[chosenMap], last = points.length - 1;
  const at = Math.min(Math.max(share, 0), 1) * last, i = Math.min(Math.floor(at), last - 1);
  return [0, 1, 2].map(k => Math.round(points[i][k] + (at - i) * (points[i + 1][k] - points[i][k])));
}

const colour = share => `rgb(${mapColour(share).join(",")})`;

// A pale colour for every fragment, from its number only, so that it is the same in all frames. Hues and saturations
// follow a low-discrepancy sequence (Roberts' R2).
function fragmentColour(number) {
  const hue = number * 0.7548776662 % 1 * 6, pale = 0.2 + 0.3 * (number * 0.5698402910 % 1),
        value = 0.95;
  return [5, 3, 1].map(k => {
    const at = (k + hue) % 6;
    return Math.round(255 * (value - value * pale * Math.max(0, Math.min(at, 4 - at, 1))));
  });
}

// From opening to shear: mode I orange, mode II blue.
function modeRgb(share) {
  const points = [[213, 94, 0], [184, 155, 196], [0, 114, 178]],
        at = 2 * Math.min(Math.max(share, 0), 1);
  const i = at < 1 ? 0 : 1;
  return points[i].map((from, k) => Math.round(from + (at - i) * (points[i + 1][k] - from)));
}
const modeColour = share => `rgb(${modeRgb(share).join(',')})`;

// Dark or light text on a cell of this colour.
function inkOn(share) {
  const [red, green, blue] = mapColour(share);
  return 0.299 * red + 0.587 * green + 0.114 * blue > 140 ? "#1d2733" : "#ffffff";
}

// The colour bar of a map as a strip from low to high, with ticks; of whole numbers only, if all values are.
function drawScale(ctx, left, top, tall, {low, high, unit, isWhole = false}) {
  if (!(low <= high)) return;  // no value
  const shown = unitFor(unit, Math.max(Math.abs(low), Math.abs(high))), colours = theme(), wide = 14;
  for (let i = 0; i < tall; ++i) {
    ctx.fillStyle = colour(1 - i / (tall - 1));
    ctx.fillRect(left, top + i, wide, 1.5);
  }
  ctx.fillStyle = colours.ink;
  ctx.textAlign = "left";
  ctx.textBaseline = "alphabetic";
  ctx.fillText(shown.label, left, top - 10);
  if (!(high > low)) {
    ctx.fillText(digits(low * shown.factor), left + wide + 6, top + 8);
    return;
  }
  const ticks = niceTicks(low * shown.factor, high * shown.factor, Math.max(2, tall / 50)).filter(tick => !isWhole || Math.abs(tick - Math.round(tick)) < 1e-9), told = tickText(ticks);
  for (const tick of ticks) {
    const y = top + tall * (1 - (tick / shown.factor - low) / (high - low));
    ctx.fillRect(left + wide, y - 0.5, 4, 1);
    ctx.fillText(told(tick), left + wide + 8, y + 4);
  }
}
