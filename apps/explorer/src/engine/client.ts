/** The page's side of the worker. */

import packed from '@wasm/slipfront.wasm';
import code from '@worker';
import { compiled } from './binding';
import { begunRun, grown, type PulseRun } from '../model/pulse_run';
import type { AnswerOf, Calls, Complaint, Message, Name, News, PulseQuestion, Question } from './protocol';

type Listener = (news: News, last: boolean) => void;

let worker: Worker | undefined;
let last = 0;
const listeners = new Map<number, Listener>();
const wasm = compiled(packed);
const codeAddress = URL.createObjectURL(new Blob([code], { type: 'text/javascript' }));

const post = (to: Worker | undefined, question: Question) => to?.postMessage(question);

function started(): Worker {
  if (worker) return worker;
  worker = new Worker(codeAddress);
  worker.onmessage = ({ data }: MessageEvent<Message>) => {
    const listener = listeners.get(data.id);
    if (data.last) listeners.delete(data.id);
    listener?.(data, data.last);
  };
  const one = worker;
  wasm.then((module) => post(one, { type: 'start', wasm: module }));
  return one;
}
started(); // while the page draws itself

function ask(question: (id: number) => Question, listener: Listener): number {
  const id = ++last;
  listeners.set(id, listener);
  post(started(), question(id));
  return id;
}

/** One call into the module. It has no answer if everything is stopped before. */
export function call<N extends Name>(name: N, ...args: Calls[N]['arguments']): Promise<AnswerOf<N>> {
  return new Promise((resolve) =>
    ask((id) => ({ type: 'call', id, name, args }), (news) => {
      if (news.type === 'answer') resolve(news.answer as AnswerOf<N>);
    }),
  );
}

/** Ends whatever runs, however long it would take. */
export function stopAll() {
  worker?.terminate();
  worker = undefined;
  const waiting = [...listeners.values()];
  listeners.clear();
  waiting.forEach((listener) => listener({ type: 'superseded' }, true));
}

/** Runs a pulse; `update` gets what there is, again and again. Returns a function that stops it. */
export function runPulse(question: PulseQuestion, update: (run: PulseRun | null, error: Complaint | undefined) => void) {
  let run: PulseRun | null = null;
  const id = ask((id) => ({ type: 'pulse', id, table: null, frames: 0, look: 0, closure: 0, ...question }), (news, last) => {
    if (news.type === 'answer' && news.answer.error) update(run, news.answer.error);
    if (news.type === 'begun') run = begunRun(news.begun);
    if (news.type !== 'more') return;
    if (news.more.error) return update(run, news.more.error);
    if (run) run = grown(run, news.more);
    update(run, last && run?.gaveUp ? { kind: 'numerics', message: run.gaveUp } : undefined);
  });
  return () => post(worker, { type: 'cancel', id });
}
