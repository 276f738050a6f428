"use strict";
// Fills the page from the record of a comparison, which holds what --json writes, and drives one view a
// surface, all with the same camera.

const kMostViews = 4; // browsers keep some ten WebGL pictures at most, phones fewer
const comparison = record.comparison;
const hasTruth = comparison.truth !== null;
const ofDiagonal = (share) => {
  const value = 100 * share;
  return (value >= 10 ? value.toFixed(0) : Number(value.toPrecision(2))) + " %";
};

/// What stands at a place, a JSON pointer, in a mesh's entry; null where nothing does.
function valueAt(mesh, place) {
  let value = mesh;
  for (const key of place.split("/").slice(1)) {
    if (value === null || value === undefined) return null;
    value = value[key];
  }
  return value === undefined ? null : value;
}

// ---- head

function fillHead() {
  const names = comparison.meshes.map((mesh) => mesh.name);
  const title = names.length < 2 ? names.join("")
    : names.slice(0, -1).join(", ") + " and " + names[names.length - 1];
  byId("title").textContent = title;
  document.title = title + " · colmap-vcarve";
  const model = comparison.model;
  const points = plural(model.points, "point"), views = plural(model.views, "view");
  let lead = "Measured against " + (hasTruth ? points + ", " + views + " and the true surface."
    : points + " and " + views + "; the true surface is not known.");
  const good = record.rows.find((one) => one.place === "/truth/agreement/2/f");
  if (good) {
    lead += " F within" + good.title.slice(1) + " of its diagonal: " +
      comparison.meshes.map((mesh, i) => mesh.name + " " + good.cells[i]).join(", ") + ".";
  }
  byId("lead").textContent = lead;
  byId("maker").textContent = record.program.name + " " + record.program.version;
}

// ---- the table, in the words of the terminal's

/// Which columns have the best value of a row: none where all are alike or which way is better is not said.
function bestColumns(line) {
  const values = comparison.meshes.map((mesh) => valueAt(mesh, line.place));
  const known = values.filter((value) => value !== null);
  if (!line.better || known.length < 2 || known.every((value) => value === known[0])) return [];
  const best = line.better === "lower" ? Math.min(...known) : Math.max(...known);
  return values.map((value) => value === best);
}
function fillTable() {
  const table = byId("table");
  table.tHead.append(element("tr", {}, element("th", { scope: "col" }, element("span", { class: "hidden" }, "Figure")),
    ...comparison.meshes.map((mesh) => element("th", { scope: "col", class: "number" }, mesh.name))));
  for (const line of record.rows) {
    const best = bestColumns(line);
    table.tBodies[0].append(element("tr", { "data-place": line.place }, element("th", { scope: "row" }, line.title),
      ...line.cells.map((text, i) => {
        const value = valueAt(comparison.meshes[i], line.place);
        const attributes = { class: best[i] ? "number best" : "number" };
        if (value !== null) attributes.title = String(value);
        return element("td", attributes, text);
      })));
  }
  byId("table-note").textContent = comparison.meshes.length > 1 ? "Bold is the best of a row, where one is better." : "";
  for (const line of comparison.definitions) byId("definitions").append(element("li", {}, line));
}
function fillRun() {
  byId("command").textContent = record.command;
  for (const [name, value] of Object.entries(record.program)) {
    byId("program").tBodies[0].append(row(name, String(value)));
  }
  const text = byId("record-text");
  text.parentElement.addEventListener("toggle", () => { text.textContent = JSON.stringify(comparison, null, 2); }, { once: true });
}

// ---- the views

const surfaces = sceneData.surfaces;
const panes = []; // { surface, view, root, ring }
const look = { layers: { surface: true, wireframe: false, points: false, cameras: false, backs: true }, colour: "plain" };
let place = null; // that is marked in every view

function legendOf(mode) {
  if (mode === "normal") return { title: "Where a face looks: right red, up green, towards you blue" };
  if (mode !== "distance") return null;
  const title = hasTruth ? "Distance to the truth, in % of its diagonal"
    : "Distance to " + (surfaces.length === 2 ? "the other surface" : surfaces[0].name + ", and of that to " +
      surfaces[1].name) + ", in % of the diagonal of the points";
  return { title, ramp: kDistanceRamp, low: "0", middle: ofDiagonal(sceneData.scale / 2),
    high: ofDiagonal(sceneData.scale) + " or more" };
}
/// The first view, which leads where a control means all.
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
  for (const button of byId("surfaces").children) {
    const isShown = panes.some((pane) => pane.surface === Number(button.dataset.surface));
    button.setAttribute("aria-pressed", String(isShown));
    button.disabled = isShown ? panes.length === 1 : panes.length === kMostViews;
  }
}
function shownText(surface) {
  const count = surface.faces.count;
  return (count < surface.of ? whole(surface.of) + " faces, simplified for this page to " + whole(count)
    : plural(count, "face")) + (surface.colors || surface.is_truth ? "" : ", no colours");
}
function openPane(number) {
  const surface = surfaces[number];
  const canvas = element("canvas", { tabindex: 0, role: "img", "aria-describedby": "help",
    "aria-label": surface.name + ", with " + plural(surface.faces.count, "face") });
  const frame = element("div", { class: "image-frame", hidden: "" });
  const ring = element("div", { class: "ring", hidden: "" });
  const root = element("figure", { class: "pane", "data-surface": number },
    element("figcaption", {}, element("strong", {}, surface.name), element("span", {}, shownText(surface))),
    element("div", { class: "stage" }, canvas, frame, ring));
  // In the order of the surfaces.
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
  view.colourBy(look.colour);
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

function driveSurfaces() {
  const group = byId("surfaces");
  group.hidden = surfaces.length < 2;
  surfaces.forEach((surface, i) => {
    const button = element("button", { type: "button", class: "surface", "data-surface": i }, surface.name);
    button.addEventListener("click", () => {
      if (panes.some((pane) => pane.surface === i)) closePane(i); else openPane(i);
    });
    group.append(button);
  });
}
function driveControls() {
  for (const button of document.querySelectorAll("[data-layer]")) {
    const name = button.dataset.layer;
    button.setAttribute("aria-pressed", String(look.layers[name]));
    button.addEventListener("click", () => {
      look.layers[name] = !look.layers[name];
      for (const pane of panes) pane.view.show(name, look.layers[name]);
      button.setAttribute("aria-pressed", String(look.layers[name]));
    });
  }
  const select = byId("camera");
  sceneData.views.forEach((one, i) => select.append(element("option", { value: i }, one.name || "view " + (i + 1))));
  select.addEventListener("change", () => { if (select.value !== "") leader().through(Number(select.value)); });
  const goes = { overview: () => leader().overview(), top: () => leader().top(), previous: () => step(-1), next: () => step(1) };
  for (const button of document.querySelectorAll("[data-go]")) button.addEventListener("click", goes[button.dataset.go]);
  byId("colour").addEventListener("change", () => colourBy(byId("colour").value));
}
function colourBy(mode) {
  look.colour = mode;
  for (const pane of panes) pane.view.colourBy(mode);
  showLegend(legendOf(mode));
}
/// Takes out the colours that no surface has, and gives the one to begin with.
function firstColour() {
  const select = byId("colour");
  const drop = (mode) => select.querySelector("[value=" + mode + "]").remove();
  if (!surfaces.some((surface) => surface.distances)) drop("distance");
  if (!surfaces.some((surface) => surface.colors)) drop("rgb");
  return select.value;
}

// ---- worst places

/// Where something is missing, only the truth shows what.
function goTo(chosen, button, surface, words, isMissing) {
  place = chosen;
  for (const wanted of isMissing ? [surface, surfaces.length - 1] : [surface]) {
    if (!panes.some((pane) => pane.surface === wanted) && panes.length < kMostViews) openPane(wanted);
  }
  for (const other of document.querySelectorAll("[data-wrong]")) other.setAttribute("aria-pressed", String(other === button));
  // Not from behind the camera that sees it, where a wall may stand.
  const distance = Math.min(Math.max(isMissing ? 0.4 : 0.15, 3 * chosen.distance) * sceneData.diagonal,
    chosen.reach || 1.5 * sceneData.diagonal);
  leader().flyTo(vectorOf(chosen.position), vectorOf(chosen.towards), distance);
  panes.forEach(showPlace);
  byId("place-text").textContent = words;
  const box = byId("panes").getBoundingClientRect();
  if (box.top < 0 || box.bottom > window.innerHeight) byId("panes").scrollIntoView({ block: "start" });
}
const seenBy = (views) => views === null ? "" : views === 0 ? "no camera sees it" : "seen by " + plural(views, "camera");
function chips(found, surface, wordsOf, isMissing) {
  const list = element("ol", { class: "chips" });
  found.forEach((one, i) => {
    const words = wordsOf(one);
    const button = element("button", { type: "button", "data-wrong": "", "aria-pressed": "false", "aria-label": words },
      ofDiagonal(one.distance), ...(one.views === 0 ? [" ", element("small", {}, "unseen")] : []));
    button.addEventListener("click", () => goTo(one, button, surface, words, isMissing));
    list.append(element("li", {}, button));
  });
  return list;
}
function placesOf(surface, number) {
  const box = element("div", {}, element("h3", {}, surface.name));
  const add = (found, label, wordsOf) => {
    if (found === null) return;
    box.append(element("p", {}, label), found.length > 0 ? chips(found, number, wordsOf, found === surface.missing)
      : element("p", {}, "None is farther than 0.1 %."));
  };
  add(surface.missing, "Missing: the truth is here, this surface so far away", (one) =>
    "Missing in " + surface.name + ": here its nearest part is " + ofDiagonal(one.distance) + " of the diagonal away from the truth" + (one.views === 0 ? "; no image holds the place." : "."));
  add(surface.wrong, hasTruth ? "Wrong: this surface is here, the truth so far away"
    : "This surface is here, " + surface.measured_to + " so far away", (one) =>
    (hasTruth ? "Wrong in " : "") + surface.name + ": here it is " + ofDiagonal(one.distance) + " of the diagonal away from " +
      surface.measured_to + "; " + seenBy(one.views) + ".");
  return box;
}
function fillPlaces() {
  const measured = surfaces.filter((surface) => surface.wrong);
  byId("places").hidden = measured.length === 0;
  byId("places-note").textContent = "Far off, in % of the diagonal; those with most area times distance come first. A click " +
    "leads there. " + (hasTruth ? "Of the truth only what enough cameras see can be missing. " : "") +
    "Unseen: no camera of the model sees that part of the surface" +
    (hasTruth ? ", or no image holds the place that is missing." : ".");
  for (const surface of measured) byId("places-of").append(placesOf(surface, surfaces.indexOf(surface)));
}

// ----

fillHead();
fillTable();
fillRun();
driveSurfaces();
look.colour = firstColour();
try {
  const meshes = surfaces.length - (hasTruth ? 1 : 0);
  for (let i = 0; i < Math.min(meshes, kMostViews); ++i) openPane(i);
  if (hasTruth && meshes <= 2 && window.innerWidth > 900) openPane(meshes);
  driveControls();
  fillPlaces();
  showLegend(legendOf(look.colour));
  leader().start();
} catch (error) {
  byId("panes").replaceChildren(element("p", { id: "no-webgl" }, "This browser shows no WebGL, so that the surfaces cannot be " +
    "drawn here. The figures below do not need it."));
  byId("places").hidden = true;
  for (const control of document.querySelectorAll(".toolbar button, .toolbar select")) control.disabled = true;
}
const points = sceneData.points;
byId("shown").textContent = points.positions.count < points.of
  ? "Of " + whole(points.of) + " points " + whole(points.positions.count) + " are shown." : "";
window.report = { record, panes };
document.documentElement.dataset.ready = "yes";
