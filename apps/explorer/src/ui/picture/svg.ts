/** A plot as SVG, for papers and lectures: the curves in the colours of the page, with the title and the link to the scenario. */

import { off, on, rangeOf, spread, ticks, tickText, type Spec } from './spec';

const escape = (text: string) => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;');

interface Frame {
  x: (value: number) => number;
  y: (value: number) => number;
}

function pathOf(x: ArrayLike<number>, y: ArrayLike<number>, frame: Frame): string {
  let text = '';
  let draws = false;
  for (let i = 0; i < x.length; ++i) {
    const [px, py] = [frame.x(x[i]), frame.y(y[i])];
    if (!Number.isFinite(px) || !Number.isFinite(py)) draws = false;
    else {
      text += `${draws ? 'L' : 'M'}${px.toFixed(2)} ${py.toFixed(2)}`;
      draws = true;
    }
  }
  return text;
}

export function svgOf(spec: Spec, color: (name: string) => string, link = '', width = 720, height = 430): string {
  const links = link.match(/.{1,118}/g) ?? [];
  const whole = height + 13 * links.length + (links.length && 4);
  const verticals = (spec.verticals ?? []).filter((v) => Number.isFinite(v.x));
  const box = { left: 76, right: width - 20, top: verticals.length ? 76 : 60, bottom: height - 56 };
  const [xRange, yRange] = [rangeOf(spec, 'x'), rangeOf(spec, 'y')];
  const frame: Frame = {
    x: (value) => box.left + ((on(value, spec.xLog) - xRange[0]) / (xRange[1] - xRange[0])) * (box.right - box.left),
    y: (value) => box.bottom - ((on(value, spec.yLog) - yRange[0]) / (yRange[1] - yRange[0])) * (box.bottom - box.top),
  };
  const parts: string[] = [];
  for (const tick of ticks(xRange, 7, spec.xLog)) {
    const x = frame.x(off(tick, spec.xLog));
    parts.push(`<path d="M${x} ${box.bottom}v5" stroke="${color('ink')}"/><text x="${x}" y="${box.bottom + 20}" text-anchor="middle">${tickText(tick, spec.xLog)}</text>`);
  }
  for (const tick of ticks(yRange, 5, spec.yLog)) {
    const y = frame.y(off(tick, spec.yLog));
    parts.push(`<path d="M${box.left} ${y}h-5" stroke="${color('ink')}"/><text x="${box.left - 9}" y="${y + 4}" text-anchor="end">${tickText(tick, spec.yLog)}</text>`);
  }
  const line = (d: string, name: string, dash?: number[], thickness = 1.8) =>
    parts.push(`<path clip-path="url(#box)" d="${d}" fill="none" stroke="${color(name)}" stroke-width="${thickness}"${dash ? ` stroke-dasharray="${dash.join(' ')}"` : ''}/>`);
  const edges = spread(verticals.map((v) => frame.x(v.x)), verticals.map((v) => 6.8 * v.label.length), [box.left, box.right], 8);
  verticals.forEach((v, i) => parts.push(`<text x="${edges[i].toFixed(1)}" y="${box.top - 6}" fill="${color(v.color)}">${escape(v.label)}</text>`));
  verticals.forEach((v) => line(`M${frame.x(v.x)} ${box.bottom}V${box.top}`, v.color, [3, 4], 1));
  spec.series.forEach((s) => line(pathOf(spec.x, s.y, frame), s.color, s.dash, s.width));
  spec.paths?.forEach((p) => line(pathOf(p.x, p.y, frame), p.color, p.dash, p.width));
  spec.points?.forEach((p) => parts.push(`<circle cx="${frame.x(p.x).toFixed(2)}" cy="${frame.y(p.y).toFixed(2)}" r="${p.chosen ? 6 : 3.5}" fill="${color(p.color)}"><title>${escape(p.label)}</title></circle>`));
  let at = box.left + 8;
  for (const s of [...spec.series, ...(spec.paths ?? [])]) {
    if (!s.label) continue;
    parts.push(`<path d="M${at} 46h18" stroke="${color(s.color)}" stroke-width="2"${s.dash ? ` stroke-dasharray="${s.dash.join(' ')}"` : ''}/><text x="${at + 23}" y="50">${escape(s.label)}</text>`);
    at += 40 + 6.4 * s.label.length;
  }
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${whole}" width="${width}" height="${whole}" font-family="Helvetica, Arial, sans-serif" font-size="12" fill="${color('ink')}">
<title>${escape(spec.title)}</title>${link && `<desc>${escape(link)}</desc>`}<rect width="100%" height="100%" fill="${color('paper')}"/><clipPath id="box"><rect x="${box.left}" y="${box.top}" width="${box.right - box.left}" height="${box.bottom - box.top}"/></clipPath>
<path d="M${box.left} ${box.top}V${box.bottom}H${box.right}" fill="none" stroke="${color('ink')}"/>
${parts.join('\n')}
<text x="${box.left}" y="26" font-size="16" font-weight="bold">${escape(spec.title)}</text>
${links.map((part, i) => `<text x="14" y="${height + 13 * i + 6}" font-size="10" textLength="${part.length < 118 ? '' : width - 28}" lengthAdjust="spacingAndGlyphs">${escape(part)}</text>`.replace(' textLength="" lengthAdjust="spacingAndGlyphs"', '')).join('\n')}
<text x="${(box.left + box.right) / 2}" y="${height - 14}" text-anchor="middle">${escape(spec.xLabel)}</text>
<text transform="translate(18 ${(box.top + box.bottom) / 2}) rotate(-90)" text-anchor="middle">${escape(spec.yLabel)}</text></svg>
`;
}
