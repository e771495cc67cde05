/** Panel "Dislocations": the chain of the scenario, live, bead by bead. */

import { useEffect, useMemo, useRef } from 'preact/hooks';
import { csvOfPaths, isOver, lastFrame, type Chain } from '../model/chain';
import { route, setParams } from '../state/route';
import { scenarioOf, tableOf, tomlOf } from '../state/scenario';
import { scaleOf } from '../state/units';
import { theme } from '../ui/colors';
import { Controls } from '../ui/controls';
import { Data } from '../ui/picture/data';
import { Equations } from '../ui/equations';
import { Exchange } from '../ui/exchange';
import { CannotRun, NumberField } from '../ui/fields';
import { short } from '../ui/format';
import { Plot } from '../ui/picture/plot';
import { save } from '../ui/save';
import { ScenarioForm } from '../ui/scenario_form';
import { paint, type Paths } from './beads';
import { averageSpec, closeSpec } from './chain_plots';
import { useChain } from './use_chain';

const most = 400;

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
  const now = chain && lastFrame(chain);
  const over = now && isOver(now.time, end);
  const [t, x] = [scaleOf('t', end), scaleOf('x', chain ? chain.begun.right - chain.begun.left : 1)];
  const si = `${scaleOf('stress', 1).factor}|${x.factor}|${x.unit}`;
  const averages = useMemo(() => chain && [
    averageSpec(chain, 'W', 'Slip velocity, averaged over eight dislocations', 'slip', 'slipVelocity', 0.05, x),
    averageSpec(chain, 'Sigma', 'Stress, averaged over eight dislocations', 'stress', 'stress', 1, x),
  ], [chain?.average, si]);
  const close = useMemo(() => chain && closeSpec(chain, x), [chain?.average, si]);
  return (
    <div class="panel">
      <Controls label="Scenario">
        <h2>Chain</h2>
        <NumberField label="Dislocations" value={typed} least={1} most={most} log onInput={(text) => setParams({ beads: /^\d+\.\d+$/.test(text) ? String(Math.max(1, Math.round(Number(text)))) : text })}
          error={bad ? `Allowed: a whole number from 1 to ${most}; the program takes millions.` : ''} hint="Few: see each of them. Many: see the average emerge." />
        <ScenarioForm error={error} averages={false} />
        <Exchange command="chain" />
      </Controls>
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
        {!chain && !error && <p class="busy" role="status">Placing the dislocations …</p>}
        {chain && now && (
          <div class={`results ${error ? 'stale' : ''}`}>
            <dl class="facts">
              <div><dt>Dislocations</dt><dd>{now.x.length}</dd></div>
              <div><dt>Sites of the chain</dt><dd>{chain.begun.sites}</dd></div>
              <div><dt>Scale</dt><dd>{short(chain.begun.scale)}</dd></div>
              <div><dt>First of them is at</dt><dd>{short((now.x[now.x.length - 1] ?? NaN) * x.factor)} {x.unit}</dd></div>
              <div><dt>Pictures a second</dt><dd>{rate ? Math.round(rate) : '–'}</dd></div>
            </dl>
            <figure class="plot">
              <figcaption>Dislocations and their paths <span class="legend"><span><i style={{ background: 'var(--slip)' }} /> moving</span><span><i style={{ background: 'var(--stress)' }} /> at rest</span></span></figcaption>
              <canvas class="beads" style={{ height: '330px' }} ref={canvas} role="img" tabIndex={0} aria-label={`${now.x.length} dislocations at t = ${short(now.time, 3)}. The table below has their positions.`} />
              <Places chain={chain} />
            </figure>
            {averages && <div class="two">{averages.map((spec) => <Plot spec={spec} height={200} />)}</div>}
            {close && <Plot spec={close} height={190} />}
            <Equations names={['chain', 'train', 'averages']}><p>The chain is stretched by the scale, and friction is divided by it: the same problem with more or fewer dislocations.</p></Equations>
          </div>
        )}
      </section>
    </div>
  );
}

function Places({ chain }: { chain: Chain }) {
  const now = lastFrame(chain);
  return (
    <Data
      of="positions of the dislocations"
      buttons={() => <button type="button" onClick={() => save('paths.csv', csvOfPaths(chain), 'text/csv')}>CSV of all paths</button>}
      table={() => (
        <>
          <caption>Positions at t = {short(now.time)}</caption>
          <thead><tr><th scope="col">dislocation</th><th scope="col">x, in b/A</th></tr></thead>
          <tbody>{Array.from(now.x, (x, i) => <tr><th scope="row">{i + 1}</th><td>{short(x, 6)}</td></tr>)}</tbody>
        </>
      )}
    />
  );
}
