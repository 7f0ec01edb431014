// What every solver writes beside detect(): tact/solver.h.
import { doubles, indicesOf, makeColumns, positionsOf, typed } from "./arrays.js";
import { TactError, call, copyOf, make, place, read, readAll, sizeOf, withMemory, wordAt } from "./memory.js";

/** Contact points by rows of a solver's system, in memory of JavaScript. */
export class Stencils {
  #bytes; #count;
  constructor(bytes, count) {
    this.#bytes = bytes;
    this.#count = count;
  }
  static of(world, firstRows) {
    return withMemory((take) => {
      const rows = indicesOf(take, firstRows, 1, "firstRows"), count = take(4);
      call("tact_report_stencils", world, rows.first, rows.count, 0, 0, count);
      const room = wordAt(count), at = take(room * sizeOf("tact_stencil"));
      call("tact_report_stencils", world, rows.first, rows.count, at, room, count);
      return new Stencils(copyOf(Uint8Array, at, room * sizeOf("tact_stencil")), room);
    });
  }
  get count() { return this.#count; }
  #placed(take) { return place(take, this.#bytes); }
  get all() { return withMemory((take) => readAll("tact_stencil", this.#placed(take), this.#count)); }

  #terms(name, positions, hessians, ...more) {
    return withMemory((take) => {
      const array = typed(positions, Float64Array, "positions"), vertices = array.length / 3;
      if (!(array instanceof Float64Array) || !Number.isInteger(vertices)) throw new TactError("wrong_size", "positions are 3 numbers of 64 bits a vertex");
      const n = this.#count, room = { values: take(8 * n), gradients: take(96 * n), hessians: hessians ? take(1152 * n) : 0 };
      const before = more.map((value) => (typeof value === "function" ? value(take, array.length) : value));
      const [rest, ...after] = name === "tact_stencil_barriers" ? before : [undefined, ...before];
      call(name, this.#placed(take), n, place(take, array), ...(name === "tact_stencil_barriers" ? [rest] : []), vertices, ...after, make(take, "tact_terms", room));
      const terms = { values: copyOf(Float64Array, room.values, n), gradients: copyOf(Float64Array, room.gradients, 12 * n) };
      return hessians ? { ...terms, hessians: copyOf(Float64Array, room.hessians, 144 * n) } : terms;
    });
  }
  gaps(positions, hessians = false) { return this.#terms("tact_stencil_gaps", positions, hessians); }
  barriers(positions, reach, { rest, hessians = false } = {}) {
    return this.#terms("tact_stencil_barriers", positions, hessians, (take, length) => (rest ? doubles(take, rest, length, "rest") : 0), reach);
  }
  penalties(positions, reach, hessians = false) { return this.#terms("tact_stencil_penalties", positions, hessians, reach); }
  friction(moved, limits, smoothing, hessians = false) {
    return this.#terms("tact_stencil_friction", moved, hessians, (take) => doubles(take, limits, this.#count, "limits"), smoothing);
  }
  /** A colour for each; two of one colour share no vertex below `moving`. */
  colors(moving) {
    return withMemory((take) => {
      const at = take(4 * this.#count);
      call("tact_stencil_colors", this.#placed(take), this.#count, moving, at);
      return copyOf(Int32Array, at, this.#count);
    });
  }
}

const matrix = (name, numbers, length, what) => withMemory((take) => {
  const at = take(72);
  call(name, doubles(take, numbers, length, what), at);
  return copyOf(Float64Array, at, 9);
});
/** The rotation nearest to a matrix that is orthonormal to 1e-5, row by row. */
export const nearestRotation = (given) => matrix("tact_nearest_rotation", given, 9, "matrix");
/** The rotation of a quaternion x, y, z, w. */
export const rotationOfQuaternion = (given) => matrix("tact_rotation_of_quaternion", given, 4, "quaternion");

/** A mesh without the vertices that repeat an earlier position. */
export function weld(positions, facets) {
  return withMemory((take) => {
    const given = positionsOf(take, positions), corners = indicesOf(take, facets, 3, "facets");
    const room = { positions: take(24 * given.count), facets: take(12 * corners.count), vertexOf: take(4 * given.count) };
    const mesh = make(take, "tact_welded_mesh", room);
    call("tact_weld", makeColumns(take, given), makeColumns(take, corners), mesh);
    const { vertices, mergedVertices, collapsedFacets } = read("tact_welded_mesh", mesh);
    return {
      positions: copyOf(Float64Array, room.positions, 3 * vertices), facets: copyOf(Int32Array, room.facets, 3 * corners.count),
      vertexOf: copyOf(Int32Array, room.vertexOf, given.count), mergedVertices, collapsedFacets,
    };
  });
}
