// Put at the end of a copy of a lever's report: chooses its force curve or friction loop, reads the legend, and chooses nN and
// µN.
"use strict";

(async () => {
  for (let i = 0; i < 400 && !document.body.dataset.ready; ++i) await new Promise(done => setTimeout(done, 20));
  const problems = [], page = document.documentElement, curve = document.getElementById("curve");
  const choose = (select, value) => { select.value = value; select.onchange(); };
  const legend = () => [...document.querySelectorAll("#curve-place .legend button")].map(button => button.textContent).join(", ");
  const paths = () => [...document.querySelectorAll("#curve-place path.curve")];
  const {summary} = JSON.parse(document.getElementById("head").textContent);
  const shown = [["Force curve", "approach, retract", "Force curves", "pull-off force", summary.force_curves],
                 ["Friction loop", "trace, retrace", "Friction loops", "half-width W", summary.loops]].filter(one => one[4]);
  for (const [title, wanted] of shown) {
    const option = [...curve.options].find(one => one.textContent === title);
    if (!option) { problems.push(`no ${title}`); continue; }
    choose(curve, option.value);
    if (legend() !== wanted) problems.push(`${title}: ${legend()}`);
    if (paths().length !== 2 || paths().some(path => path.getAttribute("d").split("L").length < 3)) problems.push(`${title}: a line is missing`);
    if (paths().filter(path => path.getAttribute("stroke-dasharray")).length !== 1) problems.push(`${title}: they look alike`);
  }
  document.getElementById("shade").click();
  if (paths().some((path, i) => path.getAttribute("stroke") !== DARK.lines[i])) problems.push("not the colours of the dark page");
  const heads = title => [...[...document.querySelectorAll(".card")].find(card => card.querySelector("h2").textContent === title)
    .querySelectorAll("thead th")].map(head => head.textContent);
  const newtons = [...document.querySelectorAll(".menu label")].find(label => label.textContent.startsWith("N ")).querySelector("select");
  for (const [prefix, unit] of [["n", "nN"], ["µ", "µN"]]) {
    choose(newtons, prefix);
    for (const [, , table, column] of shown) {
      if (!heads(table).includes(`${column} [${unit}]`)) problems.push(`${table}: ${heads(table)}`);
    }
    if (!document.querySelector("#curve-place .plot").textContent.includes(`[${unit}]`)) problems.push(`the axis is not in ${unit}`);
  }
  if (page.scrollWidth > page.clientWidth) problems.push(`the page is ${page.scrollWidth} wide`);
  document.body.dataset.probed = problems.length ? problems.join("; ") : shown.map(([title]) => title).join(", ");
})().catch(error => { document.body.dataset.probed = error; });
