// A common time for the whole page: frames, curves and observations follow it, and each of them can change it.
// Times are fractions of the run, so that runs of different length can be shown together.
"use strict";

const nearestIndex = (values, wanted) =>
  values.reduce((best, value, i) => Math.abs(value - wanted) < Math.abs(values[best] - wanted) ? i : best, 0);

class Timeline {
  // times: frame times of the reference run, s
  // textOf(time): the time as text
  constructor(host, times, textOf = time => withUnit(time, "s", 3)) {
    Object.assign(this, {times, textOf, end: times.at(-1) || 1, frame: times.length - 1, listeners: [], timer: 0});
    this.share = 1;
    this.button = element("button", {type: "button", className: "play", id: "play", onclick: () => this.toggle()});
    this.slider = element("input", {type: "range", id: "frame", min: 0, max: Math.max(0, times.length - 1),
                                    step: 1, value: this.frame, "aria-label": "Frame"});
    this.slider.oninput = () => this.showFrame(Number(this.slider.value));
    this.told = element("output", {className: "told", htmlFor: "frame", "aria-live": "off"});
    host.replaceChildren(this.button, this.slider, this.told);
    this.setPlaying(false);
    this.tell();
    onUnits(() => this.tell());
    onKey(window, event => this.key(event));
  }

  // The same run with more frames: stays at the last one, or at the frame that was shown. The listeners are not called.
  renew(times) {
    const shown = this.times[this.frame], follows = this.frame >= this.times.length - 1;
    Object.assign(this, {times, end: times.at(-1) || 1});
    this.frame = follows ? times.length - 1 : nearestIndex(times, shown);
    this.share = follows ? 1 : times[this.frame] / this.end;
    this.slider.max = Math.max(0, times.length - 1);
    this.slider.value = this.frame;
    this.tell();
  }
  get follows() { return this.frame >= this.times.length - 1; }

  listen(listener) { this.listeners.push(listener); }

  showFrame(frame) {
    if (!this.times.length) return;
    this.frame = Math.min(Math.max(frame, 0), this.times.length - 1);
    this.showShare(this.times[this.frame] / this.end);
  }

  // Called by a chart: the fraction may lie between two frames.
  seek(share) {
    if (this.timer) return;
    if (!this.times.length) return;
    this.frame = nearestIndex(this.times, share * this.end);
    this.showShare(share);
  }

  showShare(share) {
    this.share = share;
    this.slider.value = this.frame;
    this.tell();
    for (const listener of this.listeners) listener(share);
  }

  tell() {
    if (!this.times.length) return;
    const text = `${this.textOf(this.times[this.frame])} · frame ${this.frame + 1} of ${this.times.length}`;
    this.told.textContent = text;
    this.slider.setAttribute("aria-valuetext", text);
  }

  setPlaying(plays) {
    this.button.textContent = plays ? "❚❚" : "▶";
    this.button.setAttribute("aria-label", plays ? "Pause" : "Play");
    this.button.title = (plays ? "Pause" : "Play") + " (space)";
  }

  toggle() {
    if (this.timer) {
      clearInterval(this.timer);
      this.timer = 0;
    } else if (this.times.length > 1) {
      if (this.frame === this.times.length - 1) this.showFrame(0);
      this.timer = setInterval(() => {
        this.showFrame(this.frame + 1);
        if (this.frame === this.times.length - 1) this.toggle();
      }, Math.min(200, Math.max(60, 6000 / this.times.length)));
    }
    this.setPlaying(Boolean(this.timer));
  }

  // Space plays, arrow keys step, where the time is shown: elsewhere they scroll the page. Other controls need their keys.
  key({key, target}) {
    const isControl = target !== this.slider && target.matches("select, input, textarea");
    if (isControl || !target.closest("#stage, .plot")) return false;
    const steps = {ArrowLeft: -1, ArrowRight: 1, PageDown: -10, PageUp: 10}[key];
    if (key === " " && !target.matches("button")) this.toggle();
    else if (steps) this.showFrame(this.frame + steps);
    else if (key === "Home") this.showFrame(0);
    else if (key === "End") this.showFrame(this.times.length - 1);
    else return false;
    return true;
  }
}
