"""Frames -> a file."""

import pathlib
import shutil
import subprocess

import numpy
from PIL import Image

from .._beside import beside

FORMATS = ("gif", "webp", "mp4")
PER_SECOND = 15


def write(frames, path) -> None:
    """Writes a moving picture; its format is the name's ending (FORMATS). The file is whole or not there.

    frames: arrays of height by width by 3, 0 to 255, all of one size; the last is held for a second.
    Raises OSError where it cannot be written, ImportError for MP4 without ffmpeg.
    """
    path = pathlib.Path(path)
    try:
        with beside(path) as name:
            if path.suffix.lower() == ".mp4":
                mp4(frames, name)
            else:
                pictures(frames, name)
    except OSError as error:
        raise OSError(f"{path}: {error.strerror or error}") from error


def pictures(frames, path):
    """GIF, with one palette for all frames, or WebP."""
    images = [Image.fromarray(frame) for frame in frames]
    times = [round(1000 / PER_SECOND)] * (len(images) - 1) + [1000]
    if path.suffix.lower() == ".gif":
        palette = images[len(images) // 2].quantize(64, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
        images = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    images[0].save(path, save_all=True, append_images=images[1:], duration=times, loop=0, quality=70)


def mp4(frames, path):
    """H.264 by ffmpeg, a program of its own."""
    program = shutil.which("ffmpeg")
    if program is None:
        raise ImportError("MP4 needs ffmpeg; install the Debian package ffmpeg, or choose .gif or .webp")
    frames = [frame[: frame.shape[0] // 2 * 2, : frame.shape[1] // 2 * 2] for frame in frames]  # H.264 wants even sizes
    height, width = frames[0].shape[:2]
    command = [program, "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(PER_SECOND), "-i", "-",
               "-pix_fmt", "yuv420p", "-movflags", "+faststart", str(path)]
    raw = b"".join(numpy.ascontiguousarray(frame).tobytes() for frame in frames + [frames[-1]] * PER_SECOND)
    done = subprocess.run(command, input=raw, capture_output=True)
    if done.returncode:
        lines = done.stderr.decode(errors="replace").strip().splitlines()
        raise OSError(f"ffmpeg: {lines[-1] if lines else 'failed'}")
