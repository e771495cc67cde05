/** The controls of a panel. On a small screen they float at the bottom of the window, so that one sees what they change. */

import type { ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';
import { route } from '../state/route';

export function Controls({ label, children }: { label: string; children: ComponentChildren }) {
  const [open, setOpen] = useState(!route.value.params.tour); // the tour shows its result first
  return (
    <aside class={`controls ${open ? '' : 'folded'}`} aria-label={label}>
      <button type="button" class="fold" aria-expanded={open} onClick={() => setOpen(!open)}>{open ? 'Hide controls' : 'Show controls'}</button>
      <div>{children}</div>
    </aside>
  );
}
