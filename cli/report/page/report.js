// Assembles the page. Status on <body>: data-ready, or data-error.
"use strict";

// The large chart: choice of curves and x axis.
function placeCurves(report, host) {
  const {run} = report;
  const single = run.head.series.filter(({name}) => name !== "time").map(({name, meaning}) =>
    ({title: titled(toldName(name)), meaning: `${meaning} (${name})`, xs: [timeAxis(run)], y: toldName(name),
      lines: [run.series(name, toldName(name))]}));
  const groups = [...curvesOf(run), ...single];
  if (run.times.length < 2 || !groups.length) return;
  const what = element("select", {id: "curve"}), against = element("select", {id: "against"});
  const families = element("optgroup", {label: "Curves"}), others = element("optgroup", {label: "Any recorded series"});
  groups.forEach((group, i) => (i < groups.length - single.length ? families : others).append(new Option(group.title, i)));
  what.append(...[families, others].filter(list => list.children.length));
  const place = element("div", {}), note = element("p", {className: "note"});
  host.append(element("div", {className: "card-head"}, element("h2", {textContent: "Curves"})),
              element("div", {className: "controls"}, element("label", {}, "Show ", what),
                      element("label", {}, "against ", against)), place, note);
  let chart = null;
  const show = () => {
    const group = groups[what.value], spec = {...group, x: group.xs[against.value || 0]};
    note.textContent = group.meaning || "";
    if (chart) chart.show(spec);
    else chart = report.chart(place, spec, {height: 400});
    chart.mark(run.sampleAt(report.timeline.share * report.endTime));
  };
  what.onchange = () => {
    against.replaceChildren(...groups[what.value].xs.map((x, i) => new Option(x.label, i)));
    show();
  };
  against.onchange = show;
  what.value = 0;
  what.onchange();
}

async function placePicture(report, host) {
  const {run, timeline} = report;
  if (!run.frames.length) return;
  const place = element("div", {}), solid = Boolean(run.head.solid);
  const view = solid ? await SolidView.load(place, run) : run.inSpace ? new SpaceView(place, run) : new FieldView(place, run);
  const field = element("select", {id: "field"});
  view.choices.forEach(([value, label]) => field.add(new Option(label, value)));
  field.value = solid ? "size" : run.field("effective_stress") >= 0 ? "effective_stress" : view.choices[0][0];
  field.onchange = () => view.show({shown: field.value});
  const controls = element("div", {className: "controls"}, element("label", {}, "Show ", field));
  const tick = (id, label, checked, name) => {
    const box = element("input", {type: "checkbox", id, checked});
    box.onchange = () => view.show({[name]: box.checked});
    controls.append(element("label", {}, box, " " + label));
  };
  if (!solid) tick("same-range", "same colour scale in all frames", true, "sameRange");
  if (run.frames.some(frame => frame.network && frame.network.lines)) tick("contacts", "contact forces", false, "contacts");
  const hasBonds = run.frames.some(frame => frame.fragments);
  const bonds = hasBonds && !run.inSpace;  // in three dimensions the particles in front are paled for them
  if (hasBonds) tick('bonds', 'bonds and cracks', bonds, 'bonds');
  if (run.inSpace) controls.append(...spaceControls(view));
  const head = element("div", {className: "card-head"}, element("h2", {textContent: solid ? "Lever" : "Particles"}),
    saveButtons("picture", {PNG: () => saveCanvas(fileName(`${field.value} frame ${view.frame + 1}`) + ".png", view.canvas)}));
  host.append(head, controls, place);
  timeline.listen(share => view.showShare(share));
  await view.show({shown: field.value, bonds});
}

function noteOfFrames({frames, head}) {
  if (!frames.length) return "The scene wrote no frames, so there is no picture of its particles: set output.frames to get them.";
  const parts = [];
  if (head.all_frames > frames.length) parts.push(`${frames.length} of the ${head.all_frames} frames are in this page`);
  if (head.mesh && head.mesh.fans) {
    parts.push(`to keep it small, every particle is drawn as ${head.mesh.fans} triangles with the mean values of its ` +
               `elements there; holes are not shown`);
  }
  if (head.mesh && head.mesh.pyramids) {
    parts.push("to keep it small, every particle is drawn as pyramids from its centre to the faces of its surface with the mean " +
               "values of its elements there");
  }
  return parts.length ? titled(parts.join("; ")) + ". run.h5 has everything." : "";
}

async function main() {
  const started = performance.now();
  const run = await Run.load(JSON.parse(document.getElementById("head").textContent));
  const timeline = new Timeline(document.getElementById("timeline"), run.frames.map(frame => frame.time), time => run.timeText(time));
  const report = new Report(run, timeline);
  document.getElementById("lead").textContent = leadOf(run);
  document.getElementById("frames-note").textContent = noteOfFrames(run);
  document.getElementById("timeline").hidden = run.frames.length < 2;
  placeSettings(document.getElementById("settings"), new Set([...run.head.series, ...(run.head.fields || [])].map(s => s.unit)));
  const tables = () => [fillFigures, fillSummary, fillQuality, fillFits, fillCost].forEach(fill => fill(run));
  tables();
  onUnits(tables);
  fillTransmission(run.summary);
  if (run.head.scene) {
    document.getElementById("scene-section").hidden = false;
    document.getElementById("scene").textContent = run.head.scene;
  }
  placeCurves(report, document.getElementById("curve-place"));
  await placePicture(report, document.getElementById("picture-place"));
  report.placePanels();
  arrangeCards(document.getElementById("curves"));
  document.body.dataset.readyIn = Math.round(performance.now() - started);
  document.body.dataset.ready = "1";
}

main().catch(fail);
