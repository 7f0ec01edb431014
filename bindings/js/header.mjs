// Reads tact_c.h with its parts and writes what the package needs of it, so that nothing of the interface is told twice:
//   node header.mjs HEADER abi.js abi.c exported
// abi.js: the values of enums, and where the fields of structs lie in WebAssembly's memory. abi.c: the same as assertions
// for the compiler, and functions that give the default of each struct. exported: the functions, as em++ is told them.
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";

// Of wasm32: bytes and alignment are equal.
const SIZES = { bool: 1, uint8_t: 1, uint16_t: 2, int: 4, int32_t: 4, uint32_t: 4, float: 4, size_t: 4, double: 8, int64_t: 8, uint64_t: 8 };
const POINTER = 4;

function withoutComments(text) {
  return text.replace(/\/\*[\s\S]*?\*\//g, " ");
}

/** By name the values in the order of their numbers, without what all names begin with: ["closed", "sheet"]. */
function enumsOf(text) {
  const enums = {};
  for (const [, body, name] of text.matchAll(/typedef enum \w+ \{([^}]*)\} (\w+);/g)) {
    const entries = [...body.matchAll(/(\w+) = (\d+)/g)].map(([, key, number]) => [key, Number(number)]);
    if (name === "tact_error") continue;  // tact_error_code_name() tells these
    const words = entries.map(([key]) => key.split("_"));
    let common = 0;
    while (words.every((one) => one.length > common + 1 && one[common] === words[0][common])) ++common;
    enums[name] = [];
    entries.forEach(([, number], i) => { enums[name][number] = words[i].slice(common).join("_").toLowerCase(); });
  }
  return enums;
}

/** What a comment after a field names first: an enum, or nothing. */
function enumOfField(text, struct, field, enums) {
  const body = text.slice(text.indexOf(`typedef struct ${struct} {`), text.indexOf(`\n} ${struct};`));
  const named = body.match(new RegExp(`\\b${field};\\s*/\\*\\*< (tact_\\w+)`))?.[1];
  return named in enums ? named : undefined;
}

/** The fields of the structs in the order of the header, where a struct stands before its uses. */
function structsOf(commented, enums) {
  const text = withoutComments(commented);
  const structs = {};
  const shapeOf = (type) => {
    if (type in SIZES) return { size: SIZES[type], align: SIZES[type] };
    if (type in structs) return structs[type];
    throw new Error(`tact_c.h has a type that is unknown here: ${type}`);
  };
  for (const [, body, name] of text.matchAll(/typedef struct \w+ \{([\s\S]*?)\n\} (\w+);/g)) {
    const fields = [];
    let offset = 0, align = 1;
    for (const line of body.split(";").map((one) => one.trim()).filter(Boolean)) {
      const pointer = /\*/.test(line) || /\(\*/.test(line);
      const called = line.match(/\(\*(\w+)\)/) ?? line.match(/(\w+)(?:\[(\d+)\])?$/);
      const type = pointer || /\w_function /.test(line) ? "pointer" : line.replace(/^const /, "").split(/\s+/)[0];
      const shape = type === "pointer" ? { size: POINTER, align: POINTER } : shapeOf(type);
      const count = pointer ? 1 : Number(called[2] ?? 0);
      offset = Math.ceil(offset / shape.align) * shape.align;
      const values = enumOfField(commented, name, called[1], enums);
      fields.push({ name: called[1], type, offset, ...(count > 1 ? { count } : {}), ...(values ? { values } : {}) });
      offset += shape.size * Math.max(count, 1);
      align = Math.max(align, shape.align);
    }
    structs[name] = { size: Math.ceil(offset / align) * align, align, fields };
  }
  return structs;
}

/** tact_c.h and what it includes, each part once and before what uses it. */
export function readHeader(path, seen = new Set()) {
  if (seen.has(path)) return "";
  seen.add(path);
  return readFileSync(path, "utf8").replace(/^#include <tact\/(tact_c_\w+\.h)>$/gm, (_, part) => readHeader(join(dirname(path), part), seen));
}

export function functionsOf(text) {
  return [...withoutComments(text).matchAll(/^TACT_C_API [^(]*?(\w+)\(/gm)].map(([, name]) => name);
}

const defaultsOf = (text) => [...text.matchAll(/#define (TACT_\w+)_INIT\b/g)].map(([, name]) => name.toLowerCase());

function source(structs, defaults) {
  const checks = Object.entries(structs).flatMap(([name, struct]) => [
    `_Static_assert(sizeof(${name}) == ${struct.size}, "${name}");`,
    ...struct.fields.map((field) => `_Static_assert(offsetof(${name}, ${field.name}) == ${field.offset}, "${name}.${field.name}");`),
  ]);
  const functions = defaults.map((name) =>
    `const ${name}* default_${name}(void) {\n  static const ${name} made = ${name.toUpperCase()}_INIT;\n  return &made;\n}`);
  return `/* Made by header.mjs. */\n#include <stddef.h>\n#include <tact/tact_c.h>\n${[...checks, ...functions].join("\n")}\n`;
}

if (process.argv[1]?.endsWith("header.mjs")) {
  const [header, abi, c, exported] = process.argv.slice(2);
  const text = readHeader(header), enums = enumsOf(withoutComments(text)), structs = structsOf(text, enums);
  const defaults = defaultsOf(text), own = ["malloc", "free", "tact_js_message_function", "tact_js_drawer"];
  writeFileSync(abi, `// Made by header.mjs from tact_c.h.\nexport const enums = ${JSON.stringify(enums)};\nexport const structs = ${JSON.stringify(structs)};\n`);
  writeFileSync(c, source(structs, defaults));
  writeFileSync(exported, [...functionsOf(text), ...defaults.map((name) => `default_${name}`), ...own].map((name) => `_${name}`).join("\n") + "\n");
}
