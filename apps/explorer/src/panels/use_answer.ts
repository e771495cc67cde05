/** The answer to one call, asked again when the arguments change. */

import { useEffect, useState } from 'preact/hooks';
import { call } from '../engine/client';
import type { AnswerOf, Calls, Name } from '../engine/protocol';

export function useAnswer<N extends Name>(name: N, ...args: Calls[N]['arguments']): AnswerOf<N> | null {
  const [answer, setAnswer] = useState<AnswerOf<N> | null>(null);
  useEffect(() => {
    let alive = true;
    call(name, ...args).then((got) => alive && setAnswer(got));
    return () => void (alive = false);
  }, [name, ...args]);
  return answer;
}
