// Runs the WebAssembly module under node, and the program for comparison. $SLIPFRONT_WASM is its folder.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const folder = process.env.SLIPFRONT_WASM;

const bytes = readFileSync(join(folder, 'slipfront.wasm'));
// We pass the bytes, because under node the module would try to fetch its file.
const make = (await import(join(folder, 'slipfront.mjs'))).default;
const module = await make({
  instantiateWasm(imports, receive) {
    WebAssembly.instantiate(bytes, imports).then((made) => receive(made.instance));
    return {};
  },
});

function withArrays(value, base) {
  if (Array.isArray(value)) return value.map((item) => withArrays(item, base));
  if (value === null || typeof value !== 'object') return value;
  if (Array.isArray(value.$)) return module.HEAPF64.slice(base + value.$[0], base + value.$[0] + value.$[1]);
  for (const key of Object.keys(value)) value[key] = withArrays(value[key], base);
  return value;
}

export function call(name, ...args) {
  const taken = [];
  const addresses = args.map((argument) => {
    if (typeof argument === 'number') return argument;
    const size = typeof argument === 'string' ? module.lengthBytesUTF8(argument) + 1 : 8 * argument.length + 8;
    const address = module._malloc(size);
    taken.push(address);
    if (typeof argument === 'string') module.stringToUTF8(argument, address, size);
    else module.HEAPF64.set(argument, address / 8);
    return address;
  });
  const answer = JSON.parse(module.UTF8ToString(module[`_${name}`](...addresses)));
  taken.forEach((address) => module._free(address));
  return withArrays(answer, module._numbers() / 8);
}

const scratch = mkdtempSync(join(tmpdir(), 'explorer-'));
export function file(name, text) {
  const path = join(scratch, name);
  writeFileSync(path, text);
  return path;
}

/** The JSON that the program prints. */
export const program = (...args) => JSON.parse(execFileSync(process.env.SLIPFRONT, [...args, '--json'], { encoding: 'utf8', maxBuffer: 1e9 }));

/** The error message of a run that must fail. */
export function refusal(...args) {
  try {
    execFileSync(process.env.SLIPFRONT, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
  } catch (error) {
    return String(error.stderr);
  }
  return '';
}
