/** Play, pause, scrub, speed: one time for all plots of a panel. */

import { useEffect, useRef } from 'preact/hooks';
import { signal, type Signal } from '@preact/signals';
import { short } from './format';

export interface Player {
  /** 0 ... 1 of the run. */
  at: Signal<number>;
  playing: Signal<boolean>;
  /** Runs a second. */
  speed: Signal<number>;
  /** Frames a second of late, as they are drawn. */
  rate: Signal<number>;
}

export const makePlayer = (at = 1): Player => ({ at: signal(at), playing: signal(false), speed: signal(0.2), rate: signal(0) });

export const reducedMotion = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

/** `time` is the text of the time, if time does not pass evenly while the run plays. */
export function Transport({ player, end, unit, factor, time: text, onSettle }: { player: Player; end: number; unit: string; factor: number; time?: string; onSettle?: (at: number) => void }) {
  const last = useRef(0);
  useEffect(() => {
    if (!player.playing.value) return;
    let id = 0;
    let frames = 0;
    let since = performance.now();
    last.current = since;
    const step = (now: number) => {
      const moved = player.at.value + ((now - last.current) / 1000) * player.speed.value;
      last.current = now;
      player.at.value = moved > 1 ? 0 : moved;
      if (++frames === 30) {
        player.rate.value = 30000 / (now - since);
        frames = 0;
        since = now;
      }
      id = requestAnimationFrame(step);
    };
    id = requestAnimationFrame(step);
    return () => cancelAnimationFrame(id);
  }, [player.playing.value]);
  const toggle = () => {
    if (!player.playing.value && player.at.value >= 1) player.at.value = 0;
    player.playing.value = !player.playing.value;
    if (!player.playing.value) onSettle?.(player.at.value);
  };
  const time = text ?? `t = ${short(player.at.value * end * factor, 3)} ${unit}`;
  return (
    <div class="transport">
      <button type="button" class="play" onClick={toggle} aria-label={player.playing.value ? 'Pause' : 'Play'}>
        <svg viewBox="0 0 24 24" width="22" height="22" aria-hidden="true">{player.playing.value ? <path d="M6 5h4v14H6zM14 5h4v14h-4z" /> : <path d="M7 4.5v15l13-7.5z" />}</svg>
      </button>
      <input type="range" min={0} max={1000} value={Math.round(player.at.value * 1000)} aria-label="Time" aria-valuetext={time}
        onInput={(e) => { player.playing.value = false; player.at.value = Number(e.currentTarget.value) / 1000; onSettle?.(player.at.value); }} />
      <output>{time}</output>
      <label class="speed">
        Speed
        <select value={String(player.speed.value)} onChange={(e) => (player.speed.value = Number(e.currentTarget.value))}>
          <option value="0.05">¼</option><option value="0.1">½</option><option value="0.2">1</option><option value="0.5">2½</option>
        </select>
      </label>
    </div>
  );
}
