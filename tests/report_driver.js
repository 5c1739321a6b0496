// Put at the end of a copy of a report by tests/report_in_browser.sh: does what a reader would do, and
// writes what came of it into the page, one attribute of <body> a question.
"use strict";

addEventListener("securitypolicyviolation", event => { document.body.dataset.violation = event.blockedURI; });

const until = async condition => {
  for (let i = 0; i < 400 && !condition(); ++i) await new Promise(done => setTimeout(done, 20));
  return condition();
};
const canvas = () => document.querySelector("canvas.picture");
const drawn = () => canvas() ? canvas().dataset.drawn : "";
const drawnAs = wanted => until(() => drawn() === wanted);

// The page draws anew when it has found its width (fonts, a scroll bar), and says so in no attribute: ten frames of
// the browser in a row, not a time, without another width. A busy machine renders few frames in a time.
async function widthFound() {
  const rendered = () => new Promise(done => requestAnimationFrame(() => setTimeout(done, 0)));
  for (let same = 0, before = 0, i = 0; same < 10 && i < 400; ++i) {
    await rendered();
    const host = canvas().parentElement.clientWidth;
    same = host === before ? same + 1 : 0;
    before = host;
  }
}

// Of the pixels, not of what the page says it has drawn.
function hashOf(picture) {
  const copy = new OffscreenCanvas(picture.width, picture.height).getContext("2d", {willReadFrequently: true});
  copy.drawImage(picture, 0, 0);
  const {data} = copy.getImageData(0, 0, picture.width, picture.height);
  let hash = 2166136261;
  for (const byte of data) hash = Math.imul(hash ^ byte, 16777619);
  return hash >>> 0;
}

// False where the page has used the key.
const key = (name, target = canvas(), more = {}) =>
  target.dispatchEvent(new KeyboardEvent("keydown", {key: name, bubbles: true, cancelable: true, ...more}));
const told = (name, value) => { document.body.dataset[name] = value; };
const change = (id, value) => {
  const select = document.getElementById(id);
  select.value = value;
  select.dispatchEvent(new Event("change"));
};

// What the tip says of a place of the canvas: {particle, x, y}; null where it is hidden.
const tip = () => document.querySelector(".tip");
function tipNow() {
  const text = tip().hidden ? "" : tip().textContent, place = /x (\S+), y (\S+) \S+$/.exec(text), particle = /^particle (\d+)/.exec(text);
  return place && particle ? {particle: particle[1], x: Number(place[1]), y: Number(place[2]), text} : null;
}
function pointAt(x, y, more = {}) {
  const {left, top} = canvas().getBoundingClientRect();
  canvas().dispatchEvent(new PointerEvent("pointermove", {clientX: left + x, clientY: top + y, bubbles: true, ...more}));
  return tipNow();
}

// It tells particle, place and value, and still does so when the picture has moved under the pointer.
function tipHolds() {
  const {width, height} = canvas().getBoundingClientRect(), found = [];
  for (let y = 0.25; y < 0.8 && found.length < 12; y += 0.11) {
    for (let x = 0.15; x < 0.7 && found.length < 12; x += 0.13) {
      const at = pointAt(Math.round(x * width), Math.round(y * height));
      if (at) found.push({...at, px: Math.round(x * width), py: Math.round(y * height)});
    }
  }
  const [a, b] = [found[0], found.at(-1)];
  if (found.length < 2) return `of few particles: ${found.length}`;
  if (!a.text.includes(document.getElementById("field").selectedOptions[0].text.toLowerCase())) return `no value: ${a.text}`;
  const step = Math.hypot(b.x - a.x, b.y - a.y) / Math.hypot(b.px - a.px, b.py - a.py);  // of a pixel
  const near = (one, x, y, factor = 1) => Math.abs(one.x - x) < 2 * step * factor && Math.abs(one.y - y) < 2 * step * factor;
  const same = (one, other) => one && one.particle === other.particle && near(one, other.x, other.y);
  pointAt(a.px, a.py);
  const {left, top} = canvas().getBoundingClientRect();
  canvas().dispatchEvent(new WheelEvent("wheel", {deltaY: -400, clientX: left + a.px, clientY: top + a.py, cancelable: true}));
  if (!same(tipNow(), a)) return "another place after zooming about it";
  const zoomed = pointAt(a.px + 40, a.py), less = Math.exp(-0.6);
  if (zoomed && !near(zoomed, a.x + 40 * step * less, a.y)) return "another scale after zooming";
  pointAt(a.px, a.py);
  if (!same(pointAt(a.px + 30, a.py + 20, {buttons: 1, movementX: 30, movementY: 20}), a)) return "another place after moving";
  key("0", canvas());
  const back = tipNow();
  if (back && !near(back, a.x + 30 * step, a.y - 20 * step)) return "another place after showing all";
  pointAt(a.px, a.py);
  return same(tipNow(), a);
}

// Columns of cards end together, and what the run cost stands at the very end.
function isWhole() {
  const bottomOf = column => column.lastElementChild.getBoundingClientRect().bottom;
  const columns = [...document.querySelectorAll(".columns")].map(({children: [one, other]}) => Math.abs(bottomOf(one) - bottomOf(other)));
  return columns.length > 0 && columns.every(apart => apart < 1) && document.querySelector("main").lastElementChild.id === "cost-section";
}

// Lines that show nothing beside the others are off at first, and one click shows them.
function hidesWhatIsNearZero() {
  const tiny = [...document.querySelectorAll(".legend button")].filter(button => button.title.startsWith("Below 1 %"));
  const off = tiny.filter(button => button.getAttribute("aria-pressed") === "false"), [first] = off, legend = first?.parentElement;
  if (!first || off.length < tiny.length) return `${off.length} of ${tiny.length} are off`;
  const name = first.textContent, chart = legend.closest(".chart"), drawn = () => chart.querySelectorAll("path.curve").length, before = drawn();
  first.click();
  const now = [...legend.children].find(button => button.textContent === name);
  const isShown = drawn() === before + 1 && now.getAttribute("aria-pressed") === "true";
  now.click();
  return isShown && drawn() === before;
}

// The title of a vertical axis is within its chart and left of the ticks.
function axesAreApart() {
  const box = text => text.getBoundingClientRect(), plots = [...document.querySelectorAll(".plot svg")];
  const wrong = plots.filter(svg => {
    const titles = [...svg.querySelectorAll('text[transform*="rotate(-90)"]')].map(box), all = box(svg);
    const ticks = [...svg.querySelectorAll('text[text-anchor="end"]')].map(text => box(text).left);
    return titles.some(title => title.left < all.left - 1 || title.top < all.top - 1 || title.bottom > all.bottom + 1 ||
                                ticks.some(left => left < title.right));
  });
  return plots.length > 0 && (wrong.length === 0 || `${wrong.length} of ${plots.length}: ${wrong[0].textContent}`);
}

// Lists have words and symbols: no key of a series or a value stands in one.
function hasNames() {
  const heads = [...document.querySelectorAll("#summary th, #quality th")].map(head => head.firstChild?.textContent ?? "");
  const told = [...[...document.querySelectorAll("#curve option")].map(option => option.textContent), ...heads];
  const keys = told.filter(text => /_|[a-z]{3}\/[a-z]{3}/.test(text));
  return told.length > 10 && (keys.length === 0 || keys.join("; "));
}

// Keys scroll the page where nothing has the focus, other controls and combinations keep theirs.
function leavesKeysAlone() {
  const before = document.getElementById("frame").value, focusable = [".plot", ".picture", "#frame"].map(one => document.querySelector(one));
  const scrolling = ["PageDown", "PageUp", " ", "Home", "End", "ArrowLeft", "ArrowRight"];
  const taken = [...[document.body, ...document.querySelectorAll("input:not(#frame), select")].flatMap(place =>
                   scrolling.filter(name => !key(name, place)).map(name => `${name} on ${place.id || place.tagName}`)),
                 ...focusable.filter(Boolean).flatMap(place => ["+", "-", "=", "0", "x", " ", "Home"].filter(name =>
                   !key(name, place, {ctrlKey: true}) || !key(name, place, {metaKey: true})).map(name => `Ctrl ${name} on ${place.className}`))];
  return taken.join("; ") || document.getElementById("frame").value === before;
}

async function drive() {
  await until(() => document.body.dataset.ready);
  told("unmeasured", withUnit(null, "Pa") === "–" && withUnit(undefined, "m") === "–" && withUnit(0, "m") === "0 m");
  told("hasCurves", document.querySelectorAll("path.curve").length > 0);
  told("axesApart", axesAreApart());
  told("whole", isWhole());
  told("named", hasNames());
  told("keysFree", leavesKeysAlone());
  told("nearZeroOff", hidesWhatIsNearZero());
  told("network", performance.getEntriesByType("resource").filter(entry => !entry.name.startsWith("data:")).length);
  const shown = document.querySelector("#curve option");
  told("cellFirst", Boolean(shown) && shown.textContent === "Stresses of the cell" && unitFor("J/m^3", 2.88e7).label === "MJ/m³");
  const bars = {family: "compaction", head: {mesh: {particles: 4}}, times: [0, 1], values: () => [1, 0.98], summary: {}};
  const parts = readable("largest 9048.9, 10201 N at 3 %").map(part => part.textContent ?? part).join("|");
  told("readable", parts === "largest |9.0489, 10.201 kN| at |3 %|" || parts);
  const twice = distinct({lines: [[1, 2], [1, 2], [1, 3]].map(values => ({values}))}).lines.map(({dash}) => Boolean(dash));
  const samplesOf = count => Array.from({length: count}, (_, i) => i / (count - 1)), ownSamples = [[7, 1], [12, 1], [12, 2]].map(([count, k]) =>
    ({x: samplesOf(count), values: samplesOf(count).map(x => k * x)}));  // lines of several runs
  const onTop = distinct({x: {values: []}, lines: ownSamples}).lines.map(({dash}) => Boolean(dash));
  told("uncovered", String(twice) === "false,true,false" && String(onTop) === "false,true,false" || `${twice}; ${onTop}`);
  const slid = far => did({...bars, family: "shear", values: name => name === "shear/distance" ? [0, far] : bars.values()});
  told("unslid", slid(0) === did(bars) && /slid under/.test(slid(1e-3)));
  const damped = materialRows([{name: "steel", damping: {mass_proportional: 5, stiffness_proportional: 2e-7}}])[0][1];
  told("damped", damped === "damping mass proportional 5 1/s, damping stiffness proportional 200 ns" || damped);
  told("pulled", did(bars) === "4 particles were moved and deformed");
  if (!canvas()) return;
  const slider = document.getElementById("frame"), last = Number(slider.max), field = document.getElementById("field").value;
  const at = (frame, what = field) => `${frame} ${what}`;
  await drawnAs(at(last));
  await widthFound();
  const first = hashOf(canvas());
  if (last > 0) {
    slider.value = Math.floor(last / 2);
    slider.dispatchEvent(new Event("input"));
    told("scrubbed", await drawnAs(at(Math.floor(last / 2))) && hashOf(canvas()) !== first);
    key("End");
    told("back", await drawnAs(at(last)) && hashOf(canvas()) === first);
    key("ArrowLeft");
    told("stepped", await drawnAs(at(last - 1)) && hashOf(canvas()) !== first);
    key("Home");
    key(" ");
    told("playing", document.getElementById("play").getAttribute("aria-label") === "Pause" &&
         await until(() => drawn() !== at(0)));
    key(" ");
    key("End");
    await drawnAs(at(last));
    const curves = document.querySelector(".plot"), box = curves.getBoundingClientRect();
    curves.dispatchEvent(new PointerEvent("pointermove", {clientX: box.left + 66, clientY: box.top + box.height / 2}));
    told("linked", await until(() => Number(drawn().split(" ")[0]) < last / 4));
    curves.dispatchEvent(new PointerEvent("pointerleave"));
    key("End");
    await drawnAs(at(last));
  }
  const curve = () => document.querySelector("path.curve").getAttribute("d"), plot = document.querySelector(".plot");
  if (plot) {
    const whole = curve();
    key("+", plot);
    told("curveZoomed", curve() !== whole);
    for (let i = 0; i < 30; ++i) key("+", plot);
    const ticks = anchor => [...plot.querySelectorAll(`text[text-anchor="${anchor}"]:not([transform])`)].map(text => text.textContent);
    told("ticksApart", ["middle", "end"].every(anchor => new Set(ticks(anchor)).size === ticks(anchor).length) || [...ticks("middle"), ...ticks("end")].join(" "));
    key("0", plot);
  }
  key("+", canvas());
  told("zoomed", hashOf(canvas()) !== first);
  key(document.getElementById("same-range") ? "0" : "-", canvas());
  key("0", canvas());
  if (tip()) {
    if (!document.getElementById("cut")) told("tip", tipHolds());  // in three dimensions: space_driver.js
    const all = hashOf(canvas()), button = document.querySelector("button.fit");
    key("+", canvas());
    const isOffered = !button.hidden;
    button.click();
    told("fit", isOffered && button.hidden && hashOf(canvas()) === all);
    if ([...document.getElementById("field").options].some(({value}) => value === "material")) {
      change("field", "material");
      told("material", await drawnAs(at(last, "material")) && hashOf(canvas()) !== all);
      change("field", field);
      await drawnAs(at(last));
    }
  }
  const other = [...document.getElementById("field").options].map(option => option.value).find(value => value !== field);
  change("field", other);
  told("otherField", await drawnAs(at(last, other)) && hashOf(canvas()) !== first);
  change("field", field);
  await drawnAs(at(last));
  for (const lines of ['contacts', 'bonds']) {
    const tick = document.getElementById(lines), before = hashOf(canvas());
    if (!tick) continue;
    tick.click();
    told(lines, await until(() => hashOf(canvas()) !== before));
    tick.click();
    await until(() => hashOf(canvas()) === before);
  }
  const dark = hashOf(canvas());
  document.getElementById("shade").click();
  told("dark", hashOf(canvas()) !== dark);
  document.getElementById("shade").click();
}

drive().then(() => told("driven", "1"), error => told("driverError", String(error && error.stack || error).replace(/[\n<>]/g, " ")));
