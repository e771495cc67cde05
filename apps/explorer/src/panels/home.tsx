/** The first page: what this is, moving. */

import { useEffect, useMemo } from 'preact/hooks';
import { linkTo } from '../state/route';
import { addressOfStop } from './tour_bar';
import { tomlOf } from '../state/scenario';
import { makePlayer, reducedMotion, Transport } from '../ui/player';
import { Plot } from '../ui/picture/plot';
import { rangeAround } from '../ui/picture/spec';
import { fieldAt, seriesAt } from '../model/pulse_run';
import { usePulse } from './use_pulse';

const player = makePlayer(0.7);
const toml = tomlOf({ 'initial.profile': 'step', 'initial.stress_left': '0.855', 'initial.stress_right': '0', 'friction.law': 'viscous', 'friction.coefficient': '0.2', 'pulse.cells': '100' });
const end = 2 * Math.PI;

function Hero() {
  const { run, error } = usePulse(toml, null, 9, () => end, 0, true, 61);
  useEffect(() => {
    if (run && !reducedMotion()) { player.at.value = 0; player.playing.value = true; }
    return () => { player.playing.value = false; };
  }, [run]);
  const at = player.at.value;
  const spec = useMemo(() => {
    if (!run) return null;
    const time = at * end;
    const slip = fieldAt(run, 'W', time);
    return {
      name: 'pulse', title: 'A slip pulse', x: run.x, xLabel: 'along the interface', yLabel: 'slip velocity', yRange: rangeAround([0.051], slip),
      series: [{ label: 'slip velocity', y: slip, color: 'slip', fill: true }],
      verticals: [
        { x: seriesAt(run, 'trailing_front', time), label: 'fast front', color: 'fast' },
        { x: seriesAt(run, 'leading_front', time), label: 'slow front', color: 'slow' },
      ],
    };
  }, [run, at]);
  if (error) return <p class="error" role="alert">{error.message}</p>;
  return <div class="hero-plot">{spec ? <Plot spec={spec} height={250} /> : <p class="busy">Computing …</p>}<Transport player={player} end={end} unit="b/(cA)" factor={1} /></div>;
}

const doors = [
  { panel: 'pulse', name: 'Pulse', text: 'Draw a stress, choose a friction, and watch it slip.' },
  { panel: 'dislocations', name: 'Dislocations', text: 'The same event, bead by bead, with nothing averaged.' },
  { panel: 'loading', name: 'Stick-slip', text: 'A spring pulls a block in the laboratory. It sticks, and slips.' },
  { panel: 'plane', name: 'Fault plane', text: 'A rupture in two dimensions, with every dislocation line.' },
  { panel: 'stress', name: 'Stress and velocity', text: 'Observed earthquakes and slow slip events, and yours.' },
  { panel: 'riemann', name: 'Riemann', text: 'Two states meet: the wave patterns behind it all.' },
  { panel: 'paper', name: 'The paper', text: 'Its figures, live, with the sliders they never had.' },
];

export function HomePanel() {
  return (
    <div class="home">
      <div class="hero">
        <div>
          <h1>How does an interface start to slip?</h1>
          <p class="lead">Two rough surfaces, pressed together, hold shear stress. Then a pulse of slip runs along them and lets it go.</p>
          <p>Earthquakes do it at kilometres a second, slow slip at kilometres a day. One theory covers both: slip is carried by dislocations, and the stress that was stored sets their speed. Everything on this page is computed here, in your browser, by the same code as the program.</p>
          <p class="doors-first"><a class="primary" href={addressOfStop(0)}>Take the tour</a> <span class="hint">ten steps, three minutes</span></p>
        </div>
        <Hero />
      </div>
      <ul class="doors">
        {doors.map((door) => (
          <li class="card"><a href={linkTo(door.panel)}>{door.name}</a><p>{door.text}</p></li>
        ))}
      </ul>
    </div>
  );
}
