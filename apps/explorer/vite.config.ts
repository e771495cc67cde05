import { readFileSync } from 'node:fs';
import preact from '@preact/preset-vite';
import katex from 'katex';
import { defineConfig, type Plugin } from 'vite';

/** Renders formulas as HTML and MathML when the page is built, so that no reader has to wait for that. */
function formulas(): Plugin {
  return {
    name: 'formulas',
    enforce: 'pre',
    load(id) {
      if (!id.endsWith('formulas.json')) return null;
      const texts = JSON.parse(readFileSync(id, 'utf8')) as Record<string, { tex: string; equation: string; page: string }>;
      const rendered: Record<string, unknown> = {};
      for (const [name, { tex, equation, page }] of Object.entries(texts))
        rendered[name] = { html: katex.renderToString(tex, { throwOnError: true, output: 'htmlAndMathml' }), equation, page };
      return { code: JSON.stringify(rendered), map: null };
    },
  };
}

/** Keeps only woff2, which every current browser reads, of the font formats of the formulas. */
function onlyWoff2(): Plugin {
  return {
    name: 'only-woff2',
    enforce: 'pre',
    transform(code, id) {
      if (!id.endsWith('katex.min.css')) return null;
      return { code: code.replace(/,url\([^)]*\.(woff|ttf)\) format\("[a-z]+"\)/g, ''), map: null };
    },
  };
}

const wasm = process.env.SLIPFRONT_WASM ?? new URL('../../build/explorer/wasm', import.meta.url).pathname;
const events = process.env.SLIPFRONT_EVENTS ?? new URL('../../build/explorer/events.json', import.meta.url).pathname;

export default defineConfig({
  base: './',
  plugins: [formulas(), onlyWoff2(), preact()],
  resolve: {
    alias: {
      '@wasm': wasm,
      '@events': events,
      '@cases': process.env.SLIPFRONT_CASES ?? new URL('../../cases', import.meta.url).pathname,
    },
  },
  build: { outDir: 'dist', target: 'es2022', assetsInlineLimit: 0, modulePreload: { polyfill: false } },
  worker: { format: 'es' },
  server: { fs: { strict: false } },
});
