/** The page's side of the worker. */

import address from '@wasm/slipfront.wasm?url';
import type { Answer } from './binding';

type Listener = (answer: Answer, done: boolean) => void;

let worker: Worker | undefined;
let last = 0;
const listeners = new Map<number, Listener>();
const compiled = WebAssembly.compileStreaming(fetch(address)).catch(async () =>
  WebAssembly.compile(await (await fetch(address)).arrayBuffer()),
);

function started(): Worker {
  if (worker) return worker;
  worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
  worker.onmessage = ({ data }) => {
    const listener = listeners.get(data.id);
    if (data.done) listeners.delete(data.id);
    listener?.(data.answer, data.done);
  };
  const one = worker;
  compiled.then((wasm) => one.postMessage({ type: 'start', wasm }));
  return one;
}

function ask(question: object, listener: Listener): number {
  const id = ++last;
  listeners.set(id, listener);
  started().postMessage({ ...question, id });
  return id;
}

/** One call into the module. */
export function call(name: string, ...args: (number | string | Float64Array)[]): Promise<Answer> {
  return new Promise((resolve) => ask({ type: 'call', name, args }, (answer) => resolve(answer)));
}

/** Ends whatever runs, however long it would take. */
export function stopAll() {
  worker?.terminate();
  worker = undefined;
  const waiting = [...listeners.values()];
  listeners.clear();
  waiting.forEach((listener) => listener({ superseded: true }, true));
}

export interface PulseRun {
  x: Float64Array;
  end: number;
  frames: number;
  closure: string;
  /** Of each snapshot so far, fields one snapshot after the other. */
  series: Record<string, Float64Array>;
  fields: Record<string, Float64Array>;
  count: number;
  now: number;
  finished: boolean;
  facts: Answer;
  warnings: string[];
  gaveUp?: string;
}

const fieldNames = ['W', 'Sigma', 'U', 'slip'];

function joined(before: Float64Array | undefined, more: Float64Array): Float64Array {
  if (!before || before.length === 0) return more;
  const all = new Float64Array(before.length + more.length);
  all.set(before);
  all.set(more, before.length);
  return all;
}

function grown(run: PulseRun, more: Answer): PulseRun {
  const next = { ...run, series: { ...run.series }, fields: { ...run.fields } };
  const facts: Answer = {};
  for (const [name, value] of Object.entries(more)) {
    if (!(value instanceof Float64Array)) facts[name] = value;
    else if (fieldNames.includes(name)) next.fields[name] = joined(next.fields[name], value);
    else next.series[name] = joined(next.series[name], value);
  }
  next.count = next.series.time?.length ?? 0;
  next.now = more.now;
  next.finished = more.finished;
  next.gaveUp = more.gave_up;
  next.facts = facts;
  if (facts.warnings) next.warnings = facts.warnings;
  return next;
}

export interface PulseQuestion {
  toml: string;
  table?: [number[], number[]] | null;
  frames?: number;
  /** A single time to look at, if > 0. */
  look?: number;
  /** 0: the scenario's, 1: consistent, 2: paper. */
  closure?: number;
  /** Runs of one slot replace each other. */
  slot: number;
}

/** Runs a pulse; `update` gets what there is, again and again. Returns a function that stops it. */
export function runPulse(question: PulseQuestion, update: (run: PulseRun | null, error: Answer['error']) => void) {
  let run: PulseRun | null = null;
  const id = ask({ type: 'pulse', table: null, frames: 0, look: 0, closure: 0, ...question }, (answer, done) => {
    if (answer.superseded) return;
    if (answer.error) return update(run, answer.error);
    if (answer.begun)
      run = { series: {}, fields: {}, count: 0, now: 0, finished: false, facts: {}, warnings: [], ...(answer.begun as any) } as PulseRun;
    if (answer.more?.error) return update(run, answer.more.error);
    if (answer.more && run) run = grown(run, answer.more);
    if (answer.more) update(run, done && run?.gaveUp ? { kind: 'numerics', message: run.gaveUp } : undefined);
  });
  return () => worker?.postMessage({ type: 'cancel', id });
}

/** The same as a promise of the end. */
export function pulseToEnd(question: PulseQuestion): Promise<PulseRun> {
  return new Promise((resolve, reject) =>
    runPulse(question, (run, error) => {
      if (error) reject(error);
      else if (run?.finished) resolve(run);
    }),
  );
}
