/** A plot as SVG, for papers and lectures: the curves in the colours of the page. */

import { axes, escape, legend, sheet, type Box, type Color } from './sheet';
import { off, on, rangeOf, spread, ticks, tickText, type Spec } from './spec';

interface Frame {
  x: (value: number) => number;
  y: (value: number) => number;
}

/** The points of a curve as the commands of an SVG path. */
export function pathOf(x: ArrayLike<number>, y: ArrayLike<number>, frame: Frame): string {
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

export function svgOf(spec: Spec, color: Color, link = '', width = 720, height = 430): string {
  const verticals = (spec.verticals ?? []).filter((v) => Number.isFinite(v.x));
  const box: Box = { left: 76, right: width - 20, top: verticals.length ? 76 : 60, bottom: height - 56 };
  const [xRange, yRange] = [rangeOf(spec, 'x'), rangeOf(spec, 'y')];
  const frame: Frame = {
    x: (value) => box.left + ((on(value, spec.xLog) - xRange[0]) / (xRange[1] - xRange[0])) * (box.right - box.left),
    y: (value) => box.bottom - ((on(value, spec.yLog) - yRange[0]) / (yRange[1] - yRange[0])) * (box.bottom - box.top),
  };
  const parts: string[] = [`<clipPath id="box"><rect x="${box.left}" y="${box.top}" width="${box.right - box.left}" height="${box.bottom - box.top}"/></clipPath>`];
  parts.push(axes(box, color,
    { label: spec.xLabel, ticks: ticks(xRange, 7, spec.xLog).map((tick) => ({ at: frame.x(off(tick, spec.xLog)), text: tickText(tick, spec.xLog) })) },
    { label: spec.yLabel, ticks: ticks(yRange, (box.bottom - box.top) / 60, spec.yLog).map((tick) => ({ at: frame.y(off(tick, spec.yLog)), text: tickText(tick, spec.yLog) })) }));
  const line = (d: string, name: string, dash?: number[], thickness = 1.8, fill?: boolean) =>
    parts.push(`<path clip-path="url(#box)" d="${d}" fill="${fill ? color(`${name}-soft`) : 'none'}" stroke="${color(name)}" stroke-width="${thickness}"${dash ? ` stroke-dasharray="${dash.join(' ')}"` : ''}/>`);
  const edges = spread(verticals.map((v) => frame.x(v.x)), verticals.map((v) => 6.8 * v.label.length), [box.left, box.right], 8);
  verticals.forEach((v, i) => parts.push(`<text x="${edges[i].toFixed(1)}" y="${box.top - 6}" fill="${color(v.color)}">${escape(v.label)}</text>`));
  verticals.forEach((v) => line(`M${frame.x(v.x)} ${box.bottom}V${box.top}`, v.color, [3, 4], 1));
  spec.series.forEach((s) => line(pathOf(spec.x, s.y, frame), s.color, s.dash, s.width));
  spec.paths?.forEach((p) => line(pathOf(p.x, p.y, frame), p.color, p.dash, p.width, p.fill));
  spec.points?.forEach((p) => parts.push(`<circle cx="${frame.x(p.x).toFixed(2)}" cy="${frame.y(p.y).toFixed(2)}" r="${p.chosen ? 6 : 3.5}" fill="${color(p.color)}"><title>${escape(p.label)}</title></circle>`));
  parts.push(legend(box.left + 8, color, [...spec.series, ...(spec.paths ?? [])]));
  return sheet(spec.title, link, width, height, color, parts.join('\n'));
}
