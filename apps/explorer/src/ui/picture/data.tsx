// Export and table of a picture, folded away. They are created only when the user opens them.

import type { ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';

export function Data({ of, buttons, table }: { of: string; buttons: () => ComponentChildren; table: () => ComponentChildren }) {
  const [open, setOpen] = useState(false);
  return (
    <details class="data" onToggle={(e) => setOpen(e.currentTarget.open)}>
      <summary>Table and export</summary>
      {open && (
        <div>
          <p class="buttons">{buttons()}</p>
          <div class="table" tabIndex={0} role="region" aria-label={`Table: ${of}`}>
            <table>{table()}</table>
          </div>
        </div>
      )}
    </details>
  );
}
