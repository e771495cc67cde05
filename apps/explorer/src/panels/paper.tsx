/** Panel "The paper": its figures, each with sliders. */

import { useEffect, useState } from 'preact/hooks';
import { call } from '../engine/client';
import type { Complaint, RelationsKey } from '../engine/protocol';
import { last, lastOf, type PulseRun } from '../model/pulse_run';
import { entryOf, go, route, setParams, unitParams } from '../state/route';
import { commandOf, tomlOf } from '../state/scenario';
import { Controls } from '../ui/controls';
import { Equations } from '../ui/equations';
import { Check, NumberField, Segments, sentence } from '../ui/fields';
import type { Name } from '../ui/formulas';
import { short } from '../ui/format';
import { SpaceTime } from '../ui/picture/map';
import { Plot } from '../ui/picture/plot';
import { copy, save } from '../ui/save';
import { rangeAround, type Spec } from '../ui/picture/spec';
import { figures } from './figures';
import { useAnswer } from './use_answer';
import { useRuns, type Question } from './use_runs';

type Values = Record<string, number>;
interface View {
  values: Values;
  closure: string;
  log: boolean;
}

const colors = ['slip', 'stress', 'speed'];
const dashes = [undefined, [7, 4], [2, 3]];

function scenario(v: View, changes: { left?: number; right?: number; C?: number; width?: number; step?: boolean; cells?: number }) {
  const text = (n: number) => String(+n.toPrecision(6));
  const { left = v.values.left, right = v.values.right ?? 0, C = v.values.C ?? 0, width = v.values.width } = changes;
  return tomlOf({
    'initial.profile': changes.step ? 'step' : 'tanh', 'initial.stress_left': text(left), 'initial.stress_right': text(right), ...(changes.step ? {} : { 'initial.width': text(width) }),
    'friction.law': 'viscous', 'friction.coefficient': text(C), 'friction.closure': v.closure, 'pulse.cells': String(changes.cells ?? 100),
  });
}

function Problem({ error }: { error?: Complaint }) {
  return error ? <p class="error" role="alert">{error.key ? `${error.key}: ` : ''}{sentence(error)}</p> : null;
}

function Train({ values }: View) {
  const a = useAnswer('train', values.stress, values.velocity, 4, 600);
  if (!a) return null;
  if (a.error) return <Problem error={a.error} />;
  const flat = (value: number) => Array.from(a.xi, () => value);
  const spec = (name: string, title: string, y: Float64Array, mean: number, color: string, label: string): Spec => ({
    name, title, x: a.xi, xLabel: 'x − Ut, in b/A', yLabel: label,
    series: [{ label: 'single dislocations', y, color }, { label: 'average', y: flat(mean), color: 'quiet', dash: [6, 4] }],
  });
  return <div class="two"><Plot spec={spec('fig-02-slip', 'Slip velocity', a.w, a.W, 'slip', 'w, in cA/π')} height={260} /><Plot spec={spec('fig-02-stress', 'Stress', a.sigma, a.k, 'stress', 'σ, in μA/π')} height={260} /></div>;
}

function Before(v: View) {
  const [specs, setSpecs] = useState<Spec | null>(null);
  const [error, setError] = useState<Complaint>();
  const smooth = scenario(v, { C: 0 });
  const step = scenario(v, { C: 0, step: true, right: 0 });
  useEffect(() => {
    let alive = true;
    Promise.all([call('scenario', smooth), call('scenario', `${step}\n[domain]\nleft = -5\nright = 5\n`)]).then(([a, b]) => {
      if (!alive) return;
      setError(a.error ?? b.error);
      if (!a.error && !b.error)
        setSpecs({
          name: 'fig-03', title: 'Stress before', x: [], xLabel: 'x, in b/A', yLabel: 'Σ, in μA/π', series: [],
          paths: [{ label: 'step', x: b.x, y: b.stress, color: 'stress' }, { label: 'smooth', x: a.x, y: a.stress, color: 'slip', dash: [3, 4] }], yRange: rangeAround(a.stress, b.stress), xRange: [-5, 5],
        });
    });
    return () => void (alive = false);
  }, [smooth, step]);
  return <>{specs && <Plot spec={specs} height={320} />}<Problem error={error} /></>;
}

function Closed({ figure, values }: { figure: string; values: Values }) {
  const a = useAnswer('relations_curve', 1, values.least, 0.999, 400, 1);
  const marks = useAnswer('relations', 1, 0.55);
  const slow = useAnswer('relations', 1, 2.14e-5);
  if (!a) return null;
  if (a.error) return <Problem error={a.error} />;
  const events = [[marks, 'Parkfield', 'earthquake'], [slow, 'slow slip', 'slowslip']] as const;
  const points = (key: RelationsKey) => events.flatMap(([e, label, color]) => (e && !e.error ? [{ x: figure === '4' ? e.rupture_velocity : e.stress, y: e[key], label, color, chosen: true }] : []));
  const against = figure === '4' ? { x: a.rupture_velocity, xLabel: '|V−|, in c', xLog: true } : { x: a.stress, xLabel: 'Σ−, in μA/π' };
  const spec: Record<string, Spec> = {
    4: { name: 'fig-04', title: '|V− / V+|', ...against, yLabel: '|V− / V+|', series: [{ label: 'ratio', y: a.velocity_ratio, color: 'fast' }], points: points('velocity_ratio') },
    5: { name: 'fig-05', title: 'Rupture velocity', ...against, yLabel: '|V−|, in c', yLog: true, series: [{ label: '|V−|', y: a.rupture_velocity, color: 'fast' }], points: points('rupture_velocity') },
    6: { name: 'fig-06', title: 'Slip velocity without friction', ...against, yLabel: 'W(0), in cA/π', yLog: true, series: [{ label: 'W(0)', y: a.slip_velocity, color: 'slip' }], points: points('slip_velocity') },
  };
  return <Plot spec={spec[figure]} height={420} />;
}

function Waiting({ done, of }: { done: number; of: number }) {
  return done < of ? <p class="busy" role="status">Computing {done + 1} of {of} …</p> : null;
}

function Surface(v: View) {
  const { runs, error } = useRuns([{ toml: scenario(v, {}), frames: 61 }], 30);
  const run = runs[0];
  return (
    <>
      <Problem error={error} />
      {run && <SpaceTime height={420} field={{ title: 'Slip velocity', name: 'surface', x: run.x, t: run.series.time, values: run.fields.W, xLabel: 'x, in b/A', tLabel: 't, in b/(cA)', label: 'W, in cA/π', xFactor: 1, tFactor: 1, factor: 1, lines: [] }} />}
      {run && <Plot height={200} spec={{ name: 'profiles', title: 'The same at four times', x: run.x, xLabel: 'x, in b/A', yLabel: 'W, in cA/π', series: [0.1, 0.4, 0.7, 1].map((share, i) => { const k = Math.round(share * (run.count - 1)); return { label: `t = ${short(run.series.time[k], 2)}`, y: run.fields.W.subarray(k * run.x.length, (k + 1) * run.x.length), color: ['before', 'speed', 'stress', 'slip'][i] }; }) }} />}
    </>
  );
}

function Three({ figure, ...v }: View & { figure: string }) {
  const coefficients = [v.values.C1, v.values.C2, v.values.C3];
  const { runs, error, done } = useRuns(coefficients.map((C) => ({ toml: scenario(v, { C, cells: 200 }), frames: 2 })), 31);
  const there = runs.flatMap((run, i) => (run ? [{ run, C: coefficients[i], i }] : []));
  if (!there.length) return <><Problem error={error} /><Waiting done={done} of={3} /></>;
  const stress = figure === '9';
  const peak = (run: PulseRun) => lastOf(run, 'peak_slip_velocity');
  const factor = (run: PulseRun) => (stress ? 1 : peak(there[0].run) / peak(run));
  const label = (run: PulseRun, C: number) => `C = ${short(C)}${stress || factor(run) === 1 ? '' : `, times ${short(factor(run), 3)}`}`;
  const paths = there.map(({ run, C, i }) => ({ label: label(run, C), x: run.x, y: Float64Array.from(last(run, stress ? 'Sigma' : 'W'), (w) => w * factor(run)), color: colors[i], dash: dashes[i] }));
  const spec: Spec = {
    name: stress ? 'fig-09' : 'fig-08', title: stress ? 'Stress at t = 2π' : 'Slip velocity at t = 2π', x: [], xLabel: 'x, in b/A', yLabel: stress ? 'Σ, in μA/π' : 'W, in cA/π', series: [], yLog: !stress && v.log,
    paths, yRange: !stress && v.log ? [1e-5 * peak(there[0].run), 2 * peak(there[0].run)] : rangeAround(...paths.map(({ y }) => y)),
  };
  return <><Problem error={error} /><Plot spec={spec} height={420} /><Waiting done={done} of={3} /></>;
}

const frictions = [0, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1, 1.5, 2];
const drops = [1, 0.9, 0.8, 0.7, 0.6, 0.5, 0.42, 0.35, 0.25, 0.15, 0.08];

function Sweep({ figure, ...v }: View & { figure: string }) {
  const byFriction = figure === '10';
  const stresses = byFriction ? [v.values.left, v.values.left2, v.values.left3] : [v.values.left, v.values.left2];
  const values = byFriction ? frictions : drops;
  const questions: Question[] = stresses.flatMap((left) => values.map((value) => ({
    toml: byFriction ? scenario(v, { left, C: value }) : scenario(v, { left, right: left * (1 - value) < 0.0045 ? 0 : left * (1 - value), step: true }), frames: 2,
  })));
  const { runs, error, done } = useRuns(questions, 32);
  const paths = stresses.map((left, k) => {
    const mine = runs.slice(k * values.length, (k + 1) * values.length);
    const W = mine.map((run) => (run ? lastOf(run, 'slip_velocity_at_origin') : NaN));
    return { label: `Σ− = ${short(left)}`, x: byFriction ? values : values.map((d) => 100 * d), y: byFriction ? W.map((w) => w / W[0]) : W, color: colors[k], dash: dashes[k] };
  });
  const marks = byFriction ? [[0.1, 0.83], [0.5, 0.5], [2, 0.2]].map(([x, y]) => ({ x, y, label: `the paper reads ${y}`, color: 'chosen', chosen: true })) : [];
  const spec: Spec = byFriction
    ? { name: 'fig-10', title: 'W(C) / W(0) at x = 0, t = 2π (dots: read off by the paper)', x: [], xLabel: 'friction C', yLabel: 'share left by friction', series: [], paths, points: marks, xRange: [0, 2.05], yRange: [0, 1.05] }
    : { name: 'fig-12', title: 'Slip velocity at x = 0, t = 2π', x: [], xLabel: '(Σ− − Σ+) / Σ−, in %', yLabel: 'W, in cA/π', series: [], paths, xRange: [0, 100], yRange: rangeAround(...paths.map(({ y }) => y)) };
  return <><Problem error={error} />{done > 1 && <Plot spec={spec} height={420} />}<Waiting done={done} of={questions.length} /></>;
}

function Picture({ figure, ...v }: View & { figure: string }) {
  if (figure === '2') return <Train {...v} />;
  if (figure === '3') return <Before {...v} />;
  if (['4', '5', '6'].includes(figure)) return <Closed figure={figure} values={v.values} />;
  if (['7', '11'].includes(figure)) return <Surface {...v} />;
  if (['8', '9'].includes(figure)) return <Three figure={figure} {...v} />;
  return <Sweep figure={figure} {...v} />;
}

const equations = (figure: string): Name[] =>
  figure === '2' ? ['train', 'averages'] : figure === '3' ? ['stress'] : ['4', '5', '6'].includes(figure) ? ['stress', 'fronts', 'origin'] : ['number', 'momentum', 'friction', 'average'];

export function PaperPanel() {
  const params = route.value.params;
  const figure = entryOf(figures, params.fig) ? params.fig : '8';
  const { title, text, sliders, closure, logarithmic } = figures[figure];
  const texts = sliders.map(({ key, value }) => params[key] ?? value);
  const bad = texts.map((one) => one.trim() === '' || !Number.isFinite(Number(one)));
  const values = Object.fromEntries(sliders.map(({ key, value }, i) => [key, bad[i] ? Number(value) : Number(texts[i])]));
  const view: View = { values, closure: params.closure === 'consistent' ? 'consistent' : 'paper', log: params.log === '1' };
  const runs = Boolean(closure);
  const toml = runs ? scenario(view, { C: values.C ?? values.C2 ?? 0.5, step: figure === '12' }) : '';
  return (
    <div class="panel">
      <Controls label="Figure">
        <Segments label="Figure" value={figure} choices={Object.keys(figures).map((key) => ({ value: key, label: key }))} onInput={(fig) => go('paper', { ...unitParams(), fig })} />
        <h2>{title}</h2>
        <p class="hint">{text}</p>
        {sliders.map((s, i) => (
          <NumberField key={figure + s.key} label={s.label} value={texts[i]} least={s.least} most={s.most} log={s.log} onInput={(one) => setParams({ [s.key]: one })} error={bad[i] ? 'Not a number. Allowed: a number such as 0.5.' : ''} />
        ))}
        {closure && <Segments label="How friction is averaged" value={view.closure} choices={[{ value: 'paper', label: 'As in the paper' }, { value: 'consistent', label: 'Exactly' }]} onInput={(one) => setParams({ closure: one })} />}
        {logarithmic && <Check label="Logarithmic axis" checked={view.log} onInput={(on) => setParams({ log: on ? '1' : null })} />}
        {runs && (
          <>
            <p class="buttons"><button type="button" onClick={() => copy(toml, 'scenario')}>Copy scenario</button><button type="button" onClick={() => save('scenario.toml', toml)}>Save .toml</button></p>
            <p class="command"><code>{commandOf('pulse', 'scenario.toml')}</code></p>
          </>
        )}
      </Controls>
      <section class="pictures" aria-label={title}><Picture key={figure} figure={figure} {...view} /><Equations key={`equations ${figure}`} names={equations(figure)} /></section>
    </div>
  );
}
