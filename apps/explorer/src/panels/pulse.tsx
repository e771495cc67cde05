/** Panel "Pulse": the modulation equations with friction, live. */

import { useEffect, useMemo, useRef } from 'preact/hooks';
import type { PulseField, PulseSeries } from '../engine/protocol';
import { fieldAt, seriesAt, type PulseRun } from '../model/pulse_run';
import { route, setParams, type Params } from '../state/route';
import { drawnOf, scenarioOf, tableOf, tomlOf } from '../state/scenario';
import { scaleOf, type Quantity } from '../state/units';
import { Controls } from '../ui/controls';
import { Exchange } from '../ui/exchange';
import { Equations } from '../ui/equations';
import { CannotRun, Check } from '../ui/fields';
import { Film, filmHeight, filmWidth } from '../ui/film';
import { short } from '../ui/format';
import { SpaceTime } from '../ui/picture/map';
import { makePlayer, reducedMotion, Transport, type Player } from '../ui/player';
import { Plot } from '../ui/picture/plot';
import { ScenarioForm } from '../ui/scenario_form';
import { svgOf } from '../ui/picture/svg';
import { color } from '../ui/colors';
import { rangeAround, reach, type Series, type Spec } from '../ui/picture/spec';
import { stopAll } from '../engine/client';
import { usePulse, type Shown } from './use_pulse';

/** The fraction of the run at which the panel opens: both fronts are on their way. */
const opening = 0.3;
const player: Player = makePlayer(opening);

type Range = [number, number];
const largest = (values: ArrayLike<number>) => {
  const [least, most] = reach(values);
  return Math.max(-least, most);
};

const times = (values: ArrayLike<number>, factor: number) => (factor === 1 ? values : Float64Array.from(values as ArrayLike<number>, (v) => v * factor));

interface Curve {
  run: PulseRun;
  label: string;
  color: (base: string) => string;
  dash?: number[];
}

function profile(name: string, title: string, field: PulseField, quantity: Quantity, symbol: string, color: string, curves: Curve[], time: number, usual: Range): Spec {
  const first = curves[0].run;
  const xScale = scaleOf('x', largest(first.x));
  const now = curves.map((curve) => fieldAt(curve.run, field, time));
  const before = field === 'Sigma' ? [fieldAt(first, field, 0)] : [];
  const extent = reach(usual, ...now, ...before);
  const yScale = scaleOf(quantity, largest(extent));
  const series: Series[] = before.map((y) => ({ label: 'before', y: times(y, yScale.factor), color: 'before', width: 1.5 }));
  curves.forEach((curve, i) => series.push({ label: curve.label, y: times(now[i], yScale.factor), color: curve.color(color), dash: curve.dash, fill: field === 'W' && !curve.dash }));
  const fronts: [PulseSeries, string, string][] = [['trailing_front', 'V−', 'fast'], ['leading_front', 'V+', 'slow']];
  const verticals = fronts.map(([key, label, tint]) => ({ x: seriesAt(first, key, time) * xScale.factor, label, color: tint })).filter((v) => Number.isFinite(v.x));
  return {
    name, title, x: times(first.x, xScale.factor), xLabel: `x, in ${xScale.unit}`, yLabel: `${symbol}, in ${yScale.unit}`, series, verticals,
    yRange: rangeAround(times(extent, yScale.factor)), factors: [xScale.factor, yScale.factor],
  };
}

/** Shows the quick look at the new scenario if there is one, else the run. */
function runToShow(shown: Shown): PulseRun | null {
  return shown.look ?? shown.run;
}

/** The range of a field in most of the run. The axis also contains the profile that is shown. */
function extentOf(run: PulseRun, field: PulseField): Range {
  const steady = run.fields[field];
  // The slip velocity of a step is largest at the start. On its scale, all later profiles would look flat.
  if (field !== 'W') return reach(steady);
  const n = run.x.length;
  return reach(steady.subarray(Math.min(steady.length - n, n * Math.max(1, Math.round(run.count * 0.1)))));
}

function Facts({ run, time }: { run: PulseRun; time: number }) {
  const value = (key: PulseSeries, quantity: Quantity) => {
    const number = seriesAt(run, key, time);
    const scale = scaleOf(quantity, number);
    return Number.isFinite(number) ? `${short(number * scale.factor, 4)} ${scale.unit}` : '–';
  };
  const coefficient = run.frictionCoefficient; // null if friction is not viscous, and 0 without friction: neither damps
  return (
    <dl class="facts" aria-label="Numbers at this time">
      <div><dt>Slip velocity at x = 0</dt><dd>{value('slip_velocity_at_origin', 'slipVelocity')}</dd></div>
      <div><dt>Slip at x = 0</dt><dd>{value('slip_at_origin', 'slip')}</dd></div>
      <div><dt>Fast front, V−</dt><dd>{value('trailing_front', 'x')}</dd></div>
      <div><dt>Slow front, V+</dt><dd>{value('leading_front', 'x')}</dd></div>
      {coefficient ? <div><dt>Damping number Γ = C t</dt><dd>{short(coefficient * time, 3)}</dd></div> : null}
    </dl>
  );
}

function energySpec(run: PulseRun): Spec {
  const t = scaleOf('t', run.end);
  const first = run.series.energy_elastic[0];
  const loss = Float64Array.from(run.series.energy_elastic, (value) => first - value);
  return {
    name: 'energy', title: 'Where the stored energy goes', x: times(run.series.time, t.factor), xLabel: `t, in ${t.unit}`, yLabel: 'energy',
    series: [
      { label: 'released', y: loss, color: 'stress' },
      { label: 'kinetic', y: run.series.energy_kinetic, color: 'slip' },
      { label: 'taken by friction', y: run.series.energy_dissipated, color: 'friction' },
    ],
  };
}

function mapOf(run: PulseRun, now: number) {
  const x = scaleOf('x', largest(run.x));
  const t = scaleOf('t', run.end);
  const w = scaleOf('slipVelocity', largest(run.fields.W));
  return {
    title: 'Slip velocity over x and t', name: 'space-time', x: run.x, t: run.series.time, values: run.fields.W, xFactor: x.factor, tFactor: t.factor, factor: w.factor,
    xLabel: `x, in ${x.unit}`, tLabel: `t, in ${t.unit}`, label: `W, in ${w.unit}`, now,
    lines: [
      { x: run.series.trailing_front, color: 'fast', label: 'V−' },
      { x: run.series.leading_front, color: 'slow', label: 'V+' },
    ],
  };
}

/** The points of a drawn stress. */
function pointsOf(params: Params): [number[], number[]] | null {
  const table = params['initial.profile'] === 'table' ? tableOf(params) : null;
  return table && [table[0].slice(1, -1), table[1].slice(1, -1)];
}

const allowed = (stress: number) => (stress < 0.02 ? 0 : Math.min(2, stress));

function movePoint(index: number, change: number) {
  const [x, y] = pointsOf(route.value.params)!;
  setParams({ drawn: drawnOf(x, y.map((stress, i) => (i === index ? allowed(+(stress + change).toFixed(4)) : stress))) });
}

function useDrawing() {
  const stroke = useRef<{ x: number[]; y: number[] } | null>(null);
  return (x: number, y: number, first: boolean) => {
    const table = tableOf(route.value.params);
    const scenario = scenarioOf(route.value.params);
    const [left, right] = [Number(scenario['domain.left'] ?? -6), Number(scenario['domain.right'] ?? 4)];
    const count = 40;
    const grid = Array.from({ length: count + 1 }, (_, i) => left + ((right - left) * i) / count);
    const at = (px: number) => {
      if (!table) return 0;
      const [tx, ty] = table;
      let i = 0;
      while (i < tx.length - 2 && tx[i + 1] < px) ++i;
      const share = Math.min(1, Math.max(0, (px - tx[i]) / (tx[i + 1] - tx[i])));
      return ty[i] * (1 - share) + ty[i + 1] * share;
    };
    if (first || !stroke.current) stroke.current = { x: [], y: [] };
    stroke.current.x.push(x);
    stroke.current.y.push(y);
    const { x: sx, y: sy } = stroke.current;
    const width = (right - left) / count;
    const values = grid.map((gx) => {
      for (let i = sx.length - 1; i >= 0; --i) {
        const j = Math.max(0, i - 1);
        const [a, b] = [Math.min(sx[i], sx[j]) - width / 2, Math.max(sx[i], sx[j]) + width / 2];
        if (gx >= a && gx <= b) return sy[i];
      }
      return at(gx);
    });
    setParams({ drawn: drawnOf(grid, values.map(allowed)) });
  };
}

export function PulsePanel() {
  const params = route.value.params;
  const scenario = scenarioOf(params);
  const toml = tomlOf(scenario);
  const table = tableOf(params);
  const end = Number(scenario['time.end'] ?? 2 * Math.PI);
  const compare = params.compare === '1' && scenario['friction.law'] !== 'none';
  const look = () => Math.max(1e-3, player.at.value * end);
  const main = usePulse(toml, table, 1, look);
  const other = usePulse(toml, table, 2, look, scenario['friction.closure'] === 'paper' ? 1 : 2, compare);
  const draw = useDrawing();
  useEffect(() => {
    if (params.t !== undefined && Number.isFinite(Number(params.t))) player.at.value = Math.min(1, Math.max(0, Number(params.t)));
    else player.at.value = opening;
    if (params.play === '1' && !reducedMotion()) { player.at.value = 0; player.playing.value = true; }
    return () => { player.playing.value = false; };
  }, [params.t, params.play]);

  const run = runToShow(main);
  const second = compare ? runToShow(other) : null;
  const whole = main.run;
  const extents = useMemo(() => whole && { W: extentOf(whole, 'W'), Sigma: extentOf(whole, 'Sigma'), U: extentOf(whole, 'U') }, [whole]);
  const slow = main.busy && main.elapsed > 1;
  const time = player.at.value * (run?.end ?? end);
  const t = scaleOf('t', end);
  const names: Record<string, string> = { consistent: 'exact average', paper: 'average of the paper' };
  const specsAt = (wanted: number): Spec[] | null => {
    if (!run || run.count < 1 || !run.fields.W.length) return null;
    const at = Math.min(wanted, run.series.time[run.count - 1]);
    const curves: Curve[] = [{ run, label: compare ? names[run.closure] : 'now', color: (base) => base }];
    if (second?.fields.W.length) curves.push({ run: second, label: names[second.closure], color: (base) => `${base}-other`, dash: [6, 4] });
    // While a control moves, the slip velocity keeps its scale, so that one sees it grow.
    const extent = (field: 'W' | 'Sigma' | 'U'): Range => (main.look && field !== 'W' ? [0, 0] : extents?.[field] ?? [0, 0]);
    return [
      profile('slip-velocity', 'Slip velocity', 'W', 'slipVelocity', 'W', 'slip', curves, at, extent('W')),
      profile('stress', 'Stress', 'Sigma', 'stress', 'Σ', 'stress', curves, at, extent('Sigma')),
      profile('dislocation-velocity', 'Velocity of the dislocations', 'U', 'velocity', 'U', 'speed', curves, at, extent('U')),
    ];
  };
  const specs = useMemo(() => specsAt(time), [run, second, time, extents, params.si, scaleOf('stress', 1).factor, scaleOf('x', 1).factor]);
  const film = (share: number) => specsAt(share * end)!.slice(0, 2).map((spec) =>
    svgOf({ ...spec, title: `${spec.title} at t = ${short(share * end * t.factor, 3)} ${t.unit}` }, color, '', filmWidth, filmHeight / 2));
  const map = useMemo(() => whole && whole.count > 2 && mapOf(whole, time), [whole, time, params.si, scaleOf('x', 1).factor]);
  const energy = useMemo(() => whole && whole.count > 2 && energySpec(whole), [whole, params.si]);
  const settle = (at: number) => setParams({ t: at.toFixed(3), play: null });
  const warnings = whole?.warnings ?? [];
  const points = pointsOf(params);
  const factors = specs?.[1].factors ?? [1, 1];
  return (
    <div class="panel">
      <Controls label="Scenario">
        <ScenarioForm error={main.error} extra={scenario['friction.law'] !== 'none' && <Check label="Both averages of friction side by side" checked={compare} onInput={(on) => setParams({ compare: on ? '1' : null })} />} />
        <Exchange command="pulse" />
      </Controls>
      <section class="pictures" aria-label="Pulse">
        <Transport player={player} end={end} unit={t.unit} factor={t.factor} onSettle={settle} />
        {slow && (
          <p class="busy" role="status">
            This run takes longer than a second: {Math.round(100 * main.share)} % after {main.elapsed.toFixed(0)} s. <button type="button" onClick={() => { main.stop(); stopAll(); }}>Stop</button>
          </p>
        )}
        <CannotRun error={main.error} shown={Boolean(run)} />
        {specs && run ? (
          <div class={`results ${main.error ? 'stale' : ''}`}>
            <Facts run={whole && !main.look ? whole : run} time={time} />
            <Plot spec={specs[0]} height={210} />
            <Plot spec={points ? { ...specs[1], handles: { x: points[0].map((v) => v * factors[0]), y: points[1].map((v) => v * factors[1]), name: 'initial stress' } } : specs[1]} height={190} onMove={movePoint}
              onDraw={points ? (x, y, first) => draw(x / factors[0], y / factors[1], first) : undefined} />
            <div class="two">
              {map && <SpaceTime field={map} onPick={(picked) => { player.playing.value = false; player.at.value = picked / end; settle(picked / end); }} />}
              <div>
                <Plot spec={specs[2]} height={130} />
                {energy && <Plot spec={energy} height={130} />}
              </div>
            </div>
            {whole?.finished && !main.error && <Film name="pulse" pictures={film} />}
            {warnings.length > 0 && <ul class="warnings" aria-label="Warnings of the run">{warnings.map((w) => <li>{w}</li>)}</ul>}
            <Equations names={['number', 'momentum', 'friction']} />
          </div>
        ) : !main.error && <p class="busy" role="status">Computing …</p>}
      </section>
    </div>
  );
}
