/** Panel "Riemann": two uniform trains meet, and the exact waves between them. */

import { useEffect, useState } from 'preact/hooks';
import { call } from '../engine/client';
import type { Complaint, Riemann } from '../engine/protocol';
import { route, setParams } from '../state/route';
import { Controls } from '../ui/controls';
import { Equations } from '../ui/equations';
import { about, NumberField, sentence } from '../ui/fields';
import { short } from '../ui/format';
import { Plot } from '../ui/picture/plot';
import type { Path, Spec } from '../ui/picture/spec';

const fields = [
  { key: 'left_stress', label: 'Left stress, in μA/π', value: '0.855', least: 0, most: 2 },
  { key: 'left_velocity', label: 'Left velocity U, in c', value: '0', least: -0.9, most: 0.9 },
  { key: 'right_stress', label: 'Right stress, in μA/π', value: '0.179', least: 0, most: 2 },
  { key: 'right_velocity', label: 'Right velocity U, in c', value: '0', least: -0.9, most: 0.9 },
];

const waveInWords: Record<string, string> = { fan: 'a fan', 'two-trains': 'two trains', none: 'no wave' };
const countInWords = ['no dislocations', 'one train', 'two trains'];

/** The number without a rounding error, that of the sizes which cancel. */
const free = (value: number, size: number) => (Math.abs(value) < 1e-12 * size ? 0 : value);

/** Rays of constant state in x-t; t goes to 1. A wave has several rays. */
function rays(a: Riemann): Path[] {
  const all: Path[] = [];
  const ray = (speed: number, color: string, width: number, label?: string) => all.push({ x: [0, speed], y: [0, 1], color, width, label });
  for (const { kind, from, to } of a.regions) {
    if (kind !== 'fan' && kind !== 'two-trains') continue;
    const [color, name] = kind === 'fan' ? ['fast', 'fan'] : ['chosen', 'two trains'];
    const named = all.some(({ label }) => label === name);
    for (let i = 0; i <= 12; ++i) ray(from + ((to - from) * i) / 12, color, i === 0 || i === 12 ? 2.2 : 0.9, i === 0 && !named ? name : undefined);
  }
  return all;
}

/** The filled part of the plane of x/t and rapidity, and the edges of its bands. Curves end at the edges of a region, where trains begin or end. */
function bands(a: Riemann): Path[] {
  const all: Path[] = [];
  const ends = a.regions.flatMap(({ from, to }) => [from, to]);
  for (const [lowest, highest] of [[a.lowest_1, a.highest_1], [a.lowest_2, a.highest_2]])
    for (let from = 0, to = 0; from < lowest.length; from = to + 1) {
      to = from;
      if (!Number.isFinite(lowest[from])) continue;
      while (to + 1 < lowest.length && Number.isFinite(lowest[to + 1]) && !ends.some((end) => a.x_over_t[to] < end && end < a.x_over_t[to + 1])) ++to;
      const [x, low, high] = [a.x_over_t, lowest, highest].map((values) => Array.from(values.slice(from, to + 1)));
      all.push({ x: [...x, ...x.slice().reverse()], y: [...high, ...low.slice().reverse()], color: 'stress', width: 0, fill: true });
      for (const y of [low, high]) all.push({ x, y, color: 'stress', width: 1.4 });
    }
  return all;
}

function profileSpec(a: Riemann, key: 'Sigma' | 'W' | 'slip', title: string, yLabel: string, color: string): Spec {
  return { name: key, title, x: a.x_over_t, xLabel: 'x/t, in c', yLabel, series: [{ label: yLabel, y: a[key], color, fill: key !== 'Sigma' }] };
}

export function RiemannPanel() {
  const params = route.value.params;
  const texts = fields.map(({ key, value }) => params[key] ?? value);
  const values = texts.map((text) => (text.trim() === '' ? NaN : Number(text)));
  const [answer, setAnswer] = useState<Riemann | null>(null);
  const [error, setError] = useState<Complaint | undefined>();
  useEffect(() => {
    const bad = values.findIndex((v) => !Number.isFinite(v));
    if (bad >= 0) return setError({ kind: 'input', message: '', key: fields[bad].key, problem: 'not a number', allowed: 'a number such as 0.855' });
    let alive = true;
    const [leftStress, leftVelocity, rightStress, rightVelocity] = values;
    call('riemann', leftStress, leftVelocity, rightStress, rightVelocity, 600).then((a) => {
      if (!alive) return;
      setError(a.error);
      if (!a.error) setAnswer(a);
    });
    return () => void (alive = false);
  }, [texts.join()]);
  const width = answer ? Math.max(Math.abs(answer.left_edge), Math.abs(answer.right_edge), 1e-12) * 1.25 : 1;
  return (
    <div class="panel">
      <Controls label="States">
        <h2>Two states</h2>
        {fields.map(({ key, label, least, most }, i) => (
          <NumberField key={key} label={label} value={texts[i]} least={least} most={most} onInput={(text) => setParams({ [key]: text })} error={sentence(about(error, key))} />
        ))}
        {error && !fields.some(({ key }) => key === error.key) && <p class="error" role="alert">{sentence(error)}</p>}
        <p class="buttons">
          <button type="button" onClick={() => setParams({ left_stress: '0.855', left_velocity: '0', right_stress: '0', right_velocity: '0' })}>Slip pulse</button>
          <button type="button" onClick={() => setParams({ left_stress: '0.6', left_velocity: '0.4', right_stress: '0.6', right_velocity: '-0.4' })}>Collision</button>
          <button type="button" onClick={() => setParams({ left_stress: '0.6', left_velocity: '-0.5', right_stress: '0.6', right_velocity: '0.5' })}>Parting</button>
        </p>
      </Controls>
      {answer && (
        <section class={`pictures results ${error ? 'stale' : ''}`} aria-label="Waves">
          <dl class="facts">
            <div><dt>Left wave</dt><dd>{waveInWords[answer.left_wave.kind]}</dd></div>
            <div><dt>Right wave</dt><dd>{waveInWords[answer.right_wave.kind]}</dd></div>
            <div><dt>Between the waves</dt><dd>{countInWords[answer.trains_between]}</dd></div>
            <div><dt>Stress between</dt><dd>{short(answer.Sigma_between, 6)} μA/π</dd></div>
            <div><dt>Slip velocity between</dt><dd>{short(free(answer.W_between, answer.Sigma_between), 6)} cA/π</dd></div>
            <div><dt>Edges</dt><dd>{short(answer.left_edge)} and {short(answer.right_edge)} c</dd></div>
          </dl>
          <div class="two">
            <Plot spec={{ name: 'waves', title: 'Waves over x and t', x: [], xLabel: 'x', yLabel: 't', series: [], paths: rays(answer), xRange: [-width, width], yRange: [0, 1] }} height={290} />
            <Plot spec={{ name: 'rapidities', title: 'Which rapidities are filled', x: [], xLabel: 'x/t, in c', yLabel: 'rapidity r', series: [], paths: bands(answer) }} height={290} />
            <Plot spec={profileSpec(answer, 'Sigma', 'Stress', 'Σ, in μA/π', 'stress')} height={190} />
            <Plot spec={profileSpec(answer, 'W', 'Slip velocity', 'W, in cA/π', 'slip')} height={190} />
          </div>
          <Equations names={['edges', 'bands']}><p>Each dislocation has a rapidity r, and alone it moves at tanh r. A train fills a band of rapidities, whose edges move at the speeds of the modulation. Where dislocations overtake others the filled region folds: two bands lie above each other, and there are two trains at one position. No wave is a shock.</p></Equations>
        </section>
      )}
    </div>
  );
}
