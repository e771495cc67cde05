/** Calls functions of the WebAssembly module with texts and numbers. The answer is an object; its arrays are copies of the module's memory. */

import type { AnswerOf, Calls, Name } from './protocol';

/** The parts of the module from emscripten that we use. */
export interface Module {
  _malloc(bytes: number): number;
  _free(address: number): void;
  _numbers(): number;
  lengthBytesUTF8(text: string): number;
  stringToUTF8(text: string, address: number, bytes: number): void;
  UTF8ToString(address: number): string;
  HEAPF64: Float64Array;
  [name: string]: unknown;
}

export type Make = (options: object) => Promise<Module>;

/** Compiles a module that the page contains as base64 of its gzipped bytes. */
export function compiled(packed: string): Promise<WebAssembly.Module> {
  const letters = atob(packed);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  const stream = new Response(bytes).body!.pipeThrough(new DecompressionStream('gzip'));
  return WebAssembly.compileStreaming(new Response(stream, { headers: { 'Content-Type': 'application/wasm' } }));
}

export const instanceOf = (make: Make, wasm: WebAssembly.Module) =>
  make({
    instantiateWasm(imports: WebAssembly.Imports, receive: (instance: WebAssembly.Instance) => void) {
      WebAssembly.instantiate(wasm, imports).then(receive);
      return {};
    },
  });

const isObject = (value: unknown): value is Record<string, unknown> => value !== null && typeof value === 'object';

function withArrays(value: unknown, heap: Float64Array, base: number): unknown {
  if (Array.isArray(value)) return value.map((item) => withArrays(item, heap, base));
  if (!isObject(value)) return value;
  const place = value.$;
  if (Array.isArray(place)) return heap.slice(base + place[0], base + place[0] + place[1]);
  for (const key of Object.keys(value)) value[key] = withArrays(value[key], heap, base);
  return value;
}

export function call<N extends Name>(module: Module, name: N, args: Calls[N]['arguments']): AnswerOf<N> {
  const taken: number[] = [];
  const addresses = args.map((argument) => {
    if (typeof argument === 'number') return argument;
    const bytes = typeof argument === 'string' ? module.lengthBytesUTF8(argument) + 1 : 8 * argument.length + 8;
    const address = module._malloc(bytes);
    taken.push(address);
    if (typeof argument === 'string') module.stringToUTF8(argument, address, bytes);
    else module.HEAPF64.set(argument, address / 8);
    return address;
  });
  try {
    const text = module.UTF8ToString((module[`_${name}`] as (...all: number[]) => number)(...addresses));
    return withArrays(JSON.parse(text), module.HEAPF64, module._numbers() / 8) as AnswerOf<N>;
  } finally {
    taken.forEach((address) => module._free(address));
  }
}

/** The buffers of all arrays in an answer, which threads can transfer without a copy. */
export function buffersOf(value: unknown, found: ArrayBuffer[] = []): ArrayBuffer[] {
  if (value instanceof Float64Array) found.push(value.buffer as ArrayBuffer);
  else if (isObject(value)) Object.values(value).forEach((item) => buffersOf(item, found));
  return found;
}
