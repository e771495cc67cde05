/** A message that a screen reader reads out, and that the page shows for 2.5 seconds. */

import { signal } from '@preact/signals';

export const said = signal('');
let timer: number | undefined;

export function announce(text: string) {
  said.value = text;
  clearTimeout(timer);
  timer = window.setTimeout(() => (said.value = ''), 2500);
}
