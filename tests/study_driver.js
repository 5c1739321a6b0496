// Put at the end of a copy of a study's report: whether wide tables scroll inside their cards, the first column staying
// where it is, and whether every picture of a last frame has been read.
"use strict";

(async () => {
  for (let i = 0; i < 400 && !document.body.dataset.ready; ++i) await new Promise(done => setTimeout(done, 20));
  const problems = [], page = document.documentElement;
  if (page.scrollWidth > page.clientWidth) problems.push(`the page is ${page.scrollWidth} wide`);
  for (const id of ["runs", "variations"]) {
    const table = document.getElementById(id), place = table.parentElement, first = table.querySelector("tbody tr > :first-child");
    const before = first.getBoundingClientRect().left;
    place.scrollLeft = 200;
    if (place.scrollWidth <= place.clientWidth) problems.push(`${id} is not wide`);
    if (place.tabIndex !== 0 || place.getAttribute("role") !== "region" || !place.getAttribute("aria-label")) problems.push(`${id} is not offered to keys`);
    if (place.scrollLeft !== 200) problems.push(`${id} does not scroll`);
    if (Math.abs(first.getBoundingClientRect().left - before) > 1) problems.push(`${id}: the first column moves`);
  }
  for (const image of document.querySelectorAll("#thumbnails img")) {
    image.loading = "eager";
    await image.decode().catch(() => problems.push("a picture cannot be read"));
    if (Math.max(image.naturalWidth, image.naturalHeight) !== 240) problems.push(`a picture of ${image.naturalWidth} pixels`);
  }
  const head = JSON.parse(document.getElementById("head").textContent), rows = id => document.querySelectorAll(`#${id} tbody tr`).length;
  const all = ["laws", "below"].map(rows);
  head.runs[0].complete = false;
  fillLaws(head);
  fillBelow(head);
  for (const [i, id] of ["laws", "below"].entries()) {
    if (!all[i] || rows(id) !== all[i] * 3 / 4) problems.push(`${id}: ${rows(id)} of ${all[i]} rows without one of four runs`);
    if (document.getElementById(`${id}-left-out`).textContent !== "1 run that did not reach its end is left out.") problems.push(`${id}: no note`);
  }
  document.body.dataset.fits = problems.length ? problems.join("; ") : "1";
})().catch(error => { document.body.dataset.fits = error; });
