/** Panel "Stick-slip": a block on a spring, a block that is pushed at its edge, and an asperity between creeping ends, live. */

import { useEffect, useMemo, useRef } from 'preact/hooks';
import asperityToml from '@cases/asperity.toml';
import edgeToml from '@cases/precursors.toml';
import blockToml from '@cases/laboratory-block.toml';
import { csvOfEvents, crosses, median, type LoadedRun } from '../model/loading';
import { route, setParams } from '../state/route';
import { commandOf } from '../state/scenario';
import { color, theme } from '../ui/colors';
import { Controls } from '../ui/controls';
import { Equations } from '../ui/equations';
import { about, CannotRun, NumberField, Segments, sentence } from '../ui/fields';
import { Film, filmHeight, filmWidth } from '../ui/film';
import { inUnits, short } from '../ui/format';
import { Data } from '../ui/picture/data';
import { SpaceTime } from '../ui/picture/map';
import { Plot } from '../ui/picture/plot';
import { svgOf } from '../ui/picture/svg';
import { makePlayer, reducedMotion, Transport } from '../ui/player';
import { copy, save } from '../ui/save';
import { paintBlocks } from './blocks';
import { frontSpec, slipSpec, timeSpecs, velocityMap } from './loading_plots';
import { useLoading } from './use_loading';

interface Control {
  /** A key of the scenario; without a dot, a number of `further`. */
  key: string;
  label: string;
  /** As the program reads it; the field shows its letters. */
  unit: string;
  value: string;
  least: number;
  most: number;
}
interface Setup {
  name: string;
  file: string;
  toml: string;
  text: string;
  controls: Control[];
  /** Settings that follow from the controls without a dot in their key. */
  further?: (valueOf: (key: string) => string) => string[];
}

const friction = (b: string, slip: string): Control[] => [
  { key: 'friction.normal_stress', label: 'Normal stress', unit: 'MPa', value: '5', least: 0.5, most: 20 },
  { key: 'friction.direct_effect', label: 'Direct effect a', unit: '', value: '0.005', least: 0.001, most: 0.03 },
  { key: 'friction.evolution_effect', label: 'Evolution effect b', unit: '', value: b, least: 0.001, most: 0.03 },
  { key: 'friction.characteristic_slip', label: 'Characteristic slip D_c', unit: 'um', value: slip, least: 0.05, most: 10 },
];

const setups: Record<string, Setup> = {
  block: {
    name: 'Block on a spring', file: 'cases/laboratory-block.toml', toml: blockToml,
    text: 'A block of PMMA, 20 cm long, is pulled through a spring. It sticks while the spring stretches, until all of it slips at once.',
    controls: [
      ...friction('0.009', '0.5'),
      { key: 'loading.stiffness', label: 'Stiffness of the spring', unit: 'MPa/um', value: '0.02', least: 0.002, most: 0.2 },
      { key: 'loading.velocity', label: 'Velocity of its end', unit: 'um/s', value: '1', least: 0.01, most: 100 },
      { key: 'time.end', label: 'Until', unit: 's', value: '300', least: 10, most: 3000 },
    ],
  },
  edge: {
    name: 'Pushed at its edge', file: 'cases/precursors.toml', toml: edgeToml,
    text: 'A chain of 101 blocks, 15 cm long, is pushed at its left edge. Slip begins there and stops inside, again and again, until a front crosses the whole chain.',
    controls: [
      ...friction('0.015', '0.1'),
      { key: 'loading.stiffness', label: 'Stiffness of the spring', unit: 'MPa/um', value: '0.2', least: 0.02, most: 2 },
      { key: 'loading.velocity', label: 'Velocity of its end', unit: 'um/s', value: '100', least: 10, most: 1000 },
      { key: 'time.end', label: 'Until', unit: 's', value: '6', least: 0.5, most: 12 },
    ],
  },
  asperity: {
    name: 'Asperity on a fault', file: 'cases/asperity.toml', toml: asperityToml,
    text: 'A fault of 60 km. In the middle third friction weakens with velocity, and earthquakes repeat there; outside it strengthens, and the fault creeps.',
    controls: [
      { key: 'inside', label: 'b − a in the asperity', unit: '', value: '0.005', least: 0.001, most: 0.014 },
      { key: 'outside', label: 'a − b outside', unit: '', value: '0.005', least: 0.0005, most: 0.05 },
      { key: 'friction.normal_stress', label: 'Normal stress', unit: 'MPa', value: '50', least: 10, most: 200 },
      { key: 'friction.characteristic_slip', label: 'Characteristic slip D_c', unit: 'mm', value: '20', least: 8, most: 100 },
      { key: 'loading.stiffness', label: 'Stiffness of the springs', unit: 'MPa/m', value: '1.5', least: 0.2, most: 10 },
      { key: 'time.end', label: 'Until', unit: 'years', value: '475', least: 50, most: 1000 },
    ],
    further: (valueOf) => [
      'chain.spacing=500 m',
      `friction.direct_effect=0.015 + ${valueOf('outside')} - (${valueOf('inside')} + ${valueOf('outside')})*(tanh((x + 10e3)/1e3) - tanh((x - 10e3)/1e3))/2`,
    ],
  },
};

const player = makePlayer(1);

/** The settings of the form, in the notation of the program's option `--set`. */
const changesOf = ({ controls, further }: Setup) => {
  const valueOf = (key: string) => route.value.params[key] || controls.find((control) => control.key === key)!.value;
  return controls.filter(({ key }) => key.includes('.')).flatMap(({ key, unit, value }) => {
    const typed = route.value.params[key] ?? value;
    return typed === '' ? [] : [`${key}=${typed}${unit ? ` ${unit}` : ''}`];
  }).concat(further?.(valueOf) ?? []);
};

function Facts({ run }: { run: LoadedRun }) {
  const whole = run.events.filter((event) => event.complete);
  const between = run.events.slice(1).map((event, i) => event.onset - run.events[i].onset);
  const inside = run.events.filter((event) => !crosses(event, run)).length;
  const speeds = whole.flatMap((event) => (event.rupture_velocity ? [event.rupture_velocity] : []));
  return (
    <dl class="facts" aria-label="Numbers of the events">
      <div><dt>Slip events</dt><dd>{run.events.length}{inside ? `, ${inside === run.events.length ? 'all' : inside} of which stop inside` : ''}</dd></div>
      <div><dt>Time between them</dt><dd>{inUnits('time', median(between))}</dd></div>
      <div><dt>Stress drop</dt><dd>{inUnits('stress', median(whole.map((event) => event.stress_drop)))}</dd></div>
      <div><dt>Largest slip</dt><dd>{inUnits('length', median(whole.map((event) => event.largest_slip)))}</dd></div>
      <div><dt>Peak slip velocity</dt><dd>{inUnits('velocity', median(whole.map((event) => event.peak_velocity)))}</dd></div>
      {speeds.length > 0 && <div><dt>Rupture velocity</dt><dd>{inUnits('velocity', median(speeds))}</dd></div>}
      {run.begun.stiffness_ratio !== null && <div><dt>Stiffness over the critical one</dt><dd>{short(run.begun.stiffness_ratio, 3)}</dd></div>}
    </dl>
  );
}

function Events({ run }: { run: LoadedRun }) {
  return (
    <Data
      of="slip events"
      buttons={() => <button type="button" onClick={() => save('events.csv', csvOfEvents(run), 'text/csv')}>CSV of all events</button>}
      table={() => (
        <>
          <caption>Slip events</caption>
          <thead><tr>{['onset', 'stress drop', 'largest slip', 'length', 'peak velocity', 'rupture velocity'].map((name) => <th scope="col">{name}</th>)}</tr></thead>
          <tbody>
            {run.events.slice(0, 200).map((e) => (
              <tr><th scope="row">{short(e.onset, 6)} s</th><td>{inUnits('stress', e.stress_drop)}</td><td>{inUnits('length', e.largest_slip)}</td><td>{inUnits('length', e.length)}</td><td>{inUnits('velocity', e.peak_velocity)}</td><td>{inUnits('velocity', e.rupture_velocity)}</td></tr>
            ))}
          </tbody>
        </>
      )}
    />
  );
}

function Blocks({ run, at }: { run: LoadedRun; at: number }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => paintBlocks(canvas.current!, run, at), [run, at, theme.value]);
  useEffect(() => {
    const watch = new ResizeObserver(() => canvas.current && paintBlocks(canvas.current, run, at));
    watch.observe(canvas.current!);
    return () => watch.disconnect();
  }, [run, at]);
  const fastest = inUnits('velocity', run.speed[at]);
  return (
    <figure class="plot">
      <figcaption>The block and its spring <span class="legend"><span>the stronger the colour, the faster: now {fastest}</span></span></figcaption>
      <canvas class="blocks" ref={canvas} role="img" aria-label={`The block and its spring at ${short(run.time[at], 6)} s; the fastest part slips at ${fastest}.`} />
      <Events run={run} />
    </figure>
  );
}

export function LoadingPanel() {
  const params = route.value.params;
  const name = Object.hasOwn(setups, params.setup ?? '') ? params.setup : 'block';
  const setup = setups[name];
  const changes = changesOf(setup);
  const { run, error, busy } = useLoading(setup.toml, changes.join('\n'));
  useEffect(() => {
    player.speed.value = 0.05;
    player.at.value = Number.isFinite(Number(params.t ?? NaN)) ? Math.min(1, Math.max(0, Number(params.t))) : 1;
    return () => { player.playing.value = false; };
  }, [name]);
  useEffect(() => {
    if (params.play === '1' && !busy && !reducedMotion()) { player.at.value = 0; player.playing.value = true; }
  }, [params.play, busy]);
  const at = run ? Math.round(player.at.value * (run.time.length - 1)) : 0;
  const specs = useMemo(() => run && timeSpecs(run, run.time[at]), [run, at]);
  const isFault = name === 'asperity';
  const fronts = useMemo(() => run && run.events.length > 0 && [...(run.arrivals.length > 0 ? [frontSpec(run)] : []), ...(run.begun.x.length > 50 ? [slipSpec(run)] : [])], [run?.begun, run?.events.length, run?.finished]);
  const map = useMemo(() => run && isFault && run.time.length > 1 && velocityMap(run), [run?.time.length, isFault]);
  const command = commandOf('chain', setup.file, changes.length ? ['--set', ...changes] : []);
  const film = (share: number) => {
    const i = Math.round(share * (run!.time.length - 1));
    return timeSpecs(run!, run!.time[i]).map((spec) => svgOf({ ...spec, title: `${spec.title}, t = ${inUnits('time', run!.time[i], 5)}` }, color, '', filmWidth, filmHeight / 2));
  };
  return (
    <div class="panel">
      <Controls label="Scenario">
        <Segments label="Set-up" value={name} choices={Object.entries(setups).map(([value, one]) => ({ value, label: one.name }))}
          onInput={(text) => setParams(Object.fromEntries([['setup', text], ['t', null], ...Object.values(setups).flatMap(({ controls }) => controls).map(({ key }) => [key, null])]))} />
        <p class="hint">{setup.text}</p>
        {setup.controls.map(({ key, label, unit, value, least, most }) => (
          <NumberField key={`${name}${key}`} label={unit ? `${label}, in ${unit.replace('um', 'µm')}` : label} value={params[key] ?? value} least={least} most={most} log onInput={(text) => setParams({ [key]: text })}
            error={sentence(about(error, key))} />
        ))}
        <details class="exchange">
          <summary>Command of the program</summary>
          <p>The program runs the same, in the repository:</p>
          <p class="command"><code>{command}</code> <button type="button" onClick={() => copy(command, 'command')}>Copy</button></p>
        </details>
      </Controls>
      <section class="pictures" aria-label="Stick-slip">
        <Transport player={player} end={1} unit="" factor={1} time={run?.time.length ? `t = ${inUnits('time', run.time[at], 4)}` : 't = 0'} onSettle={(share) => setParams({ t: share.toFixed(3), play: null })} />
        {busy && <p class="busy" role="status">Computing{run ? `: ${Math.round((100 * run.now) / run.begun.end)} %` : ' …'}</p>}
        <CannotRun error={error} shown={Boolean(run)} />
        {run && specs && run.time.length > 1 && (
          <div class={`results ${error ? 'stale' : ''}`}>
            <Facts run={run} />
            <Plot spec={specs[0]} height={220} />
            {map ? <SpaceTime field={map} height={300} onPick={(t) => { player.at.value = run.time.findIndex((time) => time >= t) / (run.time.length - 1); }} /> : <Blocks run={run} at={at} />}
            {map && <figure class="plot"><figcaption>Slip events</figcaption><Events run={run} /></figure>}
            {run.finished && run.events.length === 0 && <p class="warnings">No slip event: {run.begun.stiffness_ratio !== null && run.begun.stiffness_ratio > 1 ? 'the spring is stiffer than the critical one, and sliding is steady.' : 'the force has not reached the strength, or sliding is stable.'}</p>}
            <Plot spec={specs[1]} height={180} />
            {fronts && fronts.length > 0 && <div class="two">{fronts.map((spec) => <Plot key={spec.name} spec={spec} height={240} />)}</div>}
            <p class="hint">Play steps from result to result: they are dense during slip, and sparse between events.</p>
            {run.finished && !error && <Film name="stick-slip" pictures={film} />}
            {run.begun.warnings.length > 0 && <ul class="warnings" aria-label="Warnings of the run">{run.begun.warnings.map((w) => <li>{w}</li>)}</ul>}
            <Equations names={['springs', 'block', 'critical']}><p>Here κ is the stiffness, and θ the age of the contacts. In a chain, its neighbours act on each block too.</p></Equations>
          </div>
        )}
      </section>
    </div>
  );
}
