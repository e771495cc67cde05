"""The command slipfront animate, which draws slip pulses as moving pictures."""

import json
import pathlib
import tomllib

from ._arguments import Arguments, add_units, chosen_units, file_name, progress, put
from ._optional import import_optional

FRAMES = 75

#: The rock for scales in SI units, as in the paper: P-wave speed in m/s, Poisson's ratio, shear modulus in Pa.
ROCK = {"p_wave_speed": 6000.0, "poisson_ratio": 0.3, "shear_modulus": 30e9}


def run(scenario, si):
    """Runs the pulse of a scenario file. The output times give a smooth animation unless the scenario has its own."""
    import slipfront

    try:
        with open(scenario, "rb") as file:
            own = "times" in tomllib.load(file).get("output", {})
    except (OSError, tomllib.TOMLDecodeError, AttributeError, UnicodeDecodeError):
        own = False  # slipfront.check below reports the error
    plan = slipfront.check(scenario)
    pulse = slipfront.pulse(scenario, set={} if own else {"output.every": plan["end"] / (FRAMES - 1)}, si=si)
    return pulse.assign_attrs(title=plan["title"])  # the title of the run names the output times that we have set


def pulse_of(source, si=None):
    """Returns the pulse of a file. A scenario is run first. `si` chooses the units, by default those of the file or the scenario."""
    from .plots import files

    pulse = run(source, si) if source.lower().endswith(".toml") else files.read(source, si)
    if not {"W", "Sigma", "k", "x_bounds"} <= set(pulse.variables) or set(pulse["k"].dims) != {"time", "x"} or pulse.sizes["time"] < 2:
        raise ValueError(f"{source}: contains no pulse with two or more output times; allowed: a file of pulse or chain, or a scenario")
    return pulse


def si_units(options):
    """Returns the SI values of the units from --contact-ratio and --asperity-spacing, or None if both are missing."""
    from . import medium

    if (options.contact_ratio is None) != (options.asperity_spacing is None):
        raise ValueError("--contact-ratio and --asperity-spacing: one is missing; scales in m, s, m/s and MPa need both")
    if options.contact_ratio is None:
        return None
    speed = float(medium.speed_from_p_wave(ROCK["p_wave_speed"], ROCK["poisson_ratio"]))
    return medium.units(ROCK["shear_modulus"], speed, options.contact_ratio, options.asperity_spacing)


def arguments(argv):
    """Returns the options of the command line."""
    parser = Arguments("animate", "Draws slip pulses as moving pictures: the averaged slip velocity and stress, and the dislocations that carry them.",
                       ["slipfront animate cases/step.toml -o step.gif", "slipfront animate cases/step.toml cases/step-viscous.toml -o both.webp"])
    parser.add_argument("sources", metavar="FILE", nargs="+",
                        help="NetCDF of pulse or chain (a frame for each output time), or a scenario (TOML) to run; several are drawn side by side")
    parser.add_argument("-o", "--output", metavar="PICTURE", type=file_name, required=True, help="its ending is the format: gif, webp, mp4")
    parser.add_argument("--contact-ratio", metavar="A", type=float, help="contact ratio; adds scales in SI units to the dimensionless ones")
    parser.add_argument("--asperity-spacing", metavar="METRES", type=float,
                        help="asperity spacing b in m, for the scales in SI units; the rock is that of the paper: P waves of 6 km/s, Poisson's ratio 0.3, 30 GPa")
    add_units(parser, "default if the file or the scenario is in SI units")
    return parser.parse_args(argv)


def main(argv) -> int:
    """Writes the animation and returns the exit code. Raises ValueError for bad input, OSError for files, and ImportError for a
    missing library."""
    options = arguments(argv)
    for module in ("xarray", "matplotlib", "PIL"):
        import_optional(module)
    from .plots import movie
    from .plots.animation import Scene

    output = pathlib.Path(options.output)
    if output.suffix.lower().lstrip(".") not in movie.FORMATS:
        raise ValueError(f"-o {output}: '{output.suffix}' is not a format of moving pictures; allowed endings: {', '.join(movie.FORMATS)}")
    pulses, si = [pulse_of(source, chosen_units(options)) for source in options.sources], si_units(options)
    if si and any(pulse.attrs.get("unit_system") == "SI" for pulse in pulses):
        raise ValueError("--contact-ratio: the pulse is in SI units already; allowed: with --dimensionless")
    if len({pulse.attrs.get("unit_system") for pulse in pulses}) > 1:
        raise ValueError("FILE: some are in SI units and others are not; allowed: --si or --dimensionless for all")
    scene, frames = Scene(pulses, si), []
    for row in range(scene.times.size):
        progress(options, f"frame {row + 1} of {scene.times.size}")
        frames.append(scene.show(row))
    movie.write(frames, output)
    progress(options, "")
    if options.json:
        print(json.dumps({"picture": str(output), "frames": len(frames), "dislocations_scale": scene.scale, "bytes": output.stat().st_size}))
    elif not options.quiet:
        put(f"written to {output}: {len(frames)} frames, {output.stat().st_size / 1e6:.2f} MB")
    return 0
