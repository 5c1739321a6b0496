// Puts the page together. <body> tells how it went: data-ready, data-drawn-quads, or data-error.
"use strict";

function connectControls(picture, head) {
  const field = document.getElementById("field"), frame = document.getElementById("frame");
  head.fields.forEach((one, i) => field.add(new Option(words(one.name), i)));
  field.value = picture.field;
  field.onchange = () => picture.show({field: Number(field.value)});
  frame.max = head.frames.length - 1;
  frame.value = picture.frame;
  frame.oninput = () => picture.show({frame: Number(frame.value)});
  const range = document.getElementById("same-range");
  range.onchange = () => picture.show({sameRange: range.checked});
  connectPlay(document.getElementById("play"), frame, head.frames.length);
}

function connectPlay(button, frame, count) {
  let timer = 0;
  const stop = () => { clearInterval(timer); timer = 0; button.textContent = "Play"; };
  const step = () => {
    frame.value = Number(frame.value) + 1;
    frame.oninput();
    if (Number(frame.value) === count - 1) stop();
  };
  button.onclick = () => {
    if (timer) { stop(); return; }
    if (Number(frame.value) === count - 1) frame.value = -1;
    button.textContent = "Stop";
    timer = setInterval(step, 120);
  };
}

async function showPicture(head, history) {
  if (!head.frames.length) return;
  document.getElementById("picture-section").hidden = false;
  const picture = new Picture(head, await integers("quads", 4), history);
  picture.field = Math.max(0, head.fields.findIndex(field => field.name === "effective_stress"));
  connectControls(picture, head);
  await picture.show({});
}

async function main() {
  const head = JSON.parse(document.getElementById("head").textContent);
  const history = await readHistory(head);
  document.getElementById("lead").textContent = leadOf(head, history);
  fillSummary(head, history);
  fillQuality(head, history);
  fillFits(head.summary);
  fillTransmission(head.summary);
  drawCharts(history);
  drawShear(history, head.summary);
  await showObserved(head);
  drawFits(head.summary);
  await showPicture(head, history);
  document.body.dataset.ready = "1";
}

main().catch(fail);
