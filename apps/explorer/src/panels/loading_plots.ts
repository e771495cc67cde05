/** The plots of a loaded chain, in SI units. */

import { crosses, type LoadedRun } from '../model/loading';
import { bestUnit, type Kind } from '../ui/format';
import type { Field } from '../ui/picture/map';
import type { Path, Spec } from '../ui/picture/spec';

function largest(values: ArrayLike<number>): number {
  let most = 0;
  for (let i = 0; i < values.length; ++i) if (Math.abs(values[i]) > most) most = Math.abs(values[i]);
  return most;
}

function scaled(kind: Kind, values: ArrayLike<number>): { unit: string; values: number[]; size: number } {
  const [unit, size] = bestUnit(kind, largest(values));
  return { unit, size, values: Array.from(values, (v) => v / size) };
}

/** The decades of slip velocity from far below that of the spring up. Before the first load, a block creeps still slower. */
const decades = ({ begun: { velocity }, speed }: LoadedRun): [number, number] => [1e-8 * velocity, 3 * Math.max(10 * velocity, largest(speed))];

/** Force and slip velocity against time, with a line at the time `now`. */
export function timeSpecs(run: LoadedRun, now: number): Spec[] {
  const t = scaled('time', [...run.time, run.begun.end]);
  const time = t.values.slice(0, -1);
  const load = scaled('stress', run.load);
  const common = { x: time, xLabel: `time, in ${t.unit}`, xRange: [0, (1.02 * run.begun.end) / t.size] as [number, number], verticals: [{ x: now / t.size, label: 'now', color: 'slow' }] };
  return [
    {
      ...common, name: 'force', title: run.begun.pulls_an_end ? 'Stress at the pushed edge' : 'Force of the spring', yLabel: `force per area, in ${load.unit}`,
      series: [{ label: 'force', y: load.values, color: 'stress' }],
      points: run.events.map((event) => ({ x: event.onset / t.size, y: event.load / load.size, label: `event at ${event.onset} s`, color: crosses(event, run) ? 'slip' : 'fast' })),
    },
    {
      ...common, name: 'slip-velocity', title: 'Fastest slip', yLabel: 'slip velocity, in m/s', yLog: true, yRange: decades(run),
      series: [{ label: 'slip velocity', y: run.speed, color: 'slip' }],
    },
  ];
}

/** The position of the front of each event, against the time since its onset. */
export function frontSpec(run: LoadedRun): Spec {
  const x = scaled('length', run.begun.fronts_x);
  const paths: Path[] = run.arrivals.map((arrivals, i) => {
    const seen = Array.from(arrivals, (at, j) => [at, x.values[j]]).filter(([at]) => Number.isFinite(at));
    return { x: seen.map(([at]) => 1e6 * at), y: seen.map(([, place]) => place), color: run.events[i] && crosses(run.events[i], run) ? 'slip' : 'fast', width: 1.3 };
  });
  // The legend has each name once.
  for (const [tint, label] of [['fast', 'stops inside'], ['slip', 'crosses the block']]) {
    const first = paths.find((path) => path.color === tint);
    if (first) first.label = label;
  }
  return { name: 'fronts', title: 'Where the front of each event is', x: [], xLabel: 'time since the onset, in µs', yLabel: `position, in ${x.unit}`, series: [], paths, yRange: [0, x.values[x.values.length - 1] * 1.03] };
}

/** The slip velocity over x and t, in decades above that of the springs. A row has the fastest of the results in its time, so that events can be seen. */
export function velocityMap(run: LoadedRun): Field {
  const { x, velocity } = run.begun;
  const [now, rows, least] = [run.time[run.time.length - 1], 240, -5];
  const t = Array.from({ length: rows }, (_, j) => ((j + 0.5) / rows) * now);
  const values = new Float64Array(rows * x.length).fill(least);
  let from = 0;
  t.forEach((_, j) => {
    let to = from;
    while (to + 1 < run.time.length && run.time[to + 1] <= ((j + 1) / rows) * now) ++to;
    for (let k = from; k <= to; ++k)
      for (let i = 0; i < x.length; ++i) values[j * x.length + i] = Math.max(values[j * x.length + i], Math.log10(Math.abs(run.velocity[k][i]) / velocity));
    from = to;
  });
  const [xUnit, xSize] = bestUnit('length', largest(x));
  const [tUnit, tSize] = bestUnit('time', run.begun.end);
  return {
    title: 'Slip velocity over position and time', name: 'velocity-map', x, t, values, tRange: [0, now], xLabel: `position, in ${xUnit}`, tLabel: `time, in ${tUnit}`,
    label: 'decades above the velocity of the springs', xFactor: 1 / xSize, tFactor: 1 / tSize, factor: 1, reach: [least, Math.ceil(Math.log10(largest(run.speed) / velocity))], lines: [],
  };
}

/** The slip along the chain at the onset of each event. */
export function slipSpec(run: LoadedRun): Spec {
  const x = scaled('length', run.begun.x);
  const last = run.slip[run.slip.length - 1];
  const slip = scaled('length', last);
  const paths: Path[] = run.events.map((event) => {
    const at = run.time.findIndex((time) => time >= event.onset + event.duration);
    return { x: x.values, y: Array.from(run.slip[at < 0 ? run.slip.length - 1 : at], (v) => v / slip.size), color: crosses(event, run) ? 'slip' : 'fast', width: 1.3 };
  });
  return { name: 'slip', title: 'Slip after each event', x: [], xLabel: `position, in ${x.unit}`, yLabel: `slip, in ${slip.unit}`, series: [], paths };
}
