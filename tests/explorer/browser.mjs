// Helpers for tests of the page in a browser. Debian's chromium opens the file.

import { createRequire } from 'node:module';
import { after, afterEach } from 'node:test';
import { pathToFileURL } from 'node:url';

const patience = 300000; // ms; longer than any wait on a busy machine
const require = createRequire(`${process.env.SLIPFRONT_NODE_MODULES}/`);
const { chromium } = require('playwright-core');
export const axe = require.resolve('axe-core/axe.min.js');

export const url = pathToFileURL(process.env.SLIPFRONT_PAGE).href;
export const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] });
// A page that stays open computes and draws all the time, and slows those that follow.
afterEach(async () => {
  for (const context of browser.contexts()) await context.close();
});
after(() => browser.close());

/** Opens the page at a fragment of its address, as #/pulse. `complaints` collects console errors and requests for anything but the page. */
export async function open(hash, { init, address = url, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  page.complaints = [];
  if (init) await page.addInitScript(init);
  page.on('console', (message) => message.type() === 'error' && page.complaints.push(message.text()));
  page.on('pageerror', (error) => page.complaints.push(String(error)));
  page.on('request', (request) => !request.isNavigationRequest() && !/^(data|blob):/.test(request.url()) && page.complaints.push(`request to ${request.url()}`));
  await page.goto(address + hash);
  return page;
}

/** Keeps the texts that canvases show, because the document does not contain them. For the option `init` of `open`. */
export function keepTexts() {
  window.texts = new Map();
  const proto = CanvasRenderingContext2D.prototype;
  const { fillText, clearRect, fillRect } = proto;
  const wiping = (paint) => function wipe(x, y, width, height) {
    const { a, d } = this.getTransform();
    if (a * width >= this.canvas.width - 1 && d * height >= this.canvas.height - 1) window.texts.set(this.canvas, []);
    return paint.call(this, x, y, width, height);
  };
  proto.clearRect = wiping(clearRect);
  proto.fillRect = wiping(fillRect);
  proto.fillText = function keep(text, x, y, ...more) {
    const size = this.measureText(text);
    const at = this.getTransform();
    const corners = [[x - size.actualBoundingBoxLeft, y - size.actualBoundingBoxAscent], [x + size.actualBoundingBoxRight, y + size.actualBoundingBoxDescent]].map(([px, py]) => at.transformPoint({ x: px, y: py }));
    const [xs, ys] = [corners.map((p) => p.x), corners.map((p) => p.y)];
    if (!window.texts.has(this.canvas)) window.texts.set(this.canvas, []);
    window.texts.get(this.canvas).push({ text: String(text), left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys) });
    return fillText.call(this, text, x, y, ...more);
  };
}

/** Pairs of texts that overlap, and labels of lines that lie in a plot, where curves may cross them. The controls may float over the rest. */
export const collisions = (page) => page.evaluate(() => {
  const all = [];
  const layerOf = (element) => element.closest('.controls, .transport') ?? document.body;
  const add = (element, text, box) => {
    const clipped = { left: box.left, right: box.right, top: box.top, bottom: box.bottom };
    for (let e = element; e && e !== document.body; e = e.parentElement) {
      if (getComputedStyle(e).overflowY === 'visible') continue;
      const window = e.getBoundingClientRect();
      clipped.left = Math.max(clipped.left, window.left);
      clipped.right = Math.min(clipped.right, window.right);
      clipped.top = Math.max(clipped.top, window.top);
      clipped.bottom = Math.min(clipped.bottom, window.bottom);
    }
    if (clipped.right - clipped.left > 1 && clipped.bottom - clipped.top > 1) all.push({ ...clipped, text, layer: layerOf(element), from: element });
  };
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const { data, parentElement } = walker.currentNode;
    if (!data.trim() || parentElement.closest('option, script, noscript, textarea, .skip') || !parentElement.checkVisibility({ visibilityProperty: true })) continue;
    const range = document.createRange();
    range.selectNodeContents(walker.currentNode);
    for (const box of range.getClientRects()) {
      const slack = 0.15 * box.height; // the box of a line is higher than its letters
      add(parentElement, data, { left: box.left, right: box.right, top: box.top + slack, bottom: box.bottom - slack });
    }
  }
  const found = [];
  for (const [canvas, texts] of window.texts) {
    if (!canvas.isConnected || !canvas.checkVisibility()) continue;
    const box = canvas.getBoundingClientRect();
    const scale = box.width / canvas.width;
    // Ticks of one axis share an edge: the lower one on the x axis, the right one on the y axis.
    const most = (edge) => {
      const groups = new Map();
      for (const one of texts) if (/^[−\d]/.test(one.text)) groups.set(Math.round(one[edge] / 4), (groups.get(Math.round(one[edge] / 4)) ?? 0) + 1);
      return Math.max(0, ...groups.values());
    };
    if (canvas.parentElement.matches('.u-wrap') && Math.min(most('bottom'), most('right')) < 2) found.push(`an axis has one tick: ${texts.map(({ text }) => text)}`);
    const inside = canvas.parentElement.querySelector('.u-over')?.getBoundingClientRect();
    for (const { text, left, right, top, bottom } of texts) {
      const place = { left: box.left + scale * left, right: box.left + scale * right, top: box.top + scale * top, bottom: box.top + scale * bottom };
      if (place.right > box.right + 1 || place.left < box.left - 1) found.push(`'${text}' leaves its picture`);
      if (inside && /^(V|fast|slow)/.test(text) && place.bottom > inside.top) found.push(`'${text}' lies in the plot`);
      add(canvas, text, place);
    }
  }
  for (let i = 0; i < all.length; ++i)
    for (let j = 0; j < i; ++j) {
      const [a, b] = [all[i], all[j]];
      if (a.layer !== b.layer || (a.from === b.from && a.from.nodeName !== 'CANVAS')) continue;
      if (Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1) found.push(`'${a.text}' and '${b.text}'`);
    }
  return { found, count: all.length };
});

/** Repeats a check until it passes. The time that this takes depends on the machine. */
export async function eventually(check) {
  for (const began = Date.now(); ; await new Promise((resolve) => setTimeout(resolve, 50))) {
    try {
      return await check();
    } catch (error) {
      if (Date.now() - began > patience) throw error;
    }
  }
}

/** Waits until the page shows the computed result. */
export async function ready(page) {
  await page.locator('.plot canvas').first().waitFor();
  await page.waitForFunction(() => !document.querySelector('.busy'), null);
}

/** Replaces the text of a field, as a user would. */
export async function type(page, label, text) {
  const field = page.getByLabel(label, { exact: true }).first();
  await field.fill(text);
}

export const factOf = (page, name) => page.locator('.facts div', { hasText: name }).locator('dd').innerText();
