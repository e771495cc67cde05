/** A loaded chain with its results so far, in SI units. Results are dense during slip events and sparse between them. */

import type { LoadingBegun, LoadingMore, SlipEvent } from '../engine/protocol';

type Column = 'time' | 'load' | 'speed';
export interface LoadedRun extends Record<Column, number[]> {
  begun: LoadingBegun;
  /** Slip and velocity of all sites, one array a result. */
  slip: Float64Array[];
  velocity: Float64Array[];
  events: SlipEvent[];
  /** Times after the onset at which each event arrives at `begun.fronts_x`. */
  arrivals: Float64Array[];
  now: number;
  finished: boolean;
}

export const begunLoading = (begun: LoadingBegun): LoadedRun => ({
  begun, time: [], load: [], speed: [], slip: [], velocity: [], events: [], arrivals: [], now: 0, finished: false,
});

const rows = (values: Float64Array, width: number) => Array.from({ length: width ? values.length / width : 0 }, (_, i) => values.subarray(i * width, (i + 1) * width));

export function grownLoading(run: LoadedRun, more: LoadingMore): LoadedRun {
  const sites = run.begun.x.length;
  return {
    begun: run.begun, time: [...run.time, ...more.time], load: [...run.load, ...more.load], speed: [...run.speed, ...more.speed],
    slip: [...run.slip, ...rows(more.slip, sites)], velocity: [...run.velocity, ...rows(more.velocity, sites)],
    events: more.events, arrivals: rows(more.arrivals, run.begun.fronts_x.length), now: more.now, finished: more.finished,
  };
}

/** Whether an event moved the whole chain. The others, which stop inside, are precursors. */
export const crosses = (event: SlipEvent, { begun: { x } }: LoadedRun) => event.length > 0.95 * (x[x.length - 1] - x[0]);

export function median(values: number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length ? (sorted[middle] + sorted[sorted.length - 1 - middle]) / 2 : NaN;
}

const columns = ['onset', 'duration', 'slip', 'largest_slip', 'load', 'stress_drop', 'peak_velocity', 'origin', 'length', 'rupture_velocity', 'complete'] as const;
const unitsOf: Record<(typeof columns)[number], string> = {
  onset: 's', duration: 's', slip: 'm', largest_slip: 'm', load: 'Pa', stress_drop: 'Pa', peak_velocity: 'm/s', origin: 'm', length: 'm', rupture_velocity: 'm/s', complete: '1',
};

/** All events, as CSV. */
export const csvOfEvents = (run: LoadedRun) =>
  [columns.map((name) => `${name} (${unitsOf[name]})`).join(','), ...run.events.map((event) => columns.map((name) => event[name] ?? '').join(','))].join('\n') + '\n';
