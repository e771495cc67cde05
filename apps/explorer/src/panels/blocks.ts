/** How a loaded chain is drawn: its blocks on a table, coloured by their slip velocity, and the spring that pulls them. */

import type { LoadedRun } from '../model/loading';
import { color, ramp } from '../ui/colors';

const height = 96;
const spring = { rest: 90, room: 60, turns: 8 };
const edge = 16;

/** Decades of slip velocity between the velocity of the spring and the fastest slip of a run. */
function tintOf(run: LoadedRun): (speed: number) => string {
  const colours = ramp([color('map-0'), ...[1, 2, 3].map((i) => color(`map-${i}`))]);
  const [least, most] = [Math.log10(run.begun.velocity), Math.log10(run.speed.reduce((a, b) => Math.max(a, b), 10 * run.begun.velocity))];
  return (speed) => `rgb(${colours((Math.log10(Math.max(speed, 1e-300)) - least) / (most - least)).map(Math.round)})`;
}

/** Draws the result `i` of a run. Displacements are enlarged so that the slip of the whole run crosses the free part of the table. */
export function paintBlocks(canvas: HTMLCanvasElement, run: LoadedRun, i: number) {
  const ratio = devicePixelRatio;
  const width = canvas.clientWidth;
  if (!width || !run.slip[i]) return;
  canvas.width = Math.round(width * ratio);
  canvas.height = height * ratio;
  const ctx = canvas.getContext('2d')!;
  ctx.scale(ratio, ratio);
  ctx.clearRect(0, 0, width, height);
  const slip = run.slip[i];
  const sites = slip.length;
  const far = run.slip[run.slip.length - 1].reduce((a, b) => Math.max(a, b), 0) || 1;
  const base = height - 18;
  ctx.fillStyle = color('line');
  ctx.fillRect(edge, base, width - 2 * edge, 5);
  // The spring pushes the left edge of a chain, or pulls a block at its right.
  const pushed = run.begun.pulls_an_end;
  const body = width - 2 * edge - spring.rest - 2 * spring.room;
  const start = edge + (pushed ? spring.rest : 0);
  const at = (j: number) => start + (j / sites) * body + (slip[Math.min(j, sites - 1)] / far) * spring.room;
  const tint = tintOf(run);
  for (let j = 0; j < sites; ++j) {
    ctx.fillStyle = tint(run.velocity[i][j]);
    ctx.fillRect(at(j), base - 44, (j + 1 < sites ? at(j + 1) : at(j) + body / sites) - at(j) + 0.5, 44);
  }
  ctx.strokeStyle = color('quiet');
  ctx.lineWidth = 1;
  ctx.strokeRect(at(0), base - 44, at(sites - 1) + body / sites - at(0), 44);
  const strained = (run.load[i] / (run.load.reduce((a, b) => Math.max(a, b), 0) || 1)) * 0.45 * spring.rest;
  const from = pushed ? at(0) - spring.rest + strained : at(sites - 1) + body / sites;
  const to = pushed ? at(0) : from + 0.5 * spring.rest + strained;
  ctx.strokeStyle = color('ink');
  ctx.lineWidth = 1.8;
  ctx.beginPath();
  ctx.moveTo(from, base - 22);
  for (let k = 0; k <= 2 * spring.turns; ++k) ctx.lineTo(from + ((k + 0.5) / (2 * spring.turns + 1)) * (to - from), base - 22 + (k % 2 ? 9 : -9));
  ctx.lineTo(to, base - 22);
  ctx.stroke();
  ctx.fillStyle = color('ink');
  ctx.fillRect((pushed ? from : to) - 3, base - 40, 6, 36);
}
