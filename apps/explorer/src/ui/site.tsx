/** Links to the documentation. If the page is part of the documentation site, `docs/site/build` has added the path to the site to its head. */

import type { ComponentChildren } from 'preact';
import { linkTo } from '../state/route';

const site = document.querySelector<HTMLMetaElement>('meta[name="slipfront-site"]')?.content;

/** A page of the documentation, named without extension. Where the explorer is not part of the site, this is the name of the file. */
export function Page({ of, children }: { of: string; children?: ComponentChildren }) {
  return site ? <a href={`${site}${of}.html`}>{children ?? of}</a> : <>{children}{children && ': '}<code>{of}.md</code></>;
}

/** The foot of the page. */
export function Sources() {
  return (
    <p class="hint sources">
      {site ? <a href={`${site}index.html`}>Documentation</a> : <>Documentation: the folder <code>docs</code> of the repository</>}
      {' · '}<a href={linkTo('licences')}>Licences and citation</a>{' · '}<Page of="docs/howto/cite">How to cite</Page>
    </p>
  );
}
