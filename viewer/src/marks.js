// What is drawn over the surfaces: boxes, hulls, directions, planes, zones, patches and points of contacts.
import * as THREE from "three";
import { ConvexHull } from "three/addons/math/ConvexHull.js";

const COLORS = { boxApart: 0x7c88a3, boxOverlap: 0xffffff, hullA: 0x6fa8ff, hullB: 0xffa56f, direction: 0xffffff, planeA: 0x6fa8ff,
  planeB: 0xffa56f, patch: 0xff6fd0, point: 0x7dffb0, faintPoint: 0x4a7d60, curve: 0xffe14d, chosen: 0xffffff };
const kMostBoxes = 4000, kMostArrows = 60, kMostLines = 5000, kMostPoints = 20000, kMostRoundPoints = 1000; // more arrows are thin lines, in one call
const kMostHullVertices = 20000; // of more, those farthest in some hundred directions stand for the hull
const kUp = new THREE.Vector3(0, 0, 1);

function lines(points, color, opacity = 1) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  const material = new THREE.LineBasicMaterial({ color, transparent: opacity < 1, opacity, depthTest: true });
  return new THREE.LineSegments(geometry, material);
}

// Drawn over what hides it, too, but fainter there.
function seenThrough(object, opacity) {
  const ghost = object.clone();
  ghost.material = object.material.clone();
  ghost.material.depthTest = false;
  ghost.material.transparent = true;
  ghost.material.opacity = opacity;
  ghost.renderOrder = 5;
  const group = new THREE.Group();
  group.add(object, ghost);
  return group;
}

function boxLines(box, to) {
  const c = [box.min, box.max];
  const corner = (i) => [c[i & 1].x, c[(i >> 1) & 1].y, c[(i >> 2) & 1].z];
  for (let i = 0; i < 8; ++i) {
    for (const bit of [1, 2, 4]) if (!(i & bit)) to.push(...corner(i), ...corner(i | bit));
  }
}

function frameAcross(n) {
  return new THREE.Quaternion().setFromUnitVectors(kUp, n);
}

function plane(center, n, size, color, opacity) {
  const group = new THREE.Group();
  const fill = new THREE.Mesh(new THREE.PlaneGeometry(size, size),
    new THREE.MeshBasicMaterial({ color, transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false }));
  const h = size / 2;
  const rim = lines([-h, -h, 0, h, -h, 0, h, -h, 0, h, h, 0, h, h, 0, -h, h, 0, -h, h, 0, -h, -h, 0], color, 0.9);
  fill.renderOrder = 3;
  group.add(fill, rim);
  group.quaternion.copy(frameAcross(n));
  group.position.copy(center);
  return group;
}

function disk(center, n, radius, color, rim) {
  const width = Math.min(0.02 * radius, rim), large = radius > 100 * rim;
  const group = new THREE.Group();
  const fill = new THREE.Mesh(new THREE.CircleGeometry(radius, 64),
    new THREE.MeshBasicMaterial({ color, transparent: true, opacity: large ? 0.05 : 0.22, side: THREE.DoubleSide, depthWrite: false }));
  fill.renderOrder = 4;
  const ring = new THREE.Mesh(new THREE.RingGeometry(radius - width, radius, 96),
    new THREE.MeshBasicMaterial({ color, side: THREE.DoubleSide }));
  group.add(fill, seenThrough(ring, 0.35));
  group.quaternion.copy(frameAcross(n));
  group.position.copy(center);
  return group;
}

function arrow(from, n, length, color) {
  const group = new THREE.Group(), radius = length * 0.018;
  const material = new THREE.MeshBasicMaterial({ color });
  const shaft = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, length * 0.8, 12), material);
  const head = new THREE.Mesh(new THREE.ConeGeometry(radius * 3.2, length * 0.2, 20), material);
  shaft.position.y = length * 0.4;
  head.position.y = length * 0.9;
  group.add(seenThrough(shaft, 0.35), seenThrough(head, 0.35));
  group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), n);
  group.position.copy(from);
  return group;
}

function balls(places, radius, color, chosen) {
  // Of thousands each is a few pixels wide, and round ones would be most of what is drawn.
  const shape = places.length > kMostRoundPoints ? new THREE.OctahedronGeometry(radius) : new THREE.SphereGeometry(radius, 12, 8);
  const mesh = new THREE.InstancedMesh(shape, new THREE.MeshBasicMaterial({ color: 0xffffff }), places.length);
  const matrix = new THREE.Matrix4(), scale = new THREE.Vector3(), none = new THREE.Quaternion();
  places.forEach((place, i) => {
    mesh.setMatrixAt(i, matrix.compose(place, none, scale.setScalar(i === chosen ? 2 : 1)));
    mesh.setColorAt(i, new THREE.Color(i === chosen ? COLORS.chosen : color));
  });
  mesh.frustumCulled = false;
  return mesh;
}

// Of many vertices, those farthest in directions all over the sphere.
function outermost(points) {
  if (points.length <= kMostHullVertices) return points;
  const chosen = new Set(), kDirections = 1500, golden = Math.PI * (3 - Math.sqrt(5));
  for (let i = 0; i < kDirections; ++i) {
    const z = 1 - (2 * i + 1) / kDirections, r = Math.sqrt(1 - z * z);
    const x = r * Math.cos(golden * i), y = r * Math.sin(golden * i);
    let best = 0, highest = -Infinity;
    for (let k = 0; k < points.length; ++k) {
      const height = x * points[k].x + y * points[k].y + z * points[k].z;
      if (height > highest) highest = height, best = k;
    }
    chosen.add(points[best]);
  }
  return [...chosen];
}

function hull(points, color) {
  const positions = [], edges = [];
  try {
    for (const face of new ConvexHull().setFromPoints(outermost(points)).faces) {
      let edge = face.edge;
      do {
        const { point } = edge.head();
        positions.push(point.x, point.y, point.z);
        const tail = edge.tail().point;
        if (face.normal.dot(edge.twin.face.normal) < 0.9995) edges.push(tail.x, tail.y, tail.z, point.x, point.y, point.z);
        edge = edge.next;
      } while (edge !== face.edge);
    }
  } catch {
    return new THREE.Group(); // a flat body has no hull with a volume
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.computeVertexNormals();
  const fill = new THREE.Mesh(geometry,
    new THREE.MeshBasicMaterial({ color, transparent: true, opacity: 0.1, side: THREE.DoubleSide, depthWrite: false }));
  fill.renderOrder = 3;
  const group = new THREE.Group();
  group.add(fill, lines(edges, color, 0.4));
  return group;
}

/** Of more pairs, hulls, planes and zones are shown of the selected one alone. */
export const kMostDetailed = 8;

export class Marks {
  constructor(stage) {
    this.stage = stage;
    this.surface = stage.surface;
    this.group = stage.marks;
    this.points = []; // of those drawn: contact, number, place
  }

  clear() {
    this.group.traverse((object) => {
      object.geometry?.dispose();
      object.material?.dispose();
    });
    this.group.clear();
    this.points = [];
  }

  vector(numbers) {
    return new THREE.Vector3(...numbers.map((x, k) => x - this.stage.center[k]));
  }

  /** Where the facets of a contact are that meet, or its zones, or the common box of the bodies. */
  centerOf(contact) {
    const center = new THREE.Vector3(), { pairs } = contact, pair = new THREE.Vector3();
    const wanted = Math.min(pairs.length / 2, 300), step = Math.max(1, Math.floor(pairs.length / 2 / Math.max(wanted, 1)));
    let found = 0;
    const { bodies } = this.stage.surface.run, solid = [contact.a, contact.b].map((body) => !bodies[body].plane);
    for (let i = 0; i < pairs.length; i += 2 * step, ++found) {
      pair.set(0, 0, 0);
      [contact.a, contact.b].forEach((body, k) => solid[k] && pair.add(this.surface.centroid(body, pairs[i + k])));
      center.addScaledVector(pair, solid[0] && solid[1] ? 0.5 : 1);
    }
    if (found > 0) return center.divideScalar(found);
    const zones = [contact.zoneA, contact.zoneB].filter((zone) => zone !== null);
    if (zones.length > 0) {
      for (const zone of zones) center.add(this.vector(zone.center));
      return center.divideScalar(zones.length);
    }
    if (!solid[0]) return this.surface.box(contact.b).getCenter(center);
    if (!solid[1]) return this.surface.box(contact.a).getCenter(center);
    const box = this.surface.box(contact.a).intersect(this.surface.box(contact.b));
    return box.isEmpty() ? this.surface.box(contact.a).getCenter(center) : box.getCenter(center);
  }

  /** How large what is drawn at a contact should be. */
  sizeOf(contact) {
    const { bodies } = this.surface.run;
    const size = (body) => (bodies[body].plane ? Infinity : this.surface.box(body).getSize(new THREE.Vector3()).length());
    return 0.5 * Math.min(size(contact.a), size(contact.b));
  }

  /** `show`: what is wanted. `contacts`: those it is wanted of; `chosen`: one of them, or null; `point`: one of its points;
   *  `isSeen(body)`: is it not hidden? */
  draw(frame, contacts, show, chosen, point, isSeen = () => true) {
    this.clear();
    if (show.boxes) this.drawBoxes(frame, contacts, chosen);
    const pairs = contacts.filter((c) => !c.self), many = pairs.length > kMostArrows;
    const hulls = new Map(); // a body's once, whatever number of pairs it is in
    if (many && show.direction) this.drawThinDirections(pairs.slice(0, kMostLines));
    for (const contact of many ? pairs.filter((c) => c === chosen) : pairs) {
      const center = this.centerOf(contact), n = new THREE.Vector3(...contact.direction), size = this.sizeOf(contact);
      if (show.direction) this.drawDirection(contact, center, n, size);
      if (contact !== chosen && contacts.length > kMostDetailed) continue;
      if (show.hulls) for (const body of [contact.a, contact.b].filter(isSeen)) hulls.set(body, hulls.size % 2 === 0 ? COLORS.hullA : COLORS.hullB);
      if (show.planes) this.drawPlanes(contact, center, n, size);
      if (show.zones) this.drawZones(contact, n, isSeen);
    }
    for (const [body, color] of hulls) this.drawHull(body, color);
    if (show.patches) for (const contact of many ? pairs.filter((c) => c === chosen) : contacts) this.drawPatches(contact);
    if (show.points) this.drawPoints(contacts, chosen, point);
    if (show.curves) this.drawCurves(contacts);
  }

  drawBoxes(frame, contacts, chosen) {
    const wanted = chosen === null ? frame.candidates.slice(0, kMostBoxes)
      : frame.candidates.filter(({ a, b }) => a === chosen.a && b === chosen.b);
    const apart = [], overlapping = [], bodies = new Set(wanted.flatMap(({ a, b }) => [a, b]));
    for (const { a, b } of wanted) {
      const common = this.surface.box(a).intersect(this.surface.box(b));
      if (!common.isEmpty()) boxLines(common, overlapping); // with margins, boxes may be apart
    }
    for (const body of bodies) if (!this.surface.box(body).isEmpty()) boxLines(this.surface.box(body), apart);
    this.group.add(seenThrough(lines(apart, COLORS.boxApart, 0.8), 0.25), seenThrough(lines(overlapping, COLORS.boxOverlap), 0.35));
  }

  drawHull(body, color) {
    const used = this.surface.usedVertices(body), points = [];
    used.forEach((isUsed, v) => isUsed && points.push(this.surface.vertex(body, v)));
    this.group.add(hull(points, color));
  }

  drawDirection(contact, center, n, size) {
    this.group.add(arrow(center, n, 0.55 * size, COLORS.direction));
  }

  drawThinDirections(contacts) {
    const segments = [], n = new THREE.Vector3(), tip = new THREE.Vector3();
    for (const contact of contacts) {
      const center = this.centerOf(contact), length = 0.4 * this.sizeOf(contact);
      tip.copy(center).addScaledVector(n.set(...contact.direction), length);
      segments.push(...center.toArray(), ...tip.toArray());
      const side = new THREE.Vector3(-n.y, n.x, 0.3).cross(n).setLength(0.12 * length), foot = tip.clone().addScaledVector(n, -0.2 * length);
      for (const sign of [1, -1]) segments.push(...tip.toArray(), ...foot.clone().addScaledVector(side, sign).toArray());
    }
    this.group.add(seenThrough(lines(segments, COLORS.direction), 0.4));
  }

  drawPlanes(contact, center, n, size) {
    // Heights are measured from the origin of the data; the picture has another.
    const base = n.dot(new THREE.Vector3(...this.stage.center)), at = n.dot(center);
    const move = (height) => center.clone().addScaledVector(n, height - base - at);
    const width = 1.15 * Math.max(size, 2 * Math.min(contact.zoneA?.radius ?? 0, contact.zoneB?.radius ?? 0));
    this.group.add(plane(move(contact.planeA), n, width, COLORS.planeA, 0.13), plane(move(contact.planeB), n, width, COLORS.planeB, 0.13));
    const edges = [], turn = frameAcross(n), h = width / 2;
    for (const [x, y] of [[-h, -h], [h, -h], [h, h], [-h, h]]) {
      const corner = new THREE.Vector3(x, y, 0).applyQuaternion(turn);
      edges.push(...move(contact.planeA).add(corner).toArray(), ...move(contact.planeB).add(corner).toArray());
    }
    this.group.add(lines(edges, COLORS.direction, 0.35));
  }

  drawZones(contact, n, isSeen) {
    const rim = 0.003 * this.stage.size;
    if (contact.zoneA !== null && isSeen(contact.a)) this.group.add(disk(this.vector(contact.zoneA.center), n, contact.zoneA.radius, COLORS.planeA, rim));
    if (contact.zoneB !== null && isSeen(contact.b)) this.group.add(disk(this.vector(contact.zoneB.center), n, contact.zoneB.radius, COLORS.planeB, rim));
  }

  drawPatches(contact) {
    const size = 0.3 * this.sizeOf(contact);
    for (const patch of contact.patches.slice(0, 4 * kMostArrows)) {
      this.group.add(arrow(this.vector(patch.point), new THREE.Vector3(...patch.direction), size, COLORS.patch));
    }
  }

  // Both places of a point; that on a plane is a gap along the normal from the other.
  placesOf(contact, point) {
    const along = (place, way) => place.clone().addScaledVector(new THREE.Vector3(...point.normal), way);
    if (point.b.vertices.length === 0) {
      const a = this.placeOf(contact.a, point.a);
      return [a, along(a, point.gap)];
    }
    const b = this.placeOf(contact.b, point.b);
    return [point.a.vertices.length === 0 ? along(b, -point.gap) : this.placeOf(contact.a, point.a), b];
  }

  placeOf(body, { vertices, weights }) {
    const place = new THREE.Vector3();
    vertices.forEach((v, k) => place.addScaledVector(this.surface.vertex(body, v), weights[k]));
    return place;
  }

  /** Points that are no minima of both surfaces are small and faint. */
  drawPoints(contacts, chosen, number) {
    for (const minimum of [true, false]) {
      const places = [], segments = [];
      let marked = -1;
      for (const contact of contacts) {
        contact.points.forEach((point, i) => {
          if (point.minimum !== minimum || this.points.length >= kMostPoints) return;
          const [a, b] = this.placesOf(contact, point);
          if (contact === chosen && i === number) marked = places.length;
          this.points.push({ contact, number: i, place: a });
          places.push(a);
          segments.push(...a.toArray(), ...b.toArray());
        });
      }
      if (places.length === 0) continue;
      const radius = (minimum ? 0.0035 : 0.0022) * this.stage.size;
      this.group.add(seenThrough(lines(segments, COLORS.point), minimum ? 0.5 : 0.2), balls(places, radius, minimum ? COLORS.point : COLORS.faintPoint, marked));
    }
  }

  drawCurves(contacts) {
    const segments = [];
    for (const { points, closed } of contacts.flatMap((contact) => contact.curves)) {
      const places = points.map((point) => this.vector(point));
      for (let i = 0; i + (closed ? 0 : 1) < places.length; ++i) {
        segments.push(...places[i].toArray(), ...places[(i + 1) % places.length].toArray());
      }
    }
    if (segments.length > 0) this.group.add(seenThrough(lines(segments, COLORS.curve), 0.8));
  }

  /** The contact point drawn nearest to a place of the page, within some pixels; or null. */
  pointAt(x, y) {
    const kReach = 9;
    let best = null, nearest = kReach;
    for (const one of this.points) {
      const p = this.stage.project(one.place);
      if (p === null) continue;
      const distance = Math.hypot(p.x - x, p.y - y);
      if (distance < nearest) nearest = distance, best = one;
    }
    return best;
  }
}
