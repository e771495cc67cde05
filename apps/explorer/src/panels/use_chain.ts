/** The chain of the scenario. It restarts when the scenario changes, and advances while the player runs. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { call } from '../engine/client';
import type { ChainFrame, Complaint, Table } from '../engine/protocol';
import { advanced, begunChain, halfShown, isOver, lastFrame, pictures, type Chain } from '../model/chain';
import { reducedMotion } from '../ui/player';

export function useChain(toml: string, table: Table | null, count: number, end: number) {
  const [chain, setChain] = useState<Chain | null>(null);
  const [error, setError] = useState<Complaint>();
  const [playing, setPlaying] = useState(false);
  const [rate, setRate] = useState(0);
  const live = useRef(0);
  const held = useRef<Chain | null>(null);
  const begin = async (run: boolean) => {
    const mine = ++live.current;
    setPlaying(false);
    if (table) await call('set_table', Float64Array.from(table[0]), Float64Array.from(table[1]), table[0].length);
    const begun = await call('chain_begin', toml, count, 8);
    if (mine !== live.current) return;
    if (begun.error) return setError(begun.error);
    const start = await call('chain_go', 0, 5, halfShown(begun));
    if (mine !== live.current) return;
    setError(start.error);
    if (start.error) return;
    held.current = begunChain(begun, start);
    setChain(held.current);
    if (run) setPlaying(true);
  };
  useEffect(() => {
    const timer = setTimeout(() => begin(!reducedMotion()), live.current ? 150 : 0);
    return () => clearTimeout(timer);
  }, [toml, table?.join(), count]);
  useEffect(() => {
    if (!playing || !held.current) return;
    let alive = true;
    let shown = 0;
    let since = performance.now();
    /** Requests the next picture while the page draws this one. */
    const ask = (begun: Chain['begun'], frame: ChainFrame, count: number) => {
      const averaged = count % 3 === 0 || frame.time >= end * (1 - 2 / pictures);
      return call('chain_go', Math.min(end, frame.time + end / pictures), 14, averaged ? halfShown(begun) : 0);
    };
    let coming = ask(held.current.begun, lastFrame(held.current), held.current.frames.length);
    const step = async () => {
      const more = await coming;
      if (!alive) return;
      const now = held.current;
      if (more.error || !now) { setError(more.error); return setPlaying(false); }
      const over = isOver(more.time, end);
      if (!over) coming = ask(now.begun, more, now.frames.length + 1);
      held.current = advanced(now, more);
      setChain(held.current);
      if (++shown === 20) {
        setRate((1000 * shown) / (performance.now() - since));
        shown = 0;
        since = performance.now();
      }
      if (over) setPlaying(false);
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
    return () => void (alive = false);
  }, [playing]);
  return { chain, error, playing, setPlaying, restart: () => begin(true), rate };
}
