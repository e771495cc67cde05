/** A plot that can be read with a mouse, a finger, the arrow keys, a screen reader, or as a table. */

import { useEffect, useRef, useState } from 'preact/hooks';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { statedAddress } from '../../state/route';
import { color, theme } from '../colors';
import { Data } from './data';
import { short } from '../format';
import { Handles, placeHandles } from './handles';
import { save } from '../save';
import { pngOf } from './raster';
import { columns, csvOf, off, on, rangeOf, spread, ticks, tickText, type Path, type Spec } from './spec';
import { svgOf } from './svg';

interface Props {
  spec: Spec;
  height?: number;
  onPick?: (index: number) => void;
  onDraw?: (x: number, y: number, first: boolean) => void;
  onMove?: (index: number, change: number) => void;
}

const numbers = (values: ArrayLike<number>, log?: boolean) =>
  Array.from(values, (value) => {
    const at = on(value, log);
    return Number.isFinite(at) ? at : null;
  });

function dataOf(spec: Spec): uPlot.AlignedData {
  const x = spec.x.length ? numbers(spec.x, spec.xLog) : (rangeOf(spec, 'x') as (number | null)[]);
  const none = x.map(() => null);
  const series = spec.series.length ? spec.series.map((s) => numbers(s.y, spec.yLog)) : [none];
  return [x as number[], ...series];
}

function drawPath(u: uPlot, path: Path, spec: Spec) {
  const { ctx } = u;
  ctx.beginPath();
  let draws = false;
  for (let i = 0; i < path.x.length; ++i) {
    const [x, y] = [on(path.x[i], spec.xLog), on(path.y[i], spec.yLog)];
    if (!Number.isFinite(x) || !Number.isFinite(y)) draws = false;
    else {
      const [px, py] = [u.valToPos(x, 'x', true), u.valToPos(y, 'y', true)];
      if (draws) ctx.lineTo(px, py);
      else ctx.moveTo(px, py);
      draws = true;
    }
  }
  if (path.fill) {
    ctx.fillStyle = color(`${path.color}-soft`);
    ctx.fill();
  }
  if (path.width === 0) return;
  ctx.strokeStyle = color(path.color);
  ctx.lineWidth = (path.width ?? 1.8) * devicePixelRatio;
  ctx.setLineDash((path.dash ?? []).map((d) => d * devicePixelRatio));
  ctx.stroke();
  ctx.setLineDash([]);
}

function drawExtras(u: uPlot, spec: Spec) {
  const { ctx, bbox } = u;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  const lines = shownLines(u, spec);
  for (const { x, tint } of lines) {
    ctx.strokeStyle = color(tint);
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash([3 * devicePixelRatio, 4 * devicePixelRatio]);
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.setLineDash([]);
  }
  spec.paths?.forEach((path) => drawPath(u, path, spec));
  for (const p of [...(spec.points ?? [])].sort((a, b) => Number(a.chosen ?? 0) - Number(b.chosen ?? 0))) {
    const [x, y] = [u.valToPos(on(p.x, spec.xLog), 'x', true), u.valToPos(on(p.y, spec.yLog), 'y', true)];
    ctx.fillStyle = ctx.strokeStyle = color(p.color);
    if (p.xInterval) {
      const [a, b] = p.xInterval.map((v) => u.valToPos(on(v, spec.xLog), 'x', true));
      ctx.lineWidth = 2 * devicePixelRatio;
      ctx.beginPath();
      ctx.moveTo(a, y);
      ctx.lineTo(b, y);
      ctx.stroke();
    }
    ctx.beginPath();
    ctx.arc(x, y, (p.chosen ? 6.5 : 3.5) * devicePixelRatio, 0, 7);
    ctx.fill();
    ctx.lineWidth = (p.chosen ? 2 : 1) * devicePixelRatio;
    ctx.strokeStyle = color('ground');
    ctx.stroke();
  }
  ctx.restore();
  labelLines(u, lines);
}

interface Line {
  x: number;
  label: string;
  tint: string;
}

/** The vertical lines inside the plot, in pixels. */
const shownLines = (u: uPlot, spec: Spec): Line[] =>
  (spec.verticals ?? []).flatMap((v) => {
    const at = on(v.x, spec.xLog);
    const x = Number.isFinite(at) ? u.valToPos(at, 'x', true) : NaN;
    return x >= u.bbox.left - 1 && x <= u.bbox.left + u.bbox.width + 1 ? [{ x, label: v.label, tint: v.color }] : [];
  });

/** Labels of the lines, above the plot, where no curve crosses them. */
function labelLines({ ctx, bbox }: uPlot, lines: Line[]) {
  ctx.font = `600 ${11 * devicePixelRatio}px system-ui, sans-serif`;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'alphabetic';
  const edges = spread(lines.map(({ x }) => x), lines.map(({ label }) => ctx.measureText(label).width), [0, bbox.left + bbox.width + 12 * devicePixelRatio], 8 * devicePixelRatio);
  lines.forEach(({ label, tint }, i) => {
    ctx.fillStyle = color(tint);
    ctx.fillText(label, edges[i], bbox.top - 5 * devicePixelRatio);
  });
}

function optionsOf(spec: () => Spec, width: number, height: number, moved: (i: number | null) => void, drawn: (u: uPlot) => void): uPlot.Options {
  const axis = (which: 'x' | 'y'): uPlot.Axis => ({
    scale: which,
    stroke: () => color('quiet'),
    grid: { stroke: () => color('grid'), width: 1 },
    ticks: { show: false },
    font: '12px system-ui, sans-serif',
    labelFont: '13px system-ui, sans-serif',
    label: which === 'x' ? spec().xLabel : spec().yLabel,
    labelSize: 20,
    size: which === 'x' ? 30 : 58,
    gap: 6,
    splits: (u) => {
      const { min = 0, max = 1 } = u.scales[which];
      const about = (which === 'x' ? u.bbox.width : u.bbox.height) / devicePixelRatio / (which === 'x' ? 85 : 34);
      return ticks([min!, max!], about, which === 'x' ? spec().xLog : spec().yLog);
    },
    values: (_, splits) => splits.map((tick) => tickText(tick, which === 'x' ? spec().xLog : spec().yLog)),
  });
  return {
    width,
    height,
    pxAlign: 0,
    legend: { show: false },
    padding: [spec().verticals ? 18 : 8, 14, 0, 0],
    cursor: { y: false, drag: { x: false, y: false }, points: { size: 7 } },
    scales: { x: { time: false, range: () => rangeOf(spec(), 'x') }, y: { range: () => rangeOf(spec(), 'y') } },
    axes: [axis('x'), axis('y')],
    series: [
      {},
      ...(spec().series.length ? spec().series : [{ label: '', y: [], color: 'quiet', width: 1 }]).map((s) => ({
        stroke: () => color(s.color),
        width: s.width ?? 2,
        dash: s.dash,
        points: { show: false },
        pxAlign: 0,
        fill: s.fill ? () => color(`${s.color}-soft`) : undefined,
      })),
    ],
    hooks: { draw: [(u) => drawExtras(u, spec()), drawn], setCursor: [(u) => moved(u.cursor.idx ?? null)] },
  };
}

/** The values of all curves at one x, as a sentence. */
function readout(spec: Spec, i: number): string {
  if (!spec.x.length) return '';
  return `${spec.xLabel}: ${short(spec.x[i])}; ${spec.series.map((s) => `${s.label}: ${short(s.y[i])}`).join('; ')}`;
}

export function Plot({ spec, height = 220, onPick, onDraw, onMove }: Props) {
  const holder = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const now = useRef(spec);
  const [at, setAt] = useState<number | null>(null);
  const [byKeys, setByKeys] = useState(false);
  now.current = spec;
  const shape = [spec.series.map((s) => s.color + (s.dash ?? '') + (s.width ?? '') + (s.fill ?? '')).join(), spec.xLabel, spec.yLabel, spec.xLog, spec.yLog, Boolean(spec.verticals), height, theme.value].join('|');

  useEffect(() => {
    const box = holder.current!;
    const made = new uPlot(optionsOf(() => now.current, box.clientWidth || 300, height, setAt, (u) => placeHandles(u, now.current, box.nextElementSibling)), dataOf(now.current), box);
    plot.current = made;
    const watch = new ResizeObserver(() => made.setSize({ width: Math.max(180, box.clientWidth), height }));
    watch.observe(box);
    return () => {
      watch.disconnect();
      made.destroy();
      plot.current = null;
    };
  }, [shape]);
  useEffect(() => plot.current?.setData(dataOf(spec)), [spec]);

  const place = (i: number) => {
    const u = plot.current;
    if (!u || !spec.x.length) return;
    const clipped = Math.min(spec.x.length - 1, Math.max(0, i));
    setByKeys(true);
    setAt(clipped);
    u.setCursor({ left: u.valToPos(on(spec.x[clipped], spec.xLog), 'x'), top: 10 });
  };
  const key = (e: KeyboardEvent) => {
    if (!spec.x.length) return;
    const step = e.shiftKey ? 10 : 1;
    const from = at ?? Math.floor(spec.x.length / 2);
    const to = { ArrowLeft: from - step, ArrowRight: from + step, PageDown: from - 25, PageUp: from + 25, Home: 0, End: spec.x.length - 1 }[e.key];
    if (to === undefined) return;
    e.preventDefault();
    place(to);
  };
  const pointed = (e: PointerEvent, first: boolean) => {
    const u = plot.current;
    if (!u) return;
    const over = u.over.getBoundingClientRect();
    const [left, top] = [e.clientX - over.left, e.clientY - over.top];
    if (onDraw && (first || e.buttons)) onDraw(off(u.posToVal(left, 'x'), spec.xLog), off(u.posToVal(top, 'y'), spec.yLog), first);
    if (!onPick || !first || !spec.points?.length) return;
    const distances = spec.points.map((p) => Math.hypot(u.valToPos(on(p.x, spec.xLog), 'x') - left, u.valToPos(on(p.y, spec.yLog), 'y') - top));
    const nearest = distances.indexOf(Math.min(...distances));
    if (distances[nearest] < 24) onPick(nearest);
  };
  const text = at !== null && at < spec.x.length ? readout(spec, at) : '';
  return (
    <figure class="plot">
      <figcaption>{spec.title}<Legend spec={spec} /></figcaption>
      <div class="board"><div class={`canvas ${onDraw ? 'drawable' : ''}`} ref={holder} tabIndex={0} role="group" aria-roledescription="plot"
        aria-label={`${spec.title}. ${spec.yLabel} against ${spec.xLabel}. Arrow keys move the cursor.`} onKeyDown={key}
        onPointerDown={(e) => { if (onDraw) (e.currentTarget as HTMLElement).setPointerCapture(e.pointerId); pointed(e, true); }}
        onPointerMove={(e) => onDraw && pointed(e, false)} />
      {onMove && spec.handles && <Handles spec={spec} onMove={onMove} />}</div>
      <p class="readout" aria-live={byKeys ? 'polite' : 'off'}>{text}</p>
      <PlotData spec={spec} />
    </figure>
  );
}

function Legend({ spec }: { spec: Spec }) {
  const named = [...spec.series, ...(spec.paths ?? [])].filter((s) => s.label);
  if (named.length < 2) return null;
  return (
    <span class="legend">
      {named.map((s) => (
        <span>
          <svg width="20" height="8" aria-hidden="true"><path d="M0 4h20" style={{ stroke: `var(--${s.color})` }} stroke-width={s.width ?? 2} stroke-dasharray={s.dash?.join(' ')} /></svg> {s.label}
        </span>
      ))}
    </span>
  );
}

function PlotData({ spec }: { spec: Spec }) {
  const svg = () => svgOf(spec, color, statedAddress());
  return (
    <Data
      of={spec.title}
      buttons={() => (
        <>
          <button type="button" onClick={async () => save(`${spec.name}.png`, await pngOf(svg()))}>PNG</button>
          <button type="button" onClick={() => save(`${spec.name}.svg`, svg(), 'image/svg+xml')}>SVG</button>
          <button type="button" onClick={() => save(`${spec.name}.csv`, csvOf(spec), 'text/csv')}>CSV</button>
        </>
      )}
      table={() => {
        const { head, rows } = columns(spec);
        const every = Math.max(1, Math.ceil(rows.length / 100));
        return (
          <>
            <caption>{spec.title}{every > 1 ? `, every ${every}th row (all are in the CSV)` : ''}</caption>
            <thead><tr>{head.map((name) => <th scope="col">{name}</th>)}</tr></thead>
            <tbody>{rows.filter((_, i) => i % every === 0).map((row) => <tr>{row.map((cell) => <td>{typeof cell === 'number' ? short(cell, 6) : cell}</td>)}</tr>)}</tbody>
          </>
        );
      }}
    />
  );
}
