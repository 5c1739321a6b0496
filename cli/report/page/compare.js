// Several runs side by side: common time, scale and colour range; curves overlaid.
// Status on <body>: data-ready, data-views, data-lines, data-panels, or data-error.
"use strict";

// Names that distinguish the runs: titles, or folders where titles are equal.
function namesOf(runs) {
  const titles = runs.map(run => run.head.title), same = new Set(titles).size < titles.length;
  return runs.map((run, i) => same ? run.head.folder : titles[i]);
}

const keyOf = line => line.name || line.label;
const groupOf = (run, title) => curvesOf(run).find(one => one.title === title);

// The contribution of one run to a curve.
function contributionOf(run, title, model, x) {
  const group = groupOf(run, title), axis = group && group.xs.find(one => one.label === x);
  if (!axis) return null;
  const key = keyOf(model), own = group.lines.find(one => keyOf(one) === key) || (run.has(key) ? run.series(key) : null);
  return own && {...own, x: axis.values, axis, y: group.y, hue: undefined, colour: undefined, dash: undefined};
}

// Controls that are there for every run or curve are told apart by its name.
function nameControls(box, name) {
  for (const one of box.querySelectorAll("select, input")) {
    const own = one.getAttribute("aria-label") || one.labels[0]?.firstChild.textContent.trim();
    one.setAttribute("aria-label", `${own}, ${name}`);
  }
}

// A curve that at least two runs have, each with its own x values.
function overlaid(runs, names, title, model, x) {
  const parts = runs.map((run, i) => {
    const part = contributionOf(run, title, model, x);
    return part && {...part, label: names[i]};
  }).filter(Boolean);
  return parts.length < 2 ? null
    : {title: `${title}: ${model.label}`, x: {...parts[0].axis, values: []}, y: `${model.label}, ${parts[0].y}`, lines: parts};
}

// All curves of the runs, each once, except those near zero in all of them: [title, the line of the first run, labels of its x axes].
function curvesOfAll(runs) {
  const found = new Map();
  for (const run of runs) {
    for (const {title, lines, xs} of curvesOf(run)) {
      const negligible = nearZero(lines);
      for (const line of lines.filter((_, i) => !negligible.has(i))) {
        const key = JSON.stringify([title, keyOf(line)]), known = found.get(key) || [title, line, new Set()];
        xs.forEach(x => known[2].add(x.label));
        found.set(key, known);
      }
    }
  }
  return [...found.values()];
}

function placeCurves(runs, names) {
  let count = 0;
  const told = new Set();
  for (const [title, model, labels] of curvesOfAll(runs)) {
    const choices = [...labels].map(x => [x, overlaid(runs, names, title, model, x)]).filter(choice => choice[1]);
    if (!choices.length) continue;
    const first = choices[0][1], select = element("select", {});
    choices.forEach(([label], i) => select.add(new Option(label, i)));
    const host = card(first.title, element("div", {className: "controls"}, element("label", {}, "against ", select)));
    nameControls(host.parentElement, first.title);
    const chart = drawChart(host, first);
    select.onchange = () => chart.show(choices[select.value][1]);
    const {meaning} = runs.map(run => groupOf(run, title)).find(Boolean);
    if (meaning && !told.has(title)) host.parentElement.append(element("p", {className: "note", textContent: meaning}));
    told.add(title);
    count += first.lines.length;
  }
  document.body.dataset.lines = count;
}

function fillRuns(runs, names) {
  const rows = new Map();
  runs.forEach((run, i) => {
    const told = [...figuresOf(run).map(([label, value]) => [label, value]),
                  ...knownRows(run).filter(([, text]) => text)];
    for (const [label, text] of told) {
      if (!rows.has(label)) rows.set(label, Array(runs.length).fill("–"));
      rows.get(label)[i] = text;
    }
  });
  const table = document.getElementById("runs");
  table.tHead.replaceChildren();
  table.tBodies[0].replaceChildren();
  table.tHead.insertRow().append(...["", ...names].map(textContent => element("th", {scope: "col", textContent})));
  for (const [label, texts] of rows) {
    table.tBodies[0].insertRow().append(element("th", {scope: "row", textContent: label}),
      ...texts.map(textContent => element("td", {textContent})));
  }
}

const showSection = (id, rows) => { document.getElementById(`${id}-section`).hidden = !rows.length; };

// Quality values with their limits, expectations and warnings: one row per value, one column per run.
function fillQualities(runs, names) {
  const rows = new Map(), put = (name, i, cell) => {
    if (!rows.has(name)) rows.set(name, Array(runs.length).fill("–"));
    rows.get(name)[i] = cell;
  };
  const verdict = (good, text) => element("span", {className: good ? "within" : "beyond", textContent: text});
  runs.forEach((run, i) => {
    for (const figure of qualityFigures(run)) {
      const limited = typeof figure.limit === "number";
      put(figure.name, i, limited ? verdict(!isBeyond(figure), `${percent(figure.value)} (${percent(figure.limit)})`) : percent(figure.value));
    }
    for (const one of run.summary.expectations || [])
      put(toldExpectation(one.what), i, verdict(one.met, `${one.measured} (${one.met ? "met" : `NOT met: ${one.expected}`})`));
    const warnings = (run.summary.warnings || []).length;
    if (warnings) put("Warnings", i, verdict(false, counted(warnings, "warning")));
  });
  showSection("quality", [...rows]);
  if (!rows.size) return;
  fillColumns(document.getElementById("quality"), [{title: "quantity", cells: [...rows.keys()].map(titled)},
    ...names.map((title, i) => ({title, cells: [...rows.values()].map(row => row[i])}))]);
}

// The tables of a compaction, with the run in the first column.
function fillCompactions(runs, names) {
  const laws = runs.flatMap(({summary: {fits}}, i) => Array.isArray(fits?.laws) ? lawRows(names[i], fits) : []);
  const shares = runs.flatMap(({summary: {transmission}}, i) =>
    (transmission?.shares || []).map(share => ({name: names[i], wall_friction: transmission.wall_friction, ...share})));
  showSection("laws", laws);
  showSection("transmission", shares);
  if (laws.length) fillTexts("laws", LAW_TITLES, laws);
  if (!shares.length) return;
  const columns = [["wall_friction", "wall µ"], ...TRANSMISSION].filter(([key]) => shares.some(share => key in share));
  fillTexts("transmission", ["run", ...columns.map(([, title]) => title)],
            shares.map(share => [share.name, ...columns.map(([key]) => digits(share[key]))]));
  document.getElementById("transmission-note").textContent = `${TRANSMISSION_NOTE}.`;
}

// The cards of the individual reports, runs side by side, one row per kind of card.
function placePanels(runs, names, timeline) {
  const reports = runs.map(run => new Report(run, timeline, runs)), last = document.getElementById("runs-section");
  let count = 0;
  for (const panel of panelsInOrder()) {
    const row = element("div", {className: "cards"});
    last.before(row);
    reports.forEach((report, i) => {
      if (!panel.when(report.run)) return;
      const host = card(`${panel.title}: ${names[i]}`);
      row.append(host.parentElement);
      panel.draw(report, host);
      nameControls(host.parentElement, names[i]);
      ++count;
    });
  }
  document.body.dataset.panels = count;
}

// The views of the runs that have frames; particle views share the scale of the largest.
async function placeViews(runs, names) {
  const host = document.getElementById("pictures"), drawn = runs.filter(run => run.frames.length && run.head.mesh);
  const shown = drawn.filter(run => !run.inSpace), radius = Math.max(...drawn.filter(run => run.inSpace).map(SpaceView.radiusOf));
  const extent = k => Math.max(...shown.map(({head}) => head.high[k] - head.low[k]));
  const whole = {width: extent(0), height: extent(1)}, views = [];
  for (const [i, run] of runs.entries()) {
    const place = element("div", {}), pane = element("div", {className: "pane"}, element("h2", {textContent: names[i]}), place);
    host.append(pane);
    if (shown.includes(run)) views.push(new FieldView(place, run, {whole, most: 420, name: names[i]}));
    else if (drawn.includes(run)) views.push(new SpaceView(place, run, {whole: {radius}, most: 420, name: names[i]}));
    else if (run.frames.length && run.head.solid) views.push(await SolidView.load(place, run, names[i]));
    else place.append(element("p", {className: "note", textContent: "No picture: the scene wrote no frames."}));
  }
  return views;
}

// Controls for all views of one kind: field, contact forces and bonds where available.
async function placeControls(views, wanted, {id, name}) {
  if (!views.length) return;
  const controls = document.getElementById("controls"), field = element("select", {id});
  const show = change => Promise.all(views.map(view => view.show(change))).then(() => views.forEach(view => view.draw()));
  views[0].choices.forEach(([value, label]) => field.add(new Option(label, value)));
  field.value = views[0].choices.some(([value]) => value === wanted) ? wanted : views[0].choices[0][0];
  field.onchange = () => show({shown: field.value});
  controls.append(element("label", {}, name + " ", field));
  const tick = (label, name, has) => {
    if (!views.some(({run}) => run.frames.some(has))) return;
    const box = element("input", {type: "checkbox"});
    box.onchange = () => show({[name]: box.checked});
    controls.append(element("label", {}, box, " " + label));
  };
  tick("contact forces", "contacts", frame => frame.network && frame.network.lines);
  tick("bonds and cracks", "bonds", frame => frame.fragments);
  await show({shown: field.value});
}

// A common colour range: over all frames of all runs, or over the frames shown.
function shareRanges(views, hasColours) {
  const alone = view => Object.assign(Object.create(Object.getPrototypeOf(view)), view, {ranges: null}).range();
  const common = () => bounds([views.filter(hasColours).flatMap(alone)]);
  views.forEach(view => { view.ranges = common; });
}

async function main() {
  const {runs: heads} = JSON.parse(document.getElementById("head").textContent);
  const runs = await Promise.all(heads.map((head, i) => Run.load(head, `run-${i}-`))), names = namesOf(runs);
  document.getElementById("names").textContent = `${runs.length} runs side by side`;
  document.getElementById("lead").textContent = names.join(" · ");
  placeSettings(document.getElementById("settings"), new Set(runs.flatMap(run => run.head.series).map(series => series.unit)));
  const views = await placeViews(runs, names), pace = views.map(view => view.run).sort((a, b) => b.frames.length - a.frames.length)[0];
  const timeline = new Timeline(document.getElementById("timeline"), pace ? pace.frames.map(frame => frame.time / (pace.frames.at(-1).time || 1)) : [],
                                share => `fraction of the run ${digits(share, 3)}`);
  document.getElementById("timeline").hidden = !pace || pace.frames.length < 2;
  placeCurves(runs, names);
  placePanels(runs, names, timeline);
  const fillTables = () => [fillRuns, fillQualities, fillCompactions].forEach(fill => fill(runs, names));
  fillTables();
  onUnits(fillTables);
  const fields = views.filter(view => view instanceof FieldView), solids = views.filter(view => view instanceof SolidView);
  fields.forEach(view => {
    view.allNames = tag => [...new Set(runs.flatMap(run => (run.tags || []).filter(({name}) => name === tag).flatMap(({names}) => names)))];
  });
  shareRanges(fields, view => view.position && (view.codes || view.tag || view.shown === "density"));
  shareRanges(solids, view => view.moved);
  const redraw = share => Promise.all(views.map(view => view.showShare(share))).then(() => views.forEach(view => view.draw()));
  timeline.listen(redraw);
  const both = fields.length > 0 && solids.length > 0;
  await placeControls(fields, "effective_stress", {id: "field", name: both ? "Particles" : "Show"});
  await placeControls(solids, "size", {id: both ? "lever-field" : "field", name: both ? "Levers" : "Show"});
  document.body.dataset.views = views.length;
  document.body.dataset.ready = "1";
}

main().catch(fail);
