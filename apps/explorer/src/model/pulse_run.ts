/** A `pulse` run with the snapshots so far, and interpolation between them. */

import type { PulseBegun, PulseField, PulseMore, PulseSeries } from '../engine/protocol';

export interface PulseRun extends PulseBegun {
  /** One number per snapshot so far. `fields` hold one snapshot after the other. */
  series: Record<PulseSeries, Float64Array>;
  fields: Record<PulseField, Float64Array>;
  /** Number of snapshots so far. */
  count: number;
  now: number;
  finished: boolean;
  /** null if friction is not viscous. */
  frictionCoefficient?: number | null;
  gaveUp?: string;
}

const fieldNames: PulseField[] = ['W', 'Sigma', 'U', 'slip'];
const seriesNames: PulseSeries[] = [
  'time', 'trailing_front', 'leading_front', 'slip_velocity_at_origin', 'stress_at_origin', 'slip_at_origin', 'peak_slip_velocity', 'peak_position',
  'energy_elastic', 'energy_kinetic', 'energy_dissipated', 'energy_supplied', 'potency',
];

function columns<Key extends string>(names: Key[], of: (name: Key) => Float64Array): Record<Key, Float64Array> {
  return Object.fromEntries(names.map((name) => [name, of(name)])) as Record<Key, Float64Array>;
}

function joined(before: Float64Array, more: Float64Array): Float64Array {
  if (before.length === 0) return more;
  const all = new Float64Array(before.length + more.length);
  all.set(before);
  all.set(more, before.length);
  return all;
}

export function begunRun(begun: PulseBegun): PulseRun {
  const none = () => new Float64Array(0);
  return { ...begun, series: columns(seriesNames, none), fields: columns(fieldNames, none), count: 0, now: 0, finished: false };
}

export function grown(run: PulseRun, more: PulseMore): PulseRun {
  const series = columns(seriesNames, (name) => joined(run.series[name], more[name]));
  return {
    ...run, series, fields: columns(fieldNames, (name) => joined(run.fields[name], more[name])), count: series.time.length,
    now: more.now, finished: more.finished, frictionCoefficient: more.friction_coefficient, gaveUp: more.gave_up, warnings: more.warnings ?? run.warnings,
  };
}

/** The index of the snapshot before a time, and the fraction of the interval to the next one that has passed. */
function between(times: Float64Array, time: number): [number, number] {
  const last = times.length - 1;
  let i = 0;
  while (i < last - 1 && times[i + 1] <= time) ++i;
  return [i, last < 1 ? 0 : Math.min(1, Math.max(0, (time - times[i]) / (times[i + 1] - times[i])))];
}

/** A field of a run at any time, by linear interpolation between its snapshots. */
export function fieldAt(run: PulseRun, name: PulseField, time: number): Float64Array {
  const n = run.x.length;
  const [i, share] = between(run.series.time, time);
  const field = run.fields[name];
  return Float64Array.from({ length: n }, (_, k) => field[i * n + k] * (1 - share) + (run.count < 2 ? 0 : field[(i + 1) * n + k] * share));
}

export function seriesAt(run: PulseRun, name: PulseSeries, time: number): number {
  const values = run.series[name];
  if (values.length < 2) return values[0] ?? NaN;
  const [i, share] = between(run.series.time, time);
  return share === 1 ? values[i + 1] : share === 0 ? values[i] : values[i] * (1 - share) + values[i + 1] * share;
}

/** A field in the last snapshot. */
export const last = (run: PulseRun, field: PulseField) => run.fields[field].subarray(run.fields[field].length - run.x.length);
export const lastOf = (run: PulseRun, name: PulseSeries) => run.series[name][run.series[name].length - 1];
