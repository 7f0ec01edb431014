// What every solver writes beside detect(): tact/solver.h.
import { allHeld, doubles, held, indicesOf, int32s, makeColumns, positionsOf, verticesOf } from "./arrays.js";
import { drawing, makeColor } from "./drawing.js";
import { call, copyOf, make, place, read, readAll, sizeOf, whole, withMemory, wordAt } from "./memory.js";

const SIZE = sizeOf("tact_stencil");

/** Calls fill(the room for a value, a gradient and, if wanted, a Hessian for each stencil), and gives them. */
function termsOf(take, count, hessians, fill) {
  const room = { values: take(8 * count), gradients: take(96 * count), hessians: hessians ? take(1152 * count) : 0 };
  fill(make(take, "tact_terms", room));
  const terms = { values: copyOf(Float64Array, room.values, count), gradients: copyOf(Float64Array, room.gradients, 12 * count) };
  return hessians ? { ...terms, hessians: copyOf(Float64Array, room.hessians, 144 * count) } : terms;
}
/** Positions at rest as the functions of barriers take them; null for none. */
const restOf = (take, rest, vertices) => (rest ? doubles(take, rest, 3 * vertices, "rest", 3) : 0);

/** Stencils by rows of a solver's system, in memory of JavaScript. */
export class Stencils {
  #bytes; #count;
  constructor(bytes, count) {
    this.#bytes = bytes;
    this.#count = count;
  }
  /** Those that write(address, capacity, address of their number) tells. */
  static #written(take, write) {
    const count = take(4);
    write(0, 0, count);
    const room = wordAt(count), at = take(room * SIZE);
    write(at, room, count);
    return new Stencils(copyOf(Uint8Array, at, room * SIZE), room);
  }
  static ofPoints(handle, firstRows) {
    return withMemory((take) => {
      const rows = int32s(take, firstRows, "firstRows");
      return Stencils.#written(take, (...room) => call("tact_report_stencils", handle, rows.first, rows.count, ...room));
    });
  }
  static ofImpacts(handle, firstRows, begin, end) {
    const way = allHeld({ firstRows, begin, end });
    return withMemory((take) => {
      const rows = int32s(take, way.firstRows, "firstRows"), from = verticesOf(take, way.begin, "begin");
      const to = doubles(take, way.end, 3 * from.count, "end", 3);
      return Stencils.#written(take, (...room) =>
        call("tact_motion_stencils", handle, rows.first, rows.count, from.first, to, from.count, ...room));
    });
  }
  get count() { return this.#count; }
  get all() { return withMemory((take) => readAll("tact_stencil", this.placed(take), this.#count)); }
  /** Where they lie in memory of the call. */
  placed(take) { return place(take, this.#bytes); }

  /** What `name` gives at values of the vertices; `more(take, number of vertices)`: its arguments after these. */
  #terms(name, values, what, hessians, more = () => []) {
    return withMemory((take) => {
      const { first, count } = verticesOf(take, values, what), after = more(take, count);
      return termsOf(take, this.#count, hessians, (terms) => call(name, this.placed(take), this.#count, first, count, ...after, terms));
    });
  }
  gaps(positions, { hessians = false } = {}) { return this.#terms("tact_stencil_gaps", positions, "positions", hessians); }
  barriers(positions, reach, { rest, hessians = false } = {}) {
    const at = allHeld({ positions, rest });
    return withMemory((take) => {
      const { first, count } = verticesOf(take, at.positions, "positions"), still = restOf(take, at.rest, count);
      return termsOf(take, this.#count, hessians,
        (terms) => call("tact_stencil_barriers", this.placed(take), this.#count, first, still, count, reach, terms));
    });
  }
  penalties(positions, reach, { hessians = false } = {}) {
    return this.#terms("tact_stencil_penalties", positions, "positions", hessians, () => [reach]);
  }
  friction(moved, limits, smoothing, { hessians = false } = {}) {
    const most = held(limits);
    return this.#terms("tact_stencil_friction", moved, "moved", hessians, (take) => [doubles(take, most, this.#count, "limits"), smoothing]);
  }
  /** How fast the gap of each grows at velocities of the vertices. */
  gapRates(velocities) {
    return withMemory((take) => {
      const { first, count } = verticesOf(take, velocities, "velocities"), rates = take(8 * this.#count);
      call("tact_stencil_gap_rates", this.placed(take), this.#count, first, count, rates);
      return copyOf(Float64Array, rates, this.#count);
    });
  }
  /** A colour for each; two of one colour share no vertex below `moving`. */
  colors(moving) {
    return withMemory((take) => {
      const at = take(4 * this.#count), below = whole("size_t", moving, "moving");
      call("tact_stencil_colors", this.placed(take), this.#count, below, at);
      return copyOf(Int32Array, at, this.#count);
    });
  }
  debugDraw(positions, drawer, color) {
    withMemory((take) => {
      const { first, count } = verticesOf(take, positions, "positions"), stencils = this.placed(take), shade = makeColor(take, color);
      drawing(drawer, (to) => call("tact_stencil_debug_draw", stencils, this.#count, first, count, to, shade));
    });
  }
}

/** The pairs within reach by rows of a solver's system: with all vertices of both features, and with the closest alone. */
export class ReachStencils {
  constructor(whole, closest) {
    this.whole = whole;
    this.closest = closest;
  }
  static of(handle, firstRows) {
    return withMemory((take) => {
      const rows = int32s(take, firstRows, "firstRows"), count = take(4);
      const write = (...room) => call("tact_report_stencils_within_reach", handle, rows.first, rows.count, ...room, count);
      write(0, 0, 0);
      const room = wordAt(count), places = [take(room * SIZE), take(room * SIZE)];
      write(...places, room);
      return new ReachStencils(...places.map((at) => new Stencils(copyOf(Uint8Array, at, room * SIZE), room)));
    });
  }
  get count() { return this.whole.count; }
  barriers(positions, reach, { rest, hessians = false } = {}) {
    const at = allHeld({ positions, rest });
    return withMemory((take) => {
      const { first, count } = verticesOf(take, at.positions, "positions"), still = restOf(take, at.rest, count);
      const pairs = [this.whole.placed(take), this.closest.placed(take), this.count];
      return termsOf(take, this.count, hessians, (terms) => call("tact_stencil_reach_barriers", ...pairs, first, still, count, reach, terms));
    });
  }
}

const matrix = (name, numbers, length, what) => withMemory((take) => {
  const given = doubles(take, numbers, length, what), at = take(72);
  call(name, given, at);
  return copyOf(Float64Array, at, 9);
});
/** The rotation nearest to a matrix that is orthonormal to 1e-5, row by row. */
export const nearestRotation = (given) => matrix("tact_nearest_rotation", given, 9, "matrix");
/** The rotation of a quaternion x, y, z, w. */
export const rotationOfQuaternion = (given) => matrix("tact_rotation_of_quaternion", given, 4, "quaternion");

/** A mesh without the vertices that repeat an earlier position. */
export function weld(positions, facets) {
  const mesh = allHeld({ positions, facets });
  return withMemory((take) => {
    const given = positionsOf(take, mesh.positions), corners = indicesOf(take, mesh.facets, 3, "facets");
    const room = { positions: take(24 * given.count), facets: take(12 * corners.count), vertexOf: take(4 * given.count) };
    const welded = make(take, "tact_welded_mesh", room);
    call("tact_weld", makeColumns(take, given), makeColumns(take, corners), welded);
    const { vertices, mergedVertices, collapsedFacets } = read("tact_welded_mesh", welded);
    return {
      positions: copyOf(Float64Array, room.positions, 3 * vertices), facets: copyOf(Int32Array, room.facets, 3 * corners.count),
      vertexOf: copyOf(Int32Array, room.vertexOf, given.count), mergedVertices, collapsedFacets,
    };
  });
}
