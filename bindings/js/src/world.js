// Worlds: bodies, steps, queries.
import { doubles, indicesOf, makeColumns, positionsOf, typed } from "./arrays.js";
import { MotionReport, Report } from "./report.js";
import {
  call, callees, copyOf, doubleAt, library, longAt, make, makeAll, nameOf, numberOf, placeString, read, readAll, result, sizeOf,
  stringAt, viewOf, withMemory, wordAt, write,
} from "./memory.js";

const worlds = new FinalizationRegistry((handle) => library().tact_world_destroy(handle));
let callers = 0;
const flagAt = (at) => viewOf(Uint8Array, at, 1)[0] !== 0;
const hitOrNone = (world, hit) => (hit.facet < 0 ? null : { ...hit, body: world.bodyOf(hit.body) });

/** A set of bodies and the contacts among them. */
export class World {
  #handle; #caller = ++callers; #bodies = new Map(); #steps = { detect: 0, motion: 0 };

  constructor(settings = {}) {
    this.#handle = withMemory((take) => result(longAt, 8, "tact_world_create", this.#settings(take, settings)));
    worlds.register(this, this.#handle, this);
  }
  /** Frees the world's memory now; otherwise it is freed some time after nothing names the world. */
  destroy() {
    call("tact_world_destroy", this.#handle);
    worlds.unregister(this);
    callees.message.delete(this.#caller);
  }
  get handle() { return this.#handle; }

  #settings(take, { onMessage, ...settings }) {
    callees.message.delete(this.#caller);
    if (onMessage) {
      callees.message.set(this.#caller, (at) => {
        const message = read("tact_message", at);
        onMessage({ ...message, a: this.bodyOf(message.a), b: this.bodyOf(message.b), text: stringAt(message.text) });
      });
    }
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
    this.#steps.detect += 1;
    withMemory((take) => call("tact_world_set_settings", this.#handle, this.#settings(take, settings)));
  }

  /** The one object that stands for a body; null for no body. */
  bodyOf({ index, generation, world }) {
    if (generation === 0) return null;
    const known = this.#bodies.get(index);
    if (known?.generation === generation && known.world === world) return known;
    const body = Object.freeze({ index, generation, world });
    this.#bodies.set(index, body);
    return body;
  }
  /** The body whose index stands in an array of a report. */
  bodyAt(index) {
    return this.#bodies.get(index) ?? this.bodies().find((body) => body.index === index) ?? null;
  }
  #body(take, body) { return make(take, "tact_body", body ?? {}); }  // of no body tact says what is wrong
  #added(take, name, at) {
    const body = take(sizeOf("tact_body"));
    call(name, this.#handle, at, body);
    return this.bodyOf(read("tact_body", body));
  }

  addBody({ positions = [], facets, edges, points, name, key, ...rest }) {
    return withMemory((take) => {
      const definition = make(take, "tact_body_definition", { ...rest, positions: positionsOf(take, positions) });
      if (facets) write("tact_body_definition", definition, { facets: indicesOf(take, facets, 3, "facets") });
      if (edges) write("tact_body_definition", definition, { edges: indicesOf(take, edges, 2, "edges") });
      if (points) {
        const { first, count } = indicesOf(take, typed(Array.from(points), Int32Array, "points"), 1, "points");
        write("tact_body_definition", definition, { points: first, pointCount: count });
      }
      if (name !== undefined) write("tact_body_definition", definition, { name: placeString(take, String(name)) });
      if (key !== undefined) write("tact_body_definition", definition, { hasKey: true, key });
      return this.#added(take, "tact_world_add_body", definition);
    });
  }
  addPlane({ name, key, ...rest }) {
    return withMemory((take) => {
      const definition = make(take, "tact_plane_definition", rest);
      if (name !== undefined) write("tact_plane_definition", definition, { name: placeString(take, String(name)) });
      if (key !== undefined) write("tact_plane_definition", definition, { hasKey: true, key });
      return this.#added(take, "tact_world_add_plane", definition);
    });
  }
  removeBody(body) { this.#set("tact_world_remove_body", body); }

  #set(name, body, ...values) {
    withMemory((take) => call(name, this.#handle, this.#body(take, body), ...values));
  }
  setPositions(body, positions) {
    withMemory((take) => call("tact_world_set_positions", this.#handle, this.#body(take, body), makeColumns(take, positionsOf(take, positions))));
  }
  setPositionsOfMany(updates) {
    withMemory((take) => {
      const all = updates.map(({ body, positions }) => ({ body, positions: positionsOf(take, positions) }));
      call("tact_world_set_positions_of_many", this.#handle, makeAll(take, "tact_positions_update", all), all.length);
    });
  }
  setFacets(body, positions, facets, vertexMap) {
    withMemory((take) => {
      const map = indicesOf(take, vertexMap, 1, "vertexMap");
      call("tact_world_set_facets", this.#handle, this.#body(take, body), makeColumns(take, positionsOf(take, positions)),
        makeColumns(take, indicesOf(take, facets, 3, "facets")), map.first, map.count);
    });
  }
  setPose(body, rotation, translation) {
    withMemory((take) => call("tact_world_set_pose", this.#handle, this.#body(take, body),
      doubles(take, rotation, 9, "rotation"), doubles(take, translation, 3, "translation")));
  }
  setPoses(updates) {
    withMemory((take) => call("tact_world_set_poses", this.#handle, makeAll(take, "tact_pose_update",
      updates.map(({ rotation, ...rest }) => ({ ...rest, rotation: rotation.flat?.() ?? rotation }))), updates.length));
  }
  setLayers(body, layer, mask) { this.#set("tact_world_set_layers", body, layer, mask); }
  setGroup(body, group) { this.#set("tact_world_set_group", body, group); }
  setExcluded(a, b, excluded) {
    withMemory((take) => call("tact_world_set_excluded", this.#handle, this.#body(take, a), this.#body(take, b), excluded ? 1 : 0));
  }
  setMotion(body, motion) { this.#set("tact_world_set_motion", body, numberOf("tact_motion", motion)); }
  setMargin(body, margin) { this.#set("tact_world_set_margin", body, margin); }
  setSelfContact(body, wanted) { this.#set("tact_world_set_self_contact", body, wanted ? 1 : 0); }

  /** Takes one step. The report is valid until the next one. */
  detect() {
    this.#steps.detect += 1;
    call("tact_world_detect", this.#handle);
    return new Report(this, this.#steps);
  }
  detectMotion({ wanted = "all", distance, bounds = false } = {}) {
    this.#steps.motion += 1;
    withMemory((take) => call("tact_world_detect_motion_by", this.#handle, make(take, "tact_motion_options",
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
    this.#steps.detect += 1;
    this.#steps.motion += 1;
    withMemory((take) => {
      const at = take(bytes.length);
      viewOf(Uint8Array, at, bytes.length).set(bytes);
      call("tact_world_restore", this.#handle, at, bytes.length);
    });
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
  selfContactOf(body) { return this.#get(flagAt, 1, "tact_world_self_contact", body); }
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
      const hits = take(rays.length * sizeOf("tact_ray_hit"));
      call("tact_world_cast_rays", this.#handle, makeAll(take, "tact_ray", rays), rays.length, numberOf("tact_ray_hits", wanted), hits);
      return readAll("tact_ray_hit", hits, rays.length).map((hit) => hitOrNone(this, hit));
    });
  }
  castRayAll(ray) {
    return withMemory((take) => this.#listed("tact_world_cast_ray_all", "tact_ray_hit", make(take, "tact_ray", ray)))
      .map((hit) => hitOrNone(this, hit));
  }
  closestPoint(query) { return this.closestPoints([query])[0]; }
  closestPoints(queries) {
    return withMemory((take) => {
      const answers = take(queries.length * sizeOf("tact_closest_point"));
      call("tact_world_closest_points", this.#handle, makeAll(take, "tact_point_query", queries), queries.length, answers);
      return readAll("tact_closest_point", answers, queries.length).map((answer) => hitOrNone(this, answer));
    });
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
    withMemory((take) => {
      const at = take(sizeOf("tact_debug_draw_options"));
      call("tact_debug_draw_defaults", at);
      write("tact_debug_draw_options", at, Object.fromEntries(Object.entries(options).map(([key, value]) =>
        [key, Array.isArray(value) ? { red: value[0], green: value[1], blue: value[2], alpha: value[3] ?? 1 } : value])));
      callees.draw = drawer;
      try {
        call("tact_world_debug_draw", this.#handle, library().tact_js_drawer(0), at);
      } finally {
        callees.draw = null;
      }
    });
  }
}
