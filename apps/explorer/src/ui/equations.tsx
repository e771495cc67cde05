/** The equations of a panel, folded away. They were typeset when the page was built, and have their numbers and pages in the theory. */

import style from 'katex/dist/katex.min.css';
import { useState } from 'preact/hooks';
import texts from '../formulas.json';
import { Page } from './site';

export type Name = keyof typeof texts;
const typeset = texts as unknown as Record<Name, { html: string; equation: string; page: string }>;

let styled = false;
/** Adds the style sheet of formulas with its fonts, which the page need not read before. */
function addStyle() {
  if (!styled) document.head.appendChild(document.createElement('style')).textContent = style;
  styled = true;
}

export function Equations({ names, children }: { names: Name[]; children?: preact.ComponentChildren }) {
  const [opened, setOpened] = useState(false);
  const open = (e: Event) => {
    if (!(e.currentTarget as HTMLDetailsElement).open) return;
    addStyle();
    setOpened(true);
  };
  return (
    <details class="equations" onToggle={open}>
      <summary>The equations</summary>
      <div class="card">
        {opened && names.map((name) => {
          const { html, equation, page } = typeset[name];
          return <div class="formula"><div dangerouslySetInnerHTML={{ __html: html }} /><p class="hint">{/^Eq/.test(equation) ? equation : `Equation ${equation}`} of <Page of={`docs/theory/${page}`} /></p></div>;
        })}
        {children}
      </div>
    </details>
  );
}
