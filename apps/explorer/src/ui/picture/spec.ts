/** The contents of a plot, which the page draws on the screen and exports as SVG, CSV and a table. */

import { short } from '../format';

export interface Series {
  label: string;
  y: ArrayLike<number>;
  /** The name of a colour of the style sheet, without the leading dashes. */
  color: string;
  dash?: number[];
  width?: number;
  fill?: boolean;
}
export interface Path {
  label?: string;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  color: string;
  dash?: number[];
  width?: number;
  /** Fills the inside of a closed curve. */
  fill?: boolean;
}
export interface Point {
  x: number;
  y: number;
  label: string;
  color: string;
  chosen?: boolean;
  /** The two ends of an interval. */
  xInterval?: [number, number];
}
export interface Vertical {
  x: number;
  label: string;
  color: string;
}
export interface Spec {
  /** Name for files, such as "slip-velocity". */
  name: string;
  title: string;
  x: ArrayLike<number>;
  xLabel: string;
  yLabel: string;
  series: Series[];
  paths?: Path[];
  points?: Point[];
  verticals?: Vertical[];
  /** Points that the arrow keys move. */
  handles?: { x: number[]; y: number[]; name: string };
  /** The units of the axes, divided by those of the scenario. */
  factors?: [number, number];
  xRange?: [number, number];
  yRange?: [number, number];
  xLog?: boolean;
  yLog?: boolean;
}

const finite = (value: number) => Number.isFinite(value);

export const on = (value: number, log?: boolean) => (log ? (value > 0 ? Math.log10(value) : NaN) : value);
export const off = (value: number, log?: boolean) => (log ? 10 ** value : value);

/** The range of an axis. On a logarithmic axis it is that of the decimal logarithm. */
export function rangeOf(spec: Spec, axis: 'x' | 'y'): [number, number] {
  const log = axis === 'x' ? spec.xLog : spec.yLog;
  const given = axis === 'x' ? spec.xRange : spec.yRange;
  if (given) return [on(given[0], log), on(given[1], log)];
  let least = Infinity;
  let most = -Infinity;
  const see = (values: ArrayLike<number>) => {
    for (let i = 0; i < values.length; ++i) {
      const value = on(values[i], log);
      if (!finite(value)) continue;
      if (value < least) least = value;
      if (value > most) most = value;
    }
  };
  if (axis === 'x') see(spec.x);
  else spec.series.forEach((series) => see(series.y));
  spec.paths?.forEach((path) => see(path[axis]));
  spec.points?.forEach((point) => see([point[axis]]));
  if (!finite(least)) return [0, 1];
  if (least === most) return [least - (Math.abs(least) || 1) * 0.1, most + (Math.abs(most) || 1) * 0.1];
  if (axis === 'x') return [least, most];
  if (log) return [least - 0.05 * (most - least), most + 0.05 * (most - least)];
  const room = 0.08 * (most - least);
  return [least >= 0 && least < 0.3 * most ? 0 : least - room, most + room];
}

/** The smallest range that contains zero and all these numbers. */
export function reach(...all: ArrayLike<number>[]): [number, number] {
  let [least, most] = [0, 0];
  for (const values of all)
    for (let i = 0; i < values.length; ++i) {
      if (values[i] < least) least = values[i];
      if (values[i] > most) most = values[i];
    }
  // Rounding errors around zero are not negative values.
  return [least < -1e-9 * most ? least : 0, most > -1e-9 * least ? most : 0];
}

/** The range of an axis that shows all these numbers and zero. */
export function rangeAround(...all: ArrayLike<number>[]): [number, number] {
  const [least, most] = reach(...all);
  const room = 0.08 * (most - least || 1e-12);
  return [least < 0 ? least - room : 0, most > 0 || least === 0 ? most + room : 0];
}

/** Evenly spaced ticks at 1, 2 or 5 times a power of ten, two or more. A logarithmic axis over more than two decades has whole decades. */
export function ticks([least, most]: [number, number], about: number, log?: boolean): number[] {
  const rough = (most - least) / Math.max(1, about);
  const power = 10 ** Math.floor(Math.log10(rough));
  const whole = log && most - least > 2;
  const steps = [0.1, 0.2, 0.5, 1, 2, 5, 10].map((m) => (whole ? Math.max(1, Math.round(m * power)) : m * power));
  let all: number[] = [];
  for (let i = steps.findIndex((step) => step >= rough); all.length < 2 && i >= 0; --i) {
    const step = steps[i];
    all = [];
    for (let tick = Math.ceil(least / step - 1e-9); tick * step <= most + 1e-9 * step; ++tick) all.push(+(tick * step).toPrecision(12));
  }
  return all;
}

/** Left edges of labels on one line that are centred on their positions as far as they do not overlap and do not leave the range. */
export function spread(centres: number[], widths: number[], [left, right]: [number, number], gap: number): number[] {
  const order = centres.map((_, i) => i).sort((i, j) => centres[i] - centres[j]);
  const edges = centres.map((at, i) => at - widths[i] / 2);
  let from = left;
  for (const i of order) from = (edges[i] = Math.max(edges[i], from)) + widths[i] + gap;
  let to = right;
  for (const i of order.reverse()) to = (edges[i] = Math.min(edges[i], to - widths[i])) - gap;
  return edges;
}

export const tickText = (tick: number, log?: boolean) => (log ? short(10 ** tick, 3).replace(/^1·/, '') : short(tick, 6));

/** Columns of the table and of the CSV file. */
export function columns(spec: Spec): { head: string[]; rows: (number | string)[][] } {
  const head = [spec.xLabel, ...spec.series.map((series) => series.label)];
  const rows: (number | string)[][] = [];
  for (let i = 0; i < spec.x.length; ++i) rows.push([spec.x[i], ...spec.series.map((series) => series.y[i])]);
  if (rows.length === 0) {
    head.splice(0, head.length, 'curve', spec.xLabel, spec.yLabel);
    spec.paths?.forEach((path, k) => {
      for (let i = 0; i < path.x.length; ++i) rows.push([path.label ?? `curve ${k + 1}`, path.x[i], path.y[i]]);
    });
    spec.points?.forEach((point) => rows.push([point.label, point.x, point.y]));
  }
  return { head, rows };
}

const csvCell = (cell: number | string) =>
  typeof cell === 'number' ? (finite(cell) ? String(cell) : '') : /[",\n]/.test(cell) ? `"${cell.replace(/"/g, '""')}"` : cell;

export function csvOf(spec: Spec): string {
  const { head, rows } = columns(spec);
  return [head, ...rows].map((row) => row.map(csvCell).join(',')).join('\n') + '\n';
}
