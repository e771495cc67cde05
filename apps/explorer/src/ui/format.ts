/** Numbers for people. */

const superscripts: Record<string, string> = { '-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹' };
export const superscript = (n: number) => [...String(n)].map((c) => superscripts[c]).join('');

export function short(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  if (exponent >= -3 && exponent < 6) return String(+value.toPrecision(digits)).replace('-', '−');
  const mantissa = +(value / 10 ** exponent).toPrecision(digits);
  if (!Number.isFinite(mantissa)) return value.toExponential(digits - 1).replace('-', '−');
  return `${String(mantissa).replace('-', '−')}·10${superscript(exponent)}`;
}

const lengths: [string, number][] = [['km', 1e3], ['m', 1], ['cm', 1e-2], ['mm', 1e-3], ['µm', 1e-6], ['nm', 1e-9]];
const times: [string, number][] = [['years', 3.156e7], ['days', 86400], ['h', 3600], ['min', 60], ['s', 1], ['ms', 1e-3], ['µs', 1e-6], ['ns', 1e-9]];
const stresses: [string, number][] = [['GPa', 1e9], ['MPa', 1e6], ['kPa', 1e3], ['Pa', 1]];
const velocities: [string, number][] = [['km/s', 1e3], ['m/s', 1], ['cm/s', 1e-2], ['mm/s', 1e-3], ['km/day', 1e3 / 86400], ['m/day', 1 / 86400], ['mm/day', 1e-3 / 86400], ['mm/year', 1e-3 / 3.156e7]];
const all = { length: lengths, time: times, stress: stresses, velocity: velocities };
export type Kind = keyof typeof all;

/** The unit in which the largest of some SI values reads best. */
export function bestUnit(kind: Kind, largest: number): [string, number] {
  const size = Math.abs(largest);
  return all[kind].find(([, factor]) => size >= 0.9 * factor) ?? all[kind][all[kind].length - 1];
}

export function inUnits(kind: Kind, value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const [name, factor] = bestUnit(kind, value);
  return `${short(value / factor, digits)} ${name}`;
}
