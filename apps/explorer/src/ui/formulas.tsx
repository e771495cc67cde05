/** Formulas, typeset when the page was built. */

import 'katex/dist/katex.min.css';
import texts from '../formulas.json';

export type Name = keyof typeof texts;

export function Formulas({ names }: { names: Name[] }) {
  return <>{names.map((name) => <div class="formula" dangerouslySetInnerHTML={{ __html: texts[name] }} />)}</>;
}
