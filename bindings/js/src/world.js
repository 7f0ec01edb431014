// Worlds: bodies, steps, queries.
import { allHeld, doubles, float64s, held, indicesOf, int32s, makeColumns, positionsOf, typed, uint32s } from "./arrays.js";
import { Bodies } from "./bodies.js";
import { drawing, makeOptions } from "./drawing.js";
import { MotionReport, Report } from "./report.js";
import {
  TactError, call, callees, copyOf, doubleAt, failureOf, handles, isInside, library, longAt, make, makeAll, nameOf, numberOf, placeString, read, readAll,
  result, sizeOf, stringAt, unmoved, viewOf, whole, withMemory, wordAt, write,
} from "./memory.js";

let callers = 0;
/** The errors of calls that have not begun. */
const REFUSED = new Set(["busy", "invalid_handle"]);
/** The largest distance, metres. */
const LARGEST = 2 ** 300;
const flagAt = (at) => viewOf(Uint8Array, at, 1)[0] !== 0;
const hitOrNone = (world, hit) => (hit.facet < 0 ? null : { ...hit, body: world.bodyOf(hit.body) });
/** The fields of a mesh in tact_body_definition and tact_mesh_update. */
function meshOf(take, { positions, facets, edges, points }) {
  const alone = points && int32s(take, points, "points");
  return {
    positions: positionsOf(take, positions), facets: facets && indicesOf(take, facets, 3, "facets"),
    edges: edges && indicesOf(take, edges, 2, "edges"), points: alone?.first, pointCount: alone?.count,
  };
}
/** The fields of a definition that may be left out, and those that say whether they are. */
const given = (take, { name, key, restOffset }) => ({
  name: name === undefined ? undefined : placeString(take, String(name), "name"),
  ...(key !== undefined && { hasKey: true, key }), ...(restOffset != null && { hasRestOffset: true, restOffset }),
});
/** The arrays of tact_feature_settings: of each the kind of its numbers, and what they are of. */
const FEATURE_SETTINGS = {
  restOffsets: Float64Array, vertexLabels: Uint32Array, facetLabels: Uint32Array, vertexLayers: Uint32Array, vertexMasks: Uint32Array,
  facetLayers: Uint32Array, facetMasks: Uint32Array, margins: Float64Array,
};
const countOf = (array) => `${array.slice(0, -1)}Count`;

/** A set of bodies and the contacts among them. */
export class World {
  #handle; #caller = ++callers; #bodies = new Bodies(); #steps = { detect: 0, motion: 0 }; #onMessage;

  constructor(settings = {}) {
    this.#handle = withMemory((take) => result(longAt, 8, "tact_world_create", this.#settings(take, settings)));
    handles.register(this, this.#handle, this);
    this.#listen(settings.onMessage);
  }
  /** Frees the world's memory now; otherwise it is freed some time after nothing names the world. */
  destroy() {
    call("tact_world_destroy", this.#handle);
    handles.unregister(this);
    callees.message.delete(this.#caller);
  }
  get handle() { return this.#handle; }

  /** What tact calls holds the world weakly: a world that nothing names goes, whatever it listens to. */
  #listen(onMessage) {
    this.#onMessage = onMessage;
    callees.message.delete(this.#caller);
    if (!onMessage) return;
    const world = new WeakRef(this);
    callees.message.set(this.#caller, (at) => world.deref()?.#tell(read("tact_message", at)));
  }
  #tell(message) {
    this.#onMessage({ ...message, a: this.bodyOf(message.a), b: this.bodyOf(message.b), text: stringAt(message.text) });
  }
  #settings(take, { onMessage, ...settings }) {
    const function_ = onMessage ? library().tact_js_message_function() : 0;
    return make(take, "tact_settings", { threads: 1, ...settings, onMessage: function_, messageUser: this.#caller });
  }
  get settings() {
    return withMemory((take) => {
      const at = make(take, "tact_settings");
      call("tact_world_settings", this.#handle, at);
      const { executor, onMessage, messageUser, ...settings } = read("tact_settings", at);
      return settings;
    });
  }
  setSettings(settings) {
    withMemory((take) => call("tact_world_set_settings", this.#handle, this.#settings(take, settings)));
    this.#steps.detect += 1;
    this.#listen(settings.onMessage);
  }

  /** The one object that stands for a body; null for no body. */
  bodyOf(body) { return this.#bodies.of(body); }
  /** The body whose index stands in an array of a report. */
  bodyAt(index) {
    return this.#bodies.latest(index) ?? this.bodies().find((body) => body.index === index) ?? null;
  }
  #body(take, body) { return make(take, "tact_body", body ?? {}); }  // of no body tact says what is wrong
  /** C has added a body though its message threw, as exceptions do not pass it: the body goes again, as in C++. */
  #added(take, name, at) {
    const body = make(take, "tact_body");
    try {
      call(name, this.#handle, at, body);
    } catch (error) {
      if (read("tact_body", body).generation !== 0) failureOf("tact_world_remove_body", this.#handle, body);
      throw error;
    }
    return this.bodyOf(read("tact_body", body));
  }

  addBody({ positions = [], facets, edges, points, name, key, restOffset, ...rest }) {
    const mesh = allHeld({ positions, facets, edges, points });
    return withMemory((take) => this.#added(take, "tact_world_add_body", make(take, "tact_body_definition",
      { ...rest, ...meshOf(take, mesh), ...given(take, { name, key, restOffset }) })));
  }
  addPlane({ name, key, restOffset, ...rest }) {
    return withMemory((take) => this.#added(take, "tact_world_add_plane", make(take, "tact_plane_definition",
      { ...unmoved(rest), ...given(take, { name, key, restOffset }) })));
  }
  removeBody(body) { this.#set("tact_world_remove_body", body); }

  #set(name, body, ...values) {
    withMemory((take) => call(name, this.#handle, this.#body(take, body), ...values));
  }
  setPositions(body, positions) {
    const all = held(positions);
    withMemory((take) => call("tact_world_set_positions", this.#handle, this.#body(take, body), makeColumns(take, positionsOf(take, all))));
  }
  setPositionsOfMany(updates) {
    const given = updates.map(({ body, positions }) => ({ body, positions: held(positions) }));
    withMemory((take) => {
      const all = given.map(({ body, positions }) => ({ body, positions: positionsOf(take, positions) }));
      call("tact_world_set_positions_of_many", this.#handle, makeAll(take, "tact_positions_update", all), all.length);
    });
  }
  setFacets(body, positions, facets, vertexMap, { edges, points, facetMap = [] } = {}) {
    const mesh = allHeld({ positions, facets, edges, points }), maps = allHeld({ vertexMap, facetMap });
    withMemory((take) => {
      const ofVertices = int32s(take, maps.vertexMap, "vertexMap"), ofFacets = int32s(take, maps.facetMap, "facetMap");
      call("tact_world_set_facets_by", this.#handle, this.#body(take, body), make(take, "tact_mesh_update", {
        ...meshOf(take, mesh), vertexMap: ofVertices.first, vertexMapCount: ofVertices.count,
        facetMap: ofFacets.first, facetMapCount: ofFacets.count,
      }));
    });
  }
  setPose(body, rotation, translation) {
    const pose = allHeld({ rotation, translation });
    withMemory((take) => call("tact_world_set_pose", this.#handle, this.#body(take, body),
      doubles(take, pose.rotation, 9, "rotation"), doubles(take, pose.translation, 3, "translation")));
  }
  setPoses(updates) {
    withMemory((take) => call("tact_world_set_poses", this.#handle, makeAll(take, "tact_pose_update",
      updates.map(({ rotation, ...rest }) => ({ ...rest, rotation: typed(rotation, Float64Array, "rotation") }))), updates.length));
  }
  setLayers(body, layer, mask) {
    this.#set("tact_world_set_layers", body, whole("uint32_t", layer, "layer"), whole("uint32_t", mask, "mask"));
  }
  setGroup(body, group) { this.#set("tact_world_set_group", body, whole("uint32_t", group, "group")); }
  setExcluded(a, b, excluded) {
    withMemory((take) => call("tact_world_set_excluded", this.#handle, this.#body(take, a), this.#body(take, b), excluded ? 1 : 0));
  }
  setMotion(body, motion) { this.#set("tact_world_set_motion", body, numberOf("tact_motion", motion)); }
  setMargin(body, margin) { this.#set("tact_world_set_margin", body, margin); }
  /** null: the margin, whatever that becomes. */
  setRestOffset(body, restOffset) {
    withMemory((take) => call("tact_world_set_rest_offset", this.#handle, this.#body(take, body),
      restOffset === null ? 0 : doubles(take, [restOffset], 1, "restOffset")));
  }
  /** Arrays that are left out set nothing. */
  setFeatureSettings(body, settings) {
    const given = Object.entries(allHeld(settings));
    withMemory((take) => {
      const at = make(take, "tact_feature_settings");
      for (const [name, numbers] of given) {
        const Kind = FEATURE_SETTINGS[name];
        if (!Object.hasOwn(FEATURE_SETTINGS, name)) throw new TactError("invalid_argument", `there is no array ${name}; there are ${Object.keys(FEATURE_SETTINGS).join(", ")}`);
        if (numbers === undefined) continue;
        const { first, count } = (Kind === Float64Array ? float64s : uint32s)(take, numbers, name);
        write("tact_feature_settings", at, { [name]: first, [countOf(name)]: count });
      }
      call("tact_world_set_feature_settings", this.#handle, this.#body(take, body), at);
    });
  }
  setSelfContact(body, wanted) { this.#set("tact_world_set_self_contact", body, wanted ? 1 : 0); }
  setSelfContactFilter(body, { restPositions, ...filter } = {}) {
    const rest = held(restPositions);
    withMemory((take) => call("tact_world_set_self_contact_filter", this.#handle, this.#body(take, body), make(take, "tact_self_contact_filter",
      { ...filter, restPositions: rest && positionsOf(take, rest) })));
  }
  setExcludedLabels(labels, excluded) {
    withMemory((take) => call("tact_world_set_excluded_labels", this.#handle, make(take, "tact_label_pair", labels), excluded ? 1 : 0));
  }

  /** Calls what replaces the result of the last call of its kind, unless it is refused before it begins. */
  #step(kind, name, ...values) {
    const before = this.#steps[kind];
    this.#steps[kind] += 1;
    const failure = failureOf(name, this.#handle, ...values);
    if (failure && REFUSED.has(failure.code)) this.#steps[kind] = before;
    if (failure) throw failure;
  }
  /** Takes one step. The report is valid until the next one. */
  detect() {
    this.#step("detect", "tact_world_detect");
    return new Report(this, this.#steps);
  }
  detectMotion({ wanted = "all", distance, bounds = false } = {}) {
    // What tact_c.h would refuse, too, but only after it has forgotten what it found before.
    if (distance !== undefined && !(distance >= 0 && distance <= LARGEST)) {
      throw new TactError("invalid_argument", `distance of motion is ${distance}, not 0 to 2^300`);
    }
    withMemory((take) => this.#step("motion", "tact_world_detect_motion_by", make(take, "tact_motion_options",
      { wanted: numberOf("tact_impacts", wanted), hasDistance: distance !== undefined, distance, bounds })));
    return new MotionReport(this, this.#steps);
  }

  /** All that later answers depend on, as bytes. */
  save() {
    return withMemory((take) => {
      const count = take(4);
      call("tact_world_save", this.#handle, 0, 0, count);
      const room = wordAt(count), bytes = take(room);
      call("tact_world_save", this.#handle, bytes, room, count);
      return copyOf(Uint8Array, bytes, room);
    });
  }
  restore(bytes) {
    if (!Number.isSafeInteger(bytes?.length)) throw new TactError("invalid_argument", "a state is no array of bytes");
    const saved = isInside(bytes) ? bytes.slice() : bytes;
    withMemory((take) => {
      const at = take(saved.length);
      viewOf(Uint8Array, at, saved.length).set(saved);
      call("tact_world_restore", this.#handle, at, saved.length);
    });
    this.#steps.detect += 1;
    this.#steps.motion += 1;
    this.#bodies.restored();
    this.bodies();
  }

  #get(reader, bytes, name, body) {
    return withMemory((take) => result(reader, bytes, name, this.#handle, this.#body(take, body)));
  }
  contains(body) { return this.#get(flagAt, 1, "tact_world_contains", body); }
  get bodyCount() { return result(wordAt, 4, "tact_world_body_count", this.#handle); }
  bodies() { return this.#listed("tact_world_bodies", "tact_body").map((body) => this.bodyOf(body)); }
  nameOf(body) { return stringAt(this.#get(wordAt, 4, "tact_world_name", body)); }
  surfaceOf(body) { return nameOf("tact_surface", this.#get(wordAt, 4, "tact_world_surface", body)); }
  motionOf(body) { return nameOf("tact_motion", this.#get(wordAt, 4, "tact_world_motion", body)); }
  groupOf(body) { return this.#get(wordAt, 4, "tact_world_group", body); }
  layerOf(body) { return this.#get(wordAt, 4, "tact_world_layer", body); }
  maskOf(body) { return this.#get(wordAt, 4, "tact_world_mask", body); }
  externalIdOf(body) { return this.#get(longAt, 8, "tact_world_external_id", body); }
  keyOf(body) { return this.#get(longAt, 8, "tact_world_key", body); }
  marginOf(body) { return this.#get(doubleAt, 8, "tact_world_margin", body); }
  restOffsetOf(body) { return this.#get(doubleAt, 8, "tact_world_rest_offset", body); }
  featureSettingsOf(body) {
    return withMemory((take) => {
      const at = make(take, "tact_feature_settings");
      call("tact_world_feature_settings", this.#handle, this.#body(take, body), at);
      const found = read("tact_feature_settings", at);
      return Object.fromEntries(Object.entries(FEATURE_SETTINGS).map(([name, Kind]) => [name, copyOf(Kind, found[name], found[countOf(name)])]));
    });
  }
  labelsOf(body, vertices) {
    return withMemory((take) => {
      const { first, count } = int32s(take, vertices, "vertices"), at = take(sizeOf("tact_feature_labels"));
      if (count !== 3) throw new TactError("wrong_size", `a feature has 3 vertices, of which -1 fills up, not ${count}`);
      call("tact_world_labels", this.#handle, this.#body(take, body), first, at);
      return read("tact_feature_labels", at);
    });
  }
  selfContactOf(body) { return this.#get(flagAt, 1, "tact_world_self_contact", body); }
  selfContactFilterOf(body) {
    return withMemory((take) => {
      const at = make(take, "tact_self_contact_filter");
      call("tact_world_self_contact_filter", this.#handle, this.#body(take, body), at);
      const { rings, restDistance, restPositions: { first, count } } = read("tact_self_contact_filter", at);
      return { rings, restDistance, restPositions: copyOf(Float64Array, first, 3 * count) };
    });
  }
  areExcludedLabels(labels) {
    return withMemory((take) => result(flagAt, 1, "tact_world_excluded_labels", this.#handle, make(take, "tact_label_pair", labels)));
  }
  isExcluded(a, b) {
    return withMemory((take) => result(flagAt, 1, "tact_world_excluded", this.#handle, this.#body(take, a), this.#body(take, b)));
  }
  vertexCountOf(body) { return this.#get(wordAt, 4, "tact_world_vertex_count", body); }
  facetCountOf(body) { return this.#get(wordAt, 4, "tact_world_facet_count", body); }
  edgeCountOf(body) { return this.#get(wordAt, 4, "tact_world_edge_count", body); }
  pointCountOf(body) { return this.#get(wordAt, 4, "tact_world_point_count", body); }
  planeOf(body) {
    return withMemory((take) => {
      const is = take(1), plane = take(sizeOf("tact_plane"));
      call("tact_world_plane", this.#handle, this.#body(take, body), is, plane);
      return flagAt(is) ? read("tact_plane", plane) : null;
    });
  }
  boundsOf(body) { return this.#get((at) => read("tact_bounds", at), sizeOf("tact_bounds"), "tact_world_bounds", body); }

  #copied(Kind, name, body, length) {
    return withMemory((take) => {
      const at = take(length * Kind.BYTES_PER_ELEMENT);
      call(name, this.#handle, this.#body(take, body), at, length);
      return copyOf(Kind, at, length);
    });
  }
  positionsOf(body) { return this.#copied(Float64Array, "tact_world_copy_positions", body, 3 * this.vertexCountOf(body)); }
  facetsOf(body) { return this.#copied(Int32Array, "tact_world_copy_facets", body, 3 * this.facetCountOf(body)); }
  edgesOf(body) { return this.#copied(Int32Array, "tact_world_copy_edges", body, 2 * this.edgeCountOf(body)); }
  pointsOf(body) { return this.#copied(Int32Array, "tact_world_copy_points", body, this.pointCountOf(body)); }

  checkSurface(body, sliver = 1e-6) {
    return withMemory((take) => {
      const solid = take(1), count = take(4), at = this.#body(take, body);
      call("tact_world_check_surface", this.#handle, at, sliver, solid, 0, 0, count);
      const room = wordAt(count), faults = take(room * sizeOf("tact_surface_fault"));
      call("tact_world_check_surface", this.#handle, at, sliver, solid, faults, room, count);
      return { solid: flagAt(solid), faults: readAll("tact_surface_fault", faults, room) };
    });
  }

  /** The elements that a function writes up to a capacity of. */
  #listed(name, struct, ...values) {
    return withMemory((take) => {
      const count = take(4);
      call(name, this.#handle, ...values, 0, 0, count);
      const room = wordAt(count), at = take(room * sizeOf(struct));
      call(name, this.#handle, ...values, at, room, count);
      return readAll(struct, at, room);
    });
  }
  /** The answers to many queries: a list for each. */
  #listedEach(name, struct, queries, count) {
    return withMemory((take) => {
      const ends = take(4 * count);
      if (count === 0) return [];
      call(name, this.#handle, queries, count, 0, 0, ends);
      const end = () => copyOf(Uint32Array, ends, count), room = end()[count - 1], at = take(room * sizeOf(struct));
      call(name, this.#handle, queries, count, at, room, ends);
      const all = readAll(struct, at, room);
      return Array.from(end()).map((one, i, every) => all.slice(i === 0 ? 0 : every[i - 1], one));
    });
  }

  castRay(ray, wanted = "first") {
    return hitOrNone(this, withMemory((take) => result((at) => read("tact_ray_hit", at), sizeOf("tact_ray_hit"),
      "tact_world_cast_ray", this.#handle, make(take, "tact_ray", ray), numberOf("tact_ray_hits", wanted))));
  }
  castRays(rays, wanted = "first") {
    return withMemory((take) => {
      const given = makeAll(take, "tact_ray", rays), hits = take(rays.length * sizeOf("tact_ray_hit"));
      call("tact_world_cast_rays", this.#handle, given, rays.length, numberOf("tact_ray_hits", wanted), hits);
      return readAll("tact_ray_hit", hits, rays.length).map((hit) => hitOrNone(this, hit));
    });
  }
  castRayAll(ray) {
    return withMemory((take) => this.#listed("tact_world_cast_ray_all", "tact_ray_hit", make(take, "tact_ray", ray)))
      .map((hit) => hitOrNone(this, hit));
  }
  /** An answer to each query. */
  #answers(name, query, answer, queries) {
    return withMemory((take) => {
      const given = makeAll(take, query, queries), answers = take(queries.length * sizeOf(answer));
      call(name, this.#handle, given, queries.length, answers);
      return readAll(answer, answers, queries.length);
    });
  }
  closestPoint(query) { return this.closestPoints([query])[0]; }
  closestPoints(queries) {
    return this.#answers("tact_world_closest_points", "tact_point_query", "tact_closest_point", queries).map((answer) => hitOrNone(this, answer));
  }
  signedDistance(query) { return this.signedDistances([query])[0]; }
  signedDistances(queries) {
    return this.#answers("tact_world_signed_distances", "tact_point_query", "tact_closest_point", queries).map((answer) => hitOrNone(this, answer));
  }
  #distance({ containment, ...rest }) {
    return { ...rest, a: this.bodyOf(rest.a), b: this.bodyOf(rest.b), containment: nameOf("tact_containment", containment) };
  }
  distance(query) { return this.distances([query])[0]; }
  distances(queries) {
    return this.#answers("tact_world_distances", "tact_distance_query", "tact_body_distance", queries).map((answer) => this.#distance(answer));
  }
  nearestBodies(query) {
    return withMemory((take) => this.#listed("tact_world_nearest_bodies", "tact_body_distance", make(take, "tact_nearest_bodies_query", query)))
      .map((answer) => this.#distance(answer));
  }
  sweep(sweep) { return this.sweeps([sweep])[0]; }
  sweeps(sweeps) {
    return this.#answers("tact_world_sweeps", "tact_sweep", "tact_sweep_hit", sweeps).map((hit) => hitOrNone(this, hit));
  }
  overlap(a, b) {
    return withMemory((take) => result((at) => read("tact_overlap", at), sizeOf("tact_overlap"),
      "tact_world_overlap", this.#handle, this.#body(take, a), this.#body(take, b)));
  }
  #facet({ body, facet }) { return { body: this.bodyOf(body), facet }; }
  overlapBox(box) {
    return withMemory((take) => this.#listed("tact_world_overlap_box", "tact_facet_of_body", make(take, "tact_box_query", box)))
      .map((one) => this.#facet(one));
  }
  overlapBoxes(boxes) {
    return withMemory((take) => this.#listedEach("tact_world_overlap_boxes", "tact_facet_of_body", makeAll(take, "tact_box_query", boxes), boxes.length))
      .map((list) => list.map((one) => this.#facet(one)));
  }
  bodiesContaining(query) {
    return withMemory((take) => this.#listed("tact_world_bodies_containing", "tact_body", make(take, "tact_point_query", query)))
      .map((body) => this.bodyOf(body));
  }
  bodiesContainingEach(queries) {
    return withMemory((take) => this.#listedEach("tact_world_bodies_containing_each", "tact_body", makeAll(take, "tact_point_query", queries), queries.length))
      .map((list) => list.map((body) => this.bodyOf(body)));
  }

  /** Calls the functions of `drawer`, `line`, `triangle` and `text`, with what the last step found. */
  debugDraw(drawer, options = {}) {
    withMemory((take) => drawing(drawer, (to) => call("tact_world_debug_draw", this.#handle, to, makeOptions(take, options))));
  }
  /** The same with what distances() gave. */
  debugDrawDistances(distances, drawer, options = {}) {
    withMemory((take) => {
      const all = makeAll(take, "tact_body_distance",
        distances.map((one) => ({ ...one, containment: numberOf("tact_containment", one.containment) })));
      drawing(drawer, (to) => call("tact_world_debug_draw_distances", this.#handle, all, distances.length, to, makeOptions(take, options)));
    });
  }
  /** The same with the sums of the last step. */
  debugDrawSums(impulses, drawer, options = {}) {
    withMemory((take) => {
      const all = makeAll(take, "tact_point_impulse", impulses);
      drawing(drawer, (to) => call("tact_world_debug_draw_sums", this.#handle, all, impulses.length, to, makeOptions(take, options)));
    });
  }
}
