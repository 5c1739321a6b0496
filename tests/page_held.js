// Put at the end of a copy of a page by tests/browser.sh: keeps its load event back, by a document of no content that
// stays open, until <body> has the attribute data-WANTED or one that tells of an error.
"use strict";

const frameHeld = document.createElement("iframe");
frameHeld.hidden = true;
document.body.append(frameHeld);
frameHeld.contentDocument.open();
frameHeld.contentDocument.write("<p>");
const release = () => {
  const {dataset} = document.body;
  if (!(WANTED in dataset || "error" in dataset || "driverError" in dataset)) return;
  watch.disconnect();
  frameHeld.contentDocument.close();
};
const watch = new MutationObserver(release);
watch.observe(document.body, {attributes: true});
release();
