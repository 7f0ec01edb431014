// What a step and a motion found.
import {
  TactError, call, copyOf, doubleAt, handles, longAt, make, makeAll, nameOf, read, readAll, result, shown, sizeOf, stringAt, viewOf,
  withMemory, wordAt,
} from "./memory.js";
import { ReachStencils, Stencils } from "./solver.js";

/** Arrays of a whole report: of each the kind of its numbers and how many a row has. */
const POINTS = {
  bodies: [Uint32Array, 2], contacts: [Int32Array, 1], kinds: [Uint8Array, 1], aVertices: [Int32Array, 3], bVertices: [Int32Array, 3],
  aWeights: [Float64Array, 3], bWeights: [Float64Array, 3], normals: [Float64Array, 3], gaps: [Float64Array, 1], ids: [BigUint64Array, 1],
  patchIds: [BigUint64Array, 1], minima: [Uint8Array, 1],
};
const POINT_LABELS = { aFacets: [Uint32Array, 1], bFacets: [Uint32Array, 1], aVertices: [Uint32Array, 3], bVertices: [Uint32Array, 3] };
const REACH_PAIRS = {
  bodies: [Uint32Array, 2], contacts: [Int32Array, 1], kinds: [Uint8Array, 1], aVertices: [Int32Array, 3], bVertices: [Int32Array, 3],
  aWeights: [Float64Array, 3], bWeights: [Float64Array, 3], normals: [Float64Array, 3], distances: [Float64Array, 1],
};
const FACET_PAIRS = { bodies: [Uint32Array, 2], contacts: [Int32Array, 1], facets: [Int32Array, 2] };
const IMPACTS = {
  bodies: [Uint32Array, 2], kinds: [Uint8Array, 1], times: [Float64Array, 1], aVertices: [Int32Array, 3], bVertices: [Int32Array, 3], stops: [Uint8Array, 1],
};

function filled(struct, name, shapes, handle, count, wanted = Object.keys(shapes)) {
  if (!Array.isArray(wanted)) throw new TactError("invalid_argument", `the arrays that are wanted are ${shown(wanted)}, no list of names`);
  return withMemory((take) => {
    const places = Object.fromEntries(wanted.map((key) => {
      if (!Object.hasOwn(shapes, key)) throw new TactError("invalid_argument", `there is no array ${shown(key)}; there are ${Object.keys(shapes).join(", ")}`);
      const [Kind, width] = shapes[key];
      return [key, take(count * width * Kind.BYTES_PER_ELEMENT)];
    }));
    call(name, handle, make(take, struct, places), count);
    const arrays = Object.entries(places).map(([key, at]) => [key, copyOf(shapes[key][0], at, count * shapes[key][1])]);
    return { count, ...Object.fromEntries(arrays) };
  });
}

/** Arrays that the world owns: pointer and count. */
function owned(name, ...values) {
  return withMemory((take) => {
    const pointer = take(4), count = take(4);
    call(name, ...values, pointer, count);
    return [wordAt(pointer), wordAt(count)];
  });
}

/** Two bodies whose hulls overlap, or are nearer than their margins. */
class Contact {
  #report; #index; #patchCount; #curveCount;
  constructor(report, index) {
    this.#report = report;
    this.#index = index;
    const { a, b, facetPairs, facetPairCount, patchCount, curveCount, containment, ...rest } = this.#read();
    this.#patchCount = patchCount;
    this.#curveCount = curveCount;
    Object.assign(this, rest, { a: report.world.bodyOf(a), b: report.world.bodyOf(b), containment: nameOf("tact_containment", containment) });
  }
  get #handle() { return this.#report.valid(); }
  #read() {
    return withMemory((take) => {
      const at = make(take, "tact_contact");
      call("tact_report_contact", this.#handle, this.#index, at);
      return read("tact_contact", at);
    });
  }
  /** Facet of a, facet of b, for each pair that meets. Where they lie is asked each time: the world may be gone. */
  get facetPairs() {
    const { facetPairs, facetPairCount } = this.#read();
    return copyOf(Int32Array, facetPairs, 2 * facetPairCount);
  }
  get points() {
    const [at, count] = owned("tact_contact_points", this.#handle, this.#index);
    return readAll("tact_contact_point", at, count);
  }
  get withinReach() {
    const [at, count] = owned("tact_contact_within_reach", this.#handle, this.#index);
    return readAll("tact_reach_pair", at, count);
  }
  #parts(struct, name, count, convert) {
    return Array.from({ length: count }, (_, i) => withMemory((take) => {
      const at = make(take, struct);
      call(name, this.#handle, this.#index, i, at);
      return convert(read(struct, at));
    }));
  }
  get patches() {
    return this.#parts("tact_patch", "tact_contact_patch", this.#patchCount, ({ facetPairCount, pointCount, ...patch }) => ({
      ...patch, facetPairs: copyOf(Int32Array, patch.facetPairs, facetPairCount), points: copyOf(Int32Array, patch.points, pointCount),
    }));
  }
  get curves() {
    return this.#parts("tact_curve", "tact_contact_curve", this.#curveCount,
      ({ closed, points, pointCount }) => ({ closed, points: readAll("tact_curve_point", points, pointCount) }));
  }
  get hash() { return result(longAt, 8, "tact_contact_hash", this.#handle, this.#index); }
}

/** What is valid until `steps` says that there is a later one. */
class StepResult {
  #handle; #steps; #step; #kind;
  constructor(world, handle, steps, kind) {
    this.world = world;
    this.#handle = handle;
    this.#steps = steps;
    this.#kind = kind;
    this.#step = steps[kind];
  }
  /** Of what tact_c.h calls the world of a report; throws where that has taken another step. */
  valid() {
    if (this.#steps[this.#kind] !== this.#step) throw new TactError("stale_report", "a report was used after its world's next step, or after its memory was used again or freed");
    return this.#handle;
  }
}

/** What a step found, in the world or kept. */
class AnyReport extends StepResult {
  #contacts;

  get contacts() {
    const length = result(wordAt, 4, "tact_report_contacts", this.valid());
    return this.#contacts ??= Array.from({ length }, (_, i) => new Contact(this, i));
  }
  findContact(a, b) {
    const index = withMemory((take) =>
      result(wordAt, 4, "tact_report_find_contact", this.valid(), make(take, "tact_body", a), make(take, "tact_body", b)));
    return this.contacts[index] ?? null;
  }
  get pointCount() { return result(wordAt, 4, "tact_report_point_count", this.valid()); }
  points(wanted) {
    return filled("tact_point_arrays", "tact_report_copy_points", POINTS, this.valid(), this.pointCount, wanted);
  }
  reachPairs(wanted) {
    const handle = this.valid(), count = result(wordAt, 4, "tact_report_reach_pair_count", handle);
    return filled("tact_reach_pair_arrays", "tact_report_copy_reach_pairs", REACH_PAIRS, handle, count, wanted);
  }
  facetPairs(wanted) {
    const handle = this.valid(), count = result(wordAt, 4, "tact_report_facet_pair_count", handle);
    return filled("tact_facet_pair_arrays", "tact_report_copy_facet_pairs", FACET_PAIRS, handle, count, wanted);
  }
  #bodies(one) { return { ...one, a: this.world.bodyOf(one.a), b: this.world.bodyOf(one.b) }; }
  #listed(name, struct) {
    const [at, count] = owned(name, this.valid());
    return readAll(struct, at, count).map((one) => this.#bodies(one));
  }
  get candidatePairs() { return this.#listed("tact_report_candidate_pairs", "tact_candidate_pair"); }
  get began() { return this.#listed("tact_report_began", "tact_contact_event"); }
  get ended() { return this.#listed("tact_report_ended", "tact_contact_event"); }
  get patchEvents() { return this.#listed("tact_report_patch_events", "tact_patch_event"); }
  /** Counts, and times in milliseconds, by name. */
  get statistics() {
    return withMemory((take) => {
      const count = take(4), handle = this.valid();
      call("tact_report_stats", handle, 0, 0, count);
      const room = wordAt(count), at = take(room * sizeOf("tact_statistic"));
      call("tact_report_stats", handle, at, room, count);
      return Object.fromEntries(readAll("tact_statistic", at, room).map((one) => [stringAt(one.name), one.isTime ? one.ms : one.count]));
    });
  }
  get trace() {
    const handle = this.valid();
    return Array.from({ length: result(wordAt, 4, "tact_report_trace", handle) }, (_, i) => withMemory((take) => {
      const at = make(take, "tact_trace_event");
      call("tact_report_trace_event", handle, i, at);
      return this.#bodies(read("tact_trace_event", at));
    }));
  }
  get hash() { return result(longAt, 8, "tact_report_hash", this.valid()); }

  /** The points for a solver; `firstRows`: by index of body the row of its first vertex. */
  stencils(firstRows) { return Stencils.ofPoints(this.valid(), firstRows); }
  /** The same of the pairs within reach. */
  stencilsWithinReach(firstRows) { return ReachStencils.of(this.valid(), firstRows); }
  /** Copies the report, which then stays. The memory of `kept` is used again, and what it was is stale. */
  keep(kept = null) { return KeptReport.of(this, kept); }
}

/** A report with memory of its own, which stays while the world goes on, changes or is destroyed. */
class KeptReport extends AnyReport {
  #room;
  constructor(world, room) {
    super(world, room.handle, room, "kept");
    this.#room = room;
  }
  static of(report, kept) {
    const handle = report.valid(), room = kept === null ? { handle: 0n, kept: 0 } : kept.#room;
    kept?.valid();
    withMemory((take) => {
      const at = take(8);
      viewOf(BigUint64Array, at, 1)[0] = room.handle;
      call("tact_report_keep", handle, at);
      if (report !== kept) room.kept += 1;
      if (room.handle === 0n) {
        room.handle = longAt(at);
        handles.register(room, room.handle, room);
      }
    });
    return new KeptReport(report.world, room);
  }
  /** Frees its memory now; otherwise it is freed some time after nothing names the report. */
  free() {
    call("tact_world_destroy", this.valid());
    this.#room.kept += 1;
    handles.unregister(this.#room);
  }
}

/** What the last step of a world found. */
export class Report extends AnyReport {
  constructor(world, steps) { super(world, world.handle, steps, "detect"); }

  /** The labels of what points() names, in its order. */
  pointLabels(wanted) {
    return filled("tact_point_label_arrays", "tact_report_copy_point_labels", POINT_LABELS, this.valid(), this.pointCount, wanted);
  }
  /** For each of points() 1 if it is a minimum also of joined surfaces, else 0. */
  joinedMinima({ within = 0, layers = 0 } = {}) {
    return withMemory((take) => {
      const handle = this.valid(), count = this.pointCount, at = take(count);
      call("tact_report_joined_minima", handle, make(take, "tact_joined_surfaces", { within, layers }), at, count);
      return copyOf(Uint8Array, at, count);
    });
  }
  /** The sums over contacts, patches and bodies; `impulses`: [{id, impulse}]. */
  sumContacts(impulses = []) {
    return withMemory((take) => {
      const handle = this.valid(), { world } = this, given = makeAll(take, "tact_point_impulse", impulses), sums = make(take, "tact_contact_sums");
      call("tact_report_sum_contacts", handle, given, impulses.length, sums);
      const { sumCount, vertexCount } = read("tact_contact_sums", sums);
      const all = take(sumCount * sizeOf("tact_contact_sum")), vertices = take(vertexCount * sizeOf("tact_vertex_of_body"));
      const room = make(take, "tact_contact_sums", { sums: all, sumCapacity: sumCount, vertices, vertexCapacity: vertexCount });
      call("tact_report_sum_contacts", handle, given, impulses.length, room);
      const named = readAll("tact_vertex_of_body", vertices, vertexCount).map(({ body, vertex }) => ({ body: world.bodyOf(body), vertex }));
      return readAll("tact_contact_sum", all, sumCount).map(({ firstVertex, vertexCount: count, ...sum }) =>
        ({ ...sum, a: world.bodyOf(sum.a), b: world.bodyOf(sum.b), vertices: named.slice(firstVertex, firstVertex + count) }));
    });
  }
}

/** What detectMotion() found. */
export class MotionReport extends StepResult {
  constructor(world, steps) { super(world, world.handle, steps, "motion"); }

  /** The earliest time of an impact that stops; Infinity if none does. */
  get firstTime() { return result(doubleAt, 8, "tact_motion_first_time", this.valid()); }
  #bodies(one) { return { ...one, a: this.world.bodyOf(one.a), b: this.world.bodyOf(one.b) }; }
  get impacts() {
    const [at, count] = owned("tact_motion_impacts", this.valid());
    return readAll("tact_impact", at, count).map((one) => this.#bodies(one));
  }
  impactArrays(wanted) {
    const handle = this.valid(), [, count] = owned("tact_motion_impacts", handle);
    return filled("tact_impact_arrays", "tact_motion_copy_impacts", IMPACTS, handle, count, wanted);
  }
  get pairs() {
    const handle = this.valid();
    return Array.from({ length: result(wordAt, 4, "tact_motion_pairs", handle) }, (_, i) => withMemory((take) => {
      const at = make(take, "tact_impact_pair");
      call("tact_motion_pair", handle, i, at);
      const { impacts, impactCount, ...pair } = read("tact_impact_pair", at);
      return { ...this.#bodies(pair), impacts: readAll("tact_impact", impacts, impactCount).map((one) => this.#bodies(one)) };
    }));
  }
  boundsOf(body) {
    return withMemory((take) => {
      const [at, count] = owned("tact_motion_bounds", this.valid(), make(take, "tact_body", body));
      return copyOf(Float64Array, at, count);
    });
  }
  /** The impacts that stop, for a solver; `begin`, `end`: the vertices of all bodies before and after the way. */
  stencils(firstRows, begin, end) { return Stencils.ofImpacts(this.valid(), firstRows, begin, end); }
  get statistics() {
    return withMemory((take) => {
      const at = make(take, "tact_motion_statistics");
      call("tact_motion_stats", this.valid(), at);
      return read("tact_motion_statistics", at);
    });
  }
}
