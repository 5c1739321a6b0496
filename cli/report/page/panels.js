// Report parts per experiment family. Each file panel_*.js registers its parts here when it is
// loaded; no other file needs to know them.
"use strict";

const PANELS = [], CURVES = [], FIGURES = [];

// {title, order, when(run), draw(report, host)}: a separate card. Cards are sorted by ascending order.
const addPanel = panel => { PANELS.push({order: 50, ...panel}); };
const panelsInOrder = () => PANELS.slice().sort((a, b) => a.order - b.order);
// run => [{title, xs: [x, ...], y, lines}]: choices for the large chart; x and lines as in a Chart. Those marked
// `first` show the main results of the run; those marked `isStill` have points that are not samples of the run.
const addCurves = make => { CURVES.push(make); };
// run => [[label, value, note], ...]: key figures at the top of the page; null values are omitted.
const addFigures = make => { FIGURES.push(make); };

const figuresOf = run => FIGURES.flatMap(make => make(run)).filter(figure => figure && figure[1]);
const curvesOf = run => CURVES.flatMap(make => make(run)).filter(group => group && group.lines.length)
  .sort((a, b) => Boolean(b.first) - Boolean(a.first));

const timeAxis = run => ({label: run.timeName, unit: run.timeUnit, values: run.times, names: run.isCalibration ? LOAD_CASE_NAMES : undefined});

// The context of a panel: the run, the common time of the page, and the runs shown beside it.
class Report {
  constructor(run, timeline, beside = [run]) {
    Object.assign(this, {timeline, beside});
    this.setRun(run);
  }

  setRun(run) {
    this.run = run;
    this.endTime = run.frames.length ? run.frames.at(-1).time : run.times.at(-1) || 1;
  }

  // The same run with more frames.
  take(run) {
    this.setRun(run);
    this.beside = [run];
    this.timeline.renew(run.frames.map(frame => frame.time));
  }

  // A chart over the samples of the run: pointing at it selects the frame, and the frame is marked in it.
  chart(host, spec, options) {
    const onCursor = sample => { if (!chart.spec.isStill) this.timeline.seek(this.run.times[sample] / this.endTime); };
    const chart = drawChart(host, spec, {...options, onCursor});
    const mark = share => chart.mark(chart.spec.isStill ? null : this.run.sampleAt(share * this.endTime));
    this.timeline.listen(mark);
    mark(this.timeline.share);
    return chart;
  }

  // A canvas redrawn for every frame: draw(ctx, width, height, frame, frames), if the frame has the data.
  // `frames` are those of all runs side by side, for a common scale; draw may return that scale, for tests.
  // Returns a function that repaints after changes other than time.
  // `shape`: height over width; columns(frame): the data for a CSV file.
  figure(host, {title, shape, draw, columns, note}) {
    const canvas = element("canvas", {className: "figure", role: "img"});
    const told = element("p", {className: "note"});
    host.append(canvas, told);
    const heading = host.parentElement.querySelector("h2").textContent;  // with the run name, if shown beside others
    let drawn = 0;
    const paint = () => {
      const ratio = devicePixelRatio || 1, width = drawn = host.clientWidth, frame = this.frame();
      const height = Math.min(Math.max(shape * width, 160), 400);
      canvas.style.height = height + "px";
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
      const ctx = canvas.getContext("2d");
      ctx.scale(ratio, ratio);
      ctx.font = "12px system-ui, sans-serif";
      const ends = frame && draw(ctx, width, height, frame, this.framesBeside());
      canvas.dataset.scale = ends || "";
      told.textContent = frame ? note(frame) : "";
      canvas.setAttribute("aria-label", `${heading}. ${told.textContent}`);
    };
    const name = fileName(heading);
    host.parentElement.querySelector(".card-head").append(saveButtons(title, {
      PNG: () => saveCanvas(name + ".png", canvas),
      CSV: () => saveText(name + ".csv", csvOf(columns(this.frame())), "text/csv")}));
    this.timeline.listen(paint);
    [onUnits, onTheme, onMap].forEach(on => on(paint));
    onResize(host, () => { if (host.clientWidth !== drawn) paint(); });
    return paint;
  }

  frame() { return this.run.frames[this.run.frameAt(this.timeline.share * this.endTime)]; }
  framesBeside() { return this.beside.map(run => new Report(run, this.timeline).frame()).filter(Boolean); }

  placePanels() {
    for (const panel of panelsInOrder()) {
      if (panel.when(this.run)) panel.draw(this, card(panel.title));
    }
  }
}

// Bit mask of the cards in the second of two columns, so that both are about equally long; card 0 stays in the first.
function evenSplit(heights) {
  const count = Math.min(heights.length, 14), sum = list => list.reduce((total, height) => total + height, 0), whole = sum(heights);
  let best = 0, least = Infinity;
  for (let bits = 0; bits < 1 << count; bits += 2) {
    const uneven = Math.abs(whole - 2 * sum(heights.filter((_, i) => bits >> i & 1)));
    if (uneven < least) { least = uneven; best = bits; }
  }
  return best;
}

// Cards in two columns without gaps: the last card of the shorter column is stretched. Wide cards span both.
function arrangeCards(host) {
  const cards = [...host.children].filter(one => one.classList.contains("card") && !one.hidden);
  const isWide = one => one.classList.contains("wide");
  for (let i = 0; i < cards.length;) {
    let end = i;
    while (end < cards.length && !isWide(cards[end])) ++end;
    const group = cards.slice(i, end);
    if (group.length > 1) {
      const columns = [0, 1].map(() => element("div", {className: "column"})), second = evenSplit(group.map(one => one.offsetHeight));
      host.insertBefore(element("div", {className: "columns"}, ...columns), group[0]);
      group.forEach((one, k) => columns[second >> k & 1].append(one));
    } else if (group.length) {
      group[0].classList.add("wide");
    }
    i = end + 1;
  }
}
