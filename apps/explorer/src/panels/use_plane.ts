/** The rupture of a scenario with changes. It restarts when they change, and runs until its end. */

import { useEffect, useState } from 'preact/hooks';
import { call } from '../engine/client';
import type { Complaint } from '../engine/protocol';
import { begunPlane, grownPlane, ringsOf, type PlaneRun } from '../model/plane';

export interface Rupture {
  run: PlaneRun | null;
  error?: Complaint;
  busy: boolean;
}

export function usePlane(toml: string, changes: string, rings: string, direct: boolean): Rupture {
  const [shown, setShown] = useState<Rupture>({ run: null, busy: true });
  useEffect(() => {
    let alive = true;
    const fail = (error: Complaint) => setShown((before) => ({ run: before.run, error, busy: false }));
    const compute = async () => {
      const [r, slip] = ringsOf(rings);
      const begun = await call('plane_begin', toml, changes, r, slip, r.length, direct ? 1 : 0);
      if (!alive) return;
      if (begun.error) return fail(begun.error);
      let run = begunPlane(begun);
      while (!run.finished) {
        const more = await call('plane_go', 40);
        if (!alive) return;
        if (more.error) return fail(more.error);
        run = grownPlane(run, more);
        setShown({ run, busy: !run.finished, error: run.gaveUp ? { kind: 'numerics', message: run.gaveUp } : undefined });
      }
    };
    const timer = setTimeout(compute, shown.run ? 150 : 0);
    setShown((before) => ({ ...before, busy: true }));
    return () => {
      alive = false;
      clearTimeout(timer);
    };
  }, [toml, changes, rings, direct]);
  return shown;
}
