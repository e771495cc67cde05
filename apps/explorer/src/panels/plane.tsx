/** Panel "Fault plane": a rupture on a plane, live, by the averages or dislocation line by line. */

import { useEffect, useMemo } from 'preact/hooks';
import barrierToml from '@cases/plane-barrier.toml';
import arrestToml from '@cases/plane-arrest.toml';
import frictionToml from '@cases/plane-friction.toml';
import rings from '@cases/plane-rings.csv';
import { seriesAt, type PlaneRun, type Snapshot } from '../model/plane';
import { route, setParams } from '../state/route';
import { commandOf } from '../state/scenario';
import { scaleOf } from '../state/units';
import { color } from '../ui/colors';
import { Controls } from '../ui/controls';
import { Equations } from '../ui/equations';
import { about, CannotRun, NumberField, Segments, sentence, TextField } from '../ui/fields';
import { Film, filmHeight, filmWidth } from '../ui/film';
import { short } from '../ui/format';
import { imageOfField, SpaceTime, type Field } from '../ui/picture/map';
import { mapSvgOf } from '../ui/picture/map_svg';
import { Plot } from '../ui/picture/plot';
import type { Spec } from '../ui/picture/spec';
import { svgOf } from '../ui/picture/svg';
import { makePlayer, reducedMotion, Transport } from '../ui/player';
import { copy } from '../ui/save';
import { usePlane } from './use_plane';

interface Control {
  key: string;
  label: string;
  value: string;
  /** The usual range of a number; a formula has none. */
  range?: [number, number];
}
interface Setup {
  name: string;
  file: string;
  toml: string;
  text: string;
  controls: Control[];
  /** The scale at which lines are followed, as text. */
  scale: string;
  /** Whether its averages are those on a grid. */
  onGrid?: boolean;
}

const setups: Record<string, Setup> = {
  friction: {
    name: 'Friction on one side', file: 'cases/plane-friction.toml', toml: frictionToml, scale: '20',
    text: 'Lines at rest around a held disc are released. Where y < 0 friction is weak, and the rupture runs ahead there.',
    controls: [
      { key: 'friction.coefficient', label: 'Friction C, by x and y', value: '1 + tanh(y / 0.1)' },
      { key: 'time.end', label: 'Until, in b/(cA)', value: '1.5', range: [0.2, 3] },
    ],
  },
  arrest: {
    name: 'A rupture that stops', file: 'cases/plane-arrest.toml', toml: arrestToml, scale: '20',
    text: 'A bent line has a tension, which pulls it back. So a round rupture stops by itself, as soon as its stress is used up.',
    controls: [
      { key: 'friction.coefficient', label: 'Friction C', value: '1', range: [0.3, 5] },
      { key: 'time.end', label: 'Until, in b/(cA)', value: '6', range: [1, 10] },
    ],
  },
  barrier: {
    name: 'A barrier', file: 'cases/plane-barrier.toml', toml: barrierToml, scale: '15', onGrid: true,
    text: 'A force drives lines against a small region that is held. They walk around it, and each leaves a loop on it.',
    controls: [
      { key: 'forcing.formula', label: 'Force F', value: '3', range: [0.5, 6] },
      { key: 'friction.coefficient', label: 'Friction C', value: '2', range: [0.5, 5] },
      { key: 'time.end', label: 'Until, in b/(cA)', value: '3.5', range: [0.5, 6] },
    ],
  },
};

const player = makePlayer(1);
const scaleKey = 'chain.scale';
const cellsOfLoops = ['plane.loops=60', 'plane.angles=64'], cellsOfGrid = ['plane.cells=100'];

/** The settings of the form, in the notation of the program's option `--set`. */
function changesOf({ controls, scale, onGrid }: Setup, direct: boolean): string[] {
  const typed = (key: string, value: string) => route.value.params[key] ?? value;
  const all = controls.flatMap(({ key, value }) => (typed(key, value) === '' ? [] : [`${key}=${typed(key, value)}`]));
  return [...all, ...(direct ? [`${scaleKey}=${typed(scaleKey, scale)}`] : onGrid ? cellsOfGrid : cellsOfLoops)];
}

/** The map of a quantity of one snapshot, with the lines on it. */
function fieldOf(run: PlaneRun, at: Snapshot, quantity: 'velocity' | 'slip', direct: boolean): Field {
  const { left, right, bottom, top } = run.begun;
  const isSlip = quantity === 'slip';
  const most = isSlip ? run.farthest : run.fastest;
  const [x, unit] = [scaleOf('x', right - left), scaleOf(isSlip ? 'slip' : 'slipVelocity', most)];
  const least = at[quantity].some((value) => value < -0.05 * most) ? -most : 0;
  return {
    title: isSlip ? 'Slip' : 'Slip velocity', name: isSlip ? 'plane-slip' : 'plane-velocity', x: run.x, t: run.y, values: at[quantity], tRange: [bottom, top], aspect: (top - bottom) / (right - left),
    reach: [least, most], xLabel: `x, in ${x.unit}`, tLabel: `y, in ${x.unit}`, label: `${isSlip ? 'slip' : 'W'}, in ${unit.unit}`, xFactor: x.factor, tFactor: x.factor, factor: unit.factor,
    lines: [{ x: at.lineX, t: at.lineY, color: 'ink', label: direct ? 'dislocation lines' : 'rupture front', width: direct ? 0.8 : 1.5 }],
  };
}

/** The moment rate and the distance of the front, against time. */
function timeSpecs(run: PlaneRun, now: number): Spec[] {
  const [t, x] = [scaleOf('t', run.begun.end), scaleOf('x', run.begun.right)];
  const common = {
    x: run.time.map((time) => time * t.factor), xLabel: `time, in ${t.unit}`, xRange: [0, run.begun.end * t.factor] as [number, number],
    verticals: [{ x: now * t.factor, label: 'now', color: 'slow' }],
  };
  return [
    { ...common, name: 'moment-rate', title: 'Moment rate', yLabel: 'in μb²c/(2πA)', series: [{ label: 'moment rate', y: run.momentRate, color: 'slip', fill: true }] },
    { ...common, name: 'front', title: 'Farthest front', yLabel: `distance, in ${x.unit}`, series: [{ label: 'front', y: run.front.map((value) => value * x.factor), color: 'fast' }] },
  ];
}

function Facts({ run, at, direct }: { run: PlaneRun; at: Snapshot; direct: boolean }) {
  const [x, slip, W] = [scaleOf('x', run.begun.right), scaleOf('slip', run.farthest), scaleOf('slipVelocity', run.fastest)];
  const parts = at.lineX.filter((value) => Number.isNaN(value)).length;
  return (
    <dl class="facts" aria-label="Numbers of the rupture">
      <div><dt>Farthest front</dt><dd>{short(seriesAt(run, run.front, at.time) * x.factor, 3)} {x.unit}</dd></div>
      <div><dt>Moment rate</dt><dd>{short(seriesAt(run, run.momentRate, at.time), 3)} μb²c/(2πA)</dd></div>
      <div><dt>Largest slip so far</dt><dd>{short(run.farthest * slip.factor, 3)} {slip.unit}</dd></div>
      <div><dt>Fastest slip so far</dt><dd>{short(run.fastest * W.factor, 3)} {W.unit}</dd></div>
      {direct && <div><dt>Lines</dt><dd>{parts}</dd></div>}
    </dl>
  );
}

export function PlanePanel() {
  const params = route.value.params;
  const name = Object.hasOwn(setups, params.setup ?? '') ? params.setup : 'friction';
  const setup = setups[name];
  const direct = params.lines === '1';
  const changes = changesOf(setup, direct);
  const { run, error, busy } = usePlane(setup.toml, changes.join('\n'), rings, direct);
  useEffect(() => {
    player.speed.value = 0.2;
    player.at.value = Number.isFinite(Number(params.t ?? NaN)) ? Math.min(1, Math.max(0, Number(params.t))) : 1;
    return () => { player.playing.value = false; };
  }, [name]);
  useEffect(() => {
    if (params.play === '1' && !busy && !reducedMotion()) { player.at.value = 0; player.playing.value = true; }
  }, [params.play, busy]);
  const shown = run && run.snapshots.length > 0 ? run.snapshots[Math.round(player.at.value * (run.snapshots.length - 1))] : null;
  const si = scaleOf('x', 1).factor;
  const fields = useMemo(() => run && shown && (['velocity', 'slip'] as const).map((quantity) => fieldOf(run, shown, quantity, direct)), [shown, run?.fastest, si]);
  const specs = useMemo(() => run && shown && timeSpecs(run, shown.time), [shown, run?.time.length, si]);
  const t = scaleOf('t', run?.begun.end ?? 1);
  const command = commandOf('plane', setup.file, [...(direct ? ['--direct'] : []), '--set', ...changes]);
  const film = async (share: number) => {
    const at = run!.snapshots[Math.round(share * (run!.snapshots.length - 1))];
    const field = fieldOf(run!, at, 'velocity', direct);
    const { scale, image } = await imageOfField(field);
    const half = filmWidth / 2;
    const placed = (svg: string, x: number, y: number) => svg.replace('<svg ', `<svg x="${x}" y="${y}" `);
    const map = mapSvgOf({ ...field, title: `Slip velocity, t = ${short(at.time * t.factor, 3)} ${t.unit}` }, scale, image, '', half, filmHeight);
    const curves = timeSpecs(run!, at.time).map((spec, i) => placed(svgOf(spec, color, '', half, filmHeight / 2), half, (i * filmHeight) / 2));
    return [`<svg xmlns="http://www.w3.org/2000/svg" width="${filmWidth}" height="${filmHeight}">${placed(map, 0, 0)}${curves.join('')}</svg>`];
  };
  return (
    <div class="panel">
      <Controls label="Scenario">
        <Segments label="Set-up" value={name} choices={Object.entries(setups).map(([value, one]) => ({ value, label: one.name }))}
          onInput={(text) => setParams(Object.fromEntries([['setup', text], ['t', null], [scaleKey, null], ...Object.values(setups).flatMap((one) => one.controls).map(({ key }) => [key, null])]))} />
        <p class="hint">{setup.text}</p>
        <Segments label="Follow" value={direct ? '1' : '0'} choices={[{ value: '0', label: 'the averages' }, { value: '1', label: 'every line' }]} onInput={(text) => setParams({ lines: text === '1' ? '1' : null })} />
        {direct && <NumberField label="Scale: more lines" value={params[scaleKey] ?? setup.scale} least={5} most={50} log onInput={(text) => setParams({ [scaleKey]: text })} error={sentence(about(error, scaleKey))} hint="Twice the scale takes eight times as long." />}
        {setup.controls.map(({ key, label, value, range }) =>
          range
            ? <NumberField key={`${name}${key}`} label={label} value={params[key] ?? value} least={range[0]} most={range[1]} log onInput={(text) => setParams({ [key]: text })} error={sentence(about(error, key))} />
            : <TextField key={`${name}${key}`} label={label} value={params[key] ?? value} onInput={(text) => setParams({ [key]: text })} error={sentence(about(error, key))} />,
        )}
        <details class="exchange">
          <summary>Command of the program</summary>
          <p>The program runs the same, in the repository:</p>
          <p class="command"><code>{command}</code> <button type="button" onClick={() => copy(command, 'command')}>Copy</button></p>
        </details>
      </Controls>
      <section class="pictures" aria-label="Fault plane">
        <Transport player={player} end={1} unit="" factor={1} time={`t = ${short((shown?.time ?? 0) * t.factor, 3)} ${t.unit}`} onSettle={(share) => setParams({ t: share.toFixed(3), play: null })} />
        {busy && <p class="busy" role="status">Computing{run ? `: ${Math.round((100 * run.now) / run.begun.end)} %` : ' …'}</p>}
        <CannotRun error={error} shown={Boolean(run)} />
        {run && shown && fields && specs && (
          <div class={`results ${error && !run.gaveUp ? 'stale' : ''}`}>
            <Facts run={run} at={shown} direct={direct} />
            <div class="two">{fields.map((field) => <SpaceTime key={field.name} field={field} />)}</div>
            {run.time.length > 1 && <div class="two">{specs.map((spec) => <Plot key={spec.name} spec={spec} height={200} />)}</div>}
            {run.finished && !error && <Film name="fault-plane" pictures={film} />}
            {run.warnings.length > 0 && <ul class="warnings" aria-label="Warnings of the run">{run.warnings.map((w) => <li>{w}</li>)}</ul>}
            <Equations names={['plane', 'plane_density', 'plane_average']}><p>U is the mean slip. Its gradient is the density of lines, and κ that density in the frame of the lines.</p></Equations>
          </div>
        )}
      </section>
    </div>
  );
}
