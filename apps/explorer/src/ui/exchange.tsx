/** A scenario as text, which the user can copy, edit, paste, or replace by dropping a file. */

import { useEffect, useState } from 'preact/hooks';
import { call } from '../engine/client';
import { go, route, unitParams, type Params } from '../state/route';
import { commandOf, csvOfTable, drawnOf, scenarioOf, tableOf, tomlOf } from '../state/scenario';
import { announce } from './announce';
import { sentence } from './fields';
import { copy, save } from './save';

/** Parameters of the address from a TOML text. The module reads the text, so that it has the same meaning as in the program. */
export async function paramsOfToml(toml: string, drawn?: string): Promise<{ params?: Params; problem?: string }> {
  if (drawn) {
    const table = tableOf({ drawn })!;
    await call('set_table', Float64Array.from(table[0]), Float64Array.from(table[1]), table[0].length);
  }
  const answer = await call('scenario', toml);
  if (answer.error) return { problem: `${answer.error.line ? `Line ${answer.error.line}: ` : ''}${answer.error.key ? `${answer.error.key}: ` : ''}${sentence(answer.error)}` };
  const params: Params = { 'friction.law': 'none' }; // the default of the program
  for (const { key, value } of answer.keys) params[key] = value;
  params['initial.stress_left'] ??= '0';
  params['initial.stress_right'] ??= '0';
  params['friction.closure'] ??= 'consistent';
  params['pulse.cells'] ??= '400';
  if (drawn && params['initial.profile'] === 'table') params.drawn = drawn;
  return { params };
}

/** Rows "x,stress" of a CSV file in the form of the address. Null if the file is not such a table. */
export function drawnOfCsv(text: string): string | null {
  const rows = text.split(/\r?\n/).filter((line) => line.trim()).map((line) => line.split(/[,;\t]/).map((cell) => cell.trim().replace(/^"|"$/g, '')));
  const head = rows.shift()?.map((name) => name.toLowerCase()) ?? [];
  const [x, stress] = [head.indexOf('x'), head.indexOf('stress')];
  if (x < 0 || stress < 0 || rows.length < 2) return null;
  const pairs = rows.map((row) => [Number(row[x]), Number(row[stress])]);
  return pairs.every((pair) => pair.every(Number.isFinite)) ? drawnOf(pairs.map((p) => p[0]), pairs.map((p) => p[1])) : null;
}

let lastCsv: string | undefined;

/** Uses pasted or dropped texts. Returns an error message, or an empty text. */
export async function take(texts: { name: string; text: string }[], panel: string): Promise<string> {
  for (const { name, text } of texts.filter((one) => one.name.endsWith('.csv'))) {
    const drawn = drawnOfCsv(text);
    if (!drawn) return `${name} is not a stress table. Allowed: columns x and stress with numbers, two rows or more.`;
    lastCsv = drawn;
  }
  const toml = texts.find((one) => !one.name.endsWith('.csv'));
  if (!toml) {
    if (!lastCsv) return 'Nothing to read. Allowed: a scenario (.toml) or a stress table (.csv).';
    go(panel, { ...route.value.params, 'initial.profile': 'table', drawn: lastCsv });
    announce('Stress table loaded');
    return '';
  }
  if (toml.text.length > 200000) return `${toml.name} is too long for a scenario. Allowed: a TOML text of up to 200 kB.`;
  const { params, problem } = await paramsOfToml(toml.text, lastCsv);
  if (problem) return problem;
  go(panel, { ...params!, ...(route.value.params.si ? { si: route.value.params.si } : {}) });
  announce('Scenario loaded');
  return '';
}

export function Exchange({ command }: { command: string }) {
  const params = route.value.params;
  const scenario = scenarioOf(params);
  const toml = tomlOf(scenario, params.title);
  const [text, setText] = useState(toml);
  const [problem, setProblem] = useState('');
  useEffect(() => setText(toml), [toml]);
  const table = tableOf(params);
  const line = commandOf(command, 'scenario.toml');
  const files = async (list: FileList | null | undefined) => {
    const all = await Promise.all([...(list ?? [])].slice(0, 4).map(async (file) => ({ name: file.name, text: file.size > 4e6 ? '' : await file.text() })));
    if (all.length) setProblem(await take(all, route.value.panel));
  };
  return (
    <details class="exchange" onDragOver={(e) => e.preventDefault()} onDrop={(e) => { e.preventDefault(); files(e.dataTransfer?.files); }}>
      <summary>Scenario file and command</summary>
      <label>
        Scenario (TOML): edit, paste, or drop a file here
        <textarea rows={12} spellcheck={false} value={text} onInput={(e) => setText(e.currentTarget.value)} aria-invalid={Boolean(problem)} />
      </label>
      {problem && <p class="error" role="alert">{problem}</p>}
      <p class="buttons">
        <button type="button" onClick={async () => setProblem(await take([{ name: 'text', text }], route.value.panel))}>Use this text</button>
        <button type="button" onClick={() => copy(text, 'scenario')}>Copy</button>
        <button type="button" onClick={() => save('scenario.toml', text)}>Save .toml</button>
        {table && <button type="button" onClick={() => save('stress.csv', csvOfTable(table), 'text/csv')}>Save stress.csv</button>}
        <button type="button" onClick={() => go(route.value.panel, unitParams())}>Start over</button>
        <label class="button">Open file<input type="file" accept=".toml,.csv" multiple onChange={(e) => files(e.currentTarget.files)} /></label>
      </p>
      <p>The program gives the same numbers{table ? ' (with stress.csv in the folder of the scenario)' : ''}:</p>
      <p class="command"><code>{line}</code> <button type="button" onClick={() => copy(line, 'command')}>Copy</button></p>
    </details>
  );
}
