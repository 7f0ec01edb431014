// Arguments of arrays: vertices, facets, edges.
import { SharedArray, TactError, make, numberOf, place } from "./memory.js";

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

/** Numbers as a typed array: as they are where tact takes their kind, others copied into `Kind`. */
export function typed(numbers, Kind, what) {
  if (numbers instanceof SharedArray) numbers = numbers.array;
  if (ArrayBuffer.isView(numbers) && KINDS.has(numbers.constructor)) {
    if (isDetached(numbers)) throw new TactError("wrong_order", `${what}: the memory of tact has grown; take the array of the SharedArray anew`);
    return numbers;
  }
  const flat = Array.isArray(numbers) && Array.isArray(numbers[0]) ? numbers.flat() : numbers;
  if (flat == null || typeof flat.length !== "number") throw new TactError("invalid_argument", `${what} are no array of numbers`);
  const result = Kind.from(flat);
  if (Kind === Int32Array && !result.every((number, i) => number === flat[i])) {
    throw new TactError("invalid_argument", `${what} are no whole numbers of 32 bits`);
  }
  return result;
}

/** tact_columns of an array of `width` numbers each. */
export function columns(take, numbers, width, Kind, what) {
  const array = typed(numbers, Kind, what);
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

/** `count` doubles in memory of the call. */
export function doubles(take, numbers, count, what) {
  const array = numbers instanceof SharedArray ? numbers.array : Float64Array.from(numbers.flat?.() ?? numbers);
  if (array.length !== count) throw new TactError("wrong_size", `${what} has ${array.length} numbers, not ${count}`);
  return place(take, array);
}
