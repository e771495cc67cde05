// How fast the page is, and how large. Prints what it measures; the limits are those of an idle machine with room for one that is not.

import assert from 'node:assert/strict';
import { gzipSync } from 'node:zlib';
import { test } from 'node:test';
import { open, ready, url } from './browser.mjs';

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

test('the first load is small, and nothing is fetched from elsewhere', async () => {
  for (const hash of ['#/', '#/pulse']) {
    const page = await open('#/nothing');
    const sizes = new Map();
    await page.goto('about:blank');
    const bodies = [];
    page.on('response', (response) => bodies.push(response.body().then((body) => sizes.set(response.url(), gzipSync(body, { level: 9 }).length))));
    const began = Date.now();
    await page.goto(url + hash);
    await ready(page);
    const seconds = (Date.now() - began) / 1000;
    await page.waitForTimeout(300);
    await Promise.all(bodies);
    const total = [...sizes.values()].reduce((a, b) => a + b, 0);
    console.log(`# ${hash}: ${(total / 1000).toFixed(1)} kB gzipped (${(total / 1024).toFixed(1)} KiB) in ${sizes.size} files, first picture after ${seconds.toFixed(2)} s`);
    assert.ok(total <= 400 * 1024, `${total} bytes`);
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  }
});

test('a slider shows its curve at once, and the page does not block', async () => {
  const page = await open('#/pulse', { reducedMotion: 'reduce' });
  await ready(page);
  await page.evaluate(() => {
    window.long = [];
    new PerformanceObserver((list) => list.getEntries().forEach((entry) => window.long.push(entry.duration))).observe({ entryTypes: ['longtask'] });
  });
  const times = await page.evaluate(async () => {
    const slider = document.querySelectorAll('input[type=range]')[0];
    const shown = () => document.querySelector('.facts dd').textContent;
    const all = [];
    for (let i = 0; i < 25; ++i) {
      const before = shown();
      const began = performance.now();
      slider.value = String(150 + 4 * i);
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      while (shown() === before && performance.now() - began < 2000) await new Promise((resolve) => { const c = new MessageChannel(); c.port1.onmessage = resolve; c.port2.postMessage(0); });
      all.push(performance.now() - began);
      await new Promise((resolve) => setTimeout(resolve, 40));
    }
    return all;
  });
  await page.waitForTimeout(1500);
  const long = await page.evaluate(() => window.long);
  console.log(`# slider to new curve, 100 cells to t = 2 pi: median ${median(times).toFixed(1)} ms of ${times.length}; longest task of the page ${Math.max(0, ...long).toFixed(0)} ms (${long.length} above 50 ms)`);
  assert.ok(median(times) < 500);
});

const rate = (page, seconds) => page.evaluate((s) => new Promise((resolve) => {
  let frames = 0;
  const began = performance.now();
  const step = (now) => (++frames, now - began > 1000 * s ? resolve((1000 * frames) / (now - began)) : requestAnimationFrame(step));
  requestAnimationFrame(step);
}), seconds);

test('play moves', async () => {
  const bare = await open('#/nothing');
  const most = await rate(bare, 2);
  const page = await open('#/pulse?pulse.cells=200');
  await ready(page);
  await page.getByRole('button', { name: 'Play' }).click();
  await page.waitForTimeout(500);
  const playing = await rate(page, 3);
  console.log(`# play, 200 cells: ${playing.toFixed(1)} frames a second; an empty page has ${most.toFixed(1)}`);
  assert.ok(playing > 5);
});

test('a chain of 300 dislocations runs live', async () => {
  const page = await open('#/dislocations?beads=300');
  await ready(page);
  const places = () => page.locator('output').innerText();
  const before = await places();
  await page.waitForTimeout(4000);
  assert.notEqual(await places(), before);
  const shown = await page.locator('.facts div', { hasText: 'Pictures a second' }).locator('dd').innerText();
  console.log(`# chain of 300 dislocations: ${shown} pictures a second`);
  assert.ok(Number(shown) > 3);
});
