/** The run of the scenario in the address. While the user moves a control, the page computes only a quick look. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { runPulse } from '../engine/client';
import type { Complaint, Table } from '../engine/protocol';
import type { PulseRun } from '../model/pulse_run';

export interface Shown {
  run: PulseRun | null;
  error?: Complaint;
  /** Snapshots of the present scenario at t = 0 and one other time, while the run is computed. */
  look: PulseRun | null;
  busy: boolean;
  /** Seconds that the run has taken so far; `share` is the finished fraction of the run. */
  elapsed: number;
  share: number;
  stop: () => void;
  milliseconds: number;
}

const rest = 160;

export function usePulse(toml: string, table: Table | null, slot: number, look: () => number, closure = 0, on = true, frames = 121): Shown {
  const [shown, setShown] = useState<Shown>({ run: null, look: null, busy: true, elapsed: 0, share: 0, stop: () => undefined, milliseconds: 0 });
  const first = useRef(true);
  const key = `${toml}|${table?.join('|') ?? ''}|${closure}|${on}`;
  useEffect(() => {
    if (!on) return;
    const asked = performance.now();
    let alive = true;
    const stops: (() => void)[] = [];
    const update = (changes: Partial<Shown>) => alive && setShown((before) => ({ ...before, ...changes }));
    const whole = () => {
      if (!alive) return;
      const began = performance.now();
      stops.push(
        runPulse({ toml, table, frames, closure, slot }, (run, error) => {
          const elapsed = (performance.now() - began) / 1000;
          const share = run && run.end > 0 ? Math.min(1, run.now / run.end) : 0;
          // If there is nothing new to show, the previous picture stays.
          if (error) update({ error, look: null, busy: false, ...(run && run.count > 1 ? { run } : {}) });
          else if (run?.finished) update({ run, look: null, error: undefined, busy: false, elapsed, share: 1 });
          else update({ elapsed, share, busy: true });
        }),
      );
    };
    const stop = () => {
      stops.forEach((one) => one());
      update({ busy: false });
    };
    update({ busy: true, elapsed: 0, share: 0, stop });
    let timer: number | undefined;
    if (first.current) whole();
    else {
      stops.push(
        runPulse({ toml, table, frames: 0, look: look(), closure, slot }, (run, error) => {
          if (error) update({ error, busy: false });
          else if (run?.finished) update({ look: run, error: undefined, milliseconds: performance.now() - asked });
        }),
      );
      timer = window.setTimeout(whole, rest);
    }
    first.current = false;
    return () => {
      alive = false;
      clearTimeout(timer);
      stops.forEach((one) => one());
    };
  }, [key]);
  return shown;
}
