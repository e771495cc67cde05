"""slipfront animate: a slip pulse as a moving picture."""

import json
import pathlib
import tomllib

from ._arguments import Arguments, file_name, progress, put
from ._optional import import_optional

FRAMES = 75


def run(scenario):
    """The pulse of a scenario file, with output times for smooth motion unless it names its own."""
    import slipfront

    try:
        with open(scenario, "rb") as file:
            own = "times" in tomllib.load(file).get("output", {})
    except (OSError, tomllib.TOMLDecodeError, AttributeError, UnicodeDecodeError):
        own = False  # what is wrong with it, the reader of scenarios says
    return slipfront.pulse(scenario, set={} if own else {"output.every": slipfront.check(scenario)["end"] / (FRAMES - 1)})


def main(argv) -> int:
    """Writes the animation. Returns the exit code; raises ValueError (bad input), OSError (files), ImportError (a library)."""
    parser = Arguments("animate", "A slip pulse as a moving picture: the averaged slip velocity and stress, and the dislocations that carry them.")
    parser.add_argument("source", metavar="FILE", help="NetCDF of pulse or chain (a frame for each output time), or a scenario (TOML) to run")
    parser.add_argument("-o", "--output", metavar="PICTURE", type=file_name, required=True, help="its ending is the format: gif, webp, mp4")
    options = parser.parse_args(argv)
    for module in ("xarray", "matplotlib", "PIL"):
        import_optional(module)
    from .plots import files, movie
    from .plots.animation import Scene

    output = pathlib.Path(options.output)
    if output.suffix.lower().lstrip(".") not in movie.FORMATS:
        raise ValueError(f"-o {output}: '{output.suffix}' is no moving picture; allowed endings: {', '.join(movie.FORMATS)}")
    pulse = run(options.source) if options.source.lower().endswith(".toml") else files.read(options.source)
    if not {"W", "Sigma", "k", "x_bounds"} <= set(pulse.variables) or set(pulse["k"].dims) != {"time", "x"} or pulse.sizes["time"] < 2:
        raise ValueError(f"{options.source}: no pulse over two or more times in it; allowed: a file of pulse or chain, or a scenario")
    scene, frames = Scene(pulse), []
    for row in range(pulse.sizes["time"]):
        progress(options, f"frame {row + 1} of {pulse.sizes['time']}")
        frames.append(scene.show(row))
    movie.write(frames, output)
    progress(options, "")
    if options.json:
        print(json.dumps({"picture": str(output), "frames": len(frames), "dislocations_scale": scene.scale, "bytes": output.stat().st_size}))
    elif not options.quiet:
        put(f"written to {output}: {len(frames)} frames, {output.stat().st_size / 1e6:.2f} MB")
    return 0
