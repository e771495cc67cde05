/** A film of a run, as WebM: the browser encodes one picture after the other. */

import { useRef, useState } from 'preact/hooks';
import { color } from './colors';
import { imageOf } from './picture/raster';
import { save } from './save';

export const filmWidth = 960; // pixels of the pictures
export const filmHeight = 540;
const enlarged = 4 / 3;
const [width, height] = [enlarged * filmWidth, enlarged * filmHeight];
const perSecond = 25;
const seconds = 8;
const missing = 'This browser cannot encode films. It may be able to if it opens the page from a disk or by https.';

/** Pictures as SVG at 0 ... 1 of the run, which the film shows below one another. */
type Pictures = (at: number) => string[] | Promise<string[]>;

/** Shows pictures below one another. */
async function show(ctx: CanvasRenderingContext2D, pictures: string[]) {
  const images = await Promise.all(pictures.map(imageOf));
  ctx.fillStyle = color('paper');
  ctx.fillRect(0, 0, filmWidth, filmHeight);
  images.forEach((image, i) => ctx.drawImage(image, 0, (i * filmHeight) / images.length));
}

/** Encodes a film. It calls `progress` with the finished fraction, and stops if the answer is false. */
async function encoded(pictures: Pictures, progress: (share: number) => boolean): Promise<Blob | null> {
  const { ArrayBufferTarget, Muxer } = await import('webm-muxer');
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width, height });
  const ctx = canvas.getContext('2d')!;
  ctx.scale(enlarged, enlarged);
  const target = new ArrayBufferTarget();
  const muxer = new Muxer({ target, video: { codec: 'V_VP8', width, height, frameRate: perSecond } });
  let failure: Error | undefined;
  const encoder = new VideoEncoder({ output: (chunk, about) => muxer.addVideoChunk(chunk, about), error: (error) => (failure = error) });
  encoder.configure({ codec: 'vp8', width, height, bitrate: 4e6, framerate: perSecond });
  const frames = perSecond * seconds;
  try {
    for (let i = 0; i <= frames; ++i) {
      await show(ctx, await pictures(i / frames));
      if (failure || !progress(i / frames)) return null;
      const frame = new VideoFrame(canvas, { timestamp: (1e6 * i) / perSecond, duration: 1e6 / perSecond });
      encoder.encode(frame, { keyFrame: i % perSecond === 0 });
      frame.close();
      while (encoder.encodeQueueSize > 4) await new Promise((resolve) => setTimeout(resolve, 5));
    }
    await encoder.flush();
  } finally {
    if (encoder.state !== 'closed') encoder.close();
  }
  muxer.finalize();
  return failure ? null : new Blob([target.buffer], { type: 'video/webm' });
}

export function Film({ name, pictures }: { name: string; pictures: Pictures }) {
  const [share, setShare] = useState<number | null>(null);
  const wanted = useRef(true);
  const start = async () => {
    wanted.current = true;
    setShare(0);
    const film = await encoded(pictures, (done) => {
      setShare(done);
      return wanted.current;
    }).catch(() => null);
    setShare(null);
    if (wanted.current) save(`${name}.webm`, film);
  };
  if (typeof VideoEncoder === 'undefined') return <p class="hint">{missing}</p>;
  return (
    <p class="buttons film">
      {share === null
        ? <><button type="button" onClick={start}>Film (WebM)</button> <span class="hint">{seconds} s, {width} × {height}</span></>
        : <><button type="button" onClick={() => (wanted.current = false)}>Stop the film</button> <progress max={1} value={share} aria-label="Finished share of the film" /></>}
    </p>
  );
}
