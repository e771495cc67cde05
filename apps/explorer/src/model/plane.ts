/** A rupture on a plane with its results so far, in the units of the model. */

import type { PlaneBegun, PlaneMore } from '../engine/protocol';

/** One snapshot: a value for each cell, row by row from the bottom, and lines whose parts end with NaN. */
export interface Snapshot {
  time: number;
  velocity: Float64Array;
  slip: Float64Array;
  lineX: Float64Array;
  lineY: Float64Array;
}
export interface PlaneRun {
  begun: PlaneBegun;
  /** Centres of the cells. */
  x: number[];
  y: number[];
  snapshots: Snapshot[];
  time: number[];
  momentRate: number[];
  front: number[];
  /** The largest slip velocity and slip of a snapshot so far. */
  fastest: number;
  farthest: number;
  warnings: string[];
  now: number;
  finished: boolean;
  gaveUp: string;
}

const centres = (from: number, to: number, count: number) => Array.from({ length: count }, (_, i) => from + ((to - from) * (i + 0.5)) / count);

export const begunPlane = (begun: PlaneBegun): PlaneRun => ({
  begun, x: centres(begun.left, begun.right, begun.nx), y: centres(begun.bottom, begun.top, begun.ny),
  snapshots: [], time: [], momentRate: [], front: [], fastest: 0, farthest: 0, warnings: begun.warnings, now: 0, finished: false, gaveUp: '',
});

const largest = (values: Float64Array, least: number) => values.reduce((most, value) => Math.max(most, Math.abs(value)), least);

export function grownPlane(run: PlaneRun, more: PlaneMore): PlaneRun {
  const cells = run.begun.nx * run.begun.ny;
  let points = 0;
  const snapshots = Array.from(more.time, (time, i) => {
    const [first, last] = [points, (points += more.line_points[i])];
    const cellsOf = (values: Float64Array) => values.subarray(i * cells, (i + 1) * cells);
    return { time, velocity: cellsOf(more.velocity), slip: cellsOf(more.slip), lineX: more.line_x.subarray(first, last), lineY: more.line_y.subarray(first, last) };
  });
  return {
    ...run, snapshots: [...run.snapshots, ...snapshots],
    time: [...run.time, ...more.series_time], momentRate: [...run.momentRate, ...more.moment_rate], front: [...run.front, ...more.front],
    fastest: largest(more.velocity, run.fastest), farthest: largest(more.slip, run.farthest),
    warnings: [...run.begun.warnings, ...more.warnings], now: more.now, finished: more.finished, gaveUp: more.gave_up,
  };
}

/** The value of the series at a time, by straight lines between its rows. */
export function seriesAt(run: PlaneRun, values: number[], time: number): number {
  const later = run.time.findIndex((row) => row >= time);
  if (later <= 0) return later < 0 ? (values[values.length - 1] ?? NaN) : values[0];
  const share = (time - run.time[later - 1]) / (run.time[later] - run.time[later - 1]);
  return values[later - 1] + share * (values[later] - values[later - 1]);
}

/** Rows of r and slip, from the text of a CSV file with these columns. */
export function ringsOf(csv: string): [Float64Array, Float64Array] {
  const rows = csv.trim().split('\n').slice(1).map((row) => row.split(',').map(Number));
  return [0, 1].map((column) => Float64Array.from(rows, (row) => row[column])) as [Float64Array, Float64Array];
}
