/** A chain with its positions and averages so far. */

import type { ChainAnswer, ChainAverages, ChainBegun, ChainFrame } from '../engine/protocol';

export interface Chain {
  begun: ChainBegun;
  frames: ChainFrame[];
  /** The latest averages; `first` are those at t = 0. */
  average: ChainAverages;
  first: ChainAverages;
}

/** Number of pictures in a whole run. */
export const pictures = 480;
/** Half the length of the part around x = 0 whose single sites are shown. */
export const halfShown = ({ left, right }: ChainBegun) => 0.12 * (right - left);

const averagesOf = (answer: ChainAnswer): ChainAverages | null => (answer.W ? (answer as ChainAverages) : null);
const frameOf = ({ time, x, sign }: ChainAnswer): ChainFrame => ({ time, x, sign });

/** The chain at t = 0, from the answer for t = 0, which has averages. */
export function begunChain(begun: ChainBegun, start: ChainAnswer): Chain {
  const average = averagesOf(start)!;
  return { begun, frames: [{ ...frameOf(start), time: 0 }], average, first: average };
}

export const advanced = (chain: Chain, more: ChainAnswer): Chain => ({
  ...chain, frames: [...chain.frames, frameOf(more)], average: averagesOf(more) ?? chain.average,
});

export const lastFrame = (chain: Chain) => chain.frames[chain.frames.length - 1];
export const isOver = (time: number, end: number) => time >= end - 1e-9;

/** Whether each dislocation moves in the last frame. One at rest trembles in its well, so we compare its position with that 24 frames before. */
export function moving({ begun, frames }: Chain): boolean[] {
  const now = frames[frames.length - 1];
  let first = frames.length - 1;
  while (first > 0 && first > frames.length - 25 && frames[first - 1].x.length === now.x.length) --first;
  const before = frames[first];
  const least = Math.max(0.005 * (now.time - before.time), (0.1 * begun.spacing) / begun.scale);
  return Array.from(now.x, (x, i) => Math.abs(x - before.x[i]) > least);
}

/** All positions of dislocations, as CSV. */
export const csvOfPaths = (chain: Chain) =>
  ['t,dislocation,x', ...chain.frames.flatMap((frame) => Array.from(frame.x, (x, i) => `${frame.time},${i + 1},${x}`))].join('\n') + '\n';
