/** Files and the clipboard. */

import { announce } from './announce';

export function save(name: string, content: string | Blob | null, type = 'text/plain;charset=utf-8') {
  if (content === null) return announce(`${name} could not be made`);
  const blob = typeof content === 'string' ? new Blob([content], { type }) : content;
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  announce(`Saved ${name}`);
}

export async function copy(text: string, what: string) {
  try {
    await navigator.clipboard.writeText(text);
    announce(`Copied ${what}`);
  } catch {
    save(`${what.replace(/\W+/g, '-')}.txt`, text);
  }
}
