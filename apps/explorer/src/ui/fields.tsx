/** Controls of a form. Each has its label and, next to it, the error and the allowed values that the module reports. */

import type { ComponentChildren } from 'preact';
import { useEffect, useId, useState } from 'preact/hooks';
import type { Complaint } from '../engine/protocol';

/** The error sentence next to a field. */
export function sentence(error: Complaint | undefined): string {
  if (!error) return '';
  const problem = error.problem || error.message;
  const start = error.kind === 'input' ? problem.charAt(0).toUpperCase() + problem.slice(1) : problem;
  return error.allowed ? `${start}. Allowed: ${error.allowed}.` : `${start.replace(/\.$/, '')}.`;
}

/** The reason why a scenario cannot run, shown above its pictures, because the error may be in a key that has no field. */
export function CannotRun({ error, shown }: { error?: Complaint; shown: boolean }) {
  if (!error) return null;
  return <p class="busy error" role="status">This scenario cannot run. {error.key ? `${error.key}: ` : ''}{sentence(error)}{shown ? ' The picture shows the last one that could.' : ''}</p>;
}

/** The error if it is in this key, else undefined. */
export const about = (error: Complaint | undefined, key: string) => (error && error.key === key ? error : undefined);

interface FieldProps {
  label: ComponentChildren;
  hint?: string;
  error?: string;
}

interface NumberProps extends FieldProps {
  value: string;
  least: number;
  most: number;
  log?: boolean;
  onInput: (text: string) => void;
}

const steps = 400;

function placeOf(value: number, { least, most, log }: NumberProps): number {
  if (!Number.isFinite(value)) return 0;
  const share = log ? Math.log(Math.max(value, least) / least) / Math.log(most / least) : (value - least) / (most - least);
  return Math.round(Math.min(1, Math.max(0, share)) * steps);
}

function valueAt(place: number, { least, most, log }: NumberProps): string {
  const share = place / steps;
  const value = log ? least * (most / least) ** share : least + (most - least) * share;
  return String(+value.toPrecision(3));
}

/** A number that the user sets by a slider or by typing. The slider has the usual range, the box accepts any allowed number. */
export function NumberField(props: NumberProps) {
  const { label, value, onInput, hint, error } = props;
  const id = useId();
  const [text, setText] = useState(value);
  useEffect(() => setText(value), [value]);
  const type = (typed: string) => {
    setText(typed);
    onInput(typed);
  };
  return (
    <div class={`field ${error ? 'bad' : ''}`}>
      <label for={id}>{label}</label>
      <input id={id} class="number" type="text" inputMode="decimal" autocomplete="off" spellcheck={false} value={text}
        aria-invalid={Boolean(error)} aria-describedby={error ? `${id}-e` : undefined}
        onInput={(e) => type(e.currentTarget.value)} />
      <input type="range" min={0} max={steps} value={placeOf(Number(value), props)} aria-label={`${typeof label === 'string' ? label : 'value'}, slider`}
        aria-valuetext={value} onInput={(e) => type(valueAt(Number(e.currentTarget.value), props))} />
      {hint && <p class="hint">{hint}</p>}
      {error && <p class="error" id={`${id}-e`} role="alert">{error}</p>}
    </div>
  );
}

export function TextField({ label, value, onInput, hint, error, placeholder }: FieldProps & { value: string; placeholder?: string; onInput: (text: string) => void }) {
  const id = useId();
  return (
    <div class={`field ${error ? 'bad' : ''}`}>
      <label for={id}>{label}</label>
      <input id={id} class="text" type="text" autocomplete="off" spellcheck={false} value={value} placeholder={placeholder} aria-invalid={Boolean(error)}
        aria-describedby={error ? `${id}-e` : undefined} onInput={(e) => onInput(e.currentTarget.value)} />
      {hint && <p class="hint">{hint}</p>}
      {error && <p class="error" id={`${id}-e`} role="alert">{error}</p>}
    </div>
  );
}

interface Choice {
  value: string;
  label: string;
}

export function SelectField({ label, value, choices, onInput, hint, error }: FieldProps & { value: string; choices: Choice[]; onInput: (text: string) => void }) {
  const id = useId();
  return (
    <div class={`field ${error ? 'bad' : ''}`}>
      <label for={id}>{label}</label>
      <select id={id} value={value} aria-invalid={Boolean(error)} onChange={(e) => onInput(e.currentTarget.value)}>
        {choices.every((choice) => choice.value !== value) && <option value={value}>{value}</option>}
        {choices.map((choice) => <option value={choice.value}>{choice.label}</option>)}
      </select>
      {hint && <p class="hint">{hint}</p>}
      {error && <p class="error" role="alert">{error}</p>}
    </div>
  );
}

export function Segments({ label, value, choices, onInput }: { label: string; value: string; choices: Choice[]; onInput: (text: string) => void }) {
  const name = useId();
  return (
    <fieldset class="segments">
      <legend>{label}</legend>
      <div>
        {choices.map((choice) => (
          <label class={choice.value === value ? 'on' : ''}>
            <input type="radio" name={name} checked={choice.value === value} onChange={() => onInput(choice.value)} />
            {choice.label}
          </label>
        ))}
      </div>
    </fieldset>
  );
}

export function Check({ label, checked, onInput }: { label: string; checked: boolean; onInput: (on: boolean) => void }) {
  return (
    <label class="check">
      <input type="checkbox" checked={checked} onChange={(e) => onInput(e.currentTarget.checked)} /> {label}
    </label>
  );
}
