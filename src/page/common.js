"use strict";
// What the scripts of all pages share. Texts from files (paths, names of images) only ever become text
// nodes.

const record = JSON.parse(document.getElementById("record").textContent);
const sceneData = JSON.parse(document.getElementById("scene").textContent);

const byId = (id) => document.getElementById(id);
const whole = (number) => Math.round(number).toLocaleString("en-US");
const seconds = (number) => number.toFixed(2);
const mebibytes = (bytes) => whole(bytes / 1048576);
const percent = (share) => {
  const value = 100 * share;
  return (value === 0 || value === 100 ? value.toFixed(0) : value < 0.1 ? "< 0.1" : value.toFixed(1)) + " %";
};
const short = (number) => number === 0 ? "0" : Number(number.toPrecision(3)).toLocaleString("en-US", { maximumSignificantDigits: 3 });

/// An element with attributes and children; a child that is no element becomes text.
function element(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
  for (const child of children) made.append(child);
  return made;
}
function row(term, value, isNumber) {
  return element("tr", {}, element("th", { scope: "row" }, term),
    element("td", isNumber ? { class: "number" } : {}, value));
}
function plural(count, noun) { return whole(count) + " " + noun + (count === 1 ? "" : "s"); }

/// `legend` has a title; where colours stand for numbers, also "low" and "high", between them perhaps
/// a "middle", a "ramp" other than the usual, and what "none" in its "noneColour" stands for.
function showLegend(legend) {
  const place = byId("legend");
  place.replaceChildren();
  place.hidden = !legend;
  if (!legend) return;
  place.append(element("div", {}, legend.title));
  if (legend.low === undefined) return;
  const scale = element("div", { class: "scale" });
  scale.style.background = "linear-gradient(to right," + (legend.ramp || kRamp).map(css).join(",") + ")";
  const ends = [legend.low, legend.middle, legend.high].filter((text) => text !== undefined);
  place.append(scale, element("div", { class: "ends" }, ...ends.map((text) => element("span", {}, text))));
  if (legend.none === undefined) return;
  const swatch = element("span", { class: "swatch" });
  swatch.style.background = css(legend.noneColour);
  place.append(element("div", {}, swatch, legend.none));
}
