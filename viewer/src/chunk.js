// What scenes/view/viewed_body.cpp and view_contacts.cpp wrote, read in the same order.
import { ByteReader } from "./bytes.js";

const CODING = { same: 0, absolute: 1, sinceLast: 2, sinceStraight: 3 };

function readPositions(reader, vertices, last, beforeLast) {
  const coding = reader.byte();
  if (coding === CODING.same && last) return last;
  const now = new Int32Array(3 * vertices);
  if (coding === CODING.absolute) {
    reader.addSigned(now.length, now, (i) => (i < 3 ? 0 : now[i - 3]));
  } else if (coding === CODING.sinceLast && last) {
    reader.addSigned(now.length, now, (i) => last[i]);
  } else if (coding === CODING.sinceStraight && last && beforeLast) {
    reader.addSigned(now.length, now, (i) => 2 * last[i] - beforeLast[i]);
  } else {
    throw new RangeError(`positions in no known coding (${coding})`);
  }
  return now;
}

/** The frames of a chunk: for each body its positions in whole steps, or null, and the bytes of its contacts. */
export function readChunk(bytes, bodies, first, count) {
  const reader = new ByteReader(bytes);
  const frames = [];
  for (let index = first; index < first + count; ++index) {
    const last = frames.at(-1)?.positions, beforeLast = frames.at(-2)?.positions;
    const positions = bodies.map((body, i) =>
      index >= body.first && index < body.end ? readPositions(reader, body.vertices, last?.[i], beforeLast?.[i]) : null);
    frames.push({ index, positions, bytes: reader.part(), contacts: null });
  }
  if (reader.left() > 0) throw new RangeError("a chunk holds more than its frames");
  return frames;
}

function readDisk(reader) {
  const radius = reader.double();
  return radius >= 0 ? { radius, center: reader.roughVector() } : null;
}

function readFacetPairs(reader) {
  const pairs = new Int32Array(2 * reader.count());
  let a = 0, b = 0;
  for (let i = 0; i < pairs.length; i += 2) {
    pairs[i] = a += reader.count();
    pairs[i + 1] = b += reader.signed();
  }
  return pairs;
}

/** Runs of facets with one outcome: length and outcome. */
function readOutcomes(reader) {
  const facets = reader.count(), runs = [];
  for (let done = 0; done < facets; ) {
    const run = reader.count(), length = Math.floor(run / 8);
    if (length === 0 || done + length > facets) throw new RangeError("outcomes of more facets than there are");
    runs.push(length, run % 8);
    done += length;
  }
  return runs;
}

function readPatch(reader) {
  const patch = { point: reader.roughVector(), direction: reader.roughVector(), depth: reader.double(), pairs: [] };
  const count = reader.count();
  for (let i = 0, last = 0; i < count; ++i) patch.pairs.push((last += reader.count()));
  return patch;
}

/** A place on a surface: vertices and their weights. `last` holds the vertices of the point before. */
function readPlace(reader, last) {
  const count = reader.count(), vertices = [], weights = [];
  for (let k = 0; k < count; ++k) vertices.push((last[k] += reader.signed()));
  let rest = 1;
  for (let k = 0; k + 1 < count; ++k) {
    weights.push(reader.byte() / 255);
    rest -= weights[k];
  }
  if (count > 0) weights.push(Math.max(rest, 0));
  return { vertices, weights };
}

function readPoint(reader, lastA, lastB) {
  const kind = reader.byte();
  return {
    kind: kind & 7,
    minimum: (kind & 8) !== 0,
    patch: reader.count(),
    a: readPlace(reader, lastA),
    b: readPlace(reader, lastB),
    normal: [0, 1, 2].map(() => reader.short() / 32767),
    gap: reader.float(),
    id: reader.hex(),
  };
}

/** Places of an intersection curve, in order. */
function readCurve(reader) {
  const count = reader.count();
  return { closed: count % 2 === 1, points: times(Math.floor(count / 2), () => reader.roughVector()) };
}

function times(count, read) {
  return Array.from({ length: count }, read);
}

function readContact(reader) {
  const contact = { a: reader.count(), b: reader.count() };
  const flags = reader.byte();
  contact.source = flags & 3;
  contact.limitReached = (flags & 4) !== 0;
  contact.direction = reader.vector();
  contact.depth = reader.double();
  contact.planeA = reader.double();
  contact.planeB = reader.double();
  contact.zoneA = readDisk(reader);
  contact.zoneB = readDisk(reader);
  contact.iterations = reader.count();
  contact.keptA = reader.count();
  contact.keptB = reader.count();
  contact.pairs = readFacetPairs(reader);
  contact.outcomesA = flags & 8 ? readOutcomes(reader) : null;
  contact.outcomesB = flags & 8 ? readOutcomes(reader) : null;
  contact.patches = times(reader.count(), () => readPatch(reader));
  contact.pointCount = reader.count(); // with --few-points more than are listed
  const lastA = [0, 0, 0], lastB = [0, 0, 0];
  contact.points = times(reader.count(), () => readPoint(reader, lastA, lastB));
  contact.curves = times(reader.count(), () => readCurve(reader));
  contact.self = contact.a === contact.b;
  return contact;
}

/** The candidate pairs and the contacts of a frame. */
export function readContacts(bytes) {
  const reader = new ByteReader(bytes);
  const candidates = times(reader.count(), () => {
    const a = reader.count();
    return { a: Math.floor(a / 2), b: reader.count(), overlap: a % 2 === 1 };
  });
  return { candidates, contacts: times(reader.count(), () => readContact(reader)) };
}
