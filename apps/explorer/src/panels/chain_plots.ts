/** The plots of a chain: averages over several dislocations, and single dislocations near x = 0. */

import type { Chain } from '../model/chain';
import { scaleOf, type Quantity } from '../state/units';
import { rangeAround, type Spec } from '../ui/picture/spec';

type Scale = { unit: string; factor: number };
const times = (values: Float64Array, factor: number) => values.map((v) => v * factor);

export function averageSpec(chain: Chain, key: 'W' | 'Sigma', title: string, tint: string, quantity: Quantity, typical: number, x: Scale): Spec {
  const { unit, factor } = scaleOf(quantity, typical);
  const yLabel = `${key === 'W' ? 'W' : 'Σ'}, in ${unit}`;
  const series = [{ label: 'now', y: times(chain.average[key], factor), color: tint, fill: key === 'W' }];
  return {
    name: `average-${key}`, title, x: times(chain.average.average_x, x.factor), xLabel: `x, in ${x.unit}`, yLabel,
    series: key === 'Sigma' ? [{ label: 'before', y: times(chain.first[key], factor), color: 'before', fill: false }, ...series] : series,
    yRange: key === 'Sigma' ? rangeAround(...series.map(({ y }) => y), [1.1 * Math.max(...chain.first[key]) * factor]) : undefined,
  };
}

export function closeSpec(chain: Chain, x: Scale): Spec {
  const stress = scaleOf('stress', 2);
  return {
    name: 'single-dislocations', title: 'Near x = 0, not averaged: each dislocation is a peak of stress', x: times(chain.average.near_x, x.factor), xLabel: `x, in ${x.unit}`, yLabel: `σ and w`,
    series: [
      { label: 'stress', y: times(chain.average.near_stress, stress.factor), color: 'stress', width: 1.5 },
      { label: 'slip velocity', y: times(chain.average.near_velocity, scaleOf('slipVelocity', 2).factor), color: 'slip', width: 1.5 },
    ],
  };
}
