/** A scenario as in the address, which maps "table.key" to text, and as TOML. The module checks it. */

import type { Params } from './route';

export const tables = ['initial', 'friction', 'forcing', 'interface', 'domain', 'time', 'pulse', 'chain', 'medium', 'output'];

export const defaults: Params = {
  'initial.profile': 'step',
  'initial.stress_left': '0.855',
  'initial.stress_right': '0',
  'friction.law': 'viscous',
  'friction.closure': 'consistent',
  'pulse.cells': '100',
};

const isScenarioKey = (key: string) => tables.includes(key.split('.')[0]) && key.includes('.');

export function scenarioOf(params: Params): Params {
  const scenario: Params = {};
  for (const [key, value] of Object.entries({ ...defaults, ...params })) if (isScenarioKey(key) && value !== '') scenario[key] = value;
  // For the other laws, the form sets all parameters.
  if (scenario['friction.law'] === 'viscous') scenario['friction.coefficient'] ??= '0.5';
  const profile = scenario['initial.profile'];
  if (profile !== 'step' && profile !== 'tanh') {
    delete scenario['initial.stress_left'];
    delete scenario['initial.stress_right'];
    scenario['domain.left'] ??= '-6';
    scenario['domain.right'] ??= '4';
  }
  if (profile !== 'tanh') delete scenario['initial.width'];
  if (profile === 'tanh') scenario['initial.width'] ??= '1';
  if (profile !== 'formula') delete scenario['initial.formula'];
  if (profile === 'table') scenario['initial.file'] ??= 'stress.csv';
  else delete scenario['initial.file'];
  return scenario;
}

/** The TOML form of a value. Text that looks like a number, a list or a boolean becomes one, except for keys with texts. */
function tomlValue(key: string, text: string): string {
  const bare = /^[-+]?(\d[\d_]*)(\.\d+)?([eE][-+]?\d+)?$/.test(text) || /^(true|false)$/.test(text) || /^\[[\d\s.,eE+-]*\]$/.test(text);
  const isText = ['profile', 'law', 'closure', 'formula', 'file', 'contact', 'model', 'state'].includes(key.split('.')[1]);
  if (bare && !isText) return text;
  return JSON.stringify(text).replace(/\u007f/g, '\\u007F');
}

/** Keys that other keys depend on come first. */
const rank = (key: string) => (/\.(profile|law)$/.test(key) ? 0 : 1);
const byName = (a: string, b: string) => rank(a) - rank(b) || (a < b ? -1 : 1);

export function tomlOf(scenario: Params, title = ''): string {
  const lines = title ? [`title = ${JSON.stringify(title)}`, ''] : [];
  for (const table of tables) {
    const keys = Object.keys(scenario).filter((key) => key.startsWith(`${table}.`)).sort(byName);
    if (!keys.length) continue;
    lines.push(`[${table}]`);
    for (const key of keys) lines.push(`${key.slice(table.length + 1)} = ${tomlValue(key, scenario[key])}`);
    lines.push('');
  }
  return lines.join('\n');
}

/** Distance by which a drawn stress is continued outside both ends with its end values, because dislocations enter the domain. */
const beyond = 20;

/** The table of a drawn profile, from its "x:stress" pairs in the address. */
export function tableOf(params: Params): [number[], number[]] | null {
  if (!params.drawn) return null;
  const rows = params.drawn.split(',').map((pair) => pair.split(':').map(Number));
  const [first, last] = [rows[0], rows[rows.length - 1]];
  const all = [[first[0] - beyond, first[1]], ...rows, [last[0] + beyond, last[1]]];
  return [all.map((row) => row[0]), all.map((row) => row[1])];
}

export const drawnOf = (x: number[], y: number[]) => x.map((at, i) => `${+at.toPrecision(4)}:${+y[i].toPrecision(4)}`).join(',');

export const csvOfTable = ([x, y]: [number[], number[]]) => `x,stress\n${x.map((at, i) => `${at},${y[i]}`).join('\n')}\n`;

const quotedForShell = (text: string) => (/^[\w./=:,+-]+$/.test(text) ? text : `'${text.replace(/'/g, `'\\''`)}'`);

/** The command that repeats the picture, with the scenario in the file `file`. */
export const commandOf = (command: string, file: string, more: string[] = []) =>
  ['slipfront', command, file, ...more].map(quotedForShell).join(' ');
