/** Formulas, typeset when the page was built, with their numbers and pages in the theory. */

import style from 'katex/dist/katex.min.css';
import texts from '../formulas.json';
import { Page } from './site';

export type Name = keyof typeof texts;
const typeset = texts as unknown as Record<Name, { html: string; equation: string; page: string }>;
document.head.appendChild(document.createElement('style')).textContent = style;

export function Formulas({ names }: { names: Name[] }) {
  return (
    <>
      {names.map((name) => {
        const { html, equation, page } = typeset[name];
        return <div class="formula"><div dangerouslySetInnerHTML={{ __html: html }} /><p class="hint">{/^Eq/.test(equation) ? equation : `Equation ${equation}`} of <Page of={`docs/theory/${page}`} /></p></div>;
      })}
    </>
  );
}
