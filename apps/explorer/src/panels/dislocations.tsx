/** Panel "Dislocations": the chain of the scenario, live, bead by bead. */

import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import type { Answer, Complaint } from '../engine/binding';
import { call } from '../engine/client';
import { route, setParams } from '../state/route';
import { scenarioOf, tableOf, tomlOf } from '../state/scenario';
import { scaleOf, type Quantity } from '../state/units';
import { color, theme } from '../ui/colors';
import { Data } from '../ui/data';
import { Equations } from '../ui/equations';
import { Exchange } from '../ui/exchange';
import { CannotRun, NumberField } from '../ui/fields';
import { short } from '../ui/format';
import { reducedMotion } from '../ui/player';
import { Plot } from '../ui/plot';
import { save } from '../ui/save';
import { ScenarioForm } from '../ui/scenario_form';
import type { Spec } from '../ui/spec';

interface Frame {
  time: number;
  x: Float64Array;
  sign: Float64Array;
}
interface Chain {
  begun: Answer;
  frames: Frame[];
  /** The last answer with averages, and the first. */
  average: Answer;
  first: Answer;
}

const most = 400;

/** Paths that have been drawn already: only new frames are added. */
interface Paths {
  of?: Answer;
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
function paint(canvas: HTMLCanvasElement, paths: Paths, chain: Chain, end: number) {
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
  const now = chain.frames[chain.frames.length - 1];
  const speeds = speedsOf(chain.frames);
  const radius = Math.max(2.2, Math.min(6.5, (0.42 * w) / Math.max(20, now.x.length)));
  for (let i = 0; i < now.x.length; ++i) {
    ctx.fillStyle = now.sign[i] < 0 ? color('fast') : speeds[i] > 0.003 ? color('slip') : color('stress');
    ctx.beginPath();
    ctx.arc(edge + ((now.x[i] - left) / (right - left)) * w, strip - 16, radius, 0, 7);
    ctx.fill();
  }
  ctx.fillStyle = color('quiet');
  ctx.font = '12px system-ui, sans-serif';
  ctx.fillText('place to the right, time upwards', edge, strip + 14);
}

/** Of the beads in the last frame, from where they were a little before. */
function speedsOf(frames: Frame[]): number[] {
  const now = frames[frames.length - 1];
  const before = frames[Math.max(0, frames.length - 6)];
  if (before.x.length !== now.x.length || now.time === before.time) return Array.from(now.x, () => 0);
  return Array.from(now.x, (x, i) => Math.abs(x - before.x[i]) / (now.time - before.time));
}

function useChain(toml: string, table: [number[], number[]] | null, count: number, end: number) {
  const [chain, setChain] = useState<Chain | null>(null);
  const [error, setError] = useState<Complaint>();
  const [playing, setPlaying] = useState(false);
  const [rate, setRate] = useState(0);
  const live = useRef(0);
  const held = useRef<Chain | null>(null);
  const begin = async (run: boolean) => {
    const mine = ++live.current;
    setPlaying(false);
    if (table) await call('set_table', Float64Array.from(table[0]), Float64Array.from(table[1]), table[0].length);
    const begun = await call('chain_begin', toml, count, 8);
    if (mine !== live.current) return;
    if (begun.error) return setError(begun.error);
    const start = await call('chain_go', 0, 5, 0.12 * (begun.right - begun.left));
    if (mine !== live.current || start.error) return setError(start.error);
    setError(undefined);
    held.current = { begun, frames: [{ time: 0, x: start.x, sign: start.sign }], average: start, first: start };
    setChain(held.current);
    if (run) setPlaying(true);
  };
  useEffect(() => {
    const timer = setTimeout(() => begin(!reducedMotion()), live.current ? 150 : 0);
    return () => clearTimeout(timer);
  }, [toml, table?.join(), count]);
  useEffect(() => {
    if (!playing || !held.current) return;
    let alive = true;
    let shown = 0;
    let since = performance.now();
    /** The next picture is computed while this one is drawn. */
    const ask = (frame: Frame, count: number) => {
      const { left, right } = held.current!.begun;
      return call('chain_go', Math.min(end, frame.time + end / 480), 14, count % 3 === 0 || frame.time >= end * (1 - 2 / 480) ? 0.12 * (right - left) : 0);
    };
    const first = held.current.frames;
    let coming = ask(first[first.length - 1], first.length);
    const step = async () => {
      const more = await coming;
      if (!alive) return;
      if (more.error) { setError(more.error); return setPlaying(false); }
      const now = held.current!;
      const over = more.time >= end - 1e-9;
      if (!over) coming = ask(more as Frame, now.frames.length + 1);
      held.current = { ...now, frames: [...now.frames, { time: more.time, x: more.x, sign: more.sign }], average: more.W ? more : now.average };
      setChain(held.current);
      if (++shown === 20) {
        setRate((1000 * shown) / (performance.now() - since));
        shown = 0;
        since = performance.now();
      }
      if (over) setPlaying(false);
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
    return () => void (alive = false);
  }, [playing]);
  return { chain, error, playing, setPlaying, restart: () => begin(true), rate };
}

export function DislocationsPanel() {
  const params = route.value.params;
  const scenario = scenarioOf(params);
  const toml = tomlOf(scenario);
  const table = tableOf(params);
  const end = Number(scenario['time.end'] ?? 2 * Math.PI);
  const typed = params.beads ?? '100';
  const number = Number(typed);
  const bad = !(number >= 1 && number <= most) || !Number.isInteger(number);
  const { chain, error, playing, setPlaying, restart, rate } = useChain(toml, table, bad ? 100 : number, end);
  const canvas = useRef<HTMLCanvasElement>(null);
  const paths = useRef<Paths>({ canvas: new OffscreenCanvas(1, 1), drawn: 0, look: '' });
  const held = useRef(chain);
  held.current = chain;
  useEffect(() => {
    if (canvas.current && chain) paint(canvas.current, paths.current, chain, end);
  }, [chain, theme.value]);
  useEffect(() => {
    const watch = new ResizeObserver(() => held.current && canvas.current && paint(canvas.current, paths.current, held.current, end));
    if (canvas.current) watch.observe(canvas.current);
    return () => watch.disconnect();
  }, [Boolean(chain), end]);
  const now = chain?.frames[chain.frames.length - 1];
  const over = now && now.time >= end - 1e-9;
  const [t, x] = [scaleOf('t', end), scaleOf('x', chain?.begun.right - chain?.begun.left || 1)];
  const si = `${scaleOf('stress', 1).factor}|${x.factor}|${x.unit}`;
  const averages = useMemo(() => chain && [
    averageSpec(chain, 'W', 'Slip velocity, averaged over eight dislocations', 'slip', 'slipVelocity', 0.05, x),
    averageSpec(chain, 'Sigma', 'Stress, averaged over eight dislocations', 'stress', 'stress', 1, x),
  ], [chain?.average, si]);
  const close = useMemo(() => chain && closeSpec(chain, x), [chain?.average, si]);
  return (
    <div class="panel">
      <aside class="controls" aria-label="Scenario">
        <h2>Chain</h2>
        <NumberField label="Dislocations" value={typed} least={1} most={most} log onInput={(text) => setParams({ beads: /^\d+\.\d+$/.test(text) ? String(Math.max(1, Math.round(Number(text)))) : text })}
          error={bad ? `Allowed: a whole number from 1 to ${most}; the program takes millions.` : ''} hint="Few: see each of them. Many: see the average emerge." />
        <ScenarioForm error={error} averages={false} />
        <Exchange command="chain" />
      </aside>
      <section class="pictures" aria-label="Dislocations">
        <div class="transport chain">
          <button type="button" class="play" aria-label={playing ? 'Pause' : 'Play'} onClick={() => (over ? restart() : setPlaying(!playing))}>
            <svg viewBox="0 0 24 24" width="22" height="22" aria-hidden="true">{playing ? <path d="M6 5h4v14H6zM14 5h4v14h-4z" /> : <path d="M7 4.5v15l13-7.5z" />}</svg>
          </button>
          <progress max={end} value={now?.time ?? 0} aria-label="Time" />
          <output>t = {short((now?.time ?? 0) * t.factor, 3)} {t.unit}</output>
          <button type="button" onClick={restart}>Start again</button>
        </div>
        <CannotRun error={error} shown={Boolean(chain)} />
        {!chain && !error && <p class="busy" role="status">Laying the dislocations …</p>}
        {chain && now && (
          <div class={error ? 'stale' : ''}>
            <dl class="facts">
              <div><dt>Dislocations</dt><dd>{now.x.length}</dd></div>
              <div><dt>Sites of the chain</dt><dd>{chain.begun.sites}</dd></div>
              <div><dt>Scale</dt><dd>{short(chain.begun.scale)}</dd></div>
              <div><dt>First of them is at</dt><dd>{short((now.x[now.x.length - 1] ?? NaN) * x.factor)} {x.unit}</dd></div>
              <div><dt>Pictures a second</dt><dd>{rate ? Math.round(rate) : '–'}</dd></div>
            </dl>
            <figure class="plot">
              <figcaption>Dislocations and their paths <span class="legend"><span><i style={{ background: 'var(--slip)' }} /> moving</span><span><i style={{ background: 'var(--stress)' }} /> at rest</span></span></figcaption>
              <canvas class="beads" style={{ height: '330px' }} ref={canvas} role="img" tabIndex={0} aria-label={`${now.x.length} dislocations at t = ${short(now.time, 3)}. The table below has their places.`} />
              <Places chain={chain} />
            </figure>
            {averages && <div class="two">{averages.map((spec) => <Plot spec={spec} height={200} />)}</div>}
            {close && <Plot spec={close} height={190} />}
            <Equations names={['chain', 'train']}><p>The chain is stretched by the scale, and friction is divided by it: the same problem with more or fewer dislocations.</p></Equations>
          </div>
        )}
      </section>
    </div>
  );
}

type Scale = { unit: string; factor: number };
const times = (values: Float64Array, factor: number) => values.map((v) => v * factor);

function averageSpec(chain: Chain, key: 'W' | 'Sigma', title: string, tint: string, quantity: Quantity, typical: number, x: Scale): Spec {
  const { unit, factor } = scaleOf(quantity, typical);
  const yLabel = `${key === 'W' ? 'W' : 'Σ'}, in ${unit}`;
  const series = [{ label: 'now', y: times(chain.average[key], factor), color: tint, fill: key === 'W' }];
  return {
    name: `average-${key}`, title, x: times(chain.average.average_x, x.factor), xLabel: `x, in ${x.unit}`, yLabel,
    series: key === 'Sigma' ? [{ label: 'before', y: times(chain.first[key], factor), color: 'before', fill: false }, ...series] : series,
    yRange: key === 'Sigma' ? [0, Math.max(...chain.first[key]) * factor * 1.2] : undefined,
  };
}

function closeSpec(chain: Chain, x: Scale): Spec {
  const stress = scaleOf('stress', 2);
  return {
    name: 'single-dislocations', title: 'Near x = 0, not averaged: each dislocation is a peak of stress', x: times(chain.average.near_x, x.factor), xLabel: `x, in ${x.unit}`, yLabel: `σ and w`,
    series: [
      { label: 'stress', y: times(chain.average.near_stress, stress.factor), color: 'stress', width: 1.5 },
      { label: 'slip velocity', y: times(chain.average.near_velocity, scaleOf('slipVelocity', 2).factor), color: 'slip', width: 1.5 },
    ],
  };
}

function Places({ chain }: { chain: Chain }) {
  const now = chain.frames[chain.frames.length - 1];
  const csv = () => ['t,dislocation,x', ...chain.frames.flatMap((frame) => Array.from(frame.x, (x, i) => `${frame.time},${i + 1},${x}`))].join('\n') + '\n';
  return (
    <Data
      of="places of the dislocations"
      buttons={() => <button type="button" onClick={() => save('paths.csv', csv(), 'text/csv')}>CSV of all paths</button>}
      table={() => (
        <>
          <caption>Places at t = {short(now.time)}</caption>
          <thead><tr><th scope="col">dislocation</th><th scope="col">x, in b/A</th></tr></thead>
          <tbody>{Array.from(now.x, (x, i) => <tr><th scope="row">{i + 1}</th><td>{short(x, 6)}</td></tr>)}</tbody>
        </>
      )}
    />
  );
}
