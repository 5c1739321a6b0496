// A run as embedded in the page: its head, its series, and frames that are decoded on demand.
"use strict";

const NO_NUMBER = 65535, MOST_KEPT_BYTES = 3e8;

// Frames and samples of a calibration, in the order written by cli/session/afm_session.cpp.
const LOAD_CASES = ["at rest", "under a force normal to the sample", "under a lateral force", "under a force along the lever"];
const LOAD_CASE_NAMES = ["at rest", "normal", "lateral", "axial"];
const loadCase = number => LOAD_CASES[Math.round(number)] || `load case ${digits(number)}`;

class Run {
  static async load(head, prefix = "") {
    const run = new Run();
    keepLabels(head.labels);
    Object.assign(run, {head, prefix, summary: head.summary, kept: new Map(), keptBytes: 0});
    const all = await floats(prefix + "history"), count = head.samples;
    run.history = new Map(head.series.map((series, k) =>
      [series.name, {...series, label: series.name, values: all.subarray(k * count, (k + 1) * count)}]));
    run.times = run.values("time");
    run.hideLightLoads();
    run.frames = head.frames || [];
    run.images = await Promise.all((head.images || []).map(async (image, i) =>
      ({...image, values: await floats(`${prefix}image-${i}`)})));
    if (head.mesh && run.frames.length) {
      run.cells = await integers(prefix + "cells", run.inSpace ? 8 : 4);
      run.particleOf = await integers(prefix + "cell-particle", 1);
      run.tags = await Promise.all((head.tags || []).map(async tag =>
        ({...tag, values: await integers(`${prefix}particle-${tag.name}`, 1)})));
    }
    if (run.inSpace && run.frames.length) await run.loadSpace();
    return run;
  }

  // The ratio of the forces on two punches says nothing while they hardly touch the powder.
  hideLightLoads() {
    const LEAST_LOAD = 0.05;  // of the largest
    const ratio = this.history.get("stress/transmission"), load = this.values("stress/axial_top"), least = LEAST_LOAD * largest(load);
    if (!ratio || !load.length) return;
    ratio.values = ratio.values.map((value, i) => load[i] > least ? value : NaN);
    this.head.series.find(({name}) => name === ratio.name).meaning += `; only above ${percent(LEAST_LOAD)} of the largest load on the top`;
  }

  // Particles in 3D: the outer faces of cells, and the quads of the tool surfaces.
  get inSpace() { return this.head.mesh?.dimension === 3; }
  async loadSpace() {
    this.surface = await integers(this.prefix + "surface", 1);
    if (!this.head.tools) return;
    this.toolQuads = await integers(this.prefix + "tool-quads", 4);
    this.toolOfQuad = await integers(this.prefix + "tool-of-quad", 1);
  }
  // Later frames are stored as differences from the first.
  async spacePositions(key, frame) {
    const codes = await shorts(key, 3), first = frame ? await this.positions(0) : null;
    for (let i = 0; first && i < codes.length; ++i) codes[i] += first[i];
    return codes;
  }

  // "done", "interrupted", "failed: ..."; "running" until one of these is written: still so, or killed.
  get outcome() { return this.summary.outcome || "running"; }
  get hasEnded() { return this.outcome !== "running" && this.outcome !== "interrupted"; }
  get family() {
    if (this.summary.family) return this.summary.family;
    if (this.head.solid) return "afm";  // without a summary: it has not ended
    return this.history.has("shear/friction") ? "shear" : "compaction";
  }
  // The programme of a lever is quasi-static: its "time" is the number of completed actions. A
  // calibration has none: it pulls the tip along one axis after another.
  get isCalibration() { return this.family === "afm" && !this.has("scanner/z"); }
  get timeName() { return this.isCalibration ? "load case" : this.family === "afm" ? "actions completed" : "time"; }
  // A time in words.
  timeText(time) {
    return this.isCalibration ? titled(loadCase(time)) : (this.timeUnit === "s" ? "" : this.timeName + " ") + withUnit(time, this.timeUnit, 3);
  }
  get timeUnit() { return this.family === "afm" ? "-" : "s"; }
  has(name) { return this.history.has(name); }
  values(name) { return this.has(name) ? this.history.get(name).values : new Float32Array(); }
  unit(name) { return this.has(name) ? this.history.get(name).unit : "-"; }
  series(name, label) { return {...this.history.get(name), label: label || name}; }
  named(pattern) {
    return [...this.history.values()].filter(series => pattern.test(series.name));
  }
  end(name) { return this.values(name).at(-1); }
  frameTime(frame) { return this.frames[frame].time; }

  // The sample at or just after a time; the frame nearest to it.
  sampleAt(time) {
    let low = 0, high = this.times.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      this.times[middle] < time * (1 - 1e-6) ? low = middle + 1 : high = middle;
    }
    return low;
  }
  frameAt(time) {
    let best = 0;
    this.frames.forEach((frame, i) => {
      if (Math.abs(frame.time - time) < Math.abs(this.frames[best].time - time)) best = i;
    });
    return best;
  }

  // Decoded frames are cached; the least recently used are dropped when the cache is full.
  async kept_(name, read) {
    const key = this.prefix + name, there = this.kept.get(key);
    this.kept.delete(key);
    const data = there || await read(key);
    this.kept.set(key, data);
    if (!there) this.keptBytes += data.byteLength;
    for (const [old, bytes] of this.kept) {
      if (this.keptBytes <= MOST_KEPT_BYTES || old === key) break;
      this.kept.delete(old);
      this.keptBytes -= bytes.byteLength;
    }
    return data;
  }
  positions(frame) { return this.kept_(`frame-${frame}-position`, key => this.inSpace ? this.spacePositions(key, frame) : shorts(key, 2)); }
  codes(frame, field) { return this.kept_(`frame-${frame}-${field}`, key => shorts(key, 1)); }
  displacements(frame) { return this.kept_(`frame-${frame}-displacement`, floats); }
  async toolCorners(frame) { return this.head.tools ? this.kept_(`frame-${frame}-tools`, floats) : null; }
  async contactLines(frame) {
    const network = this.frames[frame].network;
    return network && network.lines ? this.kept_(`frame-${frame}-network`, floats) : new Float32Array();
  }

  // Lines in two dimensions; in three, dots (cli/report/report_fragments.cpp).
  async bondLines(frame) {
    const {bonds, cracks} = this.frames[frame],
                  lines = (count, name) =>
                      count ? this.kept_(`frame-${frame}-${name}`, floats) : new Float32Array();
    return {bonds: await lines(bonds, 'bonds'), cracks: await lines(cracks, 'cracks')};
  }

  field(name) { return (this.head.fields || []).findIndex(field => field.name === name); }
  get densities() { return this.frames.flatMap(frame => frame.density ? frame.density.cells : []); }
}
