// Fills the page of a comparison from its record, which contains the output of --json.

const ofDiagonal = (share) => {
  const value = 100 * share;
  return (value >= 10 ? value.toFixed(0) : Number(value.toPrecision(2))) + " %";
};

/// Returns the value at a JSON pointer in a mesh's entry, or null.
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
    : points + " and " + views + "; the true surface is unknown.");
  const good = record.rows.find((one) => one.place === "/truth/agreement/2/f");
  if (good) {
    lead += " F within" + good.title.slice(1) + " of its diagonal: " +
      comparison.meshes.map((mesh, i) => mesh.name + " " + good.cells[i]).join(", ") + ".";
  }
  fillHead(title, lead);
  fillTable();
  driveSurfaces();
}

// ---- the table, with the same texts as in the terminal

/// Whether each column has the best value of a row; empty if all are equal or no direction is better.
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
  byId("table-note").textContent = comparison.meshes.length > 1 ? "The best value of a row is bold." : "";
  for (const line of comparison.definitions) byId("definitions").append(element("li", {}, line));
}

// ---- the views

function distanceLegend() {
  const title = hasTruth ? "Distance to the truth, in % of its diagonal"
    : "Distance to " + (surfaces.length === 2 ? "the other surface" : surfaces[0].name + ", and of this mesh to " +
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

/// Goes to a position. Opens the view of the surface, and of the truth if a part is missing.
function goTo(chosen, button, surface, words, isMissing) {
  place = chosen;
  for (const wanted of isMissing ? [surface, surfaces.length - 1] : [surface]) {
    if (!panes.some((pane) => pane.surface === wanted) && panes.length < kMostViews) openPane(wanted);
  }
  for (const other of document.querySelectorAll("[data-wrong]")) other.setAttribute("aria-pressed", String(other === button));
  // Stay in front of the camera that sees it, because a wall may be behind the camera.
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
      : element("p", {}, "No deviation is above 0.1 %."));
  };
  add(surface.missing, "Missing: parts of the truth that are far from this surface, with their distance", (one) =>
    "Missing in " + surface.name + ": its nearest part is " + ofDiagonal(one.distance) + " of the diagonal away from the truth" + (one.views === 0 ? "; no image contains the position." : "."));
  add(surface.wrong, hasTruth ? "Wrong: parts of this surface that are far from the truth, with their distance"
    : "Parts of this surface that are far from " + surface.measured_to + ", with their distance", (one) =>
    (hasTruth ? "Wrong in " : "") + surface.name + ": it is " + ofDiagonal(one.distance) + " of the diagonal away from " +
      surface.measured_to + "; " + seenBy(one.views) + ".");
  return box;
}
function fillPlaces() {
  const measured = surfaces.filter((surface) => surface.wrong);
  byId("places").hidden = measured.length === 0;
  byId("places-note").textContent = "Distances are in % of the diagonal, in order of area times distance. Click a " +
    "distance to go there. " + (hasTruth ? "Only parts of the truth that enough cameras see can be missing. " : "") +
    "Unseen: no camera of the model sees this part of the surface" +
    (hasTruth ? ", or no image contains the missing part." : ".");
  for (const surface of measured) byId("places-of").append(placesOf(surface, surfaces.indexOf(surface)));
}
