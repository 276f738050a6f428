// Colors by the distance of a surface to another, at the positions of grid_places() in display_mesh.cpp.

/// Returns the number of parts of each edge: the minimum of its faces. All are powers of two, so small
/// faces meet corner to corner and there are no cracks.
function partsOfEdges(corners, parts) {
  const ofEdges = new Map();
  const keyOf = (a, b) => Math.min(a, b) * 16777216 + Math.max(a, b);
  for (let i = 0; i < corners.length; ++i) {
    const key = keyOf(corners[i], corners[i % 3 === 2 ? i - 2 : i + 1]), n = parts[Math.floor(i / 3)];
    const before = ofEdges.get(key);
    if (before === undefined || n < before) ofEdges.set(key, n);
  }
  return (a, b) => ofEdges.get(keyOf(a, b));
}

// From pale (near) to dark (far), so that it is also readable without colors.
const kDistanceRamp = [[232, 230, 222], [250, 214, 116], [241, 142, 60], [212, 66, 84], [152, 36, 118], [82, 24, 128]];

/// Splits the surface into small faces with a color per corner. `scale` is the distance, in diagonals,
/// at which the ramp ends.
function cutByDistance(positions, corners, packed, scale) {
  const parts = bytesOf(packed.parts);
  const ofVertices = errorsOf(packed.vertices); // thousandths of a percent
  const between = errorsOf(packed.between);
  let faces = 0;
  for (const n of parts) faces += n * n;
  const places = new Float32Array(9 * faces);
  const colors = new Uint8Array(9 * faces);
  const table = new Map();
  const colorOf = (value) => {
    if (!table.has(value)) table.set(value, rampColor(value / 1e5 / scale, kDistanceRamp));
    return table.get(value);
  };
  const partsOf = partsOfEdges(corners, parts);
  let corner = 0, next = 0;
  for (let f = 0; f < parts.length; ++f) {
    const n = parts[f], face = [corners[3 * f], corners[3 * f + 1], corners[3 * f + 2]];
    // Row by row in the order of grid_places(), with the corners of the face inserted.
    const rows = [];
    for (let i = 0; i <= n; ++i) {
      rows.push([]);
      for (let j = 0; j <= n - i; ++j) {
        const own = i + j === 0 ? 0 : i === n ? 1 : j === n ? 2 : -1;
        rows[i].push(own >= 0 ? ofVertices[face[own]] : between[next++]);
      }
    }
    // The number of the face's parts per part of an edge, for the sides j = 0, i + j = n and i = 0.
    const steps = [[0, 1], [1, 2], [2, 0]].map(([from, to]) => n / partsOf(face[from], face[to]));
    const put = (i, j) => {
      if (j === 0) i = steps[0] * Math.round(i / steps[0]);
      else if (i + j === n) { j = steps[1] * Math.round(j / steps[1]); i = n - j; }
      else if (i === 0) j = steps[2] * Math.round(j / steps[2]);
      const b = i / n, c = j / n, a = 1 - b - c;
      for (let axis = 0; axis < 3; ++axis) {
        places[3 * corner + axis] = a * positions[3 * face[0] + axis] + b * positions[3 * face[1] + axis] +
          c * positions[3 * face[2] + axis];
      }
      colors.set(colorOf(rows[i][j]), 3 * corner);
      ++corner;
    };
    for (let i = 0; i < n; ++i) {
      for (let j = 0; j < n - i; ++j) {
        put(i, j); put(i + 1, j); put(i, j + 1);
        if (j < n - i - 1) { put(i + 1, j); put(i + 1, j + 1); put(i, j + 1); }
      }
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3, true));
  return { geometry, legend: null };
}
