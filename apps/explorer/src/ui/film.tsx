/** A film of a run, as WebM: the browser records a canvas that shows one picture after the other. */

import { useRef, useState } from 'preact/hooks';
import { color } from './colors';
import { imageOf } from './picture/raster';
import { save } from './save';

export const filmWidth = 960; // pixels of the pictures
export const filmHeight = 540;
const enlarged = 4 / 3;
const perSecond = 25;
const seconds = 8;
const type = 'video/webm';

/** Why the browser cannot make a film; an empty text if it can. */
function missing(): string {
  if (typeof MediaRecorder === 'undefined' || typeof HTMLCanvasElement.prototype.captureStream !== 'function') return 'This browser cannot record films.';
  return MediaRecorder.isTypeSupported(type) ? '' : 'This browser cannot record WebM.';
}

/** Shows pictures, as SVG, below one another. */
async function show(ctx: CanvasRenderingContext2D, pictures: string[]) {
  const images = await Promise.all(pictures.map(imageOf));
  ctx.fillStyle = color('paper');
  ctx.fillRect(0, 0, filmWidth, filmHeight);
  images.forEach((image, i) => ctx.drawImage(image, 0, (i * filmHeight) / images.length));
}

/** Records a film of the pictures at 0 ... 1 of the run. It calls `progress` with the recorded fraction, and stops if the answer is false. */
async function record(pictures: (at: number) => string[], progress: (share: number) => boolean): Promise<Blob | null> {
  const canvas = document.createElement('canvas');
  canvas.width = enlarged * filmWidth;
  canvas.height = enlarged * filmHeight;
  const ctx = canvas.getContext('2d')!;
  ctx.scale(enlarged, enlarged);
  await show(ctx, pictures(0));
  const stream = canvas.captureStream(0);
  const [track] = stream.getVideoTracks() as CanvasCaptureMediaStreamTrack[];
  const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 4e6 });
  const parts: Blob[] = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const stopped = new Promise((resolve) => (recorder.onstop = resolve));
  recorder.start();
  const began = performance.now();
  const frames = perSecond * seconds;
  let wanted = true;
  for (let i = 0; wanted && i <= frames; ++i) {
    await show(ctx, pictures(i / frames));
    await new Promise((resolve) => setTimeout(resolve, began + (1000 * i) / perSecond - performance.now()));
    track.requestFrame();
    wanted = progress(i / frames);
  }
  recorder.stop();
  await stopped;
  track.stop();
  return wanted ? new Blob(parts, { type }) : null;
}

export function Film({ name, pictures }: { name: string; pictures: (at: number) => string[] }) {
  const [share, setShare] = useState<number | null>(null);
  const wanted = useRef(true);
  const reason = missing();
  const start = async () => {
    wanted.current = true;
    setShare(0);
    const film = await record(pictures, (done) => {
      setShare(done);
      return wanted.current;
    });
    setShare(null);
    if (film) save(`${name}.webm`, film);
  };
  if (reason) return <p class="hint">Film: {reason}</p>;
  return (
    <p class="buttons film">
      {share === null
        ? <><button type="button" onClick={start}>Film (WebM)</button> <span class="hint">{seconds} s, {enlarged * filmWidth} × {enlarged * filmHeight}; recording takes as long</span></>
        : <><button type="button" onClick={() => (wanted.current = false)}>Stop the film</button> <progress max={1} value={share} aria-label="Recorded" /></>}
    </p>
  );
}
