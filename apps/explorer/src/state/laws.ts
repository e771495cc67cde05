/** The friction laws as the module declares them: what the form shows follows from that. */

import { signal } from '@preact/signals';
import { call } from '../engine/client';
import type { Law } from '../engine/protocol';

export const laws = signal<Law[]>([]);
call('laws').then((answer) => (laws.value = answer.error ? [] : answer.laws));
