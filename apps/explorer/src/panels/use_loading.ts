/** The loaded chain of a scenario with changes. It restarts when they change, and runs until its end. */

import { useEffect, useState } from 'preact/hooks';
import { call } from '../engine/client';
import type { Complaint } from '../engine/protocol';
import { begunLoading, grownLoading, type LoadedRun } from '../model/loading';

const mostResults = 20000;

export interface Loading {
  run: LoadedRun | null;
  error?: Complaint;
  busy: boolean;
}

export function useLoading(toml: string, changes: string): Loading {
  const [shown, setShown] = useState<Loading>({ run: null, busy: true });
  useEffect(() => {
    let alive = true;
    const fail = (error: Complaint) => setShown((before) => ({ run: before.run, error, busy: false }));
    const compute = async () => {
      const begun = await call('loading_begin', toml, changes);
      if (!alive) return;
      if (begun.error) return fail(begun.error);
      let run = begunLoading(begun);
      while (true) {
        const more = await call('loading_go', 40);
        if (!alive) return;
        if (more.error) return fail(more.error);
        run = grownLoading(run, more);
        const full = run.time.length > mostResults;
        setShown({ run, busy: !run.finished && !full, error: full && !run.finished ? { kind: 'input', key: 'time.end', message: '', problem: `more than ${mostResults} results before the end`, allowed: 'an earlier end on this page' } : undefined });
        if (run.finished || full) return;
      }
    };
    const timer = setTimeout(compute, shown.run ? 150 : 0);
    setShown((before) => ({ ...before, busy: true }));
    return () => {
      alive = false;
      clearTimeout(timer);
    };
  }, [toml, changes]);
  return shown;
}
