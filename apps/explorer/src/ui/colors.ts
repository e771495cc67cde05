/** The colours of the style sheet, for canvases. */

import { signal } from '@preact/signals';

let known: Record<string, string> = {};
/** Changes when the colours do. */
export const theme = signal(0);

function changed() {
  known = {};
  theme.value += 1;
}
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', changed);

export function setTheme(name: string | null) {
  if (name) document.documentElement.dataset.theme = name;
  else delete document.documentElement.dataset.theme;
  changed();
}

export function color(name: string): string {
  return (known[name] ??= getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim() || '#888');
}

/** From the ground of the page to the full colour of a quantity, as red, green and blue. */
export function ramp(stops: string[]): (share: number) => [number, number, number] {
  const all = stops.map((stop) => [1, 3, 5].map((at) => parseInt(stop.slice(at, at + 2), 16)));
  return (share) => {
    const at = (share > 0 ? Math.min(1, share) : 0) * (all.length - 1);
    const i = Math.min(all.length - 2, Math.floor(at));
    return [0, 1, 2].map((c) => all[i][c] + (at - i) * (all[i + 1][c] - all[i][c])) as [number, number, number];
  };
}
