// Shows the run in the page. Status on <body>: data-ready, or data-error.
"use strict";

async function main() {
  const started = performance.now();
  await new ReportPage().show(await Run.load(JSON.parse(document.getElementById("head").textContent)));
  document.body.dataset.readyIn = Math.round(performance.now() - started);
  document.body.dataset.ready = "1";
}

main().catch(fail);
