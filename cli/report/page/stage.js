// What a report shows of a run: curves and picture with their common time, tables and cards. All of it can be shown again
// for the same run with more frames and samples (live.js); then what the reader has chosen stays.
"use strict";

// Replaces the choices of a list, unless they are the same, and keeps the chosen one if it is still there.
function offer(select, entries) {
  const key = JSON.stringify(entries), chosen = select.value;
  if (select.dataset.offers === key) return;
  select.dataset.offers = key;
  select.replaceChildren(...entries.map(([value, label]) => new Option(label, value)));
  select.value = entries.some(([value]) => value === chosen) ? chosen : entries[0][0];
}

// The large chart: choice of curves and x axis.
class CurvePane {
  constructor(report, host) { Object.assign(this, {report, host}); }

  groups() {
    const {run} = this.report;
    const single = run.head.series.filter(({name}) => name !== "time").map(({name, meaning}) =>
      ({title: titled(toldName(name)), meaning: `${meaning} (${name})`, xs: [timeAxis(run)], y: toldName(name),
        lines: [run.series(name, toldName(name))]}));
    return {families: curvesOf(run), single};
  }

  show() {
    const {families, single} = this.groups();
    this.all = [...families, ...single];
    if (this.report.run.times.length < 2 || !this.all.length) return;
    if (!this.what) this.place();
    this.offerGroups(families.length);
    this.draw(true);
  }

  place() {
    const what = element("select", {id: "curve"}), against = element("select", {id: "against"});
    Object.assign(this, {what, against, plot: element("div", {}), note: element("p", {className: "note"})});
    this.host.append(element("div", {className: "card-head"}, element("h2", {textContent: "Curves"})),
                     element("div", {className: "controls"}, element("label", {}, "Show ", what),
                             element("label", {}, "against ", against)), this.plot, this.note);
    what.onchange = () => this.draw();
    against.onchange = () => this.draw();
  }

  // Values are positions in the list: two groups may have the same title.
  offerGroups(families) {
    const titles = this.all.map(({title}) => title), key = JSON.stringify([families, titles]), {what} = this;
    if (what.dataset.offers === key) return;
    const chosen = what.selectedOptions[0]?.text, lists = [["Curves", 0, families], ["Any recorded series", families, titles.length]];
    what.dataset.offers = key;
    what.replaceChildren(...lists.filter(([, from, to]) => to > from).map(([label, from, to]) =>
      element("optgroup", {label}, ...titles.slice(from, to).map((title, i) => new Option(title, from + i)))));
    what.value = Math.max(0, titles.indexOf(chosen));
  }

  draw(isSame = false) {
    const {report} = this, group = this.all[this.what.value];
    offer(this.against, group.xs.map((x, i) => [String(i), x.label]));
    const spec = {...group, x: group.xs[this.against.value || 0]};
    this.note.textContent = group.meaning || "";
    if (!this.chart) this.chart = report.chart(this.plot, spec, {height: 400});
    else if (isSame) this.chart.renew(spec);
    else this.chart.show(spec);
    this.chart.mark(spec.isStill ? null : report.run.sampleAt(report.timeline.share * report.endTime));
  }
}

// The picture of particles or lever.
class PicturePane {
  constructor(report, host) {
    Object.assign(this, {report, host});
    report.timeline.listen(share => this.view?.showShare(share));
  }

  // What the pane consists of: another one is placed if this changes.
  kind() {
    const {run} = this.report, {mesh} = run.head;
    return JSON.stringify([mesh?.drawn_cells, mesh?.drawn_nodes, run.frames.some(frame => frame.network && frame.network.lines),
                           run.frames.some(frame => frame.fragments), (run.head.tags || []).map(({name}) => name)]);
  }

  async show() {
    const {run, timeline} = this.report, kind = this.kind();
    if (!run.frames.length) return;
    if (kind !== this.is) {
      this.is = kind;
      await this.place();
      return;
    }
    this.view.share = timeline.share;
    await this.view.renew(run);
    offer(this.field, this.view.choices);
    if (this.view.shown !== this.field.value) await this.view.show({shown: this.field.value});
  }

  async place() {
    const {run, timeline} = this.report, solid = Boolean(run.head.solid), place = element("div", {}), before = this.view;
    before?.gl?.gl.getExtension("WEBGL_lose_context")?.loseContext();
    const view = this.view = solid ? await SolidView.load(place, run) : run.inSpace ? new SpaceView(place, run) : new FieldView(place, run);
    const field = this.field = element("select", {id: "field"}), {choices} = view;
    offer(field, choices);
    const first = solid ? "size" : run.field("effective_stress") >= 0 ? "effective_stress" : choices[0][0];
    field.value = choices.some(([value]) => value === before?.shown) ? before.shown : first;
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
    this.host.replaceChildren(head, controls, place);
    view.share = timeline.share;
    await view.show({shown: field.value, bonds, frame: run.frameAt(timeline.share * run.frames.at(-1).time)});
  }
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

// What the reader has chosen in the cards, by their titles.
function choicesIn(host) {
  const controls = one => [...one.querySelectorAll("select, input")], charts = one => [...one.querySelectorAll(".chart")];
  const cards = () => [...host.querySelectorAll(".card")].map(one => [one.querySelector("h2")?.textContent, one]);
  const chosen = new Map(cards().map(([title, one]) =>
    [title, {values: controls(one).map(({value, checked}) => ({value, checked})), charts: charts(one).map(({chart}) => chart)}]));
  return () => cards().forEach(([title, one]) => {
    const before = chosen.get(title), now = controls(one);
    if (!before) return;
    if (now.length === before.values.length) now.forEach((control, i) => {
      if (control.value === before.values[i].value && control.checked === before.values[i].checked) return;
      Object.assign(control, before.values[i]);
      for (const event of ["input", "change"]) control.dispatchEvent(new Event(event));
    });
    charts(one).forEach(({chart}, i) => before.charts[i] && chart.renew(chart.spec, before.charts[i]));
  });
}

// The whole page but its status.
class ReportPage {
  // The run, or the same one with more frames and samples.
  async show(run) {
    this.run = run;
    if (!this.report) this.begin();
    const choose = this.dropCards();
    this.fill();
    this.curves.show();
    await this.picture.show();
    this.listeners = this.lists.map(list => list.length);
    this.report.placePanels();
    arrangeCards(this.cards);
    choose();
    this.cards.style.minHeight = "";
  }

  begin() {
    const {run} = this, byId = id => document.getElementById(id);
    const timeline = new Timeline(byId("timeline"), run.frames.map(frame => frame.time), time => this.run.timeText(time));
    this.report = new Report(run, timeline);
    this.lists = [unitListeners, themeListeners, mapListeners, timeline.listeners];
    this.cards = byId("curves");
    this.fixed = [...this.cards.children];
    placeSettings(byId("settings"), new Set([...run.head.series, ...(run.head.fields || [])].map(s => s.unit)));
    onUnits(() => this.fillTables());
    this.curves = new CurvePane(this.report, byId("curve-place"));
    this.picture = new PicturePane(this.report, byId("picture-place"));
  }

  // Removes the cards of the panels, and whatever listens for them; returns how to choose again in new ones what was chosen.
  dropCards() {
    if (!this.listeners) return () => {};
    const choose = choicesIn(this.cards);
    this.lists.forEach((list, i) => { list.length = this.listeners[i]; });
    this.cards.style.minHeight = this.cards.offsetHeight + "px";  // the page must not scroll
    this.fixed.forEach(one => one.classList.remove("wide"));
    this.cards.replaceChildren(...this.fixed);
    this.report.take(this.run);
    return choose;
  }

  fillTables() { for (const fill of [fillFigures, fillSummary, fillQuality, fillFits, fillCost]) fill(this.run); }

  fill() {
    const {run} = this, told = (id, text) => { document.getElementById(id).textContent = text; };
    told("lead", leadOf(run));
    told("frames-note", noteOfFrames(run));
    document.getElementById("timeline").hidden = run.frames.length < 2;
    this.fillTables();
    fillTransmission(run.summary);
    if (!run.head.scene) return;
    document.getElementById("scene-section").hidden = false;
    told("scene", run.head.scene);
  }
}
