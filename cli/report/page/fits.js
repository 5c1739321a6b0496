// Report parts for compaction: laws fitted to its density curve, and the force transmitted to the
// bottom punch compared with theory.
"use strict";

const LAWS = {heckel: ["Heckel", "ln[1/(1 − D)] = K P + A"],
              kawakita: ["Kawakita", "P/C = P/a + 1/(a b),  C = 1 − D₀/D"],
              cooper_eaton: ["Cooper–Eaton", "C/(1 − D₀) = a₁ exp(−k₁/P) + a₂ exp(−k₂/P)"]};

// A law with less is not drawn: it describes something else.
const LEAST_R_SQUARED = 0.9;
const fitsWell = law => !law.not_fitted && law.r_squared >= LEAST_R_SQUARED;

const parameterText = ({name, value, unit}) => `${words(name)} = ${withUnit(value, unit)}`;

const NOT_DRAWN = `Not drawn: R² is below ${LEAST_R_SQUARED}, the law does not describe this curve.`;

// One row per law, for tables of several runs.
const LAW_TITLES = ["run", "law", "parameters", "R²", "rms of D"];
const lawRows = (name, {laws}) => laws.map(law => [
  name, (LAWS[law.law] || [law.law])[0],
  law.not_fitted ? `not fitted: ${law.not_fitted}` : law.parameters.map(parameterText).join(", "),
  law.not_fitted ? "–" : digits(law.r_squared, 5), law.not_fitted ? "–" : digits(law.rms_density, 3)]);

function fillFits({summary: {fits}}) {
  if (!fits || !Array.isArray(fits.laws)) return;
  document.getElementById("fits-section").hidden = false;
  const body = document.querySelector("#fits tbody");
  body.replaceChildren();
  for (const law of fits.laws) {
    const row = body.insertRow(), name = row.insertCell(), told = row.insertCell();
    const [title, formula] = LAWS[law.law] || [law.law, ""];
    name.textContent = title;
    name.append(element("small", {textContent: formula}));
    told.textContent = law.not_fitted ? `not fitted: ${law.not_fitted}`
                                      : law.parameters.map(parameterText).join(", ");
    if (law.not_fitted) continue;
    told.append(element("small", {textContent: `R² ${digits(law.r_squared, 5)}; rms ` +
      `${withUnit(law.rms, law.rms_unit, 3)} of the ordinate, ` +
      `${digits(law.rms_density, 3)} of the relative density`}));
    if (!fitsWell(law)) told.append(element("small", {className: "advice", textContent: NOT_DRAWN}));
  }
  const range = fits.samples > 0 ?
    `Pressure P of the top punch, ${fits.samples} samples of the loading from ` +
    `${withUnit(fits.pressure[0], "Pa", 3)} (1 % of the largest) to ` +
    `${withUnit(fits.pressure[1], "Pa", 3)}, relative density D ` +
    `${digits(fits.relative_density[0])} to ${digits(fits.relative_density[1])}.` : "";
  document.getElementById("fits-note").textContent = range;
}

const TRANSMISSION = [["relative_density", "D"], ["height_over_width", "H/W"],
                      ["lateral_ratio", "K measured"], ["measured", "measured"],
                      ["round_die", "cylindrical die"], ["slot", "plane strain"],
                      ["slot_measured_ratio", "plane strain, K measured"]];

const TRANSMISSION_NOTE =
  "Bottom over top force, means over pieces of the loading. Cylindrical die: exp(−4 µ ν H / (W (1 − ν))); " +
  "plane strain between two walls: exp(−2 µ K H / W) with the elastic K = ν/(1 − ν) and with the measured one";

function fillTransmission({transmission}) {
  if (!transmission) return;
  document.getElementById("transmission-section").hidden = false;
  const note = document.getElementById("transmission-note");
  if (transmission.not_measured) {
    note.textContent = `Not measured: ${transmission.not_measured}.`;
    return;
  }
  const shares = transmission.shares;
  const columns = TRANSMISSION.filter(([key]) => shares.some(share => key in share));
  const head = document.querySelector("#transmission thead").insertRow();
  columns.forEach(([, title]) => head.append(element("th", {textContent: title})));
  const body = document.querySelector("#transmission tbody");
  for (const share of shares) {
    const row = body.insertRow();
    for (const [key] of columns) row.insertCell().textContent = digits(share[key]);
  }
  note.textContent = transmission.not_compared ?
    `Not compared with theory: ${transmission.not_compared}.` :
    `${TRANSMISSION_NOTE}; µ = ${digits(transmission.wall_friction)} at the walls, ν = ${digits(transmission.poissons_ratio)}.`;
}
