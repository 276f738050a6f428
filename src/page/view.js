"use strict";
// The 3D view of a surface: draws the data of page_scene.cpp and comparison_scene.cpp by three.js.

// ---- unpacking, the inverse of src/page/pack.cpp

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

function threeByteNumbers(base64) {
  const bytes = bytesOf(base64);
  const numbers = new Uint32Array(bytes.length / 3);
  for (let i = 0, k = 0; k < numbers.length; ++k, i += 3) {
    numbers[k] = bytes[i] | bytes[i + 1] << 8 | bytes[i + 2] << 16;
  }
  return numbers;
}

function positionsOf(packed) {
  const steps = threeByteNumbers(packed.data);
  const positions = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; ++i) {
    positions[i] = packed.low[i % 3] + packed.quantum[i % 3] * steps[i];
  }
  return positions;
}

const kNoError = 65535;

function errorsOf(base64) {
  const bytes = bytesOf(base64);
  const errors = new Uint16Array(bytes.length / 2);
  for (let i = 0; i < errors.length; ++i) errors[i] = bytes[2 * i] | bytes[2 * i + 1] << 8;
  return errors;
}

// ---- colors

const kRamp = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]]; // viridis
const kNone = [196, 64, 84];     // no value: no support, no view
const kUnknown = [150, 150, 150];
const kPlain = [190, 188, 182];

function rampColor(share, ramp = kRamp) {
  const place = Math.min(Math.max(share, 0), 1) * (ramp.length - 1);
  const low = Math.min(Math.floor(place), ramp.length - 2);
  return ramp[low].map((value, i) => Math.round(value + (place - low) * (ramp[low + 1][i] - value)));
}

/// Colors of removed faces, indexed by the number of the reason.
const kRemoved = [[222, 143, 5], [2, 115, 178], [148, 148, 148], [204, 120, 188], [2, 158, 115]];

const css = (color) => "rgb(" + color.join(" ") + ")";

/// The quantile of the accepted numbers at a fraction.
function quantile(numbers, share, accepts) {
  const taken = Array.from(numbers).filter(accepts).sort((a, b) => a - b);
  return taken.length === 0 ? 0 : taken[Math.min(taken.length - 1, Math.floor(share * taken.length))];
}

/// Returns a color per corner of every face, and a legend, for a color mode.
function coloring(mode, surface) {
  const corners = surface.corners;
  const colors = new Uint8Array(3 * corners.length);
  const put = (i, color) => { colors[3 * i] = color[0]; colors[3 * i + 1] = color[1]; colors[3 * i + 2] = color[2]; };
  let legend = null;
  if (mode === "rgb" && surface.colors) {
    for (let i = 0; i < corners.length; ++i) {
      const from = 3 * corners[i];
      colors[3 * i] = surface.colors[from];
      colors[3 * i + 1] = surface.colors[from + 1];
      colors[3 * i + 2] = surface.colors[from + 2];
    }
  } else if (mode === "support" || mode === "views" || mode === "error") {
    const ofFaces = mode === "support";
    const values = { support: surface.supports, views: surface.numViews, error: surface.errors }[mode];
    const known = mode === "error" ? (v) => v !== kNoError : (v) => v > 0;
    const low = mode === "error" ? 0 : 1;
    const high = Math.max(quantile(values, 0.95, known), low + 1);
    const table = new Map();
    const colorOf = (value) => {
      if (!known(value)) return mode === "error" ? kUnknown : kNone;
      if (!table.has(value)) table.set(value, rampColor((value - low) / (high - low)));
      return table.get(value);
    };
    for (let i = 0; i < corners.length; ++i) {
      put(i, colorOf(values[ofFaces ? Math.floor(i / 3) : corners[i]]));
    }
    legend = {
      support: { title: "Views that see each corner of a face from its front (minimum)", none: "none: no view, or a filled hole", unit: "" },
      views: { title: "Views that see a vertex", none: "none: the vertex is not a point of the model", unit: "" },
      error: { title: "Mean reprojection error of a vertex", none: "unknown", unit: " px" },
    }[mode];
    legend.noneColor = mode === "error" ? kUnknown : kNone;
    const shown = (value) => mode === "error" ? (value / 1000).toFixed(2) : String(value);
    legend.low = shown(low) + legend.unit;
    legend.high = shown(high) + legend.unit + " or more";
  } else {
    for (let i = 0; i < corners.length; ++i) put(i, kPlain);
    if (mode === "normal") legend = { title: "Surface normals: red is right, green is up, blue is towards you" };
  }
  return { colors, legend };
}

// ---- shading: a light beside the eye, flat faces, striped back faces in one hue

const kVertexShader = `
varying vec3 vColor;
varying vec2 vPlace;
varying vec3 vEye;
void main() {
  #ifdef TEXTURED
  vPlace = uv;
  #else
  vColor = color;
  #endif
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  vEye = eye.xyz;
  gl_Position = projectionMatrix * eye;
}`;
const kFragmentShader = `
uniform float byNormal;
uniform float contrast;
uniform float ownBacks;
uniform sampler2D page;
varying vec3 vColor;
varying vec2 vPlace;
varying vec3 vEye;
void main() {
  vec3 normal = normalize(cross(dFdx(vEye), dFdy(vEye)));
  float lit = max(dot(normal, normalize(vec3(0.3, 0.5, 1.0))), 0.0);
  #ifdef TEXTURED
  vec3 own = texture2D(page, vPlace).rgb;
  #else
  vec3 own = vColor;
  #endif
  vec3 color = mix(own, 0.5 + 0.5 * normal, byNormal);
  float shade = 1.0 - contrast * (1.0 - lit);
  if (!gl_FrontFacing) {
    float stripe = step(0.5, fract((gl_FragCoord.x + gl_FragCoord.y) / 9.0));
    color = ownBacks > 0.5 ? color * mix(1.0, 0.72, stripe)
      : mix(vec3(0.72, 0.42, 0.36), vec3(0.62, 0.34, 0.29), stripe);
  }
  gl_FragColor = vec4(color * shade, 1.0);
}`;

/// Makes the material of a surface: with corner colors, or with a page of a texture. Textures contain
/// their lighting.
function surfaceMaterial(page) {
  return new THREE.ShaderMaterial({
    vertexShader: kVertexShader, fragmentShader: kFragmentShader, defines: page ? { TEXTURED: 1 } : {},
    vertexColors: page ? THREE.NoColors : THREE.VertexColors, side: THREE.DoubleSide, extensions: { derivatives: true },
    uniforms: { byNormal: { value: 0 }, contrast: { value: page ? 0 : 0.5 }, ownBacks: { value: 0 }, page: { value: page } },
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
  });
}

/// Makes the textured surface: faces page by page, and a material per page. A page appears as soon as
/// the browser has decoded it; then `changed` is called.
function texturedSurface(texture, cornerPositions, changed) {
  const pageOfFace = bytesOf(texture.page), bytes = bytesOf(texture.places);
  const geometry = new THREE.BufferGeometry();
  const places = new Float32Array(cornerPositions.length), uvs = new Float32Array(2 * cornerPositions.length / 3);
  const materials = [];
  let corner = 0;
  texture.pages.forEach((page, number) => {
    const first = corner;
    for (let face = 0; face < pageOfFace.length; ++face) {
      if (pageOfFace[face] !== number) continue;
      for (let i = 3 * face; i < 3 * face + 3; ++i, ++corner) {
        places.set(cornerPositions.subarray(3 * i, 3 * i + 3), 3 * corner);
        for (let axis = 0; axis < 2; ++axis) {
          uvs[2 * corner + axis] = (bytes[4 * i + 2 * axis] | bytes[4 * i + 2 * axis + 1] << 8) / 65535;
        }
      }
    }
    geometry.addGroup(first, corner - first, number);
    const image = new Image();
    const map = new THREE.Texture(image);
    map.flipY = false;
    map.generateMipmaps = false;
    map.minFilter = THREE.LinearFilter;
    image.onload = () => { map.needsUpdate = true; changed(); };
    image.src = "data:image/jpeg;base64," + page;
    materials.push(surfaceMaterial(map));
  });
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setAttribute("uv", new THREE.BufferAttribute(uvs, 2));
  return { geometry, materials };
}

function vectorOf(array) { return new THREE.Vector3(array[0], array[1], array[2]); }

/// Returns the region of most vertices: center and half the diagonal of a box that omits 3 % of the
/// vertices at each end of every axis.
function middleOf(positions) {
  const low = [], high = [];
  const step = 3 * Math.max(1, Math.floor(positions.length / 3 / 20000));
  for (let axis = 0; axis < 3; ++axis) {
    const values = [];
    for (let i = axis; i < positions.length; i += step) values.push(positions[i]);
    values.sort((a, b) => a - b);
    low.push(values.length ? values[Math.floor(0.03 * values.length)] : 0);
    high.push(values.length ? values[Math.min(values.length - 1, Math.floor(0.97 * values.length))] : 1);
  }
  const center = vectorOf(low).add(vectorOf(high)).multiplyScalar(0.5);
  return { center, radius: Math.max(vectorOf(high).distanceTo(vectorOf(low)) / 2, 1e-9) };
}

/// The frusta of all views, with eight lines each. A view without a known lens is a small cross.
function frustumLines(views, size) {
  const lines = [];
  const push = (a, b) => lines.push(a.x, a.y, a.z, b.x, b.y, b.z);
  for (const view of views) {
    const eye = vectorOf(view.center), right = vectorOf(view.right), down = vectorOf(view.down);
    const forward = vectorOf(view.forward);
    const at = (x, y, z) => eye.clone().addScaledVector(right, size * x).addScaledVector(down, size * y)
      .addScaledVector(forward, size * z);
    if (!view.half_size) {
      push(at(-.3, 0, 0), at(.3, 0, 0)); push(at(0, -.3, 0), at(0, .3, 0)); push(at(0, 0, -.3), at(0, 0, .3));
      continue;
    }
    const w = view.half_size[0], h = view.half_size[1];
    const corners = [at(-w, -h, 1), at(w, -h, 1), at(w, h, 1), at(-w, h, 1)];
    corners.forEach((corner, i) => { push(eye, corner); push(corner, corners[(i + 1) % 4]); });
  }
  return new Float32Array(lines);
}

/// Removed faces, with a mesh per reason. Unseen faces are in front of all others, so they are faint.
function removedFaces(removed) {
  const why = bytesOf(removed.why), corners = threeByteNumbers(removed.faces.data), places = positionsOf(removed.positions);
  const group = new THREE.Group();
  for (const { reason, name } of removed.reasons) {
    const own = [];
    for (let i = 0; i < corners.length; ++i) {
      if (why[Math.floor(i / 3)] === reason) own.push(places[3 * corners[i]], places[3 * corners[i] + 1], places[3 * corners[i] + 2]);
    }
    const made = new THREE.BufferGeometry();
    made.setAttribute("position", new THREE.BufferAttribute(new Float32Array(own), 3));
    group.add(new THREE.Mesh(made, new THREE.MeshBasicMaterial({
      color: new THREE.Color(css(kRemoved[reason]).replace(/ /g, ",")), side: THREE.DoubleSide, transparent: true,
      opacity: ["unseen", "trimmed"].includes(name) ? 0.15 : 0.7, depthWrite: false })));
  }
  return group;
}

/// Draws a surface, points and views in a canvas. When the view moves, `changed` is called with the
/// argument for follow() of other views.
function makeView(canvas, frame, surfaceData, sceneData, changed) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(45, 1, 0.1, 1000);
  const views = sceneData.views;
  const up = vectorOf(sceneData.up);

  const positions = positionsOf(surfaceData.positions);
  const surface = {
    corners: threeByteNumbers(surfaceData.faces.data),
    colors: surfaceData.colors ? bytesOf(surfaceData.colors) : null,
    numViews: surfaceData.num_views ? bytesOf(surfaceData.num_views) : null,
    errors: surfaceData.errors ? errorsOf(surfaceData.errors) : null,
    supports: surfaceData.supports ? bytesOf(surfaceData.supports) : null,
  };
  const middle = sceneData.middle
    ? { center: vectorOf(sceneData.middle.center), radius: sceneData.middle.radius } : middleOf(positions);

  // Faces do not share corners, because support belongs to faces.
  const cornerPositions = new Float32Array(3 * surface.corners.length);
  for (let i = 0; i < surface.corners.length; ++i) {
    const from = 3 * surface.corners[i];
    cornerPositions[3 * i] = positions[from];
    cornerPositions[3 * i + 1] = positions[from + 1];
    cornerPositions[3 * i + 2] = positions[from + 2];
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(cornerPositions, 3));
  const material = surfaceMaterial(null);
  const layers = { surface: new THREE.Mesh(geometry, material) };

  function makeLayer(name) {
    const made = new THREE.BufferGeometry();
    if (name === "wireframe") {
      const corners = surface.corners;
      const edges = new Uint32Array(2 * corners.length);
      for (let i = 0; i < corners.length; ++i) {
        edges[2 * i] = corners[i];
        edges[2 * i + 1] = corners[i % 3 === 2 ? i - 2 : i + 1];
      }
      made.setAttribute("position", new THREE.BufferAttribute(positions, 3));
      made.setIndex(new THREE.BufferAttribute(edges, 1));
      return new THREE.LineSegments(made, new THREE.LineBasicMaterial({ transparent: true, opacity: 0.45 }));
    }
    if (name === "removed") return removedFaces(sceneData.removed);
    if (name === "points") {
      made.setAttribute("position", new THREE.BufferAttribute(positionsOf(sceneData.points.positions), 3));
      made.setAttribute("color", new THREE.BufferAttribute(bytesOf(sceneData.points.colors), 3, true));
      return new THREE.Points(made, new THREE.PointsMaterial({
        size: 2.5 * renderer.getPixelRatio(), sizeAttenuation: false, vertexColors: THREE.VertexColors }));
    }
    made.setAttribute("position", new THREE.BufferAttribute(frustumLines(views, 0.07 * middle.radius), 3));
    return new THREE.LineSegments(made, new THREE.LineBasicMaterial());
  }

  const shown = { surface: true, wireframe: false, points: false, cameras: false, backs: true, removed: false };
  let mode = "rgb";
  const state = { position: new THREE.Vector3(), target: new THREE.Vector3(), up: up.clone(), fov: 45, view: null };
  let pending = false;
  let marked = null; // a position and the element that follows it
  let textured = null;
  let cut = null;    // the surface split into small faces, see distance.js

  function style(name) { return getComputedStyle(document.documentElement).getPropertyValue(name).trim(); }

  function draw() {
    pending = false;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (width === 0 || height === 0) return;
    renderer.setSize(width, height, false);
    renderer.setClearColor(new THREE.Color(style("--canvas")));
    const view = state.view === null ? null : views[state.view];
    camera.fov = state.fov;
    camera.aspect = width / height;
    frame.hidden = !(view && view.half_size);
    if (view && view.half_size) {
      // Show the whole image with a small margin.
      const half = 1.08 * Math.max(view.half_size[1], view.half_size[0] / camera.aspect);
      camera.fov = 2 * Math.atan(half) * 180 / Math.PI;
      const scale = height / (2 * half);
      frame.style.width = 2 * scale * view.half_size[0] + "px";
      frame.style.height = 2 * scale * view.half_size[1] + "px";
      frame.style.left = width / 2 - scale * view.half_size[0] + "px";
      frame.style.top = height / 2 - scale * view.half_size[1] + "px";
    }
    camera.position.copy(state.position);
    camera.up.copy(state.up);
    camera.lookAt(state.target);
    const distance = state.position.distanceTo(state.target);
    camera.near = 0.01 * Math.min(distance, middle.radius);
    camera.far = 100 * (state.position.distanceTo(middle.center) + middle.radius);
    camera.updateProjectionMatrix();
    for (const name of ["wireframe", "cameras"]) {
      if (layers[name]) layers[name].material.color.set(style(name === "cameras" ? "--frame" : "--ink"));
    }
    renderer.render(scene, camera);
    if (marked) {
      const at = marked.place.clone().project(camera);
      marked.element.hidden = Math.abs(at.x) > 1 || Math.abs(at.y) > 1 || at.z > 1;
      marked.element.style.left = (0.5 + 0.5 * at.x) * width + "px";
      marked.element.style.top = (0.5 - 0.5 * at.y) * height + "px";
    }
  }
  function redraw() {
    if (!pending) { pending = true; requestAnimationFrame(draw); }
  }
  function moved() {
    redraw();
    if (changed) changed(state);
  }

  // ---- moving

  function leaveEyes() {
    if (state.view === null) return;
    state.fov = Math.min(camera.fov, 75);
    state.view = null;
  }
  function orbit(turn, tilt) {
    leaveEyes();
    const arm = state.position.clone().sub(state.target).applyAxisAngle(state.up, turn);
    const from = arm.angleTo(state.up);
    const to = Math.min(Math.max(from - tilt, 0.03), Math.PI - 0.03);
    const side = state.up.clone().cross(arm).normalize();
    arm.applyAxisAngle(side, to - from);
    state.position.copy(state.target).add(arm);
    moved();
  }
  function zoom(factor) {
    leaveEyes();
    const arm = state.position.clone().sub(state.target);
    arm.setLength(Math.min(Math.max(arm.length() * factor, 1e-4 * middle.radius), 50 * middle.radius));
    state.position.copy(state.target).add(arm);
    moved();
  }
  function shift(x, y) { // in canvas heights
    leaveEyes();
    const arm = state.position.clone().sub(state.target);
    const length = 2 * arm.length() * Math.tan(state.fov * Math.PI / 360);
    const right = state.up.clone().cross(arm).normalize();
    const above = arm.clone().cross(right).normalize();
    const by = right.multiplyScalar(-x * length).add(above.multiplyScalar(y * length));
    state.position.add(by);
    state.target.add(by);
    moved();
  }
  function lookFrom(direction) {
    state.view = null;
    state.fov = 45;
    state.up.copy(up);
    state.target.copy(middle.center);
    const aspect = canvas.clientWidth / Math.max(canvas.clientHeight, 1);
    const half = Math.atan(Math.tan(22.5 * Math.PI / 180) * Math.min(aspect, 1));
    state.position.copy(middle.center).addScaledVector(direction.normalize(), 1.05 * middle.radius / Math.sin(half));
    moved();
  }
  function overview() {
    // From the side of the cameras if they are on one side, else from the first camera.
    const eyes = new THREE.Vector3();
    for (const view of views) eyes.addScaledVector(vectorOf(view.center), 1 / views.length);
    let direction = eyes.sub(middle.center);
    if (direction.length() < 0.3 * middle.radius && views.length > 0) {
      direction = vectorOf(views[0].center).sub(middle.center);
    }
    direction.projectOnPlane(up);
    if (direction.length() < 1e-9) direction = new THREE.Vector3(up.y, up.z, up.x).projectOnPlane(up);
    lookFrom(direction.normalize().addScaledVector(up, 0.55));
  }
  function top() {
    const direction = views.length > 0 ? vectorOf(views[0].forward).projectOnPlane(up) : new THREE.Vector3(1, 0, 0);
    lookFrom(up.clone().addScaledVector(direction, -0.05));
  }
  function distanceBefore(view) {
    const depth = middle.center.clone().sub(vectorOf(view.center)).dot(vectorOf(view.forward));
    return Math.max(depth, 0.2 * middle.radius);
  }
  function through(number, depth) {
    const view = views[number];
    state.view = number;
    state.up.copy(vectorOf(view.down)).negate();
    state.position.copy(vectorOf(view.center));
    state.target.copy(state.position).addScaledVector(vectorOf(view.forward), depth || distanceBefore(view));
    moved();
  }
  /// The start view: like the view that sees most, slightly farther back, upright.
  function start() {
    const first = sceneData.start;
    if (!first) return overview();
    const view = views[first.view];
    const forward = vectorOf(view.forward);
    state.view = null;
    state.fov = 55;
    state.up.copy(up);
    state.target.copy(vectorOf(view.center)).addScaledVector(forward, first.depth);
    state.position.copy(vectorOf(view.center)).addScaledVector(forward, -0.15 * first.depth);
    moved();
  }
  /// Moves to look at a position from a direction and distance.
  function flyTo(place, towards, distance) {
    state.view = null;
    state.fov = 45;
    state.up.copy(up);
    // Not exactly along the up direction, where up would be undefined.
    const from = towards.clone();
    if (from.clone().cross(up).length() < 0.05) from.add(new THREE.Vector3(up.y, up.z, up.x).multiplyScalar(0.1)).normalize();
    state.target.copy(place);
    state.position.copy(place).addScaledVector(from, distance);
    moved();
  }
  /// Keeps an element at a position; null unsets it.
  function mark(element, place) {
    if (marked) marked.element.hidden = true;
    marked = place ? { element, place } : null;
    redraw();
  }
  function centerAt(x, y) {
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(2 * x / canvas.clientWidth - 1, 1 - 2 * y / canvas.clientHeight), camera);
    const hit = caster.intersectObject(layers.surface)[0];
    if (!hit) return;
    leaveEyes();
    state.position.add(hit.point.clone().sub(state.target));
    state.target.copy(hit.point);
    // Move closer, so that a second double click zooms in again.
    const arm = state.position.clone().sub(state.target);
    state.position.copy(state.target).addScaledVector(arm, 0.6);
    moved();
  }

  // ---- mouse, fingers, keys

  const pointers = new Map();
  let lastTap = null;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = place(event), height = canvas.clientHeight;
    const x = (now.x - before.x) / height, y = (now.y - before.y) / height;
    if (pointers.size === 2) {
      const other = Array.from(pointers).find(([id]) => id !== event.pointerId)[1];
      const apart = (p) => Math.max(Math.hypot(p.x - other.x, p.y - other.y), 1);
      zoom(apart(before) / apart(now));
      shift(x / 2, y / 2);
    } else if (event.buttons & 2 || event.shiftKey) {
      shift(x, y);
    } else if (x !== 0 || y !== 0) {
      orbit(-Math.PI * x, Math.PI * y);
    }
    pointers.set(event.pointerId, now);
  });
  for (const name of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(name, (event) => {
      pointers.delete(event.pointerId);
      if (name !== "pointerup" || event.pointerType !== "touch") return;
      const tap = Object.assign(place(event), { time: event.timeStamp });
      if (lastTap && tap.time - lastTap.time < 350 && Math.hypot(tap.x - lastTap.x, tap.y - lastTap.y) < 25) {
        centerAt(tap.x, tap.y);
      }
      lastTap = tap;
    });
  }
  canvas.addEventListener("dblclick", (event) => { const at = place(event); centerAt(at.x, at.y); });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(Math.min(Math.max(event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015), -0.5), 0.5)));
  }, { passive: false });

  function onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    const turn = 0.09, step = 0.06;
    const arrows = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const arrow = arrows[event.key];
    if (arrow && event.shiftKey) shift(step * arrow[0], step * arrow[1]);
    else if (arrow) orbit(turn * arrow[0], turn * arrow[1]);
    else if (event.key === "+" || event.key === "=") zoom(0.85);
    else if (event.key === "-") zoom(1 / 0.85);
    else if (event.key === "0") overview();
    else return false;
    return true;
  }
  canvas.addEventListener("keydown", (event) => { if (onKey(event)) event.preventDefault(); });

  // ---- what is shown

  function show(name, on) {
    shown[name] = on;
    if (name === "backs") {
      for (const one of [material, ...(textured ? textured.materials : [])]) {
        one.side = on ? THREE.DoubleSide : THREE.FrontSide;
        one.needsUpdate = true;
      }
    } else {
      if (on && !layers[name]) layers[name] = makeLayer(name);
      if (on) scene.add(layers[name]); else if (layers[name]) scene.remove(layers[name]);
    }
    redraw();
  }
  function colorBy(wanted) {
    const isDistance = wanted === "distance" && Boolean(surfaceData.distances);
    mode = wanted === "distance" && !isDistance ? "plain" : wanted;
    if (isDistance && !cut) cut = cutByDistance(positions, surface.corners, surfaceData.distances, sceneData.scale);
    const isTextured = mode === "texture" && Boolean(surfaceData.texture);
    if (isTextured && !textured) textured = texturedSurface(surfaceData.texture, cornerPositions, redraw);
    layers.surface.material = isTextured ? textured.materials : material;
    if (isTextured) {
      layers.surface.geometry = textured.geometry;
      redraw();
      return null;
    }
    const made = isDistance ? cut : coloring(mode, surface);
    if (!isDistance) geometry.setAttribute("color", new THREE.BufferAttribute(made.colors, 3, true));
    layers.surface.geometry = isDistance ? cut.geometry : geometry;
    material.uniforms.ownBacks.value = isDistance ? 1 : 0;
    material.uniforms.byNormal.value = mode === "normal" ? 1 : 0;
    material.uniforms.contrast.value = mode === "rgb" ? 0.3 : mode === "normal" ? 0.1 : wanted === "distance" ? 0.45 : mode === "plain" ? 0.6 : 0.35;
    redraw();
    return made.legend;
  }

  scene.add(layers.surface);
  const resizes = new ResizeObserver(redraw);
  resizes.observe(canvas);
  const scheme = window.matchMedia("(prefers-color-scheme: dark)");
  scheme.addEventListener("change", redraw);

  return {
    state, shown, show, colorBy, overview, top, through, start, draw, flyTo, mark,
    follow(other) {
      state.position.copy(other.position); state.target.copy(other.target); state.up.copy(other.up);
      state.fov = other.fov; state.view = other.view;
      redraw();
    },
    /// Frees the WebGL context; browsers allow only about ten.
    dispose() {
      resizes.disconnect();
      scheme.removeEventListener("change", redraw);
      renderer.dispose();
      renderer.forceContextLoss();
    },
  };
}
