// User settings for the whole page: units, colormap, light or dark theme.
"use strict";

const UNIT_CHOICES = {N: ["n", "µ", "m", "", "k", "M"], Pa: ["k", "M", "G"], m: ["", "m", "µ", "n"], s: ["", "m", "µ"], J: ["", "m", "µ", "n", "p", "f"], V: ["", "m", "µ"]};

function picker(label, options, chosen, action) {
  const select = element("select", {});
  options.forEach(([value, text]) => select.add(new Option(text, value)));
  select.value = chosen;
  select.onchange = () => action(select.value);
  return element("label", {}, label + " ", select);
}

// units: those used on the page; hasMap: whether anything uses a colormap.
function placeSettings(host, units, hasMap = true) {
  const choices = Object.entries(UNIT_CHOICES).filter(([unit]) => units.has(unit)).map(([unit, prefixes]) =>
    picker(unit, [["auto", "auto"], ...prefixes.map(prefix => [prefix, prefix + unit])], "auto",
           value => chooseUnit(unit, value === "auto" ? null : value)));
  const menu = element("details", {className: "menu"}, element("summary", {textContent: "Units"}),
                       element("div", {}, ...choices));
  onKey(menu, ({key}) => {
    if (key !== "Escape" || !menu.open) return false;
    menu.open = false;
    menu.querySelector("summary").focus();
    return true;
  });
  const map = hasMap && picker("Colours", Object.keys(MAPS).map(name => [name, name]), chosenMap, chooseMap);
  const shade = element("button", {type: "button", id: "shade"});
  const tell = () => {
    shade.textContent = isDark() ? "Light" : "Dark";
    shade.setAttribute("aria-label", `Switch to ${shade.textContent.toLowerCase()} colours`);
  };
  shade.onclick = () => {
    document.documentElement.dataset.theme = isDark() ? "light" : "dark";
    themeChanged();
  };
  onTheme(tell);
  tell();
  host.append(...(choices.length ? [menu] : []), ...(map ? [map] : []), shade);
}

// Printing always uses dark on white, whatever the theme.
addEventListener("beforeprint", () => {
  const root = document.documentElement, chosen = root.dataset.theme;
  root.dataset.theme = "light";
  themeChanged();
  addEventListener("afterprint", () => {
    chosen ? root.dataset.theme = chosen : delete root.dataset.theme;
    themeChanged();
  }, {once: true});
});
