// SPDX-License-Identifier: BSD-3-Clause
// What is computed of the mesh once: cells as vtk.js has them, the edges that outline the bodies, whose body a node is.

// [n, node, .., n, node, ..]; shift: added to the nodes.
export function cellArray({ offsets, nodes }, shift = 0) {
  const count = offsets.length - 1;
  const out = new Uint32Array(count + nodes.length);
  for (let i = 0, at = 0; i < count; i += 1) {
    out[at] = offsets[i + 1] - offsets[i];
    at += 1;
    for (let k = offsets[i]; k < offsets[i + 1]; k += 1, at += 1) out[at] = nodes[k] + shift;
  }
  return out;
}

// The normal of a polygon, of length 1 (Newell).
function normalOf(points, { offsets, nodes }, i) {
  const n = [0, 0, 0];
  for (let k = offsets[i]; k < offsets[i + 1]; k += 1) {
    const a = 3 * nodes[k];
    const b = 3 * nodes[k + 1 < offsets[i + 1] ? k + 1 : offsets[i]];
    for (let c = 0; c < 3; c += 1) {
      const p = (c + 1) % 3;
      const q = (c + 2) % 3;
      n[c] += (points[a + p] - points[b + p]) * (points[a + q] + points[b + q]);
    }
  }
  const length = Math.hypot(...n) || 1;
  return n.map((value) => value / length);
}

// Edges where a surface ends or bends by more than 30 degrees, as lines of two nodes.
export function outline(points, polygons) {
  const { offsets, nodes } = polygons;
  const seen = new Map();
  const total = points.length / 3;
  for (let i = 0; i + 1 < offsets.length; i += 1) {
    for (let k = offsets[i]; k < offsets[i + 1]; k += 1) {
      const a = nodes[k];
      const b = nodes[k + 1 < offsets[i + 1] ? k + 1 : offsets[i]];
      const key = Math.min(a, b) * total + Math.max(a, b);
      const before = seen.get(key);
      // The first face that has it, -1 once another continues it smoothly.
      if (before === undefined) seen.set(key, i);
      else if (before >= 0) {
        const [m, n] = [normalOf(points, polygons, before), normalOf(points, polygons, i)];
        if (m[0] * n[0] + m[1] * n[1] + m[2] * n[2] > Math.cos(Math.PI / 6)) seen.set(key, -1);
      }
    }
  }
  const lines = [];
  for (const [key, face] of seen) if (face >= 0) lines.push(2, Math.floor(key / total), key % total);
  return Uint32Array.from(lines);
}

// The body of each node, 0 where no face says so, from the faces of bodies.
export function bodyOfNodes(count, { offsets, nodes }, body) {
  const out = new Int32Array(count).fill(-1);
  for (let i = 0; i + 1 < offsets.length; i += 1) {
    for (let k = offsets[i]; k < offsets[i + 1]; k += 1) out[nodes[k]] = body[i];
  }
  return out;
}

export function box(points) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 1) {
    const c = i % 3;
    if (points[i] < low[c]) low[c] = points[i];
    if (points[i] > high[c]) high[c] = points[i];
  }
  return { low, high, size: Math.hypot(...high.map((value, c) => value - low[c])) };
}
