/** The worker computes in its own thread, so that the page stays responsive. It divides runs into pieces and reads newer questions between them. */

import make from '@wasm/slipfront.mjs';
import { buffersOf, call, instanceOf, type Module } from './binding';
import type { Calls, Message, Name, News, Question, Table } from './protocol';

const milliseconds = 12;
let begin!: (made: Promise<Module>) => void;
/** Questions that arrive before the module wait for it. */
const module = new Promise<Module>((resolve) => (begin = resolve));
const cancelled = new Set<number>();
const latest = new Map<number, number>();

function say(id: number, news: News, last: boolean) {
  const message: Message = { id, last, ...news };
  postMessage(message, { transfer: buffersOf(message) });
}

/** Lets the worker receive messages before it continues. */
const breathe = () =>
  new Promise<void>((resolve) => {
    const channel = new MessageChannel();
    channel.port1.onmessage = () => (channel.port1.close(), resolve());
    channel.port2.postMessage(0);
  });

function setTable(m: Module, table: Table | null) {
  const [x, y] = table ?? [[], []];
  call(m, 'set_table', [Float64Array.from(x), Float64Array.from(y), x.length]);
}

async function pulse(q: Question & { type: 'pulse' }) {
  const m = await module;
  latest.set(q.slot, q.id);
  await breathe();
  const stopped = () => cancelled.has(q.id) || latest.get(q.slot) !== q.id;
  if (stopped()) return say(q.id, { type: 'superseded' }, true);
  setTable(m, q.table);
  const begun = call(m, 'pulse_begin', [q.slot, q.toml, q.frames, q.look, q.closure]);
  if (begun.error) return say(q.id, { type: 'answer', answer: begun }, true);
  say(q.id, { type: 'begun', begun }, false);
  let taken = 0;
  while (true) {
    const more = call(m, 'pulse_go', [q.slot, milliseconds, taken]);
    const over = more.error !== undefined || more.finished || Boolean(more.gave_up);
    taken += more.error ? 0 : more.time.length;
    say(q.id, { type: 'more', more }, over);
    if (over) return;
    await breathe();
    if (stopped()) return say(q.id, { type: 'superseded' }, true);
  }
}

onmessage = async ({ data }: MessageEvent<Question>) => {
  if (data.type === 'start') {
    begin(instanceOf(make, data.wasm));
  } else if (data.type === 'cancel') {
    cancelled.add(data.id);
  } else if (data.type === 'pulse') {
    await pulse(data);
  } else {
    const m = await module;
    say(data.id, { type: 'answer', answer: call(m, data.name, data.args as Calls[Name]['arguments']) }, true);
  }
};
