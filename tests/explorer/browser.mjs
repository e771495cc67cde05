// Helpers for tests of the page in a browser. The program serves the page, and Debian's chromium shows it.

import { spawn } from 'node:child_process';
import { createRequire } from 'node:module';
import { once } from 'node:events';
import { after } from 'node:test';

const patience = 300000; // ms; longer than any wait on a busy machine
const require = createRequire(`${process.env.SLIPFRONT_NODE_MODULES}/`);
const { chromium } = require('playwright-core');
export const axe = require.resolve('axe-core/axe.min.js');

const server = spawn(process.env.SLIPFRONT, ['explore', '--no-open', '--json', '--port', '0', '--folder', process.env.SLIPFRONT_PAGE]);
const [line] = await once(server.stdout, 'data');
export const url = JSON.parse(String(line)).url;
export const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] });
after(async () => {
  await browser.close();
  server.kill();
});

/** Opens the page at a fragment of its address, as #/pulse. `complaints` collects console errors and requests to other servers. */
export async function open(hash, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  await context.grantPermissions(['clipboard-read', 'clipboard-write'], { origin: url.slice(0, -1) });
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  page.complaints = [];
  page.on('console', (message) => message.type() === 'error' && page.complaints.push(message.text()));
  page.on('pageerror', (error) => page.complaints.push(String(error)));
  page.on('request', (request) => !request.url().startsWith(url) && !/^(data|blob):/.test(request.url()) && page.complaints.push(`request to ${request.url()}`));
  await page.goto(url + hash);
  return page;
}

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
