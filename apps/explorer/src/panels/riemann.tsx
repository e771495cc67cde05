/** Panel "Riemann": two states, and the waves between them. */

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

const inWords: Record<string, string> = { fan: 'a fan: the train spreads', shock: 'a shock: the train is run into', none: 'no wave' };

/** Rays of constant state in x-t; t goes to 1. */
function rays(a: Riemann): Path[] {
  const all: Path[] = [];
  const ray = (speed: number, color: string, width: number, dash?: number[], label?: string) => all.push({ x: [0, speed], y: [0, 1], color, width, dash, label });
  for (const [side, color] of [['left', 'fast'], ['right', 'slow']] as const) {
    const wave = a[`${side}_wave`];
    if (wave.kind === 'fan') {
      const count = 12;
      for (let i = 0; i <= count; ++i) ray(wave.outer + ((wave.inner - wave.outer) * i) / count, color, i === 0 || i === count ? 2.2 : 0.9, undefined, i === 0 ? `${side} fan` : undefined);
    } else if (wave.kind === 'shock') ray(wave.outer, color, 3.2, undefined, `${side} shock`);
  }
  return all;
}

function planeSpec(a: Riemann): Spec {
  const states = [
    { state: a.left, label: 'left', color: 'fast' },
    { state: a.star, label: 'between', color: 'chosen' },
    { state: a.right, label: 'right', color: 'slow' },
  ];
  const paths: Path[] = [];
  for (const [side, color] of [['left', 'fast'], ['right', 'slow']] as const) {
    const wave = a[`${side}_wave`];
    if (wave.kind === 'fan') paths.push({ label: `${side} fan`, x: a[`${side}_path`].phi, y: a[`${side}_path`].psi, color });
    if (wave.kind === 'shock') paths.push({ label: `${side} shock`, x: [a[side].phi, a.star.phi], y: [a[side].psi, a.star.psi], color, dash: [6, 4] });
  }
  const filled = states.filter(({ state }) => state.psi > 0);
  const most = Math.max(...filled.map(({ state }) => state.psi));
  const phis = [...filled.map(({ state }) => state.phi), ...paths.flatMap((path) => Array.from(path.x))];
  const [low, high] = [Math.min(...phis), Math.max(...phis)];
  const room = Math.max(0.1 * (high - low), 0.02);
  return {
    name: 'states', title: 'The same in the plane of states', x: [], xLabel: 'φ, rapidity of the dislocations', yLabel: 'ψ, how densely they lie', series: [], paths,
    points: filled.map(({ state, label, color }) => ({ x: state.phi, y: state.psi, label, color, chosen: true })),
    xRange: [low - room, high + room], yRange: [0, most * 1.15],
  };
}

function profileSpec(a: Riemann, key: 'Sigma' | 'W', title: string, yLabel: string, color: string): Spec {
  return { name: key, title, x: a.x_over_t, xLabel: 'x/t, in c', yLabel, series: [{ label: yLabel, y: a[key], color, fill: key === 'W' }] };
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
            <div><dt>Left wave</dt><dd>{inWords[answer.left_wave.kind]}</dd></div>
            <div><dt>Right wave</dt><dd>{inWords[answer.right_wave.kind]}</dd></div>
            <div><dt>Stress between</dt><dd>{short(answer.star.Sigma, 6)} μA/π</dd></div>
            <div><dt>Slip velocity between</dt><dd>{short(answer.star.W, 6)} cA/π</dd></div>
            <div><dt>Edges</dt><dd>{short(answer.left_edge)} and {short(answer.right_edge)} c</dd></div>
          </dl>
          <div class="two">
            <Plot spec={{ name: 'waves', title: 'Waves over x and t', x: [], xLabel: 'x', yLabel: 't', series: [], paths: rays(answer), xRange: [-width, width], yRange: [0, 1] }} height={290} />
            <Plot spec={planeSpec(answer)} height={290} />
            <Plot spec={profileSpec(answer, 'Sigma', 'Stress', 'Σ, in μA/π', 'stress')} height={190} />
            <Plot spec={profileSpec(answer, 'W', 'Slip velocity', 'W, in cA/π', 'slip')} height={190} />
          </div>
          <Equations names={['invariants', 'jump']}><p>Along a fan one of φ ± ψ stays the same, so its path in the plane is a straight line at 45°. A shock jumps.</p></Equations>
        </section>
      )}
    </div>
  );
}
