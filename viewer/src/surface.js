// The surfaces of all bodies in one draw call: positions, outcomes and looks come from textures, so that a step changes
// textures alone. The same geometry drawn with numbers for colours tells which facet is under the mouse.
import * as THREE from "three";
import { OUTCOMES } from "./run.js";

const kWidth = 2048; // texels in a row

const COMMON = `
  precision highp float;
  precision highp int;
  precision highp sampler2D;
`;

const VERTEX = `
  ${COMMON}
  uniform mat4 modelViewMatrix, projectionMatrix;
  uniform sampler2D positions, facets, looks;
  uniform float pass;  // 0: opaque bodies, 1: transparent ones, 2: all, for picking, 3: what meets, behind the others
  in uint position;    // the number of the vertex
  in uint body;
  out vec3 place;
  out vec3 corner;
  flat out vec4 look;
  flat out vec4 facet;
  flat out uint number;
  vec4 texel(sampler2D from, int i) { return texelFetch(from, ivec2(i % ${kWidth}, i / ${kWidth}), 0); }
  void main() {
    int f = gl_VertexID / 3, k = gl_VertexID % 3;
    number = uint(f);
    look = texel(looks, int(body));
    facet = texel(facets, f);
    corner = vec3(k == 0, k == 1, k == 2);
    vec4 seen = modelViewMatrix * vec4(texel(positions, int(position)).xyz, 1.0);
    place = seen.xyz;
    gl_Position = projectionMatrix * seen;
    bool met = facet.r * 255.0 > ${OUTCOMES.length - 1}.0 - 0.5;
    bool hidden = look.a < 0.01 || (pass == 3.0 && !met) || (pass == 0.0 && look.a < 0.99) || (pass == 1.0 && look.a >= 0.99);
    if (hidden) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  }
`;

const FRAGMENT = `
  ${COMMON}
  uniform vec3 outcomeColors[${OUTCOMES.length}];
  uniform float colouring;  // 0: bodies, 1: outcomes, 2: clusters
  uniform float wire;
  uniform vec3 up;          // in view space
  in vec3 place;
  in vec3 corner;
  flat in vec4 look;
  flat in vec4 facet;
  flat in uint number;
  out vec4 color;
  vec3 hue(float h) { return 0.5 + 0.42 * cos(6.2832 * (h + vec3(0.0, 0.33, 0.67))); }
  void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    if (normal.z < 0.0) normal = -normal;
    float key = max(dot(normal, normalize(vec3(-0.45, 0.65, 0.75))), 0.0);
    float fill = max(dot(normal, normalize(vec3(0.8, 0.1, 0.5))), 0.0);
    float light = 0.34 + 0.58 * key + 0.16 * fill + 0.12 * dot(normal, up);
    int outcome = int(facet.r * 255.0 + 0.5);
    vec3 base = look.rgb;
    float alpha = look.a;
    if (colouring > 1.5) base = mix(hue(facet.g * 0.9961), vec3(0.9), 0.15);
    else if (colouring > 0.5 && outcome > 0) {
      base = mix(outcomeColors[outcome], look.rgb, outcome < 5 ? 0.25 : 0.0);
      light = mix(light, 1.0, outcome > 5 ? 0.35 : outcome > 4 ? 0.15 : 0.0);
      if (outcome > 4) alpha = max(alpha, 0.9);
    }
    vec3 shaded = base * light;
    vec3 d = fwidth(corner);
    vec3 edge = smoothstep(vec3(0.0), d * 1.4, corner);
    float line = 1.0 - min(min(edge.x, edge.y), edge.z);
    float dense = clamp(1.6 * max(max(d.x, d.y), d.z), 0.0, 1.0);  // of facets of few pixels there are only lines
    shaded = mix(shaded, shaded * 0.45, line * mix(0.55 * wire, 0.0, dense));
    if (facet.b > 0.9) shaded = mix(shaded, vec3(1.0), 0.55);
    else if (facet.b > 0.4) shaded = mix(shaded, vec3(1.0, 1.0, 0.9), 0.22);
    color = vec4(pow(shaded, vec3(0.4545)), alpha);
  }
`;

const BEHIND = `
  ${COMMON}
  uniform vec3 outcomeColors[${OUTCOMES.length}];
  in vec3 place;
  in vec3 corner;
  flat in vec4 look;
  flat in vec4 facet;
  flat in uint number;
  out vec4 color;
  void main() {
    vec3 d = fwidth(corner);
    vec3 edge = smoothstep(vec3(0.0), d * 1.4, corner);
    float line = 1.0 - min(min(edge.x, edge.y), edge.z);
    color = vec4(pow(outcomeColors[${OUTCOMES.length - 1}], vec3(0.4545)), 0.1 + 0.24 * line);
  }
`;

const NUMBERS = `
  ${COMMON}
  in vec3 place;
  in vec3 corner;
  flat in vec4 look;
  flat in vec4 facet;
  flat in uint number;
  out vec4 color;
  void main() {
    uint n = number + 1u;
    color = vec4(n & 255u, (n >> 8) & 255u, (n >> 16) & 255u, (n >> 24) & 255u) / 255.0;
  }
`;

function texture(count, array, type, format, internal) {
  const height = Math.max(1, Math.ceil(count / kWidth));
  const made = new THREE.DataTexture(new array(4 * kWidth * height), kWidth, height, format, type);
  made.internalFormat = internal;
  made.needsUpdate = true;
  return made;
}

const bytes = (count) => texture(count, Uint8Array, THREE.UnsignedByteType, THREE.RGBAFormat, "RGBA8");

export class Surface {
  constructor(run) {
    this.run = run;
    this.positions = texture(run.vertices, Float32Array, THREE.FloatType, THREE.RGBAFormat, "RGBA32F");
    this.facets = bytes(run.facets);
    this.looks = bytes(run.bodies.length);
    this.shared = {
      positions: { value: this.positions },
      facets: { value: this.facets },
      looks: { value: this.looks },
      outcomeColors: { value: OUTCOMES.map((outcome) => new THREE.Color(...outcome.color)).map((c) => c.convertSRGBToLinear()) },
      colouring: { value: 1 },
      wire: { value: 1 },
      up: { value: new THREE.Vector3(0, 0, 1) },
    };
    this.boxes = new Map(); // of bodies, as they were placed last
    this.geometry = this.makeGeometry();
    this.opaque = this.makeMesh(0, FRAGMENT, {});
    this.transparent = this.makeMesh(1, FRAGMENT, { transparent: true, depthWrite: false });
    this.transparent.renderOrder = 2;
    // Bodies hide where they meet: it shows through.
    this.behind = this.makeMesh(3, BEHIND, { transparent: true, depthTest: false, depthWrite: false });
    this.behind.renderOrder = 1;
    this.numbered = this.makeMesh(2, NUMBERS, { blending: THREE.NoBlending });
  }

  makeGeometry() {
    const { bodies, facets } = this.run;
    const vertex = new Uint32Array(3 * facets), owner = new Uint32Array(3 * facets);
    bodies.forEach((body, i) => {
      const begin = 3 * body.firstFacet;
      for (let k = 0; k < body.corners.length; ++k) vertex[begin + k] = body.firstVertex + body.corners[k];
      owner.fill(i, begin, begin + body.corners.length);
    });
    const geometry = new THREE.BufferGeometry();
    for (const [name, array] of [["position", vertex], ["body", owner]]) {
      const attribute = new THREE.BufferAttribute(array, 1);
      attribute.gpuType = THREE.IntType;
      geometry.setAttribute(name, attribute);
    }
    geometry.boundingSphere = new THREE.Sphere(); // not asked for: nothing is culled
    return geometry;
  }

  makeMesh(pass, fragmentShader, options) {
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: VERTEX,
      fragmentShader,
      uniforms: { ...this.shared, pass: { value: pass } },
      side: THREE.DoubleSide,
      ...options,
    });
    const mesh = new THREE.Mesh(this.geometry, material);
    mesh.frustumCulled = false;
    return mesh;
  }

  /** Puts all bodies where they are in a frame; `center` is what the scene is drawn around. */
  place(frame, center) {
    const to = this.positions.image.data;
    this.run.bodies.forEach((body, i) => {
      const from = frame.positions[i];
      if (from === null) return;
      const [x, y, z] = body.origin.map((o, k) => o - center[k]), step = body.step;
      for (let k = 0, at = 4 * body.firstVertex; k < from.length; k += 3, at += 4) {
        to[at] = x + step * from[k];
        to[at + 1] = y + step * from[k + 1];
        to[at + 2] = z + step * from[k + 2];
      }
    });
    this.positions.needsUpdate = true;
    this.boxes.clear();
  }

  /** A vertex where it was placed. */
  vertex(body, vertex, to = new THREE.Vector3()) {
    return to.fromArray(this.positions.image.data, 4 * (this.run.bodies[body].firstVertex + vertex));
  }

  /** The corners of a facet where they were placed. */
  triangle(body, facet) {
    const corners = this.run.bodies[body].corners;
    return [0, 1, 2].map((k) => this.vertex(body, corners[3 * facet + k]));
  }

  centroid(body, facet) {
    const [p, q, r] = this.triangle(body, facet);
    return p.add(q).add(r).divideScalar(3);
  }

  /** The box of a body where it was placed; the caller's to change. */
  box(body) {
    if (!this.boxes.has(body)) this.boxes.set(body, this.findBox(body));
    return this.boxes.get(body).clone();
  }

  findBox(body) {
    const { firstVertex, vertices } = this.run.bodies[body], at = this.positions.image.data;
    const box = new THREE.Box3(), used = this.usedVertices(body), p = new THREE.Vector3();
    for (let v = 0; v < vertices; ++v) {
      if (used[v]) box.expandByPoint(p.fromArray(at, 4 * (firstVertex + v)));
    }
    return box;
  }

  usedVertices(body) {
    const b = this.run.bodies[body];
    if (b.used === undefined) {
      b.used = new Uint8Array(b.vertices);
      for (const list of [b.corners, b.edges ?? [], b.points ?? []]) for (const v of list) b.used[v] = 1;
    }
    return b.used;
  }

  /** Outcomes of facets: the farthest that each came in the given contacts. */
  showOutcomes(contacts) {
    const to = this.facets.image.data, { bodies } = this.run;
    for (let i = 0; i < to.length; i += 4) to[i] = 0;
    const apply = (runs, body) => {
      if (runs === null) return;
      let facet = bodies[body].firstFacet;
      for (let i = 0; i < runs.length; i += 2) {
        const end = facet + runs[i], outcome = runs[i + 1];
        for (; facet < end; ++facet) if (outcome > to[4 * facet]) to[4 * facet] = outcome;
      }
    };
    for (const contact of contacts) {
      apply(contact.outcomesA, contact.a);
      apply(contact.outcomesB, contact.b);
      if (contact.outcomesA !== null) continue;
      for (let i = 0; i < contact.pairs.length; ++i) { // a body with itself, or with a plane, which has no facets here
        const body = bodies[i % 2 === 0 ? contact.a : contact.b];
        if (!body.plane) to[4 * (body.firstFacet + contact.pairs[i])] = OUTCOMES.length - 1;
      }
    }
    this.facets.needsUpdate = true;
  }

  /** Neighbouring clusters get colours that differ. */
  showClusters(frame) {
    const to = this.facets.image.data;
    this.run.bodies.forEach((body, i) => {
      const clusters = this.run.clustersOf(i, frame);
      for (let f = 0; f < body.facets; ++f) {
        to[4 * (body.firstFacet + f) + 1] = clusters === null ? 0 : (clusters[f] * 97 + i * 31) % 256;
      }
    });
    this.facets.needsUpdate = true;
  }

  /** Marks the picked facet, and those that it meets. */
  highlight(picked, others) {
    const to = this.facets.image.data;
    for (let i = 2; i < to.length; i += 4) to[i] = 0;
    for (const facet of others) to[4 * facet + 2] = 128;
    if (picked !== null) to[4 * picked + 2] = 255;
    this.facets.needsUpdate = true;
  }

  /** Colours as numbers from 0 to 1, and how opaque each body is; 0: hidden. */
  look(colors, opacities) {
    const to = this.looks.image.data;
    colors.forEach((color, i) => {
      const linear = new THREE.Color(...color).convertSRGBToLinear();
      for (let k = 0; k < 3; ++k) to[4 * i + k] = Math.round(255 * [linear.r, linear.g, linear.b][k]);
      to[4 * i + 3] = Math.round(255 * opacities[i]);
    });
    this.transparent.visible = opacities.some((o) => o > 0 && o < 1);
    this.looks.needsUpdate = true;
  }
}
