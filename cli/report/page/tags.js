// Particle tags: number, material and class, each with its own colours.
"use strict";

// Pale enough for outlines and lines on top, and colour-blind safe: the first three differ in hue and
// lightness, the others mainly in lightness.
const TAG_COLOURS = ["#8fb8de", "#f0a868", "#b9d98c", "#d7a3c7", "#f2dd7e", "#7a9e9f", "#c9c9c9", "#b98b73", "#9a8fd0"];

const rgbOf = hex => hex.match(/\w\w/g).map(two => parseInt(two, 16));
const tagColour = (position, count) => count <= TAG_COLOURS.length ? rgbOf(TAG_COLOURS[position]) : fragmentColour(position);

// {name, names, values}: for each particle an index into `names`, or its number if `names` is empty.
function tagsOf(run) {
  const particles = run.head.mesh.particles;
  return [...run.tags, {name: "number", names: [], values: Int32Array.from({length: particles}, (_, i) => i)}];
}

// "particle 12, 316L, class large"; tags common to all particles are omitted.
function particleInWords(run, number) {
  const parts = [`particle ${number}`];
  for (const {name, names, values} of run.tags) {
    if (names.length > 1) parts.push(name === "class" ? `class ${names[values[number]]}` : names[values[number]]);
  }
  return parts.join(", ");
}

function shortened(ctx, text, wide) {
  if (ctx.measureText(text).width <= wide) return text;
  let kept = text.length;
  while (kept > 1 && ctx.measureText(text.slice(0, kept) + "…").width > wide) --kept;
  return text.slice(0, kept) + "…";
}

// A colour swatch and a name for each.
function drawTagLegend(ctx, left, top, {names}, colours, room) {
  ctx.textAlign = "left";
  names.forEach((name, i) => {
    const y = top + 20 * i;
    ctx.fillStyle = `rgb(${colours[i].join(",")})`;
    ctx.fillRect(left, y, 14, 14);
    ctx.strokeStyle = theme().edge;
    ctx.lineWidth = 1;
    ctx.strokeRect(left + 0.5, y + 0.5, 13, 13);
    ctx.fillStyle = theme().ink;
    ctx.fillText(shortened(ctx, name, room - 22), left + 20, y + 11);
  });
}
