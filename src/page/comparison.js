// Fills the page of a comparison from its record, which holds what --json writes.

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

function fillComparison() {
  const names = comparison.meshes.map((mesh) => mesh.name);
  const title = names.length < 2 ? names.join("")
    : names.slice(0, -1).join(", ") + " and " + names[names.length - 1];
  const model = comparison.model;
  const points = plural(model.points, "point"), views = plural(model.views, "view");
  let lead = "Measured against " + (hasTruth ? points + ", " + views + " and the true surface."
    : points + " and " + views + "; the true surface is not known.");
  const good = record.rows.find((one) => one.place === "/truth/agreement/2/f");
  if (good) {
    lead += " F within" + good.title.slice(1) + " of its diagonal: " +
      comparison.meshes.map((mesh, i) => mesh.name + " " + good.cells[i]).join(", ") + ".";
  }
  fillHead(title, lead);
  fillTable();
  driveSurfaces();
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

// ---- the views

function distanceLegend() {
  const title = hasTruth ? "Distance to the truth, in % of its diagonal"
    : "Distance to " + (surfaces.length === 2 ? "the other surface" : surfaces[0].name + ", and of that to " +
      surfaces[1].name) + ", in % of the diagonal of the points";
  return { title, ramp: kDistanceRamp, low: "0", middle: ofDiagonal(sceneData.scale / 2),
    high: ofDiagonal(sceneData.scale) + " or more" };
}
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
