// Put behind report_driver.js at the end of a report of particles in three dimensions: turns, cuts and asks as a reader
// would. The run is tests/helpers/synthetic_space_run.hpp's: particle n stands at column n % 2, row n / 2 % 2, layer n / 4 of
// 1 mm each, in layers that sink by a quarter.
"use strict";

const turnedKey = name => canvas().dispatchEvent(new KeyboardEvent("keydown", {key: name, shiftKey: true, bubbles: true, cancelable: true}));
const oneLine = answer => String(answer).replaceAll("\n", " ");
const box = id => document.getElementById(id);
async function settle(id, value, event = "change") {
  box(id).value = value;
  box(id).dispatchEvent(new Event(event));
  await widthFound();
  return hashOf(canvas());
}
async function ticked(id) {
  box(id).click();
  await widthFound();
  return hashOf(canvas());
}
const allDiffer = hashes => new Set(hashes).size === hashes.length;

// {particle, x, y, z} of what the tip says, in mm.
function spaceTip(x, y) {
  pointAt(Math.round(x), Math.round(y));
  const text = tip().hidden ? "" : tip().textContent, place = /x (\S+), y (\S+), z (\S+) (\S+)$/.exec(text), particle = /^particle (\d+)/.exec(text);
  if (!place || !particle) return null;
  const factor = {mm: 1, "µm": 1e-3}[place[4]];
  const [at, number] = [place.slice(1, 4).map(part => factor * Number(part.replace("−", "-"))), Number(particle[1])];
  return {particle: number, x: at[0], y: at[1], z: at[2], text};
}

function places() {
  const {width, height} = canvas().getBoundingClientRect(), found = [];
  for (let y = 0.2; y < 0.85; y += 0.06) for (let x = 0.1; x < 0.75; x += 0.06) found.push(spaceTip(x * width, y * height));
  return found.filter(Boolean);
}

// Every place lies in the particle that is named, and the value is told.
function tipIsRight(found, layers) {
  const isIn = (at, cell, size) => at > size * cell - 0.01 && at < size * (cell + 1) + 0.01;  // flat sides touch
  const wrong = found.find(({particle, x, y, z}) =>
    !isIn(x, particle % 2, 1) || !isIn(y, Math.floor(particle / 2) % 2, 1) || !isIn(z, Math.floor(particle / 4), 0.75));
  if (found.length < 12) return `few places: ${found.length}`;
  if (new Set(found.map(({particle}) => particle)).size < layers) return "few particles";
  if (!found.every(({text}) => /effective stress \d+(\.\d+)? \wPa/.test(text))) return `no value: ${found[0].text}`;
  return wrong ? `wrong: ${wrong.text}` : true;
}

// The map of densities: a layer of 3 x 4 cells across y, of 3 x 2 across z; others have other values.
function layersAreDrawn() {
  const across = document.querySelector("select[aria-label^=Axis]"), place = document.querySelector("input[aria-label^=Layer]");
  const map = across.closest(".card").querySelector("canvas"), note = () => map.getAttribute("aria-label"), seen = [hashOf(map)];
  if (!/in 3 × 4 cells, x to the right, z up, y from/.test(note())) return false;
  across.value = 2;
  across.onchange();
  for (const layer of [0, 3]) {
    place.value = layer;
    place.oninput();
    seen.push(hashOf(map));
  }
  return place.max === "3" && /in 3 × 2 cells, x to the right, y up, z from/.test(note()) && allDiffer(seen);
}

async function driveSpace() {
  await until(() => document.body.dataset.driven);
  canvas().focus();
  const first = hashOf(canvas());
  pointAt(200, 200, {buttons: 1, movementX: 60, movementY: 20});
  const offered = !document.querySelector("button.fit").hidden, dragged = hashOf(canvas());
  key("0", canvas());
  const isNamed = box("view").value === "isometric";
  told("turned", dragged !== first && offered && hashOf(canvas()) === first && isNamed);
  turnedKey("ArrowLeft");
  const views = [hashOf(canvas())], names = [box("view").value];
  for (const axis of "xyzi") {
    key(axis, canvas());
    views.push(hashOf(canvas()));
    names.push(box("view").value);
  }
  told("looked", names.join(" ") === " x y z isometric" && allDiffer(views) && views.at(-1) === first);
  told("tipInSpace", oneLine(tipIsRight(places(), 5)));

  const cuts = [first], cells = [];
  for (const axis of ["x", "y", "z", "free"]) {
    await settle("cut", axis);
    cuts.push(await settle("cut-at", axis === "free" ? 0.5 : 0.3, "input"));
    cells.push(Number(canvas().dataset.cells));
  }
  told("cut", allDiffer(cuts) && cells.every(count => count > 0));
  told("cutTold", /Cut at chosen plane/.test(canvas().getAttribute("aria-label")) && canvas().getAttribute("role") === "img");
  await settle("cut", "z");
  await settle("cut-at", 0.3, "input");
  key("z", canvas());
  const plane = Number(/z = (\S+)/.exec(canvas().getAttribute("aria-label"))[1]), inPlane = places();
  const units = /z = \S+ µm/.test(canvas().getAttribute("aria-label")) ? 1e-3 : 1;
  const low = tipIsRight(inPlane, 4);
  told("tipInSection", low === true ? inPlane.every(({z}) => z < plane * units + 0.01) && inPlane.some(({z}) => Math.abs(z - plane * units) < 0.01) : oneLine(low));
  const shown = hashOf(canvas());
  told("sliced", await ticked("slice") !== shown && await ticked("slice") === shown);
  await settle("cut", "");
  key("i", canvas());
  told("uncut", hashOf(canvas()) === first);
  const edges = await ticked("edges");
  told("edged", edges !== first && await ticked("edges") === first);
  const forces = await ticked("contacts"), lines = Number(canvas().dataset.contacts), named = /normal contact forces, widest \S+ k?N/.test(canvas().getAttribute("aria-label"));
  await settle("cut", "z");
  const half = hashOf(canvas());
  await settle("cut", "");
  told("networkInSpace", forces !== first && lines > 0 && named && half !== forces && await ticked("contacts") === first);
  told("layers", layersAreDrawn());
  told("toolsHidden", !box("tools") || await ticked("tools") !== first && await ticked("tools") === first);
  told("labels", [...document.querySelectorAll("#picture-place select, #picture-place input")].every(one => one.labels.length || one.ariaLabel || one.getAttribute("aria-label")));
}

driveSpace().then(() => told("spaced", "1"), error => { told("driverError", String(error && error.stack || error).replace(/[\n<>]/g, " ")); told("spaced", "1"); });
