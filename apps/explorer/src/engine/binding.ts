/** Calls into the WebAssembly module: texts and numbers in, an object out whose arrays are copies of its memory. */

export type Value = number | string | boolean | null | Float64Array | Value[] | { [key: string]: Value };
export interface Complaint {
  kind: 'input' | 'numerics' | 'memory';
  message: string;
  key?: string;
  value?: string;
  problem?: string;
  allowed?: string;
  line?: number;
}
export type Answer = Record<string, any> & { error?: Complaint };

/** What emscripten gives. */
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

function withArrays(value: any, heap: Float64Array, base: number): any {
  if (Array.isArray(value)) return value.map((item) => withArrays(item, heap, base));
  if (value === null || typeof value !== 'object') return value;
  const place = value.$;
  if (Array.isArray(place)) return heap.slice(base + place[0], base + place[0] + place[1]);
  for (const key of Object.keys(value)) value[key] = withArrays(value[key], heap, base);
  return value;
}

export function call(module: Module, name: string, args: (number | string | Float64Array)[]): Answer {
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
    const answer = JSON.parse(text);
    return withArrays(answer, module.HEAPF64, module._numbers() / 8);
  } finally {
    taken.forEach((address) => module._free(address));
  }
}

/** The buffers of all arrays in an answer, to be handed over between threads without a copy. */
export function buffersOf(value: any, found: ArrayBuffer[] = []): ArrayBuffer[] {
  if (value instanceof Float64Array) found.push(value.buffer as ArrayBuffer);
  else if (value && typeof value === 'object') Object.values(value).forEach((item) => buffersOf(item, found));
  return found;
}
