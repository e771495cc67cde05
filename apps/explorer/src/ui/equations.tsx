/** The equations of a panel, folded away: they and their fonts are read when somebody looks. */

import type { ComponentType } from 'preact';
import { useState } from 'preact/hooks';
import type { Name } from './formulas';

export function Equations({ names, children }: { names: Name[]; children?: preact.ComponentChildren }) {
  const [View, setView] = useState<ComponentType<{ names: Name[] }> | null>(null);
  const open = async (e: Event) => {
    if (!(e.currentTarget as HTMLDetailsElement).open || View) return;
    const { Formulas } = await import('./formulas');
    setView(() => Formulas);
  };
  return (
    <details class="equations" onToggle={open}>
      <summary>The equations</summary>
      <div class="card">{View && <View names={names} />}{children}</div>
    </details>
  );
}
