// Names shown in pages instead of keys: words and a symbol, from the same table as for figures
// (cli/python/pulvis/figures/name_table.py), embedded in the page as NAMES.
"use strict";

const PATTERNS = NAMES.patterns.map(([pattern, ...name]) => [new RegExp(`^(?:${pattern})$`), ...name]);

// {words, symbol}; a key that is not in the table is shown unchanged.
function nameOf(key) {
  if (Object.hasOwn(NAMES.keys, key)) {
    const [words, symbol] = NAMES.keys[key];
    return {words, symbol};
  }
  if (key.startsWith("peak/")) {
    const {words, symbol} = nameOf(key.slice("peak/".length));
    return {words: `${words} at peak density`, symbol};
  }
  if (key.startsWith("energy/")) {
    const kind = key.slice("energy/".length), isWhole = kind === "external" || kind === "balance";
    return {words: (NAMES.energies[kind] || words(kind)) + (isWhole ? "" : " energy"), symbol: "E"};
  }
  for (const [pattern, told, symbol] of PATTERNS) {
    const found = pattern.exec(key);
    if (!found) continue;
    const filled = text => Object.entries(found.groups || {}).reduce((one, [part, value]) => one.replaceAll(`{${part}}`, value), text);
    return {words: filled(told), symbol: filled(symbol)};
  }
  return {words: words(key).replaceAll("/", ", "), symbol: ""};
}

// A symbol as plain text, converted from mathtext.
const plainSymbol = symbol => Object.entries(NAMES.letters)
  .reduce((text, [tex, letter]) => text.replaceAll(tex, letter), symbol).replace(/[{}$_]/g, "");
const toldName = key => {
  const {words, symbol} = nameOf(key);
  return symbol ? `${words} ${plainSymbol(symbol)}` : words;
};
// A quantity in an expectation: a key, then its statistic ("tool/top/force_y, smallest").
function toldExpectation(what) {
  const [, key, rest] = /^([^\s,]*)(.*)$/s.exec(what);
  return toldName(key) + rest;
}
