"""Frames -> a file."""

import io
import pathlib
import shutil
import subprocess
import tempfile

import numpy
from PIL import Image

from .._files import isolated, told_of, write_bytes

FORMATS = ("gif", "webp", "mp4")
PER_SECOND = 15


def write(frames, path) -> None:
    """Writes a moving picture; its format is the name's ending (FORMATS). The file is whole or not
    there.

    frames: arrays of height by width by 3, 0 to 255, all of one size; the last is held for a
    second. Raises OSError where it cannot be written, ImportError for MP4 without ffmpeg.
    """
    kind = pathlib.Path(path).suffix.lower().lstrip(".")
    with told_of(path):
        write_bytes(path, mp4(frames) if kind == "mp4"
                    else isolated(path, lambda: pictures(frames, kind)))


def pictures(frames, kind):
    """GIF, with one palette for all frames, or WebP, as bytes."""
    images = [Image.fromarray(frame) for frame in frames]
    times = [round(1000 / PER_SECOND)] * (len(images) - 1) + [1000]
    if kind == "gif":
        palette = images[len(images) // 2].quantize(256, method=Image.Quantize.MAXCOVERAGE,
                                                    dither=Image.Dither.NONE)
        images = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    picture = io.BytesIO()
    images[0].save(picture, kind, save_all=True, append_images=images[1:], duration=times, loop=0,
                   quality=70)
    return picture.getvalue()


def mp4(frames):
    """H.264 by ffmpeg, a program of its own, as bytes."""
    program = shutil.which("ffmpeg")
    if program is None:
        raise ImportError("MP4 needs ffmpeg; install the Debian package ffmpeg, or choose .gif or "
                          ".webp")
    # H.264 wants even sizes
    frames = [frame[: frame.shape[0] // 2 * 2, : frame.shape[1] // 2 * 2] for frame in frames]
    height, width = frames[0].shape[:2]
    command = [program, "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s",
               f"{width}x{height}", "-r", str(PER_SECOND), "-i", "-", "-pix_fmt", "yuv420p",
               "-movflags", "+faststart"]
    raw = b"".join(numpy.ascontiguousarray(frame).tobytes()
                   for frame in frames + [frames[-1]] * PER_SECOND)
    with tempfile.TemporaryDirectory() as folder:  # ffmpeg goes back in its file
        whole = pathlib.Path(folder) / "movie.mp4"
        done = subprocess.run([*command, str(whole)], input=raw, capture_output=True)
        if done.returncode:
            lines = done.stderr.decode(errors="replace").strip().splitlines()
            raise OSError(f"ffmpeg: {lines[-1] if lines else 'failed'}")
        return whole.read_bytes()
