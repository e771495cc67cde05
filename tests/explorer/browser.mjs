// The page in a browser: served by the program, shown by Debian's chromium.

import { spawn } from 'node:child_process';
import { createRequire } from 'node:module';
import { once } from 'node:events';
import { after } from 'node:test';

const patience = 300000; // ms that nothing takes, however busy the machine is
const require = createRequire(`${process.env.SLIPFRONT_NODE_MODULES}/`);
const { chromium } = require('playwright-core');
export const axe = require.resolve('axe-core/axe.min.js');

const server = spawn(process.env.SLIPFRONT, ['explore', '--no-open', '--json', '--port', '0', '--folder', process.env.SLIPFRONT_PAGE]);
const [said] = await once(server.stdout, 'data');
export const url = JSON.parse(String(said)).url;
export const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] });
after(async () => {
  await browser.close();
  server.kill();
});

/** A page at a place of the address. Errors of its console and requests that leave it are kept in `complaints`. */
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

/** Repeats a check until it passes: how long that takes depends on the machine. */
export async function eventually(check) {
  for (const began = Date.now(); ; await new Promise((resolve) => setTimeout(resolve, 50))) {
    try {
      return await check();
    } catch (error) {
      if (Date.now() - began > patience) throw error;
    }
  }
}

/** Waits until what is computed stands there. */
export async function ready(page) {
  await page.locator('.plot canvas').first().waitFor();
  await page.waitForFunction(() => !document.querySelector('.busy'), null);
}

/** Like a user: the text of a field is replaced. */
export async function type(page, label, text) {
  const field = page.getByLabel(label, { exact: true }).first();
  await field.fill(text);
}

export const factOf = (page, name) => page.locator('.facts div', { hasText: name }).locator('dd').innerText();
