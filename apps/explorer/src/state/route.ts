/** The address of the page: `#/panel?key=value&...`. It contains everything that a picture depends on. */

import { effect, signal } from '@preact/signals';

export type Params = Record<string, string>;
export interface Route {
  panel: string;
  params: Params;
}

function readable(text: string): string {
  try {
    return decodeURIComponent(text.replace(/\+/g, ' '));
  } catch {
    return text;
  }
}

/** The entry of a table under a name that a user typed. Inherited names such as `constructor` are not entries. */
export function entryOf<T>(table: Record<string, T>, name: string | undefined): T | undefined {
  return name !== undefined && Object.hasOwn(table, name) ? table[name] : undefined;
}

export function parse(hash: string): Route {
  const [path, query = ''] = hash.replace(/^#\/?/, '').split(/\?(.*)/s);
  const params: Params = {};
  for (const pair of query.split('&')) {
    if (!pair) continue;
    const [key, value = ''] = pair.split(/=(.*)/s);
    params[readable(key)] = readable(value);
  }
  return { panel: readable(path).replace(/\/$/, ''), params };
}

const plain = (text: string) => encodeURIComponent(text).replace(/%2C/g, ',').replace(/%3A/g, ':').replace(/%20/g, '+');

export function addressOf(route: Route): string {
  const query = Object.entries(route.params)
    .map(([key, value]) => `${plain(key)}=${plain(value)}`)
    .join('&');
  return `#/${route.panel}${query ? `?${query}` : ''}`;
}

export const route = signal<Route>(parse(location.hash));
addEventListener('hashchange', () => (route.value = parse(location.hash)));

/** Panels that run the scenario of the address. */
const runsScenario = (panel: string) => panel === 'pulse' || panel === 'dislocations';
const isUnit = (key: string) => key === 'si' || key.startsWith('medium.');
const isScenario = (key: string) => !isUnit(key) && (key === 'drawn' || key === 'title' || key.includes('.')) && !key.startsWith('my.');
/** The tour shows its own states, and a run starts only when somebody asks for it. */
const isBrief = (key: string) => key === 'tour' || key === 'play';

const pick = (params: Params, wanted: (key: string) => boolean) => Object.fromEntries(Object.entries(params).filter(([key]) => wanted(key)));

let scenario: Params = {};
const own = new Map<string, Params>();
/** The settings with which each panel was last shown. The scenario is shared by the panels that run it, and the units by all. */
effect(() => {
  const { panel, params } = route.value;
  if (runsScenario(panel)) scenario = pick(params, isScenario);
  own.set(panel, pick(params, (key) => !isUnit(key) && !isBrief(key) && !(runsScenario(panel) && isScenario(key))));
});

/** Units in the address, which every link of the page passes on. */
export const unitParams = () => pick(route.value.params, isUnit);

/** The address of a panel with the scenario and the units of the page, as in the menu. */
export const linkTo = (panel: string) =>
  addressOf({ panel, params: { ...(runsScenario(panel) ? scenario : {}), ...own.get(panel), ...unitParams() } });

let pending: number | undefined;
/** Changes parameters of the present panel; null removes one. The address changes only after a pause of 120 ms. */
export function setParams(changes: Record<string, string | null>) {
  const params = { ...route.value.params };
  for (const [key, value] of Object.entries(changes))
    if (value === null) delete params[key];
    else params[key] = value;
  route.value = { ...route.value, params };
  clearTimeout(pending);
  pending = window.setTimeout(() => history.replaceState(null, '', addressOf(route.value)), 120);
}

/** The address that exported pictures state. The folder of a file on this machine is private and leads nowhere elsewhere. */
export const statedAddress = () => (location.protocol === 'file:' ? `slipfront explorer ${location.hash}` : location.href);

export function go(panel: string, params: Params = {}) {
  location.hash = addressOf({ panel, params });
}
