// Checks roughly how the panels look. It compares the mean brightness of 24 by 16 fields of a screenshot with that of pictures that a person has checked.
// SLIPFRONT_SCREENS=new stores new values, and writes the pictures into $SLIPFRONT_SCREENS_FOLDER.

import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { eventually, open, ready } from './browser.mjs';

const store = fileURLToPath(new URL('./screens.json', import.meta.url));
const known = existsSync(store) ? JSON.parse(readFileSync(store, 'utf8')) : {};
const renew = process.env.SLIPFRONT_SCREENS === 'new';
const screens = {
  pulse: ['#/pulse?t=0.6', {}], pulse_dark: ['#/pulse?t=0.6&compare=1', { colorScheme: 'dark' }], pulse_narrow: ['#/pulse?t=0.6', { viewport: { width: 360, height: 740 } }],
  stress: ['#/stress?event=Kobe+1995', {}], riemann: ['#/riemann', {}], loading: ['#/loading?t=0.5', {}], plane: ['#/plane?t=0.8&time.end=1', {}], paper_7: ['#/paper?fig=7', {}], paper_10: ['#/paper?fig=10', {}], dislocations: ['#/dislocations?beads=30', {}],
};

/** Mean brightness, 0 to 100, of the fields of a picture. The browser decodes it. */
const fieldsOf = (page, png) => page.evaluate(async (data) => {
  const image = new Image();
  image.src = `data:image/png;base64,${data}`;
  await image.decode();
  const canvas = new OffscreenCanvas(24, 16);
  const ctx = canvas.getContext('2d');
  ctx.imageSmoothingQuality = 'high';
  ctx.drawImage(image, 0, 0, 24, 16);
  const { data: pixels } = ctx.getImageData(0, 0, 24, 16);
  return Array.from({ length: 24 * 16 }, (_, i) => Math.round((pixels[4 * i] + pixels[4 * i + 1] + pixels[4 * i + 2]) / 7.65));
}, png.toString('base64'));

for (const [name, [hash, look]] of Object.entries(screens))
  test(`the screen ${name} looks as before`, async () => {
    const page = await open(hash, { reducedMotion: 'reduce', ...look });
    await ready(page);
    const decoder = await open('#/none', { bypassCSP: true });
    const picture = () => page.screenshot();
    const fields = async () => fieldsOf(decoder, await picture());
    if (renew) {
      await page.waitForTimeout(2000);
      if (process.env.SLIPFRONT_SCREENS_FOLDER) writeFileSync(`${process.env.SLIPFRONT_SCREENS_FOLDER}/${name}.png`, await picture());
      known[name] = await fields();
      writeFileSync(store, `${JSON.stringify(known).replaceAll('],', '],\n')}\n`);
      return;
    }
    const differenceOf = (now) => now.reduce((sum, light, i) => sum + Math.abs(light - known[name][i]), 0) / now.length;
    // Another font shifts lines a little. An empty plot, another theme or a missing panel changes far more.
    await eventually(async () => {
      const difference = differenceOf(await fields());
      console.log(`# ${name}: mean difference ${difference.toFixed(2)} of 100`);
      assert.ok(difference < 4, `${difference}`);
    });
  });
