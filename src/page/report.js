// Fills the page of a run from its record, which is the output of --stats.

// ---- head and warnings

function fillReport() {
  const mesh = record.mesh, input = record.input, total = record.total;
  surfaces[0].name = record.output.split("/").pop();
  const state = mesh.is_closed ? "closed" : "open, with " + plural(mesh.boundary_edges, "boundary edge");
  fillHead(surfaces[0].name, plural(mesh.faces, "face") + " from " + plural(record.report.points, "point") +
    " in " + plural(input.views, "view") + ", made in " + seconds(total.seconds) + " s with " +
    mebibytes(total.peak_memory_bytes) + " MiB of memory. The surface is " + state + ", and has " +
    plural(mesh.components, "connected component") + ".");
  const warnings = record.report.warnings;
  byId("warnings-section").classList.toggle("none", warnings.length === 0);
  for (const warning of warnings.length ? warnings : ["No warnings for this run."]) {
    byId("warnings").append(element("li", {}, warning));
  }
  fillStages();
  fillFilter();
  fillMesh();
  fillDepth();
  fillHistograms();
}

// ---- stages

/// Returns the counts of a stage as text: "19,258 cells, 7 trimmed".
function countsText(counts) {
  const parts = [];
  for (const [name, count] of Object.entries(counts)) {
    if (name.startsWith("of ") && parts.length > 0) {
      const before = parts.pop();
      const space = before.indexOf(" ");
      parts.push(before.slice(0, space) + " of " + whole(count) + before.slice(space));
    } else if (count !== 0 || parts.length === 0) {
      parts.push(whole(count) + " " + name);
    }
  }
  return parts.join(", ");
}
function fillStages() {
  const longest = Math.max(...record.stages.map((stage) => stage.seconds), 1e-9);
  const body = byId("stages").tBodies[0];
  for (const stage of record.stages) {
    const bar = element("div", {});
    bar.style.width = 100 * stage.seconds / longest + "%";
    body.append(element("tr", {}, element("th", { scope: "row" }, stage.name),
      element("td", {}, countsText(stage.counts)),
      element("td", { class: "number" }, seconds(stage.seconds)),
      element("td", { class: "bar", "aria-hidden": "true" }, bar),
      element("td", { class: "number" }, mebibytes(stage.peak_memory_bytes))));
  }
  byId("stages").tFoot.append(element("tr", {}, element("th", { scope: "row" }, "total"),
    element("td", {}, record.threads_used + (record.threads_used === 1 ? " thread, " : " threads, ") +
      seconds(record.total.cpu_seconds) + " s of CPU time"),
    element("td", { class: "number" }, seconds(record.total.seconds)), element("td", { class: "bar" }),
    element("td", { class: "number" }, mebibytes(record.total.peak_memory_bytes))));
  byId("stages-note").textContent = record.peak_memory_is_per_stage
    ? "Memory is the peak during a stage."
    : "Memory is the peak from the start of the run to the end of a stage.";
}

// ---- filter

const kReasons = [
  ["non-finite", "not finite", () => "a coordinate is not finite, or is beyond 1e100"],
  ["duplicate", "duplicate", () => "at the position of another point, and merged with it"],
  ["few views", "few views", (o) => "seen by fewer than " + o["min-views"] + " views (--min-views)"],
  ["high error", "high error", (o) => "reprojection error above " + o["max-error"] + " px (--max-error)"],
  ["low angle", "small angle", (o) => "rays meet at less than " + o["min-angle"] + "° (--min-angle)"],
  ["stray", "stray", (o) => "seen by two views, and " + o["stray-spacing"] + " times the usual spacing away from other points (--stray-spacing)"],
];
function fillFilter() {
  const stage = record.stages.find((one) => one.name === "filter");
  if (!stage) { byId("filter-section").hidden = true; return; }
  const counts = stage.counts, { "of points": all } = counts;
  const list = element("div", { class: "drops" });
  const line = (name, why, count, kind) => {
    const bar = element("div", {});
    bar.style.width = 100 * count / Math.max(all, 1) + "%";
    if (count === 0) bar.hidden = true;
    list.append(element("span", { class: "why" }, name, element("br"), element("small", {}, why)),
      element("span", { class: "number", "data-count": count }, whole(count) + " · " + percent(count / Math.max(all, 1))),
      element("span", { class: "track " + kind, "aria-hidden": "true" }, bar));
  };
  line("kept", "of " + whole(all) + " points", counts.points, "kept");
  for (const [key, name, why] of kReasons) line(name, why(record.options), counts[key], "");
  byId("filter").append(list);
}

// ---- the surface

function fillMesh() {
  const mesh = record.mesh, report = record.report;
  const body = byId("mesh").tBodies[0];
  const yes = (is) => is ? "yes" : "no";
  body.append(
    row("Faces", whole(mesh.faces), true), row("Vertices", whole(mesh.vertices), true),
    row("Connected components", whole(mesh.components), true),
    row("Closed", yes(mesh.is_closed), true), row("Boundary edges", whole(mesh.boundary_edges), true),
    row("Manifold", yes(mesh.is_manifold), true),
    row("Area, in square model units", short(mesh.area), true),
    row("Area of faces without support (a corner that no view sees from the front)", percent(report.unsupported_area), true),
    row("Area of faces with an edge above 10 median edges", percent(report.long_area), true));
}

// ---- dense stereo

function fillDepth() {
  const depth = sceneData.depth;
  byId("depth-section").hidden = !depth;
  if (!depth) return;
  for (const [name, what] of [["photograph", "Photograph "], ["depth", "Depth map of "]]) {
    byId("depth").append(element("img", { src: "data:image/jpeg;base64," + depth[name], alt: what + depth.name }));
  }
  const counts = (stage) => record.stages.find((one) => one.name === stage).counts;
  const measured = counts("depth"), fused = counts("fuse");
  byId("depth-note").textContent = depth.name + ": light is near, dark is far, blue is not measured. Of " +
    whole(measured["of pixels measured"]) + " pixels in " + plural(measured["depth maps"], "depth map") + ", " +
    whole(measured["pixels measured"]) + " were measured and " + whole(fused["pixels fused"]) + " fused to " +
    plural(fused.points, "point") + ".";
}

// ---- histograms

function svg(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}
function histogram(title, what, data) {
  const isCount = data.unit === "views";
  const number = isCount ? whole : short;
  const words = "Median " + number(data.median) + " " + data.unit + ", largest " + number(data.largest) + "; " +
    whole(data.values) + " " + what + ".";
  const figure = element("figure", {}, element("figcaption", {}, element("h3", {}, title), element("p", {}, words)));
  const width = 360, height = 150, base = height - 22;
  const columns = data.counts.concat(data.beyond > 0 ? [data.beyond] : []);
  const highest = Math.max(...columns, 1);
  const step = width / Math.max(columns.length, 8);
  const picture = svg("svg", { viewBox: "0 0 " + width + " " + height, role: "img", "aria-label": title + ". " + words });
  columns.forEach((count, i) => {
    const tall = (base - 14) * count / highest;
    const beyond = i === data.counts.length;
    const column = svg("rect", { class: beyond ? "column beyond" : "column", x: (i * step).toFixed(2), y: (base - tall).toFixed(2),
      width: Math.max(step - 1, 0.5).toFixed(2), height: tall.toFixed(2) });
    const from = number(data.bounds[i]);
    const range = beyond ? from + " or more" : isCount ? from : from + " to " + number(data.bounds[i + 1]);
    column.append(svg("title", {}, range + " " + data.unit + ": " + whole(count)));
    picture.append(column);
  });
  picture.append(svg("line", { x1: 0, x2: width, y1: base, y2: base }));
  // Labels, far enough apart to not overlap.
  const last = data.counts.length;
  const every = Math.max(1, Math.ceil(last / 6));
  const end = data.beyond > 0 ? width - 90 : width;
  for (let i = 0; i < last; i += every) {
    const x = isCount ? (i + 0.5) * step : i * step;
    if (x > end) break;
    picture.append(svg("text", { x: x.toFixed(1), y: height - 8, "text-anchor": i === 0 && !isCount ? "start" : "middle" }, number(data.bounds[i])));
  }
  if (data.beyond > 0) {
    picture.append(svg("text", { x: (last + 1) * step, y: height - 8, "text-anchor": "end" }, number(data.bounds[last]) + " or more"));
  }
  const span = data.bounds[last] - data.bounds[0];
  const place = step * last * (data.median - data.bounds[0] + (isCount ? 0.5 : 0)) / span;
  if (place <= step * last) {
    picture.append(svg("line", { class: "median", x1: place.toFixed(1), x2: place.toFixed(1), y1: 4, y2: base }));
  }
  figure.append(picture);
  return figure;
}
function fillHistograms() {
  const all = record.report.histograms, place = byId("histograms");
  if (all.track_length) place.append(histogram("Track length", "points, by number of views", all.track_length));
  if (all.reprojection_error) place.append(histogram("Reprojection error", "points", all.reprojection_error));
  if (all.edge_length) place.append(histogram("Edge length", "edges of faces", all.edge_length));
}
