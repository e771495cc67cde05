/** Several pulses, one after the other: what there is so far. */

import { useEffect, useState } from 'preact/hooks';
import { runPulse } from '../engine/client';
import type { Complaint } from '../engine/protocol';
import type { PulseRun } from '../model/pulse_run';

export interface Question {
  toml: string;
  frames: number;
}

export function useRuns(questions: Question[], slot: number): { runs: (PulseRun | null)[]; error?: Complaint; done: number } {
  const [state, setState] = useState<{ key: string; runs: (PulseRun | null)[]; error?: Complaint }>({ key: '', runs: [] });
  const key = questions.map((q) => `${q.frames}:${q.toml}`).join('\n');
  useEffect(() => {
    let alive = true;
    let stop: (() => void) | undefined;
    const runs: (PulseRun | null)[] = questions.map(() => null);
    const next = (i: number) => {
      if (!alive || i >= questions.length) return;
      stop = runPulse({ ...questions[i], slot }, (run, error) => {
        if (!alive) return;
        if (error) setState({ key, runs: [...runs], error });
        if (!error && !run?.finished) return;
        if (run?.finished) {
          runs[i] = run;
          setState({ key, runs: [...runs] });
        }
        if (!error) next(i + 1);
      });
    };
    const timer = setTimeout(() => next(0), state.key ? 60 : 0);
    return () => {
      alive = false;
      clearTimeout(timer);
      stop?.();
    };
  }, [key]);
  return { runs: state.runs, error: state.error, done: state.key === key ? state.runs.filter(Boolean).length : 0 };
}
