// Tables of a study: its runs, its variations, their last frames.
"use strict";

const fillTable = (id, columns, isBad) => fillColumns(document.getElementById(id), columns, isBad);

// Result columns of the table of runs, in order: [name], with a title where it is shorter than the words of the name
// (names.js). Columns without any value are omitted.
const COLUMNS = [["particles"], ["steps"], ["wall_seconds"], ["peak/relative_density", "peak relative density"],
                 ["peak/top_force"], ["peak/bottom_force"], ["peak/top_pressure"], ["peak/transmission"],
                 ["peak/stress_ratio/axial", "σ axial / σy at peak density"],
                 ["peak/stress_ratio/lateral", "σ lateral / σy at peak density"],
                 ["relative_density", "final relative density"], ["stress_ratio/axial", "final σ axial / σy"],
                 ["stress_ratio/lateral", "final σ lateral / σy"], ["top_force_end"], ["static_friction"],
                 ["dynamic_friction"], ["dilation"], ["elements"], ["increments"], ["k_n", "k_n"], ["k_l", "k_l"],
                 ["k_x", "k_x"], ["k_l/k_n", "k_l/k_n"], ["torsional_stiffness"], ["share_twist"],
                 ["share_bending"], ["share_tip"], ["invols_normal", "InvOLS normal"],
                 ["invols_lateral", "InvOLS lateral"], ["loop/load"], ["loop/half_width", "half-width W"],
                 ["loop/offset", "offset Δ"], ["loop/friction", "friction"], ["loop/sensitivity"],
                 ["curve/pull_off"], ["curve/work"], ["curve/work_of_adhesion"], ["bottom_force_end"],
                 ["top_force_max"], ["energy_balance_error"], ["kinetic_ratio"], ["expectations_met"]];
const titleOf = name => (COLUMNS.find(([known]) => known === name) || [])[1] || nameOf(name).words;
const valueOf = (run, name) => run.values.find(value => value.name === name);

const linkTo = run => element("a", {textContent: run.name, href: `${encodeURIComponent(run.name)}/report.html`});
const hasReport = run => run.values.some(value => value.name === "outcome" && value.value);

function qualityCell({quality}) {
  if (!quality) return "–";
  return quality.length ? element("span", {className: "beyond flag", textContent: `⚠ ${quality.join("; ")}`})
                        : element("span", {className: "within", textContent: "within limits"});
}

// The message of a failed run is long: it wraps.
function outcomeCell(run) {
  const text = run.failure || valueOf(run, "outcome")?.value || "–";
  return text.length > 24 ? element("span", {className: "flag", textContent: text}) : text;
}

function fillRuns({runs}) {
  const columns = COLUMNS.filter(([name]) => runs.some(run => {
    const found = valueOf(run, name);
    return found && found.value !== null && found.value !== "";
  }));
  const of = name => runs.map(run => valueOf(run, name)?.value ?? null);
  const unit = name => runs.map(run => valueOf(run, name)).find(Boolean).unit;
  fillTable("runs", [
    {title: "run", cells: runs.map(run => hasReport(run) ? linkTo(run) : run.name)},
    ...Object.keys(runs[0].varied).map(key => ({title: key, cells: runs.map(run => run.varied[key] || "–")})),
    {title: "seed", cells: runs.map(run => String(run.seed))},
    {title: "outcome", cells: runs.map(outcomeCell)},
    {title: "quality", cells: runs.map(qualityCell)},
    ...columns.map(([name]) => ({title: titleOf(name), unit: unit(name), cells: of(name)}))], i => Boolean(runs[i].failure));
}

// If any variation has several seeds: mean and standard deviation of each.
function fillVariations({variations = []}) {
  document.getElementById("variations-section").hidden = !variations.some(one => one.runs > 1);
  const names = COLUMNS.filter(([name]) => variations.some(one => one.values.some(value => value.name === name)));
  const of = (one, name) => one.values.find(value => value.name === name);
  const cell = value => value ? {mean: value.mean, deviation: value.standard_deviation} : null;
  fillTable("variations", [
    {title: "variation", cells: variations.map(one => one.variation)},
    {title: "runs", cells: variations.map(one => one.runs === one.of ? String(one.of) : `${one.runs} of ${one.of}`)},
    ...names.map(([name]) => ({title: titleOf(name), unit: variations.map(one => of(one, name)).find(Boolean).unit,
                               cells: variations.map(one => cell(of(one, name)))}))]);
}

// The last frame of every run, with a common colour scale.
function fillThumbnails({runs, thumbnails}) {
  const shown = runs.filter(run => run.thumbnail);
  document.getElementById("thumbnails-section").hidden = !shown.length;
  document.getElementById("thumbnails").replaceChildren(...shown.map(run => {
    const name = hasReport(run) ? linkTo(run) : element("span", {textContent: run.name});
    const flag = (run.quality || []).length ? [element("span", {className: "beyond", textContent: " ⚠", title: run.quality.join("; ")})] : [];
    return element("figure", {}, element("img", {src: run.thumbnail, alt: `Last frame of ${run.name}`, loading: "lazy"}),
                   element("figcaption", {}, name, ...flag));
  }));
  document.getElementById("thumbnails-note").textContent = (thumbnails || []).map(({field, unit, low, high}) =>
    `Colours: ${words(field)} from ${withUnit(low, unit, 3)} (dark) to ${withUnit(high, unit, 3)} (light), the same in all runs.`).join(" ");
}
