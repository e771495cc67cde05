/** Events of the shipped catalogue and the event that the user types, in one form. */

import type { EventAnswer, EventKey, EventNumbers } from '../engine/protocol';

export type Interval = [number, number];

/** An event as `slipfront event --json` prints it. */
export type PublishedEvent = EventNumbers & Partial<Record<`${EventKey}_interval`, Interval | null>> & {
  name: string;
  citation?: string | null;
  note?: string | null;
  warnings?: string[];
  error?: unknown;
};

export interface FaultEvent {
  name: string;
  numbers: EventNumbers;
  intervals: Partial<Record<EventKey, Interval>>;
  citation: string;
  note: string;
  warnings: string[];
}
/** An event with known rupture velocity, and therefore known stress. */
export type LocatedEvent = FaultEvent & { numbers: { stress: number; rupture_velocity: number; rupture_velocity_m_s: number } };

export const eventKeys: EventKey[] = [
  'rupture_velocity', 'stress', 'stress_bound', 'frictionless_slip_velocity', 'stress_pa', 'stress_pa_bound', 'contact_ratio', 'contact_ratio_bound', 'damping_number',
];

function intervalsBy(of: (key: EventKey) => Interval | null | undefined): FaultEvent['intervals'] {
  return Object.fromEntries(eventKeys.flatMap((key) => (of(key) ? [[key, of(key)]] : [])));
}

export const published = (event: PublishedEvent): FaultEvent => ({
  name: event.name, numbers: event, intervals: intervalsBy((key) => event[`${key}_interval`]),
  citation: event.citation ?? '', note: event.note ?? '', warnings: event.warnings ?? [],
});

export const typed = (event: EventAnswer): FaultEvent => ({
  name: event.name, numbers: event, citation: '', note: '', warnings: event.warnings,
  intervals: intervalsBy((key) => {
    const [low, high] = [event[`${key}_low`], event[`${key}_high`]];
    return low !== null && high !== null ? [low, high] : null;
  }),
});

export const isLocated = (event: FaultEvent): event is LocatedEvent => event.numbers.stress !== null && event.numbers.rupture_velocity !== null;
