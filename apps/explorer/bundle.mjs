// Makes the page: one HTML file that contains everything. Usage: node bundle.mjs ROOT WASM EVENTS OUT, with the checkout,
// the folder of the module and the JSON of the published events.

import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { basename, dirname } from 'node:path';
import { build } from 'esbuild';
import katex from 'katex';

const [root, wasm, events, out] = process.argv.slice(2);
const read = (path) => readFileSync(path, 'utf8');
const packages = JSON.parse(read('package-lock.json')).packages;
/** The page contains these packages, and KaTeX's style sheet and fonts. KaTeX itself has run when the page was built. */
const shipped = Object.entries(packages).filter(([path, { dev }]) => path === 'node_modules/katex' || (path && !dev && !path.includes('/@types/')));

const licences = [
  { name: 'slipfront, BSD-3-Clause', text: read(`${root}/LICENSE`) },
  ...shipped.map(([path, { version, license }]) => ({ name: `${path.replace('node_modules/', '')} ${version}, ${license}`, text: read(`${path}/LICENSE`) })),
  { name: 'Fonts of KaTeX, OFL-1.1', text: read('LICENSE-fonts.txt') },
  { name: 'WebAssembly module', text: read('LICENSE-webassembly.txt') },
  { name: 'Names of units from UDUNITS-2', text: read(`${root}/LICENSES/LicenseRef-UDUNITS-2.txt`) },
];

/** Formulas as HTML and MathML, so that no reader has to wait for that. */
function typeset(path) {
  const formulas = JSON.parse(read(path));
  for (const formula of Object.values(formulas)) formula.html = katex.renderToString(formula.tex, { throwOnError: true, output: 'htmlAndMathml' });
  return JSON.stringify(formulas, (key, value) => (key === 'tex' ? undefined : value));
}

/** Numbers of JSON with seven digits, which is more than the page shows. */
function rounded(path) {
  return JSON.stringify(JSON.parse(read(path)), (_, value) => (typeof value === 'number' ? Number(value.toPrecision(7)) : value));
}

const fonts = /^KaTeX_(Main-Regular|Math-Italic|Caligraphic-Regular|Size[1-4]-Regular)\.woff2$/;
/** KaTeX's style sheet with those of its fonts that our formulas use. */
function withFonts(path) {
  return read(path).replace(/@font-face\{[^}]*url\((fonts\/\w+-\w+\.woff2)\)[^}]*\}/g, (face, font) => {
    if (!fonts.test(basename(font))) return '';
    const data = readFileSync(`${dirname(path)}/${font}`).toString('base64');
    return face.replace(/src:[^}]*/, `src:url(data:font/woff2;base64,${data}) format("woff2")`);
  });
}

const common = { bundle: true, minify: true, write: false, metafile: true, format: 'iife', target: 'es2022', logLevel: 'warning' };

/** Adds what the page needs besides code: a text, or the contents of a file in another form. */
const parts = {
  name: 'parts',
  setup({ onResolve, onLoad }) {
    const places = { '@wasm': wasm, '@events': events, '@cases': `${root}/cases` };
    onResolve({ filter: /^@(wasm|events|cases)/ }, ({ path }) => ({ path: path.replace(/^@\w+/, (name) => places[name]) }));
    onResolve({ filter: /^@(licences|citation|worker)$/ }, ({ path }) => ({ path, namespace: 'parts' }));
    onLoad({ filter: /licences/, namespace: 'parts' }, () => ({ contents: JSON.stringify(licences), loader: 'json' }));
    onLoad({ filter: /citation/, namespace: 'parts' }, () => ({ contents: read(`${root}/CITATION.cff`), loader: 'text' }));
    onLoad({ filter: /worker/, namespace: 'parts' }, async () => ({ contents: await codeOf('src/engine/worker.ts', '.js'), loader: 'text' }));
    onLoad({ filter: /formulas\.json$/ }, ({ path }) => ({ contents: typeset(path), loader: 'json' }));
    onLoad({ filter: /events\.json$/ }, ({ path }) => ({ contents: rounded(path), loader: 'json' }));
    onLoad({ filter: /katex\.min\.css$/ }, ({ path }) => ({ contents: withFonts(path), loader: 'text' }));
    onLoad({ filter: /\.wasm$/ }, ({ path }) => ({ contents: execFileSync('zopfli', ['-c', path], { maxBuffer: 1 << 24 }).toString('base64'), loader: 'text' }));
  },
};

const texts = new Map();
/** The bundled code (.js) or style sheets (.css) of an entry. */
async function codeOf(entry, kind) {
  if (!texts.has(entry)) {
    const { outputFiles, metafile } = await build({ ...common, entryPoints: [entry], outdir: 'out', loader: { '.toml': 'text', '.csv': 'text' }, plugins: [parts] });
    const unknown = Object.keys(metafile.inputs).find((path) => path.startsWith('node_modules/') && !shipped.some(([known]) => path.startsWith(`${known}/`)));
    if (unknown) throw new Error(`${unknown} is in the page, but its licence is not`);
    texts.set(entry, outputFiles);
  }
  return texts.get(entry).find(({ path }) => path.endsWith(kind)).text;
}

const script = await codeOf('src/main.tsx', '.js');
const values = {
  ICON: `data:image/svg+xml,${encodeURIComponent(read('icon.svg').trim())}`,
  STYLE: (await codeOf('src/main.tsx', '.css')).trim(),
  SCRIPT: script,
  HASH: `'sha256-${createHash('sha256').update(script).digest('base64')}'`,
};
writeFileSync(out, read('index.html').replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]));
