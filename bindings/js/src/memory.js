// The WebAssembly of tact, its memory, and the structs of tact_c.h in it.
import { enums, structs } from "./abi.js";
import { base64 } from "./wasm.js";

const camel = (name) => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());

/** What is wrong with a call. `code` is one of tact's, such as "stale_body"; nothing has changed. */
export class TactError extends Error {
  constructor(code, message) {
    super(message);
    this.name = "TactError";
    this.code = code;
  }
}

let wasm, view, loading;
export const callees = { message: new Map(), draw: null };
/** Destroys the world, or the kept report, of a handle some time after nothing names what was registered for it. */
export const handles = new FinalizationRegistry((handle) => wasm.tact_world_destroy(handle));

/** The functions of tact_c.h by their names. */
export function library() {
  if (!wasm) throw new TactError("wrong_order", "tact is not loaded: await ready() comes before all else");
  return wasm;
}
export const memory = () => library().memory.buffer;
function data() {
  if (view?.buffer !== wasm.memory.buffer) view = new DataView(wasm.memory.buffer);
  return view;
}

/** What package.mjs wrote: gzip in base64. */
async function unpacked(text) {
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

const BAD_FILE = 8;  // WASI's EBADF: there are no files
const system = {
  clock_time_get: (_clock, _precision, place) => (data().setBigUint64(place, BigInt(Math.round(performance.now() * 1e6)), true), 0),
  environ_sizes_get: (count, size) => (data().setUint32(count, 0, true), data().setUint32(size, 0, true), 0),
  environ_get: () => 0,
  proc_exit: (status) => { throw new TactError("internal", `tact ended with status ${status}`); },
  emscripten_notify_memory_growth: () => {},
};
const color = (at) => [0, 4, 8, 12].map((byte) => data().getFloat32(at + byte, true));
const point = (at) => [0, 8, 16].map((byte) => data().getFloat64(at + byte, true));
// No exception of JavaScript goes through the frames of C++: the first is kept until the call returns. WebAssembly gives
// addresses with a sign.
let thrown;
function kept(callee) {
  return (...values) => {
    try {
      if (!thrown) callee(...values.map((value) => value >>> 0));
    } catch (error) {
      thrown = { error };
    }
  };
}
const called = {
  message: kept((user, at) => callees.message.get(user)?.(at)),
  line: kept((_user, from, to, shade) => callees.draw.line?.(point(from), point(to), color(shade))),
  triangle: kept((_user, p, q, r, shade) => callees.draw.triangle?.(point(p), point(q), point(r), color(shade))),
  text: kept((_user, at, words, shade) => callees.draw.text?.(point(at), stringAt(words), color(shade))),
};

async function load() {
  const module = await WebAssembly.compile(await unpacked(base64)), imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    imports[from] ??= {};
    imports[from][name] = (from === "tact" ? called : system)[name] ?? (() => BAD_FILE);
  }
  const instance = await WebAssembly.instantiate(module, imports);
  wasm = instance.exports;
  wasm._initialize();
}

/** Loads tact, once. Everything else comes after it. */
export function ready() {
  return loading ??= load();
}

/** Calls a function of tact_c.h that returns an error; gives it, or null. What a function of JavaScript threw comes out. */
export function failureOf(name, ...values) {
  const code = library()[name](...values), failed = thrown;
  thrown = undefined;
  if (failed) throw failed.error;
  return code === 0 ? null : new TactError(stringAt(wasm.tact_error_code_name(code)), stringAt(wasm.tact_last_error_message()));
}
/** The same; throws the error. */
export function call(name, ...values) {
  const failure = failureOf(name, ...values);
  if (failure) throw failure;
}

export function stringAt(at) {
  const bytes = new Uint8Array(memory(), at);
  let end = 0;
  while (bytes[end] !== 0) ++end;
  return new TextDecoder().decode(bytes.slice(0, end));
}

/** Memory of tact. Its addresses have no sign; WebAssembly gives and takes 32 bits, and would cut a larger size. */
function allocated(bytes, what) {
  const at = bytes < 2 ** 32 ? library().malloc(Math.max(bytes, 1)) >>> 0 : 0;
  if (at === 0) throw new TactError("out_of_memory", `${what} not to be had`);
  return at;
}
/** Memory of one call: what take() gave is freed when the call ends. */
export function withMemory(use) {
  const taken = [];
  try {
    return use((bytes) => {
      const at = allocated(bytes, `${bytes} bytes are`);
      taken.push(at);
      return at;
    });
  } finally {
    for (const at of taken) wasm.free(at);
  }
}

/** The numbers of a typed array of `Kind` at a place. A view: valid until tact's memory grows. */
export const viewOf = (Kind, at, length) => new Kind(memory(), at, length);
export const copyOf = (Kind, at, length) => (length === 0 ? new Kind(0) : viewOf(Kind, at, length).slice());

/** Whether numbers lie in tact's memory, which moves when it grows. */
export const isInside = (numbers) => ArrayBuffer.isView(numbers) && numbers.buffer === memory();
/** The object with copies of those of its numbers that lie there: its other fields may make it grow. */
export function unmoved(object) {
  if (object == null || !Object.values(object).some(isInside)) return object;
  return Object.fromEntries(Object.entries(object).map(([key, value]) => [key, isInside(value) ? value.slice() : value]));
}

/** Copies numbers into memory of the call, unless they lie in tact's memory already. */
export function place(take, numbers) {
  if (isInside(numbers)) return numbers.byteOffset;
  const at = take(numbers.byteLength);
  viewOf(numbers.constructor, at, numbers.length).set(numbers);
  return at;
}
export function placeString(take, text, what) {
  if (text.includes("\0")) throw new TactError("invalid_argument", `${what} has a zero character, where C would end it`);
  const bytes = new TextEncoder().encode(text), at = take(bytes.length + 1), room = viewOf(Uint8Array, at, bytes.length + 1);
  room.set(bytes);
  room[bytes.length] = 0;
  return at;
}

/** A typed array in tact's memory, which is read there without a copy. `array` is to be taken anew after every call of tact,
 *  as memory that grew moves. */
export class SharedArray {
  #kind; #at; #length; #array;
  constructor(Kind, length) {
    if (!Number.isSafeInteger(length) || length < 0) throw new TactError("invalid_argument", `the length of an array is ${length}`);
    this.#at = allocated(length * Kind.BYTES_PER_ELEMENT, `an array of ${length} numbers is`);
    this.#kind = Kind;
    this.#length = length;
    this.array.fill(0);
  }
  get array() {
    if (this.#at === 0) throw new TactError("wrong_order", "the array was freed");
    if (this.#array?.buffer !== memory()) this.#array = viewOf(this.#kind, this.#at, this.#length);
    return this.#array;
  }
  free() {
    if (this.#at !== 0) wasm.free(this.#at);
    this.#at = 0;
    this.#array = null;
  }
}

const NUMBERS = {
  uint8_t: ["Uint8", 1], uint16_t: ["Uint16", 2], int: ["Int32", 4], int32_t: ["Int32", 4], uint32_t: ["Uint32", 4], size_t: ["Uint32", 4],
  pointer: ["Uint32", 4], float: ["Float32", 4], double: ["Float64", 8], int64_t: ["BigInt64", 8], uint64_t: ["BigUint64", 8],
};

/** A value as errors show it. */
export function shown(value) {
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value === "bigint") return `${value}n`;
  return value !== null && typeof value === "object" ? "an object" : String(value);
}
/** What JavaScript may give for a whole number of a type of tact_c.h, least and largest. An uint32_t may have a sign: the bits
 *  of a mask come as JavaScript computes with them, ~0 is -1. */
function limitsOf(type) {
  const [kind, bytes] = NUMBERS[type], values = 2n ** BigInt(8 * bytes), isUnsigned = kind.includes("Uint");
  const limits = [isUnsigned && type !== "uint32_t" ? 0n : -values / 2n, (isUnsigned ? values : values / 2n) - 1n];
  return bytes === 8 ? limits : limits.map(Number);
}
const LIMITS = Object.fromEntries(Object.keys(NUMBERS).filter((type) => !/float|double/.test(type)).map((type) => [type, limitsOf(type)]));
/** The value of the parameter `what` as a whole number of `type`, a BigInt where that has 64 bits. The one place where they
 *  are checked: WebAssembly would wrap and cut without a word. */
export function whole(type, value, what) {
  const isLong = NUMBERS[type][1] === 8, [least, largest] = LIMITS[type];
  if (!(Number.isSafeInteger(value) || (isLong && typeof value === "bigint")) || value < least || value > largest) {
    throw new TactError("invalid_argument", `${what} is ${shown(value)}, no whole number ${least} to ${largest}`);
  }
  return isLong ? BigInt(value) : value;
}

// `camelName`: as JavaScript names the field.
for (const struct of Object.values(structs)) for (const field of struct.fields) field.camelName = camel(field.name);
export const sizeOf = (name) => structs[name].size;
/** The number of the name of a value of an enum. */
export function numberOf(values, name) {
  const number = enums[values].indexOf(name);
  if (number < 0) throw new TactError("invalid_argument", `${shown(name)} is none of ${enums[values].filter(Boolean).join(", ")}`);
  return number;
}
export const nameOf = (values, number) => enums[values][number];

function readNumber(type, at) {
  if (type === "bool") return data().getUint8(at) !== 0;
  if (!(type in NUMBERS)) return read(type, at);
  const number = data()[`get${NUMBERS[type][0]}`](at, true);
  return type === "int64_t" ? Number(number) : number;
}
function writeNumber(type, at, value, what) {
  if (type === "bool") data().setUint8(at, value ? 1 : 0);
  else if (type in NUMBERS) data()[`set${NUMBERS[type][0]}`](at, type in LIMITS ? whole(type, value, what) : value, true);
  else write(type, at, value, what);
}
const bytesOfType = (type) => (type === "bool" ? 1 : NUMBERS[type]?.[1] ?? sizeOf(type));

/** A struct as an object. Counts are numbers, ids BigInts, values of enums their names. */
export function read(name, at) {
  const result = {};
  for (const { type, offset, count, values, camelName } of structs[name].fields) {
    if (camelName === "structSize") continue;
    result[camelName] = count ? Array.from({ length: count }, (_, i) => readNumber(type, at + offset + i * bytesOfType(type)))
      : values ? nameOf(values, readNumber(type, at + offset)) : readNumber(type, at + offset);
  }
  return result;
}

/** Sets the fields of a struct that an object has, which errors name `what`. One that the struct has not is an error. */
export function write(name, at, object, what = name) {
  const known = structs[name].fields;
  if (object == null) throw new TactError("invalid_argument", `${what} is ${object}`);
  for (const [key, value] of Object.entries(object)) {
    const field = known.find((one) => one.camelName === key);
    if (!field) throw new TactError("invalid_argument", `${name} has no ${key}; it has ${known.map((one) => one.camelName).join(", ")}`);
    if (value === undefined) continue;
    const { type, offset, count, values } = field;
    if (!count) {
      writeNumber(type, at + offset, values && typeof value === "string" ? numberOf(values, value) : value, key);
    } else {
      if (value?.length !== count) throw new TactError("wrong_size", `${key} has ${value?.length ?? "no"} numbers, not ${count}`);
      for (let i = 0; i < count; ++i) writeNumber(type, at + offset + i * bytesOfType(type), value[i], key);
    }
  }
}

/** A struct in memory of the call: its default where the header has one, else zeros, then the fields of `object`. */
export function make(take, name, object = {}) {
  const fields = unmoved(object);
  const at = take(sizeOf(name)), made = library()[`default_${name}`]?.(), room = viewOf(Uint8Array, at, sizeOf(name));
  made ? room.set(viewOf(Uint8Array, made, sizeOf(name))) : room.fill(0);
  write(name, at, fields);
  return at;
}
/** Many of a struct, one after the other. */
export function makeAll(take, name, objects) {
  const all = objects.map(unmoved), at = take(sizeOf(name) * all.length);
  all.forEach((object, i) => {
    const room = viewOf(Uint8Array, at + i * sizeOf(name), sizeOf(name)), made = library()[`default_${name}`]?.();
    made ? room.set(viewOf(Uint8Array, made, sizeOf(name))) : room.fill(0);
    write(name, at + i * sizeOf(name), object);
  });
  return at;
}
export const readAll = (name, at, count) => Array.from({ length: count }, (_, i) => read(name, at + i * sizeOf(name)));
export const wordAt = (at) => data().getUint32(at, true);
export const doubleAt = (at) => data().getFloat64(at, true);
export const longAt = (at) => data().getBigUint64(at, true);
/** What a function of tact_c.h writes into its last argument. */
export function result(reader, bytes, name, ...values) {
  return withMemory((take) => {
    const at = take(bytes);
    call(name, ...values, at);
    return reader(at);
  });
}
