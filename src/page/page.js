// Shared by the pages of runs and comparisons: texts, and one view per surface, all with the same
// camera. Texts from files (paths, names of images) become only text nodes.

const record = JSON.parse(document.getElementById("record").textContent);
const sceneData = JSON.parse(document.getElementById("scene").textContent);
const comparison = record.comparison; // undefined on the page of a run
const hasTruth = Boolean(comparison && comparison.truth);

const byId = (id) => document.getElementById(id);
const whole = (number) => Math.round(number).toLocaleString("en-US");
const seconds = (number) => number.toFixed(2);
const mebibytes = (bytes) => whole(bytes / 1048576);
const percent = (share) => {
  const value = 100 * share;
  return (value === 0 || value === 100 ? value.toFixed(0) : value < 0.1 ? "< 0.1" : value.toFixed(1)) + " %";
};
const short = (number) => number === 0 ? "0" : Number(number.toPrecision(3)).toLocaleString("en-US", { maximumSignificantDigits: 3 });

/// Makes an element with attributes and children; other children become text.
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

function fillHead(title, lead) {
  byId("kicker").textContent += comparison ? " comparison" : " report";
  byId("title").textContent = title;
  document.title = title + " · colmap-vcarve";
  byId("lead").textContent = lead;
  byId("maker").textContent = record.program.name + " " + record.program.version;
}
const optionText = (value) => Array.isArray(value) ? value.join(", ") : typeof value === "boolean" ? (value ? "yes" : "no") : String(value);
function fillRun() {
  byId("command").textContent = record.command;
  for (const note of record.notes || []) byId("notes").append(element("li", {}, note));
  for (const [name, value] of Object.entries(record.options || {})) {
    byId("options").tBodies[0].append(row("--" + name, optionText(value)));
  }
  for (const [name, value] of Object.entries(record.program)) {
    byId("program").tBodies[0].append(row(name, String(value)));
  }
  const text = byId("record-text");
  text.parentElement.addEventListener("toggle",
    () => { text.textContent = JSON.stringify(comparison || record, null, 2); }, { once: true });
}

// ---- the views

const kMostViews = 4; // browsers allow about ten WebGL contexts, phones fewer
const surfaces = sceneData.surfaces;
const panes = []; // { surface, view, root, ring }
const look = { layers: { surface: true, wireframe: false, points: false, cameras: false, backs: true, removed: false }, color: "plain" };
let place = null; // the position marked in every view

/// Shows a legend with a "title". Legends of numbers also have "low" and "high", and optionally
/// "middle", a "ramp" (default: kRamp), and "none", the meaning of "noneColor".
function showLegend(legend) {
  const box = byId("legend");
  box.replaceChildren();
  box.hidden = !legend;
  if (!legend) return;
  box.append(element("div", {}, legend.title));
  if (legend.low === undefined) return;
  const scale = element("div", { class: "scale" });
  scale.style.background = "linear-gradient(to right," + (legend.ramp || kRamp).map(css).join(",") + ")";
  const ends = [legend.low, legend.middle, legend.high].filter((text) => text !== undefined);
  box.append(scale, element("div", { class: "ends" }, ...ends.map((text) => element("span", {}, text))));
  if (legend.none !== undefined) box.append(element("div", {}, swatch(legend.noneColor), legend.none));
}
function swatch(color) {
  const made = element("span", { class: "swatch" });
  made.style.background = css(color);
  return made;
}
/// Shows the reasons of removed faces while these are shown.
function showRemoved(on) {
  const box = byId("removed-legend");
  box.replaceChildren();
  box.hidden = !on;
  if (!on) return;
  box.append(element("div", {}, "Removed faces"));
  for (const { reason, name, of } of sceneData.removed.reasons) {
    box.append(element("div", { "data-removed": of }, swatch(kRemoved[reason]), name + ": " + whole(of)));
  }
}

/// The first view. Controls for all views act on it, and the others follow.
const leader = () => panes[0].view;
function follow(state, from) {
  for (const pane of panes) if (pane.view !== from) pane.view.follow(state);
  byId("camera").value = state.view === null ? "" : String(state.view);
}
function showPlace(pane) {
  pane.view.mark(pane.ring, place ? vectorOf(place.position) : null);
}
function layOut() {
  byId("panes").dataset.count = String(panes.length);
  for (const button of document.querySelectorAll("#surfaces button")) {
    const isShown = panes.some((pane) => pane.surface === Number(button.dataset.surface));
    button.setAttribute("aria-pressed", String(isShown));
    button.disabled = isShown ? panes.length === 1 : panes.length === kMostViews;
  }
}
function facesText(surface) {
  const count = surface.faces.count;
  return (count < surface.of ? whole(surface.of) + " faces, simplified for this page to " + whole(count)
    : plural(count, "face")) + (surface.colors || surface.is_truth ? "" : ", no colors");
}
function openPane(number) {
  const surface = surfaces[number];
  const canvas = element("canvas", { tabindex: 0, role: "img", "aria-describedby": "help",
    "aria-label": surface.name + ", with " + plural(surface.faces.count, "face") });
  const frame = element("div", { class: "image-frame", hidden: "" });
  const ring = element("div", { class: "ring", hidden: "" });
  const root = element("figure", { class: "pane", "data-surface": number },
    element("figcaption", {}, element("strong", {}, surface.name), element("span", {}, facesText(surface))),
    element("div", { class: "stage" }, canvas, frame, ring));
  // Keep the order of the surfaces.
  const after = panes.find((pane) => pane.surface > number);
  byId("panes").insertBefore(root, after ? after.root : null);
  let view = null;
  try {
    view = makeView(canvas, frame, surface, sceneData, (state) => follow(state, view));
  } catch (error) {
    root.remove();
    throw error;
  }
  for (const [name, on] of Object.entries(look.layers)) if (view.shown[name] !== on) view.show(name, on);
  view.colorBy(look.color);
  if (panes.length > 0) view.follow(leader().state);
  canvas.addEventListener("keydown", (event) => {
    if (event.key === "[") step(-1);
    if (event.key === "]") step(1);
  });
  const pane = { surface: number, view, root, ring };
  panes.push(pane);
  panes.sort((a, b) => a.surface - b.surface);
  showPlace(pane);
  layOut();
}
function closePane(number) {
  const index = panes.findIndex((pane) => pane.surface === number);
  panes[index].view.dispose();
  panes[index].root.remove();
  panes.splice(index, 1);
  layOut();
}
function step(by) {
  const count = sceneData.views.length, now = leader().state.view;
  if (count === 0) return;
  leader().through(((now === null ? (by > 0 ? -1 : count) : now) + by + count) % count);
}

// ---- controls

function driveLayers() {
  for (const button of document.querySelectorAll("[data-layer]")) {
    const name = button.dataset.layer;
    if (name === "removed" && sceneData.removed.of === 0) {
      button.disabled = true;
      button.title = "Nothing was removed";
    }
    button.setAttribute("aria-pressed", String(look.layers[name]));
    button.addEventListener("click", () => {
      look.layers[name] = !look.layers[name];
      for (const pane of panes) pane.view.show(name, look.layers[name]);
      if (name === "removed") showRemoved(look.layers[name]);
      button.setAttribute("aria-pressed", String(look.layers[name]));
    });
  }
}
function driveCameras() {
  const select = byId("camera");
  sceneData.views.forEach((one, i) => select.append(element("option", { value: i }, one.name || "view " + (i + 1))));
  select.addEventListener("change", () => { if (select.value !== "") leader().through(Number(select.value)); });
  const goes = { overview: () => leader().overview(), top: () => leader().top(), previous: () => step(-1), next: () => step(1) };
  for (const button of document.querySelectorAll("[data-go]")) button.addEventListener("click", goes[button.dataset.go]);
}
function colorBy(mode) {
  look.color = mode;
  const legends = panes.map((pane) => pane.view.colorBy(mode));
  showLegend(mode === "distance" ? distanceLegend() : legends[0]);
}
/// Removes color modes that no surface has, and returns the first remaining mode.
function driveColors() {
  const needs = { texture: "texture", distance: "distances", rgb: "colors", support: "supports", views: "num_views", error: "errors" };
  const select = byId("color");
  for (const [mode, part] of Object.entries(needs)) {
    if (!surfaces.some((surface) => surface[part])) select.querySelector("[value=" + mode + "]").remove();
  }
  select.addEventListener("change", () => colorBy(select.value));
  return select.value;
}
function shownText() {
  const points = sceneData.points, removed = sceneData.removed;
  const parts = [["points", points.positions.count, points.of], ["cameras", sceneData.views.length, sceneData.views_of]];
  if (removed) parts.push(["removed faces", removed.faces.count, removed.of]);
  return parts.filter(([, count, of]) => count < of)
    .map(([what, count, of]) => "Of " + whole(of) + " " + what + ", " + whole(count) + " are shown.").join(" ");
}
function showViews() {
  const first = driveColors(), meshes = surfaces.length - (hasTruth ? 1 : 0);
  try {
    for (let i = 0; i < Math.min(meshes, kMostViews); ++i) openPane(i);
    if (hasTruth && meshes <= 2 && window.innerWidth > 900) openPane(meshes);
    driveLayers();
    driveCameras();
    if (comparison) fillPlaces();
    colorBy(first);
    leader().start();
  } catch (error) {
    byId("panes").replaceChildren(element("p", { id: "no-webgl" }, "The surface cannot be drawn: this browser has no WebGL. " +
      "The figures below do not need it."));
    if (comparison) byId("places").hidden = true;
    for (const control of document.querySelectorAll(".toolbar button, .toolbar select")) control.disabled = true;
  }
  byId("shown").textContent = shownText();
}

const kind = comparison ? "comparison" : "report";
document.body.classList.add(kind);
if (comparison) document.querySelector(".toolbar").append(byId("legend")); // several views share it
for (const part of document.querySelectorAll("[data-of]")) if (part.dataset.of !== kind) part.remove();
if (comparison) fillComparison(); else fillReport();
fillRun();
showViews();
window.report = { record, panes };
document.documentElement.dataset.ready = "yes";
