/** The friction laws as the module declares them: what the form shows follows from that. */

import { signal } from '@preact/signals';
import { call } from '../engine/client';

export interface Parameter {
  name: string;
  symbol: string;
  unit: string;
  value: number;
  least: number;
  most: number | null;
  without_least: boolean;
  words: string[];
}
export interface Law {
  name: string;
  equation: string;
  source: string;
  curve: 'none' | 'formula' | 'table';
  remembers: boolean;
  parameters: Parameter[];
}

export const laws = signal<Law[]>([]);
call('laws').then((answer) => (laws.value = (answer.laws as Law[]) ?? []));
