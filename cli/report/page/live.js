// A page that is served while the run is under way (cli/live): asks where it came from for news, and shows them in place.
// Status on <body>: data-phase, data-version of the data that are shown, data-samples, data-frames; data-lost.
"use strict";

const loadedSections = new Map();
sectionText = id => loadedSections.get(id);

// What a phase of the run means: a mark, and words. `left`: s, null if not known.
const PHASES = {
  before: () => ["wait", "The run is being set up: it has no results yet."],
  running: ({left, share}) => ["go", Number.isFinite(share) ? `Running: ${Math.floor(100 * share)} % done` +
    (left === null ? "." : `, about ${duration(Math.max(1, Math.round(left)))} left.`) : "Running."],
  silent: ({quiet}) => ["bad", `No news for ${duration(Math.round(quiet))}: the run may have ended. It writes from another machine, which cannot be asked.`],
  gone: () => ["bad", "The process of the run is gone, and it wrote no end: it was killed. What is shown is as far as it had come; " +
    "pulvis resume continues from the last checkpoint."],
  missing: () => ["bad", "The folder holds no run any more. What is shown is as far as was read."],
  ended: ({outcome}) => outcome === "done" ? ["good", "Finished. The page that stays is report.html in the folder of the run."]
    : outcome === "interrupted" ? ["wait", "Interrupted: pulvis resume continues it."] : outcome.startsWith("failed") ? ["bad", "The run failed: the reason is below."] : ["good", "The run stopped as its scene expects."],
};

// The line below the title that says how the run is doing.
class LiveStatus {
  constructor() {
    this.text = element("span", {});
    this.news = element("span", {className: "soft"});
    this.bar = element("progress", {max: 1, "aria-label": "Share of the run that is done"});
    this.latest = element("button", {type: "button", textContent: "Newest frame", title: "Show the newest frame, and follow the run", hidden: true});
    this.host = element("div", {id: "live", className: "live", role: "status"}, element("i", {"aria-hidden": "true"}), this.text, this.news, this.bar, this.latest);
    document.querySelector("h1").after(this.host);
    document.querySelector(".brand span").textContent = "live view";
    document.querySelector("footer p").textContent = "This page is served by pulvis on the machine of this browser, and asks it for news. " +
      "It stays as it is when that ends; the full results are in the folder of the run.";
    OUTCOMES.running = "";  // this line says it
  }

  show({phase, time, end, left, quiet, outcome}) {
    const share = end > 0 && Number.isFinite(end) ? Math.min(1, time / end) : NaN;
    const [mark, text] = PHASES[phase]({left, share, quiet, outcome});
    this.host.dataset.mark = mark;
    if (this.text.textContent !== text) this.text.textContent = text;
    this.news.textContent = phase === "running" && quiet >= 2 ? `Last written ${duration(Math.round(quiet))} ago.` : "";
    this.bar.hidden = phase !== "running" || !Number.isFinite(share);
    if (!this.bar.hidden) this.bar.value = share;
    document.body.dataset.phase = phase;
  }

  // The process that serves the page does not answer any more.
  lose(isOver) {
    document.body.dataset.lost = "1";
    this.bar.hidden = true;
    this.news.textContent = "";
    if (isOver) return;
    this.text.textContent = `The live view has ended: this page gets no news any more. Last known: ${this.text.textContent}`;
    this.host.dataset.mark = "bad";
  }
}

// The quality values that the samples tell while the run goes on; the run itself judges more of them at its end.
function qualitySoFar(run, limits = {}) {
  const energies = run.named(/^energy\/(?!balance)/).map(({values}) => largest(values)), whole = Math.max(0, ...energies);
  const of = name => run.has(`energy/${name}`) ? largest(run.values(`energy/${name}`)) : NaN, internal = Math.max(of("elastic"), of("plastic"));
  const judged = "at the end";
  if (!run.has("energy/balance") || !(whole > 0)) return [];
  return [
    {name: "Energy balance error", meaning: "so far, relative to the largest energy in the run", value: of("balance") / whole, limit: limits.energy_balance},
    {name: "Kinetic energy", meaning: "now, relative to the internal energy", value: run.end("energy/kinetic") / (run.end("energy/elastic") + run.end("energy/plastic")), judged},
    {name: "Hourglass energy", meaning: "largest so far, relative to the largest internal energy", value: of("hourglass") / internal, judged},
    {name: "Penetration", meaning: "deepest overlap of two surfaces so far, relative to the length of a boundary edge",
     value: run.has("penetration") ? run.end("penetration") : NaN, limit: limits.penetration},
  ];
}

class NoAnswer extends Error {}

async function ask(what, version) {
  let answer = null;
  try {
    answer = await (await fetch(`${what}?since=${version}`, {cache: "no-store"})).json();
  } catch (error) {
    throw new NoAnswer(error.message);
  }
  return answer;
}

class LivePage {
  constructor() { Object.assign(this, {version: 0, page: new ReportPage(), status: new LiveStatus()}); }

  async load() {
    const {version, head, sections} = await ask("report", this.version);
    for (const [name, text] of Object.entries(sections)) if (text !== null) loadedSections.set(name, text);
    for (const name of loadedSections.keys()) if (!(name in sections)) loadedSections.delete(name);
    this.version = version;
    if (!head) return;
    const run = await Run.load(head), {body} = document;
    if (this.state.phase !== "ended") run.summary.quality ??= qualitySoFar(run, this.state.limits);
    document.title = document.querySelector("h1").textContent = head.title;
    await this.page.show(run);
    this.follow();
    Object.assign(body.dataset, {version, samples: run.times.length, frames: run.frames.length, ready: "1"});
  }

  // The button that leads back to the newest frame is there while another one is shown.
  follow() {
    const {timeline} = this.page.report, {latest} = this.status, tell = () => { latest.hidden = timeline.follows; };
    tell();
    if (latest.onclick) return;
    latest.onclick = () => timeline.showFrame(Infinity);
    timeline.listeners.unshift(tell);  // before those that are dropped with the cards
    this.page.listeners[3] += 1;
  }

  // Waits for news; whether there will be more.
  async next() {
    const {version, last, state} = await ask("state", this.version), isNew = version !== this.version;
    this.status.show(state);
    this.state = state;
    if (isNew) await this.load();
    return !last || isNew;
  }
}

async function main() {
  const live = new LivePage(), most = 3;
  document.getElementById("timeline").hidden = true;
  for (let lost = 0; lost < most;) {
    try {
      if (!await live.next()) {
        if (!["ended", "gone", "missing"].includes(live.state.phase)) live.status.lose(false);
        return;
      }
      lost = 0;
    } catch (error) {
      if (!(error instanceof NoAnswer)) throw error;
      ++lost;
      if (lost === most) live.status.lose(live.state?.phase === "ended");
      else await new Promise(done => setTimeout(done, 500));
    }
  }
}

main().catch(fail);
