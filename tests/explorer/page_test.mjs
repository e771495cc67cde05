// The page as its users have it: every panel, links, scenarios, bad input, the keyboard, a screen reader's rules.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';
import { axe, browser, collisions, eventually, factOf, keepTexts, open, ready, type, url } from './browser.mjs';

const calm = { reducedMotion: 'reduce' };
const routes = ['#/', '#/pulse', '#/pulse?compare=1&si=1', '#/dislocations?beads=20', '#/stress?event=Parkfield+2004', '#/riemann', '#/licences', '#/loading', '#/loading?setup=edge&time.end=0.8', '#/loading?setup=asperity', '#/plane?time.end=0.5', '#/plane?setup=barrier&time.end=1', '#/tour-is-none',
  ...[2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12].map((fig) => `#/paper?fig=${fig}`)];

async function violations(page) {
  await page.evaluate(readFileSync(axe, 'utf8')); // a script in the page would not pass its content security policy
  const found = await page.evaluate(async () => (await window.axe.run(document, { resultTypes: ['violations'] })).violations.map((v) => `${v.id}: ${v.nodes[0].html.slice(0, 150)}`));
  return found;
}

const looks = [{ colorScheme: 'light', viewport: { width: 1400, height: 900 } }, { colorScheme: 'dark', viewport: { width: 360, height: 740 } }];

for (const hash of routes)
  test(`${hash}: shows its pictures, complains of nothing, breaks no rule of access, and no text covers another`, async () => {
    for (const look of looks) {
      const page = await open(hash, { ...calm, ...look, init: keepTexts });
      if (!/none|licences/.test(hash)) await ready(page);
      for (const width of look.colorScheme === 'light' ? [1400, 800] : [360]) {
        await page.setViewportSize({ ...look.viewport, width });
        assert.deepEqual(await violations(page), [], `${width}`);
        const text = await page.locator('body').innerText();
        assert.doesNotMatch(text, /\bNaN\b|undefined|Infinity/);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
        assert.ok(wide <= 1, `wider than the window by ${wide}`);
        const { found, count } = await collisions(page);
        assert.deepEqual(found, [], `${width}`);
        assert.ok(count > 10, `${count} texts`);
      }
      assert.deepEqual(page.complaints, []);
      await page.context().close();
    }
  });

test('on a phone the controls are in the window, with the picture that they change', async () => {
  for (const hash of ['#/pulse', '#/dislocations?beads=20', '#/loading', '#/plane?time.end=0.5', '#/stress', '#/riemann', '#/paper?fig=8']) {
    const page = await open(hash, { ...calm, viewport: { width: 360, height: 740 } });
    await ready(page);
    const control = page.locator('.controls :is(input, select)').first();
    const seen = async (locator) => { const box = await locator.boundingBox(); return box.y >= 0 && box.y + box.height <= 740; };
    assert.ok(await seen(control), hash);
    await page.locator('figure.plot').first().evaluate((plot) => plot.scrollIntoView());
    assert.ok(await seen(control), `${hash}, scrolled`);
    const [sheet, plot] = [await page.locator('.controls').boundingBox(), await page.locator('figure.plot canvas').first().boundingBox()];
    assert.ok(plot.y >= 0 && Math.min(sheet.y, plot.y + plot.height) - plot.y > 180, `${hash}: the picture has ${sheet.y - plot.y} px`);
    await page.getByRole('button', { name: 'Hide controls' }).click();
    assert.equal(await control.isVisible(), false);
    await page.context().close();
  }
});

test('a link shows the same', async () => {
  const page = await open('#/pulse', calm);
  await ready(page);
  await type(page, 'Left, Σ−', '0.7');
  await page.getByText('Smooth', { exact: true }).click();
  await type(page, 'Width', '0.4');
  await page.getByLabel('Time', { exact: true }).fill('600');
  await eventually(async () => {
    for (const part of ['initial.stress_left=0.7', 'initial.width=0.4', 't=']) assert.match(page.url(), new RegExp(`[?&]${part}`));
  });
  const other = await open(page.url().slice(url.length), calm);
  for (const one of [page, other]) await ready(one);
  await eventually(async () => { // both settle: either may still show what it computed last
    for (const fact of ['Slip velocity at x = 0', 'Slip at x = 0']) {
      assert.match(await factOf(other, fact), /\d/);
      assert.equal(await factOf(other, fact), await factOf(page, fact));
    }
  });
});

test('every friction law opens with a visible effect, and only viscous friction has a damping number', async () => {
  const page = await open('#/pulse', calm);
  await ready(page);
  assert.ok(Number(await page.getByLabel('Time', { exact: true }).inputValue()) < 700, 'the panel opens in the middle of the run');
  const field = page.getByLabel('Friction law');
  const names = await field.locator('option').allInnerTexts();
  assert.equal(names.length, 9);
  const velocities = new Map();
  for (const name of names) {
    const velocity = () => factOf(page, 'Slip velocity at x = 0');
    const before = await velocity();
    await field.selectOption(name);
    await eventually(async () => assert.notEqual(await velocity(), before, name));
    velocities.set(name, Number((await velocity()).split(' ')[0]));
    const facts = page.locator('.facts').first();
    await eventually(async () => assert.equal(/Damping number/.test(await facts.innerText()), name === 'viscous', name));
    const free = velocities.get('none');
    assert.ok(velocities.get(name) > 0.3 * free && (name === 'none' || velocities.get(name) < 0.97 * free), `${name}: ${velocities.get(name)} of ${free}`);
  }
  assert.equal(new Set(velocities.values()).size, names.length);
});

test('the menu keeps the scenario and the units', async () => {
  const page = await open('#/pulse?initial.profile=tanh&initial.stress_left=0.7&initial.width=0.4&friction.law=coulomb&friction.coefficient=0.02&si=1&medium.shear_modulus=40+GPa&t=0.5', calm);
  await ready(page);
  const to = async (name) => {
    await page.getByRole('navigation', { name: 'Panels' }).getByRole('link', { name, exact: true }).click();
    await page.waitForFunction((text) => document.querySelector('nav a[aria-current]')?.textContent === text, name);
    await ready(page);
  };
  const kept = async (parts) => { for (const part of parts) assert.ok(decodeURIComponent(page.url()).includes(part), `${part} in ${page.url()}`); };
  const units = ['si=1', 'medium.shear_modulus=40+GPa'];
  const scenario = ['initial.stress_left=0.7', 'initial.width=0.4', 'friction.law=coulomb', 'friction.coefficient=0.02'];
  await to('Dislocations');
  await kept([...units, ...scenario]);
  assert.equal(await page.getByLabel('Left, Σ−', { exact: true }).inputValue(), '0.7');
  assert.match(await factOf(page, 'First of them is at'), / (m|km|cm)$/);
  await to('The paper');
  await kept(units);
  assert.ok(!page.url().includes('initial.'), page.url());
  await page.getByText('3', { exact: true }).click();
  await eventually(() => kept([...units, 'fig=3']));
  await to('Pulse');
  await kept([...units, ...scenario, 't=0.5']);
  await to('The paper');
  await kept([...units, 'fig=3']);
  assert.deepEqual(page.complaints, []);
});

test('a scenario goes out as TOML and comes back', async () => {
  const page = await open('#/pulse?initial.profile=tanh&initial.stress_left=0.9&initial.stress_right=0.2&initial.width=0.7&friction.law=power&friction.coefficient=0.2&friction.exponent=2&time.end=3', calm);
  await ready(page);
  await page.getByText('Scenario file and command').click();
  const toml = await page.locator('textarea').inputValue();
  assert.match(toml, /\[friction\]\nlaw = "power"/);
  const velocity = await factOf(page, 'Slip velocity at x = 0');
  const other = await open('#/pulse', calm);
  await ready(other);
  await other.getByText('Scenario file and command').click();
  await other.locator('textarea').fill(toml);
  await other.getByRole('button', { name: 'Use this text' }).click();
  await eventually(async () => assert.equal(await factOf(other, 'Slip velocity at x = 0'), velocity));
  assert.equal(await other.locator('textarea').inputValue(), toml);
});

test('files of the program can be opened', async () => {
  const page = await open('#/pulse', calm);
  await ready(page);
  await page.getByText('Scenario file and command').click();
  await page.locator('input[type=file]').setInputFiles([`${process.env.SLIPFRONT_SOURCE}/cases/barrier.toml`]);
  await eventually(() => assert.match(page.url(), /interface\.contact=/));
  await page.locator('input[type=file]').setInputFiles([`${process.env.SLIPFRONT_SOURCE}/cases/catalogue.csv`]);
  await page.locator('.exchange .error').waitFor();
  assert.match(await page.locator('.exchange .error').innerText(), /Allowed: columns x and stress/);
});

test('bad input: a sentence beside the field, and the picture stays', async () => {
  const page = await open('#/pulse', calm);
  await ready(page);
  for (const [label, text] of [['Left, Σ−', '-1'], ['Left, Σ−', 'abc'], ['Left, Σ−', ''], ['Left, Σ−', '1e9'], ['Right, Σ+', '0.001'], ['coefficient C', '-2'], ['coefficient C', '1e400'], ['Until t', '0']]) {
    const before = await page.getByLabel(label, { exact: true }).first().inputValue();
    await type(page, label, text);
    if (text !== '') {
      await page.locator('.field .error').first().waitFor();
      await eventually(async () => assert.match(await page.locator('.field .error').first().innerText(), /Allowed/, `${label} = ${text}`));
    }
    assert.ok((await page.locator('.plot canvas').count()) > 0);
    await type(page, label, before);
    await eventually(async () => assert.equal(await page.locator('.field .error').count(), 0, `${label} = ${before}`));
  }
  assert.deepEqual(page.complaints, []);
});

test('any address: never a blank page', async () => {
  for (const hash of ['#/pulse?initial.stress_left=%00%ff&friction.law=%3Cscript%3E', '#/pulse?time.end=1e99', '#/pulse?drawn=a:b,,&initial.profile=table', '#/riemann?left_stress=NaN', '#/stress?value=%E0%A4%A&range=x&given=y&event=z',
    '#/paper?fig=99&left=-1', '#/paper?fig=2&stress=0', '#/dislocations?beads=1e9', '#/dislocations?beads=x', '#/x/y?z', '#/__proto__', '#/constructor', '#/paper?fig=__proto__', '#/stress?range=constructor&event=__proto__', '#/pulse?__proto__=1&friction.law=toString', '#/pulse?pulse.cells=1e8', '#/stress?my.rupture_velocity=9+km/s', '#/?tour=99', '#/pulse?si=1&medium.contact_ratio=9',
    '#/loading?setup=__proto__&t=9&friction.normal_stress=x', '#/loading?time.end=1e9&loading.velocity=0', '#/plane?setup=__proto__&t=x&friction.coefficient=x(', '#/plane?lines=1&chain.scale=1e9&time.end=-1']) {
    const page = await open(hash, calm);
    await page.waitForFunction(() => document.querySelector('main')?.innerText.length > 100);
    await page.waitForTimeout(700);
    const text = await page.locator('main').innerText();
    assert.ok(text.length > 100, hash);
    assert.doesNotMatch(text, /\bNaN (cA|b|c|μA)|undefined|\[object|\[native/, hash);
    assert.deepEqual(page.complaints.filter((c) => !/favicon/.test(c)), [], hash);
    await page.context().close();
  }
});

test('all by keyboard: every control can be reached, plots are read by arrows', async () => {
  const page = await open('#/pulse', calm);
  await ready(page);
  const wanted = await page.evaluate(() => [...document.querySelectorAll('main a, main button, main select, main summary, main [tabindex="0"], main input:not([type=radio])')].filter((e) => e.checkVisibility() && !e.disabled).length);
  await page.evaluate(() => document.querySelector('.brand').focus());
  const seen = new Set();
  for (let i = 0; i < wanted + 40; ++i) {
    await page.keyboard.press('Tab');
    const name = await page.evaluate(() => {
      const e = document.activeElement;
      window.ids ??= new Map();
      if (!window.ids.has(e)) window.ids.set(e, window.ids.size);
      return e.closest('main') && !e.matches('main, [type=radio]') ? window.ids.get(e) : -1;
    });
    if (name >= 0) seen.add(name);
  }
  assert.ok(seen.size >= wanted, `${seen.size} of ${wanted}`);
  await page.locator('.canvas').first().focus();
  await page.keyboard.press('Home');
  const first = await page.locator('.readout').first().innerText();
  await page.keyboard.press('PageUp');
  const second = await page.locator('.readout').first().innerText();
  assert.match(first, /x, in b\/A.*slip|x, in b\/A: −/i);
  assert.notEqual(first, second);
  assert.equal(await page.locator('.readout').first().getAttribute('aria-live'), 'polite');
});

test('a profile is drawn by the arrow keys, in any units, or by the mouse', async () => {
  for (const si of ['', '&si=1']) {
    const page = await open(`#/pulse?initial.profile=table&drawn=-6:0.8,-3:0.8,0:0.3,4:0${si}`, calm);
    await ready(page);
    const points = page.getByRole('group', { name: /Points of the initial stress/ }).getByRole('slider');
    assert.equal(await points.count(), 4);
    await points.first().focus();
    for (const key of ['ArrowRight', 'ArrowRight', 'ArrowUp', 'ArrowUp', 'Shift+ArrowUp', 'End', 'ArrowDown', 'ArrowUp']) await page.keyboard.press(key);
    await eventually(async () => assert.match(page.url(), /drawn=-6:0.8,-3:0.8,0:0.44,4:0.02(&|$)/));
    assert.match(await points.nth(2).getAttribute('aria-label'), /initial stress at x = 0/);
    await eventually(async () => { // the handle is on the curve, 44/80 of the height of the first one
      const [first, third, last] = await Promise.all([0, 2, 3].map(async (i) => (await points.nth(i).boundingBox()).y));
      assert.ok(Math.abs((last - third) / (last - first) - (0.44 - 0.02) / 0.78) < 0.03, `${first} ${third} ${last}`);
    });
    assert.deepEqual(await violations(page), []);
    const board = await page.locator('.drawable .u-over').boundingBox();
    const [high, low] = await Promise.all([0, 2].map(async (i) => (await points.nth(i).boundingBox()).y + 5.5));
    await page.mouse.move(board.x + board.width * 0.6, low);
    await page.mouse.down();
    await page.mouse.move(board.x + board.width * 0.8, low, { steps: 5 });
    await page.mouse.up();
    assert.ok(high < low);
    await eventually(async () => {
      const drawn = decodeURIComponent(/drawn=([^&]*)/.exec(page.url())[1]).split(',').map((pair) => pair.split(':').map(Number));
      assert.ok(drawn.length > 20 && drawn.some(([x, y]) => x > 0.5 && Math.abs(y - 0.44) < 0.02), page.url());
    });
    await page.context().close();
  }
});

/** Numbers of pixels in the left and the right half of a picture whose colour passes a test of r, g and b. */
const halves = (page, address, passes) => page.evaluate(async ([from, text]) => {
  const image = new Image();
  image.src = from;
  await image.decode();
  const { width, height } = image;
  const ctx = new OffscreenCanvas(width, height).getContext('2d');
  ctx.drawImage(image, 0, 0);
  const { data } = ctx.getImageData(0, 0, width, height);
  const passes = new Function('r', 'g', 'b', `return ${text}`);
  const count = [0, 0];
  for (let i = 0; i < data.length; i += 4) if (passes(data[i], data[i + 1], data[i + 2])) count[Number((i / 4) % width > width / 2)] += 1;
  return count;
}, [address, passes]);

/** Exported pictures state the part of the address that leads to the same picture, and not the folder of the page. */
const statedAddress = (page) => `slipfront explorer ${new URL(page.url()).hash}`;

test('every plot has its table and its exports, which show negative slip velocity too', async () => {
  const page = await open('#/pulse?initial.profile=formula&initial.formula=0.9*exp(-x^2)&t=0.5', { ...calm, bypassCSP: true });
  await ready(page);
  const plots = await page.locator('figure.plot').count();
  const summaries = page.locator('figure.plot .data summary');
  assert.equal(await summaries.count(), plots);
  for (let i = 0; i < plots; ++i) await summaries.nth(i).click();
  await page.waitForFunction((n) => document.querySelectorAll('figure.plot table').length === n, plots);
  const saved = {};
  for (const kind of ['PNG', 'SVG', 'CSV']) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: kind }).first().click()]);
    assert.match(download.suggestedFilename(), new RegExp(`slip-velocity\\.${kind.toLowerCase()}`));
    saved[kind] = readFileSync(await download.path());
  }
  // The pulse is antisymmetric, so both halves of the curve are in the plot.
  const slips = saved.CSV.toString().trim().split('\n').slice(1).map((row) => Number(row.split(',')[1]));
  const [least, most] = [Math.min(...slips), Math.max(...slips)];
  assert.ok(least < -0.9 * most && most > 0.001, `${least} ... ${most}`);
  const svg = saved.SVG.toString();
  const [bottom, curve] = [Number(/V([\d.]+)H/.exec(svg)[1]), [.../clip-path="url\(#box\)" d="M([^"V]+)" /.exec(svg)[1].matchAll(/ (-?[\d.]+)/g)].map((m) => Number(m[1]))];
  assert.ok(Math.max(...curve) < bottom && Math.min(...curve) > 40, `${Math.min(...curve)} ... ${Math.max(...curve)}, box to ${bottom}`);
  assert.match(svg, />−0\.0\d+</);
  // Both pictures have the title, the axes, the names of the fronts and the link; the PNG has twice the size.
  const texts = [...svg.matchAll(/<text[^>]*>([^<]*)/g)].map((one) => one[1].replaceAll('&lt;', '<').replaceAll('&gt;', '>').replaceAll('&amp;', '&'));
  for (const text of ['Slip velocity', 'x, in b/A', 'W, in cA/π', 'V+']) assert.ok(texts.includes(text), `${text} in ${texts}`);
  assert.ok(texts.join('').includes(statedAddress(page)) && !svg.includes('file:'), page.url());
  assert.deepEqual([saved.PNG.readUInt32BE(16), saved.PNG.readUInt32BE(20)], [2, 2].map((twice, i) => twice * Number(/viewBox="0 0 (\d+) (\d+)"/.exec(svg)[i + 1])));
  if (process.env.SLIPFRONT_SCREENS_FOLDER) for (const kind of ['PNG', 'SVG']) writeFileSync(`${process.env.SLIPFRONT_SCREENS_FOLDER}/export.${kind.toLowerCase()}`, saved[kind]);
  const [left, right] = await halves(page, `data:image/png;base64,${saved.PNG.toString('base64')}`, 'Math.abs(r - 200) < 9 && Math.abs(g - 80) < 9 && Math.abs(b - 30) < 9');
  assert.ok(left > 100 && right > 100, `${left} and ${right} pixels of the curve`);
  // The map has a colour for each sign: blue on the left, red on the right, and both in the colour bar.
  const map = await page.locator('figure.map canvas').evaluate((canvas) => canvas.toDataURL());
  const [blue, red] = [await halves(page, map, 'b > r + 90'), await halves(page, map, 'r > b + 90')];
  assert.ok(blue[0] > 500 && red[1] > 500 && blue[1] > 100, `${blue} blue, ${red} red`);
});

/** The file that the page saves when a button is pressed. */
async function savedBy(page, button) {
  const [download] = await Promise.all([page.waitForEvent('download'), button.click()]);
  return { name: download.suggestedFilename(), content: readFileSync(await download.path()) };
}

test('a map is exported with its title, axes, fronts, colour bar and link', async () => {
  for (const [hash, label] of [['#/pulse?t=0.5', 'W, in cA/π'], ['#/pulse?si=1', 'W, in cm/s'], ['#/paper?fig=7', 'W, in cA/π']]) {
    const page = await open(hash, { ...calm, bypassCSP: true });
    await ready(page);
    const map = page.locator('figure.map');
    await map.locator('summary').click();
    const [png, svg] = [await savedBy(page, map.getByRole('button', { name: 'PNG' })), await savedBy(page, map.getByRole('button', { name: 'SVG' }))];
    const text = svg.content.toString();
    const texts = [...text.matchAll(/<text[^>]*>([^<]*)/g)].map((one) => one[1].replaceAll('&lt;', '<').replaceAll('&gt;', '>').replaceAll('&amp;', '&'));
    for (const one of [await map.locator('figcaption').evaluate((caption) => caption.firstChild.data), ...(hash.includes('pulse') ? ['V−', 'V+'] : []), label]) assert.ok(texts.includes(one), `${one} in ${texts}`);
    assert.ok(texts.some((one) => /^x, in/.test(one)) && texts.some((one) => /^t, in/.test(one)), `${texts}`);
    assert.ok(texts.join('').includes(statedAddress(page)) && !text.includes('file:'), page.url());
    assert.deepEqual([png.content.readUInt32BE(16), png.content.readUInt32BE(20)], [2, 2].map((twice, i) => twice * Number(/viewBox="0 0 (\d+) (\d+)"/.exec(text)[i + 1])));
    if (process.env.SLIPFRONT_SCREENS_FOLDER) writeFileSync(`${process.env.SLIPFRONT_SCREENS_FOLDER}/map${hash.replace(/\W/g, '')}.png`, png.content);
    // The pulse and its colour bar are in the picture.
    const [left, right] = await halves(page, `data:image/png;base64,${png.content.toString('base64')}`, 'r > b + 90');
    assert.ok(left > 3000 && right > 3000, `${left} and ${right} pixels`);
    await page.context().close();
  }
});

test('a film shows the whole run', async () => {
  for (const hash of ['#/pulse', '#/loading', '#/plane?time.end=0.5']) {
    const page = await open(hash, { ...calm, bypassCSP: true });
    await ready(page);
    const film = await savedBy(page, page.getByRole('button', { name: 'Film (WebM)' }));
    assert.match(film.name, /\.webm$/);
    const [width, height, seconds, moved] = await page.evaluate(async (data) => {
      const video = document.createElement('video');
      video.muted = true;
      video.src = `data:video/webm;base64,${data}`;
      await new Promise((resolve) => (video.onloadeddata = resolve));
      const picture = () => {
        const ctx = new OffscreenCanvas(320, 180).getContext('2d');
        ctx.drawImage(video, 0, 0, 320, 180);
        return ctx.getImageData(0, 0, 320, 180).data;
      };
      const first = picture();
      let moved = 0;
      for (let k = 0; k < 20 && moved <= 200; ++k) { // a busy machine may show the frame of a seek late
        video.currentTime = video.duration - 0.02 * k;
        await new Promise((resolve) => (video.onseeked = resolve));
        moved = picture().reduce((sum, value, i) => sum + (Math.abs(value - first[i]) > 60), 0);
      }
      return [video.videoWidth, video.videoHeight, video.duration, moved];
    }, film.content.toString('base64'));
    assert.deepEqual([width, height], [1280, 720]);
    assert.ok(Math.abs(seconds - 8) < 0.1 && moved > 200, `${seconds} s, ${moved} pixels`);
    if (process.env.SLIPFRONT_SCREENS_FOLDER) writeFileSync(`${process.env.SLIPFRONT_SCREENS_FOLDER}/${film.name}`, film.content);
    await page.context().close();
  }
  const page = await open('#/pulse', { ...calm, init: () => delete window.VideoEncoder });
  await ready(page);
  await page.getByText(/This browser cannot encode films/).waitFor();
  await page.context().close();
});

test('a rupture on a plane: the averages have a front, every line is followed, and the command repeats it', async () => {
  const page = await open('#/plane?time.end=0.5', calm);
  await ready(page);
  const averaged = parseFloat(await factOf(page, 'Farthest front'));
  assert.ok(averaged > 2.1 && averaged < 2.4, `${averaged}`);
  await page.getByText('every line', { exact: true }).click();
  await eventually(async () => assert.ok(parseInt(await factOf(page, 'Lines'), 10) >= 8));
  assert.match(await page.locator('.command code').textContent(), /slipfront plane cases\/plane-friction\.toml --direct --set 'friction\.coefficient=1 \+ tanh\(y \/ 0\.1\)' time\.end=0\.5 chain\.scale=20/);
  await type(page, 'Friction C, by x and y', '-1');
  await eventually(async () => assert.match(await page.locator('.field .error').innerText(), />= 0/));
  await page.getByText('A rupture that stops').click();
  await eventually(async () => assert.match(await page.locator('.controls').innerText(), /tension/));
  await page.getByText('A barrier').click();
  await page.getByText('the averages', { exact: true }).click();
  await eventually(async () => assert.match(await page.locator('.command code').textContent(), /plane-barrier\.toml --set .*plane\.cells=100/));
  assert.deepEqual(page.complaints, []);
});

test('an asperity between creeping ends repeats earthquakes, unless it strengthens nearly as much as it weakens', async () => {
  const page = await open('#/loading?setup=asperity', calm);
  await ready(page);
  await eventually(async () => assert.match(await factOf(page, 'Slip events'), /^4, all of which stop inside/));
  await page.getByRole('img', { name: /Slip velocity over position and time/ }).waitFor();
  await type(page, 'b − a in the asperity', '0.002');
  await page.getByText(/No slip event/).waitFor();
  assert.match(await page.locator('.command code').textContent(), /friction\.direct_effect=0\.015 \+ 0\.005 - \(0\.002 \+ 0\.005\)/);
  assert.deepEqual(page.complaints, []);
});

test('a spring that is too stiff makes no stick-slip, and a softer one larger events', async () => {
  const page = await open('#/loading', calm);
  await ready(page);
  const drop = async () => Number((await factOf(page, 'Stress drop')).split(' ')[0]);
  const events = async () => Number((await factOf(page, 'Slip events')).split(',')[0]);
  assert.equal(await events(), 6);
  assert.equal(await factOf(page, 'Stiffness over the critical one'), '0.5');
  const before = await drop();
  await type(page, 'Stiffness of the spring, in MPa/µm', '0.01');
  await eventually(async () => assert.ok((await drop()) > 1.05 * before));
  await type(page, 'Stiffness of the spring, in MPa/µm', '0.1');
  await page.getByText(/No slip event: the spring is stiffer than the critical one/).waitFor();
  await type(page, 'Normal stress, in MPa', '-5');
  await eventually(async () => assert.match(await page.locator('.field .error').innerText(), /Allowed/));
  await type(page, 'Normal stress, in MPa', '5');
  await page.getByText('Pushed at its edge').click();
  await eventually(async () => assert.match(await factOf(page, 'Slip events'), /of which stop inside/));
  assert.match(await page.locator('.command code').textContent(), /slipfront chain cases\/precursors\.toml --set 'friction\.normal_stress=5 MPa'/);
  assert.deepEqual(page.complaints, []);
});

/** Fonts in which letters of formulas are set and which the page does not contain. */
const missingFonts = async () => {
  await document.fonts.ready;
  const loaded = [...document.fonts].filter((face) => face.status === 'loaded').map((face) => `${face.family} ${face.style} ${face.weight}`);
  const used = [...document.querySelectorAll('.katex-html *')].filter((element) => [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.replace(/\u200b/g, '').trim())).map((element) => {
    const { fontFamily, fontStyle, fontWeight } = getComputedStyle(element);
    return `${fontFamily.split(',')[0]} ${fontStyle} ${fontWeight}`;
  });
  return used.length ? [...new Set(used)].filter((font) => !loaded.includes(font)) : ['no letter'];
};

test('the equations of each panel have their numbers in the theory, and links to it where the page is part of the site', async () => {
  const source = process.env.SLIPFRONT_SOURCE;
  const formulas = JSON.parse(readFileSync(`${source}/apps/explorer/src/formulas.json`, 'utf8'));
  for (const { equation, page } of Object.values(formulas)) assert.ok(readFileSync(`${source}/docs/theory/${page}.md`, 'utf8').includes(`\\tag{${equation}}`), `${equation} in ${page}`);
  const page = await open('#/nothing', calm);
  const shown = async (hash, address = url) => {
    await page.goto('about:blank');
    await page.goto(address + hash);
    await ready(page);
    await page.getByText('The equations', { exact: true }).click();
    await page.locator('.formula .katex').first().waitFor();
    return page.locator('.formula').evaluateAll((all) => all.map((one) => ({ text: one.querySelector('p').innerText, link: one.querySelector('p a')?.getAttribute('href') })));
  };
  const alone = await shown('#/pulse');
  assert.deepEqual(alone[0], { text: 'Equation 3.1 of docs/theory/3_modulation.md', link: undefined });
  assert.deepEqual(await violations(page), []);
  // The page of the site, as docs/site/build makes it.
  const command = /sed ('s#.*?')/.exec(readFileSync(`${source}/docs/site/build`, 'utf8'))[0];
  const ofSite = join(mkdtempSync(join(tmpdir(), 'slipfront-')), 'index.html');
  execFileSync('sh', ['-c', `${command} "$1" >"$2"`, 'sh', process.env.SLIPFRONT_PAGE, ofSite]);
  const site = pathToFileURL(ofSite).href;
  for (const hash of ['#/pulse', '#/dislocations?beads=20', '#/loading', '#/plane?time.end=0.5', '#/stress', '#/riemann', ...[2, 3, 4, 7].map((fig) => `#/paper?fig=${fig}`)]) {
    const links = (await shown(hash, site)).map(({ link }) => link);
    assert.ok(links.length > 0 && links.every((link) => /^\.\.\/docs\/theory\/\d_\w+\.html$/.test(link)), `${hash}: ${links}`);
    assert.deepEqual(await page.evaluate(missingFonts), [], hash);
  }
  await page.goto(`${site}#/`);
  assert.equal(await page.getByRole('link', { name: 'Documentation', exact: true }).getAttribute('href'), '../index.html');
  assert.equal(await page.getByRole('link', { name: 'How to cite', exact: true }).getAttribute('href'), '../docs/howto/cite.html');
  assert.deepEqual(page.complaints, []);
});

test('the foot of each panel leads to the licences of all that is in the page', async () => {
  const page = await open('#/riemann', calm);
  await page.getByRole('link', { name: 'Licences and citation' }).click();
  const texts = page.locator('.licence pre');
  await eventually(async () => assert.ok((await texts.count()) > 8));
  const names = await page.locator('.licence summary').allTextContents();
  for (const name of ['slipfront', 'Citation', 'katex', 'preact', '@preact/signals', '@preact/signals-core', 'uplot', 'webm-muxer', 'Fonts of KaTeX', 'WebAssembly module', 'Names of units'])
    assert.ok(names.some((one) => one === name || /^[ ,]/.test(one.slice(name.length)) && one.startsWith(name)), `${name} in ${names}`);
  const all = (await texts.allTextContents()).join('\n');
  for (const text of ['BSD 3-Clause License', 'cff-version', 'Khan Academy', 'SIL OPEN FONT LICENSE', 'Jason Miller', 'Leon Sorokin', 'Vanilagy', 'Rich Felker', 'UCAR/UNIDATA']) assert.ok(all.includes(text), text);
  assert.deepEqual(await violations(page), []);
  assert.deepEqual(page.complaints, []);
});

test('the tour goes through all its steps, and each shows its result in the window', async () => {
  const page = await open('#/', calm);
  await page.getByRole('link', { name: 'Take the tour' }).click();
  const titles = new Set();
  for (let i = 1; ; ++i) {
    await page.locator('.tour').waitFor();
    await ready(page);
    titles.add(await page.locator('.tour h2').innerText());
    const result = page.locator(/my\.rupture/.test(page.url()) ? '.event' : 'figure.plot canvas').first();
    const box = await eventually(async () => { // the page may draw it anew
      const at = await result.boundingBox();
      assert.ok(at, `step ${i}`);
      return at;
    });
    assert.ok(box.y >= 0 && box.y + Math.min(box.height, 200) <= 900, `step ${i}: its result is at ${box.y}`);
    if (i === 8) { // the text of this step quotes the interval
      const [, low, high] = /\(([\d.]+) MPa to ([\d.]+) MPa\)/.exec(await result.innerText());
      assert.ok(Math.abs(low / 30 - 1) < 0.1 && Math.abs(high / 230 - 1) < 0.1, `${low} to ${high} MPa`);
    }
    const next = page.getByRole('button', { name: 'Next' });
    if (!(await next.count())) break;
    await next.click();
    await page.waitForFunction((n) => document.querySelector('.tour .count')?.textContent.includes(`step ${n} `), i + 1);
    assert.deepEqual(page.complaints, []);
  }
  assert.equal(titles.size, 10);
});

test('a bead that trembles in its well has the colour of rest', async () => {
  const page = await open('#/dislocations?tour=1&initial.profile=step&initial.stress_left=0.855&initial.stress_right=0&friction.law=none&beads=12');
  await ready(page);
  const seen = await page.evaluate(async () => {
    const canvas = document.querySelector('canvas.beads');
    const near = (data, i, [r, g, b]) => Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 12;
    const count = (from, to, tint) => {
      const { data } = canvas.getContext('2d').getImageData(from * canvas.width, 0, (to - from) * canvas.width, 40 * devicePixelRatio);
      let found = 0;
      for (let i = 0; i < data.length; i += 4) found += near(data, i, tint);
      return found;
    };
    const [moving, resting] = [[200, 80, 30], [31, 95, 153]];
    const seen = { left: 0, rest: 0, right: 0, pictures: 0 };
    while (document.querySelector('progress').value < 4.5) {
      seen.left = Math.max(seen.left, count(0, 0.1, moving));
      seen.rest = Math.max(seen.rest, count(0, 0.1, resting));
      seen.right = Math.max(seen.right, count(0.7, 1, moving));
      seen.pictures += 1;
      await new Promise(requestAnimationFrame);
    }
    return seen;
  });
  assert.ok(seen.left === 0 && seen.rest > 30 && seen.right > 30 && seen.pictures > 10, JSON.stringify(seen));
});

test('a typed event has the numbers of the program, with the constants of the units', async () => {
  const page = await open('#/stress?my.rupture_velocity=3.0+km/s&my.slip_velocity=0.5+m/s', calm);
  const folder = mkdtempSync(join(tmpdir(), 'slipfront-'));
  const card = page.locator('.event');
  const agrees = async (toml) => {
    writeFileSync(join(folder, 'event.toml'), toml);
    const [theirs] = JSON.parse(execFileSync(process.env.SLIPFRONT, ['event', join(folder, 'event.toml'), '--json', '--quiet'])).events;
    await eventually(async () => {
      const shown = Number(/([\d.]+) MPa/.exec(await card.textContent())[1]);
      assert.ok(Math.abs((shown * 1e6) / theirs.stress_pa - 1) < 0.05, `${shown} MPa, ${theirs.stress_pa} Pa`); // both are sampled
    });
  };
  const event = '[event]\nrupture_velocity = "3.0 km/s"\n';
  await agrees(`${event}slip_velocity = "0.5 m/s"\n`);
  await page.getByRole('button', { name: 'Units' }).click();
  await page.getByLabel('Units').getByLabel('Shear modulus μ').fill('40 GPa');
  const rock = '[medium]\nshear_modulus = "40 GPa"\n';
  await agrees(`${event}slip_velocity = "0.5 m/s"\n${rock}`);
  assert.doesNotMatch(await card.textContent(), /shear_modulus 3e\+10/);
  const form = page.getByLabel('Question');
  assert.equal(await form.getByLabel('Shear modulus μ').inputValue(), '40 GPa');
  for (const [label, text] of [['Slip velocity', ''], ['Slip', '0.3 m'], ['Rise time', '0.6 s'], ['Stress drop', '20 MPa']]) await form.getByLabel(label, { exact: true }).fill(text);
  await agrees(`${event}slip = "0.3 m"\nrise_time = "0.6 s"\nstress_drop = "20 MPa"\n${rock}`);
  // The answer is a median, which may differ from what was typed: both are shown.
  await form.getByLabel('Rupture velocity', { exact: true }).fill('2.0 +- 0.3 km/s');
  await eventually(async () => assert.match(await card.textContent(), /2\.0 \+- 0\.3 km\/s.*0\.\d+ c = [12]\.\d+ km\/s.*medians of the posterior/));
});

test('a long run says so and can be stopped', async () => {
  const page = await open('#/pulse?pulse.cells=2000&friction.coefficient=0.1', calm);
  const stop = page.getByRole('button', { name: 'Stop' });
  await stop.waitFor();
  assert.match(await page.locator('.busy').first().innerText(), /longer than a second/);
  await stop.click();
  await stop.waitFor({ state: 'detached' });
  await page.goto(`${url}#/pulse?pulse.cells=60&time.end=1`);
  await ready(page);
  assert.equal(browser.isConnected(), true);
});

test('the page is one file of at most 700 kB, gzipped, and requests nothing', async () => {
  const size = gzipSync(readFileSync(process.env.SLIPFRONT_PAGE), { level: 9 }).length;
  console.log(`# ${(size / 1000).toFixed(1)} kB gzipped`);
  assert.ok(size <= 700_000, `${size} bytes`);
  for (const hash of ['#/', '#/pulse']) {
    const page = await open(hash, { offline: true });
    await ready(page);
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  }
});

test('its policy runs no other script, and permits no form and no other base', async () => {
  const page = await open('#/nothing', calm);
  const refused = await page.evaluate(async () => {
    const refused = [];
    addEventListener('securitypolicyviolation', (event) => refused.push(event.effectiveDirective));
    const add = (name, properties) => document.body.appendChild(Object.assign(document.createElement(name), properties));
    add('script', { textContent: 'window.intruder = true' });
    add('base', { href: 'https://example.org/' });
    add('form', { action: 'https://example.org/' }).submit();
    add('img', { src: 'https://example.org/a.png' });
    await fetch('https://example.org/').catch(() => 0);
    setTimeout(() => new Function('window.intruder = true')()); // at once, the browser would permit it to the test
    await new Promise((resolve) => setTimeout(resolve, 200));
    return { refused: [...new Set(refused)].sort(), intruder: 'intruder' in window, base: document.baseURI };
  });
  assert.equal(refused.intruder, false);
  assert.ok(refused.base.startsWith('file:'));
  for (const directive of ['base-uri', 'connect-src', 'form-action', 'img-src', 'script-src', 'script-src-elem']) assert.ok(refused.refused.includes(directive), `${directive} in ${refused.refused}`);
});
