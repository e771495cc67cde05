/** SI units on request. The address contains the constants, and the module computes the units from them. */

import { computed, signal } from '@preact/signals';
import { call } from '../engine/client';
import type { Complaint, Units } from '../engine/protocol';
import { bestUnit, type Kind } from '../ui/format';
import { route } from './route';

export const constants = [
  { key: 'medium.contact_ratio', label: 'Contact ratio A', value: '0.003' },
  { key: 'medium.asperity_spacing', label: 'Asperity spacing b', value: '1 cm' },
  { key: 'medium.shear_modulus', label: 'Shear modulus μ', value: '30 GPa' },
  { key: 'medium.p_wave_speed', label: 'P-wave speed', value: '6 km/s' },
  { key: 'medium.poisson_ratio', label: 'Poisson’s ratio ν', value: '0.3' },
];

/** Constants of the rock, which an event of the user has too. */
export const rock = constants.slice(1);

export const wantsUnits = computed(() => route.value.params.si === '1');
export const stated = computed(() => constants.map(({ key, value }) => route.value.params[key] ?? value));
export const units = signal<Units | null>(null);
export const unitsProblem = signal<Complaint | undefined>(undefined);

let asked = '';
export async function refreshUnits() {
  const [A, b, mu, speed, nu] = stated.value;
  const question = [mu, speed, nu, A, b].join('|');
  if (question === asked) return;
  asked = question;
  const answer = await call('units', mu, speed, nu, A, b);
  if (asked !== question) return;
  unitsProblem.value = answer.error;
  if (!answer.error) units.value = answer;
}

export type Quantity = 'x' | 't' | 'stress' | 'slipVelocity' | 'velocity' | 'slip' | 'none';
const meanings: Record<Exclude<Quantity, 'none'>, { unit: keyof Units; kind: Kind; plain: string }> = {
  x: { unit: 'length', kind: 'length', plain: 'b/A' },
  t: { unit: 'time', kind: 'time', plain: 'b/(cA)' },
  stress: { unit: 'stress', kind: 'stress', plain: 'μA/π' },
  slipVelocity: { unit: 'slip_velocity', kind: 'velocity', plain: 'cA/π' },
  velocity: { unit: 'velocity', kind: 'velocity', plain: 'c' },
  slip: { unit: 'slip', kind: 'length', plain: 'b/2π' },
};

/** The name of the unit of an axis, and the factor that converts dimensionless numbers to it. */
export function scaleOf(quantity: Quantity, largest: number): { unit: string; factor: number } {
  if (quantity === 'none') return { unit: '', factor: 1 };
  const meaning = meanings[quantity];
  if (!wantsUnits.value || !units.value) return { unit: meaning.plain, factor: 1 };
  const unit = units.value[meaning.unit];
  const [name, si] = bestUnit(meaning.kind, largest * unit);
  return { unit: name, factor: unit / si };
}
