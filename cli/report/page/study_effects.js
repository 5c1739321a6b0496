// Main effects: the mean of a value at each level of every varied key, with its standard deviation.
"use strict";

const sampleAt = (level, name) => level.values.find(value => value.name === name);

// Values that differ between levels; those shown in the table come first, in its order.
function effectValues(effects) {
  const units = new Map();
  for (const {levels} of effects) {
    for (const {values} of levels) for (const {name, unit} of values) units.set(name, unit);
  }
  const differs = name => effects.some(({levels}) => {
    const means = levels.map(level => sampleAt(level, name)?.mean).filter(Number.isFinite);
    return means.length > 1 && means.some(mean => Math.abs(mean - means[0]) > 1e-9 * Math.abs(means[0]));
  });
  const order = name => { const at = COLUMNS.findIndex(([known]) => known === name); return at < 0 ? COLUMNS.length : at; };
  return [...units].filter(([name]) => differs(name)).sort(([a], [b]) => order(a) - order(b))
    .map(([name, unit]) => ({name, unit}));
}

// -, of the means at the levels, over the largest of them.
function variationOf(effects, name) {
  return Math.max(...effects.map(({levels}) => {
    const means = levels.map(level => sampleAt(level, name)?.mean).filter(Number.isFinite), [low, high] = bounds([means]);
    return means.length > 1 ? (high - low) / (largest(means) || 1) : 0;
  }));
}

// The page opens on the first result of the table that varies: runs that end at a density all have the same one.
const COSTS = ["particles", "steps", "wall_seconds", "elements", "increments"];
function firstThatVaries(effects, values) {
  const CLEAR = 0.02, of = values.map(({name}) => COSTS.includes(name) ? 0 : variationOf(effects, name)), first = of.findIndex(variation => variation >= CLEAR);
  return first >= 0 ? first : of.indexOf(Math.max(...of));
}

function effectsRange(effects, name) {
  const ends = effects.flatMap(({levels}) => levels.map(level => sampleAt(level, name)).filter(Boolean)
    .flatMap(({mean, standard_deviation: s = 0}) => [mean - s, mean + s]));
  return bounds([ends]);
}

// One panel per key, side by side with a common axis; dashed: the mean over all runs.
function effectsSvg(effects, {name, unit}, width, colours) {
  const {factor, label} = unitFor(unit, largest(effectsRange(effects, name)));
  const [low, high] = withMargin(effectsRange(effects, name).map(v => v * factor), 0.08);
  const title = labelled(titleOf(name), label), ticks = niceTicks(low, high, 5), top = 28, bottom = 250, height = 320;
  const left = roomOnTheLeft(ticks, title, bottom - top), right = width - 10;
  const panel = (right - left) / effects.length, py = v => bottom - (v - low) / (high - low) * (bottom - top);
  const text = (x, y, anchor, content, more = "") =>
    `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}" ${more}>${markup(content)}</text>`;
  const path = (d, stroke, more = "") => `<path d="${d}" stroke="${stroke}" fill="none" ${more}/>`;
  const out = [`<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" ` +
               `font-family="system-ui, sans-serif" font-size="12" fill="${colours.soft}">`];
  const told = tickText(ticks);
  for (const tick of ticks) {
    out.push(path(`M${left} ${py(tick).toFixed(1)}H${right}`, colours.grid), text(left - 7, py(tick) + 4, "end", told(tick)));
  }
  out.push(axisTitleSvg(title, top, bottom));
  effects.forEach(({key, levels, balanced}, k) => {
    const x0 = left + k * panel, there = levels.filter(level => sampleAt(level, name));
    const px = i => x0 + panel * (i + 0.5) / levels.length, stroke = colours.lines[k % colours.lines.length];
    if (k) out.push(path(`M${x0.toFixed(1)} ${top}V${bottom}`, colours.edge));
    out.push(text(x0 + panel / 2, 16, "middle", key + (balanced ? "" : " *"), 'font-weight="600"'));
    const runs = there.reduce((sum, level) => sum + sampleAt(level, name).runs, 0);
    const mean = there.reduce((sum, level) => sum + sampleAt(level, name).mean * sampleAt(level, name).runs, 0) / runs;
    out.push(path(`M${(x0 + 4).toFixed(1)} ${py(mean * factor).toFixed(1)}h${(panel - 8).toFixed(1)}`, colours.edge, 'stroke-dasharray="5 4"'));
    out.push(path(there.map((level, i) =>
      `${i ? "L" : "M"}${px(levels.indexOf(level)).toFixed(1)} ${py(sampleAt(level, name).mean * factor).toFixed(1)}`).join(""),
                  stroke, 'class="effect" stroke-width="1.8"'));
    there.forEach(level => {
      const {mean: m, standard_deviation: s = 0} = sampleAt(level, name), x = px(levels.indexOf(level)).toFixed(1);
      if (s > 0) out.push(path(`M${x} ${py((m - s) * factor).toFixed(1)}V${py((m + s) * factor).toFixed(1)}`, stroke, 'class="error-bar"'));
      out.push(`<circle class="level" cx="${x}" cy="${py(m * factor).toFixed(1)}" r="3.5" fill="${stroke}"/>`);
    });
    const room = panel / levels.length, short = t => t.length * 6.5 > room - 4;
    const slanted = levels.some(({level}) => short(level || "as in the scene"));
    levels.forEach(({level}, i) => {
      const at = level || "as in the scene", x = px(i), y = bottom + 16;
      out.push(slanted ? text(x, y, "end", at.length > 14 ? at.slice(0, 13) + "…" : at, `transform="rotate(-35 ${x.toFixed(1)} ${y})"`)
                       : text(x, y, "middle", at));
    });
  });
  return out.join("") + "</svg>";
}

function effectColumns(effects, {name, unit}) {
  return effects.flatMap(({key, levels}) => {
    const samples = levels.map(level => sampleAt(level, name));
    return [{label: `${key}: level`, unit: "-", values: levels.map(({level}) => Number(level))},
            {label: `${key}: mean of ${name}`, unit, values: samples.map(sample => sample?.mean)},
            {label: `${key}: standard deviation of ${name}`, unit, values: samples.map(sample => sample?.standard_deviation)}];
  });
}

// Returns the number of panels.
function drawEffects({effects = []}) {
  const values = effectValues(effects);
  if (!values.length) return 0;
  const choice = element("select", {});
  values.forEach(({name}, i) => choice.add(new Option(titleOf(name), i)));
  choice.value = firstThatVaries(effects, values);
  const title = "Main effects", host = card(title, element("div", {className: "controls"}, element("label", {}, "value ", choice)));
  const plot = element("div", {className: "effects", role: "img"}), chosen = () => values[Number(choice.value)];
  const unbalanced = effects.some(({balanced}) => !balanced);
  host.append(element("div", {className: "scroll"}, plot), element("p", {className: "note", textContent: "Mean over all runs at a level; bars: ± standard deviation of " +
    "these runs (over seeds and the other keys); dashed: mean of all runs. All values are in effects.csv." +
    (unbalanced ? " * Combinations were not run equally often: the effect includes part of those of other keys." : "")}));
  const svg = (colours, width) => effectsSvg(effects, chosen(), Math.max(width, 66 + 150 * effects.length), colours);
  const draw = () => {
    plot.innerHTML = svg(theme(), host.clientWidth);
    plot.setAttribute("aria-label", `${title} on ${titleOf(chosen().name)}`);
  };
  choice.onchange = draw;
  draw();
  onResize(host, draw);
  onTheme(draw);
  onUnits(draw);
  const name = () => fileName(`main effects ${chosen().name}`);
  host.parentElement.classList.add("wide");
  host.parentElement.querySelector(".card-head").append(saveButtons(title, {
    SVG: () => saveText(name() + ".svg", svg(LIGHT, 720), "image/svg+xml"),
    PNG: () => saveAsPng(name() + ".png", svg(LIGHT, 720), Math.max(720, 66 + 150 * effects.length), 320),
    CSV: () => saveText(name() + ".csv", csvOf(effectColumns(effects, chosen())), "text/csv")}));
  return effects.length;
}
