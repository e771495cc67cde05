/** The controls of a scenario: initial stress, friction, contact, time. Shared by all panels that run one. */

import type { Complaint, Parameter } from '../engine/protocol';
import { laws, openingOf } from '../state/laws';
import { route, setParams } from '../state/route';
import { scenarioOf } from '../state/scenario';
import { about, NumberField, Segments, SelectField, sentence, TextField } from './fields';

const profiles = [
  { value: 'step', label: 'Step' },
  { value: 'tanh', label: 'Smooth' },
  { value: 'table', label: 'Drawn' },
  { value: 'formula', label: 'Formula' },
];

const usual: Record<string, [number, number]> = {
  coefficient: [0.001, 10], exponent: [0.2, 4], strength: [0.001, 0.5], weakened: [0.001, 0.5], residual: [0.001, 0.5], velocity: [0.001, 1],
  direct_effect: [0.001, 0.1], evolution_effect: [0.001, 0.1], reference_velocity: [0.001, 1], characteristic_slip: [0.01, 30], initial_state: [0.01, 1000],
};

function usualRange(p: Parameter): [number, number] {
  const known = usual[p.name];
  if (known) return known;
  const middle = Math.abs(p.value) || 0.1;
  return [Math.max(p.least ?? 0, middle / 30, 1e-4), Math.min(p.most ?? Infinity, middle * 30)];
}

function ParameterField({ p, error }: { p: Parameter; error?: Complaint }) {
  const key = `friction.${p.name}`;
  const value = scenarioOf(route.value.params)[key] ?? (p.words.length ? p.words[p.value] : String(p.value));
  const label = `${p.name.replace(/_/g, ' ')}${p.symbol ? ` ${p.symbol}` : ''}`;
  if (p.words.length)
    return <SelectField label={label} value={value} choices={p.words.map((word) => ({ value: word, label: word }))} onInput={(text) => setParams({ [key]: text })} />;
  const [least, most] = usualRange(p);
  return (
    <NumberField label={label} value={value} least={least} most={most} log={most / least > 20} onInput={(text) => setParams({ [key]: text })}
      error={sentence(about(error, key))} />
  );
}

function FrictionFields({ error, averages }: { error?: Complaint; averages: boolean }) {
  const scenario = scenarioOf(route.value.params);
  const law = laws.value.find((one) => one.name === scenario['friction.law']);
  const choose = (name: string) => {
    const changes: Record<string, string | null> = { 'friction.law': name };
    for (const key of Object.keys(route.value.params)) if (key.startsWith('friction.') && !['friction.law', 'friction.closure'].includes(key)) changes[key] = null;
    const next = laws.value.find((one) => one.name === name);
    for (const [key, value] of Object.entries(next ? openingOf(next) : {})) changes[`friction.${key}`] = value;
    if (next?.remembers) changes['friction.closure'] = 'consistent';
    setParams(changes);
  };
  return (
    <>
      <SelectField label="Friction law" value={scenario['friction.law']} hint={law?.equation ? `${law.equation}` : undefined} error={sentence(about(error, 'friction.law'))}
        choices={laws.value.filter((one) => one.curve !== 'table').map((one) => ({ value: one.name, label: one.name }))} onInput={choose} />
      {law?.parameters.map((p) => <ParameterField key={p.name} p={p} error={error} />)}
      {law?.curve === 'formula' && (
        <TextField label="f(w)" value={scenario['friction.formula'] ?? ''} onInput={(text) => setParams({ 'friction.formula': text })} error={sentence(about(error, 'friction.formula'))} />
      )}
      {averages && scenario['friction.law'] !== 'none' && !law?.remembers && (
        <Segments label="How friction is averaged" value={scenario['friction.closure']} onInput={(text) => setParams({ 'friction.closure': text })}
          choices={[{ value: 'consistent', label: 'Exactly' }, { value: 'paper', label: 'As in the paper' }]} />
      )}
    </>
  );
}

/** `averages`: friction is averaged over trains, and can be in two ways. */
export function ScenarioForm({ error, extra, averages = true }: { error?: Complaint; extra?: preact.ComponentChildren; averages?: boolean }) {
  const params = route.value.params;
  const scenario = scenarioOf(params);
  const profile = scenario['initial.profile'];
  const set = (key: string) => (text: string) => setParams({ [key]: text });
  const say = (key: string) => sentence(about(error, key));
  return (
    <>
      <h2>Stress before</h2>
      <Segments label="Profile" value={profile} choices={profiles} onInput={(text) => setParams({ 'initial.profile': text, ...(text === 'formula' && !params['initial.formula'] ? { 'initial.formula': '0.9*exp(-(x+2)^2)' } : {}), ...(text === 'table' && !params.drawn ? { drawn: '-6:0.855,-3:0.855,-1:0.6,0:0.3,1:0.05,4:0' } : {}) })} />
      {(profile === 'step' || profile === 'tanh') && (
        <>
          <NumberField label="Left, Σ−" value={scenario['initial.stress_left']} least={0.15} most={2} onInput={set('initial.stress_left')} error={say('initial.stress_left')} />
          <NumberField label="Right, Σ+" value={scenario['initial.stress_right']} least={0} most={1.5} onInput={set('initial.stress_right')} error={say('initial.stress_right')} />
        </>
      )}
      {profile === 'tanh' && <NumberField label="Width" value={scenario['initial.width']} least={0.05} most={5} log onInput={set('initial.width')} error={say('initial.width')} />}
      {profile === 'table' && <p class="hint">Draw with the mouse or a finger in the plot of stress, or move its points with the arrow keys{error ? '' : ', or drop a CSV file with columns x and stress'}. {say('initial.file')}</p>}
      {profile === 'formula' && <TextField label="Stress as a formula of x" value={scenario['initial.formula'] ?? ''} onInput={set('initial.formula')} error={say('initial.formula')} />}
      <h2>Friction</h2>
      <FrictionFields error={error} averages={averages} />
      <h2>Run</h2>
      <NumberField label="Until t" value={scenario['time.end'] ?? '6.2832'} least={0.5} most={50} log onInput={set('time.end')} error={say('time.end')} />
      {extra}
      <details class="more">
        <summary>Contact, load, domain, resolution</summary>
        <TextField label="Contact profile a(x)" value={scenario['interface.contact'] ?? ''} placeholder="1" hint="Relative contact ratio, such as 1 + 0.5*(1 + tanh((x - 0.3)/0.05))" error={say('interface.contact')}
          onInput={(text) => setParams({ 'interface.contact': text || null, ...(text && !params['domain.left'] ? { 'domain.left': '-6', 'domain.right': '2' } : {}) })} />
        <TextField label="Load F(x, t)" value={scenario['forcing.formula'] ?? ''} placeholder="none" onInput={(text) => setParams({ 'forcing.formula': text || null })} error={say('forcing.formula')} />
        <TextField label="Domain from" value={scenario['domain.left'] ?? ''} placeholder="as far as the pulse runs" onInput={(text) => setParams({ 'domain.left': text || null })} error={say('domain.left') || say('domain')} />
        <TextField label="Domain to" value={scenario['domain.right'] ?? ''} placeholder="as far as the pulse runs" onInput={(text) => setParams({ 'domain.right': text || null })} error={say('domain.right')} />
        <NumberField label="Cells" value={scenario['pulse.cells']} least={40} most={400} onInput={(text) => setParams({ 'pulse.cells': text.includes('.') ? String(Math.round(Number(text))) : text })} error={say('pulse.cells')} />
      </details>
    </>
  );
}
