/** Panel "Stress and velocity": the closed form over 300 decades, with observed events. */

import { useEffect, useMemo, useState } from 'preact/hooks';
import catalogue from '@events';
import { call } from '../engine/client';
import type { Complaint, EventKey, Relations, RelationsCurve, RelationsKey, Reply } from '../engine/protocol';
import { isLocated, published, typed as typedEvent, type FaultEvent } from '../model/events';
import { entryOf, route, setParams } from '../state/route';
import { Controls } from '../ui/controls';
import { Equations } from '../ui/equations';
import { NumberField, Segments, SelectField, sentence, TextField } from '../ui/fields';
import { inUnits, short } from '../ui/format';
import { Plot } from '../ui/picture/plot';
import { copy } from '../ui/save';
import type { Point, Spec } from '../ui/picture/spec';
import { rock, wantsUnits } from '../state/units';
import { useAnswer } from './use_answer';

const events = catalogue.events.filter((event) => !event.error).map(published).filter(isLocated);

const ranges: Record<string, { label: string; from: number; to: number; log: boolean }> = {
  all: { label: 'All 300 decades', from: 1e-300, to: 0.999, log: true },
  observed: { label: 'What is observed', from: 1e-9, to: 0.98, log: true },
  fast: { label: 'Earthquakes', from: 0.05, to: 0.98, log: false },
};
const givens = [
  { key: 'stress', label: 'Stress Σ−, in μA/π', least: 0.005, most: 3, log: false },
  { key: 'rupture_velocity', label: 'Rupture velocity |V−|, in c', least: 1e-12, most: 0.99, log: true },
  { key: 'slip_velocity', label: 'Slip velocity W(0), in cA/π', least: 1e-14, most: 1, log: true },
];
const names: [RelationsKey, string, string][] = [
  ['stress', 'Stress before, Σ−', 'μA/π'],
  ['rupture_velocity', 'Fast front, |V−|', 'c'],
  ['leading_velocity', 'Slow front, V+', 'c'],
  ['velocity_ratio', '|V− / V+|', ''],
  ['slip_velocity', 'Slip velocity at x = 0, W', 'cA/π'],
  ['stress_at_origin', 'Stress at x = 0', 'μA/π'],
  ['dislocation_velocity_at_origin', 'Velocity of dislocations there', 'c'],
];

const isSlow = (rupture_velocity: number) => rupture_velocity < 0.01;

const interval = (event: FaultEvent, key: EventKey, show: (value: number) => string) => {
  const known = event.intervals[key];
  return known ? ` (${show(known[0])} to ${show(known[1])})` : '';
};

/** `typed`: the texts of the observed quantities that the user typed. */
function EventCard({ event, typed }: { event: FaultEvent; typed?: Record<string, string> }) {
  const of = event.numbers;
  const or = (value: number | null, none: string, known: (value: number) => string) => (value === null ? none : known(value));
  const pa = (value: number) => inUnits('stress', value);
  const velocity = (value: number) => inUnits('velocity', value);
  const rows: [string, string][] = [
    ['Rupture velocity, observed', typed ? typed['my.rupture_velocity'] || 'not known' : or(of.rupture_velocity_m_s, '–', velocity)],
    ['Rupture velocity, inferred', or(of.rupture_velocity, '–', (v) => `${short(v)} c${of.c_m_s === null ? '' : ` = ${velocity(v * of.c_m_s)}`}${interval(event, 'rupture_velocity', short)}`)],
    ['Stress before, Σ−', or(of.stress, '–', (v) => `${of.stress_bound !== null ? 'at least ' : ''}${short(v)} μA/π${interval(event, 'stress', short)}`)],
    ['Slip velocity, observed', (typed && typed['my.slip_velocity']) || or(of.slip_velocity_m_s, 'not known', velocity)],
    ['Slip velocity without friction', `${or(of.frictionless_slip_velocity, '–', short)} cA/π`],
    ['Stress in SI', of.stress_pa !== null
      ? pa(of.stress_pa) + interval(event, 'stress_pa', pa)
      : or(of.stress_pa_bound, 'cannot be known: no slip velocity and no contact ratio', (v) => `at least ${pa(v)}${interval(event, 'stress_pa_bound', pa)}, if friction took nothing`)],
    ['Contact ratio A', or(of.contact_ratio, 'cannot be known', (v) => `${of.contact_ratio_bound !== null ? 'at least ' : ''}${short(v)}${interval(event, 'contact_ratio', short)}`)],
    ['Damping number Γ', or(of.damping_number, 'cannot be known from velocities alone', (v) => `${short(v)}${interval(event, 'damping_number', short)}`)],
  ];
  return (
    <section class="card event" aria-label="Chosen event" aria-live="polite">
      <h2>{event.name || 'Your event'}</h2>
      <table><tbody>{rows.map(([name, value]) => <tr><th scope="row">{name}</th><td>{value}</td></tr>)}</tbody></table>
      {Object.keys(event.intervals).length > 0 && <p class="hint">Inferred values are medians of the posterior, with 5 % and 95 % in brackets. They need not equal the observed values.</p>}
      {event.citation && <p class="hint">{event.citation}{event.note ? `. ${event.note}` : ''}</p>}
      {event.warnings.length > 0 && <ul>{event.warnings.map((w) => <li>{w}</li>)}</ul>}
    </section>
  );
}

/** Keys of the address, which end with a key of the table of an event. The constants of the rock are those of the units. */
const typedKeys = [
  { key: 'my.rupture_velocity', label: 'Rupture velocity', value: '3.0 +- 0.2 km/s' },
  { key: 'my.slip_velocity', label: 'Slip velocity', value: '0.5 */ 1.3 m/s' },
  { key: 'my.slip', label: 'Slip', value: '0.3 m' },
  { key: 'my.rise_time', label: 'Rise time', value: '0.6 s' },
  { key: 'my.stress_drop', label: 'Stress drop', value: '30 MPa' },
];
const mediumKeys = [{ key: 'my.contact_ratio', label: 'Contact ratio A', value: '0.003' }, ...rock];
const nameOf = (key: string) => key.split('.')[1];

function tomlOfTyped(params: Record<string, string>): string {
  const lines = (keys: { key: string }[]) => keys.flatMap(({ key }) => (params[key] ? [`${nameOf(key)} = ${JSON.stringify(params[key])}\n`] : [])).join('');
  const medium = lines(mediumKeys);
  return lines(typedKeys) && `[event]\nname = "Your event"\n${lines(typedKeys)}${medium && `[medium]\n${medium}`}`;
}

function useTyped(): { event: FaultEvent | null; error?: Complaint; toml: string } {
  const params = route.value.params;
  const toml = tomlOfTyped(params);
  const [state, setState] = useState<{ event: FaultEvent | null; error?: Complaint }>({ event: null });
  useEffect(() => {
    if (!toml) return setState({ event: null });
    let alive = true;
    const timer = setTimeout(() => {
      call('event', toml, 400).then((answer) => alive && setState(answer.error ? { event: null, error: answer.error } : { event: typedEvent(answer) }));
    }, 150);
    return () => {
      alive = false;
      clearTimeout(timer);
    };
  }, [toml]);
  return { ...state, toml };
}

function TypedForm({ error, toml }: { error?: Complaint; toml: string }) {
  const params = route.value.params;
  const of = (key: string) => error && (error.key ?? '').split('.').pop() === nameOf(key);
  const field = ({ key, label, value }: (typeof typedKeys)[number]) => (
    <TextField key={key} label={label} value={params[key] ?? ''} placeholder={value} error={of(key) ? sentence(error) : ''} onInput={(text) => setParams({ [key]: text || null, event: null })} />
  );
  return (
    <>
      <h2>Your own event</h2>
      <p class="hint">With units and, if known, errors: 3.0 +- 0.2 km/s, 0.5 */ 1.3 m/s, 2..15 km/day.</p>
      {typedKeys.map(field)}
      <details class="more" open={mediumKeys.some(({ key }) => params[key])}>
        <summary>Contact ratio, constants of the rock</summary>
        {mediumKeys.map(field)}
      </details>
      {error && ![...typedKeys, ...mediumKeys].some(({ key }) => of(key)) && <p class="error" role="alert">{sentence(error)}</p>}
      {toml && <p class="buttons"><button type="button" onClick={() => copy(toml, 'event as TOML')}>Copy as TOML</button></p>}
    </>
  );
}

function curveSpec(curve: RelationsCurve, range: (typeof ranges)[string], keys: [RelationsKey, string, string][], title: string, yLabel: string, points: Point[], chosen: Reply<Relations> | null, pointKey: RelationsKey): Spec {
  const spec: Spec = {
    name: title.toLowerCase().replace(/\W+/g, '-'), title, x: curve.stress, xLabel: 'stress before, Σ−, in μA/π', yLabel, yLog: range.log,
    series: keys.map(([key, label, color]) => ({ label, y: curve[key], color })), points,
    xRange: [0, curve.stress[curve.stress.length - 1]],
  };
  if (chosen && !chosen.error) spec.points = [...points, { x: chosen.stress, y: chosen[pointKey], label: 'slider', color: 'chosen', chosen: true }];
  return spec;
}

export function StressPanel() {
  const params = route.value.params;
  const range = entryOf(ranges, params.range) ?? ranges.observed;
  const given = givens.find((one) => one.key === params.given) ?? givens[0];
  const value = params.value ?? (given.key === 'stress' ? '1.03' : given.key === 'rupture_velocity' ? '0.55' : '0.1');
  const number = value.trim() === '' ? NaN : Number(value);
  const curve = useAnswer('relations_curve', 1, range.from, range.to, 500, range.log ? 1 : 0);
  const chosen = useAnswer('relations', givens.indexOf(given), number);
  const typed = useTyped();
  const index = params.event === undefined ? -1 : events.findIndex((event) => event.name === params.event);
  const event = index >= 0 ? events[index] : typed.event;
  const mine = typed.event?.numbers;
  const points = (key: 'rupture_velocity' | 'frictionless_slip_velocity'): Point[] => [
    ...events.flatMap(({ name, numbers }) => {
      const y = numbers[key];
      return y === null ? [] : [{ x: numbers.stress, y, label: name, color: isSlow(numbers.rupture_velocity) ? 'slowslip' : 'earthquake', chosen: name === params.event }];
    }),
    ...(mine && mine.stress !== null && mine[key] !== null ? [{ x: mine.stress, y: mine[key], label: 'Your event', color: 'chosen', chosen: true, xInterval: typed.event?.intervals.stress }] : []),
  ];
  const pick = (i: number) => {
    if (i < events.length) setParams({ event: events[i].name });
  };
  const specs = useMemo(() => curve && !curve.error && [
    curveSpec(curve, range, [['rupture_velocity', 'fast front, |V−|', 'fast'], ['leading_velocity', 'slow front, V+', 'slow']], 'Rupture velocity', 'velocity, in c', points('rupture_velocity'), chosen, 'rupture_velocity'),
    curveSpec(curve, range, [['slip_velocity', 'W(0)', 'slip']], 'Slip velocity without friction', 'W(0), in cA/π', points('frictionless_slip_velocity'), chosen, 'slip_velocity'),
  ], [curve, chosen, params.event, typed.event]);
  const complaint = !Number.isFinite(number) ? 'Not a number. Allowed: a number such as 1.03 or 1e-9.' : sentence(chosen?.error);
  return (
    <div class="panel">
      <Controls label="Question">
        <h2>From any one, all others</h2>
        <SelectField label="Given" value={given.key} choices={givens.map((one) => ({ value: one.key, label: one.label }))} onInput={(key) => setParams({ given: key, value: null })} />
        <NumberField label="Value" value={value} least={given.least} most={given.most} log={given.log} onInput={(text) => setParams({ value: text })} error={complaint} />
        {chosen && !chosen.error && !complaint && (
          <table class="numbers"><tbody>{names.map(([key, name, unit]) => <tr><th scope="row">{name}</th><td>{short(chosen[key], 6)} {unit}</td></tr>)}</tbody></table>
        )}
        <TypedForm error={typed.error} toml={typed.toml} />
      </Controls>
      <section class="pictures" aria-label="Curves and events">
        <Segments label="Range" value={Object.keys(ranges).find((key) => ranges[key] === range)!} choices={Object.entries(ranges).map(([key, one]) => ({ value: key, label: one.label }))} onInput={(key) => setParams({ range: key })} />
        {event && event === typed.event && <EventCard event={event} typed={params} />}
        {specs && (
          <div class="two">
            <Plot spec={specs[0]} height={330} onPick={pick} />
            <Plot spec={specs[1]} height={330} onPick={pick} />
          </div>
        )}
        <p class="legend dots"><span><i style={{ background: 'var(--earthquake)' }} /> earthquakes</span><span><i style={{ background: 'var(--slowslip)' }} /> slow slip</span><span><i style={{ background: 'var(--chosen)' }} /> slider, or your event</span></p>
        <div class="two">
          <div>
            <h2>{events.length} published events</h2>
            <div class="list">
              {events.map((one) => (
                <button type="button" aria-pressed={one.name === params.event} onClick={() => setParams({ event: one.name === params.event ? null : one.name })}>
                  <span>{one.name}</span><span>{inUnits('velocity', one.numbers.rupture_velocity_m_s)}</span>
                </button>
              ))}
            </div>
          </div>
          <div>{index >= 0 ? <EventCard event={events[index]} /> : <p class="hint">Choose an event in the list or in a plot, or type your own.</p>}</div>
        </div>
        {wantsUnits.value && <p class="hint">Stress in Pa and the contact ratio are given with each event; the curves stay dimensionless, because A differs from event to event.</p>}
        <Equations names={['stress', 'fronts', 'origin']} />
      </section>
    </div>
  );
}
