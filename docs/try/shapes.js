// Meshes: a vertex is three numbers, a facet three indices, counter-clockwise seen from outside.

/** A sheet of `cells` x `cells` squares, each of two facets. */
export function sheet(cells, size) {
  const positions = [], facets = [], n = cells + 1;
  for (let row = 0; row < n; ++row) for (let column = 0; column < n; ++column) {
    positions.push((column / cells - 0.5) * size, (row / cells - 0.5) * size, 0);
  }
  for (let row = 0; row < cells; ++row) for (let column = 0; column < cells; ++column) {
    const v = row * n + column;
    if ((row + column) % 2) facets.push(v, v + 1, v + n, v + 1, v + n + 1, v + n);
    else facets.push(v, v + 1, v + n + 1, v, v + n + 1, v + n);
  }
  return { positions, facets };
}

/** A surface over a cube's grid of `cells` squares an edge, moved by `shape`: a box, a ball or what lies between. */
function overCube(cells, shape) {
  const positions = [], facets = [], known = new Map();
  const vertex = (p) => {
    const key = p.join();
    if (!known.has(key)) {
      known.set(key, positions.length / 3);
      positions.push(...shape(p.map((x) => (2 * x) / cells - 1)));
    }
    return known.get(key);
  };
  for (let axis = 0; axis < 3; ++axis) for (const end of [0, cells]) {
    const at = (u, v) => {
      const p = [0, 0, 0];
      p[axis] = end;
      p[(axis + 1) % 3] = u;
      p[(axis + 2) % 3] = v;
      return vertex(p);
    };
    for (let u = 0; u < cells; ++u) for (let v = 0; v < cells; ++v) {
      const a = at(u, v), b = at(u + 1, v), c = at(u + 1, v + 1), d = at(u, v + 1);
      facets.push(...(end ? [a, b, c, a, c, d] : [a, c, b, a, d, c]));
    }
  }
  return { positions, facets };
}

export function ball(radius) {
  return overCube(3, (p) => {
    const warped = p.map((x) => Math.tan((x * Math.PI) / 4)), length = Math.hypot(...warped);
    return warped.map((x) => (x / length) * radius);
  });
}

/** A box with rounded edges: half of the way from the cube to the ball. */
export function pillow(radius) {
  return overCube(3, (p) => {
    const length = Math.hypot(...p);
    return p.map((x) => 0.6 * radius * x + (0.4 * radius * x) / length);
  });
}

export function ring(radius, thickness, around = 12, across = 5) {
  const positions = [], facets = [];
  for (let i = 0; i < around; ++i) for (let k = 0; k < across; ++k) {
    const u = (2 * Math.PI * i) / around, v = (2 * Math.PI * k) / across, r = radius + thickness * Math.cos(v);
    positions.push(r * Math.cos(u), r * Math.sin(u), thickness * Math.sin(v));
    const a = i * across + k, b = ((i + 1) % around) * across + k;
    const c = ((i + 1) % around) * across + ((k + 1) % across), d = i * across + ((k + 1) % across);
    facets.push(a, b, c, a, c, d);
  }
  return { positions, facets };
}

/** The edges of facets, each once: pairs of vertices. */
export function edgesOf(facets) {
  const known = new Set(), edges = [];
  for (let i = 0; i < facets.length; ++i) {
    const a = facets[i], b = facets[i % 3 === 2 ? i - 2 : i + 1], key = Math.min(a, b) * 65536 + Math.max(a, b);
    if (!known.has(key)) known.add(key), edges.push(a, b);
  }
  return edges;
}
