// A solver of a page: position based dynamics (Macklin, Müller, Chentanez, "XPBD", 2016) with small steps. Cloth is edges
// that keep their length, a soft body a cloud that is drawn to its shape (Müller et al., "Meshless deformations based on
// shape matching", 2005). Contacts are tact's points: where two surfaces are nearest, weights, a normal and a gap.

export const SMALL_STEPS = 6;
const GRAVITY = -9.8, SOFTNESS = 0.12, STRETCH = 2e-7, BEND = 2e-4;
const FASTEST = 7;          // m/s: a body goes no farther in a step than contact points see
const SLOWEST_WAY_OUT = 0.8;  // m/s: how fast surfaces that have crossed come apart

export class Solver {
  constructor(capacity) {
    this.before = new Float64Array(3 * capacity);   // positions of the last small step
    this.detected = new Float64Array(3 * capacity);  // positions that the contacts are of
    this.velocities = new Float64Array(3 * capacity);
    this.lightness = new Float64Array(capacity);    // one over the mass; 0 stands still
    this.contacts = { count: 0 };
    this.pull = null;
  }

  /** One step of `dt` seconds; `x`: positions of all vertices. */
  step(x, end, bodies, dt, { friction, thickness }) {
    const h = dt / SMALL_STEPS, { velocities: v, before, lightness: w } = this;
    for (let small = 0; small < SMALL_STEPS; ++small) {
      for (let i = 0; i < end; ++i) {
        const at = 3 * i;
        before[at] = x[at], before[at + 1] = x[at + 1], before[at + 2] = x[at + 2];
        if (w[i] === 0) continue;
        v[at + 2] += GRAVITY * h;
        const speed = Math.hypot(v[at], v[at + 1], v[at + 2]), part = speed > FASTEST ? FASTEST / speed : 1;
        for (let k = at; k < at + 3; ++k) x[k] += (v[k] *= part) * h;
      }
      for (const body of bodies) body.rest ? this.#match(x, body) : this.#keepLengths(x, body, h);
      if (this.pull) this.#pull(x);
      this.#push(x, h, friction, thickness);
      for (const { first, count, damping } of bodies) {
        for (let k = 3 * first; k < 3 * (first + count); ++k) v[k] = ((x[k] - before[k]) / h) * damping;
      }
    }
  }

  #keepLengths(x, { first, edges, lengths, soft }, h) {
    const w = this.lightness;
    for (let e = 0; e < lengths.length; ++e) {
      const i = first + edges[2 * e], j = first + edges[2 * e + 1], a = 3 * i, b = 3 * j, mass = w[i] + w[j];
      if (mass === 0) continue;
      const dx = x[b] - x[a], dy = x[b + 1] - x[a + 1], dz = x[b + 2] - x[a + 2], length = Math.hypot(dx, dy, dz) || 1e-9;
      const compliance = e < soft ? STRETCH : BEND, s = (length - lengths[e]) / (mass + compliance / (h * h)) / length;
      const si = s * w[i], sj = s * w[j];
      x[a] += si * dx, x[a + 1] += si * dy, x[a + 2] += si * dz;
      x[b] -= sj * dx, x[b + 1] -= sj * dy, x[b + 2] -= sj * dz;
    }
  }

  /** Draws a body towards its shape, placed where it fits best. */
  #match(x, body) {
    const { first, count, rest, turn } = body;
    let cx = 0, cy = 0, cz = 0;
    for (let i = 3 * first; i < 3 * (first + count); i += 3) cx += x[i], cy += x[i + 1], cz += x[i + 2];
    cx /= count, cy /= count, cz /= count;
    const m = [0, 0, 0, 0, 0, 0, 0, 0, 0];
    for (let i = 0; i < count; ++i) {
      const at = 3 * (first + i), px = x[at] - cx, py = x[at + 1] - cy, pz = x[at + 2] - cz;
      for (let k = 0; k < 3; ++k) {
        const q = rest[3 * i + k];
        m[k] += px * q, m[3 + k] += py * q, m[6 + k] += pz * q;
      }
    }
    const r = rotationOf(m, turn);
    for (let i = 0; i < count; ++i) {
      const at = 3 * (first + i), a = rest[3 * i], b = rest[3 * i + 1], c = rest[3 * i + 2];
      x[at] += SOFTNESS * (cx + r[0] * a + r[1] * b + r[2] * c - x[at]);
      x[at + 1] += SOFTNESS * (cy + r[3] * a + r[4] * b + r[5] * c - x[at + 1]);
      x[at + 2] += SOFTNESS * (cz + r[6] * a + r[7] * b + r[8] * c - x[at + 2]);
    }
  }

  /** What the mouse holds follows it. */
  #pull(x) {
    const { vertices, weights, target } = this.pull, w = this.lightness;
    const mass = vertices.reduce((sum, v, k) => sum + weights[k] * weights[k] * w[v], 0);
    if (mass === 0) return;
    for (let axis = 0; axis < 3; ++axis) {
      const at = vertices.reduce((sum, v, k) => sum + weights[k] * x[3 * v + axis], 0);
      const way = Math.max(-0.02, Math.min(0.02, 0.25 * (target[axis] - at))) / mass;  // 7 m/s at most
      vertices.forEach((v, k) => { x[3 * v + axis] += way * weights[k] * w[v]; });
    }
  }

  /** Takes the points of a step of tact; `firstOf`: by index of body the first vertex, -1 for the floor. */
  take(points, firstOf, x, end) {
    this.detected.set(x.subarray(0, 3 * end));
    const { count, bodies, aVertices, bVertices, aWeights, bWeights, normals, gaps } = points;
    const vertices = new Int32Array(6 * count), weights = new Float64Array(6 * count);
    for (let p = 0; p < count; ++p) for (let k = 0; k < 3; ++k) {
      const a = aVertices[3 * p + k], b = bVertices[3 * p + k], fa = firstOf[bodies[2 * p]], fb = firstOf[bodies[2 * p + 1]];
      vertices[6 * p + k] = a < 0 || fa < 0 ? -1 : fa + a;
      vertices[6 * p + 3 + k] = b < 0 || fb < 0 ? -1 : fb + b;
      weights[6 * p + k] = -aWeights[3 * p + k];
      weights[6 * p + 3 + k] = bWeights[3 * p + k];
    }
    this.contacts = { count, vertices, weights, normals, gaps };
  }

  /** Keeps the gaps above `thickness`, with friction of Coulomb's kind. */
  #push(x, h, friction, thickness) {
    const { count, vertices, weights, normals, gaps } = this.contacts, { detected, before, lightness } = this;
    for (let p = 0; p < count; ++p) {
      const nx = normals[3 * p], ny = normals[3 * p + 1], nz = normals[3 * p + 2];
      let gap = gaps[p] - thickness, mass = 0, tx = 0, ty = 0, tz = 0;
      for (let k = 6 * p; k < 6 * p + 6; ++k) {
        const v = vertices[k];
        if (v < 0) continue;
        const w = weights[k], at = 3 * v;
        gap += w * (nx * (x[at] - detected[at]) + ny * (x[at + 1] - detected[at + 1]) + nz * (x[at + 2] - detected[at + 2]));
        tx += w * (x[at] - before[at]), ty += w * (x[at + 1] - before[at + 1]), tz += w * (x[at + 2] - before[at + 2]);
        mass += w * w * lightness[v];
      }
      if (gap >= 0 || mass === 0) continue;
      const along = tx * nx + ty * ny + tz * nz;
      const push = Math.min(-gap, Math.max(-along, 0) + SLOWEST_WAY_OUT * h) / mass;
      tx -= along * nx, ty -= along * ny, tz -= along * nz;
      const slid = Math.hypot(tx, ty, tz), hold = slid > 0 ? Math.min(1 / mass, (friction * push) / slid) : 0;
      for (let k = 6 * p; k < 6 * p + 6; ++k) {
        const v = vertices[k];
        if (v < 0) continue;
        const s = weights[k] * lightness[v], at = 3 * v;
        x[at] += s * (push * nx - hold * tx), x[at + 1] += s * (push * ny - hold * ty), x[at + 2] += s * (push * nz - hold * tz);
      }
    }
  }
}

/** The rotation nearest to a matrix, from that of the last step (Müller et al., "A robust method to extract the rotational
 *  part of deformations", 2016). `turn`: a quaternion x, y, z, w, which is carried on. */
function rotationOf(m, turn) {
  for (let round = 0; round < 4; ++round) {
    const r = matrixOf(turn);
    let ox = 0, oy = 0, oz = 0, size = 1e-9;
    for (let k = 0; k < 3; ++k) {
      const rx = r[k], ry = r[3 + k], rz = r[6 + k], ax = m[k], ay = m[3 + k], az = m[6 + k];
      ox += ry * az - rz * ay, oy += rz * ax - rx * az, oz += rx * ay - ry * ax;
      size += rx * ax + ry * ay + rz * az;
    }
    ox /= Math.abs(size), oy /= Math.abs(size), oz /= Math.abs(size);
    const angle = Math.hypot(ox, oy, oz);
    if (angle < 1e-7) break;
    const s = Math.sin(angle / 2) / angle, [x, y, z, w] = turn, c = Math.cos(angle / 2), a = ox * s, b = oy * s, d = oz * s;
    turn[0] = c * x + a * w + b * z - d * y;
    turn[1] = c * y - a * z + b * w + d * x;
    turn[2] = c * z + a * y - b * x + d * w;
    turn[3] = c * w - a * x - b * y - d * z;
    const length = Math.hypot(...turn);
    for (let k = 0; k < 4; ++k) turn[k] /= length;
  }
  return matrixOf(turn);
}
function matrixOf([x, y, z, w]) {
  return [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)];
}
