// Arguments of arrays: vertices, facets, edges.
import { SharedArray, TactError, isInside, make, numberOf, place, viewOf } from "./memory.js";

const KINDS = new Map([[Float32Array, "float32"], [Float64Array, "float64"], [Int32Array, "int32"], [Uint32Array, "uint32"], [Uint16Array, "uint16"]]);

/** Whether an array lay in memory that has moved since; `detached` is younger than the browsers that are meant here. */
function isDetached(array) {
  if (array.length > 0) return false;
  try {
    return new Uint8Array(array.buffer).length < 0;
  } catch {
    return true;
  }
}

/** Numbers in tact's memory by their place, which stays when that memory grows and moves. */
class Held {
  #Kind; #at; #length;
  constructor(numbers) {
    this.#Kind = numbers.constructor;
    this.#at = numbers.byteOffset;
    this.#length = numbers.length;
  }
  get array() { return viewOf(this.#Kind, this.#at, this.#length); }
}
/** An argument as it is valid during all of a call; to be taken before the call allocates anything. */
export const held = (numbers) => (isInside(numbers) ? new Held(numbers) : numbers);
export const allHeld = (object) => Object.fromEntries(Object.entries(object).map(([name, numbers]) => [name, held(numbers)]));

/** Numbers of rows one after the other; each row has `width`. */
function flattened(rows, width, what) {
  for (const [i, row] of rows.entries()) {  // holes, too
    if (Array.isArray(row) && row.length === width) continue;
    throw new TactError("wrong_size", `${what}: row ${i} has ${Array.isArray(row) ? row.length : "no"} numbers, not ${width}`);
  }
  return rows.flat();
}
/** Numbers as a typed array: as they are where tact takes their kind, others copied into `Kind`. Of rows each has `width`
 *  numbers, or as many as the first. */
export function typed(numbers, Kind, what, width) {
  if (numbers instanceof SharedArray || numbers instanceof Held) numbers = numbers.array;
  if (ArrayBuffer.isView(numbers) && KINDS.has(numbers.constructor)) {
    if (isDetached(numbers)) throw new TactError("wrong_order", `${what}: the memory of tact has grown; take the array of the SharedArray anew`);
    return numbers;
  }
  const isOfRows = Array.isArray(numbers) && Array.isArray(numbers[0]);
  const flat = isOfRows ? flattened(numbers, width ?? numbers[0].length, what) : numbers;
  if (flat == null || typeof flat.length !== "number") throw new TactError("invalid_argument", `${what} are no array of numbers`);
  const result = Kind.from(flat);
  // The bits of a mask may come as JavaScript computes with them: ~0 is -1.
  const isMask = (number, given) => Kind === Uint32Array && (number | 0) === given;
  if (Kind !== Float64Array && !result.every((number, i) => number === flat[i] || isMask(number, flat[i]))) {
    throw new TactError("invalid_argument", `${what} are no whole numbers of 32 bits`);
  }
  return result;
}

/** tact_columns of an array of `width` numbers each. */
export function columns(take, numbers, width, Kind, what) {
  const array = typed(numbers, Kind, what, width);
  if (array.length % width !== 0) throw new TactError("wrong_size", `${what} have ${array.length} numbers, which is no multiple of ${width}`);
  return {
    first: place(take, array),
    count: array.length / width,
    strideBytes: width * array.BYTES_PER_ELEMENT,
    kind: numberOf("tact_number_kind", KINDS.get(array.constructor)),
  };
}
export const positionsOf = (take, positions) => columns(take, positions, 3, Float64Array, "positions");
export const indicesOf = (take, indices, width, what) => columns(take, indices, width, Int32Array, what);
export const makeColumns = (take, given) => make(take, "tact_columns", given);

/** Numbers as an array of `Kind`: as they are if they are one, else copied. */
function exactly(Kind, numbers, what, width) {
  const array = typed(numbers, Kind, what, width);
  return array instanceof Kind ? array : typed(Array.from(array), Kind, what);
}
/** Numbers of one kind in memory of the call, for a pointer and a count. */
function placed(take, Kind, numbers, what, width) {
  const array = exactly(Kind, numbers, what, width);
  return { first: place(take, array), count: array.length };
}
export const int32s = (take, numbers, what) => placed(take, Int32Array, numbers, what);
export const uint32s = (take, numbers, what) => placed(take, Uint32Array, numbers, what);
export const float64s = (take, numbers, what, width) => placed(take, Float64Array, numbers, what, width);

/** `count` doubles in memory of the call. */
export function doubles(take, numbers, count, what, width) {
  const given = float64s(take, numbers, what, width);
  if (given.count !== count) throw new TactError("wrong_size", `${what} has ${given.count} numbers, not ${count}`);
  return given.first;
}
/** Three doubles a vertex in memory of the call. */
export function verticesOf(take, numbers, what) {
  const { first, count } = float64s(take, numbers, what, 3);
  if (count % 3 !== 0) throw new TactError("wrong_size", `${what} have ${count} numbers, which is no multiple of 3`);
  return { first, count: count / 3 };
}
