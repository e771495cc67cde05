/** The friction laws as the module declares them: what the form shows follows from that. */

import { signal } from '@preact/signals';
import { call } from '../engine/client';
import type { Law } from '../engine/protocol';

export const laws = signal<Law[]>([]);
call('laws').then((answer) => (laws.value = answer.error ? [] : answer.laws));

/** Parameters with which each law opens. They slow a pulse of stress 0.855 visibly, without stopping it at once. */
const opening: Record<string, Record<string, string>> = {
  viscous: { coefficient: '0.5' },
  coulomb: { coefficient: '0.01' },
  power: { coefficient: '0.1', exponent: '0.5' },
  formula: { coefficient: '1', formula: '0.1*w/(0.05 + w)' },
  'n-shaped': { coefficient: '0.08', velocity: '0.01' },
  'flash-heating': { strength: '0.05', weakened: '0.005', velocity: '0.02' },
  'slip-weakening': { strength: '0.05', residual: '0.005', characteristic_slip: '0.1' },
  'rate-and-state': { strength: '0.02', direct_effect: '0.002', evolution_effect: '0.006', characteristic_slip: '0.1', reference_velocity: '0.1', initial_state: '1' },
};

export function openingOf(law: Law): Record<string, string> {
  const defaults = law.parameters.map((p) => [p.name, p.words.length ? p.words[p.value] : String(p.value || 0.05)]);
  return { ...Object.fromEntries(defaults), ...opening[law.name] };
}
