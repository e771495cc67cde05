/** The colours of a field over x and t. Zero has the colour of the ground, and both signs have their own. */

import { color, ramp } from '../colors';
import { reach } from './spec';

export interface Scale {
  range: [number, number];
  colour: (value: number) => [number, number, number];
}

/** Both ends of the vertical axis of a field, which begins at 0 unless the field states them. */
export const tRangeOf = (f: { t: ArrayLike<number>; tRange?: [number, number] }): [number, number] => f.tRange ?? [0, f.t[f.t.length - 1]];

export function scaleOf(values: ArrayLike<number>): Scale {
  const range = reach(values);
  const most = Math.max(-range[0], range[1]) || 1;
  const [up, down] = ['map', 'cold'].map((name) => ramp([color('map-0'), ...[1, 2, 3].map((i) => color(`${name}-${i}`))]));
  const share = (value: number) => (Number.isFinite(value) ? (Math.abs(value) / most) ** 0.6 : 0);
  return { range, colour: (value) => (value < 0 ? down : up)(share(value)) };
}
