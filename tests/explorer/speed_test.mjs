// Measures and prints the speed of the page. You start this test manually, because a busy machine misses the limits.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { open, ready } from './browser.mjs';

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

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

test('the player shows more than 5 frames a second', async () => {
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
