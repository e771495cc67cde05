/** What a screen reader says, politely, and everybody else sees for a moment. */

import { signal } from '@preact/signals';

export const said = signal('');
let timer: number | undefined;

export function announce(text: string) {
  said.value = text;
  clearTimeout(timer);
  timer = window.setTimeout(() => (said.value = ''), 2500);
}
