// Names shown in pages instead of keys: words and a symbol. Results have theirs in run.h5; other keys in the same table as for
// figures (cli/python/pulvis/figures/name_table.py), embedded in the page as NAMES.
"use strict";

const LABELS = new Map(Object.entries(NAMES.keys));  // "relative density $\\rho$"
const keepLabels = (labels = {}) => Object.entries(labels).forEach(one => LABELS.set(...one));

// {words, symbol}; a key without a label is shown as words.
function nameOf(key) {
  if (LABELS.has(key)) {
    const [, words, symbol = ""] = /^(.*?)(?: \$([^$]*)\$)?$/s.exec(LABELS.get(key));
    return {words, symbol};
  }
  if (key.startsWith("peak/")) {
    const {words, symbol} = nameOf(key.slice("peak/".length));
    return {words: `${words} at peak density`, symbol};
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
