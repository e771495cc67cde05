/** Points of a curve that the arrow keys move: left and right choose one, up and down change its value. */

import { useState } from 'preact/hooks';
import type uPlot from 'uplot';
import { short } from '../format';
import type { Spec } from './spec';

export function Handles({ spec, onMove }: { spec: Spec; onMove: (index: number, change: number) => void }) {
  const [chosen, choose] = useState(0);
  const { x, y, name } = spec.handles!;
  const key = (e: KeyboardEvent, i: number) => {
    const large = e.shiftKey ? 0.1 : 0.02;
    const change = { ArrowUp: large, ArrowDown: -large, PageUp: 0.1, PageDown: -0.1 }[e.key];
    const to = { ArrowLeft: i - 1, ArrowRight: i + 1, Home: 0, End: x.length - 1 }[e.key];
    if (change === undefined && to === undefined) return;
    e.preventDefault();
    if (change !== undefined) return onMove(i, change);
    (e.currentTarget as HTMLElement).parentElement!.querySelectorAll<HTMLElement>('span')[Math.min(x.length - 1, Math.max(0, to!))].focus();
  };
  return (
    <div class="handles" role="group" aria-label={`Points of the ${name}. Left and right choose one, up and down move it.`}>
      {x.map((at, i) => (
        <span role="slider" tabIndex={i === Math.min(chosen, x.length - 1) ? 0 : -1} aria-orientation="vertical" aria-label={`${name} at x = ${short(at)}`}
          aria-valuenow={+y[i].toPrecision(4)} aria-valuemin={0} aria-valuetext={`${short(y[i])}; ${spec.yLabel}`} onFocus={() => choose(i)} onKeyDown={(e) => key(e, i)} />
      ))}
    </div>
  );
}

/** Moves the handles of a plot to their points. */
export function placeHandles(u: uPlot, { handles }: Spec, box: Element | null | undefined) {
  if (!handles || !box) return;
  box.querySelectorAll<HTMLElement>('span').forEach((span, i) => {
    if (i >= handles.x.length) return;
    const [x, y] = [u.valToPos(handles.x[i], 'x'), u.valToPos(handles.y[i], 'y')];
    const width = u.over.offsetWidth;
    span.style.left = `${u.over.offsetLeft + Math.min(width, Math.max(0, x))}px`; // the ends may be half a cell outside
    span.style.top = `${u.over.offsetTop + y}px`;
    span.style.visibility = x > -12 && x < width + 12 ? 'visible' : 'hidden';
  });
}
