/** The messages between the page and the worker, and the functions of the module with the types of their answers. */

export interface Complaint {
  kind: 'input' | 'numerics' | 'memory';
  message: string;
  key?: string;
  value?: string;
  problem?: string;
  allowed?: string;
  line?: number;
}

/** An answer, or the error that the module reports. */
export type Reply<T> = (T & { error?: undefined }) | { error: Complaint };

export type Argument = number | string | Float64Array;

export type RelationsKey =
  | 'stress' | 'rupture_velocity' | 'leading_velocity' | 'velocity_ratio' | 'slip_velocity'
  | 'stress_at_origin' | 'dislocation_velocity_at_origin' | 'psi' | 'psi_at_origin';
export type Relations = Record<RelationsKey, number>;
export type RelationsCurve = Record<RelationsKey, Float64Array>;

export interface Wave {
  kind: 'none' | 'fan' | 'two-trains';
  outer: number;
  inner: number;
}
export interface Region {
  kind: 'constant' | 'fan' | 'two-trains' | 'vacuum';
  from: number;
  to: number;
  trains: number;
}
/** The rapidities of the edges of each train over x/t are NaN where there is no such train. */
export type Riemann = Record<'left_wave' | 'right_wave', Wave> & { regions: Region[] } &
  Record<'Sigma_between' | 'W_between' | 'trains_between' | 'left_edge' | 'right_edge', number> &
  Record<'x_over_t' | 'Sigma' | 'W' | 'slip' | 'lowest_1' | 'highest_1' | 'lowest_2' | 'highest_2', Float64Array>;

export type Train = Record<'spacing' | 'k' | 'W' | 'psi' | 'phi', number> & Record<'xi' | 'u' | 'sigma' | 'w', Float64Array>;

export type Units = Record<'speed' | 'slip' | 'length' | 'time' | 'stress' | 'slip_velocity' | 'velocity', number>;

export interface Parameter {
  name: string;
  symbol: string;
  unit: string;
  value: number;
  least: number;
  most: number | null;
  without_least: boolean;
  words: string[];
}
export interface Law {
  name: string;
  equation: string;
  source: string;
  curve: 'none' | 'formula' | 'table';
  remembers: boolean;
  parameters: Parameter[];
}

export interface ScenarioAnswer {
  keys: { key: string; value: string }[];
  warnings: string[];
  end: number;
  left: number;
  right: number;
  x: Float64Array;
  stress: Float64Array;
}

/** Quantities of an event. A quantity that the observations do not determine is null. */
export type EventKey =
  | 'rupture_velocity' | 'stress' | 'stress_bound' | 'frictionless_slip_velocity' | 'stress_pa' | 'stress_pa_bound'
  | 'contact_ratio' | 'contact_ratio_bound' | 'damping_number';
export type EventNumbers = Record<EventKey | 'c_m_s' | 'rupture_velocity_m_s' | 'slip_velocity_m_s', number | null>;
export type EventAnswer = EventNumbers & Record<`${EventKey}_low` | `${EventKey}_high`, number | null> & { name: string; warnings: string[] };

export interface ChainBegun {
  scale: number;
  left: number;
  right: number;
  end: number;
  sites: number;
  spacing: number;
  warnings: string[];
  dislocations: number;
}
export interface ChainFrame {
  time: number;
  x: Float64Array;
  sign: Float64Array;
}
/** Averages over several dislocations, and the sites near x = 0. */
export type ChainAverages = Record<'average_x' | 'W' | 'Sigma' | 'near_x' | 'near_velocity' | 'near_stress', Float64Array>;
export type ChainAnswer = ChainFrame & { reached: boolean; steps: number } & Partial<ChainAverages>;

export interface PulseBegun {
  x: Float64Array;
  end: number;
  frames: number;
  closure: string;
  warnings: string[];
}
export type PulseField = 'W' | 'Sigma' | 'U' | 'slip';
export type PulseSeries =
  | 'time' | 'trailing_front' | 'leading_front' | 'slip_velocity_at_origin' | 'stress_at_origin' | 'slip_at_origin'
  | 'peak_slip_velocity' | 'peak_position' | 'energy_elastic' | 'energy_kinetic' | 'energy_dissipated' | 'energy_supplied' | 'potency';
/** Snapshots since the last answer. Each array of a field holds one snapshot after the other. */
export type PulseMore = Record<PulseField | PulseSeries, Float64Array> & {
  now: number;
  steps: number;
  finished: boolean;
  friction_coefficient: number | null;
  gave_up?: string;
  warnings?: string[];
};

/** A loaded chain, in SI units. `x` are its sites, and `fronts_x` the positions that record the arrival of slip events. */
export interface LoadingBegun {
  end: number;
  pulls_an_end: boolean;
  velocity: number;
  stiffness_ratio: number | null;
  warnings: string[];
  x: Float64Array;
  fronts_x: Float64Array;
}
export type SlipEvent = Record<'onset' | 'duration' | 'slip' | 'largest_slip' | 'load' | 'stress_drop' | 'peak_velocity' | 'origin' | 'length' | 'complete', number> & { rupture_velocity: number | null };
/** Results since the last answer: `slip` and `velocity` hold all sites at one time after the other. `arrivals` hold one event after the other. */
export type LoadingMore = Record<'time' | 'load' | 'speed' | 'slip' | 'velocity' | 'arrivals', Float64Array> & {
  finished: boolean;
  steps: number;
  now: number;
  events: SlipEvent[];
};

/** A rupture on a plane of nx times ny cells, in the units of the model. */
export type PlaneBegun = Record<'left' | 'right' | 'bottom' | 'top' | 'end' | 'nx' | 'ny', number> & { warnings: string[] };
/** Snapshots and rows of the series since the last answer. `line_points` are the numbers of points of the lines of each snapshot. */
export type PlaneMore = Record<'time' | 'velocity' | 'slip' | 'line_points' | 'line_x' | 'line_y' | 'series_time' | 'moment_rate' | 'front', Float64Array> & {
  finished: boolean;
  gave_up: string;
  steps: number;
  now: number;
  warnings: string[];
};

/** The functions of the module that the page calls: arguments and answers. */
export interface Calls {
  relations: { arguments: [given: number, value: number]; answer: Relations };
  relations_curve: { arguments: [given: number, from: number, to: number, points: number, byLogarithm: number]; answer: RelationsCurve };
  riemann: { arguments: [leftStress: number, leftVelocity: number, rightStress: number, rightVelocity: number, points: number]; answer: Riemann };
  train: { arguments: [stress: number, velocity: number, periods: number, points: number]; answer: Train };
  units: { arguments: [shearModulus: string, pWaveSpeed: string, poissonRatio: string, contactRatio: string, asperitySpacing: string]; answer: Units };
  laws: { arguments: []; answer: { laws: Law[] } };
  event: { arguments: [toml: string, samples: number]; answer: EventAnswer };
  scenario: { arguments: [toml: string]; answer: ScenarioAnswer };
  set_table: { arguments: [x: Float64Array, stress: Float64Array, rows: number]; answer: object };
  chain_begin: { arguments: [toml: string, dislocations: number, window: number]; answer: ChainBegun };
  chain_go: { arguments: [time: number, milliseconds: number, half: number]; answer: ChainAnswer };
  loading_begin: { arguments: [toml: string, changes: string]; answer: LoadingBegun };
  loading_go: { arguments: [milliseconds: number]; answer: LoadingMore };
  plane_begin: { arguments: [toml: string, changes: string, r: Float64Array, slip: Float64Array, rows: number, direct: number]; answer: PlaneBegun };
  plane_go: { arguments: [milliseconds: number]; answer: PlaneMore };
  pulse_begin: { arguments: [slot: number, toml: string, frames: number, look: number, closure: number]; answer: PulseBegun };
  pulse_go: { arguments: [slot: number, milliseconds: number, first: number]; answer: PulseMore };
}
export type Name = keyof Calls;
export type AnswerOf<N extends Name> = Reply<Calls[N]['answer']>;

/** A stress table: x and stress. */
export type Table = [number[], number[]];

export interface PulseQuestion {
  toml: string;
  table?: Table | null;
  frames?: number;
  /** If > 0, the only output time besides t = 0. */
  look?: number;
  /** 0: the closure of the scenario, 1: consistent, 2: paper. */
  closure?: number;
  /** A new run replaces the earlier run in its slot. */
  slot: number;
}

/** A message from the page to the worker. */
export type Question =
  | { type: 'start'; wasm: WebAssembly.Module }
  | { type: 'call'; id: number; name: Name; args: Argument[] }
  | ({ type: 'pulse'; id: number } & Required<PulseQuestion>)
  | { type: 'cancel'; id: number };

/** A message from the worker to the page. A question may have several answers; one of them is marked as the last. */
export type News =
  | { type: 'answer'; answer: Reply<object> }
  | { type: 'begun'; begun: PulseBegun }
  | { type: 'more'; more: Reply<PulseMore> }
  | { type: 'superseded' };
export type Message = { id: number; last: boolean } & News;
