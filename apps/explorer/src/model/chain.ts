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

/** Speeds of the dislocations in the last frame, from their positions a few frames earlier. */
export function speedsOf(frames: ChainFrame[]): number[] {
  const now = frames[frames.length - 1];
  const before = frames[Math.max(0, frames.length - 6)];
  if (before.x.length !== now.x.length || now.time === before.time) return Array.from(now.x, () => 0);
  return Array.from(now.x, (x, i) => Math.abs(x - before.x[i]) / (now.time - before.time));
}

/** All positions of dislocations, as CSV. */
export const csvOfPaths = (chain: Chain) =>
  ['t,dislocation,x', ...chain.frames.flatMap((frame) => Array.from(frame.x, (x, i) => `${frame.time},${i + 1},${x}`))].join('\n') + '\n';
