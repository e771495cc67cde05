/** A field over x and t as SVG, for papers and lectures: the field as an image, with axes, fronts and colour bar as text and lines. */

import { color } from '../colors';
import { short } from '../format';
import type { Field } from './map';
import { tRangeOf, type Scale } from './map_scale';
import { axes, legend, sheet, sideways, type Box } from './sheet';
import { ticks } from './spec';
import { pathOf } from './svg';

const barWidth = 14;

/** The colours of the bar, from the largest value down, and its ticks. */
function bar({ range: [least, most], colour }: Scale, factor: number, left: number, box: Box): string {
  const height = box.bottom - box.top;
  const stops = Array.from({ length: 33 }, (_, i) => `<stop offset="${i / 32}" stop-color="rgb(${colour(most - (i / 32) * (most - least)).map(Math.round)})"/>`);
  const marks = ticks([least * factor, most * factor], 6).map((mark) => {
    const y = box.top + height * (1 - (mark / factor - least) / (most - least));
    return `<path d="M${left + barWidth} ${y}h4" stroke="${color('ink')}"/><text x="${left + barWidth + 7}" y="${y + 4}">${short(mark)}</text>`;
  });
  return `<linearGradient id="bar" x2="0" y2="1">${stops.join('')}</linearGradient>
<rect x="${left}" y="${box.top}" width="${barWidth}" height="${height}" fill="url(#bar)" stroke="${color('ink')}"/>
${marks.join('\n')}`;
}

/** `image` is the address of the field as a picture, with the last time on top. */
export function mapSvgOf(f: Field, scale: Scale, image: string, link = '', width = 720, height = 480): string {
  const nx = f.x.length;
  const [least, most] = scale.range;
  const box: Box = { left: 76, right: width - (least < most ? 110 : 20), top: 60, bottom: height - 56 };
  if (f.aspect) box.right = Math.min(box.right, box.left + (box.bottom - box.top) / f.aspect);
  const half = (f.x[1] - f.x[0]) / 2;
  const [x0, x1] = [f.x[0] - half, f.x[nx - 1] + half];
  const [t0, t1] = tRangeOf(f);
  const frame = { x: (x: number) => box.left + ((x - x0) / (x1 - x0)) * (box.right - box.left), y: (t: number) => box.bottom - ((t - t0) / (t1 - t0)) * (box.bottom - box.top) };
  const lines = f.lines.map((line) => `<path d="${pathOf(line.x, line.t ?? f.t, frame)}" fill="none" stroke="${color(line.color)}" stroke-width="${line.width ?? 1.8}"${line.dash ? ` stroke-dasharray="${line.dash.join(' ')}"` : ''}/>`);
  return sheet(f.title, link, width, height, color, `<image href="${image}" x="${box.left}" y="${box.top}" width="${box.right - box.left}" height="${box.bottom - box.top}" preserveAspectRatio="none"/>
${lines.join('\n')}
${axes(box, color,
    { label: f.xLabel, ticks: ticks([x0 * f.xFactor, x1 * f.xFactor], 7).map((tick) => ({ at: frame.x(tick / f.xFactor), text: short(tick) })) },
    { label: f.tLabel, ticks: ticks([t0 * f.tFactor, t1 * f.tFactor], 6).map((tick) => ({ at: frame.y(tick / f.tFactor), text: short(tick) })) })}
${legend(box.left + 8, color, f.lines)}
${least < most ? bar(scale, f.factor, box.right + 16, box) + sideways(box.right + 98, (box.top + box.bottom) / 2, f.label) : ''}`);
}
