/** How the dislocations are drawn: beads on the wells of the substrate, and the paths that they have come. */

import type { ChainBegun } from '../engine/protocol';
import { lastFrame, moving, type Chain } from '../model/chain';
import { color, theme } from '../ui/colors';

/** Paths that have been drawn already: only new frames are added. */
export interface Paths {
  of?: ChainBegun;
  canvas: OffscreenCanvas;
  drawn: number;
  look: string;
}

const strip = 46;
const edge = 14;

function drawPaths(paths: Paths, chain: Chain, end: number, width: number, height: number, ratio: number) {
  const look = [width, height, ratio, theme.value, end].join();
  if (paths.of !== chain.begun || paths.look !== look) {
    paths.canvas.width = width * ratio;
    paths.canvas.height = height * ratio;
    Object.assign(paths, { of: chain.begun, drawn: 0, look });
  }
  const ctx = paths.canvas.getContext('2d')!;
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.fillStyle = color('stress');
  ctx.globalAlpha = 0.55;
  const { left, right } = chain.begun;
  const size = chain.frames[0].x.length > 150 ? 1 : 1.5;
  for (; paths.drawn < chain.frames.length; ++paths.drawn) {
    const frame = chain.frames[paths.drawn];
    const y = height - 12 - (frame.time / end) * (height - strip - 30);
    for (const x of frame.x) ctx.fillRect(edge + ((x - left) / (right - left)) * (width - 2 * edge) - size / 2, y - size / 2, size, size);
  }
}

/** The beads now, on the wells of the substrate, and the paths that they have come. */
export function paint(canvas: HTMLCanvasElement, paths: Paths, chain: Chain, end: number) {
  const ratio = devicePixelRatio;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (!width) return;
  if (canvas.width !== Math.round(width * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = height * ratio;
  }
  const ctx = canvas.getContext('2d')!;
  ctx.setTransform(1, 0, 0, 1, 0, 0);
  ctx.clearRect(0, 0, canvas.width, canvas.height);
  drawPaths(paths, chain, end, width, height, ratio);
  ctx.drawImage(paths.canvas, 0, 0);
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  const { left, right } = chain.begun;
  const w = width - 2 * edge;
  ctx.strokeStyle = color('before');
  ctx.beginPath();
  const wells = Math.min(120, w / 9);
  for (let i = 0; i <= w; i += 1.5) ctx.lineTo(edge + i, strip - 8 + 5 * Math.cos((2 * Math.PI * i * wells) / w));
  ctx.stroke();
  const now = lastFrame(chain);
  const moves = moving(chain);
  const radius = Math.max(2.2, Math.min(6.5, (0.42 * w) / Math.max(20, now.x.length)));
  for (let i = 0; i < now.x.length; ++i) {
    ctx.fillStyle = now.sign[i] < 0 ? color('fast') : moves[i] ? color('slip') : color('stress');
    ctx.beginPath();
    ctx.arc(edge + ((now.x[i] - left) / (right - left)) * w, strip - 16, radius, 0, 7);
    ctx.fill();
  }
  ctx.fillStyle = color('quiet');
  ctx.font = '12px system-ui, sans-serif';
  ctx.fillText('x to the right, time upwards', edge, strip + 14);
}
