// Put at the end of a copy of a page that is opened on a narrow screen: nothing is wider than the page, and images of a raster
// are not squeezed.
"use strict";

(async () => {
  for (let i = 0; i < 400 && !document.body.dataset.ready; ++i) await new Promise(done => setTimeout(done, 20));
  const problems = [], page = document.documentElement;
  if (page.scrollWidth > page.clientWidth) problems.push(`the page is ${page.scrollWidth} wide`);
  for (const {dataset} of document.querySelectorAll("canvas[data-wide]")) if (Number(dataset.wide) < 150) problems.push(`a map is ${dataset.wide} wide`);
  document.body.dataset.within = problems.length ? problems.join("; ") : "1";
})().catch(error => { document.body.dataset.within = error; });
