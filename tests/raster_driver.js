// Put at the end of a copy of a raster's report: chooses every channel and levelling in turn, and keeps the ranges that
// were drawn, as JSON, for raster_page.py.
"use strict";

(async () => {
  for (let i = 0; i < 400 && !document.body.dataset.ready; ++i) await new Promise(done => setTimeout(done, 20));
  const channel = document.querySelector("select.channel"), level = document.querySelector("select.level");
  const canvas = channel.closest(".card").querySelector("canvas.figure"), ranges = {};
  for (const {value: name} of channel.options) {
    for (const {value: way} of level.options) {
      channel.value = name;
      level.value = way;
      level.onchange();
      ranges[`${name} ${way}`] = canvas.dataset.scale.split(" ").map(Number);
    }
  }
  document.body.append(element("pre", {id: "ranges", textContent: JSON.stringify(ranges)}));
  document.body.dataset.levelled = "1";
})().catch(error => { document.body.dataset.driverError = error; });
