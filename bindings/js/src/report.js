// What a step and a motion found.
import {
  TactError, call, copyOf, doubleAt, longAt, make, makeAll, nameOf, read, readAll, result, sizeOf, stringAt, withMemory, wordAt,
} from "./memory.js";
import { Stencils } from "./solver.js";

/** Arrays of a whole report: of each the kind of its numbers and how many a row has. */
const POINTS = {
  bodies: [Uint32Array, 2], contacts: [Int32Array, 1], kinds: [Uint8Array, 1], aVertices: [Int32Array, 3], bVertices: [Int32Array, 3],
  aWeights: [Float64Array, 3], bWeights: [Float64Array, 3], normals: [Float64Array, 3], gaps: [Float64Array, 1], ids: [BigUint64Array, 1],
  patchIds: [BigUint64Array, 1], minima: [Uint8Array, 1],
};
const REACH_PAIRS = {
  bodies: [Uint32Array, 2], contacts: [Int32Array, 1], kinds: [Uint8Array, 1], aVertices: [Int32Array, 3], bVertices: [Int32Array, 3],
  aWeights: [Float64Array, 3], bWeights: [Float64Array, 3], normals: [Float64Array, 3], distances: [Float64Array, 1],
};
const FACET_PAIRS = { bodies: [Uint32Array, 2], contacts: [Int32Array, 1], facets: [Int32Array, 2] };
const IMPACTS = {
  bodies: [Uint32Array, 2], kinds: [Uint8Array, 1], times: [Float64Array, 1], aVertices: [Int32Array, 3], bVertices: [Int32Array, 3], stops: [Uint8Array, 1],
};

function filled(struct, name, shapes, world, count, wanted = Object.keys(shapes)) {
  return withMemory((take) => {
    const places = Object.fromEntries(wanted.map((key) => {
      if (!(key in shapes)) throw new TactError("invalid_argument", `there is no array ${key}; there are ${Object.keys(shapes).join(", ")}`);
      const [Kind, width] = shapes[key];
      return [key, take(count * width * Kind.BYTES_PER_ELEMENT)];
    }));
    call(name, world.handle, make(take, struct, places), count);
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
  #report; #index; #facetPairs; #facetPairCount; #patchCount; #curveCount;
  constructor(report, index) {
    const { a, b, facetPairs, facetPairCount, patchCount, curveCount, containment, ...rest } = withMemory((take) => {
      const at = make(take, "tact_contact");
      call("tact_report_contact", report.world.handle, index, at);
      return read("tact_contact", at);
    });
    this.#report = report;
    this.#index = index;
    this.#facetPairs = facetPairs;
    this.#facetPairCount = facetPairCount;
    this.#patchCount = patchCount;
    this.#curveCount = curveCount;
    Object.assign(this, rest, { a: report.world.bodyOf(a), b: report.world.bodyOf(b), containment: nameOf("tact_containment", containment) });
  }
  get #world() { return this.#report.valid().handle; }
  /** Facet of a, facet of b, for each pair that meets. */
  get facetPairs() {
    this.#report.valid();
    return copyOf(Int32Array, this.#facetPairs, 2 * this.#facetPairCount);
  }
  get points() {
    const [at, count] = owned("tact_contact_points", this.#world, this.#index);
    return readAll("tact_contact_point", at, count);
  }
  get withinReach() {
    const [at, count] = owned("tact_contact_within_reach", this.#world, this.#index);
    return readAll("tact_reach_pair", at, count);
  }
  #parts(struct, name, count, convert) {
    return Array.from({ length: count }, (_, i) => withMemory((take) => {
      const at = make(take, struct);
      call(name, this.#world, this.#index, i, at);
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
  get hash() { return result(longAt, 8, "tact_contact_hash", this.#world, this.#index); }
}

class StepResult {
  #steps; #step; #kind;
  constructor(world, steps, kind) {
    this.world = world;
    this.#steps = steps;
    this.#kind = kind;
    this.#step = steps[kind];
  }
  /** The world; throws where it has taken another step. */
  valid() {
    if (this.#steps[this.#kind] !== this.#step) throw new TactError("stale_report", "a report was used after its world's next step");
    return this.world;
  }
}

/** What a step found. */
export class Report extends StepResult {
  #contacts;
  constructor(world, steps) { super(world, steps, "detect"); }

  get contacts() {
    const world = this.valid();
    return this.#contacts ??= Array.from({ length: result(wordAt, 4, "tact_report_contacts", world.handle) }, (_, i) => new Contact(this, i));
  }
  findContact(a, b) {
    const index = withMemory((take) =>
      result(wordAt, 4, "tact_report_find_contact", this.valid().handle, make(take, "tact_body", a), make(take, "tact_body", b)));
    return this.contacts[index] ?? null;
  }
  points(wanted) {
    const world = this.valid(), count = result(wordAt, 4, "tact_report_point_count", world.handle);
    return filled("tact_point_arrays", "tact_report_copy_points", POINTS, world, count, wanted);
  }
  reachPairs(wanted) {
    const world = this.valid(), count = result(wordAt, 4, "tact_report_reach_pair_count", world.handle);
    return filled("tact_reach_pair_arrays", "tact_report_copy_reach_pairs", REACH_PAIRS, world, count, wanted);
  }
  facetPairs(wanted) {
    const world = this.valid(), count = result(wordAt, 4, "tact_report_facet_pair_count", world.handle);
    return filled("tact_facet_pair_arrays", "tact_report_copy_facet_pairs", FACET_PAIRS, world, count, wanted);
  }
  #listed(name, struct) {
    const world = this.valid(), [at, count] = owned(name, world.handle);
    return readAll(struct, at, count).map((one) => ({ ...one, a: world.bodyOf(one.a), b: world.bodyOf(one.b) }));
  }
  get candidatePairs() { return this.#listed("tact_report_candidate_pairs", "tact_candidate_pair"); }
  get began() { return this.#listed("tact_report_began", "tact_contact_event"); }
  get ended() { return this.#listed("tact_report_ended", "tact_contact_event"); }
  get patchEvents() { return this.#listed("tact_report_patch_events", "tact_patch_event"); }
  /** Counts, and times in milliseconds, by name. */
  get statistics() {
    return withMemory((take) => {
      const count = take(4), world = this.valid();
      call("tact_report_stats", world.handle, 0, 0, count);
      const room = wordAt(count), at = take(room * sizeOf("tact_statistic"));
      call("tact_report_stats", world.handle, at, room, count);
      return Object.fromEntries(readAll("tact_statistic", at, room).map((one) => [stringAt(one.name), one.isTime ? one.ms : one.count]));
    });
  }
  get trace() {
    const world = this.valid();
    return Array.from({ length: result(wordAt, 4, "tact_report_trace", world.handle) }, (_, i) => withMemory((take) => {
      const at = make(take, "tact_trace_event");
      call("tact_report_trace_event", world.handle, i, at);
      const event = read("tact_trace_event", at);
      return { ...event, a: world.bodyOf(event.a), b: world.bodyOf(event.b) };
    }));
  }
  get hash() { return result(longAt, 8, "tact_report_hash", this.valid().handle); }

  /** The sums over contacts, patches and bodies; `impulses`: [{id, impulse}]. */
  sumContacts(impulses = []) {
    return withMemory((take) => {
      const world = this.valid(), given = makeAll(take, "tact_point_impulse", impulses), sums = make(take, "tact_contact_sums");
      call("tact_report_sum_contacts", world.handle, given, impulses.length, sums);
      const { sumCount, vertexCount } = read("tact_contact_sums", sums);
      const all = take(sumCount * sizeOf("tact_contact_sum")), vertices = take(vertexCount * sizeOf("tact_vertex_of_body"));
      const room = make(take, "tact_contact_sums", { sums: all, sumCapacity: sumCount, vertices, vertexCapacity: vertexCount });
      call("tact_report_sum_contacts", world.handle, given, impulses.length, room);
      const named = readAll("tact_vertex_of_body", vertices, vertexCount).map(({ body, vertex }) => ({ body: world.bodyOf(body), vertex }));
      return readAll("tact_contact_sum", all, sumCount).map(({ firstVertex, vertexCount: count, ...sum }) =>
        ({ ...sum, a: world.bodyOf(sum.a), b: world.bodyOf(sum.b), vertices: named.slice(firstVertex, firstVertex + count) }));
    });
  }
  /** The points for a solver; `firstRows`: by index of body the row of its first vertex. */
  stencils(firstRows) { return Stencils.of(this.valid().handle, firstRows); }
}

/** What detectMotion() found. */
export class MotionReport extends StepResult {
  constructor(world, steps) { super(world, steps, "motion"); }

  /** The earliest time of an impact that stops; Infinity if none does. */
  get firstTime() { return result(doubleAt, 8, "tact_motion_first_time", this.valid().handle); }
  #bodies(one) { return { ...one, a: this.world.bodyOf(one.a), b: this.world.bodyOf(one.b) }; }
  get impacts() {
    const [at, count] = owned("tact_motion_impacts", this.valid().handle);
    return readAll("tact_impact", at, count).map((one) => this.#bodies(one));
  }
  impactArrays(wanted) {
    const world = this.valid(), [, count] = owned("tact_motion_impacts", world.handle);
    return filled("tact_impact_arrays", "tact_motion_copy_impacts", IMPACTS, world, count, wanted);
  }
  get pairs() {
    const world = this.valid();
    return Array.from({ length: result(wordAt, 4, "tact_motion_pairs", world.handle) }, (_, i) => withMemory((take) => {
      const at = make(take, "tact_impact_pair");
      call("tact_motion_pair", world.handle, i, at);
      const { impacts, impactCount, ...pair } = read("tact_impact_pair", at);
      return { ...this.#bodies(pair), impacts: readAll("tact_impact", impacts, impactCount).map((one) => this.#bodies(one)) };
    }));
  }
  boundsOf(body) {
    return withMemory((take) => {
      const [at, count] = owned("tact_motion_bounds", this.valid().handle, make(take, "tact_body", body));
      return copyOf(Float64Array, at, count);
    });
  }
  get statistics() {
    return withMemory((take) => {
      const at = make(take, "tact_motion_statistics");
      call("tact_motion_stats", this.valid().handle, at);
      return read("tact_motion_statistics", at);
    });
  }
}
