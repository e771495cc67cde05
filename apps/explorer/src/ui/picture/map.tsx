/** A picture of a field over x and t, with the fronts on it. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { statedAddress } from '../../state/route';
import { color, theme } from '../colors';
import { Data } from './data';
import { short } from '../format';
import { announce } from '../announce';
import { save } from '../save';
import { scaleOf, tRangeOf, type Scale } from './map_scale';
import { mapSvgOf } from './map_svg';
import { addressOf, pngOf } from './raster';
import { ticks } from './spec';
import { pathOf } from './svg';

export interface Field {
  title: string;
  name: string;
  x: ArrayLike<number>;
  t: ArrayLike<number>;
  /** All x at the first time, then all x at the next time, and so on. */
  values: ArrayLike<number>;
  xLabel: string;
  tLabel: string;
  label: string;
  xFactor: number;
  tFactor: number;
  factor: number;
  /** Lines over all t, or with a `t` of their own, where NaN ends a part of the line. */
  lines: { x: ArrayLike<number>; t?: ArrayLike<number>; color: string; label: string; dash?: number[]; width?: number }[];
  now?: number;
  /** Both ends of the axis of t, which else begins at 0. */
  tRange?: [number, number];
  /** Height of the field over its width; else that of the picture decides. */
  aspect?: number;
  /** The smallest and the largest value of the colours, else those of the field. */
  reach?: [number, number];
}


const margin = { left: 58, top: 6, bottom: 44, ofBar: 84 };
const bar = { gap: 14, width: 11, title: 16 };

/** The field without lines, one pixel per value. It is drawn only once, although the lines move over it often. */
interface Picture {
  of?: ArrayLike<number>;
  reach?: string;
  theme?: number;
  canvas: OffscreenCanvas;
  scale: Scale;
}

function draw(picture: Picture, f: Field) {
  const reach = f.reach?.join();
  if (picture.of === f.values && picture.reach === reach && picture.theme === theme.value) return;
  const [nx, nt] = [f.x.length, f.t.length];
  const data = new ImageData(nx, nt);
  const scale = scaleOf(f.reach ?? f.values);
  for (let j = 0; j < nt; ++j)
    for (let i = 0; i < nx; ++i) data.data.set([...scale.colour(f.values[j * nx + i]), 255], 4 * ((nt - 1 - j) * nx + i));
  const canvas = new OffscreenCanvas(nx, nt);
  canvas.getContext('2d')!.putImageData(data, 0, 0);
  Object.assign(picture, { of: f.values, reach, theme: theme.value, canvas, scale });
}

/** The field as an image for SVG pictures, and its colours. */
export async function imageOfField(f: Field): Promise<{ image: string; scale: Scale }> {
  const picture: Picture = { canvas: new OffscreenCanvas(1, 1), scale: scaleOf([]) };
  draw(picture, f);
  return { image: await addressOf(picture.canvas), scale: picture.scale };
}

/** The colour bar, from x = `left` on; the field has the height `h`. */
function paintBar(ctx: CanvasRenderingContext2D, { range: [least, most], colour }: Scale, f: Field, marks: number[], left: number, h: number) {
  for (let y = 0; y < h; ++y) {
    ctx.fillStyle = `rgb(${colour(most - ((y + 0.5) / h) * (most - least)).map(Math.round)})`;
    ctx.fillRect(left, margin.top + y, bar.width, 1.5);
  }
  ctx.strokeStyle = ctx.fillStyle = color('quiet');
  ctx.lineWidth = 1;
  ctx.strokeRect(left, margin.top, bar.width, h);
  ctx.textAlign = 'left';
  for (const mark of marks) ctx.fillText(short(mark), left + bar.width + 5, margin.top + h * (1 - (mark / f.factor - least) / (most - least)) + 4);
}

function sideways(ctx: CanvasRenderingContext2D, text: string, x: number, y: number) {
  ctx.save();
  ctx.translate(x, y);
  ctx.rotate(-Math.PI / 2);
  ctx.textAlign = 'center';
  ctx.fillText(text, 0, 0);
  ctx.restore();
}

function paint(canvas: HTMLCanvasElement, picture: Picture, f: Field, wanted: number) {
  const ratio = devicePixelRatio;
  const width = canvas.clientWidth;
  const height = f.aspect ? margin.top + margin.bottom + f.aspect * Math.max(0, width - margin.left - margin.ofBar) : wanted;
  canvas.style.height = `${height}px`;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const ctx = canvas.getContext('2d')!;
  ctx.scale(ratio, ratio);
  const [nx, nt] = [f.x.length, f.t.length];
  if (nt < 2 || nx < 2 || !width) return;
  const h = height - margin.top - margin.bottom;
  draw(picture, f);
  const [least, most] = picture.scale.range;
  const marks = least < most ? ticks([least * f.factor, most * f.factor], h / 40) : [];
  ctx.font = '12px system-ui, sans-serif';
  const w = width - margin.left - (f.aspect ? margin.ofBar : bar.gap + bar.width + 5 + Math.max(0, ...marks.map((mark) => ctx.measureText(short(mark)).width)) + bar.title);
  ctx.fillStyle = color('paper');
  ctx.fillRect(0, 0, width, height); // also in the PNG
  ctx.drawImage(picture.canvas, margin.left, margin.top, w, h);
  const half = (f.x[1] - f.x[0]) / 2;
  const [x0, x1] = [f.x[0] - half, f.x[nx - 1] + half];
  const [t0, t1] = tRangeOf(f);
  const at = (x: number, t: number): [number, number] => [margin.left + ((x - x0) / (x1 - x0)) * w, margin.top + h - ((t - t0) / (t1 - t0)) * h];
  for (const line of f.lines) {
    ctx.strokeStyle = color(line.color);
    ctx.lineWidth = line.width ?? 1.6;
    ctx.setLineDash(line.dash ?? []);
    ctx.stroke(new Path2D(pathOf(line.x, line.t ?? f.t, { x: (x) => at(x, t0)[0], y: (t) => at(x0, t)[1] })));
  }
  ctx.setLineDash([]);
  if (f.now !== undefined) {
    ctx.strokeStyle = color('ink');
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(...at(x0, f.now));
    ctx.lineTo(...at(x1, f.now));
    ctx.stroke();
  }
  ctx.fillStyle = color('quiet');
  ctx.textAlign = 'center';
  for (const tick of ticks([x0 * f.xFactor, x1 * f.xFactor], w / 75)) ctx.fillText(short(tick), at(tick / f.xFactor, t0)[0], height - margin.bottom + 17);
  ctx.fillText(f.xLabel, margin.left + w / 2, height - 8);
  ctx.textAlign = 'right';
  for (const tick of ticks([t0 * f.tFactor, t1 * f.tFactor], h / 40)) ctx.fillText(short(tick), margin.left - 7, at(x0, tick / f.tFactor)[1] + 4);
  sideways(ctx, f.tLabel, 13, margin.top + h / 2);
  sideways(ctx, f.label, width - 5, margin.top + h / 2);
  if (marks.length) paintBar(ctx, picture.scale, f, marks, margin.left + w + bar.gap, h);
}

export function SpaceTime({ field, height = 260, onPick }: { field: Field; height?: number; onPick?: (t: number) => void }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [cell, setCell] = useState<[number, number] | null>(null);
  const picture = useRef<Picture>({ canvas: new OffscreenCanvas(1, 1), scale: scaleOf([]) });
  const shown = useRef(field);
  shown.current = field;
  useEffect(() => paint(canvas.current!, picture.current, field, height), [field, height, theme.value]);
  useEffect(() => {
    const watch = new ResizeObserver(() => canvas.current && paint(canvas.current, picture.current, shown.current, height));
    watch.observe(canvas.current!);
    return () => watch.disconnect();
  }, [height]);
  const [nx, nt] = [field.x.length, field.t.length];
  const move = (di: number, dj: number) => {
    const [i, j] = cell ?? [nx >> 1, nt - 1];
    const next: [number, number] = [Math.min(nx - 1, Math.max(0, i + di)), Math.min(nt - 1, Math.max(0, j + dj))];
    setCell(next);
    announce(`x ${short(field.x[next[0]] * field.xFactor)}, ${field.tLabel.split(',')[0]} ${short(field.t[next[1]] * field.tFactor)}: ${short(field.values[next[1] * nx + next[0]] * field.factor)}`);
    if (dj) onPick?.(field.t[next[1]]);
  };
  const keys: Record<string, [number, number]> = { ArrowLeft: [-2, 0], ArrowRight: [2, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  return (
    <figure class="plot map">
      <figcaption>{field.title}
        <span class="legend">{field.lines.map((line) => <span><svg width="20" height="8" aria-hidden="true"><path d="M0 4h20" style={{ stroke: `var(--${line.color})` }} stroke-width="2" stroke-dasharray={line.dash?.join(' ')} /></svg> {line.label}</span>)}</span>
      </figcaption>
      <canvas ref={canvas} tabIndex={0} role="img" aria-label={`${field.title}. ${field.label} over ${field.xLabel} and ${field.tLabel}. Arrow keys read it.`}
        onKeyDown={(e) => { const way = keys[e.key]; if (way) { e.preventDefault(); move(...way); } }}
        onPointerDown={(e) => {
          const box = e.currentTarget.getBoundingClientRect();
          const share = 1 - (e.clientY - box.top - margin.top) / (height - margin.top - margin.bottom);
          onPick?.(Math.min(1, Math.max(0, share)) * field.t[nt - 1]);
        }} />
      <MapData field={field} picture={picture.current} />
    </figure>
  );
}

function csvOf(f: Field): string {
  const rows = [[`${f.tLabel.split(',')[0]} \\ x`, ...Array.from(f.x, (x) => x * f.xFactor)].join(',')];
  for (let j = 0; j < f.t.length; ++j) rows.push([f.t[j] * f.tFactor, ...Array.from({ length: f.x.length }, (_, i) => f.values[j * f.x.length + i] * f.factor)].join(','));
  return rows.join('\n') + '\n';
}

function MapData({ field: f, picture }: { field: Field; picture: Picture }) {
  const svg = async () => mapSvgOf(f, picture.scale, await addressOf(picture.canvas), statedAddress());
  const columns = Array.from({ length: 9 }, (_, k) => Math.round((k / 8) * (f.x.length - 1)));
  const rows = Array.from({ length: 13 }, (_, k) => Math.round((k / 12) * (f.t.length - 1)));
  return (
    <Data
      of={f.title}
      buttons={() => (
        <>
          <button type="button" onClick={async () => save(`${f.name}.png`, await pngOf(await svg()))}>PNG</button>
          <button type="button" onClick={async () => save(`${f.name}.svg`, await svg(), 'image/svg+xml')}>SVG</button>
          <button type="button" onClick={() => save(`${f.name}.csv`, csvOf(f), 'text/csv')}>CSV</button>
        </>
      )}
      table={() => (
        <>
          <caption>{f.title}, some rows and columns (all are in the CSV)</caption>
          <thead><tr><th scope="col">{f.tLabel}</th>{columns.map((i) => <th scope="col">x = {short(f.x[i] * f.xFactor, 3)}</th>)}</tr></thead>
          <tbody>{rows.map((j) => <tr><th scope="row">{short(f.t[j] * f.tFactor, 3)}</th>{columns.map((i) => <td>{short(f.values[j * f.x.length + i] * f.factor, 3)}</td>)}</tr>)}</tbody>
        </>
      )}
    />
  );
}
