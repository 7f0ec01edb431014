// A run: what the page holds, unpacked piece by piece as it is wanted.
import { ByteReader } from "./bytes.js";
import { readChunk, readContacts } from "./chunk.js";

export const OUTCOMES = [
  { key: "outside_box", name: "outside the box", color: [0.62, 0.66, 0.72], why: "outside the box of what is left of the other body" },
  { key: "outside_slab", name: "outside the slab", color: [0.33, 0.52, 0.86], why: "before the other's contact plane" },
  { key: "far", name: "nothing near", color: [0.42, 0.68, 0.6], why: "no cluster of the other body is near its cluster" },
  { key: "facing_away", name: "facing away", color: [0.66, 0.46, 0.85], why: "faces away from the other (accuracy paper only)" },
  { key: "outside_zone", name: "outside the zone", color: [0.2, 0.75, 0.85], why: "misses the disk around the other's impact zone" },
  { key: "kept", name: "kept", color: [1.0, 0.76, 0.2], why: "left after the criteria; meets no facet" },
  { key: "meets", name: "meets", color: [0.98, 0.27, 0.22], why: "left after the criteria, and meets a facet" },
];
export const SOURCES = ["carried", "fresh", "smallest"];
export const FEATURES = [
  "vertex-facet", "facet-vertex", "edge-edge", "vertex-edge", "edge-vertex", "vertex-vertex", "vertex-plane", "plane-vertex",
];

/** What is wrong with the page's data, for people. */
export class DataError extends Error {}

const CUT = "The page was cut: its end is missing. Write it again, or copy all of it.";
const FORMAT = 5;

function textOf(id) {
  const element = document.getElementById(id);
  if (element === null) throw new DataError(id === "tact-head" ? CUT : `The page lacks a part of its data (${id}). ${CUT}`);
  return element.textContent;
}

async function unpack(id) {
  let packed;
  try {
    packed = Uint8Array.from(atob(textOf(id)), (c) => c.charCodeAt(0));
  } catch (error) {
    if (error instanceof DataError) throw error;
    throw new DataError(`A part of the page's data is damaged (${id}: not base64).`);
  }
  if (typeof DecompressionStream === "undefined") {
    throw new DataError("This browser is too old for the page: it has no DecompressionStream (2023).");
  }
  try {
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new DataError(`A part of the page's data is damaged (${id}: it does not unpack).`);
  }
}

function readHead() {
  const text = textOf("tact-head");
  let head;
  try {
    head = JSON.parse(text);
  } catch {
    throw new DataError("The page's data are damaged: their head is no JSON. " + CUT);
  }
  if (head.format !== FORMAT) throw new DataError(`The page's data have format ${head.format}; this page reads ${FORMAT}.`);
  return head;
}

function readMeshes(bytes, bodies) {
  const reader = new ByteReader(bytes);
  for (const body of bodies) {
    body.corners = new Int32Array(3 * body.facets);
    reader.addSigned(body.corners.length, body.corners, (i) => (i > 0 ? body.corners[i - 1] : 0));
    if (body.corners.some((v) => v < 0 || v >= body.vertices)) throw new RangeError("a facet has a vertex that is none");
    body.groupings = [];
  }
  const groupings = reader.count();
  for (let i = 0; i < groupings; ++i) {
    const body = bodies[reader.count()];
    const grouping = { frame: reader.count(), clusters: new Int32Array(body.facets) };
    const clusters = grouping.clusters;
    reader.addSigned(clusters.length, clusters, (k) => (k > 0 ? clusters[k - 1] : 0));
    body.groupings.push(grouping);
  }
}

// Turns what a reader throws into a message that names the part.
async function guarded(part, read) {
  try {
    return await read();
  } catch (error) {
    if (error instanceof DataError) throw error;
    throw new DataError(`A part of the page's data is damaged (${part}: ${error.message}).`);
  }
}

export class Run {
  /** Errors: DataError. */
  static async open() {
    const run = new Run(readHead());
    await guarded("tact-meshes", async () => readMeshes(await unpack("tact-meshes"), run.bodies));
    return run;
  }

  constructor(head) {
    this.head = head;
    this.bodies = head.bodies;
    this.count = head.frames.step.length;
    this.columns = new Map();
    for (const column of [...head.statistics.counts, ...head.statistics.times]) this.columns.set(column.name, column);
    this.chunks = new Map(); // number: a promise of its frames; the last few that were wanted
    let facets = 0, vertices = 0;
    for (const body of this.bodies) {
      body.firstFacet = facets;
      body.firstVertex = vertices;
      facets += body.facets;
      vertices += body.vertices;
    }
    this.facets = facets;
    this.vertices = vertices;
  }

  /** A count or a time of a frame. */
  stat(name, frame) {
    return this.columns.get(name).values[frame];
  }

  chunkOf(frame) {
    return this.head.chunks.findIndex((chunk) => frame < chunk.first + chunk.count);
  }

  chunk(number) {
    const kKept = 4;
    let frames = this.chunks.get(number);
    this.chunks.delete(number);
    if (frames === undefined) {
      const { first, count } = this.head.chunks[number], id = `tact-chunk-${number}`;
      frames = guarded(id, async () => readChunk(await unpack(id), this.bodies, first, count));
    }
    this.chunks.set(number, frames);
    if (this.chunks.size > kKept) this.chunks.delete(this.chunks.keys().next().value);
    return frames;
  }

  /** Positions, candidates and contacts of a frame. Errors: DataError. */
  async frame(index) {
    const number = this.chunkOf(index);
    const frames = await this.chunk(number);
    const chunk = this.head.chunks[number];
    // The next one is unpacked while this one plays.
    if (index - chunk.first >= chunk.count / 2 && number + 1 < this.head.chunks.length) this.chunk(number + 1).catch(() => {});
    const frame = frames[index - chunk.first];
    if (frame.contacts === null) {
      Object.assign(frame, await guarded(`step ${this.head.frames.step[index]}`, async () => readContacts(frame.bytes)));
    }
    return frame;
  }

  clustersOf(body, frame) {
    return this.bodies[body].groupings.findLast((grouping) => grouping.frame <= frame)?.clusters ?? null;
  }

  bodyOfFacet(facet) {
    let low = 0, high = this.bodies.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.bodies[middle].firstFacet <= facet) low = middle;
      else high = middle - 1;
    }
    return low;
  }
}

/** How many facets had each outcome. */
export function outcomeCounts(runs) {
  const counts = OUTCOMES.map(() => 0);
  for (let i = 0; i < runs.length; i += 2) counts[runs[i + 1]] += runs[i];
  return counts;
}

/** The outcome of one facet. */
export function outcomeOf(runs, facet) {
  let end = 0;
  for (let i = 0; i < runs.length; i += 2) {
    end += runs[i];
    if (facet < end) return runs[i + 1];
  }
  return 0;
}

/** A name as text that can be seen: control characters get their symbols. */
export function visible(name) {
  return name.replace(/[\u0000-\u001f]/g, (c) => String.fromCharCode(0x2400 + c.charCodeAt(0))).replace(/\u007f/g, "\u2421")
    .replace(/[\u0080-\u009f\u200b-\u200f\u2028-\u202e\u2066-\u2069\ufeff]/g, "\ufffd") || "(no name)";
}
